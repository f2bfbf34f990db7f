//! Defending without the ball: the most dangerous opponents are marked, the rest keep the block.

use crate::control::bot::{GOAL, View, formation, send};
use crate::football::movement::{RUN_MPS, SPRINT_MPS};
use crate::state::{Match, PlayerId};
use glam::Vec2;
use setpiece_scenario::vocabulary::{Role, Rule};

/// How far behind the ball the back line stands, metres.
const FALL_BACK_M: f32 = 28.0;
/// No further up than this stands the back line, own frame x, metres.
const LINE_MAX_M: f32 = 2.0;
/// How many opponents are marked.
const MARKED: usize = 5;

/// Gives the most dangerous opponents a marker each, the one with the ball too.
pub fn assign(game: &mut Match, view: &View) {
    for i in 0..game.players.len() {
        if PlayerId(i as u8).team() == view.team {
            game.players[i].body.mind.mark = None;
        }
    }
    let carrier = view.carrier(game);
    // (GRF's.)
    let aim = Vec2::new(-53.0, 0.0) * 0.8 + view.ball * 0.2;
    let mut taken = 0u32;
    for _ in 0..MARKED {
        let mut worst: Option<(f32, PlayerId, Vec2)> = None;
        for (rival, other) in game.team(view.team.other()) {
            let pos = other.pos * view.side;
            let carries = carrier == Some(rival);
            let danger = (1.0 - pos.distance(aim) / 110.0) * 0.95 + if carries { 0.05 } else { 0.0 };
            let open = taken & (1 << rival.0) == 0 && other.role != Role::GK;
            if open && (pos.x < 15.0 || carries) && worst.is_none_or(|(most, _, _)| danger > most) {
                worst = Some((danger, rival, pos));
            }
        }
        let Some((_, rival, pos)) = worst else { return };
        taken |= 1 << rival.0;
        let post = goal_side(pos);
        let mut best: Option<(f32, PlayerId)> = None;
        for (id, player) in game.team(view.team) {
            // Whom an agent plays marks nobody for sure.
            let driven = game.play.driven & (1 << id.0) != 0;
            let chases = carrier.is_none() && game.play.chaser[view.team.index()] == Some(id);
            let busy = driven || chases || player.body.mind.mark.is_some();
            if player.role == Role::GK || busy || player.body.mind.mindset > 0.7 {
                continue;
            }
            let own = player.pos * view.side;
            let distance = own.distance(post) + 6.0 * player.body.mind.mindset + if own.x > pos.x { 4.0 } else { 0.0 };
            if best.is_none_or(|(least, _)| distance < least) {
                best = Some((distance, id));
            }
        }
        if let Some((distance, id)) = best
            && distance < 22.0
        {
            game.players[id.index()].body.mind.mark = Some(rival);
        }
    }
}

/// Where a marker stands: between his man and the goal, nearer to him the nearer the goal.
fn goal_side(pos: Vec2) -> Vec2 {
    let goal = Vec2::new(-54.0, 0.0);
    let way = goal - pos;
    let length = way.length().max(1.0);
    pos + way * ((length * 0.1).clamp(1.2, 4.5) / length)
}

/// Sends a defender to his man, or to his place.
pub fn place(game: &mut Match, view: &View, id: PlayerId) {
    let player = *game.player(id);
    let own = player.pos * view.side;
    let mut to = formation::place(game, view, id);
    let mut speed: f32 = RUN_MPS;
    if let Some(rival) = player.body.mind.mark {
        let other = game.player(rival);
        let man = other.pos * view.side;
        let post = goal_side(man + other.vel * view.side * 0.4);
        // The nearer to the own goal, the tighter.
        let weight = (0.95 - (man.x + GOAL.x) / (2.0 * GOAL.x) * 0.6).clamp(0.2, 0.9);
        // Where nobody is offside, nobody is left behind the line.
        let loose = own.x > post.x + 1.0 && !game.rule(Rule::Offside);
        to += (post - to) * if loose { weight.max(0.85) } else { weight };
        speed = if own.x > post.x + 1.0 { SPRINT_MPS } else { 6.5 };
    }
    // The back line keeps behind the ball, the midfield not far before it.
    let mindset = player.body.mind.mindset;
    if mindset < 0.3 {
        // The back line stands together, and who runs past it is offside.
        let line = (view.ball.x - FALL_BACK_M).clamp(-47.0, LINE_MAX_M);
        let free = player.body.mind.mark.is_none();
        to.x = to.x.min(view.ball.x - FALL_BACK_M).max(-47.0);
        if free {
            to.x = to.x.clamp(line - 2.0, line + 2.0);
        }
    } else if mindset < 0.7 {
        to.x = to.x.min(view.ball.x - 6.0).max(-43.0);
    }
    // Whoever is caught up the pitch runs back.
    let behind = own.x - to.x;
    if behind > 8.0 || (behind > 3.0 && own.x > view.ball.x) {
        speed = SPRINT_MPS;
    }
    send(game, view, id, to, speed);
}
