//! Many environments at once, on a few threads.
//!
//! Parallel over matches, never inside one: what an episode gives depends on its seed and index alone, so results are the
//! same on any number of threads, and come in the order of the episodes.

use crate::control::agents::Agent;
use crate::draw::DrawError;
use crate::environment::{Environment, Scratch, StepError};
use crate::judge::Recorded;
use crate::random::{Purpose, Stream};
use crate::statistics::MatchStatistics;
use rayon::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuilder};
use setpiece_scenario::vocabulary::{Action, Verdict};
use std::collections::VecDeque;
use std::ops::Range;
use std::sync::{Mutex, PoisonError};

/// Whoever chooses an environment's actions.
pub trait Policy {
    /// An episode has begun.
    fn begin(&mut self, environment: &Environment) {
        let _ = environment;
    }

    /// The action of an agent.
    fn act(&mut self, environment: &Environment, agent: usize) -> Action;
}

impl<F: FnMut(&Environment, usize) -> Action> Policy for F {
    fn act(&mut self, environment: &Environment, agent: usize) -> Action {
        self(environment, agent)
    }
}

/// A ready-made agent as a policy; one that acts at random draws from the episode's seed.
#[derive(Clone, Debug)]
pub struct ReadyMade {
    agent: Agent,
    stream: Stream,
}

impl ReadyMade {
    /// A ready-made agent that plays every slot.
    pub fn new(agent: Agent) -> ReadyMade {
        ReadyMade { agent, stream: Stream::new(0, 0, Purpose::Agent) }
    }
}

impl Policy for ReadyMade {
    fn begin(&mut self, environment: &Environment) {
        self.stream = Stream::new(environment.seed(), environment.index(), Purpose::Agent);
    }

    fn act(&mut self, environment: &Environment, agent: usize) -> Action {
        self.agent.act(environment.state(), agent, &mut self.stream)
    }
}

/// What an episode was.
#[derive(Clone, Debug, PartialEq)]
pub struct EpisodeSummary {
    /// Its index.
    pub index: u64,
    /// The name of its ending.
    pub outcome: String,
    /// Success or failure, where the ending says so.
    pub verdict: Option<Verdict>,
    /// It ran into its limit.
    pub truncated: bool,
    /// Steps.
    pub length: u32,
    /// Goals, left and right.
    pub score: [u16; 2],
    /// What each agent was paid.
    pub returns: Vec<f64>,
    /// Agent by agent, the sums of the terms, in the order of [`Environment::term_names`].
    pub terms: Vec<Vec<f64>>,
    /// Payments that were stopped because their value was impossible.
    pub faults: u32,
    /// What the scenario's records say, by name.
    pub records: Vec<(String, Recorded)>,
    /// The fingerprint of its last state.
    pub digest: u64,
    /// What it was like.
    pub statistics: MatchStatistics,
}

/// Why an episode was not played to its end.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum EpisodeError {
    /// It has no start.
    #[error(transparent)]
    Draw(#[from] DrawError),
    /// It failed on its way.
    #[error(transparent)]
    Step(#[from] StepError),
    /// Neither an ending nor a limit came within a day of play.
    #[error("the episode has no end{}", if *.0 == 0 { String::new() } else { format!(": none in {} steps", .0) })]
    Endless(u32),
}

/// Steps after which an episode without a limit is given up: a day of play.
pub const STEPS_MAX: u32 = 864_000;

/// The threads could not be started.
#[derive(Debug, thiserror::Error)]
#[error("{threads} threads can't be started: {source}")]
pub struct BatchError {
    threads: usize,
    source: rayon::ThreadPoolBuildError,
}

fn pool(threads: usize) -> Result<ThreadPool, BatchError> {
    ThreadPoolBuilder::new().num_threads(threads).build().map_err(|source| BatchError { threads, source })
}

/// Plays one episode to its end.
///
/// # Errors
/// [`EpisodeError`] where it has no start, a script fails, or nothing ends it.
pub fn run_episode(
    environment: &mut Environment,
    seed: u64,
    index: u64,
    policy: &mut impl Policy,
    scratch: &mut Scratch,
) -> Result<EpisodeSummary, EpisodeError> {
    environment.reset(Some(seed), Some(index))?;
    policy.begin(environment);
    let n_agents = environment.n_agents();
    let mut actions = vec![Action::Idle; n_agents];
    while environment.is_running() {
        for (agent, action) in actions.iter_mut().enumerate() {
            *action = policy.act(environment, agent);
        }
        environment.step(&actions, scratch)?;
        if environment.is_running() && environment.steps() >= STEPS_MAX {
            return Err(EpisodeError::Endless(STEPS_MAX));
        }
    }
    let outcome = environment.outcome();
    let terms: Vec<Vec<f64>> = (0..n_agents).map(|agent| environment.term_sums(agent).to_vec()).collect();
    Ok(EpisodeSummary {
        index,
        outcome: outcome.map(|outcome| outcome.label.to_string()).unwrap_or_default(),
        verdict: outcome.and_then(|outcome| outcome.verdict),
        truncated: outcome.is_some_and(|outcome| outcome.truncated),
        length: environment.steps(),
        score: environment.score(),
        returns: terms.iter().map(|terms| terms.iter().sum()).collect(),
        terms,
        faults: environment.faults(),
        records: environment.records().map(|(name, value)| (name.to_owned(), value)).collect(),
        digest: environment.digest(),
        statistics: environment.statistics().summary(),
    })
}

/// Plays episodes on a pool of threads of its own.
///
/// - `prototype`: the environment that every worker plays a copy of.
/// - `episodes`: their indices under `seed`.
/// - `policy`: makes a worker's policy; what it does must depend on the environment alone (its seed and index too).
/// - `after`: is told of every episode as it ends, from any thread, in no order.
/// - returns: one result per episode, in the order of the indices.
///
/// # Errors
/// [`BatchError`] where the threads can't be started.
pub fn run_episodes<P: Policy>(
    prototype: &Environment,
    seed: u64,
    episodes: Range<u64>,
    threads: usize,
    policy: impl Fn() -> P + Sync,
    after: impl Fn(&Result<EpisodeSummary, EpisodeError>) + Sync,
) -> Result<Vec<Result<EpisodeSummary, EpisodeError>>, BatchError> {
    let worker = || (prototype.clone(), Scratch::default(), policy());
    let play = |(environment, scratch, policy): &mut (Environment, Scratch, P), index| {
        let result = run_episode(environment, seed, index, policy, scratch);
        after(&result);
        result
    };
    if threads <= 1 {
        let mut worker = worker();
        return Ok(episodes.map(|index| play(&mut worker, index)).collect());
    }
    Ok(pool(threads)?.install(|| episodes.into_par_iter().map_init(worker, play).collect()))
}

/// Lanes, a match each, that are worked on together: on a few threads, each with a scratch world of its own.
pub struct Batch<L> {
    lanes: Vec<L>,
    scratches: Vec<Scratch>,
    /// The threads beside the caller's own; none where that does all.
    others: Option<ThreadPool>,
}

impl<L: Send> Batch<L> {
    /// Lanes on so many threads, the caller's among them.
    ///
    /// # Errors
    /// [`BatchError`] where the threads can't be started.
    pub fn new(lanes: Vec<L>, threads: usize) -> Result<Batch<L>, BatchError> {
        let threads = threads.clamp(1, lanes.len().max(1));
        let scratches = std::iter::repeat_with(Scratch::default).take(threads).collect();
        let others = if threads > 1 { Some(pool(threads - 1)?) } else { None };
        Ok(Batch { lanes, scratches, others })
    }

    /// Starts the threads again: those of a process are not in its fork.
    ///
    /// # Errors
    /// [`BatchError`] if the threads can't be started.
    pub fn restart_threads(&mut self) -> Result<(), BatchError> {
        if let Some(others) = self.others.take() {
            // Its threads are gone, and may have gone with a lock of its own: nobody waits for them.
            std::mem::forget(others);
            self.others = Some(pool(self.scratches.len() - 1)?);
        }
        Ok(())
    }

    /// The lanes.
    pub fn lanes(&self) -> &[L] {
        &self.lanes
    }

    /// The lanes, to change.
    pub fn lanes_mut(&mut self) -> &mut [L] {
        &mut self.lanes
    }

    /// Does something with every lane and its row: `work` is given the lane's number, the lane, the row and a scratch
    /// world. Lanes without a row are left alone. Which thread has which lane changes nothing.
    ///
    /// A thread goes through a share of its own (the caller's is always the first, whose lanes its cache may still hold),
    /// then helps the others from the end of theirs: nobody waits for longer than one lane's work.
    pub fn each<R: Send>(&mut self, rows: Vec<R>, work: impl Fn(usize, &mut L, R, &mut Scratch) + Sync) {
        let length = self.lanes.len().div_ceil(self.scratches.len()).max(1);
        let mut lanes = self.lanes.iter_mut().zip(rows).enumerate();
        let share = |_: &Scratch| Mutex::new(lanes.by_ref().take(length).collect::<VecDeque<_>>());
        let shares: Vec<_> = self.scratches.iter().map(share).collect();
        let next = |whose: usize, own: usize| {
            let mut share = shares[whose].lock().unwrap_or_else(PoisonError::into_inner);
            if whose == own { share.pop_front() } else { share.pop_back() }
        };
        let turn = |own: usize, scratch: &mut Scratch| {
            for whose in (own..shares.len()).chain(0..own) {
                while let Some((number, (lane, row))) = next(whose, own) {
                    work(number, lane, row, scratch);
                }
            }
        };
        let mut scratches = self.scratches.iter_mut().enumerate();
        let Some((own, scratch)) = scratches.next() else { return };
        match &self.others {
            None => turn(own, scratch),
            Some(others) => others.in_place_scope(|scope| {
                for (own, scratch) in scratches {
                    let turn = &turn;
                    scope.spawn(move |_| turn(own, scratch));
                }
                turn(own, scratch);
            }),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::environment::EnvironmentOptions;
    use crate::testing::{scenario, scoring};
    use setpiece_scenario::vocabulary::{Role, Team};
    use std::sync::Arc;

    fn prototype() -> Environment {
        let mut scenario = scenario(&[(Team::Left, Role::CF, 0.5, 0.0), (Team::Right, Role::GK, 50.0, 0.0)]);
        scenario.players[0].controllable = true;
        scenario.rewards.push(scoring());
        Environment::new(Arc::new(scenario), EnvironmentOptions::default()).unwrap()
    }

    #[test]
    fn threads_change_nothing() {
        let random = || ReadyMade::new(Agent::Random);
        let run = |threads| run_episodes(&prototype(), 7, 0..8, threads, random, |_| ()).unwrap();
        let (one, three) = (run(1), run(3));
        assert_eq!(one, three);
        let summaries: Vec<_> = one.into_iter().map(Result::unwrap).collect();
        assert!(summaries.iter().enumerate().all(|(k, summary)| summary.index == k as u64 && summary.length <= 50));
    }

    #[test]
    fn who_is_done_helps_the_others() {
        use std::sync::mpsc::channel;
        use std::time::Duration;
        let (tell, told) = channel();
        let told = Mutex::new(told);
        let mut batch = Batch::new(vec![(); 4], 2).unwrap();
        // Lanes 0 and 1 are one thread's share; 0 isn't done before 1 is.
        batch.each(vec![(); 4], |number, (), (), _| match number {
            0 => told.lock().unwrap().recv_timeout(Duration::from_secs(60)).unwrap(),
            1 => tell.send(()).unwrap(),
            _ => (),
        });
    }

    #[test]
    fn the_size_of_a_batch_and_its_threads_change_nothing() {
        let digests = |lanes: usize, threads: usize| -> Vec<u64> {
            let mut batch = Batch::new(vec![prototype(); lanes], threads).unwrap();
            batch.each((0..).take(lanes).collect(), |_, lane, seed, _| lane.reset(Some(seed), None).unwrap());
            for _ in 0..30 {
                batch.each(vec![Action::Right; lanes], |_, lane, action, scratch| {
                    lane.step(&[action], scratch).unwrap();
                });
            }
            batch.lanes().iter().map(Environment::digest).collect()
        };
        let all = digests(40, 1);
        assert_ne!(all[0], all[1]);
        for (lanes, threads) in [(1, 1), (5, 2), (40, 2), (40, 9)] {
            assert_eq!(digests(lanes, threads), all[..lanes], "{lanes} lanes on {threads} threads");
        }
    }

    #[test]
    fn a_batch_works_on_each_lane_with_its_row() {
        for threads in [1, 2, 9] {
            let mut batch = Batch::new(vec![prototype(); 5], threads).unwrap();
            batch.each((0..5).collect(), |at, lane, row: u64, _| {
                assert_eq!(at as u64, row);
                lane.reset(Some(1), Some(row)).unwrap();
            });
            batch.each(vec![Action::Right; 4], |_, lane, action, scratch| {
                lane.step(&[action], scratch).unwrap();
            });
            let told: Vec<_> = batch.lanes().iter().map(|lane| (lane.index(), lane.steps())).collect();
            assert_eq!(told, [(0, 1), (1, 1), (2, 1), (3, 1), (4, 0)]);
        }
    }
}
