//! Texts of up to 1 MiB that repeat, nest, chain or break whatever can be: each is answered with
//! few reports and a bounded scenario. What is counted is sizes: a step that takes the square of a
//! text's length would never finish here.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

use setpiece_dsl::problem::{Code, Severity, nearest};
use setpiece_dsl::source::{LoadError, Source, SourceLoader};
use setpiece_dsl::{CompileOptions, CompileOutcome, compile};
use std::cell::Cell;
use std::fmt::Write as _;

/// As large as a source may be.
const FULL: usize = 1 << 20;
/// Problems of one kind.
const SOME: usize = 500;

const HEAD: &str = "scenario s {\n ball at (0, 0)\n end limit 10 steps\n";

/// Makes up files that import each other, and counts how often it is asked.
#[derive(Default)]
struct Endless {
    asked: Cell<usize>,
    /// What every file holds, but for its import.
    filler: String,
}

impl SourceLoader for Endless {
    fn load(&self, path: &str, from: &str) -> Result<Source, LoadError> {
        self.asked.set(self.asked.get() + 1);
        if path.starts_with("std/") || path.starts_with("missing") {
            return Err(LoadError {
                message: format!("no file `{path}`"),
                similar: vec![],
                awaited: None,
            });
        }
        let name = format!("{from}/{path}");
        let next = if path.starts_with("deep") { "import \"deep.pitch\"\n" } else { "" };
        Ok(Source { name, text: format!("{next}{}", self.filler).into() })
    }
}

fn outcome(text: &str) -> CompileOutcome {
    outcome_with(text, &Endless::default())
}

fn outcome_with(text: &str, loader: &Endless) -> CompileOutcome {
    assert!(text.len() <= FULL, "{} bytes", text.len());
    let root = Source { name: "case.pitch".to_owned(), text: text.into() };
    compile(root, loader, &CompileOptions::default())
}

/// Repeats a part up to the size of a source.
fn full(head: &str, part: impl Fn(usize) -> String, tail: &str) -> String {
    let mut text = head.to_owned();
    for index in 0.. {
        let part = part(index);
        if text.len() + part.len() + tail.len() > FULL {
            break;
        }
        text.push_str(&part);
    }
    text + tail
}

fn repeated(head: &str, n: usize, part: impl Fn(usize) -> String, tail: &str) -> String {
    let mut text = head.to_owned();
    (0..n).for_each(|index| text.push_str(&part(index)));
    text + tail
}

/// How often a code was reported.
fn count(outcome: &CompileOutcome, code: Code) -> usize {
    outcome.problems.iter().filter(|problem| problem.code() == code).count()
}

#[track_caller]
fn is_too_much(outcome: &CompileOutcome, message: &str) {
    let found = outcome.problems.iter().find(|problem| problem.code() == Code::TooMuch);
    let found = found
        .unwrap_or_else(|| panic!("{:#?}", outcome.problems.iter().take(3).collect::<Vec<_>>()));
    assert!(found.words().message.contains(message), "{}", found.words().message);
    assert!(outcome.scenario.is_none());
    let label = found.place();
    assert!(
        outcome
            .sources
            .get(label.file)
            .unwrap()
            .text
            .get(label.start as usize..label.end as usize)
            .is_some()
    );
}

#[test]
fn a_full_text_of_anything_is_answered_in_few_words() {
    let parts = [
        "x ",
        "} ",
        "} }\n",
        ") ",
        "( ",
        "{ ",
        "( } ",
        "[ ) { ] ( }\n",
        "}{][",
        "}{)(",
        "}{)(][;:,",
        "{\n",
        "\"\n",
        "\"\"\"",
        "/* ",
        "/**/x ",
        "@",
        "é ",
        "1 ",
        "5mm ",
        "let ",
        "if ",
        "goal by ",
        "CM ",
        "team left {\n",
        "team left\n}\n",
        "scenario s {\n",
        "scenario s {}\n",
        " at -0.1, 0)\n",
        "/// doc\n",
        "import \"missing\"\n",
        "x += 1\n",
        "          x\n",
        ";",
        "\n",
    ];
    for part in parts {
        for head in [
            "",
            HEAD,
            "scenario s { team left {",
            "reward r {",
            "behavior b {",
            "scenario s { rules {",
        ] {
            let outcome = outcome(&full(head, |_| part.to_owned(), ""));
            assert!(outcome.problems.len() <= 3 * SOME, "{part:?}: {}", outcome.problems.len());
            let failed =
                outcome.problems.iter().any(|problem| problem.severity() == Severity::Error);
            assert_eq!(outcome.scenario.is_none(), failed, "{part:?}");
        }
    }
}

#[test]
fn closing_braces_far_apart_are_looked_at_once() {
    for blank in [" ", "\n"] {
        let text = full("", |_| format!("}}{}", blank.repeat(10)), "");
        assert!(count(&outcome(&text), Code::Syntax) <= SOME);
    }
    let junk = full(HEAD, |_| format!("let{}", " ".repeat(40)), "\n}\n");
    assert!(outcome(&junk).problems.len() <= SOME);
}

#[test]
fn a_file_has_a_limit_of_words() {
    is_too_much(&outcome(&full(HEAD, |_| "1 ".to_owned(), "}")), "more than 100000 words");
    // Comments are none.
    let text = full(HEAD, |_| "/* a b c d e f g h */ // i j k l m n\n".to_owned(), "}");
    assert_eq!(count(&outcome(&text), Code::TooMuch), 0);
}

#[test]
fn lists_have_a_limit() {
    let many = 4_097;
    let options = repeated(&format!("{HEAD} rules {{"), many, |i| format!("k{i}: 1\n"), "}}");
    is_too_much(&outcome(&options), "more than 4096 options");
    is_too_much(
        &outcome(&repeated(HEAD, many, |i| format!("let a{i} = {i}\n"), "}")),
        "more than 4096 statements",
    );
    is_too_much(
        &outcome(&repeated("", many, |i| format!("const a{i} = {i}\n"), "")),
        "more than 4096 items",
    );
    let args = repeated(&format!("{HEAD} let a = choice("), many, |_| "1, ".to_owned(), "1) }");
    is_too_much(&outcome(&args), "more than 4096 arguments");
    let params = repeated("fn f(", many, |i| format!("a{i}, "), "z) = 1\n");
    is_too_much(&outcome(&params), "more than 4096 parameters");
    let values = repeated(&format!("{HEAD} observe vector {{"), many, |_| "ball ".to_owned(), "}}");
    is_too_much(&outcome(&values), "more than 4096 values");
}

#[test]
fn a_shuffle_mixes_so_many_values() {
    let text = |n: usize| {
        let names: Vec<String> = (0..n).map(|i| format!("_a{i}")).collect();
        let values: Vec<&str> = vec!["uniform(0, 1)"; n];
        format!(
            "{HEAD} team left {{ CM at (0, 0) }} let ({}) = shuffle({}) }}",
            names.join(", "),
            values.join(", ")
        )
    };
    assert_eq!(count(&outcome(&text(64)), Code::TooMuch), 0);
    is_too_much(&outcome(&text(65)), "more than 64 values");
}

#[test]
fn parents_have_a_limit() {
    let chain = |n: usize| {
        let mut text = "abstract scenario s0 { ball at (0, 0) }\n".to_owned();
        for i in 1..=n {
            let _ = writeln!(text, "scenario s{i} extends s{} {{ let a{i} = 1 }}", i - 1);
        }
        text
    };
    assert_eq!(count(&outcome(&chain(32)), Code::TooMuch), 0);
    is_too_much(&outcome(&chain(33)), "more than 32 parents");
    assert!(outcome(&chain(4_000)).problems.len() < 20 * SOME);
    let rewards = repeated(
        "reward r0 {}\n",
        4_000,
        |i| format!("reward r{} extends r{i} {{}}\n", i + 1),
        HEAD,
    );
    is_too_much(&outcome(&(rewards + "reward r4000 }")), "more than 32 parents");
}

#[test]
fn a_team_writes_so_many_players() {
    let text =
        repeated(&format!("{HEAD} team left {{"), 4_000, |_| "CM at (0, 0)\n".to_owned(), "}}");
    let outcome = outcome(&text);
    let too_many = outcome.problems.iter().filter(|problem| problem.code() == Code::TooManyPlayers);
    assert!(
        too_many
            .map(|problem| problem.words().message)
            .any(|message| message.contains("more than 44 players"))
    );
    assert!(outcome.problems.len() < 3 * SOME);
}

#[test]
fn imports_have_limits() {
    let loader = Endless::default();
    is_too_much(&outcome_with("import \"deep.pitch\"\n", &loader), "more than 32 deep");
    assert!(loader.asked.get() < 50, "{} files", loader.asked.get());
    let loader = Endless::default();
    let text = repeated("", 4_000, |i| format!("import \"f{i}.pitch\"\n"), "");
    is_too_much(&outcome_with(&text, &loader), "more than 128 files");
    let missing = repeated("", 4_000, |i| format!("import \"missing{i}.pitch\"\n"), "");
    let loader = Endless::default();
    is_too_much(&outcome_with(&missing, &loader), "more than 128 imports");
    assert!(loader.asked.get() < 140, "{} files", loader.asked.get());
    let loader = Endless { filler: "// much\n".repeat(1 << 15), ..Endless::default() };
    is_too_much(&outcome_with("import \"deep.pitch\"\n", &loader), "larger than 1 MiB together");
    let scripts =
        repeated(HEAD, 200, |i| format!("reward script \"missing{i}.rhai\" as \"r{i}\"\n"), "}");
    is_too_much(&outcome(&scripts), "more than 128 script files");
}

#[test]
fn what_multiplies_has_a_limit() {
    let lets = repeated("", 4_000, |i| format!("let a{i} = uniform(0, {i})\n"), "");
    let base = format!("scenario b {{ ball at (0, 0) end limit 1 step\n{lets}}}\n");
    let children = repeated(&base, 4_000, |i| format!("scenario s{i} extends b {{}}\n"), "");
    is_too_much(&outcome(&children), "400000 expressions");
    let big = repeated("reward big { ", 4_000, |i| format!("give {i}\n"), "}\n");
    let uses = repeated(&(big + HEAD), 4_000, |i| format!("reward big as \"r{i}\"\n"), "}");
    is_too_much(&outcome(&uses), "400000 expressions");
    let behavior =
        repeated("behavior b { ", 4_000, |i| format!("do move_to((ball.x + {i}m, 0m))\n"), "}\n");
    let team =
        "team left { 11 CM in left.box { ai: b } } team right { 11 CM in right.box { ai: b } } }";
    is_too_much(&outcome(&format!("{behavior}{HEAD}{team}")), "400000 expressions");
}

#[test]
fn names_are_looked_up_in_thousands() {
    let lets = repeated(HEAD, 4_000, |i| format!("let a{i} = uniform(0, 1)\n"), "");
    let uses = |i: usize| {
        format!("give a{} + a{} * a{}\n", (i * 7) % 4_000, (i * 11) % 4_000, (i * 13) % 4_000)
    };
    let found = outcome(&repeated(&(lets + "reward r {"), 4_000, uses, "}}"));
    assert_eq!(count(&found, Code::TooMuch) + count(&found, Code::UnknownName), 0);
    let unknown = repeated(HEAD, 4_000, |i| format!("let abcdefgh{i} = abcdefg{i}x\n"), "}");
    assert!(count(&outcome(&unknown), Code::UnknownName) <= SOME);
}

#[test]
fn a_similar_name_is_looked_for_among_so_many() {
    let names: Vec<String> = (0..5_000).map(|i| format!("left_{i}")).collect();
    let seen = Cell::new(0);
    let candidates = names.iter().map(|name| {
        seen.set(seen.get() + 1);
        name.as_str()
    });
    assert!(nearest("loft_0", candidates).is_some());
    assert_eq!(seen.get(), 1_000);
    let long = "a".repeat(100_000);
    assert_eq!(nearest(&long, [long.as_str()]), None);
}

#[test]
fn what_is_tried_out_takes_no_room_of_what_is_told() {
    let head = format!("reward r(x = nope) {{ give x }}\n{HEAD}");
    let uses = repeated(
        &head,
        600,
        |i| format!("reward r(x: 1) as \"r{i}\"\n"),
        "end lost when another\n}",
    );
    let found = outcome(&uses);
    let reported =
        |name: &str| found.problems.iter().any(|problem| problem.words().message.contains(name));
    assert!(reported("`another`"), "{:#?}", found.problems.iter().take(3).collect::<Vec<_>>());
}
