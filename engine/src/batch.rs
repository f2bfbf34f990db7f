//! Many environments at once, on a few threads.
//!
//! Work is parallel over matches, never inside one. The result of an episode depends only on its
//! seed and index. So results are the same on any number of threads, and come in the order of the
//! episodes.

use crate::control::agents::Agent;
use crate::draw::DrawError;
use crate::environment::{Environment, EnvironmentError, Scratch, StepError};
use crate::judge::Recorded;
use crate::random::{Purpose, Stream};
use crate::statistics::MatchStatistics;
use rayon::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuilder};
use setpiece_scenario::Bindings;
use setpiece_scenario::vocabulary::{Action, Verdict};
use std::collections::VecDeque;
use std::ops::Range;
use std::sync::{Mutex, PoisonError};

/// Chooses the actions of an environment's agents.
pub trait Policy {
    /// Starts an episode.
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

/// A ready-made agent as a policy. One that acts at random draws from the episode's seed.
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

/// The result of an episode.
#[derive(Clone, Debug, PartialEq)]
pub struct EpisodeSummary {
    /// Its index.
    pub index: u64,
    /// The name of its ending.
    pub outcome: String,
    /// Success or failure, if the ending says so.
    pub verdict: Option<Verdict>,
    /// Whether it reached its limit.
    pub truncated: bool,
    /// Steps.
    pub length: u32,
    /// Goals, left and right.
    pub score: [u16; 2],
    /// The return of each agent.
    pub returns: Vec<f64>,
    /// The sums of the terms, agent by agent, in the order of [`Environment::term_names`].
    pub terms: Vec<Vec<f64>>,
    /// Payments that were dropped because their value was impossible.
    pub faults: u32,
    /// The values of the scenario's records, by name.
    pub records: Vec<(String, Recorded)>,
    /// The fingerprint of the last state.
    pub digest: u64,
    /// The figures of the match.
    pub statistics: MatchStatistics,
}

impl EpisodeSummary {
    /// The result of the episode that an environment has just played.
    pub fn of(environment: &Environment) -> EpisodeSummary {
        let outcome = environment.outcome();
        let terms: Vec<Vec<f64>> = (0..environment.n_agents())
            .map(|agent| environment.term_sums(agent).to_vec())
            .collect();
        EpisodeSummary {
            index: environment.index(),
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
        }
    }
}

/// Why an episode was not played to its end.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum EpisodeError {
    /// No start was found.
    #[error(transparent)]
    Draw(#[from] DrawError),
    /// The drawn parameters don't fit.
    #[error(transparent)]
    Environment(#[from] EnvironmentError),
    /// A step failed.
    #[error(transparent)]
    Step(#[from] StepError),
    /// Neither an ending nor a limit came within a day of play.
    #[error("the episode has no end{}", if *.0 == 0 { String::new() } else { format!(": none in {} steps", .0) })]
    Endless(u32),
}

/// After this many steps an episode without a limit is given up: a day of play.
pub const STEPS_MAX: u32 = 864_000;

/// The threads could not be started.
#[derive(Debug, thiserror::Error)]
#[error("{threads} threads can't be started: {source}")]
pub struct BatchError {
    threads: usize,
    source: rayon::ThreadPoolBuildError,
}

fn pool(threads: usize) -> Result<ThreadPool, BatchError> {
    ThreadPoolBuilder::new()
        .num_threads(threads)
        .build()
        .map_err(|source| BatchError { threads, source })
}

/// Plays one episode to its end.
///
/// # Errors
/// [`EpisodeError`] if it has no start, a script fails, or nothing ends it.
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
    Ok(EpisodeSummary::of(environment))
}

/// Plays episodes on a new pool of threads.
///
/// - `prototype`: the environment that every worker plays a copy of.
/// - `episodes`: their indices under `seed`.
/// - `bindings`: the parameters of an episode, if they aren't the prototype's.
/// - `policy`: makes a worker's policy. Its choices must depend only on the environment (including
///   its seed and index).
/// - `after`: called with every episode as it ends, from any thread, in no order.
/// - returns: one result per episode, in the order of the indices.
///
/// # Errors
/// [`BatchError`] if the threads can't be started.
pub fn run_episodes<P: Policy>(
    prototype: &Environment,
    seed: u64,
    episodes: Range<u64>,
    threads: usize,
    bindings: impl Fn(u64) -> Option<Bindings> + Sync,
    policy: impl Fn() -> P + Sync,
    after: impl Fn(&Result<EpisodeSummary, EpisodeError>) + Sync,
) -> Result<Vec<Result<EpisodeSummary, EpisodeError>>, BatchError> {
    let worker = || (prototype.clone(), Scratch::default(), policy());
    let play = |(environment, scratch, policy): &mut (Environment, Scratch, P), index| {
        let bound = bindings(index).map_or(Ok(()), |bindings| environment.set_bindings(&bindings));
        let result = bound
            .map_err(EpisodeError::from)
            .and_then(|()| run_episode(environment, seed, index, policy, scratch));
        after(&result);
        result
    };
    if threads <= 1 {
        let mut worker = worker();
        return Ok(episodes.map(|index| play(&mut worker, index)).collect());
    }
    Ok(pool(threads)?.install(|| episodes.into_par_iter().map_init(worker, play).collect()))
}

/// Lanes, one match each, that a few threads work on together, each with its own scratch world.
pub struct Batch<L> {
    lanes: Vec<L>,
    scratches: Vec<Scratch>,
    /// The threads besides the caller's own; none if the caller's thread is enough.
    others: Option<ThreadPool>,
}

impl<L: Send> Batch<L> {
    /// Lanes on this many threads, including the caller's.
    ///
    /// # Errors
    /// [`BatchError`] if the threads can't be started.
    pub fn new(lanes: Vec<L>, threads: usize) -> Result<Batch<L>, BatchError> {
        let threads = threads.clamp(1, lanes.len().max(1));
        let scratches = std::iter::repeat_with(Scratch::default).take(threads).collect();
        let others = if threads > 1 { Some(pool(threads - 1)?) } else { None };
        Ok(Batch { lanes, scratches, others })
    }

    /// Starts the threads again: a forked process doesn't inherit its parent's threads.
    ///
    /// # Errors
    /// [`BatchError`] if the threads can't be started.
    pub fn restart_threads(&mut self) -> Result<(), BatchError> {
        if let Some(others) = self.others.take() {
            // The old pool's threads are gone and may have held one of its locks, so dropping it
            // could wait forever.
            std::mem::forget(others);
            self.others = Some(pool(self.scratches.len() - 1)?);
        }
        Ok(())
    }

    /// The lanes.
    pub fn lanes(&self) -> &[L] {
        &self.lanes
    }

    /// The lanes, mutable.
    pub fn lanes_mut(&mut self) -> &mut [L] {
        &mut self.lanes
    }

    /// Calls `work` for every lane and its row, with the lane's number, the lane, the row and a
    /// scratch world. Lanes without a row are skipped. Results don't depend on which thread has
    /// which lane.
    ///
    /// Each thread processes its own share first. The caller's share is always the first one, whose
    /// lanes its cache may still hold. Then the thread helps the others from the end of their
    /// shares. So nobody waits longer than one lane's work.
    pub fn each<R: Send>(
        &mut self,
        rows: Vec<R>,
        work: impl Fn(usize, &mut L, R, &mut Scratch) + Sync,
    ) {
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
        let mut scenario =
            scenario(&[(Team::Left, Role::CF, 0.5, 0.0), (Team::Right, Role::GK, 50.0, 0.0)]);
        scenario.players[0].controllable = true;
        scenario.rewards.push(scoring());
        Environment::new(Arc::new(scenario), EnvironmentOptions::default()).unwrap()
    }

    #[test]
    fn threads_change_nothing() {
        let random = || ReadyMade::new(Agent::Random);
        let run = |threads| {
            run_episodes(&prototype(), 7, 0..8, threads, |_| None, random, |_| ()).unwrap()
        };
        let (one, three) = (run(1), run(3));
        assert_eq!(one, three);
        let summaries: Vec<_> = one.into_iter().map(Result::unwrap).collect();
        assert!(
            summaries
                .iter()
                .enumerate()
                .all(|(k, summary)| summary.index == k as u64 && summary.length <= 50)
        );
    }

    #[test]
    fn who_is_done_helps_the_others() {
        use std::sync::mpsc::channel;
        use std::time::Duration;
        let (send, receive) = channel();
        let receive = Mutex::new(receive);
        let mut batch = Batch::new(vec![(); 4], 2).unwrap();
        // Lanes 0 and 1 are one thread's share; 0 isn't done before 1 is.
        batch.each(vec![(); 4], |number, (), (), _| match number {
            0 => receive.lock().unwrap().recv_timeout(Duration::from_secs(60)).unwrap(),
            1 => send.send(()).unwrap(),
            _ => (),
        });
    }

    #[test]
    fn the_size_of_a_batch_and_its_threads_change_nothing() {
        let digests = |lanes: usize, threads: usize| -> Vec<u64> {
            let mut batch = Batch::new(vec![prototype(); lanes], threads).unwrap();
            batch.each((0..).take(lanes).collect(), |_, lane, seed, _| {
                lane.reset(Some(seed), None).unwrap();
            });
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
            let found: Vec<_> =
                batch.lanes().iter().map(|lane| (lane.index(), lane.steps())).collect();
            assert_eq!(found, [(0, 1), (1, 1), (2, 1), (3, 1), (4, 0)]);
        }
    }
}
