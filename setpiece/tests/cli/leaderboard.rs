//! `setpiece leaderboard`: who is how good.

use super::{fails, folder, json, text_of, write};

/// Four a side for a minute and a half: who plays all outfield players shows who they are.
const SHORT: &str = "scenario short extends 5_vs_5 { end limit 90s }";

fn board(others: &[&str]) -> serde_json::Value {
    let folder = folder();
    let short = write(folder.path(), "short.pitch", SHORT);
    let agents = ["leaderboard", "idle", "random", "bot", "--scenario", &short, "-p", "4"];
    json(&[&agents[..], &["--format", "json"], others].concat())
}

#[test]
fn the_better_agent_stands_above_the_worse() {
    let board = board(&["-n", "8", "--seed", "1"]);
    let agents = board["agents"].as_array().unwrap();
    let elo = |agent: &serde_json::Value| agent["elo"]["value"].as_f64().unwrap();
    assert_eq!(agents[0]["agent"], "bot", "{board}");
    let [low, second] = [agents[0]["elo"]["low"].as_f64().unwrap(), elo(&agents[1])];
    assert!(low > second, "{board}");
    let mean = agents.iter().map(elo).sum::<f64>() / 3.0;
    assert!((mean - 1_000.0).abs() < 1e-6, "{mean}");
    for agent in agents {
        let played = ["won", "drawn", "lost"].map(|what| agent[what].as_u64().unwrap());
        assert_eq!(played.iter().sum::<u64>(), 2 * 16, "{agent}");
    }
    let pairs = board["pairs"].as_array().unwrap();
    let names: Vec<String> = pairs.iter().map(|pair| pair["agents"].to_string()).collect();
    assert_eq!(names, [r#"["idle","random"]"#, r#"["idle","bot"]"#, r#"["random","bot"]"#]);
    let goals = |of: &serde_json::Value| -> u64 {
        of["goals"].as_array().unwrap().iter().map(|it| it.as_u64().unwrap()).sum()
    };
    assert_eq!(agents.iter().map(goals).sum::<u64>(), 2 * pairs.iter().map(goals).sum::<u64>());
}

#[test]
fn threads_change_nothing_and_the_seed_does() {
    let one = board(&["-n", "2", "-t", "1"]);
    assert_eq!(one, board(&["-n", "2", "-t", "3"]));
    assert_ne!(one["digest"], board(&["-n", "2", "--seed", "1"])["digest"]);
}

#[test]
fn equals_share_the_wins() {
    let folder = folder();
    let short = write(folder.path(), "short.pitch", SHORT);
    let args = ["leaderboard", "bot", "bot", "--scenario", &short, "-p", "4", "-n", "10"];
    let board = json(&[&args[..], &["--format", "json"]].concat());
    for agent in board["agents"].as_array().unwrap() {
        let [low, high] = ["low", "high"].map(|end| agent["elo"][end].as_f64().unwrap());
        assert!(low <= 1_000.0 && 1_000.0 <= high, "{board}");
    }
    // Each has a name of its own.
    assert_eq!(board["pairs"][0]["agents"].to_string(), r#"["bot","bot (2)"]"#);
    let shown = text_of(&args);
    assert!(shown.contains("20 matches of each pair, 4 players each, seed 0"), "{shown}");
    assert!(shown.contains("  bot (2)  "), "{shown}");
}

/// Who wins both of two matches isn't known to win all.
#[test]
fn an_interval_of_few_matches_is_wide() {
    let board = json(
        &[
            &["leaderboard", "bot", "idle", "--scenario", "academy_empty_goal", "-n", "1"][..],
            &["--format", "json"],
        ]
        .concat(),
    );
    for agent in board["agents"].as_array().unwrap() {
        let [low, high] = ["low", "high"].map(|end| agent["elo"][end].as_f64().unwrap());
        assert!(high - low > 200.0, "{board}");
    }
}

#[test]
fn what_cannot_be_played_is_reported() {
    fails(&["leaderboard", "bot"], 2, &["2 values required"]);
    fails(&["leaderboard", "bot", "bott"], 2, &["FILE.onnx"]);
    let many = ["leaderboard", "bot", "idle", "--scenario", "5_vs_5", "-p", "9"];
    fails(&many, 1, &["SP0410", "4 controllable players"]);
    fails(&["leaderboard", "bot", "baseline"], 1, &["SP0024", "11_vs_11_kaggle"]);
}
