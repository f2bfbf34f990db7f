//! `setpiece studio`: the real server and its socket.
#![cfg(unix)]
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

use serde_json::{Value, json};
use std::io::{BufRead, BufReader, Write};
use std::net::TcpStream;
use std::path::PathBuf;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};
use tungstenite::client::IntoClientRequest;
use tungstenite::{Message, WebSocket};

const SCENARIO: &str = "scenario two {
    param gap: length = 8m in 3m..15m
    ball at (10m, 0m)
    team left { CF at (9m, 0m) }
    team right { CB at (10m + gap, 0m) }
    reward near { give 0.1 as \"step\" }
    end limit 20 steps
}
";
const PATIENCE: Duration = Duration::from_secs(20);

/// A running studio, ended with the test.
struct Studio {
    child: Child,
    port: u16,
    token: String,
    folder: tempfile::TempDir,
}

impl Drop for Studio {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

impl Studio {
    fn open() -> Studio {
        Studio::of("two.pitch")
    }

    fn of(scenario: &str) -> Studio {
        Studio::with(&[scenario], SCENARIO)
    }

    /// Opens sources beside a file `two.pitch` with this text.
    fn with(sources: &[&str], text: &str) -> Studio {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("two.pitch"), text).unwrap();
        let mut child = Command::new(env!("CARGO_BIN_EXE_setpiece"))
            .arg("studio")
            .args(sources)
            .current_dir(folder.path())
            .stdout(Stdio::piped())
            .spawn()
            .unwrap();
        let mut line = String::new();
        BufReader::new(child.stdout.take().unwrap()).read_line(&mut line).unwrap();
        let (port, token) = line
            .trim()
            .strip_prefix("open http://127.0.0.1:")
            .unwrap()
            .split_once("/?token=")
            .unwrap();
        Studio { child, port: port.parse().unwrap(), token: token.to_owned(), folder }
    }

    fn file(&self) -> PathBuf {
        self.folder.path().join("two.pitch")
    }

    /// The status of a plain request with these headers.
    fn status(&self, path: &str, headers: &str) -> u16 {
        let mut stream = TcpStream::connect(("127.0.0.1", self.port)).unwrap();
        write!(stream, "GET {path} HTTP/1.1\r\n{headers}\r\n").unwrap();
        let mut line = String::new();
        BufReader::new(stream).read_line(&mut line).unwrap();
        line.split(' ').nth(1).unwrap().parse().unwrap()
    }

    fn tab(&self) -> Tab {
        let address = format!("ws://127.0.0.1:{}/socket?token={}", self.port, self.token);
        let stream = TcpStream::connect(("127.0.0.1", self.port)).unwrap();
        stream.set_read_timeout(Some(PATIENCE)).unwrap();
        let (socket, _) =
            tungstenite::client(address.into_client_request().unwrap(), stream).unwrap();
        Tab(socket)
    }
}

/// A page's socket.
struct Tab(WebSocket<TcpStream>);

impl Tab {
    fn ask(&mut self, request: &Value) {
        self.0.send(Message::text(request.to_string())).unwrap();
    }

    /// The next message of a kind.
    fn hear(&mut self, kind: &str) -> Value {
        loop {
            let message = self.0.read().unwrap();
            let Message::Text(text) = message else { continue };
            let value: Value = serde_json::from_str(&text).unwrap();
            if value["type"] == kind {
                return value;
            }
        }
    }
}

/// Where the first player is at a step.
fn place(episode: &Value, step: usize) -> Value {
    let player = &episode["scenes"][step]["players"][0];
    json!([player[0], player[1]])
}

#[test]
fn a_page_gets_text_parameters_and_an_episode() {
    let studio = Studio::open();
    let mut tab = studio.tab();
    let opened = tab.hear("opened");
    assert_eq!((opened["text"].as_str(), &opened["is_file"]), (Some(SCENARIO), &json!(true)));
    let checked = tab.hear("checked");
    assert_eq!((&checked["problems"], &checked["name"]), (&json!([]), &json!("two")));
    assert_eq!(checked["params"][0]["range"], json!([3.0, 15.0]));
    let episode = tab.hear("episode");
    assert_eq!(episode["scenes"].as_array().unwrap().len(), 21);
    assert_eq!(episode["outcome"], "limit");
    let reward = episode["scenes"][1]["rewards"][0]["value"].as_f64().unwrap();
    assert!((reward - 0.1).abs() < 1e-6);
}

#[test]
fn a_mistake_is_reported_while_the_last_good_text_stays() {
    let studio = Studio::open();
    let (mut tab, mut other) = (studio.tab(), studio.tab());
    tab.hear("episode");
    other.hear("episode");
    tab.ask(&json!({"type": "text", "text": SCENARIO.replace("CB at", "CBB at")}));
    for page in [&mut tab, &mut other] {
        let checked = page.hear("checked");
        assert_eq!(checked["problems"][0]["code"], "SP0203", "{checked}");
        assert_eq!(checked["problems"][0]["labels"][0]["line"], 5);
        assert_eq!(checked["name"], "two");
    }
    tab.ask(&json!({"type": "text", "text": SCENARIO.replace("10m + gap", "30m")}));
    // The parameter is now of no use, which is a warning.
    let checked = tab.hear("checked");
    assert!(checked["problems"].as_array().unwrap().iter().all(|one| one["severity"] == "warning"));
    let episode = tab.hear("episode");
    let x = episode["scenes"][0]["players"][1][0].as_f64().unwrap();
    assert!((x - 30.0).abs() < 0.01, "{x}");
    // Nothing is written before somebody saves.
    assert_eq!(std::fs::read_to_string(studio.file()).unwrap(), SCENARIO);
    tab.ask(&json!({"type": "save"}));
    tab.hear("saved");
    assert!(std::fs::read_to_string(studio.file()).unwrap().contains("CB at (30m, 0m)"));
}

#[test]
fn a_file_saved_elsewhere_shows_its_start() {
    let studio = Studio::open();
    let mut tab = studio.tab();
    tab.hear("episode");
    std::thread::sleep(Duration::from_millis(50));
    std::fs::write(studio.file(), SCENARIO.replace("9m, 0m", "5m, 2m")).unwrap();
    let begin = Instant::now();
    assert!(tab.hear("opened")["text"].as_str().unwrap().contains("5m, 2m"));
    let episode = tab.hear("episode");
    assert_eq!(place(&episode, 0), json!([5.0, 2.0]));
    assert!(begin.elapsed() < PATIENCE / 4, "{:?}", begin.elapsed());
}

#[test]
fn parameters_seeds_clouds_and_summaries_follow_the_page() {
    let studio = Studio::open();
    let mut tab = studio.tab();
    tab.hear("episode");
    tab.ask(&json!({"type": "bind", "params": {"gap": 12.0}}));
    assert_eq!(tab.hear("checked")["params"][0]["shown"], "12m");
    let episode = tab.hear("episode");
    let x = episode["scenes"][0]["players"][1][0].as_f64().unwrap();
    assert!((x - 22.0).abs() < 0.01, "{x}");
    // A slider never leaves its range, whatever it says.
    tab.ask(&json!({"type": "bind", "params": {"gap": 1e9}}));
    assert_eq!(tab.hear("checked")["params"][0]["value"], 15.0);
    tab.ask(&json!({"type": "play", "seed": 7, "episode": 3, "agent": "idle"}));
    let played = tab.hear("episode");
    while_not(&mut tab, played, |value| value["seed"] == 7 && value["agent"] == "idle");
    tab.ask(&json!({"type": "cloud", "count": 12}));
    let cloud = tab.hear("cloud");
    assert_eq!(cloud["starts"].as_array().unwrap().len(), 12);
    assert_eq!(cloud["starts"][0].as_array().unwrap().len(), 3);
    tab.ask(&json!({"type": "summary", "episodes": 9}));
    let summary = tab.hear("summary");
    assert_eq!(summary["outcomes"], json!([["limit", 9]]));
    assert!((summary["mean_return"].as_f64().unwrap() - 2.0).abs() < 1e-6, "{summary}");
    tab.ask(&json!({"type": "play", "seed": 7, "episode": 3, "agent": "genius"}));
    let refused = tab.hear("refused");
    assert!(refused["message"].as_str().unwrap().contains("nobody is called `genius`"));
}

#[test]
fn a_policy_plays_at_the_beginning_and_may_be_chosen() {
    let policies = concat!(env!("CARGO_MANIFEST_DIR"), "/../baselines/policies/");
    let file = format!("{policies}academy_empty_goal_close.onnx");
    let studio = Studio::with(&["academy_empty_goal_close", "--agent", &file], SCENARIO);
    let mut tab = studio.tab();
    let players = tab.hear("checked")["players"].clone();
    assert_eq!(players, json!(["random", "idle", "run_and_shoot", "bot", "baseline", file]));
    let mut episode = tab.hear("episode");
    assert_eq!((&episode["agent"], &episode["success"]), (&json!(file), &json!(true)));
    tab.ask(&json!({"type": "play", "seed": 0, "episode": 0, "agent": "baseline"}));
    let mut same = tab.hear("episode");
    episode["agent"].take();
    same["agent"].take();
    assert_eq!(episode, same);
}

#[test]
fn a_scenario_without_a_baseline_offers_none() {
    let studio = Studio::open();
    let mut tab = studio.tab();
    let players = tab.hear("checked")["players"].clone();
    assert!(!players.as_array().unwrap().contains(&json!("baseline")), "{players}");
    tab.ask(&json!({"type": "play", "seed": 0, "episode": 0, "agent": "baseline"}));
    let message = tab.hear("refused")["message"].as_str().unwrap().to_owned();
    assert!(message.contains("nobody is called `baseline`"), "{message}");
}

const ZONES: &str = "
region danger = rect((30m, -12m), (44m, 12m)) | circle((25m, 0m), reach)
const reach = 6m
behavior waits { do hold }
scenario zones {
    param near: length = 25m in 1m..60m
    ball at (20m, 20m)
    team left { striker: CF in danger  RM at (19m, 20m) }
    team right { GK at own (-1, 0)  CB in right.box - right.six_yard }
    agents { left: [striker], right: 1 }
    require distance(striker, ball) < near
    end limit 20 steps
}
";

#[test]
fn regions_and_requirements_are_drawn_and_what_fails_is_marked() {
    let studio = Studio::with(&["two.pitch"], ZONES);
    let mut tab = studio.tab();
    let sketch = tab.hear("sketch");
    let regions = sketch["regions"].as_array().unwrap();
    let names: Vec<&str> = regions.iter().map(|one| one["name"].as_str().unwrap()).collect();
    assert_eq!(names, ["danger", "right.box - right.six_yard"]);
    let circle = json!({"circle": [[25.0, 0.0], 6.0]});
    assert_eq!(regions[0]["shape"]["union"][1], circle, "{sketch}");
    let written = sketch["requires"][0].clone();
    assert_eq!((&written["line"], &written["fails"]), (&json!(11), &json!(false)));
    let refused = written["refused"].as_f64().unwrap();
    assert!((0.2..0.9).contains(&refused), "{written}");
    // A parameter that no start can meet: the page says what fails, and keeps the last episode.
    tab.ask(&json!({"type": "bind", "params": {"near": 1.0}}));
    let sketch = tab.hear("sketch");
    assert_eq!(sketch["requires"][0]["fails"], true, "{sketch}");
    assert!(tab.hear("refused")["message"].as_str().unwrap().contains("distance(striker, ball)"));
}

#[test]
fn every_reply_has_the_pitch_of_its_episode_and_a_drag_ends_at_its_rim() {
    let text = SCENARIO
        .replace(
            "ball at",
            "pitch { length: uniform(40m, 80m), width: 30m, goal: 4m }\n    ball at",
        )
        .replace("gap,", "gap / 2,");
    let studio = Studio::with(&["two.pitch"], &text);
    let mut tab = studio.tab();
    let mut lengths = Vec::new();
    for seed in [1, 2, 3] {
        tab.ask(&json!({"type": "play", "seed": seed, "episode": 0, "agent": "idle"}));
        let first = tab.hear("episode");
        let episode = while_not(&mut tab, first, |value| value["seed"] == seed);
        let length = episode["pitch"]["length_m"].as_f64().unwrap();
        assert!((40.0..80.0).contains(&length), "{length}");
        assert_eq!(episode["pitch"]["width_m"], 30.0);
        assert_eq!(episode["pitch"]["goal_width_m"], 4.0);
        assert_eq!(tab.hear("sketch")["pitch"], episode["pitch"]);
        lengths.push(length);
    }
    assert!(lengths[0] != lengths[1] && lengths[1] != lengths[2], "{lengths:?}");
    let left = json!({"team": "left", "slot": 0});
    tab.ask(&json!({"type": "move", "player": left, "to": [99.0, 99.0]}));
    let episode = tab.hear("episode");
    let [x, y] = [0, 1].map(|axis| place(&episode, 0)[axis].as_f64().unwrap());
    assert!((x - lengths[2] / 2.0).abs() < 0.06 && (y - 15.0).abs() < 0.01, "{x} {y}");
}

#[test]
fn behaviours_play_and_two_policies_stand_side_by_side() {
    let studio = Studio::with(&["two.pitch"], ZONES);
    let mut tab = studio.tab();
    let checked = tab.hear("checked");
    let players = checked["players"].as_array().unwrap();
    assert!(players.contains(&json!("waits")) && players.contains(&json!("bot")), "{players:?}");
    assert_eq!(checked["agents"][0], json!({"id": "striker", "team": "left"}));
    tab.ask(&json!({
        "type": "play", "seed": 4, "episode": 1, "agent": "waits", "beside": "run_and_shoot"
    }));
    let first = tab.hear("episode");
    let first = if first["agent"] == "waits" { first } else { tab.hear("episode") };
    let second = tab.hear("episode");
    assert_eq!((&first["beside"], &second["beside"]), (&json!(false), &json!(true)));
    assert_eq!(second["agent"], "run_and_shoot");
    assert_eq!(place(&first, 0), place(&second, 0));
    let moved = |episode: &Value, player: usize| {
        let at = |step: usize, axis: usize| {
            episode["scenes"][step]["players"][player][axis].as_f64().unwrap()
        };
        let steps = 0..episode["scenes"].as_array().unwrap().len();
        let gap = |step| (at(step, 0) - at(0, 0)).hypot(at(step, 1) - at(0, 1));
        steps.take(40).map(gap).fold(0.0, f64::max)
    };
    // A player who waits is pushed at most; one without an agent plays as ever.
    assert!(moved(&first, 0) < 2.0, "{}", moved(&first, 0));
    assert!(moved(&second, 0) > 3.0, "{}", moved(&second, 0));
    assert!(moved(&first, 1) > 2.0, "{}", moved(&first, 1));
}

#[test]
fn an_episode_is_handed_over_as_a_file_that_plays_it_again() {
    let studio = Studio::open();
    let mut tab = studio.tab();
    tab.ask(&json!({"type": "play", "seed": 9, "episode": 2, "agent": "random"}));
    let first = tab.hear("episode");
    let episode = if first["seed"] == 9 { first } else { tab.hear("episode") };
    tab.ask(&json!({"type": "record"}));
    let recording = tab.hear("recording");
    assert_eq!(recording["name"], "two_9_2.pitchr");
    let hex = recording["hex"].as_str().unwrap();
    let bytes: Vec<u8> = (0..hex.len() / 2)
        .map(|at| u8::from_str_radix(&hex[2 * at..2 * at + 2], 16).unwrap())
        .collect();
    std::fs::write(studio.folder.path().join("one.pitchr"), &bytes).unwrap();
    let path = studio.folder.path().join("one.pitchr");
    let path = path.to_str().unwrap();
    let both = Studio::with(&[path, path], SCENARIO);
    let mut tab = both.tab();
    let (again, beside) = (tab.hear("episode"), tab.hear("episode"));
    assert_eq!(again["scenes"], episode["scenes"]);
    assert_eq!((&beside["beside"], &beside["scenes"]), (&json!(true), &episode["scenes"]));
}

#[test]
fn a_drag_rewrites_the_numbers_of_one_place() {
    let studio = Studio::open();
    let mut tab = studio.tab();
    tab.hear("episode");
    let left = json!({"team": "left", "slot": 0});
    tab.ask(&json!({"type": "move", "player": left, "to": [4.0, -6.27]}));
    let text = tab.hear("opened")["text"].as_str().unwrap().to_owned();
    assert_eq!(text, SCENARIO.replace("(9m, 0m)", "(4m, -6.3m)"));
    let episode = tab.hear("episode");
    assert_eq!(place(&episode, 0), json!([4.0, -6.3]));
    tab.ask(&json!({"type": "move", "player": null, "to": [12.0, 1.0]}));
    let text = tab.hear("opened")["text"].as_str().unwrap().to_owned();
    assert!(text.contains("ball at (12m, 1m)"), "{text}");
    // The defender's place depends on a parameter.
    let right = json!({"team": "right", "slot": 0});
    tab.ask(&json!({"type": "move", "player": right, "to": [1.0, 1.0]}));
    assert!(tab.hear("refused")["message"].as_str().unwrap().contains("computed"));
    let nobody = json!({"team": "left", "slot": 9});
    tab.ask(&json!({"type": "move", "player": nobody, "to": [1.0, 1.0]}));
    assert!(tab.hear("refused")["message"].as_str().unwrap().contains("isn't written"));
}

#[test]
fn the_ball_s_own_numbers_change_wherever_else_its_words_stand() {
    let text =
        SCENARIO.replace("    ball at", "    // the ball at (1, 2) is a comment\n    ball   at");
    let text = format!("abstract scenario base {{ ball at (3m, 3m) }}\n{text}");
    let studio = Studio::with(&["two.pitch"], &text);
    let mut tab = studio.tab();
    tab.hear("episode");
    tab.ask(&json!({"type": "move", "player": null, "to": [12.0, 99.0]}));
    let moved = tab.hear("opened")["text"].as_str().unwrap().to_owned();
    // What is dropped off the pitch lies on its rim.
    assert_eq!(moved, text.replace("(10m, 0m) \n", "").replacen("(10m, 0m)", "(12m, 36m)", 1));
    tab.ask(&json!({"type": "text", "text": moved.replace("team left", "tem left")}));
    tab.hear("checked");
    tab.ask(&json!({"type": "move", "player": null, "to": [1.0, 1.0]}));
    let refused = tab.hear("refused");
    assert!(refused["message"].as_str().unwrap().contains("mend the text"), "{refused}");
    // A slider doesn't hide what is wrong.
    tab.ask(&json!({"type": "bind", "params": {"gap": 4.0}}));
    assert_eq!(tab.hear("checked")["problems"].as_array().unwrap().len(), 1);
}

#[test]
fn a_place_of_the_parent_is_not_moved_for_its_child() {
    let text = format!("{SCENARIO}scenario later extends two {{ ball at (5m, 0m) }}\n");
    let studio = Studio::with(&["two.pitch"], &text);
    let mut tab = studio.tab();
    tab.hear("episode");
    let left = json!({"team": "left", "slot": 0});
    tab.ask(&json!({"type": "move", "player": left, "to": [1.0, 1.0]}));
    let refused = tab.hear("refused");
    assert!(refused["message"].as_str().unwrap().contains("inherited from `two`"), "{refused}");
    tab.ask(&json!({"type": "move", "player": null, "to": [6.0, 1.0]}));
    let moved = tab.hear("opened")["text"].as_str().unwrap().to_owned();
    assert_eq!(moved, text.replace("(5m, 0m)", "(6m, 1m)"));
}

#[test]
fn what_one_tab_types_the_others_show() {
    let studio = Studio::open();
    let (mut tab, mut other) = (studio.tab(), studio.tab());
    assert_eq!(other.hear("opened")["is_saved"], true);
    tab.ask(&json!({"type": "text", "text": format!("{SCENARIO}// mine\n"), "from": "a"}));
    let opened = other.hear("opened");
    assert!(opened["text"].as_str().unwrap().ends_with("// mine\n"));
    assert_eq!((&opened["from"], &opened["is_saved"]), (&json!("a"), &json!(false)));
    other.ask(&json!({"type": "save"}));
    other.hear("saved");
    assert_eq!(studio.tab().hear("opened")["is_saved"], true);
}

#[test]
fn many_changes_are_played_once_and_many_episodes_stop_nothing() {
    let studio = Studio::of("11_vs_11_stochastic");
    let mut tab = studio.tab();
    tab.hear("episode");
    tab.ask(&json!({"type": "summary", "episodes": 1000}));
    for step in 0..40 {
        tab.ask(&json!({"type": "bind", "params": {"difficulty": f64::from(step) / 40.0}}));
    }
    tab.ask(&json!({"type": "play", "seed": 5, "episode": 0, "agent": "idle"}));
    let mut episodes = 1;
    while tab.hear("episode")["seed"] != 5 {
        episodes += 1;
    }
    assert!(episodes < 10, "{episodes} episodes were played");
    // A new tab is served while the thousand go on.
    studio.tab().hear("checked");
}

#[test]
fn a_person_plays_a_goal_by_hand() {
    let studio = Studio::of("academy_empty_goal_close");
    let (mut tab, mut other) = (studio.tab(), studio.tab());
    tab.hear("episode");
    other.hear("episode");
    for (seats, why) in [
        (json!([]), "1 to 4 people"),
        (json!(["right_0"]), "no agent `right_0`"),
        (json!(["left_0", "left_0"]), "two people"),
    ] {
        tab.ask(&json!({"type": "begin", "seats": seats}));
        assert!(tab.hear("refused")["message"].as_str().unwrap().contains(why));
    }
    tab.ask(&json!({"type": "begin", "seats": ["left_0"]}));
    assert_eq!(tab.hear("step")["scenes"][0]["step"], 0);
    let begin = Instant::now();
    tab.ask(&json!({"type": "hold", "seat": 0, "keys": {"way": [1, 0], "held": ["sprint"]}}));
    let step = tab.hear("step");
    assert_eq!(step["scenes"][0]["step"], 1);
    for page in [&mut tab, &mut other] {
        let episode = page.hear("episode");
        assert_eq!((&episode["agent"], &episode["outcome"]), (&json!("you"), &json!("scored")));
        let length = episode["scenes"].as_array().unwrap().len();
        assert!((10..60).contains(&length), "{length}");
    }
    // At the pace of the match.
    assert!(begin.elapsed() > Duration::from_secs(1), "{:?}", begin.elapsed());
    // Whoever stops can watch what they have played.
    tab.ask(&json!({"type": "begin", "seats": ["left_0"]}));
    tab.hear("step");
    tab.ask(&json!({"type": "stop"}));
    assert_eq!(tab.hear("episode")["outcome"], Value::Null);
}

#[test]
fn a_recorded_episode_is_shown_as_it_was_played() {
    use setpiece::engine::environment::{Environment, EnvironmentOptions, Scratch};
    use setpiece::replay::{Recorder, Replay};
    use setpiece::scenario::Action;
    let scenario = setpiece::load("academy_corner").unwrap().scenario;
    let mut environment = Environment::new(scenario, EnvironmentOptions::default()).unwrap();
    let (mut recorder, mut scratch) = (Recorder::default(), Scratch::default());
    environment.reset(Some(7), Some(2)).unwrap();
    recorder.begin(None);
    for _ in 0..9 {
        recorder.note(Action::HighPass, None);
        environment.step(&[Action::HighPass], &mut scratch).unwrap();
    }
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.pitchr");
    let replay = Replay::of(&environment, &recorder).unwrap();
    std::fs::write(&path, replay.to_bytes().unwrap()).unwrap();
    let studio = Studio::of(path.to_str().unwrap());
    let mut tab = studio.tab();
    let opened = tab.hear("opened");
    assert_eq!((&opened["text"], &opened["is_file"]), (&json!(""), &json!(false)));
    let episode = tab.hear("episode");
    assert_eq!((&episode["seed"], &episode["episode"]), (&json!(7), &json!(2)));
    let ball: [f32; 3] = serde_json::from_value(episode["scenes"][9]["ball"].clone()).unwrap();
    for (shown, is) in ball.into_iter().zip(environment.state().ball.pos.to_array()) {
        // Centimetres are enough to look at.
        assert!((shown - is).abs() < 0.006, "{shown} instead of {is}");
    }
    // A recording has no text to change.
    tab.ask(&json!({"type": "move", "player": null, "to": [0, 0]}));
    tab.hear("refused");
}

/// Reads episodes until one is as wanted.
fn while_not(tab: &mut Tab, first: Value, wanted: impl Fn(&Value) -> bool) -> Value {
    let mut value = first;
    while !wanted(&value) {
        value = tab.hear("episode");
    }
    value
}

#[test]
fn a_level_opens_with_its_parameters_and_its_episode() {
    let studio = Studio::of("two.pitch{gap=12m}#7:3");
    let mut tab = studio.tab();
    assert_eq!(tab.hear("opened")["is_file"], true);
    assert_eq!(tab.hear("checked")["params"][0]["shown"], "12m");
    let episode = tab.hear("episode");
    assert_eq!((&episode["seed"], &episode["episode"]), (&json!(7), &json!(3)));
    let x = episode["scenes"][0]["players"][1][0].as_f64().unwrap();
    assert!((x - 22.0).abs() < 0.01, "{x}");
}

#[test]
fn garbage_ends_nothing() {
    let studio = Studio::open();
    let mut tab = studio.tab();
    tab.hear("episode");
    for garbage in ["", "{", "null", "[1]", r#"{"type":"text"}"#, r#"{"type":"bind","params":3}"#] {
        tab.0.send(Message::text(garbage)).unwrap();
        assert!(tab.hear("refused")["message"].as_str().unwrap().starts_with("not a request"));
    }
    // Binary data and a message that is too large end that tab alone.
    let mut binary = studio.tab();
    binary.0.send(Message::binary(vec![1, 2, 3])).unwrap();
    while binary.0.read().is_ok() {}
    let mut large = studio.tab();
    let _ = large.0.send(Message::text("x".repeat(4 << 20)));
    while large.0.read().is_ok() {}
    tab.ask(&json!({"type": "summary", "episodes": 1}));
    tab.hear("summary");
}

#[test]
fn only_its_own_page_is_served() {
    let studio = Studio::open();
    let own = format!("Host: 127.0.0.1:{}\r\n", studio.port);
    let page = format!("/?token={}", studio.token);
    assert_eq!(studio.status(&page, &own), 200);
    assert_eq!(studio.status("/studio.js", &own), 200);
    assert_eq!(studio.status("/", &own), 403);
    assert_eq!(studio.status("/?token=wrong", &own), 403);
    assert_eq!(studio.status(&page, "Host: evil.example\r\n"), 403);
    let foreign = format!("{own}Origin: http://evil.example\r\n");
    assert_eq!(studio.status(&page, &foreign), 403);
    assert_eq!(studio.status("/studio.js", &foreign), 403);
    assert_eq!(studio.status("/etc/passwd", &own), 404);
    let upgrade = "Connection: Upgrade\r\nUpgrade: websocket\r\nSec-WebSocket-Version: 13\r\n\
                   Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n";
    let socket = format!("/socket?token={}", studio.token);
    assert_eq!(studio.status("/socket?token=wrong", &format!("{own}{upgrade}")), 403);
    assert_eq!(studio.status(&socket, &format!("{foreign}{upgrade}")), 403);
}

#[test]
fn a_tab_that_stops_reading_stops_nothing() {
    let studio = Studio::open();
    let silent: Vec<Tab> = (0..9).map(|_| studio.tab()).collect();
    let mut tab = studio.tab();
    tab.hear("episode");
    for episode in 0..150 {
        tab.ask(&json!({"type": "play", "seed": 1, "episode": episode, "agent": "bot"}));
    }
    let first = tab.hear("episode");
    while_not(&mut tab, first, |value| value["episode"] == 149);
    drop(silent);
}

#[test]
fn an_interrupt_ends_it_with_the_port_free() {
    let mut studio = Studio::open();
    let mut tab = studio.tab();
    tab.hear("episode");
    let id = studio.child.id().to_string();
    assert!(Command::new("kill").args(["-INT", &id]).status().unwrap().success());
    assert!(studio.child.wait().unwrap().success());
    std::net::TcpListener::bind(("127.0.0.1", studio.port)).unwrap();
}

#[test]
fn what_cannot_be_opened_or_served_is_one_clear_error() {
    let run = |args: &[&str]| {
        let output = Command::new(env!("CARGO_BIN_EXE_setpiece")).args(args).output().unwrap();
        (output.status.code(), String::from_utf8(output.stderr).unwrap())
    };
    let (code, why) = run(&["studio", "academy_cornr"]);
    assert!(code == Some(1) && why.contains("SP0005") && why.contains("academy_corner"), "{why}");
    let (code, why) = run(&["studio", "academy_corner{gapp=3}#1"]);
    assert!(code == Some(1) && why.contains("gapp"), "{why}");
    let taken = std::net::TcpListener::bind(("127.0.0.1", 0)).unwrap();
    let port = taken.local_addr().unwrap().port().to_string();
    let (code, why) = run(&["studio", "academy_corner", "--port", &port]);
    assert!(code == Some(1) && why.contains("SP0018") && why.contains("--port"), "{why}");
}
