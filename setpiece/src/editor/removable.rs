//! What a scenario inherits under a name and may remove.

use super::completion::{Completion, CompletionKind, word};
use super::parents::{scenario_named, with_parents};
use super::{Analysis, SymbolKind};
use crate::dsl::ast::{EndStmt, Item, RewardUse, RewardUseKind, ScenarioItem, ScenarioStmtKind};
use crate::dsl::parse::parse;
use crate::dsl::source::{FileId, SourceLoader};
use crate::files::FileLoader;

/// What is removed at the end of a text, and the byte where its statement begins: of `remove end `,
/// `end`.
pub(super) fn removed(before: &str) -> Option<(&str, usize)> {
    let (rest, what) = before.trim_end().rsplit_once(char::is_whitespace)?;
    let statement = rest.trim_end().strip_suffix("remove")?;
    before.ends_with(char::is_whitespace).then_some((what, statement.len()))
}

impl Analysis {
    /// The names that may stand behind `remove WHAT` at a byte: what the scenario's parents give
    /// it, whether the text is whole or broken.
    pub(super) fn removable(&self, what: &str, statement: usize) -> Vec<Completion> {
        let around = self.around(statement, &[SymbolKind::Scenario]);
        let own = around.and_then(|it| scenario_named(&self.tree.items, &it.name).cloned());
        let mut names: Vec<String> = Vec::new();
        for parent in own.map_or_else(Vec::new, |own| self.parents(own)).iter().rev() {
            for stmt in &parent.body {
                match &stmt.kind {
                    ScenarioStmtKind::Remove { what: kind, name: Some(name) } => {
                        names.retain(|known| kind.node != what || *known != name.node);
                    }
                    kind => names.extend(name_of(kind, what)),
                }
            }
        }
        names.sort();
        names.dedup();
        let name = |name: String| Completion {
            kind: CompletionKind::Name,
            ..word(&name, "", "inherited")
        };
        names.into_iter().map(name).collect()
    }

    /// The parents of a scenario, the nearest first.
    fn parents(&self, own: ScenarioItem) -> Vec<ScenarioItem> {
        let items: Vec<Item> = self.items().collect();
        let library = FileLoader::anywhere();
        let of_library = |name: &str| {
            let (_, path) = library.scenarios().into_iter().find(|(known, _)| known == name)?;
            let source = library.load(&path, "").ok()?;
            let file = parse(&source, FileId(0), &mut Vec::new());
            scenario_named(&file.items, name).cloned()
        };
        let parent = |of: &ScenarioItem| {
            let name = of.extends.as_ref()?.bare();
            let known = scenario_named(&items, name).filter(|it| it.name != of.name).cloned();
            known.or_else(|| of_library(name))
        };
        with_parents(own, parent).skip(1).collect()
    }
}

/// The name under which a statement is removed by `remove WHAT`.
fn name_of(kind: &ScenarioStmtKind, what: &str) -> Option<String> {
    match (what, kind) {
        ("end", ScenarioStmtKind::End(EndStmt::Limit(_))) => Some("limit".to_owned()),
        ("end", ScenarioStmtKind::End(EndStmt::When { label, .. })) => {
            Some(label.as_ref()?.bare().to_owned())
        }
        ("reward", ScenarioStmtKind::Reward(RewardUse { label: Some(label), .. })) => {
            Some(label.node.clone())
        }
        ("reward", ScenarioStmtKind::Reward(RewardUse { what, .. })) => match what {
            RewardUseKind::Named(named) => Some(named.bare().to_owned()),
            RewardUseKind::Inline { name, .. } => Some(name.node.clone()),
            RewardUseKind::Script { .. } => None,
        },
        ("record", ScenarioStmtKind::Record(record)) => Some(record.name.node.clone()),
        ("require", ScenarioStmtKind::Require { label: Some(label), .. }) => {
            Some(format!("\"{}\"", label.node))
        }
        _ => None,
    }
}
