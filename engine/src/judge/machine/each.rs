//! Runs loops: for players and events in turn, for numbers several at a time.

use super::fold::Folding;
use super::plan::Loop;
use super::{Crew, Machine, POINTS, each_lane, is_kind};
use crate::judge::view::{ids, team_number, team_of_number};
use crate::state::PlayerId;
use crate::state::event::Event;
use setpiece_scenario::Over;

impl<const W: usize> Machine<'_, W> {
    /// Runs a loop and folds it in the first `N` lanes; in one lane if all are the same.
    pub(super) fn each<const N: usize>(&mut self, each: &Loop, at: usize) -> [f64; N] {
        let mut folding = Folding::<N>::new(each.fold.kind);
        let around = self.crew.seated;
        match &each.over {
            Over::Players { team, except } => {
                let (teams, except) =
                    (self.lanes::<W>(*team), except.map(|reg| self.lanes::<W>(reg)));
                for id in players_of::<N, W>(&teams) {
                    if !self.input.now.is_some_and(|now| now.is_active(id)) {
                        continue;
                    }
                    let number = id as f64;
                    let own = team_number(Some(PlayerId(id as u8).team()));
                    let taken: [bool; W] = each_lane(|lane| {
                        let but = except.is_some_and(|except| except[lane] == number);
                        (teams[lane] == own || teams[lane] == -1.0) && !but
                    });
                    if taken[..N].contains(&true) {
                        self.element(each, at, (number, None), (&around, &taken), &mut folding);
                    }
                }
            }
            Over::Events(filter) => {
                let events = self.input.events;
                for (number, event) in
                    events.iter().enumerate().filter(|(_, event)| is_kind(filter, event))
                {
                    let taken: [bool; W] =
                        each_lane(|lane| self.passes(filter, event, if N == 1 { 0 } else { lane }));
                    if taken[..N].contains(&true) {
                        self.element(
                            each,
                            at,
                            (number as f64, Some(event)),
                            (&around, &taken),
                            &mut folding,
                        );
                    }
                }
            }
            Over::Numbers(count) => {
                for number in 0..*count {
                    let number = (f64::from(number), None);
                    self.element(each, at, number, (&around, &[true; W]), &mut folding);
                }
            }
        }
        self.crew.seated = around;
        folding.result()
    }

    /// Runs a loop over numbers and folds it, with numbers in the lanes instead of players: what is
    /// the same for all numbers is computed once for [`POINTS`] of them.
    pub(super) fn each_point(&mut self, each: &Loop, at: usize) -> f64 {
        let mut folding = Folding::<1>::new(each.fold.kind);
        let Over::Numbers(count) = each.over else { return folding.result()[0] };
        let points = std::mem::take(&mut self.points);
        for &reg in &each.reads {
            points[reg as usize] = [self.regs[reg as usize][0]; POINTS];
        }
        let mut machine = Machine {
            input: self.input,
            crew: Crew { players: [self.crew.players[0]; POINTS], seated: [true; POINTS] },
            plan: self.plan,
            regs: &mut *points,
            points: &mut [],
            cells: &mut [],
            terms: &mut [],
            faults: self.faults,
            draws: self.draws,
        };
        for first in (0..count).step_by(POINTS) {
            let numbers: [f64; POINTS] = each_lane(|lane| f64::from(first) + lane as f64);
            machine.regs[at] = numbers;
            machine.block(&each.body, None);
            let guard = each.fold.guard.map_or([true; POINTS], |guard| machine.truths(guard));
            let value = each.fold.value.map_or([0.0; POINTS], |value| machine.lanes(value));
            for lane in 0..POINTS.min((count - first) as usize) {
                folding.add(numbers[lane], [guard[lane]], [value[lane]]);
            }
        }
        self.points = points;
        folding.result()[0]
    }

    /// Runs the body of a loop for an element, in the lanes that take it.
    #[inline]
    fn element<const N: usize>(
        &mut self,
        each: &Loop,
        at: usize,
        (element, event): (f64, Option<&Event>),
        (around, taken): (&[bool; W], &[bool; W]),
        folding: &mut Folding<N>,
    ) {
        self.regs[at] = [element; W];
        self.crew.seated = each_lane(|lane| around[lane] & taken[lane]);
        self.block(&each.body, event);
        let guard = each.fold.guard.map_or([true; N], |guard| self.truths::<N>(guard));
        let value = each.fold.value.map_or([0.0; N], |value| self.lanes::<N>(value));
        folding.add(element, each_lane(|lane| taken[lane] & guard[lane]), value);
    }
}

/// The players that a loop may visit: only one team's if every lane asks for the same.
fn players_of<const N: usize, const W: usize>(teams: &[f64; W]) -> std::ops::Range<usize> {
    if teams[..N].iter().all(|team| *team == teams[0]) {
        match team_of_number(teams[0]) {
            Some(team) => ids(Some(team)),
            None if teams[0] == -1.0 => ids(None),
            None => 0..0,
        }
    } else {
        ids(None)
    }
}
