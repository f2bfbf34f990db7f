//! What a hook's call may use: time and memory.

use super::*;
use crate::judge::script::budget::count_copies;
use cpu_time::ThreadTime;
use std::time::Duration;

/// Much longer than a call takes now, much shorter than when only the number of operations was
/// counted.
const PATIENCE: Duration = Duration::from_secs(1);
/// What `docs/language/script.md` promises.
const MEMORY_BYTES: u64 = 64 << 20;

const HELPERS: &str = "fn same(x) { return x; }
fn deep(a, n) { let b = a; let c = [a[0], a]; if n == 0 { 1 } else { deep(b, n - 1) + deep(a, n - 1) } }
fn hold(p) { || p }
fn hold_both(p, q) { || [p, q] }
";

const LIST: &str = "let a = []; a.pad(4000, 7); ";
const TEXT: &str = "let s = \"\"; s.pad(4000, \"a\"); ";
const TABLE: &str = "let m = #{}; for i in 0..500 { m[\"k\" + i] = i; } ";

fn call(body: &str, memory: &mut Memory) -> Result<f64, ScriptError> {
    let scripts = scripts(&format!("{HELPERS}fn reward(ctx, now, prev, events) {{\n{body}\n}}"));
    let perspective = Perspective { us: Team::Left, me: Some(PlayerId(1)), agent: 0 };
    scripts.reward(0, &scene(&[]), perspective, &[], memory)
}

/// A call that runs for as long as it may.
fn endless(body: &str) -> ScriptError {
    let begun = ThreadTime::now();
    let failed = call(body, &mut Memory::default()).expect_err(body);
    let taken = begun.elapsed();
    assert!(taken < PATIENCE, "{body}: {taken:?}");
    failed
}

#[test]
fn work_on_large_values_is_counted() {
    for (given, work) in [
        (TEXT, "s.split(\"a\");"),
        (TEXT, "s.contains(\"aaab\");"),
        (TEXT, "let t = s; t.crop(1);"),
        (TEXT, "let t = s; t.set(1, 'b');"),
        (TEXT, "s.to_upper();"),
        (TEXT, "try { s.replace(\"a\", s); } catch {}"),
        (LIST, "a.sort();"),
        (LIST, "a.contains(8);"),
        (LIST, "8 in a;"),
        (LIST, "a == a;"),
        (LIST, "a.pad(4096, 1); a.clear();"),
        (LIST, "a.pop(); a.push(1);"),
        (LIST, "a.reverse();"),
        (LIST, "a.map(|x| x);"),
        (LIST, "a.dedup(\"no such function\");"),
        (LIST, "a.splice(0..10, a.extract(10..20));"),
        (TABLE, "m.keys();"),
        (TABLE, "m.to_json();"),
        (TABLE, "m.mixin(m);"),
        ("let a = []; a.pad(4000, now.ball); ", "count(a, \"pass\");"),
        ("let a = []; a.pad(4000, now.me); ", "nearest(a, now.ball);"),
        ("let f = Fn(\"split\"); let s = \"\"; s.pad(4000, \"a\");", "f.call(s, \"a\");"),
    ] {
        endless(&format!("{given}loop {{ {work} }}"));
    }
}

#[test]
fn copies_are_counted() {
    for copy in [
        "let b = a;",
        "a;",
        "a == 5;",
        "a < 5;",
        "try { if a { } } catch { }",
        "try { a && true } catch { }",
        "switch a { 1 => 2, _ => 3 }",
        "a ?? 3;",
        "[a];",
        "#{ x: a };",
        "same(a);",
        "for x in a { break; }",
        "type_of(a);",
        "try { throw a } catch (e) { e; e; }",
        "let f = || a; f.call();",
        "this.a = a; this.a; this;",
        "let b = [a]; b[0]; (b)[0]; b?[0];",
        "let n = 0; let f = |x| { n = x; }; f.call(a); n; n;",
        "let l = now.us.players; l.push(a); for p in l { p; p; }",
        "let l = now.us.players; l[0] = a; l[0]; l[0];",
        "let m = #{}; m.len = || a; let x = m.len(); x; x;",
    ] {
        endless(&format!("{LIST}loop {{ {copy} }}"));
    }
    endless("let a = []; a.pad(2000, []); loop { let b = a; }");
    endless(&format!(
        "{TEXT}let t = s + \"\"; loop {{ if s == t + \"b\" {{ s[3999]; }} for c in s {{ break; }} s - \"a\"; }}"
    ));
    endless(&format!("let n = 0; loop {{ {} }}", "n = n + 1 - 1; ".repeat(2000)));
    endless(&format!("{LIST}deep(a, 20)"));
    for captured in ["1", "s", "now"] {
        endless(&format!("{TEXT}let f = |x| x; loop {{ f = f.curry({captured}); }}"));
        endless(&format!("{TEXT}let f = |x| x; loop {{ f = curry(f, {captured}); }}"));
        endless(&format!(
            "{TEXT}let f = |x| x; loop {{ this.f = f; f = this.f.curry({captured}).curry(1); }}"
        ));
        endless(&format!(
            "{TEXT}let f = |x| x; for i in 0..2000 {{ f = f.curry({captured}); }} loop {{ f.curry(1).is_shared(); }}"
        ));
    }
}

#[test]
fn what_is_spent_on_sizes_has_its_place() {
    let failed = endless("let a = []; a.pad(4000, 7);\nloop {\n    let b = a;\n}");
    let words = "more than 200000 operations in one call: work on values counts by their size, 256 bytes to an operation";
    assert_eq!(
        (failed.line, failed.column, failed.message.as_str()),
        (HELPERS.lines().count() + 4, 13, words)
    );
    // Catching doesn't help either.
    endless(&format!("{LIST}loop {{ try {{ loop {{ let b = a; }} }} catch {{ }} }}"));
}

#[test]
fn places_are_the_authors() {
    for (body, place) in [
        ("let a = this.a; let b = [this.a, a, \"é\"]; throw 1", "throw"),
        ("let a = [1]; this.x = (a); this[\"y\"] = a; for x in a { } a[7]", "7"),
        ("let f = |x| this; `${this}`; let b = now.us; b.heigth", "heigth"),
    ] {
        let before = body.split(place).next().unwrap_or_default();
        assert_eq!(fail(body).column, before.chars().count() + 1, "{body}");
    }
}

/// What a hook creates is bounded, and freed when its call is over.
#[test]
fn memory_is_bounded_and_nothing_is_left() {
    for body in [
        "let f = |x| x; for i in 0..28 { f = f.curry(f); } 1",
        "let f = |x| x; for i in 0..28 { f = curry(f, f); } 1",
        "this.f = |x| x; for i in 0..40 { this.f = this.f.curry(this.f); } 1",
        "let a = [1]; for i in 0..28 { let m = #{}; m.x = a; m.y = a; a = m; } 1",
        "let m = #{}; let a = []; a.pad(4000, 7); for i in 0..60000 { m[\"k\" + i] = a; } 1",
        "let m = #{}; let a = []; a.pad(4000, 7); for i in 0..60000 { m[(\"k\" + i)] = if i > 0 { (a) } else { 1 }; } 1",
        "let m = #{}; let a = []; a.pad(4000, 7); for i in 0..60000 { m.set(\"k\" + i, a); } 1",
        "let m = #{}; let s = \"\"; s.pad(4000, \"a\"); for i in 0..60000 { m[i.to_string()] = s + i; } 1",
        "let m = #{}; let s = \"\"; s.pad(4000, \"a\"); for i in 0..60000 { m[s + i] = 0; } 1",
        "let a = []; a.pad(4000, 7); for i in 0..60000 { this[\"k\" + i] = a; } 1",
        "let a = []; a.pad(4000, 1); let b = a; a.map(|x| b); 1",
        "let m = #{}; let a = []; a.pad(4000, 7); for i in 0..20000 { let b = a; m[\"k\" + i] = || b; } 1",
        "loop { this.a = [this.a, this.a]; }",
        "this.x = 1; loop { this.y = this; }",
        "let a = #{}; let f = || a; a.f = f; a.big = []; a.big.pad(4000, 7); 1",
        "let a = #{}; a.f = || a; a.big = []; a.big.pad(4000, 7); 1",
        "let a = (); let b = []; let f = || b; let g = || a; a = [f]; b.push(g); 1",
        "let a = []; a.pad(4000, 7); let f = || a; this.f = f; 1",
        "let p = 0; loop { p = hold(p); }",
        "let p = 0; loop { p = hold_both(p, p); }",
        "let a = #{}; a.f = || a; throw a",
        "let a = #{}; a.f = || a; a.to_debug()",
        "let a = #{}; a.f = || a; a.to_json()",
    ] {
        // Lets Rhai allocate first what it keeps forever.
        let _ = call(body, &mut Memory::default());
        let counted = allocation_counter::measure(|| {
            let mut memory = Memory::default();
            for _ in 0..3 {
                if let Err(failed) = call(body, &mut memory) {
                    assert!(failed.line > HELPERS.lines().count(), "{body}: {failed}");
                    assert_eq!(memory.this.to_string(), "#{}", "{body}");
                }
            }
        });
        assert!(counted.bytes_max <= MEMORY_BYTES, "{body}: {} bytes", counted.bytes_max);
        assert!(
            counted.bytes_current < 100_000,
            "{body}: {} bytes are left",
            counted.bytes_current
        );
    }
}

/// A kept function has its own copies of what it shared, so that no two episodes share a variable.
#[test]
fn what_is_kept_shares_nothing() {
    let scripts = scripts(
        "fn reward(ctx, now, prev, events) {
            if this.f == () { let n = 0; this.f = |x| { n += x; n }; n = 5; }
            let f = this.f;
            f.call(1)
        }",
    );
    let perspective = Perspective { us: Team::Left, me: None, agent: 0 };
    let mut memory = Memory::default();
    let pay = |memory: &mut Memory| scripts.reward(0, &scene(&[]), perspective, &[], memory);
    assert_eq!(pay(&mut memory), Ok(6.0));
    let mut other = memory.clone();
    assert_eq!([pay(&mut memory), pay(&mut memory), pay(&mut other)], [7.0, 7.0, 7.0].map(Ok));
}

#[test]
fn remembered_steps_are_bounded() {
    let source = "fn reward(ctx, now, prev, events) { if this.l == () { this.l = []; } this.l.push(now.ball); 1 }";
    let scripts = scripts(source);
    let perspective = Perspective { us: Team::Left, me: None, agent: 0 };
    let mut memory = Memory::default();
    let kept = (0..1000).find_map(|at| {
        let failed = scripts.reward(0, &scene(&[]), perspective, &[], &mut memory).err()?;
        Some((at, failed.message))
    });
    let (at, message) = kept.unwrap();
    assert!(at > 100, "only {at}");
    assert!(
        message.starts_with(&format!("`this` holds what was shown in more than {at} steps")),
        "{message}"
    );
}

/// Typical scripts have enough budget: lists of thousands, pairs of players, a loop over a string.
#[test]
fn ordinary_work_has_room() {
    for body in [
        "let a = []; for i in 0..4000 { a.push(i * 2); } let n = 0; for x in a { n += x; } n",
        "let a = []; a.pad(3000, 1.5); let n = 0; for i in 0..3000 { n += a[i]; } n",
        "if this.t == () { this.t = []; this.t.pad(3000, 0.5); } let n = 0; for x in this.t { n += x; } n",
        "let n = 0; for p in now.players { for q in now.players { if distance(p, q) < 5.0 { n += 1; } } } n",
        "let s = \"\"; for i in 0..500 { s += \"a,\"; } s.split(\",\").len()",
        "let a = []; for i in 0..1000 { a.push((i * 7919) % 1009); } a.sort(); a[0]",
        "let a = []; for i in 0..200 { a.push(#{ x: i, y: [i, i] }); } a.filter(|m| m.x > 5).map(|m| m.y[0]).len()",
        "let g = []; g.pad(1200, 0.0); for i in 0..1200 { g[i] = g[i] + 1.0; } g.len()",
    ] {
        let mut memory = Memory::default();
        for _ in 0..3 {
            let paid = call(body, &mut memory);
            assert!(paid.is_ok(), "{body}: {paid:?}");
        }
    }
}

/// Hooks that hold only numbers and players are unchanged.
#[test]
fn plain_scripts_stay_as_they_are() {
    let counted = |source: &str| count_copies(source, &host::read(source).unwrap()).unwrap().0;
    for body in [
        "0.001 * now.ball.x + 0.1 * count(events, \"pass\", \"us\")",
        "let n = 0; for p in now.them.players { if p.x > now.ball.x && distance(p, now.ball) < 5.0 { n += 1; } } n * 0.1",
        "let best = nearest(now.us.players, now.ball); half(distance(best, now.ball)) + half(1)",
        "let all = now.them.players; all.filter(|p| p.x > now.ball.x && p.speed > 1.0).len() * 0.1",
        "this.n += 1; this.gap = now.ball.x; `${now.ball.x} of ${this.n}`.len",
        "if now.us.has_ball && now.me != () && now.me.speed > 3.0 { \"text // { [\".len } else { 'a'; 0 }",
    ] {
        let source =
            format!("fn half(x) {{ x / 2 }}\nfn reward(ctx, now, prev, events) {{ {body} }}");
        assert_eq!(counted(&source), source);
    }
    let source = "fn reward(ctx, now, prev, events) { let a = this.a[\"]\"]; /* } */ let b = a; b.c[0].d /* a */ }";
    let expected = "fn reward(ctx, now, prev, events) { let a = setpiece_counted(this.a[\"]\"]); /* } */ \
                    let b = setpiece_counted(a); setpiece_counted(b.c[0].d) /* a */ }";
    assert_eq!(counted(source), expected);
    for odd in [
        "this.f = || ;; 1",
        "this.f = |x, | x; let a = []; this.g = |x, | a; 1",
        "let a = []; let f = || { a // }\n }; 1",
    ] {
        assert_eq!(pay(odd), 1.0, "{odd}");
    }
    let fault = check_script("fn setpiece_counted(x) { x }", &[], "none", &ScriptNames::default())
        .pop()
        .unwrap();
    assert_eq!((fault.kind, fault.range), (ScriptFaultKind::Syntax, 23..24));
    assert_eq!(fault.message, "`setpiece_counted` is not available in a script");
}
