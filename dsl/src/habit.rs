//! Habits of other languages and near misses of form: what is seen, and what to write instead.

mod table;

use pest::Parser;
use setpiece_grammar::{PitchParser, Rule};
use setpiece_scenario::vocabulary::{EventKind, Role};
use std::borrow::Cow;
use table::HABITS;

/// Tokens on either side of a place that are looked at.
const WINDOW: usize = 64;

/// A bracket that does not touch what stands before it.
pub(crate) const BRACKET_APART: &str = " (";

/// Where a habit is met.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum HabitPlace {
    /// A name that nothing has.
    Name,
    /// Text that can't be read, in any list of statements.
    Anywhere,
    /// The same, outside of everything.
    File,
    /// In a scenario.
    Scenario,
    /// In a team or formation.
    Team,
    /// In a reward.
    Reward,
    /// In a behaviour.
    Behavior,
    /// In a suite, check or curriculum.
    Level,
    /// Among options.
    Fields,
}

/// A row of the table.
struct Habit {
    place: HabitPlace,
    /// The tokens; `|` stands before the one that can't be read, `^ |` where the unreadable text
    /// begins.
    ///
    /// `_` is a name, `""` a string, `9` a number, `±9` one with or without a minus, `9a` a number
    /// with letters, `é` a word of other letters, `ROLE` a role, `EVENT` an event, `␣(` a bracket
    /// behind a blank, `a¦b` one of two, `a*` what begins with `a`, `a?` what may stand there, `*`
    /// any token and `\*` that sign, `…` any number of them, `$` the end.
    seen: &'static str,
    /// What to write; `{1}` is the first that was not spelt out in `seen`.
    write: &'static str,
}

/// A habit that was met.
#[derive(Debug, PartialEq, Eq)]
pub(crate) struct FoundHabit {
    /// What to write.
    pub(crate) help: String,
    /// Whether it goes on with what stands before the place.
    pub(crate) begins: Begins,
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
    let mut habits = HABITS.iter().filter(|habit| habit.place == HabitPlace::Name);
    habits.find_map(|habit| habit.at(&[], &[name], true)).map(|found| found.help)
}

/// What to write where the tokens of a statement stop making sense at one of them; the unreadable
/// begins at `first`. Gives the token, too, that the habit is seen at.
pub(crate) fn of_text(
    place: HabitPlace,
    tokens: &[&str],
    at: usize,
    first: usize,
) -> Option<(usize, FoundHabit)> {
    let habits =
        HABITS.iter().filter(|habit| habit.place == place || habit.place == HabitPlace::Anywhere);
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
        Some((at, habit.at(near.0, near.1, at == first)?))
    })
}

impl Habit {
    /// Whether it is met between two parts of a statement.
    fn at(&self, before: &[&str], behind: &[&str], begins: bool) -> Option<FoundHabit> {
        let (left, right) = self.seen.split_once('|').unwrap_or(("", self.seen));
        let (mut found, mut ahead) = (Vec::new(), Vec::new());
        let pattern: Vec<&str> = right.split_whitespace().chain(["…"]).collect();
        if !matches(&pattern, behind, &mut found) {
            return None;
        }
        let left = left.trim();
        if left == "^" {
            return begins.then(|| self.found(Begins::New, &found));
        }
        let pattern: Vec<&str> = ["…"].into_iter().chain(left.split_whitespace()).collect();
        if !matches(&pattern, before, &mut ahead) {
            return None;
        }
        ahead.append(&mut found);
        Some(self.found(if left.is_empty() { Begins::Either } else { Begins::Before }, &ahead))
    }

    fn found(&self, begins: Begins, open: &[Cow<'_, str>]) -> FoundHabit {
        let fill = |help: String, (index, text): (usize, &Cow<'_, str>)| {
            help.replace(&format!("{{{}}}", index + 1), text.trim_matches('"'))
        };
        FoundHabit { help: open.iter().enumerate().fold(self.write.to_owned(), fill), begins }
    }
}

/// Whether a pattern is all of some tokens; notes what it left open.
fn matches<'t>(pattern: &[&str], tokens: &[&'t str], found: &mut Vec<Cow<'t, str>>) -> bool {
    let Some((wanted, pattern)) = pattern.split_first() else { return tokens.is_empty() };
    if *wanted == "…" {
        let known = found.len();
        return pattern.is_empty()
            || (0..=tokens.len()).any(|skipped| {
                found.truncate(known);
                tokens.get(skipped..).is_some_and(|rest| matches(pattern, rest, found))
            });
    }
    // A lone question mark is that sign.
    if let Some(optional) = wanted.strip_suffix('?').filter(|optional| !optional.is_empty()) {
        let known = found.len();
        let stands = tokens.split_first().filter(|(token, _)| **token == optional);
        if stands.is_some_and(|(_, rest)| matches(pattern, rest, found)) {
            return true;
        }
        found.truncate(known);
        return matches(pattern, tokens, found);
    }
    if *wanted == "±9"
        && let ["-", number, tokens @ ..] = tokens
    {
        found.push(format!("-{number}").into());
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
            found.extend(rest.map(Cow::from));
            return rest.is_some() && matches(pattern, tokens, found);
        }
        literals if literals.contains('¦') => literals.split('¦').any(|literal| literal == *token),
        "␣(" => return *token == BRACKET_APART && matches(pattern, tokens, found),
        literal => {
            return literal.trim_start_matches('\\') == token.trim_start()
                && matches(pattern, tokens, found);
        }
    };
    if meant {
        found.push((*token).into());
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
        for habit in HABITS {
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
