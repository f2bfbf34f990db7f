//! Who plays players, whatever the text says.

use super::World;
use super::roster::Rostered;
use crate::ast::{Field, Ident};
use crate::cast::CastTarget;
use crate::problem::Problem;
use crate::problem::facts::Names;
use setpiece_scenario::vocabulary::Team;

/// An `ai` from outside, read: `each all { ai: … }` in a text of its own.
#[derive(Clone, Copy)]
pub(crate) struct Casting<'w> {
    /// Whose.
    pub(crate) target: CastTarget,
    /// The `all`.
    pub(crate) who: &'w Ident,
    /// The `ai`.
    pub(crate) field: &'w Field,
}

/// Gives single players theirs: it stands behind what they have of their own, and wins.
pub(super) fn apply<'w>(world: &World<'w>, players: &mut [Rostered<'w>], team: Team) {
    for cast in world.casting {
        let CastTarget::Player(side, place) = cast.target else { continue };
        if side != team {
            continue;
        }
        match players.get_mut(place) {
            Some(player) => player.fields.push(cast.field),
            None => world.report(Problem::new(
                cast.who.span,
                Names::NoSuchPlace { team: team.name(), place },
            )),
        }
    }
}
