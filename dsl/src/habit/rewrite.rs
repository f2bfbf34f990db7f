//! How the help of a habit is followed in the text: what is written, in the place of which tokens.

use super::filled;
use std::borrow::Cow;
use std::ops::Range;

/// A part of a pattern that was found in some tokens, counted from their end.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct FoundPart {
    pub(super) kind: PartKind,
    /// How many tokens there are from its first one on.
    pub(super) left: usize,
    /// How many of them it is.
    pub(super) count: usize,
}

/// A part of a pattern, and the tokens that it was.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct MatchedPart {
    kind: PartKind,
    tokens: Range<usize>,
}

/// What a part of a pattern is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum PartKind {
    /// It is spelt out.
    Word,
    /// It was left open, as the nth.
    Open(usize),
    /// `…`
    Gap,
}

/// A way to follow a habit's help.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct HabitRewrite {
    /// What is written.
    pub(crate) says: String,
    /// In the place of which tokens, and of which pieces, the likeliest first.
    pub(crate) places: Vec<(Range<usize>, Vec<HabitPiece>)>,
}

/// A piece of what is written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum HabitPiece {
    /// Words and signs.
    Text(String),
    /// Tokens that stay as they are.
    Kept(Range<usize>),
    /// What follows in the line.
    Rest(usize),
}

impl FoundPart {
    /// The same among all tokens; `end`: where those end that the pattern was matched with.
    pub(super) fn before(&self, end: usize) -> MatchedPart {
        let start = end - self.left;
        MatchedPart { kind: self.kind, tokens: start..start + self.count }
    }
}

impl HabitRewrite {
    /// Counts tokens from an earlier one.
    pub(super) fn move_by(&mut self, skipped: usize) {
        for (range, pieces) in &mut self.places {
            *range = range.start + skipped..range.end + skipped;
            for piece in pieces {
                match piece {
                    HabitPiece::Kept(kept) => *kept = kept.start + skipped..kept.end + skipped,
                    HabitPiece::Rest(from) => *from += skipped,
                    HabitPiece::Text(_) => {}
                }
            }
        }
    }
}

/// How a help is followed: a way for every text between backticks without numbers of its own.
///
/// - `write`: the help of the table;
/// - `parts`: what the pattern found, in order;
/// - `tokens`: all that was looked at, and the one that can't be read.
pub(super) fn rewrites(
    write: &str,
    open: &[Cow<'_, str>],
    parts: &[MatchedPart],
    (tokens, at): (&[&str], usize),
) -> Vec<HabitRewrite> {
    // A text follows the words that lead to it.
    let words = write.split('`').step_by(2).map(str::trim_end);
    let quoted = write.split('`').skip(1).step_by(2);
    words
        .zip(quoted)
        .filter(|(words, text)| is_said(words) && !is_example(text))
        .filter_map(|(words, template)| {
            if words.ends_with("leave") {
                let end = parts.last()?.tokens.end;
                let places = vec![(at..end, Vec::new())];
                return Some(HabitRewrite { says: String::new(), places });
            }
            let template = template.strip_prefix('…').unwrap_or(template);
            let says = filled(template, open).trim().to_owned();
            let places = places(template, open, parts, (tokens, at));
            (!places.is_empty()).then_some(HabitRewrite { says, places })
        })
        .collect()
}

/// Whether a help says to write, or leave out, what follows some words of it: other texts are
/// mentioned.
fn is_said(words: &str) -> bool {
    [":", "write", "written", "or", "is", "with", "leave"].iter().any(|it| words.ends_with(it))
}

/// Whether a text has numbers that the author didn't write; `x = x + 1` is what they did write.
fn is_example(template: &str) -> bool {
    let known = template.strip_suffix("+ 1").or(template.strip_suffix("- 1"));
    let known = known.or(template.strip_prefix("0.")).unwrap_or(template);
    let mut bracket = false;
    known.chars().any(|sign| {
        bracket = sign == '{' || (bracket && sign.is_ascii_digit());
        sign.is_ascii_digit() && !bracket
    })
}

/// The places where a text of a help may go, the likeliest first.
fn places(
    template: &str,
    open: &[Cow<'_, str>],
    parts: &[MatchedPart],
    (tokens, at): (&[&str], usize),
) -> Vec<(Range<usize>, Vec<HabitPiece>)> {
    let Some(end) = parts.last().map(|part| part.tokens.end) else { return Vec::new() };
    let is_named = |part: &MatchedPart| match part.kind {
        PartKind::Open(nth) => template.contains(&format!("{{{}}}", nth + 1)),
        PartKind::Word => {
            let word = tokens.get(part.tokens.start).copied().unwrap_or_default().trim();
            let begin = template.get(..word.len()).unwrap_or_default();
            begin.eq_ignore_ascii_case(word)
        }
        PartKind::Gap => false,
    };
    let first = |is_it: &dyn Fn(&MatchedPart) -> bool| {
        parts.iter().find(|part| is_it(part)).map(|part| part.tokens.start)
    };
    let named = first(&is_named).map_or(at, |from| from.min(at));
    let whole = first(&|_| true).unwrap_or(at);
    // What is left open at the end and not written again may stay.
    let stays = |part: &&MatchedPart| matches!(part.kind, PartKind::Open(_)) && !is_named(part);
    let kept: usize = parts.iter().rev().take_while(stays).map(|part| part.tokens.len()).sum();
    let of_pattern = [named..end, named..end - kept, whole..end];
    // What repeats what stands before the place takes its place.
    let repeats = named < at;
    let of_place = [at..end, at..end - kept, at..at + 1].into_iter().filter(|_| !repeats);
    let ranges = of_pattern.into_iter().chain(of_place);
    let mut found: Vec<(Range<usize>, Vec<HabitPiece>)> = Vec::new();
    for range in ranges {
        if range.is_empty() || range.end > tokens.len() {
            continue;
        }
        let gaps: Vec<Range<usize>> = parts
            .iter()
            .filter(|part| part.kind == PartKind::Gap && range.contains(&part.tokens.start))
            .map(|part| part.tokens.clone())
            .collect();
        for rest in [None, Some(range.end)] {
            let Some(pieces) = pieces(template, open, &gaps, rest) else { continue };
            let range = balanced(&range, &pieces, tokens);
            let place = (range, pieces);
            if !found.contains(&place) {
                found.push(place);
            }
        }
    }
    found
}

/// What is written: gaps of the help are those of the pattern, in order. One more is what follows
/// in the line (`rest`), or ends what is written. None if something would be lost.
fn pieces(
    template: &str,
    open: &[Cow<'_, str>],
    gaps: &[Range<usize>],
    rest: Option<usize>,
) -> Option<Vec<HabitPiece>> {
    let texts: Vec<&str> = template.split('…').collect();
    let mut pieces = Vec::new();
    let mut gaps = gaps.iter();
    let mut has_rest = false;
    for (nth, text) in texts.iter().enumerate() {
        pieces.push(HabitPiece::Text(filled(text, open)));
        if nth + 1 == texts.len() {
            break;
        }
        match (gaps.next(), rest) {
            (Some(gap), _) => pieces.push(HabitPiece::Kept(gap.clone())),
            // What stands behind the last gap only closes it.
            (None, Some(from)) if nth + 2 == texts.len() && !texts[nth + 1].trim().is_empty() => {
                pieces.push(HabitPiece::Rest(from));
                has_rest = true;
            }
            (None, _) => break,
        }
    }
    let is_all = gaps.next().is_none() && has_rest == rest.is_some();
    is_all.then_some(pieces)
}

/// Some tokens, with the ends of brackets that what is written closes already.
fn balanced(range: &Range<usize>, pieces: &[HabitPiece], tokens: &[&str]) -> Range<usize> {
    let depth = |text: &str| -> isize {
        text.chars()
            .map(|sign| match sign {
                '(' | '[' | '{' => 1,
                ')' | ']' | '}' => -1,
                _ => 0,
            })
            .sum()
    };
    let of_tokens = |range: Range<usize>| -> isize {
        tokens.get(range).unwrap_or_default().iter().map(|token| depth(token)).sum()
    };
    let written: isize = pieces
        .iter()
        .map(|piece| match piece {
            HabitPiece::Text(text) => depth(text),
            HabitPiece::Kept(kept) => of_tokens(kept.clone()),
            HabitPiece::Rest(_) => 0,
        })
        .sum();
    let missing = of_tokens(range.clone()) - written;
    if missing <= 0 {
        return range.clone();
    }
    let end = (range.end..tokens.len()).find(|end| of_tokens(range.end..end + 1) <= -missing);
    range.start..end.map_or(range.end, |end| end + 1)
}
