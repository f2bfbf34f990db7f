//! Habits of other languages and near misses of form: what is seen, and what to write instead.

mod names;
mod plans;
mod rewrite;
mod row;
mod table;

use names::{NAMES, TYPES};
use pest::Parser;
use plans::PLANS;
use rewrite::{FoundPart, MatchedPart, PartKind, rewrites};
pub(crate) use rewrite::{HabitPiece, HabitRewrite};
use row::Habit;
pub(crate) use row::HabitPlace;
use setpiece_grammar::{PitchParser, Rule};
use setpiece_scenario::vocabulary::{EventKind, Role};
use std::borrow::Cow;
use table::HABITS;

/// Tokens on either side of a place that are looked at.
const WINDOW: usize = 64;

/// A bracket that does not touch what stands before it.
pub(crate) const BRACKET_APART: &str = " (";

/// A habit that was met.
#[derive(Debug, PartialEq, Eq)]
pub(crate) struct FoundHabit {
    /// What to write.
    pub(crate) help: String,
    /// Whether it goes on with what stands before the place.
    pub(crate) begins: Begins,
    /// How its help is followed, if that is known.
    pub(crate) rewrites: Vec<HabitRewrite>,
}

/// What a pattern found in some tokens.
#[derive(Clone, Debug, Default)]
struct Matched<'t> {
    /// What it left open.
    open: Vec<Cow<'t, str>>,
    /// Every part.
    parts: Vec<FoundPart>,
}

impl Matched<'_> {
    fn len(&self) -> (usize, usize) {
        (self.open.len(), self.parts.len())
    }

    fn truncate(&mut self, (open, parts): (usize, usize)) {
        self.open.truncate(open);
        self.parts.truncate(parts);
    }
}

/// Where what a habit writes begins.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Begins {
    /// At the place: a new statement.
    New,
    /// Before it.
    Before,
    /// It isn't known.
    Either,
}

/// What to write for a name that nothing has.
pub(crate) fn of_name(name: &str) -> Option<String> {
    NAMES.iter().find_map(|habit| habit.at(&[], &[name], true)).map(|found| found.help)
}

/// The type that another language calls by a name.
pub(crate) fn of_type(name: &str) -> Option<&'static str> {
    TYPES.iter().find_map(|(theirs, ours)| theirs.contains(&name).then_some(*ours))
}

/// What to write where the tokens of a statement stop making sense at one of them; the unreadable
/// begins at `first`. Gives the token, too, that the habit is seen at.
pub(crate) fn of_text(
    place: HabitPlace,
    tokens: &[&str],
    at: usize,
    first: usize,
) -> Option<(usize, FoundHabit)> {
    let habits = PLANS
        .iter()
        .chain(HABITS)
        .filter(|habit| habit.place == place || habit.place == HabitPlace::Anywhere);
    // A sign is only wrong where nothing fits.
    let word = |token: &&str| {
        token.starts_with(|char: char| char.is_alphanumeric() || "_\"".contains(char))
    };
    let first = if tokens.get(first).is_some_and(word) { first } else { at };
    habits.flat_map(|habit| [(habit, at), (habit, first)]).find_map(|(habit, at)| {
        let (before, behind) = tokens.split_at_checked(at)?;
        let near = (
            before.get(before.len().saturating_sub(WINDOW)..)?,
            behind.get(..behind.len().min(WINDOW))?,
        );
        let mut found = habit.at(near.0, near.1, at == first)?;
        let skipped = before.len() - near.0.len();
        for rewrite in &mut found.rewrites {
            rewrite.move_by(skipped);
        }
        Some((at, found))
    })
}

impl Habit {
    /// Whether it is met between two parts of a statement.
    fn at(&self, before: &[&str], behind: &[&str], begins: bool) -> Option<FoundHabit> {
        let (left, right) = self.seen.split_once('|').unwrap_or(("", self.seen));
        let (mut found, mut ahead) = (Matched::default(), Matched::default());
        let pattern: Vec<&str> = right.split_whitespace().chain(["…"]).collect();
        if !matches(&pattern, behind, &mut found) {
            return None;
        }
        let left = left.trim();
        let begin = if left == "^" {
            if !begins {
                return None;
            }
            Begins::New
        } else {
            let pattern: Vec<&str> = ["…"].into_iter().chain(left.split_whitespace()).collect();
            if !matches(&pattern, before, &mut ahead) {
                return None;
            }
            if left.is_empty() { Begins::Either } else { Begins::Before }
        };
        // What stands before and behind doesn't belong to it.
        let (left, right) = (ahead.parts.get(1..).unwrap_or_default(), found.parts.split_last());
        let of_right = right.map_or(&[][..], |(_, parts)| parts);
        let parts: Vec<MatchedPart> = left
            .iter()
            .map(|part| part.before(before.len()))
            .chain(of_right.iter().map(|part| part.before(before.len() + behind.len())))
            .collect();
        ahead.open.append(&mut found.open);
        let tokens: Vec<&str> = before.iter().chain(behind).copied().collect();
        Some(FoundHabit {
            help: filled(self.write, &ahead.open),
            begins: begin,
            rewrites: rewrites(self.write, &ahead.open, &parts, (&tokens, before.len())),
        })
    }
}

/// What a habit's help says, with what was left open.
fn filled(write: &str, open: &[Cow<'_, str>]) -> String {
    let fill = |help: String, (index, text): (usize, &Cow<'_, str>)| {
        help.replace(&format!("{{{}}}", index + 1), text.trim_matches('"'))
    };
    open.iter().enumerate().fold(write.to_owned(), fill)
}

/// Whether a pattern is all of some tokens; notes what it found.
fn matches<'t>(pattern: &[&str], tokens: &[&'t str], found: &mut Matched<'t>) -> bool {
    let Some((wanted, pattern)) = pattern.split_first() else { return tokens.is_empty() };
    let left = tokens.len();
    let known = found.len();
    if *wanted == "…" {
        if pattern.is_empty() {
            found.parts.push(FoundPart { kind: PartKind::Gap, left, count: left });
            return true;
        }
        return (0..=left).any(|skipped| {
            found.truncate(known);
            found.parts.push(FoundPart { kind: PartKind::Gap, left, count: skipped });
            tokens.get(skipped..).is_some_and(|rest| matches(pattern, rest, found))
        });
    }
    // A lone question mark is that sign.
    if let Some(optional) = wanted.strip_suffix('?').filter(|optional| !optional.is_empty()) {
        let stands = tokens.split_first().filter(|(token, _)| **token == optional);
        if stands.is_some_and(|(_, rest)| {
            found.parts.push(FoundPart { kind: PartKind::Word, left, count: 1 });
            matches(pattern, rest, found)
        }) {
            return true;
        }
        found.truncate(known);
        return matches(pattern, tokens, found);
    }
    let open = PartKind::Open(found.open.len());
    if *wanted == "±9"
        && let ["-", number, tokens @ ..] = tokens
    {
        found.open.push(format!("-{number}").into());
        found.parts.push(FoundPart { kind: open, left, count: 2 });
        return is_number(number) && matches(pattern, tokens, found);
    }
    let Some((token, tokens)) = tokens.split_first() else {
        return *wanted == "$" && matches(pattern, tokens, found);
    };
    let digits = token.starts_with(|char: char| char.is_ascii_digit());
    let letters = token.contains(|char: char| char.is_alphabetic() || char == '_');
    let meant = match *wanted {
        "$" => false,
        "*" => true,
        "_" => PitchParser::parse(Rule::ident, token).is_ok_and(|pairs| pairs.as_str() == *token),
        "9" | "±9" => is_number(token),
        "9a" => digits && letters,
        "é" => letters && !token.is_ascii() && !token.starts_with('"'),
        "\"\"" => token.starts_with('"'),
        "ROLE" => Role::from_name(token).is_some(),
        "EVENT" => EventKind::from_name(token).is_some(),
        literal if literal.starts_with(char::is_alphabetic) && literal.ends_with('*') => {
            let rest = token.strip_prefix(literal.trim_end_matches('*'));
            found.open.extend(rest.map(Cow::from));
            found.parts.push(FoundPart { kind: open, left, count: 1 });
            return rest.is_some() && matches(pattern, tokens, found);
        }
        literals if literals.contains('¦') => literals.split('¦').any(|literal| literal == *token),
        literal => {
            let is_it = if literal == "␣(" {
                *token == BRACKET_APART
            } else {
                literal.trim_start_matches('\\') == token.trim_start()
            };
            found.parts.push(FoundPart { kind: PartKind::Word, left, count: 1 });
            return is_it && matches(pattern, tokens, found);
        }
    };
    if meant {
        found.open.push((*token).into());
        found.parts.push(FoundPart { kind: open, left, count: 1 });
    }
    meant && matches(pattern, tokens, found)
}

/// Whether a token is a number without letters.
fn is_number(token: &str) -> bool {
    token.starts_with(|char: char| char.is_ascii_digit())
        && !token.contains(|char: char| char.is_alphabetic() || char == '_')
}

#[cfg(test)]
mod tests {
    use super::*;

    fn text(place: HabitPlace, tokens: &str, at: usize) -> Option<String> {
        of_text(place, &tokens.split_whitespace().collect::<Vec<_>>(), at, 0)
            .map(|(_, found)| found.help)
    }

    #[test]
    fn what_is_left_open_is_filled_in() {
        assert_eq!(
            text(HabitPlace::Fields, "offside = off", 1).as_deref(),
            Some("write `offside: off`")
        );
        assert_eq!(text(HabitPlace::Reward, "x += 1", 1).as_deref(), Some("write `x = x + …`"));
        assert_eq!(of_name("e_PlayerRole_CM").as_deref(), Some("write `CM`"));
    }

    /// The statement with the first way to follow its help.
    fn mended(place: HabitPlace, tokens: &str, at: usize) -> Option<String> {
        let tokens: Vec<&str> = tokens.split_whitespace().collect();
        let (_, found) = of_text(place, &tokens, at, 0)?;
        let (range, pieces) = found.rewrites.into_iter().next()?.places.into_iter().next()?;
        let mut words = tokens[..range.start].to_vec();
        let mut end = range.end;
        for piece in &pieces {
            match piece {
                HabitPiece::Text(text) => words.extend(text.split_whitespace()),
                HabitPiece::Kept(kept) => words.extend(&tokens[kept.clone()]),
                HabitPiece::Rest(from) => {
                    words.extend(&tokens[*from..]);
                    end = tokens.len();
                }
            }
        }
        words.extend(&tokens[end..]);
        Some(words.join(" "))
    }

    #[test]
    fn what_is_written_takes_the_place_of_what_was_seen() {
        for (place, tokens, at, expected) in [
            (HabitPlace::Fields, "offside = off , cards : on", 1, "offside: off , cards : on"),
            (HabitPlace::Reward, "give 1 if us has ball", 2, "give 1 when us has ball"),
            (HabitPlace::Team, "CM at ( 0 , 0 ) maybe 40 %", 7, "maybe 40% CM at ( 0 , 0 )"),
            (HabitPlace::Team, "AddPlayer ( 0 , 0 , CM , lazy ) GK", 0, "CM at own (0, 0) GK"),
            (HabitPlace::Scenario, "end when goal success", 3, "end success when goal"),
            (HabitPlace::Reward, "give 1 each step", 2, "give 1"),
        ] {
            assert_eq!(mended(place, tokens, at).as_deref(), Some(expected), "{tokens}");
        }
        // What is mentioned, and what the author has to say, is not written.
        for (place, tokens, at) in
            [(HabitPlace::Team, "maybe CM", 0), (HabitPlace::Anywhere, "let größe = 1", 1)]
        {
            assert_eq!(mended(place, tokens, at), None, "{tokens}");
        }
    }

    #[test]
    fn a_number_keeps_its_sign() {
        for (tokens, help) in [
            ("AddPlayer ( - 0.5 , 0.1 , CM", "write `CM at own (-0.5, 0.1)`"),
            (
                "builder . AddPlayer ( 0.5 , - 0.1 , e_PlayerRole_CM",
                "write `CM at own (0.5, -0.1)`",
            ),
            (
                "AddPlayer ( - 0.5 , - 0.1 , PlayerRole . e_PlayerRole_CM",
                "write `CM at own (-0.5, -0.1)`",
            ),
            ("builder . SetBallPosition ( 0.62 , 0.1 )", "write `ball at (0.62, 0.1)`"),
            ("SetBallPosition ( - 0.62 , y )", "write `ball at (0.6, 0)`"),
        ] {
            assert_eq!(text(HabitPlace::Team, tokens, 0).as_deref(), Some(help), "{tokens}");
        }
    }

    #[test]
    fn a_row_belongs_to_its_place() {
        assert_ne!(text(HabitPlace::Reward, "elif x", 0), text(HabitPlace::Behavior, "elif x", 0));
        assert_eq!(of_name("elif"), None);
        assert_eq!(text(HabitPlace::Team, "striker", 1), None);
    }

    #[test]
    fn every_row_can_be_met() {
        for habit in PLANS.iter().chain(HABITS) {
            assert!(!habit.write.is_empty() && !habit.seen.trim().is_empty());
            assert_eq!(
                habit.place == HabitPlace::Name,
                !habit.seen.contains('|'),
                "{}",
                habit.seen
            );
            let open = habit.seen.split_whitespace().filter(|token| {
                ["_", "*", "9", "±9", "9a", "é", "\"\"", "ROLE", "EVENT"].contains(token)
                    || token.contains('¦')
                    || token.ends_with("_*")
            });
            let open = open.count();
            for index in 1..9 {
                assert!(
                    index <= open || !habit.write.contains(&format!("{{{index}}}")),
                    "{}",
                    habit.seen
                );
            }
        }
    }
}
