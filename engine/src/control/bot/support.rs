//! Attacking without the ball: find a place where a pass can come, stay onside, run behind now and then.

use crate::control::bot::{View, formation, send};
use crate::football::movement::{RUN_MPS, SPRINT_MPS};
use crate::football::noise;
use crate::state::{Match, PlayerId};
use glam::Vec2;
use setpiece_scenario::vocabulary::{Role, Rule, Stat};

/// Places tried around the block's place, own frame, metres.
const OFFSETS: [Vec2; 6] = [
    Vec2::ZERO,
    Vec2::new(0.0, 6.0),
    Vec2::new(0.0, -6.0),
    Vec2::new(6.0, 0.0),
    Vec2::new(-5.0, 3.0),
    Vec2::new(-5.0, -3.0),
];

/// Sends a mate of the ball to where he helps.
pub fn place(game: &mut Match, view: &View, id: PlayerId) {
    let player = *game.player(id);
    let mindset = player.body.mind.mindset;
    let own = player.pos * view.side;
    let offside = game.rule(Rule::Offside);
    if player.body.mind.run_until_step > game.step {
        // A run behind the defence, towards goal.
        let to = Vec2::new((own.x + 14.0).min(50.0), own.y * 0.9);
        send(game, view, id, to, SPRINT_MPS);
        return;
    }
    let mut base = formation::place(game, view, id);
    // Forwards stay high, up against the line; midfielders follow the attack.
    let push = 2.0 + view.bias * (3.0 + 11.0 * mindset);
    base.x += push;
    if mindset > 0.7 {
        base.x = base.x.max(view.line_x - 6.0);
    }
    if mindset >= 0.5 && view.ball.x > 18.0 {
        // The ball is near their goal: into the box.
        let box_spot = Vec2::new(43.0 + 3.0 * (mindset - 0.5), base.y * 0.45);
        base += (box_spot - base) * (0.35 + 0.4 * mindset);
    }
    let mut best = (f32::MIN, base);
    for offset in OFFSETS {
        let spot = base + offset;
        let worth = worth(game, view, id, spot) - 0.02 * offset.length();
        if worth > best.0 {
            best = (worth, spot);
        }
    }
    let mut to = best.1;
    if offside {
        to.x = to.x.min((view.line_x - 0.6).max(view.ball.x - 0.5));
    }
    let far = own.distance(to);
    let speed = if far > 14.0 && mindset > 0.2 { SPRINT_MPS } else { RUN_MPS };
    send(game, view, id, to, speed);
    let owner_near = view.owner.is_some_and(|owner| owner.team() == view.team && owner != id)
        && own.distance(view.ball) < 32.0
        && view.ball.x > -25.0;
    let onside = !offside || own.x < view.line_x - 0.2;
    if mindset >= 0.5 && owner_near && onside && own.x > view.line_x - 9.0 && player.role != Role::GK {
        let keen = (0.14 + 0.22 * mindset) * (0.3 + 0.8 * player.skill(Stat::OffensivePositioning));
        if noise::chooses(game, keen) {
            game.players[id.index()].body.mind.run_until_step = game.step + 14;
        }
    }
}

/// How good a place is: free of opponents, not crowded by mates, with a clear line to the ball.
fn worth(game: &Match, view: &View, id: PlayerId, spot: Vec2) -> f32 {
    let world = spot * view.side;
    let ball = view.ball * view.side;
    let mut worth = 0.0;
    let way = world - ball;
    let length = way.length().max(1.0);
    let along = way / length;
    for (_, rival) in game.team(view.team.other()) {
        let distance = rival.pos.distance_squared(world);
        if distance < 64.0 {
            worth -= (64.0 - distance) * 0.012;
        }
        let to = rival.pos - ball;
        let t = to.dot(along);
        if t > 1.0 && t < length {
            let off = (to - along * t).length_squared();
            if off < 9.0 {
                worth -= (9.0 - off) * 0.06;
            }
        }
    }
    for (mate, other) in game.team(view.team) {
        let distance = other.pos.distance_squared(world);
        if mate != id && distance < 110.0 {
            worth -= (110.0 - distance) * 0.008;
        }
    }
    if length > 28.0 {
        worth -= (length - 28.0) * 0.02;
    }
    worth + 0.01 * spot.x
}
