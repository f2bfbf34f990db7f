//! A place as two numbers in a text, and the numbers rewritten in their own unit.

use super::NewNumber;
use crate::scenario::pitch::{X_SCALE_M, Y_SCALE_M};
use std::ops::Range;

/// Metres of a normalised 1, along and across the pitch.
const NORMALISED_M: [f64; 2] = [X_SCALE_M, Y_SCALE_M];

/// Two numbers in a text.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Written {
    /// Where the numbers stand, with their units.
    numbers: [Range<usize>; 2],
    /// Whether they are metres.
    pub(super) is_metres: bool,
    /// Whether the word `own` stands before them.
    pub(super) is_own: bool,
}

impl Written {
    /// The two numbers of a place `at (…, …)`; none if it is anything else.
    ///
    /// `place`: its bytes.
    pub(super) fn of(text: &str, place: Range<usize>) -> Option<Written> {
        let mut rest = Cursor { text: text.get(..place.end)?, at: place.start };
        if !rest.takes("at") {
            return None;
        }
        let written = rest.point()?;
        rest.skip();
        // `(1m, 2m) + (3m, 0m)` is computed.
        (rest.at == place.end).then_some(written)
    }

    /// What they say, metres.
    pub(super) fn metres(&self, text: &str) -> Option<[f64; 2]> {
        let number = |axis: usize| {
            let value = value_of(text.get(self.numbers[axis].clone())?)?;
            Some(if self.is_metres { value } else { value * NORMALISED_M[axis] })
        };
        Some([number(0)?, number(1)?])
    }

    /// The numbers that say some metres instead, rounded, but not beyond `most` metres on either
    /// side of the centre.
    pub(super) fn with(self, metres: [f64; 2], most: [f64; 2]) -> [NewNumber; 2] {
        let [x, y] = self.numbers;
        let is_metres = self.is_metres;
        let number = |range, axis: usize| NewNumber {
            range,
            text: if is_metres {
                format!("{}m", short(metres[axis], 1, most[axis]))
            } else {
                let unit = NORMALISED_M[axis];
                short(metres[axis] / unit, 3, most[axis] / unit)
            },
        };
        [number(x, 0), number(y, 1)]
    }
}

/// What a number says, without its unit.
fn value_of(number: &str) -> Option<f64> {
    let is_blank = |sign: char| sign == '_' || sign.is_whitespace();
    number.trim_end_matches('m').replace(is_blank, "").parse().ok()
}

/// A number with at most so many decimals, no further from 0 than `most`.
fn short(value: f64, decimals: usize, most: f64) -> String {
    let nearest = format!("{value:.decimals$}");
    let is_beyond = nearest.parse().is_ok_and(|nearest: f64| nearest.abs() > most);
    let text = if is_beyond {
        let tens = 10_f64.powi(decimals as i32);
        format!("{:.decimals$}", (most * tens).floor() / tens * value.signum())
    } else {
        nearest
    };
    let text = if text.contains('.') {
        text.trim_end_matches('0').trim_end_matches('.')
    } else {
        text.as_str()
    };
    if text == "-0" { "0".to_owned() } else { text.to_owned() }
}

/// A place in a text.
struct Cursor<'a> {
    text: &'a str,
    at: usize,
}

impl Cursor<'_> {
    /// Goes past blanks and comments.
    fn skip(&mut self) {
        loop {
            let rest = &self.text[self.at..];
            self.at += rest.len() - rest.trim_start().len();
            let rest = &self.text[self.at..];
            let end = match rest.get(..2) {
                Some("//") => rest.find('\n'),
                Some("/*") => rest.find("*/").map(|at| at + 2),
                _ => return,
            };
            self.at += end.unwrap_or(rest.len());
        }
    }

    /// Goes past a sign or word, if it stands here.
    fn takes(&mut self, sign: &str) -> bool {
        self.skip();
        let stands = self.text[self.at..].starts_with(sign);
        if stands {
            self.at += sign.len();
        }
        stands
    }

    /// Goes past a point of two numbers, which may stand in brackets of its own.
    fn point(&mut self) -> Option<Written> {
        let is_own = self.takes("own");
        let begin = self.at;
        if let Some(pair) = self.pair(is_own) {
            return Some(pair);
        }
        self.at = begin;
        if is_own || !self.takes("(") {
            return None;
        }
        self.point().filter(|_| self.takes(")"))
    }

    /// Goes past two numbers in brackets.
    fn pair(&mut self, is_own: bool) -> Option<Written> {
        if !self.takes("(") {
            return None;
        }
        let (first, is_metres) = self.coordinate()?;
        if !self.takes(",") {
            return None;
        }
        let (second, second_is_metres) = self.coordinate()?;
        let is_plain = self.takes(")") && is_metres == second_is_metres;
        is_plain.then_some(Written { numbers: [first, second], is_metres, is_own })
    }

    /// Goes past a number, which may stand in brackets of its own.
    fn coordinate(&mut self) -> Option<(Range<usize>, bool)> {
        if self.takes("(") { self.coordinate().filter(|_| self.takes(")")) } else { self.number() }
    }

    /// Goes past a number; returns where it stands and whether it is in metres.
    fn number(&mut self) -> Option<(Range<usize>, bool)> {
        self.skip();
        let begin = self.at;
        if self.takes("-") {
            let rest = &self.text[self.at..];
            self.at += rest.len() - rest.trim_start().len();
        }
        let digits = |rest: &str| {
            let is_digit = |sign: char| sign.is_ascii_digit() || sign == '_' || sign == '.';
            rest.find(|sign| !is_digit(sign)).unwrap_or(rest.len())
        };
        self.at += digits(&self.text[self.at..]);
        // Of `2e-1`, what follows the `e`.
        if let Some(rest) = self.text[self.at..].strip_prefix('e') {
            let sign = usize::from(rest.starts_with(['-', '+']));
            let exponent = digits(&rest[sign..]);
            self.at += if exponent > 0 { 1 + sign + exponent } else { 0 };
        }
        value_of(&self.text[begin..self.at])?;
        let rest = &self.text[self.at..];
        let is_metres = rest.starts_with('m');
        self.at += usize::from(is_metres);
        let goes_on = self.text[self.at..].starts_with(|sign: char| sign.is_alphanumeric());
        (!goes_on).then_some((begin..self.at, is_metres))
    }
}

#[cfg(test)]
mod tests {
    use super::Written;
    use crate::drag::rewritten;

    /// The text with a place moved, which ends before a brace, a comment or the text's end.
    fn to(text: &str, metres: [f64; 2]) -> Option<String> {
        let start = text.find("at").unwrap_or_default();
        let end = text.find(['{', '/']).unwrap_or(text.len());
        let end = text.get(..end)?.trim_end().len();
        Some(rewritten(text, &Written::of(text, start..end)?.with(metres, [54.999, 36.0])))
    }

    #[test]
    fn exactly_the_numbers_change_in_their_own_unit() {
        let place = [20.0, -10.28];
        assert_eq!(
            to("CM at (0.5, 0.1) { ai: hold } // at (1, 2)", place).unwrap(),
            "CM at (0.368, -0.123) { ai: hold } // at (1, 2)"
        );
        assert_eq!(to("CM at (1m , 2.5m)", place).unwrap(), "CM at (20m , -10.3m)");
        assert_eq!(
            to("CM at\r\n  (1m,\r\n  2.5m)", place).unwrap(),
            "CM at\r\n  (20m,\r\n  -10.3m)"
        );
        assert_eq!(to("matt: GK at own (-1, 0)", [-54.4, 8.36]), None, "`at` of a name");
        assert_eq!(to("GK at own (-1, 0)", [-54.4, 8.36]).unwrap(), "GK at own (-1, 0.1)");
        assert_eq!(
            to("ball at (0, 0) { height: 2m }", [5.44, 0.0]).unwrap(),
            "ball at (0.1, 0) { height: 2m }"
        );
        let within = "at /* a */ (1, // x\n2) // y";
        let written = Written::of(within, 0..within.len()).unwrap();
        assert_eq!(
            rewritten(within, &written.with([0.0; 2], [55.0, 36.0])),
            "at /* a */ (0, // x\n0) // y"
        );
        assert_eq!(to("CM at (5m, 5m)", [-0.04, -0.0]).unwrap(), "CM at (0m, 0m)");
        assert_eq!(to("CM at (2e-1, 1_0.5e+0)", place).unwrap(), "CM at (0.368, -0.123)");
        assert_eq!(to("CM at ((- 1m, (2m)))", place).unwrap(), "CM at ((20m, (-10.3m)))");
        assert_eq!(to("CM at (own ((1), 2))", place).unwrap(), "CM at (own ((0.368), -0.123))");
    }

    #[test]
    fn rounding_leads_nobody_off_the_pitch() {
        // 36 m are 0.4306.
        assert_eq!(to("CM at (0, 0)", [20.0, 36.0]).unwrap(), "CM at (0.368, 0.43)");
        assert_eq!(to("CM at (0, 0)", [20.0, -36.0]).unwrap(), "CM at (0.368, -0.43)");
        assert_eq!(to("CM at (0m, 0m)", [-54.999, -36.0]).unwrap(), "CM at (-54.9m, -36m)");
    }

    #[test]
    fn the_numbers_are_read_in_their_own_unit() {
        let exact = "at (- 2.5e1m, 1_0m)";
        assert_eq!(Written::of(exact, 0..exact.len()).unwrap().metres(exact), Some([-25.0, 10.0]));
        let text = "at (-2.5m, 4m) at (0.5, -1)";
        let metres = |range| Written::of(text, range).unwrap().metres(text);
        assert_eq!(metres(0..14), Some([-2.5, 4.0]));
        assert_eq!(metres(15..text.len()), Some([27.2, -83.6]));
    }

    #[test]
    fn a_computed_place_is_left_alone() {
        for text in [
            "CM at (0.5, lane)",
            "CM at ball + (1m, 0m)",
            "CM at (1m, 2m) + (3m, 0m)",
            "CM in left.box",
            "CM ahead of anna by 2m",
            "CM at (0.5 + 0.1, 0)",
            "CM at (1m, 2)",
            "CM at (8m / s, 2m)",
            "CM at ((0.5, 0.1) + v)",
            "CM at (-(0.5), 0.1)",
            "CM at (2e, 0.1)",
            "CM at (--0.5, 0.1)",
            "CM at",
            "",
        ] {
            assert_eq!(to(text, [1.0, 1.0]), None, "{text}");
        }
    }
}
