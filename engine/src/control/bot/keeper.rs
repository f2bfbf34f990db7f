//! The keeper's feet: where he stands, when he comes out. (His hands are `football::keeper`'s.)

use crate::control::bot::{GOAL, View, send};
use crate::football::body::{Intent, Pose};
use crate::football::movement::{RUN_MPS, SPRINT_MPS};
use crate::football::touch;
use crate::state::{Match, PlayerId};
use glam::Vec2;

/// Further up than this, own frame x, metres, a keeper without mates plays as the only man he is; chosen.
const STRAYED_M: f32 = -15.0;
/// Further up than this, own frame x, metres, a keeper goes for a ball that is as good as his alone; chosen.
const FAR_OUT_M: f32 = -30.0;
/// Seconds by which it must be his there; chosen.
const FAR_LEAD_S: f32 = 3.0;

/// Decides for a keeper without the ball; false if he should go for it like anyone else.
pub fn stands(game: &mut Match, view: &View, id: PlayerId) -> bool {
    let player = *game.player(id);
    if player.body.pose == Pose::Diving {
        return true;
    }
    let lone = game.team(view.team).count() == 1;
    if lone && player.pos.x * view.side > STRAYED_M {
        return false;
    }
    let called = game.play.rush[view.team.index()] && !view.attacks(game);
    if called || comes_out(game, view, id) {
        let body = &mut game.players[id.index()].body;
        body.intent = Intent::Ball(SPRINT_MPS);
        body.dribble = Vec2::ZERO;
        return true;
    }
    let way = view.ball + GOAL;
    let distance = way.length().max(1.0);
    let rival_on_ball = view.owner.is_some_and(|owner| owner.team() != view.team);
    let alone = rival_on_ball && distance < 26.0 && alone_on_goal(game, view, distance);
    let out = if alone {
        (distance * 0.45).clamp(1.5, 9.0)
    } else if distance > 45.0 {
        (distance * 0.16).min(if view.bias > 0.6 { 14.0 } else { 10.0 })
    } else {
        (distance * 0.13).clamp(1.0, 5.0)
    };
    let mut spot = way * (out / distance) - GOAL;
    spot.y = spot.y.clamp(-6.0, 6.0);
    spot.x = spot.x.max(-54.3);
    let own = player.pos * view.side;
    let speed = if own.distance(spot) > 3.0 || alone { SPRINT_MPS } else { RUN_MPS };
    send(game, view, id, spot, speed);
    true
}

/// Whether a free ball is his: passed to him, or he is surely there before the others. How surely depends on where it
/// is: out of his box his hands are no help, and his goal is empty; who has no mates has only himself.
fn comes_out(game: &Match, view: &View, id: PlayerId) -> bool {
    if touch::controller(game).is_some() {
        return false;
    }
    if game.play.pass.is_some_and(|pass| pass.to == Some(id)) {
        return true;
    }
    let player = game.player(id);
    let meet = player.body.meet * view.side;
    let rivals = View::soonest(game, view.team.other());
    let mates =
        game.team(view.team).filter(|(mate, _)| *mate != id).fold(f32::MAX, |least, (_, p)| least.min(p.body.meet_s));
    let lone = game.team(view.team).count() == 1;
    let in_box = meet.x < -39.5 && meet.y.abs() < 19.5;
    let lead_s = match (lone, in_box, meet.x < FAR_OUT_M) {
        (true, ..) => -0.05,
        (_, true, _) => 0.25,
        (_, _, true) => 0.8,
        _ => FAR_LEAD_S,
    };
    let theirs_first = player.body.meet_s + lead_s >= rivals;
    !theirs_first && (player.body.meet_s < mates + 0.3 || in_box && view.ball.x < -44.0)
}

/// Whether no defender stands between the ball and the goal.
fn alone_on_goal(game: &Match, view: &View, distance: f32) -> bool {
    !game.team(view.team).any(|(_, mate)| {
        let own = mate.pos * view.side;
        mate.role != setpiece_scenario::vocabulary::Role::GK
            && own.distance(-GOAL) < distance
            && own.distance(view.ball) < 6.0
    })
}
