//! Names: where they are declared and used, and how they get others. `‸` marks the cursor.

use super::marked;
use setpiece::editor::text::code;
use setpiece::editor::{RenameError, SymbolKind, Workspace};
use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

/// The text after the name at the cursor has become `renamed`.
fn renamed(text: &str) -> Result<String, RenameError> {
    let (mut workspace, path, at) = marked(text);
    let mut edits = workspace.rename(&path, at, "renamed")?;
    edits.sort_by_key(|edit| std::cmp::Reverse(edit.place.range.start));
    let mut text = text.replacen('‸', "", 1);
    for edit in edits {
        assert_eq!(edit.place.path, path);
        text.replace_range(edit.place.range, &edit.text);
    }
    Ok(text)
}

/// How often the name at the cursor stands in the text after it was renamed.
fn count(text: &str) -> usize {
    renamed(text).expect(text).matches("renamed").count()
}

#[test]
fn what_replaces_something_of_the_library_keeps_its_name() {
    let text = "scenario x extends academy { param ‸difficulty = 0.9\n ball at (0, 0) }";
    let refused = renamed(text).expect_err("the library declares it");
    let item = "academy".to_owned();
    let name = "difficulty".to_owned();
    assert_eq!(refused, RenameError::ReplacesLibrary { name, item });
    let text = "scenario x extends academy { reward ‸scoring { give 1 on goal by us } }";
    let refused = renamed(text);
    assert!(matches!(refused, Err(RenameError::ReplacesLibrary { .. })), "{refused:?}");
}

#[test]
fn a_child_and_its_parent_get_a_name_together() {
    let child = "scenario child extends parent";
    for (parent, child, times) in [
        ("param ‸gap: length = 3m in 1m..9m", format!("{child} {{ param gap = 5m }}"), 2),
        ("param gap: length = 3m in 1m..9m", format!("{child} {{ param ‸gap = 5m }}"), 2),
        ("param ‸gap: length = 3m in 1m..9m", format!("{child}(gap: 4m) {{}}"), 2),
        ("let ‸far = 3m\n require far > 1m", format!("{child} {{ let far = 4m }}"), 3),
        ("const ‸far = 3m\n require far > 1m", format!("{child} {{ const far = 4m }}"), 3),
        ("record ‸kept = elapsed", format!("{child} {{ record kept = 2s }}"), 2),
        ("record ‸kept = elapsed", format!("{child} {{ remove record kept }}"), 2),
        (
            "reward ‸near { give 1 on goal by us }",
            format!("{child} {{ reward near {{ give 2 on goal by us }} }}"),
            2,
        ),
        ("reward ‸near { give 1 on goal by us }", format!("{child} {{ remove reward near }}"), 2),
        (
            "end success ‸close when ball in right.box",
            format!("{child} {{ end failure close when ball in left.box }}"),
            2,
        ),
        ("end success ‸close when ball in right.box", format!("{child} {{ remove end close }}"), 2),
        (
            "region ‸zone = circle(centre, 9m)\n require ball in zone",
            format!("{child} {{ region zone = circle(centre, 8m) }}"),
            3,
        ),
        (
            "team left { GK ‸striker: CF at (0.1, 0) }\n agents { left: [striker] }",
            format!("{child} {{ team left {{ GK striker: CM at (0.2, 0) }} }}"),
            3,
        ),
    ] {
        let parent = format!("scenario parent extends academy {{ ball at (0, 0)\n {parent} }}");
        let text = format!("{parent}\n{child}\n");
        assert_eq!(count(&text), times, "{text}");
    }
}

#[test]
fn arguments_and_assignments_are_uses() {
    let reward = "reward near(value: number = 1) { give value on goal by us }";
    let phases = "reward steps { state ‸phase = 0\n on pass { phase = phase + 1 } give phase }";
    for (text, times) in [
        (reward.replace("near(value", "near(‸value") + "\nscenario a extends academy { reward near(value: 2) }", 3),
        (phases.to_owned(), 4),
        ("behavior ‸idle { do wait for 1s }\nbehavior twice { do idle do idle }".to_owned(), 3),
        (
            "scenario a extends academy { ball at (0, 0)\n agents { left: [‸carrier] }\n \
             team left { GK carrier: CF at (0.1, 0) } }"
                .to_owned(),
            2,
        ),
        (
            "formation f { GK ‸tip: CF at (0.1, 0) }\nscenario a extends academy { ball at (0, 0)\n \
             team left { formation: f place tip at (0.2, 0) } }"
                .to_owned(),
            2,
        ),
        (
            "scenario a extends academy { ball at (0, 0) param ‸gap: length = 1m in 0m..9m }\n\
             suite all { a(gap: 2m) for 2 episodes }\n\
             check \"it\" { play a(gap: 3m) for 2 episodes\n expect success_rate >= 0% }"
                .to_owned(),
            3,
        ),
        (
            "scenario a extends academy { ball at (0, 0) record ‸kept = elapsed }\n\
             check \"it\" { play a for 2 episodes\n expect mean(record kept) >= 0 }"
                .to_owned(),
            2,
        ),
        (
            "scenario a extends academy { ball at (0, 0) param ‸pace: number = 1 in 0..2\n \
             reward script rhai \"\"\" fn reward(now, prev, event, state, ctx) { ctx.params.pace } \"\"\" }"
                .to_owned(),
            2,
        ),
    ] {
        assert_eq!(count(&text), times, "{text}");
    }
}

#[test]
fn each_part_of_a_dotted_name_is_a_name() {
    let text = "scenario a extends academy { ball at (0, 0)\n reward attack { state phase = 0\n \
                give phase }\n record last = att‸ack.phase }";
    let (mut workspace, path, at) = marked(text);
    let declared = workspace.declaration(&path, at).unwrap().range;
    let plain = text.replacen('‸', "", 1);
    assert_eq!(declared.start, plain.find("attack").unwrap());
    let declared = workspace.declaration(&path, at + 6).unwrap().range;
    assert_eq!(declared.start, plain.find("phase").unwrap());
}

/// A folder with some files, and the path of each.
fn folder(name: &str, files: &[(&str, &str)]) -> PathBuf {
    let root = std::env::temp_dir().join(format!("setpiece-naming-{name}-{}", std::process::id()));
    for (file, text) in files {
        let path = root.join(file);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, text).unwrap();
    }
    root
}

#[test]
fn closed_files_that_import_a_text_are_renamed_and_kept_whole() {
    let a = "reward pays(value: number = 1) { give value on goal by us }\n";
    let b =
        "import \"IT\"\nscenario b extends academy { ball at (0, 0)\n reward pays(value: 2) }\n";
    for (open, closed, import) in
        [("a.pitch", "b.pitch", "a.pitch"), ("lib/a.pitch", "b.pitch", "lib/a.pitch")]
    {
        let b = b.replace("IT", import);
        let root = folder("closed", &[(open, a), (closed, &b)]);
        let mut workspace = Workspace::default();
        workspace.set(&root.join(open), a);
        for (offset, times) in [(a.find("value").unwrap(), 1), (a.find("pays").unwrap(), 1)] {
            let edits = workspace.rename(&root.join(open), offset, "renamed").unwrap();
            let there = edits.iter().filter(|edit| edit.place.path == root.join(closed));
            assert_eq!(there.count(), times, "{open} {edits:?}");
        }
        // The closed file has that name itself.
        let other = format!("{b}reward mine {{ give 1 on goal by us }}\n");
        fs::write(root.join(closed), other).unwrap();
        workspace.refresh();
        let refused = workspace.rename(&root.join(open), a.find("pays").unwrap(), "mine");
        assert_eq!(refused, Err(RenameError::Captures("mine".to_owned())));
        fs::remove_dir_all(root).unwrap();
    }
}

#[test]
fn linked_places_are_those_of_a_rename() {
    let text = "reward near(‸value: number = 1) { give value on goal by us }\n\
                scenario a extends academy_empty_goal { reward near(value: 2) }";
    let (mut workspace, path, at) = marked(text);
    assert_eq!(workspace.linked(&path, at).len(), 3);
    let text = "scenario x extends academy { param ‸difficulty = 0.9\n ball at (0, 0) }";
    let (mut workspace, path, at) = marked(text);
    assert_eq!(workspace.linked(&path, at), []);
}

#[test]
fn a_text_that_cant_be_read_keeps_its_names() {
    let text = "scenario x extends academy { ball at (0,0)\n agents { left: [‸foo] }\n \
                team left { GK at (-1,0) foo: CF at (0.1,0) } }\n\
                scenario z extends academy { ball at at }";
    assert!(matches!(renamed(text), Err(RenameError::Unreadable(_))));
}

#[test]
fn a_scenario_may_be_called_six_against_six() {
    let text = "scenario ‸x extends academy { ball at (0,0) }\nreward r { give 1 on goal by us }";
    let (mut workspace, path, at) = marked(text);
    assert_eq!(workspace.rename(&path, at, "6_vs_6").unwrap().len(), 1);
    let reward = text.find("r {").unwrap() - '‸'.len_utf8();
    let refused = workspace.rename(&path, reward, "6_vs_6");
    assert_eq!(refused, Err(RenameError::NotAName("6_vs_6".to_owned())));
}

#[test]
fn a_parameter_in_brackets_is_shown_alone() {
    let text = "fn far(x: length = 1m, ‸y: number = max(1, 2)) = x * y";
    let (mut workspace, path, at) = marked(text);
    let shown = workspace.hover(&path, at).unwrap().text;
    assert!(shown.contains("```pitch\ny: number = max(1, 2)\n```"), "{shown}");
}

/// Every `.pitch` file of a folder of the repository.
fn pitches(folder: &str) -> Vec<PathBuf> {
    let mut found = Vec::new();
    let mut folders = vec![Path::new(env!("CARGO_MANIFEST_DIR")).join("..").join(folder)];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|ending| ending == "pitch") {
                found.push(path);
            }
        }
    }
    found.sort();
    found
}

/// Where a word of the language stands that a file also has as a name: options and arguments before
/// their colon, restarts, landmarks, qualifiers of events.
const WORDS: &[&str] =
    &["difficulty:", "gamma:", "wind:", "start corner", ".corner.", "shot on_target"];

#[test]
fn every_name_of_the_repository_has_a_declaration() {
    let files = [pitches("examples"), pitches("stdlib-scenarios")].concat();
    assert!(files.len() > 20);
    let mut missing = Vec::new();
    for path in files {
        let text = fs::read_to_string(&path).unwrap();
        let mut workspace = Workspace::default();
        workspace.set(&path, &text);
        let analysis = workspace.analysis(&path).unwrap();
        let mut names: BTreeSet<String> = BTreeSet::new();
        let mut symbols: Vec<_> = analysis.symbols().iter().collect();
        while let Some(symbol) = symbols.pop() {
            symbols.extend(&symbol.inside);
            let is_word = symbol.name.chars().all(|it| it.is_alphanumeric() || it == '_');
            // A player without a name stands under the role.
            let is_role =
                symbol.kind == SymbolKind::Player && symbol.name == symbol.name.to_uppercase();
            if is_word && !is_role && symbol.kind != SymbolKind::Team {
                names.insert(symbol.name.clone());
            }
        }
        let code: BTreeSet<usize> = code(&text).map(|(at, _)| at).collect();
        let is_word = |sign: char| sign.is_alphanumeric() || sign == '_';
        let words: Vec<_> = WORDS.iter().flat_map(|word| text.match_indices(word)).collect();
        let is_of_language =
            |at: usize| words.iter().any(|(start, word)| *start <= at && at < start + word.len());
        for name in &names {
            for (at, _) in text.match_indices(name.as_str()) {
                let (before, after) = (&text[..at], &text[at + name.len()..]);
                if !code.contains(&at)
                    || before.ends_with(is_word)
                    || after.starts_with(is_word)
                    || is_of_language(at)
                {
                    continue;
                }
                if workspace.declaration(&path, at).is_none() {
                    let line = before.lines().count();
                    let words = text.lines().nth(line.saturating_sub(1)).unwrap_or_default();
                    missing.push(format!("{}:{line} {name}: {words}", path.display()));
                }
            }
        }
    }
    assert!(missing.is_empty(), "{} names:\n{}", missing.len(), missing.join("\n"));
}

/// A script in a file of its own has the names of the scenario that names it.
#[test]
fn a_name_is_renamed_in_the_script_files_that_use_it() {
    let script = "fn reward(ctx, now, prev, events) { ctx.params.pace * 0.1 }\n";
    let text = "scenario s extends academy {\n    param pace = 3 in 1..9\n    ball at centre\n    \
        team left { CF at (0, 0) }\n    reward script \"r.rhai\"\n}\n";
    let path = folder("script", &[("r.rhai", script), ("s.pitch", text)]).join("s.pitch");
    let mut workspace = Workspace::default();
    workspace.set(&path, text);
    assert!(workspace.reports()[&path].is_empty(), "{:?}", workspace.reports());
    let at = text.find("pace").unwrap();
    let edits = workspace.rename(&path, at, "tempo").expect("a parameter");
    let changed: BTreeSet<String> = edits
        .iter()
        .map(|edit| edit.place.path.file_name().unwrap().to_str().unwrap().to_owned())
        .collect();
    assert_eq!(changed, ["r.rhai", "s.pitch"].map(str::to_owned).into());
    let of_script = edits.iter().find(|it| it.place.path.ends_with("r.rhai")).unwrap();
    assert_eq!(&script[of_script.place.range.clone()], "pace");
    // From the script it is the same.
    let from = path.with_file_name("r.rhai");
    let in_script = script.find("pace").unwrap() + 1;
    let declared = workspace.declaration(&from, in_script).expect("a declaration");
    assert_eq!((&declared.path, declared.range.start), (&path, at));
    assert_eq!(workspace.rename(&from, in_script, "tempo").expect("a parameter"), edits);
    assert_eq!(workspace.references(&from, in_script).len(), 2);
    assert_eq!(workspace.declaration(&from, script.find("ctx").unwrap()), None);
}
