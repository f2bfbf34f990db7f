//! Random scenarios: teams of any size anywhere on pitches of any size, every rule, every start,
//! agents of every kind.

mod script;

use setpiece::engine::random::Stream;
use setpiece::scenario::vocabulary::Stat;
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
    "anti_stalling",
    "grf_keeper",
    "six_seconds",
];
const STARTS: [&str; 9] =
    ["open", "open", "open", "kickoff", "corner", "free_kick", "throw_in", "goal_kick", "penalty"];
const SIDES: [&str; 2] = ["left", "right"];

/// A player of a scenario.
struct Footballer {
    name: String,
    role: &'static str,
    /// Normalised.
    place: (f32, f32),
    controllable: bool,
}

/// The pitch of a scenario.
struct SoakPitch {
    /// Its length as a multiple of the usual pitch's.
    along: f32,
    /// Its width as a multiple of the usual pitch's.
    across: f32,
    /// What sets it; empty for the usual one.
    text: String,
}

impl SoakPitch {
    /// Mostly the usual pitch.
    fn any(random: &mut Stream) -> SoakPitch {
        if !one_in(random, 4) {
            return SoakPitch { along: 1.0, across: 1.0, text: String::new() };
        }
        let mut from = |low: u32, high: u32| low + random.below(high + 1 - low);
        // Includes both ends of each range.
        let (length, width, goal) = (from(20, 120), from(15, 90), from(1, 10));
        let mut text = format!("    pitch {{ length: {length}m  width: {width}m");
        if one_in(random, 2) {
            let _ = write!(text, "  goal: {goal}m  goal_height: {:.1}m", 1.0 + 2.0 * random.unit());
        }
        if one_in(random, 3) {
            let deep = 2.0 + random.unit() * (0.5 * length as f32 - 2.0).min(38.0);
            let wide = 4.0 + random.unit() * (width as f32 - 4.0);
            // Downwards, so that it fits.
            let [deep, wide] = [deep, wide].map(|metres| (10.0 * metres).floor() / 10.0);
            let _ = write!(text, "  box: {deep:.1}m  box_width: {wide:.1}m");
        }
        text.push_str(" }\n");
        SoakPitch { along: length as f32 / 110.0, across: width as f32 / 72.0, text }
    }

    /// A normalised place of the usual pitch in proportion on this one.
    fn place(&self, (x, y): (f32, f32)) -> (f32, f32) {
        (x * self.along, y * self.across)
    }
}

/// A scenario's text.
pub(super) fn scenario(random: &mut Stream, limit: u32) -> String {
    let mut text = String::new();
    let behaviors = one_in(random, 2);
    if behaviors {
        script::behaviors(&mut text, random);
    }
    if one_in(random, 8) {
        kicked_off(&mut text, random, limit);
        return text;
    }
    let ground = SoakPitch::any(random);
    let sizes = [size(random, 1), size(random, 0)];
    let teams = [0, 1].map(|team| footballers(random, &ground, team, sizes[team]));
    text.push_str("scenario soak {\n");
    text.push_str(&ground.text);
    rules(&mut text, random);
    start(&mut text, random, &ground, &teams);
    agents(&mut text, random, &teams);
    for (side, team) in SIDES.into_iter().zip(&teams) {
        let _ = writeln!(text, "    team {side} {{\n        difficulty: {:.2}", random.unit());
        for footballer in team {
            player(&mut text, random, footballer, &teams, behaviors);
        }
        text.push_str("    }\n");
    }
    let _ = writeln!(text, "    end limit {limit} steps\n}}");
    text
}

/// True once in `n` times.
fn one_in(random: &mut Stream, n: u32) -> bool {
    random.below(n) == 0
}

/// From -1 to 1.
fn spread(random: &mut Stream) -> f32 {
    random.unit() * 2.0 - 1.0
}

/// The size of a team; often small.
fn size(random: &mut Stream, least: u32) -> u32 {
    if one_in(random, 3) { least + random.below(3) } else { least + random.below(12 - least) }
}

fn footballers(random: &mut Stream, ground: &SoakPitch, team: usize, size: u32) -> Vec<Footballer> {
    let keeper = !one_in(random, 4);
    let side = if team == 0 { -1.0 } else { 1.0 };
    let footballer = |index| {
        let role = if index == 0 && keeper { "GK" } else { ROLES[random.below(9) as usize] };
        let at_home = role == "GK" && !one_in(random, 6);
        let place = if at_home { (side, 0.0) } else { (spread(random), spread(random) * 0.42) };
        let place = ground.place(place);
        Footballer {
            name: format!("{}{index}", &SIDES[team][..1]),
            role,
            place,
            controllable: !one_in(random, 12),
        }
    };
    (0..size).map(footballer).collect()
}

fn rules(text: &mut String, random: &mut Stream) {
    text.push_str("    rules {");
    for rule in SWITCHES {
        // Mostly the default.
        if one_in(random, 4) {
            let _ = write!(text, " {rule}: {}", if one_in(random, 2) { "on" } else { "off" });
        }
    }
    if one_in(random, 4) {
        let _ = write!(text, " half_time: {} steps", 50 + random.below(300));
    }
    if one_in(random, 10) {
        text.push_str(" physics: full");
    }
    text.push_str(" }\n");
}

fn start(text: &mut String, random: &mut Stream, ground: &SoakPitch, teams: &[Vec<Footballer>; 2]) {
    let kind = STARTS[random.below(9) as usize];
    let team = usize::from(!teams[1].is_empty() && one_in(random, 2));
    let whose = matches!(kind, "corner" | "goal_kick" | "penalty")
        || (kind != "open" && !one_in(random, 4));
    let whose = if whose { format!(" for {}", SIDES[team]) } else { String::new() };
    let late = if one_in(random, 4) {
        let (left, right, elapsed) = (random.below(4), random.below(4), random.below(200));
        format!(" {{ score: [{left}, {right}]  elapsed: {elapsed} steps }}")
    } else {
        String::new()
    };
    let _ = writeln!(text, "    start {kind}{whose}{late}");
    match kind {
        "open" => ball(text, random, ground, teams),
        "free_kick" | "throw_in" => {
            let (x, y) = (spread(random) * 0.9, spread(random) * 0.4);
            let y = if kind == "throw_in" { 0.42_f32.copysign(y) } else { y };
            let (x, y) = ground.place((x, y));
            let _ = writeln!(text, "    ball at ({x:.4}, {y:.4})");
        }
        _ => {}
    }
}

fn ball(text: &mut String, random: &mut Stream, ground: &SoakPitch, teams: &[Vec<Footballer>; 2]) {
    let owner = teams
        .iter()
        .flatten()
        .filter(|footballer| footballer.place.0.abs() < 0.85 * ground.along)
        .nth(random.below(22) as usize);
    if let Some(footballer) = owner {
        let _ = writeln!(
            text,
            "    ball at {} + ({:.2}m, 0m) {{ owner: {} }}",
            footballer.name,
            spread(random),
            footballer.name
        );
        return;
    }
    let (x, y) = ground.place((spread(random), spread(random) * 0.42));
    let _ = write!(text, "    ball at ({x:.3}, {y:.3})");
    if one_in(random, 2) {
        let mut speed = |most: f32| format!("{:.1}m/s", spread(random) * most);
        let (vx, vy, vz) = (speed(35.0), speed(35.0), speed(9.0));
        let _ =
            write!(text, " {{ velocity: ({vx}, {vy}, {vz})  height: {:.2}m", random.unit() * 6.0);
        if one_in(random, 3) {
            let mut spin = || (spread(random) * 100.0).round();
            let _ = write!(text, "  spin: ({}, {}, {})", spin(), spin(), spin());
        }
        text.push_str(" }");
    }
    text.push('\n');
}

fn agents(text: &mut String, random: &mut Stream, teams: &[Vec<Footballer>; 2]) {
    text.push_str("    agents {");
    for (side, team) in SIDES.into_iter().zip(teams) {
        let free: Vec<&Footballer> =
            team.iter().filter(|footballer| footballer.controllable).collect();
        let count = match random.below(5) {
            _ if free.is_empty() => "0".to_owned(),
            0 => "all".to_owned(),
            1 => "0".to_owned(),
            2 => {
                let named: Vec<&str> = free
                    .iter()
                    .filter(|_| one_in(random, 2))
                    .map(|footballer| footballer.name.as_str())
                    .collect();
                if named.is_empty() { "1".to_owned() } else { format!("[{}]", named.join(", ")) }
            }
            _ => random.below(free.len() as u32 + 1).to_string(),
        };
        let _ = write!(text, " {side}: {count},");
    }
    manners(text, random);
}

/// What agents' teammates do, and whether agents switch players.
fn manners(text: &mut String, random: &mut Stream) {
    let others = if one_in(random, 3) { "hold" } else { "bot" };
    let switching = if one_in(random, 4) { ", switching: fixed" } else { "" };
    let _ = writeln!(text, " others: {others}{switching} }}");
}

fn player(
    text: &mut String,
    random: &mut Stream,
    footballer: &Footballer,
    teams: &[Vec<Footballer>; 2],
    behaviors: bool,
) {
    let ai = match random.below(if behaviors { 10 } else { 6 }) {
        0 => "hold".to_owned(),
        1 => "lazy".to_owned(),
        2..6 => "bot".to_owned(),
        _ => {
            script::call(random, teams.iter().flatten().map(|footballer| footballer.name.as_str()))
        }
    };
    let _ = write!(
        text,
        "        {}: {} at ({:.3}, {:.3})",
        footballer.name, footballer.role, footballer.place.0, footballer.place.1
    );
    if one_in(random, 8) {
        let _ = write!(text, " facing {:.0}deg", spread(random) * 180.0);
    }
    let _ = write!(text, " {{ ai: {ai}  overlap: allowed");
    if !footballer.controllable {
        text.push_str("  controllable: off");
    }
    if one_in(random, 6) {
        // Includes both ends of the range.
        let _ = write!(text, "  fatigue: {:.2}", (random.unit() * 1.4 - 0.2).clamp(0.0, 1.0));
    }
    if one_in(random, 8) {
        text.push_str("  yellow_cards: 1");
    }
    if one_in(random, 10) {
        let _ = write!(
            text,
            "  velocity: ({:.1}m/s, {:.1}m/s)",
            spread(random) * 7.0,
            spread(random) * 7.0
        );
    }
    if one_in(random, 5) {
        let stats: Vec<String> = Stat::ALL
            .iter()
            .map(|stat| (stat.name(), random.unit() * 4.2 - 0.6))
            .filter(|(_, value)| *value < 1.6)
            .map(|(name, value)| format!("{name}: {:.2}", value.clamp(0.0, 1.0)))
            .collect();
        if !stats.is_empty() {
            let _ = write!(text, "  stats: {{ {} }}", stats.join(", "));
        }
    }
    text.push_str(" }\n");
}

/// A scenario with the teams of a kick-off, with its own formations.
fn kicked_off(text: &mut String, random: &mut Stream, limit: u32) {
    let ground = SoakPitch::any(random);
    let size = size(random, 1);
    let keeper = !one_in(random, 4);
    let roles: Vec<&str> = (0..size)
        .map(|index| if index == 0 && keeper { "GK" } else { ROLES[random.below(9) as usize] })
        .collect();
    for name in ["kicking", "receiving"] {
        let _ = writeln!(text, "formation {name} {{");
        for role in &roles {
            let place =
                if *role == "GK" { (-1.0, 0.0) } else { (-random.unit(), spread(random) * 0.42) };
            let place = ground.place(place);
            let _ = writeln!(text, "    {role} at ({:.3}, {:.3})", place.0, place.1);
        }
        text.push_str("}\n");
    }
    text.push_str("scenario soak {\n");
    text.push_str(&ground.text);
    rules(text, random);
    let whose = ["left", "right", "alternate(left, right)", "choice(left, right)"]
        [random.below(4) as usize];
    let _ = writeln!(text, "    kickoff {whose} {{ kicking: kicking, receiving: receiving }}");
    let mut count =
        || if one_in(random, 3) { "all".to_owned() } else { random.below(size + 1).to_string() };
    let _ = write!(text, "    agents {{ left: {}, right: {},", count(), count());
    manners(text, random);
    for side in SIDES {
        let _ = writeln!(
            text,
            "    team {side} {{ difficulty: {:.2}  each all {{ overlap: allowed }} }}",
            random.unit()
        );
    }
    let _ = writeln!(text, "    end limit {limit} steps\n}}");
}
