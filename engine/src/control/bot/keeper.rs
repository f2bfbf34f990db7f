//! The keeper's feet: where they stand, and when they come out. (Their hands are in
//! `football::keeper`.)

use crate::control::bot::send::send;
use crate::control::bot::{TeamView, on_ball, press};
use crate::football::pace::{RUN_MPS, SPRINT_MPS};
use crate::math::share;
use crate::state::player::{Intent, Pose};
use crate::state::{Match, Player, PlayerId};
use glam::Vec2;
use setpiece_scenario::PitchSize;
use setpiece_scenario::vocabulary::{PitchMeasure, Stat};

/// Beyond this own frame x, metres on the usual pitch, a keeper without teammates plays as the only
/// player; chosen.
const STRAYED_M: f64 = -15.0;
/// Beyond this own frame x, metres on the usual pitch, a keeper goes only for a ball that no
/// opponent can contest; chosen.
const FAR_OUT_M: f64 = -30.0;
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
/// Balls bound for goal. (GRF's.) The course is read over `COURSE_TICKS`. The other values: the
/// ticks within which the ball must cross the line, the distance from which it worries a keeper,
/// and how far in front of the line the keeper meets it, metres.
const COURSE_TICKS: u32 = 80;
const BOUND_TICKS: u32 = 400;
const BOUND_M: f32 = 32.0;
const BEFORE_LINE_M: f32 = 0.4;
/// The starting speed of a keeper who keeps facing the ball, m/s, and what they gain per step.
/// Measured.
const SIDLES_MPS: f32 = 3.5;
const GAINS_MPS: f32 = 0.5;
/// The lead that the keeper needs there, seconds; chosen.
const FAR_LEAD_S: f32 = 3.0;

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
    if called || steals || comes_out(game, view, id) {
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

/// The nearest point on the path of a ball bound for goal, own frame; none for any other ball. A
/// ball dribbled towards the goal counts too. (GRF's.)
fn in_the_way(game: &Match, view: &TeamView, id: PlayerId) -> Option<Vec2> {
    let (player, goal) = (game.player(id), game.goal());
    let at = |ticks: u32| game.play.forecast.at(game.tick + ticks).truncate() * view.side;
    let (ball, soon) = (at(1), at(COURSE_TICKS));
    let way = soon - ball;
    let rolls_in = at(BOUND_TICKS).x < -goal.x && way.x < 0.0;
    if !rolls_in || (player.pos * view.side).distance(at(25)) > BOUND_M {
        return None;
    }
    let y = ball.y + way.y * (-goal.x - ball.x) / way.x;
    let reads = 0.6 * player.skill(Stat::DefensivePositioning) + 0.4 * player.skill(Stat::Vision);
    if y.abs() > game.measure(PitchMeasure::GoalHalfWidth) * (1.02 + 0.5 * (1.0 - reads)) {
        return None;
    }
    let line = Vec2::new(-goal.x, y);
    let end = line + (ball - line).normalize_or_zero() * BEFORE_LINE_M;
    let course = end - ball;
    let own = (player.pos + player.vel * 0.05) * view.side - ball;
    let share = (own.dot(course) / course.length_squared().max(1e-3)).clamp(0.0, 1.0);
    let spot = ball + course * share;
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

/// Whether a free ball is the keeper's: it was passed to them, or they surely reach it before the
/// others. The required lead depends on where the ball is: out of the box hands don't help and the
/// goal is empty. A keeper without teammates has nobody else.
fn comes_out(game: &Match, view: &TeamView, id: PlayerId) -> bool {
    if game.controller().is_some() {
        return false;
    }
    if game.play.pass.is_some_and(|pass| pass.to == Some(id)) {
        return true;
    }
    let player = game.player(id);
    let meet = player.body.meet * view.side;
    let rivals = TeamView::soonest(game, view.team.other());
    let mates = game
        .team(view.team)
        .filter(|(mate, _)| *mate != id)
        .fold(f32::MAX, |least, (_, p)| least.min(p.body.meet_s));
    let lone = game.team(view.team).count() == 1;
    let (line, pitch) = (game.goal().x, &game.pitch);
    let edge = line - game.measure(PitchMeasure::BoxDepth) + 1.0;
    let aside = (pitch.measure(PitchMeasure::BoxHalfWidth) - 0.65) as f32;
    let in_box = meet.x < -edge && meet.y.abs() < aside;
    let far_out = meet.x < pitch.along(FAR_OUT_M) as f32;
    let lead_s = match (lone, in_box, far_out) {
        (true, ..) => -0.05,
        (_, true, _) => 0.25,
        (_, _, true) => 0.8,
        _ => FAR_LEAD_S,
    };
    let theirs_first = player.body.meet_s + lead_s >= rivals;
    !theirs_first && (player.body.meet_s < mates + 0.3 || in_box && view.ball.x < 11.0 - line)
}
