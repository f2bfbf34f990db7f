//! The dry run: what can be found only by drawing starts and looking at them.

use crate::load::Loaded;
use setpiece_dsl::problem::{Code, Problem};
use setpiece_engine::draw::{Drawer, Roster};
use setpiece_engine::environment::{Environment, EnvironmentOptions};
use setpiece_scenario::{Bindings, Instr};
use std::time::{Duration, Instant};

/// How many starts are looked at.
const DRAWS: u64 = 200;
/// How many attempts at a start are made to learn how often one succeeds.
const ATTEMPTS: u32 = 10_000;
/// Below this share of attempts that succeed, the author is warned.
const SELDOM: f64 = 0.01;
/// So many successes say that it is no less.
const ENOUGH: u32 = (ATTEMPTS as f64 * SELDOM) as u32;

/// The warnings of a scenario and what a dry run adds to them: requirements that (almost) no start meets, an episode
/// that is over before its first step.
///
/// - `budget`: how long it may take; what it has not found by then it leaves out.
pub fn probe(loaded: &Loaded, budget: Option<Duration>) -> Vec<Problem> {
    let mut problems = loaded.warnings.clone();
    let end = budget.map(|budget| Instant::now() + budget);
    let in_time = || end.is_none_or(|end| Instant::now() < end);
    let Some(place) = loaded.origin else { return problems };
    let scenario = &loaded.scenario;
    let name = &scenario.name;
    if let Some(seldom) = requirements(loaded, &in_time) {
        let startable = seldom.code != Code::ImpossibleToDraw;
        problems.push(seldom);
        if !startable {
            return problems;
        }
    }
    let Ok(mut environment) = Environment::new(scenario.clone(), EnvironmentOptions::default()) else {
        return problems;
    };
    let draws = if varies(loaded) { DRAWS } else { 1 };
    let over = (0..draws).take_while(|_| in_time()).find_map(|index| {
        environment.reset(Some(0), Some(index)).ok()?;
        environment.ends_at_start().map(str::to_owned)
    });
    if let Some(label) = over {
        problems.push(
            Problem::new(Code::EndsAtOnce, place, format!("`{name}` is over before its first step"), "here")
                .help(format!("the ending `{label}` holds at the start")),
        );
    }
    problems
}

/// Whether one start differs from another.
fn varies(loaded: &Loaded) -> bool {
    let draws = |instr: &Instr| matches!(instr, Instr::Random { .. } | Instr::EpisodeIndex);
    loaded.scenario.start.program.code.iter().any(draws)
}

/// What is to be said of how often an attempt at a start succeeds.
fn requirements(loaded: &Loaded, in_time: &dyn Fn() -> bool) -> Option<Problem> {
    let (scenario, place) = (&loaded.scenario, loaded.origin?);
    let bindings = Bindings::defaults(&scenario.params);
    let roster = Roster::new(scenario, &bindings, None).ok()?;
    let mut drawer = Drawer::new(scenario);
    let (all, enough) = if varies(loaded) { (ATTEMPTS, ENOUGH) } else { (1, 1) };
    // A tenth first: most scenarios are known to be easy by then.
    let mut found = drawer.acceptance(scenario, &bindings, &roster, all.div_ceil(10), enough);
    if found.met < enough && all > 1 {
        if !in_time() {
            return None;
        }
        found = drawer.acceptance(scenario, &bindings, &roster, all, enough);
    }
    let name = &scenario.name;
    let (met, attempts) = (found.met, found.attempts);
    let hardest = found.hardest.as_deref()?;
    if met == 0 {
        return Some(
            Problem::new(
                Code::ImpossibleToDraw,
                place,
                format!("`{name}` can't be started"),
                match attempts {
                    1 => "its start doesn't meet its requirements".to_owned(),
                    _ => format!("none of {attempts} starts meets its requirements"),
                },
            )
            .help(format!("`{hardest}` fails most often: loosen it, or place the players so that it holds")),
        );
    }
    (found.rate() < SELDOM).then(|| {
        Problem::new(
            Code::HardToDraw,
            place,
            format!("`{name}` is seldom drawn"),
            format!("{met} of {attempts} starts meet its requirements"),
        )
        .help(format!("`{hardest}` fails most often: loosen it, or place the players so that it holds"))
    })
}
