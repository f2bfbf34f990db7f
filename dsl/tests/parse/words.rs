//! The words of every report.

use super::{read, sources};
use setpiece_dsl::problem::Code;
use setpiece_dsl::report::{Format, diagnostics, render};
use setpiece_dsl::source::{LoadError, Source, SourceLoader};
use setpiece_dsl::{CompileOptions, compile};

fn report(text: &str) -> String {
    let (_, problems) = read(text);
    render(&problems, &sources(text), Format::Human { color: false, width: 100 })
}

macro_rules! words {
    ($($name:ident: $text:expr;)+) => { $(
        #[test]
        fn $name() {
            insta::assert_snapshot!(stringify!($name), report($text));
        }
    )+ };
}

words! {
    misplaced_keywords: "scenario s {\n    give 1 on goal by us\n    GK at (0, 0)\n}\nteam left { }";
    units: "scenario s {\n    let a = 5mm\n    let b = 5 m\n    let c = 30degrees\n    let d = 3km\n    end limit 400 step5\n}";
    unclosed_brace: "scenario s {\n    team left {\n        CB at (0.5, 0)\n\n    team right {\n        GK at (1, 0)\n    }\n}\n\nscenario t {\n    bal at (0, 0)\n}";
    unclosed_round: "scenario s {\n    team left {\n        CB at (0.5, 0\n        CM at (0.6, 0)\n    }\n    tema right { }\n}";
    unclosed_string: "import \"std/rewards\nscenario s {\n    rewrd x\n}";
    unclosed_at_the_end: "scenario s {\n    ball at (0, 0)\n";
    stray_bracket: "scenario s {\n    ball at (0, 0))\n}\n}";
    block_after_give: "reward r {\n    give 1 on goal by us { x = 1 }\n}";
    comparison_chain: "reward r {\n    give 1 when 0 < ball.x < 0.5\n}";
    too_deep: &format!("scenario s {{\n    let x = {}1{}\n}}", "(".repeat(70), ")".repeat(70));
    too_deep_without_brackets: &format!("scenario s {{\n    let x = {}c\n}}", "if a then b else if ".repeat(70));
    bad_head: "scenario s extnds academy {\n    bal at (0, 0)\n}\nscenario extends academy { }";
    other_languages: "scenario s {\n    require a && b\n    let x = .5\n    let d = 7 % 2\n    let s = 'abc'\n    if x = 3 { }\n}";
    unknown_role: "scenario s {\n    team left {\n        CBB at (0.5, 0)\n        2 XY in left.box\n        striker: CFF at (0, 0)\n    }\n}";
    misspelt_keywords: "scenario s {\n    rewrd scoring\n    team left {\n        palce CF at (0, 0)\n        CM at (0, 0) facng ball\n        each outfeld { ai: lazy }\n    }\n}\nreward r {\n    give 1 whn goal\n    gve 2\n}";
    incomplete: "scenario s {\n    ball at\n    team left { }\n    let x =\n}\nreward r {\n    give\n    give 1 on\n    when { give 1 }\n    on goal by { give 1 }\n}";
    reserved_names: "scenario s {\n    let in = 3\n    let corner = 1\n    let CB = 2\n}";
}

#[test]
fn json_and_short_forms() {
    let text =
        "scenario s {\n    team left {\n        CBB at (0.5, 0)\n    }\n    rewrd scoring\n}";
    let (_, problems) = read(text);
    insta::assert_snapshot!("json", render(&problems, &sources(text), Format::Json));
    insta::assert_snapshot!("short", render(&problems, &sources(text), Format::Short));
    assert_eq!(diagnostics(&problems, &sources(text)).len(), 2);
}

#[test]
fn twenty_are_shown_and_all_are_counted() {
    let text = format!("scenario s {{\n{}}}", "    rewrd x\n".repeat(30));
    let report = report(&text);
    assert_eq!(report.matches("SP0101").count(), 20);
    assert!(report.ends_with("30 errors; 10 of them not shown\n"), "{report}");
}

#[test]
fn labels_of_two_files_are_two_pictures() {
    struct Parent;
    impl SourceLoader for Parent {
        fn load(&self, path: &str, _from: &str) -> Result<Source, LoadError> {
            let text = "// Shared.\nabstract scenario parent(width: length = 2m) { }\n";
            match path {
                "lib.pitch" => Ok(Source { name: path.to_owned(), text: text.into() }),
                _ => Err(LoadError {
                    message: format!("no file `{path}`"),
                    similar: Vec::new(),
                    awaited: None,
                }),
            }
        }

        fn scenarios(&self) -> Vec<(String, String)> {
            Vec::new()
        }
    }
    let text = "import \"lib.pitch\"\nscenario child(width: number = 2) extends parent {\n    ball at (0, 0)\n    \
                end limit 10 steps\n}\n";
    let outcome = compile(
        Source { name: "test.pitch".into(), text: text.into() },
        &Parent,
        &CompileOptions::default(),
    );
    let problem =
        outcome.problems.iter().find(|problem| problem.code() == Code::WrongType).cloned();
    let report =
        render(problem.as_slice(), &outcome.sources, Format::Human { color: false, width: 100 });
    insta::assert_snapshot!("two_files", report);
}
