//! Notes, for editors, what every name of the root file refers to.
//!
//! The compiler looks only at what it compiles: a reward that nothing uses, what a child replaces
//! and the keys of arguments stay out of its sight. Here every name of the tree is looked up once,
//! where it stands, in the order in which the compiler looks: locals, the scenario, its players,
//! its records, the file.

mod expr;
mod parts;
mod plan;
mod scenario;
mod script;

use crate::ast::{
    Binding, Domain, FormationItem, Ident, Item, ItemKind, ParamDecl, Span, TableRows,
};
use crate::check::names;
use crate::lower::Effort;
use crate::lower::loaded_scripts::LoadedScripts;
use crate::resolve::{
    Flat, FlatEnding, Library, ending_declaration, reward_declaration, reward_name,
};
use std::collections::BTreeMap;

/// Notes the names of some items.
pub(super) fn note<'a>(
    library: &'a Library,
    scripts: &'a LoadedScripts<'a>,
    effort: &'a Effort,
    items: &'a [Item],
) {
    let mut uses = Uses {
        library,
        scripts,
        effort,
        locals: Vec::new(),
        scenario: None,
        players: BTreeMap::new(),
        reached: Vec::new(),
        is_silent: false,
    };
    for item in items {
        uses.item(item);
    }
}

/// What names mean at a place of the tree.
struct Uses<'a> {
    library: &'a Library,
    scripts: &'a LoadedScripts<'a>,
    effort: &'a Effort,
    /// Parameters, states and values around the place, the nearest last.
    locals: Vec<(&'a str, Span)>,
    /// The scenario whose names the place sees.
    scenario: Option<Flat<'a>>,
    /// The players of the scenario or formation around the place.
    players: BTreeMap<&'a str, Span>,
    /// The formations that names referred to.
    reached: Vec<&'a FormationItem>,
    /// Whether nothing is noted: only `reached` is wanted.
    is_silent: bool,
}

impl<'a> Uses<'a> {
    fn item(&mut self, item: &'a Item) {
        self.locals.clear();
        self.players.clear();
        self.scenario = None;
        match &item.kind {
            ItemKind::Import { alias, .. } => alias.iter().for_each(|alias| self.declare(alias)),
            ItemKind::Scenario(scenario) => self.scenario(scenario),
            ItemKind::Reward(reward) => self.reward_item(reward),
            ItemKind::Formation(formation) => self.formation(formation),
            ItemKind::Const(binding) => self.binding(binding),
            ItemKind::Fn(f) | ItemKind::Region(f) | ItemKind::Ending(f) => {
                self.declare(&f.name);
                self.function(f);
            }
            ItemKind::Table(table) => {
                self.declare(&table.name);
                table.over.iter().for_each(|over| self.expr(over));
                if let TableRows::Written(rows) = &table.rows {
                    self.expr(rows);
                }
            }
            ItemKind::Behavior(behavior) => self.behavior(behavior),
            ItemKind::Suite(suite) => self.suite(suite),
            ItemKind::Check(check) => self.check(check),
            ItemKind::Curriculum(curriculum) => self.curriculum(curriculum),
            ItemKind::Broken => {}
        }
    }

    /// Notes that a name declares something.
    fn declare(&self, name: &Ident) {
        self.declare_at(name.span);
    }

    fn declare_at(&self, span: Span) {
        if !self.is_silent {
            self.library.note(|index| index.declare(span));
        }
    }

    /// Notes that a name refers to a declaration.
    fn refer(&self, at: Span, declaration: Span) {
        if !self.is_silent {
            self.library.refer(at, declaration);
        }
    }

    /// Notes that two declarations of a name stand for each other.
    fn relate(&self, one: Span, other: Span) {
        if !self.is_silent {
            self.library.relate(one, other);
        }
    }

    /// Runs `f`, and forgets the locals that it adds.
    fn block(&mut self, f: impl FnOnce(&mut Self)) {
        let outer = self.locals.len();
        f(self);
        self.locals.truncate(outer);
    }

    /// Adds a local name.
    fn bind(&mut self, name: &'a Ident) {
        self.declare(name);
        self.locals.push((&name.node, name.span));
    }

    /// A declaration with a value.
    fn binding(&mut self, binding: &'a Binding) {
        self.declare(&binding.name);
        self.expr(&binding.value);
    }

    /// What parameters say, without making them known.
    fn params(&mut self, params: &'a [ParamDecl]) {
        for param in params {
            self.declare(&param.name);
            param.default.iter().for_each(|default| self.expr(default));
            param.domain.iter().for_each(|domain| self.domain(domain));
        }
    }

    fn domain(&mut self, domain: &'a Domain) {
        match domain {
            Domain::Range(low, high) => {
                self.expr(low);
                self.expr(high);
            }
            Domain::List(values, _) => values.iter().for_each(|value| self.expr(value)),
        }
    }

    /// An item by a name that may have a dot; the name is noted.
    fn found(&mut self, name: &Ident) -> Option<&'a Item> {
        self.found_at(&name.node, name.span)
    }

    fn found_at(&mut self, name: &str, span: Span) -> Option<&'a Item> {
        let library = self.library;
        let found = library.find(span.file, name)?;
        self.refer(span, found.name.span);
        self.alias(name, span);
        if let ItemKind::Formation(formation) = &found.item.kind {
            self.reached.push(formation);
        }
        Some(found.item)
    }

    /// Notes the name of the import that a name with a dot begins with.
    fn alias(&self, name: &str, span: Span) {
        let Some((head, _)) = name.split_once('.') else { return };
        let Some(file) = self.library.files.get(span.file.0 as usize) else { return };
        let known = file.items.iter().find_map(|item| match &item.kind {
            ItemKind::Import { alias: Some(alias), .. } if alias.node == head => Some(alias.span),
            _ => None,
        });
        if let Some(known) = known {
            self.refer(Span { end: span.start + head.len() as u32, ..span }, known);
        }
    }

    /// Where a name of a value is declared.
    fn meant(&self, name: &str) -> Option<Span> {
        let local = self.locals.iter().rev().find(|(known, _)| *known == name);
        if let Some((_, at)) = local {
            return Some(*at);
        }
        let of_scenario = self.scenario.as_ref().and_then(|flat| flat.declaration(name));
        of_scenario.or_else(|| self.players.get(name).copied())
    }

    /// A name that stands for a value.
    fn name(&mut self, name: &str, span: Span) {
        let known = self.meant(name).or_else(|| self.record(name));
        match known {
            Some(at) => self.refer(span, at),
            None if !self.is_word(name, span) => drop(self.found_at(name, span)),
            None => {}
        }
    }

    fn record(&self, name: &str) -> Option<Span> {
        let flat = self.scenario.as_ref().filter(|_| !names::is_value(name))?;
        flat.records.iter().find(|known| known.name.node == name).map(|known| known.name.span)
    }

    /// Whether a name is a word of the language even where a file has an item of this name.
    fn is_word(&self, name: &str, span: Span) -> bool {
        let found = self.library.find(span.file, name);
        names::is_value(name) && !found.is_some_and(|found| found.item.kind.is_value())
    }

    /// Where the reward that a scenario knows by a name is declared.
    fn reward_of(&self, flat: &Flat<'a>, name: &str) -> Option<Span> {
        let (_, used, _) = flat.rewards.iter().find(|(known, ..)| known == name)?;
        debug_assert_eq!(reward_name(used), name);
        reward_declaration(self.library, used)
    }

    fn ending_of(&self, flat: &Flat<'a>, name: &str) -> Option<Span> {
        let bears = |ending: &&FlatEnding<'_>| ending.label.is_some_and(|it| it.bare() == name);
        let ending = flat.ends.iter().find(bears)?;
        ending_declaration(self.library, ending.label?, ending.condition.is_some())
    }
}
