//! Starts built by hand.

use glam::{Vec2, Vec3};
use setpiece_engine::physics::Conditions;
use setpiece_engine::start::{Drawn, DrawnAgent, DrawnPlayer};
use setpiece_engine::state::PlayerId;
use setpiece_scenario::PitchSize;
use setpiece_scenario::vocabulary::{Role, Rule, StartKind, Team};
use setpiece_scenario::{Ai, Others};

#[derive(Clone, Copy, Debug)]
pub(crate) enum Layout {
    Eleven,
    EmptyGoalClose,
    EmptyGoal,
    RunToScore,
    RunToScoreKeeper,
    ThreeVersusOne,
    Alone,
    AloneWithBall,
}

use Role::{CB, CF, CM, GK, LB, LM, RB, RM};

const KICK: [(f32, f32, Role); 11] = [
    (-1.0, 0.0, GK),
    (0.0, 0.02, RM),
    (0.0, -0.02, CF),
    (-0.422, -0.19576, LB),
    (-0.5, -0.06356, CB),
    (-0.5, 0.063559, CB),
    (-0.422, 0.19576, RB),
    (-0.184212, -0.10568, CM),
    (-0.267574, 0.0, CM),
    (-0.184212, 0.10568, CM),
    (-0.01, -0.2161, LM),
];

fn recv() -> [(f32, f32, Role); 11] {
    let mut all = KICK;
    all[1] = (-0.05, 0.0, RM);
    all[2] = (-0.01, 0.216102, CF);
    all
}

pub(crate) fn drawn(layout: Layout, seed: u64) -> Drawn {
    let mut left: Vec<(f32, f32, Role)> = Vec::new();
    let mut right: Vec<(f32, f32, Role)> = Vec::new();
    let mut ball = (0.0, 0.0);
    let mut offside = false;
    match layout {
        Layout::Eleven => {
            offside = true;
            let first = seed.is_multiple_of(2);
            left.extend(if first { KICK } else { recv() });
            right.extend(if first { recv() } else { KICK });
        }
        Layout::EmptyGoalClose => {
            left.extend([(-1.0, 0.0, GK), (0.75, 0.0, CB)]);
            right.push((1.0, 0.0, GK));
            ball = (0.77, 0.0);
        }
        Layout::EmptyGoal => {
            left.extend([(-1.0, 0.0, GK), (0.0, 0.0, CB)]);
            right.push((1.0, 0.0, GK));
            ball = (0.02, 0.0);
        }
        Layout::RunToScore | Layout::RunToScoreKeeper => {
            left.extend([(-1.0, 0.0, GK), (0.0, 0.0, CB)]);
            right.push((if matches!(layout, Layout::RunToScore) { 1.0 } else { -1.0 }, 0.0, GK));
            right.extend([
                (0.12, 0.2, LB),
                (0.12, 0.1, CB),
                (0.12, 0.0, CM),
                (0.12, -0.1, CB),
                (0.12, -0.2, RB),
            ]);
            ball = (0.02, 0.0);
        }
        Layout::ThreeVersusOne => {
            left.extend([(-1.0, 0.0, GK), (0.6, 0.0, CM), (0.7, 0.2, CM), (0.7, -0.2, CM)]);
            right.extend([(-1.0, 0.0, GK), (-0.75, 0.0, CB)]);
            ball = (0.62, 0.0);
        }
        Layout::Alone | Layout::AloneWithBall => {
            left.extend([(-1.0, 0.0, GK), (-0.8, 0.1, CB)]);
            right.push((1.0, 0.0, GK));
            ball = if matches!(layout, Layout::Alone) { (0.9, -0.35) } else { (-0.79, 0.1) };
        }
    }
    let mut rules = std::array::from_fn(|i| Rule::from_index(i).map_or(0.0, Rule::default_value));
    rules[Rule::Offside.index()] = f64::from(u8::from(offside));
    let alone = matches!(layout, Layout::Alone | Layout::AloneWithBall);
    if matches!(layout, Layout::Alone) {
        rules[Rule::Assist.index()] = 0.0;
    }
    let mut players: [Option<DrawnPlayer>; 22] = std::array::from_fn(|_| None);
    for (team, list) in [(Team::Left, &left), (Team::Right, &right)] {
        let side = team.side() as f32;
        for (i, &(x, y, role)) in list.iter().enumerate() {
            let at = |x: f32, y: f32| Vec2::new(x * 54.4, y * 83.6) * side;
            let kickoff = (list.len() == 11).then(|| {
                let other = recv()[i];
                [at(KICK[i].0, KICK[i].1), at(other.0, other.1)]
            });
            players[team.index() * 11 + i] = Some(DrawnPlayer {
                role,
                ai: if alone && i != 1 { Ai::Lazy } else { Ai::Bot },
                controllable: true,
                active: true,
                pos: at(x, y),
                vel: Vec2::ZERO,
                heading_rad: None,
                fatigue: 0.0,
                yellow_cards: 0,
                difficulty: if team == Team::Left { 1.0 } else { 0.6 },
                stats: Vec::new(),
                kickoff,
            });
        }
    }
    Drawn {
        seed,
        index: 0,
        players,
        ball_pos: Vec3::new(ball.0 * 54.4, ball.1 * 83.6, 0.11),
        ball_vel: Vec3::ZERO,
        ball_spin: Vec3::ZERO,
        owner: None,
        kind: StartKind::Open,
        taker: None,
        first_kickoff: None,
        score: [0, 0],
        elapsed_steps: 0,
        difficulty: [1.0, 0.6],
        rules,
        conditions: Conditions::USUAL,
        pitch: PitchSize::USUAL,
        limit_steps: Some(3000),
        rounds: 1,
        steps_before: 0,
        others: Others::Bot,
        agents: vec![DrawnAgent { team: Team::Left, fixed: alone.then_some(PlayerId(1)) }],
        lets: Vec::new(),
    }
}

pub(crate) fn set_level(drawn: &mut Drawn, levels: [f32; 2]) {
    drawn.difficulty = levels;
    for (i, player) in drawn.players.iter_mut().enumerate() {
        if let Some(player) = player {
            player.difficulty = levels[i / 11];
        }
    }
}
