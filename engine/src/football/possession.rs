//! Who has the ball now, and which team had it last.

use crate::football::report;
use crate::state::event::Events;
use crate::state::{Match, PlayerId};
use setpiece_scenario::vocabulary::EventKind;

/// A dribbler's ball is at most this high, metres; chosen: how high a trapped ball hops.
const HIGH_M: f32 = 1.5;

impl Match {
    /// The player with the ball at their feet or in their hands, or the one who dribbles it.
    pub fn on_ball(&self) -> Option<PlayerId> {
        self.owner.or_else(|| self.controller())
    }

    /// The player who dribbles the ball, even while it rolls free between two touches.
    pub fn controller(&self) -> Option<PlayerId> {
        let id = self.last_touch?;
        let player = self.player(id);
        let near = player.pos.distance_squared(self.ball.pos.truncate()) < 2.2 * 2.2;
        let own = self.play.pass.is_none() && self.play.shot.is_none();
        (player.active && near && own && self.ball.pos.z < HIGH_M).then_some(id)
    }
}

/// Whether a player has the ball at their feet: it is near, low and about as fast as the player.
pub fn has_ball(game: &Match, id: PlayerId) -> bool {
    let player = game.player(id);
    if !player.active || game.ball.pos.z > 0.5 {
        return false;
    }
    let centre = player.pos + player.vel * 0.05 + player.body.facing * 0.1;
    centre.distance_squared(game.ball.pos.truncate()) <= 1.0
        && (game.ball.vel.truncate() - player.vel).length_squared() <= 36.0
}

/// Updates the owner: the last toucher while they have the ball, or the keeper while holding it.
pub fn update(game: &mut Match, events: &mut Events) {
    let owner = match (game.play.hands, game.play.set_piece) {
        (Some((keeper, _)), _) => Some(keeper),
        (_, Some(set_piece)) => Some(set_piece.taker),
        _ => game.last_touch.filter(|&id| has_ball(game, id)),
    };
    if owner.is_some() && owner != game.owner {
        let team = owner.map(PlayerId::team);
        if team != game.possession && game.play.set_piece.is_none() {
            won(game, events, owner);
        }
        game.possession = team;
    }
    if owner.is_some() && owner != game.play.last_owner {
        game.play.last_owner = owner;
        game.play.owned_since = game.tick;
    }
    game.owner = owner;
}

/// Reports that the ball changed sides.
fn won(game: &Match, events: &mut Events, owner: Option<PlayerId>) {
    let Some(winner) = owner else { return };
    let Some(before) = game.possession else { return };
    events.push(report::event(game, EventKind::BallWon).by(winner));
    let lost = report::event(game, EventKind::BallLost).team(before);
    // A set piece gives the ball to a team even if none of its players had it.
    let loser = game.play.last_owner.filter(|loser| loser.team() == before);
    events.push(loser.map_or(lost, |loser| lost.by(loser)));
}
