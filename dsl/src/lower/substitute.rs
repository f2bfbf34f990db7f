//! `substitute PLAYER when …`: who comes on for a player, and when.

use super::team::{share, stat_of};
use super::{Lower, fields};
use crate::ast::{Expr, ExprKind, FieldValue, Span, Substitute};
use crate::check::names;
use crate::check::options::SUBSTITUTE;
use crate::check::types::Ty;
use crate::problem::facts::{Fact, Kind, Names, Players, Types};
use crate::problem::{Guess, Problem};
use setpiece_scenario::Substitution;

/// Lowers a substitution in the endings' program; `None` after a report.
pub(super) fn lower_substitute<'w>(
    lower: &mut Lower<'_, 'w>,
    said: &'w Substitute,
) -> Option<Substitution> {
    let player = who_goes_off(lower, &said.who);
    let when = lower.condition(&said.when);
    let mut found =
        Substitution { player: player?, when, fatigue: None, difficulty: None, stats: Vec::new() };
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

/// The id of who goes off; `None` after a report.
fn who_goes_off<'w>(lower: &mut Lower<'_, 'w>, who: &'w Expr) -> Option<u8> {
    let world = lower.world;
    let text = || world.text(who.span);
    let fact: Fact = match (&who.kind, world.tentatively(|| lower.expr(who).ty)) {
        (ExprKind::Name(name), Ty::Error) if is_strange(lower, name, who.span) => {
            let known = world.roster.iter().filter_map(|player| player.name);
            let known: Vec<&str> = known.map(|name| name.node.as_str()).collect();
            let guess = Guess::similar_or_all(name, &known);
            Names::Unknown { kind: Kind::NamedPlayer, name: name.clone(), guess }.into()
        }
        (ExprKind::String(name), _) => Players::SubstituteInQuotes { name: name.clone() }.into(),
        (_, ty @ (Ty::Team | Ty::Set | Ty::List)) => {
            Players::SubstituteOfMany { text: text(), noun: ty.noun() }.into()
        }
        _ => {
            let value = lower.want(who, Ty::Player);
            if value.is_error() {
                return None;
            }
            let reg = lower.reg(&value);
            if let Some(id) = lower.code.constant_of(reg).filter(|&id| id >= 0.0) {
                return Some(id as u8);
            }
            Players::SubstituteOfNobody { text: text() }.into()
        }
    };
    lower.report(Problem::new(who.span, fact));
    None
}

/// Whether a name is like none that could stand here.
fn is_strange(lower: &Lower<'_, '_>, name: &str, span: Span) -> bool {
    let known = lower.names_in_sight(span);
    let replaced = lower.world.flat.teams.iter().flat_map(|team| &team.replaced);
    !names::is_value(name)
        && replaced.into_iter().all(|(replaced, _)| *replaced != name)
        && Guess::of(name, known.iter().map(String::as_str)) == Guess::default()
}
