//! Under which names a scenario knows its parts, and which declarations stand for each other.

use super::Adding;
use crate::ast::{Ref, RewardUse, RewardUseKind, ScriptSource, Span};

impl<'a> Adding<'a, '_> {
    /// Notes that a declaration stands for the first one of its name in the chain.
    pub(super) fn relate(&mut self, kind: &'static str, name: &'a str, at: Span) {
        let first = *self.declared.entry((kind, name)).or_insert(at);
        if first != at {
            self.library.relate(at, first);
        }
    }

    /// The name of a reward and where it is declared: as its label, itself, or as the item.
    pub(super) fn reward_at(&self, reward: &'a RewardUse) -> Option<(&'a str, Span)> {
        match (&reward.label, &reward.what) {
            (Some(label), _) => {
                let Span { file, start, end } = label.span;
                let inner = Span { file, start: start + 1, end: end.saturating_sub(1) };
                Some((label.node.as_str(), inner))
            }
            (None, RewardUseKind::Named(named)) => Some((named.bare(), self.item_at(named)?)),
            (None, RewardUseKind::Inline { name, .. }) => Some((name.node.as_str(), name.span)),
            (None, RewardUseKind::Script { .. }) => None,
        }
    }

    pub(super) fn item_at(&self, named: &Ref) -> Option<Span> {
        let name = &named.name;
        self.library.find(name.span.file, &name.node).map(|found| found.name.span)
    }
}

/// The place of a name without the one of its import.
pub(super) fn last_part(label: &Ref) -> Span {
    let span = label.name.span;
    Span { start: span.end.saturating_sub(label.bare().len() as u32), ..span }
}

/// The name a reward of a scenario is known and reported by.
pub(crate) fn reward_name(reward: &RewardUse) -> String {
    match (&reward.label, &reward.what) {
        (Some(label), _) => label.node.clone(),
        (None, RewardUseKind::Named(named)) => named.bare().to_owned(),
        (None, RewardUseKind::Inline { name, .. }) => name.node.clone(),
        (None, RewardUseKind::Script { script, .. }) => match &script.source {
            ScriptSource::File(path) => {
                let stem = path.node.rsplit('/').next().unwrap_or_default();
                stem.strip_suffix(".rhai").unwrap_or(stem).to_owned()
            }
            ScriptSource::Inline(_) => "script".to_owned(),
        },
    }
}
