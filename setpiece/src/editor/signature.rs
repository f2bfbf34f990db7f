//! What the brackets behind a name take.

use super::place::is_scenario;
use super::text::{code, word_at};
use super::words::{self, WordKind};
use super::{Analysis, FilePlace, Workspace};
use crate::dsl::ast::{ParamDecl, Span};
use crate::dsl::parse::parse;
use crate::dsl::source::{FileId, Source};
use crate::files::name_of;
use std::ops::Range;
use std::path::Path;

/// How something is called.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Signature {
    /// The call: `circle(centre, radius)`.
    pub label: String,
    /// What it does.
    pub doc: String,
    /// The bytes of each argument in the label.
    pub arguments: Vec<Range<usize>>,
    /// Which of them stands at the cursor.
    pub active: usize,
}

impl Workspace {
    /// What the call around a byte takes.
    pub fn signature(&mut self, path: &Path, offset: usize) -> Option<Signature> {
        let text = self.file_text(path)?;
        let (name, argument) = open_call(&text, offset)?;
        let analysis = self.analysis(path)?;
        let callee = text.get(name.clone()).unwrap_or_default();
        let declared = self.declaration(path, name.end).or_else(|| analysis.item_named(callee));
        if let Some(place) = declared
            && let Some(signature) = self.declared_call(&place, callee, &argument)
        {
            return Some(signature);
        }
        let known = words::all().find(|known| {
            known.name == callee && matches!(known.kind, WordKind::Function | WordKind::Act)
        })?;
        // The documentation begins with the call.
        let end = known.doc.find("): ").map_or(known.doc.len(), |at| at + 1);
        let (label, doc) = known.doc.split_at_checked(end)?;
        if !label.starts_with(callee) {
            return None;
        }
        Some(shown(label, doc.trim_start_matches(": "), &argument))
    }

    /// The call of something that a file declares.
    fn declared_call(
        &self,
        place: &FilePlace,
        callee: &str,
        argument: &ArgumentAt,
    ) -> Option<Signature> {
        let source = Source { name: name_of(&place.path), text: self.file_text(&place.path)? };
        let tree = parse(&source, FileId(0), &mut Vec::new());
        let holds =
            |span: Span| (span.start as usize..span.end as usize).contains(&place.range.start);
        let item = tree.items.iter().find(|item| holds(item.span))?;
        let params = item.kind.params();
        let parts: Vec<String> = params.iter().map(|param| written(param, &source.text)).collect();
        let label = format!("{callee}({})", parts.join(", "));
        Some(shown(&label, item.doc.trim(), argument))
    }
}

/// A parameter as it is declared, without its comment.
fn written(param: &ParamDecl, text: &str) -> String {
    let (start, end) = (param.span.start as usize, param.span.end as usize);
    let text = text.get(start..end).unwrap_or(&param.name.node);
    let text = text.strip_prefix("param ").unwrap_or(text);
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// Which argument stands at the cursor.
#[derive(Clone, Debug, PartialEq, Eq)]
enum ArgumentAt {
    Nth(usize),
    Named(String),
}

/// The signature of a call, with the argument at the cursor.
fn shown(label: &str, doc: &str, argument: &ArgumentAt) -> Signature {
    let open = label.find('(').map_or(label.len(), |at| at + 1);
    let mut arguments: Vec<Range<usize>> = Vec::new();
    let (mut depth, mut start) = (0_usize, open);
    for (at, sign) in label.char_indices().filter(|(at, _)| *at >= open) {
        match sign {
            '(' | '[' => depth += 1,
            ')' | ']' if depth > 0 => depth -= 1,
            ',' if depth == 0 => {
                arguments.push(start..at);
                start = at + 1;
            }
            ')' => {
                arguments.push(start..at);
                break;
            }
            _ => {}
        }
    }
    for range in &mut arguments {
        let text = label.get(range.clone()).unwrap_or_default();
        range.start += text.len() - text.trim_start().len();
    }
    arguments.retain(|range| !range.is_empty());
    let active = match argument {
        ArgumentAt::Nth(nth) => *nth,
        ArgumentAt::Named(name) => arguments
            .iter()
            .position(|range| {
                let text = label.get(range.clone()).unwrap_or_default();
                text.split(':').next().is_some_and(|key| key.trim() == name)
            })
            .unwrap_or(arguments.len()),
    };
    Signature { label: label.to_owned(), doc: doc.to_owned(), arguments, active }
}

/// The call whose brackets are open at a byte: the bytes of its name, and the argument.
fn open_call(text: &str, offset: usize) -> Option<(Range<usize>, ArgumentAt)> {
    let before = text.get(..offset)?;
    let mut open: Vec<(char, usize, usize)> = Vec::new();
    for (at, sign) in code(before) {
        match sign {
            '(' | '[' | '{' => open.push((sign, at, 0)),
            ')' | ']' | '}' => {
                open.pop();
            }
            ',' => {
                if let Some((_, _, commas)) = open.last_mut() {
                    *commas += 1;
                }
            }
            _ => {}
        }
    }
    // A tuple or list is an argument of the call around it.
    while let Some((sign, at, commas)) = open.pop() {
        let name = word_at(text, at);
        if sign == '(' && !name.is_empty() && name.end == at {
            let last = before.rfind([',', '(']).map_or(at + 1, |it| it + 1);
            let written = before.get(last..).unwrap_or_default();
            let key =
                written.split_once(':').map(|(key, _)| ArgumentAt::Named(key.trim().to_owned()));
            return Some((name, key.unwrap_or(ArgumentAt::Nth(commas))));
        }
        if sign == '{' {
            return None;
        }
    }
    None
}

impl Analysis {
    /// Where an item is declared that the text sees under a name.
    fn item_named(&self, name: &str) -> Option<FilePlace> {
        let name = name.rsplit('.').next().unwrap_or_default();
        self.kinds()
            .keys()
            .find(|span| self.sources.text(**span) == name)
            .and_then(|span| self.place(*span))
    }

    /// The items of the text's files that take arguments, with the names of their parameters.
    pub(super) fn taking(&self) -> Vec<(Span, Vec<String>)> {
        let mut taking = Vec::new();
        for (file, source) in self.sources.iter() {
            let parsed;
            let tree = if file == FileId(0) {
                &self.tree
            } else if is_scenario(Path::new(&source.name)) {
                parsed = parse(source, file, &mut Vec::new());
                &parsed
            } else {
                continue;
            };
            let items = tree.items.iter().filter(|item| !item.kind.params().is_empty());
            taking.extend(items.map(|item| {
                let params = item.kind.params().iter();
                (item.span, params.map(|param| param.name.node.clone()).collect())
            }));
        }
        taking
    }
}
