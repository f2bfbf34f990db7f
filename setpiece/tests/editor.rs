//! What an editor is answered, on whole and broken texts. `‸` marks the cursor.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

#[path = "editor/actions.rs"]
mod actions;
#[path = "editor/completion.rs"]
mod completion;
#[path = "editor/fixes.rs"]
mod fixes;
#[path = "editor/grf.rs"]
mod grf;
#[path = "editor/layout.rs"]
mod layout;
#[path = "editor/naming.rs"]
mod naming;
#[path = "editor/preview.rs"]
mod preview;

use setpiece::editor::text::Lines;
use setpiece::editor::{FoldedKind, LensKind, RenameError, Workspace};
use std::path::{Path, PathBuf};

/// A scenario to ask about; `name` follows a line of comment.
const ATTACK: &str = "\
import \"shared.pitch\"

/// Two against one.
scenario attack extends academy {
    /// How far from goal it begins.
    param far: length = 20m in 10m..40m
    ball at (0.5, 0)
    team left {
        striker: CF at (0.45, 0)
        CM at (0.4, 0.1)
    }
    team right {
        CB at right.goal + (-15m, 0m)
    }
    reward scoring
    reward pressing(within: 3m)
    require distance(ball, right.goal) > far
    end success near when ball in them_box
    region them_box = circle(right.goal, 12m)
}
";

const SHARED: &str = "\
/// Pays for a near opponent.
reward pressing(within: length = 2m) {
    give 0.1 per second when pressed(me, within: within)
}
fn halved(x: number) = x / 2
";

/// A workspace with `attack.pitch` and `shared.pitch` open, in a folder that isn't there.
fn workspace() -> (Workspace, PathBuf, PathBuf) {
    let folder = Path::new("/nowhere/pitches");
    let (attack, shared) = (folder.join("attack.pitch"), folder.join("shared.pitch"));
    let mut workspace = Workspace::default();
    workspace.set(&attack, ATTACK);
    workspace.set(&shared, SHARED);
    (workspace, attack, shared)
}

/// One text, without its cursor, and where that stands.
fn marked(text: &str) -> (Workspace, PathBuf, usize) {
    let at = text.find('‸').expect("a cursor");
    let path = PathBuf::from("/nowhere/pitches/one.pitch");
    let mut workspace = Workspace::default();
    workspace.set(&path, &text.replacen('‸', "", 1));
    (workspace, path, at)
}

/// The byte behind the first place of some words.
fn behind(text: &str, words: &str) -> usize {
    text.find(words).expect(words) + words.len()
}

#[test]
fn a_sound_text_and_what_it_imports_have_no_reports() {
    let (mut workspace, attack, shared) = workspace();
    let reports = workspace.reports();
    assert_eq!(reports.keys().collect::<Vec<_>>(), [&attack, &shared]);
    assert!(reports.values().all(Vec::is_empty), "{reports:?}");
}

#[test]
fn a_problem_stands_in_the_file_that_has_it() {
    let (mut workspace, attack, shared) = workspace();
    workspace.set(&shared, &SHARED.replace("per second", "per secnd"));
    let reports = workspace.reports();
    assert!(!reports[&shared].is_empty());
    let of_attack: Vec<_> = reports[&attack].iter().map(|it| it.code.to_string()).collect();
    assert!(of_attack.iter().all(|code| code == "SP0201"), "{of_attack:?}");
    // A file that isn't open any more counts as it is on disk: not at all, here.
    workspace.close(&shared);
    let codes =
        workspace.reports()[&attack].iter().map(|it| it.code.to_string()).collect::<Vec<_>>();
    assert!(codes.contains(&"SP0005".to_owned()) || !codes.is_empty(), "{codes:?}");
}

#[test]
fn a_file_outside_is_read_only_if_it_may_be() {
    let (inner, outer) =
        (Path::new("/nowhere/pitches/a/one.pitch"), Path::new("/nowhere/pitches/shared.pitch"));
    let text = "import \"../shared.pitch\"\nscenario a extends academy {\n    ball at (0, 0)\n    \
        team left { CF at (0, 0) }\n    reward pressing\n}\n";
    for (allowed, codes) in [(true, &[][..]), (false, &["SP0001"][..])] {
        let mut workspace = Workspace::new(allowed);
        workspace.set(inner, text);
        workspace.set(outer, SHARED);
        let found: Vec<String> =
            workspace.reports()[inner].iter().map(|report| report.code.to_string()).collect();
        assert_eq!(found.iter().filter(|code| *code == "SP0001").count(), codes.len(), "{found:?}");
        assert_eq!(found.is_empty(), allowed);
    }
}

/// The reports are those of `setpiece check`, but for what only a dry run shows.
#[test]
fn reports_are_those_of_a_check() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let mut files: Vec<PathBuf> = Vec::new();
    for folder in ["examples", "stdlib-scenarios/academy", "stdlib-scenarios/benchmark"] {
        let entries = std::fs::read_dir(root.join(folder)).expect(folder);
        files.extend(entries.filter_map(|entry| Some(entry.ok()?.path())));
    }
    files.retain(|path| path.extension().is_some_and(|ending| ending == "pitch"));
    assert!(files.len() > 30, "{files:?}");
    for path in files {
        let checked = setpiece::check(&path).expect("a file that can be read");
        let mut expected: Vec<String> = checked
            .problems
            .iter()
            .filter(|problem| !problem.code().to_string().starts_with("SP06"))
            .map(|problem| problem.words().message)
            .collect();
        let mut workspace = Workspace::default();
        workspace.set(&path, &std::fs::read_to_string(&path).expect("a text"));
        let reports = workspace.reports();
        let mut found: Vec<String> =
            reports.values().flatten().map(|report| report.message.clone()).collect();
        expected.sort();
        found.sort();
        assert_eq!(found, expected, "{}", path.display());
    }
}

#[test]
fn hover_says_what_a_name_a_word_or_a_value_is() {
    let of = |line: &str, words: &str| {
        let text = format!(
            "scenario a extends academy {{\n    ball at (0.5, 0)\n    team left {{ striker: CF at (0.45, 0) }}\n    \
             reward scoring\n    {line}\n}}\n"
        );
        let at = behind(&text, words) - 1;
        let mut workspace = Workspace::default();
        let path = Path::new("/nowhere/hover.pitch");
        workspace.set(path, &text);
        workspace.hover(path, at).map(|hover| hover.text).unwrap_or_default()
    };
    for (line, words, expected) in [
        ("", "(0.5", "a point: (27.2m, 0m), normalised (0.5, 0)"),
        ("", "(0.45", "here stands striker (left)"),
        ("", "(0.45", "30.5m from the right one"),
        ("", "team", "**team**: the players of a team"),
        ("", "CF", "**CF**: centre forward"),
        ("", "scoring", "+1 for a goal"),
        (
            "/// How far.\n    param far: length = 20m in 10m..40m\n    require distance(ball, right.goal) > far",
            "> far",
            "How far.",
        ),
        (
            "let d = uniform(2m, 6m)\n    require distance(ball, left.goal) > d",
            "unif",
            "mean 4m, from 2m to 6m",
        ),
        ("end limit 40s", "40s", "a duration: 40s, 400 steps"),
        ("reward r { give 0.1 on pass completed by us }", "pass", "**pass**"),
        ("reward r { give 0.1 when me.speed > 3m/s }", "speed", "**speed**"),
        ("rules { offside: off }", "offside", "/language/start/"),
    ] {
        let hover = of(line, words);
        assert!(hover.contains(expected), "{words}: {hover}");
    }
}

#[test]
fn signatures_show_the_argument_at_the_cursor() {
    for (call, label, active) in [
        ("distance(ball, ‸", "distance(a, b)", 1),
        ("clamp(‸", "clamp(x, low, high)", 0),
        ("clamp(1, min(2, 3), ‸", "clamp(x, low, high)", 2),
        ("halved(‸", "halved(x: number)", 0),
        ("far_from(spot: ball, ‸", "far_from(spot: point, least: length = 2m)", 1),
        ("far_from(least: ‸", "far_from(spot: point, least: length = 2m)", 1),
    ] {
        let text = format!(
            "fn halved(x: number) = x / 2\nfn far_from(spot: point, least: length = 2m) = distance(ball, spot) > least\n\
             reward r {{ give 1 when {call}\n}}\n"
        );
        let (mut workspace, path, at) = marked(&text);
        let signature = workspace.signature(&path, at).unwrap_or_else(|| panic!("{call}"));
        assert_eq!((signature.label.as_str(), signature.active), (label, active), "{call}");
        assert!(!signature.arguments.is_empty(), "{call}");
    }
    let (mut workspace, path, at) = marked("reward r { give 1 when (ball.x > ‸ }");
    assert_eq!(workspace.signature(&path, at), None, "brackets without a call");
}

#[test]
fn a_name_leads_to_its_declaration_and_its_uses() {
    let (mut workspace, attack, shared) = workspace();
    let place = workspace.declaration(&attack, behind(ATTACK, "reward pressing")).expect("a place");
    assert_eq!((&place.path, &SHARED[place.range.clone()]), (&shared, "pressing"));
    let uses = workspace.references(&shared, behind(SHARED, "reward pressing"));
    assert_eq!(uses.iter().map(|it| &it.path).collect::<Vec<_>>(), [&attack, &shared]);
    let library =
        workspace.declaration(&attack, behind(ATTACK, "extends academy")).expect("a place");
    assert!(library.is_in_library(), "{library:?}");
    // A name that nothing uses leads to itself.
    let unused = workspace.declaration(&shared, behind(SHARED, "fn halved")).expect("a place");
    assert_eq!(&SHARED[unused.range], "halved");
}

#[test]
fn renaming_crosses_files_and_keeps_the_meaning() {
    let (mut workspace, attack, shared) = workspace();
    let at = behind(ATTACK, "reward pressing");
    let edits = workspace.rename(&attack, at, "hunting").expect("a new name");
    let files: Vec<_> = edits.iter().map(|edit| &edit.place.path).collect();
    assert_eq!(files, [&attack, &shared]);
    let refused = |workspace: &mut Workspace, words: &str, name: &str| {
        workspace.rename(&attack, behind(ATTACK, words), name).expect_err("refused")
    };
    assert_eq!(refused(&mut workspace, "reward scoring", "x"), RenameError::OfLibrary);
    let nothing = RenameError::NotAName("a b".to_owned());
    assert_eq!(refused(&mut workspace, "reward pressing", "a b"), nothing);
    let captures = RenameError::Captures("scoring".to_owned());
    assert_eq!(refused(&mut workspace, "reward pressing", "scoring"), captures);
    let captures = RenameError::Captures("ball".to_owned());
    assert_eq!(refused(&mut workspace, "param far", "ball"), captures);
    let edits =
        workspace.rename(&attack, behind(ATTACK, "param far"), "distance_m").expect("a name");
    assert_eq!(edits.len(), 2);
}

#[test]
fn a_broken_text_still_has_an_outline_folds_and_selections() {
    let broken = ATTACK.replace("team right {", "team right {{{");
    let path = Path::new("/nowhere/broken.pitch");
    let mut workspace = Workspace::default();
    workspace.set(path, &broken);
    let analysis = workspace.analysis(path).expect("a text");
    assert!(!analysis.reports.is_empty());
    assert_eq!(analysis.symbols().first().map(|it| it.name.clone()).as_deref(), Some("attack"));
    assert!(analysis.folds().len() >= 2, "{:?}", analysis.folds());
    let at = behind(&broken, "striker");
    let selections = analysis.selections(at);
    assert!(selections.len() >= 4, "{selections:?}");
    assert!(selections.windows(2).all(|pair| {
        pair[1].start <= pair[0].start && pair[0].end <= pair[1].end && pair[0] != pair[1]
    }));
    let hover = workspace.hover(path, behind(&broken, "ball at (0")).map(|it| it.text);
    assert!(hover.is_some_and(|text| text.contains("27.2m")), "a value before the slip");
}

#[test]
fn folds_are_blocks_comments_and_imports() {
    let text = "import \"a.pitch\"\nimport \"b.pitch\"\n\n/// One.\n/// Two.\nscenario a {\n    ball at (\n        0, 0)\n}\n";
    let path = Path::new("/nowhere/folds.pitch");
    let mut workspace = Workspace::default();
    workspace.set(path, text);
    let kinds: Vec<FoldedKind> =
        workspace.analysis(path).expect("a text").folds().iter().map(|it| it.kind).collect();
    assert_eq!(
        kinds,
        [FoldedKind::Imports, FoldedKind::Comment, FoldedKind::Block, FoldedKind::Block]
    );
}

#[test]
fn hints_show_metres_arguments_and_what_is_inherited() {
    let text = "fn far_from(spot: point, least: length) = distance(ball, spot) > least\n\
        scenario a extends academy {\n    ball at (0.5, 0)\n    let x = uniform(0, 1)\n    team left { CF at (0.4, 0) }\n    \
        require x > 0.3\n    require x < 0.4\n    end success far when far_from(right.goal, 60m)\n}\n";
    let path = Path::new("/nowhere/hints.pitch");
    let mut workspace = Workspace::default();
    workspace.set(path, text);
    let analysis = workspace.analysis(path).expect("a text");
    assert!(analysis.reports.is_empty(), "{:?}", analysis.reports);
    let hints: Vec<String> =
        analysis.hints(&(0..text.len())).iter().map(|it| it.text.clone()).collect();
    for expected in ["27.2m, 0.0m", "spot:", "least:"] {
        assert!(hints.iter().any(|it| it == expected), "{expected}: {hints:?}");
    }
    assert!(hints.iter().any(|it| it.starts_with("from academy: ")), "{hints:?}");
    // The second one refuses half of them, which a report says a little later.
    let refused = hints.iter().filter_map(|it| it.strip_prefix("refuses ")?.strip_suffix('%'));
    let refused: Vec<f64> = refused.map(|it| it.parse().expect("a share")).collect();
    let [refused] = refused.as_slice() else { panic!("{hints:?}") };
    assert!((20.0..40.0).contains(refused), "{refused}");
}

/// A shaped reward beside an inherited one: what both pay for is said.
#[test]
fn what_an_inherited_reward_pays_for_too_is_said() {
    let said = |parent: &str, reward: &str| -> Vec<String> {
        let text = format!(
            "reward mine {{\n    give 2 on goal by us\n}}\nscenario a{parent} {{\n    ball at (0.5, 0)\n    \
             team left {{ CF at (0.4, 0) }}\n    {reward}\n    end limit 3s\n}}\n"
        );
        let path = Path::new("/nowhere/paid.pitch");
        let mut workspace = Workspace::default();
        workspace.set(path, &text);
        let analysis = workspace.analysis(path).expect("a text");
        let hints = analysis
            .hints(&(0..text.len()))
            .into_iter()
            .map(|it| (text[..it.at].rsplit('\n').next().unwrap().trim().to_owned(), it.text));
        let paid = hints.filter(|(_, hint)| hint.contains("pays for"));
        paid.map(|(line, hint)| format!("{line} ⟨{hint}⟩")).collect()
    };
    let academy = " extends academy";
    assert_eq!(
        said(
            academy,
            "reward r {\n    give 0.1 on pass completed by us\n    on goal by  us {\n    give 1\n} }"
        ),
        ["on goal by  us ⟨`scoring` pays for it, too⟩"]
    );
    assert_eq!(said(academy, "reward mine"), ["give 2 on goal by us ⟨`scoring` pays for it, too⟩"]);
    assert_eq!(said(academy, "reward r { give 0.1 on goal by them when me.x > 0 }").len(), 1);
    assert_eq!(said(academy, "reward mine\n    remove reward scoring"), [""; 0]);
    assert_eq!(said("", "reward mine"), [""; 0]);
}

#[test]
fn lenses_run_draw_check_and_count() {
    let text = format!(
        "{ATTACK}check \"it is scored\" {{\n    play attack with bot for 20 episodes\n    expect success_rate > 1%\n}}\n"
    );
    let (mut workspace, attack, shared) = workspace();
    workspace.set(&attack, &text);
    let kinds: Vec<LensKind> = workspace.lenses(&attack).into_iter().map(|it| it.kind).collect();
    let name = || "attack".to_owned();
    let expected =
        [LensKind::Run(name()), LensKind::Draw(name()), LensKind::Check("it is scored".to_owned())];
    assert_eq!(kinds, expected);
    let titles: Vec<String> = workspace.lenses(&shared).into_iter().map(|it| it.title).collect();
    assert_eq!(titles, ["used once", "used nowhere here"]);
}

#[test]
fn hierarchies_follow_extends_and_uses() {
    let text = "abstract scenario base extends academy { ball at centre }\nfn near(p: point) = distance(ball, p) < 3m\n\
        scenario one extends base { team left { CF at (0, 0) } end success a when near(right.goal) }\n\
        scenario two extends base { team left { CF at (0.1, 0) } end success a when near(left.goal) }\n";
    let path = Path::new("/nowhere/family.pitch");
    let mut workspace = Workspace::default();
    workspace.set(path, text);
    let base = workspace.node(path, behind(text, "scenario base")).expect("base");
    let names = |nodes: Vec<setpiece::editor::ItemNode>| -> Vec<String> {
        nodes.into_iter().map(|it| it.name).collect()
    };
    assert_eq!(names(workspace.children(&base)), ["one", "two"]);
    assert_eq!(names(workspace.parents(&base)), ["academy"]);
    let near = workspace.node(path, behind(text, "fn near")).expect("near");
    let callers = workspace.callers(&near).into_iter().map(|it| it.node.name).collect::<Vec<_>>();
    assert_eq!(callers, ["one", "two"]);
    let one = workspace.node(path, behind(text, "scenario one")).expect("one");
    let callees = workspace.callees(&one).into_iter().map(|it| it.node.name).collect::<Vec<_>>();
    assert!(
        callees.contains(&"near".to_owned()) && callees.contains(&"base".to_owned()),
        "{callees:?}"
    );
}

/// Random edits: no crash, and the answers of a server that has seen only the last text.
#[test]
fn any_edit_leads_to_what_a_fresh_workspace_says() {
    let edits = std::env::var("SETPIECE_EDITS").ok().and_then(|it| it.parse().ok()).unwrap_or(300);
    let (mut workspace, attack, shared) = workspace();
    let pieces = [
        "}",
        "{",
        "\"",
        "reward ",
        "scoring",
        "\n",
        "ball at (0.5, 0)",
        "//",
        "/*",
        "*/",
        "3m",
        " when ",
        "é",
        "😀",
        ".",
        "team left { CF at (0, 0) }",
        "\"\"\"",
        "param x = 1\n",
        "(",
        ")",
        ",",
        "end ",
        "striker",
        "0x",
        "-",
    ];
    let mut state = 7_u64;
    let mut random = |below: usize| {
        state =
            state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) as usize % below.max(1)
    };
    let mut undo: Vec<(PathBuf, String)> = Vec::new();
    for step in 0..edits {
        let path = if random(4) == 0 { &shared } else { &attack };
        let mut text = workspace.text(path).expect("open").to_string();
        let boundary = |text: &str, at: usize| {
            (0..=at).rev().find(|at| text.is_char_boundary(*at)).unwrap_or_default()
        };
        undo.push((path.clone(), text.clone()));
        let len = text.len() + 1;
        let at = boundary(&text, random(len));
        match random(4) {
            0 if undo.len() > 3 => {
                undo.pop();
                let (path, before) = undo.swap_remove(random(undo.len()));
                workspace.set(&path, &before);
                continue;
            }
            1 => {
                let end = boundary(&text, (at + random(12)).min(text.len())).max(at);
                text.replace_range(at..end, "");
            }
            _ => text.insert_str(at, pieces[random(pieces.len())]),
        }
        if text.len() > 6_000 {
            text = ATTACK.to_owned();
        }
        workspace.set(path, &text);
        undo.truncate(20);
        if step % 10 == 0 {
            let mut fresh = Workspace::default();
            for path in [&attack, &shared] {
                fresh.set(path, &workspace.text(path).expect("open").clone());
            }
            assert_eq!(workspace.reports(), fresh.reports(), "{text}");
            let at = boundary(&text, at);
            assert_eq!(workspace.hover(path, at), fresh.hover(path, at), "{text}");
            assert_eq!(workspace.complete(path, at), fresh.complete(path, at), "{text}");
            assert_eq!(workspace.signature(path, at), fresh.signature(path, at), "{text}");
            assert_eq!(workspace.references(path, at), fresh.references(path, at), "{text}");
            let (one, other) =
                (workspace.analysis(path).expect("open"), fresh.analysis(path).expect("open"));
            assert_eq!(one.tokens(), other.tokens(), "{text}");
            assert_eq!(one.folds(), other.folds(), "{text}");
            assert_eq!(one.selections(at), other.selections(at), "{text}");
            assert_eq!(workspace.lenses(path), fresh.lenses(path), "{text}");
            let lines = Lines::of(&text);
            assert_eq!(lines.offset(&text, lines.position(&text, at)), at, "{text}");
        }
        if step % 100 == 0 {
            let within = at..(at + 20).min(text.len());
            let _ =
                workspace.actions(path, boundary(&text, within.start)..boundary(&text, within.end));
            let _ = workspace.preview(path, at);
            let _ = workspace.format(path);
        }
    }
}

/// A selection in a thousand open brackets grows a hundred times, and then to the whole text.
#[test]
fn a_selection_grows_in_few_steps() {
    let (mut workspace, path, at) = marked(&format!("{}‸", "scenario a {\n".repeat(1_000)));
    let analysis = workspace.analysis(&path).expect("a text");
    let grown = analysis.selections(at);
    assert_eq!(grown.len(), 100);
    assert_eq!(grown.last(), Some(&(0..analysis.text.len())));
    assert!(grown.windows(2).all(|it| it[1].start <= it[0].start && it[0].end <= it[1].end));
}
