//! What a script imports: `import "PATH" as ALIAS;`.

use super::place::offset;
use super::words::line_column;
use rhai::{AST, ASTNode, Expr, Position, Stmt};
use std::ops::Range;

/// A statement that imports a module.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct ImportedModule {
    /// The path as written.
    pub(super) path: String,
    /// The name before `::`.
    pub(super) alias: String,
    /// The place of the path, in bytes.
    pub(super) range: Range<usize>,
    /// The place of the whole statement, without its semicolon.
    pub(super) statement: Range<usize>,
}

/// An import that can't be followed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct ImportFault {
    pub(super) range: Range<usize>,
    pub(super) message: &'static str,
}

/// How an import is written.
pub(super) const WRITTEN: &str = "write `import \"lib\" as lib;` above the functions";

/// The imports of a text, and those that can't be followed.
pub(super) fn imports(source: &str, ast: &AST) -> (Vec<ImportedModule>, Vec<ImportFault>) {
    let (mut found, mut faults) = (Vec::<ImportedModule>::new(), Vec::new());
    let mut fault = |at: usize, message| {
        let range = super::place::word_at(source, at);
        faults.push(ImportFault { range, message });
    };
    let at = |position: Position| {
        line_column(position).map_or(source.len(), |(line, column)| offset(source, line, column))
    };
    let top = ast.statements();
    ast.walk(&mut |path: &[ASTNode]| {
        if let Some(ASTNode::Stmt(Stmt::Import(_, position))) = path.last()
            && !top.iter().any(|own| own.position() == *position)
        {
            fault(at(*position), "a script imports at its top, outside functions");
        }
        true
    });
    for statement in top {
        let Stmt::Import(import, position) = statement else { continue };
        let (path, alias) = &**import;
        let start = at(*position);
        let Expr::StringConstant(text, place) = path else {
            fault(start, "the path of an import is a string");
            continue;
        };
        if alias.name.is_empty() {
            fault(start, "an import has no name");
            continue;
        }
        if found.iter().any(|other| other.alias == alias.name.as_str()) {
            fault(at(alias.pos), "two imports have one name");
            continue;
        }
        found.push(ImportedModule {
            path: text.to_string(),
            alias: alias.name.to_string(),
            range: super::place::word_at(source, at(*place)),
            statement: start..at(alias.pos) + alias.name.len(),
        });
    }
    (found, faults)
}
