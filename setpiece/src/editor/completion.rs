//! Something that may be written, made from the tables of words.

use super::keywords::{KEYWORDS, Keyword, KeywordBlock};
use super::words::{self, WordKind};

/// Something that may be written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Completion {
    /// What is written.
    pub text: String,
    /// What it is, in a few words.
    pub detail: String,
    /// What it means; may be empty.
    pub doc: String,
    /// What is written instead, with `${1:places}` to fill in; empty if it is the text.
    pub snippet: String,
    /// Its kind.
    pub kind: CompletionKind,
}

/// What kind of thing is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CompletionKind {
    /// A word that begins or joins a statement.
    Keyword,
    /// A name that a file declares.
    Name,
    /// A word of the language's tables.
    Word,
    /// The key of an option.
    Key,
    /// A file that can be imported.
    File,
}

/// What a parameter is, in a few words.
pub(super) const PARAMETER: &str = "a parameter";

/// The keywords that begin a statement in a block.
pub(super) fn keywords(block: KeywordBlock) -> Vec<Completion> {
    let known = KEYWORDS.iter().filter(|known| known.block == block);
    let completion = |known: &Keyword| Completion {
        text: known.name.to_owned(),
        detail: "statement".to_owned(),
        doc: known.doc.to_owned(),
        snippet: known.snippet.to_owned(),
        kind: CompletionKind::Keyword,
    };
    known.map(completion).collect()
}

/// A word of the language.
pub(super) fn word(text: &str, doc: &str, detail: &str) -> Completion {
    Completion {
        text: text.to_owned(),
        detail: detail.to_owned(),
        doc: doc.to_owned(),
        snippet: String::new(),
        kind: CompletionKind::Word,
    }
}

/// The words of some kinds.
pub(super) fn words_of(kinds: &[WordKind]) -> impl Iterator<Item = Completion> {
    let kinds = kinds.to_vec();
    words::all().filter(move |known| kinds.contains(&known.kind)).map(|known| {
        let detail = match known.kind {
            WordKind::Role => "role",
            WordKind::Event => "event",
            WordKind::Qualifier => "kind of event",
            WordKind::Function => "function",
            WordKind::Property => "property",
            WordKind::Place => "place",
            WordKind::Value => "in the match",
            WordKind::Option(_) => "option",
            WordKind::Measure => "measure",
            WordKind::Act => "act",
            WordKind::Action => "action",
            WordKind::Mode => "mode",
            WordKind::Type => "type",
            WordKind::OverTime => "over the episode",
            WordKind::Unit => "unit",
        };
        word(known.name, known.doc, detail)
    })
}

/// The keys of a block of options.
pub(super) fn keys(block: &str) -> Vec<Completion> {
    words::all()
        .filter(|known| matches!(known.kind, WordKind::Option(of) if of == block))
        .map(|known| Completion {
            kind: CompletionKind::Key,
            ..word(known.name, known.doc, "option")
        })
        .collect()
}

/// A keyword within a statement.
pub(super) fn joining(name: &str) -> Option<Completion> {
    let known = KEYWORDS.iter().rfind(|known| known.name == name)?;
    Some(Completion { kind: CompletionKind::Keyword, ..word(name, known.doc, "in a statement") })
}
