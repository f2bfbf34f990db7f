//! What a moment of a match looks like: the one place that turns the engine's state into a
//! [`Scene`].
//!
//! A state alone gives most of a scene ([`of_match`]). A [`SceneWriter`] follows an episode and
//! adds what a state doesn't say: what happened in the last steps, and what the rewards paid.
//! Scenes are filled in place: after the first one nothing is allocated.

use crate::engine::environment::Environment;
use crate::engine::state::event::Event;
use crate::engine::state::player::Pose;
use crate::engine::state::{Match, Player, PlayerId};
use crate::scenario::pitch::{GOAL_DEPTH_M, STEPS_PER_S};
use crate::scenario::vocabulary::{EventKind, GameMode, PitchMeasure, Role};
use crate::scenario::{PitchSize, Team};
use setpiece_render::Scene;
use setpiece_render::scene::{
    self, Id, Mode, News, NewsKind, Pitch, Posture, SceneBall, ScenePlayer, Side, Term,
};

/// For how many steps what happened is news.
const NEWS_STEPS: u32 = 30;
/// Ticks of a leg before and after it meets the ball, as a figure shows them.
const SWING_TICKS: i32 = 22;
const FOLLOW_TICKS: i32 = 20;
/// Ticks of a slide, a dive and a stumble, as the game has them or about so.
const SLIDE_TICKS: f32 = 60.0;
const DIVE_TICKS: f32 = 45.0;
const STUMBLE_TICKS: f32 = 40.0;
/// Who is this near to a ball between these heights jumps for it, metres.
const JUMPS_M: f32 = 1.0;
const JUMPS_FROM_M: f32 = 1.7;
const JUMPS_TO_M: f32 = 3.0;
/// What a standing head reaches, and the highest jump, metres.
const STANDS_M: f32 = 1.75;
const JUMP_MAX_M: f32 = 0.6;

/// Follows an episode and writes its scenes.
#[derive(Clone, Debug, Default)]
pub struct SceneWriter {
    /// What happened lately, with the step in which it did.
    news: Vec<(u32, News)>,
}

impl SceneWriter {
    /// Starts over: call it after each reset.
    pub fn begin(&mut self) {
        self.news.clear();
    }

    /// Keeps what happened in the environment's last step: call it after each step.
    pub fn note(&mut self, environment: &Environment) {
        let step = environment.steps();
        self.news.retain(|(at, _)| step.saturating_sub(*at) <= NEWS_STEPS);
        self.news.extend(environment.events().iter().filter_map(|event| {
            let kind = news_kind(event.kind)?;
            Some((
                step,
                News { kind, team: side_of(event)?, number: number_of(event), age_steps: 0 },
            ))
        }));
    }

    /// Writes the environment's state into a scene.
    pub fn write(&self, environment: &Environment, scene: &mut Scene) {
        self.write_state(environment, environment.state(), scene);
    }

    /// Writes the state that the last step was judged on: where play was stopped, before the
    /// restart.
    pub fn write_judged(&self, environment: &Environment, scene: &mut Scene) {
        self.write_state(environment, environment.judged_state(), scene);
    }

    fn write_state(&self, environment: &Environment, game: &Match, scene: &mut Scene) {
        fill(game, scene);
        for &(step, news) in &self.news {
            let age_steps = environment.steps().saturating_sub(step);
            scene.news.push(News { age_steps, ..news });
        }
        write_terms(environment, &mut scene.rewards);
    }
}

/// Writes what a state alone says: no news and no rewards.
pub fn of_match(game: &Match, scene: &mut Scene) {
    fill(game, scene);
    scene.rewards.clear();
}

/// Writes a state, and leaves the memory of the rewards as it is.
fn fill(game: &Match, scene: &mut Scene) {
    scene.step = game.step;
    scene.between = 0.0;
    scene.pitch = pitch_of(&game.pitch);
    scene.ball = SceneBall {
        pos: game.ball.pos.to_array(),
        vel: game.ball.vel.to_array(),
        spin: game.ball.spin.to_array(),
        owner: game.owner.map(id),
    };
    scene.players.clear();
    for player in game.squad.ids() {
        scene.players.push(player_of(game, player));
    }
    scene.score = game.score;
    scene.clock_s = (f64::from(game.elapsed_at_start + game.step) / STEPS_PER_S) as f32;
    scene.mode = mode(game.mode);
    let waiting = (game.mode != GameMode::Normal).then_some(game.play.set_piece).flatten();
    scene.mode_team = waiting.map(|set_piece| side(set_piece.team));
    scene.possession = game.possession.map(side);
    scene.news.clear();
    scene.placed = false;
}

/// Writes what an agent sees: its own team plays in the left team's kit and attacks towards +x, and
/// only its own player is ringed.
pub fn seen_by(game: &Match, agent: usize, scene: &mut Scene) {
    of_match(game, scene);
    let Some(slot) = game.agents.get(agent) else { return };
    for player in &mut scene.players {
        player.agent = slot.player.map(id) == Some(player.id);
    }
    if slot.team == Team::Right {
        turn(scene);
    }
}

/// Turns a scene by half a circle and swaps the teams.
fn turn(scene: &mut Scene) {
    let other = |side: Side| if side == Side::Left { Side::Right } else { Side::Left };
    let turned = |[x, y]: [f32; 2]| [-x, -y];
    let raised = |[x, y, z]: [f32; 3]| [-x, -y, z];
    let ball = &mut scene.ball;
    (ball.pos, ball.vel, ball.spin) = (raised(ball.pos), raised(ball.vel), raised(ball.spin));
    if let Some(owner) = &mut ball.owner {
        owner.team = other(owner.team);
    }
    for player in &mut scene.players {
        player.id.team = other(player.id.team);
        player.pos = turned(player.pos);
        player.vel = turned(player.vel);
        player.facing = turned(player.facing);
    }
    scene.score.swap(0, 1);
    scene.mode_team = scene.mode_team.map(other);
    scene.possession = scene.possession.map(other);
}

/// The measures of a pitch.
pub(crate) fn pitch_of(pitch: &PitchSize) -> Pitch {
    use PitchMeasure as Measure;
    let one = |measure| pitch.measure(measure) as f32;
    Pitch {
        length_m: 2.0 * one(Measure::HalfLength),
        width_m: 2.0 * one(Measure::HalfWidth),
        goal_width_m: 2.0 * one(Measure::GoalHalfWidth),
        goal_height_m: one(Measure::GoalHeight),
        goal_depth_m: GOAL_DEPTH_M as f32,
        box_depth_m: one(Measure::BoxDepth),
        box_width_m: 2.0 * one(Measure::BoxHalfWidth),
        six_yard_depth_m: one(Measure::SixYardDepth),
        six_yard_width_m: 2.0 * one(Measure::SixYardHalfWidth),
        spot_m: one(Measure::PenaltySpot),
        circle_m: one(Measure::Circle),
    }
}

/// A player's identity in a scene.
pub fn id(player: PlayerId) -> Id {
    Id { team: side(player.team()), slot: player.in_team() as u8 }
}

/// The player of an identity.
pub fn player_id(id: Id) -> PlayerId {
    PlayerId::new(team(id.team), usize::from(id.slot))
}

/// A team by the goal that it defends.
pub fn side(team: Team) -> Side {
    match team {
        Team::Left => Side::Left,
        Team::Right => Side::Right,
    }
}

/// The team that defends a goal.
pub fn team(side: Side) -> Team {
    match side {
        Side::Left => Team::Left,
        Side::Right => Team::Right,
    }
}

/// The number on a player's shirt: 1 for the first of the team's list.
pub fn number(player: PlayerId) -> u8 {
    player.in_team() as u8 + 1
}

fn player_of(game: &Match, player: PlayerId) -> ScenePlayer {
    let body = game.player(player);
    let (posture, progress) = posture(game, player, body);
    let rises = if posture == Posture::Jumping {
        (game.ball.pos.z - STANDS_M).clamp(0.0, JUMP_MAX_M)
    } else {
        0.0
    };
    ScenePlayer {
        id: id(player),
        number: number(player),
        role: role(body.role),
        pos: body.pos.to_array(),
        height_m: rises,
        vel: body.vel.to_array(),
        facing: body.body.facing.to_array(),
        posture,
        progress,
        tired: body.fatigue,
        yellow_cards: body.yellow_cards,
        present: body.active,
        agent: game.agents.iter().any(|agent| agent.player == Some(player)),
    }
}

/// What a body does, and how far it has come with it.
fn posture(game: &Match, id: PlayerId, player: &Player) -> (Posture, f32) {
    let left = f32::from(player.body.pose_ticks);
    let come = |ticks: f32| (1.0 - left / ticks).clamp(0.0, 1.0);
    match player.body.pose {
        Pose::Stumbling { .. } => (Posture::Stumbling, come(STUMBLE_TICKS)),
        Pose::Sliding => (Posture::Sliding, come(SLIDE_TICKS)),
        Pose::Diving => (Posture::Diving, come(DIVE_TICKS)),
        Pose::Down => (Posture::Fallen, 1.0),
        Pose::Up => leg(game, player).unwrap_or_else(|| jump(game, id, player)),
    }
}

/// A leg on its way to the ball, or following through after a kick.
fn leg(game: &Match, player: &Player) -> Option<(Posture, f32)> {
    let (now, body) = (game.tick as i32, &player.body);
    let after = body.follows_until - now;
    if (1..=FOLLOW_TICKS).contains(&after) {
        let share = 1.0 - after as f32 / FOLLOW_TICKS as f32;
        return Some((Posture::Kicking, 0.5 + 0.5 * share));
    }
    let swing = body.kick.and_then(|plan| plan.swing).map(|swing| swing.ready_at - now);
    let lunge = body.lunge.map(|lunge| lunge.at - now);
    let before = swing.or(lunge).filter(|before| (0..=SWING_TICKS).contains(before))?;
    Some((Posture::Kicking, 0.5 - 0.5 * before as f32 / SWING_TICKS as f32))
}

/// Whoever is under a high ball jumps for it.
fn jump(game: &Match, id: PlayerId, player: &Player) -> (Posture, f32) {
    let ball = game.ball.pos;
    let is_near = player.pos.distance_squared(ball.truncate()) < JUMPS_M * JUMPS_M;
    let is_high = (JUMPS_FROM_M..JUMPS_TO_M).contains(&ball.z);
    if is_near && is_high && game.play.hands.is_none_or(|(keeper, _)| keeper != id) {
        (Posture::Jumping, 0.5)
    } else {
        (Posture::Upright, 0.0)
    }
}

/// Writes what each term paid to the first agent. Names are written once.
fn write_terms(environment: &Environment, terms: &mut Vec<Term>) {
    let (names, paid) = (environment.term_names(), environment.terms(0));
    terms.truncate(names.len());
    for (at, (name, &value)) in names.iter().zip(paid).enumerate() {
        match terms.get_mut(at) {
            Some(term) => {
                if term.name != *name {
                    term.name.clone_from(name);
                }
                term.value = value as f32;
            }
            None => terms.push(Term { name: name.clone(), value: value as f32 }),
        }
    }
}

fn news_kind(kind: EventKind) -> Option<NewsKind> {
    match kind {
        EventKind::Goal => Some(NewsKind::Goal),
        EventKind::Foul | EventKind::Handball => Some(NewsKind::Foul),
        EventKind::Offside => Some(NewsKind::Offside),
        EventKind::YellowCard => Some(NewsKind::YellowCard),
        EventKind::RedCard => Some(NewsKind::RedCard),
        _ => None,
    }
}

/// The team that scored, else that of the player who is meant.
fn side_of(event: &Event) -> Option<Side> {
    event.team.or_else(|| event.by.map(PlayerId::team)).map(side)
}

fn number_of(event: &Event) -> Option<u8> {
    event.by.map(number)
}

fn mode(mode: GameMode) -> Mode {
    match mode {
        GameMode::Normal => Mode::Normal,
        GameMode::KickOff => Mode::KickOff,
        GameMode::GoalKick => Mode::GoalKick,
        GameMode::FreeKick => Mode::FreeKick,
        GameMode::Corner => Mode::Corner,
        GameMode::ThrowIn => Mode::ThrowIn,
        GameMode::Penalty => Mode::Penalty,
    }
}

fn role(role: Role) -> scene::Role {
    match role {
        Role::GK => scene::Role::GK,
        Role::CB => scene::Role::CB,
        Role::LB => scene::Role::LB,
        Role::RB => scene::Role::RB,
        Role::DM => scene::Role::DM,
        Role::CM => scene::Role::CM,
        Role::LM => scene::Role::LM,
        Role::RM => scene::Role::RM,
        Role::AM => scene::Role::AM,
        Role::CF => scene::Role::CF,
    }
}
