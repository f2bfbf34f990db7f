//! The functions of the interface, and all other functions that scripts can call.

use super::super::budget::{Failable, count_bytes};
use super::convert::{to_number, type_words};
use super::{Ctx, Point, SeenBall, SeenEvent, SeenPlayer, SeenTeam, ShownState, Vector};
use crate::judge::machine;
use crate::judge::view::PlayerView;
use rhai::{Array, Dynamic, Engine, NativeCallContext};
use setpiece_scenario::EventFilter;
use setpiece_scenario::pitch::{X_SCALE_M, Y_SCALE_M};
use setpiece_scenario::vocabulary::{EventKind, Qualifier};

/// A function of the interface.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Function {
    /// Its name.
    pub(crate) name: &'static str,
    /// How many arguments it takes.
    pub(crate) takes: &'static [usize],
    /// How to call it, and what it returns.
    pub(crate) about: &'static str,
}

const OWN: &[Function] = &[
    own("random", &[1], "ctx.random(): a number in 0..1, from the episode's seed"),
    own(
        "distance",
        &[2],
        "distance(a, b): metres along the ground, between players, points and the ball",
    ),
    own("grf_distance", &[2], "grf_distance(a, b): in normalised units"),
    own("angle", &[2], "angle(a, b): the heading from a to b in the reader's frame, radians"),
    own("nearest", &[2], "nearest(players, to): the player nearest to a place, or ()"),
    own("pressed", &[2], "pressed(player, within): whether an opponent is within this many metres"),
    own("speed", &[1], "speed(x): of a player or the ball, m/s"),
    own(
        "point",
        &[3],
        "now.point(x, y): a place from normalised coordinates of the reader's frame",
    ),
    own(
        "count",
        &[2, 3],
        "count(events, kind), count(events, kind, team): the number of events of a kind, \"shot\" or \"pass completed\"; team is \"us\" or \"them\"",
    ),
    own("at", &[2], "table.at(place): the table's number in the cell where the place lies"),
    own("linear", &[2], "table.linear(place): linear between the centres of the table's cells"),
    own("clamp", &[3], "clamp(x, low, high): x limited to low..high"),
    own("smoothstep", &[3], "smoothstep(low, high, x): 0 below low, 1 above high, smooth between"),
    own("print", &[1], "print(x): writes a value into the log"),
    own("debug", &[1], "debug(x): writes a value into the log, as code shows it"),
    own("pow", &[2], "pow(x, y): x to the power y"),
];

const fn own(name: &'static str, takes: &'static [usize], about: &'static str) -> Function {
    Function { name, takes, about }
}

/// A function of the interface, by its name.
pub(crate) fn function(name: &str) -> Option<&'static Function> {
    OWN.iter().find(|function| function.name == name)
}

/// Rhai's own functions, from the packages that scripts have.
const RHAI: &[&str] = &[
    "E",
    "PI",
    "abs",
    "acos",
    "acosh",
    "all",
    "append",
    "asin",
    "asinh",
    "atan",
    "atan2",
    "atanh",
    "bits",
    "bytes",
    "call",
    "ceiling",
    "chars",
    "chop",
    "clear",
    "concat",
    "contains",
    "cos",
    "cosh",
    "crop",
    "curry",
    "dedup",
    "drain",
    "end",
    "ends_with",
    "exp",
    "extract",
    "fill_with",
    "filter",
    "find",
    "find_map",
    "floor",
    "for_each",
    "fraction",
    "get",
    "get_bit",
    "get_bits",
    "hypot",
    "index_of",
    "insert",
    "int",
    "is_def_fn",
    "is_def_var",
    "is_empty",
    "is_even",
    "is_exclusive",
    "is_finite",
    "is_inclusive",
    "is_infinite",
    "is_nan",
    "is_odd",
    "is_shared",
    "is_zero",
    "keys",
    "len",
    "ln",
    "log",
    "log10",
    "make_lower",
    "make_upper",
    "map",
    "max",
    "min",
    "mixin",
    "order",
    "order_by",
    "order_desc",
    "pad",
    "parse_float",
    "parse_int",
    "pop",
    "push",
    "range",
    "reduce",
    "reduce_rev",
    "remove",
    "replace",
    "retain",
    "reverse",
    "round",
    "rsplit",
    "set",
    "set_bit",
    "set_bits",
    "shift",
    "sign",
    "sin",
    "sinh",
    "some",
    "sort",
    "sort_by",
    "sort_desc",
    "splice",
    "split",
    "split_rev",
    "sqrt",
    "start",
    "starts_with",
    "sub_string",
    "tan",
    "tanh",
    "to_binary",
    "to_chars",
    "to_debug",
    "to_degrees",
    "to_float",
    "to_hex",
    "to_int",
    "to_json",
    "to_lower",
    "to_octal",
    "to_radians",
    "to_string",
    "to_upper",
    "trim",
    "truncate",
    "type_of",
    "values",
    "zip",
    "Fn",
];

/// The names of every function that a script can call.
pub fn functions() -> impl Iterator<Item = &'static str> {
    OWN.iter().map(|function| function.name).chain(RHAI.iter().copied())
}

/// The functions of the interface: the name, and how to call it.
pub fn interface() -> impl Iterator<Item = (&'static str, &'static str)> {
    OWN.iter().map(|function| (function.name, function.about))
}

/// Bytes that reading one element of a list counts as.
const ELEMENT_BYTES: usize = 64;

pub(super) fn register(engine: &mut Engine) {
    engine.register_fn("random", |ctx: &mut Ctx| {
        let mut random =
            ctx.0.scene.random.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
        random.unit_f64()
    });
    between(engine, "distance", apart_m);
    between(engine, "grf_distance", |a, b| {
        libm::hypot(
            (a.metres[0] - b.metres[0]) / X_SCALE_M,
            (a.metres[1] - b.metres[1]) / Y_SCALE_M,
        )
    });
    between(engine, "angle", |a, b| {
        libm::atan2(a.side * (b.metres[1] - a.metres[1]), a.side * (b.metres[0] - a.metres[0]))
    });
    engine.register_fn("nearest", nearest);
    engine.register_fn("pressed", |player: SeenPlayer, within: f64| {
        player.nearest_opponent_m() < within
    });
    engine.register_fn("pressed", |player: SeenPlayer, within: i64| {
        player.nearest_opponent_m() < within as f64
    });
    engine.register_fn("speed", |player: SeenPlayer| {
        let [x, y] = player.view().vel.map(f64::from);
        libm::hypot(x, y)
    });
    engine.register_fn("speed", |ball: SeenBall| {
        let [x, y, z] = ball.0.view().ball_vel.map(f64::from);
        libm::sqrt(x * x + y * y + z * z)
    });
    engine.register_fn("point", |now: &mut ShownState, x: f64, y: f64| now.normalised(x, y));
    engine.register_fn(
        "point",
        |now: &mut ShownState, x: Dynamic, y: Dynamic| -> Failable<Point> {
            Ok(now.normalised(to_number(&x)?, to_number(&y)?))
        },
    );
    engine.register_fn("count", |context: NativeCallContext, events: &mut Array, words: &str| {
        count(&context, events, words, None)
    });
    engine.register_fn(
        "count",
        |context: NativeCallContext, events: &mut Array, words: &str, team: &str| {
            count(&context, events, words, Some(team))
        },
    );
    register_equality(engine);
}

/// Registers a function of two places.
fn between(engine: &mut Engine, name: &str, f: fn(Point, Point) -> f64) {
    fn from<A: Placed>(engine: &mut Engine, name: &str, f: fn(Point, Point) -> f64) {
        engine.register_fn(name, move |a: &mut A, b: Point| f(a.place(), b));
        engine.register_fn(name, move |a: &mut A, b: SeenPlayer| f(a.place(), b.place()));
        engine.register_fn(name, move |a: &mut A, b: SeenBall| f(a.place(), b.place()));
        engine.register_fn(name, move |a: &mut A, b: SeenEvent| f(a.place(), b.place()));
    }
    from::<Point>(engine, name, f);
    from::<SeenPlayer>(engine, name, f);
    from::<SeenBall>(engine, name, f);
    from::<SeenEvent>(engine, name, f);
    // Anything else gets an error about what was expected. Rhai tries this form last.
    engine.register_fn(name, move |a: Dynamic, b: Dynamic| -> Failable<f64> {
        Ok(f(place(&a)?, place(&b)?))
    });
}

/// Values are equal if they are the same thing, whenever they were read.
fn register_equality(engine: &mut Engine) {
    engine.register_fn("==", |a: SeenPlayer, b: SeenPlayer| a.1 == b.1);
    engine.register_fn("!=", |a: SeenPlayer, b: SeenPlayer| a.1 != b.1);
    engine.register_fn("==", |_: SeenPlayer, (): ()| false);
    engine.register_fn("!=", |_: SeenPlayer, (): ()| true);
    engine.register_fn("==", |(): (), _: SeenPlayer| false);
    engine.register_fn("!=", |(): (), _: SeenPlayer| true);
    engine.register_fn("==", |a: SeenTeam, b: SeenTeam| a.1 == b.1);
    engine.register_fn("!=", |a: SeenTeam, b: SeenTeam| a.1 != b.1);
    engine.register_fn("==", |word: &str, team: SeenTeam| team.is_called(word));
    engine.register_fn("!=", |word: &str, team: SeenTeam| !team.is_called(word));
    engine.register_fn("==", |team: SeenTeam, word: &str| team.is_called(word));
    engine.register_fn("!=", |team: SeenTeam, word: &str| !team.is_called(word));
    engine.register_fn("==", |a: Point, b: Point| a == b);
    engine.register_fn("!=", |a: Point, b: Point| a != b);
    engine.register_fn("==", |a: Vector, b: Vector| a == b);
    engine.register_fn("!=", |a: Vector, b: Vector| a != b);
}

impl SeenTeam {
    fn is_called(&self, word: &str) -> bool {
        word == if self.1 == self.0.perspective.us { "us" } else { "them" }
    }
}

impl SeenPlayer {
    /// What is seen of them: who is off the pitch is nowhere and has no speed, as in programs.
    pub(super) fn view(&self) -> PlayerView {
        const NONE: f32 = f32::NAN;
        let seen = *self.0.player(self.1);
        if seen.active {
            return seen;
        }
        PlayerView {
            pos: [NONE; 2],
            vel: [NONE; 2],
            heading_rad: NONE,
            fatigue: NONE,
            sprinting: false,
            dribbling: false,
            controlled: false,
            ..seen
        }
    }

    pub(super) fn point(&self) -> Point {
        self.0.point(self.view().pos)
    }

    fn nearest_opponent_m(&self) -> f64 {
        let at = self.point();
        let opponents = self.0.view().on_pitch(Some(self.1.team().other()));
        opponents
            .map(|(_, other)| apart_m(at, self.0.point(other.pos)))
            .fold(f64::INFINITY, |a, b| if b < a { b } else { a })
    }
}

fn apart_m(a: Point, b: Point) -> f64 {
    libm::hypot(a.metres[0] - b.metres[0], a.metres[1] - b.metres[1])
}

/// Values that have a place.
trait Placed: Clone + Send + Sync + 'static {
    fn place(&self) -> Point;
}

impl Placed for Point {
    fn place(&self) -> Point {
        *self
    }
}

impl Placed for SeenPlayer {
    fn place(&self) -> Point {
        self.point()
    }
}

impl Placed for SeenBall {
    fn place(&self) -> Point {
        let [x, y, _] = self.0.view().ball;
        self.0.point([x, y])
    }
}

impl Placed for SeenEvent {
    fn place(&self) -> Point {
        self.0.point([self.1.at.x, self.1.at.y])
    }
}

/// The place of a player, the ball, an event or a point.
pub(super) fn place(of: &Dynamic) -> Failable<Point> {
    fn of_a<T: Placed>(of: &Dynamic) -> Option<Point> {
        of.read_lock::<T>().map(|it| it.place())
    }
    of_a::<Point>(of)
        .or_else(|| of_a::<SeenPlayer>(of))
        .or_else(|| of_a::<SeenBall>(of))
        .or_else(|| of_a::<SeenEvent>(of))
        .ok_or_else(|| {
            let found = if of.is_unit() { "nobody".to_owned() } else { type_words(of.type_name()) };
            format!("expected a player, a point or the ball, found {found}").into()
        })
}

/// Counts reading each element of a list.
fn look_at_each(context: &NativeCallContext, list: &Array) -> Failable<()> {
    count_bytes(ELEMENT_BYTES * list.len(), context.call_position())
}

#[allow(clippy::needless_pass_by_value, reason = "Rhai passes arguments by value")]
fn nearest(context: NativeCallContext, players: &mut Array, to: Dynamic) -> Failable<Dynamic> {
    look_at_each(&context, players)?;
    let to = place(&to)?;
    let mut best: Option<(f64, &Dynamic)> = None;
    for element in &*players {
        if let Some(player) = element.read_lock::<SeenPlayer>() {
            let apart = apart_m(player.point(), to);
            if best.is_none_or(|best| apart < best.0) {
                best = Some((apart, element));
            }
        }
    }
    Ok(best.map_or(Dynamic::UNIT, |(_, player)| player.clone()))
}

/// Counts matching events. `words` are a kind and optionally a qualifier; a kind alone means the
/// same as in the language.
fn count(
    context: &NativeCallContext,
    events: &Array,
    words: &str,
    team: Option<&str>,
) -> Failable<i64> {
    look_at_each(context, events)?;
    let (kind, qualifier) =
        words.split_once(' ').map_or((words, None), |(kind, word)| (kind, Some(word)));
    let Some(kind) = EventKind::from_name(kind) else { return Ok(0) };
    let qualifier = qualifier.map(Qualifier::from_name);
    if qualifier == Some(None) {
        return Ok(0);
    }
    let filter = EventFilter { kind, qualifier: qualifier.flatten(), by: None, to: None };
    let matching = events.iter().filter(|event| {
        event.read_lock::<SeenEvent>().is_some_and(|event| {
            let of_team = |word: &str| match event.1.team {
                None => false,
                Some(team) => word == if team == event.0.perspective.us { "us" } else { "them" },
            };
            machine::is_kind(&filter, &event.1) && team.is_none_or(of_team)
        })
    });
    Ok(matching.count() as i64)
}
