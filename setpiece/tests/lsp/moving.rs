//! Dragging in the drawn start: the request that answers with the two numbers of a place.

use super::{Client, URI};
use serde_json::{Value, json};

/// A parent with a place, a formation, and three scenarios; the one in the middle is drawn.
const SEVERAL: &str = "\
abstract scenario base extends academy {
    ball at (0.5, 0)
    team left {
        anna: CF at (0.45, 0)
        GK at (-1, 0)
    }
}
formation block {
    GK at (-1, 0)
    stopper: CB at (-0.5, 0.1)
}
scenario first extends base {
    team left { place GK at (-50m, 0m) }
}
scenario drawn extends base {
    param lane = 0.1 in 0..0.4
    ball at (10m, 0m)
    team left {
        bert: CM at (0.2, 0.1) jitter 2m
        cora: CM at (0.2, lane)
    }
    team right {
        formation: block
        dora: CB at own (-10m, 20m)
        emma: RB at (30m, 20m)
        CB in right.box
    }
}
scenario last extends base { ball at (0, 0) }
";

/// A text that is open, and what moves in one of its scenarios.
struct Drawn {
    client: Client,
    text: String,
    picture: Value,
}

impl Drawn {
    /// Opens a text and draws the scenario behind some words.
    fn open(text: &str, words: &str) -> Drawn {
        let mut client = Client::new();
        client.open(URI, text);
        for (uri, problems) in client.published() {
            assert!(problems.is_empty(), "{uri}: {problems:?}");
        }
        let before = &text[..text.find(words).expect(words)];
        let line = before.matches('\n').count();
        let place = json!({ "line": line, "character": 0 });
        let asked = json!({ "textDocument": { "uri": URI }, "position": place });
        let picture = client.result("setpiece/preview", asked);
        Drawn { client, text: text.to_owned(), picture }
    }

    fn thing(&self, name: &str) -> Value {
        let things = self.picture["things"].as_array().expect("a picture");
        things.iter().find(|it| it["name"] == name).expect(name).clone()
    }

    /// What the server answers if somebody is dragged.
    fn drag(&mut self, name: &str, to: [f64; 2]) -> Value {
        let asked = json!({
            "textDocument": { "uri": URI, "version": self.picture["version"] },
            "scenario": self.picture["scenario"], "player": self.thing(name)["player"], "to": to,
        });
        self.client.result("setpiece/move", asked)
    }

    /// The text after somebody was dragged, made of the edits as an editor makes them, and the
    /// numbers that were replaced.
    fn moved(&mut self, name: &str, to: [f64; 2]) -> (String, Vec<String>) {
        let answer = self.drag(name, to);
        assert_eq!(answer["version"], self.picture["version"], "{answer}");
        let edits = answer["edits"].as_array().expect("edits");
        let units: Vec<u16> = self.text.encode_utf16().collect();
        let newline = u16::from(b'\n');
        let unit = |at: &Value| {
            let line = at["line"].as_u64().unwrap() as usize;
            let begins = units.iter().enumerate().filter(|(_, unit)| **unit == newline);
            let begin =
                if line == 0 { 0 } else { begins.map(|(at, _)| at).nth(line - 1).unwrap() + 1 };
            begin + at["character"].as_u64().unwrap() as usize
        };
        let (mut after, mut replaced, mut from) = (Vec::new(), Vec::new(), 0);
        for edit in edits {
            let range = unit(&edit["range"]["start"])..unit(&edit["range"]["end"]);
            after.extend_from_slice(&units[from..range.start]);
            after.extend(edit["newText"].as_str().unwrap().encode_utf16());
            replaced.push(String::from_utf16(&units[range.clone()]).unwrap());
            from = range.end;
        }
        after.extend_from_slice(&units[from..]);
        (String::from_utf16(&after).unwrap(), replaced)
    }

    /// Drags somebody, checks that only their two numbers change, and that the new text has them
    /// where they were dropped.
    fn lands(&mut self, name: &str, to: [f64; 2], numbers: [&str; 2], instead: &str) {
        let (text, replaced) = self.moved(name, to);
        assert_eq!(replaced, numbers, "{name}");
        let line = |text: &str, wanted: &str| {
            text.lines().find(|line| line.contains(wanted)).map(str::to_owned)
        };
        assert!(line(&text, instead).is_some(), "{name}: no {instead} in\n{text}");
        let scenario = self.picture["scenario"].as_str().unwrap();
        let after = Drawn::open(&text, &format!("scenario {scenario}"));
        let at = [0, 1].map(|axis| after.thing(name)["at"][axis].as_f64().unwrap());
        let far = (at[0] - to[0]).hypot(at[1] - to[1]);
        assert!(far < 0.08, "{name} was dropped at {to:?} and stands at {at:?}");
    }

    fn refusal(&mut self, name: &str) -> String {
        let answer = self.drag(name, [1.0, 2.0]);
        assert!(answer.get("edits").is_none(), "{answer}");
        answer["message"].as_str().expect("a sentence").to_owned()
    }
}

#[test]
fn who_is_dragged_lands_where_they_are_dropped() {
    let mut drawn = Drawn::open(SEVERAL, "scenario drawn");
    assert_eq!(drawn.picture["scenario"], "drawn");
    drawn.lands("ball", [12.34, -5.0], ["10m", "0m"], "    ball at (12.3m, -5m)");
    // Of a jitter, the middle moves by as much as the player.
    let [x, y] = [0, 1].map(|axis| drawn.thing("bert")["at"][axis].as_f64().unwrap());
    drawn.lands("bert", [x - 5.44, y + 8.36], ["0.2", "0.1"], "bert: CM at (0.1, 0.2) jitter");
    let mut first = Drawn::open(SEVERAL, "scenario first");
    first.lands("GK", [-45.0, 3.0], ["-50m", "0m"], "place GK at (-45m, 3m)");
}

#[test]
fn the_right_team_s_own_frame_is_turned() {
    let mut drawn = Drawn::open(SEVERAL, "scenario drawn");
    let place = drawn.thing("dora")["at"].clone();
    assert_eq!(place, json!([10.0, -20.0]));
    drawn.lands("dora", [15.0, -25.0], ["-10m", "20m"], "dora: CB at own (-15m, 25m)");
    drawn.lands("emma", [15.0, 25.0], ["30m", "20m"], "emma: RB at (15m, 25m)");
    // A formation is in the own frame without the word.
    drawn.lands("stopper", [5.44, -16.72], ["-0.5", "0.1"], "stopper: CB at (-0.1, 0.2)");
    let high = "formation high extends block { place stopper at (-0.3, 0.1) }\nscenario first";
    let text = SEVERAL.replacen("scenario first", high, 1);
    let text = text.replacen("formation: block", "formation: high", 1);
    let mut drawn = Drawn::open(&text, "scenario drawn");
    drawn.lands("stopper", [5.44, -16.72], ["-0.3", "0.1"], "place stopper at (-0.1, 0.2)");
}

#[test]
fn what_the_scenario_doesn_t_write_as_numbers_is_refused_in_words() {
    let mut drawn = Drawn::open(SEVERAL, "scenario drawn");
    assert!(drawn.refusal("cora").contains("computed"));
    assert!(drawn.refusal("CB").contains("computed"));
    let mut first = Drawn::open(SEVERAL, "scenario first");
    let inherited = "this place is inherited from `base`: move it there, or write it in `first`";
    assert_eq!(first.refusal("anna"), inherited);
    assert_eq!(first.refusal("ball"), inherited);
    let mut last = Drawn::open(SEVERAL, "scenario last");
    last.lands("ball", [5.44, 0.0], ["0", "0"], "last extends base { ball at (0.1, 0) }");
    // In the picture the left team receives, and has the places of the other layout.
    let text = "\
formation kicks { CB at (-0.5, 0.1) }
formation waits { CB at (-0.4, 0.1) }
scenario kicked_off extends academy {
    ball at centre
    agents { left: 0, right: 0 }
    kickoff right { kicking: kicks, receiving: waits }
}
";
    let mut kicked_off = Drawn::open(text, "scenario kicked_off");
    let why = "another statement gives this place: edit the text";
    assert_eq!(kicked_off.refusal("CB"), why);
    // Of the library.
    let text = "scenario corner extends academy_corner { end limit 9s }\n";
    let mut corner = Drawn::open(text, "scenario corner");
    let why = corner.refusal("ball");
    assert!(why.starts_with("this place isn't written in this file, but in `std/"), "{why}");
}

#[test]
fn a_mirror_turns_what_is_written() {
    for (mirror, place, right) in [
        ("flanks", "(10m, -4m)", "own (5m, 6m)"),
        ("ends", "(-10m, -4m)", "own (-5m, 6m)"),
        ("none", "(10m, 4m)", "own (5m, -6m)"),
    ] {
        let text =
            SEVERAL.replacen("    param lane", &format!("    mirror: {mirror}\n    param lane"), 1);
        let mut drawn = Drawn::open(&text, "scenario drawn");
        drawn.lands("ball", [10.0, 4.0], ["10m", "0m"], &format!("ball at {place}"));
        drawn.lands("dora", [-5.0, 6.0], ["-10m", "20m"], &format!("dora: CB at {right}"));
    }
}

#[test]
fn ranges_count_as_editors_do() {
    // A sign of two units and one of two bytes stand before the numbers, and lines end in \r\n.
    let text = SEVERAL
        .replacen("formation block", "// \u{1d4d0}\u{fc}\nformation block", 1)
        .replacen(
            "    ball at (10m, 0m)\n",
            "    require ball.x > -2 as \"\u{fc}ber \u{1d4d0}\" ball at (10m, 0m) // \u{1d4d0}\n",
            1,
        )
        .replace('\n', "\r\n");
    let mut drawn = Drawn::open(&text, "scenario drawn");
    let (after, replaced) = drawn.moved("ball", [-7.0, 1.26]);
    assert_eq!(replaced, ["10m", "0m"]);
    assert_eq!(after, text.replacen("(10m, 0m)", "(-7m, 1.3m)", 1));
}

#[test]
fn a_pitch_of_another_size_keeps_the_scale_and_has_its_own_rim() {
    let size = "    pitch { length: 60m, width: 40m, goal: 5m }\n    param lane";
    let text = SEVERAL.replacen("    param lane", size, 1);
    let text = text.replace("GK at (-1, 0)", "GK at (-0.5, 0)").replace("(30m, 20m)", "(20m, 15m)");
    let text = text.replace("CB in right.box", "CB in right.box { overlap: allowed }");
    let mut drawn = Drawn::open(&text, "scenario drawn");
    assert_eq!(drawn.picture["view"], json!([-34.5, -24.5, 69.0, 49.0]));
    // Numbers of a formation are stretched over the pitch.
    let to = [5.44 * 60.0 / 110.0, -16.72 * 40.0 / 72.0];
    drawn.lands("stopper", to, ["-0.5", "0.1"], "stopper: CB at (-0.1, 0.2)");
    drawn.lands("emma", [15.0, 10.0], ["20m", "15m"], "emma: RB at (15m, 10m)");
    let (after, _) = drawn.moved("ball", [99.0, -99.0]);
    assert_eq!(after, text.replacen("(10m, 0m)", "(30m, -20m)", 1));
}

#[test]
fn only_the_text_that_was_drawn_is_edited() {
    let mut drawn = Drawn::open(SEVERAL, "scenario drawn");
    let changed = SEVERAL.replacen("ball at (0.5, 0)", "ball at (0.5, 0.1)", 1);
    let change = |version: i32, text: &str| {
        json!({ "textDocument": { "uri": URI, "version": version },
            "contentChanges": [{ "text": text }] })
    };
    drawn.client.say("textDocument/didChange", change(2, &changed));
    assert!(drawn.refusal("ball").contains("has changed"));
    drawn.picture["version"] = Value::Null;
    assert!(drawn.refusal("ball").contains("has changed"));
    drawn.picture["version"] = 2.into();
    assert!(drawn.drag("ball", [1.0, 2.0])["edits"].is_array());
    drawn.picture["scenario"] = "gone".into();
    assert!(drawn.refusal("ball").contains("can't be compiled"));
    drawn.picture["scenario"] = "drawn".into();
    let broken = changed.replacen("team left", "tem left", 1);
    drawn.client.say("textDocument/didChange", change(3, &broken));
    drawn.picture["version"] = 3.into();
    assert!(drawn.refusal("ball").contains("in the text"));
    let nobody = json!({ "textDocument": { "uri": URI, "version": 3 }, "scenario": "drawn",
        "player": { "team": "middle", "slot": 0 }, "to": [0, 0] });
    assert!(drawn.client.ask("setpiece/move", nobody).response_result.is_err());
}

/// A line that every start must meet, with a player on either side of it.
const ASKED: &str = "\
scenario other extends academy { ball at (0, 0)  team left { CM at (0.1, 0) } }
scenario asked extends academy {
    ball at (0.5, 0)
    team left {
        anna: CM at (2e-1, 0.1)
        bert: CM at ((0.3, 0.1))
        cora: CM at (uniform(0, 0.4), -0.1)
    }
    require anna in circle(centre, 25m)
    require cora.x < 0.3 as \"cora stays back\"
}
";

#[test]
fn requirements_are_drawn_and_a_drop_that_breaks_one_is_refused() {
    let mut drawn = Drawn::open(ASKED, "scenario asked");
    let svg = drawn.picture["svg"].as_str().unwrap();
    assert!(svg.contains("<circle cx=\"0.00\" cy=\"0.00\" r=\"25.00\""), "{svg}");
    let requires = drawn.picture["requires"].as_array().unwrap();
    let [circle, back] = requires.as_slice() else { panic!("{requires:?}") };
    assert_eq!(circle["label"], "anna in circle(centre, 25m)");
    assert_eq!((&circle["share"], &circle["fails"]), (&json!(0.0), &json!(false)));
    assert_eq!(back["label"], "cora stays back");
    let share = back["share"].as_f64().unwrap();
    assert!((0.15..0.35).contains(&share), "{share}");
    assert!(drawn.picture.get("message").is_none());
    drawn.lands("anna", [5.44, 16.72], ["2e-1", "0.1"], "anna: CM at (0.1, 0.2)");
    drawn.lands("bert", [5.44, 16.72], ["0.3", "0.1"], "bert: CM at ((0.1, 0.2))");
    let mut refused = |to: [f64; 2]| drawn.drag("anna", to)["message"].as_str().map(str::to_owned);
    assert_eq!(
        refused([30.0, 0.0]).as_deref(),
        Some("not there: `anna in circle(centre, 25m)` fails")
    );
    assert!(refused([16.32, 8.36]).is_some_and(|why| why.starts_with("not there: ")));
    assert_eq!(refused([24.0, 0.0]), None);
}

#[test]
fn a_start_that_no_episode_has_is_drawn_as_it_is_written() {
    let text = ASKED.replacen("uniform(0, 0.4)", "0.35", 1);
    let mut client = Client::new();
    client.open(URI, &text);
    let place = json!({ "line": 3, "character": 0 });
    let asked = json!({ "textDocument": { "uri": URI }, "position": place });
    let picture = client.result("setpiece/preview", asked);
    let why = picture["message"].as_str().unwrap();
    let mut drawn = Drawn { client, text, picture: picture.clone() };
    assert!(why.contains("cora stays back"), "{why}");
    let failing = json!({ "label": "cora stays back", "share": null, "fails": true });
    assert_eq!(picture["requires"][1], failing);
    // It can be mended by hand, also in several moves.
    drawn.lands("cora", [13.6, -8.36], ["0.35", "-0.1"], "cora: CM at (0.25, -0.1)");
    assert!(drawn.drag("anna", [0.0, 0.0])["edits"].is_array());
}

#[test]
fn whatever_the_drawn_start_does_not_meet_fails() {
    let text = "\
scenario asked extends academy {
    let far = normal(0, 0.01)
    ball at (0.5, 0)
    team left { anna: CM at (0.2, far) }
    require far > 0.9
    require far > 0.95 as \"farther\"
    require far < 0.99 as \"not there\"
}
";
    let picture = Drawn::open(text, "scenario asked").picture;
    assert!(picture["message"].is_string(), "{picture}");
    // The first refuses every attempt, so that none comes to the second; neither holds.
    assert_eq!(
        picture["requires"],
        json!([
            { "label": "far > 0.9", "share": 1.0, "fails": true },
            { "label": "farther", "share": 0.0, "fails": true },
            { "label": "not there", "share": 0.0, "fails": false },
        ])
    );
    // Nothing is measured of one that can't be read.
    let mut client = Client::new();
    client.open(URI, &ASKED.replacen("cora.x < 0.3", "cora.z < 0.3", 1));
    let place = json!({ "line": 3, "character": 0 });
    let asked = json!({ "textDocument": { "uri": URI }, "position": place });
    let picture = client.result("setpiece/preview", asked);
    assert_eq!(
        picture["requires"],
        json!([
            { "label": "anna in circle(centre, 25m)", "share": 0.0, "fails": false },
            { "label": "cora stays back", "share": null, "fails": true },
        ])
    );
}

#[test]
fn errors_of_other_items_leave_the_picture() {
    let broken = ASKED.replacen("CM at (0.1, 0) } }", "CMM at (0.1, 0) } }\nformation f { ? }", 1);
    let mut client = Client::new();
    client.open(URI, &broken);
    let mut preview = |line: u32| {
        let place = json!({ "line": line, "character": 0 });
        let asked = json!({ "textDocument": { "uri": URI }, "position": place });
        client.result("setpiece/preview", asked)
    };
    let picture = preview(4);
    assert!(picture["svg"].is_string(), "{picture}");
    assert_eq!(preview(0)["message"], "2 errors in the text");
    let mut drawn = Drawn { client, text: broken, picture };
    let (after, replaced) = drawn.moved("anna", [0.0, 0.0]);
    assert_eq!(replaced, ["2e-1", "0.1"]);
    assert!(after.contains("anna: CM at (0, 0)") && after.contains("CMM at"));
    // Not those of what it extends or uses.
    let parent = SEVERAL.replacen("ball at (0.5, 0)", "ball at (0.5, 0, 3)", 1);
    let mut client = Client::new();
    client.open(URI, &parent);
    let place = json!({ "line": 15, "character": 0 });
    let asked = json!({ "textDocument": { "uri": URI }, "position": place });
    let picture = client.result("setpiece/preview", asked);
    assert!(picture["message"].as_str().is_some_and(|why| why.contains("in the text")));
}

#[test]
fn a_formation_of_both_teams_is_left_alone() {
    let text = SEVERAL.replacen(
        "        bert: CM at (0.2, 0.1) jitter 2m",
        "        formation: block\n        bert: CM at (0.2, 0.1)",
        1,
    );
    let mut drawn = Drawn::open(&text, "scenario drawn");
    let why = "the left team has the same formation, whose player would move, too: edit the text";
    let stoppers = drawn.picture["things"].as_array().unwrap().iter();
    let right = stoppers.filter(|it| (it["at"][0].as_f64().unwrap() - 27.2).abs() < 0.01);
    let player = right.map(|it| it["player"].clone()).next().expect("one of either team");
    let asked = json!({
        "textDocument": { "uri": URI, "version": drawn.picture["version"] },
        "scenario": "drawn", "player": player, "to": [1.0, 2.0],
    });
    assert_eq!(drawn.client.result("setpiece/move", asked)["message"], why);
}
