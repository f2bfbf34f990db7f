//! What an editor writes between the words: metres, names of arguments, what is inherited, how
//! many starts a requirement refuses.

use super::refused::Refusals;
use super::text::{brackets, code};
use super::{Analysis, SymbolKind};
use crate::dsl::ast::{ItemKind, ScenarioStmtKind, Span, TeamStmtKind};
use std::collections::BTreeMap;
use std::ops::Range;

/// Some words beside a byte of the text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct InlayHint {
    /// The byte.
    pub at: usize,
    /// The words.
    pub text: String,
    /// What they say, in full; may be empty.
    pub doc: String,
    /// Whether they stand before the byte's word, as the name of an argument does.
    pub is_before: bool,
}

impl Analysis {
    /// What is written between the words of some bytes, in order.
    pub fn hints(&self, within: &Range<usize>) -> Vec<InlayHint> {
        let mut hints = self.metres();
        hints.extend(self.argument_names());
        hints.extend(self.inherited());
        hints.extend(self.refused());
        hints.extend(self.paid_twice());
        hints.retain(|hint| within.start <= hint.at && hint.at <= within.end);
        hints.sort_by_key(|hint| hint.at);
        hints
    }

    /// Metres beside normalised points.
    fn metres(&self) -> Vec<InlayHint> {
        let values = self.index.values().filter(|(_, fact)| fact.is_point);
        values
            .filter_map(|(span, fact)| {
                let own = self.own(span)?;
                let inner = self.text.get(own.clone())?.strip_prefix('(')?.strip_suffix(')')?;
                let (x, y) = inner.split_once(',')?;
                let is_plain = |text: &str| text.trim().parse::<f64>().is_ok();
                let &[x_m, y_m] = fact.constants.as_slice() else { return None };
                (is_plain(x) && is_plain(y)).then(|| InlayHint {
                    at: own.end,
                    text: format!("{:.1}m, {:.1}m", x_m + 0.0, y_m + 0.0),
                    doc: "from the centre spot, in the world's frame".to_owned(),
                    is_before: false,
                })
            })
            .collect()
    }

    /// The names of arguments that stand without them.
    fn argument_names(&self) -> Vec<InlayHint> {
        let (kinds, taking) = (self.kinds(), self.taking());
        let pairs: BTreeMap<usize, usize> =
            brackets(&self.text).iter().map(|it| (it.open, it.close)).collect();
        let mut hints = Vec::new();
        for (at, declared) in self.index.uses() {
            let is_called = matches!(
                kinds.get(&declared),
                Some(
                    SymbolKind::Function
                        | SymbolKind::Behavior
                        | SymbolKind::Formation
                        | SymbolKind::Reward
                        | SymbolKind::Ending
                )
            );
            let Some(own) = self.own(at).filter(|_| is_called) else { continue };
            let Some(close) = pairs.get(&own.end) else { continue };
            if !self.text.get(own.end..).is_some_and(|rest| rest.starts_with('(')) {
                continue;
            }
            let Some((_, params)) = taking.iter().find(|(item, _)| item.holds(declared)) else {
                continue;
            };
            let inner = own.end + 1..close.saturating_sub(1);
            for (argument, param) in self.arguments(&inner).into_iter().zip(params) {
                let text = self.text.get(argument.clone()).unwrap_or_default();
                let has_name = text.split_once(':').is_some_and(|(key, _)| {
                    key.trim().chars().all(|sign| sign.is_alphanumeric() || sign == '_')
                });
                if !has_name && text != *param && !text.is_empty() {
                    hints.push(InlayHint {
                        at: argument.start,
                        text: format!("{param}:"),
                        doc: String::new(),
                        is_before: true,
                    });
                }
            }
        }
        hints
    }

    /// The arguments between two brackets, without blanks around them.
    fn arguments(&self, inner: &Range<usize>) -> Vec<Range<usize>> {
        let text = self.text.get(inner.clone()).unwrap_or_default();
        let (mut found, mut depth, mut start) = (Vec::new(), 0_usize, 0);
        for (at, sign) in code(text) {
            match sign {
                '(' | '[' | '{' => depth += 1,
                ')' | ']' | '}' => depth = depth.saturating_sub(1),
                ',' if depth == 0 => {
                    found.push(start..at);
                    start = at + 1;
                }
                _ => {}
            }
        }
        found.push(start..text.len());
        let trimmed = |range: Range<usize>| {
            let part = text.get(range.clone()).unwrap_or_default();
            let blank = part.len() - part.trim_start().len();
            let start = inner.start + range.start + blank;
            start..start + part.trim().len()
        };
        found.into_iter().map(trimmed).collect()
    }

    /// What the last scenario takes over from others, behind the brace that opens it.
    fn inherited(&self) -> Option<InlayHint> {
        let loaded = self.loaded.as_ref()?;
        let scenario = self.tree.items.iter().find_map(|item| match &item.kind {
            ItemKind::Scenario(it) if Some(it.name.span) == loaded.origin => Some((it, item.span)),
            _ => None,
        });
        let (scenario, whole) = scenario?;
        let parent = scenario.extends.as_ref()?;
        let is_own = |span: &Span| whole.holds(*span);
        let origins = &loaded.origins;
        let mut parts: Vec<String> = Vec::new();
        if origins.ball.is_some_and(|ball| !is_own(&ball)) {
            parts.push("ball".to_owned());
        }
        let players = origins.players.iter().filter(|player| !is_own(player)).count();
        // The players of a formation that the scenario names are its own choice.
        let names_formation = scenario.body.iter().any(|stmt| {
            match &stmt.kind {
            ScenarioStmtKind::Team { body, .. } => body.iter().any(|stmt| {
                matches!(&stmt.kind, TeamStmtKind::Field(field) if field.key.node == "formation")
            }),
            _ => false,
        }
        });
        match players {
            _ if names_formation => {}
            0 => {}
            1 => parts.push("1 player".to_owned()),
            count => parts.push(format!("{count} players")),
        }
        let scenario = &loaded.scenario;
        let endings = origins.endings.iter().zip(&scenario.endings.list);
        let endings: Vec<&str> =
            endings.filter(|(at, _)| !is_own(at)).map(|(_, it)| it.label.as_str()).collect();
        if !endings.is_empty() {
            parts.push(format!("end {}", endings.join(", ")));
        }
        let rewards = origins.rewards.iter().zip(&scenario.rewards);
        let rewards: Vec<&str> =
            rewards.filter(|(at, _)| !is_own(at)).map(|(_, it)| it.name.as_str()).collect();
        if !rewards.is_empty() {
            parts.push(format!("reward {}", rewards.join(", ")));
        }
        let params = origins.params.iter().zip(&scenario.params);
        let params: Vec<&str> =
            params.filter(|(at, _)| !is_own(at)).map(|(_, it)| it.name.as_str()).collect();
        if !params.is_empty() {
            parts.push(format!("param {}", params.join(", ")));
        }
        if parts.is_empty() {
            return None;
        }
        let own = self.own(whole)?;
        let open = brackets(&self.text).into_iter().find(|it| {
            own.contains(&it.open) && self.text.get(it.open..).is_some_and(|it| it.starts_with('{'))
        })?;
        Some(InlayHint {
            at: open.open + 1,
            text: format!("from {}: {}", parent.name.node, parts.join(", ")),
            doc: "what the scenario takes over".to_owned(),
            is_before: false,
        })
    }

    /// How many starts each requirement refuses. Where it is many, a report says so.
    fn refused(&self) -> Vec<InlayHint> {
        let Some(loaded) = &self.loaded else { return Vec::new() };
        if loaded.origins.requires.iter().all(|require| require.span.is_none()) {
            return Vec::new();
        }
        let Some(found) = Refusals::of(loaded) else { return Vec::new() };
        let written = loaded.origins.requires.iter().zip(&found.by);
        written
            .filter(|(origin, refused)| origin.help.is_none() && !found.is_worth_saying(**refused))
            .filter_map(|(origin, refused)| {
                let own = self.own(origin.span?)?;
                Some(InlayHint {
                    at: own.end,
                    text: format!("refuses {:.0}%", 100.0 * found.share(*refused)),
                    doc: format!(
                        "of {} attempts at a start this is the first requirement that {refused} fail",
                        found.attempts
                    ),
                    is_before: false,
                })
            })
            .collect()
    }
}
