//! Checks a script before it runs: its grammar, its hook, the [`names`] it uses.

mod names;
mod terms;

use super::api::Subject;
use super::hooks::{REWARD, hook_arguments};
use super::imports::{WRITTEN, imports};
use super::limits::IMPORT;
use super::place::{definition, offset, word_at};
use super::{host, words};
use names::{Names, SharedFunctions};
use rhai::{AST, ASTNode, Expr, ParseError, ParseErrorType, Position, Stmt};
use setpiece_scenario::{NamedKind, ScriptModule, module_name};
use std::collections::BTreeMap;
use std::ops::Range;

/// Least similarity of a suggestion.
const SIMILAR: f64 = 0.6;

/// The kind of a script's problem.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ScriptFaultKind {
    /// The text isn't valid Rhai.
    Syntax,
    /// The hook is missing, or takes other arguments.
    Hook,
    /// An unknown property, function or variable.
    Name,
}

/// A problem in a script.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ScriptFault {
    /// What kind.
    pub kind: ScriptFaultKind,
    /// In which module; none if in the script itself.
    pub module: Option<usize>,
    /// The place, in bytes of the text.
    pub range: Range<usize>,
    /// What is wrong, in one clause.
    pub message: String,
    /// What to write instead.
    pub help: Option<String>,
}

/// The names that a script may read.
#[derive(Clone, Copy, Debug, Default)]
pub struct ScriptNames<'a> {
    /// Those in `ctx.params`.
    pub params: &'a [&'a str],
    /// Those in `named`.
    pub named: &'a [(&'a str, NamedKind)],
    /// Names that it might have meant instead.
    pub others: &'a [&'a str],
    /// The keys of the map that a `reward` hook returns; none if it returns a number.
    pub terms: &'a [&'a str],
}

impl ScriptNames<'_> {
    /// How a function reads what the text around a script calls by a name.
    ///
    /// - `position`: the name's, in the script.
    fn read_as(&self, source: &str, position: Position, name: &str) -> Option<String> {
        if self.params.contains(&name) {
            return Some(format!("ctx.params.{name}"));
        }
        let is_named = self.others.contains(&name);
        is_named.then(|| {
            let before = source.get(..position_offset(source, position)).unwrap_or_default();
            let head = before.rsplit_once("fn ").map_or("", |(_, function)| function);
            let head = head.split(')').next().unwrap_or_default();
            let mut words = head.split(|sign: char| !sign.is_alphanumeric() && sign != '_');
            // What a hook without the state has, as `reset`, is its context.
            let of = if words.any(|word| word == "now") { "now" } else { "ctx" };
            format!("{of}.named.{name}")
        })
    }

    /// What to write for a call of what the text around a script calls by a name.
    fn called_as(&self, source: &str, position: Position, name: &str) -> Option<String> {
        let read = self.read_as(source, position, name)?;
        Some(format!(
            "write `{read}.at(…)` of a table, `{read}.contains(…)` of a region, and `{read}` of a value"
        ))
    }
}

/// The most problems reported per script, because finding the place of each scans the script from
/// its beginning.
const FAULTS_MAX: usize = 100;

/// Checks a script that is used as `hook` (`reward`, `done`, `act` or `reset`) and may read these
/// names, and its modules.
///
/// Problems are in text order, the script's first. A text that isn't valid Rhai has only one.
pub fn check_script(
    source: &str,
    modules: &[ScriptModule],
    hook: &str,
    known: &ScriptNames<'_>,
) -> Vec<ScriptFault> {
    let asts: Vec<_> = modules.iter().map(|module| host::read(&module.source)).collect();
    let shared: Vec<SharedFunctions> =
        asts.iter().map(|ast| ast.as_ref().ok().map(shared)).collect();
    let aliases = |importer: &str, source: &str, ast: &AST| {
        let named = imports(source, ast).0.into_iter().map(|import| {
            let wanted = module_name(importer, &import.path);
            let at = modules.iter().position(|module| Some(&module.name) == wanted.as_ref());
            (import.alias, at.and_then(|at| shared.get(at).cloned().flatten()))
        });
        named.collect()
    };
    let mut faults = match host::read(source) {
        Err(error) => vec![unread(source, hook, known, &error)],
        Ok(ast) => {
            let mut faults: Vec<ScriptFault> = check_hook(source, hook, &ast).into_iter().collect();
            faults.extend(check_reset(source, &ast));
            if hook == REWARD {
                terms::check(source, &ast, known.terms, &mut faults);
            }
            check_text(source, hook, *known, &ast, aliases("", source, &ast), faults)
        }
    };
    for (at, (module, ast)) in modules.iter().zip(&asts).enumerate() {
        let source = module.source.as_str();
        let own = match ast {
            Err(error) => vec![unread(source, hook, known, error)],
            Ok(ast) => {
                let aliases = aliases(&module.name, source, ast);
                check_text(source, hook, *known, ast, aliases, Vec::new())
            }
        };
        faults.extend(own.into_iter().map(|fault| ScriptFault { module: Some(at), ..fault }));
    }
    faults.truncate(FAULTS_MAX);
    faults
}

/// The paths of the modules that a script or module imports, and their places; none of a text that
/// can't be read.
pub fn script_imports(source: &str) -> Vec<(String, Range<usize>)> {
    if !source.contains(IMPORT) {
        return Vec::new();
    }
    let Ok(ast) = host::read(source) else { return Vec::new() };
    imports(source, &ast).0.into_iter().map(|import| (import.path, import.range)).collect()
}

/// The functions that a module has for those that import it.
fn shared(ast: &AST) -> Vec<(String, usize)> {
    let public = ast.iter_functions().filter(|own| own.access.is_public());
    public.map(|own| (own.name.to_owned(), own.params.len())).collect()
}

/// Why a text can't be read.
fn unread(source: &str, hook: &str, known: &ScriptNames<'_>, error: &ParseError) -> ScriptFault {
    let start = position_offset(source, error.position());
    let (kind, help) = match error.err_type() {
        ParseErrorType::VariableUndefined(name) => {
            let arguments = hook_arguments(hook).unwrap_or_default().iter().map(|(name, _)| *name);
            let help =
                known.read_as(source, error.position(), name).map(|read| format!("write `{read}`"));
            (ScriptFaultKind::Name, help.or_else(|| suggest(name, arguments.chain(["this"]))))
        }
        ParseErrorType::ModuleUndefined(_) => (ScriptFaultKind::Name, Some(WRITTEN.to_owned())),
        _ => (ScriptFaultKind::Syntax, None),
    };
    let message = words::parse_message(error);
    ScriptFault { kind, module: None, range: word_at(source, start), message, help }
}

/// Checks what scripts and modules have in common; adds to what was found in the text.
fn check_text(
    source: &str,
    hook: &str,
    known: ScriptNames<'_>,
    ast: &AST,
    aliases: BTreeMap<String, SharedFunctions>,
    mut faults: Vec<ScriptFault>,
) -> Vec<ScriptFault> {
    faults.extend(check_top_level(source, ast));
    faults.extend(imports(source, ast).1.into_iter().map(|fault| ScriptFault {
        kind: ScriptFaultKind::Syntax,
        module: None,
        range: fault.range,
        message: fault.message.to_owned(),
        help: Some(WRITTEN.to_owned()),
    }));
    let mut names = Names::of(source, hook, known, ast, aliases);
    names.check();
    faults.append(&mut names.faults);
    faults.sort_by_key(|fault| fault.range.start);
    faults.dedup();
    faults
}

/// Whether a script reads the agent's own player.
pub(super) fn mentions_me(ast: &AST) -> bool {
    !ast.walk(&mut |path: &[ASTNode]| {
        !matches!(path.last(), Some(ASTNode::Expr(Expr::Property(property, _))) if matches!(&*property.2, "me" | "agent"))
    })
}

/// Whether a script reads the events that its hook gets.
pub(super) fn mentions_events(ast: &AST, hook: &str) -> bool {
    let arguments = hook_arguments(hook).unwrap_or_default();
    let Some(place) = arguments.iter().position(|(_, subject)| *subject == Subject::Events) else {
        return false;
    };
    let defined =
        ast.iter_functions().find(|f| f.name == hook && f.params.len() == arguments.len());
    let Some(events) = defined.and_then(|f| f.params.get(place).copied()) else { return false };
    !ast.walk(&mut |path: &[ASTNode]| {
        let Some(ASTNode::Expr(Expr::Variable(variable, ..))) = path.last() else { return true };
        variable.1 != events
    })
}

fn check_hook(source: &str, hook: &str, ast: &AST) -> Option<ScriptFault> {
    let arguments = hook_arguments(hook)?;
    let wanted = arguments.iter().map(|(name, _)| *name).collect::<Vec<_>>().join(", ");
    let defined: Vec<usize> =
        ast.iter_functions().filter(|f| f.name == hook).map(|f| f.params.len()).collect();
    if defined.contains(&arguments.len()) {
        return None;
    }
    let help = Some(format!("write `fn {hook}({wanted}) {{ … }}`"));
    let kind = ScriptFaultKind::Hook;
    Some(match defined.first() {
        None => ScriptFault {
            kind,
            module: None,
            range: 0..source.lines().next().map_or(0, str::len),
            message: format!("the script has no function `{hook}`"),
            help,
        },
        Some(found) => ScriptFault {
            kind,
            module: None,
            range: definition(source, hook).unwrap_or(0..0),
            message: format!("`{hook}` takes {} arguments, found {found}", arguments.len()),
            help,
        },
    })
}

/// Checks the optional `reset` hook; with other arguments it would never be called.
fn check_reset(source: &str, ast: &AST) -> Option<ScriptFault> {
    ast.iter_functions()
        .any(|f| f.name == "reset")
        .then(|| check_hook(source, "reset", ast))
        .flatten()
}

/// Reports statements outside functions, because nothing runs them.
fn check_top_level(source: &str, ast: &AST) -> Option<ScriptFault> {
    let statement =
        ast.statements().iter().find(|of| !matches!(of, Stmt::Noop(_) | Stmt::Import(..)))?;
    Some(ScriptFault {
        kind: ScriptFaultKind::Hook,
        module: None,
        range: word_at(source, position_offset(source, statement.position())),
        message: "statements outside functions never run".to_owned(),
        help: Some(
            "write them into a function; what lasts between steps is kept in `this`".to_owned(),
        ),
    })
}

pub(super) fn suggest<'a>(name: &str, candidates: impl Iterator<Item = &'a str>) -> Option<String> {
    let scored = candidates
        .map(|candidate| (strsim::normalized_damerau_levenshtein(name, candidate), candidate));
    let best = scored.filter(|(score, _)| *score >= SIMILAR).fold(
        None,
        |best: Option<(f64, &str)>, next| match best {
            Some(best) if best.0 >= next.0 => Some(best),
            _ => Some(next),
        },
    );
    best.map(|(_, candidate)| format!("did you mean `{candidate}`?"))
}

fn position_offset(source: &str, position: Position) -> usize {
    match words::line_column(position) {
        Some((line, column)) => offset(source, line, column),
        None => source.len(),
    }
}
