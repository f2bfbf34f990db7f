//! Which actions can change anything.

use super::{ObserveError, slot};
use crate::control::driver;
use crate::football::body::KickKind;
use crate::state::Match;
use setpiece_scenario::vocabulary::{Action, StickyAction};

/// Which of the 20 actions of GRF's `v2` set can change something for agent `agent`; the first 19 are its `default` set.
/// `idle` always may be chosen.
///
/// Masked are: what is held already and the release of what isn't held; passes and shots while the ball is not the
/// player's to play, and sliding while it is; high passes and shots at a throw-in; everything but `idle` for an agent
/// without a player on the pitch.
///
/// # Errors
/// [`ObserveError::Agent`] for no such agent.
pub fn action_mask(game: &Match, agent: usize) -> Result<[bool; Action::V2_SET], ObserveError> {
    let slot = slot(game, agent)?;
    let mut mask = [false; Action::V2_SET];
    mask[Action::Idle.index()] = true;
    let Some(player) = slot.player.filter(|player| game.player(*player).active) else { return Ok(mask) };
    let held = |sticky: StickyAction| slot.sticky >> sticky.index() & 1 == 1;
    let directions = &StickyAction::ALL[..StickyAction::Sprint.index()];
    let kick = |kind: KickKind| driver::may_arm(game, player, kind);
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
            | Action::BottomLeft => StickyAction::from_name(action.name()).is_some_and(|direction| !held(direction)),
            Action::ReleaseDirection => directions.iter().any(|direction| held(*direction)),
            Action::Sprint => !held(StickyAction::Sprint),
            Action::ReleaseSprint => held(StickyAction::Sprint),
            Action::Dribble => !held(StickyAction::Dribble),
            Action::ReleaseDribble => held(StickyAction::Dribble),
            Action::LongPass => kick(KickKind::Long),
            Action::HighPass => kick(KickKind::High),
            Action::ShortPass => kick(KickKind::Short),
            Action::Shot => kick(KickKind::Shot),
            Action::Sliding => driver::may_slide(game, player),
        };
    }
    Ok(mask)
}
