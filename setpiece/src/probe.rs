//! The dry run: finds problems that only show when starts are drawn.

use crate::load::Loaded;
use setpiece_dsl::RequireOrigin;
use setpiece_dsl::problem::{Code, Cure, DryRun, Problem};
use setpiece_dsl::source::Span;
use setpiece_engine::draw::{Drawer, Roster};
use setpiece_engine::environment::{Environment, EnvironmentOptions};
use setpiece_scenario::{Bindings, Instr};
use std::time::{Duration, Instant};

/// How many starts are checked.
const DRAWS: u64 = 200;
/// The most attempts at a start for estimating how often one succeeds.
const ATTEMPTS: u32 = 10_000;
/// Below this share of successful attempts, the author gets a warning.
const SELDOM: f64 = 0.01;
/// This many successes prove that the share isn't lower.
const ENOUGH: u32 = (ATTEMPTS as f64 * SELDOM) as u32;

/// The engine's requirement on every value of a start.
const NUMBERS: &str = "every place, velocity and heading is a number";

/// A scenario's warnings, plus those of a dry run: requirements that (almost) no start meets, an
/// episode that ends before its first step.
///
/// - `budget`: how long it may take. What it hasn't found by then is left out.
pub fn probe(loaded: &Loaded, budget: Option<Duration>) -> Vec<Problem> {
    let mut problems = [&loaded.warnings[..], &loaded.unplayable].concat();
    let end = budget.map(|budget| Instant::now() + budget);
    let in_time = || end.is_none_or(|end| Instant::now() < end);
    if loaded.origin.is_none() {
        return problems;
    }
    let scenario = &loaded.scenario;
    let name = &scenario.name;
    if let Some(seldom) = requirements(loaded, &in_time) {
        let startable = seldom.code() != Code::ImpossibleToDraw;
        problems.push(seldom);
        if !startable {
            return problems;
        }
    }
    let Ok(mut environment) = Environment::new(scenario.clone(), EnvironmentOptions::default())
    else {
        return problems;
    };
    let draws = if varies(loaded) { DRAWS } else { 1 };
    let over = (0..draws).take_while(|_| in_time()).find_map(|index| {
        environment.reset(Some(0), Some(index)).ok()?;
        environment.ends_at_start().map(str::to_owned)
    });
    if let (Some(ending), Some(declared)) = (over, loaded.origin) {
        let which = scenario.endings.list.iter().position(|known| known.label == ending);
        let at = which.and_then(|which| loaded.origins.endings.get(which).copied());
        let (place, elsewhere) = place(declared, at);
        let fact = DryRun::EndsAtOnce { scenario: name.clone(), ending, elsewhere };
        problems.push(Problem::of_dry_run(place, fact));
    }
    problems
}

/// Where a problem is, and the part at fault if it stands in another file than the scenario, whose
/// name is `declared`.
fn place(declared: Span, at: Option<Span>) -> (Span, Option<Span>) {
    match at {
        Some(at) if at.file == declared.file => (at, None),
        elsewhere => (declared, elsewhere),
    }
}

/// Whether starts differ.
fn varies(loaded: &Loaded) -> bool {
    let draws = |instr: &Instr| matches!(instr, Instr::Random { .. } | Instr::EpisodeIndex);
    loaded.scenario.start.program.code.iter().any(draws)
}

/// The report about how often an attempt at a start succeeds.
fn requirements(loaded: &Loaded, in_time: &dyn Fn() -> bool) -> Option<Problem> {
    let scenario = &loaded.scenario;
    let bindings = Bindings::defaults(&scenario.params);
    let roster = Roster::new(scenario, &bindings, None).ok()?;
    let mut drawer = Drawer::new(scenario);
    let (all, enough) = if varies(loaded) { (ATTEMPTS, ENOUGH) } else { (1, 1) };
    // A tenth first: for most scenarios that already shows that starts are easy to find.
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
    let which = scenario.start.requires.iter().position(|require| require.label == hardest);
    let origin = which.and_then(|which| loaded.origins.requires.get(which));
    let cure = match (origin, hardest) {
        (Some(RequireOrigin { help: Some(help), .. }), _) => Cure::Known(help.clone()),
        (Some(_), _) => Cure::Loosen,
        (None, NUMBERS) => Cure::Divisor,
        (None, _) => Cure::Spread,
    };
    if met > 0 && found.rate() >= SELDOM {
        return None;
    }
    let at = origin.and_then(|origin| origin.span);
    let (place, elsewhere) = place(loaded.origin?, at);
    let (scenario, hardest, is_located) = (name.clone(), hardest.to_owned(), at.is_some());
    let fact = DryRun::HardToDraw { scenario, met, attempts, hardest, cure, is_located, elsewhere };
    Some(Problem::of_dry_run(place, fact))
}
