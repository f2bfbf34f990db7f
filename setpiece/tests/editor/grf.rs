//! Scripts of Google Research Football that are pasted into a text.

use setpiece::editor::{Action, ActionKind, Workspace};
use std::path::Path;

const SCRIPT: &str = "\
from . import *

def build_scenario(builder):
  builder.config().game_duration = 400
  builder.SetBallPosition(0.62, 0.0)
  builder.SetTeam(Team.e_Left)
  builder.AddPlayer(-1.0, 0.0, e_PlayerRole_GK)
  builder.AddPlayer(0.6, 0.0, e_PlayerRole_CM)
  builder.SetTeam(Team.e_Right)
  builder.AddPlayer(-1.0, 0.0, e_PlayerRole_GK)
";

const OTHER: &str = "\
/// Another one.
scenario other extends academy {
    ball at (0, 0)
    team left { CM at (-0.1, 0) }
}
";

fn actions(file: &str, text: &str, at: usize) -> (Workspace, Vec<Action>) {
    let path = Path::new("/nowhere/grf").join(file);
    let mut workspace = Workspace::default();
    workspace.set(&path, text);
    let actions = workspace.actions(&path, at..at);
    (workspace, actions)
}

/// The text after the one action that is offered in its script, wherever the cursor stands in it.
fn translated(file: &str, text: &str) -> String {
    let start = text.find("from .").expect("a script");
    let end = text.rfind("GK)\n").expect("its end") + 4;
    let mut after: Vec<String> = Vec::new();
    for at in (start..=end).filter(|at| text.is_char_boundary(*at)) {
        let (workspace, actions) = actions(file, text, at);
        let [action] = actions.as_slice() else { panic!("{at}: {actions:?}") };
        assert_eq!(action.kind, ActionKind::Fix);
        let [edit] = action.edits.as_slice() else { panic!("{action:?}") };
        let path = Path::new("/nowhere/grf").join(file);
        let mut whole = workspace.text(&path).expect("a text").to_string();
        whole.replace_range(edit.place.range.clone(), &edit.text);
        after.push(whole);
    }
    after.dedup();
    assert_eq!(after.len(), 1, "{after:?}");
    after.remove(0)
}

#[test]
fn a_pasted_script_becomes_a_scenario() {
    for (file, name) in [("two on one.pitch", "two_on_one"), ("from.pitch", "from_scenario")] {
        let after = translated(file, SCRIPT);
        let path = Path::new("/nowhere/grf").join(file);
        let mut workspace = Workspace::default();
        workspace.set(&path, &after);
        assert_eq!(workspace.reports()[&path], [], "{after}");
        assert_eq!(workspace.format(&path), [], "{after}");
        for expected in [
            format!("scenario {name} {{").as_str(),
            "        CM at (0.6066, 0)\n",
            "        GK at own (-1.011, 0)\n",
            "    end limit 400 steps\n",
        ] {
            assert!(after.contains(expected), "{expected}: {after}");
        }
    }
}

#[test]
fn the_text_around_a_script_stays() {
    for (above, below) in [(OTHER, ""), ("", OTHER), (OTHER, OTHER)] {
        let below = below.replace("other", "third");
        let text = format!("{above}\n{SCRIPT}\n{below}");
        let after = translated("other.pitch", &text);
        assert!(after.starts_with(above) && after.ends_with(&below), "{after}");
        let name = if above.is_empty() { "other" } else { "other_2" };
        assert!(after.contains(&format!("\nscenario {name} {{")), "{after}");
        let path = Path::new("/nowhere/grf/other.pitch");
        let mut workspace = Workspace::default();
        workspace.set(path, &after);
        assert_eq!(workspace.reports()[path], [], "{after}");
        let at = text.find("ball at").expect("the other scenario");
        let (_, beside) = actions("other.pitch", &text, at);
        assert!(beside.iter().all(|it| !it.title.contains("script")), "{beside:?}");
    }
}

#[test]
fn lines_that_cannot_be_read_are_named() {
    let loop_of_players =
        "  for y in (0.1, 0.2):\n    builder.AddPlayer(0.5, y, e_PlayerRole_CF)\n";
    let text = format!("{SCRIPT}{loop_of_players}");
    let (_, actions) = actions("partly.pitch", &text, 0);
    let [action] = actions.as_slice() else { panic!("{actions:?}") };
    assert!(action.title.ends_with(", without 2 lines that can't be read"), "{action:?}");
    for line in loop_of_players.lines() {
        assert!(action.edits[0].text.contains(&format!("\n// {line}\n")), "{action:?}");
    }
}

/// A script that no text can express is refused with the reason, and keeps its other helps.
#[test]
fn a_script_that_no_text_can_express_is_refused_with_the_reason() {
    let turns = |condition: &str| {
        let turning = format!(
            "  if {condition}:\n    builder.SetBallPosition(0.1, 0)\n  else:\n    builder.SetBallPosition(0.2, 0)\n"
        );
        format!("{SCRIPT}{turning}")
    };
    let other_players =
        "  if builder.EpisodeNumber() % 2 == 0:\n    builder.AddPlayer(0.5, 0, e_PlayerRole_CF)\n";
    for (text, reason) in [
        (SCRIPT.replace("0.62", "3"), "off the pitch"),
        (SCRIPT.replace("400", "-1"), "-1"),
        (turns("builder.EpisodeNumber() % 3 == 0"), "more than even from odd episodes"),
        (format!("{SCRIPT}{other_players}"), "other players in odd than in even episodes"),
    ] {
        let at = text.find("builder.config").expect("a script");
        let (_, actions) = actions("odd.pitch", &text, at);
        let refused: Vec<_> = actions.iter().filter(|it| it.title.contains("script of")).collect();
        let [refused] = refused.as_slice() else { panic!("{text}: {actions:?}") };
        assert!(refused.edits.is_empty(), "{refused:?}");
        let given = refused.refused.as_deref().expect("a reason");
        assert!(given.contains(reason), "{given}");
    }
}

/// What is no script, or stands in a comment, keeps its other helps.
#[test]
fn no_translation_is_offered_of_what_is_no_script() {
    for text in [
        SCRIPT.replace("def build_scenario", "def build_scenery"),
        format!("/*\n{SCRIPT}*/\n{OTHER}"),
        format!("scenario s extends academy {{\n    script rhai \"\"\"\n{SCRIPT}\"\"\"\n}}\n"),
    ] {
        let at = text.find("builder.config").expect("a script");
        let (_, actions) = actions("odd.pitch", &text, at);
        assert!(actions.iter().all(|it| !it.title.contains("script of")), "{text}: {actions:?}");
    }
}

#[test]
fn what_mends_a_whole_text_leaves_its_scripts() {
    let text = format!("{}\n{SCRIPT}", OTHER.replace("ball at", "bal at"));
    let (workspace, _) = actions("beside.pitch", &text, 0);
    let all = workspace.fix_all(Path::new("/nowhere/grf/beside.pitch")).expect("a fix");
    assert_eq!(all.edits[0].text, format!("{OTHER}\n{SCRIPT}"));
}

/// What an author has written behind a script that isn't finished stays as it is.
#[test]
fn an_unfinished_script_takes_nothing_of_the_language() {
    let of_rhai = "    reward r script rhai \"\"\"fn reward(ctx, now, prev, events) { 0 }\"\"\"\n";
    let others = [
        OTHER.to_owned(),
        OTHER.replace("/// Another one.\n", "  // My note.\n"),
        OTHER.lines().skip(1).map(|line| format!("  {line}\n")).collect(),
        OTHER.replace("    ball", &format!("{of_rhai}    ball")),
    ];
    for cut in [
        "  \"\"\"cut here\n",
        "  '''cut here\n",
        "  builder.AddPlayer(0.6, 0.1,\n",
        "  name = \"\"\"x\n",
        "  builder.AddPlayer(0.6, 0.1, [\n",
    ] {
        for other in &others {
            let text = format!("{SCRIPT}{cut}\n{other}");
            let at = text.find("builder.config").expect("a script");
            let (_, actions) = actions("cut.pitch", &text, at);
            let action = actions.iter().find(|it| it.title.contains("script of"));
            let edit = &action.unwrap_or_else(|| panic!("{text}\n{actions:?}")).edits[0];
            let mut whole = text.clone();
            whole.replace_range(edit.place.range.clone(), &edit.text);
            assert!(whole.ends_with(other.as_str()), "{cut}{other}\n{whole}");
            assert!(whole.contains(cut.trim_end()), "{cut} is named as left out:\n{whole}");
        }
    }
}

#[test]
fn a_script_is_translated_where_a_scenario_may_stand() {
    let inside = OTHER.replace("    ball", &format!("{SCRIPT}    ball"));
    let at = inside.find("builder.config").expect("a script");
    let (_, of_scenario) = actions("inside.pitch", &inside, at);
    let (_, of_rhai) = actions("inside.rhai", SCRIPT, 60);
    for action in of_scenario.iter().chain(&of_rhai) {
        assert!(!action.title.contains("script of"), "{action:?}");
    }
}

#[test]
fn a_translation_keeps_the_ends_of_lines_and_takes_free_names() {
    let text = format!("\u{feff}{SCRIPT}\n{OTHER}").replace('\n', "\r\n");
    let (_, found) = actions("mine.pitch", &text, 200);
    let edit = &found[0].edits[0];
    assert_eq!(edit.text.matches('\n').count(), edit.text.matches("\r\n").count());
    assert_eq!(edit.place.range.start, 3);
    let kick_off = SCRIPT.replace("0.62, 0.0)", "0.0, 0.0)").replace("0.6, 0.0", "0.0, 0.0");
    let text = format!("{kick_off}\nformation mine_kicking {{\n    CM at (0, 0)\n}}\n");
    let (_, found) = actions("mine.pitch", &text, 200);
    assert!(found[0].edits[0].text.contains("mine_scenario"), "{found:?}");
}
