//! Long runs over scenarios made up at random, every step held to what must be true of any match.

mod properties;
mod scramble;

use crate::pitch::{Failure, text};
use properties::Witness;
use setpiece::engine::environment::{Environment, Scratch};
use setpiece::engine::random::{Purpose, Stream};
use setpiece::scenario::vocabulary::Action;
use std::fs::File;
use std::io::Write as _;
use std::path::PathBuf;
use std::process::Command;
use std::sync::atomic::{AtomicU64, Ordering};

/// Steps where nothing else is asked for.
const STEPS: u64 = 10_000_000;
/// Longest episode of a scenario, steps.
const EPISODE: u32 = 600;
/// Episodes of every scenario.
const EPISODES: u64 = 4;

/// What a run has seen.
#[derive(Clone, Copy, Debug, Default)]
struct Count {
    steps: u64,
    scenarios: u64,
    episodes: u64,
    goals: u64,
    set_pieces: u64,
    cards: u64,
}

/// Runs `soak [--steps N] [--seed S]`.
pub(crate) fn soak(args: &[String]) -> Result<(), Failure> {
    let (steps, seed) = options(args)?;
    let next = AtomicU64::new(0);
    let done = AtomicU64::new(0);
    let results: Vec<Result<Count, Failure>> = std::thread::scope(|scope| {
        let work = || {
            let mut count = Count::default();
            let mut scratch = Scratch::default();
            while done.load(Ordering::Relaxed) < steps {
                let which = next.fetch_add(1, Ordering::Relaxed);
                let before = count.steps;
                play(seed, which, &mut scratch, &mut count)?;
                done.fetch_add(count.steps - before, Ordering::Relaxed);
            }
            Ok(count)
        };
        let hands: Vec<_> = (0..crate::threads()).map(|_| scope.spawn(work)).collect();
        hands.into_iter().map(|hand| hand.join().unwrap_or_else(|_| Err("a worker stopped".to_owned()))).collect()
    });
    let mut total = Count::default();
    let mut failures = Vec::new();
    for result in results {
        match result {
            Ok(count) => {
                total.steps += count.steps;
                total.scenarios += count.scenarios;
                total.episodes += count.episodes;
                total.goals += count.goals;
                total.set_pieces += count.set_pieces;
                total.cards += count.cards;
            }
            Err(why) => failures.push(why),
        }
    }
    println!("{total:?}");
    if failures.is_empty() { log(seed, total) } else { Err(failures.join("\n")) }
}

fn options(args: &[String]) -> Result<(u64, u64), Failure> {
    let (mut steps, mut seed) = (STEPS, 0);
    let mut args = args.iter();
    while let Some(arg) = args.next() {
        let number = args.next().and_then(|n| n.parse::<u64>().ok()).ok_or(format!("`{arg}` wants a number"));
        match arg.as_str() {
            "--steps" => steps = number?,
            "--seed" => seed = number?,
            other => return Err(format!("no option `{other}`; there is --steps N, --seed S")),
        }
    }
    Ok((steps, seed))
}

/// Who acts in an episode.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Habit {
    /// Every agent at random, every step.
    Random,
    /// The bot for every agent.
    Bot,
    /// Every agent holds what it did for a while, the bot now and then.
    Slow,
}

/// Plays some episodes of a scenario made up from a seed.
fn play(seed: u64, which: u64, scratch: &mut Scratch, count: &mut Count) -> Result<(), Failure> {
    let mut random = Stream::new(seed, which, Purpose::Agent);
    let source = scramble::scenario(&mut random, EPISODE);
    let fails = |why: String| format!("seed {seed}, scenario {which}: {why}\n{source}");
    let mut environment = text(&source).map_err(fails)?;
    count.scenarios += 1;
    for episode in 0..EPISODES {
        let habit = [Habit::Random, Habit::Bot, Habit::Slow][random.below(3) as usize];
        environment.reset(Some(seed), Some(episode)).map_err(|why| fails(why.to_string()))?;
        episode_of(&mut environment, habit, &mut random, scratch, count)
            .map_err(|why| fails(format!("episode {episode}, {habit:?}, step {}: {why}", environment.steps())))?;
        count.episodes += 1;
    }
    Ok(())
}

fn episode_of(
    environment: &mut Environment,
    habit: Habit,
    random: &mut Stream,
    scratch: &mut Scratch,
    count: &mut Count,
) -> Result<(), Failure> {
    let mut witness = Witness::new(environment.state())?;
    let mut actions = vec![Action::Idle; environment.n_agents()];
    while environment.is_running() {
        for action in &mut actions {
            *action = match habit {
                Habit::Bot => Action::BuiltinAi,
                Habit::Slow if random.below(8) > 0 => *action,
                Habit::Random | Habit::Slow => {
                    Action::from_index(random.below(Action::V2_SET as u32) as usize).unwrap_or(Action::Idle)
                }
            };
        }
        environment.step(&actions, scratch).map_err(|why| why.to_string())?;
        let seen = witness.see(environment.judged_state(), environment.state(), environment.events())?;
        count.steps += 1;
        count.goals += seen.goals;
        count.set_pieces += seen.set_pieces;
        count.cards += seen.cards;
    }
    Ok(())
}

/// Adds a line to the log of such runs.
fn log(seed: u64, total: Count) -> Result<(), Failure> {
    let commit = Command::new("git").args(["rev-parse", "--short", "HEAD"]).output();
    let commit =
        commit.map_or_else(|_| "unknown".to_owned(), |out| String::from_utf8_lossy(&out.stdout).trim().to_owned());
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("soak.csv");
    let Count { steps, scenarios, episodes, goals, set_pieces, cards } = total;
    let line = format!("{commit},{seed},{steps},{scenarios},{episodes},{goals},{set_pieces},{cards},held\n");
    let file = File::options().append(true).create(true).open(&path);
    file.and_then(|mut file| file.write_all(line.as_bytes())).map_err(|why| format!("{}: {why}", path.display()))
}
