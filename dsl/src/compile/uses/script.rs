//! Names in scripts: `ctx.params.pace`, `now.named.box`, `params["pace"]`.

use super::Uses;
use crate::ast::{ScriptRef, ScriptSource, Span};
use crate::resolve::Named;

impl<'a> Uses<'a> {
    /// Notes the names that a script reads. A script that makes a name out of words is left out.
    pub(super) fn script(&mut self, script: &'a ScriptRef) {
        if self.is_silent {
            return;
        }
        let library = self.library;
        let at = match &script.source {
            ScriptSource::Inline(text) => text.span,
            ScriptSource::File(path) => {
                let found = self.scripts.find(path.span.file, &path.node);
                let Some(file) = found.and_then(|found| found.as_ref().ok()) else { return };
                let length = library.sources.get(*file).map_or(0, |source| source.text.len());
                Span { file: *file, start: 0, end: length as u32 }
            }
        };
        let text = library.sources.text(at);
        for (kind, start, name) in names_of(text) {
            let (start, length) = (at.start + start as u32, name.len() as u32);
            let span = Span { file: at.file, start, end: start + length };
            match kind {
                Read::Param => {
                    let declared = self.param(name);
                    if let Some(it) = declared {
                        self.refer(span, it);
                    }
                }
                Read::Named => match self.value(name) {
                    Some(it) => self.refer(span, it),
                    None => {
                        if let Some(found) = library.find(script.span.file, name) {
                            self.refer(span, found.name.span);
                        }
                    }
                },
            }
        }
    }

    /// A parameter of what the script stands in, or of the scenario.
    fn param(&self, name: &str) -> Option<Span> {
        let local = self.locals.iter().rev().find(|(known, _)| *known == name);
        let of_scenario = || {
            let flat = self.scenario.as_ref()?;
            match flat.named(name)? {
                Named::Param(at) => flat.params.get(at).map(|it| it.decl.name.span),
                _ => None,
            }
        };
        local.map(|(_, at)| *at).or_else(of_scenario)
    }

    /// A value or player of the scenario.
    fn value(&self, name: &str) -> Option<Span> {
        let flat = self.scenario.as_ref()?;
        flat.declaration(name).or_else(|| self.players.get(name).copied())
    }
}

/// Where a script looks a name up.
#[derive(Clone, Copy, PartialEq)]
enum Read {
    Param,
    Named,
}

/// The names that a script looks up, with their bytes.
fn names_of(text: &str) -> Vec<(Read, usize, &str)> {
    let is_word = |sign: char| sign.is_alphanumeric() || sign == '_';
    let code = without_comments(text);
    let mut maps: Vec<(&str, Read)> = vec![("params", Read::Param), ("named", Read::Named)];
    // `let names = now.named;` gives the map another name.
    for statement in code.split([';', '{', '}']) {
        let Some((left, right)) = statement.split_once('=') else { continue };
        let Some(name) = left.trim().strip_prefix("let ") else { continue };
        let right = right.trim();
        for (word, read) in [(".params", Read::Param), (".named", Read::Named)] {
            if right.ends_with(word) {
                maps.push((name.trim(), read));
            }
        }
    }
    let mut found = Vec::new();
    let mut at = 0;
    while let Some(start) = code.get(at..).and_then(|rest| rest.find(is_word)).map(|it| at + it) {
        let rest = code.get(start..).unwrap_or_default();
        let word = rest.split(|sign| !is_word(sign)).next().unwrap_or_default();
        at = start + word.len();
        let Some((_, read)) = maps.iter().find(|(known, _)| *known == word) else { continue };
        let rest = code.get(at..).unwrap_or_default();
        let inner = rest.strip_prefix('.').or_else(|| rest.strip_prefix("[\""));
        let Some(inner) = inner else { continue };
        let begin = at + rest.len() - inner.len();
        let name = inner.split(|sign| !is_word(sign)).next().unwrap_or_default();
        if let Some(name) = text.get(begin..begin + name.len()).filter(|name| !name.is_empty()) {
            found.push((*read, begin, name));
            at = begin + name.len();
        }
    }
    found
}

/// A script with blanks in the place of its comments.
fn without_comments(text: &str) -> String {
    let mut code = String::with_capacity(text.len());
    let (mut rest, mut in_line, mut in_block) = (text, false, false);
    while let Some(sign) = rest.chars().next() {
        match sign {
            '\n' => in_line = false,
            _ if in_line || in_block => {}
            _ if rest.starts_with("//") => in_line = true,
            _ if rest.starts_with("/*") => in_block = true,
            _ => {}
        }
        let ends = in_block && rest.starts_with("*/");
        let taken = if ends { 2 } else { sign.len_utf8() };
        if (in_line || in_block) && sign != '\n' {
            code.extend(std::iter::repeat_n(' ', taken));
        } else {
            code.push(sign);
        }
        in_block &= !ends;
        rest = rest.get(taken..).unwrap_or_default();
    }
    code
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_script_reads_names_in_every_way() {
        let text = "// ctx.params.no\nlet names = now.named; /* é */ names.box + \
                    ctx.params.pace * ctx.params[\"far\"]";
        let found: Vec<&str> = names_of(text).into_iter().map(|(.., name)| name).collect();
        assert_eq!(found, ["box", "pace", "far"]);
    }
}
