//! Rhai scripts: loaded, checked against the engine's hooks, embedded with their arguments.

use super::named::{nameable, named_values};
use super::value::{LocalName, Repr, Value};
use super::{Lower, World};
use crate::ast::{ParamDecl, ScriptRef, ScriptSource, Span, Spanned};
use crate::check::types::Ty;
use crate::problem::facts::{Files, Types};
use crate::problem::{Problem, ScriptSight};
use crate::source::{FileId, Source};
use setpiece_scenario::vocabulary::Type;
use setpiece_scenario::{NamedValue, Script, ScriptArg, ScriptModule};

impl<'w> Lower<'_, 'w> {
    /// The parameters around a script, as its hook sees them; `every` one must be such that it can.
    pub(crate) fn script_args(
        &mut self,
        params: impl IntoIterator<Item = &'w ParamDecl>,
        every: bool,
    ) -> Vec<ScriptArg> {
        let mut args = Vec::new();
        for decl in params {
            let known = self.scope.find(&decl.name.node).cloned();
            let Some(
                LocalName::Expr { now: Some(value), .. }
                | LocalName::Value(value)
                | LocalName::Kept { value, .. },
            ) = known
            else {
                continue;
            };
            self.world.mark_used(decl.name.span);
            if value.is_error() {
                continue;
            }
            match script_type(&value) {
                Some(ty) => {
                    args.push(ScriptArg { name: decl.name.node.clone(), ty, regs: value.regs() });
                }
                None if !every => {}
                None => self.report(Problem::new(
                    decl.name.span,
                    Types::NoScriptParameter { ty: value.ty },
                )),
            }
        }
        args
    }
}

/// The type under which a script gets a value.
pub(super) fn script_type(value: &Value<'_>) -> Option<Type> {
    match (&value.repr, value.ty) {
        (Repr::One(_), Ty::Bool) => Some(Type::Bool),
        (Repr::One(_), Ty::Int) => Some(Type::Int),
        (Repr::One(_), Ty::Player) => Some(Type::Player),
        (Repr::One(_), Ty::Team) => Some(Type::Team),
        (Repr::One(_), ty) if ty.dim().is_some() => Some(Type::Number),
        (Repr::Two(..), Ty::Point) => Some(Type::Point),
        _ => None,
    }
}

/// A file that stands beside the text; `None` after a report.
pub(super) fn named_file(world: &World<'_>, path: &Spanned<String>) -> Option<FileId> {
    match world.scripts_loaded.find(path.span.file, &path.node)? {
        Ok(file) => Some(*file),
        Err(error) => {
            let (why, similar) = (error.message.clone(), error.similar.first().cloned());
            let fact = Files::Missing { why, similar, is_import: false };
            world.report(Problem::new(path.span, fact));
            None
        }
    }
}

/// What is asked of a script.
#[derive(Clone, Copy, Default)]
pub(crate) struct AskedHook<'a> {
    /// The hook's name.
    pub(crate) name: &'static str,
    /// Names that it finds among the scenario's parameters.
    pub(crate) own: &'a [&'a str],
    /// The terms that it returns.
    pub(crate) terms: &'a [&'a str],
}

/// Embeds a script and gives its place in the scenario; `None` after a report.
pub(crate) fn embed<'w>(
    lower: &Lower<'_, 'w>,
    script: &'w ScriptRef,
    hook: AskedHook<'_>,
) -> Option<u32> {
    let world = lower.world;
    let (name, source, text_at) = match &script.source {
        ScriptSource::File(path) => {
            let file = named_file(world, path)?;
            let source = world.library.sources.get(file)?;
            (path.node.clone(), source.clone(), (file, 0))
        }
        ScriptSource::Inline(text) => {
            let name = format!(
                "inline in {}",
                world.library.sources.get(text.span.file).map_or("", |f| f.name.as_str())
            );
            let source = Source { name: name.clone(), text: text.node.as_str().into() };
            (name, source, (text.span.file, text.span.start))
        }
    };
    let sources = &world.library.sources;
    let files = world.scripts_loaded.modules(text_at.0, &source.text, sources);
    let modules: Vec<ScriptModule> = files
        .iter()
        .filter_map(|(name, file)| {
            let source = sources.get(*file)?.text.to_string();
            Some(ScriptModule { name: name.clone(), source })
        })
        .collect();
    let texts = || {
        std::iter::once(&*source.text).chain(modules.iter().map(|module| module.source.as_str()))
    };
    let n_bytes = texts().map(str::len).sum();
    if let Err(why) = world.scripts_loaded.take(n_bytes, modules.len()) {
        world.report(Problem::new(script.span, why));
        return None;
    }
    // A script reads a parameter by its name, in whatever way.
    let words: Vec<&str> =
        texts().flat_map(|text| text.split(|c: char| !c.is_alphanumeric() && c != '_')).collect();
    let named = named_values(lower, &words, script.span);
    let checked = CheckedScript { source: &source, at: text_at, modules: &modules, files: &files };
    check(lower, script.span, &checked, hook, &named);
    for param in world.params.iter().filter(|param| words.contains(&param.name.node.as_str())) {
        world.mark_used(param.name.span);
    }
    let mut scripts = world.scripts.borrow_mut();
    let at =
        world.library.sources.get(text_at.0).map_or((1, 1), |file| file.line_column(text_at.1));
    let embedded = Script { name, at, source: source.text.to_string(), named, modules };
    let known = scripts.iter().position(|script| *script == embedded);
    let index = known.unwrap_or_else(|| {
        scripts.push(embedded);
        scripts.len() - 1
    });
    Some(index as u32)
}

/// A script with its modules, and where they are in the files.
struct CheckedScript<'a> {
    source: &'a Source,
    /// The file and the byte at which its text begins.
    at: (FileId, u32),
    modules: &'a [ScriptModule],
    files: &'a [(String, FileId)],
}

fn check(
    lower: &Lower<'_, '_>,
    used: Span,
    script: &CheckedScript<'_>,
    hook: AskedHook<'_>,
    named: &[NamedValue],
) {
    let world = lower.world;
    let Some(api) = world.scripts_loaded.api else { return };
    let bound = world.params.iter().filter(|param| param.bound.is_none());
    let sight = ScriptSight {
        params: bound
            .map(|param| param.param.name.as_str())
            .chain(hook.own.iter().copied())
            .collect(),
        named: named.iter().map(|named| (named.name.as_str(), named.kind)).collect(),
        others: nameable(lower, used),
        terms: hook.terms.to_vec(),
    };
    for found in api.check(script.source, script.modules, hook.name, &sight) {
        let module = found.module.and_then(|at| script.files.get(at));
        let (file, offset) = module.map_or(script.at, |(_, file)| (*file, 0));
        let span = Span {
            file,
            start: offset + found.range.start as u32,
            end: offset + found.range.end.max(found.range.start) as u32,
        };
        let fact = Files::Script { code: found.code, message: found.message, help: found.help };
        world.report(Problem::new(span, fact));
    }
}
