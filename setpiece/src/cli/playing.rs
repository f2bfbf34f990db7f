//! Options shared by commands that play episodes: the scenario, its parameters, the agent, the
//! seed, the physics.

use crate::agent::ChosenAgent;
use crate::cli::agent::AgentParser;
use crate::engine::environment::{EnvironmentOptions, Physics};
use crate::error::LevelFault;
use crate::files::{SNAPSHOT_MAX_BYTES, read_file};
use crate::level::Level;
use crate::load::LoadOptions;
use crate::{Error, Loaded};
use clap::{Args, ValueEnum, builder::RangedU64ValueParser};
use std::ffi::{OsStr, OsString};
use std::ops::Deref;
use std::path::PathBuf;
use std::sync::Arc;

/// One episode of what is played.
#[derive(Args, Debug)]
pub(crate) struct OneEpisode {
    #[command(flatten)]
    pub(crate) playing: Playing,
    /// The episode's index under the seed
    #[arg(
        short,
        long,
        value_name = "N",
        default_value_t = 0,
        allow_negative_numbers = true,
        conflicts_with = "level"
    )]
    episode: u64,
}

impl OneEpisode {
    /// Its seed and its index under that.
    pub(crate) fn key(&self) -> (u64, u64) {
        (self.playing.seed(), self.playing.episode(self.episode))
    }
}

/// What is played, and who plays it.
#[derive(Args, Debug)]
pub(crate) struct Playing {
    #[command(flatten)]
    what: PlayedArgs,
    /// Who controls the agents
    #[arg(short, long, value_parser = AgentParser, default_value = "bot")]
    agent: ChosenAgent,
}

impl Deref for Playing {
    type Target = PlayedArgs;

    fn deref(&self) -> &PlayedArgs {
        &self.what
    }
}

impl Playing {
    /// The agent that plays every slot.
    pub(crate) fn agent(&self) -> ChosenAgent {
        self.agent.clone()
    }
}

/// How many threads play.
#[derive(Args, Debug)]
pub(crate) struct ThreadsArg {
    /// Threads; the results don't depend on them [default: one per core]
    #[arg(short, long, value_name = "N", value_parser = RangedU64ValueParser::<u16>::new().range(1..=1024))]
    threads: Option<u16>,
}

impl ThreadsArg {
    /// The number of threads.
    pub(crate) fn count(&self) -> usize {
        let cores = std::thread::available_parallelism().map_or(1, usize::from);
        self.threads.map_or(cores, usize::from)
    }
}

/// What is played.
#[derive(Args, Debug)]
pub(crate) struct PlayedArgs {
    /// A scenario of the library, a .pitch file or a compiled .pitchc file
    #[arg(value_name = "SCENARIO", required_unless_present = "level")]
    scenario: Option<OsString>,
    /// Which scenario of the file [default: its last that isn't abstract]
    #[arg(long = "scenario", value_name = "NAME", conflicts_with = "level")]
    wanted: Option<String>,
    /// The seed; the same seed gives the same episodes
    #[arg(short, long, value_name = "S", default_value_t = 0, allow_negative_numbers = true)]
    seed: u64,
    /// Play the one episode of a level: 'NAME{param=value}#SEED:EPISODE', or its JSON
    #[arg(long, value_name = "LEVEL", value_parser = level, conflicts_with_all = ["seed", "set", "from"])]
    pub(crate) level: Option<Level>,
    /// Set a parameter of the scenario; may be repeated
    #[arg(long, value_name = "PARAM=VALUE", value_parser = pair)]
    set: Vec<(String, String)>,
    /// How the ball's contacts are found [default: as the scenario says]
    #[arg(long, value_enum)]
    physics: Option<PhysicsName>,
    /// Begin every episode in the state of a snapshot instead of the scenario's start
    #[arg(long, value_name = "FILE")]
    from: Option<PathBuf>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum PhysicsName {
    /// Rapier runs only if the ball comes near something hard
    Gated,
    /// Rapier runs on every tick
    Full,
}

fn pair(text: &str) -> Result<(String, String), String> {
    match text.split_once('=') {
        Some((name, value)) if !name.trim().is_empty() => {
            Ok((name.trim().to_owned(), value.trim().to_owned()))
        }
        _ => Err("write it as name=value".to_owned()),
    }
}

fn level(text: &str) -> Result<Level, Error> {
    let unreadable =
        |why| Error::Level { level: text.to_owned(), why: LevelFault::Unreadable(why) };
    let level = Level::read(text).map_err(unreadable)?;
    // The range of its one episode has an end.
    if level.episode == u64::MAX {
        return Err(unreadable(format!("the greatest index of an episode is {}", u64::MAX - 1)));
    }
    Ok(level)
}

impl PlayedArgs {
    /// What to load: the scenario that is named, else the level's.
    pub(crate) fn source(&self) -> &OsStr {
        let named = self.scenario.as_deref();
        let of_level = || self.level.as_ref().map(|level| OsStr::new(&level.scenario));
        named.or_else(of_level).unwrap_or_default()
    }

    /// Loads it; of a file, the scenario that is wanted or that a level names.
    ///
    /// # Errors
    /// Like [`crate::load_with`]; [`Error::Level`] if only a level names it and it isn't found.
    pub(crate) fn load(&self, options: LoadOptions<'_>) -> Result<Loaded, Error> {
        let scenario = self.wanted();
        let loaded = crate::load_with(self.source(), &LoadOptions { scenario, ..options });
        loaded.map_err(|error| self.explained(error))
    }

    /// The scenario that an option or a level names, where a file may have others.
    pub(crate) fn wanted(&self) -> Option<&str> {
        let level = self.level.as_ref().filter(|_| self.scenario.is_some());
        self.wanted.as_deref().or_else(|| level.map(|level| level.scenario.as_str()))
    }

    /// Explains that a scenario isn't found, where only a level names it.
    pub(crate) fn explained(&self, error: Error) -> Error {
        match (&self.level, error) {
            (Some(level), Error::Unknown { similar: None, .. }) if self.scenario.is_none() => {
                level.fault(LevelFault::Unknown)
            }
            (_, error) => error,
        }
    }

    /// The seed.
    pub(crate) fn seed(&self) -> u64 {
        self.level.as_ref().map_or(self.seed, |level| level.seed)
    }

    /// The index of the level's episode, else the one that is asked for.
    pub(crate) fn episode(&self, otherwise: u64) -> u64 {
        self.level.as_ref().map_or(otherwise, |level| level.episode)
    }

    /// How the ball's contacts are found, if it is said.
    pub(crate) fn physics(&self) -> Option<Physics> {
        self.physics.map(|physics| match physics {
            PhysicsName::Gated => Physics::Gated,
            PhysicsName::Full => Physics::Full,
        })
    }

    /// The option that a suite has no use for, if one is given.
    pub(crate) fn foreign_to_suites(&self) -> Option<&'static str> {
        let given = [
            (self.seed != 0, "--seed"),
            (!self.set.is_empty(), "--set"),
            (self.from.is_some(), "--from"),
        ];
        given.into_iter().find(|(given, _)| *given).map(|(_, name)| name)
    }

    /// The parameters, the physics and the snapshot to begin from, with the scenario's own rewards.
    ///
    /// # Errors
    /// [`Error::Param`] for an unknown parameter or a value that isn't allowed; [`Error::File`] if
    /// the snapshot can't be read; [`Error::Level`] for a level of another scenario.
    pub(crate) fn environment(&self, loaded: &Loaded) -> Result<EnvironmentOptions, Error> {
        let pairs = self.set.iter().map(|(name, value)| (name.as_str(), value.as_str()));
        let bindings = match &self.level {
            Some(level) => {
                if self.scenario.is_some() {
                    level.check_name(&loaded.scenario)?;
                }
                level.bind(&loaded.scenario)?
            }
            None => crate::bind(&loaded.scenario, pairs)?,
        };
        Ok(EnvironmentOptions {
            bindings: Some(bindings),
            rewards: None,
            physics: self.physics(),
            agents: None,
            from: self
                .from
                .as_ref()
                .map(|path| read_file(path, SNAPSHOT_MAX_BYTES))
                .transpose()?
                .map(Arc::from),
        })
    }
}
