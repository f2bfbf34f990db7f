//! The process's one Rhai engine: what a script may use, and how much.

use super::budget::{BYTES_PER_OPERATION, OPERATIONS_MAX, Overspent, Why};
use super::{api, budget};
use rhai::packages::{
    ArithmeticPackage, BasicArrayPackage, BasicIteratorPackage, BasicMapPackage, BasicMathPackage,
    BasicStringPackage, LogicPackage, MoreStringPackage, Package,
};
use rhai::{
    AST, Array, Dynamic, Engine, EvalAltResult, FnPtr, ImmutableString, Map, OptimizationLevel,
    ParseError, ParseErrorType, Position,
};
use std::sync::OnceLock;

const CALL_LEVELS_MAX: usize = 24;
pub(super) const EXPRESSION_DEPTH_MAX: usize = 48;
const STRING_MAX: usize = 4_096;
pub(super) const ARRAY_MAX: usize = 4_096;
pub(super) const MAP_MAX: usize = 512;
/// Bytes for the steps that the memories of an episode's scripts may keep, out of the 64 MiB that
/// the documentation promises.
pub(super) const MEMORIES_BYTES_MAX: usize = 12 << 20;
/// Number of steps that each script may keep, however many scripts there are.
const SCENES_LEAST: usize = 8;
const VARIABLES_MAX: usize = 256;
const FUNCTIONS_MAX: usize = 256;

/// Keywords that would give access to the outside, or to more than the limits allow.
const DISABLED: &[&str] = &["eval", "import", "export", "print", "debug", "**", "**="];

/// The engine that runs scripts; built at its first use.
pub(super) fn engine() -> &'static Engine {
    static ENGINE: OnceLock<Engine> = OnceLock::new();
    ENGINE.get_or_init(|| {
        let mut engine = build();
        budget::register(&mut engine);
        budget::register_natives(&mut engine, &plain_engine());
        engine
    })
}

/// The engine that parses authors' scripts; its trees are complete.
fn reader() -> &'static Engine {
    static READER: OnceLock<Engine> = OnceLock::new();
    READER.get_or_init(|| {
        let mut engine = build();
        engine.set_optimization_level(OptimizationLevel::None);
        engine
    })
}

/// An engine with those parts of Rhai that scripts may use, unchanged.
pub(super) fn plain_engine() -> Engine {
    let mut engine = Engine::new_raw();
    Basics::new().register_into_engine(&mut engine);
    engine
}

/// Parses a script.
pub(super) fn read(source: &str) -> Result<AST, ParseError> {
    let ast = reader().compile(source)?;
    // A function with a reserved name would be called instead of the one that counts.
    let reserved = ast.iter_fn_def().find(|own| budget::RESERVED.contains(&own.name.as_str()));
    let refused = reserved
        .map(|own| (ParseErrorType::Reserved(own.name.to_string()), own.body.start_position()));
    refused.map_or(Ok(ast), |(why, position)| Err(ParseError(Box::new(why), position)))
}

rhai::def_package! {
    /// The parts of Rhai that scripts may use, as one module, so that one lookup finds a function.
    Basics(module) : ArithmeticPackage, LogicPackage, BasicMathPackage, BasicStringPackage,
        MoreStringPackage, BasicIteratorPackage, BasicArrayPackage, BasicMapPackage {}
}

fn build() -> Engine {
    let mut engine = plain_engine();
    register_maths(&mut engine);
    api::register(&mut engine);
    for word in DISABLED {
        engine.disable_symbol(*word);
    }
    engine.set_strict_variables(true);
    // Never higher: the optimiser would fold a call of `ctx.random()`.
    engine.set_optimization_level(OptimizationLevel::Simple);
    // Not Rhai's own limit: a reused machine continues its count, and a closure counts from 0.
    engine.on_progress(|_| (!budget::count_operations(1)).then_some(Dynamic::UNIT));
    engine.set_max_call_levels(CALL_LEVELS_MAX);
    engine.set_max_expr_depths(EXPRESSION_DEPTH_MAX, EXPRESSION_DEPTH_MAX);
    engine.set_max_string_size(STRING_MAX);
    engine.set_max_array_size(ARRAY_MAX);
    engine.set_max_map_size(MAP_MAX);
    engine.set_max_variables(VARIABLES_MAX);
    engine.set_max_functions(FUNCTIONS_MAX);
    engine.set_max_modules(0);
    engine
}

/// Replaces the platform's functions by libm's; their last bits differ.
fn register_maths(engine: &mut Engine) {
    engine
        .register_fn("sin", libm::sin)
        .register_fn("cos", libm::cos)
        .register_fn("tan", libm::tan);
    engine
        .register_fn("asin", libm::asin)
        .register_fn("acos", libm::acos)
        .register_fn("atan", libm::atan);
    engine
        .register_fn("sinh", libm::sinh)
        .register_fn("cosh", libm::cosh)
        .register_fn("tanh", libm::tanh);
    engine
        .register_fn("asinh", libm::asinh)
        .register_fn("acosh", libm::acosh)
        .register_fn("atanh", libm::atanh);
    engine
        .register_fn("atan", libm::atan2)
        .register_fn("atan2", libm::atan2)
        .register_fn("hypot", libm::hypot);
    engine.register_fn("exp", libm::exp).register_fn("ln", libm::log).register_fn("log", libm::log);
    engine.register_fn("log", |x: f64, base: f64| libm::log(x) / libm::log(base));
    engine.register_fn("sqrt", libm::sqrt).register_fn("pow", libm::pow);
    engine.register_fn("pow", |x: f64, y: i64| libm::pow(x, y as f64));
    engine.register_fn("pow", |x: i64, y: i64| libm::pow(x as f64, y as f64));
    engine.register_fn("pow", |x: i64, y: f64| libm::pow(x as f64, y));
    engine
        .register_fn("exp", |x: i64| libm::exp(x as f64))
        .register_fn("sqrt", |x: i64| libm::sqrt(x as f64));
    // Integers are accepted too; Rhai tries the general form last.
    engine.register_fn("clamp", clamp);
    engine.register_fn(
        "clamp",
        |x: Dynamic, low: Dynamic, high: Dynamic| -> Result<f64, Box<EvalAltResult>> {
            Ok(clamp(to_number(&x)?, to_number(&low)?, to_number(&high)?))
        },
    );
    engine.register_fn("smoothstep", smoothstep);
    engine.register_fn(
        "smoothstep",
        |low: Dynamic, high: Dynamic, x: Dynamic| -> Result<f64, Box<EvalAltResult>> {
            Ok(smoothstep(to_number(&low)?, to_number(&high)?, to_number(&x)?))
        },
    );
}

fn clamp(x: f64, low: f64, high: f64) -> f64 {
    if x < low {
        low
    } else if x > high {
        high
    } else {
        x
    }
}

fn smoothstep(low: f64, high: f64, x: f64) -> f64 {
    let t = if x <= low {
        0.0
    } else if x >= high {
        1.0
    } else {
        (x - low) / (high - low)
    };
    t * t * (3.0 - 2.0 * t)
}

/// Converts an integer or float to a float.
pub(super) fn to_number(value: &Dynamic) -> Result<f64, Box<EvalAltResult>> {
    match (value.as_float(), value.as_int()) {
        (Ok(number), _) => Ok(number),
        (_, Ok(whole)) => Ok(whole as f64),
        _ => Err(format!("expected a number, found {}", type_words(value.type_name())).into()),
    }
}

/// The total content of a script's memory.
#[derive(Default)]
struct MemorySize {
    elements: usize,
    entries: usize,
    bytes: usize,
    levels: usize,
    scenes: Vec<*const api::HookScene>,
}

impl MemorySize {
    /// Adds a value; stops if the total is too large.
    fn add(&mut self, value: &Dynamic, level: usize) -> Result<(), String> {
        self.levels = self.levels.max(level);
        if let Some(map) = value.read_lock::<Map>() {
            self.entries += map.len();
            self.within()?;
            map.values().try_for_each(|value| self.add(value, level + 1))
        } else if let Some(array) = value.read_lock::<Array>() {
            self.elements += array.len();
            self.within()?;
            array.iter().try_for_each(|value| self.add(value, level + 1))
        } else if let Some(function) = value.read_lock::<FnPtr>() {
            self.elements += function.curry().len();
            self.within()?;
            function.iter_curry().try_for_each(|value| self.add(value, level + 1))
        } else {
            self.bytes += value.read_lock::<ImmutableString>().map_or(0, |text| text.len());
            if value.is_variant() {
                self.scenes.extend(api::scene_of(value));
            }
            self.within()
        }
    }

    fn within(&self) -> Result<(), String> {
        for (found, max, noun) in [
            (self.entries, MAP_MAX, "entries of maps"),
            (self.elements, ARRAY_MAX, "elements of arrays"),
            (self.bytes, STRING_MAX, "bytes of strings"),
            (self.levels, EXPRESSION_DEPTH_MAX, "levels"),
        ] {
            if found > max {
                return Err(format!("`this` holds more than {max} {noun}"));
            }
        }
        Ok(())
    }

    /// Checks that the steps in memory aren't too many.
    fn scenes_within(mut self, bytes: usize) -> Result<(), String> {
        self.scenes.sort_unstable();
        self.scenes.dedup();
        let max = (bytes / size_of::<api::HookScene>()).max(SCENES_LEAST);
        if self.scenes.len() > max {
            return Err(format!(
                "`this` holds what was shown in more than {max} steps: keep the numbers that are needed of it"
            ));
        }
        Ok(())
    }
}

/// Checks that a script's memory is within the bounds of any value. Rhai checks only values that
/// are passed on, not those that grow in place. A value that was shown to the script keeps its
/// whole step, which counts towards these bytes.
pub(super) fn check_size(memory: &Dynamic, bytes: usize) -> Result<(), String> {
    let mut held = MemorySize::default();
    held.add(memory, 0)?;
    held.scenes_within(bytes)
}

/// Line and column of a position, if it has any.
pub(super) fn line_column(position: Position) -> Option<(usize, usize)> {
    position.line().map(|line| (line, position.position().unwrap_or(1)))
}

/// Where and why a call failed.
pub(super) fn explain(error: Box<EvalAltResult>) -> (Option<(usize, usize)>, String) {
    let mut error = error;
    let mut place = None;
    // The innermost place is the line that failed.
    loop {
        let here = line_column(error.position());
        match *error {
            EvalAltResult::ErrorInFunctionCall(_, _, inner, _) => {
                place = here.or(place);
                error = inner;
            }
            other => {
                let known = match &other {
                    EvalAltResult::ErrorTerminated(token, _) => {
                        token.read_lock::<Overspent>().and_then(|over| over.place)
                    }
                    _ => None,
                };
                let place = known.or(here).or(place);
                return (place, runtime_message(other));
            }
        }
    }
}

/// Two of a script's functions use one variable at once.
const RACE: &str =
    "a closure reads the variable that its chain begins with: put one of both into a `let` before";

/// Rhai reports what is too large; this adds which limit it is.
fn words_of_size(words: &str) -> String {
    if words.starts_with("a value") { words.to_owned() } else { format!("{words} too large") }
}

fn runtime_message(error: EvalAltResult) -> String {
    match error {
        EvalAltResult::ErrorTerminated(token, _) if token.is::<Overspent>() => {
            match token.cast::<Overspent>().why {
                Why::Size => format!(
                    "more than {OPERATIONS_MAX} operations in one call: work on values counts by their size, \
                 {BYTES_PER_OPERATION} bytes to an operation"
                ),
                Why::Changing => RACE.to_owned(),
            }
        }
        EvalAltResult::ErrorTerminated(..) => {
            format!("more than {OPERATIONS_MAX} operations in one call: a loop doesn't end")
        }
        EvalAltResult::ErrorStackOverflow(_) => format!("calls nest deeper than {CALL_LEVELS_MAX}"),
        EvalAltResult::ErrorDataRace(..) => RACE.to_owned(),
        EvalAltResult::ErrorDataTooLarge(words, _) => lower_first(&words_of_size(&words)),
        EvalAltResult::ErrorDotExpr(message, _) if !message.is_empty() => lower_first(&message),
        EvalAltResult::ErrorRuntime(value, _) => format!("the script threw `{value}`"),
        EvalAltResult::ErrorPropertyNotFound(name, _) => format!("unknown property `{name}`"),
        EvalAltResult::ErrorVariableNotFound(name, _) => format!("unknown variable `{name}`"),
        EvalAltResult::ErrorFunctionNotFound(signature, _) => {
            format!("no function `{}`", tidy(&signature))
        }
        mut other => {
            let _ = other.take_position();
            lower_first(&other.to_string())
        }
    }
}

/// What is wrong with a script's text, in one clause.
pub(super) fn parse_message(error: &ParseError) -> String {
    match error.err_type() {
        ParseErrorType::VariableUndefined(name) => format!("unknown variable `{name}`"),
        ParseErrorType::Reserved(word)
            if DISABLED.iter().chain(budget::RESERVED).any(|known| known == word) =>
        {
            format!("`{word}` is not available in a script")
        }
        other => lower_first(&other.to_string()),
    }
}

/// Rhai's name of a type in plain words.
pub(super) fn type_words(name: &str) -> String {
    match name {
        "()" => "nothing".to_owned(),
        "i64" => "a whole number".to_owned(),
        "f64" => "a number".to_owned(),
        "string" | "map" | "array" | "bool" | "char" => format!("a {name}"),
        other => match api::type_name(other) {
            Some(name) => format!(
                "{} {name}",
                if name.starts_with(['a', 'e', 'i', 'o', 'u']) { "an" } else { "a" }
            ),
            None => format!("`{}`", tidy(other)),
        },
    }
}

/// Drops the paths of Rust types from Rhai's words.
fn tidy(words: &str) -> String {
    let short = words.replace("rhai::types::immutable_string::", "").replace("alloc::vec::", "");
    short
        .split_inclusive([' ', ',', '('])
        .map(|part| part.rsplit("::").next().unwrap_or(part))
        .collect()
}

fn lower_first(text: &str) -> String {
    let mut chars = text.chars();
    chars.next().map_or_else(String::new, |first| first.to_lowercase().chain(chars).collect())
}
