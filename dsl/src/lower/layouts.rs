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
pub(super) fn says_more<'w>(world: &World<'_>, one: &Rostered<'w>, other: &Rostered<'w>) -> bool {
    let known = said(one);
    let reads_as = |part: &(Span, Scope<'w>)| {
        let same = known.iter().find(|known| known.0 == part.0);
        same.is_some_and(|known| reads_alike(world, part.0, &known.1, &part.1))
    };
    !said(other).iter().all(reads_as)
}

/// What is said of a player beside the place, and the scopes in which it stands.
fn said<'w>(player: &Rostered<'w>) -> Vec<(Span, Scope<'w>)> {
    let facing = player.facing.iter().map(|part| (part.it.target.span, part.scope.clone()));
    let jitter = player.jitter.iter().map(|part| (part.it.span, part.scope.clone()));
    let plays = [player.when, player.maybe].into_iter().flatten();
    let plays = plays.map(|expr| (expr.span, player.scope.clone()));
    let fields = player.fields.iter().map(|part| (whole(part.it), part.scope.clone()));
    facing.chain(jitter).chain(plays).chain(fields).collect()
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
