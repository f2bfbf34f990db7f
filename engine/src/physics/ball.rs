//! The ball.

use glam::Vec3;

/// The ball: world metres, m/s, rad/s.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Ball {
    /// Its centre.
    pub pos: Vec3,
    /// Its velocity.
    pub vel: Vec3,
    /// Its spin.
    pub spin: Vec3,
}
