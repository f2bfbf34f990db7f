//! Fixes of what is reported, and what is offered besides.

use super::{ATTACK, SHARED, behind, marked, workspace};
use setpiece::editor::{ActionKind, Workspace};
use std::path::Path;

/// Every help that says what to write applies itself, and mends what it is about.
#[test]
fn fixes_mend_what_they_are_about() {
    for (line, fixed) in [
        ("reward scorin", "reward scoring"),
        ("end limit 400", "end limit 400s"),
        ("require distance(ball, right.goal) > 3", "require distance(ball, right.goal) > 3m"),
        ("require ball.metres.x > self.metres.x", ""),
        ("end when 30s", "end when elapsed > 30s"),
        ("rules { ofside: off }", "rules { offside: off }"),
        ("team right { CF at (0.5 0.1) }", "team right { CF at (0.5, 0.1) }"),
        ("team right { CFF at (0.5, 0.1) }", "team right { CF at (0.5, 0.1) }"),
        ("reward \"scoring\"", "reward scoring"),
        ("limit 200", "end limit 200 steps"),
        ("reward r { give 0.1 * closing(ball, right.goal) }", "right.goal) / 1m }"),
        ("team right { CF at (0.5, 0.1 }", "team right { CF at (0.5, 0.1) }"),
        ("team right { CF at (0.5, 0.1] }", "team right { CF at (0.5, 0.1) }"),
        ("team right { CF at (0.5, 0.1 facing 90deg }", "CF at (0.5, 0.1) facing 90deg }"),
        ("end when distance(ball, centre < 3m // near", "distance(ball, centre) < 3m // near"),
        ("end when (ball in right.box", "end when (ball in right.box)\n"),
        ("reward r {\n        give 1 on goal by us", "        give 1 on goal by us\n    }\n"),
        ("reward r { give 1 on goal by us", "reward r { give 1 on goal by us }\n"),
        ("reward r { give 1 on goal as \"goal }", "as \"goal\" }"),
        ("reward r { give 1 on goal as \"\" }", ""),
        (
            "reward r { give 0.1 * max(0, min(1, closing(ball, them.goal) / 1m as \"near\" }",
            "1m)) as \"near\" }",
        ),
        ("let x = max(1,\n        2\n    require x > 0", "        2)\n    require"),
        ("record near = count of ball in right.box", ""),
        ("reward r { give 1 if ball in them.box }", "{ give 1 when ball in them.box }"),
        ("reward r { give -1 if ball in us.box }", "{ give -1 when ball in us.box }"),
        ("reward r { give -1 if goal by them }", "{ give -1 when goal by them }"),
        ("team right { CF at (0.09m, 0) }", ""),
        ("reward r { give 1 on goal completed by us }", "give 1 on goal by us }"),
        ("reward r { give 1 on goal_by_us }", "give 1 on goal by us }"),
        ("reward r { give 1 when me.has_ball }", "give 1 when me has ball }"),
        ("reward r { give 1 on ball_dead }", "give 1 when ball_dead }"),
        ("rules { offside = on }", "rules { offside: on }"),
        ("team right { GK (-1, 0) }", "team right { GK at (-1, 0) }"),
        ("team right { CM striker at (0.5, 0) }", "team right { striker: CM at (0.5, 0) }"),
        ("var a = 3", "    let a = 3\n"),
        ("end limit 0.25s", "end limit 3 steps"),
        ("end deep when ball.x > 5m", "end deep when ball.metres.x > 5m"),
        ("reward r { give 1 on goal by us as 'x' }", "by us as \"x\" }"),
        ("end a when ball == right.box", "end a when ball in right.box"),
        ("end a when 0.1 < ball.x < 0.5", "when 0.1 < ball.x and ball.x < 0.5"),
        ("team right { CF at right.box }", "team right { CF in right.box }"),
        ("end caught when offside by left", "{\n    rules { offside: on }\n    ball at"),
        (
            "rules { cards: on, offside: off }\n    end caught when offside by left",
            "rules { cards: on, offside: on }\n",
        ),
        (
            "rules { cards: on }\n    end caught when offside by left",
            "rules { offside: on, cards: on }\n",
        ),
        // An option of another block goes there, and takes its comma or its empty braces along.
        ("rules { drag: 2 }", "{\n    world { drag: 2 }\n    ball at"),
        ("rules { drag: 2, offside: on }", "    rules { offside: on }\n"),
        ("rules { offside: on, drag: 2 }\n    world { swerve: 2 }", "    rules { offside: on }\n"),
        ("rules { drag: 2 }\n    world { swerve: 2 }", "    world { drag: 2, swerve: 2 }\n"),
        ("world { offside: on }", "{\n    rules { offside: on }\n    ball at"),
        ("world { length: 60m }", "{\n    pitch { length: 60m }\n    ball at"),
        ("team right { CB at (0.8, 0) { drag: 2 } }", "team right { CB at (0.8, 0) }"),
        ("team right { drag: 2 }", "team right {  }"),
        ("team right { fatigue: 0.5 }", ""),
        ("reward r { give normal(0, 1, 2) * 0 + 1 }", ""),
        ("end a when !ball_dead", "end a when not ball_dead"),
        (
            "reward r { give uniform(0, 1) }",
            "{\n    let drawn = uniform(0, 1)\n    ball at (0.5, 0)",
        ),
        ("reward r { give uniform(0, 1) }", "reward r { give drawn }"),
        ("gravity: 9.81", "    world { gravity: 9.81 }\n"),
        ("let a = 1  let b = a ** 2", ""),
        ("reward r { give ball.x ** 2 }", "give pow(ball.x, 2) }"),
        // What is warned of once the text makes sense is no reason to leave it broken.
        ("let spare = 3\n    reward r { give 1 on gaol by us }", "give 1 on goal by us"),
    ] {
        let text = format!(
            "scenario a extends academy {{\n    ball at (0.5, 0)\n    team left {{ CF at (0.4, 0) }}\n    {line}\n}}\n"
        );
        let path = Path::new("/nowhere/fix.pitch");
        let mut workspace = Workspace::default();
        workspace.set(path, &text);
        let reports = workspace.reports()[path].clone();
        let report = reports.first().unwrap_or_else(|| panic!("{line}: nothing is wrong"));
        let actions = workspace.actions(path, report.place.range.clone());
        let fixes: Vec<_> = actions.iter().filter(|it| it.kind == ActionKind::Fix).collect();
        if fixed.is_empty() {
            assert!(fixes.is_empty(), "{line}: {fixes:?}");
            continue;
        }
        let fix = fixes.first().unwrap_or_else(|| panic!("{line}: no fix for {report:?}"));
        let mut after = text.clone();
        // From the back, so that the first place stays right.
        let mut edits = fix.edits.clone();
        edits.sort_by_key(|edit| std::cmp::Reverse(edit.place.range.start));
        for edit in &edits {
            after.replace_range(edit.place.range.clone(), &edit.text);
        }
        assert!(after.contains(fixed), "{line}: {}\n{after}", fix.title);
    }
}

/// Lines of Google Research Football are replaced as a whole, and no help brings its own numbers.
#[test]
fn everything_that_says_how_is_mended_at_once() {
    let text = "scenario s extends academy {\n    agents { left: alle }\n    \
        builder.config().game_duration = 400\n    \
        builder.SetBallPosition(0.26, y)\n    ball at (0.26, -0.11)\n    reward scorin\n}\nscenario \
        t extends academy {\n    builder.SetBallPosition(-0.26, -0.11)\n}\n";
    let path = Path::new("/nowhere/grf.pitch");
    let mut workspace = Workspace::default();
    workspace.set(path, text);
    assert!(!workspace.reports()[path].is_empty());
    let all = workspace.fix_all(path).expect("something can be mended");
    assert_eq!(all.kind, ActionKind::FixAll);
    let after = &all.edits[0].text;
    for expected in [
        "    end limit 400 steps\n",
        "builder.SetBallPosition(0.26, y)",
        "    ball at (-0.26, -0.11)\n",
        "reward scoring\n",
        // Of several forms the author chooses one.
        "left: alle",
    ] {
        assert!(after.contains(expected), "{expected}: {after}");
    }
}

/// However many slips a text has, all of them are mended at once, and what isn't a slip stays.
#[test]
fn hundreds_of_slips_are_mended_at_once() {
    let line = |name: &str| format!("    end success when distance({name}, ball) < 3m\n");
    let (mut slips, mut mended) = (String::new(), String::new());
    for part in 0..40 {
        let head = format!(
            "scenario s{part} extends academy {{\n    ball at (0.5, 0)\n    team left {{ striker: CF at (0.4, 0) }}\n"
        );
        // What nothing is like stays as it is.
        let unlike = if part == 20 { line("xyzzy") } else { String::new() };
        for (text, name, region) in
            [(&mut slips, "strikr", "right.bax"), (&mut mended, "striker", "right.box")]
        {
            text.push_str(&head);
            for _ in 0..3 {
                text.push_str(&line(name));
            }
            text.push_str(&format!("{unlike}    end failure when ball in {region}\n}}\n"));
        }
    }
    let path = Path::new("/nowhere/slips.pitch");
    let mut workspace = Workspace::default();
    workspace.set(path, &slips);
    assert_eq!(workspace.reports()[path].len(), 161);
    let all = workspace.fix_all(path).expect("slips");
    assert_eq!(all.edits[0].text, mended);
}

#[test]
fn a_file_that_declares_an_unknown_name_is_imported() {
    let folder = Path::new("/nowhere/pitches");
    let (attack, shared) = (folder.join("attack.pitch"), folder.join("shared.pitch"));
    let text = ATTACK.replace("import \"shared.pitch\"\n\n", "");
    let mut workspace = Workspace::default();
    workspace.set(&attack, &text);
    workspace.set(&shared, SHARED);
    let at = behind(&text, "reward pressing");
    let actions = workspace.actions(&attack, at..at);
    let import = actions.iter().find(|it| it.title.contains("import")).expect("an import");
    assert_eq!(import.edits[0].text, "import \"shared.pitch\"\n");
    assert_eq!(import.edits[0].place.range, 0..0);
}

#[test]
fn what_is_offered_besides_says_the_same() {
    let (mut workspace, attack, _) = workspace();
    let mut of = |words: &str, length: usize| {
        let at = behind(ATTACK, words);
        workspace.actions(&attack, at..at + length)
    };
    let titles = |actions: Vec<setpiece::editor::Action>| -> Vec<String> {
        actions.into_iter().map(|it| it.title).collect()
    };
    assert_eq!(titles(of("ball at (", 0))[0], "write the place in metres: `(27.2m, 0m)`");
    let region = titles(of("them_box = cir", 0));
    assert!(region.iter().any(|it| it == "give the region a name"), "{region:?}");
    let team = titles(of("striker: CF", 0));
    assert!(team.iter().any(|it| it == "make a formation of these players"), "{team:?}");
    let number = titles(of("circle(right.goal, 1", 0));
    assert!(number.iter().any(|it| it == "make `12m` a parameter"), "{number:?}");
    // A parameter has no other one as its value.
    let (mut workspace, path, at) = marked(
        "scenario s extends academy {\n    param far: length = 3‸m\n    end when distance(ball, right.goal) < far\n}\n",
    );
    let offered = titles(workspace.actions(&path, at..at));
    assert!(!offered.iter().any(|it| it.contains("a parameter")), "{offered:?}");
}
