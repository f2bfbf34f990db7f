//! Under which names a scenario knows its parts, and which declarations stand for each other.

use super::{Adding, Flat, Library, Named};
use crate::ast::{Ref, RewardUse, RewardUseKind, ScriptSource, Span, Spanned};

impl Adding<'_, '_> {
    /// Notes that a declaration stands for the first one of its name in the chain.
    pub(super) fn relate(&mut self, kind: &'static str, name: &str, at: Span) {
        let first = *self.declared.entry((kind, name.to_owned())).or_insert(at);
        if first != at {
            self.library.relate(at, first);
        }
    }
}

impl Flat<'_> {
    /// Where a value of this name is declared, players aside.
    pub(crate) fn declaration(&self, name: &str) -> Option<Span> {
        let known = match self.named(name)? {
            Named::Param(at) => &self.params.get(at)?.decl.name,
            Named::Let(at) => &self.lets.get(at)?.name,
            Named::Tuple(at, index) => self.tuples.get(at)?.0.get(index)?,
            Named::Const(at) => &self.consts.get(at)?.name,
            Named::Region(at) => &self.regions.get(at)?.name,
        };
        Some(known.span)
    }
}

/// Where the name of a scenario's reward is declared: in its label, as itself, or as the item.
pub(crate) fn reward_declaration(library: &Library, reward: &RewardUse) -> Option<Span> {
    match (&reward.label, &reward.what) {
        (Some(label), _) => quoted(label),
        (None, RewardUseKind::Named(named)) => item_declaration(library, named),
        (None, RewardUseKind::Inline { name, .. }) => Some(name.span),
        (None, RewardUseKind::Script { .. }) => None,
    }
}

/// Where the name of an ending is declared: at the ending that has a condition, or as the item.
pub(crate) fn ending_declaration(library: &Library, label: &Ref, is_own: bool) -> Option<Span> {
    if is_own { Some(last_part(label)) } else { item_declaration(library, label) }
}

fn item_declaration(library: &Library, named: &Ref) -> Option<Span> {
    let name = &named.name;
    library.find(name.span.file, &name.node).map(|found| found.name.span)
}

/// The words between the quotes of a label, if they are a name.
pub(crate) fn quoted(label: &Spanned<String>) -> Option<Span> {
    let is_name = label.node.chars().all(|sign| sign.is_alphanumeric() || sign == '_');
    let Span { file, start, end } = label.span;
    (is_name && !label.node.is_empty()).then_some(Span { file, start: start + 1, end: end - 1 })
}

/// The place of a name without the one of its import.
pub(crate) fn last_part(label: &Ref) -> Span {
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
