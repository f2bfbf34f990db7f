//! The drawn start beside a text.

use super::{ATTACK, behind, workspace};
use setpiece::editor::Workspace;
use std::path::Path;

#[test]
fn the_preview_follows_the_cursor() {
    let text = format!(
        "{ATTACK}scenario other extends academy {{\n    ball at centre\n    team left {{ CF in circle(centre, 9m) }}\n}}\n"
    );
    let (mut workspace, attack, _) = workspace();
    workspace.set(&attack, &text);
    let first = workspace.preview(&attack, behind(&text, "ball at (0.5")).expect("a scenario");
    assert_eq!(first.scenario, "attack");
    let svg = first.picture.expect("a picture").svg;
    assert!(svg.starts_with("<svg") && svg.contains(">striker</text>"), "{svg}");
    let last = workspace.preview(&attack, text.len()).expect("a scenario");
    assert_eq!(last.scenario, "other");
    let dots = last.picture.expect("a picture").svg.matches("fill-opacity=\"0.45\"").count();
    assert_eq!(dots, 9 + 1, "nine other places of the player, one of the ball");
    workspace.set(&attack, "scenario broken {");
    assert!(workspace.preview(&attack, 0).is_none_or(|it| it.picture.is_err()));
}

/// Of this scenario's first ten starts two aren't found.
#[test]
fn the_preview_shows_the_starts_that_there_are() {
    let text = "scenario seldom extends academy {\n    let x = uniform(0, 1)\n    ball at centre\n    \
        team left { CF at (0.1 * x, 0) }\n    require x > 0.9998\n}\n";
    let path = Path::new("/nowhere/seldom.pitch");
    let mut workspace = Workspace::default();
    workspace.set(path, text);
    let preview = workspace.preview(path, text.len()).expect("a scenario");
    assert!(preview.picture.is_ok(), "{:?}", preview.picture);
    workspace.set(path, &text.replace("0.9998", "0.99999999"));
    let preview = workspace.preview(path, text.len()).expect("a scenario");
    let start = preview.picture.expect("the start as it is written");
    assert!(start.refused.is_some_and(|why| why.contains("`x > 0.99999999` failed")));
    assert!(!start.svg.contains("fill-opacity=\"0.45\""), "no other start");
}
