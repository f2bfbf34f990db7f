//! The touches of a dribble: motions in which one touch sends the ball the way that the player
//! wants.
//!
//! The body commits itself: until the end of the motion its velocity changes evenly from that of
//! the run to that of the motion's end. The touch comes on the way. (GRF's motions.)

use crate::football::carry::{self, Carry};
use crate::football::dribble::{self, LIES_MPS, STOPS_MPS};
use crate::football::foot::{self, STRIDE_TICKS};
use crate::football::leg::{self, MotionTouch, Reach};
use crate::football::pace::{DRIBBLES_FROM_MPS, SPRINTS_FROM_MPS, WALKS_FROM_MPS};
use crate::football::{awkward, kick, noise, possession, reach, touch, trap};
use crate::math;
use crate::state::play::ticks_since;
use crate::state::player::{Aim, Lunge};
use crate::state::{Match, Player, PlayerId, Squad};
use glam::{Vec2, Vec3};
use setpiece_scenario::Ai;

/// A touch of a dribble.
///
/// Measured of GRF's motions with the keys of random turns: 1,100 touches of a player alone.
pub(super) struct DribbleMotion {
    /// The lowest speed for this motion, m/s.
    from_mps: f32,
    /// Up to which angle between the run and the way that the player wants, degrees.
    to_degrees: f32,
    /// Ticks until the touch, and until the player is free again.
    ticks: i32,
    lasts: i32,
    /// Where it leads.
    out: MotionEnd,
    /// Where the ball is that it is made for, metres from the body: ahead, aside, and up.
    ball_m: [f32; 3],
    /// How fast the player is on average until the touch, and then, m/s: at least, and by share of
    /// the run.
    mean: [f32; 2],
    end: [f32; 2],
    /// Whether the other foot leads afterwards.
    changes_feet: bool,
}

/// How a player comes out of a motion.
#[derive(Clone, Copy)]
pub(super) enum MotionEnd {
    /// The way that they want, at this speed, m/s.
    Turned(f32),
    /// Along their old run, at this speed, m/s.
    Braked(f32),
    /// On, a bit closer to the pace that they want.
    On,
    /// On, by a small angle towards the way that they want.
    Bent,
}

pub(super) const fn motion(
    from_mps: f32,
    to_degrees: f32,
    [ticks, lasts]: [i32; 2],
    out: MotionEnd,
    ahead_m: f32,
    mean: [f32; 2],
    end: [f32; 2],
) -> DribbleMotion {
    DribbleMotion {
        from_mps,
        to_degrees,
        ticks,
        lasts,
        out,
        ball_m: [ahead_m, 0.0, leg::GRASS_M],
        mean,
        end,
        changes_feet: true,
    }
}

impl DribbleMotion {
    /// The same with an even number of steps.
    const fn even(mut self) -> DribbleMotion {
        self.changes_feet = false;
        self
    }

    /// The same at a ball beside the body and in the air.
    pub(super) const fn at(mut self, aside_m: f32, high_m: f32) -> DribbleMotion {
        (self.ball_m[1], self.ball_m[2]) = (aside_m, high_m);
        self
    }
}

/// Angles up to which a motion leads on, and turns by 45, 90, 135 and 180 degrees.
const ON_DEG: f32 = 32.0;
const HALF_DEG: f32 = 67.0;
const SQUARE_DEG: f32 = 112.0;
const BACK_DEG: f32 = 157.0;
const ABOUT_DEG: f32 = 180.0;

const SPRINTS: f32 = SPRINTS_FROM_MPS;
const WALKS: f32 = DRIBBLES_FROM_MPS;

/// The touches: fastest gait first, and those of a gait by their angles.
const TOUCHES: [DribbleMotion; 12] = [
    motion(SPRINTS, ON_DEG, [12, 25], MotionEnd::On, 0.48, [1.36, 0.9], [2.22, 0.7]),
    motion(SPRINTS, SQUARE_DEG, [14, 40], MotionEnd::Bent, 0.59, [2.41, 0.73], [4.01, 0.43]).even(),
    motion(SPRINTS, ABOUT_DEG, [22, 59], MotionEnd::Braked(0.8), 0.66, [1.85, 0.65], [4.8, 0.0]),
    motion(WALKS, ON_DEG, [12, 26], MotionEnd::On, 0.5, [1.22, 0.84], [2.04, 0.59]),
    motion(WALKS, HALF_DEG, [10, 41], MotionEnd::Turned(4.2), 0.47, [1.11, 0.81], [1.84, 0.52])
        .even(),
    motion(WALKS, SQUARE_DEG, [19, 53], MotionEnd::Turned(4.0), 0.42, [2.24, 0.46], [3.4, 0.0]),
    motion(WALKS, BACK_DEG, [20, 47], MotionEnd::Braked(0.6), 0.68, [2.56, 0.37], [3.1, 0.0])
        .even(),
    motion(WALKS, ABOUT_DEG, [12, 75], MotionEnd::Turned(2.2), 0.51, [1.64, 0.57], [2.12, 0.22])
        .even(),
    motion(0.0, ON_DEG, [8, 28], MotionEnd::Turned(2.6), 0.49, [1.6, 0.0], [2.0, 0.0]),
    motion(0.0, HALF_DEG, [7, 36], MotionEnd::Turned(3.3), 0.4, [0.3, 0.0], [0.5, 0.0]),
    motion(0.0, SQUARE_DEG, [8, 32], MotionEnd::Turned(3.1), 0.4, [0.3, 0.0], [0.5, 0.0]),
    motion(0.0, ABOUT_DEG, [13, 55], MotionEnd::Turned(2.5), 0.48, [-0.6, 0.0], [1.0, 0.0]),
];
/// The same for a player who wants to sprint: walking, on and by 45 degrees, and from a standstill.
const SPEEDING: [DribbleMotion; 3] = [
    motion(WALKS, ON_DEG, [15, 26], MotionEnd::On, 0.32, [1.33, 0.8], [2.13, 0.62]),
    motion(WALKS, HALF_DEG, [27, 50], MotionEnd::Turned(5.1), 0.29, [1.96, 0.63], [3.56, 0.23])
        .even(),
    motion(0.0, ON_DEG, [8, 28], MotionEnd::Turned(3.6), 0.49, [1.6, 0.0], [2.0, 0.0]),
];
/// The same for a player who wants to stand: sprinting, and walking. How long they last is fitted
/// to how soon players stop.
const STOPPING: [DribbleMotion; 2] = [
    motion(SPRINTS, ABOUT_DEG, [12, 45], MotionEnd::Braked(4.1), 0.52, [1.36, 0.9], [2.2, 0.6]),
    motion(WALKS, ABOUT_DEG, [12, 22], MotionEnd::Braked(0.0), 0.4, [1.47, 0.61], [1.87, 0.28])
        .even(),
];
/// Up to how long after their own touch players finish a stride, ticks, and by how much they may
/// want another velocity, m/s. (GRF's.)
const LATELY_TICKS: i32 = 60;
const ALIKE_MPS: f32 = 1.0;
/// For how many ticks a motion can be left for another one (GRF's), and up to which cosine of what
/// is wanted then.
const AGAIN_TICKS: i32 = 8;
const CHANGED: f32 = 0.9;
/// A ball less than this behind and beside the place that a motion is made for is waited for,
/// metres; chosen.
const WAITS_M: f32 = 0.4;
const ASIDE_M: f32 = 0.2;
/// How fast a ball rises that springs off the foot as high as it can, m/s. (GRF's.)
const SPRINGS_MPS: f32 = 4.0;
/// How much further off its place a low ball is that these motions still play, metres. (GRF's.)
const LOW_M: f32 = 0.15;
/// A ball that meets a player faster than this can't be taken along, m/s. (GRF's.)
const TAKES_MPS: f32 = 15.0;
/// What is left of the pace of a player who is to kick. (GRF's.)
pub const BRAKED: f32 = 0.9;
/// Between which ticks from now the ball's course is seen. A slower ball has none, m/s. (GRF's.)
const COURSE_TICKS: [u32; 2] = [12, 18];
const ROLLS_MPS: f32 = 2.0;
/// The sides to which a motion is made.
const SIDES: [f32; 2] = [1.0, -1.0];
/// Which share of the way to the ball a body is drawn. Forwards it comes at most `FORWARD_M` in a
/// tick, less the faster it goes on (`FORWARD_MPS`, `FORWARDS`), and loses `FORWARD_LOST_M`. An
/// opponent nearer than `PRESSED_M`, metres, leaves as little as `PRESSED` of it. (GRF's.)
const DRAWN: f32 = 0.6;
const FORWARD_M: f32 = 0.025;
const FORWARD_MPS: f32 = 6.0;
const FORWARDS: f32 = 0.6;
const FORWARD_LOST_M: f32 = 0.02;
const PRESSED_M: [f32; 2] = [0.6, 1.2];
const PRESSED: f32 = 0.7;
/// By how much a sprinter's touch strays, radians. Fitted to how far sprinters get off their line.
const STRAY_RAD: f32 = 0.006;
/// How far to one side a standing player begins a touch, metres, and by which angle every ball goes
/// to the other side, radians. It is invisible, but it matches GRF's rounding on the border between
/// two pixels of a map.
const OFF_ASIDE_M: f32 = 1.5e-6;
const ASIDE_RAD: f32 = -2.0e-6;
/// What a motion that leads on does to the pace. Fitted to GRF's motions.
///
/// - `NEARER`: the share of what a walker lacks.
/// - `SPEEDS_UP`: the end of one who walks and wants to sprint: base and share of their speed, and
///   at most, m/s.
/// - `SPRINTS_MPS`: of one who sprints, and `SLOWS_MPS`: of one who no longer wants to.
const NEARER: f32 = 0.75;
const SPEEDS_UP: [f32; 3] = [2.76, 0.66, 5.76];
const SPRINTS_MPS: f32 = 7.2;
const SLOWS_MPS: f32 = 4.6;
/// By how much a sprinter turns with one touch, radians, and how fast they come out of it, m/s.
const BEND_RAD: f32 = 0.39;
const BENT_MPS: f32 = 6.7;

/// Begins the motion of the player who plays the ball next. `near`: who may be in reach; `about`:
/// who may be when a free ball has come.
pub(super) fn begin(game: &mut Match, near: Squad, about: Squad) {
    let Some(id) = next(game, near, about) else { return };
    let kicks = game.player(id).body.kick.is_some();
    if kicks && !kick::looks(game, id) {
        // A kick comes first.
        return;
    }
    let along = wanted(game.player(id), asks(game, id)).filter(|motion| {
        (game.on_ball() == Some(id) || is_slow(game, id))
            && motion.fits(game, id, 0.0, reach(game, id))
    });
    let free = || game.on_ball().is_none();
    let Some(motion) = along.or_else(|| free().then(|| trap::find(game, id)).flatten()) else {
        return;
    };
    start(game, id, motion, Aim::Carry);
}

/// Begins the motion in which a player takes along a ball that a rival has, if it meets the ball.
pub(super) fn takes(game: &mut Match, id: PlayerId) -> bool {
    let motion = wanted(game.player(id), asks(game, id))
        .filter(|motion| motion.fits(game, id, 0.0, reach(game, id)));
    motion.is_some_and(|motion| start(game, id, motion, Aim::Carry))
}

/// Begins a motion.
pub(super) fn start(game: &mut Match, id: PlayerId, motion: &DribbleMotion, aim: Aim) -> bool {
    let player = game.player(id);
    let run = run(player);
    let wish = if aim == Aim::Carry { wish(asks(game, id), run, motion) } else { run };
    let (mps, brakes) = match motion.out {
        MotionEnd::Turned(mps) => (mps, false),
        MotionEnd::Braked(mps) => (mps, true),
        MotionEnd::On => (on_mps(player, wish.length()), false),
        MotionEnd::Bent => (BENT_MPS, false),
    };
    let now = game.tick as i32;
    let [steps_before, steps_after] = steps(game, id, motion);
    let lunge = Lunge {
        at: now + motion.ticks,
        out: motion.ticks as u8,
        back: (motion.lasts - motion.ticks) as u8,
        changes_feet: motion.changes_feet,
        aim,
        place: reach::expected(game, id, motion.ticks as u32),
        brakes,
        out_dmps: (mps * 10.0).round() as u8,
        at_dmps: matches!(motion.out, MotionEnd::On)
            .then(|| (motion.at_mps(player.vel.length()) * 10.0).round() as u8),
        wish,
        steps_before,
        steps_after,
    };
    let leads = left_leads(player, asks(game, id), motion, run, now);
    let stands = player.vel.length_squared() < DRIBBLES_FROM_MPS * DRIBBLES_FROM_MPS;
    let player = &mut game.players[id.index()];
    if stands {
        player.pos += run.perp() * OFF_ASIDE_M;
    }
    player.body.left_leads = leads != lunge.changes_feet;
    player.body.ready_at = lunge.until();
    player.body.lunge = Some(lunge);
    true
}

/// How far the body moves besides its run in each tick of a motion before the touch, and after it,
/// world metres. It leans to the ball and comes back, and is drawn to where the ball will be.
fn steps(game: &Match, id: PlayerId, motion: &DribbleMotion) -> [Vec2; 2] {
    let player = game.player(id);
    let (pace, run) = (player.vel.length(), run(player));
    let ticks = motion.ticks as f32;
    let leans_m = match motion.out {
        MotionEnd::On => {
            (motion.mean_mps(pace) - 0.5 * (pace + motion.at_mps(pace))) * ticks * 0.01
        }
        _ => 0.0,
    };
    let off = |side: f32| {
        let (touch, ball) = motion.touch(game, id, side);
        ball - touch.made_for
    };
    let [one, other] = SIDES.map(off);
    let off = if one.length_squared() <= other.length_squared() { one } else { other };
    let mut drawn = leg::drawn(off, DRAWN);
    let out = motion.touch(game, id, 0.0).0.out.x;
    if drawn.x > 0.0 {
        let most = FORWARD_M * (1.0 - math::pow((out / FORWARD_MPS).min(1.0), FORWARDS)) * ticks;
        drawn.x = (drawn.x - FORWARD_LOST_M).clamp(0.0, most);
    }
    let near_m = nearest_rival_m(game, id);
    drawn *= math::mix(PRESSED, 1.0, math::share(near_m, PRESSED_M[0], PRESSED_M[1]));
    let leans = run * leans_m;
    let drawn = run * drawn.x + run.perp() * drawn.y;
    [(leans + drawn) / ticks, -leans / (motion.lasts - motion.ticks) as f32]
}

/// How far away the nearest opponent is, metres.
fn nearest_rival_m(game: &Match, id: PlayerId) -> f32 {
    let from = game.player(id).pos;
    let rivals = game.team(id.team().other());
    rivals.fold(f32::MAX, |near, (_, rival)| near.min(rival.pos.distance_squared(from))).sqrt()
}

/// Whether the left foot leads in a motion: in a turn, that of its side.
fn left_leads(player: &Player, wish: Vec2, motion: &DribbleMotion, run: Vec2, now: i32) -> bool {
    let turns = motion.to_degrees > ON_DEG && wish.length_squared() > STOPS_MPS * STOPS_MPS;
    if turns { run.perp_dot(wish) < 0.0 } else { foot::left_leads(player, now) }
}

/// The velocity with which a player comes out of a motion.
pub(super) fn out(player: &Player, lunge: &Lunge) -> Vec2 {
    let way = if lunge.brakes { player.vel } else { lunge.wish };
    way.normalize_or(player.body.facing) * (f32::from(lunge.out_dmps) * 0.1)
}

/// The velocity that a motion is for: a sprinter's turn is cut into small ones.
fn wish(wish: Vec2, run: Vec2, motion: &DribbleMotion) -> Vec2 {
    if !matches!(motion.out, MotionEnd::Bent) {
        return wish;
    }
    let turn = math::unit(if run.perp_dot(wish) < 0.0 { -BEND_RAD } else { BEND_RAD });
    turn.rotate(run) * wish.length()
}

/// How fast a player comes out of a motion that leads on.
fn on_mps(player: &Player, wanted: f32) -> f32 {
    let pace = player.vel.length();
    let most = wanted.min(player.body.speed_top_mps);
    if pace >= SPRINTS_FROM_MPS {
        if wanted > SPRINTS_FROM_MPS { SPRINTS_MPS.min(most) } else { SLOWS_MPS }
    } else if wanted > SPRINTS_FROM_MPS {
        let [base, share, end] = SPEEDS_UP;
        (base + share * pace).min(end)
    } else {
        pace + (most - pace) * NEARER
    }
}

impl DribbleMotion {
    /// Whether the motion to one of both sides meets a ball that comes on a course. `course`: from
    /// the player's run to the ball's; `made_for`: the same of the motion, and how far the ball's
    /// may be off that; degrees.
    pub(super) fn meets(
        &self,
        game: &Match,
        id: PlayerId,
        course: f32,
        made_for: [f32; 2],
        reach: Reach,
    ) -> bool {
        SIDES.into_iter().any(|side| {
            let off = math::wrap((course - side * made_for[0]).to_radians()).to_degrees();
            off.abs() <= made_for[1] && self.fits(game, id, side, reach)
        })
    }

    /// Whether the motion to a side (1, -1, or 0 for neither) meets the ball.
    pub(super) fn fits(&self, game: &Match, id: PlayerId, side: f32, reach: Reach) -> bool {
        let ball_m = reach::expected(game, id, self.ticks as u32).z;
        if !leg::is_high_enough(ball_m, self.ball_m[2], LOW_M) {
            return false;
        }
        let (touch, ball) = self.touch(game, id, side);
        leg::meets(&touch, ball, reach, leg::freshness(game, id, self.ticks))
    }

    /// How fast the player is on average until the touch, m/s, for their pace now.
    fn mean_mps(&self, pace: f32) -> f32 {
        self.mean[0] + self.mean[1] * pace
    }

    /// How fast the player is at the touch, m/s, for their pace now.
    fn at_mps(&self, pace: f32) -> f32 {
        self.end[0] + self.end[1] * pace
    }

    /// The touch of this motion to a side, and where the ball will be then, in the run's frame.
    fn touch(&self, game: &Match, id: PlayerId, side: f32) -> (MotionTouch, Vec2) {
        let player = game.player(id);
        let (pace, run) = (player.vel.length(), run(player));
        let out_mps = match self.out {
            MotionEnd::Turned(mps) | MotionEnd::Braked(mps) => mps,
            MotionEnd::On => on_mps(player, asks(game, id).length()),
            MotionEnd::Bent => BENT_MPS,
        };
        let ball = reach::expected(game, id, self.ticks as u32).truncate();
        let way_m = self.mean_mps(pace) * self.ticks as f32 * 0.01;
        let place = ball - player.pos - run * way_m;
        let touch = MotionTouch {
            ticks: self.ticks,
            made_for: Vec2::new(self.ball_m[0], side * self.ball_m[1]),
            pace,
            at: Vec2::new(self.at_mps(pace), 0.0),
            out: Vec2::new(out_mps, 0.0),
            ends: Vec2::X,
        };
        (touch, Vec2::new(place.dot(run), run.perp_dot(place)))
    }
}

/// Who plays the ball next: its owner, or whoever is nearest to a ball that lies.
fn next(game: &Match, near: Squad, about: Squad) -> Option<PlayerId> {
    let now = game.tick as i32;
    let lies = || game.ball.vel.length_squared() < LIES_MPS * LIES_MPS;
    let id = match game.on_ball() {
        Some(owner) => owner,
        None if lies() => first(game, near)?,
        None => {
            let id = reach::first(game)?;
            let player = game.player(id);
            let free = player.is_up() && player.body.lunge.is_none() && !player.body.swings();
            return (free && about.has(id) && touch::wants_ball(game, id)).then_some(id);
        }
    };
    let player = game.player(id);
    let ready = now >= player.body.ready_at || game.last_touch.is_none();
    let free = match player.body.lunge {
        None => ready && !runs_on(game, id),
        Some(lunge) => begins_again(player, &lunge, now),
    };
    let plays = player.ai != Ai::Lazy || game.is_driven(id);
    (near.has(id) && player.is_up() && free && plays && !player.body.swings()).then_some(id)
}

/// Whether a ball comes slowly enough to take it along. (GRF's.)
pub(super) fn is_slow(game: &Match, id: PlayerId) -> bool {
    let (player, ball) = (game.player(id), game.ball.vel);
    ball.z.abs() < TAKES_MPS
        && (ball.truncate() - player.vel).length_squared() < TAKES_MPS * TAKES_MPS
}

/// Whether a player who runs as they want is within a stride, which they finish before they touch
/// their ball again. (GRF's.)
fn runs_on(game: &Match, id: PlayerId) -> bool {
    let player = game.player(id);
    let now = game.tick as i32;
    let lately = game.last_touch == Some(id)
        && ticks_since(game.tick, player.body.touched_at) < LATELY_TICKS;
    let alike = player.vel.distance_squared(player.body.dribble) < ALIKE_MPS * ALIKE_MPS;
    lately && alike && is_within_stride(player, now)
}

/// Whether a stride after a player's last touch has begun and isn't over.
pub(super) fn is_within_stride(player: &Player, now: i32) -> bool {
    (now - player.body.ready_at) % STRIDE_TICKS != 0
}

/// Whether a player who wants something else by now may begin the motion again. (GRF's.)
fn begins_again(player: &Player, lunge: &Lunge, now: i32) -> bool {
    if lunge.aim != Aim::Carry {
        return false;
    }
    // A sprinter's turn is cut into small ones: what they want by now is cut too.
    let asked = player.body.dribble;
    let new =
        wanted(player, asked).map_or(Vec2::ZERO, |motion| self::wish(asked, run(player), motion));
    let stands = |wish: Vec2| wish.length_squared() < STOPS_MPS * STOPS_MPS;
    let changed = stands(new) != stands(lunge.wish)
        || new.dot(lunge.wish) < CHANGED * new.length() * lunge.wish.length();
    now <= lunge.from() + AGAIN_TICKS && changed
}

/// Whether a kick may take the place of a motion: its touch is yet to come. (GRF's.)
pub(super) fn has_yet_to_touch(lunge: &Lunge, now: i32) -> bool {
    lunge.aim == Aim::Carry && now < lunge.at
}

/// The player nearest to a ball that lies, if they would play it.
fn first(game: &Match, near: Squad) -> Option<PlayerId> {
    let ball = game.ball.pos.truncate();
    let gap = |id: PlayerId| game.player(id).pos.distance_squared(ball);
    let nearest =
        game.order_of(near).reduce(|best, id| if gap(id) < gap(best) { id } else { best })?;
    let wish = game.player(nearest).body.dribble;
    (touch::contests(game, nearest) && wish.length_squared() >= STOPS_MPS * STOPS_MPS)
        .then_some(nearest)
}

/// How far a player reaches for a ball that they want to take along.
pub(super) fn reach(game: &Match, id: PlayerId) -> Reach {
    let kicks = game.player(id).body.kick.is_some_and(|plan| !plan.held);
    if kicks { leg::BEFORE_A_KICK } else { leg::DRIBBLE }
}

/// The angle from a player's run to the course on which they see the ball, degrees. None if the
/// ball is too slow.
pub(super) fn course(game: &Match, id: PlayerId) -> Option<f32> {
    let run = run(game.player(id));
    let [from, to] = COURSE_TICKS.map(|ticks| reach::expected(game, id, ticks).truncate());
    let course = to - from;
    (course.length() >= ROLLS_MPS * 0.01 * (COURSE_TICKS[1] - COURSE_TICKS[0]) as f32)
        .then(|| math::atan2(run.perp_dot(course), run.dot(course)).to_degrees())
}

/// The direction of a player's run, or where they face if they stand.
pub(super) fn run(player: &Player) -> Vec2 {
    if player.vel.length_squared() < DRIBBLES_FROM_MPS * DRIBBLES_FROM_MPS {
        player.body.facing
    } else {
        player.vel.normalize_or(player.body.facing)
    }
}

/// The velocity that a player wants with the ball. Whoever an agent wants to kick it keeps their
/// line and brakes, most if another direction is held. (GRF's.)
pub(super) fn asks(game: &Match, id: PlayerId) -> Vec2 {
    let player = game.player(id);
    let kicks = player.body.kick.is_some() && game.play.set_piece.is_none();
    if kicks && game.is_driven(id) && game.on_ball() != Some(id) {
        braked(player, player.body.dribble)
    } else {
        player.body.dribble
    }
}

/// The velocity of a player who is to kick, and holds a direction at a gait.
fn braked(player: &Player, held: Vec2) -> Vec2 {
    let ahead = player.vel.normalize_or(player.body.facing);
    ahead * (player.vel.length() * BRAKED * braking(ahead, held.try_normalize()))
}

/// The share of that by the direction that is held: all of it straight ahead, a fifth back.
pub fn braking(ahead: Vec2, held: Option<Vec2>) -> f32 {
    let along = held.map_or(1.0, |held| 0.5 + 0.5 * ahead.dot(held).clamp(-1.0, 1.0));
    0.2 + 0.8 * libm::powf(along, 1.5)
}

/// The motion that a player wants. None for one who stands and wants to.
fn wanted(player: &Player, wish: Vec2) -> Option<&'static DribbleMotion> {
    let pace = player.vel.length();
    if wish.length_squared() < STOPS_MPS * STOPS_MPS {
        return STOPPING.iter().find(|motion| pace >= motion.from_mps);
    }
    let cos = wish.normalize_or_zero().dot(run(player)).clamp(-1.0, 1.0);
    let degrees = libm::acosf(cos).to_degrees();
    let gait = TOUCHES.iter().map(|motion| motion.from_mps).find(|from| pace >= *from)?;
    let of_gait = |motion: &&DribbleMotion| motion.from_mps == gait && degrees <= motion.to_degrees;
    let speeds = wish.length_squared() > SPRINTS_FROM_MPS * SPRINTS_FROM_MPS;
    // Who already walks fast turns before they speed up.
    let speeding = || {
        SPEEDING
            .iter()
            .find(of_gait)
            .filter(|motion| speeds && (motion.to_degrees <= ON_DEG || pace < WALKS_FROM_MPS))
    };
    speeding().or_else(|| TOUCHES.iter().find(of_gait))
}

/// Whether a player who has the ball will turn with it: until then they stay behind it.
pub(super) fn turns(player: &Player) -> bool {
    wanted(player, player.body.dribble).is_some_and(|motion| motion.to_degrees > ON_DEG)
}

/// Whether the ball is ahead of a player, so that their motion will meet it.
pub(super) fn waits(game: &Match, id: PlayerId) -> bool {
    let Some(motion) = wanted(game.player(id), asks(game, id)) else { return false };
    let (touch, ball) = motion.touch(game, id, 0.0);
    ball.x > touch.made_for.x - WAITS_M && ball.y.abs() < ASIDE_M
}

/// The velocity that a motion's touch gives the ball: the way that its player wanted, m/s.
pub(super) fn touched(game: &mut Match, id: PlayerId, lunge: &Lunge) -> Vec3 {
    let to = out(game.player(id), lunge);
    sent(game, id, &Sending { wish: lunge.wish, to, rest: lunge.back })
}

/// How a player sends a ball on.
pub(super) struct Sending {
    /// The velocity that they want, world m/s.
    pub(super) wish: Vec2,
    /// The velocity with which they come out of their step, world m/s.
    pub(super) to: Vec2,
    /// Ticks until then.
    pub(super) rest: u8,
}

/// The velocity of a ball that a player sends on, m/s. One that isn't theirs yet may be awkward.
pub(super) fn sent(game: &mut Match, id: PlayerId, sending: &Sending) -> Vec3 {
    let player = *game.player(id);
    let to_ball = game.ball.pos.truncate() - player.pos;
    let owns = possession::has_ball(game, id);
    let Sending { wish, to, rest } = *sending;
    let carry = Carry { wish, to, rest, first: game.last_touch != Some(id) };
    let velocity = carry::touched(&player, to_ball, &carry, owns, dribble::minds_lines(game, id));
    let velocity = carry::as_skilled(game, id, velocity, carry.wish.length());
    let sprints = carry.wish.length_squared() > SPRINTS_FROM_MPS * SPRINTS_FROM_MPS;
    let stray = if sprints { noise::bell(game) * STRAY_RAD } else { ASIDE_RAD };
    let velocity = math::unit(stray).rotate(velocity);
    if owns {
        return velocity.extend(carry::hop_mps(velocity));
    }
    let before = game.ball.vel;
    let awkward = awkward::to(game, id);
    let velocity = carry::longer(velocity, awkward.far);
    let up = carry::hop_mps(velocity) + (before.z + SPRINGS_MPS) * awkward.high;
    velocity.extend(up).lerp(before, awkward.kept)
}
