//! Set pieces: who takes one and where everybody stands.

use crate::football::{lineup, offside};
use crate::state::play::{Restart, SetPiece};
use crate::state::{Match, Player, PlayerId};
use glam::Vec2;
use setpiece_scenario::Ai;
use setpiece_scenario::pitch::PLAYERS_MAX;
use setpiece_scenario::vocabulary::{GameMode, PitchMeasure, Role, Rule, Team};

/// How far opponents keep from a throw-in, metres. Laws.
const THROW_IN_M: f32 = 2.0;
/// A wall is built for free kicks nearer to goal than this, metres (GRF's).
pub const WALL_WITHIN_M: f32 = 40.0;
/// Least distance between two players at a set piece, metres: about a body's breadth.
const APART_M: f32 = 0.74;
/// Attackers wait this far behind the offside line at a free kick, metres; chosen: they may still
/// be moved apart.
const ONSIDE_M: f32 = 1.0;
/// How often a crowd is resolved until no two players overlap.
const SPREAD_PASSES: usize = 8;
/// How high the ball is held before a throw-in, metres; chosen.
const OVERHEAD_M: f32 = 1.9;
/// Distance between players of a wall, as a share of the distance to the ball. (GRF's.)
const WALL_SPACING: f32 = 0.07;

/// The taker of a set piece: the teammate nearest to the ball once everybody is in place. (GRF's.)
/// A lazy player that no agent can control takes it only if nobody else is there.
fn nearest(
    game: &Match,
    team: Team,
    spot: Vec2,
    unfit: impl Fn(&Player) -> bool,
) -> Option<PlayerId> {
    let mut best: Option<(f32, PlayerId)> = None;
    for (id, player) in game.team(team) {
        let led = game.agents.iter().any(|slot| {
            slot.player == Some(id) || slot.team == team && !slot.fixed && player.controllable
        });
        let unwilling = if player.ai == Ai::Lazy && !led { 1.0e5 } else { 0.0 };
        let misplaced = if unfit(player) { 1.0e4 } else { 0.0 };
        let distance = player.pos.distance(spot) + misplaced + unwilling;
        if best.is_none_or(|(least, _)| distance < least) {
            best = Some((distance, id));
        }
    }
    best.map(|(_, id)| id)
}

/// Appoints the taker of the pending set piece if the scenario has placed everybody else. It is the
/// nearest player: the keeper for goal kicks, an outfielder otherwise.
pub fn appoint(game: &mut Match) {
    let Some(SetPiece { mode, team, spot, .. }) = game.play.set_piece else { return };
    let unfit = |player: &Player| (player.role == Role::GK) != (mode == GameMode::GoalKick);
    let Some(taker) = nearest(game, team, spot, unfit) else { return };
    if let Some(set_piece) = &mut game.play.set_piece {
        set_piece.taker = taker;
    }
    game.owner = Some(taker);
    game.last_touch = Some(taker);
    let side = team.side() as f32;
    let player = &mut game.players[taker.index()];
    (player.pos, player.vel) = (side * lineup::taker(mode, side * spot), Vec2::ZERO);
}

/// Places everyone for a set piece other than a kick-off, and returns the taker.
pub fn arrange(game: &mut Match, restart: Restart) -> Option<PlayerId> {
    line_up(game, restart);
    keep_distance(game, restart);
    build_wall(game, restart);
    if restart.mode == GameMode::FreeKick && game.rule(Rule::Offside) {
        keep_onside(game, restart.team);
    }
    let taker = nearest(game, restart.team, restart.spot, |_| false)?;
    let side = restart.team.side() as f32;
    game.players[taker.index()].pos = side * lineup::taker(restart.mode, side * restart.spot);
    if restart.mode == GameMode::ThrowIn {
        game.ball.pos.z = OVERHEAD_M;
    }
    spread_out(game, taker);
    Some(taker)
}

/// Sends everyone to the place of their number.
fn line_up(game: &mut Match, restart: Restart) {
    let sizes = [Team::Left, Team::Right].map(|team| game.team(team).count());
    let pitch = game.pitch;
    for i in 0..PLAYERS_MAX {
        let id = PlayerId(i as u8);
        let side = id.team().side() as f32;
        let player = &mut game.players[i];
        if player.active {
            let own = id.team() == restart.team;
            player.pos = side
                * match player.role {
                    Role::GK => lineup::keeper(&pitch),
                    _ => lineup::place(
                        &pitch,
                        restart.mode,
                        own,
                        side * restart.spot,
                        lineup::slot(id.in_team(), sizes[id.team().index()]),
                    ),
                };
        }
    }
}

/// Moves the kicking team's players out of offside positions.
fn keep_onside(game: &mut Match, team: Team) {
    let side = team.side() as f32;
    let line = offside::line(game, team) - ONSIDE_M;
    game.each(game.squad.of(team), |player| {
        if player.pos.x * side > line {
            player.pos.x = line * side;
        }
    });
}

/// Moves apart players who would overlap. The taker and keepers stay. Returns whether anybody was
/// moved.
pub fn spread_out(game: &mut Match, taker: PlayerId) -> bool {
    let rim = game.rim();
    for pass in 0..SPREAD_PASSES {
        let mut moved = false;
        for a in game.order() {
            for b in game.order() {
                let (first, second) = (game.player(a), game.player(b));
                let between = second.pos - first.pos;
                let near = between.length_squared() < APART_M * APART_M;
                let stays = b == taker || second.role == Role::GK;
                if !near || a == b || stays || !first.active || !second.active {
                    continue;
                }
                let distance = between.length();
                let away = if distance > 1e-3 {
                    between / distance
                } else {
                    Vec2::new(0.0, a.team().side() as f32)
                };
                game.players[b.index()].pos = beside(first.pos, away * (APART_M + 0.01), rim);
                moved = true;
            }
        }
        if !moved {
            return pass > 0;
        }
    }
    true
}

/// The place at this distance from another; on the other side of it if that place is beyond the
/// rim.
fn beside(of: Vec2, away: Vec2, rim: Vec2) -> Vec2 {
    let outside = (of + away).abs().cmpgt(rim);
    (of + Vec2::select(outside, -away, away)).clamp(-rim, rim)
}

/// Builds a wall of the three defenders nearest to the ball, as close to a free kick near their
/// goal as allowed.
fn build_wall(game: &mut Match, restart: Restart) {
    let goal = game.goal() * restart.team.side() as f32;
    // Laws.
    let wall_m = game.measure(PitchMeasure::Circle);
    let way = goal - restart.spot;
    let distance = way.length();
    if restart.mode != GameMode::FreeKick || !(wall_m + 1.5..WALL_WITHIN_M).contains(&distance) {
        return;
    }
    let ahead = way / distance;
    let aside = Vec2::new(-ahead.y, ahead.x);
    let mut taken = 0u32;
    for place in [-1.0, 0.0, 1.0] {
        let mut best: Option<(f32, PlayerId)> = None;
        for (id, player) in game.team(restart.team.other()) {
            let away = player.pos.distance_squared(restart.spot);
            let free = player.role != Role::GK && taken & (1 << id.0) == 0;
            if free && best.is_none_or(|(least, _)| away < least) {
                best = Some((away, id));
            }
        }
        let Some((_, id)) = best else { return };
        taken |= 1 << id.0;
        let way = (ahead + aside * (place * WALL_SPACING)).normalize_or(ahead);
        game.players[id.index()].pos = restart.spot + way * wall_m;
    }
}

/// Keeps opponents at the legal distance.
fn keep_distance(game: &mut Match, restart: Restart) {
    let circle = game.measure(PitchMeasure::Circle);
    let least = if restart.mode == GameMode::ThrowIn { THROW_IN_M } else { circle };
    let inward = (-restart.spot).normalize_or(Vec2::new(-(restart.team.side() as f32), 0.0));
    let (x, y) = game.half().into();
    for (i, player) in game.players.iter_mut().enumerate() {
        let own = PlayerId(i as u8).team() == restart.team;
        let away = player.pos - restart.spot;
        if own
            || !player.active
            || player.role == Role::GK
            || away.length_squared() >= least * least
        {
            continue;
        }
        player.pos = restart.spot + away.normalize_or(inward) * least;
        if player.pos.x.abs() > x || player.pos.y.abs() > y {
            player.pos = restart.spot + inward * least;
        }
    }
}
