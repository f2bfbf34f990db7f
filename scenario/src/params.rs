//! Parameters of a scenario and their binding.

use crate::pitch::STEPS_PER_S;
use crate::vocabulary::Type;
use serde::{Deserialize, Serialize};

/// A parameter: a typed number with a default and a range. Strings and teams are numbered by
/// `choices`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Param {
    /// The name.
    pub name: String,
    /// The documentation above it.
    #[serde(default)]
    pub doc: String,
    /// The type; its values are SI.
    pub ty: Type,
    /// The value unless bound.
    pub default: f64,
    /// Least and greatest value, both included.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub range: Option<(f64, f64)>,
    /// The allowed words, for strings; the value is the index in this list.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub choices: Vec<String>,
    /// The allowed numbers, if it is a list.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub values: Vec<f64>,
}

/// The values of a scenario's parameters, in their order.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(transparent)]
pub struct Bindings(pub Vec<f64>);

/// Why a parameter can't be bound.
#[derive(Clone, Debug, PartialEq)]
pub enum ParamError {
    /// The scenario has no such parameter.
    Unknown {
        /// The requested name.
        name: String,
        /// The names that exist.
        known: Vec<String>,
    },
    /// The text or value doesn't have the parameter's type.
    Type {
        /// The parameter.
        name: String,
        /// Its type.
        ty: Type,
        /// The given value.
        found: String,
    },
    /// The value is outside the range or the choices.
    Range {
        /// The parameter.
        name: String,
        /// The given value.
        found: String,
        /// What is allowed, in words.
        allowed: String,
    },
}

impl std::fmt::Display for ParamError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            ParamError::Unknown { name, known } if known.is_empty() => {
                write!(f, "no parameter `{name}`: the scenario has none")
            }
            ParamError::Unknown { name, known } => {
                write!(f, "no parameter `{name}`; the scenario has `{}`", known.join("`, `"))
            }
            ParamError::Type { name, ty, found } => {
                write!(f, "parameter `{name}`: expected {}, found `{found}`", ty.noun())
            }
            ParamError::Range { name, found, allowed } => {
                write!(f, "parameter `{name}` is {found}, outside {allowed}")
            }
        }
    }
}

impl std::error::Error for ParamError {}

impl Bindings {
    /// The defaults of some parameters.
    pub fn defaults(params: &[Param]) -> Bindings {
        Bindings(params.iter().map(|param| param.default).collect())
    }

    /// Binds a parameter to a value in SI units.
    ///
    /// # Errors
    /// [`ParamError`] if there is no such parameter or the value isn't allowed; nothing is changed
    /// then.
    pub fn set(&mut self, params: &[Param], name: &str, value: f64) -> Result<(), ParamError> {
        let (index, param) = find(params, name)?;
        let value = param.admit(value)?;
        if let Some(slot) = self.0.get_mut(index) {
            *slot = value;
        }
        Ok(())
    }

    /// Binds a parameter to a value written as in the language: `0.9`, `60%`, `12m`, `on`, `left`,
    /// a word.
    ///
    /// # Errors
    /// Like [`Bindings::set`], and if the text doesn't have the parameter's type.
    pub fn set_text(&mut self, params: &[Param], name: &str, text: &str) -> Result<(), ParamError> {
        let (_, param) = find(params, name)?;
        self.set(params, name, param.parse(text)?)
    }
}

fn find<'a>(params: &'a [Param], name: &str) -> Result<(usize, &'a Param), ParamError> {
    params.iter().enumerate().find(|(_, param)| param.name == name).ok_or_else(|| {
        ParamError::Unknown {
            name: name.to_owned(),
            known: params.iter().map(|param| param.name.clone()).collect(),
        }
    })
}

impl Param {
    /// Reads a value as the language writes it. A bare number is in the type's SI unit.
    ///
    /// # Errors
    /// [`ParamError::Type`] if the text is anything else.
    pub fn parse(&self, text: &str) -> Result<f64, ParamError> {
        use crate::vocabulary::Unit;
        let text = text.trim();
        let wrong =
            || ParamError::Type { name: self.name.clone(), ty: self.ty, found: text.to_owned() };
        if let Some(index) = self.choices.iter().position(|choice| choice == text) {
            return Ok(index as f64);
        }
        match self.ty {
            Type::Bool => match text {
                "on" | "true" => return Ok(1.0),
                "off" | "false" => return Ok(0.0),
                _ => return Err(wrong()),
            },
            Type::Team => {
                return match text {
                    "left" => Ok(0.0),
                    "right" => Ok(1.0),
                    "none" => Ok(-1.0),
                    _ => Err(wrong()),
                };
            }
            Type::String => {
                return Err(ParamError::Range {
                    name: self.name.clone(),
                    found: format!("`{text}`"),
                    allowed: self.allowed(),
                });
            }
            _ => {}
        }
        let number_end = text
            .char_indices()
            .find(|&(at, c)| {
                let exponent = (c == 'e' || c == 'E')
                    && text[at + 1..]
                        .starts_with(|d: char| d.is_ascii_digit() || d == '-' || d == '+');
                !(c.is_ascii_digit() || matches!(c, '.' | '-' | '+') || exponent)
            })
            .map_or(text.len(), |(at, _)| at);
        let number: f64 = text[..number_end].parse().map_err(|_| wrong())?;
        let unit = text[number_end..].trim();
        if unit.is_empty() {
            return Ok(number);
        }
        let unit = Unit::ALL
            .iter()
            .find(|u| u.name() == unit || (unit == "step" && **u == Unit::Step))
            .ok_or_else(wrong)?;
        let plain = matches!(self.ty, Type::Number | Type::Percent);
        if unit.ty() == self.ty || (plain && *unit == Unit::Percent) {
            Ok(unit.si(number))
        } else {
            Err(wrong())
        }
    }

    /// Checks a value against type, range and choices.
    ///
    /// # Errors
    /// [`ParamError`] if it isn't allowed.
    pub fn admit(&self, value: f64) -> Result<f64, ParamError> {
        let whole = matches!(self.ty, Type::Int | Type::Bool | Type::Team | Type::String);
        if !value.is_finite() || (whole && value.fract() != 0.0) {
            return Err(ParamError::Type {
                name: self.name.clone(),
                ty: self.ty,
                found: self.show(value),
            });
        }
        let inside = match self.ty {
            Type::Bool => value == 0.0 || value == 1.0,
            Type::Team => (-1.0..=1.0).contains(&value),
            Type::String => (0.0..self.choices.len() as f64).contains(&value),
            _ => true,
        } && self.range.is_none_or(|(low, high)| (low..=high).contains(&value))
            && (self.values.is_empty() || self.values.contains(&value));
        if inside {
            Ok(value)
        } else {
            Err(ParamError::Range {
                name: self.name.clone(),
                found: self.show(value),
                allowed: self.allowed(),
            })
        }
    }

    /// A value as the language writes it: `0.9`, `60%`, `12m`, `400 steps`, `on`, `left`, a word.
    pub fn show(&self, value: f64) -> String {
        // Twelve decimals hide the error of binary fractions.
        let number = |value: f64| {
            let rounded = (value * 1e12).round() / 1e12;
            if rounded.is_finite() { rounded } else { value }
        };
        match self.ty {
            Type::Bool => if value == 0.0 { "off" } else { "on" }.to_owned(),
            Type::Team if value == 0.0 => "left".to_owned(),
            Type::Team if value == 1.0 => "right".to_owned(),
            Type::Team => "none".to_owned(),
            Type::String => self
                .choices
                .get(value as usize)
                .cloned()
                .unwrap_or_else(|| number(value).to_string()),
            Type::Percent => format!("{}%", number(value * 100.0)),
            Type::Length => format!("{}m", number(value)),
            Type::Speed => format!("{}m/s", number(value)),
            Type::Angle => format!("{}deg", number(value.to_degrees())),
            Type::Duration => match number(value * STEPS_PER_S) {
                steps if steps.fract() == 0.0 => format!("{steps} steps"),
                _ => format!("{}s", number(value)),
            },
            _ => number(value).to_string(),
        }
    }

    /// A value as a text that [`Param::parse`] reads back to the bit: as [`Param::show`] writes it
    /// where that is exact, otherwise in SI units.
    pub fn write(&self, value: f64) -> String {
        let shown = self.show(value);
        if self.parse(&shown) == Ok(value) { shown } else { value.to_string() }
    }

    /// What is allowed, in words: `0..1`, `one of wing, centre`.
    pub fn allowed(&self) -> String {
        if !self.choices.is_empty() {
            return format!("one of {}", self.choices.join(", "));
        }
        if !self.values.is_empty() {
            let words: Vec<String> = self.values.iter().map(|value| self.show(*value)).collect();
            return format!("one of {}", words.join(", "));
        }
        match (self.ty, self.range) {
            (_, Some((low, high))) => format!("{}..{}", self.show(low), self.show(high)),
            (Type::Bool, None) => "on, off".to_owned(),
            (Type::Team, None) => "left, right, none".to_owned(),
            (ty, None) => ty.noun().to_owned(),
        }
    }
}
