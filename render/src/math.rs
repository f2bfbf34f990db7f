//! Arithmetic that gives the same bits everywhere: sums, products, quotients and square roots
//! alone.

pub(crate) use glam::{Vec2, Vec3};

/// The furthest place that can be distinguished, metres.
const FAR_M: f32 = 400.0;

/// A number within limits; `lo` for NaN.
pub(crate) fn within(x: f32, lo: f32, hi: f32) -> f32 {
    // `max` drops a NaN.
    x.max(lo).min(hi)
}

/// A length or place in metres that can be computed with: NaN is 0, infinity is far away.
pub(crate) fn metres(x: f32) -> f32 {
    if x.is_nan() { 0.0 } else { x.clamp(-FAR_M, FAR_M) }
}

/// [`metres`] of a place on the ground.
pub(crate) fn ground(at: [f32; 2]) -> Vec3 {
    Vec3::new(metres(at[0]), metres(at[1]), 0.0)
}

/// [`metres`] of a place or velocity in space.
pub(crate) fn space(at: [f32; 3]) -> Vec3 {
    Vec3::new(metres(at[0]), metres(at[1]), metres(at[2]))
}

/// The unit vector along `v`, or `otherwise` where `v` has no direction.
pub(crate) fn unit_or(v: Vec3, otherwise: Vec3) -> Vec3 {
    let length = v.length();
    if length > 1e-4 && length < 1e6 { v / length } else { otherwise }
}

/// Sine, good to 0.001, for |x| < 10⁵.
pub(crate) fn sin(x: f32) -> f32 {
    use std::f32::consts::{PI, TAU};
    let turns = x / TAU;
    let whole = (turns + if turns < 0.0 { -0.5 } else { 0.5 }) as i32 as f32;
    let x = (turns - whole) * TAU;
    let y = 4.0 / PI * x - 4.0 / (PI * PI) * x * x.abs();
    0.775 * y + 0.225 * y * y.abs()
}

/// Cosine, good to 0.001.
pub(crate) fn cos(x: f32) -> f32 {
    sin(x + std::f32::consts::FRAC_PI_2)
}

/// A smooth step: 0 at 0, 1 at 1, level at both ends.
pub(crate) fn smooth(x: f32) -> f32 {
    let x = within(x, 0.0, 1.0);
    x * x * (3.0 - 2.0 * x)
}

/// The number `share` of the way from `a` to `b`.
pub(crate) fn mix(a: f32, b: f32, share: f32) -> f32 {
    a + (b - a) * share
}

/// A well-mixed number for a place on a grid.
pub(crate) fn hash(x: u32, y: u32) -> u32 {
    let mut h = x.wrapping_mul(0x9e37_79b1) ^ y.wrapping_mul(0x85eb_ca77) ^ 0x27d4_eb2f;
    h = (h ^ (h >> 15)).wrapping_mul(0x2c1b_3c6d);
    h = (h ^ (h >> 12)).wrapping_mul(0x297a_2d39);
    h ^ (h >> 15)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[allow(clippy::disallowed_methods, reason = "the platform's functions are the reference")]
    #[test]
    fn sine_and_cosine_are_close() {
        for i in -1000..1000 {
            let x = i as f32 * 0.037;
            assert!((f64::from(sin(x)) - f64::from(x).sin()).abs() < 0.0012, "{x}");
            assert!((f64::from(cos(x)) - f64::from(x).cos()).abs() < 0.0012, "{x}");
        }
    }

    #[test]
    fn nothing_is_too_far_to_compute_with() {
        assert_eq!(metres(f32::NAN), 0.0);
        assert_eq!(metres(f32::NEG_INFINITY), -FAR_M);
        assert_eq!(within(f32::NAN, 1.0, 2.0), 1.0);
        assert_eq!(unit_or(Vec3::ZERO, Vec3::X), Vec3::X);
    }
}
