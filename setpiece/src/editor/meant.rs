//! What the words of a help may mean as a change of the text.
//!
//! Most helps bring their changes as data ([`TextReport::rewrites`]). Where they don't, what stands
//! between their backticks is tried.

use super::Analysis;
use super::closing::closings;
use super::edits::Edit;
use super::elsewhere::elsewhere;
use super::fixes::{Try, names_unit};
use super::report::TextReport;
use super::text::{brackets, line_around};
use crate::dsl::problem::Code;
use crate::scenario::pitch::STEPS_PER_S;
use std::ops::Range;
use std::path::Path;

/// The edits of one text that a report's help may mean, the likeliest first.
pub(super) fn meant(analysis: &Analysis, path: &Path, report: &TextReport) -> Vec<Try> {
    let Some(help) = &report.help else { return Vec::new() };
    let range = report.place.range.clone();
    let marked = analysis.text.get(range.clone()).unwrap_or_default();
    let write = |range: Range<usize>, text: String| Try {
        title: format!("write `{text}`"),
        edits: vec![Edit::replace(path, range, text)],
    };
    let mut tries = Vec::new();
    let line = line_around(&analysis.text, range.start);
    let whole_line = analysis.text.get(line).unwrap_or_default().to_owned();
    // An example isn't what the author meant; of one with a unit, the unit is.
    let is_example =
        ["for example", "as in `"].iter().any(|it| help.contains(it)) || names_unit(report);
    if only_lists(help) {
        return Vec::new();
    }
    if matches!(report.code, Code::UnclosedBracket | Code::UnclosedString) {
        let places = closings(&analysis.text, range.start);
        let closed = places.into_iter().map(|(at, sign)| Try {
            title: format!("close it with `{}`", one_line(&sign)),
            edits: vec![Edit::replace(path, at..at, sign)],
        });
        tries.extend(closed);
        // One that closes another kind of bracket opens nothing: it is replaced.
        if !tries.is_empty() {
            return tries;
        }
    }
    let before = analysis.text.get(..range.start).unwrap_or_default();
    tries.extend(nearest_of(help, marked).map(|text| write(range.clone(), text)));
    if report.elsewhere.is_some() {
        return elsewhere(analysis, path, report).into_iter().collect();
    }
    for (text, goes_on) in quoted(help) {
        // `2..11 CB …` is the beginning of what is marked.
        if let Some(begin) = begin_of(marked, text).filter(|_| goes_on) {
            tries.push(write(range.start..range.start + begin, text.to_owned()));
        }
        let Some(text) = behind(before, text) else { continue };
        let unit = text.trim_start_matches(|sign: char| sign.is_ascii_digit() || sign == '.');
        let has_unit =
            unit.len() < text.len() && unit.trim_start().starts_with(char::is_alphabetic);
        if text.starts_with("/ ") {
            tries.push(write(range.clone(), format!("{marked} {text}")));
        } else if has_unit && is_number(marked) {
            tries.push(write(range.clone(), format!("{marked}{unit}")));
        } else if !has_unit && !is_example && !invents(text, marked, &whole_line) {
            tries.push(write(range.clone(), text.to_owned()));
            // A line of another language is replaced as a whole.
            let line = line_around(&analysis.text, range.start);
            let written = analysis.text.get(line.clone()).unwrap_or_default();
            let begin = line.start + written.len() - written.trim_start().len();
            if begin == range.start {
                tries.push(write(begin..line.start + written.trim_end().len(), text.to_owned()));
            }
            // What is written in brackets may stand for the brackets around.
            let around = brackets(&analysis.text)
                .into_iter()
                .rev()
                .find(|pair| pair.open <= range.start && range.end <= pair.close);
            if let Some(pair) = around.filter(|_| text.starts_with(['(', '[', '{'])) {
                tries.push(write(pair.open..pair.close, text.to_owned()));
            }
            if let [sign] = text.as_bytes()
                && sign.is_ascii_punctuation()
            {
                tries.push(write(range.start..range.start, text.to_owned()));
                tries.push(write(range.end..range.end, text.to_owned()));
            }
        }
    }
    if ["leave it out", "leave one", "take the"].iter().any(|it| help.contains(it)) {
        tries.extend(left_out(analysis, path, &range));
    }
    if let [only] = tries.as_mut_slice()
        && !is_example
        && !["did you mean", "write a value"].iter().any(|it| help.starts_with(it))
    {
        only.title.clone_from(help);
    }
    tries
}

/// Whether a help says what there is, not what is meant.
fn only_lists(help: &str) -> bool {
    let begins = |words: &[&str]| words.iter().any(|it| help.starts_with(it));
    let is_asked = begins(&["write", "did you mean"]);
    // How a function is written says nothing of its values.
    let is_signature = help.starts_with('`') && help.ends_with(")`");
    help.contains("use one of")
        || begins(&["it has", "keep", "begin"])
        || (!is_asked && quoted(help).count() > 2)
        || is_signature
}

/// The marked text left out: alone, with what joins it, and with its line.
fn left_out(analysis: &Analysis, path: &Path, range: &Range<usize>) -> Vec<Try> {
    let leave = |range: Range<usize>, what: &str| Try {
        title: format!("leave out {what}"),
        edits: vec![Edit::replace(path, range, "")],
    };
    let marked = one_line(analysis.text.get(range.clone()).unwrap_or_default());
    let before = analysis.text.get(..range.start).unwrap_or_default().trim_end();
    let mut tries = vec![leave(range.clone(), &format!("`{marked}`"))];
    if let Some(comma) = before.strip_suffix(',') {
        tries.push(leave(comma.len()..range.end, &format!("`{marked}`")));
    }
    // Of `to me`, both words.
    let word = before.rsplit(char::is_whitespace).next().unwrap_or_default();
    if !word.is_empty() && word.chars().all(char::is_alphabetic) {
        let from = before.strip_suffix(word).unwrap_or(before).trim_end().len();
        tries.push(leave(from..range.end, &format!("`{word} {marked}`")));
    }
    tries.push(leave(line_around(&analysis.text, range.start), "the line"));
    tries
}

/// A text in a line of a title.
pub(super) fn one_line(text: &str) -> String {
    let words = text.split_whitespace().collect::<Vec<_>>().join(" ");
    if words.chars().count() > 40 { words.chars().take(39).chain(['…']).collect() } else { words }
}

/// What stands between backticks and can be written as it is, and whether more follows it.
fn quoted(help: &str) -> impl Iterator<Item = (&str, bool)> {
    let parts = help.split('`').skip(1).step_by(2);
    parts
        .map(|part| (part.trim_end_matches(" …"), part.ends_with(" …")))
        .filter(|(part, _)| !part.contains('…') && !part.is_empty())
}

/// How many bytes of a text are as many words as another one has, if only the first differs.
fn begin_of(marked: &str, text: &str) -> Option<usize> {
    let words: Vec<&str> = text.split_whitespace().collect();
    let own: Vec<&str> = marked.split_whitespace().take(words.len()).collect();
    let last = own.last().filter(|_| words.len() > 1 && own.get(1..) == words.get(1..))?;
    // The last word stands in the marked text itself.
    Some(last.as_ptr() as usize - marked.as_ptr() as usize + last.len())
}

/// The end of a range that is nearest to a number outside of it, if a help says to stay within one.
fn nearest_of(help: &str, marked: &str) -> Option<String> {
    let range = help.strip_prefix("write a value in `")?.split('`').next()?;
    let (low, high) = range.split_once("..")?;
    let value = |text: &str| -> Option<f64> {
        let unit = text.trim_start_matches(|sign: char| "-0123456789.e".contains(sign));
        let number: f64 = text.strip_suffix(unit)?.parse().ok()?;
        Some(match unit.trim() {
            "%" => number / 100.0,
            "s" => number * STEPS_PER_S,
            _ => number,
        })
    };
    let (value, low_value) = (value(marked)?, value(low)?);
    Some(if value < low_value { low } else { high }.to_owned())
}

/// What a help says to write behind what stands before the place already: of `give 1 when`, it is
/// `when` behind `give -1`. None if the author has written another beginning of it.
fn behind<'t>(before: &str, text: &'t str) -> Option<&'t str> {
    let line = before.rsplit('\n').next().unwrap_or_default();
    let written: Vec<&str> = line.split_whitespace().collect();
    let is_alike =
        |(one, other): (&&str, &str)| *one == other || (is_number(one) && is_number(other));
    let words = || text.split_whitespace();
    let starts = |count: usize| {
        written.len() >= count && written[written.len() - count..].iter().zip(words()).all(is_alike)
    };
    let count = words().count();
    let Some(known) = (1..count).rev().find(|count| starts(*count)) else {
        let first = words().next().unwrap_or_default();
        let is_word = first.len() > 1 && first.chars().all(char::is_alphabetic);
        let stands = count > 1 && is_word && statement_of(line).contains(&first);
        return (!stands).then_some(text);
    };
    let mut rest = text;
    for _ in 0..known {
        rest = rest.trim_start().split_once(char::is_whitespace)?.1;
    }
    Some(rest.trim_start())
}

/// The words of the statement under way at the end of a line.
fn statement_of(line: &str) -> Vec<&str> {
    line.rsplit(['{', '}']).next().unwrap_or_default().split_whitespace().collect()
}

/// Whether a help has numbers of its own where the author wrote others.
fn invents(text: &str, marked: &str, line: &str) -> bool {
    let numbers = |text: &str| -> Vec<String> {
        let parts = text.split(|sign: char| !(sign.is_alphanumeric() || matches!(sign, '.' | '_')));
        let begins = |part: &&str| part.starts_with(|sign: char| sign.is_ascii_digit());
        parts
            .flat_map(|part| part.split(".."))
            .filter(begins)
            .map(|part| part.trim_end_matches(char::is_alphabetic).to_owned())
            .collect()
    };
    let written = numbers(line);
    let is_new = !is_number(marked) || text.contains(['(', '[', '{']);
    is_new && !written.is_empty() && numbers(text).iter().any(|number| !written.contains(number))
}

fn is_number(text: &str) -> bool {
    text.parse::<f64>().is_ok()
}
