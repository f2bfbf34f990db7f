//! What may be written at a place.

use super::marked;

/// A text, the words that are offered at its mark, and others that are not.
type CompletionCase = (String, &'static [&'static str], &'static [&'static str]);

/// A scenario with a parameter, a player and a line.
fn scenario(inside: &str) -> String {
    format!(
        "scenario a extends academy {{\n    param far: length = 3m\n    team left {{ striker: CF at (0.4, 0) }}\n    {inside}\n}}\n"
    )
}

fn assert_completes(cases: &[CompletionCase]) {
    for (text, has, has_not) in cases {
        let (mut workspace, path, at) = marked(text);
        let found: Vec<String> =
            workspace.complete(&path, at).into_iter().map(|it| it.text).collect();
        for word in *has {
            assert!(found.iter().any(|it| it == word), "no `{word}` in {text}\n{found:?}");
        }
        for word in *has_not {
            assert!(!found.iter().any(|it| it == word), "`{word}` in {text}\n{found:?}");
        }
    }
}

#[test]
fn completion_knows_the_place() {
    assert_completes(&[
        ("‸".to_owned(), &["scenario", "reward", "import"], &["ball", "CF"]),
        (scenario("‸"), &["ball", "team", "end"], &["GK", "scenario"]),
        (scenario("team right { ‸ }"), &["GK", "CB", "maybe"], &["ball"]),
        (scenario("reward ‸"), &["scoring", "checkpoints"], &["GK"]),
        (scenario("end success when ball in them.‸"), &["box", "half", "goal"], &["far", "pitch"]),
        (scenario("require striker.metres.‸"), &["x", "y"], &["fatigue", "speed", "metres"]),
        (scenario("reward r { give 1 on goal ‸"), &["by", "when"], &["completed", "on_target"]),
        (scenario("reward r { give 1 on shot ‸"), &["on_target", "by"], &["completed", "taken"]),
        (scenario("end success when ball.‸"), &["speed", "height"], &["fatigue"]),
        (scenario("end success when striker.‸"), &["fatigue", "role"], &["height"]),
        (
            scenario("reward r { give 1 when distance(me, ‸"),
            &["striker", "far", "ball", "distance"],
            &["import"],
        ),
        (scenario("rules { ‸ }"), &["offside", "half_time"], &["GK"]),
        (scenario("reward r { give 0.1 on ‸ }"), &["pass", "shot", "goal"], &["ball", "distance"]),
        (
            scenario("reward r { give 0.1 on pass ‸ }"),
            &["completed", "by", "to", "when"],
            &["ball", "shot"],
        ),
        (scenario("reward r { give 0.1 on pass by ‸"), &["striker", "us", "left"], &["distance"]),
        (scenario("reward r { give 0.1\n        ‸"), &["on", "when", "as", "give"], &["ball"]),
        (
            scenario("reward r { give 0.01 * closing(‸"),
            &["ball", "striker", "them"],
            &["by", "pass"],
        ),
        (scenario("end ‸"), &["limit", "success", "failure", "when"], &["ball", "CM"]),
        (scenario("end success when ‸"), &["goal", "ball", "not", "elapsed"], &["ahead"]),
        (scenario("end limit 400 ‸"), &["steps"], &["pass", "ball"]),
        (
            scenario("ball ‸"),
            &["at", "in", "ahead of", "left of", "between"],
            &["striker", "pass", "left"],
        ),
        (scenario("ball at ‸"), &["striker", "left", "centre"], &["completed", "by"]),
        (scenario("record n = ‸"), &["count", "max", "ball"], &["import"]),
        (scenario("record n = count of ‸"), &["pass", "goal"], &["import", "ahead"]),
        (scenario("remove ‸"), &["reward", "end", "record"], &["ball_lost", "striker"]),
        (scenario("team ‸"), &["left", "right"], &["striker"]),
        (scenario("param x: ‸"), &["length", "number"], &["striker"]),
        (scenario("team right { CB ‸"), &["at", "in", "jitter", "absent"], &["pass"]),
        (scenario("team right { keeper: ‸"), &["GK"], &["distance"]),
        (scenario("team right { difficulty: ‸"), &["far"], &["at"]),
        (scenario("observe vector { me.speed ‸"), &["noise", "delayed", "as"], &["import"]),
        ("behavior b { do ‸ }".to_owned(), &["press", "hold"], &["ball"]),
        (scenario("end limit 40‸"), &["steps", "m/s"], &["pass"]),
        (scenario("// a ‸"), &[], &["ball"]),
        // The first words of a file.
        ("x = ‸".to_owned(), &[], &["scoring"]),
        (scenario("/* a ‸ */"), &[], &["ball"]),
        (scenario("// }\n    ‸"), &["ball", "team"], &["scenario"]),
        (scenario("reward scoring as \"}\"\n    ‸"), &["ball", "team"], &["scenario"]),
        ("behavior b { if me has ball { ‸".to_owned(), &["do", "if"], &["press", "ball"]),
        ("behavior b { choose { 2: ‸".to_owned(), &["do"], &["press", "ball"]),
        (
            scenario("reward r { when me has ball { give 1 } else { ‸"),
            &["give", "when"],
            &["ball", "distance"],
        ),
        ("import \"‸".to_owned(), &["std/rewards.pitch"], &["ball"]),
        ("scenario b extends ‸".to_owned(), &["academy", "academy_corner"], &["ball"]),
        (
            scenario("reward s script rhai \"\"\"fn reward(ctx, now, prev, events) { now.ball.‸"),
            &["speed", "at"],
            &["fatigue"],
        ),
        (
            scenario("reward s script rhai \"\"\"fn reward(ctx, now, prev, events) { ctx.‸"),
            &["params", "step"],
            &["ball"],
        ),
        (
            scenario("reward s script rhai \"\"\"fn reward(ctx, now, prev, events) { now.named.‸"),
            &["striker"],
            &["ball", "far"],
        ),
        (
            scenario("reward s script rhai \"\"\"fn reward(ctx, now, prev, events) { ctx.params.‸"),
            &["far"],
            &["striker"],
        ),
        (scenario("end success when right.goal.‸"), &["x", "y", "metres"], &["fatigue", "speed"]),
        (scenario("end success when centre.‸"), &["x"], &["fatigue"]),
        (scenario("end success when right.box.‸"), &[], &["x", "fatigue"]),
    ]);
}

#[test]
fn completion_knows_what_an_option_may_be() {
    assert_completes(&[
        (scenario("rules { offside: ‸"), &["on", "off"], &["auto", "GK"]),
        (scenario("rules { physics: ‸ }"), &["gated", "full"], &["on", "far"]),
        (scenario("reward r { give 1 on goal when event.‸"), &["at", "by"], &["x", "by_team"]),
        (scenario("team right { CB at own.zone.‸"), &["CB", "GK"], &["x", "fatigue"]),
        (scenario("team right { CB at (0.8, 0) { fatigue: ‸"), &["far", "uniform"], &["GK"]),
        (scenario("world { ‸ }"), &["wind", "gravity"], &["wind_x"]),
        (scenario("kickoff left { ‸ }"), &["kicking", "receiving"], &["ball"]),
        (scenario("kickoff left { kicking: ‸ }"), &["grf_kicking"], &["kicking", "ball"]),
        (scenario("agents { left: [striker, ‸] }"), &["striker"], &["switching"]),
        (scenario("start ‸"), &["corner", "kickoff"], &["normal", "kick_off"]),
        (scenario("start kickoff { score: ‸"), &["[0, 0]"], &["ball", "far"]),
        (scenario("start kickoff { elapsed: ‸"), &["far", "uniform"], &["ball", "press"]),
        (scenario("world { drag: ‸"), &["far", "uniform"], &["ball", "striker", "grf_kicking"]),
        (scenario("pitch { goal: ‸ }"), &["far"], &["ball", "striker"]),
        (
            scenario("team right { CB at (0, 0) { ai: if far > 1m then ‸"),
            &["press", "bot", "lazy"],
            &["striker", "distance", "far"],
        ),
        (
            scenario("team right { CB at (0, 0) { ai: if far > 1m then press else ‸ } }"),
            &["mark", "hold"],
            &["striker", "ball"],
        ),
        (scenario("team right { CB at (0, 0) { ai: script ‸"), &["rhai"], &["and", "has", "in"]),
        (scenario("param p: bool = ‸"), &["true", "false", "far"], &["ball", "striker"]),
        (scenario("param p: team = ‸"), &["left", "right"], &["ball", "striker"]),
        (scenario("param p: length = ‸ in 1m..3m"), &["far", "min"], &["uniform", "striker"]),
        ("scenario a(p: bool = ‸".to_owned(), &["true", "false"], &["ball"]),
        ("reward r(n: int = 1, w: number = ‸".to_owned(), &["max"], &["ball"]),
        ("const far: length = ‸".to_owned(), &["min"], &["ball", "uniform"]),
        (scenario("ball beyond centre by 2m from ‸"), &["striker", "left"], &["rhai"]),
        (scenario("reward r { give 0.1 * ‸"), &["closing", "ball"], &["grf_kicking"]),
        (scenario("team right { formation: choice(‸"), &["grf_kicking"], &[]),
        (scenario("let shape = ‸"), &["grf_kicking"], &[]),
        ("formation f { ‸ }".to_owned(), &["CB"], &["difficulty"]),
        ("formation f extends ‸".to_owned(), &["grf_kicking"], &["academy"]),
        ("check \"c\" { play academy with ‸".to_owned(), &["bot", "run_and_shoot"], &["ball"]),
        (scenario("mirror: ‸"), &["flanks", "ends"], &["far", "striker"]),
        (scenario("agents { left: ‸ }"), &["all", "[striker]"], &["striker", "distance", "far"]),
        (scenario("agents { others: ‸ }"), &["bot", "hold"], &["striker"]),
        (scenario("team right { GK at (1, 0) { ai: ‸"), &["lazy", "press"], &["distance", "GK"]),
        (scenario("team right { GK at (1, 0) { difficulty: 1, overlap: ‸"), &["allowed"], &["on"]),
        (scenario("end limit 100 ‸"), &["steps", "s"], &["m", "deg"]),
        ("behavior b { do press for ‸".to_owned(), &["min", "elapsed"], &["press", "limit"]),
        ("import ‸".to_owned(), &["\"std/rewards.pitch\""], &["ball"]),
    ]);
}

/// Whatever is offered for an option is understood there.
#[test]
fn every_setting_that_is_offered_compiles() {
    let texts = [
        ("agents { others: ‸ }", 2),
        ("agents { left: 1, switching: ‸ }", 2),
        ("agents { left: ‸ }", 1),
        ("mirror: ‸", 3),
        ("rules { physics: ‸ }", 2),
        ("rules { offside: ‸ }", 2),
        ("rules { half_time: ‸ }", 1),
        ("team right { CB at (0.8, 0) { ai: ‸ } }", 3),
        ("team right { CB at (0.8, 0) { controllable: ‸ } }", 2),
        ("team right { CB at (0.8, 0) { overlap: ‸ } }", 1),
    ];
    for (line, count) in texts {
        let text = format!(
            "scenario a extends academy {{\n    ball at (0.5, 0)\n    team left {{ striker: CF at (0.4, 0) }}\n    {line}\n}}\n"
        );
        let (mut workspace, path, at) = marked(&text);
        let offered = workspace.complete(&path, at);
        let settings: Vec<_> = offered.iter().filter(|it| it.detail == "setting").collect();
        assert_eq!(settings.len(), count, "{line}: {offered:?}");
        for setting in settings {
            let mut workspace = setpiece::editor::Workspace::default();
            workspace.set(&path, &text.replace('‸', &setting.text));
            let reports = workspace.reports();
            let errors: Vec<_> = reports[&path]
                .iter()
                .filter(|it| it.severity == setpiece::dsl::problem::Severity::Error)
                .collect();
            assert!(errors.is_empty(), "{line} {}: {errors:?}", setting.text);
        }
    }
}

/// An answer takes time that grows with the text, not with what is nested in it.
#[test]
fn deep_nesting_is_answered() {
    for text in ["{\n".repeat(60), "behavior b {\n".repeat(2_000), "(\n".repeat(2_000)] {
        let (mut workspace, path, at) = marked(&format!("{text}‸"));
        workspace.complete(&path, at);
        assert_eq!(workspace.hover(&path, at), None);
    }
}

/// A word of several meanings is explained as what it can be where it stands.
#[test]
fn a_word_means_what_may_be_written_there() {
    let hover = |text: &str| {
        let (mut workspace, path, at) = marked(text);
        workspace.hover(&path, at).expect("a meaning").text
    };
    let count = |text: &str| text.matches("**: ").count();
    for (text, has, meanings) in [
        ("scenario a {\n    agents { le‸ft: all }\n}", "left", 1),
        ("scenario a {\n    team le‸ft { CF at (0, 0) }\n}", "left", 1),
        ("scenario a {\n    record n = cou‸nt of pass\n}", "how many events", 1),
        ("scenario a {\n    end limit 200 st‸eps\n}", "step", 1),
        ("reward r {\n    give 1 on pass b‸y left\n}", "who", 1),
        ("reward r {\n    give 1 wh‸en me has ball\n}", "paid in steps", 1),
        ("reward r {\n    give 1 on goal wh‸en me has ball\n}", "for these events", 1),
        ("reward r {\n    give 1 o‸n goal when me has ball\n}", "with one of these", 1),
        ("scenario a {\n    ball le‸ft of centre by 2m\n}", "to the left of somebody", 1),
        ("scenario a {\n    ball left o‸f centre by 2m\n}", "from which player", 1),
        ("scenario a {\n    ball between centre and left.goal a‸t 20%\n}", "how far along", 1),
        ("scenario a {\n    param far: length = 3m i‸n 1m..5m\n}", "range", 1),
        ("scenario a {\n    end wh‸en ball i", "as soon as", 1),
        ("scenario a {\n    end when ball i‸n right.box\n}", "lies in a region", 1),
        ("scenario a {\n    record n = count o‸f goal\n}", "in brackets", 1),
        ("behavior b {\n    do press f‸or 2s\n}", "how long", 1),
        ("behavior b {\n    do press unti‸l me has ball\n}", "the act ends", 1),
        ("behavior b {\n    interrupt w‸hen me has ball { do shot }\n}", "in the middle", 1),
        ("scenario a {\n    record n = mi‸n of me.speed\n}", "least value", 1),
        ("reward r {\n    give mi‸n(1, 2)\n}", "the least", 1),
        ("reward r {\n    give 1 when possession changes t‸o them\n}", "changes to", 1),
        ("reward r {\n    give 1 when me.action i‸n [shot]\n}", "in a list", 1),
        ("reward r {\n    give distance(me, nearest(them, t‸o: ball)) / 1m\n}", "measured to", 1),
        ("reward r {\n    give 1 on goal when event.a‸t in right.box\n}", "the event was", 1),
        ("suite s {\n    ea‸ch d in [0, 1] { academy_corner for 9 episodes }\n}", "one row", 1),
        ("suite s {\n    academy_corner f‸or 10 episodes\n}", "how many", 1),
        (
            "curriculum c {\n    stage a = academy until success_rate(la‸st: 20) > 90%\n}",
            "last episodes",
            1,
        ),
    ] {
        let said = hover(text);
        assert!(said.contains(has), "{text}\n{said}");
        assert_eq!(count(&said), meanings, "{text}\n{said}");
    }
}

#[test]
fn comments_and_quotes_are_not_explained() {
    for text in ["// goal‸", "/* goal‸ */", "import \"goal‸\""] {
        let (mut workspace, path, at) = marked(text);
        assert_eq!(workspace.hover(&path, at), None, "{text}");
    }
}

/// A role is offered as a role: only a name refers to a player.
#[test]
fn who_has_no_name_is_not_offered_as_a_player() {
    let (mut workspace, path, at) =
        marked("scenario a {\n    team left { CM at (0, 0)  top: CF at (0.1, 0) }\n    ball at ‸");
    let found = workspace.complete(&path, at);
    let detail = |name: &str| -> Vec<&str> {
        found.iter().filter(|it| it.text == name).map(|it| it.detail.as_str()).collect()
    };
    assert_eq!((detail("CM"), detail("top")), (vec!["role"], vec!["a player"]));
}

#[test]
fn a_region_behind_in_an_inherited_name_behind_remove_and_a_file_of_a_folder() {
    let with = |line: &str| {
        scenario(&format!(
            "let flank = choice(left.box, right.box)\n    let lane = 0.2\n    region near = right.box\n    {line}"
        ))
    };
    let regions: &[&str] = &["near", "flank", "zones", "left", "right", "centre_circle", "circle"];
    let others: &[&str] = &["far", "lane", "striker", "goal", "box", "CF", "distance", "ball"];
    let zones = "region zones = left.half\nconst width = 3m\n";
    assert_completes(&[
        (format!("{zones}{}", with("team right { CB in ‸ }")), regions, others),
        (format!("{zones}{}", with("team right { CB in ‸")), regions, others),
        (format!("{zones}{}", with("ball in ‸")), regions, others),
        (with("team right { CB at (0, 0) when ball in ‸"), &["near", "left"], &[]),
        (scenario("end mine when goal\n    remove end ‸"), &["scored", "limit"], &["mine"]),
        (scenario("reward mine { give 1 }\n    remove reward ‸"), &["scoring"], &["mine"]),
        // What is wrong elsewhere doesn't matter.
        (format!("scenario b {{ bal }}\n{}", scenario("remove end ‸")), &["scored"], &["striker"]),
    ]);
    let (mut workspace, path, at) = marked("import \"‸\"\nimport \"deeper/\"\n");
    let other = path.parent().unwrap().join("deeper/parts/two.pitch");
    workspace.set(&other, "region a = left.box\n");
    let mut offered = |at: usize| -> Vec<String> {
        workspace.complete(&path, at).into_iter().map(|it| it.text).collect()
    };
    assert!(offered(at).contains(&"deeper/parts/two.pitch".to_owned()));
    assert_eq!(offered(at + "\"\nimport \"deeper/".len()), ["parts/two.pitch"]);
}

/// What is offered says what it means there, not what the word means elsewhere.
#[test]
fn a_word_is_offered_with_what_it_means_there() {
    for (text, word, meaning) in [
        (scenario("ball ‸"), "left of", "as they face or attack"),
        (scenario("ball ‸"), "in", "drawn at reset"),
        (scenario("team right { CB ‸"), "when", "the player is there"),
        (scenario("end success ‸"), "when", "the episode ends"),
        (scenario("reward r { give 0.1 ‸"), "on", "paid in steps with one of these events"),
        (scenario("reward r { give 0.1 on goal ‸"), "by", "whose deed"),
        (scenario("start corner ‸"), "for", "the team that takes it"),
        ("behavior b { do press ‸".to_owned(), "for", "how long the act lasts"),
    ] {
        let (mut workspace, path, at) = marked(&text);
        let found = workspace.complete(&path, at);
        let offered = found.iter().find(|it| it.text == word);
        let offered = offered.unwrap_or_else(|| panic!("{text}: {found:?}"));
        assert!(offered.doc.contains(meaning), "{text}: {offered:?}");
    }
    let (mut workspace, path, at) = marked(&scenario("reward r { give 0.1 ‸"));
    let found = workspace.complete(&path, at);
    assert!(!found.iter().any(|it| it.text == "m/s"), "a unit behind a blank: {found:?}");
}

#[test]
fn a_script_is_named_by_its_file() {
    for (line, file) in [
        ("team right { CB at (0, 0) { ai: script ‸ } }", "\"press.rhai\""),
        ("team right { CB at (0, 0) { ai: script \"‸\" } }", "press.rhai"),
        ("reward script ‸", "\"press.rhai\""),
        ("reward script \"pr‸", "press.rhai"),
    ] {
        let (mut workspace, path, at) = marked(&scenario(line));
        workspace.set(&path.parent().unwrap().join("press.rhai"), "fn act(ctx, now) { 0 }");
        let found: Vec<String> =
            workspace.complete(&path, at).into_iter().map(|it| it.text).collect();
        assert!(found.iter().any(|it| it == file), "{line}: {found:?}");
        assert!(!found.iter().any(|it| it.contains(".pitch")), "{line}: {found:?}");
    }
}
