//! Set pieces by the bot: what the taker plays, and when.

use crate::football::kick;
use crate::football::noise;
use crate::football::offside;
use crate::football::pace::SPRINT_MPS;
use crate::math;
use crate::state::play::SetPiece;
use crate::state::player::{Intent, KickKind, KickPlan};
use crate::state::{Match, PlayerId};
use glam::Vec2;
use setpiece_scenario::Ai;
use setpiece_scenario::pitch::PLAYERS_MAX;
use setpiece_scenario::vocabulary::{GameMode, Rule};

/// Steps that a team of lazy players waits; chosen, so that it ends before an agent would have to
/// kick.
const LAZY_WAIT_STEPS: u16 = 14;

/// Lets everyone stand; a bot that is the taker plans its kick.
pub fn think(game: &mut Match) {
    let Some(set_piece) = game.play.set_piece else { return };
    for i in 0..PLAYERS_MAX {
        if !game.is_driven(PlayerId(i as u8)) {
            game.players[i].body.intent = Intent::Stand;
        }
    }
    let taker = set_piece.taker;
    let driven = game.is_driven(taker);
    // A lazy taker acts only if they would otherwise hold up the game.
    let late = set_piece.waited_steps >= LAZY_WAIT_STEPS && game.rule(Rule::AntiStalling);
    let lazy = game.player(taker).ai == Ai::Lazy && !late;
    if driven || lazy {
        return;
    }
    if game.player(taker).body.kick.is_none() {
        let plan = choose(game, set_piece);
        game.players[taker.index()].body.kick = Some(plan);
    }
    // The run-up.
    let body = &mut game.players[taker.index()].body;
    body.dribble = Vec2::ZERO;
    body.intent = Intent::Ball(SPRINT_MPS);
}

/// Chooses what the taker plays.
fn choose(game: &mut Match, set_piece: SetPiece) -> KickPlan {
    let side = set_piece.team.side() as f32;
    let (own, goal) = (set_piece.spot * side, game.goal());
    let pitch = game.pitch;
    let post = |inside_m: f64| (pitch.goal_half_width() - inside_m) as f32;
    let luck = noise::bot_roll(game);
    let spread = noise::bot_roll(game) * 2.0 - 1.0;
    let [short, high, shot] = [KickKind::Short, KickKind::High, KickKind::Shot]
        .map(|kind| kick::taken(kind, set_piece.mode, game.tick));
    let near = |x: f32, y: f32| nearest(game, set_piece.taker, Vec2::new(x, y) * side);
    match set_piece.mode {
        GameMode::Penalty => KickPlan {
            point: Some(Vec2::new(goal.x, spread * post(0.5)) * side),
            power: 0.3 + 0.5 * luck,
            ..shot
        },
        GameMode::Corner if luck < 0.75 => {
            let point = Vec2::new(goal.x - 8.5, spread * 7.0);
            KickPlan { mate: near(point.x, point.y), point: Some(point * side), ..high }
        }
        GameMode::GoalKick if luck < 0.45 => KickPlan { mate: near(5.0, spread * 22.0), ..high },
        GameMode::GoalKick => {
            KickPlan { mate: near(20.0 - goal.x, math::sign_or(spread, 1.0) * 18.0), ..short }
        }
        GameMode::FreeKick if own.x > goal.x - 26.0 && own.y.abs() < 16.0 => KickPlan {
            point: Some(Vec2::new(goal.x, spread * post(0.4)) * side),
            power: 0.5,
            ..shot
        },
        GameMode::FreeKick if own.x > goal.x - 33.0 => {
            let point = Vec2::new(goal.x - 9.0, spread * 8.0);
            KickPlan { mate: near(point.x, point.y), point: Some(point * side), ..high }
        }
        GameMode::ThrowIn => {
            KickPlan { mate: nearest(game, set_piece.taker, set_piece.spot), ..short }
        }
        _ => KickPlan { mate: near(own.x + 10.0, own.y * 0.7), ..short },
    }
}

/// The teammate nearest to a world point, without the taker and players in an offside position.
fn nearest(game: &Match, taker: PlayerId, point: Vec2) -> Option<PlayerId> {
    let knows_offside = game.play.set_piece.is_some_and(|it| !offside::exempt(it.mode));
    let offside = if knows_offside { offside::positions(game, taker) } else { 0 };
    let mut best: Option<(f32, PlayerId)> = None;
    for (mate, other) in game.team(taker.team()) {
        let distance = other.pos.distance_squared(point);
        let may = mate != taker && offside & (1 << mate.0) == 0;
        if may && best.is_none_or(|(least, _)| distance < least) {
            best = Some((distance, mate));
        }
    }
    best.map(|(_, mate)| mate)
}
