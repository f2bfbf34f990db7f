//! What a hook can read: the language's properties, by the language's names, in the frame of the
//! judged side.
//!
//! The tables of this file and `vocabulary::PROPERTIES` are the whole interface. The getters are
//! registered from them, and a script's names are checked against them.

mod convert;
mod functions;
mod getters;
mod kept;
mod named;
mod table;

pub(super) use convert::{to_number, type_words};
pub(super) use functions::function;
pub use functions::{functions, interface};
pub(crate) use kept::Shelf;
pub(super) use kept::scene_of;
pub(crate) use named::EpisodeNames;
pub(super) use named::{NamedList, NamedProgram, SeenRegion, SeenTable, register_named};
pub(super) use table::elsewhere;
pub use table::{Member, Subject, members};

use crate::judge::script::budget::count_operations;
use crate::judge::view::{MatchView, PlayerView, player_index, team_of_number};
use crate::random::Stream;
use crate::state::PlayerId;
use crate::state::event::Event;
use rhai::{Array, Dynamic, Engine};
use setpiece_scenario::pitch::{X_SCALE_M, Y_SCALE_M};
use setpiece_scenario::vocabulary::{Team, Type};
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

/// A scenario's parameters as scripts see them.
pub type Params = Arc<rhai::Map>;

/// The data that the hooks of one step share.
#[derive(Debug)]
pub struct HookScene {
    now: MatchView,
    prev: MatchView,
    events: Vec<Event>,
    params: Params,
    /// What names stand for; none in a scene from a snapshot until its episode is read.
    episode: OnceLock<Arc<EpisodeNames>>,
    random: Mutex<Stream>,
    /// The episode's seed.
    pub seed: u64,
    /// The episode's index.
    pub index: u64,
}

impl HookScene {
    /// The scene of a step; `key` is the episode's seed and index.
    pub fn new(
        now: MatchView,
        prev: MatchView,
        events: &[Event],
        params: Params,
        random: Stream,
        key: (u64, u64),
    ) -> HookScene {
        HookScene {
            now,
            prev,
            events: events.to_vec(),
            params,
            episode: OnceLock::new(),
            random: Mutex::new(random),
            seed: key.0,
            index: key.1,
        }
    }

    /// The same scene in an episode with these names.
    #[must_use]
    pub(crate) fn in_episode(self, names: Arc<EpisodeNames>) -> HookScene {
        HookScene { episode: OnceLock::from(names), ..self }
    }

    /// The same scene with other names, for scripts that have changed.
    #[must_use]
    pub(crate) fn renamed(&self, names: Arc<EpisodeNames>) -> HookScene {
        self.followed_by(self.now, &self.prev, &self.events).in_episode(names)
    }

    /// Switches to another step.
    pub fn show(&mut self, now: MatchView, prev: &MatchView, events: &[Event]) {
        (self.now, self.prev) = (now, *prev);
        self.events.clear();
        self.events.extend_from_slice(events);
    }

    /// Creates a scene of another step that continues this one's random numbers.
    #[must_use]
    pub fn followed_by(&self, now: MatchView, prev: &MatchView, events: &[Event]) -> HookScene {
        let key = (self.seed, self.index);
        let scene = HookScene::new(now, *prev, events, self.params.clone(), self.random(), key);
        HookScene { episode: self.episode.clone(), ..scene }
    }

    /// The same scene with a behaviour's arguments in `ctx.params`.
    #[must_use]
    pub fn with_arguments(
        self: &Arc<HookScene>,
        perspective: Perspective,
        arguments: &[Argument<'_>],
    ) -> HookScene {
        let sight = ShownState::now(self, perspective, 0);
        let mut params = (*self.params).clone();
        params.extend(
            arguments.iter().map(|argument| (argument.name.into(), sight.argument(argument))),
        );
        let same = self.followed_by(self.now, &self.prev, &self.events);
        HookScene { params: Arc::new(params), ..same }
    }

    /// Continues the random numbers of another scene.
    pub fn take_random(&self, from: &HookScene) {
        *self.random.lock().unwrap_or_else(PoisonError::into_inner) = from.random();
    }

    /// The random stream as the hooks left it.
    pub fn random(&self) -> Stream {
        self.random.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }

    /// The step, counted from the episode's start.
    pub fn step(&self) -> u32 {
        self.now.step
    }
}

/// An argument of a behaviour that is a script.
#[derive(Clone, Copy, Debug)]
pub struct Argument<'a> {
    /// Its name.
    pub name: &'a str,
    /// Its type.
    pub ty: Type,
    /// Its value as programs write it; a point needs two numbers.
    pub values: [f64; 2],
}

/// The perspective of a hook's call.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Perspective {
    /// The side judged.
    pub us: Team,
    /// The agent's player, if on the pitch.
    pub me: Option<PlayerId>,
    /// The agent's index.
    pub agent: usize,
}

/// `now` or `prev`.
#[derive(Clone)]
pub(super) struct ShownState {
    scene: Arc<HookScene>,
    perspective: Perspective,
    /// Which script reads it.
    script: u32,
    past: bool,
}

/// `ctx`.
#[derive(Clone)]
pub(super) struct Ctx(ShownState);
/// The ball.
#[derive(Clone)]
pub(super) struct SeenBall(ShownState);
/// A player.
#[derive(Clone)]
pub(super) struct SeenPlayer(ShownState, PlayerId);
/// `us` or `them`.
#[derive(Clone)]
pub(super) struct SeenTeam(ShownState, Team);
/// The score.
#[derive(Clone)]
pub(super) struct SeenScore(ShownState);
/// An event.
#[derive(Clone)]
pub(super) struct SeenEvent(ShownState, Event);
/// A place; world metres, shown in the reader's frame.
#[derive(Clone, Copy, PartialEq)]
pub(super) struct Point {
    metres: [f64; 2],
    side: f64,
}
/// A velocity in m/s, or a place in metres from the centre spot; in the reader's frame.
#[derive(Clone, Copy, PartialEq)]
pub(super) struct Vector {
    own: [f64; 2],
}

impl ShownState {
    pub(super) fn now(scene: &Arc<HookScene>, perspective: Perspective, script: u32) -> ShownState {
        ShownState { scene: scene.clone(), perspective, script, past: false }
    }

    /// The state of the step before.
    pub(super) fn before(&self) -> ShownState {
        ShownState { past: true, ..self.clone() }
    }

    pub(super) fn ctx(&self) -> Ctx {
        Ctx(self.clone())
    }

    pub(super) fn scene(&self) -> &HookScene {
        &self.scene
    }

    /// The player that the hook is called for.
    pub(super) fn me(&self) -> Dynamic {
        self.somebody(self.perspective.me)
    }

    /// An argument as scripts see it: numbers in SI units.
    fn argument(&self, argument: &Argument<'_>) -> Dynamic {
        let [value, other] = argument.values;
        match argument.ty {
            Type::Bool => (value != 0.0).into(),
            Type::Int => Dynamic::from_int(value as i64),
            Type::Player => self.somebody(player_index(value).map(|index| PlayerId(index as u8))),
            Type::Team => team_of_number(value).map_or("none", Team::name).into(),
            Type::Point => Dynamic::from(Point { metres: [value, other], side: self.side() }),
            _ => value.into(),
        }
    }

    fn view(&self) -> &MatchView {
        if self.past { &self.scene.prev } else { &self.scene.now }
    }

    fn player(&self, id: PlayerId) -> &PlayerView {
        &self.view().players[id.index()]
    }

    fn side(&self) -> f64 {
        self.perspective.us.side()
    }

    fn point(&self, metres: [f32; 2]) -> Point {
        Point { metres: metres.map(f64::from), side: self.side() }
    }

    /// A place from normalised coordinates of the reader's frame.
    fn normalised(&self, x: f64, y: f64) -> Point {
        let side = self.side();
        Point { metres: [side * x * X_SCALE_M, side * y * Y_SCALE_M], side }
    }

    /// A team as seen from the judged side.
    fn team_word(&self, team: Option<Team>) -> Dynamic {
        match team {
            None => "none".into(),
            Some(team) if team == self.perspective.us => "us".into(),
            Some(_) => "them".into(),
        }
    }

    /// A player, or `()` for nobody.
    fn somebody(&self, id: Option<PlayerId>) -> Dynamic {
        id.map_or(Dynamic::UNIT, |id| Dynamic::from(SeenPlayer(self.clone(), id)))
    }

    fn players(&self, team: Option<Team>) -> Dynamic {
        let list: Array = self
            .view()
            .on_pitch(team)
            .map(|(id, _)| Dynamic::from(SeenPlayer(self.clone(), PlayerId(id as u8))))
            .collect();
        // Making the list is work. If no operations are left, the next one fails.
        count_operations(list.len() as u64 / 2);
        list.into()
    }
}

impl Point {
    /// Normalised, in the reader's frame.
    fn own(self) -> [f64; 2] {
        [self.side * self.metres[0] / X_SCALE_M, self.side * self.metres[1] / Y_SCALE_M]
    }

    /// Metres from the centre spot, in the reader's frame.
    fn own_metres(self) -> [f64; 2] {
        self.metres.map(|metres| self.side * metres)
    }
}

/// This step's events, as an array.
pub(super) fn events_of(now: &ShownState) -> Array {
    now.scene.events.iter().map(|event| Dynamic::from(SeenEvent(now.clone(), *event))).collect()
}

/// Gives every type that scripts see the name by which reports call it.
macro_rules! names_of_types {
    ($($of:ty: $name:literal),+ $(,)?) => {
        fn register_types(engine: &mut Engine) {
            $(engine.register_type_with_name::<$of>($name);)+
        }

        /// The name of a type of the interface, by its Rust name.
        pub(super) fn type_name(rust_name: &str) -> Option<&'static str> {
            $(if rust_name == std::any::type_name::<$of>() {
                return Some($name);
            })+
            None
        }
    };
}

names_of_types! {
    ShownState: "state of the match",
    Ctx: "context",
    SeenBall: "ball",
    SeenPlayer: "player",
    SeenTeam: "team",
    SeenScore: "score",
    SeenEvent: "event",
    Point: "point",
    Vector: "vector",
    SeenRegion: "region",
    SeenTable: "table",
}

/// Registers types, getters and functions.
pub(super) fn register(engine: &mut Engine) {
    register_types(engine);
    getters::register(engine);
    functions::register(engine);
}

/// Whether every name of the tables has its getter.
#[cfg(test)]
pub(super) fn getters_complete(member: &Member) -> bool {
    getters::is_registered(member.of, member.name)
}
