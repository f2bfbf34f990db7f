//! The session: the open scenario, on a thread of its own.

use super::drag::moved;
use super::live::LiveMatch;
use super::message::{
    CheckReply, DRAWS_MAX, EPISODES_MAX, Episode, Happened, OpenReply, ParamControl, Reply,
    Request, SummaryReply,
};
use crate::dsl::report::diagnostics;
use crate::engine::batch::ReadyMade;
use crate::engine::control::agents::Agent;
use crate::engine::environment::{Environment, EnvironmentOptions};
use crate::engine::state::PlayerId;
use crate::error::{FileFault, Packed};
use crate::files::{SOURCE_MAX_BYTES, read_file, write};
use crate::film::{Film, FilmOptions, film, replayed};
use crate::load::{LoadOptions, compile_text_with, load_with};
use crate::render::Scene;
use crate::render::scene::Id;
use crate::replay::{REPLAY_MAX_BYTES, Replay};
use crate::run::{RunOptions, run};
use crate::scenario::{Bindings, Type, Verdict};
use crate::scene::{of_match, team};
use crate::watch::Watcher;
use crate::{Error, Loaded};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Duration;
use tokio::sync::broadcast;
use tokio::sync::mpsc::UnboundedReceiver;
use tokio::sync::mpsc::error::TryRecvError;
use tokio::sync::oneshot;

/// How long the session waits for a file before it looks at its requests again.
const WAIT: Duration = Duration::from_millis(20);
/// An episode without an end is shown up to here.
const STEPS_MAX: u32 = 3_000;

/// What the session is asked for.
pub(super) enum Command {
    /// A page's request.
    Request(Request),
    /// Something that is none, and why.
    Nonsense(String),
    /// Everything that a new page needs.
    Join(oneshot::Sender<Vec<Arc<str>>>),
}

/// The open scenario.
pub struct Session {
    source: String,
    /// The file, if it is one.
    path: Option<PathBuf>,
    allow_outside: bool,
    text: String,
    /// The last good scenario.
    loaded: Loaded,
    params: BTreeMap<String, f64>,
    seed: u64,
    episode: u64,
    agent: Agent,
    watcher: Watcher,
    /// The match that a person plays.
    live: Option<LiveMatch>,
    /// The last message of each kind, for pages that come later.
    opened: Arc<str>,
    checked: Arc<str>,
    played: Option<Arc<str>>,
}

impl Session {
    /// Opens a scenario by its name in the library or as a file, or a recorded episode.
    ///
    /// # Errors
    /// Like [`load_with`]; [`Error::Replay`] for a recording that can't be played here.
    pub fn open(source: &std::ffi::OsStr, allow_outside: bool) -> Result<Session, Error> {
        let options = LoadOptions { allow_outside, ..LoadOptions::default() };
        match load_with(source, &options) {
            Err(Error::File { path, why: FileFault::Packed(Packed::Replay) }) => {
                let replay = Replay::from_bytes(&read_file(&path, REPLAY_MAX_BYTES)?)?;
                let film = replayed(&replay)?;
                let mut session =
                    Session::new(source, Loaded::without_text(replay.scenario()?), allow_outside);
                (session.seed, session.episode) = (replay.seed, replay.index);
                session.played = Some(said(&session.episode_of(film, "")));
                Ok(session)
            }
            loaded => {
                let mut session = Session::new(source, loaded?, allow_outside);
                session.played = session.play().ok().map(|reply| said(&reply));
                Ok(session)
            }
        }
    }

    fn new(source: &std::ffi::OsStr, loaded: Loaded, allow_outside: bool) -> Session {
        // A compiled scenario and a recording have no text to edit.
        let has_text = loaded.sources.iter().next().is_some();
        let path = (has_text && Path::new(source).is_file()).then(|| PathBuf::from(source));
        let text = loaded.sources.iter().next().map_or("", |(_, file)| &*file.text).to_owned();
        let name = source.to_string_lossy().into_owned();
        let watcher = Watcher::new(&loaded.inputs);
        let nothing: Arc<str> = Arc::from("");
        let mut session = Session {
            source: name,
            path,
            allow_outside,
            text,
            loaded,
            params: BTreeMap::new(),
            seed: 0,
            episode: 0,
            agent: Agent::Bot,
            watcher,
            live: None,
            opened: nothing.clone(),
            checked: nothing,
            played: None,
        };
        session.opened = said(&session.opening());
        session.checked = said(&session.checked(&Ok(())));
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
                    let present = [&self.opened, &self.checked].into_iter().chain(&self.played);
                    // A page that has gone needs no answer.
                    let _ = answer.send(present.cloned().collect());
                }
                Ok(Command::Request(request)) => self.meet(request, pages),
                Ok(Command::Nonsense(why)) => {
                    tell(pages, &Reply::Refused { message: format!("not a request: {why}") });
                }
                Err(TryRecvError::Empty) => {
                    self.go_on(pages);
                    if self.watcher.changed(WAIT) {
                        self.reload(pages);
                    }
                }
                Err(TryRecvError::Disconnected) => return,
            }
        }
    }

    fn meet(&mut self, request: Request, pages: &broadcast::Sender<Arc<str>>) {
        let refuse = |message: String| tell(pages, &Reply::Refused { message });
        match request {
            Request::Text { text } => self.take(text, pages),
            Request::Save => match &self.path {
                Some(path) => match write(path, self.text.as_bytes()) {
                    Ok(()) => tell(pages, &Reply::Saved),
                    Err(why) => refuse(why.to_string()),
                },
                None => refuse(format!("`{}` is a scenario of the library", self.source)),
            },
            Request::Play { seed, episode, agent } => match Agent::from_name(&agent) {
                Some(agent) => {
                    (self.seed, self.episode, self.agent) = (seed, episode, agent);
                    self.show(pages);
                }
                None => refuse(format!("no agent `{agent}`")),
            },
            Request::Begin { side } => match self.begin(team(side)) {
                Ok(live) => {
                    tell(pages, &Reply::Step { scenes: live.film.scenes.clone() });
                    self.live = Some(live);
                }
                Err(why) => refuse(why),
            },
            Request::Hold { keys } => {
                if let Some(live) = &mut self.live {
                    live.hold(keys);
                }
            }
            Request::Stop => self.end(pages),
            Request::Bind { params } => {
                self.params = params;
                self.checked = said(&self.checked(&Ok(())));
                let _ = pages.send(self.checked.clone());
                self.show(pages);
            }
            Request::Move { player, to } => match self.dragged(player, to) {
                Ok(text) => {
                    self.take(text, pages);
                    let _ = pages.send(self.opened.clone());
                }
                Err(why) => refuse(why),
            },
            Request::Cloud { count } => match self.cloud(count.min(DRAWS_MAX)) {
                Ok(reply) => tell(pages, &reply),
                Err(why) => refuse(why.to_string()),
            },
            Request::Summary { episodes } => match self.summary(episodes.min(EPISODES_MAX)) {
                Ok(reply) => tell(pages, &reply),
                Err(why) => refuse(why.to_string()),
            },
        }
    }

    fn begin(&self, side: crate::scenario::Team) -> Result<LiveMatch, String> {
        let environment = Environment::new(self.loaded.scenario.clone(), self.environment())
            .map_err(|why| Error::Environment(why).to_string())?;
        let policy = ReadyMade::new(self.agent);
        LiveMatch::begin(environment, (self.seed, self.episode), policy, side)
    }

    /// Plays the next step of a person's match when it is due.
    fn go_on(&mut self, pages: &broadcast::Sender<Arc<str>>) {
        let Some(live) = self.live.as_mut().filter(|live| live.is_due()) else { return };
        let before = live.film.scenes.len();
        let played = live.step();
        let scenes = live.film.scenes.get(before..).unwrap_or_default().to_vec();
        tell(pages, &Reply::Step { scenes });
        match played {
            Ok(true) if live.film.length() < STEPS_MAX => {}
            Ok(_) => self.end(pages),
            Err(why) => {
                self.live = None;
                tell(pages, &Reply::Refused { message: why.to_string() });
            }
        }
    }

    /// Ends a person's match: from now on it can be watched like any other.
    fn end(&mut self, pages: &broadcast::Sender<Arc<str>>) {
        let Some(live) = self.live.take() else { return };
        let played = said(&self.episode_of(live.film, "you"));
        let _ = pages.send(played.clone());
        self.played = Some(played);
    }

    /// Reads the file again.
    fn reload(&mut self, pages: &broadcast::Sender<Arc<str>>) {
        let Some(path) = self.path.clone() else { return };
        let text =
            read_file(&path, SOURCE_MAX_BYTES).ok().and_then(|bytes| String::from_utf8(bytes).ok());
        let Some(text) = text else { return };
        let is_new = text != self.text;
        self.take(text, pages);
        if is_new {
            self.opened = said(&self.opening());
            let _ = pages.send(self.opened.clone());
        }
    }

    /// Takes another text: checks it, and plays it if it is sound. Otherwise the last good one
    /// stays.
    fn take(&mut self, text: String, pages: &broadcast::Sender<Arc<str>>) {
        let options = LoadOptions { allow_outside: self.allow_outside, ..LoadOptions::default() };
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
        let is_sound = result.is_ok();
        self.checked = said(&self.checked(&result));
        self.opened = said(&self.opening());
        let _ = pages.send(self.checked.clone());
        if is_sound {
            self.show(pages);
        }
    }

    /// The text with a player or the ball put elsewhere.
    fn dragged(&self, player: Option<Id>, to: [f64; 2]) -> Result<String, String> {
        if to.iter().any(|metres| !metres.is_finite()) {
            return Err("a place is two numbers".to_owned());
        }
        let elsewhere = || "this place isn't written in this file".to_owned();
        let Some(id) = player else {
            let statement = self.text.find("ball at ").ok_or_else(elsewhere)?;
            return moved(&self.text, statement, to, false);
        };
        let of_team = |slot: &&crate::scenario::PlayerSlot| slot.team == team(id.team);
        let slots = &self.loaded.scenario.players;
        let slot = slots.iter().filter(of_team).nth(usize::from(id.slot)).ok_or_else(elsewhere)?;
        let at = slots.iter().position(|other| std::ptr::eq(other, slot)).ok_or_else(elsewhere)?;
        let span = self.loaded.origins.players.get(at).copied().ok_or_else(elsewhere)?;
        let (sources, main) = (&self.loaded.sources, self.loaded.sources.iter().next());
        let is_here =
            main.is_some_and(|(file, _)| file == span.file) && !sources.text(span).is_empty();
        // A text that has changed since the last good one has its statements elsewhere.
        let same = main.is_some_and(|(_, source)| *source.text == *self.text);
        if !is_here || !same {
            return Err(elsewhere());
        }
        moved(&self.text, span.start as usize, to, slot.team == crate::scenario::Team::Right)
    }

    /// Plays the episode and shows it.
    fn show(&mut self, pages: &broadcast::Sender<Arc<str>>) {
        match self.play() {
            Ok(reply) => {
                let played = said(&reply);
                let _ = pages.send(played.clone());
                self.played = Some(played);
            }
            Err(why) => tell(pages, &Reply::Refused { message: why.to_string() }),
        }
    }

    fn opening(&self) -> Reply {
        Reply::Opened(OpenReply {
            source: self.source.clone(),
            is_file: self.path.is_some(),
            text: self.text.clone(),
            agents: Agent::NAMED.iter().map(|(name, _)| *name).collect(),
        })
    }

    fn checked(&self, result: &Result<(), Error>) -> Reply {
        let (problems, fault) = match result {
            Ok(()) => (diagnostics(&self.loaded.warnings, &self.loaded.sources), None),
            Err(Error::Compile(failure)) => {
                (diagnostics(&failure.problems, &failure.sources), None)
            }
            Err(other) => (Vec::new(), Some(other.to_string())),
        };
        let scenario = &self.loaded.scenario;
        let values = self.bindings().0;
        let params = scenario.params.iter().zip(values).map(|(param, value)| ParamControl {
            name: param.name.clone(),
            doc: param.doc.clone(),
            value,
            shown: param.show(value),
            range: param.range,
            choices: param.choices.clone(),
            values: param.values.clone(),
            kind: match param.ty {
                Type::Bool => "bool",
                Type::Int => "integer",
                _ => "number",
            },
        });
        Reply::Checked(CheckReply {
            problems,
            fault,
            name: scenario.name.clone(),
            title: scenario.title().to_owned(),
            params: params.collect(),
        })
    }

    /// The parameters' values: those that were set, within their ranges.
    fn bindings(&self) -> Bindings {
        let value = |param: &crate::scenario::Param| {
            let set = self.params.get(&param.name).copied().filter(|value| value.is_finite());
            match (set, param.range) {
                (Some(value), Some((low, high))) => value.clamp(low, high),
                (Some(value), None) => value,
                (None, _) => param.default,
            }
        };
        Bindings(self.loaded.scenario.params.iter().map(value).collect())
    }

    fn environment(&self) -> EnvironmentOptions {
        EnvironmentOptions { bindings: Some(self.bindings()), ..EnvironmentOptions::default() }
    }

    fn play(&self) -> Result<Reply, Error> {
        let scenario = &self.loaded.scenario;
        let is_endless = scenario.endings.list.is_empty() && scenario.start.limit.is_none();
        let options = FilmOptions {
            seed: self.seed,
            episode: self.episode,
            agent: self.agent,
            environment: self.environment(),
            until_step: is_endless.then_some(STEPS_MAX),
        };
        let agent = Agent::NAMED.iter().find(|(_, agent)| *agent == self.agent);
        let film = film(scenario, &options)?;
        Ok(self.episode_of(film, agent.map_or("", |(name, _)| name)))
    }

    fn episode_of(&self, film: Film, agent: &'static str) -> Reply {
        let events = film.events.iter().map(|(at, event)| happened(&film, *at, event)).collect();
        let verdict = film.outcome.as_ref().and_then(|outcome| outcome.verdict);
        Reply::Episode(Box::new(Episode {
            seed: self.seed,
            episode: self.episode,
            agent,
            names: film.names.to_vec(),
            events,
            outcome: film.outcome.as_ref().map(|outcome| outcome.label.to_string()),
            success: verdict.map(|verdict| verdict == Verdict::Success),
            scenes: film.scenes,
        }))
    }

    fn cloud(&self, count: u32) -> Result<Reply, Error> {
        let mut environment = Environment::new(self.loaded.scenario.clone(), self.environment())
            .map_err(Error::Environment)?;
        let (mut starts, mut scene) = (Vec::new(), Scene::default());
        for episode in 0..u64::from(count) {
            environment
                .reset(Some(self.seed), Some(episode))
                .map_err(|why| Error::Episode(Box::new(why.into())))?;
            of_match(environment.state(), &mut scene);
            let [x, y, _] = scene.ball.pos;
            let players = scene.players.iter().map(|player| player.pos);
            starts.push(std::iter::once([x, y]).chain(players).collect());
        }
        Ok(Reply::Cloud { starts })
    }

    fn summary(&self, episodes: u32) -> Result<Reply, Error> {
        let options = RunOptions {
            episodes: 0..u64::from(episodes),
            seed: self.seed,
            agent: self.agent,
            threads: 1,
            environment: self.environment(),
        };
        let summary = run(&self.loaded.scenario, &options, |_| {})?;
        Ok(Reply::Summary(SummaryReply {
            episodes,
            outcomes: summary.outcomes.into_iter().map(|(name, _, count)| (name, count)).collect(),
            mean_return: summary.mean_return,
            score: summary.score,
            terms: summary.terms,
            records: summary.records,
        }))
    }
}

fn happened(film: &Film, at: usize, event: &crate::engine::state::event::Event) -> Happened {
    let name = match event.qualifier {
        Some(qualifier) => format!("{} {}", event.kind.name(), qualifier.name()),
        None => event.kind.name().to_owned(),
    };
    Happened {
        at,
        name,
        by: event.by.and_then(|by| film.names.get(by.index()).cloned()),
        team: event.team.or_else(|| event.by.map(PlayerId::team)).map(crate::scenario::Team::name),
    }
}

fn said(reply: &Reply) -> Arc<str> {
    serde_json::to_string(reply).unwrap_or_default().into()
}

fn tell(pages: &broadcast::Sender<Arc<str>>, reply: &Reply) {
    // Without a page there is nobody to tell.
    let _ = pages.send(said(reply));
}
