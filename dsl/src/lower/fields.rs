//! Fields in braces: which keys are known, and the value of one.

use super::Lower;
use crate::ast::{Expr, Field, FieldValue};
use crate::check::options::{PITCH, PLAYER, RULES, WORLD};
use crate::problem::facts::{Names, Types};
use crate::problem::{Guess, Problem};

/// Whose options stand in a team's braces.
pub(super) const A_TEAM: &str = "a team";

/// The fields of a list that are known; reports the others.
pub(super) fn known_fields<'w>(
    lower: &Lower<'_, 'w>,
    fields: &'w [Field],
    known: &[&str],
    whose: &str,
) -> Vec<&'w Field> {
    fields.iter().filter(|field| is_known(lower, field, known, whose)).collect()
}

/// Whether a field's key is known; reports it if not.
pub(super) fn is_known(lower: &Lower<'_, '_>, field: &Field, known: &[&str], whose: &str) -> bool {
    let key = field.key.node.as_str();
    if known.contains(&key) {
        return true;
    }
    let (whose, option) = (whose.to_owned(), key.to_owned());
    let fact = match block_of(key) {
        None if matches!(key, "mass" | "weight") && ["`world`", "the ball"].contains(&&*whose) => {
            Names::NoMass { whose, option }
        }
        _ if whose == A_TEAM && PLAYER.contains(&key) => Names::OfPlayers { option },
        Some(block) => Names::OfBlock { whose, option, block },
        None => Names::NoOption { whose, option, guess: Guess::similar_or_all(key, known) },
    };
    lower.report(Problem::new(field.key.span, fact));
    false
}

/// The block of the scenario that alone has this option.
pub(super) fn block_of(option: &str) -> Option<&'static str> {
    let blocks = [("world", WORLD), ("pitch", PITCH), ("rules", RULES)];
    blocks.into_iter().find(|(_, keys)| keys.contains(&option)).map(|(block, _)| block)
}

/// The expression of a field; reports a group or a script.
pub(super) fn expression<'w>(lower: &Lower<'_, 'w>, field: &'w Field) -> Option<&'w Expr> {
    let span = match &field.value {
        FieldValue::Expr(expr) => return Some(expr),
        FieldValue::Fields(_, span) => *span,
        FieldValue::Script(script) => script.span,
    };
    lower.report(Problem::new(span, Types::OneValue { option: field.key.node.clone() }));
    None
}
