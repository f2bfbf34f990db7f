//! The studio: a page on this machine that shows a scenario's text and its football.
//!
//! A [`Session`] holds the scenario on a thread of its own: it compiles, plays and watches the
//! file. The server ([`serve`]) passes messages between the session and any number of pages. A page
//! that closes or stops reading stops nothing.
//!
//! Only this machine can connect, with the token of the printed address: [`guard`] checks each
//! request.

pub mod guard;
pub mod hands;
mod language;
mod live;
pub mod message;
pub mod moment;
mod page;
mod players;
mod server;
mod session;
mod stage;
mod summary;
mod tell;

pub use players::{Guest, Guests};
pub use server::{Ready, Running, ServeOptions, serve, start};
pub use session::{OpenOptions, Session};
