//! Checks a scenario that was read from a file: afterwards every index in it is valid.
//!
//! The compiler writes only scenarios that pass. A file may contain anything.

mod behavior;

use crate::bounds::{self, NAME_MAX_BYTES};
use crate::pitch::TEAM_MAX;
use crate::program::{Fold, Instr, Program, Reg};
use crate::scenario::{Ai, RewardBody, Scenario, SideAgents};
use crate::table::{TABLE_MAX, Table};
use crate::vocabulary::{Owner, Team};

/// The most instructions of one program.
const CODE_MAX: usize = 100_000;
/// Deepest nesting of loops: each multiplies the work by the number of players.
const LOOPS_MAX: usize = 4;

/// Checks a scenario.
///
/// # Errors
/// One sentence about the first problem found.
pub fn verify(scenario: &Scenario) -> Result<(), String> {
    bounds::check(scenario).map_err(|excess| excess.message)?;
    verify_names(scenario)?;
    for team in Team::ALL {
        if scenario.seats(*team).count() > TEAM_MAX {
            return Err(format!("the {team} team has more than {TEAM_MAX} players"));
        }
    }
    if scenario.players.windows(2).any(|pair| pair[0].team > pair[1].team) {
        return Err("the left team's players must come before the right team's".to_owned());
    }
    for param in &scenario.params {
        param.admit(param.default).map_err(|error| error.to_string())?;
    }
    let n_params = scenario.params.len();
    let n_lets = scenario.start.lets.len();
    let n_scripts = scenario.scripts.len();
    let check = |what: &str, program: &Program, place: ProgramPlace| {
        verify_program(program, place, n_params, n_lets).map_err(|fault| format!("{what}: {fault}"))
    };
    check("the start", &scenario.start.program, ProgramPlace::Start)?;
    check("the endings", &scenario.endings.program, ProgramPlace::Step { terms: 0 })?;
    let round = scenario.endings.round;
    round.map_or(Ok(()), |reg| visible(&scenario.endings.program, reg))?;
    for substitution in &scenario.endings.substitutions {
        below("player", u32::from(substitution.player), crate::pitch::PLAYERS_MAX)?;
        substitution
            .clone()
            .regs_mut()
            .try_for_each(|reg| visible(&scenario.endings.program, *reg))?;
    }
    for ending in &scenario.endings.list {
        ending.when.map_or(Ok(()), |reg| visible(&scenario.endings.program, reg))?;
        ending.script.map_or(Ok(()), |script| below("script", script, n_scripts))?;
    }
    for reward in scenario.rewards.iter().chain(&scenario.library) {
        let RewardBody { init, step, terms, hooks } = &reward.body;
        check(&reward.name, init, ProgramPlace::Init)?;
        check(&reward.name, step, ProgramPlace::Step { terms: terms.len() })?;
        if init.cells != step.cells {
            return Err(format!("{}: init and step differ in memory", reward.name));
        }
        let fixed = step.fixed();
        for hook in hooks {
            below("script", hook.script, n_scripts)?;
            below("cell", hook.cells().end - 1, step.cells as usize)?;
            for reg in hook.args.iter().flat_map(|arg| &arg.regs) {
                visible(step, *reg)?;
                if !fixed[reg.index()] {
                    return Err(format!(
                        "{}: an argument of a script changes within an episode",
                        reward.name
                    ));
                }
            }
        }
    }
    for record in &scenario.records {
        check(&record.name, &record.program, ProgramPlace::Step { terms: 0 })?;
        record.values.iter().try_for_each(|&reg| visible(&record.program, reg))?;
        if !(1..=2).contains(&record.values.len()) {
            return Err(format!("{}: a record has one value or two", record.name));
        }
    }
    if let Some(observation) = &scenario.observation {
        check("the observation", &observation.program, ProgramPlace::Observation)?;
        observation
            .columns()
            .into_iter()
            .try_for_each(|column| visible(&observation.program, column))?;
        if observation.values.iter().any(|value| value.ago > observation.history) {
            return Err("the observation looks back further than it keeps".to_owned());
        }
        if observation.program.cells > 0 {
            return Err("the observation remembers something".to_owned());
        }
    }
    for behavior in &scenario.behaviors {
        check(&behavior.name, &behavior.program, ProgramPlace::Step { terms: 0 })?;
        behavior::verify_nodes(behavior, n_scripts)
            .map_err(|fault| format!("{}: {fault}", behavior.name))?;
    }
    for (script, named) in
        scenario.scripts.iter().flat_map(|of| of.named.iter().map(move |named| (of, named)))
    {
        let what = format!("{} in {}", named.name, script.name);
        check(&what, &named.program, ProgramPlace::Step { terms: 0 })?;
        named.values.iter().try_for_each(|&reg| visible(&named.program, reg))?;
        if named.values.len() != named.kind.n_values()
            || named.program.cells != named.kind.n_cells()
            || named.program.uses_me()
        {
            return Err(format!("{what}: is not what a script can read"));
        }
    }
    verify_start(scenario)
}

/// Names that other names are derived from (files, keys, ids) must be words of the language.
fn verify_names(scenario: &Scenario) -> Result<(), String> {
    let params = scenario.params.iter().map(|param| &param.name);
    let players = scenario.players.iter().filter_map(|slot| slot.name.as_ref());
    for name in std::iter::once(&scenario.name).chain(params).chain(players) {
        let word = name.bytes().all(|byte| byte.is_ascii_alphanumeric() || byte == b'_');
        if name.is_empty() || !word {
            return Err(format!("{name:?} is not a name: it may have letters, digits and `_`"));
        }
    }
    if scenario.name.len() > NAME_MAX_BYTES {
        return Err(format!("its name is longer than {NAME_MAX_BYTES} letters"));
    }
    Ok(())
}

fn verify_start(scenario: &Scenario) -> Result<(), String> {
    let start = &scenario.start;
    let mut regs: Vec<Reg> = start.lets.clone();
    regs.extend(start.difficulty);
    regs.extend([start.ball.x, start.ball.y]);
    regs.extend(
        [
            start.ball.height,
            start.ball.owner,
            start.taker,
            start.elapsed,
            start.limit,
            start.rounds,
        ]
        .into_iter()
        .flatten(),
    );
    regs.extend(start.ball.velocity.iter().chain(&start.ball.spin).flat_map(|v| [v.0, v.1, v.2]));
    regs.extend(start.score.iter().flat_map(|s| [s.0, s.1]));
    regs.extend(start.rules.iter().map(|setting| setting.value));
    regs.extend(start.world.iter().map(|setting| setting.value));
    regs.extend(start.pitch.iter().map(|setting| setting.value));
    for require in &start.requires {
        regs.push(require.condition);
        regs.extend(require.probability);
    }
    if let Some(kickoff) = &start.kickoff {
        if kickoff.places.len() != scenario.players.len() {
            return Err("the kick-off has not one place per player".to_owned());
        }
        regs.push(kickoff.first);
        for place in &kickoff.places {
            regs.extend([place.kicking.0, place.kicking.1, place.receiving.0, place.receiving.1]);
        }
    }
    for slot in &scenario.players {
        let s = &slot.start;
        regs.extend([s.x, s.y]);
        regs.extend(
            [s.heading, s.fatigue, s.yellow_cards, s.difficulty, s.present, s.active]
                .into_iter()
                .flatten(),
        );
        regs.extend(s.velocity.iter().flat_map(|v| [v.0, v.1]));
        regs.extend(slot.stats.iter().map(|(_, reg)| *reg));
        regs.extend(slot.sometimes.iter().map(|(reg, _)| *reg));
        for ai in slot.played_by() {
            if let Ai::Behavior(behavior) = ai {
                below("behavior", behavior, scenario.behaviors.len())?;
            }
        }
    }
    for (team, side) in Team::ALL.iter().zip(&scenario.agents.sides) {
        match side {
            SideAgents::Count(reg) => regs.push(*reg),
            SideAgents::All => {}
            SideAgents::Players(players) => {
                let n = scenario.seats(*team).count();
                for &player in players {
                    below("player", u32::from(player), n)?;
                }
            }
        }
    }
    regs.into_iter().try_for_each(|reg| visible(&start.program, reg))
}

/// The role of a program, which decides what it may contain.
#[derive(Clone, Copy)]
enum ProgramPlace {
    Start,
    Init,
    Step { terms: usize },
    Observation,
}

impl ProgramPlace {
    /// Whether the match is under way.
    fn is_step(self) -> bool {
        matches!(self, ProgramPlace::Step { .. } | ProgramPlace::Observation)
    }
}

fn verify_table(table: &Table) -> Result<(), String> {
    let whole = table.columns > 0
        && !table.values.is_empty()
        && table.values.len() <= TABLE_MAX
        && table.values.len().is_multiple_of(table.columns as usize);
    if !whole || table.values.iter().any(|value| !value.is_finite()) {
        return Err("a table is not a rectangle of finite numbers".to_owned());
    }
    Ok(())
}

fn verify_program(
    program: &Program,
    place: ProgramPlace,
    n_params: usize,
    n_lets: usize,
) -> Result<(), String> {
    if program.code.len() > CODE_MAX || program.cells as usize > CODE_MAX {
        return Err("too large".to_owned());
    }
    program.tables.iter().try_for_each(verify_table)?;
    // Ends of the bodies around the current instruction, innermost last.
    let mut open: Vec<(usize, usize, Fold, bool)> = Vec::new();
    for (at, instr) in program.code.iter().enumerate() {
        while open.last().is_some_and(|body| body.1 == at) {
            close_body(program, &mut open)?;
        }
        let mut fault = None;
        instr.operands(&mut |reg| {
            if reg.index() >= at {
                fault =
                    Some(format!("instruction {at} reads register {} before it is written", reg.0));
            }
        });
        fault.map_or(Ok(()), Err)?;
        if instr.cell().is_some_and(|cell| cell >= program.cells) {
            return Err(format!("instruction {at} uses a memory cell that is not there"));
        }
        match (instr, place) {
            (Instr::Const(value), _) if !value.is_finite() => {
                return Err(format!("constant {at} is not finite"));
            }
            (Instr::Table { table, .. }, _) => below("table", *table, program.tables.len())?,
            (Instr::Param(param), _) => below("parameter", *param, n_params)?,
            (Instr::Let(_), ProgramPlace::Start) => {
                return Err("a `let` is read in the start itself".to_owned());
            }
            (Instr::Let(index), _) => below("let", *index, n_lets)?,
            (Instr::Load { field, of, .. }, _) => {
                let wanted = matches!(field.subject(), Owner::Player | Owner::Team);
                if wanted != of.is_some() {
                    return Err(format!("instruction {at} loads `{field}` of the wrong thing"));
                }
                if !place.is_step() {
                    return Err(format!("instruction {at} reads the match before it has begun"));
                }
            }
            (Instr::RoundElapsed, ProgramPlace::Start | ProgramPlace::Init) => {
                return misplaced(at);
            }
            (Instr::Event(_), _) if !open.iter().any(|body| body.3) => {
                return Err(format!("instruction {at} reads an event outside a loop over events"));
            }
            _ if instr.looks_back() && !open.is_empty() => {
                return Err(format!("instruction {at} looks back inside a loop"));
            }
            (Instr::Give { term, .. }, ProgramPlace::Step { terms }) => {
                below("term", *term, terms)?;
            }
            (Instr::Random { .. }, ProgramPlace::Observation) if !open.is_empty() => {
                return Err(format!("instruction {at} draws inside a loop"));
            }
            (Instr::Random { .. }, ProgramPlace::Start | ProgramPlace::Observation)
            | (Instr::Assign { .. }, ProgramPlace::Init | ProgramPlace::Step { .. })
            | (
                Instr::Terminated | Instr::Us | Instr::Me,
                ProgramPlace::Step { .. } | ProgramPlace::Observation,
            )
            | (Instr::Us, ProgramPlace::Init) => {}
            (_, ProgramPlace::Step { .. } | ProgramPlace::Observation) if instr.looks_back() => {}
            _ if instr.looks_back() => return misplaced(at),
            (
                Instr::Random { .. }
                | Instr::Give { .. }
                | Instr::Assign { .. }
                | Instr::Terminated
                | Instr::Us
                | Instr::Me,
                _,
            ) => return misplaced(at),
            (Instr::Each(each), _) => {
                let end = at + 1 + each.body as usize;
                let limit = open.last().map_or(program.code.len(), |body| body.1);
                if end > limit {
                    return Err(format!("the loop at {at} runs past its end"));
                }
                if !place.is_step() {
                    return Err(format!("instruction {at} reads the match before it has begun"));
                }
                if open.len() >= LOOPS_MAX {
                    return Err(format!("the loop at {at} is nested more than {LOOPS_MAX} deep"));
                }
                let events = matches!(each.over, crate::program::Over::Events(_));
                open.push((at, end, each.fold.clone(), events));
            }
            _ => {}
        }
    }
    while !open.is_empty() {
        close_body(program, &mut open)?;
    }
    Ok(())
}

fn misplaced(at: usize) -> Result<(), String> {
    Err(format!("instruction {at} has no place there"))
}

fn close_body(program: &Program, open: &mut Vec<(usize, usize, Fold, bool)>) -> Result<(), String> {
    if let Some((at, end, fold, _)) = open.pop() {
        for reg in fold.value.iter().chain(&fold.guard) {
            if reg.index() >= end || reg.index() >= program.code.len() {
                return Err(format!("the loop at {at} folds a register behind its end"));
            }
        }
    }
    Ok(())
}

fn visible(program: &Program, reg: Reg) -> Result<(), String> {
    below("register", reg.0, program.code.len())
}

fn below(what: &str, index: u32, n: usize) -> Result<(), String> {
    if (index as usize) < n { Ok(()) } else { Err(format!("{what} {index} of {n} is not there")) }
}
