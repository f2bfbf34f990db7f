//! An agent runs at one defender.

use super::rows;
use crate::figure::{Part, Section, short};
use crate::pitch::{Failure, Trial, script};
use setpiece::scenario::vocabulary::{Action, Team};

/// Seeds of every row.
const SEEDS: u64 = 48;
/// Steps of an episode.
const STEPS: u32 = 130;

const FILE: &str = "grf_duels.json";
const DATA: &str = include_str!("../../data/grf_duels.json");

const SCENE: &str = "scenario duels {
    agents { left: [runner] }
    ball at (-0.28, 0)
    team left { GK at (-1, 0) { ai: lazy }  runner: CF at (-0.3, 0) }
    team right { difficulty: LEVEL  GK at (1, 0) { ai: lazy }  CB at (PLACE, 0) }
    end when goal or ball_dead
    end when possession changes to right
    end limit 130 steps
}";

/// A row as recorded: quartiles.
#[derive(serde::Deserialize)]
struct Row {
    difficulty: f64,
    gap: f64,
    plan: String,
    furthest_x: [f64; 3],
    steps_with_ball: [f64; 3],
    nearest_m: [f64; 3],
}

/// Measures every row: our median must lie in their span, give or take.
pub(super) fn measure(section: &mut Section, count: Option<u64>) -> Result<(), Failure> {
    let seeds = count.unwrap_or(SEEDS);
    for row in rows::<Row>(FILE, DATA)? {
        let source =
            SCENE.replace("LEVEL", &row.difficulty.to_string()).replace("PLACE", &format!("{:.3}", -0.3 + row.gap));
        let mut trial = Trial::new(script(&source)?, 0)?;
        let mut runs = Vec::new();
        for seed in 0..seeds {
            trial.again(seed)?;
            runs.push(play(&mut trial, &row.plan)?);
        }
        let median = |i: usize| {
            let mut of: Vec<f64> = runs.iter().map(|run| run[i]).collect();
            of.sort_by(f64::total_cmp);
            of[of.len() / 2]
        };
        let part = |theirs: [f64; 3], give: f64, ours: f64| Part {
            theirs: theirs.map(short).join("/"),
            range: [theirs[0] - give, theirs[2] + give],
            ours,
        };
        section.row(
            format!(
                "defender of {} at {}, {}: furthest x · steps with the ball · nearest m",
                row.difficulty, row.gap, row.plan
            ),
            vec![
                part(row.furthest_x, 0.1, median(0)),
                part(row.steps_with_ball, 15.0, median(1)),
                part(row.nearest_m, 1.5, median(2)),
            ],
        );
    }
    Ok(())
}

/// The key of a step of a plan.
fn key(plan: &str, step: u32) -> Action {
    let first = match plan {
        "close control straight" => Action::Dribble,
        "walk straight" => Action::Idle,
        _ => Action::Sprint,
    };
    match (plan, step) {
        ("stand", _) => Action::ReleaseDirection,
        (_, 0) => Action::Right,
        (_, 1) => first,
        ("sprint, top_right from step 8", 8..) => Action::TopRight,
        ("zigzag, 6 steps each", _) if (step / 6).is_multiple_of(2) => Action::TopRight,
        ("zigzag, 6 steps each", _) => Action::BottomRight,
        _ => Action::Right,
    }
}

/// Runs: the ball's largest x while owned, the last step owned, the least distance.
fn play(trial: &mut Trial, plan: &str) -> Result<[f64; 3], Failure> {
    let mut run = [-0.28_f64, 0.0, 99.0];
    for step in 0..STEPS {
        if !trial.step(key(plan, step))? {
            break;
        }
        let game = trial.state();
        let me = trial.place()?;
        let nearest = game.team(Team::Right).map(|(_, rival)| rival.pos.distance(me)).fold(99.0, f32::min);
        run[2] = run[2].min(f64::from(nearest));
        if game.owner.is_some_and(|id| id.team() == Team::Left) {
            run[0] = run[0].max(f64::from(game.ball.pos.x) / 54.4);
            run[1] = f64::from(step + 1);
        }
    }
    Ok(run)
}
