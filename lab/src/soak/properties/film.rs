//! Checks a step tick by tick: nothing passes through anything, nothing jumps.

use super::goal::GoalPlace;
use super::{Step, must};
use crate::pitch::LabError;
use glam::{Vec2, Vec3};
use setpiece::engine::control;
use setpiece::engine::environment::Scratch;
use setpiece::engine::football::{separation, tick};
use setpiece::engine::physics::constants::{BALL_RADIUS, FRAME_RADIUS, NET_HALF, TICK_S};
use setpiece::engine::state::event::Events;
use setpiece::engine::state::player::Pose;
use setpiece::engine::state::{Match, PlayerId};
use setpiece::engine::step;
use setpiece::scenario::pitch::PLAYERS_MAX;
use setpiece::scenario::vocabulary::{Action, PitchMeasure, Rule};

// These limits are the largest values measured over some million steps, plus a little.

/// How far contacts yield, metres: a ball that a foot holds against a post.
const GIVE_M: f32 = 0.03;
/// The most that a tick moves the ball in addition to its velocity: lifted for a kick, pushed by a
/// body, metres.
const LIFT_M: f32 = 0.05;
/// The fastest kick, m/s.
const KICK_MPS: f32 = 36.0;
/// The most that a player moves in a tick, metres.
const STRIDE_M: f32 = 0.24;
/// Least distance of a player's middle from a net or post, metres.
const NET_M: f32 = 0.2;

/// The memory from tick to tick: which players have been apart since they were placed, one bit
/// each.
#[derive(Debug, Default)]
pub(super) struct TickMemory {
    apart: [u32; PLAYERS_MAX],
}

impl TickMemory {
    /// Plays a step again and checks each of its ticks. The result must be the same.
    pub(super) fn watch(
        &mut self,
        before: &Match,
        step: &Step,
        scratch: &mut Scratch,
    ) -> Result<(), LabError> {
        let mut game = before.clone();
        step::hand_over(&mut game);
        let mut events = Events::new();
        // A player that an agent has switched away from is the bot's for this step, even if
        // scripted.
        let switched =
            game.agents.iter().zip(step.actions).filter(|(_, action)| **action == Action::Switch);
        let left: Vec<PlayerId> = switched.filter_map(|(slot, _)| slot.player).collect();
        for (i, (acting, done)) in
            game.play.acting.iter_mut().zip(&step.judged.play.acting).enumerate()
        {
            acting.chosen = done.played.filter(|_| !left.contains(&PlayerId(i as u8)));
        }
        control::command(&mut game, step.actions, &mut events);
        while game.tick < step.judged.tick {
            let was = game.clone();
            tick::advance(&mut game, &mut events, scratch);
            self.tick(&was, &game).map_err(|why| format!("tick {}: {why}", game.tick))?;
        }
        same(&game, step.judged)?;
        if step.judged.dead {
            *self = TickMemory::default();
        }
        Ok(())
    }

    pub(super) fn tick(&mut self, was: &Match, now: &Match) -> Result<(), LabError> {
        ball(was, now)?;
        let goal = GoalPlace::of(now);
        for i in (0..PLAYERS_MAX).filter(|&i| was.players[i].active && now.players[i].active) {
            player(&goal, i, was.players[i].pos, now.players[i].pos)?;
            for j in
                (i + 1..PLAYERS_MAX).filter(|&j| was.players[j].active && now.players[j].active)
            {
                self.pair(was, now, i, j)?;
            }
        }
        circle(now)
    }

    /// Two players on their feet don't run through each other: however far a crowd presses them
    /// together, they never swap sides.
    pub(super) fn pair(
        &mut self,
        was: &Match,
        now: &Match,
        i: usize,
        j: usize,
    ) -> Result<(), LabError> {
        let between = |game: &Match| game.players[j].pos - game.players[i].pos;
        let (from, to) = (between(was), between(now));
        let up = [i, j].iter().all(|&k| now.players[k].body.pose == Pose::Up);
        if !up {
            self.apart[i] &= !(1 << j);
        } else if self.apart[i] & (1 << j) != 0 {
            must(from.dot(to) > 0.0, || {
                format!("players {i} and {j} come through: {from} to {to}")
            })?;
        } else if to.length() >= separation::CONTACT_M {
            self.apart[i] |= 1 << j;
        }
        Ok(())
    }
}

/// Whether a step played again has the same result.
fn same(again: &Match, judged: &Match) -> Result<(), LabError> {
    must(again.ball == judged.ball && again.score == judged.score, || {
        "the ball went another way".to_owned()
    })?;
    for (i, (a, b)) in again.players.iter().zip(&judged.players).enumerate() {
        must((a.pos, a.vel, a.active) == (b.pos, b.vel, b.active), || {
            format!("player {i} went another way")
        })?;
    }
    Ok(())
}

/// A free ball flies. It may meet frame and nets from outside, and enters the goal only through its
/// mouth.
fn ball(was: &Match, now: &Match) -> Result<(), LabError> {
    let (from, to, goal) = (was.ball.pos, now.ball.pos, GoalPlace::of(now));
    let held = |game: &Match| game.play.hands.is_some() || game.play.set_piece.is_some();
    let scored = now.score != was.score;
    must(!scored || goal.is_entered(from, to, BALL_RADIUS + NET_HALF - GIVE_M), || {
        format!("a goal from {from} to {to}")
    })?;
    if held(was) || held(now) {
        return Ok(());
    }
    let way = from.distance(to);
    // A ball struck at a body right in front of it has a speed that neither end of the tick shows.
    let struck = now.players.iter().any(|player| player.body.touched_at >= was.tick as i32);
    let struck_mps = if struck { KICK_MPS } else { 0.0 };
    let most = was.ball.vel.length().max(now.ball.vel.length()).max(struck_mps) * TICK_S + LIFT_M;
    must(way <= most, || format!("the ball has jumped {way} m: {from} to {to}"))?;
    if goal.is_far(to.x, to.y) {
        return Ok(());
    }
    let (from, to) = (at_right(from, to), at_right(to, to));
    let reach = BALL_RADIUS + FRAME_RADIUS - GIVE_M;
    for [foot, head] in goal.frame() {
        let near = between(from, to, foot, head);
        must(near >= reach, || {
            format!("the ball comes through the frame, {near} m off: {from} to {to}")
        })?;
    }
    let near = goal.net_distance(to);
    must(near >= BALL_RADIUS + NET_HALF - GIVE_M, || format!("the ball is in a net: {to}"))?;
    must(scored || !goal.contains(to), || {
        format!("the ball is in the goal at {to} and nobody has scored")
    })
}

/// Mirrors a point to the right goal, if `end` is at the left one.
fn at_right(point: Vec3, end: Vec3) -> Vec3 {
    if end.x < 0.0 { Vec3::new(-point.x, -point.y, point.z) } else { point }
}

/// The least distance between two segments.
fn between(a: Vec3, b: Vec3, c: Vec3, d: Vec3) -> f32 {
    let (along, post, gap) = (b - a, d - c, a - c);
    let (aa, pp, ap) = (along.dot(along), post.dot(post), along.dot(post));
    let (ag, pg) = (along.dot(gap), post.dot(gap));
    let area = aa * pp - ap * ap;
    let on_way = if area > 1e-9 { ((ap * pg - pp * ag) / area).clamp(0.0, 1.0) } else { 0.0 };
    let on_post = ((ap * on_way + pg) / pp).clamp(0.0, 1.0);
    let on_way = if aa > 1e-9 { ((ap * on_post - ag) / aa).clamp(0.0, 1.0) } else { 0.0 };
    (a + along * on_way).distance(c + post * on_post)
}

/// A player runs; they never jump, and never pass through nets.
fn player(goal: &GoalPlace, i: usize, from: Vec2, to: Vec2) -> Result<(), LabError> {
    let way = from.distance(to);
    must(way <= STRIDE_M, || format!("player {i} has jumped {way} m: {from} to {to}"))?;
    if goal.is_far(to.x, to.y) {
        return Ok(());
    }
    let level = |point: Vec2| at_right(point.extend(0.0), to.extend(0.0));
    let (from, to) = (level(from), level(to));
    for [near, far] in goal.walls() {
        let away = between(from, to, near, far);
        must(away >= NET_M, || {
            format!("player {i} runs into a net, {away} m off: {from} to {to}")
        })?;
    }
    Ok(())
}

/// Opponents keep out of the centre circle until a kick-off has been taken.
fn circle(now: &Match) -> Result<(), LabError> {
    let Some(team) = now.play.kick_off.filter(|_| now.rule(Rule::KickoffCircle)) else {
        return Ok(());
    };
    let radius = now.measure(PitchMeasure::Circle);
    for (i, player) in now.players.iter().enumerate() {
        let keeps = !player.active || PlayerId(i as u8).team() == team;
        let away = player.pos.length();
        must(keeps || away > radius - 0.001, || format!("player {i} is in the circle: {away} m"))?;
    }
    Ok(())
}
