//! What scripts read by name: players, `let`s, constants and regions of the scenario, and what the
//! file around the script has.

use super::script::script_type;
use super::value::{LiteralFrame, Repr, Scope, Value};
use super::{Lower, ProgramStage};
use crate::ast::{ItemKind, Span, TableItem};
use crate::resolve::Named;
use setpiece_scenario::{NamedKind, NamedValue, Reg};

/// The word by which a script asks for names. A script without it has none.
const NAMED: &str = "named";

/// What a script can read by name, of all that its words might mean.
pub(super) fn named_values<'w>(lower: &Lower<'_, 'w>, words: &[&str], at: Span) -> Vec<NamedValue> {
    if !words.contains(&NAMED) {
        return Vec::new();
    }
    let known = nameable(lower, at);
    let mut names: Vec<&'w str> = known.into_iter().filter(|name| words.contains(name)).collect();
    names.sort_unstable();
    names.dedup();
    names.into_iter().filter_map(|name| named_value(lower, name, at)).collect()
}

/// Every name that a script may read, also those whose values it can't.
pub(super) fn nameable<'w>(lower: &Lower<'_, 'w>, at: Span) -> Vec<&'w str> {
    let world = lower.world;
    let visible = world.library.visible(at.file).filter(|(_, found)| match &found.item.kind {
        ItemKind::Region(region) => region.params.is_empty(),
        ItemKind::Const(_) | ItemKind::Table(_) => true,
        _ => false,
    });
    let mut known: Vec<&str> = visible.map(|(name, _)| name).collect();
    if lower.scope.scenario {
        let flat = world.flat;
        let tuples = flat.tuples.iter().flat_map(|(names, _)| *names);
        let regions = flat.regions.iter().filter(|region| region.params.is_empty());
        let names = (flat.lets.iter().chain(&flat.consts).map(|binding| &binding.name))
            .chain(tuples)
            .chain(regions.map(|region| &region.name));
        known.extend(names.map(|name| name.node.as_str()));
        let bound = world.params.iter().filter(|param| param.bound.is_some());
        known.extend(bound.map(|param| param.name.node.as_str()));
        let players = world.roster.iter().filter_map(|player| player.name);
        known.extend(players.map(|name| name.node.as_str()));
    }
    known
}

/// One of them; `None` for a value of a kind that scripts can't read.
fn named_value<'w>(around: &Lower<'_, 'w>, name: &'w str, at: Span) -> Option<NamedValue> {
    let (world, step) = (around.world, around.step?);
    let scope = Scope::new(around.scope.scenario, LiteralFrame::World);
    let mut lower = Lower::in_step(step, ProgramStage::Ending, scope);
    lower.team = Some(lower.code.us());
    let found = world.found();
    let (kind, values) = world.tentatively(|| lower.named_parts(name, at))?;
    if world.found() > found || values.iter().any(|&reg| lower.code.is_unknown(reg)) {
        return None;
    }
    let (program, layout) = lower.code.finish(&values);
    // What remembers something has a history that a script doesn't take part in.
    let fits = program.cells == kind.n_cells() && !program.uses_me();
    let values = values.into_iter().map(|reg| layout.reg(reg)).collect();
    fits.then(|| NamedValue { name: name.to_owned(), kind, program, values })
}

impl<'w> Lower<'_, 'w> {
    fn named_parts(&mut self, name: &'w str, at: Span) -> Option<(NamedKind, Vec<Reg>)> {
        let world = self.world;
        let own = self.scope.scenario;
        // A free parameter is in `ctx.params`.
        let is_free = |at: usize| world.params.get(at).is_some_and(|info| info.bound.is_none());
        if own && matches!(world.flat.named(name), Some(Named::Param(at)) if is_free(at)) {
            return None;
        }
        if own && let Some(value) = self.scenario_name(name, at) {
            return self.named_parts_of(&value);
        }
        let library = world.library;
        if let Some(found) = library.find(at.file, name)
            && let ItemKind::Table(table) = &found.item.kind
            && library.ambiguous(at.file, name, at).is_none()
        {
            world.mark_used(found.name.span);
            return self.named_table(table);
        }
        let value = self.file_name(name, at)?;
        self.named_parts_of(&value)
    }

    fn named_parts_of(&mut self, value: &Value<'w>) -> Option<(NamedKind, Vec<Reg>)> {
        if let Repr::Region(region) = &value.repr {
            let place = self.named_place();
            return Some((NamedKind::Region, vec![self.inside(place, region)]));
        }
        Some((NamedKind::Value(script_type(value)?), value.regs()))
    }

    fn named_table(&mut self, table: &'w TableItem) -> Option<(NamedKind, Vec<Reg>)> {
        let place = self.named_place();
        let scope = Scope::new(false, LiteralFrame::Own);
        let [nearest, between] = [false, true]
            .map(|linear| self.within(scope.clone(), |lower| lower.look_up(table, place, linear)));
        Some((NamedKind::Table, vec![nearest?, between?]))
    }

    /// The point that a script asks about.
    fn named_place(&mut self) -> (Reg, Reg) {
        let (x, y) = (self.code.new_cell(), self.code.new_cell());
        (self.code.cell(x), self.code.cell(y))
    }
}
