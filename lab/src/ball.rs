//! The ball: how it leaves the foot, flies, bounces and rolls, and the results of shots.

use crate::figure::Section;
use crate::pitch::{LabError, Trial, deviation, mean, text};
use setpiece::scenario::pitch::BALL_RADIUS_M;
use setpiece::scenario::vocabulary::{Action, EventKind};

/// Seeds of every kick.
const SEEDS: u64 = 64;
/// Seeds of every shot at goal.
const SHOTS: u64 = 200;

/// Measures everything of the section.
pub(crate) fn measure() -> Result<Section, LabError> {
    let mut section = Section::new(
        3,
        "The ball",
        format!(
            "Kicks: means over {SEEDS} seeds, level speed from the ball's places at the steps' ends. Limits: ±8 % on \
             speeds, ±25 % on the means of heights, ±1 step on times. Standing shots: {SHOTS} episodes each, every one with \
             its own start, a keeper of difficulty 0.6; limits as in section 6."
        ),
    );
    kicks(&mut section)?;
    motion(&mut section)?;
    crate::hands::standing_shots(&mut section, Some(SHOTS))?;
    Ok(section)
}

/// The figures of a kick.
struct Kick {
    /// Steps from the press until the ball leaves.
    leaves_after: f64,
    /// Highest horizontal speed of a step, m/s.
    top_mps: f64,
    /// Highest point of the ball, m.
    peak_m: f64,
    /// Angle off the mean direction, degrees.
    aside_deg: f64,
}

/// The kicker's run-up.
#[derive(Clone, Copy)]
enum RunUp {
    Stand,
    Walk,
    Sprint,
}

const KICKS: &str = "scenario kicks {
    rules { offside: off }
    agents { left: [runner] }
    ball at (-0.36, 0)
    team left { MATE  runner: CB at (-0.37, 0) }
    team right { GK at (1, 0) { ai: lazy } }
    end limit 400 steps
}";

/// Kicks once for every seed.
fn kick(action: Action, mate: Option<f64>, run_up: RunUp) -> Result<Vec<Kick>, LabError> {
    let mate = mate.map_or("GK at (-1, 0) { ai: lazy }".to_owned(), |ahead| {
        format!("CM at ({}, 0) {{ ai: hold }}", -0.37 + ahead)
    });
    let mut trial = Trial::new(text(&KICKS.replace("MATE", &mate))?, 0)?;
    let mut kicks = Vec::new();
    for seed in 0..SEEDS {
        trial.again(seed)?;
        match run_up {
            RunUp::Stand => trial.steps(Action::Idle, 12)?,
            RunUp::Walk | RunUp::Sprint => {
                trial.step(Action::Right)?;
                trial.step(if matches!(run_up, RunUp::Sprint) {
                    Action::Sprint
                } else {
                    Action::Idle
                })?;
                // Long enough for the gait. The length varies, so that the ball isn't always at the
                // same foot.
                trial.steps(Action::Idle, 20 + (seed % 6) as usize)?;
            }
        }
        let mut kick =
            Kick { leaves_after: f64::INFINITY, top_mps: 0.0, peak_m: 0.0, aside_deg: 0.0 };
        let mut before = trial.ball();
        for step in 0..30 {
            let on = trial.step(if step == 0 { action } else { Action::Idle })?;
            if !on || trial.events().iter().any(|e| e.kind == EventKind::OutOfPlay) {
                // The restart has moved the ball.
                break;
            }
            let struck =
                trial.events().iter().any(|e| matches!(e.kind, EventKind::Pass | EventKind::Shot));
            let way = (trial.ball() - before).truncate();
            let speed = f64::from(way.length()) * 10.0;

            if struck && kick.leaves_after.is_infinite() {
                kick.leaves_after = f64::from(step);
            }
            if kick.leaves_after.is_finite()
                && f64::from(step) > kick.leaves_after
                && kick.aside_deg == 0.0
            {
                kick.aside_deg = f64::from(way.y.atan2(way.x)).to_degrees();
            }
            // After a contact with a teammate or the frame, the kick no longer counts.
            if trial.state().last_touch.is_some_and(|id| id.in_team() != 1) {
                break;
            }
            if kick.leaves_after.is_finite() {
                kick.top_mps = kick.top_mps.max(speed);
                kick.peak_m = kick.peak_m.max(f64::from(trial.ball().z));
            }
            before = trial.ball();
        }
        kicks.push(kick);
    }
    Ok(kicks)
}

#[expect(clippy::too_many_lines, reason = "one table, row by row")]
fn kicks(section: &mut Section) -> Result<(), LabError> {
    use Action::{HighPass, LongPass, ShortPass, Shot};
    let cases = [
        (
            "shot, standing",
            Shot,
            None,
            RunUp::Stand,
            [3.0, 3.0],
            [26.0, 27.5],
            [0.7, 1.2],
            "0.9–2.6",
        ),
        (
            "shot, walking",
            Shot,
            None,
            RunUp::Walk,
            [3.5, 3.5],
            [30.0, 30.0],
            [0.32, 0.32],
            "1.5–1.8",
        ),
        (
            "shot, sprinting",
            Shot,
            None,
            RunUp::Sprint,
            [2.0, 5.4],
            [30.0, 30.0],
            [0.36, 0.36],
            "1.5–1.8",
        ),
        (
            "short pass, 0.2",
            ShortPass,
            Some(0.2),
            RunUp::Stand,
            [4.0; 2],
            [15.0; 2],
            [0.26; 2],
            "<0.1",
        ),
        (
            "short pass, 0.4",
            ShortPass,
            Some(0.4),
            RunUp::Stand,
            [4.0; 2],
            [23.8; 2],
            [0.83; 2],
            "<0.1",
        ),
        (
            "short pass, 0.8",
            ShortPass,
            Some(0.8),
            RunUp::Stand,
            [4.0; 2],
            [24.3; 2],
            [2.1; 2],
            "<0.1",
        ),
        (
            "long pass, 0.2",
            LongPass,
            Some(0.2),
            RunUp::Stand,
            [4.0; 2],
            [16.3; 2],
            [0.30; 2],
            "<0.1",
        ),
        (
            "long pass, 0.4",
            LongPass,
            Some(0.4),
            RunUp::Stand,
            [4.0; 2],
            [24.3; 2],
            [1.3; 2],
            "<0.1",
        ),
        (
            "long pass, 0.8",
            LongPass,
            Some(0.8),
            RunUp::Stand,
            [4.0; 2],
            [24.3; 2],
            [2.1; 2],
            "<0.1",
        ),
        (
            "high pass, 0.2",
            HighPass,
            Some(0.2),
            RunUp::Stand,
            [3.0; 2],
            [12.4; 2],
            [1.5; 2],
            "<0.1",
        ),
        (
            "high pass, 0.4",
            HighPass,
            Some(0.4),
            RunUp::Stand,
            [3.0; 2],
            [17.8; 2],
            [2.5; 2],
            "<0.1",
        ),
        (
            "high pass, 0.8",
            HighPass,
            Some(0.8),
            RunUp::Stand,
            [3.0; 2],
            [32.1; 2],
            [5.4; 2],
            "<0.1",
        ),
    ];
    for (name, action, mate, run_up, leaves, speed, peak, aside) in cases {
        let kicks = kick(action, mate, run_up)?;
        let of = |what: fn(&Kick) -> f64| kicks.iter().map(what).collect::<Vec<_>>();
        let (after, top, high) = (of(|k| k.leaves_after), of(|k| k.top_mps), of(|k| k.peak_m));
        section.within(
            format!("{name}: leaves after, steps"),
            span(leaves),
            [leaves[0] - 1.0, leaves[1] + 1.0],
            mean(&after),
        );
        section.within(
            format!("{name}: top speed, m/s"),
            span(speed),
            [speed[0] * 0.92, speed[1] * 1.08],
            mean(&top),
        );
        section.within(
            format!("{name}: peak height, m"),
            span(peak),
            [peak[0] * 0.75, peak[1] * 1.25],
            mean(&high),
        );
        section.notes.push(format!(
            "Scatter, {name}: speed ±{:.2} m/s, direction ±{:.1}° (theirs {aside}°), height ±{:.2} m.",
            deviation(&top),
            deviation(&of(|k| k.aside_deg)),
            deviation(&high)
        ));
    }
    Ok(())
}

/// A range as the report shows it.
fn span([low, high]: [f64; 2]) -> String {
    use crate::figure::short;
    if low == high { short(low) } else { format!("{}–{}", short(low), short(high)) }
}

/// The most spin that a scenario can give a ball, rad/s.
const SPIN_MAX: f64 = 200.0;

const FREE: &str = "scenario free {
    agents { left: [runner] }
    ball at (X, 0) { velocity: (V, 0m/s)  height: Z  spin: (0, W, 0) }
    team left { runner: CB at (-0.9, 0.35) { ai: hold } }
    team right { GK at (0.9, 0.35) { ai: lazy } }
    rules { assist: off }
    end limit 200 steps
}";

/// A ball released with a horizontal speed from a height; one on the ground rolls.
fn let_go(x: f64, speed: f64, height: f64) -> Result<Trial, LabError> {
    let spin = if height == 0.0 { (speed / BALL_RADIUS_M).min(SPIN_MAX) } else { 0.0 };
    let source = FREE
        .replace('X', &x.to_string())
        .replace('V', &format!("{speed}m/s"))
        .replace('W', &spin.to_string())
        .replace('Z', &format!("{height}m"));
    Trial::new(text(&source)?, 0)
}

/// Flight, bounce and roll of a ball that nobody touches.
fn motion(section: &mut Section) -> Result<(), LabError> {
    let level = |trial: &Trial| f64::from(trial.state().ball.vel.truncate().length());
    for speed in [6.0, 12.0, 18.0, 24.0] {
        let mut trial = let_go(-0.5, speed, 0.0)?;
        let before = level(&trial);
        trial.step(Action::Idle)?;
        let after = level(&trial);
        let at = (before + after) * 0.5;
        let theirs = 1.6 + 0.055 * at * at;
        section.near(
            format!("rolling at {speed:.0} m/s slows by, m/s²"),
            theirs,
            0.08,
            (before - after) * 10.0,
        );
    }
    for speed in [12.0, 20.0, 30.0] {
        let mut trial = let_go(-0.5, speed, 9.0)?;
        let before = level(&trial);
        trial.step(Action::Idle)?;
        let after = level(&trial);
        let at = (before + after) * 0.5;
        section.near(
            format!("flying at {speed:.0} m/s slows by, m/s²"),
            0.0155 * at * at,
            0.08,
            (before - after) * 10.0,
        );
    }
    let mut trial = let_go(-0.5, 0.0, 2.0)?;
    let mut rebound = 0.0;
    for _ in 0..16 {
        trial.step(Action::Idle)?;
        let ball = trial.state().ball;
        if ball.vel.z > 0.0 {
            let height =
                f64::from(ball.pos.z - 0.11) + f64::from(ball.vel.z).powi(2) / (2.0 * 9.81);
            rebound = f64::max(rebound, height);
        }
    }
    section.near("height after a bounce over that before", 0.37, 0.25, rebound / 1.89);
    let mut trial = let_go(-0.8, 15.0, 3.0)?;
    let mut before = level(&trial);
    let mut kept = f64::NAN;
    for _ in 0..16 {
        trial.step(Action::Idle)?;
        if trial.state().ball.vel.z > 0.0 && kept.is_nan() {
            kept = level(&trial) / before;
        }
        before = level(&trial);
    }
    section.near("level speed after a bounce over that before", 0.77, 0.08, kept);
    section.near("height of the centre of a ball at rest, m", 0.11, 0.001, {
        let mut trial = let_go(0.0, 0.0, 0.0)?;
        trial.steps(Action::Idle, 10)?;
        f64::from(trial.ball().z)
    });
    section.near("a standing shot in flight falls with, m/s²", 7.4, 0.08, shot_fall()?);
    Ok(())
}

/// The mean vertical acceleration of standing shots before they come down, m/s².
fn shot_fall() -> Result<f64, LabError> {
    let mut trial = Trial::new(text(&KICKS.replace("MATE", "GK at (-1, 0) { ai: lazy }"))?, 0)?;
    let mut falls = Vec::new();
    for seed in 0..SEEDS {
        trial.again(seed)?;
        trial.steps(Action::Idle, 12)?;
        trial.step(Action::Shot)?;
        let mut before: Option<f64> = None;
        for _ in 0..14 {
            trial.step(Action::Idle)?;
            let ball = trial.state().ball;
            let now = f64::from(ball.vel.z);
            let flies = ball.pos.z > 0.2 && ball.vel.x > 15.0;
            if let Some(before) = before.filter(|before| flies && now < *before) {
                falls.push((before - now) * 10.0);
            }
            before = flies.then_some(now);
        }
    }
    Ok(mean(&falls))
}
