//! Which actions have an effect.

use super::{ObserveError, slot};
use crate::control::driver;
use crate::football::switching;
use crate::state::Match;
use crate::state::player::KickKind;
use setpiece_scenario::vocabulary::{Action, StickyAction};

/// Which of the 33 actions of GRF's `full` set can have an effect for agent `agent`. The first 19
/// are its `default` set, the first 20 its `v2` set. `idle` is always allowed.
///
/// Masked are:
///
/// - actions already held, and the release of what isn't held;
/// - a switch without a player to switch to;
/// - passes and shots while the ball isn't the player's to play, and sliding while it is;
/// - high passes and shots at a throw-in;
/// - everything but `idle` for an agent without a player on the pitch.
///
/// # Errors
/// [`ObserveError::Agent`] for unknown agents.
pub fn action_mask(game: &Match, agent: usize) -> Result<[bool; Action::FULL_SET], ObserveError> {
    let slot = slot(game, agent)?;
    let mut mask = [false; Action::FULL_SET];
    mask[Action::Idle.index()] = true;
    let Some(player) = slot.player.filter(|player| game.player(*player).active) else {
        return Ok(mask);
    };
    let held = |sticky: StickyAction| slot.sticky >> sticky.index() & 1 == 1;
    let directions = &StickyAction::ALL[..StickyAction::Sprint.index()];
    // A key that is down may stay down; it must be released before it can act again.
    let kick = |kind: KickKind| slot.key == Some(kind) || driver::may_arm(game, player, kind);
    for (action, open) in Action::ALL.iter().zip(&mut mask) {
        *open = match action {
            Action::Idle | Action::BuiltinAi => true,
            Action::Left
            | Action::TopLeft
            | Action::Top
            | Action::TopRight
            | Action::Right
            | Action::BottomRight
            | Action::Bottom
            | Action::BottomLeft
            | Action::KeeperRush
            | Action::Pressure
            | Action::TeamPressure
            | Action::Sprint
            | Action::Dribble => {
                StickyAction::from_name(action.name()).is_some_and(|key| !held(key))
            }
            Action::ReleaseDirection => directions.iter().any(|direction| held(*direction)),
            Action::ReleaseSprint => held(StickyAction::Sprint),
            Action::ReleaseDribble => held(StickyAction::Dribble),
            Action::ReleaseKeeperRush => held(StickyAction::KeeperRush),
            Action::ReleasePressure => held(StickyAction::Pressure),
            Action::ReleaseTeamPressure => held(StickyAction::TeamPressure),
            Action::Switch => {
                switching::runner(game, agent).or_else(|| switching::sooner(game, agent)).is_some()
            }
            Action::ReleaseLongPass
            | Action::ReleaseHighPass
            | Action::ReleaseShortPass
            | Action::ReleaseShot
            | Action::ReleaseSliding
            | Action::ReleaseSwitch => false,
            Action::LongPass => kick(KickKind::Long),
            Action::HighPass => kick(KickKind::High),
            Action::ShortPass => kick(KickKind::Short),
            Action::Shot => kick(KickKind::Shot),
            Action::Sliding => driver::may_slide(game, player),
        };
    }
    Ok(mask)
}
