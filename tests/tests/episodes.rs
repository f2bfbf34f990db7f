//! What the library's scenarios must show when played.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

use setpiece::engine::control::agents::Agent;
use setpiece::engine::environment::{EnvironmentOptions, Physics};
use setpiece::run::{RunOptions, Summary, run};

fn play(name: &str, agent: Agent, episodes: u64) -> Summary {
    play_with(name, agent, episodes, EnvironmentOptions::default())
}

fn play_with(name: &str, agent: Agent, episodes: u64, environment: EnvironmentOptions) -> Summary {
    let loaded = setpiece::load(name).unwrap();
    let agent = agent.into();
    let options = RunOptions { episodes: 0..episodes, seed: 1, agent, threads: 2, environment };
    let summary = run(&loaded.scenario, &options, |_| {}).unwrap();
    assert!(summary.episodes.iter().all(Result::is_ok), "{name}");
    summary
}

#[test]
fn whoever_runs_and_shoots_scores_into_an_empty_goal() {
    for (name, success, length) in [
        ("academy_empty_goal_close", 0.95, 60.0),
        ("academy_empty_goal", 0.9, 120.0),
        ("academy_run_to_score", 0.7, 120.0),
    ] {
        let summary = play(name, Agent::RunAndShoot, 100);
        assert!(
            summary.success_rate >= success,
            "{name}: {} {:?}",
            summary.success_rate,
            summary.outcomes
        );
        assert!(summary.mean_length <= length, "{name}: {}", summary.mean_length);
    }
}

#[test]
fn whoever_does_nothing_never_scores() {
    for name in ["academy_empty_goal_close", "academy_empty_goal", "academy_run_to_score"] {
        let summary = play(name, Agent::Idle, 50);
        assert_eq!(summary.success_rate, 0.0, "{name}: {:?}", summary.outcomes);
    }
}

#[test]
fn who_stands_on_the_ball_is_left_alone() {
    for base in ["11_vs_11_stochastic", "5_vs_5"] {
        let text = format!(
            "scenario s extends {base} {{ end failure still when held(ball.speed < 0.1m/s, for: 30s) }}"
        );
        let loaded = setpiece::compile_text(&text, "<test>").unwrap();
        let options = RunOptions {
            episodes: 0..40,
            seed: 0,
            agent: Agent::Idle.into(),
            threads: 2,
            environment: EnvironmentOptions::default(),
        };
        let summary = run(&loaded.scenario, &options, |_| {}).unwrap();
        let still =
            summary.episodes.iter().flatten().filter(|episode| episode.outcome == "still").count();
        // As in GRF, where nobody attacks an idle player on the ball.
        assert!(still >= 12, "{base}: {still} of 40 stood still for 30 s");
    }
}

#[test]
fn chance_scores_now_and_then() {
    let summary = play("academy_3_vs_1_with_keeper", Agent::Random, 400);
    assert!(summary.success_rate > 0.0 && summary.success_rate < 0.3, "{:?}", summary.outcomes);
}

#[test]
fn a_full_match_looks_like_football() {
    let summary = play("11_vs_11_stochastic", Agent::Bot, 20);
    assert!(
        summary.episodes.iter().flatten().all(|episode| episode.length == 3000),
        "a match lasts exactly 3000 steps"
    );
    let stats = &summary.match_stats;
    let within = |what: &str, value: f64, low: f64, high: f64| {
        assert!((low..=high).contains(&value), "{what} {value} outside {low}..{high}: {stats:?}");
    };
    within("passes", stats.passes, 40.0, 250.0);
    within("completed", stats.pass_completion, 0.45, 1.0);
    within("shots", stats.shots, 3.0, 40.0);
    within("goals", stats.goals, 0.3, 8.0);
    within("spell", stats.possession_spell, 10.0, 100.0);
    within("crowding", stats.crowding, 0.0, 0.3);
    for third in stats.thirds {
        within("third", third, 0.1, 0.8);
    }
}

#[test]
fn every_scenario_plays_to_its_end() {
    for entry in setpiece::list() {
        for agent in [Agent::Random, Agent::Bot] {
            let summary = play(&entry.name, agent, 2);
            for episode in summary.episodes.iter().flatten() {
                assert!(
                    episode.returns.iter().all(|paid| paid.is_finite()) && episode.length > 0,
                    "{}",
                    entry.name
                );
            }
        }
    }
}

#[test]
fn who_lost_the_ball_is_known() {
    let text = "scenario s extends 11_vs_11_stochastic {
        agents { left: all }
        reward lost { give 1 on ball_lost by me as \"me\"  give 1 on ball_lost by us as \"us\" }
        end limit 1500 steps
    }";
    let loaded = setpiece::compile_text(text, "<test>").unwrap_or_else(|error| panic!("{error}"));
    let environment = EnvironmentOptions::default();
    let options =
        RunOptions { episodes: 0..2, seed: 1, agent: Agent::Bot.into(), threads: 2, environment };
    let summary = run(&loaded.scenario, &options, |_| {}).unwrap();
    let term = |name: &str| summary.terms.iter().position(|(term, _)| term == name).unwrap();
    for episode in summary.episodes.iter().flatten() {
        let total = |name: &str| episode.terms.iter().map(|terms| terms[term(name)]).sum::<f64>();
        let (by_me, by_us) = (total("lost/me"), total("lost/us") / episode.terms.len() as f64);
        assert!(by_us >= 2.0, "{by_us}");
        // A player sent off and a ball given to nobody aren't any agent's loss.
        assert!(by_me >= by_us - 2.0 && by_me <= by_us, "{by_me} of {by_us}");
    }
}

#[test]
fn checkpoints_pay_at_most_one_and_the_rest_with_the_first_goal() {
    let options = EnvironmentOptions {
        rewards: Some(vec!["scoring".to_owned(), "checkpoints".to_owned()]),
        ..EnvironmentOptions::default()
    };
    let summary = play_with("academy_empty_goal", Agent::RunAndShoot, 40, options.clone());
    for episode in summary.episodes.iter().flatten() {
        let term = |name: &str| {
            summary
                .terms
                .iter()
                .position(|(term, _)| term == name)
                .map(|i| episode.terms[0][i])
                .unwrap()
        };
        let checkpoints = term("checkpoints/carried") + term("checkpoints/goal");
        // Tenths, except for the rounding of sums.
        assert!((checkpoints * 10.0 - (checkpoints * 10.0).round()).abs() < 1e-9, "{checkpoints}");
        assert!(checkpoints <= 1.0 + 1e-9);
        if episode.score[0] > 0 {
            assert!((checkpoints - 1.0).abs() < 1e-9, "{checkpoints}");
            assert_eq!(term("scoring/goal"), 1.0);
        }
    }
    let random = play_with("11_vs_11_easy_stochastic", Agent::Bot, 1, options);
    let carried: f64 = random
        .terms
        .iter()
        .filter(|(name, _)| name.starts_with("checkpoints"))
        .map(|(_, mean)| mean)
        .sum();
    assert!((0.0..=1.0 + 1e-9).contains(&carried), "{carried}");
}

#[test]
fn the_difficulty_is_felt() {
    let goals = |difficulty: f64| {
        let loaded = setpiece::load("11_vs_11_stochastic").unwrap();
        let bindings =
            setpiece::bind(&loaded.scenario, [("difficulty", difficulty.to_string().as_str())])
                .unwrap();
        let options =
            EnvironmentOptions { bindings: Some(bindings), ..EnvironmentOptions::default() };
        let [left, right] = play_with("11_vs_11_stochastic", Agent::Bot, 10, options).score;
        left - right
    };
    assert!(goals(0.05) > goals(1.0), "a weak opponent must lose by more");
}

#[test]
fn full_physics_plays_the_same_kind_of_match() {
    let options =
        EnvironmentOptions { physics: Some(Physics::Full), ..EnvironmentOptions::default() };
    let summary = play_with("academy_empty_goal_close", Agent::RunAndShoot, 40, options);
    assert!(summary.success_rate >= 0.95, "{:?}", summary.outcomes);
}

/// The digest of a fixed run is the same in debug and release, on any number of threads, on any
/// machine. It changes only with the physics, the game, or the library's scenarios.
#[test]
fn the_golden_digest_holds() {
    let mut text = String::new();
    for (name, agent, episodes) in [
        ("academy_3_vs_1_with_keeper", Agent::Random, 20),
        ("academy_corner", Agent::Bot, 5),
        ("11_vs_11_stochastic", Agent::Bot, 1),
    ] {
        let one = play(name, agent, episodes);
        let loaded = setpiece::load(name).unwrap();
        let options = RunOptions {
            episodes: 0..episodes,
            seed: 1,
            agent: agent.into(),
            threads: 1,
            environment: EnvironmentOptions::default(),
        };
        let single = run(&loaded.scenario, &options, |_| {}).unwrap();
        assert_eq!(one.digest, single.digest, "{name}: threads matter");
        text += &format!("{name} {:016x}\n", one.digest);
    }
    insta::assert_snapshot!("digests", text);
}
