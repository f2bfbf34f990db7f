//! Supporting the player on the ball: forces draw a player to their place and to the ball, and push
//! them away from opponents and teammates. (GRF's figures.)

use crate::control::bot::TeamView;
use crate::control::bot::formation::mindset;
use crate::football::pace::SPRINT_MPS;
use crate::math::{self, ease, share};
use crate::state::{Match, PlayerId};
use glam::Vec2;
use setpiece_scenario::vocabulary::{Role, Stat};

/// Positions are predicted this far ahead, seconds.
const AHEAD_S: f32 = 0.1;
/// Within this distance a point of attraction draws less, metres.
const DAMPED_M: f32 = 7.0;
/// Players stay this far short of the offside line, metres.
const ONSIDE_M: f32 = 0.08;
/// How many opponents and teammates push.
const RIVALS: usize = 3;
const MATES: usize = 6;
/// A team nearer to the ball than this spreads out and leaves the ball's path free.
const SPREADS: f32 = 1.02;
const MAKES_WAY: f32 = 1.06;
/// Steps that a run forward lasts, and steps between two attempts at one.
const RUN_STEPS: u32 = 40;
const RUN_EVERY: u32 = 5;
/// In which step first: in the one before, a start may have given an agent whoever will run.
const RUN_AT: u32 = 1;
/// How good a chance of a run must be, and how much less good for whoever reads the game; GRF's .5
/// for the average.
const RUNS_FROM: f32 = 0.65;
const READS: f32 = 0.2;
/// Steps between two choices of a supporter for the player on the ball.
const HELPER_EVERY: u32 = 15;

/// A squared distance larger by this factor is surely further, however roots are rounded.
const SURELY: f32 = 1.001;

/// Forces on a point: their sum and their total strength.
pub struct Forces {
    at: Vec2,
    sum: Vec2,
    strength: f32,
}

impl Forces {
    /// Starts without any force.
    pub fn at(at: Vec2) -> Forces {
        Forces { at, sum: Vec2::ZERO, strength: 0.0 }
    }

    /// The resulting force, no longer than 1.
    pub fn mean(&self) -> Vec2 {
        self.sum / self.strength.max(1e-3)
    }

    /// Adds an attracting point, equally strong everywhere, but weaker within `damped` metres.
    pub fn draw(&mut self, to: Vec2, power: f32, damped: f32) {
        let way = to - self.at;
        let length = way.length();
        self.sum += way.normalize_or_zero() * (power * (length / damped).min(1.0));
        self.strength += power;
    }

    /// Adds an attracting point, stronger nearby and without effect from `scale` metres on.
    fn draw_near(&mut self, to: Vec2, power: f32, scale: f32) {
        self.draw(to, power * (1.0 - to.distance(self.at) / scale).max(0.0), DAMPED_M);
    }

    /// Adds a repelling point, stronger nearby (to the power of EIGHTHS/8) and without effect from
    /// `scale` metres on.
    pub fn push<const EIGHTHS: u32>(&mut self, from: Vec2, power: f32, scale: f32) {
        let way = self.at - from;
        if way.length_squared() > SURELY * scale * scale {
            return;
        }
        let near = 1.0 - way.length() / scale;
        if near > 0.0 {
            let power = power * if EIGHTHS == 8 { near } else { math::eighths::<EIGHTHS>(near) };
            self.sum += way.normalize_or_zero() * power;
            self.strength += power;
        }
    }
}

/// Where a player supports, own frame, given their place in the block.
pub fn place(game: &Match, view: &TeamView, id: PlayerId, base: Vec2) -> Vec2 {
    let player = game.player(id);
    let role = game.player(player.body.mind.fills).role;
    let mind = mindset(role);
    let soon = |id: PlayerId| {
        let player = game.player(id);
        (player.pos + player.vel * AHEAD_S) * view.side
    };
    let at = soon(id);
    let ahead = game.play.chaser[view.team.index()].filter(|&chaser| chaser != id);
    let main = game.play.chaser[view.team.index()].map_or(at, soon);
    let runs = player.body.mind.run_until_step > game.step && may_run(role, view.nearness);
    let mut forces = Forces::at(at);

    let mut base = base;
    if game.play.recent.helper[view.team.index()] == Some(id) {
        base.x += 12.0 * (0.3 + 0.7 * mind);
    } else {
        // A player on the far wing goes forward.
        let lane_y = if main.y < 0.0 { 8.0 } else { -8.0 };
        let in_lane = ease(1.0 - share((lane_y - at.y).abs(), 0.0, 30.0));
        base.x += 22.0 * in_lane * mind * mind.sqrt();
    }
    forces.draw(base, 0.7 * (0.3 + 0.7 * share(base.distance(at), 0.0, 20.0)), DAMPED_M);
    if runs {
        forces.draw(Vec2::new(game.half().x, 0.5 * at.y), 2.0, DAMPED_M);
    }
    let caution = match role {
        Role::CB | Role::LB | Role::RB => 2.2,
        Role::DM => 2.0,
        Role::CM | Role::LM | Role::RM => 1.6,
        Role::AM => 1.2,
        _ => 1.0,
    };
    let (power, scale) = if runs { (0.15 * caution, 2.0) } else { (0.3 * caution, 5.0) };
    for rival in
        view.board.nearest::<RIVALS>(view.team.other(), (at * 0.7 + main * 0.3) * view.side, None)
    {
        // Repelled by a point behind the opponent, so that the ball's path is free.
        let place = soon(rival);
        forces.push::<6>(place + (place - main).normalize_or_zero() * 2.0, power, scale);
    }
    let nearness = game.play.recent.nearness[view.team.index()];
    if nearness >= SPREADS {
        for mate in view.board.nearest::<MATES>(view.team, at * view.side, None) {
            if mate != id {
                forces.push::<8>(soon(mate), 0.4, 10.5);
            }
        }
    }
    if ahead.is_some() {
        if nearness >= MAKES_WAY {
            for ball in view.ways {
                forces.push::<4>(ball, 1.0, 2.0);
            }
        }
        forces.draw_near(main, 0.45, 21.0);
        forces.push::<8>(main, 0.45, 12.0);
    }
    let mut to = at + forces.mean() * SPRINT_MPS;
    to.x = to.x.min(view.line_x - ONSIDE_M);
    to.clamp(-game.half(), game.half())
}

/// Whether a role runs forward at this nearness of its team to the ball.
fn may_run(role: Role, nearness: f32) -> bool {
    match role {
        Role::CF => share(nearness - 0.5, 0.1, 0.6) > 0.7,
        Role::AM | Role::LM | Role::CM | Role::RM | Role::DM => {
            share(nearness - 0.5, 0.1, 0.7) > 0.9
        }
        _ => false,
    }
}

/// Chooses who supports the player on the ball. In a team with at most one agent it also chooses
/// who runs forward.
pub fn assign(game: &mut Match, view: &TeamView) {
    let Some(main) = game.play.chaser[view.team.index()] else { return };
    let place = game.player(main).pos;
    if game.step.is_multiple_of(HELPER_EVERY) {
        let to = place + Vec2::new(1.5 * view.side, 0.0);
        game.play.recent.helper[view.team.index()] =
            view.board.nearest::<1>(view.team, to, Some(main)).pop();
    }
    let agents = game.agents.iter().filter(|slot| slot.team == view.team).count();
    if game.step % RUN_EVERY != RUN_AT || agents > 1 || !view.best {
        return;
    }
    if game.team(view.team).any(|(_, player)| player.body.mind.run_until_step > game.step) {
        return;
    }
    let to = place + Vec2::new(26.0 * view.side, 0.0);
    let runner = game
        .team(view.team)
        .filter(|(id, _)| *id != main && !game.is_driven(*id))
        .min_by(|(_, a), (_, b)| a.pos.distance_squared(to).total_cmp(&b.pos.distance_squared(to)));
    let Some((runner, player)) = runner else { return };
    let near = (1.0 - share(player.pos.distance(place), 0.0, 40.0)).sqrt();
    let spot = Vec2::new(player.pos.x - 10.0 * view.side, 0.8 * player.pos.y);
    let crowd = view
        .board
        .nearest::<4>(view.team.other(), spot, None)
        .into_iter()
        .map(|rival| ease(1.0 - share(game.player(rival).pos.distance(spot), 0.0, 15.0)).sqrt())
        .sum::<f32>();
    let reads = player.body.stats[Stat::OffensivePositioning.index()];
    if near * (1.0 - 0.3 * crowd) >= RUNS_FROM - READS * reads {
        game.players[runner.index()].body.mind.run_until_step = game.step + RUN_STEPS;
    }
}
