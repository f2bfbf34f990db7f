//! Random behaviours: acts in sequence, ended by time and by conditions, chosen, repeated,
//! interrupted.

use super::{one_in, spread};
use setpiece::engine::random::Stream;
use std::fmt::Write as _;

/// What a behaviour may do; `mate` is its parameter.
const ACTS: [&str; 16] = [
    "move_to(ball)",
    "move_to(mate)",
    "move_to(them.goal)",
    "dribble_to(me + (uniform(2m, 9m), uniform(-6m, 6m)))",
    "dribble_to(them.goal)",
    "pass_to(mate)",
    "high_pass_to(mate)",
    "long_pass_to(mate)",
    "shoot",
    "tackle",
    "slide",
    "mark(mate)",
    "press",
    "hold",
    "wait for 0.5s",
    "bot",
];
/// Acts that may be done sprinting.
const RUNS: [&str; 5] = ["move_to", "dribble_to", "tackle", "mark", "press"];
/// Conditions that end or interrupt something.
const CONDITIONS: [&str; 5] = [
    "possession == them",
    "possession == us",
    "pressed(me, within: 2m)",
    "distance(me, ball) < 3m",
    "distance(me, them.goal) < 20m",
];

/// How many behaviours a scenario has.
const BEHAVIORS: u32 = 3;

/// Writes the behaviours of a scenario, `act0` and so on.
pub(super) fn behaviors(text: &mut String, random: &mut Stream) {
    for index in 0..BEHAVIORS {
        let _ = writeln!(text, "behavior act{index}(mate: player) {{");
        let again = !one_in(random, 4);
        if again {
            text.push_str("    repeat {\n");
        }
        for _ in 0..=random.below(3) {
            statement(text, random);
        }
        if again {
            text.push_str("    }\n");
        }
        if one_in(random, 3) {
            let _ = write!(text, "    interrupt when {} {{ ", condition(random));
            act(text, random);
            text.push_str("}\n");
        }
        text.push_str("}\n");
    }
}

/// A call of one of them for a player, with one of the named players.
pub(super) fn call<'a>(random: &mut Stream, names: impl Iterator<Item = &'a str>) -> String {
    let names: Vec<&str> = names.collect();
    format!("act{}({})", random.below(BEHAVIORS), names[random.below(names.len() as u32) as usize])
}

fn statement(text: &mut String, random: &mut Stream) {
    if one_in(random, 4) {
        let _ = write!(text, "        choose {{ {}: {{ ", 1 + random.below(3));
        act(text, random);
        text.push_str("} 1: { ");
        act(text, random);
        text.push_str("} }\n");
    } else {
        text.push_str("        ");
        act(text, random);
        text.push('\n');
    }
}

fn act(text: &mut String, random: &mut Stream) {
    let act = match random.below(17) {
        16 => format!("run({:.0}deg)", spread(random) * 180.0),
        other => ACTS[other as usize].to_owned(),
    };
    let _ = write!(text, "do {act}");
    if RUNS.iter().any(|run| act.starts_with(run)) && one_in(random, 2) {
        text.push_str(" sprinting");
    }
    if !act.starts_with("wait") {
        if one_in(random, 3) {
            let _ = write!(text, " until {}", condition(random));
        }
        let _ = write!(text, " for {:.1}s", 0.2 + random.unit() * 4.0);
    }
    text.push(' ');
}

fn condition(random: &mut Stream) -> &'static str {
    CONDITIONS[random.below(5) as usize]
}
