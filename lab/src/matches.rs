//! Bot against bot: what whole matches look like, and whether the better bot wins.

use crate::figure::{Section, short};
use crate::pitch::{Failure, deviation, library, mean};
use setpiece::engine::environment::{Environment, Scratch};
use setpiece::engine::event::Event;
use setpiece::engine::state::Match;
use setpiece::scenario::vocabulary::{Action, EventKind, GameMode, Qualifier, Role, Team};

/// Matches of every pairing.
const MATCHES: u64 = 200;
/// Seeds of every pair of the ladder, each played with the sides as they are and swapped.
const LADDER: u64 = 1000;
/// The scenario of all of them.
const SCENARIO: &str = "11_vs_11_stochastic";

/// What is counted of one match.
#[derive(Clone, Debug, Default)]
pub(crate) struct Tally {
    steps: f64,
    goals: [f64; 2],
    shots: [f64; 2],
    shot_m: f64,
    shot_mps: f64,
    passes: [f64; 2],
    completed: [f64; 2],
    owned: [f64; 2],
    spells: f64,
    possession: Option<Team>,
    counts: [f64; COUNTED.len()],
    stopped: f64,
    thirds: [f64; 3],
    high: f64,
    metres: f64,
    tired: [f64; 2],
}

/// What is counted besides, by both teams.
const COUNTED: [EventKind; 12] = [
    EventKind::GoalKick,
    EventKind::ThrowIn,
    EventKind::Corner,
    EventKind::FreeKick,
    EventKind::Penalty,
    EventKind::Foul,
    EventKind::YellowCard,
    EventKind::RedCard,
    EventKind::Header,
    EventKind::Offside,
    EventKind::Tackle,
    EventKind::Save,
];

impl Tally {
    fn step(&mut self, game: &Match, events: &[Event]) {
        self.steps += 1.0;
        for event in events {
            self.count(event);
        }
        if let Some(id) = game.owner {
            self.owned[id.team().index()] += 1.0;
        }
        if game.possession.is_some() && game.possession != self.possession {
            self.spells += 1.0;
            self.possession = game.possession;
        }
        let ball = game.ball.pos;
        self.thirds[usize::from(ball.x > -55.0 / 3.0) + usize::from(ball.x > 55.0 / 3.0)] += 1.0;
        self.high += f64::from(u8::from(ball.z > 1.0));
        self.stopped += f64::from(u8::from(game.mode != GameMode::Normal));
        for player in game.players.iter().filter(|p| p.active && p.role != Role::GK) {
            self.metres += f64::from(player.vel.length()) * 0.1 / 20.0;
        }
    }

    fn count(&mut self, event: &Event) {
        if let Some(place) = COUNTED.iter().position(|kind| *kind == event.kind && event.qualifier.is_none()) {
            self.counts[place] += 1.0;
        }
        let Some(team) = event.team.map(Team::index) else { return };
        match (event.kind, event.qualifier) {
            (EventKind::Goal, _) => self.goals[team] += 1.0,
            (EventKind::Shot, None) => {
                self.shots[team] += 1.0;
                self.shot_m += f64::from(event.length_m);
                self.shot_mps += f64::from(event.speed_mps);
            }
            (EventKind::Pass, Some(Qualifier::Attempted)) => self.passes[team] += 1.0,
            (EventKind::Pass, Some(Qualifier::Completed)) => self.completed[team] += 1.0,
            _ => {}
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

    fn of(&self, kind: EventKind) -> f64 {
        COUNTED.iter().position(|known| *known == kind).map_or(f64::NAN, |place| self.counts[place])
    }
}

/// Plays matches of two difficulties, seeds from 0 on.
pub(crate) fn play(left: f64, right: f64, matches: u64) -> Result<Vec<Tally>, Failure> {
    let params = [("difficulty", right.to_string()), ("left_difficulty", left.to_string())];
    let prototype = library(SCENARIO, &params)?;
    let workers = crate::threads() as u64;
    let mut all: Vec<(u64, Tally)> = std::thread::scope(|scope| {
        let hands: Vec<_> = (0..workers)
            .map(|worker| {
                let mut environment = prototype.clone();
                scope.spawn(move || {
                    let mut scratch = Scratch::default();
                    (worker..matches)
                        .step_by(workers as usize)
                        .map(|seed| Ok((seed, match_of(&mut environment, seed, &mut scratch)?)))
                        .collect::<Result<Vec<_>, Failure>>()
                })
            })
            .collect();
        hands
            .into_iter()
            .map(|hand| hand.join().map_err(|_| "a worker stopped".to_owned())?)
            .collect::<Result<Vec<_>, Failure>>()
    })?
    .concat();
    all.sort_by_key(|(seed, _)| *seed);
    Ok(all.into_iter().map(|(_, tally)| tally).collect())
}

fn match_of(environment: &mut Environment, seed: u64, scratch: &mut Scratch) -> Result<Tally, Failure> {
    environment.reset(Some(seed), Some(seed)).map_err(|why| why.to_string())?;
    let mut tally = Tally::default();
    while environment.is_running() {
        environment.step(&[Action::BuiltinAi], scratch).map_err(|why| why.to_string())?;
        tally.step(environment.state(), environment.events());
    }
    tally.end(environment.state());
    Ok(tally)
}

/// Measures everything of the section.
pub(crate) fn measure(matches: Option<u64>) -> Result<Section, Failure> {
    let count = matches.unwrap_or(MATCHES);
    let mut section = Section::new(
        4,
        "Bot against bot, 11 v 11",
        format!(
            "`{SCENARIO}`, 3000 steps, {count} matches a pairing, both teams the bot's; per match, by both teams where no \
             other is named. The aims are those of equal teams."
        ),
    );
    for level in [0.6, 1.0] {
        equal(&mut section, level, &play(level, level, count)?);
    }
    for (left, right, theirs) in [(1.0, 0.05, 2.8), (1.0, 0.6, 1.4), (1.0, 0.95, -0.1)] {
        let tallies = play(left, right, count)?;
        let goals: Vec<f64> = tallies.iter().map(|tally| tally.goals[0] - tally.goals[1]).collect();
        if right == 0.05 {
            let difference = mean(&goals);
            section.within("goal difference, 1.0 against 0.05", "+2.8", [2.0, f64::INFINITY], difference);
        }
        section.told.push(pairing(left, right, theirs, &tallies));
    }
    Ok(section)
}

/// A pairing in words.
fn pairing(left: f64, right: f64, theirs: f64, tallies: &[Tally]) -> String {
    let of = |what: &dyn Fn(&Tally) -> f64| mean(&tallies.iter().map(what).collect::<Vec<_>>());
    let won = |sign: f64| tallies.iter().filter(|t| (t.goals[0] - t.goals[1]) * sign > 0.0).count();
    format!(
        "{left} against {right}: goals {} : {} (difference {}; theirs {theirs:+}), won {} drawn {} lost {}, shots {} : {}, \
         passes {} : {}, possession {:.2}.",
        short(of(&|t| t.goals[0])),
        short(of(&|t| t.goals[1])),
        short(of(&|t| t.goals[0] - t.goals[1])),
        won(1.0),
        tallies.len() - won(1.0) - won(-1.0),
        won(-1.0),
        short(of(&|t| t.shots[0])),
        short(of(&|t| t.shots[1])),
        short(of(&|t| t.passes[0])),
        short(of(&|t| t.passes[1])),
        of(&|t| t.owned[0] / (t.owned[0] + t.owned[1])),
    )
}

/// The figures of equal teams.
fn equal(section: &mut Section, level: f64, tallies: &[Tally]) {
    let of = |what: &dyn Fn(&Tally) -> f64| mean(&tallies.iter().map(what).collect::<Vec<_>>());
    let per = |part: f64, whole: f64| if whole > 0.0 { part / whole } else { f64::NAN };
    let both = |pair: [f64; 2]| pair[0] + pair[1];
    let shots = of(&|t| both(t.shots));
    let passes = of(&|t| both(t.passes));
    let steps = of(&|t| t.steps);
    let kind = |kind: EventKind| of(&|t| t.of(kind));
    let goals = if level < 0.8 { "1.5" } else { "2.3" };
    let figures: [(&str, &str, [f64; 2], f64); 25] = [
        ("goals", goals, [1.0, 4.0], of(&|t| both(t.goals))),
        ("shots", "7", [6.0, 20.0], shots),
        ("goals per shot", ".20–.39", [0.10, 0.35], per(of(&|t| both(t.goals)), shots)),
        ("mean shot distance, m", "15.4", [12.0, 20.0], per(of(&|t| t.shot_m), shots)),
        ("mean shot speed, m/s", "33", [28.0, 36.0], per(of(&|t| t.shot_mps), shots)),
        ("passes", "80–95", [70.0, 160.0], passes),
        ("share of passes completed", ".70–.75", [0.65, 0.85], per(of(&|t| both(t.completed)), passes)),
        ("share of steps in which nobody owns the ball", ".41–.44", [0.30, 0.55], {
            per(of(&|t| t.steps - both(t.owned)), steps)
        }),
        ("mean possession spell, steps", "30–50", [20.0, 70.0], per(steps, of(&|t| t.spells))),
        ("goal kicks", "3", [2.0, 8.0], kind(EventKind::GoalKick)),
        ("throw-ins", "1", [2.0, 10.0], kind(EventKind::ThrowIn)),
        ("corners", ".1", [0.5, 6.0], kind(EventKind::Corner)),
        ("free kicks", "4.8–6.4", [2.0, 10.0], kind(EventKind::FreeKick)),
        ("fouls", ".2", [1.0, 6.0], kind(EventKind::Foul)),
        ("yellow cards", ".1", [0.2, 2.0], kind(EventKind::YellowCard)),
        ("red cards", "0", [0.0, 0.2], kind(EventKind::RedCard)),
        ("penalties", ".1", [0.0, 0.4], kind(EventKind::Penalty)),
        ("headers", "0", [1.0, 15.0], kind(EventKind::Header)),
        ("steps with `game_mode` ≠ 0", "46–61", [30.0, 120.0], of(&|t| t.stopped)),
        ("share of steps with the ball in the left third", ".24", [0.2, 0.5], per(of(&|t| t.thirds[0]), steps)),
        ("share in the middle third", ".48", [0.2, 0.5], per(of(&|t| t.thirds[1]), steps)),
        ("share in the right third", ".28", [0.2, 0.5], per(of(&|t| t.thirds[2]), steps)),
        ("share of steps with the ball above 1 m", ".15–.20", [0.05, 0.25], per(of(&|t| t.high), steps)),
        ("km run per outfield player", "1.1", [0.8, 1.5], of(&|t| t.metres / 1000.0)),
        ("tiredness of outfield players at the end", ".82", [0.67, 0.97], of(&|t| t.tired[0])),
    ];
    for (what, theirs, range, ours) in figures {
        section.within(format!("{what}, {level} each"), theirs, range, ours);
    }
    section.within(format!("tiredness of keepers at the end, {level} each"), ".25", [0.10, 0.40], of(&|t| t.tired[1]));
    section.told.push(pairing(level, level, 0.0, tallies));
    section.told.push(format!(
        "Besides, {level} each: offsides {}, tackles {}, saves {} a match.",
        short(kind(EventKind::Offside)),
        short(kind(EventKind::Tackle)),
        short(kind(EventKind::Save))
    ));
}

/// The ladder of difficulties: the better against the worse, both ways round.
pub(crate) fn ladder(seeds: Option<u64>) -> Result<Section, Failure> {
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
        let differences: Vec<f64> = there
            .iter()
            .zip(&back)
            .map(|(a, b)| ((a.goals[0] - a.goals[1]) + (b.goals[1] - b.goals[0])) * 0.5)
            .collect();
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
            section.within(format!("{better} against {worse}: mean"), "–", [0.0, f64::INFINITY], middle);
        }
        section.told.push(format!("{better} against {worse}: {middle:+.3} ± {half:.3} goals."));
    }
    Ok(section)
}
