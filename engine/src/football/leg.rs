//! Where a motion of a leg, or of a keeper's hands, meets the ball.
//!
//! A motion is made for a ball at one place beside the body. The real one may be some way off that
//! place: far behind it but hardly ahead of it, and further along the run than beside it. A long
//! motion allows for more than a short one, a slow player for more than a sprinter, and whoever has
//! just touched the ball for hardly anything. (GRF's rule and figures.)

use crate::football::pace::SPRINT_MPS;
use crate::math;
use crate::state::play::ticks_since;
use crate::state::{Match, PlayerId};
use glam::{Vec2, Vec3};
use setpiece_scenario::vocabulary::Stat;

/// The reach of a motion of [`MEAN_TICKS`], metres, and the power by which it grows with the time
/// until the touch; `LATE` of the growth counts beyond that.
const REACH_M: f32 = 0.3;
const MEAN_TICKS: f32 = 24.0;
const SOONER: f32 = 0.7;
const LATE: f32 = 0.5;
/// How long a player's own touch shortens the reach, seconds, and by which share of it at first;
/// ball control saves up to `CONTROL` of that.
const FRESH_S: f32 = 0.6;
const FRESH: f32 = 0.97;
const CONTROL: f32 = 0.1;
/// Within this distance of the body's front (`FRONT_M` ahead) a ball is easier to reach, metres:
/// how much of the ease is smooth, of the motion's place and of the ball's.
const EASY_M: f32 = 0.7;
const FRONT_M: f32 = 0.1;
const SMOOTH: [f32; 2] = [0.7, 0.4];
/// What that adds to the reach: the motion's place, the ball's, both together.
const EASE: [f32; 3] = [1.0, 0.6, 0.8];
/// The width of the reach beside the run, or beside the way in which one who stands ends: of who
/// stands, and how much less at a sprint.
const WIDTH: [f32; 2] = [0.6, 0.3];
/// By how much the velocities before, at and after the touch pull the reach back; less in a motion
/// that doesn't lead on.
const BEHIND: [f32; 3] = [0.1, 0.2, 0.7];
/// The share of a reach that a motion uses, how much of the extra reach is pulled back, and what is
/// allowed on top, metres.
const SHARE: f32 = 0.5;
const PULLED: f32 = 0.6;
const SLACK_M: f32 = 0.02;

/// How far above or below its place a motion meets the ball, metres, and what the heights of both
/// take off that, per metre and at most. (GRF's.)
pub(super) const UP_M: f32 = 0.22;
const HIGHER: [[f32; 2]; 2] = [[0.3, 0.2], [0.4, 0.3]];
/// The height of a ball on the grass, and up to which a ball counts as low, metres. (GRF's.)
pub(super) const GRASS_M: f32 = 0.11;
const LOW_M: f32 = 0.5;
/// Up to how far off its place a ball doesn't draw a body, and how far off it a body stays, metres.
/// (GRF's.)
const UNDRAWN_M: f32 = 0.02;
const OFF_M: f32 = 0.2;
/// How far off its place the ball may be when the foot arrives, metres. (GRF's.)
const MISSED_M: f32 = 0.4;

/// A motion's touch, in the frame of the player's run: x along it, y to one side.
pub(super) struct MotionTouch {
    /// Ticks until then.
    pub(super) ticks: i32,
    /// The place of the ball that it is made for, metres from the body.
    pub(super) made_for: Vec2,
    /// The player's speed now, m/s.
    pub(super) pace: f32,
    /// The velocity at the touch and at the end, m/s.
    pub(super) at: Vec2,
    pub(super) out: Vec2,
    /// The way of the player at its end, unit.
    pub(super) ends: Vec2,
}

/// What a motion is for decides how far it reaches.
#[derive(Clone, Copy)]
pub(super) struct Reach {
    /// A factor of the reach, and more metres of it.
    pub(super) factor: f32,
    pub(super) more_m: f32,
}

/// The reach of kicks.
pub(super) const KICK: Reach = Reach { factor: 1.3, more_m: 0.15 };

/// The reach of pokes, and of slides.
pub(super) const POKE: Reach = Reach { factor: 1.4, more_m: 0.2 };
pub(super) const SLIDE: Reach = Reach { factor: 0.2, more_m: 0.0 };

/// The reach of the touches of a dribble, and what a player who is about to kick has of it.
pub(super) const DRIBBLE: Reach = Reach { factor: 1.0, more_m: 0.0 };
pub(super) const BEFORE_A_KICK: Reach = Reach { factor: 0.3, more_m: 0.0 };

/// The reach of a keeper's hands.
pub(super) const HANDS: Reach = Reach { factor: 1.8, more_m: 0.4 };

/// The share of their reach that a player has at a touch some ticks ahead.
pub(super) fn freshness(game: &Match, id: PlayerId, ticks: i32) -> f32 {
    if game.last_touch != Some(id) {
        return 1.0;
    }
    let player = game.player(id);
    let since = ticks_since(game.tick, player.body.touched_at).saturating_add(ticks);
    after(since as f32 * 0.01, player.skill(Stat::BallControl))
}

/// The share of their reach that a player has some seconds after their own touch of the ball.
fn after(since_s: f32, control: f32) -> f32 {
    1.0 - math::ease(1.0 - (since_s / FRESH_S).clamp(0.0, 1.0)) * FRESH * (1.0 - CONTROL * control)
}

/// Whether a motion meets a ball that will be here at the touch, metres from the body.
pub(super) fn meets(touch: &MotionTouch, ball: Vec2, reach: Reach, fresh: f32) -> bool {
    let ease = |place: Vec2, smooth: f32| {
        let far = (place.distance(Vec2::new(FRONT_M, 0.0)) / EASY_M).min(1.0);
        1.0 - math::mix(far, math::ease(far), smooth)
    };
    let (planned, real) = (ease(touch.made_for, SMOOTH[0]), ease(ball, SMOOTH[1]));
    let run = Vec2::new(touch.pace, 0.0);
    let mean = 0.5 * (run + touch.out).length();
    let slow = 1.0 - (mean / SPRINT_MPS).min(1.0);
    let width = WIDTH[0] - WIDTH[1] * math::pow((touch.pace / SPRINT_MPS).min(1.0), SOONER);
    let radius_m = reach.factor
        * fresh
        * in_time_m(touch.ticks)
        * (1.0 + EASE[0] * planned + EASE[1] * real + EASE[2] * planned * real + slow)
        / libm::sqrtf(width);
    let more_m = reach.more_m * fresh;
    let pull = BEHIND[0] * run + BEHIND[1] * touch.at + BEHIND[2] * touch.out;
    let back = libm::sqrtf((pull.length() / SPRINT_MPS).min(1.0)) * (0.75 + 0.25 * touch.ends.x);
    let centre = pull.normalize_or_zero() * (-back * (radius_m + PULLED * more_m) * SHARE);
    let axis = if touch.pace > 0.0 { Vec2::X } else { touch.ends };
    let off = ball - touch.made_for;
    let off = axis * off.dot(axis) + axis.perp() * (axis.perp_dot(off) / width);
    off.distance(centre) <= (radius_m + more_m) * SHARE + SLACK_M
}

/// The reach of a motion that touches the ball after some ticks, metres.
fn in_time_m(ticks: i32) -> f32 {
    let time = math::pow(ticks as f32 / MEAN_TICKS, SOONER);
    REACH_M * if time > 1.0 { 1.0 + (time - 1.0) * LATE } else { time }
}

/// Whether a ball at this height is met by a motion at another, metres. `low_m`: how much further
/// off a low ball may be.
pub(super) fn is_high_enough(ball_m: f32, motion_m: f32, low_m: f32) -> bool {
    let low_m = if ball_m < LOW_M { low_m } else { 0.0 };
    heights_apart_m(ball_m, motion_m) - low_m < UP_M
}

/// How far a ball at this height counts as being above or below the one that a motion is made for,
/// metres.
pub(super) fn heights_apart_m(ball_m: f32, motion_m: f32) -> f32 {
    let eased =
        |height: f32, [per_m, most]: [f32; 2]| 1.0 - ((height - GRASS_M) * per_m).clamp(0.0, most);
    (ball_m - motion_m).abs() * eased(motion_m, HIGHER[0]) * eased(ball_m, HIGHER[1])
}

/// How much of its own way a ball keeps that has come off the place where a foot arrives now, 0..1.
/// None if the foot misses it. (GRF's.) The height doesn't count: forecasts of bounces are too
/// coarse.
pub(super) fn missed_share(game: &Match, place: Vec3) -> Option<f32> {
    missed_by(game.ball.pos.truncate().distance(place.truncate()))
}

/// How much of its own way a ball keeps that is this far off the place of a touch, metres.
pub(super) fn missed_by(off_m: f32) -> Option<f32> {
    let off = off_m / MISSED_M;
    (off < 1.0).then(|| math::smooth(math::smooth(off)))
}

/// How far a body moves to a ball that is this far off the place that a touch is made for, metres.
/// It comes nearer by `drawn` of the way, but stays `OFF_M` off: from a nearer ball it moves away.
/// (GRF's.)
pub(super) fn drawn(off: Vec2, drawn: f32) -> Vec2 {
    let off_m = off.length();
    off.normalize_or_zero() * (drawn * (off_m - UNDRAWN_M).max(0.0)).min(off_m - OFF_M)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A sprinter's shot.
    const SHOT: MotionTouch = MotionTouch {
        ticks: 17,
        made_for: Vec2::new(0.54, 0.14),
        pace: 7.64,
        at: Vec2::new(6.04, 0.0),
        out: Vec2::new(3.36, 0.0),
        ends: Vec2::X,
    };

    #[test]
    fn a_body_is_drawn_to_a_ball_that_is_far_off_and_away_from_a_near_one() {
        // Measured: 0.23 m behind the place draws back by 0.03 m, 0.02 m ahead of it by 0.18 m.
        assert!((drawn(Vec2::new(-0.23, 0.0), 0.6).x + 0.03).abs() < 1e-3);
        assert!((drawn(Vec2::new(0.02, 0.0), 0.6).x + 0.18).abs() < 1e-3);
        assert!((drawn(Vec2::new(1.0, 0.0), 0.6).x - 0.588).abs() < 1e-3);
        assert_eq!(drawn(Vec2::ZERO, 0.6), Vec2::ZERO);
    }

    #[test]
    fn a_sprinter_shoots_a_ball_that_is_no_further_than_the_motion_is_made_for() {
        // Measured: its place is 1.82 m ahead of the start, 1.86 m is too far, 1.77 near enough.
        let ball = |ahead: f32| Vec2::new(0.54 + ahead - 1.82, 0.0);
        assert!(!meets(&SHOT, ball(1.86), KICK, 1.0));
        assert!(meets(&SHOT, ball(1.77), KICK, 1.0));
        assert!(meets(&SHOT, ball(1.3), KICK, 1.0));
        assert!(!meets(&SHOT, ball(0.5), KICK, 1.0));
    }

    #[test]
    fn a_motion_for_the_grass_meets_a_bouncing_ball_only_if_it_may_be_low() {
        assert!(is_high_enough(0.3, GRASS_M, 0.0));
        assert!(!is_high_enough(0.45, GRASS_M, 0.0) && is_high_enough(0.45, GRASS_M, 0.15));
        assert!(!is_high_enough(0.6, GRASS_M, 0.15), "a ball at the knee isn't low");
        assert!(is_high_enough(1.9, 1.65, 0.0), "a header allows for more");
    }

    #[test]
    fn whoever_has_just_touched_the_ball_reaches_less() {
        let [soon, later] = [0.25, 0.7].map(|since_s| after(since_s, 0.7));
        assert!(soon < 0.5 && later == 1.0);
        let ball = Vec2::new(0.2, 0.0);
        assert!(meets(&SHOT, ball, KICK, later) && !meets(&SHOT, ball, KICK, soon));
    }
}
