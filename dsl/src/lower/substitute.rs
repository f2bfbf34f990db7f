//! `substitute PLAYER when …`: who comes on for a player, and when.

use super::team::{share, stat_of};
use super::{Lower, fields};
use crate::ast::{FieldValue, Substitute};
use crate::check::options::SUBSTITUTE;
use crate::check::types::Ty;
use crate::problem::Problem;
use crate::problem::facts::{Players, Types};
use setpiece_scenario::Substitution;

/// Lowers a substitution in the endings' program; `None` after a report.
pub(super) fn lower_substitute<'w>(
    lower: &mut Lower<'_, 'w>,
    said: &'w Substitute,
) -> Option<Substitution> {
    let who = lower.want(&said.who, Ty::Player);
    let when = lower.condition(&said.when);
    if who.is_error() {
        return None;
    }
    let reg = lower.reg(&who);
    let player = lower.code.constant_of(reg).filter(|&id| id >= 0.0);
    let Some(player) = player else {
        let text = lower.world.text(said.who.span);
        lower.report(Problem::new(said.who.span, Players::SubstituteOfNobody { text }));
        return None;
    };
    let mut found = Substitution {
        player: player as u8,
        when,
        fatigue: None,
        difficulty: None,
        stats: Vec::new(),
    };
    for field in &said.fields {
        if !fields::is_known(lower, field, SUBSTITUTE, "`substitute`") {
            continue;
        }
        match (field.key.node.as_str(), &field.value) {
            ("stats", FieldValue::Fields(stats, _)) => {
                for field in stats {
                    if let Some((stat, reg)) = stat_of(lower, field) {
                        found.stats.retain(|(known, _)| *known != stat);
                        found.stats.push((stat, reg));
                    }
                }
            }
            ("stats", _) => lower.report(Problem::new(field.key.span, Types::StatsIsAGroup)),
            (key, _) => {
                let Some(expr) = fields::expression(lower, field) else { continue };
                let reg = share(lower, expr, &format!("`{key}`"));
                let option =
                    if key == "fatigue" { &mut found.fatigue } else { &mut found.difficulty };
                *option = Some(reg);
            }
        }
    }
    Some(found)
}
