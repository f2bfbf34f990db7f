//! The process's one Rhai engine: what a script may use, and how much.

use super::api::to_number;
use super::limits::{
    ARRAY_MAX, CALL_LEVELS_MAX, DISABLED, EXPRESSION_DEPTH_MAX, IMPORT, MAP_MAX, PREFIX, STRING_MAX,
};
use super::{api, budget, print};
use rhai::packages::{
    ArithmeticPackage, BasicArrayPackage, BasicIteratorPackage, BasicMapPackage, BasicMathPackage,
    BasicStringPackage, LogicPackage, MoreStringPackage, Package,
};
use rhai::{
    AST, Array, Dynamic, Engine, EvalAltResult, FnPtr, ImmutableString, Map, OptimizationLevel,
    ParseError, ParseErrorType,
};
use std::sync::OnceLock;

/// Bytes for the steps that the memories of an episode's scripts may keep, out of the 64 MiB that
/// the documentation promises.
pub(super) const MEMORIES_BYTES_MAX: usize = 12 << 20;
/// Number of steps that each script may keep, however many scripts there are.
const SCENES_LEAST: usize = 8;
const VARIABLES_MAX: usize = 256;
const FUNCTIONS_MAX: usize = 256;

/// The engine that runs scripts; built at its first use.
pub(super) fn engine() -> &'static Engine {
    static ENGINE: OnceLock<Engine> = OnceLock::new();
    ENGINE.get_or_init(|| {
        let mut engine = build(DISABLED);
        budget::register(&mut engine);
        budget::register_natives(&mut engine, &plain_engine());
        engine
    })
}

/// The engine that parses authors' scripts; its trees are complete.
fn reader() -> &'static Engine {
    static READER: OnceLock<Engine> = OnceLock::new();
    READER.get_or_init(|| {
        let disabled: Vec<&str> = DISABLED.iter().copied().filter(|word| *word != IMPORT).collect();
        let mut engine = build(&disabled);
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

/// Parses a text, whatever its functions are called.
pub(super) fn parse(text: &str) -> Result<AST, ParseError> {
    reader().compile(text)
}

/// Parses a script or module of an author, which may import modules.
pub(super) fn read(source: &str) -> Result<AST, ParseError> {
    let ast = parse(source)?;
    // A function with a reserved name would be called instead of the one that counts, or of a
    // module's.
    let reserved = ast.iter_fn_def().find(|own| own.name.starts_with(PREFIX));
    let refused = reserved
        .map(|own| (ParseErrorType::Reserved(own.name.to_string()), own.body.start_position()));
    refused.map_or(Ok(ast), |(why, position)| Err(ParseError(Box::new(why), position)))
}

rhai::def_package! {
    /// The parts of Rhai that scripts may use, as one module, so that one lookup finds a function.
    Basics(module) : ArithmeticPackage, LogicPackage, BasicMathPackage, BasicStringPackage,
        MoreStringPackage, BasicIteratorPackage, BasicArrayPackage, BasicMapPackage {}
}

fn build(disabled: &[&str]) -> Engine {
    let mut engine = plain_engine();
    register_maths(&mut engine);
    api::register(&mut engine);
    api::register_named(&mut engine);
    print::register(&mut engine);
    for word in disabled {
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
    engine.register_fn("clamp", clamp::<f64>).register_fn("clamp", clamp::<i64>);
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

/// Limits a number; whole numbers stay whole.
fn clamp<T: PartialOrd>(x: T, low: T, high: T) -> T {
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
