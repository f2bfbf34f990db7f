//! The largest cost of a scenario: its memory, and the work of a step and of a reset.
//!
//! A text of a megabyte or a compiled file can ask for more than any machine has: loops multiply
//! instructions, and every agent has its own memory. The totals are computed before anything is
//! built from the scenario. They assume that every loop visits everybody and that every player has
//! an agent. The compiler reports an excess at its place in the text; a file is rejected.

use crate::behavior::Node;
use crate::module::MODULES_MAX;
use crate::named::NamedValue;
use crate::pitch::PLAYERS_MAX;
use crate::program::{Distribution, Instr, Over, Program};
use crate::scenario::{Ai, Reward, Scenario, Script};
use crate::vocabulary::Team;

/// The most events of one step.
pub const EVENTS_MAX: usize = 128;
/// The most instructions of a step, for all rewards, records, observations and behaviours: about a
/// quarter of a second. Four nested loops over all players run a million.
pub const STEP_WORK_MAX: u64 = 1 << 25;
/// The most instructions of one attempt at a start.
pub const START_WORK_MAX: u64 = 1 << 22;
/// The most instructions of all programs: with one register per agent and instruction, about 50 MB.
pub const CODE_MAX: u64 = 200_000;
/// The most memory cells of all programs; each agent has its own copy.
pub const CELLS_MAX: u64 = 100_000;
/// The most terms of all rewards; each has a name and sums for every agent.
pub const TERMS_MAX: u64 = 10_000;
/// The most parameters, requirements, rewards, endings, records and behaviours, counted separately.
pub const PARTS_MAX: u64 = 2_000;
/// The most `let`s, and the most numbers of an observation.
pub const NUMBERS_MAX: u64 = 10_000;
/// The most nodes of all behaviours.
pub const NODES_MAX: u64 = 250_000;
/// Most numbers that the agents' observations keep of earlier steps.
const KEPT_MAX: u64 = 1_000_000;
/// The most numbers that all series keep per step: 8 kB, for as long as the episode lasts.
pub const SERIES_MAX: u64 = 1_000;
/// The most bytes of all scripts.
pub const SCRIPTS_MAX_BYTES: u64 = 1 << 20;
/// The most bytes of a script and its modules. The time that Rhai takes to read a text grows with
/// the square of its length.
pub const SCRIPT_MAX_BYTES: usize = 32 << 10;
/// Longest name of a scenario, bytes, because files are named after it.
pub const NAME_MAX_BYTES: usize = 128;

/// Cost of the worst draw from a truncated normal distribution, in instructions: it is repeated
/// until the value is within its ends.
const TRUNCATED_WORK: u64 = 1_000;

/// A part of a scenario, by its index in its list.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    /// The whole scenario.
    Scenario,
    /// Its start.
    Start,
    /// A reward that it pays.
    Reward(usize),
    /// Another reward in scope.
    Library(usize),
    /// Its endings.
    Endings,
    /// A record.
    Record(usize),
    /// Its observation.
    Observation,
    /// A behaviour.
    Behavior(usize),
}

/// A total that is too large.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Excess {
    /// The part that adds most to it.
    pub part: Part,
    /// One clause.
    pub message: String,
    /// What to change.
    pub help: &'static str,
}

/// Checks the totals of a scenario. Its programs need not be verified.
///
/// # Errors
/// The first total beyond its bound.
pub fn check(scenario: &Scenario) -> Result<(), Excess> {
    let nodes = scenario.behaviors.iter().map(|behavior| behavior.nodes.len()).sum();
    let parts = [
        ("parameters", scenario.params.len(), PARTS_MAX),
        ("`let`s", scenario.start.lets.len(), NUMBERS_MAX),
        ("requirements", scenario.start.requires.len(), PARTS_MAX),
        ("rewards", scenario.rewards.len() + scenario.library.len(), PARTS_MAX),
        ("endings", scenario.endings.list.len(), PARTS_MAX),
        ("substitutions", scenario.endings.substitutions.len(), PARTS_MAX),
        ("records", scenario.records.len(), PARTS_MAX),
        (
            "numbers to observe",
            scenario.observation.as_ref().map_or(0, |it| it.values.len()),
            NUMBERS_MAX,
        ),
        ("behaviours", scenario.behaviors.len(), PARTS_MAX),
        ("things to do in its behaviours", nodes, NODES_MAX),
    ];
    for (what, n, most) in parts {
        Total::count(what, Part::Scenario, n as u64).within(most, "leave some of them out")?;
    }
    let bytes = scenario.scripts.iter().map(|script| script.n_bytes() as u64).sum();
    Total::count("bytes of scripts", Part::Scenario, bytes)
        .within(SCRIPTS_MAX_BYTES, "make the scripts shorter")?;
    let longest = scenario.scripts.iter().map(Script::n_bytes).max();
    Total::count("bytes in one script", Part::Scenario, longest.unwrap_or_default() as u64)
        .within(SCRIPT_MAX_BYTES as u64, "divide the script")?;
    let modules = scenario.scripts.iter().map(|script| script.modules.len()).max();
    Total::count("modules of one script", Part::Scenario, modules.unwrap_or_default() as u64)
        .within(MODULES_MAX as u64, "join some of them")?;

    let (mut code, mut cells, mut terms) =
        (Total::new("instructions"), Total::new("memory cells"), Total::new("terms of rewards"));
    for (part, program) in programs(scenario) {
        code.add(part, program.code.len() as u64);
        cells.add(part, program.cells.into());
    }
    for (part, reward) in rewards(scenario) {
        terms.add(part, reward.body.terms.len() as u64);
    }
    let mut series = Total::new("numbers of series in a step");
    let all = Counts::of(scenario).all;
    for (at, record) in scenario.records.iter().enumerate().filter(|(_, record)| record.series) {
        let times = if record.program.uses_me() { all } else { 1 };
        series.add(Part::Record(at), times * record.values.len() as u64);
    }
    series.within(SERIES_MAX, "keep fewer series")?;
    if let Some(observation) = &scenario.observation {
        let kept = (observation.columns().len() as u64).saturating_mul(observation.history.into());
        Total::count("numbers that observations keep", Part::Observation, kept.saturating_mul(all))
            .within(KEPT_MAX, "delay or stack fewer numbers, or look back less far")?;
    }
    code.within(CODE_MAX, "name what is used often with a `let`, and leave some of it out")?;
    cells.within(CELLS_MAX, "leave some of its `state`s, `held`s and `once`s out")?;
    terms.within(TERMS_MAX, "leave some of its `give`s out")?;

    let start = work(&scenario.start.program, &Counts::of(scenario));
    Total::count("instructions at a start", Part::Start, start)
        .within(START_WORK_MAX, "draw fewer values")?;
    step_work(scenario)
        .within(STEP_WORK_MAX, "nest fewer sums, and compute once with a `let` what is used often")
}

/// The cost of an attempt at a start, in instructions; at least one.
pub fn start_work(scenario: &Scenario) -> u64 {
    work(&scenario.start.program, &Counts::of(scenario)).max(1)
}

/// The cost of a value that a script reads by name, in instructions.
pub fn named_work(scenario: &Scenario, named: &NamedValue) -> u64 {
    work(&named.program, &Counts::of(scenario))
}

/// The cost of a step, in instructions.
fn step_work(scenario: &Scenario) -> Total {
    let counts = Counts::of(scenario);
    let mut total = Total::new("instructions in a step");
    // A program that doesn't depend on the agent's player runs once per team.
    let times = |program: &Program, else_: u64| if program.uses_me() { counts.all } else { else_ };
    for (part, reward) in rewards(scenario) {
        let step = &reward.body.step;
        total.add(part, times(step, 2).saturating_mul(work(step, &counts)));
    }
    total.add(Part::Endings, work(&scenario.endings.program, &counts));
    for (at, record) in scenario.records.iter().enumerate() {
        total.add(
            Part::Record(at),
            times(&record.program, 1).saturating_mul(work(&record.program, &counts)),
        );
    }
    if let Some(observation) = &scenario.observation {
        total
            .add(Part::Observation, counts.all.saturating_mul(work(&observation.program, &counts)));
    }
    for (at, behavior) in scenario.behaviors.iter().enumerate() {
        let plays = |ai| ai == Ai::Behavior(at as u32);
        let played =
            scenario.players.iter().filter(|slot| slot.played_by().any(plays)).count() as u64;
        // Each write to a cell computes everything again, and an interrupt may lead through it
        // twice.
        let writes = behavior.nodes.iter().filter(|node| writes(node)).count() as u64;
        let computed = work(&behavior.program, &counts).saturating_mul(1 + 2 * writes);
        total.add(
            Part::Behavior(at),
            played.saturating_mul(computed.saturating_add(2 * behavior.nodes.len() as u64)),
        );
    }
    total
}

fn writes(node: &Node) -> bool {
    matches!(node, Node::Let(_) | Node::Assign(_) | Node::Draw { .. } | Node::Mark(_))
}

/// A scenario's programs.
fn programs(scenario: &Scenario) -> impl Iterator<Item = (Part, &Program)> {
    let rewards = rewards(scenario)
        .flat_map(|(part, reward)| [(part, &reward.body.init), (part, &reward.body.step)]);
    let records =
        scenario.records.iter().enumerate().map(|(at, record)| (Part::Record(at), &record.program));
    let behaviors =
        scenario.behaviors.iter().enumerate().map(|(at, one)| (Part::Behavior(at), &one.program));
    let observation =
        scenario.observation.iter().map(|observation| (Part::Observation, &observation.program));
    let named = scenario.scripts.iter().flat_map(|script| &script.named);
    let named = named.map(|named| (Part::Scenario, &named.program));
    [(Part::Start, &scenario.start.program), (Part::Endings, &scenario.endings.program)]
        .into_iter()
        .chain(rewards)
        .chain(records)
        .chain(observation)
        .chain(behaviors)
        .chain(named)
}

/// The rewards that are paid, and those that can be requested.
fn rewards(scenario: &Scenario) -> impl Iterator<Item = (Part, &Reward)> {
    let paid = scenario.rewards.iter().enumerate().map(|(at, reward)| (Part::Reward(at), reward));
    paid.chain(scenario.library.iter().enumerate().map(|(at, reward)| (Part::Library(at), reward)))
}

/// The numbers of players.
struct Counts {
    teams: [u64; 2],
    all: u64,
}

impl Counts {
    fn of(scenario: &Scenario) -> Counts {
        let teams = [Team::Left, Team::Right]
            .map(|team| scenario.seats(team).count().min(PLAYERS_MAX) as u64);
        Counts { teams, all: teams.iter().sum() }
    }

    /// The most elements of a loop.
    fn of_loop(&self, over: &Over, code: &[Instr]) -> u64 {
        match over {
            Over::Events(_) => EVENTS_MAX as u64,
            Over::Numbers(number) => u64::from(*number),
            Over::Players { team, .. } => match code.get(team.index()) {
                Some(Instr::Const(team)) if *team == 0.0 => self.teams[0],
                Some(Instr::Const(team)) if *team == 1.0 => self.teams[1],
                Some(Instr::Us | Instr::Unary(..)) => self.teams[0].max(self.teams[1]),
                _ => self.all,
            },
        }
    }
}

/// The most instructions in one run of a program.
fn work(program: &Program, counts: &Counts) -> u64 {
    let mut total = 0_u64;
    // Ends of the loops around the current instruction, innermost last, and how often their bodies
    // run.
    let mut open: Vec<(usize, u64)> = Vec::new();
    for (at, instr) in program.code.iter().enumerate() {
        while open.last().is_some_and(|(end, _)| *end <= at) {
            open.pop();
        }
        let times = open.last().map_or(1, |(_, times)| *times);
        let mut once = 1;
        match instr {
            Instr::Each(each) => {
                let elements = counts.of_loop(&each.over, &program.code);
                // A loop checks everybody that it might visit.
                once = elements.saturating_add(1);
                open.push((at + 1 + each.body as usize, times.saturating_mul(elements)));
            }
            Instr::Random { from, .. } => match &**from {
                Distribution::Weighted(weights) => once += weights.len() as u64,
                Distribution::TruncatedNormal(..) => once += TRUNCATED_WORK,
                _ => {}
            },
            _ => {}
        }
        total = total.saturating_add(times.saturating_mul(once));
    }
    total
}

/// A sum over parts that remembers the largest one.
struct Total {
    what: &'static str,
    sum: u64,
    most: (u64, Part),
}

impl Total {
    fn new(what: &'static str) -> Total {
        Total { what, sum: 0, most: (0, Part::Scenario) }
    }

    fn count(what: &'static str, part: Part, n: u64) -> Total {
        Total { what, sum: n, most: (n, part) }
    }

    fn add(&mut self, part: Part, n: u64) {
        self.sum = self.sum.saturating_add(n);
        if n > self.most.0 {
            self.most = (n, part);
        }
    }

    fn within(self, most: u64, help: &'static str) -> Result<(), Excess> {
        if self.sum <= most {
            return Ok(());
        }
        let message = format!(
            "{} {}, where a scenario may have {}",
            grouped(self.sum),
            self.what,
            grouped(most)
        );
        Err(Excess { part: self.most.1, message, help })
    }
}

/// A number with a comma between every three digits.
fn grouped(n: u64) -> String {
    let digits = n.to_string();
    let mut out = String::new();
    for (at, digit) in digits.chars().enumerate() {
        if at > 0 && (digits.len() - at).is_multiple_of(3) {
            out.push(',');
        }
        out.push(digit);
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::program::{Each, Fold, FoldKind, Reg};

    fn each(body: u32) -> Instr {
        let fold = Fold { kind: FoldKind::Count, value: None, guard: None };
        Instr::Each(Box::new(Each {
            over: Over::Players { team: Reg(0), except: None },
            body,
            fold,
        }))
    }

    #[test]
    fn loops_multiply_what_stands_in_them() {
        let counts = Counts { teams: [11, 11], all: 22 };
        let mut program = Program {
            code: vec![Instr::Const(-1.0), each(2), each(1), Instr::Us, Instr::Us],
            cells: 0,
            ..Program::default()
        };
        // The constant, the outer loop, 22 inner loops, 22 · 22 bodies, and what follows.
        assert_eq!(work(&program, &counts), 1 + 23 + 22 * 23 + 22 * 22 + 1);
        program.code[0] = Instr::Const(1.0);
        assert_eq!(work(&program, &counts), 1 + 12 + 11 * 12 + 11 * 11 + 1);
    }

    #[test]
    fn totals_never_overflow() {
        let counts = Counts { teams: [u64::MAX, 0], all: u64::MAX };
        let program = Program {
            code: vec![Instr::Us, each(2), each(1), Instr::Us],
            cells: 0,
            ..Program::default()
        };
        assert_eq!(work(&program, &counts), u64::MAX);
        assert_eq!(grouped(u64::MAX), "18,446,744,073,709,551,615");
        assert_eq!(
            (grouped(0), grouped(999), grouped(1000)),
            ("0".into(), "999".into(), "1,000".into())
        );
    }
}
