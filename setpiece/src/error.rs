//! Errors before an episode runs, each with a stable code and a help line.

use crate::level::Level;
use crate::onnx::NetworkFault;
use crate::replay::ReplayError;
use setpiece_dsl::problem::{Code, Problem, Severity, nearest};
use setpiece_dsl::source::Sources;
use setpiece_engine::batch::EpisodeError;
use setpiece_engine::environment::EnvironmentError;
use setpiece_engine::snapshot::SnapshotError;
use setpiece_scenario::{FormatError, ParamError};
use std::path::PathBuf;

/// Why a scenario can't be loaded or played.
#[derive(Clone, Debug)]
pub enum Error {
    /// Neither a scenario of the library nor a file.
    Unknown {
        /// The requested name.
        name: String,
        /// A similar name, if any.
        similar: Option<String>,
    },
    /// A file can't be used.
    File {
        /// The file.
        path: PathBuf,
        /// The reason.
        why: FileFault,
    },
    /// The text has errors.
    Compile(Box<Failure>),
    /// A compiled scenario can't be read.
    Format {
        /// The file.
        path: PathBuf,
        /// The reason.
        why: FormatError,
    },
    /// The players of a compiled scenario can't be cast.
    Cast {
        /// The requested behaviour.
        ai: String,
    },
    /// A snapshot can't be taken, restored or begun from.
    Snapshot(SnapshotError),
    /// A replay can't be read or played.
    Replay(ReplayError),
    /// A scenario has no policy in the box.
    NoBaseline {
        /// The scenario's name.
        scenario: String,
        /// The reason.
        why: BaselineFault,
        /// The scenarios that have one.
        known: Vec<String>,
    },
    /// Entries of a suite have no policy in the box.
    NoBaselines {
        /// Those that have none.
        entries: Vec<String>,
        /// How many entries there are.
        of: usize,
        /// The scenarios that have one.
        known: Vec<String>,
    },
    /// A policy from a file can't be played.
    Policy {
        /// The file.
        path: PathBuf,
        /// The reason.
        why: PolicyFault,
    },
    /// An environment can't be created from the scenario.
    Environment(EnvironmentError),
    /// An episode failed: no start was found, a script's hook failed, or nothing ended it.
    Episode(Box<EpisodeError>),
    /// An episode ended before the requested step.
    NoStep {
        /// The step.
        step: u32,
        /// How many steps the episode has.
        length: u32,
    },
    /// Threads can't be started.
    Threads(String),
    /// A level is of another scenario, or can't be read.
    Level {
        /// The level.
        level: String,
        /// What is wrong with it.
        why: LevelFault,
    },
    /// There is no such suite or curriculum.
    NoPlan {
        /// What is wanted: `suite`, `curriculum`.
        what: &'static str,
        /// The requested name; none for the only one of a file.
        name: Option<String>,
        /// The names that exist.
        known: Vec<String>,
        /// A similar name, if any.
        similar: Option<String>,
    },
    /// A parameter can't be bound.
    Param {
        /// The reason.
        why: ParamError,
        /// A similar name, if any.
        similar: Option<String>,
    },
}

/// What is wrong with a level: most often, its scenario differs from the one that it is used with.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum LevelFault {
    /// The level has the digest of another version.
    Version,
    /// It has another name.
    Name {
        /// The name of the scenario that the level is used with.
        found: String,
    },
    /// Neither the library nor a file has this name.
    Unknown,
    /// Its text or JSON can't be read.
    Unreadable(String),
}

/// Why a scenario has no policy in the box.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum BaselineFault {
    /// No policy was trained on a scenario with these players and this start.
    Unlike,
    /// The library's scenario of this name has one, but is another.
    Differs {
        /// What differs first.
        what: String,
    },
}

/// What is wrong with a policy from a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum PolicyFault {
    /// Its network can't be read or computed.
    Network(NetworkFault),
    /// Its network has other inputs than an observation and perhaps masks.
    Inputs {
        /// Their names.
        found: Vec<String>,
    },
    /// Its metadata says something else than a number of steps.
    Repeat {
        /// What it says.
        said: String,
    },
    /// It sees something that the scenario doesn't show.
    Observation {
        /// The lengths of the axes behind that of the batch; none where one is free.
        axes: Vec<Option<usize>>,
        /// The observation that the file names.
        named: Option<String>,
        /// The scenario's name.
        scenario: String,
        /// The observations of the scenario and how many numbers they have.
        known: Vec<(&'static str, String)>,
    },
    /// It returns something else than logits of the actions.
    Actions {
        /// The shape of what it returns.
        found: Vec<usize>,
    },
    /// It returns logits that are no numbers, whatever it sees.
    NotNumbers,
}

impl From<NetworkFault> for PolicyFault {
    fn from(why: NetworkFault) -> PolicyFault {
        PolicyFault::Network(why)
    }
}

impl std::fmt::Display for PolicyFault {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            PolicyFault::Network(why) => why.fmt(f),
            PolicyFault::Inputs { found } => write!(
                f,
                "expected one input, and perhaps a `mask`; found `{}`",
                found.join("`, `")
            ),
            PolicyFault::Repeat { said } => {
                write!(f, "its metadata says `repeat` is `{said}`; expected a number of steps")
            }
            PolicyFault::Observation { axes, named, scenario, .. } => {
                let length =
                    |axis: &Option<usize>| axis.map_or("n".to_owned(), |it| it.to_string());
                let shape: Vec<String> = axes.iter().map(length).collect();
                let shape = shape.join(" × ");
                match named {
                    Some(name) => write!(
                        f,
                        "it sees {shape} numbers of `{name}`, which `{scenario}` doesn't show"
                    ),
                    None => write!(f, "it sees {shape} numbers, which `{scenario}` doesn't show"),
                }
            }
            PolicyFault::NotNumbers => f.write_str("it returns logits that are no numbers (NaN)"),
            PolicyFault::Actions { found } => {
                write!(f, "it returns {found:?}; expected the logits of 19 or 20 actions, [1, 19]")
            }
        }
    }
}

/// What is wrong with a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum FileFault {
    /// It doesn't exist.
    Missing {
        /// A neighbour with a similar name.
        similar: Option<String>,
    },
    /// It is a directory.
    Directory,
    /// It is a pipe, a socket or a device.
    NotRegular,
    /// It isn't UTF-8.
    NotUtf8 {
        /// The first line with an invalid byte.
        line: usize,
    },
    /// It is a replay or snapshot, but a scenario was expected.
    Packed(Packed),
    /// It is larger than allowed.
    TooLarge {
        /// The limit in bytes.
        max: u64,
    },
    /// The system's message.
    Io(String),
    /// It can't be written; the system's message.
    Write(String),
}

/// A file of Setpiece that isn't a scenario.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Packed {
    /// A recorded episode.
    Replay,
    /// The state of an episode.
    Snapshot,
}

impl Packed {
    /// Recognises a file by its first bytes.
    pub fn of(bytes: &[u8]) -> Option<Packed> {
        let kinds = [
            (crate::replay::CONTAINER, Packed::Replay),
            (setpiece_engine::snapshot::CONTAINER, Packed::Snapshot),
        ];
        kinds.into_iter().find(|(container, _)| container.marks(bytes)).map(|(_, kind)| kind)
    }
}

/// The reports of a compilation that failed.
#[derive(Clone, Debug)]
pub struct Failure {
    /// Errors and warnings.
    pub problems: Vec<Problem>,
    /// The files they point into.
    pub sources: Sources,
    /// The files on disk that were read or looked for. A watcher watches them until they are fixed.
    pub inputs: Vec<PathBuf>,
}

impl Failure {
    /// Whether nothing is wrong but that there is no scenario: rewards or formations alone.
    pub fn is_without_scenario(&self) -> bool {
        let mut errors =
            self.problems.iter().filter(|problem| problem.severity() == Severity::Error);
        errors.all(Problem::misses_scenario)
    }

    /// Whether one of the problems is that there is no scenario.
    pub(crate) fn lacks_scenario(&self) -> bool {
        self.problems.iter().any(Problem::misses_scenario)
    }
}

impl Error {
    /// The stable code; the first one of several reports.
    pub fn code(&self) -> Code {
        match self {
            Error::Unknown { .. } => Code::UnknownScenario,
            Error::File {
                why: FileFault::Missing { .. } | FileFault::Io(_) | FileFault::Write(_),
                ..
            } => Code::FileMissing,
            Error::File { why: FileFault::Directory, .. } => Code::FileIsDirectory,
            Error::File { why: FileFault::NotRegular, .. } => Code::FileNotRegular,
            Error::File { why: FileFault::NotUtf8 { .. }, .. } => Code::NotUtf8,
            Error::File { why: FileFault::TooLarge { .. }, .. } => Code::FileTooLarge,
            Error::Compile(failure) => {
                failure.problems.first().map_or(Code::NoScenario, Problem::code)
            }
            Error::Format { .. } | Error::File { why: FileFault::Packed(_), .. } => {
                Code::BadCompiled
            }
            Error::Cast { .. } => Code::CompiledCast,
            Error::Param { .. } => Code::BadParameter,
            Error::Environment(why) => match why {
                EnvironmentError::Reward { .. } | EnvironmentError::RewardTwice(_) => {
                    Code::UnknownReward
                }
                EnvironmentError::Param(_)
                | EnvironmentError::Bindings { .. }
                | EnvironmentError::Roster => Code::BadParameter,
                EnvironmentError::Agents(_) => Code::BadAgents,
                EnvironmentError::Script(_) => Code::ScriptSyntax,
                EnvironmentError::Snapshot(_) => Code::BadSnapshot,
            },
            Error::Snapshot(_) => Code::BadSnapshot,
            Error::Replay(_) => Code::BadReplay,
            Error::Policy { .. } => Code::BadPolicy,
            Error::NoBaseline { .. } | Error::NoBaselines { .. } => Code::NoBaseline,
            Error::Episode(why) => match **why {
                EpisodeError::Draw(_) => Code::DrawFailed,
                EpisodeError::Environment(_) => Code::BadParameter,
                EpisodeError::Step(_) => Code::ScriptFailed,
                EpisodeError::Endless(_) => Code::Endless,
            },
            Error::NoStep { .. } => Code::NoStep,
            Error::Threads(_) => Code::NoThreads,
            Error::Level { why: LevelFault::Unreadable(_), .. } => Code::BadLevel,
            Error::Level { .. } => Code::OtherLevel,
            Error::NoPlan { .. } => Code::NoPlans,
        }
    }

    /// What to do instead.
    pub fn help(&self) -> Option<String> {
        let meant = |name: &String| format!("did you mean `{name}`?");
        match self {
            Error::Unknown { name, .. } if Level::read(name).is_ok() => {
                Some(format!("a level is given by an option: `--level '{name}'`"))
            }
            Error::Unknown { similar: Some(name), .. } => Some(meant(name)),
            Error::Unknown { .. } => {
                Some("`setpiece list` shows the scenarios; a file's path ends in .pitch".to_owned())
            }
            Error::File { why: FileFault::Missing { similar }, .. }
            | Error::Param { similar, .. }
            | Error::NoPlan { similar, name: Some(_), .. } => {
                similar.as_ref().map(meant)
            }
            Error::File { why: FileFault::Directory, .. } => Some("name a file in it".to_owned()),
            Error::File { why: FileFault::NotRegular, .. } => {
                Some("save what it gives to a file, and name that file".to_owned())
            }
            Error::File { why: FileFault::Packed(Packed::Replay), .. } => {
                Some("`setpiece replay FILE` plays it again, and `setpiece.Replay` in Python".to_owned())
            }
            Error::File { why: FileFault::Packed(Packed::Snapshot), .. } => {
                Some("name the scenario too, and begin in the snapshot: `setpiece run SCENARIO --from FILE`".to_owned())
            }
            Error::File { why: FileFault::NotUtf8 { .. }, path } if path.extension().is_some_and(|e| e == "pitchc") => {
                Some("it is damaged: build it again from its source".to_owned())
            }
            Error::File { why: FileFault::NotUtf8 { .. }, .. } => Some("save it as UTF-8 text".to_owned()),
            Error::Environment(EnvironmentError::Reward { name, known }) => {
                nearest(name, known.iter().map(String::as_str)).map(|name| format!("did you mean `{name}`?"))
            }
            Error::Cast { .. } => Some(
                "give the scenario's name or the path of its `.pitch` file, or write `ai: …` in the text".to_owned(),
            ),
            Error::Policy { why, .. } => policy_help(why),
            Error::NoBaseline { scenario, why: BaselineFault::Differs { .. }, .. } => {
                Some(format!(
                    "the library's is played by its name, `setpiece run {scenario}`; \
                     `--agent FILE.onnx` plays any policy"
                ))
            }
            Error::NoBaseline { known, .. } => {
                Some(format!("these have one: `{}`", known.join("`, `")))
            }
            Error::NoBaselines { known, .. } => Some(format!(
                "write a suite of those that have one: `{}`",
                known.join("`, `")
            )),
            Error::NoStep { length, .. } => Some(format!("its last moment is `--step {length}`")),
            Error::Snapshot(why)
            | Error::Environment(EnvironmentError::Snapshot(why)) => snapshot_help(why),
            Error::Replay(ReplayError::NotAReplay) => {
                Some("`setpiece.make(…, record=\"runs\")` writes them, and `env.unwrapped.save_replay`".to_owned())
            }
            Error::Replay(ReplayError::Beginning) => {
                Some("save the replay of an episode that `reset` began; `snapshot` keeps this one's state".to_owned())
            }
            Error::Level { why: LevelFault::Version, .. } => Some(
                "leave out the level's `digest` to play it all the same; the episode may differ"
                    .to_owned(),
            ),
            Error::NoPlan { name: None, known, .. } if known.len() > 1 => {
                Some("name one of them".to_owned())
            }
            Error::Level { why: LevelFault::Unreadable(_), .. } => Some(
                "a level is written `academy_corner{difficulty=0.8}#12:3`, or as its JSON"
                    .to_owned(),
            ),
            Error::Level { why: LevelFault::Unknown, .. } => Some(
                "name the file that holds it: `setpiece run FILE.pitch --level …`".to_owned(),
            ),
            _ => None,
        }
    }
}

fn policy_help(why: &PolicyFault) -> Option<String> {
    match why {
        PolicyFault::Network(NetworkFault::NotOnnx) => {
            Some("`torch.onnx.export` writes one".to_owned())
        }
        PolicyFault::Network(NetworkFault::Opset(_)) => {
            Some("export it with `opset_version=17`".to_owned())
        }
        PolicyFault::Network(NetworkFault::Operator { .. }) => Some(
            "`setpiece.evaluate` in Python plays every ONNX model, with `onnxruntime`".to_owned(),
        ),
        PolicyFault::Observation { known, .. } => {
            let known = known.iter().map(|(name, length)| format!("`{name}` has {length}"));
            Some(known.collect::<Vec<_>>().join(", "))
        }
        _ => None,
    }
}

fn snapshot_help(why: &SnapshotError) -> Option<String> {
    let help = match why {
        SnapshotError::NotASnapshot => {
            "`setpiece snapshot` and `env.unwrapped.snapshot()` take one"
        }
        SnapshotError::Scenario { .. } => {
            "a new episode may begin in its state: `reset(options={\"snapshot\": …})`"
        }
        SnapshotError::Roster { .. } => {
            "an episode begins from a snapshot of as many players and agents, in the same places"
        }
        SnapshotError::NotBegun => "reset the environment before it is taken",
        _ => return None,
    };
    Some(help.to_owned())
}

impl std::fmt::Display for Error {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Error::Unknown { name, .. } => write!(f, "no scenario is called `{name}`, and no file"),
            Error::File { path, why } => {
                let path = path.display();
                match why {
                    FileFault::Missing { .. } => write!(f, "no file `{path}`"),
                    FileFault::Directory => write!(f, "`{path}` is a directory"),
                    FileFault::NotRegular => write!(f, "`{path}` is not a regular file"),
                    FileFault::NotUtf8 { line } => {
                        write!(f, "`{path}` is not UTF-8 text: line {line} has other bytes")
                    }
                    FileFault::Packed(Packed::Replay) => {
                        write!(f, "`{path}` is a replay, not a scenario")
                    }
                    FileFault::Packed(Packed::Snapshot) => {
                        write!(f, "`{path}` is a snapshot, not a scenario")
                    }
                    FileFault::TooLarge { max } => {
                        write!(f, "`{path}` is larger than {} MiB", max / (1 << 20))
                    }
                    FileFault::Io(why) => write!(f, "`{path}` can't be read: {why}"),
                    FileFault::Write(why) => write!(f, "`{path}` can't be written: {why}"),
                }
            }
            Error::Compile(failure) => {
                let first = failure
                    .problems
                    .first()
                    .map_or("no scenario".to_owned(), |problem| problem.words().message);
                match failure.problems.len() {
                    0 | 1 => f.write_str(&first),
                    n => write!(f, "{first} (and {} more)", n - 1),
                }
            }
            Error::Format { path, why } => write!(f, "`{}`: {why}", path.display()),
            Error::Cast { ai } => {
                write!(
                    f,
                    "a compiled scenario keeps who plays its players: `{ai}` can't change them"
                )
            }
            Error::Param { why, .. } => why.fmt(f),
            Error::Snapshot(why) => why.fmt(f),
            Error::Replay(why) => why.fmt(f),
            Error::NoBaseline { scenario, why: BaselineFault::Unlike, .. } => {
                write!(f, "the scenario `{scenario}` has no baseline")
            }
            Error::NoBaseline { scenario, why: BaselineFault::Differs { what }, .. } => {
                write!(
                    f,
                    "the scenario `{scenario}` has no baseline: it isn't the library's of this \
                     name, whose baseline learned another start; {what} differs"
                )
            }
            Error::NoBaselines { entries, of, .. } => {
                let n = entries.len();
                let have = if n == 1 { "has" } else { "have" };
                write!(f, "{n} of {of} entries {have} no baseline: `{}`", entries.join("`, `"))
            }
            Error::Policy { path, why } => {
                write!(f, "the policy `{}` can't be played: {why}", path.display())
            }
            Error::Environment(why) => why.fmt(f),
            Error::Episode(why) => why.fmt(f),
            Error::NoStep { step, length: 1 } => {
                write!(f, "there is no step {step}: the episode has 1 step")
            }
            Error::NoStep { step, length } => {
                write!(f, "there is no step {step}: the episode has {length} steps")
            }
            Error::Threads(why) => f.write_str(why),
            Error::NoPlan { what, name, known, .. } => {
                match name {
                    Some(name) => write!(f, "no {what} is called `{name}`")?,
                    None => write!(f, "expected one {what}, found {}", known.len())?,
                }
                match known.as_slice() {
                    [] => Ok(()),
                    known => write!(f, "; there is `{}`", known.join("`, `")),
                }
            }
            Error::Level { level, why } => match why {
                LevelFault::Version => {
                    write!(f, "the level `{level}` was taken of another version of its scenario")
                }
                LevelFault::Name { found } => {
                    write!(f, "the level `{level}` is of another scenario than `{found}`")
                }
                LevelFault::Unreadable(why) => {
                    write!(f, "the level `{level}` can't be read: {why}")
                }
                LevelFault::Unknown => {
                    write!(f, "the level `{level}` is of a scenario that isn't in the library")
                }
            },
        }
    }
}

impl std::error::Error for Error {}
