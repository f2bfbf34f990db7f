//! How many agents a scenario has, where its parameters alone decide it.

use setpiece_scenario::operators::truth;
use setpiece_scenario::plan::Played;
use setpiece_scenario::vocabulary::Team;
use setpiece_scenario::{Instr, Reg, SideAgents};

/// The agents of both sides; `None` if a draw would decide.
pub(super) fn agents_of(played: &Played) -> Option<[usize; 2]> {
    Some([of_side(played, Team::Left)?, of_side(played, Team::Right)?])
}

fn of_side(played: &Played, team: Team) -> Option<usize> {
    let scenario = &played.scenario;
    let mut seats = Vec::new();
    for (_, slots) in scenario.seats(team) {
        let mut is_open = false;
        for slot in slots {
            let is_present = match slot.start.present {
                Some(present) => truth(value(played, present)?),
                None => true,
            };
            is_open |= is_present;
        }
        seats.push((is_open, slots.iter().any(|slot| slot.controllable)));
    }
    match scenario.agents.sides.get(team.index())? {
        SideAgents::Count(count) => Some(value(played, *count)?.round() as usize),
        SideAgents::All => Some(seats.iter().filter(|seat| **seat == (true, true)).count()),
        SideAgents::Players(players) => {
            let is_open = |place: &&u8| seats.get(usize::from(**place)).is_some_and(|seat| seat.0);
            Some(players.iter().filter(is_open).count())
        }
    }
}

/// The value of a register of the start that depends on parameters alone.
fn value(played: &Played, reg: Reg) -> Option<f64> {
    match played.scenario.start.program.code.get(reg.index())? {
        Instr::Const(value) => Some(*value),
        Instr::Param(param) => played.bindings.0.get(*param as usize).copied(),
        Instr::Unary(op, a) => op.fold(value(played, *a)?),
        Instr::Binary(op, a, b) => Some(op.apply(value(played, *a)?, value(played, *b)?)),
        Instr::Select(condition, then, otherwise) => {
            let holds = truth(value(played, *condition)?);
            value(played, if holds { *then } else { *otherwise })
        }
        _ => None,
    }
}
