//! The keeper's feet: where he stands, when he comes out. (His hands are `football::keeper`'s.)

use crate::control::bot::{View, send};
use crate::football::body::{Intent, Pose};
use crate::football::movement::{RUN_MPS, SPRINT_MPS};
use crate::football::touch;
use crate::state::{Match, PlayerId};
use glam::Vec2;

/// Further up than this, own frame x, metres, a keeper is no keeper: he plays as the man who is nearest to the ball.
const STRAYED_M: f32 = -15.0;

/// Decides for a keeper without the ball; false if he should go for it like anyone else.
pub fn stands(game: &mut Match, view: &View, id: PlayerId) -> bool {
    let player = *game.player(id);
    if player.body.pose == Pose::Diving {
        return true;
    }
    if player.pos.x * view.side > STRAYED_M && game.play.chaser[view.team.index()] == Some(id) {
        return false;
    }
    let rivals = game.play.chaser[view.team.other().index()].map_or(9.0, |rival| game.player(rival).body.meet_s);
    let lone = game.team(view.team).count() == 1;
    if lone && touch::controller(game).is_none() && player.body.meet_s < rivals + 0.05 {
        return false;
    }
    let goal = Vec2::new(-55.0, 0.0);
    let meet = player.body.meet * view.side;
    let mates =
        game.team(view.team).filter(|(mate, _)| *mate != id).fold(9.0f32, |least, (_, p)| least.min(p.body.meet_s));
    let in_box = meet.x < -39.5 && meet.y.abs() < 19.5;
    let loose = touch::controller(game).is_none();
    let first = player.body.meet_s + 0.25 < rivals && (in_box || player.body.meet_s + 0.8 < rivals && meet.x < -30.0);
    let receives = game.play.pass.is_some_and(|pass| pass.to == Some(id));
    if loose && (receives || first && (player.body.meet_s < mates + 0.3 || in_box && view.ball.x < -44.0)) {
        let body = &mut game.players[id.index()].body;
        body.intent = Intent::Ball(SPRINT_MPS);
        body.dribble = Vec2::ZERO;
        return true;
    }
    let way = view.ball - goal;
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
    let mut spot = goal + way * (out / distance);
    spot.y = spot.y.clamp(-6.0, 6.0);
    spot.x = spot.x.max(-54.3);
    let own = player.pos * view.side;
    let speed = if own.distance(spot) > 3.0 || alone { SPRINT_MPS } else { RUN_MPS };
    send(game, view, id, spot, speed);
    true
}

/// Whether no defender stands between the ball and the goal.
fn alone_on_goal(game: &Match, view: &View, distance: f32) -> bool {
    let goal = Vec2::new(-55.0, 0.0);
    !game.team(view.team).any(|(_, mate)| {
        let own = mate.pos * view.side;
        mate.role != setpiece_scenario::vocabulary::Role::GK
            && own.distance(goal) < distance
            && own.distance(view.ball) < 6.0
    })
}
