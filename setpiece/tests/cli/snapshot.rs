//! `setpiece snapshot`, and episodes that begin in one.

use super::{fails, folder, json, setpiece, text, write};

#[test]
fn a_snapshot_is_taken_and_begun_from() {
    let folder = folder();
    let path = folder.path().join("early.pitchs").to_string_lossy().into_owned();
    let taken = setpiece(&["snapshot", "5_vs_5", "--step", "100", "--seed", "3", "-o", &path]);
    let said = text(&taken.stdout);
    assert!(
        taken.status.success() && said.contains("5_vs_5 at step 100") && said.contains("bytes"),
        "{said}"
    );
    let run = |threads| {
        json(&[
            "run",
            "5_vs_5",
            "-n",
            "4",
            "--from",
            &path,
            "--threads",
            threads,
            "--format",
            "json",
        ])
    };
    let (one, two, start) =
        (run("1"), run("2"), json(&["run", "5_vs_5", "-n", "4", "--format", "json"]));
    assert_eq!(one["digest"], two["digest"]);
    assert_ne!(one["digest"], start["digest"]);
    let broken = write(folder.path(), "broken.pitchs", &std::fs::read(&path).unwrap()[..200]);
    fails(&["run", "5_vs_5", "--from", &broken], 1, &["SP0013", "truncated"]);
    fails(&["run", "academy_corner", "--from", &path], 1, &["SP0013", "left players differ"]);
    fails(&["run", "5_vs_5", "--from", "nowhere.pitchs"], 1, &["SP0001", "nowhere.pitchs"]);
    fails(
        &["snapshot", "academy_empty_goal_close", "--step", "9999", "-o", &path],
        1,
        &["SP0012", "there is no step 9999"],
    );
    fails(
        &["snapshot", "5_vs_5", "-o", "over.pitch"],
        1,
        &["ends in .pitchc, a snapshot in .pitchs"],
    );
}
