//! The session: the open scenario, on a thread of its own.

mod about;

use super::live::LiveMatch;
use super::message::{DRAWS_MAX, EPISODES_MAX, Episode, Reply, Request};
use super::players::{ActingPolicy, Guests, Performer};
use super::stage::{STEPS_MAX, StudioStage, episode_of};
use super::summary::RunningSummary;
use super::tell::{said, said_episode, send_all, step, tell};
use crate::agent::ChosenAgent;
use crate::baseline::baseline_file;
use crate::drag::rewritten;
use crate::dsl::report::{Diagnostic, diagnostics};
use crate::engine::control::agents::Agent;
use crate::engine::environment::Environment;
use crate::engine::state::PlayerId;
use crate::error::{FileFault, Packed};
use crate::files::{SOURCE_MAX_BYTES, read_file, write};
use crate::film::replayed;
use crate::level::Level;
use crate::load::{Cast, CastTarget, LoadOptions, compile_text_with, load_with};
use crate::replay::{REPLAY_MAX_BYTES, Replay};
use crate::scenario::Team;
use crate::watch::Watcher;
use crate::{Error, Loaded};
use std::collections::BTreeMap;
use std::ffi::OsStr;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Duration;
use tokio::sync::broadcast;
use tokio::sync::mpsc::UnboundedReceiver;
use tokio::sync::mpsc::error::TryRecvError;
use tokio::sync::oneshot;

/// How long the session waits for a file before it looks at its requests again.
const WAIT: Duration = Duration::from_millis(20);

/// What the session is asked for.
pub(super) enum Command {
    /// A page's request.
    Request(Request),
    /// Something that is none, and why.
    Nonsense(String),
    /// Everything that a new page needs.
    Join(oneshot::Sender<Vec<Arc<str>>>),
    /// An episode of another program.
    Watch(Box<Replay>),
}

/// How a scenario is opened.
#[derive(Default)]
pub struct OpenOptions {
    /// Whether imports and scripts may be outside the file's folder.
    pub allow_outside: bool,
    /// Agents that pages can choose besides the ready-made ones; the first plays at the beginning.
    pub agents: Vec<ChosenAgent>,
    /// The policies of the program that opens it.
    pub guests: Option<Box<dyn Guests>>,
    /// Parameters that differ from their defaults, SI units.
    pub params: BTreeMap<String, f64>,
}

/// The open scenario.
pub struct Session {
    source: String,
    /// The file, if it is one.
    path: Option<PathBuf>,
    options: OpenOptions,
    text: String,
    /// The text of the file.
    on_disk: String,
    /// The last good scenario.
    loaded: Loaded,
    params: BTreeMap<String, f64>,
    seed: u64,
    episode: u64,
    who: Performer,
    /// Who plays the same episode beside it.
    beside: Option<Performer>,
    watcher: Watcher,
    /// The match that people play.
    live: Option<LiveMatch>,
    /// The last message of each kind, for pages that come later.
    opened: Arc<str>,
    checked: Arc<str>,
    shown: Vec<Arc<str>>,
    /// Why the episode can't be played, if it can't.
    unmet: Vec<Arc<str>>,
    /// The episode that is shown, as a recording.
    replay: Option<Replay>,
    /// What the last check found, and what is wrong besides.
    found: (Vec<Diagnostic>, Option<String>),
    /// Whether something has changed since the episode was played.
    is_stale: bool,
    /// Many episodes that are being played.
    sum: Option<RunningSummary>,
}

impl Session {
    /// Whether imports and scripts may be outside the file's folder.
    pub(super) fn allows_outside(&self) -> bool {
        self.options.allow_outside
    }

    /// Opens a scenario by its name in the library or as a file, a level, or a recorded episode;
    /// `beside`:
    /// a recorded episode that is shown beside it.
    ///
    /// # Errors
    /// Like [`load_with`]; [`Error::Replay`] for a recording that can't be played here.
    pub fn open(
        source: &OsStr,
        beside: Option<&OsStr>,
        options: OpenOptions,
    ) -> Result<Session, Error> {
        let loading = LoadOptions {
            allow_outside: options.allow_outside,
            regions: true,
            ..LoadOptions::default()
        };
        let named = source.to_str().filter(|_| !Path::new(source).exists());
        let level = named.and_then(|text| Level::read(text).ok());
        let source = level.as_ref().map_or(source, |level| OsStr::new(&level.scenario));
        let mut session = match load_with(source, &loading) {
            Err(Error::File { path, why: FileFault::Packed(Packed::Replay) }) => {
                let replay = recording(&path)?;
                let loaded = Loaded::without_text(replay.scenario()?);
                let mut session = Session::new(source, loaded, options);
                (session.seed, session.episode) = (replay.seed, replay.index);
                session.shown = vec![said_episode(recorded(&replay, false)?)];
                session.replay = Some(replay);
                session
            }
            loaded => {
                let mut session = Session::new(source, loaded?, options);
                if let Some(level) = &level {
                    session.enter(level)?;
                }
                session.replay_episode();
                session
            }
        };
        if let Some(beside) = beside {
            let other = recording(Path::new(beside))?;
            session.shown.push(said_episode(recorded(&other, true)?));
        }
        Ok(session)
    }

    /// Takes the parameters and the episode of a level.
    fn enter(&mut self, level: &Level) -> Result<(), Error> {
        let scenario = &self.loaded.scenario;
        let values = level.bind(scenario)?.0;
        let names = scenario.params.iter().map(|param| param.name.clone());
        self.params = names.zip(values).collect();
        (self.seed, self.episode) = (level.seed, level.episode);
        self.checked = said(&self.checked());
        Ok(())
    }

    /// Opens a scenario that is loaded; `name`: how it was asked for.
    pub fn of(name: &OsStr, loaded: Loaded, options: OpenOptions) -> Session {
        let mut session = Session::new(name, loaded, options);
        // A text of the same name as a file isn't that file.
        session.path = None;
        session.opened = said(&session.opening(None));
        session.replay_episode();
        session
    }

    fn new(source: &OsStr, loaded: Loaded, mut options: OpenOptions) -> Session {
        // A compiled scenario and a recording have no text to edit.
        let has_text = loaded.sources.iter().next().is_some();
        let path = (has_text && Path::new(source).is_file()).then(|| PathBuf::from(source));
        let text = loaded.sources.iter().next().map_or("", |(_, file)| &*file.text).to_owned();
        let name = source.to_string_lossy().into_owned();
        let watcher = Watcher::new(&loaded.inputs);
        let params = std::mem::take(&mut options.params);
        let nothing: Arc<str> = Arc::from("");
        let who = options.agents.first().cloned().unwrap_or_else(|| Agent::Bot.into());
        let who = Performer::Agent(who);
        let mut session = Session {
            source: name,
            path,
            options,
            on_disk: text.clone(),
            text,
            loaded,
            params,
            seed: 0,
            episode: 0,
            who,
            beside: None,
            watcher,
            live: None,
            opened: nothing.clone(),
            checked: nothing,
            shown: Vec::new(),
            unmet: Vec::new(),
            replay: None,
            found: (Vec::new(), None),
            is_stale: false,
            sum: None,
        };
        session.found.0 = diagnostics(&session.loaded.warnings, &session.loaded.sources);
        session.opened = said(&session.opening(None));
        session.checked = said(&session.checked());
        session
    }

    /// Serves requests until nobody can send any.
    pub(super) fn run(
        mut self,
        mut inbox: UnboundedReceiver<Command>,
        pages: &broadcast::Sender<Arc<str>>,
    ) {
        loop {
            match inbox.try_recv() {
                Ok(Command::Join(answer)) => {
                    let present = [&self.opened, &self.checked].into_iter();
                    let present = present.chain(&self.shown).chain(&self.unmet);
                    // A page that has gone needs no answer.
                    let _ = answer.send(present.cloned().collect());
                }
                Ok(Command::Request(request)) => self.meet(request, pages),
                Ok(Command::Nonsense(why)) => {
                    tell(pages, &Reply::Refused { message: format!("not a request: {why}") });
                }
                Ok(Command::Watch(replay)) => self.watch(*replay, pages),
                // What came later has been heard: only the last of many changes is played.
                Err(TryRecvError::Empty) => self.idle(pages),
                Err(TryRecvError::Disconnected) => return,
            }
        }
    }

    /// What there is to do while nobody asks for anything.
    fn idle(&mut self, pages: &broadcast::Sender<Arc<str>>) {
        if self.live.is_none() && std::mem::take(&mut self.is_stale) {
            self.show(pages);
        }
        self.go_on(pages);
        let wait = if self.sum.is_some() { Duration::ZERO } else { WAIT };
        if self.watcher.changed(wait) {
            self.reload(pages);
        }
        self.sum_up(pages);
    }

    /// Plays the next of many episodes.
    fn sum_up(&mut self, pages: &broadcast::Sender<Arc<str>>) {
        let Some(mut sum) = self.sum.take() else { return };
        match sum.play_one() {
            Ok(true) => self.sum = Some(sum),
            Ok(false) => tell(pages, &Reply::Summary(sum.reply())),
            Err(message) => tell(pages, &Reply::Refused { message }),
        }
    }

    fn meet(&mut self, request: Request, pages: &broadcast::Sender<Arc<str>>) {
        if let Err(message) = self.try_to_meet(request, pages) {
            tell(pages, &Reply::Refused { message });
        }
    }

    fn try_to_meet(
        &mut self,
        request: Request,
        pages: &broadcast::Sender<Arc<str>>,
    ) -> Result<(), String> {
        match request {
            Request::Text { text, from } => self.take(text, from, pages),
            Request::Save => {
                let no_file = || format!("there is no file to save `{}` to", self.source);
                let path = self.path.as_ref().ok_or_else(no_file)?;
                write(path, self.text.as_bytes()).map_err(|why| why.to_string())?;
                self.on_disk.clone_from(&self.text);
                self.opened = said(&self.opening(None));
                tell(pages, &Reply::Saved);
            }
            Request::Play { seed, episode, agent, beside } => {
                let who = self.find(&agent)?;
                let beside = beside.map(|name| self.find(&name)).transpose()?;
                (self.seed, self.episode, self.who, self.beside) = (seed, episode, who, beside);
                self.is_stale = true;
            }
            Request::Begin { seats } => {
                let stage = self.stage(&self.who)?;
                let environment = stage.environment()?;
                let key = (self.seed, self.episode);
                let live = LiveMatch::begin(environment, key, stage.player, &seats)?;
                tell(pages, &step(&live.film.scenes));
                self.live = Some(live);
            }
            Request::Hold { seat, keys } => {
                if let Some(live) = &mut self.live {
                    live.hold(seat, keys);
                }
            }
            Request::Stop => self.end(pages),
            Request::Bind { params } => {
                (self.params, self.sum) = (params, None);
                self.checked = said(&self.checked());
                let _ = pages.send(self.checked.clone());
                self.is_stale = true;
            }
            Request::Move { player, to } => {
                let held = self.stage(&self.who)?.held((self.seed, self.episode), player)?;
                let numbers = held.moved(&self.loaded, &self.text, to)?;
                self.take(rewritten(&self.text, &numbers), None, pages);
            }
            Request::Cloud { count } => {
                let starts = self.stage(&self.who)?.cloud(self.seed, count.min(DRAWS_MAX))?;
                tell(pages, &Reply::Cloud { starts });
            }
            Request::Summary { episodes } => {
                let stage = self.stage(&self.who)?;
                self.sum =
                    Some(RunningSummary::begin(stage, self.seed, episodes.min(EPISODES_MAX))?);
            }
            Request::Record => {
                let replay = self.replay.as_ref().ok_or("there is no episode to hand over")?;
                let bytes = replay.to_bytes().map_err(|why| why.to_string())?;
                let name = &self.loaded.scenario.name;
                let name = format!("{name}_{}_{}.pitchr", replay.seed, replay.index);
                let mut hex = String::with_capacity(2 * bytes.len());
                for byte in bytes {
                    let _ = write!(hex, "{byte:02x}");
                }
                tell(pages, &Reply::Recording { name, hex });
            }
        }
        Ok(())
    }

    /// Who has a name: a ready-made agent, a policy from outside, or a behaviour of the text.
    fn find(&self, name: &str) -> Result<Performer, String> {
        if let Some(agent) = self.agents().find(|agent| agent.name() == name) {
            return Ok(Performer::Agent(agent));
        }
        if self.guests().iter().any(|guest| guest == name) {
            return Ok(Performer::Guest(name.to_owned()));
        }
        if self.loaded.behaviors.iter().any(|behavior| behavior == name) {
            return Ok(Performer::Behavior(name.to_owned()));
        }
        Err(format!("nobody is called `{name}`"))
    }

    /// The ready-made agents, and those that the studio was opened with.
    fn agents(&self) -> impl Iterator<Item = ChosenAgent> {
        let ready_made = Agent::NAMED.iter().map(|(_, agent)| ChosenAgent::from(*agent));
        let baseline = baseline_file(&self.loaded.scenario).ok().map(|_| ChosenAgent::Baseline);
        let given = self.options.agents.iter();
        let given = given.filter(|agent| ChosenAgent::from_name(agent.name()).is_none());
        ready_made.chain(baseline).chain(given.cloned())
    }

    fn guests(&self) -> Vec<String> {
        self.options.guests.as_ref().map(|guests| guests.names()).unwrap_or_default()
    }

    /// The scenario with its parameters, played by somebody.
    fn stage(&self, who: &Performer) -> Result<StudioStage, String> {
        let acting = |agent: &ChosenAgent| -> Result<ActingPolicy, Error> {
            let scenario = self.loaded.scenario.clone();
            let environment =
                Environment::new(scenario, self.environment()).map_err(Error::Environment)?;
            Ok(ActingPolicy::Agent(agent.fit(&environment)?.player()))
        };
        let mut scenario = self.loaded.scenario.clone();
        let player = match who {
            Performer::Agent(agent) => acting(agent).map_err(|why| why.to_string())?,
            Performer::Guest(name) => {
                let policy = self.options.guests.as_ref().and_then(|guests| guests.policy(name));
                ActingPolicy::Guest(policy.ok_or_else(|| format!("`{name}` has gone"))?)
            }
            Performer::Behavior(name) => {
                // The bot hands over to the behaviour of the player.
                let cast = self.cast(name)?;
                let options = LoadOptions { cast: &cast, ..self.loading() };
                let (_, main) = self.loaded.sources.iter().next().ok_or("there is no text")?;
                let cast = compile_text_with(&main.text, &main.name, &options);
                scenario = cast.map_err(|why| why.to_string())?.scenario;
                acting(&Agent::Bot.into()).map_err(|why| why.to_string())?
            }
        };
        let who = who.name().to_owned();
        Ok(StudioStage { scenario, options: self.environment(), player, who })
    }

    /// The players that a behaviour plays: those of the agents; all of a team whose agent changes
    /// players.
    fn cast(&self, behavior: &str) -> Result<Vec<Cast>, String> {
        let environment = Environment::new(self.loaded.scenario.clone(), self.environment())
            .map_err(|why| Error::Environment(why).to_string())?;
        let of = |&(team, player): &(Team, Option<PlayerId>)| match player {
            Some(player) => CastTarget::Player(team, player.in_team()),
            None => CastTarget::Team(team),
        };
        let targets = environment.roster().agents.iter().map(of);
        Ok(targets.map(|target| Cast { target, ai: behavior.to_owned() }).collect())
    }

    fn loading(&self) -> LoadOptions<'static> {
        let allow_outside = self.options.allow_outside;
        LoadOptions { allow_outside, regions: true, ..LoadOptions::default() }
    }

    /// Shows an episode of another program.
    fn watch(&mut self, replay: Replay, pages: &broadcast::Sender<Arc<str>>) {
        if self.live.is_some() {
            return;
        }
        match recorded(&replay, false) {
            Ok(episode) => {
                self.shown = vec![said_episode(Episode { watched: true, ..episode })];
                self.replay = Some(replay);
                send_all(pages, &self.shown);
            }
            Err(why) => tell(pages, &Reply::Refused { message: why.to_string() }),
        }
    }

    /// Plays the next step of a match by hand when it is due.
    fn go_on(&mut self, pages: &broadcast::Sender<Arc<str>>) {
        let Some(live) = self.live.as_mut().filter(|live| live.is_due()) else { return };
        let before = live.film.scenes.len();
        let played = live.step();
        tell(pages, &step(live.film.scenes.get(before..).unwrap_or_default()));
        match played {
            Ok(true) if live.film.length() < STEPS_MAX => {}
            Ok(_) => self.end(pages),
            Err(why) => {
                let message = format!("`{}` failed: {why}", self.who.name());
                self.end(pages);
                tell(pages, &Reply::Refused { message });
            }
        }
    }

    /// Ends a match by hand: from now on it can be watched like any other.
    fn end(&mut self, pages: &broadcast::Sender<Arc<str>>) {
        let Some(live) = self.live.take() else { return };
        self.is_stale = false;
        self.replay = live.replay();
        let episode = episode_of(live.film, (self.seed, self.episode), "you");
        self.shown = vec![said_episode(episode)];
        send_all(pages, &self.shown);
    }

    /// Reads the file again.
    fn reload(&mut self, pages: &broadcast::Sender<Arc<str>>) {
        let Some(path) = self.path.clone() else { return };
        let text =
            read_file(&path, SOURCE_MAX_BYTES).ok().and_then(|bytes| String::from_utf8(bytes).ok());
        let Some(text) = text else { return };
        // What has changed may be an import: the text here, saved or not, is compiled again.
        let is_other = text != self.on_disk;
        self.on_disk.clone_from(&text);
        let text = if is_other { text } else { self.text.clone() };
        self.take(text, None, pages);
    }

    /// Takes another text, and says so: checks it, and plays it if it is sound. Otherwise the last
    /// good one stays.
    ///
    /// `from`: the page that it comes from.
    fn take(&mut self, text: String, from: Option<String>, pages: &broadcast::Sender<Arc<str>>) {
        let options = self.loading();
        let name = self
            .path
            .as_deref()
            .map_or("studio.pitch".to_owned(), |path| path.to_string_lossy().into_owned());
        self.text = text;
        let result = compile_text_with(&self.text, &name, &options).map(|mut loaded| {
            if loaded.inputs.is_empty() {
                loaded.inputs.clone_from(&self.loaded.inputs);
            }
            self.watcher.watch(&loaded.inputs);
            self.loaded = loaded;
        });
        self.is_stale |= result.is_ok();
        self.sum = None;
        self.found = match result {
            Ok(()) => (diagnostics(&self.loaded.warnings, &self.loaded.sources), None),
            Err(Error::Compile(failure)) => {
                (diagnostics(&failure.problems, &failure.sources), None)
            }
            Err(other) => (Vec::new(), Some(other.to_string())),
        };
        let opened = said(&self.opening(from));
        let _ = pages.send(opened);
        self.opened = said(&self.opening(None));
        self.checked = said(&self.checked());
        let _ = pages.send(self.checked.clone());
    }

    /// Plays the episode and shows it.
    fn show(&mut self, pages: &broadcast::Sender<Arc<str>>) {
        self.replay_episode();
        send_all(pages, if self.unmet.is_empty() { &self.shown } else { &self.unmet });
    }

    /// Plays the episode again. If it can't be played, the last one stays, and why.
    fn replay_episode(&mut self) {
        match self.play() {
            Ok(replies) => (self.shown, self.unmet) = (replies, Vec::new()),
            Err(message) => {
                // What stands around a start also says why there is none.
                let sketch = self.sketch().ok().into_iter();
                self.unmet = sketch.chain([said(&Reply::Refused { message })]).collect();
            }
        }
    }

    /// Plays the episode: what pages get.
    fn play(&mut self) -> Result<Vec<Arc<str>>, String> {
        let key = (self.seed, self.episode);
        let (film, replay) = self.stage(&self.who)?.film(key)?;
        let mut episodes = vec![episode_of(film, key, self.who.name())];
        if let Some(beside) = &self.beside {
            let (film, _) = self.stage(beside)?.film(key)?;
            episodes.push(Episode { beside: true, ..episode_of(film, key, beside.name()) });
        }
        self.replay = replay;
        let mut replies: Vec<Arc<str>> = episodes.into_iter().map(said_episode).collect();
        replies.push(self.sketch()?);
        Ok(replies)
    }

    fn sketch(&self) -> Result<Arc<str>, String> {
        let stage = self.stage(&Performer::Agent(Agent::Idle.into()))?;
        Ok(said(&Reply::Sketch(stage.sketch(&self.loaded, (self.seed, self.episode))?)))
    }
}

/// A recorded episode, as pages get it.
fn recorded(replay: &Replay, beside: bool) -> Result<Episode, Error> {
    let episode = episode_of(replayed(replay)?, (replay.seed, replay.index), "");
    Ok(Episode { beside, ..episode })
}

/// Reads a recorded episode.
fn recording(path: &Path) -> Result<Replay, Error> {
    Replay::from_bytes(&read_file(path, REPLAY_MAX_BYTES)?)
}
