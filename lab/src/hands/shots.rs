//! Shots of a sprinting agent: place, held direction, presses, keeper.

use super::{direction, rows, share_give};
use crate::figure::{Part, Section};
use crate::pitch::{Failure, Trial, mean, script};
use setpiece::scenario::vocabulary::{Action, EventKind, GameMode, Team};

/// Seeds of every row.
const SEEDS: u64 = 60;
/// Steps that an episode may last.
const STEPS: u32 = 100;

/// How far two rows of theirs with the same keys lie apart because the runner's stride was at another point, steps.
const PHASE_STEPS: f64 = 2.5;
/// Steps over which the largest speed is taken.
const SPEED_STEPS: u32 = 4;

const FILE: &str = "grf_shots_held.json";
const DATA: &str = include_str!("../../data/grf_shots_held.json");

const SCENE: &str = "scenario shots_held {
    agents { left: [runner] }
    ball at (BALLX, SIDE)
    team left { GK at (-1, 0) { ai: lazy }  runner: CF at (STARTX, SIDE) }
    team right { KEEPER }
    end when goal or ball_dead
    end limit 120 steps
}";

/// A row as recorded.
#[derive(serde::Deserialize)]
struct Row {
    x: f64,
    y: f64,
    keeper: bool,
    held: String,
    presses: u32,
    n: u64,
    goals: f64,
    wide: f64,
    lost: f64,
    leaves: Option<f64>,
    angle: Option<f64>,
    angle_sd: Option<f64>,
    speed: Option<f64>,
}

/// What became of one shot.
#[derive(Default)]
struct Shot {
    goal: bool,
    wide: bool,
    lost: bool,
    struck: Option<[f64; 3]>,
}

/// Measures every row.
pub(super) fn measure(section: &mut Section, count: Option<u64>) -> Result<(), Failure> {
    let seeds = count.unwrap_or(SEEDS);
    for row in rows::<Row>(FILE, DATA)? {
        let keeper = if row.keeper { "GK at (1, 0)" } else { "GK at (-0.9, -0.3) { ai: lazy }" };
        let source = SCENE
            .replace("BALLX", &format!("{:.3}", row.x - 0.13))
            .replace("STARTX", &format!("{:.3}", row.x - 0.15))
            .replace("SIDE", &row.y.to_string())
            .replace("KEEPER", keeper);
        let mut trial = Trial::new(script(&source)?, 0)?;
        let mut shots = Vec::new();
        for seed in 0..seeds {
            trial.again(seed)?;
            shots.push(play(&mut trial, &row)?);
        }
        let share = |what: fn(&Shot) -> bool| shots.iter().filter(|s| what(s)).count() as f64 / seeds as f64;
        let around = |theirs: f64, ours: f64| Part::around(theirs, share_give(theirs, row.n, seeds), ours);
        let mut parts = vec![
            around(row.goals, share(|s| s.goal)),
            around(row.wide, share(|s| s.wide)),
            around(row.lost, share(|s| s.lost)),
        ];
        if let (Some(leaves), Some(angle), Some(speed)) = (row.leaves, row.angle, row.speed) {
            let of = |i: usize| shots.iter().filter_map(|s| s.struck).map(|s| s[i]).collect::<Vec<_>>();
            parts.push(Part::around(leaves, PHASE_STEPS, mean(&of(0))));
            parts.push(Part::around(angle, 3.0 + row.angle_sd.unwrap_or_default(), mean(&of(1))));
            parts.push(Part::around(speed, 0.08 * speed, mean(&of(2))));
        }
        let what = format!(
            "shot from ({}, {}), {}, {} held, {} presses: goals · wide · lost · step · degrees · m/s",
            row.x,
            row.y,
            if row.keeper { "keeper" } else { "no keeper" },
            row.held,
            row.presses
        );
        section.row(what, parts);
    }
    Ok(())
}

/// Runs at the place, presses, and sees what becomes of it.
fn play(trial: &mut Trial, row: &Row) -> Result<Shot, Failure> {
    let mut shot = Shot::default();
    trial.step(Action::Sprint)?;
    let x_m = (row.x - 0.03) as f32 * 54.4;
    let mut since: Option<u32> = None;
    for _ in 0..STEPS {
        let game = trial.state();
        let owned = game.owner.is_some_and(|id| id.team() == Team::Left);
        if since.is_none() && owned && game.ball.pos.x >= x_m {
            since = Some(0);
        }
        let key = match since {
            None => Action::Right,
            Some(0) => direction(&row.held).unwrap_or(Action::ReleaseDirection),
            Some(n) if n <= row.presses => Action::Shot,
            Some(_) => Action::Idle,
        };
        let before = trial.ball();
        if !trial.step(key)? {
            break;
        }
        let goal = trial.events().iter().any(|e| e.kind == EventKind::Goal);
        let wide = trial.state().play.pending.is_some_and(|it| it.mode == GameMode::GoalKick)
            || trial.events().iter().any(|e| e.kind == EventKind::GoalKick);
        shot.goal |= goal;
        shot.wide |= wide && !goal;
        let Some(n) = &mut since else { continue };
        *n += 1;
        let vel = trial.state().ball.vel.truncate();
        let free = trial.state().owner.is_none() && vel.length() > 15.0;
        if shot.struck.is_none() && free {
            let angle = -f64::from(vel.y.atan2(vel.x)).to_degrees();
            shot.struck = Some([f64::from(*n), angle, 0.0]);
        }
        if let Some([leaves, _, speed]) = &mut shot.struck {
            let way = (trial.ball() - before).truncate().length();
            if f64::from(*n) < *leaves + f64::from(SPEED_STEPS)
                && !trial.events().iter().any(|e| e.kind == EventKind::OutOfPlay)
                && !goal
            {
                *speed = speed.max(f64::from(way) * 10.0);
            }
        }
    }
    shot.lost = since.is_none();
    Ok(shot)
}
