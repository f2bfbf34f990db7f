//! Long runs over random scenarios; every step must fulfil what is true of any match.

mod properties;
mod scramble;

use crate::pitch::{LabError, text};
use properties::{Step, Witness};
use setpiece::engine::environment::{Environment, Scratch};
use setpiece::engine::random::{Purpose, Stream};
use setpiece::scenario::vocabulary::Action;
use std::collections::BTreeMap;
use std::fs::File;
use std::io::Write as _;
use std::path::PathBuf;
use std::process::Command;
use std::sync::Mutex;
use std::sync::atomic::{AtomicU64, Ordering};

/// Default number of steps.
const STEPS: u64 = 10_000_000;
/// A run of at least this many steps adds a line to the log.
const LOGGED: u64 = 1_000_000;
/// Longest episode of a scenario, steps.
const EPISODE: u32 = 600;
/// Episodes of every scenario.
const EPISODES: u64 = 4;

/// What a run has covered.
#[derive(Clone, Copy, Debug, Default)]
struct Count {
    steps: u64,
    scenarios: u64,
    episodes: u64,
    goals: u64,
    set_pieces: u64,
    cards: u64,
}

impl Count {
    /// The sum of both.
    fn with(self, other: Count) -> Count {
        Count {
            steps: self.steps + other.steps,
            scenarios: self.scenarios + other.scenarios,
            episodes: self.episodes + other.episodes,
            goals: self.goals + other.goals,
            set_pieces: self.set_pieces + other.set_pieces,
            cards: self.cards + other.cards,
        }
    }
}

/// Breaches: the first case of each kind, and the number of cases.
type Breaches = BTreeMap<String, (u64, LabError)>;

/// Options of `lab soak`.
#[derive(Debug, clap::Args)]
pub(crate) struct SoakArgs {
    /// Play this many steps
    #[arg(long, value_name = "N", default_value_t = STEPS)]
    steps: u64,
    /// The seed of the scenarios
    #[arg(long, value_name = "S", default_value_t = 0)]
    seed: u64,
    /// The scenario to begin with: the one that a breach has named
    #[arg(long, value_name = "SCENARIO", default_value_t = 0)]
    from: u64,
}

/// Plays, and reports what has not held.
pub(crate) fn soak(args: &SoakArgs) -> Result<(), LabError> {
    let &SoakArgs { steps, seed, from } = args;
    let next = AtomicU64::new(from);
    let done = AtomicU64::new(0);
    let breaches = Mutex::new(Breaches::new());
    let work = || {
        let mut count = Count::default();
        let mut scratch = Scratch::default();
        while done.load(Ordering::Relaxed) < steps {
            let which = next.fetch_add(1, Ordering::Relaxed);
            let before = count.steps;
            if let Err(breach) = play(seed, which, &mut scratch, &mut count)
                && let Ok(mut breaches) = breaches.lock()
            {
                breaches.entry(kind_of(&breach.what)).or_insert((0, breach.report)).0 += 1;
            }
            // A scenario that can't be played counts as a step, so that the run still ends.
            done.fetch_add((count.steps - before).max(1), Ordering::Relaxed);
        }
        count
    };
    let total = std::thread::scope(|scope| {
        let hands: Vec<_> = (0..crate::threads::threads()).map(|_| scope.spawn(work)).collect();
        hands.into_iter().try_fold(Count::default(), |total, hand| {
            hand.join().map(|count| total.with(count)).map_err(|_| "a worker stopped".to_owned())
        })
    })?;
    println!("{total:?}");
    let breaches = breaches.into_inner().map_err(|_| "a worker stopped".to_owned())?;
    if breaches.is_empty() {
        return if steps < LOGGED || from > 0 { Ok(()) } else { log(seed, total) };
    }
    let reports: Vec<LabError> =
        breaches.values().map(|(times, first)| format!("{times} times: {first}")).collect();
    Err(reports.join("\n"))
}

/// The kind of a breach: its words without the numbers.
fn kind_of(what: &str) -> String {
    what.chars().filter(|c| !c.is_ascii_digit() && !"-.,".contains(*c)).collect()
}

/// Who acts in an episode.
#[derive(Clone, Copy, Debug, PartialEq)]
enum AgentHabit {
    /// Idle.
    Idle,
    /// Every agent acts at random in every step.
    Random,
    /// The bot plays every agent.
    Bot,
    /// Every agent keeps its action for a while; sometimes the bot plays.
    Slow,
}

/// Habits, each as often as it is drawn.
const HABITS: [AgentHabit; 5] =
    [AgentHabit::Random, AgentHabit::Random, AgentHabit::Bot, AgentHabit::Slow, AgentHabit::Idle];

/// A property that was breached.
struct Breach {
    what: LabError,
    /// The same, with its scenario and the moment.
    report: LabError,
}

/// Plays some episodes of a random scenario derived from a seed.
fn play(seed: u64, which: u64, scratch: &mut Scratch, count: &mut Count) -> Result<(), Breach> {
    let mut random = Stream::new(seed, which, Purpose::Agent);
    let source = scramble::scenario(&mut random, EPISODE);
    let tell = |what: LabError, when: String| Breach {
        report: format!("seed {seed}, scenario {which}{when}: {what}\n{source}"),
        what,
    };
    let mut environment = text(&source).map_err(|why| tell(why, String::new()))?;
    count.scenarios += 1;
    for episode in 0..EPISODES {
        let habit = HABITS[random.below(HABITS.len() as u32) as usize];
        environment
            .reset(Some(seed), Some(episode))
            .map_err(|why| tell(why.to_string(), format!(", episode {episode}")))?;
        episode_of(&mut environment, habit, &mut random, scratch, count).map_err(|why| {
            tell(why, format!(", episode {episode}, {habit:?}, step {}", environment.steps()))
        })?;
        count.episodes += 1;
    }
    Ok(())
}

fn episode_of(
    environment: &mut Environment,
    habit: AgentHabit,
    random: &mut Stream,
    scratch: &mut Scratch,
    count: &mut Count,
) -> Result<(), LabError> {
    let mut witness = Witness::new(environment.state())?;
    let mut actions = vec![Action::Idle; environment.n_agents()];
    while environment.is_running() {
        for action in &mut actions {
            *action = match habit {
                AgentHabit::Idle => Action::Idle,
                AgentHabit::Bot => Action::BuiltinAi,
                AgentHabit::Slow if random.below(8) > 0 => *action,
                AgentHabit::Random | AgentHabit::Slow => {
                    Action::from_index(random.below(Action::FULL_SET as u32) as usize)
                        .unwrap_or(Action::Idle)
                }
            };
        }
        environment.step(&actions, scratch).map_err(|why| why.to_string())?;
        let step = Step {
            actions: &actions,
            judged: environment.judged_state(),
            after: environment.state(),
            events: environment.events(),
        };
        let seen = witness.see(&step, scratch)?;
        let ended = environment.steps() >= EPISODE;
        if ended == environment.is_running() {
            return Err("the limit is not the end".to_owned());
        }
        count.steps += 1;
        count.goals += seen.goals;
        count.set_pieces += seen.set_pieces;
        count.cards += seen.cards;
    }
    Ok(())
}

/// Adds a line to the log of such runs.
fn log(seed: u64, total: Count) -> Result<(), LabError> {
    let commit = Command::new("git").args(["rev-parse", "--short", "HEAD"]).output();
    let commit = commit.map_or_else(
        |_| "unknown".to_owned(),
        |out| String::from_utf8_lossy(&out.stdout).trim().to_owned(),
    );
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("soak.csv");
    let Count { steps, scenarios, episodes, goals, set_pieces, cards } = total;
    let line = format!(
        "{commit},{seed},{steps},{scenarios},{episodes},{goals},{set_pieces},{cards},held\n"
    );
    let file = File::options().append(true).create(true).open(&path);
    file.and_then(|mut file| file.write_all(line.as_bytes()))
        .map_err(|why| format!("{}: {why}", path.display()))
}
