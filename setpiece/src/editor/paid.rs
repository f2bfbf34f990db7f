//! What an inherited reward pays for, too: both payments come in the same step.

use super::Analysis;
use super::hints::InlayHint;
use crate::dsl::ast::{
    EventExpr, ItemKind, RewardStmt, RewardStmtKind, RewardUseKind, ScenarioStmtKind, Span,
};
use crate::dsl::parse::parse;
use crate::dsl::source::FileId;

/// An event that a reward pays for.
struct PaidEvent {
    /// Its words, with single blanks.
    words: String,
    span: Span,
}

impl Analysis {
    /// Behind each event that the last scenario pays for itself: the inherited rewards that pay
    /// for it, too.
    pub(super) fn paid_twice(&self) -> Vec<InlayHint> {
        let Some(loaded) = &self.loaded else { return Vec::new() };
        let scenario = self.tree.items.iter().find_map(|item| match &item.kind {
            ItemKind::Scenario(it) if Some(it.name.span) == loaded.origin => Some((it, item.span)),
            _ => None,
        });
        let Some((scenario, whole)) = scenario else { return Vec::new() };
        let rewards = loaded.origins.rewards.iter().zip(&loaded.scenario.rewards);
        let inherited: Vec<(&str, Vec<PaidEvent>)> = rewards
            .filter(|(at, _)| !whole.holds(**at))
            .map(|(_, reward)| (reward.name.as_str(), self.paid_by_item(&reward.name)))
            .collect();
        let bodies = scenario.body.iter().filter_map(|stmt| match &stmt.kind {
            ScenarioStmtKind::Reward(used) => Some(&used.what),
            _ => None,
        });
        let own = bodies.flat_map(|what| match what {
            RewardUseKind::Inline { body, .. } => paid(body, &self.text),
            RewardUseKind::Named(used) => self
                .tree
                .items
                .iter()
                .find_map(|item| match &item.kind {
                    ItemKind::Reward(it) if it.name.node == used.name.node => {
                        Some(paid(&it.body, &self.text))
                    }
                    _ => None,
                })
                .unwrap_or_default(),
            RewardUseKind::Script { .. } => Vec::new(),
        });
        own.filter_map(|event| {
            let too: Vec<String> = inherited
                .iter()
                .filter(|(_, events)| events.iter().any(|it| it.words == event.words))
                .map(|(name, _)| format!("`{name}`"))
                .collect();
            Some(InlayHint {
                at: self.own(event.span)?.end,
                text: format!("{} pays for it, too", too.first()?),
                doc: format!("inherited: {}; both are paid in the same step", too.join(", ")),
                is_before: false,
            })
        })
        .collect()
    }

    /// The events that a reward pays for, of this text or of a file that it sees.
    fn paid_by_item(&self, name: &str) -> Vec<PaidEvent> {
        let trees = self.sources.iter().map(|(_, source)| {
            (parse(source, FileId(0), &mut Vec::new()).items, source.text.clone())
        });
        let mut found = trees.filter_map(|(items, text)| {
            items.iter().find_map(|item| match &item.kind {
                ItemKind::Reward(it) if it.name.node == name => Some(paid(&it.body, &text)),
                _ => None,
            })
        });
        found.next().unwrap_or_default()
    }
}

/// The events that some statements pay for.
fn paid(body: &[RewardStmt], text: &str) -> Vec<PaidEvent> {
    let event = |event: &EventExpr| {
        let words = text.get(event.span.start as usize..event.span.end as usize)?;
        let words = words.split_whitespace().collect::<Vec<_>>().join(" ");
        Some(PaidEvent { words, span: event.span })
    };
    let mut found = Vec::new();
    for stmt in body {
        match &stmt.kind {
            RewardStmtKind::Give(give) => found.extend(give.on.iter().filter_map(event)),
            RewardStmtKind::On { events, body, .. } => {
                let gives = body.iter().any(|it| matches!(it.kind, RewardStmtKind::Give(_)));
                found.extend(events.iter().filter(|_| gives).filter_map(event));
                found.extend(paid(body, text));
            }
            RewardStmtKind::When { then, otherwise, .. } => {
                found.extend(paid(then, text));
                found.extend(otherwise.iter().flat_map(|it| paid(it, text)));
            }
            _ => {}
        }
    }
    found
}
