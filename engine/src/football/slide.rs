//! Slide tackles: the slide itself, and the ball or the legs that it meets.

use crate::football::dribble_motion::MotionEnd::Braked;
use crate::football::dribble_motion::{self, DribbleMotion, motion};
use crate::football::pace::{DRIBBLES_FROM_MPS, SPRINTS_FROM_MPS};
use crate::football::{foul, leg, report};
use crate::state::event::Events;
use crate::state::play::ticks_since;
use crate::state::player::{Aim, Pose};
use crate::state::{Match, Player, PlayerId, Squad};
use glam::{Vec2, Vec3};
use setpiece_scenario::vocabulary::EventKind;

/// Ticks of a slide.
const SLIDE_TICKS: u8 = 60;
/// Ticks after which a slide has no force left.
const FORCE_TICKS: u8 = 42;
/// Ticks until the leg is out; before that it brings nobody down. (GRF's.)
const OUT_TICKS: u8 = 11;
/// Speed at the start of a slide out of a standstill, a walk and a sprint, m/s. Measured of GRF's
/// motions.
const SLIDES_MPS: [f32; 3] = [3.2, 6.5, 8.0];
/// The slides that meet the ball, of the same gaits. Only a ball exactly in the way is met, but
/// there it flies off. (GRF's motions.)
const SLIDES: [DribbleMotion; 3] = [
    motion(0.0, 180.0, [22, 46], Braked(0.8), 1.02, [0.2, 0.85], [0.0, 0.85]),
    motion(0.0, 180.0, [31, 59], Braked(0.2), 1.02, [0.0, 0.87], [0.0, 0.7]),
    motion(0.0, 180.0, [32, 62], Braked(1.2), 0.97, [0.0, 0.95], [0.0, 0.77]),
];
/// How fast a ball flies off that a slide meets: ahead and up, m/s, and how much of its own
/// velocity turns round. (GRF's.)
const MET_MPS: [f32; 2] = [6.0, 6.0];
const BACK: f32 = 0.28;
/// The severity of a slide that goes for no ball, and of one that does: too early or late, by a
/// power of the share of its time, and off the ball, in full from `OFF_M` on. (GRF's.)
const NO_BALL: f32 = 1.0;
const MISTIMED: [f32; 2] = [0.5, 0.7];
const OFF: f32 = 0.5;
const OFF_M: f32 = 2.0;
/// How near a slide must come to bring a rival down, metres.
const LEGS_M: f32 = 0.45;

/// Whether a player can start a slide: on their feet, without the ball, while play is on.
pub fn may_begin(game: &Match, id: PlayerId) -> bool {
    let waits = game.play.set_piece.is_some() || game.play.hands.is_some();
    game.player(id).is_up() && game.owner != Some(id) && !waits
}

/// Starts a slide tackle in the direction of the run or towards the ball.
pub fn begin(game: &mut Match, events: &mut Events, id: PlayerId, dir: Option<Vec2>) {
    if !may_begin(game, id) {
        return;
    }
    let ball = game.ball.pos.truncate();
    let player = &mut game.players[id.index()];
    let to_ball = ball - player.pos;
    let near = to_ball.length_squared() < 3.0 * 3.0;
    let way = if near { to_ball } else { dir.unwrap_or(player.body.facing) };
    let way = way.normalize_or(player.body.facing);
    let pace = player.vel.length();
    let gait = [DRIBBLES_FROM_MPS, SPRINTS_FROM_MPS].iter().filter(|&&from| pace >= from).count();
    player.body.facing = way;
    player.vel = way * SLIDES_MPS[gait];
    player.body.kick = None;
    player.body.lunge = None;
    let motion = &SLIDES[gait];
    if motion.fits(game, id, 0.0, leg::SLIDE) {
        dribble_motion::start(game, id, motion, Aim::Slide);
    }
    game.players[id.index()].body.strike_pose(Pose::Sliding, SLIDE_TICKS);
    report::did(game, events, EventKind::Slide, id, None);
}

/// The velocity of a ball that a slide meets.
pub(super) fn touched(player: &Player, ball: Vec3) -> Vec3 {
    let [ahead, up] = MET_MPS;
    (player.body.facing * ahead).extend(up) - ball * BACK
}

/// Lets every sliding player meet a rival. `slides`: the players that may be sliding.
pub fn resolve(game: &mut Match, events: &mut Events, slides: Squad) {
    for id in game.order_of(slides) {
        let player = game.player(id);
        if !player.active
            || player.body.pose != Pose::Sliding
            || player.body.pose_ticks < SLIDE_TICKS - FORCE_TICKS
        {
            continue;
        }
        if game.dead || game.play.hands.is_some() {
            return;
        }
        if ticks_since(game.tick, player.body.touched_at) <= 60 {
            continue;
        }
        let gone = SLIDE_TICKS.saturating_sub(player.body.pose_ticks);
        if gone >= OUT_TICKS {
            meet_legs(game, events, id);
        }
    }
}

/// Lets the slide meet a rival's legs.
fn meet_legs(game: &mut Match, events: &mut Events, id: PlayerId) {
    let player = *game.player(id);
    let ball = game.ball.pos.truncate();
    let foot = player.pos + player.body.facing * 0.35;
    let hit = game.team(id.team().other()).find_map(|(rival, other)| {
        (other.is_on_feet() && other.pos.distance_squared(foot) < LEGS_M * LEGS_M).then_some((
            rival,
            other.pos,
            other.body.facing,
        ))
    });
    let Some((rival, pos, facing)) = hit else { return };
    game.players[rival.index()].fall(60.0);
    game.players[rival.index()].vel *= 0.5;
    if pos.distance_squared(ball) > 8.0 * 8.0 {
        return;
    }
    let behind = 0.5 + 0.5 * facing.dot((pos - player.pos).normalize_or_zero());
    let severity = match player.body.lunge {
        None => NO_BALL,
        Some(lunge) => {
            let mistimed = (lunge.at - game.tick as i32).abs() as f32 / f32::from(lunge.out);
            let off = game.ball.pos.distance(lunge.place) / OFF_M;
            MISTIMED[0] * libm::powf(mistimed.min(1.0), MISTIMED[1]) + OFF * off.min(1.0)
        }
    };
    foul::call(game, events, id, rival, severity + behind);
}
