//! The keeper's feet: where they stand, and when they come out. (Their hands are in
//! `football::keeper`.)

use crate::control::bot::send::send;
use crate::control::bot::{TeamView, on_ball, press};
use crate::football::keeper::bound_for_goal;
use crate::football::pace::{RUN_MPS, SPRINT_MPS};
use crate::football::reach;
use crate::math::share;
use crate::state::player::{Intent, Pose};
use crate::state::{Match, Player, PlayerId};
use glam::Vec2;
use setpiece_scenario::PitchSize;

/// Beyond this own frame x, metres on the usual pitch, a keeper without teammates plays as the only
/// player; chosen.
const STRAYED_M: f64 = -15.0;
/// How far ahead a keeper predicts the ball, ticks. (GRF's.)
const LOOK_TICKS: u32 = 60;
/// How far ahead a keeper predicts opponents, seconds. (GRF's.)
const MEET_S: f32 = 0.32;
/// How far in front of the goal line a keeper waits, metres: with the ball in the other half, and
/// at least. (GRF's.)
const WAIT_M: f32 = 10.0;
const LINE_M: f32 = 0.7;
/// How far towards the ball a keeper waits whose team has it, a share of the distance. (GRF's.)
const UP_SHARE: f32 = 0.3;
/// From how far the opponent on the ball and a second one shoot, metres. (GRF's.)
const RIVAL_SHOOTS_M: f32 = 20.0;
const SECOND_SHOOTS_M: f32 = 24.0;
/// How far in front of the goal line a keeper meets a ball bound for goal, and above which height
/// they let it go by, metres. (GRF's.)
const BEFORE_LINE_M: f32 = 0.4;
const HIGH_M: f32 = 2.5;
/// The starting speed of a keeper who keeps facing the ball, m/s, and what they gain per step.
/// Measured.
const SIDLES_MPS: f32 = 3.5;
const GAINS_MPS: f32 = 0.5;

/// Decides for a keeper without the ball. False if they should go for it like anyone else.
pub fn stands(game: &mut Match, view: &TeamView, id: PlayerId) -> bool {
    let player = *game.player(id);
    if player.body.pose == Pose::Diving {
        return true;
    }
    let lone = game.team(view.team).count() == 1;
    if lone && player.pos.x * view.side > game.pitch.along(STRAYED_M) as f32 {
        return false;
    }
    let called = game.play.rush[view.team.index()] && !view.attacks(game);
    let first = game.play.chaser[view.team.index()] == Some(id);
    // A keeper who is at the ball before its dribbler plays it. (GRF's.)
    let steals = first
        && game
            .controller()
            .is_some_and(|rival| rival.team() != view.team && press::is_sooner(game, id, rival));
    if called || steals || comes_out(game, view, id, lone) {
        let body = &mut game.players[id.index()].body;
        body.intent = Intent::Ball(SPRINT_MPS);
        body.dribble = Vec2::ZERO;
        if first && view.rival(game).is_some_and(|rival| press::is_sooner(game, id, rival)) {
            on_ball::before_touch(game, view, id);
        }
        return true;
    }
    let (spot, speed) = post(game, view, id);
    send(game, view, id, spot, speed.min((player.vel.length() + GAINS_MPS).max(SIDLES_MPS)));
    true
}

/// Where a keeper waits, own frame, and how fast they go there. (GRF's.)
///
/// The keeper stands on the line that halves the goal as seen from the ball: just in front of the
/// goal line, or further up while the own team has the ball. They come all the way out to an
/// opponent that no teammate can stop any more, unless a second opponent waits for that.
fn post(game: &Match, view: &TeamView, id: PlayerId) -> (Vec2, f32) {
    let (keeper, goal) = (game.player(id).pos * view.side, game.goal());
    if let Some(spot) = in_the_way(game, view, id) {
        return (spot, SPRINT_MPS);
    }
    let ball = game.play.forecast.at(game.tick + LOOK_TICKS).truncate() * view.side;
    if ball.x > 0.0 {
        return (Vec2::new(WAIT_M - goal.x, 0.0), SPRINT_MPS);
    }
    let foot = Vec2::new(LINE_M - goal.x, middle_of_goal(&game.pitch, ball));
    let mut front = ball;
    let nearness = view.nearness_of(game, id);
    let mut share = UP_SHARE * share(nearness, 1.0, 1.5);
    let theirs = view.owner.filter(|owner| owner.team() != view.team);
    if let Some(rival) = view.rival(game).filter(|_| nearness < 1.0) {
        let other = game.player(rival);
        let place = (other.pos + other.vel * MEET_S) * view.side;
        front = if theirs.is_some() { ball * 0.6 + place * 0.4 } else { ball * 0.4 + place * 0.6 };
        let left_m = shooting_m(place, goal, RIVAL_SHOOTS_M);
        if nearest_mate_m(game, view, id, place, left_m) > left_m + 1.0 {
            share = 1.0 - second_danger(game, view, id, rival, left_m);
        }
    }
    if game.play.rush[view.team.index()] {
        share = 1.0;
    }
    let way = front - foot;
    let out = ((way.length() - 0.5).max(0.0) * share).max(LINE_M);
    let mut spot = foot + way.normalize_or_zero() * out;
    spot.x = spot.x.max(0.2 - goal.x);
    // A keeper who goes back on the line between ball and goal keeps facing the ball.
    let on_line = way.normalize_or_zero().perp_dot(keeper - foot).abs() < 1.0;
    let back = spot.distance(-goal) < keeper.distance(-goal);
    (spot, if back && on_line { RUN_MPS } else { SPRINT_MPS })
}

/// The nearest point on the path of a ball bound for goal, own frame; none for any other ball. The
/// keeper runs to the goal line if the ball will be too high for them there. (GRF's.)
fn in_the_way(game: &Match, view: &TeamView, id: PlayerId) -> Option<Vec2> {
    let y = bound_for_goal(game, id)?;
    let (player, goal) = (game.player(id), game.goal());
    let at = |ticks: u32| game.play.forecast.at(game.tick + ticks);
    let ball = at(1).truncate() * view.side;
    let line = Vec2::new(-goal.x, y);
    let end = line + (ball - line).normalize_or_zero() * BEFORE_LINE_M;
    let course = end - ball;
    let share = |place: Vec2| (place - ball).dot(course) / course.length_squared().max(1e-3);
    let own = share((player.pos + player.vel * 0.05) * view.side);
    let per_s = share(at(1 + 100).truncate() * view.side);
    if per_s > 1e-4 && at(1 + (100.0 * own / per_s).max(0.0) as u32).z > HIGH_M {
        return Some(end);
    }
    let spot = ball + course * own.clamp(0.0, 1.0);
    Some(Vec2::new(spot.x.max(0.2 - goal.x), spot.y))
}

/// The own frame y, metres, at which the bisector of the view of the goal from a place meets the
/// goal line.
fn middle_of_goal(pitch: &PitchSize, from: Vec2) -> f32 {
    let line = pitch.half_length() as f32;
    let post = |y: f32| (Vec2::new(-line, y) - from).normalize_or(Vec2::NEG_X);
    let half = pitch.goal_half_width() as f32;
    let way = post(half) + post(-half);
    let along = (LINE_M - line - from.x) / way.x.min(-0.01);
    (from.y + way.y * along).clamp(-half, half)
}

/// How far a place is from where a shot pays, metres; nearer to goal, a shot pays from further out.
fn shooting_m(place: Vec2, goal: Vec2, from_m: f32) -> f32 {
    let away = place.distance(-goal);
    (away - from_m * (away / (2.0 * from_m)).min(1.0)).max(0.0)
}

/// The distance of the nearest outfield teammate from the point at which an opponent could shoot,
/// metres.
fn nearest_mate_m(game: &Match, view: &TeamView, id: PlayerId, place: Vec2, left_m: f32) -> f32 {
    let point = place + (-game.goal() - place).normalize_or_zero() * left_m;
    let mates = game.team(view.team).filter(|(mate, _)| *mate != id);
    mates.fold(f32::MAX, |least, (_, mate)| {
        least.min(((mate.pos + mate.vel * 0.24) * view.side).distance(point))
    })
}

/// How much a second opponent near the goal keeps the keeper on the line, 0..0.7.
fn second_danger(game: &Match, view: &TeamView, id: PlayerId, rival: PlayerId, left_m: f32) -> f32 {
    let others = game.team(view.team.other()).filter(|(other, _)| *other != rival);
    let place_of = |other: &Player| (other.pos + other.vel * MEET_S) * view.side;
    let goal = game.goal();
    let near = others.map(|(_, other)| place_of(other)).reduce(|best, next| {
        if next.distance_squared(-goal) < best.distance_squared(-goal) { next } else { best }
    });
    let Some(place) = near else { return 0.0 };
    let second_m = shooting_m(place, goal, SECOND_SHOOTS_M);
    let open = (0.5 * (nearest_mate_m(game, view, id, place, second_m) - second_m)).clamp(0.0, 1.0);
    let nearer = 1.0 - ((second_m / (left_m + 1e-4) - 1.0) / 0.5).clamp(0.0, 1.0);
    open * nearer * 0.7
}

/// Whether a free ball is the keeper's: it was passed to them, or they are first at it, and it
/// isn't bound for goal. (GRF's.) A keeper without teammates has nobody else.
fn comes_out(game: &Match, view: &TeamView, id: PlayerId, lone: bool) -> bool {
    let passed = || game.play.pass.is_some_and(|pass| pass.to == Some(id));
    let first = || {
        if lone {
            game.player(id).body.meet_s <= TeamView::soonest(game, view.team.other())
        } else {
            reach::first(game) == Some(id)
        }
    };
    game.controller().is_none() && (passed() || first()) && bound_for_goal(game, id).is_none()
}
