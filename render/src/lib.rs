//! Draws a football [`Scene`] into pixels: no game, no clock, no file.
//!
//! ```
//! use setpiece_render::{Options, Renderer, Scene};
//!
//! let mut renderer = Renderer::new(640, 360, Options::default())?;
//! let mut rgba = vec![0; 640 * 360 * 4];
//! renderer.render(&Scene::default(), &mut rgba)?;
//! # Ok::<(), setpiece_render::RenderError>(())
//! ```
//!
//! # How a picture is made
//!
//! 1. `view` places the [`Camera`]. It never rolls or turns, so a row of the picture shows one line
//!    of the ground.
//! 2. `ground` and `stands` paint the background row by row: stripes with a grain, `marks` (each
//!    line with the exact share of a pixel that it covers), boards, crowd. Crowd and boards are
//!    painted once per renderer, at the picture's size.
//! 3. `pose` turns a player's speed and posture into angles, `skeleton` turns those into joints,
//!    and `figure` into some thirty tapered capsules. `canvas` draws a capsule by its signed
//!    distance, which smooths and shades it. Shadows are the same joints laid on the ground.
//! 4. `broadcast` orders players, ball, flags and the bands of the goals (`goal`) from far to near.
//!    A plan is drawn by `above` instead.
//! 5. `overlay` adds scoreboard, radar and banner if the picture is large enough.
//!
//! Small pictures have less: below 12 pixels per metre figures have fewer parts, below 5.5 they are
//! legs, trunk and head. Nothing that counts gets thinner than about a pixel.
//!
//! # Determinism
//!
//! A picture depends on its scene, its size and its options, and on nothing else: not on the
//! thread, the pictures before, or the machine. All arithmetic is on whole numbers and on `f32`
//! sums, products, quotients and square roots, which IEEE 754 fixes bit for bit.

mod above;
mod ball;
mod between;
mod broadcast;
mod canvas;
mod color;
mod crowd;
mod figure;
mod goal;
mod ground;
mod marks;
mod math;
mod overlay;
mod pixels;
mod pose;
mod renderer;
mod skeleton;
mod stands;
mod text;
mod tile;
mod view;

/// What is drawn.
pub mod scene;

pub use between::between;
pub use color::shirt;
pub use overlay::Overlays;
pub use pixels::{PixelObserver, Pixels};
pub use renderer::{Options, RenderError, Renderer, SIDE_MAX, gray};
pub use scene::Scene;
pub use view::{Camera, PitchRegion};
