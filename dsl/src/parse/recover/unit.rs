//! Units that are none, or that don't touch their number.

use crate::parse::reader::{Reader, token};
use crate::problem::facts::{Syntax, UnitGuess};
use crate::problem::{Problem, nearest};
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
        let number_len = digits.len()
            - digits.trim_end_matches(|char: char| char.is_ascii_digit() || char == '.').len();
        let number = digits.get(digits.len() - number_len..)?;
        let part_of_name = digits
            .get(..digits.len() - number_len)?
            .ends_with(|char: char| char.is_alphanumeric() || char == '_');
        if !number.ends_with(|char: char| char.is_ascii_digit()) || part_of_name {
            return None;
        }
        let touches = digits.len() == line.len();
        if touches && word.starts_with('_') {
            let span = self.between(at - number.len(), at + word.len());
            return Some(Problem::new(
                span,
                Syntax::DigitsAlone { number: number.to_owned(), rest: word.to_owned() },
            ));
        }
        if touches {
            let start = at - number.len();
            let word =
                if word == "km" && text.get(at..)?.starts_with("km/") { "km/" } else { word };
            let span = self.between(start, at + word.len());
            let units = Unit::ALL.iter().map(|unit| unit.name());
            let meant = match (meant(word), nearest(word, units.clone())) {
                (Some(unit), _) => UnitGuess::One(unit.to_owned()),
                (None, Some(unit)) => UnitGuess::One(format!("{}{unit}", blank_before(unit))),
                (None, None) => UnitGuess::All(units.collect()),
            };
            let (word, number) = (word.to_owned(), number.to_owned());
            return Some(Problem::new(span, Syntax::UnknownUnit { word, number, meant }));
        }
        let Some(unit) = Unit::from_name(word) else {
            let counted = nearest(
                word.trim_end_matches(|char: char| char.is_ascii_digit()),
                ["step", "steps", "episodes"],
            );
            let counted = counted.filter(|_| word.len() >= 4)?;
            let meant =
                UnitGuess::One(format!(" {}", if counted == "step" { "steps" } else { counted }));
            let (word, number) = (word.to_owned(), number.to_owned());
            return Some(Problem::new(self.at(at), Syntax::UnknownUnit { word, number, meant }));
        };
        let gap = line.len() - digits.len();
        let span = self.between(at - gap - number.len(), at + word.len());
        Some(Problem::new(span, Syntax::UnitApart { number: number.to_owned(), unit: unit.name() }))
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
