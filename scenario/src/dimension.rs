//! Units of numbers, as exponents.

use serde::{Deserialize, Serialize};

/// Exponents of metre, second and radian.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Dimension {
    /// Of the metre.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub m: i8,
    /// Of the second.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub s: i8,
    /// Of the radian.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub rad: i8,
}

#[allow(clippy::trivially_copy_pass_by_ref, reason = "serde's signature")]
fn is_zero(exponent: &i8) -> bool {
    *exponent == 0
}

impl Dimension {
    /// Of a plain number.
    pub const NONE: Dimension = Dimension { m: 0, s: 0, rad: 0 };
    /// Of a length.
    pub const LENGTH: Dimension = Dimension { m: 1, s: 0, rad: 0 };
    /// Of a duration.
    pub const DURATION: Dimension = Dimension { m: 0, s: 1, rad: 0 };
    /// Of a speed.
    pub const SPEED: Dimension = Dimension { m: 1, s: -1, rad: 0 };
    /// Of an angle.
    pub const ANGLE: Dimension = Dimension { m: 0, s: 0, rad: 1 };

    /// Whether it is that of a plain number.
    #[allow(clippy::trivially_copy_pass_by_ref, reason = "serde's signature")]
    pub fn is_none(&self) -> bool {
        *self == Dimension::NONE
    }

    /// Of a product.
    #[must_use]
    pub fn times(self, other: Dimension) -> Dimension {
        Dimension {
            m: self.m.saturating_add(other.m),
            s: self.s.saturating_add(other.s),
            rad: self.rad.saturating_add(other.rad),
        }
    }

    /// Of a quotient.
    #[must_use]
    pub fn over(self, other: Dimension) -> Dimension {
        let inverse = |exponent: i8| exponent.saturating_neg();
        self.times(Dimension { m: inverse(other.m), s: inverse(other.s), rad: inverse(other.rad) })
    }

    /// Of a square root, if it has one.
    pub fn root(self) -> Option<Dimension> {
        let even = self.m % 2 == 0 && self.s % 2 == 0 && self.rad % 2 == 0;
        even.then_some(Dimension { m: self.m / 2, s: self.s / 2, rad: self.rad / 2 })
    }
}

/// `m`, `m/s`, `m^2·s`; nothing for a plain number.
impl std::fmt::Display for Dimension {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        if *self == Dimension::SPEED {
            return f.write_str("m/s");
        }
        let parts = [("m", self.m), ("s", self.s), ("rad", self.rad)];
        let mut separator = "";
        for (name, exponent) in parts.into_iter().filter(|(_, exponent)| *exponent != 0) {
            f.write_str(separator)?;
            match exponent {
                1 => f.write_str(name)?,
                n => write!(f, "{name}^{n}")?,
            }
            separator = "·";
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::Dimension;

    #[test]
    fn a_dimension_is_written_as_its_unit() {
        let area = Dimension::LENGTH.times(Dimension::LENGTH);
        for (dimension, text) in [
            (Dimension::NONE, ""),
            (Dimension::LENGTH, "m"),
            (Dimension::SPEED, "m/s"),
            (area, "m^2"),
            (area.times(Dimension::DURATION), "m^2·s"),
            (Dimension::SPEED.over(Dimension::DURATION), "m·s^-2"),
        ] {
            assert_eq!(dimension.to_string(), text);
        }
        assert_eq!(area.root(), Some(Dimension::LENGTH));
        assert_eq!(Dimension::SPEED.root(), None);
    }
}
