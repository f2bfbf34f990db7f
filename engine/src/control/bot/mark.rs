//! Defending without the ball: the most dangerous opponents are marked, and the back line keeps its
//! line. (All figures are GRF's.)

use crate::control::bot::TeamView;
use crate::math::share;
use crate::state::{Match, PlayerId};
use glam::Vec2;
use setpiece_scenario::vocabulary::Role;

/// How many opponents are marked.
const MARKED: usize = 3;
/// From how far the opponent with the ball, and another one, could shoot, metres.
const CARRIER_SHOOTS_M: f32 = 24.0;
const OTHER_SHOOTS_M: f32 = 8.0;
/// How far ahead the positions of an opponent and of the marker are predicted, seconds.
const RIVAL_AHEAD_S: f32 = 0.5;
const OWN_AHEAD_S: f32 = 0.14;
/// A marker stands at least this far in front of an opponent, and this much nearer to where the
/// opponent shoots, metres.
const CLOSE_M: f32 = 0.4;
const NEARER_M: f32 = 4.0;
/// A late marker runs towards the goal by this share of their delay.
const LATE: f32 = 0.7;
/// Distance from the goal of the line behind which nobody falls back; a more daring team keeps it
/// further out, metres on the usual pitch.
const LINE_M: f32 = 30.0;
const LINE_DARING_M: f32 = 20.0;
/// The line's least distance from the goal, metres.
const LAST_LINE_M: f32 = 6.0;
/// The line keeps this far from an opponent on the ball, and doesn't wait for a teammate this far
/// behind it, metres.
const CAUTION_M: f32 = 4.0;
/// Half the depth of the zone in which places are moved onto the line, metres.
const LINE_ZONE_M: f32 = 2.0;

/// Assigns a marker to each of the most dangerous opponents, including the one with the ball.
pub fn assign(game: &mut Match, view: &TeamView) {
    game.each(game.squad.of(view.team), |player| player.body.mind.mark = None);
    let (carrier, goal) = (view.rival(game), game.goal());
    let aim = Vec2::new(2.0 - goal.x, 0.0) * 0.8 + view.ball * 0.2;
    let mut marked = 0u32;
    for _ in 0..MARKED {
        let danger = |id: PlayerId| {
            let far = (game.player(id).pos * view.side).distance(aim) / (2.0 * goal.x);
            0.95 * (1.0 - far.min(1.0)) + if carrier == Some(id) { 0.05 } else { 0.0 }
        };
        let open =
            game.team(view.team.other()).map(|(id, _)| id).filter(|id| marked & (1 << id.0) == 0);
        let Some(rival) = best(open, danger) else { return };
        marked |= 1 << rival.0;
        let free = game
            .team(view.team)
            .filter(|(_, player)| player.role != Role::GK && player.body.mind.mark.is_none());
        let worth = |id: PlayerId| worth(game, view, id, rival);
        let Some(marker) = best(free.map(|(id, _)| id), worth) else { return };
        game.players[marker.index()].body.mind.mark = Some(rival);
    }
}

/// The first of those with the highest value.
fn best(of: impl Iterator<Item = PlayerId>, worth: impl Fn(PlayerId) -> f32) -> Option<PlayerId> {
    let rated = of.map(|id| (worth(id), id));
    rated.max_by(|a, b| a.0.total_cmp(&b.0).then(b.1.cmp(&a.1))).map(|(_, id)| id)
}

/// How well a player would mark an opponent, 0..1: best if the opponent is in front of them, not
/// far to the side.
fn worth(game: &Match, view: &TeamView, id: PlayerId, rival: PlayerId) -> f32 {
    let soon = |id: PlayerId| {
        let player = game.player(id);
        (player.pos + player.vel * 0.1) * view.side
    };
    let (own, other) = (soon(id), soon(rival));
    let goal = game.goal();
    let to_goal = -goal - own;
    let reach = to_goal.length().clamp(4.0, 14.0);
    let way = to_goal.normalize_or(Vec2::NEG_X);
    let from = other - (own - way * 0.5);
    let before_m = -from.dot(way);
    let far_m = if before_m > 0.0 { (before_m - 2.0).abs() } else { -before_m };
    let beside = (from.perp_dot(way) / reach).abs().min(1.0);
    let mut worth = (1.0 - 0.5 * share(far_m, 0.0, 60.0).sqrt() - 0.5 * beside.sqrt()).max(0.0);
    if before_m <= 0.0 {
        worth *= 0.6;
    }
    worth * 0.8 + 0.2 * (1.0 - share(own.distance(other), 0.0, 2.0 * goal.x))
}

/// Where a player goes to mark their opponent, given the place, own frame, where they would be
/// otherwise.
pub fn post(game: &Match, view: &TeamView, id: PlayerId, place: Vec2) -> Vec2 {
    let player = game.player(id);
    let Some(rival) = player.body.mind.mark else { return place };
    let other = game.player(rival);
    let at = (other.pos + other.vel * RIVAL_AHEAD_S) * view.side;
    let from_m = if view.action == Some(rival) { CARRIER_SHOOTS_M } else { OTHER_SHOOTS_M };
    let goal = game.goal();
    let to_goal = -goal - at;
    let mut left_m = (to_goal.length() - from_m).clamp(CLOSE_M, goal.x);
    let mut shoots_at = at + to_goal.normalize_or_zero() * left_m;
    if shoots_at.x < view.trap_x && to_goal.x < -1e-3 {
        // The opponent is met no further back than at the line.
        shoots_at = at + to_goal * ((view.trap_x - at.x) / to_goal.x);
        left_m = shoots_at.distance(at);
    }
    let way = shoots_at - place;
    let lacks_m = way.length() - (left_m - NEARER_M);
    let mut post = place + way.clamp_length_max(lacks_m.max(0.0));
    let own = (player.pos + player.vel * OWN_AHEAD_S) * view.side;
    let late_m = own.distance(shoots_at) - left_m;
    if late_m > 0.0 {
        post += (-goal - post).normalize_or_zero() * (late_m * LATE);
    }
    post
}

/// The line, own frame x, metres, behind which nobody falls back, so that opponents are offside. It
/// retreats with the ball, the opponent on it and the teammates behind it.
pub fn trap_x(game: &Match, view: &TeamView) -> f32 {
    let (side, goal) = (view.side, game.goal());
    let along = |usual_m: f32| game.pitch.along(f64::from(usual_m)) as f32;
    let from_m = along(LINE_M + LINE_DARING_M * view.daring);
    let yields_m = along(20.0 + 10.0 * (1.0 - view.daring));
    let ball = -view.ball.x;
    let forced = share(ball, goal.x - from_m - yields_m, goal.x - LAST_LINE_M);
    let mut depth = (goal.x - from_m).max(ball + yields_m * (1.0 - forced));
    depth = depth.max(-game.play.forecast.at(game.tick + 70).x * side);
    if let Some(rival) = view.rival(game) {
        let other = game.player(rival);
        let at = |ahead_s: f32| CAUTION_M - (other.pos.x + other.vel.x * ahead_s) * side;
        if at(0.15) > depth {
            depth = at(0.1);
        }
    }
    let (mut last, mut second) = (f32::MIN, f32::MIN);
    for (_, mate) in game.team(view.team) {
        let x = -mate.pos.x * side;
        if x > last {
            (last, second) = (x, last);
        } else if x > second {
            second = x;
        }
    }
    -depth.max(second.max(ball).clamp(0.0, goal.x) - CAUTION_M)
}

/// Moves a place onto the line.
pub fn hold_line(view: &TeamView, place: Vec2) -> Vec2 {
    let zone = view.trap_x + LINE_ZONE_M;
    if place.x >= zone {
        return place;
    }
    let back = share(zone - place.x, 0.0, 2.0 * LINE_ZONE_M);
    Vec2::new(zone - LINE_ZONE_M * back, place.y)
}
