//! Playing without the ball: a place in the block, shifted to where the player supports and towards
//! the opponent that they mark. (GRF's figures.)

use crate::control::bot::formation::{Outlook, mindset};
use crate::control::bot::send::send;
use crate::control::bot::{TeamView, mark, support};
use crate::football::pace::SPRINT_MPS;
use crate::math::{self, ease, share};
use crate::state::player::Intent;
use crate::state::{Match, PlayerId};
use setpiece_scenario::vocabulary::{Role, Stat};

/// Speed (m/s) per metre of distance to a place.
const HASTE: f32 = 2.6;
/// The speeds at which players run, each with the wanted speed from which it is taken, m/s.
const PACES: [(f32, f32); 3] = [(1.8, 0.0), (4.2, 3.5), (6.0, 5.0)];

/// How a role plays without the ball.
struct Manner {
    /// How firmly it keeps to its own slot far from the ball, 0..1.
    own_slot: f32,
    /// Between these values of its team's nearness to the ball, it comes to support.
    helps: (f32, f32),
    /// It marks down to this nearness.
    marks: f32,
    /// Whether it keeps to the line.
    holds_line: bool,
}

fn manner(role: Role) -> Manner {
    match role {
        Role::CB | Role::LB | Role::RB => {
            Manner { own_slot: 1.0, helps: (0.2, 0.9), marks: 1.9, holds_line: true }
        }
        Role::CF => Manner { own_slot: 0.8, helps: (0.1, 0.6), marks: 1.3, holds_line: false },
        _ => Manner { own_slot: 0.9, helps: (0.1, 0.7), marks: 1.5, holds_line: true },
    }
}

/// Sends a player to where they play without the ball.
pub fn place(game: &mut Match, view: &TeamView, id: PlayerId) {
    let player = game.player(id);
    let own = player.pos * view.side;
    let manner = manner(player.role);
    let fills = player.body.mind.fills;
    let far = share(own.distance(view.action_at(game)), 15.0, 20.0);
    let outlook = Outlook::of(game, view, id);
    let mut to = outlook.place(game, view, id);
    if fills != id {
        let firm = ease(manner.own_slot * far);
        if firm < 1.0 {
            to += (outlook.place(game, view, fills) - to) * (1.0 - firm);
        }
    }
    let nearness = view.nearness_of(game, id);
    let helps = share(nearness - 0.5, manner.helps.0, manner.helps.1);
    if helps > 0.0 {
        to += (support::place(game, view, id, to) - to) * helps;
    }
    let mind = mindset(game.player(fills).role);
    let marks = math::eighths::<6>((manner.marks - mind - nearness).clamp(0.0, 1.0));
    if marks > 0.0 {
        to += (mark::post(game, view, id, to) - to) * marks;
    }
    if manner.holds_line {
        to = mark::hold_line(view, to);
    }
    let pace = pace(lazily(game, view, id, own.distance(to) * HASTE));
    send(game, view, id, to, pace);
    // Close to the action nobody slows down before they arrive.
    if far < 1.0 {
        let way = (to - own).normalize_or_zero() * view.side;
        game.players[id.index()].body.intent = Intent::Run(way * pace);
    }
}

/// The running speed for a wanted speed.
pub fn pace(wanted_mps: f32) -> f32 {
    PACES.into_iter().find(|(below, _)| wanted_mps < *below).map_or(SPRINT_MPS, |(_, pace)| pace)
}

/// The speed of a player far from the action, m/s: slower the less it concerns them, and when
/// tired.
fn lazily(game: &Match, view: &TeamView, id: PlayerId, wanted_mps: f32) -> f32 {
    let player = game.player(id);
    let fresh = 1.0 - player.fatigue;
    let (near_m, far_m) = (20.0 * (0.8 * fresh + 0.2), 65.0 * (0.5 * fresh + 0.5));
    let rival = view.team.other();
    let Some(other) = game.play.chaser[rival.index()] else { return wanted_mps };
    let far = share(player.pos.distance(game.player(other).pos), near_m, far_m);
    let mind = mindset(game.player(player.body.mind.fills).role);
    let ours = (view.nearness_of(game, id) - 0.5).clamp(0.0, 1.0);
    let lazy = far * (0.5 + 0.5 * (mind + ours * (1.0 - 2.0 * mind)));
    let wants = if wanted_mps > SPRINT_MPS {
        SPRINT_MPS + 0.1 * (wanted_mps - SPRINT_MPS)
    } else {
        wanted_mps
    };
    let mut runs = wants * (1.0 - lazy);
    if wanted_mps >= 3.5 {
        runs = runs.max(3.5);
    }
    let rested = 1.0 - share(player.body.mean_mps, 0.0, SPRINT_MPS);
    let works = player.body.stats[Stat::Workrate.index()];
    let breath = math::mix(math::eighths::<6>(rested), math::eighths::<5>(rested), works) * 1.2;
    runs.min(SPRINT_MPS * (breath.min(1.0) * lazy + 1.0 - lazy))
}
