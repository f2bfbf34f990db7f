//! Scripts from text to pay: several terms, modules.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

use setpiece::engine::environment::{Environment, EnvironmentOptions, Scratch};
use setpiece::scenario::file::binary;
use setpiece::scenario::vocabulary::Action;
use setpiece::{Error, load};
use std::fs;
use std::path::Path;
use std::sync::Arc;

fn scenario(rewards: &str) -> String {
    format!(
        "scenario s {{
            param share = 0.5
            agents {{ left: 2 }}
            ball at (0.2, 0)
            team left {{ CM at (0.1, 0) CF at (-0.1, 0.2) }}
            {rewards}
            end limit 9 steps
        }}"
    )
}

fn environment(text: &str) -> Environment {
    let loaded = setpiece::compile_text(text, "s.pitch").unwrap_or_else(|error| panic!("{error}"));
    // As it comes out of a compiled file.
    let file = binary::to_bytes(&loaded.scenario).unwrap();
    let scenario = Arc::new(binary::from_bytes(&file).unwrap());
    Environment::new(scenario, EnvironmentOptions::default()).unwrap()
}

fn play(environment: &mut Environment, steps: usize) {
    environment.reset(Some(1), Some(0)).unwrap();
    for _ in 0..steps {
        environment.step(&[Action::Idle; 2], &mut Scratch::default()).unwrap();
    }
}

#[test]
fn each_term_of_a_script_is_a_term_of_its_reward() {
    let mut environment = environment(&scenario(
        r#"reward shape {
            give script rhai """
                fn reward(ctx, now, prev, events) {
                    #{step: ctx.step, side: if now.me.y > 0.0 { 1 } else { -0.5 }}
                }
            """ per second as ["side", "step"]
            give 2 as "step"
        }
        reward script rhai """
            fn reset(ctx) { this.n = 0; }
            fn reward(ctx, now, prev, events) {
                this.n += 1;
                let pay = #{half: 0.5};
                pay.n = this.n;
                pay
            }
        """ for left as ["n", "half"] * (share + 1)"#,
    ));
    play(&mut environment, 3);
    assert_eq!(environment.term_names(), ["shape/side", "shape/step", "script/n", "script/half"]);
    assert_eq!(environment.terms(0), [-0.05, 2.3, 4.5, 0.75]);
    assert_eq!(environment.terms(1), [0.1, 2.3, 4.5, 0.75]);
    let sums: Vec<f64> =
        environment.term_sums(1).iter().map(|sum| (sum * 1e6).round() / 1e6).collect();
    assert_eq!(sums, [0.3, 6.6, 9.0, 2.25]);
    let paid = environment.rewards()[1];
    assert!((paid - 7.65).abs() < 1e-6, "{paid}");
}

#[test]
fn all_terms_of_a_script_are_paid_once_together() {
    let mut environment = environment(&scenario(
        r#"reward shape {
            give script rhai """
                fn reward(ctx, now, prev, events) { #{a: ctx.step, b: 2 * ctx.step} }
            """ once as ["a", "b"] when elapsed > 0.15s
        }"#,
    ));
    play(&mut environment, 5);
    assert_eq!(environment.term_sums(0), [2.0, 4.0]);
}

#[test]
fn a_map_without_a_term_ends_the_episode_with_its_name() {
    let text = scenario(
        r#"reward script rhai """
            fn reward(ctx, now, prev, events) {
                let pay = #{a: 1};
                if ctx.step < 3 { pay.b = 1; }
                pay
            }
        """ as ["a", "b"]"#,
    );
    let mut environment = environment(&text);
    environment.reset(Some(1), Some(0)).unwrap();
    let mut step = || environment.step(&[Action::Idle; 2], &mut Scratch::default());
    assert!(step().is_ok() && step().is_ok());
    let error = step().unwrap_err().to_string();
    assert!(error.contains("s.pitch:7:16: `reward` failed: the map has no term `b`"), "{error}");
}

/// A folder with a scenario whose script imports a module.
fn folder(files: &[(&str, &str)]) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    for (name, text) in files {
        let path = folder.path().join(name);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, text).unwrap();
    }
    folder
}

const HOOK: &str = "import \"lib/pay\" as pay;
fn reward(ctx, now, prev, events) { pay::twice(ctx.params.share) }";

#[test]
fn a_compiled_scenario_contains_the_modules_of_its_scripts() {
    let text = scenario(r#"reward script "scripts/hook.rhai""#);
    let folder = folder(&[
        ("s.pitch", &text),
        ("scripts/hook.rhai", HOOK),
        ("scripts/lib/pay.rhai", "import \"deep\" as deep; fn twice(x) { deep::double(x) }"),
        ("scripts/lib/deep.rhai", "fn double(x) { 2 * x }"),
    ]);
    let loaded = load(folder.path().join("s.pitch")).unwrap_or_else(|error| panic!("{error}"));
    let mut inputs: Vec<_> =
        loaded.inputs.iter().map(|path| path.file_name().unwrap().to_owned()).collect();
    inputs.sort();
    assert_eq!(inputs, ["deep.rhai", "hook.rhai", "pay.rhai", "s.pitch"]);
    let file = binary::to_bytes(&loaded.scenario).unwrap();
    drop(folder);
    let scenario = Arc::new(binary::from_bytes(&file).unwrap());
    let mut environment = Environment::new(scenario, EnvironmentOptions::default()).unwrap();
    play(&mut environment, 2);
    assert_eq!(environment.terms(0), [1.0]);
}

#[test]
fn a_changed_module_is_taken_over() {
    let text = scenario(r#"reward script "hook.rhai""#);
    let folder = folder(&[
        ("s.pitch", &text),
        ("hook.rhai", HOOK),
        ("lib/pay.rhai", "fn twice(x) { 2 * x }"),
    ]);
    let loaded = || load(folder.path().join("s.pitch")).unwrap().scenario;
    let mut environment = Environment::new(loaded(), EnvironmentOptions::default()).unwrap();
    play(&mut environment, 1);
    fs::write(folder.path().join("lib/pay.rhai"), "fn twice(x) { 20 * x }").unwrap();
    assert_eq!(environment.adopt_scripts(&loaded()), Ok(true));
    environment.step(&[Action::Idle; 2], &mut Scratch::default()).unwrap();
    assert_eq!(environment.terms(0), [10.0]);
}

/// What a scenario in a folder is refused for.
fn refused(folder: &Path) -> String {
    match load(folder.join("s.pitch")) {
        Err(Error::Compile(failure)) => {
            assert_eq!(failure.problems.len(), 1, "{:#?}", failure.problems);
            Error::Compile(failure).to_string()
        }
        other => panic!("{other:?}"),
    }
}

#[cfg(unix)]
#[test]
fn a_module_is_never_read_from_outside_the_scenarios_folder() {
    let text = scenario(r#"reward script "hook.rhai""#);
    let outside = folder(&[("pay.rhai", "fn twice(x) { 2 * x }")]);
    let inside = folder(&[("s.pitch", &text), ("hook.rhai", HOOK)]);
    std::os::unix::fs::symlink(outside.path(), inside.path().join("lib")).unwrap();
    let refused = refused(inside.path());
    assert!(refused.contains("lies outside of the scenario's folder"), "{refused}");
}

#[test]
fn the_modules_of_a_script_are_few() {
    let text = scenario(r#"reward script "hook.rhai""#);
    let mut files = vec![("s.pitch".to_owned(), text)];
    let hook = |module: &str| {
        format!("import \"{module}\" as m;\nfn reward(ctx, now, prev, events) {{ m::f() }}")
    };
    files.push(("hook.rhai".to_owned(), hook("m0")));
    for at in 0..20 {
        let text = format!("import \"m{}\" as m;\nfn f() {{ m::f() }}", at + 1);
        files.push((format!("m{at}.rhai"), text));
    }
    files.push(("m20.rhai".to_owned(), "fn f() { 1 }".to_owned()));
    let named: Vec<(&str, &str)> = files.iter().map(|(a, b)| (a.as_str(), b.as_str())).collect();
    let folder = folder(&named);
    let refused = refused(folder.path());
    assert!(refused.contains("more than 16 modules"), "{refused}");
}
