//! Replays: an episode as a file that can be played again, bit for bit.
//!
//! A replay holds the scenario, who played, the key of the draw and what every agent did;
//! everything else follows. It begins with a [head](setpiece_scenario::container); what follows is
//! CBOR, deflated.

use crate::error::Error;
use flate2::Compression;
use flate2::read::DeflateDecoder;
use flate2::write::DeflateEncoder;
use glam::Vec2;
use serde::de::{Error as _, SeqAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize};
use setpiece_engine::batch::{EpisodeError, STEPS_MAX};
use setpiece_engine::environment::{
    AgentsChoice, Environment, EnvironmentOptions, Physics, ResetError, Scratch,
};
use setpiece_engine::judge::Outcome;
use setpiece_engine::state::Steer;
use setpiece_scenario::container::{Container, HeadError};
use setpiece_scenario::file::binary;
use setpiece_scenario::{Action, Bindings, Scenario, Verdict};
use std::io::{Read as _, Write as _};
use std::marker::PhantomData;
use std::sync::Arc;

/// The version of replays that this build writes and plays.
pub const REPLAY_VERSION: u32 = 2;
/// Largest replay, bytes.
pub const REPLAY_MAX_BYTES: u64 = 64 << 20;
/// The most bytes after the header, inflated.
const BODY_MAX_BYTES: u64 = 64 << 20;
/// The most actions, over all agents and steps: three whole matches of 22 agents.
const ACTS_MAX: usize = 4_000_000;
/// Replays as files.
pub(crate) const CONTAINER: Container =
    Container { mark: b"\x8bpitchr\n", version: REPLAY_VERSION };

/// Why a replay can't be read or played.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ReplayError {
    /// It has another format.
    #[error("not a replay: its header isn't recognised")]
    NotAReplay,
    /// It was written by another version.
    #[error("the replay has version {0}; this build plays version {REPLAY_VERSION}")]
    Version(u32),
    /// It is truncated.
    #[error("the replay is truncated: its end is missing")]
    Truncated,
    /// It has been changed.
    #[error("the replay was changed after it was written: its checksum differs")]
    Checksum,
    /// It holds impossible values.
    #[error("the replay is damaged: {0}")]
    Corrupt(String),
    /// It has no episode.
    #[error("no episode has begun: there is nothing to replay")]
    NotBegun,
    /// Its episode is longer than a replay may be.
    #[error(
        "the episode is too long: a replay has {STEPS_MAX} steps and {ACTS_MAX} actions at most"
    )]
    TooLong,
    /// It is larger than a replay may be.
    #[error("the replay is larger than {} MiB", BODY_MAX_BYTES >> 20)]
    TooLarge,
    /// How its episode began is unknown.
    #[error(
        "the episode continues from a restored snapshot or with changed scripts: its beginning is unknown"
    )]
    Beginning,
    /// This build plays it differently.
    #[error("step {step}: this build diverges from the recording")]
    Differs {
        /// The step after which the states differed.
        step: u32,
    },
}

impl From<HeadError> for ReplayError {
    fn from(error: HeadError) -> ReplayError {
        match error {
            HeadError::Mark => ReplayError::NotAReplay,
            HeadError::Truncated => ReplayError::Truncated,
            HeadError::Version(found) => ReplayError::Version(found),
            HeadError::Checksum => ReplayError::Checksum,
        }
    }
}

/// What is written down while an episode is played.
#[derive(Clone, Debug, Default)]
pub struct Recorder {
    from: Option<Vec<u8>>,
    acts: Vec<u8>,
    steers: Vec<Option<Steer>>,
    whole: bool,
    too_long: bool,
}

impl Recorder {
    /// Begins an episode, optionally in the state of a snapshot.
    pub fn begin(&mut self, from: Option<&[u8]>) {
        self.from = from.map(<[u8]>::to_vec);
        self.acts.clear();
        self.steers.clear();
        (self.whole, self.too_long) = (true, false);
    }

    /// Invalidates the recording: the episode continues from elsewhere, so its beginning is
    /// unknown.
    pub fn invalidate(&mut self) {
        *self = Recorder::default();
    }

    /// Records an agent's action of the next step; agent by agent, step by step.
    ///
    /// An episode that is longer than a replay may be isn't kept.
    pub fn note(&mut self, action: Action, steer: Option<Steer>) {
        if self.acts.len() >= ACTS_MAX || !self.whole {
            *self = Recorder { too_long: self.too_long || self.whole, ..Recorder::default() };
            return;
        }
        self.acts.push(action.index() as u8);
        self.steers.push(steer);
    }

    /// Drops the actions beyond `steps` steps of `n_agents`: those of a rejected step.
    pub fn keep(&mut self, steps: u32, n_agents: usize) {
        self.acts.truncate(steps as usize * n_agents);
        self.steers.truncate(steps as usize * n_agents);
    }
}

/// An episode that can be played again.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Replay {
    scenario: Vec<u8>,
    rewards: Option<Vec<String>>,
    physics: Option<Physics>,
    agents: Option<AgentsChoice>,
    params: Bindings,
    /// The seed of its draw.
    pub seed: u64,
    /// The index of its draw.
    pub index: u64,
    from: Option<Vec<u8>>,
    /// Steps.
    pub length: u32,
    /// The fingerprint of its last state.
    pub digest: u64,
    #[serde(deserialize_with = "acts")]
    acts: Vec<u8>,
    /// Direction and power, if agents steered.
    #[serde(deserialize_with = "acts")]
    steers: Vec<Option<[f32; 3]>>,
    /// How it ended: label, verdict, whether the limit ended it. A caller may have
    /// [ended](Environment::end) it.
    #[serde(default)]
    outcome: Option<(String, Option<Verdict>, bool)>,
}

impl Replay {
    /// The episode of an environment, as far as it has been played.
    ///
    /// # Errors
    /// [`Error::Replay`] if no episode has begun, or if its beginning is unknown.
    pub fn of(environment: &Environment, recorder: &Recorder) -> Result<Replay, Error> {
        if !environment.has_begun() {
            return Err(Error::Replay(ReplayError::NotBegun));
        }
        let noted = environment.steps() as usize * environment.n_agents();
        if recorder.too_long || environment.steps() > STEPS_MAX {
            return Err(Error::Replay(ReplayError::TooLong));
        }
        if !recorder.whole || recorder.acts.len() != noted {
            return Err(Error::Replay(ReplayError::Beginning));
        }
        let scenario = binary::to_bytes(environment.scenario())
            .map_err(|why| Error::Replay(ReplayError::Corrupt(why.to_string())))?;
        let options = environment.options();
        let steered = recorder.steers.iter().any(Option::is_some);
        let numbers =
            |steer: &Option<Steer>| steer.map(|steer| [steer.way.x, steer.way.y, steer.power]);
        Ok(Replay {
            scenario,
            rewards: options.rewards.clone(),
            physics: options.physics,
            agents: options.agents.clone(),
            params: environment.bindings().clone(),
            seed: environment.seed(),
            index: environment.index(),
            from: recorder.from.clone().or_else(|| options.from.as_ref().map(|from| from.to_vec())),
            length: environment.steps(),
            digest: environment.digest(),
            acts: recorder.acts.clone(),
            steers: if steered {
                recorder.steers.iter().map(numbers).collect()
            } else {
                Vec::new()
            },
            outcome: environment
                .outcome()
                .map(|it| (it.label.to_string(), it.verdict, it.truncated)),
        })
    }

    /// Encodes the replay.
    ///
    /// # Errors
    /// [`Error::Replay`] if it can't be encoded.
    pub fn to_bytes(&self) -> Result<Vec<u8>, Error> {
        let corrupt = |why: String| Error::Replay(ReplayError::Corrupt(why));
        let mut body = Vec::new();
        ciborium::into_writer(self, &mut body).map_err(|why| corrupt(why.to_string()))?;
        if body.len() as u64 > BODY_MAX_BYTES {
            return Err(Error::Replay(ReplayError::TooLarge));
        }
        let mut deflated = DeflateEncoder::new(Container::begin(0), Compression::default());
        deflated.write_all(&body).map_err(|why| corrupt(why.to_string()))?;
        let file = deflated.finish().map_err(|why| corrupt(why.to_string()))?;
        Ok(CONTAINER.seal(file))
    }

    /// Decodes a replay.
    ///
    /// # Errors
    /// [`Error::Replay`] for anything but an unchanged replay of this version.
    pub fn from_bytes(file: &[u8]) -> Result<Replay, Error> {
        read(file).map_err(Error::Replay)
    }

    /// The scenario, bound to the parameters that it was played with.
    ///
    /// # Errors
    /// [`Error::Replay`] if this build can't read it.
    pub fn scenario(&self) -> Result<Scenario, Error> {
        let mut scenario = binary::from_bytes(&self.scenario).map_err(|why| corrupt(&why))?;
        if self.params.0.len() != scenario.params.len() {
            return Err(corrupt(&"it has not one value for each parameter"));
        }
        for (param, value) in scenario.params.iter_mut().zip(&self.params.0) {
            param.default = *value;
        }
        Ok(scenario)
    }

    /// Creates an environment that can play it, before its start.
    ///
    /// # Errors
    /// [`Error::Environment`] if this build can't play the scenario like that, [`Error::Replay`] if
    /// the replay is damaged.
    pub fn environment(&self) -> Result<Environment, Error> {
        let options = EnvironmentOptions {
            bindings: None,
            rewards: self.rewards.clone(),
            physics: self.physics,
            agents: self.agents.clone(),
            from: None,
        };
        let environment =
            Environment::new(Arc::new(self.scenario()?), options).map_err(Error::Environment)?;
        let noted = self.length as usize * environment.n_agents();
        if self.acts.len() != noted || !(self.steers.is_empty() || self.steers.len() == noted) {
            return Err(corrupt(&"it has not one action for each agent and step"));
        }
        if let Some(number) =
            self.acts.iter().find(|&&number| Action::from_index(number.into()).is_none())
        {
            return Err(corrupt(&format!("no action has the number {number}")));
        }
        Ok(environment)
    }

    /// The snapshot that it began in, if any.
    pub fn from(&self) -> Option<&[u8]> {
        self.from.as_deref()
    }

    /// The agents' actions, agent by agent, step by step: keys, and how they steered.
    pub fn acts(&self) -> impl ExactSizeIterator<Item = (Action, Option<Steer>)> + '_ {
        self.acts.iter().enumerate().map(|(at, &number)| {
            let steer = self.steers.get(at).copied().flatten();
            let steer = steer.map(|[x, y, power]| Steer { way: Vec2::new(x, y), power });
            (Action::from_index(number.into()).unwrap_or(Action::Idle), steer)
        })
    }

    /// Ends an environment that has played it as the caller had ended the episode, if the scenario
    /// didn't end it.
    pub fn end(&self, environment: &mut Environment) {
        if let Some((label, verdict, truncated)) = &self.outcome
            && environment.steps() == self.length
        {
            environment.end(Outcome {
                label: label.as_str().into(),
                verdict: *verdict,
                truncated: *truncated,
            });
        }
    }

    /// Plays it. `each` gets the start, and the environment after every step.
    ///
    /// # Errors
    /// [`Error::Replay`] if it can't be played here, or diverges from the recording.
    pub fn play(
        &self,
        mut each: impl FnMut(&Environment, &[Action]),
    ) -> Result<Environment, Error> {
        let mut environment = self.environment()?;
        let broken = |why: EpisodeError| Error::Episode(Box::new(why));
        match &self.from {
            Some(from) => {
                environment.reset_from(from, Some(self.seed), Some(self.index)).map_err(|why| {
                    match why {
                        ResetError::Draw(why) => broken(why.into()),
                        ResetError::Snapshot(why) => Error::Snapshot(why),
                    }
                })?;
            }
            None => environment
                .reset(Some(self.seed), Some(self.index))
                .map_err(|why| broken(why.into()))?,
        }
        each(&environment, &[]);
        let mut scratch = Scratch::default();
        let mut actions = vec![Action::Idle; environment.n_agents()];
        let mut acts = self.acts();
        for step in 0..self.length {
            if !environment.is_running() {
                return Err(Error::Replay(ReplayError::Differs { step }));
            }
            for (agent, (action, act)) in actions.iter_mut().zip(acts.by_ref()).enumerate() {
                *action = act.0;
                if act.1.is_some() {
                    environment.steer(agent, act.1);
                }
            }
            environment.step(&actions, &mut scratch).map_err(|why| broken(why.into()))?;
            self.end(&mut environment);
            each(&environment, &actions);
        }
        if environment.digest() != self.digest {
            return Err(Error::Replay(ReplayError::Differs { step: self.length }));
        }
        Ok(environment)
    }
}

fn corrupt(why: &dyn std::fmt::Display) -> Error {
    Error::Replay(ReplayError::Corrupt(why.to_string()))
}

/// Reads a list with as many actions as a replay may have, because a byte of a file may become
/// sixteen in memory.
fn acts<'de, D: Deserializer<'de>, T: Deserialize<'de>>(from: D) -> Result<Vec<T>, D::Error> {
    struct Acts<T>(PhantomData<T>);
    impl<'de, T: Deserialize<'de>> Visitor<'de> for Acts<T> {
        type Value = Vec<T>;

        fn expecting(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
            f.write_str("a list of actions")
        }

        fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<Vec<T>, A::Error> {
            let mut acts = Vec::new();
            while let Some(act) = list.next_element()? {
                if acts.len() >= ACTS_MAX {
                    return Err(A::Error::custom(format_args!(
                        "it has more than {ACTS_MAX} actions"
                    )));
                }
                acts.push(act);
            }
            Ok(acts)
        }
    }
    from.deserialize_seq(Acts(PhantomData))
}

fn read(file: &[u8]) -> Result<Replay, ReplayError> {
    let body = CONTAINER.open(file)?;
    let mut inflated = Vec::new();
    let mut inflater = DeflateDecoder::new(body).take(BODY_MAX_BYTES + 1);
    inflater.read_to_end(&mut inflated).map_err(|why| ReplayError::Corrupt(why.to_string()))?;
    if inflated.len() as u64 > BODY_MAX_BYTES {
        return Err(ReplayError::TooLarge);
    }
    let replay: Replay = ciborium::from_reader(inflated.as_slice())
        .map_err(|why| ReplayError::Corrupt(why.to_string()))?;
    if replay.length > STEPS_MAX {
        return Err(ReplayError::TooLong);
    }
    let sound =
        replay.steers.iter().flatten().flatten().all(|number| (-1.0..=1.0).contains(number));
    if sound {
        Ok(replay)
    } else {
        Err(ReplayError::Corrupt("a way or power is beyond its bounds".to_owned()))
    }
}
