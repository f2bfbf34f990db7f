//! Bot against bot: figures of whole matches, and whether the better bot wins.

mod recorded;

use crate::figure::{Section, short};
use crate::pitch::{LabError, deviation, library, mean};
use recorded::{Give, part};
use setpiece::engine::environment::{Environment, Scratch};
use setpiece::engine::state::Match;
use setpiece::engine::state::event::Event;
use setpiece::engine::statistics::{MatchStatistics, Statistics, TeamStatistics};
use setpiece::scenario::vocabulary::{Action, EventKind, GameMode, Role};

/// Matches per pairing.
const MATCHES: u64 = 200;
/// Seeds per pair of the ladder, each played with the sides unchanged and swapped.
const LADDER: u64 = 1000;
/// The scenario of all of them.
const SCENARIO: &str = "11_vs_11_stochastic";

/// Counts of one match, as an agent sees it: after restarts.
#[derive(Clone, Debug, Default)]
pub(crate) struct Tally {
    counted: MatchStatistics,
    beside: Beside,
}

/// Counts that the engine's statistics don't have.
#[derive(Clone, Debug, Default)]
struct Beside {
    shot_m: f64,
    shot_mps: f64,
    owned: [f64; 2],
    headers: f64,
    saves: f64,
    stopped: f64,
    high: f64,
    metres: f64,
    tired: [f64; 2],
}

impl Beside {
    fn step(&mut self, game: &Match, events: &[Event]) {
        for event in events.iter().filter(|event| event.qualifier.is_none()) {
            match event.kind {
                EventKind::Shot => {
                    self.shot_m += f64::from(event.length_m);
                    self.shot_mps += f64::from(event.speed_mps);
                }
                EventKind::Header => self.headers += 1.0,
                EventKind::Save => self.saves += 1.0,
                _ => {}
            }
        }
        if let Some(id) = game.owner {
            self.owned[id.team().index()] += 1.0;
        }
        self.high += f64::from(u8::from(game.ball.pos.z > 1.0));
        self.stopped += f64::from(u8::from(game.mode != GameMode::Normal));
        for player in game.players.iter().filter(|p| p.active && p.role != Role::GK) {
            self.metres += f64::from(player.vel.length()) * 0.1 / 20.0;
        }
    }

    fn end(&mut self, game: &Match) {
        let mean = |keeper: bool| {
            let of: Vec<f64> = game
                .players
                .iter()
                .filter(|p| p.active && (p.role == Role::GK) == keeper)
                .map(|p| f64::from(p.fatigue))
                .collect();
            crate::pitch::mean(&of)
        };
        self.tired = [mean(false), mean(true)];
    }
}

impl Tally {
    /// A count of a team.
    fn team(&self, team: usize, of: fn(&TeamStatistics) -> u32) -> f64 {
        f64::from(of(&self.counted.teams[team]))
    }

    /// A count of both teams.
    fn both(&self, of: fn(&TeamStatistics) -> u32) -> f64 {
        self.team(0, of) + self.team(1, of)
    }

    /// The left team's goal difference.
    fn lead(&self) -> f64 {
        self.team(0, |team| team.goals) - self.team(1, |team| team.goals)
    }
}

/// Plays matches of two difficulties, with seeds from 0 on.
pub(crate) fn play(left: f64, right: f64, matches: u64) -> Result<Vec<Tally>, LabError> {
    let params = [("difficulty", right.to_string()), ("left_difficulty", left.to_string())];
    let prototype = library(SCENARIO, &params)?;
    let workers = crate::threads::threads() as u64;
    let mut all: Vec<(u64, Tally)> = std::thread::scope(|scope| {
        let hands: Vec<_> = (0..workers)
            .map(|worker| {
                let mut environment = prototype.clone();
                scope.spawn(move || {
                    let mut scratch = Scratch::default();
                    (worker..matches)
                        .step_by(workers as usize)
                        .map(|seed| Ok((seed, match_of(&mut environment, seed, &mut scratch)?)))
                        .collect::<Result<Vec<_>, LabError>>()
                })
            })
            .collect();
        hands
            .into_iter()
            .map(|hand| hand.join().map_err(|_| "a worker stopped".to_owned())?)
            .collect::<Result<Vec<_>, LabError>>()
    })?
    .concat();
    all.sort_by_key(|(seed, _)| *seed);
    Ok(all.into_iter().map(|(_, tally)| tally).collect())
}

fn match_of(
    environment: &mut Environment,
    seed: u64,
    scratch: &mut Scratch,
) -> Result<Tally, LabError> {
    environment.reset(Some(seed), Some(seed)).map_err(|why| why.to_string())?;
    let mut statistics = Statistics::begin(environment.state());
    let mut beside = Beside::default();
    while environment.is_running() {
        environment.step(&[Action::BuiltinAi], scratch).map_err(|why| why.to_string())?;
        statistics.observe(environment.state(), environment.events());
        beside.step(environment.state(), environment.events());
    }
    beside.end(environment.state());
    Ok(Tally { counted: statistics.summary(), beside })
}

/// Measures everything of the section.
pub(crate) fn measure(matches: Option<u64>) -> Result<Section, LabError> {
    let count = matches.unwrap_or(MATCHES);
    let mut section = Section::new(
        4,
        "Bot against bot, 11 v 11",
        format!(
            "`{SCENARIO}`, 3000 steps, {count} matches a pairing, both teams the bot's; per match, by both teams where no \
             other is named. Limits where theirs have a ±: ±25 % on counts, at least 0.25, ±0.05 on shares, ±15 % on the \
             rest, and what chance does to the two means (95 %). The others are aims for equal teams."
        ),
    );
    for level in [0.6, 1.0] {
        equal(&mut section, level, &play(level, level, count)?)?;
    }
    for (left, right, theirs) in [(1.0, 0.05, 2.8), (1.0, 0.6, 1.4), (1.0, 0.95, -0.1)] {
        let tallies = play(left, right, count)?;
        let goals: Vec<f64> = tallies.iter().map(Tally::lead).collect();
        if right == 0.05 {
            let difference = mean(&goals);
            section.within(
                "goal difference, 1.0 against 0.05",
                "+2.8",
                [2.0, f64::INFINITY],
                difference,
            );
        }
        section.notes.push(pairing(left, right, theirs, &tallies));
    }
    Ok(section)
}

/// A pairing in words.
fn pairing(left: f64, right: f64, theirs: f64, tallies: &[Tally]) -> String {
    let of = |what: &dyn Fn(&Tally) -> f64| mean(&tallies.iter().map(what).collect::<Vec<_>>());
    let won = |sign: f64| tallies.iter().filter(|t| t.lead() * sign > 0.0).count();
    format!(
        "{left} against {right}: goals {} : {} (difference {}; theirs {theirs:+}), won {} drawn {} lost {}, shots {} : {}, \
         passes {} : {}, possession {:.2}.",
        short(of(&|t| t.team(0, |team| team.goals))),
        short(of(&|t| t.team(1, |team| team.goals))),
        short(of(&Tally::lead)),
        won(1.0),
        tallies.len() - won(1.0) - won(-1.0),
        won(-1.0),
        short(of(&|t| t.team(0, |team| team.shots))),
        short(of(&|t| t.team(1, |team| team.shots))),
        short(of(&|t| t.team(0, |team| team.passes_attempted))),
        short(of(&|t| t.team(1, |team| team.passes_attempted))),
        of(&|t| t.beside.owned[0] / (t.beside.owned[0] + t.beside.owned[1])),
    )
}

/// The figures of equal teams.
fn equal(section: &mut Section, level: f64, tallies: &[Tally]) -> Result<(), LabError> {
    let of = |what: &dyn Fn(&Tally) -> f64| mean(&tallies.iter().map(what).collect::<Vec<_>>());
    let per = |part: f64, whole: f64| if whole > 0.0 { part / whole } else { f64::NAN };
    let both = |count: fn(&TeamStatistics) -> u32| of(&|t| t.both(count));
    let shots = both(|t| t.shots);
    let passes = both(|t| t.passes_attempted);
    let steps = of(&|t| f64::from(t.counted.steps));
    let share = |figure: fn(&MatchStatistics) -> f64| of(&|t| figure(&t.counted));
    let aims: [(&str, &str, [f64; 2], f64); 7] = [
        ("shots", "7", [6.0, 20.0], shots),
        ("goals per shot", ".20–.39", [0.10, 0.35], per(both(|t| t.goals), shots)),
        ("mean shot distance, m", "15.4", [12.0, 20.0], per(of(&|t| t.beside.shot_m), shots)),
        ("mean shot speed, m/s", "33", [28.0, 36.0], per(of(&|t| t.beside.shot_mps), shots)),
        ("passes", "80–95", [70.0, 160.0], passes),
        (
            "share of passes completed",
            ".70–.75",
            [0.65, 0.85],
            per(both(|t| t.passes_completed), passes),
        ),
        ("fouls", ".2", [0.0, 0.8], both(|t| t.fouls)),
    ];
    for (what, theirs, range, ours) in aims {
        section.within(format!("{what}, {level} each"), theirs, range, ours);
    }
    let spell = of(&|t| f64::from(t.counted.steps) / f64::from(t.counted.spells.max(1)));
    let counted: [(&str, &str, Give, f64); 18] = [
        ("goals", "goals", Give::Count, both(|t| t.goals)),
        ("goal kicks", "goal_kicks", Give::Count, both(|t| t.goal_kicks)),
        ("throw-ins", "throw_ins", Give::Count, both(|t| t.throw_ins)),
        ("corners", "corners", Give::Count, both(|t| t.corners)),
        ("free kicks", "free_kicks", Give::Count, both(|t| t.free_kicks)),
        ("penalties", "penalties", Give::Count, both(|t| t.penalties)),
        ("yellow cards", "yellow", Give::Count, both(|t| t.yellow_cards)),
        ("red cards", "red", Give::Count, both(|t| t.red_cards)),
        (
            "share of steps in which nobody owns the ball",
            "nobody",
            Give::Share,
            share(|t| t.nobody_owns),
        ),
        ("mean possession spell, steps", "spell", Give::Measure, spell),
        ("steps with `game_mode` ≠ 0", "stopped", Give::Measure, of(&|t| t.beside.stopped)),
        (
            "share of steps with the ball in the left third",
            "left_third",
            Give::Share,
            share(|t| t.thirds[0]),
        ),
        ("share in the middle third", "middle_third", Give::Share, share(|t| t.thirds[1])),
        ("share in the right third", "right_third", Give::Share, share(|t| t.thirds[2])),
        (
            "share of steps with the ball above 1 m",
            "high",
            Give::Share,
            per(of(&|t| t.beside.high), steps),
        ),
        ("km run per outfield player", "km", Give::Measure, of(&|t| t.beside.metres / 1000.0)),
        (
            "tiredness of outfield players at the end",
            "tired",
            Give::Measure,
            of(&|t| t.beside.tired[0]),
        ),
        (
            "tiredness of keepers at the end",
            "tired_keepers",
            Give::Measure,
            of(&|t| t.beside.tired[1]),
        ),
    ];
    let theirs = recorded::matches(level, level)?;
    for (what, name, give, ours) in counted {
        section.row(
            format!("{what}, {level} each"),
            vec![part(&theirs, name, give, ours, tallies.len())],
        );
    }
    section.notes.push(pairing(level, level, 0.0, tallies));
    section.notes.push(format!(
        "Besides, {level} each: headers {}, offsides {}, tackles {}, saves {} a match.",
        short(of(&|t| t.beside.headers)),
        short(both(|t| t.offsides)),
        short(both(|t| t.tackles)),
        short(of(&|t| t.beside.saves))
    ));
    Ok(())
}

/// The ladder of difficulties: the better against the worse, on both sides.
pub(crate) fn ladder(seeds: Option<u64>) -> Result<Section, LabError> {
    let seeds = seeds.unwrap_or(LADDER);
    let mut section = Section::new(
        7,
        "The ladder of difficulties",
        format!(
            "`{SCENARIO}`, mean goal difference of the better bot over seeds 0…{} with the sides as they are and swapped. \
             Wide steps must be above 0 by the lower end of the 95 % interval, narrow ones in the mean.",
            seeds - 1
        ),
    );
    for (better, worse, surely) in [
        (0.5, 0.05, true),
        (0.95, 0.5, true),
        (0.25, 0.05, false),
        (0.5, 0.25, false),
        (0.75, 0.5, false),
        (0.95, 0.75, false),
    ] {
        let there = play(better, worse, seeds)?;
        let back = play(worse, better, seeds)?;
        // A seed is one observation: its two matches have the same start.
        let differences: Vec<f64> =
            there.iter().zip(&back).map(|(a, b)| (a.lead() - b.lead()) * 0.5).collect();
        let middle = mean(&differences);
        let half = 1.96 * deviation(&differences) / (differences.len() as f64).sqrt();
        if surely {
            section.within(
                format!("{better} against {worse}: lower end of the interval"),
                "–",
                [f64::MIN_POSITIVE, f64::INFINITY],
                middle - half,
            );
        } else {
            section.within(
                format!("{better} against {worse}: mean"),
                "–",
                [0.0, f64::INFINITY],
                middle,
            );
        }
        section.notes.push(format!("{better} against {worse}: {middle:+.3} ± {half:.3} goals."));
    }
    Ok(section)
}
