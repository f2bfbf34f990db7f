//! What is said about the thing under the cursor.

use super::text::word_at;
use super::words::{self, Word};
use super::{Analysis, FilePlace, Workspace};
use crate::dsl::index::ValueFact;
use crate::scenario::pitch::to_normalised;
use std::fmt::Write as _;
use std::ops::Range;
use std::path::Path;

/// Words about a place of a text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Hover {
    /// Markdown.
    pub text: String,
    /// The bytes that it is about.
    pub range: Range<usize>,
}

impl Workspace {
    /// What is known of the name, word or expression at a byte of a text.
    pub fn hover(&mut self, path: &Path, offset: usize) -> Option<Hover> {
        let declaration = self.declaration(path, offset);
        let analysis = self.analysis(path)?;
        let range = word_at(&analysis.text, offset);
        let word = analysis.text.get(range.clone()).unwrap_or_default();
        let fact = analysis.value_around(offset);
        let mut parts: Vec<String> = Vec::new();
        match declaration {
            Some(declaration) => parts.extend(analysis.declared(&declaration)),
            None => parts.extend(words::all().filter(|known| known.name == word).map(about)),
        }
        if let Some((_, value)) = &fact {
            parts.push(shown(value));
        }
        let range = if range.is_empty() { fact.map(|(at, _)| at)? } else { range };
        (!parts.is_empty()).then(|| Hover { text: parts.join("\n\n"), range })
    }
}

impl Analysis {
    /// The smallest expression around a byte, with what is known of it.
    fn value_around(&self, offset: usize) -> Option<(Range<usize>, &ValueFact)> {
        self.index
            .values()
            .filter_map(|(span, fact)| Some((self.own(span)?, fact)))
            .filter(|(own, _)| own.start <= offset && offset <= own.end)
            .min_by_key(|(own, _)| own.len())
    }

    /// The first line of a declaration, and the comment above it.
    fn declared(&self, declaration: &FilePlace) -> Option<String> {
        let name = crate::files::name_of(&declaration.path);
        let (_, source) = self.sources.iter().find(|(_, source)| source.name == name)?;
        let before = source.text.get(..declaration.range.start)?;
        let start = before.rfind('\n').map_or(0, |at| at + 1);
        let line = source.text.get(start..)?.lines().next()?.trim();
        let comments = before.get(..start)?.lines().rev();
        let mut doc: Vec<&str> =
            comments.map_while(|line| line.trim().strip_prefix("///")).map(str::trim).collect();
        doc.reverse();
        let mut text = format!("```pitch\n{line}\n```");
        if !doc.is_empty() {
            let _ = write!(text, "\n\n{}", doc.join("\n"));
        }
        Some(text)
    }
}

/// A word of the language.
fn about(word: Word) -> String {
    format!("**{}**: {} ([{}](docs/language/{}))", word.name, word.doc, word.page, word.page)
}

/// The type of an expression, and its value if it is a constant.
fn shown(fact: &ValueFact) -> String {
    let round = |value: f64| (value * 1000.0).round() / 1000.0 + 0.0;
    match (fact.constants.as_slice(), fact.ty.as_str()) {
        (&[x, y], ty) if fact.is_point => {
            let (u, v) = to_normalised(x, y);
            let [x, y, u, v] = [x, y, u, v].map(round);
            format!("{ty}: ({x}m, {y}m), normalised ({u}, {v})")
        }
        (&[value], "a length") => format!("a length: {}m", round(value)),
        (&[value], "a duration") => {
            format!("a duration: {}s, {} steps", round(value), round(value * 10.0))
        }
        (&[value], "a speed") => format!("a speed: {}m/s", round(value)),
        (&[value], "an angle") => format!("an angle: {}deg", round(value.to_degrees())),
        (&[value], "a percentage") => format!("a percentage: {}%", round(100.0 * value)),
        (&[value], "a number" | "a whole number") => format!("{}: {}", fact.ty, round(value)),
        (_, ty) => ty.to_owned(),
    }
}
