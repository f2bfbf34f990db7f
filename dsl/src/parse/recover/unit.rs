//! Units that are none, or that don't touch their number.

use crate::parse::reader::{Reader, token};
use crate::problem::{Code, Problem, nearest};
use setpiece_scenario::vocabulary::Unit;

impl Reader<'_> {
    /// `5mm`, and `5 m`: a number whose unit is not one or does not touch it.
    pub(super) fn unit(&self, at: usize) -> Option<Problem> {
        let text = self.text;
        let word = token(text.get(at..)?);
        if !word.starts_with(|char: char| char.is_alphabetic() || char == '_') {
            return None;
        }
        let line = text.get(self.line_start(at)..at)?;
        let digits = line.trim_end_matches([' ', '\t']);
        let number_len =
            digits.len() - digits.trim_end_matches(|char: char| char.is_ascii_digit() || char == '.').len();
        let number = digits.get(digits.len() - number_len..)?;
        let part_of_name =
            digits.get(..digits.len() - number_len)?.ends_with(|char: char| char.is_alphanumeric() || char == '_');
        if !number.ends_with(|char: char| char.is_ascii_digit()) || part_of_name {
            return None;
        }
        let touches = digits.len() == line.len();
        if touches && word.starts_with('_') {
            let span = self.between(at - number.len(), at + word.len());
            let all = format!("{number}{}", word.replace('_', ""));
            return Some(
                Problem::legacy(Code::Syntax, span, format!("`{number}{word}` is no number"), "digits alone")
                    .help(format!("write `{all}`")),
            );
        }
        if touches {
            let start = at - number.len();
            let word = if word == "km" && text.get(at..)?.starts_with("km/") { "km/" } else { word };
            let span = self.between(start, at + word.len());
            let units = Unit::ALL.iter().map(|unit| unit.name());
            let known: Vec<_> = units.clone().map(|unit| format!("`{unit}`")).collect();
            let problem =
                Problem::legacy(Code::Syntax, span, format!("unknown unit `{word}`"), "no unit has this name");
            return Some(match nearest(word, units).filter(|_| meant(word).is_none()) {
                Some(unit) => problem.help(format!("did you mean `{number}{}{unit}`?", blank_before(unit))),
                None if meant(word).is_some() => {
                    problem.help(format!("did you mean `{number}{}`?", meant(word).unwrap_or_default()))
                }
                None => problem.help(format!("the units are {}", known.join(", "))),
            });
        }
        let Some(unit) = Unit::from_name(word) else {
            let counted =
                nearest(word.trim_end_matches(|char: char| char.is_ascii_digit()), ["step", "steps", "episodes"]);
            let counted = counted.filter(|_| word.len() >= 4)?;
            let message = format!("unknown unit `{word}`");
            let help = format!("did you mean `{number} {}`?", if counted == "step" { "steps" } else { counted });
            return Some(Problem::legacy(Code::Syntax, self.at(at), message, "no unit has this name").help(help));
        };
        let gap = line.len() - digits.len();
        let span = self.between(at - gap - number.len(), at + word.len());
        Some(
            Problem::legacy(
                Code::Syntax,
                span,
                format!("the unit `{}` must touch its number", unit.name()),
                "a blank between them",
            )
            .help(format!("write `{number}{}`", unit.name())),
        )
    }
}

/// The unit behind another language's name for it.
fn meant(word: &str) -> Option<&'static str> {
    Some(match word {
        "degree" | "degrees" => "deg",
        "radian" | "radians" => "rad",
        "sec" | "secs" | "second" | "seconds" => "s",
        "msec" | "millis" => "ms",
        "meter" | "meters" | "metre" | "metres" => "m",
        "kmh" | "kph" => "km/h",
        "mps" => "m/s",
        "percent" => "%",
        _ => return None,
    })
}

/// `steps` and `episodes` stand apart from their number.
fn blank_before(unit: &str) -> &'static str {
    if unit.len() > 4 { " " } else { "" }
}
