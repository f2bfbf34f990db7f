//! Warns of what the root declares and nothing uses.

use crate::ast::{
    Ident, Item, ItemKind, RewardItem, RewardStmt, RewardStmtKind, RewardUseKind, ScenarioStmtKind, Span,
};
use crate::lower::World;
use crate::problem::Problem;
use crate::problem::facts::Whole;
use crate::source::FileId;
use std::collections::BTreeSet;

/// What scenarios declare and use.
#[derive(Default)]
pub(super) struct Unused {
    used: BTreeSet<Span>,
    declared: Vec<(&'static str, Ident)>,
    /// Whether a scenario that can be run stands in the file: what it leaves, nobody uses.
    has_scenario: bool,
}

impl Unused {
    /// Notes the values that a scenario declares; what an abstract one declares, its children may use.
    pub(super) fn declare(&mut self, world: &World<'_>) {
        let flat = world.flat;
        if flat.item.is_abstract {
            return;
        }
        self.has_scenario = true;
        let mut add = |what: &'static str, name: &Ident| {
            if name.span.file == FileId(0) {
                self.declared.push((what, name.clone()));
            }
        };
        world.params.iter().for_each(|param| add("parameter", param.name));
        flat.lets.iter().for_each(|binding| add("`let`", &binding.name));
        flat.tuples.iter().flat_map(|(names, _)| *names).for_each(|name| add("`let`", name));
        flat.consts.iter().for_each(|binding| add("`const`", &binding.name));
        flat.regions.iter().for_each(|region| add("region", &region.name));
    }

    /// Notes what a scenario refers to.
    pub(super) fn use_all(&mut self, used: BTreeSet<Span>) {
        self.used.extend(used);
    }

    /// Reports what nothing refers to.
    pub(super) fn report(mut self, items: &[Item], problems: &mut Vec<Problem>) {
        for (what, name) in std::mem::take(&mut self.declared) {
            self.check(what, &name, "use it", problems);
        }
        if !self.has_scenario {
            return;
        }
        for item in items {
            let (what, name, cure) = match &item.kind {
                ItemKind::Const(binding) => ("`const`", &binding.name, "use it".to_owned()),
                ItemKind::Fn(item) => ("function", &item.name, "use it".to_owned()),
                ItemKind::Region(item) => ("region", &item.name, "use it".to_owned()),
                ItemKind::Ending(item) => ("ending", &item.name, format!("end by it, `end {}`", item.name.node)),
                ItemKind::Formation(item) => {
                    ("formation", &item.name, format!("give it to a team, `formation: {}`", item.name.node))
                }
                ItemKind::Behavior(item) => {
                    ("behavior", &item.name, format!("give it to a player, `ai: {}`", item.name.node))
                }
                ItemKind::Reward(item) => {
                    ("reward", &item.name, format!("pay it in a scenario, `reward {}`", item.name.node))
                }
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
                ItemKind::Import { .. } | ItemKind::Reserved { .. } | ItemKind::Broken => continue,
            };
            if self.check(what, name, &cure, problems) {
                self.inner(&item.kind, problems);
            }
        }
    }

    /// The names that an item which is used declares for itself.
    fn inner(&self, item: &ItemKind, problems: &mut Vec<Problem>) {
        for param in item.params() {
            self.check("parameter", &param.name, "use it", problems);
        }
        if let ItemKind::Reward(RewardItem { body, .. }) = item {
            self.statements(body, true, problems);
        }
    }

    fn statements(&self, body: &[RewardStmt], is_top: bool, problems: &mut Vec<Problem>) {
        for statement in body {
            match &statement.kind {
                RewardStmtKind::State(binding) if is_top => {
                    self.check("state", &binding.name, "use it", problems);
                }
                RewardStmtKind::Let(binding) => {
                    self.check("`let`", &binding.name, "use it", problems);
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

    /// Whether something is used; reports it if not.
    fn check(&self, what: &str, name: &Ident, cure: &str, problems: &mut Vec<Problem>) -> bool {
        let used = self.used.contains(&name.span);
        if !used && !name.node.starts_with('_') {
            problems.push(Problem::new(
                name.span,
                Whole::Unused { what: what.to_owned(), name: name.node.clone(), cure: cure.to_owned() },
            ));
        }
        used
    }
}
