//! `remove …`: what a child takes away from what it inherits.

use super::Adding;
use crate::ast::{ExprKind, ScenarioStmt, ScenarioStmtKind, Substitute};
use crate::problem::facts::Names;
use crate::problem::{Guess, Problem};

impl<'a> Adding<'a, '_> {
    /// `remove` acts on the parents' result, wherever it stands in the child.
    pub(super) fn removals(&mut self, body: &'a [ScenarioStmt]) {
        for stmt in body {
            let ScenarioStmtKind::Remove { what, name } = &stmt.kind else { continue };
            let removed = self.remove(&what.node, name.as_ref().map(|name| name.node.as_str()));
            if removed {
                continue;
            }
            let span = name.as_ref().map_or(stmt.span, |name| name.span);
            let candidates: Vec<&str> = match what.node.as_str() {
                "reward" => self.flat.rewards.iter().map(|(name, _, _)| name.as_str()).collect(),
                "record" => {
                    self.flat.records.iter().map(|known| known.name.node.as_str()).collect()
                }
                "end" => self.flat.ends.iter().filter_map(|end| Some(end.label?.bare())).collect(),
                "substitute" => self.flat.substitutes.iter().filter_map(|one| who(one)).collect(),
                "require" => self.flat.requires.iter().filter_map(|stmt| label(stmt)).collect(),
                _ => Vec::new(),
            };
            let name = name.as_ref().map(|name| name.node.clone());
            let guess = Guess::of(name.as_deref().unwrap_or_default(), candidates);
            let fact = Names::NothingToRemove { what: what.node.clone(), name, guess };
            self.problems.push(Problem::new(span, fact));
        }
    }

    fn remove(&mut self, what: &str, name: Option<&str>) -> bool {
        let flat = &mut *self.flat;
        match (what, name) {
            ("ball", _) => flat.ball.take().is_some(),
            ("rounds", _) => flat.rounds.take().is_some(),
            ("start", _) => flat.start.take().is_some(),
            ("observe", _) => flat.observed.take().is_some(),
            ("world", _) => !std::mem::take(&mut flat.world).is_empty(),
            ("pitch", _) => !std::mem::take(&mut flat.pitch).is_empty(),
            ("substitute", Some(name)) => {
                removed(&mut flat.substitutes, |one| who(one) == Some(name))
            }
            ("reward", Some(name)) => removed(&mut flat.rewards, |(known, _, _)| known == name),
            ("record", Some(name)) => removed(&mut flat.records, |known| known.name.node == name),
            ("end", Some("limit")) => flat.limit.take().is_some(),
            ("end", Some(name)) => removed(&mut flat.ends, |end| {
                end.label.map_or_else(
                    || end.verdict.is_some_and(|verdict| verdict.node == name),
                    |label| label.bare() == name,
                )
            }),
            ("require", Some(name)) => {
                removed(&mut flat.requires, |stmt| label(stmt) == Some(name))
            }
            _ => false,
        }
    }
}

/// Who goes off by a substitution, if it is a name.
fn who(substitute: &Substitute) -> Option<&str> {
    match &substitute.who.kind {
        ExprKind::Name(name) => Some(name),
        _ => None,
    }
}

/// The label of a requirement.
fn label(stmt: &ScenarioStmt) -> Option<&str> {
    match &stmt.kind {
        ScenarioStmtKind::Require { label, .. } => label.as_ref().map(|label| label.node.as_str()),
        _ => None,
    }
}

fn removed<T>(list: &mut Vec<T>, test: impl Fn(&T) -> bool) -> bool {
    let before = list.len();
    list.retain(|entry| !test(entry));
    list.len() < before
}
