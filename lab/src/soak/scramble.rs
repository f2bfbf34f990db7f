//! Scenarios made up at random: teams of any size anywhere, every rule, every start, agents of every kind.

use setpiece::engine::random::Stream;
use std::fmt::Write as _;

const ROLES: [&str; 9] = ["CB", "LB", "RB", "DM", "CM", "LM", "RM", "AM", "CF"];
const SWITCHES: [&str; 13] = [
    "offside",
    "fouls",
    "cards",
    "penalties",
    "handball",
    "kickoff_circle",
    "back_pass",
    "fatigue",
    "stochastic",
    "assist",
    "grf_keeper",
    "six_seconds",
    "anti_stalling",
];
const AIS: [&str; 6] = ["bot", "bot", "bot", "bot", "hold", "lazy"];

/// A scenario's text.
pub(super) fn scenario(random: &mut Stream, limit: u32) -> String {
    let mut text = String::from("scenario soak {\n    rules {");
    for rule in SWITCHES {
        // Mostly as it is by default; never without the rule that a run is held to.
        if rule != "anti_stalling" && random.below(4) == 0 {
            let _ = write!(text, " {rule}: {}", if random.below(2) == 0 { "on" } else { "off" });
        }
    }
    if random.below(6) == 0 {
        let _ = write!(text, " half_time: {} steps", 50 + random.below(300));
    }
    if random.below(10) == 0 {
        text.push_str(" physics: full");
    }
    text.push_str(" }\n");
    let sizes = [1 + random.below(11), random.below(12)];
    let kind = ["open", "open", "corner", "free_kick", "throw_in", "goal_kick", "penalty"][random.below(7) as usize];
    let team = if sizes[1] > 0 && random.below(2) == 0 { "right" } else { "left" };
    if kind == "open" {
        ball(&mut text, random);
    } else {
        let _ = writeln!(text, "    start {kind} for {team}");
        if kind == "free_kick" || kind == "throw_in" {
            let _ = writeln!(text, "    ball at ({:.3}, {:.3})", spread(random) * 0.9, spread(random) * 0.4);
        }
    }
    let agents = |random: &mut Stream, size: u32| match random.below(4) {
        0 => "all".to_owned(),
        1 => "0".to_owned(),
        _ => random.below(size + 1).to_string(),
    };
    let left = agents(random, sizes[0]);
    let right = if sizes[1] == 0 { "0".to_owned() } else { agents(random, sizes[1]) };
    let others = if random.below(3) == 0 { "hold" } else { "bot" };
    let _ = writeln!(text, "    agents {{ left: {left}, right: {right}, others: {others} }}");
    for (side, size) in ["left", "right"].into_iter().zip(sizes) {
        let _ = writeln!(text, "    team {side} {{\n        difficulty: {:.2}", random.unit());
        for index in 0..size {
            player(&mut text, random, index);
        }
        text.push_str("    }\n");
    }
    let _ = writeln!(text, "    end limit {limit} steps\n}}");
    text
}

/// From -1 to 1.
fn spread(random: &mut Stream) -> f32 {
    random.unit() * 2.0 - 1.0
}

fn ball(text: &mut String, random: &mut Stream) {
    let (x, y) = (spread(random), spread(random) * 0.42);
    let _ = write!(text, "    ball at ({x:.3}, {y:.3})");
    if random.below(2) == 0 {
        let (vx, vy, height) = (spread(random) * 35.0, spread(random) * 35.0, random.unit() * 6.0);
        let _ = write!(text, " {{ velocity: ({vx:.1}m/s, {vy:.1}m/s)  height: {height:.2}m }}");
    }
    text.push('\n');
}

fn player(text: &mut String, random: &mut Stream, index: u32) {
    let role = if index == 0 && random.below(8) > 0 { "GK" } else { ROLES[random.below(9) as usize] };
    let (x, y) = if role == "GK" { (-1.0, 0.0) } else { (spread(random), spread(random) * 0.42) };
    let ai = AIS[random.below(6) as usize];
    let _ = write!(text, "        {role} at ({x:.3}, {y:.3}) {{ ai: {ai}  overlap: allowed");
    if random.below(6) == 0 {
        let _ = write!(text, "  fatigue: {:.2}", random.unit());
    }
    if random.below(12) == 0 {
        text.push_str("  yellow_cards: 1");
    }
    text.push_str(" }\n");
}
