//! Warns of what the root declares and nothing uses.

use crate::ast::{
    Ident, Item, ItemKind, RewardItem, RewardStmt, RewardStmtKind, RewardUseKind, ScenarioStmtKind,
    Span,
};
use crate::lower::World;
use crate::problem::Problem;
use crate::problem::facts::{Declared, Whole};
use crate::source::FileId;
use std::collections::BTreeSet;

/// What scenarios declare and use.
#[derive(Default)]
pub(super) struct Unused {
    used: BTreeSet<Span>,
    /// What, its name, and all of its declaration.
    declared: Vec<(Declared, Ident, Span)>,
    /// Whether a scenario that can be run stands in the file: what it leaves, nobody uses.
    has_scenario: bool,
}

impl Unused {
    /// Notes the values that a scenario declares; what an abstract one declares, its children may
    /// use.
    pub(super) fn declare(&mut self, world: &World<'_>) {
        let flat = world.flat;
        if flat.item.is_abstract {
            return;
        }
        self.has_scenario = true;
        let mut add = |what: Declared, name: &Ident, whole: Span| {
            if name.span.file == FileId(0) {
                self.declared.push((what, name.clone(), whole));
            }
        };
        flat.params.iter().for_each(|param| {
            add(Declared::Parameter, &param.decl.name, param.decl.span);
        });
        flat.lets.iter().for_each(|binding| add(Declared::Let, &binding.name, binding.whole()));
        flat.tuples.iter().for_each(|(names, value)| {
            names.iter().for_each(|name| add(Declared::Let, name, name.span.to(value.span)));
        });
        flat.consts.iter().for_each(|binding| {
            add(Declared::Const, &binding.name, binding.whole());
        });
        flat.regions.iter().for_each(|region| {
            add(Declared::Region, &region.name, region.name.span.to(region.body.span));
        });
    }

    /// Notes what a scenario refers to.
    pub(super) fn use_all(&mut self, used: BTreeSet<Span>) {
        self.used.extend(used);
    }

    /// Whether something refers to a declaration.
    pub(super) fn is_used(&self, declaration: Span) -> bool {
        self.used.contains(&declaration)
    }

    /// Reports what nothing refers to.
    pub(super) fn report(mut self, items: &[Item], problems: &mut Vec<Problem>) {
        for (what, name, whole) in std::mem::take(&mut self.declared) {
            self.check(what, &name, whole, problems);
        }
        if !self.has_scenario {
            return;
        }
        for item in items {
            let (what, name) = match &item.kind {
                ItemKind::Const(binding) => (Declared::Const, &binding.name),
                ItemKind::Fn(item) => (Declared::Function, &item.name),
                ItemKind::Region(item) => (Declared::Region, &item.name),
                ItemKind::Table(item) => (Declared::Table, &item.name),
                ItemKind::Ending(item) => (Declared::Ending, &item.name),
                ItemKind::Formation(item) => (Declared::Formation, &item.name),
                ItemKind::Behavior(item) => (Declared::Behavior, &item.name),
                ItemKind::Reward(item) => (Declared::Reward, &item.name),
                ItemKind::Scenario(item) => {
                    for stmt in &item.body {
                        if let ScenarioStmtKind::Reward(reward) = &stmt.kind
                            && let RewardUseKind::Inline { body, .. } = &reward.what
                        {
                            self.statements(body, true, problems);
                        }
                    }
                    continue;
                }
                ItemKind::Suite(_)
                | ItemKind::Check(_)
                | ItemKind::Curriculum(_)
                | ItemKind::Import { .. }
                | ItemKind::Broken => continue,
            };
            if self.check(what, name, item.span, problems) {
                self.inner(&item.kind, problems);
            }
        }
    }

    /// The names that an item which is used declares for itself.
    fn inner(&self, item: &ItemKind, problems: &mut Vec<Problem>) {
        for param in item.params() {
            self.check(Declared::Parameter, &param.name, param.span, problems);
        }
        if let ItemKind::Reward(RewardItem { body, .. }) = item {
            self.statements(body, true, problems);
        }
    }

    fn statements(&self, body: &[RewardStmt], is_top: bool, problems: &mut Vec<Problem>) {
        for statement in body {
            match &statement.kind {
                RewardStmtKind::State(binding) if is_top => {
                    self.check(Declared::State, &binding.name, binding.whole(), problems);
                }
                RewardStmtKind::Let(binding) => {
                    self.check(Declared::Let, &binding.name, binding.whole(), problems);
                }
                RewardStmtKind::On { body, .. } => self.statements(body, false, problems),
                RewardStmtKind::When { then, otherwise, .. } => {
                    self.statements(then, false, problems);
                    self.statements(otherwise.as_deref().unwrap_or_default(), false, problems);
                }
                _ => {}
            }
        }
    }

    /// Whether something is used; reports it if not, and if nothing is wrong with it itself.
    fn check(
        &self,
        what: Declared,
        name: &Ident,
        whole: Span,
        problems: &mut Vec<Problem>,
    ) -> bool {
        let used = self.used.contains(&name.span);
        let is_wrong = |problem: &Problem| problem.is_error() && whole.holds(problem.place());
        if !used && !name.node.starts_with('_') && !problems.iter().any(is_wrong) {
            problems.push(Problem::new(name.span, Whole::Unused { what, name: name.node.clone() }));
        }
        used
    }
}
