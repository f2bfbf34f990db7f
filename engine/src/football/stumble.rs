//! Who loses their balance when two bodies collide.
//!
//! There is no chance in it. Speed, the ball, the opponent's side and the depth of the collision
//! count against balance; if they outweigh it, a runner stumbles or falls. (GRF's rule; its motions
//! are measured.)

use crate::football::pace::{DRIBBLES_FROM_MPS, SPRINTS_FROM_MPS, WALKS_FROM_MPS};
use crate::football::{foul, possession};
use crate::math;
use crate::state::event::Events;
use crate::state::player::{Aim, Pose};
use crate::state::{Match, Player, PlayerId};
use glam::Vec2;
use setpiece_scenario::vocabulary::Stat;

/// Weights relative to 1: a lack of balance, and how deep two bodies overlap. (GRF's.)
const BALANCE: f32 = 3.0;
const DEPTH: f32 = 6.0;
const DEPTH_POWER: f32 = 0.4;
/// Depth is judged this far ahead, seconds. A ball this near is in the way, metres. (GRF's.)
const AHEAD_S: f32 = 0.03;
const BALL_M: f32 = 0.7;
/// Shares of the total weight from which on a player stumbles, and falls. (GRF's.)
const STUMBLES: f32 = 0.48;
const FALLS: f32 = 0.58;
/// Severity of bringing somebody down with a leg that is out, and what is added from behind. Chosen
/// so that it earns no card.
const SEVERITY: f32 = 1.05;
const FROM_BEHIND: f32 = 0.3;
/// Within this distance of the ball a fall may be a foul, metres. (GRF's.)
const FOUL_M: f32 = 2.0;
/// The weight of each gait: standing, dribbling, walking, sprinting. (GRF's.)
const PACES: [f32; 4] = [0.0, 0.44, 0.63, 1.0];
/// The direction of a push: shares of both runs in it.
const OWN_RUN: f32 = 0.1;
const OTHER_RUN: f32 = 0.06;
/// Cosines between a push and where the player faces: pushed back, pushed back at a sprint, pushed
/// on.
const BACK: f32 = -0.4;
const BACK_SPRINTING: f32 = -0.7;
const ON: f32 = 0.7;

/// A stumble, or a fall that is run out of: its length, ticks, and its final speed, m/s.
struct StumbleMotion(u8, f32);

const STANDING: StumbleMotion = StumbleMotion(30, 0.7);
const HELD_UP: StumbleMotion = StumbleMotion(25, 3.75);
const HELD_UP_SPRINTING: StumbleMotion = StumbleMotion(49, 3.4);
const ASIDE: StumbleMotion = StumbleMotion(36, 4.2);
const ASIDE_SPRINTING: StumbleMotion = StumbleMotion(91, 4.8);
const PUSHED_ON: StumbleMotion = StumbleMotion(46, 6.6);
const FALLEN: StumbleMotion = StumbleMotion(60, 4.2);
const FALLEN_SPRINTING: StumbleMotion = StumbleMotion(96, 1.2);

/// How a collision ends for one of the two players.
#[derive(Clone, Copy, PartialEq, PartialOrd)]
enum MeetingOutcome {
    Stands,
    Stumbles,
    Falls,
}

/// Lets two bodies collide; both may lose their balance. `contact_m`: the distance at which bodies
/// touch. `vel`: how they move while they are pushed apart, m/s.
pub fn meet(
    game: &mut Match,
    events: &mut Events,
    [i, j]: [PlayerId; 2],
    vel: [Vec2; 2],
    contact_m: f32,
) {
    if game.play.hands.is_some_and(|(keeper, _)| keeper == i || keeper == j) {
        return;
    }
    let [a, b] = [(i, vel[0]), (j, vel[1])].map(|(id, vel)| Player { vel, ..*game.player(id) });
    let apart = (b.pos - a.pos + (b.vel - a.vel) * AHEAD_S).length() / contact_m;
    let depth = DEPTH * math::pow((1.0 - apart).clamp(0.0, 1.0), DEPTH_POWER);
    let outcomes = [(i, &a, &b), (j, &b, &a)]
        .map(|(id, player, other)| outcome(game, id, player, other, depth));
    for ([(id, player), (by, other)], outcome) in
        [[(i, &a), (j, &b)], [(j, &b), (i, &a)]].into_iter().zip(outcomes)
    {
        lose_balance(game, events, (id, player), (by, other), outcome);
    }
}

/// How a collision ends for a player.
fn outcome(
    game: &Match,
    id: PlayerId,
    player: &Player,
    other: &Player,
    depth: f32,
) -> MeetingOutcome {
    let from = (player.pos - other.pos).normalize_or_zero();
    let turned = 0.5 - 0.5 * player.body.facing.dot(from);
    let ball = game.play.forecast.at(game.tick + 1).truncate();
    let rivals = game.team(id.team().other());
    let soonest = rivals.fold(f32::MAX, |least, (_, rival)| least.min(rival.body.meet_s));
    let has_ball = possession::has_ball(game, id) && soonest > player.body.meet_s;
    let counts = turned
        + pace(player.vel.length())
        + f32::from(u8::from(has_ball))
        + BALANCE * (1.0 - player.skill(Stat::Balance))
        + (player.body.push_m * 10.0).min(1.0)
        + depth
        + (1.0 - ball.distance(player.pos) / BALL_M).max(0.0);
    let share = counts / (5.0 + BALANCE + DEPTH);
    if share > FALLS {
        MeetingOutcome::Falls
    } else if share > STUMBLES {
        MeetingOutcome::Stumbles
    } else {
        MeetingOutcome::Stands
    }
}

/// The weight of a gait.
fn pace(mps: f32) -> f32 {
    let gaits = [DRIBBLES_FROM_MPS, WALKS_FROM_MPS, SPRINTS_FROM_MPS];
    PACES[gaits.iter().filter(|&&from_mps| mps >= from_mps).count()]
}

/// Lets a player stumble or fall over another.
fn lose_balance(
    game: &mut Match,
    events: &mut Events,
    (id, player): (PlayerId, &Player),
    (by, other): (PlayerId, &Player),
    outcome: MeetingOutcome,
) {
    let worse = match player.body.pose {
        Pose::Up => outcome > MeetingOutcome::Stands,
        Pose::Stumbling { .. } => {
            outcome > MeetingOutcome::Stumbles && player.body.pose_ticks < FALLEN.0
        }
        Pose::Sliding | Pose::Down | Pose::Diving => false,
    };
    if !worse {
        return;
    }
    let push =
        (player.pos - other.pos).normalize_or_zero() + player.vel * OWN_RUN + other.vel * OTHER_RUN;
    let cos = push.normalize_or_zero().dot(player.body.facing);
    let (speed, falls) = (player.vel.length(), outcome == MeetingOutcome::Falls);
    let tripped = &mut game.players[id.index()];
    tripped.vel = player.vel;
    tripped.body.lunge = None;
    if let Some(kick) = &mut tripped.body.kick {
        kick.swing = None;
    }
    let StumbleMotion(ticks, mps) = match (falls, speed >= SPRINTS_FROM_MPS) {
        (true, true) => FALLEN_SPRINTING,
        (true, false) => FALLEN,
        (false, _) => stumble(speed, cos),
    };
    let ticks = if falls { tripped.shaken(f32::from(ticks)) as u8 } else { ticks };
    tripped.body.strike_pose(Pose::Stumbling { to_dmps: (mps * 10.0) as u8 }, ticks);
    // A foot on its way back brings a runner down, too. (GRF's.)
    let lunges = other.body.lunge.is_some_and(|lunge| lunge.aim == Aim::Poke)
        || other.body.pose == Pose::Sliding;
    let near = player.pos.distance_squared(game.ball.pos.truncate()) < FOUL_M * FOUL_M;
    if falls && lunges && near && by.team() != id.team() && game.possession == Some(id.team()) {
        let behind = player.body.facing.dot((player.pos - other.pos).normalize_or_zero()).max(0.0);
        foul::call_or_let_run(game, events, by, id, SEVERITY + FROM_BEHIND * behind);
    }
}

/// How a player stumbles who is pushed backwards or onwards.
fn stumble(speed: f32, cos: f32) -> StumbleMotion {
    let sprints = speed >= SPRINTS_FROM_MPS;
    if speed < DRIBBLES_FROM_MPS {
        STANDING
    } else if cos > ON {
        PUSHED_ON
    } else if cos < BACK_SPRINTING && sprints {
        HELD_UP_SPRINTING
    } else if sprints {
        ASIDE_SPRINTING
    } else if cos < BACK {
        HELD_UP
    } else {
        ASIDE
    }
}
