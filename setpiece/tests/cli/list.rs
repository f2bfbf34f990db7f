//! `setpiece list`.

use super::{setpiece, text};

#[test]
fn lists_every_scenario_with_its_sides() {
    let output = text(&setpiece(&["list"]).stdout);
    let (scenarios, suites) = output.split_once("\n\n").unwrap();
    assert_eq!(scenarios.lines().count(), 41, "{output}");
    let names = suites.lines().map(|line| line.split_whitespace().next().unwrap());
    assert_eq!(names.collect::<Vec<_>>(), ["academy", "academy_multi", "benchmarks"]);
    for line in [
        "academy_3_vs_1_with_keeper",
        "11_vs_11_stochastic",
        "5_vs_5",
        "1_vs_1_easy",
        "11_vs_11_kaggle",
    ] {
        assert!(output.contains(line), "{output}");
    }
    assert!(!output.contains("full_match"), "abstract scenarios can't be run: {output}");
    let row = output.lines().find(|line| line.starts_with("academy_3_vs_1")).unwrap();
    assert!(row.contains("4 v 2"), "{row}");
}
