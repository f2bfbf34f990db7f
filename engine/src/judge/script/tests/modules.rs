//! Modules: joined, called, failing at their own places.

use super::*;
use setpiece_scenario::ScriptModule;

fn compiled(source: &str, modules: &[(&str, &str)]) -> Result<Scripts, ScriptLoadError> {
    let mut scenario = scenario(&[]);
    let module = |&(name, source): &(&str, &str)| ScriptModule {
        name: name.to_owned(),
        source: source.to_owned(),
    };
    scenario.scripts.push(Script {
        name: "folder/own.rhai".to_owned(),
        at: (1, 1),
        source: source.to_owned(),
        named: Vec::new(),
        modules: modules.iter().map(module).collect(),
    });
    Scripts::compile(&scenario)
}

fn paid(source: &str, modules: &[(&str, &str)]) -> Result<f64, String> {
    let perspective = Perspective { us: Team::Left, me: Some(PlayerId(1)), agent: 0 };
    compiled(source, modules)
        .unwrap_or_else(|error| panic!("{error}"))
        .reward(0, &scene(&[]), perspective, &[], &mut Memory::default())
        .map_err(|error| {
            format!("{}:{}:{} {}", error.script, error.line, error.column, error.message)
        })
}

const HOOK: &str = "fn reward(ctx, now, prev, events) {";

#[test]
fn functions_of_modules_are_called_by_their_own_names() {
    let script = format!(
        "import \"lib\" as lib; // a note\nimport \"a/deep\" as other;\nfn f(x) {{ 1000 * x }}
        {HOOK} f(1) + lib::f(2) + lib :: g(`${{other::f(3)}}`) + [1, 2].map(|x| lib::f(x))[1] }}"
    );
    let modules = [
        (
            "lib.rhai",
            "fn f(x) { 10 * x }\n/* fn f( */ fn g(text) { text.len() + h() }\nprivate fn h() { f(1) + own(\"fn f(x)\") } fn own(text) { 0 }",
        ),
        (
            "a/deep.rhai",
            "import \"deeper\" as lib; fn f(x) { lib::f(x) * 1000 + x.plus(1) } fn plus(y) { this + y }",
        ),
        ("a/deeper.rhai", "fn f(x) { x + 1 }"),
    ];
    // 1000 + 20 + (4 letters + 10) + 20
    assert_eq!(paid(&script, &modules), Ok(1054.0));
    assert!(compiled(&script, &modules).unwrap().names(&[], &[], (1, 0)).scripts.len() == 1);
}

#[test]
fn modules_run_as_bytecode_too() {
    let script = format!("import \"lib\" as lib;\n{HOOK} lib::f(now.ball.x) }}");
    let scripts = compiled(&script, &[("lib.rhai", "fn f(x) { x * 2.0 }")]).unwrap();
    assert!(scripts.is_lowered());
}

#[test]
fn failures_in_modules_name_their_place() {
    let script = format!("import \"lib\" as lib;\n{HOOK}\n    lib::f(now) }}");
    let lib =
        "import \"deep\" as d;\n\nfn f(now) {\n    let x = [1, 2, 3, 4];\n    x + d::g(now) }";
    let deep = "// é\nfn g(now) { let x = 1; x[0.5] }\nfn h(x) { throw \"no\" }";
    let modules = [("lib.rhai", lib), ("deep.rhai", deep)];
    let failed = paid(&script, &modules).unwrap_err();
    assert!(failed.starts_with("folder/deep.rhai:2:"), "{failed}");
    let script = script.replace("lib::f(now)", "1 + now.nothing");
    let failed = paid(&script, &modules).unwrap_err();
    assert!(failed.starts_with("folder/own.rhai:3:"), "{failed}");
}

#[test]
fn failures_in_closures_name_their_line() {
    for (body, line, column) in [
        ("let x = 1;\n[1, 2].filter(|p|\n  p.nothing > 1).len()", 4, 5),
        ("now.us.players.map(|p|\n  p.x.nothing.more)[0]", 3, 0),
        ("now.us.players.map(|p|\n  p.x + \"a\".len() - ())[0]", 3, 0),
        ("now.us.players.map(|p|\n  { let a = [1];\n a[5] })[0]", 4, 0),
        ("now.us.players.some(|p|\n  clamp(p, 0, 1) > 1)", 3, 0),
        ("let f = |x|\n  x.nothing;\nf.call(1)", 3, 0),
        ("now.us.players.filter(|p|\n  throw \"x\").len()", 3, 0),
        ("let n = 2; now.us.players.filter(|p| [1].some(|q|\n  q.nothing + n)).len()", 3, 0),
        ("now.us.players.filter(|p|\n  p.length > 1.0).len()", 3, 5),
        ("[3, 1].reduce(|a, b|\n  b.nothing + a)", 3, 0),
    ] {
        let failed = fail(body);
        assert_eq!(failed.line, line, "{body}: {failed}");
        assert!(column == 0 || failed.column == column, "{body}: {failed}");
    }
}

#[test]
fn modules_reach_me_and_events() {
    let script = format!("import \"lib\" as lib;\n{HOOK} lib::f(now) }}");
    assert!(compiled(&script, &[("lib.rhai", "fn f(now) { now.me.x }")]).unwrap().uses_me(0));
    assert!(!compiled(&script, &[("lib.rhai", "fn f(now) { now.ball.x }")]).unwrap().uses_me(0));
}

#[test]
fn what_cant_be_joined_is_an_error_with_its_place() {
    let script = format!("import \"lib\" as lib;\n{HOOK} lib::f(now) }}");
    for (modules, expected) in [
        (&[][..], "folder/own.rhai:1:8: no module `lib`"),
        (
            &[("lib.rhai", "fn f(now) {\n  let = 1 }")],
            "folder/lib.rhai:2:7: expecting name of a variable",
        ),
        (
            &[("lib.rhai", "fn f(now) { 1 }\nfn setpiece_0_f(x) { 2 }")],
            "folder/lib.rhai:2:20: `setpiece_0_f` is not available in a script",
        ),
        (
            &[("lib.rhai", "import \"../x\" as x; fn f(now) { 1 }")],
            "folder/lib.rhai:1:8: no module `../x`",
        ),
    ] {
        let failed = compiled(&script, modules).unwrap_err().to_string();
        assert_eq!(failed, expected);
    }
}
