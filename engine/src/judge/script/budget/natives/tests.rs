use super::*;
use crate::judge::script::api;
use crate::judge::script::host;
use std::collections::BTreeSet;

/// All letters.
const ALL: &str = "AMSICRQFD";

/// Everything that Rhai has for lists, maps and strings is in the table.
#[test]
fn no_function_of_rhai_is_uncounted() {
    let plain = host::plain_engine();
    let mut missing = Vec::new();
    let names = api::functions().chain([
        "+",
        "+=",
        "-",
        "-=",
        "get$len",
        "get$is_empty",
        "get$bytes",
        "get$chars",
    ]);
    // What is printed is counted when it becomes a text.
    let names = names.filter(|name| !["print", "debug"].contains(name));
    let names: BTreeSet<&str> = names.collect();
    for name in names {
        let mut known: Vec<String> = Vec::new();
        let mut open: Vec<String> = ["A", "M", "S", "F"].map(str::to_owned).to_vec();
        open.extend((name == "+").then(|| "C".to_owned()));
        for _ in 0..4 {
            let mut next = Vec::new();
            for letters in open {
                let leaked: Letters = letters.clone().leak();
                if find(&plain, name, leaked).is_some() {
                    known.push(letters.clone());
                }
                if letters.len() < 4 {
                    next.extend(ALL.chars().map(|letter| format!("{letters}{letter}")));
                }
            }
            open = next;
        }
        // A function that takes anything is found for every type.
        let all = known.clone();
        known.retain(|letters| {
            (1..letters.len()).all(|at| {
                let mut other = letters.clone();
                other.replace_range(at..=at, "D");
                other == *letters || !all.contains(&other)
            })
        });
        let counted =
            TABLE.iter().find(|(known, _)| *known == name).map_or(&[][..], |(_, all)| all);
        missing.extend(
            known
                .into_iter()
                .filter(|letters| !counted.contains(&letters.as_str()))
                .map(|l| (name, l)),
        );
    }
    assert_eq!(missing, []);
}
