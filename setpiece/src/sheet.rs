//! Sheets: an episode as frames on one page, or one moment of it large.
//!
//! [`film`](mod@crate::film) plays an episode and keeps a scene of every step. [`moments`] chooses
//! those worth a frame, and the renderer draws them from above. [`caption`] writes what happened,
//! and [`page`] arranges frames and captions. No clock or chance is involved: the same film gives
//! the same pixels.

pub mod badge;
pub mod canvas;
pub mod caption;
pub mod colours;
pub mod head;
pub mod moments;
pub mod page;
pub mod region;
pub mod text;
pub mod words;

pub use page::{frame, sheet};
pub use region::Region;
