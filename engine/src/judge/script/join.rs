//! Joins a script and its modules into one text, so that everything that reads, bounds and runs a
//! script knows only texts without modules.
//!
//! The modules follow the script, each on lines of its own. Their functions get a prefix, and so do
//! the calls of them: `lib::free(p)` becomes `setpiece_1_free(p)`, behind as many blanks as
//! `lib::` has letters. [`Joined::original`] maps places back to the author's texts.

use super::budget::{Edits, inserted};
use super::imports::imports;
use super::limits::{IMPORT, PREFIX};
use super::place::{offset, place_of};
use super::scan::definitions;
use super::{host, words};
use rhai::{AST, ASTNode, Expr, FnCallExpr, ParseError, Position, Stmt};
use setpiece_scenario::{ScriptModule, module_name};
use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;

/// A script with its modules.
#[derive(Debug)]
pub(super) struct Joined {
    /// The text.
    pub(super) text: String,
    /// The script, then the modules.
    parts: Vec<JoinedPart>,
}

#[derive(Debug)]
struct JoinedPart {
    /// The line of the text at which it begins, from 1.
    first_line: usize,
    edits: Edits,
}

/// Why texts can't be joined: which module (none: the script), where, and why.
pub(super) struct JoinFault {
    pub(super) module: Option<usize>,
    pub(super) place: (usize, usize),
    pub(super) message: String,
}

/// Where a text isn't where Rhai finds it: it stores lines and columns in two bytes, and has its
/// own line ends.
pub(super) const UNFOLLOWED: &str = "the text can't be followed here: it has a lone carriage return, or more than 65535 lines or columns";

impl Joined {
    /// Joins a script with its modules; one without modules stays as it is.
    pub(super) fn of(script: &str, modules: &[ScriptModule]) -> Result<Joined, JoinFault> {
        if modules.is_empty() && !script.contains(IMPORT) {
            let parts = vec![JoinedPart { first_line: 1, edits: Edits::default() }];
            return Ok(Joined { text: script.to_owned(), parts });
        }
        let names: Vec<&str> = modules.iter().map(|module| module.name.as_str()).collect();
        let texts = std::iter::once(("", script))
            .chain(modules.iter().map(|m| (m.name.as_str(), m.source.as_str())));
        let (mut text, mut parts) = (String::new(), Vec::new());
        for (at, (name, source)) in texts.enumerate() {
            let module = at.checked_sub(1);
            let (written, edits) = rewritten(name, source, module, &names)
                .map_err(|(place, message)| JoinFault { module, place, message })?;
            let first_line = 1 + text.matches('\n').count();
            parts.push(JoinedPart { first_line, edits });
            text.push_str(&written);
            text.push('\n');
        }
        Ok(Joined { text, parts })
    }

    /// Parses the text.
    pub(super) fn parse(&self) -> Result<AST, ParseError> {
        if self.parts.len() > 1 { host::parse(&self.text) } else { host::read(&self.text) }
    }

    /// Maps a place of the text to the author's: which module (none: the script), line and column.
    pub(super) fn original(
        &self,
        (line, column): (usize, usize),
    ) -> (Option<usize>, (usize, usize)) {
        let behind = self.parts.partition_point(|part| part.first_line <= line);
        let at = behind.saturating_sub(1);
        let Some(part) = self.parts.get(at) else { return (None, (line, column)) };
        let own = (line + 1 - part.first_line.min(line), column);
        (at.checked_sub(1), part.edits.original(own))
    }
}

/// A line and column, and what is wrong there.
type PlacedFault = ((usize, usize), String);

/// One text, with the prefixes of modules in the place of their names.
fn rewritten(
    name: &str,
    source: &str,
    own: Option<usize>,
    modules: &[&str],
) -> Result<(String, Edits), PlacedFault> {
    let ast = host::read(source).map_err(|error| {
        let place = words::line_column(error.position()).unwrap_or((1, 1));
        (place, words::parse_message(&error))
    })?;
    let (found, faults) = imports(source, &ast);
    if let Some(fault) = faults.first() {
        return Err((place_of(source, fault.range.start), fault.message.to_owned()));
    }
    let mut aliases = BTreeMap::new();
    let mut writer = Writer { source, blanks: Vec::new(), prefixes: BTreeMap::new() };
    for import in found {
        let wanted = module_name(name, &import.path);
        let module = modules.iter().position(|module| Some(*module) == wanted.as_deref());
        let Some(module) = module else {
            return Err((
                place_of(source, import.range.start),
                format!("no module `{}`", import.path),
            ));
        };
        aliases.insert(import.alias, module);
        writer.blanks.push(import.statement);
    }
    let functions: BTreeSet<(&str, usize)> =
        ast.iter_functions().map(|own| (own.name, own.params.len())).collect();
    let mut lost = None;
    ast.walk(&mut |path: &[ASTNode]| {
        let (call, position) = match path.last() {
            Some(
                ASTNode::Expr(Expr::FnCall(call, position) | Expr::MethodCall(call, position))
                | ASTNode::Stmt(Stmt::FnCall(call, position)),
            ) => (call, *position),
            _ => return true,
        };
        let written = if !call.namespace.is_empty() {
            let module = aliases.get(call.namespace.root());
            module.and_then(|module| writer.qualified(call, *module))
        } else if let Some(own) = own
            && call.op_token.is_none()
            && functions.contains(&(call.name.as_str(), call.args.len()))
        {
            writer.called(call, position, own)
        } else {
            return true;
        };
        if written.is_none() {
            let place =
                if call.namespace.is_empty() { position } else { call.namespace.position() };
            lost = words::line_column(place).or(Some((1, 1)));
        }
        written.is_some()
    });
    if let Some(place) = lost {
        return Err((place, UNFOLLOWED.to_owned()));
    }
    if let Some(own) = own {
        for range in definitions(source) {
            writer.prefixes.insert(range.start, own);
        }
    }
    Ok(writer.written())
}

/// Collects what changes in a text.
struct Writer<'a> {
    source: &'a str,
    /// What becomes blanks.
    blanks: Vec<Range<usize>>,
    /// Where the prefix of which module is inserted.
    prefixes: BTreeMap<usize, usize>,
}

impl Writer<'_> {
    /// The byte of a position, if this word stands there.
    fn offset_of(&self, position: Position, word: &str) -> Option<usize> {
        let (line, column) = words::line_column(position)?;
        let at = offset(self.source, line, column);
        self.source.get(at..)?.starts_with(word).then_some(at)
    }

    /// `alias::name(…)`
    fn qualified(&mut self, call: &FnCallExpr, module: usize) -> Option<()> {
        let [alias] = call.namespace.path.as_slice() else { return None };
        let start = self.offset_of(alias.pos, &alias.name)?;
        let rest = self.source.get(start + alias.name.len()..)?;
        let name = rest.trim_start().strip_prefix("::")?.trim_start();
        let at = self.source.len() - name.len();
        if !name.starts_with(call.name.as_str()) {
            return None;
        }
        self.blanks.push(start..at);
        self.prefixes.insert(at, module);
        Some(())
    }

    /// `name(…)` of the module's own function.
    fn called(&mut self, call: &FnCallExpr, position: Position, module: usize) -> Option<()> {
        let at = self.offset_of(position, &call.name)?;
        self.prefixes.insert(at, module);
        Some(())
    }

    fn written(self) -> (String, Edits) {
        let mut text = String::with_capacity(self.source.len());
        // As many blanks as characters keep the columns, so that only prefixes move them.
        let is_blank = |at: usize| self.blanks.iter().any(|range| range.contains(&at));
        let mut prefixes = Vec::new();
        for (at, char) in self.source.char_indices() {
            if let Some(module) = self.prefixes.get(&at) {
                prefixes.push((text.len(), format!("{PREFIX}{module}_")));
            }
            text.push(if is_blank(at) && char != '\n' { ' ' } else { char });
        }
        inserted(&text, prefixes.iter().map(|(at, words)| (*at, words.as_str())))
    }
}
