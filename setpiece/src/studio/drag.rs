//! Dragging: the numbers of a place in the text, rewritten in their own units.

use crate::Loaded;
use crate::render::scene::Id;
use crate::scenario::{PitchSize, Team};
use crate::scene::team;
use std::ops::Range;

/// Metres of a normalised 1, along and across the pitch. (GRF's.)
const NORMALISED_M: [f64; 2] = [54.4, 83.6];

/// A place as two numbers in the text.
#[derive(Clone, Debug, PartialEq)]
struct WrittenPlace {
    /// Where the numbers stand, with their units.
    numbers: [Range<usize>; 2],
    /// Whether they are metres.
    is_metres: bool,
    /// Whether they are in the team's own frame.
    is_own: bool,
}

/// The text of a session with a player, or the ball, put elsewhere.
///
/// - `loaded`: the last good scenario.
/// - `to`: metres, in the world's frame; what lies off the pitch is put on its rim.
/// - `pitch`: the pitch of the start that is shown.
///
/// # Errors
/// A sentence for the user, if the place isn't two plain numbers of this text.
pub(super) fn dragged(
    loaded: &Loaded,
    text: &str,
    player: Option<Id>,
    to: [f64; 2],
    pitch: &PitchSize,
) -> Result<String, String> {
    if to.iter().any(|metres| !metres.is_finite()) {
        return Err("a place is two numbers".to_owned());
    }
    let half = [pitch.half_length(), pitch.half_width()];
    let to = [to[0].clamp(-half[0], half[0]), to[1].clamp(-half[1], half[1])];
    let main = loaded.sources.iter().next();
    // A text that has changed since the last good one has its statements elsewhere.
    if main.is_some_and(|(_, source)| *source.text != *text) {
        return Err("mend the text first: the picture is of the last good one".to_owned());
    }
    let elsewhere = || "this place isn't written in this file".to_owned();
    let origins = &loaded.origins;
    let (span, turns) = match player {
        None => (origins.ball, false),
        Some(id) => {
            let slots = &loaded.scenario.players;
            let mut of_team = slots
                .iter()
                .enumerate()
                .filter(|(_, slot)| slot.team == team(id.team) && !slot.instead);
            let (at, slot) = of_team.nth(usize::from(id.slot)).ok_or_else(elsewhere)?;
            if slots.get(at + 1).is_some_and(|next| next.instead) {
                return Err(
                    "players of several formations share this place: edit the text".to_owned()
                );
            }
            (origins.players.get(at).copied(), slot.team == Team::Right)
        }
    };
    let here = span.filter(|span| main.is_some_and(|(file, _)| file == span.file));
    let span = here.filter(|span| !loaded.sources.text(*span).is_empty()).ok_or_else(elsewhere)?;
    moved(text, span.start as usize, to, turns)
}

/// The text with the place behind the first `at` of a statement moved to a point of the pitch.
///
/// - `statement`: where the statement of the player or the ball begins.
/// - `to`: metres, in the world's frame.
/// - `turns`: whether the team's own frame is turned: the right team's.
///
/// # Errors
/// A sentence for the user, if the place isn't two plain numbers.
pub fn moved(text: &str, statement: usize, to: [f64; 2], turns: bool) -> Result<String, String> {
    let place = written(text, statement).ok_or_else(|| {
        "this place is computed, so there are no numbers to change: edit the text".to_owned()
    })?;
    let side = if place.is_own && turns { -1.0 } else { 1.0 };
    let mut edited = text.to_owned();
    // From the back, so that the first range stays right.
    for axis in [1, 0] {
        let range = place.numbers[axis].clone();
        let value = to[axis] * side;
        let number = if place.is_metres {
            format!("{}m", short(value, 1))
        } else {
            short(value / NORMALISED_M[axis], 3)
        };
        edited.replace_range(range, &number);
    }
    Ok(edited)
}

/// A number with at most so many decimals.
fn short(value: f64, decimals: usize) -> String {
    let text = format!("{value:.decimals$}");
    let text = if text.contains('.') {
        text.trim_end_matches('0').trim_end_matches('.')
    } else {
        text.as_str()
    };
    if text == "-0" { "0".to_owned() } else { text.to_owned() }
}

/// The two numbers of `at (…, …)` in the statement that begins here.
fn written(text: &str, statement: usize) -> Option<WrittenPlace> {
    let line_end = text.get(statement..)?.find('\n').map_or(text.len(), |end| statement + end);
    let line = text.get(statement..line_end)?;
    let mut from = 0;
    let behind = loop {
        let at = from + line.get(from..)?.find("at")?;
        let word = |place: Option<char>| place.is_some_and(|it| it.is_alphanumeric() || it == '_');
        let (before, after) = (line[..at].chars().next_back(), line[at + 2..].chars().next());
        if !word(before) && !word(after) {
            break statement + at + 2;
        }
        from = at + 2;
    };
    let mut rest = Cursor { text: text.get(..line_end)?, at: behind };
    let is_own = rest.takes("own");
    if !rest.takes("(") {
        return None;
    }
    let (first, first_metres) = rest.number()?;
    if !rest.takes(",") {
        return None;
    }
    let (second, second_metres) = rest.number()?;
    let plain = rest.takes(")") && first_metres == second_metres;
    // `(1m, 2m) + (3m, 0m)` is computed.
    let goes_on = ["+", "-", "*", "/"].into_iter().any(|sign| rest.takes(sign));
    let numbers = [first, second];
    (plain && !goes_on).then_some(WrittenPlace { numbers, is_metres: first_metres, is_own })
}

/// A place in a text.
struct Cursor<'a> {
    text: &'a str,
    at: usize,
}

impl Cursor<'_> {
    fn skip(&mut self) {
        let rest = &self.text[self.at..];
        self.at += rest.len() - rest.trim_start().len();
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

    /// Goes past a number; returns where it stands and whether it is in metres.
    fn number(&mut self) -> Option<(Range<usize>, bool)> {
        self.skip();
        let (begin, rest) = (self.at, &self.text[self.at..]);
        let length = rest
            .char_indices()
            .find(|&(place, sign)| {
                !(sign.is_ascii_digit() || sign == '.' || sign == '-' && place == 0)
            })
            .map_or(rest.len(), |(place, _)| place);
        rest.get(..length)?.parse::<f64>().ok()?;
        self.at += length;
        let rest = &self.text[self.at..];
        let is_metres = rest.starts_with('m');
        self.at += usize::from(is_metres);
        let goes_on = self.text[self.at..].starts_with(|sign: char| sign.is_alphanumeric());
        (!goes_on).then_some((begin..self.at, is_metres))
    }
}

#[cfg(test)]
mod tests {
    use super::moved;

    fn to(text: &str, place: [f64; 2], turns: bool) -> Option<String> {
        moved(text, 0, place, turns).ok()
    }

    #[test]
    fn exactly_the_numbers_change_in_their_own_unit() {
        let place = [20.0, -10.28];
        assert_eq!(
            to("CM at (0.5, 0.1) { ai: hold } // at (1, 2)", place, false).unwrap(),
            "CM at (0.368, -0.123) { ai: hold } // at (1, 2)"
        );
        assert_eq!(to("CM at (1m , 2.5m)", place, false).unwrap(), "CM at (20m , -10.3m)");
        assert_eq!(
            to("matt: GK at own (-1, 0)", [54.4, 0.0], true).unwrap(),
            "matt: GK at own (-1, 0)"
        );
        assert_eq!(to("GK at own (-1, 0)", [-54.4, 8.36], false).unwrap(), "GK at own (-1, 0.1)");
        assert_eq!(
            to("ball at (0, 0) { height: 2m }", [5.44, 0.0], false).unwrap(),
            "ball at (0.1, 0) { height: 2m }"
        );
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
            "CM at (8m/s, 2m)",
            "CM at",
            "",
        ] {
            assert_eq!(to(text, [1.0, 1.0], false), None, "{text}");
        }
    }
}
