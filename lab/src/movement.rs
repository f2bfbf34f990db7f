//! Running, turning, stopping, tiring: one player without opponents.

use crate::figure::Section;
use crate::pitch::{LabError, Trial, mean, text};
use glam::Vec2;
use setpiece::scenario::vocabulary::Action;

/// A player alone; the ball is far away, or at their feet.
const ALONE: &str = "scenario alone {
    rules { offside: off, assist: off }
    agents { left: [runner] }
    ball at BALL
    team left { GK at (-1, 0)  runner: CB at (-0.8, 0.1) }
    team right { GK at (1, 0) { ai: lazy } }
    end limit 3000 steps
}";

/// The player's gait.
#[derive(Clone, Copy, PartialEq)]
enum MeasuredGait {
    Dribble,
    Walk,
    Sprint,
}

impl MeasuredGait {
    const ALL: [(MeasuredGait, &'static str); 3] = [
        (MeasuredGait::Dribble, "dribble"),
        (MeasuredGait::Walk, "walk"),
        (MeasuredGait::Sprint, "sprint"),
    ];

    /// The action that turns it on.
    fn action(self) -> Action {
        match self {
            MeasuredGait::Dribble => Action::Dribble,
            MeasuredGait::Walk => Action::Idle,
            MeasuredGait::Sprint => Action::Sprint,
        }
    }
}

/// Speeds per step from a standstill, without the ball, sprinting.
const SPRINT: [f64; 20] = [
    0.36, 2.19, 3.11, 3.93, 4.69, 5.07, 5.34, 5.86, 6.31, 6.69, 6.97, 7.19, 7.36, 7.48, 7.57, 7.64,
    7.69, 7.73, 7.75, 7.77,
];
/// Measures everything of the section.
pub(crate) fn measure() -> Result<Section, LabError> {
    let mut section = Section::new(
        2,
        "Movement",
        "One player (index 1 of the team) without opponents; speeds from the places at the steps' ends, 100 ms per step. \
         Limits: ±5 % on speeds, ±1 step on times, 10 % or 0.4 m/s on the points of a curve, ±0.03 on tiredness. Rows \
         with the ball are means over many starts, with the limits of section 6.",
    );
    top_speeds(&mut section)?;
    curves(&mut section)?;
    turns(&mut section)?;
    crate::hands::runs_with_the_ball(&mut section)?;
    tiredness(&mut section)?;
    Ok(section)
}

fn start(with_ball: bool) -> Result<Trial, LabError> {
    let ball = if with_ball { "(-0.79, 0.1)" } else { "(0.9, -0.35)" };
    let mut trial = Trial::new(text(&ALONE.replace("BALL", ball))?, 0)?;
    if with_ball {
        // The player takes the ball first.
        trial.steps(Action::Idle, 12)?;
    }
    Ok(trial)
}

/// The player's speed in every step after the keys are pressed, one per step, m/s.
fn speeds(trial: &mut Trial, keys: &[Action], steps: usize) -> Result<Vec<f64>, LabError> {
    let mut before = trial.place()?;
    let mut speeds = Vec::with_capacity(steps);
    for step in 0..steps {
        trial.step(keys.get(step).copied().unwrap_or(Action::Idle))?;
        let now = trial.place()?;
        speeds.push(f64::from(now.distance(before)) * 10.0);
        before = now;
    }
    Ok(speeds)
}

fn top_speeds(section: &mut Section) -> Result<(), LabError> {
    for (with_ball, theirs) in [(false, [3.50, 5.00, 7.82]), (true, [4.1, 5.12, 7.45])] {
        for ((gait, name), theirs) in MeasuredGait::ALL.into_iter().zip(theirs) {
            let run = speeds(&mut start(with_ball)?, &[Action::Right, gait.action()], 70)?;
            let of = if with_ball { "with the ball" } else { "without the ball" };
            section.near(format!("top speed, {name}, {of}, m/s"), theirs, 0.05, mean(&run[35..]));
        }
    }
    Ok(())
}

fn curves(section: &mut Section) -> Result<(), LabError> {
    let cut = |top: f64| SPRINT.map(|speed| speed.min(top)).to_vec();
    let cases = [
        ("sprint without the ball", MeasuredGait::Sprint, SPRINT.to_vec()),
        ("walk without the ball", MeasuredGait::Walk, cut(5.0)),
        ("dribble without the ball", MeasuredGait::Dribble, cut(3.5)),
    ];
    for (name, gait, theirs) in cases {
        let give = |theirs: f64| (theirs * 0.1).max(0.4);
        let run = speeds(&mut start(false)?, &[Action::Right, gait.action()], theirs.len())?;
        if matches!(gait, MeasuredGait::Walk | MeasuredGait::Dribble) {
            // The same curve, cut: one figure.
            let off = run
                .iter()
                .zip(&theirs)
                .filter(|(ours, theirs)| (*ours - *theirs).abs() > give(**theirs))
                .count();
            let what =
                format!("points of 20 beside the same curve cut at {:.1} m/s, {name}", theirs[19]);
            section.within(what, "0", [0.0, 0.0], off as f64);
            continue;
        }
        for (step, (ours, theirs)) in run.iter().zip(&theirs).enumerate() {
            let give = give(*theirs);
            section.within(
                format!("speed in step {} from a standstill, {name}, m/s", step + 1),
                crate::figure::short(*theirs),
                [theirs - give, theirs + give],
                *ours,
            );
        }
    }
    Ok(())
}

fn turns(section: &mut Section) -> Result<(), LabError> {
    let cases = [
        // Steps until the direction is new, until the speed is back; for 45° and 90°; steps to a
        // stop, its way.
        (
            "walk without the ball",
            MeasuredGait::Walk,
            [[2, 5], [2, 5]],
            [[3, 5], [5, 8]],
            [3, 5],
            1.1,
        ),
        (
            "sprint without the ball",
            MeasuredGait::Sprint,
            [[3, 5], [6, 8]],
            [[5, 7], [12, 14]],
            [5, 6],
            2.4,
        ),
    ];
    for (name, gait, half, full, stop, way) in cases {
        for (turn, degrees, [direction, speed]) in
            [(Action::BottomRight, 45, half), (Action::Bottom, 90, full)]
        {
            let [turned, fast] = turn_steps(gait, turn)?;
            section.within(
                format!("steps to turn by {degrees}°, {name}"),
                limits(direction),
                wide(direction),
                turned,
            );
            section.within(
                format!("steps until 90 % of the speed is back after {degrees}°, {name}"),
                limits(speed),
                wide(speed),
                fast,
            );
        }
        let [steps, metres] = stop_of(gait)?;
        section.within(format!("steps to a stop, {name}"), limits(stop), wide(stop), steps);
        section.notes.push(format!(
            "Way of a stop, {name}: {metres:.1} m; theirs {way} m (no limit stated)."
        ));
    }
    Ok(())
}

/// Limits as the report shows them.
fn limits([low, high]: [u32; 2]) -> String {
    if low == high { low.to_string() } else { format!("{low}–{high}") }
}

/// Limits of steps, with one more on either side.
fn wide([low, high]: [u32; 2]) -> [f64; 2] {
    [f64::from(low) - 1.0, f64::from(high) + 1.0]
}

/// Steps until the velocity points within 12° of a new direction, and until it also has 90 % of the
/// old speed.
fn turn_steps(gait: MeasuredGait, turn: Action) -> Result<[f64; 2], LabError> {
    let mut trial = start(false)?;
    speeds(&mut trial, &[Action::Right, gait.action()], 35)?;
    let old = mean(&speeds(&mut trial, &[], 5)?);
    let (x, y) = turn.direction().unwrap_or_default();
    let aim = Vec2::new(x as f32, y as f32);
    let (mut turned, mut fast) = (f64::INFINITY, f64::INFINITY);
    let mut before = trial.place()?;
    for step in 1..=60 {
        trial.step(if step == 1 { turn } else { Action::Idle })?;
        let way = trial.place()? - before;
        before = trial.place()?;
        let straight = way.normalize_or_zero().dot(aim) > 0.978;
        if straight {
            turned = turned.min(f64::from(step));
        }
        if straight && f64::from(way.length()) * 10.0 >= 0.9 * old {
            fast = fast.min(f64::from(step));
        }
    }
    Ok([turned, fast])
}

/// Steps until the player stands, and the metres that they take.
fn stop_of(gait: MeasuredGait) -> Result<[f64; 2], LabError> {
    let mut trial = start(false)?;
    speeds(&mut trial, &[Action::Right, gait.action()], 40)?;
    let from = trial.place()?;
    for step in 1..=40 {
        let before = trial.place()?;
        trial.step(if step == 1 { Action::ReleaseDirection } else { Action::Idle })?;
        if trial.place()?.distance(before) * 10.0 < 0.1 {
            // The player stopped in the step before this one.
            return Ok([f64::from(step - 1), f64::from(before.distance(from))]);
        }
    }
    Ok([f64::INFINITY, f64::INFINITY])
}

fn tiredness(section: &mut Section) -> Result<(), LabError> {
    let mut trial = start(false)?;
    trial.steps(Action::Right, 1)?;
    trial.steps(Action::Sprint, 1)?;
    let mut top_fresh = 0.0;
    for step in 2..=2000 {
        // Up and down the pitch.
        let action = match step % 200 {
            100 => Action::Left,
            0 => Action::Right,
            _ => Action::Idle,
        };
        let before = trial.place()?;
        trial.step(action)?;
        if step == 90 {
            top_fresh = f64::from(trial.place()?.distance(before)) * 10.0;
        }
        let theirs = match step {
            500 => 0.26,
            1000 => 0.53,
            1500 => 0.79,
            2000 => 0.99,
            _ => continue,
        };
        let ours = f64::from(trial.me()?.fatigue);
        section.within(
            format!("tiredness after {step} steps of sprint"),
            crate::figure::short(theirs),
            [theirs - 0.03, theirs + 0.03],
            ours,
        );
    }
    trial.steps(Action::Right, 60)?;
    let before = trial.place()?;
    trial.steps(Action::Idle, 1)?;
    let tired = f64::from(trial.place()?.distance(before)) * 10.0;
    section.near(
        "top speed of an exhausted player over that of a fresh one",
        1.0,
        0.05,
        tired / top_fresh,
    );
    let mut trial = start(false)?;
    trial.steps(Action::Right, 1)?;
    for step in 1..500 {
        let turn = if step % 300 == 150 { Action::Left } else { Action::Idle };
        trial.step(if step == 300 { Action::Right } else { turn })?;
    }
    let ours = f64::from(trial.me()?.fatigue);
    section.within("tiredness after 500 steps of walking", "0.17", [0.14, 0.20], ours);
    let mut trial = start(false)?;
    trial.steps(Action::Idle, 500)?;
    let ours = f64::from(trial.me()?.fatigue);
    section.within("tiredness after 500 steps of standing", "0", [-0.03, 0.03], ours);
    Ok(())
}
