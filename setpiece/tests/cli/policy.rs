//! `--agent FILE.onnx` and `--agent baseline`: policies from files, and files that are none.

use super::{fails, folder, json, setpiece, text, write};
use std::path::Path;

const DRILL: &str = "academy_3_vs_1_with_keeper";

/// A network that always likes one action best, and what can be wrong with it.
#[derive(Clone, Copy)]
struct Linear {
    /// How many numbers it sees.
    inputs: u64,
    /// How many actions it rates.
    actions: usize,
    favourite: usize,
    operator: &'static str,
    metadata: &'static [(&'static str, &'static str)],
    weight: f32,
}

const LINEAR: Linear =
    Linear { inputs: 115, actions: 19, favourite: 0, operator: "Gemm", metadata: &[], weight: 0.0 };

/// A field of the format: its number and its bytes.
fn field(number: u64, bytes: impl AsRef<[u8]>) -> Vec<u8> {
    let bytes = bytes.as_ref();
    [varint(number << 3 | 2), varint(bytes.len() as u64), bytes.to_vec()].concat()
}

fn number(number: u64, value: u64) -> Vec<u8> {
    [varint(number << 3), varint(value)].concat()
}

fn varint(mut value: u64) -> Vec<u8> {
    let mut bytes = Vec::new();
    while value >= 0x80 {
        bytes.push(value as u8 | 0x80);
        value >>= 7;
    }
    bytes.push(value as u8);
    bytes
}

fn constant(name: &str, shape: &[u64], floats: &[f32]) -> Vec<u8> {
    let raw: Vec<u8> = floats.iter().flat_map(|it| it.to_le_bytes()).collect();
    let shape: Vec<u8> = shape.iter().flat_map(|&length| number(1, length)).collect();
    [shape, number(2, 1), field(8, name), field(9, raw)].concat()
}

/// A value of floats with a free batch axis.
fn value(name: &str, length: u64) -> Vec<u8> {
    let shape = [field(1, field(2, "batch")), field(1, number(1, length))].concat();
    let tensor = [number(1, 1), field(2, shape)].concat();
    [field(1, name), field(2, field(1, tensor))].concat()
}

impl Linear {
    fn bytes(self) -> Vec<u8> {
        let n = self.actions as u64;
        let mut bias = vec![0.0; self.actions];
        bias[self.favourite] = 1.0;
        let weights = vec![self.weight; self.inputs as usize * self.actions];
        let inputs = ["observation", "weights", "bias"].map(|name| field(1, name)).concat();
        let node = [inputs, field(2, "logits"), field(3, "last"), field(4, self.operator)].concat();
        let graph = [
            field(1, node),
            field(5, constant("weights", &[self.inputs, n], &weights)),
            field(5, constant("bias", &[n], &bias)),
            field(11, value("observation", self.inputs)),
            field(12, value("logits", n)),
        ];
        let metadata = self.metadata.iter();
        let metadata =
            metadata.map(|(key, said)| field(14, [field(1, key), field(2, said)].concat()));
        let metadata: Vec<u8> = metadata.flatten().collect();
        [number(1, 9), field(7, graph.concat()), field(8, number(2, 17)), metadata].concat()
    }

    fn write(self, folder: &Path) -> String {
        write(folder, "policy.onnx", self.bytes())
    }
}

/// A policy that always shoots.
pub(crate) fn shooting(folder: &Path) -> String {
    Linear { favourite: 12, ..LINEAR }.write(folder)
}

fn digest(agent: &str, others: &[&str]) -> serde_json::Value {
    let args = ["run", DRILL, "-n", "5", "--seed", "3", "--format", "json", "--agent", agent];
    json(&[&args[..], others].concat())["digest"].clone()
}

#[test]
fn a_policy_presses_the_action_of_the_greatest_logit() {
    let folder = folder();
    let idle = LINEAR.write(folder.path());
    assert_eq!(digest(&idle, &[]), digest("idle", &[]));
    // The 20th action hands the step over to the bot.
    let hands_over = Linear { actions: 20, favourite: 19, ..LINEAR }.write(folder.path());
    assert_eq!(digest(&hands_over, &[]), digest("bot", &[]));
    assert_eq!(digest(&hands_over, &["-t", "1"]), digest(&hands_over, &["-t", "3"]));
}

#[test]
fn the_observation_is_the_named_one_or_the_first_that_fits() {
    let folder = folder();
    let drill =
        "scenario mine extends academy_3_vs_1_with_keeper { observe vector { ball.x ball.y } }";
    let drill = write(folder.path(), "mine.pitch", drill);
    let plays = |policy: Linear| {
        let policy = policy.write(folder.path());
        let output = setpiece(&["run", &drill, "-n", "1", "--agent", &policy]);
        (output.status.success(), text(&output.stderr))
    };
    // Its own vector, `simple115v2`, with the held keys, and four of the latest at once.
    for inputs in [2, 115, 125, 460] {
        assert_eq!(plays(Linear { inputs, ..LINEAR }), (true, String::new()), "{inputs}");
    }
    let named: &[_] = &[("observation", "vector")];
    assert!(plays(Linear { inputs: 6, metadata: named, ..LINEAR }).0);
    let (fits, why) = plays(Linear { metadata: named, ..LINEAR });
    assert!(!fits && why.contains("sees 115 numbers of `vector`"), "{why}");
}

#[test]
fn every_command_that_plays_takes_a_policy() {
    let folder = folder();
    let policy = LINEAR.write(folder.path());
    let check = format!(
        "check \"nobody scores\" {{ play {DRILL} for 3 episodes expect success_rate < 1% }}"
    );
    let check = write(folder.path(), "checks.pitch", check);
    let out = |name: &str| folder.path().join(name).to_string_lossy().into_owned();
    let (picture, state) = (out("sheet.png"), out("state.pitchs"));
    let commands: [&[&str]; 5] = [
        &["run", DRILL, "-n", "2", "--beside", &policy],
        &["test", &check],
        &["render", DRILL, "-o", &picture],
        &["snapshot", DRILL, "--step", "5", "-o", &state],
        &["bench", DRILL, "--seconds", "0.01", "-t", "1"],
    ];
    for command in commands {
        let output = setpiece(&[command, &["--agent", &policy]].concat());
        assert!(output.status.success(), "{command:?}: {}", text(&output.stderr));
        // A picture says who played.
        if command[0] == "render" {
            assert!(text(&output.stdout).contains(&policy));
        }
    }
}

#[test]
fn files_that_are_no_policies_are_reported() {
    let folder = folder();
    let refused = |name: &str, content: &[u8], words: &[&str]| {
        let path = write(folder.path(), name, content);
        let words = [&["SP0023", name][..], words].concat();
        fails(&["run", DRILL, "--agent", &path], 1, &words);
    };
    let of = |linear: Linear| linear.bytes();
    refused("text.onnx", b"scenario", &["it is no ONNX model", "torch.onnx.export"]);
    refused("cut.onnx", &of(LINEAR)[..5_000], &["it is no ONNX model"]);
    refused(
        "wide.onnx",
        &of(Linear { inputs: 117, ..LINEAR }),
        &[
            "it sees 117 numbers, which `academy_3_vs_1_with_keeper` doesn't show",
            "`simple115v2` has 115",
        ],
    );
    refused("many.onnx", &of(Linear { actions: 33, ..LINEAR }), &["[1, 33]", "19 or 20 actions"]);
    refused(
        "unknown.onnx",
        &of(Linear { operator: "Det", ..LINEAR }),
        &["`last` needs the operator `Det`", "setpiece.evaluate"],
    );
    refused(
        "wrong.onnx",
        &of(Linear { operator: "Conv", ..LINEAR }),
        &["`last` (Conv) can't be computed", "expected pictures"],
    );
    let diverged = Linear { weight: f32::NAN, ..LINEAR };
    refused("nan.onnx", &of(diverged), &["it returns logits that are no numbers (NaN)"]);
    for said in ["0", "often", "-1", "1.5", "4000000000"] {
        let metadata = Box::leak(Box::new([("repeat", said)]));
        let bytes = of(Linear { metadata, ..LINEAR });
        refused("repeat.onnx", &bytes, &[said, "expected a number of steps"]);
    }
    let gone = folder.path().join("gone.onnx");
    fails(&["run", DRILL, "--agent", &gone.to_string_lossy()], 1, &["SP0001", "gone.onnx"]);
    let directory = folder.path().join("folder.onnx");
    std::fs::create_dir(&directory).unwrap();
    fails(&["run", DRILL, "--agent", &directory.to_string_lossy()], 1, &["SP0006"]);
    fails(&["run", DRILL, "--agent", "bott"], 2, &["FILE.onnx", "'bot'"]);
}

/// The folder of the policies in the box.
fn folder_of_policies() -> std::path::PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../baselines/policies")
}

#[test]
fn every_policy_in_the_box_is_small_and_plays_as_its_card_says() {
    let names: Vec<&str> = setpiece::baseline::baselines().collect();
    assert!(names.contains(&"academy_empty_goal_close"), "{names:?}");
    for name in names {
        let path = folder_of_policies().join(format!("{name}.onnx"));
        assert!(std::fs::metadata(&path).unwrap().len() <= 200_000, "{name}");
        let card = std::fs::read(path.with_extension("json")).unwrap();
        let card: serde_json::Value = serde_json::from_slice(&card).unwrap();
        assert_eq!(card["scenario"], name);
        let run = |agent: &str| {
            json(&["run", name, "--agent", agent, "-n", "100", "--seed", "7", "--format", "json"])
        };
        let (boxed, file) = (run("baseline"), run(&path.to_string_lossy()));
        assert_eq!(boxed["digest"], file["digest"], "{name}");
        // `doc` shows what the card says.
        let page = text(&setpiece(&["doc", name]).stdout);
        for words in ["does", "weaknesses"] {
            let words = card["words"][words].as_str().unwrap();
            assert!(!words.is_empty() && page.contains(words), "{name}: {page}");
        }
        // Half of it, so that not every change of the game needs new policies.
        let score =
            boxed["score"]["left"].as_f64().unwrap() - boxed["score"]["right"].as_f64().unwrap();
        let said = card["score"]["mean"].as_f64().unwrap();
        assert!(score > 0.5 * said, "{name}: {score}, its card says {said}");
    }
}

#[test]
fn a_scenario_without_a_baseline_says_which_have_one() {
    let words =
        ["SP0024", "`11_vs_11_easy_stochastic` has no baseline", "`academy_empty_goal_close`"];
    fails(&["run", "11_vs_11_easy_stochastic", "--agent", "baseline"], 1, &words);
}

/// A policy belongs to players and a start, not to a name.
#[test]
fn the_baseline_is_that_of_the_players_and_the_start() {
    let folder = folder();
    let digest = |name: &str, text: &str| {
        let path = write(folder.path(), "mine.pitch", text);
        let args = ["run", &path, "--scenario", name, "-n", "5", "-a", "baseline"];
        json(&[&args[..], &["--format", "json"]].concat())["digest"].clone()
    };
    let extends = |change: &str| format!("scenario mine extends {DRILL} {{ {change} }}");
    let usual = digest_of_baseline();
    let library = concat!(env!("CARGO_MANIFEST_DIR"), "/../stdlib-scenarios/academy");
    let library = std::fs::read_to_string(format!("{library}/{DRILL}.pitch")).unwrap();
    assert_eq!(digest(DRILL, &library), usual);
    assert_eq!(digest("mine", &extends("reward fast { give -0.01 }")), usual);
    // The limit is a number of the start program.
    for change in [
        "end success near when ball.x > 0.8",
        "end limit 30s",
        "end limit 1s",
        "param difficulty = 0.9",
        "team right { difficulty: 0.3 }",
        "let far = uniform(1m, 2m)",
    ] {
        digest("mine", &extends(change));
    }
}

fn digest_of_baseline() -> serde_json::Value {
    json(&["run", DRILL, "-n", "5", "-a", "baseline", "--format", "json"])["digest"].clone()
}

#[test]
fn another_scenario_of_the_same_name_has_no_baseline() {
    let folder = folder();
    let refused = |change: &str, what: &str| {
        let text = format!("scenario {DRILL} extends academy {{ {change} }}");
        let path = write(folder.path(), "mine.pitch", text);
        let words = ["SP0024", "isn't the library's of this name", what, "--agent FILE.onnx"];
        fails(&["run", &path, "--agent", "baseline"], 1, &words);
    };
    let players = "team left { GK at (-1.011, 0) CM at (0.6066, 0) CM at (0.7077, 0.2033) \
        CM at (0.7077, -0.2033) }";
    let (right, ball) = ("team right { GK at (1.011, 0) CB at (0.7583, 0) }", "ball at (0.62, 0)");
    refused(&format!("{ball} {right} team left {{ CM at (0.6, 0) }}"), "the number of players");
    let moved = players.replace("0.6066", "0.5");
    refused(&format!("{ball} {right} {moved}"), "player 2 (the left CM)");
    refused(&format!("ball at (0.6, 0) {players} {right}"), "the ball's start");
    refused(&format!("{ball} {players} {right} rules {{ offside: on }}"), "the rules");
}

#[test]
fn every_entry_of_a_suite_without_a_baseline_is_reported_at_once() {
    let folder = folder();
    let suite = "suite some {
        academy_empty_goal_close for 2 episodes
        academy_corner for 1000000 episodes
        academy_empty_goal for 2 episodes
        5_vs_5 for 2 episodes
    }";
    let suite = write(folder.path(), "some.pitch", suite);
    let words = [
        "SP0024",
        "2 of 4 entries have no baseline: `academy_corner`, `5_vs_5`",
        "`academy_empty_goal_close`",
    ];
    let played = setpiece(&["run", &suite, "-a", "baseline"]);
    assert!(played.stdout.is_empty());
    fails(&["run", &suite, "-a", "baseline"], 1, &words);
    fails(&["run", &suite, "-a", "idle", "--beside", "baseline"], 1, &words);
    let all = setpiece(&["run", "academy", "-a", "baseline"]);
    assert!(text(&all.stderr).contains("6 of 11 entries have no baseline"), "{all:?}");
}

#[test]
fn a_check_is_played_with_the_baseline() {
    let folder = folder();
    let check = "check \"it can be scored\" {
        play academy_empty_goal_close with baseline for 20 episodes
        expect success_rate > 90%
    }";
    let check = write(folder.path(), "checks.pitch", check);
    let shown = json(&["test", &check, "--format", "json"]);
    assert_eq!((&shown["agent"], &shown["holds"]), (&"baseline".into(), &true.into()), "{shown}");
}
