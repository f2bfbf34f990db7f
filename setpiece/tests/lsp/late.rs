//! What drawn starts show of a text, which comes a little later than the compiler's reports.

use super::{Client, URI, diagnostics_of};
use serde_json::{Value, json};

/// A scenario whose striker is drawn, with some requirements.
fn text(requires: &str) -> String {
    format!(
        "// \u{1d4d0}\nscenario drawn extends academy {{\n    let x = uniform(0, 1)\n    ball at (0.2, 0)\n    \
         team left {{ CF at (0.1 * x, 0) }}\n{requires}}}\nscenario last extends academy {{\n    ball at centre\n    team left {{ CF at (0, 0) }}\n}}\n"
    )
}

/// An editor with a text, and all that the server says of it by and by.
struct Later {
    client: Client,
    text: String,
}

impl Later {
    fn open(text: &str) -> Later {
        let mut client = Client::new();
        client.open(URI, text);
        Later { client, text: text.to_owned() }
    }

    /// What is said at once, and what is said of the text in the end.
    fn said(&mut self) -> (Vec<Value>, Option<Vec<Value>>) {
        let own = |all: Vec<(String, Vec<Value>)>| {
            all.into_iter().find(|(uri, _)| uri == URI).map(|(_, found)| found)
        };
        assert!(!self.client.server.has_later(), "the ordinary reports come first");
        let first = own(self.client.published()).expect("reports");
        let work = self.client.server.later().expect("something to do");
        assert!(self.client.server.later().is_none(), "it is done once");
        let found = work.run();
        (first, own(diagnostics_of(self.client.server.settle(&found))))
    }

    /// The only thing that is said later.
    fn only(&mut self) -> Value {
        let (first, all) = self.said();
        assert!(first.is_empty(), "{first:?}");
        let all = all.expect("something");
        let [one] = all.as_slice() else { panic!("{all:?}") };
        one.clone()
    }

    /// The words that a range covers.
    fn words(&self, at: &Value) -> &str {
        let line = self.text.lines().nth(at["start"]["line"].as_u64().unwrap() as usize).unwrap();
        let [start, end] =
            ["start", "end"].map(|it| at[it]["character"].as_u64().unwrap() as usize);
        &line[start..end]
    }
}

/// The first percentage in some words.
fn percent(words: &str) -> f64 {
    let before = words.split('%').next().unwrap();
    before.rsplit(' ').next().unwrap().parse().expect(words)
}

#[test]
fn a_requirement_that_refuses_most_starts_is_information() {
    let mut later = Later::open(&text("    require x < 0.25 as \"early\"\n"));
    let note = later.only();
    assert_eq!((&note["severity"], &note["source"]), (&json!(3), &json!("setpiece")));
    assert_eq!(note.get("code"), None, "codes are of errors and warnings");
    assert_eq!(later.words(&note["range"]), "x < 0.25");
    let message = note["message"].as_str().unwrap();
    assert!((68.0..82.0).contains(&percent(message)), "{message}");
    assert!(message.contains("of the starts that are drawn. A reset draws 4."), "{message}");
}

#[test]
fn several_that_refuse_them_together_are_reported_at_the_scenario() {
    let requires = "    require x > 0.35\n    require x < 0.7\n";
    let mut later = Later::open(&text(requires));
    let note = later.only();
    assert_eq!(later.words(&note["range"]), "drawn");
    let message = note["message"].as_str().unwrap();
    assert!((58.0..72.0).contains(&percent(message)), "{message}");
    let words = "are drawn for `drawn` are refused, most often because `x > 0.35` fails. ";
    assert!(message.contains(words), "{message}");
    let related = note["relatedInformation"].as_array().unwrap();
    assert_eq!(related.len(), 2, "{related:?}");
    assert_eq!(later.words(&related[0]["location"]["range"]), "x > 0.35");
    assert_eq!(later.words(&related[1]["location"]["range"]), "x < 0.7");
}

/// Nobody wrote that players stand on the pitch.
#[test]
fn what_the_pitch_refuses_counts_too() {
    let corner = "CF in circle(left.corner.top, 20m + 1m * x)";
    let text = text("").replace("CF at (0.1 * x, 0)", corner);
    let mut later = Later::open(&text);
    let note = later.only();
    assert_eq!(later.words(&note["range"]), "in circle(left.corner.top, 20m + 1m * x)");
    let message = note["message"].as_str().unwrap();
    assert!((60.0..80.0).contains(&percent(message)), "{message}");
    assert!(message.contains("of the starts fail here: `"), "{message}");
}

#[test]
fn what_is_inherited_is_reported_at_the_child() {
    let child = "scenario child extends drawn {\n    end limit 9s\n}\n";
    let mut later = Later::open(&format!("{}{child}", text("    require x < 0.3\n")));
    let (_, all) = later.said();
    let all = all.unwrap();
    let places: Vec<&str> = all.iter().map(|it| later.words(&it["range"])).collect();
    assert_eq!(places, ["x < 0.3", "child"]);
    let related = &all[1]["relatedInformation"][0]["location"]["range"];
    assert_eq!(later.words(related), "x < 0.3");
}

#[test]
fn what_refuses_less_than_half_is_a_number_beside_the_text() {
    let requires = "    require x > 0.2\n    require x > 0.25 as \"more\"\n";
    let mut later = Later::open(&text(requires));
    let (first, all) = later.said();
    assert_eq!((first, all), (Vec::new(), None));
    assert!(Later::open(&text("")).said().1.is_none());
}

/// What a check reports is reported, and then nothing else.
#[test]
fn what_no_start_meets_is_reported_once_as_a_check_does() {
    for (requires, code, severity) in [
        ("    require x < 0.4\n    require x > 0.4\n", "SP0604", 1),
        ("    require x < 0.004\n", "SP0603", 2),
    ] {
        let mut later = Later::open(&text(requires));
        let problem = later.only();
        assert_eq!((&problem["code"], &problem["severity"]), (&json!(code), &json!(severity)));
        assert!(later.words(&problem["range"]).starts_with("x < 0."), "{problem}");
    }
    // What the compiler proves is said at once, and not again.
    let (first, all) = Later::open(&text("    require x > 2\n")).said();
    assert_eq!((first.len(), &first[0]["code"], all), (1, &json!("SP0604"), None));
    let ends = text("    end success at_once when ball.x < 0.5\n");
    assert_eq!(Later::open(&ends).only()["code"], "SP0601");
}

#[test]
fn what_was_found_of_an_older_text_is_dropped() {
    let mut later = Later::open(&text("    require x < 0.25\n"));
    later.client.published();
    let (work, change) = (later.client.server.later().unwrap(), text("    require x < 0.9\n"));
    let found = work.run();
    later.client.say(
        "textDocument/didChange",
        json!({ "textDocument": { "uri": URI, "version": 2 }, "contentChanges": [{ "text": change }] }),
    );
    assert!(later.client.server.settle(&found).is_empty());
    let (first, all) = later.said();
    assert_eq!((first, all), (Vec::new(), None));
    assert!(later.client.server.settle(&found).is_empty());
}

/// What was found stays in view while somebody types elsewhere, until starts are drawn again.
#[test]
fn what_was_found_stays_until_it_is_looked_for_again() {
    let mut later = Later::open(&text("    require x < 0.25\n"));
    let note = later.only();
    let mut version = 1;
    let mut change = |later: &mut Later, text: &str| {
        version += 1;
        text.clone_into(&mut later.text);
        let document = json!({ "uri": URI, "version": version });
        let changes = json!([{ "text": text }]);
        let params = json!({ "textDocument": document, "contentChanges": changes });
        later.client.say("textDocument/didChange", params);
    };
    // Above it, it moves; behind it, it stays; at another text nothing happens.
    let above = format!("// A line.\n{}", later.text);
    change(&mut later, &above);
    let (first, all) = later.said();
    assert_eq!(first, all.unwrap());
    assert_eq!(
        (&first[0]["message"], later.words(&first[0]["range"])),
        (&note["message"], "x < 0.25")
    );
    let below = format!("{above}// \u{1d4d0}\n");
    change(&mut later, &below);
    let (first, _) = later.said();
    assert_eq!(later.words(&first[0]["range"]), "x < 0.25");
    // A requirement that is written again has nothing to say until its starts are drawn.
    change(&mut later, &below.replace("x < 0.25", "x < 0.95"));
    assert_eq!(later.said(), (Vec::new(), Some(Vec::new())));
}

/// Work that nobody waits for ends.
#[test]
fn a_change_ends_the_work_on_the_text_before() {
    let many: String = (0..200)
        .map(|at| {
            text("    require x < 0.25\n")
                .replace("drawn ", &format!("d{at} "))
                .replace("last", &format!("l{at}"))
        })
        .collect();
    let mut later = Later::open(&many);
    later.client.published();
    let work = later.client.server.later().unwrap();
    later.client.say("textDocument/didSave", json!({ "textDocument": { "uri": URI } }));
    let began = std::time::Instant::now();
    let found = work.run();
    assert!(began.elapsed().as_millis() < 200, "{:?}", began.elapsed());
    assert!(later.client.server.settle(&found).is_empty());
}

#[test]
fn the_compiler_s_reports_stay_and_a_text_with_errors_is_not_drawn() {
    let warned = text("    param far = 1 in 0..2\n    require x < 0.25\n");
    let (first, all) = Later::open(&warned).said();
    let codes = |all: &[Value]| -> Vec<String> {
        all.iter().map(|it| it["code"].as_str().unwrap_or("note").to_owned()).collect()
    };
    assert_eq!(codes(&first), ["SP0213"]);
    assert_eq!(codes(&all.unwrap()), ["SP0213", "note"]);
    let broken = text("    require x < 0.25\n    reward scorin\n");
    let (first, all) = Later::open(&broken).said();
    assert_eq!((codes(&first), all), (vec!["SP0201".to_owned()], None));
    // A text that is closed takes its notes along.
    let mut later = Later::open(&text("    require x < 0.25\n"));
    later.only();
    later.client.say("textDocument/didClose", json!({ "textDocument": { "uri": URI } }));
    let taken_back = later.client.published();
    assert!(taken_back.contains(&(URI.to_owned(), Vec::new())), "{taken_back:?}");
}
