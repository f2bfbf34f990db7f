//! Restarts: what follows a stop of play. The ball and the players are placed; dead time costs no
//! step.

use crate::football::{forecast, lineup, reach, recent, set_piece, switching};
use crate::physics::Ball;
use crate::state::play::{Restart, SetPiece};
use crate::state::player::{Intent, NEVER, Pose};
use crate::state::{Match, PlayerId};
use glam::{Vec2, Vec3};
use setpiece_scenario::pitch::BALL_RADIUS_M;
use setpiece_scenario::vocabulary::{GameMode, PitchMeasure, Role, Rule, Team};

/// Places everyone for the pending restart, and ends the stop.
pub fn apply(game: &mut Match) {
    game.dead = false;
    if let Some(restart) = game.play.pending.take() {
        place(game, restart);
    }
}

/// Sets up a set piece.
///
/// If the awarded team has no players, the other team takes it. If no players exist at all, the
/// ball lies there.
pub fn place(game: &mut Match, restart: Restart) {
    calm(game);
    let empty = game.team(restart.team).next().is_none();
    let restart = if empty { Restart { team: restart.team.other(), ..restart } } else { restart };
    game.play.lead = restart.team;
    lay_ball(game, restart.spot);
    if restart.mode == GameMode::KickOff {
        kick_off(game, restart.team, restart.spot);
    } else if let Some(taker) = set_piece::arrange(game, restart) {
        game.play.set_piece = Some(SetPiece {
            mode: restart.mode,
            team: restart.team,
            taker,
            spot: restart.spot,
            waited_steps: 0,
        });
        game.mode = restart.mode;
        game.owner = Some(taker);
        game.possession = Some(restart.team);
        game.last_touch = Some(taker);
    } else {
        game.mode = GameMode::Normal;
        game.owner = None;
    }
    face_ball(game);
    forecast::renew(game);
    reach::assess(game);
    recent::begin(game);
    switching::reassign(game);
}

/// How often a crowd at the circle is resolved.
const CLEARING_PASSES: usize = 4;

/// Sends everyone to their kick-off place. Play is on at once; the mode shows that the kick-off
/// hasn't been taken.
///
/// If opponents keep out of the circle, a player of the team that kicks off is brought to the ball.
/// Otherwise everyone stays in place, and the first player there has the ball. (GRF's.)
fn kick_off(game: &mut Match, team: Team, spot: Vec2) {
    for (i, player) in game.players.iter_mut().enumerate() {
        let own = PlayerId(i as u8).team() == team;
        player.pos = player.body.kickoff[usize::from(!own)];
    }
    lineup::assign_slots(game);
    game.mode = GameMode::KickOff;
    game.owner = None;
    game.possession = Some(team);
    game.last_touch = None;
    game.play.kick_off = Some(team);
    game.play.kick_off_tick = game.tick;
    if !game.rule(Rule::KickoffCircle) {
        return;
    }
    clear_circle(game, team, spot);
    if let Some(kicker) = bring_kicker(game, team, spot) {
        // A player moved aside may end up in the circle again, and one moved out of it may end up
        // inside another player.
        for _ in 0..CLEARING_PASSES {
            if !set_piece::spread_out(game, kicker) {
                break;
            }
            clear_circle(game, team, spot);
        }
    }
}

/// Moves opponents of the team that kicks off out of the circle.
fn clear_circle(game: &mut Match, team: Team, spot: Vec2) {
    let (side, radius) = (team.other().side() as f32, game.measure(PitchMeasure::Circle));
    for (i, player) in game.players.iter_mut().enumerate() {
        if PlayerId(i as u8).team() != team && player.pos.distance(spot) < radius {
            let away = (player.pos - spot).normalize_or(Vec2::new(-side, 0.0));
            let away = if away.x * side > 0.0 { Vec2::new(-side, 0.0) } else { away };
            player.pos = spot + away * (radius + 0.3);
        }
    }
}

/// Brings a player of the team that kicks off to the ball, and returns that player.
fn bring_kicker(game: &mut Match, team: Team, spot: Vec2) -> Option<PlayerId> {
    let mut best: Option<(f32, PlayerId)> = None;
    for (id, player) in game.team(team) {
        let keeper = if player.role == Role::GK { 1.0e4 } else { 0.0 };
        let distance = player.pos.distance(spot) + keeper;
        if best.is_none_or(|(least, _)| distance < least) {
            best = Some((distance, id));
        }
    }
    let (distance, id) = best?;
    if distance > 2.5 {
        game.players[id.index()].pos = spot - Vec2::new(0.9 * team.side() as f32, 0.0);
    }
    Some(id)
}

/// Ends everything under way: flights, poses, intents.
fn calm(game: &mut Match) {
    game.play.pass = None;
    game.play.shot = None;
    game.play.hands = None;
    game.play.set_piece = None;
    game.play.kicked_by = None;
    game.play.offside = 0;
    game.play.kick_off = None;
    game.play.advantage = None;
    game.play.save = [None; 2];
    for player in &mut game.players {
        player.vel = Vec2::ZERO;
        player.body.pose = Pose::Up;
        player.body.pose_ticks = 0;
        player.body.lag_ticks = 0;
        player.body.kick = None;
        player.body.lunge = None;
        player.body.follows_until = NEVER;
        player.body.dribble = Vec2::ZERO;
        player.body.intent = Intent::Stand;
        player.body.touched_at = NEVER;
        player.body.ready_at = NEVER;
        player.body.mind.mark = None;
        player.body.mind.run_until_step = 0;
        player.body.mind.decide_at_step = game.step;
    }
}

/// Places the ball at rest.
fn lay_ball(game: &mut Match, spot: Vec2) {
    game.ball = Ball { pos: spot.extend(BALL_RADIUS_M as f32), vel: Vec3::ZERO, spin: Vec3::ZERO };
}

/// Turns everyone to the ball.
pub fn face_ball(game: &mut Match) {
    let ball = game.ball.pos.truncate();
    for player in &mut game.players {
        player.body.facing = (ball - player.pos).normalize_or(player.body.facing);
        player.heading_rad = crate::math::heading(player.body.facing);
    }
}
