//! Who plays players, whatever the text says.

use super::World;
use super::people::{Rostered, Scoped};
use super::value::{LiteralFrame, Scope};
use crate::cast::CastTarget;
use crate::problem::Problem;
use crate::problem::facts::Names;
use setpiece_scenario::vocabulary::Team;

/// Gives single players theirs: it stands behind what they have of their own, and wins.
pub(super) fn apply<'w>(world: &World<'w>, players: &mut [Rostered<'w>], team: Team) {
    let scope = Scope::new(true, LiteralFrame::World);
    for cast in world.casting {
        let CastTarget::Player(side, place) = cast.target else { continue };
        if side != team {
            continue;
        }
        match players.get_mut(place) {
            Some(player) => player.fields.push(Scoped::new(cast.field, &scope)),
            None => world.report(Problem::new(
                cast.who.span,
                Names::NoSuchPlace { team: team.name(), place },
            )),
        }
    }
}
