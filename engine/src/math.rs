//! Transcendental functions with the same bits on every machine: libm instead of the platform's.

pub use glam::{Vec2, Vec3};

/// The sign of a number; `zero` if it is neither positive nor negative.
pub fn sign_or(x: f32, zero: f32) -> f32 {
    if x > 0.0 {
        1.0
    } else if x < 0.0 {
        -1.0
    } else {
        zero
    }
}

/// Sine.
pub fn sin(x: f32) -> f32 {
    libm::sinf(x)
}

/// Cosine.
pub fn cos(x: f32) -> f32 {
    libm::cosf(x)
}

/// Angle of the vector (x, y), -π..π.
pub fn atan2(y: f32, x: f32) -> f32 {
    libm::atan2f(y, x)
}

/// Arc cosine.
pub fn acos(x: f32) -> f32 {
    libm::acosf(x)
}

/// e to the power x.
pub fn exp(x: f32) -> f32 {
    libm::expf(x)
}

/// Natural logarithm.
pub fn ln(x: f32) -> f32 {
    libm::logf(x)
}

/// x to the power y.
pub fn pow(x: f32, y: f32) -> f32 {
    libm::powf(x, y)
}

/// x to the power of N eighths, by square roots only, in an eighth of the time of [`pow`].
pub fn eighths<const N: u32>(x: f32) -> f32 {
    let half = x.sqrt();
    let quarter = half.sqrt();
    let parts = [quarter.sqrt(), quarter, half];
    (0..3).filter(|bit| N & (1 << bit) != 0).fold(1.0, |product, bit| product * parts[bit])
}

/// The unit vector of a heading in radians.
pub fn unit(heading_rad: f32) -> Vec2 {
    Vec2::new(cos(heading_rad), sin(heading_rad))
}

/// The heading of a vector, radians; 0 for the zero vector.
pub fn heading(v: Vec2) -> f32 {
    if v == Vec2::ZERO { 0.0 } else { atan2(v.y, v.x) }
}

/// An angle wrapped to -π..π.
pub fn wrap(angle_rad: f32) -> f32 {
    use std::f32::consts::{PI, TAU};
    let turned = (angle_rad + PI) % TAU;
    if turned < 0.0 { turned + PI } else { turned - PI }
}

/// A smooth step: 0 at 0, 1 at 1, level at both ends.
pub fn smooth(x: f32) -> f32 {
    let x = x.clamp(0.0, 1.0);
    x * x * (3.0 - 2.0 * x)
}

/// From `a` to `b` by a share.
pub fn mix(a: f32, b: f32, share: f32) -> f32 {
    a + (b - a) * share
}

/// How far a value is from `low` (0) to `high` (1), clamped to these ends.
pub fn share(value: f32, low: f32, high: f32) -> f32 {
    ((value - low) / (high - low)).clamp(0.0, 1.0)
}

/// A cosine ease: a share 0..1, slow at both ends.
pub fn ease(share: f32) -> f32 {
    // The ends are frequent, and exact.
    if share == 0.0 || share == 1.0 {
        return share;
    }
    0.5 - 0.5 * cos(share * std::f32::consts::PI)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_ends_of_an_ease_are_those_of_the_cosine() {
        for share in [0.0, 1.0] {
            assert_eq!(ease(share), 0.5 - 0.5 * cos(share * std::f32::consts::PI));
        }
    }
}
