//! A kick and the keys that follow it.

use super::{rows, share_give};
use crate::figure::{Part, Section};
use crate::pitch::{Failure, Trial, mean, script};
use setpiece::scenario::vocabulary::Action;

/// Seeds of every row.
const SEEDS: u64 = 60;
/// Steps after the kick's key.
const STEPS: u32 = 18;
/// A ball faster than this has been kicked, m/s.
const KICKED_MPS: f64 = 11.5;
/// Steps over which the largest speed is taken.
const SPEED_STEPS: u32 = 4;

const FILE: &str = "grf_kick_inputs.json";
const DATA: &str = include_str!("../../data/grf_kick_inputs.json");

const SCENE: &str = "scenario kick_inputs {
    agents { left: [runner] }
    ball at (-0.28, 0)
    team left {
        GK at (-1, 0) { ai: lazy }
        runner: CB at (-0.3, 0)
        CM at (0.1, -0.2) { ai: lazy }
        CM at (0.3, 0.2) { ai: lazy }
    }
    team right { GK at (1, 0) { ai: lazy } }
    end limit 400 steps
}";

/// A row as recorded.
#[derive(serde::Deserialize)]
struct Row {
    run: String,
    kick: String,
    after: String,
    n: u64,
    kicked: f64,
    when: Option<f64>,
    when_sd: Option<f64>,
    speed: Option<f64>,
    speed_sd: Option<f64>,
    angle: Option<f64>,
    angle_sd: Option<f64>,
    peak: Option<f64>,
}

/// What became of one kick.
struct Kick {
    when: f64,
    speed: f64,
    angle: f64,
    peak: f64,
}

/// Measures every row.
pub(super) fn measure(section: &mut Section, count: Option<u64>) -> Result<(), Failure> {
    let seeds = count.unwrap_or(SEEDS);
    let mut trial = Trial::new(script(SCENE)?, 0)?;
    for row in rows::<Row>(FILE, DATA)? {
        let kick = match row.kick.as_str() {
            "short" => Action::ShortPass,
            "long" => Action::LongPass,
            "high" => Action::HighPass,
            _ => Action::Shot,
        };
        let mut kicks = Vec::new();
        for seed in 0..seeds {
            trial.again(seed)?;
            run_up(&mut trial, &row.run)?;
            kicks.extend(play(&mut trial, kick, &row.after)?);
        }
        let share = kicks.len() as f64 / seeds as f64;
        let give = share_give(row.kicked, row.n, seeds);
        let mut parts = vec![Part::around(row.kicked, give, share)];
        if let (Some(when), Some(speed), Some(angle), Some(peak)) = (row.when, row.speed, row.angle, row.peak) {
            let of = |what: fn(&Kick) -> f64| kicks.iter().map(what).collect::<Vec<_>>();
            let [when_sd, speed_sd, angle_sd] =
                [row.when_sd, row.speed_sd, row.angle_sd].map(Option::unwrap_or_default);
            // Angles by turns to two mates have no middle.
            let turns =
                of(|k| k.angle).iter().map(|of| (of - angle + 540.0).rem_euclid(360.0) - 180.0).collect::<Vec<_>>();
            parts.push(Part::around(when, 1.0 + when_sd, mean(&of(|k| k.when))));
            parts.push(Part::around(speed, 0.08 * speed + speed_sd, mean(&of(|k| k.speed))));
            parts.push(Part::around(angle, 3.0 + angle_sd, angle + mean(&turns)));
            parts.push(Part::around(peak, (0.25 * peak).max(0.3), mean(&of(|k| k.peak))));
        }
        section.row(
            format!("{} {}, then {}: share kicked · step · m/s · degrees · peak m", row.run, row.kick, row.after),
            parts,
        );
    }
    Ok(())
}

/// The keys before the kick's.
fn run_up(trial: &mut Trial, run: &str) -> Result<(), Failure> {
    match run {
        "walk" => trial.steps(Action::Right, 14),
        "sprint" => {
            trial.step(Action::Sprint)?;
            trial.steps(Action::Right, 16)
        }
        _ => {
            trial.steps(Action::Right, 8)?;
            trial.steps(Action::ReleaseDirection, 10)
        }
    }
}

/// The key of a step after the kick's, counted from 0.
fn after(keys: &str, kick: Action, step: u32) -> Action {
    let once = |key| if step == 0 { key } else { Action::Idle };
    match keys {
        "R" => Action::Right,
        "L" => Action::Left,
        "T" => Action::Top,
        "again" => kick,
        "again3" if step < 3 => kick,
        "release" => once(Action::ReleaseDirection),
        "sprint" => once(Action::Sprint),
        "relsprint" => once(Action::ReleaseSprint),
        "drib" => once(Action::Dribble),
        "BR_T" if step.is_multiple_of(2) => Action::BottomRight,
        "BR_T" => Action::TopRight,
        _ => Action::Idle,
    }
}

/// Presses a kick and what follows; none where the ball never left.
fn play(trial: &mut Trial, key: Action, keys: &str) -> Result<Option<Kick>, Failure> {
    let mut kick: Option<Kick> = None;
    let mut before = trial.ball();
    for step in 1..=STEPS + 1 {
        let on = trial.step(if step == 1 { key } else { after(keys, key, step - 2) })?;
        let way = (trial.ball() - before).truncate();
        before = trial.ball();
        let vel = trial.state().ball.vel.truncate();
        let free = trial.state().owner.is_none() && f64::from(vel.length()) > KICKED_MPS;
        if !on || (kick.is_none() && !free && step > STEPS) {
            break;
        }
        if kick.is_none() && free {
            let angle = -f64::from(vel.y.atan2(vel.x)).to_degrees();
            kick = Some(Kick { when: f64::from(step), speed: f64::from(vel.length()), angle, peak: 0.0 });
        }
        let Some(kick) = &mut kick else { continue };
        kick.peak = kick.peak.max(f64::from(before.z));
        if f64::from(step) > kick.when && f64::from(step) < kick.when + f64::from(SPEED_STEPS) {
            kick.speed = kick.speed.max(f64::from(way.length()) * 10.0);
        }
    }
    Ok(kick)
}
