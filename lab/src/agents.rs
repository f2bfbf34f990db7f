//! Ready-made agents on the scenarios: their scores and the lengths of their episodes.

use crate::figure::{Section, short};
use crate::pitch::{LabError, library};
use setpiece::engine::control::agents::Agent;
use setpiece::engine::environment::EnvironmentOptions;
use setpiece::run::{RunOptions, Summary, run};

/// Episodes of every agent on every scenario.
const EPISODES: u64 = 500;

/// A scenario with their scores and lengths for the random and the scripted agent, and the required
/// range for the scripted one.
type AgentRow = (&'static str, [f64; 2], [f64; 2], [f64; 2], Option<[f64; 2]>);

const ACADEMY: &[AgentRow] = &[
    ("academy_empty_goal_close", [0.105, 122.0], [1.0, 13.0], [0.97, 1.0], Some([9.0, 20.0])),
    ("academy_empty_goal", [0.0, 123.0], [1.0, 70.0], [0.95, 1.0], Some([55.0, 85.0])),
    ("academy_run_to_score", [-0.07, 115.0], [1.0, 70.0], [0.85, 1.0], Some([55.0, 85.0])),
    ("academy_run_to_score_with_keeper", [-0.095, 150.0], [0.42, 71.0], [0.2, 0.6], None),
    ("academy_pass_and_shoot_with_keeper", [-0.03, 126.0], [0.0, 24.0], [0.0, 0.25], None),
    ("academy_3_vs_1_with_keeper", [-0.01, 99.0], [0.13, 32.0], [0.05, 0.35], None),
    ("academy_corner", [-0.03, 172.0], [0.06, 160.0], [0.0, 0.2], None),
];

/// The matches: their result for the random agent over 72 matches (mean and its 95 % error), and
/// for the scripted one over three.
const MATCHES: &[(&str, [f64; 2], f64)] = &[
    ("11_vs_11_easy_stochastic", [-1.9, 0.28], 4.0),
    ("11_vs_11_stochastic", [-2.54, 0.33], 2.0),
    ("11_vs_11_hard_stochastic", [-3.21, 0.39], -2.3),
];

/// Measures everything of the section.
pub(crate) fn measure(episodes: Option<u64>) -> Result<Section, LabError> {
    let episodes = episodes.unwrap_or(EPISODES);
    let mut section = Section::new(
        5,
        "Agents on scenarios",
        format!(
            "Means over {episodes} episodes. Scripted: sprints at (1, 0), shoots as owner nearer than 16 m, else chases \
             the ball. Random: uniform over the 19 actions. Limits: the aim for the scripted agent; ±0.1 in score and \
             ±30 % in length for the random one. Of the three matches theirs at random is the mean of 72 of each, \
             played through EnvPool's build of it; the limits add the 95 % interval of that mean."
        ),
    );
    for &(name, random, scripted, score, length) in ACADEMY {
        let ours = play(name, Agent::RunAndShoot, episodes)?;
        section.within(format!("{name}: score, scripted"), short(scripted[0]), score, goals(&ours));
        if let Some(length) = length {
            section.within(
                format!("{name}: steps, scripted"),
                short(scripted[1]),
                length,
                ours.mean_length,
            );
        } else {
            section.notes.push(format!(
                "Steps, {name}, scripted: {:.0}; theirs {:.0}.",
                ours.mean_length, scripted[1]
            ));
        }
        let ours = play(name, Agent::Random, episodes)?;
        let [low, high] = [random[0] - 0.1, random[0] + 0.1];
        section.within(
            format!("{name}: score, random"),
            short(random[0]),
            [low, high],
            goals(&ours),
        );
        section.near(format!("{name}: steps, random"), random[1], 0.3, ours.mean_length);
        let ends: Vec<String> = ours
            .outcomes
            .iter()
            .map(|(label, _, count)| {
                format!("{label} {:.0} %", f64::from(*count) * 100.0 / episodes as f64)
            })
            .collect();
        section.notes.push(format!("Ends, {name}, random: {}.", ends.join(", ")));
    }
    matches(&mut section, episodes)?;
    Ok(section)
}

fn matches(section: &mut Section, episodes: u64) -> Result<(), LabError> {
    let mut easier = f64::INFINITY;
    for &(name, [random, unsure], scripted) in MATCHES {
        let ours = goals(&play(name, Agent::RunAndShoot, episodes)?);
        section.within(
            format!("{name}: score, scripted, below that of the easier one"),
            short(scripted),
            [f64::NEG_INFINITY, easier],
            ours,
        );
        easier = ours;
        let ours = goals(&play(name, Agent::Random, episodes)?);
        let [low, high] = [random - 0.1 - unsure, random + 0.1 + unsure];
        section.within(format!("{name}: score, random"), short(random), [low, high], ours);
    }
    Ok(())
}

/// The mean goal difference of the agent's side.
fn goals(summary: &Summary) -> f64 {
    summary.score[0] - summary.score[1]
}

/// Plays the episodes.
fn play(name: &str, agent: Agent, episodes: u64) -> Result<Summary, LabError> {
    let environment = library(name, &[])?;
    let options = RunOptions {
        episodes: 0..episodes,
        seed: 0,
        agent: agent.into(),
        threads: crate::threads::threads(),
        environment: EnvironmentOptions::default(),
    };
    run(environment.scenario(), &options, |_| {}).map_err(|why| format!("{name}: {why}"))
}
