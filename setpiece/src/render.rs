//! Pictures of a match, seen from above: one moment large, or an episode as a sheet of frames.
//!
//! [`mod@film`] plays an episode and keeps a [`SheetScene`] of every step. [`moments`] chooses
//! those worth a frame. [`stage`] draws a scene into a buffer of pixels; [`pitch`], [`people`] and
//! [`ball`] draw their part of it. [`caption`] writes what happened, and [`mod@sheet`] arranges
//! frames and captions. No clock or chance is involved: the same film gives the same pixels.

pub mod ball;
pub mod canvas;
pub mod caption;
pub mod colours;
pub mod film;
pub mod head;
pub mod moments;
pub mod people;
pub mod pitch;
pub mod scene;
pub mod sheet;
pub mod stage;
pub mod text;
pub mod view;
pub mod words;

pub use film::{Film, FilmOptions, film, replayed};
pub use scene::SheetScene;
pub use sheet::{frame, sheet};
pub use stage::draw;
pub use view::Region;
