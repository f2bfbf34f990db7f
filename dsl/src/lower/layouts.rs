//! Two layouts of one team: the same players, who stand elsewhere.

use super::World;
use super::people::Rostered;
use super::value::{LocalName, Scope};
use crate::ast::{Field, FieldValue, Span};
use crate::problem::Problem;
use crate::problem::facts::Players;

/// Two layouts of one team have the same players; the second says where they stand, and nothing
/// else of them that the first doesn't say.
pub(super) fn check_same(
    world: &World<'_>,
    one: &[Rostered<'_>],
    other: &[Rostered<'_>],
    at: Span,
) {
    if one.len() == other.len() && one.iter().zip(other).all(|(one, other)| one.role == other.role)
    {
        let mut pairs = one.iter().zip(other);
        if let Some((_, player)) = pairs.find(|(one, other)| says_more(world, one, other)) {
            world.report(Problem::new(at, Players::SecondLayoutSaysMore { player: player.span }));
        }
        return;
    }
    let (first, second) = (roles(one.iter()), roles(other.iter()));
    world.report(Problem::new(at, Players::LayoutsDiffer { first, second }));
}

/// A layout has the same players whichever of its formations an episode has.
/// `false` after a report.
pub(super) fn check_whole(world: &World<'_>, players: &[Rostered<'_>], at: Span) -> bool {
    let of = |which: usize| {
        roles(players.iter().filter(|player| {
            player.formations.as_ref().is_none_or(|them| them.which.contains(&which))
        }))
    };
    let first = of(0);
    let second = players
        .iter()
        .filter_map(|player| player.formations.as_ref())
        .flat_map(|them| &them.which)
        .map(|&which| of(which))
        .find(|roles| *roles != first);
    let is_whole = second.is_none();
    if let Some(second) = second {
        world.report(Problem::new(at, Players::LayoutsDiffer { first, second }));
    }
    is_whole
}

fn roles<'a, 'w: 'a>(players: impl Iterator<Item = &'a Rostered<'w>>) -> String {
    players.map(|player| player.role.name()).collect::<Vec<_>>().join(" ")
}

/// Whether the second layout says something of a player beside the place that it doesn't share
/// with the first, as a child shares what it inherits.
pub(super) fn says_more(world: &World<'_>, one: &Rostered<'_>, other: &Rostered<'_>) -> bool {
    let said = |player: &Rostered<'_>| -> Vec<Span> {
        let facing = player.facing.map(|facing| facing.target.span);
        let exprs =
            [player.jitter, player.when, player.maybe].into_iter().flatten().map(|expr| expr.span);
        facing
            .into_iter()
            .chain(exprs)
            .chain(player.fields.iter().map(|field| whole(field)))
            .collect()
    };
    let known = said(one);
    said(other)
        .into_iter()
        .any(|part| !known.contains(&part) || !reads_alike(world, part, &one.scope, &other.scope))
}

fn whole(field: &Field) -> Span {
    field.key.span.to(match &field.value {
        FieldValue::Expr(expr) => expr.span,
        FieldValue::Fields(_, span) => *span,
        FieldValue::Script(script) => script.span,
    })
}

/// Whether a text means the same in two scopes: parameters of a formation may differ.
fn reads_alike(world: &World<'_>, text: Span, one: &Scope<'_>, other: &Scope<'_>) -> bool {
    let text = world.library.sources.text(text);
    let mut words = text.split(|c: char| !c.is_alphanumeric() && c != '_');
    words.all(|word| match (one.find(word), other.find(word)) {
        (None, None) => true,
        (
            Some(LocalName::Expr { expr: a, scope: of_a, .. }),
            Some(LocalName::Expr { expr: b, scope: of_b, .. }),
        ) => a.span == b.span && reads_alike(world, a.span, of_a, of_b),
        _ => false,
    })
}
