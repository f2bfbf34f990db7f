use super::api::getters_complete;
use super::*;
use crate::random::{Purpose, Stream};
use crate::state::PlayerId;
use crate::state::event::Event;
use crate::testing::{event, scenario, view};
use setpiece_scenario::Script;
use setpiece_scenario::vocabulary::{EventKind, Qualifier, Team};

fn scene(events: &[Event]) -> Arc<HookScene> {
    let prev = view([0.0, 0.0], [20.0, 0.0], [0.0, 0.0, 0.11]);
    let mut now = view([27.2, 8.36], [30.2, 12.36], [27.2, -8.36, 0.5]);
    now.owner = Some(PlayerId(1));
    now.possession = Some(Team::Left);
    now.score = [2, 1];
    now.step = 30;
    now.players[1].vel = [3.0, 4.0];
    let mut params = rhai::Map::new();
    params.insert("width".into(), 4.5.into());
    Arc::new(HookScene::new(
        now,
        prev,
        events,
        Arc::new(params),
        Stream::new(1, 2, Purpose::Script),
        (1, 2),
    ))
}

fn scripts(source: &str) -> Scripts {
    let mut scenario = scenario(&[]);
    scenario.scripts.push(Script {
        name: "own.rhai".to_owned(),
        at: (1, 1),
        source: source.to_owned(),
        named: Vec::new(),
        modules: Vec::new(),
    });
    Scripts::compile(&scenario).unwrap()
}

impl Scripts {
    /// Calls a `reward` hook that returns a number.
    fn reward(
        &self,
        script: u32,
        scene: &Arc<HookScene>,
        perspective: Perspective,
        arguments: &[Argument<'_>],
        memory: &mut Memory,
    ) -> Result<f64, ScriptError> {
        let mut value = [0.0];
        let asked = RewardAsked { terms: &[], arguments };
        self.reward_terms(script, scene, perspective, asked, memory, &mut value)?;
        Ok(value[0])
    }
}

fn pay_for(body: &str, us: Team, events: &[Event]) -> Result<f64, ScriptError> {
    let source = format!("fn reward(ctx, now, prev, events) {{\n{body}\n}}");
    let me = Some(if us == Team::Left { PlayerId(1) } else { PlayerId(12) });
    let perspective = Perspective { us, me, agent: 0 };
    scripts(&source).reward(0, &scene(events), perspective, &[], &mut Memory::default())
}

fn pay(body: &str) -> f64 {
    pay_for(body, Team::Left, &[]).unwrap()
}

fn fail(body: &str) -> ScriptError {
    pay_for(body, Team::Left, &[]).unwrap_err()
}

fn near(found: f64, expected: f64) {
    assert!((found - expected).abs() < 1e-5, "{found} for {expected}");
}

#[test]
fn every_name_has_its_getter() {
    let missing: Vec<Member> = members().filter(|member| !getters_complete(member)).collect();
    assert_eq!(missing, []);
}

#[test]
fn properties_bear_the_languages_names() {
    near(pay("now.ball.x"), 0.5);
    near(pay("now.ball.y"), -0.1);
    near(pay("now.ball.height"), 0.5);
    near(pay("prev.ball.x"), 0.0);
    near(pay("now.us.players[1].speed"), 5.0);
    near(pay("now.me.speed + now.me.velocity.x"), 8.0);
    near(pay("now.score.us - now.score.them"), 1.0);
    near(pay("now.elapsed"), 3.0);
    near(pay("ctx.params.width"), 4.5);
    near(pay("if now.possession == \"us\" && now.ball.owner == now.me { 1.0 } else { 0.0 }"), 1.0);
    near(
        pay("if now.possession == now.us && now.possession != now.them { 1.0 } else { 0.0 }"),
        1.0,
    );
    near(pay("if prev.ball.owner == () && now.ball.owner != () { 1 } else { 0 }"), 1.0);
    near(pay("now.players.len + now.them.players.len"), 4.0);
    assert_eq!(pay("now.remaining"), f64::INFINITY);
    near(pay("if now.game_mode == \"normal\" && now.me.role == \"CM\" { 1 } else { 0 }"), 1.0);
    near(
        pay(
            "if now.me.action == \"idle\" && !now.me.sprinting && !now.me.dribbling { 1 } else { 0 }",
        ),
        1.0,
    );
}

#[test]
fn the_right_side_reads_its_own_frame() {
    let pay = |body| pay_for(body, Team::Right, &[]).unwrap();
    near(pay("now.ball.x"), -0.5);
    near(pay("now.them.players[1].velocity.x"), -3.0);
    near(pay("now.us.goal.x"), -55.0 / 54.4);
    near(pay("now.score.us"), 1.0);
    near(pay("if now.possession == \"them\" { 1 } else { 0 }"), 1.0);
    near(pay("now.me.x"), -30.2 / 54.4);
    near(pay("now.point(-0.5, 0.1).x - now.ball.x"), 0.0);
}

#[test]
fn helpers_measure() {
    near(pay("distance(now.me, now.ball)"), 16.72);
    near(pay("distance(now.me, now.them.players[0])"), 5.0);
    near(pay("grf_distance(now.ball, now.point(1.0, 0.0))"), (0.25f64 + 0.01).sqrt());
    near(pay("angle(now.me, now.ball)"), -std::f64::consts::FRAC_PI_2);
    near(pay("nearest(now.us.players, now.ball).x"), 0.5);
    near(pay("if pressed(now.me, 5.1) && !pressed(now.me, 4) { 1 } else { 0 }"), 1.0);
    near(pay("pow(2, 3) + sqrt(9) + clamp(5.0, 0.0, 1.0) + smoothstep(0.0, 1.0, 0.5)"), 12.5);
    assert!(fail("distance(now.me, prev.ball.owner)").message.contains("found nobody"));
}

fn pay_terms(body: &str, terms: &[&str]) -> Result<Vec<f64>, String> {
    let source = format!("fn reward(ctx, now, prev, events) {{\n{body}\n}}");
    let terms: Vec<String> = terms.iter().map(|&term| term.to_owned()).collect();
    let asked = RewardAsked { terms: &terms, arguments: &[] };
    let perspective = Perspective { us: Team::Left, me: Some(PlayerId(1)), agent: 0 };
    let mut values = vec![0.0; terms.len().max(1)];
    let memory = &mut Memory::default();
    scripts(&source)
        .reward_terms(0, &scene(&[]), perspective, asked, memory, &mut values)
        .map(|()| values)
        .map_err(|error| format!("{}:{} {}", error.line, error.column, error.message))
}

#[test]
fn a_map_pays_each_of_its_terms() {
    let terms = &["goal", "tempo"];
    assert_eq!(pay_terms("#{tempo: -0.1, goal: 1}", terms), Ok(vec![1.0, -0.1]));
    assert_eq!(
        pay_terms("let pay = #{}; pay.goal = 2.5; pay.tempo = 0; pay", terms),
        Ok(vec![2.5, 0.0])
    );
    for (body, message) in [
        ("#{goal: 1}", "1:4 the map has no term `tempo`"),
        ("#{goal: 1, tempo: 0, temp: 1}", "1:4 no term is called `temp`; did you mean `tempo`?"),
        ("#{goal: 1, tempo: \"x\"}", "1:4 term `tempo`: expected a number, found a string"),
        ("0.5", "1:4 expected a map of `goal`, `tempo`, found a number"),
    ] {
        assert_eq!(pay_terms(body, terms), Err(message.to_owned()));
    }
    let alone = pay_terms("#{goal: 1}", &[]).unwrap_err();
    assert!(alone.contains("expected a number, found a map"), "{alone}");
}

#[test]
fn whole_numbers_serve_where_numbers_do() {
    near(pay("clamp(7, 0, 5) + clamp(now.ball.x, 0, 1) + clamp(0.5, 0.0, 1)"), 6.0);
    assert_eq!(pay("[1, 2, 3][clamp(9, 0, 1)] + 7 / clamp(2, 0, 5)"), 5.0);
    near(pay("smoothstep(0, 1, now.ball.x) + smoothstep(0, 10, 5)"), 1.0);
    near(pay("distance(now.point(1, 0), now.point(0.5, 0))"), 27.2);
    assert!(fail("clamp(now.ball, 0, 1)").message.contains("expected a number, found a ball"));
    let found = fail("nearest(now.us.players, 3.0)").message;
    assert!(found.contains("expected a player, a point or the ball, found a number"), "{found}");
    let found = fail("distance(now.ball, now.score)").message;
    assert!(!found.contains("Seen"), "{found}");
    let racing = fail("now.them.players.filter(|p| p.x > now.ball.x).len()");
    assert!(racing.message.contains("a closure reads the variable"), "{racing}");
    near(pay("let all = now.them.players; all.filter(|p| p.x > now.ball.x).len()"), 1.0);
}

#[test]
fn a_kind_is_counted_as_in_the_language() {
    let pass = |qualifier| Event {
        qualifier: Some(qualifier),
        ..event(EventKind::Pass, Some(Team::Left), Some(1))
    };
    let shot = event(EventKind::Shot, Some(Team::Left), Some(1));
    let saved = Event { qualifier: Some(Qualifier::OnTarget), ..shot };
    let events = [
        pass(Qualifier::Attempted),
        pass(Qualifier::Completed),
        pass(Qualifier::Attempted),
        shot,
        saved,
    ];
    let pay = |body| pay_for(body, Team::Left, &events).unwrap();
    near(pay("count(events, \"pass\") + 10 * count(events, \"pass completed\", \"us\")"), 12.0);
    near(pay("count(events, \"shot\") + 10 * count(events, \"shot on_target\")"), 11.0);
    near(pay("count(events, \"pass completed\", \"them\")"), 0.0);
    assert_eq!(
        faults("count(events, \"pass completed\") + count(events, \"pass complete\")").len(),
        1
    );
}

#[test]
fn events_are_an_array() {
    let events = [
        event(EventKind::Goal, Some(Team::Left), Some(1)),
        event(EventKind::Corner, Some(Team::Right), None),
    ];
    let pay = |body| pay_for(body, Team::Left, &events).unwrap();
    near(pay("count(events, \"goal\", \"us\") + 10 * count(events, \"goal\", \"them\")"), 1.0);
    let body =
        "let n = 0.0; for e in events { if e.kind == \"goal\" && e.by == now.me { n += 1.0; } } n";
    near(pay(body), 1.0);
    near(pay("if events[1].by == () && events[1].team == \"them\" { 1 } else { 0 }"), 1.0);
}

#[test]
fn memory_lasts_and_random_numbers_are_seeded() {
    let scripts = scripts(
        "fn reward(ctx, now, prev, events) { this.n = (this.n ?? 0) + 1; this.n + ctx.random() }",
    );
    let perspective = Perspective { us: Team::Left, me: None, agent: 0 };
    let run = || {
        let (mut memory, scene) = (Memory::default(), scene(&[]));
        let mut pay = || scripts.reward(0, &scene, perspective, &[], &mut memory).unwrap();
        [pay(), pay(), pay()]
    };
    let paid = run();
    assert_eq!(paid, run());
    assert_eq!(paid.map(f64::trunc), [1.0, 2.0, 3.0]);
    assert_ne!(paid[0].fract(), paid[1].fract());
    assert_eq!(pay("if ctx.random() == ctx.random() { 1 } else { 0 }"), 0.0);
}

#[test]
fn reset_is_called_once_an_episode() {
    let source =
        "fn reset(ctx) { this.n = 10; }\nfn reward(ctx, now, prev, events) { this.n += 1; this.n }";
    let scripts = scripts(source);
    let perspective = Perspective { us: Team::Left, me: None, agent: 0 };
    for _ in 0..2 {
        let (mut memory, scene) = (Memory::default(), scene(&[]));
        let mut pay = || scripts.reward(0, &scene, perspective, &[], &mut memory).unwrap();
        assert_eq!([pay(), pay()], [11.0, 12.0]);
    }
}

/// Rhai ends the line of a comment at a lone carriage return.
#[test]
fn a_fault_lies_in_the_text_whatever_ends_its_lines() {
    let comments = "// one\r \n".repeat(8);
    for map in ["#{goal: now.ball.x}", "#{goal: 1}", "#{goal: 1, é: 2}"] {
        let source = format!("fn reward(ctx, now, prev, events) {{\n{comments}{map} }}\n");
        for terms in [&[][..], &["tempo"]] {
            let known = ScriptNames { terms, ..ScriptNames::default() };
            let faults = check_script(&source, &[], "reward", &known);
            assert!(!faults.is_empty(), "{map}");
            let lies_in = |range: &std::ops::Range<usize>| source.get(range.clone()).is_some();
            assert!(faults.iter().all(|fault| lies_in(&fault.range)), "{map}: {faults:?}");
        }
    }
}

#[test]
fn the_sandbox_holds() {
    for body in [
        "loop { }",
        "let x = 0; while true { x += 1; } x",
        "let a = [1]; loop { a += a; }",
        "let s = \"x\"; loop { s += s; }",
    ] {
        let error = fail(body);
        assert!(!error.message.is_empty() && error.line >= 1, "{body}: {error}");
    }
    let recursion = "fn f(n) { f(n + 1) }\nfn reward(ctx, now, prev, events) { f(0) }";
    let perspective = Perspective { us: Team::Left, me: None, agent: 0 };
    let error = scripts(recursion)
        .reward(0, &scene(&[]), perspective, &[], &mut Memory::default())
        .unwrap_err();
    assert!(error.message.contains("deeper"), "{error}");
    for text in ["eval(\"1\")", "import \"x\" as y;", "export", "2.0 ** 3.0"] {
        let faults = check_script(
            &format!("fn reward(ctx, now, prev, events) {{ {text} }}"),
            &[],
            "reward",
            &ScriptNames::default(),
        );
        assert!(!faults.is_empty(), "{text}");
    }
    for call in ["timestamp()", "sleep(1)", "exit()", "parse_json(\"1\")"] {
        assert!(fail(call).message.starts_with("no function"), "{}", fail(call));
        assert_eq!(faults(call).len(), 1, "{call}");
    }
}

#[test]
fn failures_name_their_place() {
    let error = fail("let x = 1;\n  now.ball.heigth");
    assert_eq!((error.script.as_str(), error.line, error.hook.as_str()), ("own.rhai", 3, "reward"));
    assert!(error.message.contains("heigth"), "{error}");
    let error = fail("\"far\"");
    assert_eq!(error.message, "expected a number, found a string");
    assert_eq!((error.line, error.column), (1, 4));
    assert_eq!(fail("if false { 1.0 }").message, "expected a number, found nothing");
    assert!(fail("throw \"no\"").message.contains("no"));
    assert!(fail("let a = [1]; a[5]").line == 2);
}

/// For every script, its bytecode and Rhai's tree walker agree: values, memory, messages and
/// places.
#[test]
fn bytecode_and_walker_agree() {
    let events = [
        event(EventKind::Shot, Some(Team::Left), Some(1)),
        event(EventKind::Corner, Some(Team::Right), None),
    ];
    let mut lowered = 0;
    for body in [
        "now.ball.x + now.us.players[1].speed",
        "let gap = distance(now.ball, now.them.goal); if gap < 20.0 && now.ball.speed > 5.0 { 1.0 } else { -gap }",
        "angle(now.me, events[0]) + grf_distance(prev.ball, now.point(0.5, 0.1)) + distance(events[1], now.me)",
        "this.n = (this.n ?? 0) + 1; this.seen = now.ball.x; this.n * 0.5 + this.seen",
        "let n = 0; for (p, i) in now.players { if p.x > 0.0 { n += i; } else { continue; } } n",
        "let a = [1, 2.5, now.ball]; a.push(4); a[1] + a[3] + a[2].x",
        "now.us.players.filter(|p| p.role != \"GK\").len() * 0.1",
        "let k = 2.0; let f = |x| x * k; f.call(3.0)",
        "switch now.game_mode { \"corner\" => 1.0, \"normal\" if events.len > 1 => 2.0, _ => 0.0 }",
        "let m = #{ a: #{ b: 1 } }; m.a.b += 2; `${m.a.b} and ${now.ball.x}`.len",
        "helper(2) + helper(now.ball.x)",
        "try { helper(()) } catch (e) { 3.0 }",
        "let i = 0; while true { i += 1; if i > 10 { break; } } do { i -= 1; } until i < 5; i",
        "ctx.random() + ctx.params.width + ctx.step + ctx.index",
        "count(events, \"shot\", \"us\") + count(events, \"shot\", \"them\") * 10",
        "let x = 1;\n  now.ball.heigth",
        "distance(now.me, prev.ball.owner)",
        "distance(now.me,\n 5)",
        "throw \"no\"",
        "let a = [1];\n a[5]",
        "helper(())",
        "\"far\"",
        "this.a.b",
        "loop { }",
        "now.players.map(|p| { loop { } }).len",
    ] {
        let source = format!(
            "fn helper(x) {{ if x == 2 {{ return 1.0; }} x * 3.0 }}\nfn reward(ctx, now, prev, events) {{\n{body}\n}}"
        );
        let (own, walked) = (scripts(&source), scripts(&source).walked());
        lowered += u32::from(own.is_lowered());
        let perspective = Perspective { us: Team::Left, me: Some(PlayerId(1)), agent: 0 };
        let run = |scripts: &Scripts| {
            let (mut memory, scene) = (Memory::default(), scene(&events));
            let paid: Vec<_> =
                (0..3).map(|_| scripts.reward(0, &scene, perspective, &[], &mut memory)).collect();
            (paid, memory.this.to_string(), scene.random())
        };
        assert_eq!(format!("{:?}", run(&own)), format!("{:?}", run(&walked)), "{body}");
    }
    assert!(lowered > 18, "only {lowered} were lowered");
}

#[test]
fn scripts_on_one_thread_do_not_mix() {
    let perspective = Perspective { us: Team::Left, me: None, agent: 0 };
    let double = scripts("fn f(x) { x * 2 }\nfn reward(ctx, now, prev, events) { f(3) }");
    let triple = scripts("fn f(x) { x * 3 }\nfn reward(ctx, now, prev, events) { f(3) }");
    let broken = scripts("fn f(x) { throw x }\nfn reward(ctx, now, prev, events) { f(3) }");
    let pay = |scripts: &Scripts| {
        scripts.reward(0, &scene(&[]), perspective, &[], &mut Memory::default())
    };
    for _ in 0..3 {
        assert_eq!(pay(&double), Ok(6.0));
        assert!(pay(&broken).is_err());
        assert_eq!(pay(&triple), Ok(9.0));
    }
}

#[test]
fn every_call_has_operations_of_its_own() {
    let scripts =
        scripts("fn reward(ctx, now, prev, events) { let n = 0; for i in 0..10000 { n += i; } n }");
    let perspective = Perspective { us: Team::Left, me: None, agent: 0 };
    for _ in 0..40 {
        assert_eq!(
            scripts.reward(0, &scene(&[]), perspective, &[], &mut Memory::default()),
            Ok(49_995_000.0)
        );
    }
    for body in [
        "now.players.map(|p| { let n = 0; for i in 0..80000 { n += i; } n }).len",
        "let n = 0; for i in 0..300000 { n += i; } n",
    ] {
        assert_eq!(
            fail(body).message,
            "more than 200000 operations in one call: a loop doesn't end"
        );
    }
}

#[test]
fn memory_is_bounded_and_a_failure_names_the_files_line() {
    let perspective = Perspective { us: Team::Left, me: None, agent: 0 };
    for (grow, held) in [
        (
            "this.m = #{}; for i in 0..100 { this[`${ctx.step}_${this.len()}`] = i; }",
            "512 entries of maps",
        ),
        (
            "if this.a == () { this.a = []; } for i in 0..500 { this.a.push(i); }",
            "4096 elements of arrays",
        ),
        (
            "this.s = (this.s ?? \"\") + \"0123456789\"; this.t = this.s; this.s += this.t;",
            "4096 bytes of strings",
        ),
        ("this.a = [this.a];", "48 levels"),
    ] {
        let scripts = scripts(&format!("fn reward(ctx, now, prev, events) {{ {grow} 1 }}"));
        let (mut memory, scene) = (Memory::default(), scene(&[]));
        let failed =
            (0..60).find_map(|_| scripts.reward(0, &scene, perspective, &[], &mut memory).err());
        let failed = failed.unwrap_or_else(|| panic!("{grow}: never too much"));
        let expected = failed.message == format!("`this` holds more than {held}")
            || failed.message.contains("too large");
        assert!(expected, "{grow}: {failed}");
    }
    let mut scenario = scenario(&[]);
    let source = "fn reward(ctx, now, prev, events) { throw 1 }\nfn f() { 1 }".to_owned();
    scenario.scripts.push(Script {
        name: "inline in a.pitch".to_owned(),
        at: (9, 22),
        source,
        named: Vec::new(),
        modules: Vec::new(),
    });
    let scripts = Scripts::compile(&scenario).unwrap();
    let failed =
        scripts.reward(0, &scene(&[]), perspective, &[], &mut Memory::default()).unwrap_err();
    assert_eq!((failed.line, failed.column), (9, 21 + 37));
}

/// A hook that doesn't read the events gets none. One that does gets them wherever it reads them.
#[test]
fn events_are_there_for_who_looks() {
    let events = [event(EventKind::Goal, Some(Team::Left), Some(1))];
    let perspective = Perspective { us: Team::Left, me: None, agent: 0 };
    for source in [
        "fn reward(ctx, now, prev, happened) { happened.len }",
        "fn n(list) { list.len }\nfn reward(ctx, now, prev, events) { n(events) }",
        "fn reward(ctx, now, prev, events) { let f = || events.len; f.call() }",
        "fn reward(ctx, now, prev, events) { `${events.len}`.parse_int() }",
    ] {
        let paid =
            scripts(source).reward(0, &scene(&events), perspective, &[], &mut Memory::default());
        assert_eq!(paid, Ok(1.0), "{source}");
    }
}

fn faults(body: &str) -> Vec<(ScriptFaultKind, String, Option<String>)> {
    let source = format!("fn reward(ctx, now, prev, events) {{\n{body}\n}}");
    let of = |fault: ScriptFault| (fault.kind, source[fault.range].to_owned(), fault.help);
    let known = ScriptNames { params: &["pace"], ..ScriptNames::default() };
    check_script(&source, &[], "reward", &known).into_iter().map(of).collect()
}

#[test]
fn right_scripts_have_no_fault() {
    let bodies = [
        "now.ball.x",
        "let best = nearest(now.us.players, now.ball); best.speed",
        "let n = 0; for p in now.them.players { if p.x > now.ball.x && distance(p, now.ball) < 5.0 { n += 1; } } n * 0.1",
        "this.last = #{ x: now.ball.x, taken: false }; this.last.taken = true; if this.last.taken { 1.0 } else { 0.0 }",
        "now.us.players.filter(|p| p.role != \"GK\").len() * 0.1",
        "let m = #{ width: 2 }; m.width + ctx.params.pace",
        "now.us.players[0].velocity.x + now.us.players[0].at.y",
        "if events.is_empty() { 0 } else { events[0].by.speed }",
        "let own = now.ball; own.height.floor() + min(1.0, 2.0) + `${now.ball.x}`.len",
        "switch now.game_mode { \"corner\" => 1.0, _ => 0.0 }",
    ];
    for body in bodies {
        assert_eq!(faults(body), [], "{body}");
    }
}

#[test]
fn wrong_names_are_found_with_their_place() {
    let name = |word: &str, suggestion: &str| {
        (ScriptFaultKind::Name, word.to_owned(), Some(format!("did you mean `{suggestion}`?")))
    };
    assert_eq!(faults("now.ball.heigth"), [name("heigth", "height")]);
    assert_eq!(faults("now.us.players[0].sped"), [name("sped", "speed")]);
    assert_eq!(faults("for p in now.players { p.fatigu; } 0"), [name("fatigu", "fatigue")]);
    assert_eq!(faults("let b = now.ball; b.hight"), [name("hight", "height")]);
    assert_eq!(faults("distnce(now.me, now.ball)"), [name("distnce", "distance")]);
    assert_eq!(faults("now.posession"), [name("posession", "possession")]);
    assert_eq!(faults("noww.ball.x"), [name("noww", "now")]);
    assert_eq!(faults("ctx.params.paze * 2.0"), [name("paze", "pace")]);
    assert_eq!(faults("let p = ctx.params; p.width")[0].1, "width");
    let several = faults("now.ball.heigth + prev.me.sped\n+ distnce(1, 2)");
    assert_eq!(several.len(), 3);
    // The ball doesn't have a player's property.
    assert_eq!(faults("now.ball.fatigue")[0].1, "fatigue");
}

#[test]
fn arguments_words_and_changes_are_checked() {
    let fault =
        |word: &str, help: &str| (ScriptFaultKind::Name, word.to_owned(), Some(help.to_owned()));
    let distance = "distance(a, b): metres along the ground, between players, points and the ball";
    assert_eq!(faults("distance(now.ball)"), [fault("distance", distance)]);
    assert_eq!(faults("now.ball.distance(now.me)"), []);
    assert_eq!(faults("ctx.random() + ctx.random(2)")[0].1, "random");
    assert_eq!(
        faults("if now.ball.x > 2.0 { count(events, \"pas\") }"),
        [fault("\"pas\"", "did you mean `pass`?")]
    );
    assert_eq!(faults("count(events, \"pass\", \"left\")").len(), 1);
    assert_eq!(faults("events.count(\"pass\", \"them\") + count(events, \"goal\")"), []);
    assert_eq!(faults("now.ball.x = 3.0; 1")[0].1, "now");
    assert_eq!(faults("let b = now.ball; b.x += 3.0; 1").len(), 1);
    assert_eq!(
        faults(
            "let list = now.players; list[0] = (); let m = #{ x: 1 }; m.x = 2; this.x = now.ball.x; m.x"
        ),
        []
    );
    let of = |source: &str, hook: &str| -> Vec<String> {
        check_script(source, &[], hook, &ScriptNames::default())
            .into_iter()
            .map(|fault| fault.message)
            .collect()
    };
    let own = "fn h(a) { a }\nfn h(a, b) { b }\nfn reward(ctx, now, prev, events) { h(1) + h(1, 2) + 1.h(2) + h(1, 2, 3) }";
    assert_eq!(of(own, "reward"), ["`h` takes 1 or 2 arguments, found 3"]);
    let done = "fn done(ctx, now, prev, events) { now.me.x > 0.5 }";
    assert_eq!(of(done, "done"), ["nobody is `me` where an episode's end is judged"]);
}

#[test]
fn hooks_are_checked() {
    let missing = check_script(
        "fn rewards(ctx, now, prev, events) { 0 }",
        &[],
        "reward",
        &ScriptNames::default(),
    );
    assert_eq!((missing.len(), missing[0].kind), (1, ScriptFaultKind::Hook));
    assert_eq!(missing[0].help.as_deref(), Some("write `fn reward(ctx, now, prev, events) { … }`"));
    let source = "\n fn reward(now) { 0 }";
    let few = check_script(source, &[], "reward", &ScriptNames::default());
    assert_eq!((few[0].kind, &source[few[0].range.clone()]), (ScriptFaultKind::Hook, "reward"));
    assert_eq!(few[0].message, "`reward` takes 4 arguments, found 1");
    let source = "fn reward(ctx, now, prev, events) {\n    1 + \n}";
    let broken = check_script(source, &[], "reward", &ScriptNames::default());
    assert_eq!(broken[0].kind, ScriptFaultKind::Syntax);
    assert_eq!(&source[broken[0].range.clone()], "}");
    assert_eq!(
        check_script("", &[], "reward", &ScriptNames::default())[0].kind,
        ScriptFaultKind::Hook
    );
}

#[test]
fn only_scripts_that_ask_run_for_each_agent() {
    assert!(scripts("fn reward(ctx, now, prev, events) { now.me.x }").uses_me(0));
    assert!(!scripts("fn reward(ctx, now, prev, events) { now.ball.x }").uses_me(0));
}

mod budget;
mod modules;
mod printing;
