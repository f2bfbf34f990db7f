//! Which folder of `engine/src` may use which, so that reading one doesn't require knowing those
//! above it.

use super::{read, rust_files};
use std::path::Path;

/// The rooms from the ground up, and what each may use: only earlier rooms.
const MAY_USE: &[(&str, &[&str])] = &[
    ("floats", &[]),
    ("in_place", &[]),
    ("laps", &[]),
    ("math", &[]),
    ("random", &[]),
    ("rows", &[]),
    ("physics", &["floats", "laps", "rows"]),
    ("state", &["floats", "in_place", "physics", "random"]),
    ("digest", &["physics", "state"]),
    ("statistics", &["state"]),
    ("start", &["physics", "state"]),
    ("football", &["laps", "math", "physics", "random", "rows", "start", "state"]),
    ("snapshot", &["state"]),
    ("judge", &["in_place", "random", "snapshot", "state"]),
    ("draw", &["in_place", "judge", "physics", "random", "start", "state"]),
    (
        "control",
        &[
            "draw", "football", "in_place", "judge", "math", "physics", "random", "rows",
            "snapshot", "state",
        ],
    ),
    ("step", &["control", "football", "laps", "math", "physics", "start", "state"]),
    ("observe", &["control", "football", "state"]),
    (
        "environment",
        &[
            "control",
            "digest",
            "draw",
            "football",
            "in_place",
            "judge",
            "laps",
            "observe",
            "physics",
            "snapshot",
            "start",
            "state",
            "statistics",
            "step",
        ],
    ),
    ("batch", &["control", "draw", "environment", "judge", "random", "statistics"]),
];

/// Names every use of a room that must not be used, of all files under `engine/src`.
pub(super) fn check(source: &Path, breaches: &mut Vec<String>) -> Result<(), String> {
    for file in rust_files(source) {
        let path = file
            .strip_prefix(source)
            .map_err(|why| why.to_string())?
            .to_string_lossy()
            .replace('\\', "/");
        check_file(&path, &read(&file)?, breaches);
    }
    Ok(())
}

/// The same for one file; `path` is relative to `engine/src`.
fn check_file(path: &str, text: &str, breaches: &mut Vec<String>) {
    let room = path.split('/').next().unwrap_or_default().trim_end_matches(".rs");
    // The crate's root uses nothing, and tests may use anything.
    if room == "lib" || room == "testing" || path.ends_with("/tests.rs") || path.contains("/tests/")
    {
        return;
    }
    let Some(at) = MAY_USE.iter().position(|(name, _)| *name == room) else {
        breaches.push(format!(
            "engine/src/{path}: `{room}` is no room yet: name it in xtask/src/tidy/rooms.rs"
        ));
        return;
    };
    let code = text.split("#[cfg(test)]\nmod ").next().unwrap_or_default();
    let code: Vec<&str> =
        code.lines().map(|line| line.split("//").next().unwrap_or_default()).collect();
    for (used, line) in uses(&code.join("\n"), path.split('/').count()) {
        let stands = MAY_USE.iter().position(|(name, _)| *name == used);
        let Some(stands) = stands.filter(|stands| *stands != at && !MAY_USE[at].1.contains(&used))
        else {
            continue;
        };
        let why = if stands > at { "which stands on it" } else { "which it need not know" };
        breaches.push(format!(
            "engine/src/{path}:{line}: {room} → {used}: `{room}` may not use `{used}`, {why}"
        ));
    }
}

/// The rooms that a file's paths lead to, each with its line; `depth` is the number of modules from
/// the root.
fn uses(code: &str, depth: usize) -> Vec<(&str, usize)> {
    let root = "super::".repeat(depth);
    let mut found = Vec::new();
    for start in ["crate::", root.as_str()] {
        for (at, _) in code.match_indices(start) {
            let before = code[..at].chars().next_back();
            if before.is_some_and(|c| c.is_alphanumeric() || matches!(c, '_' | ':' | '$')) {
                continue;
            }
            let rest = &code[at + start.len()..];
            let line = |rest: &str| code[..code.len() - rest.len()].matches('\n').count() + 1;
            match rest.strip_prefix('{') {
                None => found.extend(word(rest).map(|word| (word, line(rest)))),
                Some(group) => {
                    found.extend(members(group).filter_map(|rest| Some((word(rest)?, line(rest)))));
                }
            }
        }
    }
    found
}

/// The word that a text begins with.
fn word(text: &str) -> Option<&str> {
    let end = text.find(|c: char| !c.is_alphanumeric() && c != '_').unwrap_or(text.len());
    (end > 0).then(|| &text[..end])
}

/// The members of a group of paths after its brace, each with everything that follows it.
fn members(group: &str) -> impl Iterator<Item = &str> {
    let mut depth = 0_usize;
    let mut starts = vec![0];
    for (at, c) in group.char_indices() {
        match c {
            '{' => depth += 1,
            '}' if depth == 0 => break,
            '}' => depth -= 1,
            ',' if depth == 0 => starts.push(at + 1),
            _ => {}
        }
    }
    starts.into_iter().map(|at| group[at..].trim_start())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn breaches(path: &str, text: &str) -> Vec<String> {
        let mut breaches = Vec::new();
        check_file(path, text, &mut breaches);
        breaches
    }

    #[test]
    fn every_room_stands_on_rooms_named_before_it() {
        for (at, (room, may_use)) in MAY_USE.iter().enumerate() {
            for used in *may_use {
                let below = MAY_USE[..at].iter().any(|(name, _)| name == used);
                assert!(below, "{room} → {used}");
            }
        }
    }

    #[test]
    fn the_engine_is_in_order() {
        let mut breaches = Vec::new();
        check(&crate::shell::root().join("engine/src"), &mut breaches).unwrap();
        assert_eq!(breaches, Vec::<String>::new());
    }

    #[test]
    fn a_use_of_a_room_above_is_named() {
        let found = breaches("state/play.rs", "//! Memory.\n\nuse crate::football::kick;\n");
        assert_eq!(
            found,
            [
                "engine/src/state/play.rs:3: state → football: `state` may not use `football`, which stands on it"
            ]
        );
        // In every notation.
        for text in [
            "fn f() { crate::football::tick::advance() }",
            "use crate::{random, football::{kick, tick}};",
            "use crate::{\n    random::Stream,\n    football,\n};",
            "use super::super::football;",
            "pub(in crate::football) fn f() {}",
            "#[serde(with = \"crate::football\")]",
            "#[cfg(test)]\nfn f() {}\n\nuse crate::football;",
        ] {
            assert_eq!(breaches("state/play.rs", text).len(), 1, "{text}");
        }
        assert!(
            breaches("state/play.rs", "use crate::{\n    random,\n    football,\n};")[0]
                .contains("play.rs:3:")
        );
        assert!(
            breaches("football/kick.rs", "use crate::control;")[0].contains("football → control")
        );
        assert!(breaches("football.rs", "use super::step;")[0].contains("football → step"));
    }

    #[test]
    fn a_use_of_a_room_below_is_named_where_the_table_lacks_it() {
        let found = breaches("football/kick.rs", "use crate::digest;");
        assert!(
            found[0].ends_with("`football` may not use `digest`, which it need not know"),
            "{found:?}"
        );
    }

    #[test]
    fn what_is_no_use_is_let_be() {
        for text in [
            "use crate::state::Match;\nuse crate::{math, physics::Ball};",
            "use super::touch;\nuse super::super::state::Match;",
            "/// What [`crate::control`] wants.\nfn f() {} // crate::control",
            "#[cfg(test)]\nfn f() {}\n\n#[cfg(test)]\nmod tests {\n    use crate::control;\n}",
            "use wide::football_crate::control;",
        ] {
            assert_eq!(breaches("football/kick.rs", text), Vec::<String>::new(), "{text}");
        }
        assert_eq!(breaches("football/tests.rs", "use crate::control;"), Vec::<String>::new());
    }

    #[test]
    fn a_new_room_is_asked_for() {
        assert!(breaches("weather.rs", "")[0].contains("`weather` is no room yet"));
    }
}
