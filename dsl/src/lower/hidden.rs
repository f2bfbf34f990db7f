//! Warns of a name of the author's that hides another one.

use super::value::Scope;
use super::{Lower, World};
use crate::ast::{Ident, ItemKind, Span};
use crate::problem::Problem;
use crate::problem::facts::Names;
use crate::source::FileId;

/// What a name meant before.
struct Hidden {
    /// With its article.
    what: &'static str,
    at: Option<Span>,
}

impl Lower<'_, '_> {
    /// Warns of a local name that hides a value which `scope` sees, its own locals aside.
    pub(crate) fn check_hides(&self, name: &str, at: Span, scope: &Scope<'_>) {
        let of_scenario = || if scope.scenario { of_scenario(self.world, name) } else { None };
        warn(self.world, name, at, || of_scenario().or_else(|| of_file(self.world, at.file, name)));
    }

    /// The same of a name in a block of its own, which may hide a local of the scope around it,
    /// too.
    pub(crate) fn check_hides_local(&self, name: &str, at: Span, around: &Scope<'_>) {
        let Some(known) = around.find(name) else { return self.check_hides(name, at, around) };
        warn(self.world, name, at, || {
            Some(Hidden { what: "the outer value", at: known.declared() })
        });
    }
}

/// Warns of the scenario's own values, players and records that hide a value of its file.
pub(crate) fn check_scenario(world: &World<'_>) {
    let flat = world.flat;
    let params = flat.params.iter().map(|param| &param.decl.name);
    let bindings = flat.lets.iter().chain(&flat.consts).map(|binding| &binding.name);
    let regions = flat.regions.iter().map(|region| &region.name);
    let shuffled = flat.tuples.iter().flat_map(|(names, _)| *names);
    let players = world.roster.iter().filter_map(|player| player.name);
    let records = flat.records.iter().map(|record| &record.name);
    let values = params.chain(bindings).chain(regions).chain(shuffled);
    let all: Vec<&Ident> = values.chain(players).chain(records).collect();
    for name in all {
        warn(world, &name.node, name.span, || of_file(world, name.span.file, &name.node));
    }
}

fn of_scenario(world: &World<'_>, name: &str) -> Option<Hidden> {
    if let Some(at) = world.declaration(name) {
        return Some(Hidden { what: "the scenario's value", at: Some(at) });
    }
    if let Some(at) = world.player(name) {
        return Some(Hidden { what: "the player", at: Some(at) });
    }
    world.record(name).map(|record| Hidden { what: "the record", at: Some(record.name.span) })
}

/// A value that the same file declares: what is imported, nobody need know by heart.
fn of_file(world: &World<'_>, file: FileId, name: &str) -> Option<Hidden> {
    let found = world.library.find(file, name)?;
    let what = match &found.item.kind {
        ItemKind::Const(_) => "the constant",
        ItemKind::Region(region) if region.params.is_empty() => "the region",
        ItemKind::Formation(_) => "the formation",
        _ => return None,
    };
    // An own name hides an imported one, as it says.
    (found.name.span.file == file).then_some(Hidden { what, at: Some(found.name.span) })
}

fn warn(world: &World<'_>, name: &str, at: Span, hidden: impl FnOnce() -> Option<Hidden>) {
    // Another file's warnings are reported where that file is checked.
    if at.file != FileId(0) {
        return;
    }
    let Some(Hidden { what, at: before }) = hidden().filter(|hidden| hidden.at != Some(at)) else {
        return;
    };
    world.report(Problem::new(at, Names::Hides { name: name.to_owned(), what, hidden: before }));
}
