//! What an author may have meant by a name that nothing has.

use crate::habit;

/// A similar name is looked for if the name is at most this long, bytes: comparing costs the
/// product of both lengths.
const SIMILAR_BYTES_MAX: usize = 64;
/// A similar name is looked for among this many candidates at most. More names than that are no
/// longer a typo's neighbours, and a text may hold as many wrong names as right ones.
const CANDIDATES_MAX: usize = 1_000;
/// How alike two names must be, from 0 to 1.
const LIKENESS_MIN: f64 = 0.6;

/// How alike a name is to one that says more: `goal_width` to `goal`.
const LIKENESS_OF_MORE: f64 = 0.72;

/// The candidate most like `found`, if it is like enough (similarity above 0.6).
pub fn nearest<'a>(found: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    if found.len() > SIMILAR_BYTES_MAX {
        return None;
    }
    let found = found.to_lowercase();
    let mut best = (LIKENESS_MIN, None);
    for candidate in candidates.into_iter().take(CANDIDATES_MAX) {
        let lowered = candidate.to_lowercase();
        let more = found.strip_prefix(&lowered).is_some_and(|rest| rest.starts_with('_'));
        if more && !lowered.is_empty() && best.0 < LIKENESS_OF_MORE {
            best = (LIKENESS_OF_MORE, Some(candidate));
            continue;
        }
        if lowered.len() > SIMILAR_BYTES_MAX || likeness_at_most(&found, &lowered) <= best.0 {
            continue;
        }
        let likeness = strsim::normalized_damerau_levenshtein(&found, &lowered);
        if likeness > best.0 {
            best = (likeness, Some(candidate));
        }
    }
    best.1
}

/// A bound of the likeness of two names that is quick to compute: letters that only one of them has
/// must be edited.
fn likeness_at_most(a: &str, b: &str) -> f64 {
    let (long, short) = if a.chars().count() < b.chars().count() { (b, a) } else { (a, b) };
    let mut counts = [0_u8; 64];
    let slot = |letter: char| letter as usize % 64;
    for letter in short.chars() {
        if let Some(count) = counts.get_mut(slot(letter)) {
            *count += 1;
        }
    }
    let (mut length, mut common) = (0_u32, 0_u32);
    for letter in long.chars() {
        length += 1;
        if let Some(count) = counts.get_mut(slot(letter)).filter(|count| **count > 0) {
            *count -= 1;
            common += 1;
        }
    }
    if length == 0 { 1.0 } else { f64::from(common) / f64::from(length) }
}

/// What an author may have meant by a name that nothing has, and what they could have written
/// instead.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Guess {
    /// What was probably meant.
    pub(super) meant: Option<Meant>,
    /// All that there is, where nothing is similar enough.
    pub(super) known: Vec<String>,
}

/// What was probably meant.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Meant {
    /// A similar name.
    Name(String),
    /// How a word of another language is written here.
    Habit(String),
}

impl Guess {
    /// Knows the words of other languages and the most similar candidate.
    pub(crate) fn of<'a>(found: &str, candidates: impl IntoIterator<Item = &'a str>) -> Guess {
        let name = || nearest(found, candidates).map(|name| Meant::Name(name.to_owned()));
        Guess { meant: habit::of_name(found).map(Meant::Habit).or_else(name), known: Vec::new() }
    }

    /// Knows what was meant.
    pub(crate) fn sure(meant: String) -> Guess {
        Guess { meant: Some(Meant::Name(meant)), known: Vec::new() }
    }

    /// The same; lists all that there is if nothing is similar and no other language has the word.
    pub(crate) fn or_all(found: &str, known: &[&str]) -> Guess {
        match Guess::of(found, known.iter().copied()) {
            Guess { meant: None, .. } => Guess::all(known),
            guess => guess,
        }
    }

    /// Knows the types of other languages.
    pub(crate) fn of_type(found: &str, known: &[&str]) -> Guess {
        match habit::of_type(found) {
            Some(ours) => Guess::sure(ours.to_owned()),
            None => Guess::similar_or_all(found, known),
        }
    }

    /// The same, but where nothing is similar it lists all that there is even for a word of another
    /// language.
    pub(crate) fn similar_or_all(found: &str, known: &[&str]) -> Guess {
        if known.is_empty() { Guess::of(found, []) } else { Guess::similar_or(found, known, known) }
    }

    /// The same; lists others than those that may be similar.
    pub(crate) fn similar_or(found: &str, known: &[&str], listed: &[&str]) -> Guess {
        if nearest(found, known.iter().copied()).is_some() {
            Guess::of(found, known.iter().copied())
        } else {
            Guess::all(listed)
        }
    }

    /// The same, but what was meant is written as `read` says; nothing is guessed where it can't be
    /// read.
    pub(crate) fn read_as(self, read: impl FnOnce(&str) -> Option<String>) -> Guess {
        let meant = match self.meant {
            Some(Meant::Name(name)) => read(&name).map(Meant::Name),
            meant => meant,
        };
        Guess { meant, ..self }
    }

    fn all(known: &[&str]) -> Guess {
        Guess { meant: None, known: known.iter().map(|&name| name.to_owned()).collect() }
    }
}
