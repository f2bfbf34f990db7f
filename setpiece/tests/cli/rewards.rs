//! `setpiece run --reward`: where rewards come from.

use super::{CLOSE, folder, json, write};

#[test]
fn an_imported_copy_of_a_reward_takes_the_librarys_place() {
    let folder = folder();
    let copy = include_str!("../../../stdlib-scenarios/rewards.pitch")
        .replace("give +1 on goal", "give +3 on goal");
    write(folder.path(), "mine.pitch", copy);
    let path = write(folder.path(), "close.pitch", format!("import \"mine.pitch\"\n{CLOSE}"));
    let result =
        json(&["run", &path, "--agent", "run_and_shoot", "--episodes", "10", "--format", "json"]);
    assert_eq!(result["terms"]["scoring/goal"], 3.0 * result["success_rate"].as_f64().unwrap());
}

#[test]
fn rewards_come_from_the_files() {
    let folder = folder();
    let run = |value: &str| {
        let path = write(
            folder.path(),
            "own.pitch",
            format!(
                "reward mine {{ give {value} on goal by us as \"goal\" }}\n{}",
                CLOSE.replace("ball at", "remove reward scoring\n    reward mine\n    ball at")
            ),
        );
        json(&[
            "run",
            &path,
            "--agent",
            "run_and_shoot",
            "--episodes",
            "10",
            "--seed",
            "1",
            "--format",
            "json",
        ])
    };
    let (one, five) = (run("1"), run("5"));
    assert!(one["terms"]["mine/goal"].as_f64().unwrap() > 0.5, "{one}");
    let ratio =
        five["terms"]["mine/goal"].as_f64().unwrap() / one["terms"]["mine/goal"].as_f64().unwrap();
    assert!((ratio - 5.0).abs() < 1e-9);
}

#[test]
fn a_reward_of_the_files_own_takes_the_place_of_the_librarys() {
    let folder = folder();
    let own = format!("reward scoring {{ give 5 on goal by us as \"goal\" }}\n{CLOSE}");
    let path = write(folder.path(), "own.pitch", own);
    let result = json(&[
        "run",
        &path,
        "--agent",
        "run_and_shoot",
        "--episodes",
        "5",
        "--seed",
        "1",
        "--format",
        "json",
    ]);
    assert_eq!(result["terms"]["scoring/goal"], 5.0, "{result}");
    assert!(result["terms"]["scoring/conceded"].is_null(), "{result}");
}
