//! Setpiece: football scenarios from text files, and the engine that runs them.
//!
//! This is the facade, for whatever needs both the compiler and the engine. [`load`](mod@load)
//! turns a name, path or text into a scenario, and [`run`] plays episodes of it. [`mod@film`] keeps
//! an episode as scenes, which [`mod@render`] draws. [`watch`] recompiles a scenario when its files
//! change, and [`probe`] finds problems that only a dry run shows.

pub mod agent;
pub mod baseline;
pub mod bench;
#[cfg(feature = "cli")]
pub mod cli;
pub mod curves;
pub mod doc;
#[cfg(feature = "editor")]
mod drag;
pub mod drawing;
#[cfg(feature = "editor")]
pub mod editor;
pub mod error;
pub mod evaluate;
pub mod explain;
pub mod files;
pub mod film;
pub mod grf;
pub mod leaderboard;
pub mod level;
pub mod levels;
pub mod live;
pub mod load;
#[cfg(feature = "editor")]
pub mod lsp;
pub mod measure;
pub mod onnx;
pub mod picture;
pub mod pixels;
pub mod plans;
#[cfg(feature = "render")]
pub mod plot;
pub mod probe;
pub mod profile;
pub mod replay;
pub mod run;
pub mod scene;
pub mod script_api;
#[cfg(feature = "render")]
pub mod sheet;
mod stdlib;
#[cfg(feature = "studio")]
pub mod studio;
pub mod suite;
pub mod tracking;
#[cfg(feature = "video")]
pub mod video;
pub mod watch;

/// The address of the documentation.
pub const DOCS: &str = env!("CARGO_PKG_HOMEPAGE");

pub use error::Error;
pub use level::Level;
pub use live::Live;
pub use load::{
    Cast, CastTarget, Checked, Entry, LoadOptions, Loaded, bind, check, check_with, compile_text,
    compile_text_cast, compile_text_with, list, load, load_cast, load_file, load_with,
};
pub use setpiece_dsl as dsl;
pub use setpiece_engine as engine;
pub use setpiece_render as render;
pub use setpiece_scenario as scenario;

// The examples of the README are compiled and run.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
mod readme {}
