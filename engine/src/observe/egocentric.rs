//! `egocentric`: what a player sees from their own place.

use super::frame::SideFrame;
use super::layout::{FAR_M, OTHER, OTHERS};
use super::{ObserveError, check_size, slot};
use crate::football::offside;
use crate::state::{Match, Player, PlayerId};
use arrayvec::ArrayVec;
use setpiece_scenario::pitch::{TEAM_MAX, X_SCALE_M};
use setpiece_scenario::vocabulary::{Role, StickyAction};

/// The unit of speeds, m/s.
const SPEED_MPS: f32 = 10.0;
/// The unit of heights, metres.
const HEIGHT_M: f32 = 10.0;
/// Number of goals that fills the scale.
const GOALS: f32 = 5.0;
/// The largest absolute value of places and velocities: [`super::layout::egocentric`].
const MOST: f32 = 4.0;

/// Writes agent `agent`'s egocentric observation. The layout is [`super::layout::egocentric`] of
/// the larger team's size. All zeros for an agent without a player.
///
/// # Errors
/// [`ObserveError`] for unknown agents, or a buffer of another size; nothing is written then.
pub fn egocentric(
    game: &Match,
    agent: usize,
    team: usize,
    out: &mut [f32],
) -> Result<(), ObserveError> {
    let slot = slot(game, agent)?;
    check_size(out.len(), size(team))?;
    out.fill(0.0);
    let Some(id) = slot.player.filter(|id| game.player(*id).active) else { return Ok(()) };
    let frame = SideFrame { game, us: slot.team };
    let me = game.player(id);
    let side = slot.team.side() as f32;
    let mut pen = NumberPen { out, at: 0 };
    let unit = X_SCALE_M as f32;
    let goal = game.goal();
    let own = me.pos * side;

    let [x, y] = frame.place_of(me.pos);
    pen.all([x as f32, y as f32], 2.0);
    pen.all((me.vel * (side / SPEED_MPS)).to_array(), 2.0);
    pen.all((me.body.facing * side).to_array(), 1.0);
    pen.one(me.fatigue, 1.0);
    pen.all(
        std::array::from_fn::<f32, { StickyAction::DEFAULT_SET }, _>(|bit| {
            f32::from(slot.sticky >> bit & 1)
        }),
        1.0,
    );
    let ball = game.ball.pos.truncate() * side - own;
    pen.all((ball / unit).to_array(), MOST);
    pen.one((game.ball.pos.z / HEIGHT_M).max(0.0), 1.0);
    pen.one(ball.length() / FAR_M, 1.0);
    let velocity = game.ball.vel / SPEED_MPS;
    pen.all([velocity.x * side, velocity.y * side, velocity.z], 6.0);
    let has = |who: &dyn Fn(PlayerId) -> bool| f32::from(u8::from(game.owner.is_some_and(who)));
    pen.all(
        [
            f32::from(u8::from(game.owner.is_none())),
            has(&|owner| owner == id),
            has(&|owner| owner != id && owner.team() == slot.team),
            has(&|owner| owner.team() != slot.team),
            f32::from(u8::from(game.play.hands.is_some())),
        ],
        1.0,
    );
    pen.all(((goal - own) / unit).to_array(), MOST);
    pen.all(((-goal - own) / unit).to_array(), MOST);
    pen.all(
        std::array::from_fn::<f32, 7, _>(|mode| f32::from(u8::from(mode == game.mode.index()))),
        1.0,
    );
    pen.one(
        f32::from(u8::from(game.play.set_piece.is_some_and(|piece| piece.team == slot.team))),
        1.0,
    );
    let [ours, theirs] = frame.teams().map(|team| f32::from(game.score[team.index()]));
    pen.one((ours - theirs) / GOALS, 1.0);
    pen.one(
        game.limit_steps
            .map_or(0.0, |limit| limit.saturating_sub(game.step) as f32 / limit.max(1) as f32),
        1.0,
    );
    pen.one((offside::line(game, slot.team) - own.x) / unit, MOST);
    pen.all([f32::from(u8::from(me.role == Role::GK)), 1.0], 1.0);

    for (who, most) in [(slot.team, team - 1), (slot.team.other(), team)] {
        let mut others: ArrayVec<(f32, &Player), TEAM_MAX> = frame
            .roster(who)
            .filter(|(other, player)| *other != id && player.active)
            .map(|(_, player)| (player.pos.distance_squared(me.pos), player))
            .collect();
        others.sort_by(|a, b| a.0.total_cmp(&b.0));
        let end = pen.at + OTHER * most;
        for (_, other) in others.into_iter().take(most) {
            let way = (other.pos - me.pos) * side;
            let velocity = (other.vel - me.vel) * (side / SPEED_MPS);
            pen.one(1.0, 1.0);
            pen.all((way / unit).to_array(), MOST);
            pen.all(velocity.to_array(), MOST);
            pen.one(way.length() / FAR_M, 1.0);
            pen.one(f32::from(u8::from(other.role == Role::GK)), 1.0);
        }
        pen.at = end;
    }
    Ok(())
}

/// The length of the observation for teams of up to `team` players.
pub fn size(team: usize) -> usize {
    OTHERS + OTHER * (2 * team).saturating_sub(1)
}

/// Writes one number after the other, each clamped to ± its bound.
struct NumberPen<'a> {
    out: &'a mut [f32],
    at: usize,
}

impl NumberPen<'_> {
    fn one(&mut self, value: f32, bound: f32) {
        if let Some(out) = self.out.get_mut(self.at) {
            // Adding 0 folds -0.0.
            *out = value.clamp(-bound, bound) + 0.0;
        }
        self.at += 1;
    }

    fn all<const N: usize>(&mut self, values: [f32; N], bound: f32) {
        for value in values {
            self.one(value, bound);
        }
    }
}
