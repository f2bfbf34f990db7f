//! Writes what a script sets as a text.

use super::kickoff::GrfKickoff;
use super::player::{crowded, either, observed, options, shape};
use super::recorded::{FIXED_SEED, GrfPlayer, GrfScenario, LIMIT_MAX};
use crate::dsl::format::{WIDTH, format};
use crate::dsl::source::Source;
use crate::scenario::vocabulary::Team;

/// What a text can't express.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum TranslationError {
    /// A setting takes turns.
    #[error("`{name}` is {even} in even and {odd} in odd episodes; a text can't express that")]
    Setting {
        /// GRF's name of the setting.
        name: &'static str,
        /// Its value in even episodes, as Python writes it.
        even: String,
        /// Its value in odd episodes.
        odd: String,
    },
    /// Players take turns, not only their places.
    #[error(
        "the {} team has other players in odd than in even episodes; \
         a text can only alternate places", .0.name()
    )]
    Players(Team),
}

impl TranslationError {
    /// What to do instead.
    pub fn help(&self) -> &'static str {
        match self {
            TranslationError::Setting { .. } => "write two scenarios, one for each",
            TranslationError::Players(_) => {
                "the same number of players, roles, `lazy` and `controllable` in every episode, \
                 or two scenarios"
            }
        }
    }
}

/// A valid name: that of a level, or of a path without folder and ending.
pub fn identifier(name: &str) -> String {
    let stem = name.rsplit(['/', '\\']).next().unwrap_or_default();
    let stem = stem.strip_suffix(".py").unwrap_or(stem);
    if stem.is_empty() {
        return "scenario".to_owned();
    }
    let is_word = |sign: char| sign.is_ascii_alphanumeric() || sign == '_';
    stem.chars().map(|sign| if is_word(sign) { sign } else { '_' }).collect()
}

/// The text of a recorded scenario, in the layout of `setpiece fmt`; it compiles if a scenario may
/// be so.
///
/// - `even`: what the script sets in even episodes, so in the first one.
/// - `odd`: what it sets in odd episodes.
/// - `name`: the name of the scenario.
///
/// # Errors
/// The two differ in more than `kickoff alternate(…)` or a number `alternate(…, …)` can express.
pub fn to_pitch(
    even: &GrfScenario,
    odd: &GrfScenario,
    name: &str,
) -> Result<String, TranslationError> {
    let kickoff = GrfKickoff::of(even, odd);
    check_same(even, odd, kickoff.is_some())?;
    // A scenario's name may begin with a digit, a formation's can't.
    let begins_with_digit = name.starts_with(|sign: char| sign.is_ascii_digit());
    let stem = if begins_with_digit { format!("_{name}") } else { name.to_owned() };
    let mut opening = vec![rules(even)];
    opening.extend(agents(even));
    if let Some(kickoff) = &kickoff {
        opening.extend(["    ball at centre".to_owned(), kickoff.statement(&stem)]);
    } else {
        let at = |axis: usize| either(even.ball_position[axis], odd.ball_position[axis]);
        opening.push(format!("    ball at ({}, {})", at(0), at(1)));
    }
    let mut blocks = vec![opening];
    for &team in Team::ALL {
        let level = either(even.difficulty(team), odd.difficulty(team));
        let players = if kickoff.is_some() { Vec::new() } else { players(even, odd, team) };
        if players.is_empty() {
            blocks.push(vec![format!("    team {} {{ difficulty: {level} }}", team.name())]);
        } else {
            let mut block = vec![format!("    team {} {{", team.name())];
            block.push(format!("        difficulty: {level}"));
            block.extend(players);
            block.push("    }".to_owned());
            blocks.push(block);
        }
    }
    blocks.push(vec!["    reward scoring".to_owned()]);
    blocks.push(endings(even));
    let body: Vec<String> = blocks.iter().map(|block| block.join("\n")).collect();
    let mut lines = kickoff.map_or_else(Vec::new, |it| it.formations(name, &stem));
    lines.extend([
        format!("/// {name}, as a script of Google Research Football has it."),
        format!("scenario {name} {{"),
        body.join("\n\n"),
        "}\n".to_owned(),
    ]);
    Ok(laid_out(lines.join("\n")))
}

/// A text in the layout of `setpiece fmt`; only long lines can differ from it.
fn laid_out(text: String) -> String {
    if text.lines().all(|line| line.chars().count() <= WIDTH) {
        return text;
    }
    let source = Source { name: String::new(), text: text.as_str().into() };
    format(&source).unwrap_or(text)
}

fn rules(recorded: &GrfScenario) -> String {
    let mut rules = Vec::new();
    if !recorded.offsides {
        rules.push("offside: off".to_owned());
    }
    rules.push("kickoff_circle: off".to_owned());
    if !recorded.use_magnet {
        rules.push("assist: off".to_owned());
    }
    if recorded.deterministic && recorded.game_engine_random_seed == FIXED_SEED {
        rules.push("stochastic: off".to_owned());
    }
    if recorded.second_half < recorded.game_duration.min(LIMIT_MAX) {
        rules.push(format!("half_time: {} steps", recorded.second_half));
    }
    format!("    rules {{ {} }}", rules.join(", "))
}

fn agents(recorded: &GrfScenario) -> Option<String> {
    let count = if recorded.control_all_players {
        "all"
    } else if recorded.left_team.iter().any(|player| player.controllable) {
        return None;
    } else {
        "0"
    };
    Some(format!("    agents {{ left: {count} }}"))
}

fn endings(recorded: &GrfScenario) -> Vec<String> {
    let mut endings = Vec::new();
    if recorded.end_episode_on_score {
        endings.push("    end success scored when goal by left".to_owned());
        endings.push("    end failure conceded when goal by right".to_owned());
    }
    if recorded.end_episode_on_out_of_play {
        endings.push("    end out when out_of_play or ball_dead".to_owned());
    }
    if recorded.end_episode_on_possession_change {
        endings.push("    end possession when possession changes".to_owned());
    }
    let steps = recorded.game_duration;
    endings.push(if steps <= LIMIT_MAX {
        format!("    end limit {steps} steps")
    } else {
        format!("    // Its game_duration of {steps} steps is more than a limit can be: none.")
    });
    endings
}

fn players(even: &GrfScenario, odd: &GrfScenario, team: Team) -> Vec<String> {
    let frame = if team == Team::Left { "" } else { "own " };
    let crowded = &crowded(even, team) | &crowded(odd, team);
    let pairs = even.team(team).iter().zip(odd.team(team));
    let line = |(index, (player, twin)): (usize, (&GrfPlayer, &GrfPlayer))| {
        let (here, there) = (observed(player), observed(twin));
        let (x, y) = (either(here[0], there[0]), either(here[1], there[1]));
        let options = options(player, crowded.contains(&index));
        format!("        {} at {frame}({x}, {y}){options}", player.role.name())
    };
    pairs.enumerate().map(line).collect()
}

/// Whether two episodes differ only in what a text can alternate.
fn check_same(
    even: &GrfScenario,
    odd: &GrfScenario,
    is_kickoff: bool,
) -> Result<(), TranslationError> {
    for ((name, here), (_, there)) in even.fixed().into_iter().zip(odd.fixed()) {
        if here != there {
            let (even, odd) = (here.to_string(), there.to_string());
            return Err(TranslationError::Setting { name, even, odd });
        }
    }
    let differs =
        |team: &&Team| !even.team(**team).iter().map(shape).eq(odd.team(**team).iter().map(shape));
    match Team::ALL.iter().find(differs) {
        Some(team) if !is_kickoff => Err(TranslationError::Players(*team)),
        _ => Ok(()),
    }
}
