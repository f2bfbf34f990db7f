//! The dry run: what can be found only by drawing starts and looking at them.

use crate::load::Loaded;
use setpiece_dsl::problem::{Code, Problem};
use setpiece_engine::environment::{Environment, EnvironmentOptions};
use setpiece_scenario::Instr;

/// How many starts are drawn.
const DRAWS: u64 = 200;

/// The warnings of a scenario and what a dry run adds to them: requirements that no start meets, an episode that is over
/// before its first step.
pub fn probe(loaded: &Loaded) -> Vec<Problem> {
    let mut problems = loaded.warnings.clone();
    let Some(place) = loaded.origin else { return problems };
    let Ok(mut environment) = Environment::new(loaded.scenario.clone(), EnvironmentOptions::default()) else {
        return problems;
    };
    let name = &loaded.scenario.name;
    let draws = |instr: &Instr| matches!(instr, Instr::Random { .. } | Instr::EpisodeIndex);
    let varies = loaded.scenario.start.program.code.iter().any(draws);
    let mut failed = 0;
    let mut requirement = String::new();
    let mut over = None;
    for index in 0..DRAWS {
        match environment.reset(Some(0), Some(index)) {
            Ok(()) => over = over.or_else(|| environment.ends_at_start().map(str::to_owned)),
            Err(error) => {
                failed += 1;
                requirement = error.requirement;
            }
        }
        // Nothing more can be learned of a start that never changes.
        if failed > 2 || !varies {
            break;
        }
    }
    if failed > 2 || (failed > 0 && !varies) {
        problems.push(
            Problem::new(
                Code::ImpossibleToDraw,
                place,
                format!("`{name}` can't be started"),
                "no start meets its requirements",
            )
            .help(format!("`{requirement}` fails most often: loosen it, or place the players so that it holds")),
        );
    }
    if let Some(label) = over {
        problems.push(
            Problem::new(Code::EndsAtOnce, place, format!("`{name}` is over before its first step"), "here")
                .help(format!("the ending `{label}` holds at the start")),
        );
    }
    problems
}
