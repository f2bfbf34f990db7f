//! `setpiece build`, and what is done with compiled files.

use super::{CLOSE, fails, folder, json, setpiece, write};

#[test]
fn a_compiled_file_runs_like_its_source_and_keeps_its_parameters() {
    let folder = folder();
    let source = write(folder.path(), "close.pitch", CLOSE);
    let compiled = folder.path().join("close.pitchc").to_string_lossy().into_owned();
    assert!(setpiece(&["build", &source, "-o", &compiled]).status.success());
    let run = |path: &str| {
        json(&[
            "run",
            path,
            "--agent",
            "random",
            "--set",
            "difficulty=0.95",
            "--episodes",
            "6",
            "--seed",
            "2",
            "--reward",
            "scoring",
            "--reward",
            "checkpoints",
            "--format",
            "json",
        ])
    };
    assert_eq!(run(&source)["digest"], run(&compiled)["digest"]);
    assert_eq!(run(&source)["terms"], run(&compiled)["terms"]);
    assert!(run(&compiled)["terms"]["checkpoints/carried"].is_number());

    let whole = std::fs::read_to_string(&compiled).unwrap();
    let cut = write(folder.path(), "cut.pitchc", &whole[..whole.len() / 2]);
    fails(&["run", &cut], 1, &["SP0007", "is truncated"]);
    let written = format!("\"version\":{}", setpiece::scenario::FORMAT_VERSION);
    for version in ["1", "99"] {
        let other = whole.replacen(&written, &format!("\"version\":{version}"), 1);
        let other = write(folder.path(), "other.pitchc", other);
        fails(&["run", &other], 1, &["SP0007", &format!("version {version};")]);
    }
    let changed = write(folder.path(), "changed.pitchc", whole.replacen("close", "klose", 1));
    fails(&["run", &changed], 1, &["SP0007", "checksum"]);
}

#[test]
fn the_compact_form_is_the_same_scenario_and_its_problems_are_reported() {
    type Change<'a> = &'a dyn Fn(&mut Vec<u8>);
    let folder = folder();
    let source = write(folder.path(), "close.pitch", CLOSE);
    let at = |name: &str| folder.path().join(name).to_string_lossy().into_owned();
    let (text, compact) = (at("text.pitchc"), at("compact.pitchc"));
    assert!(setpiece(&["build", &source, "-o", &text]).status.success());
    assert!(setpiece(&["build", &source, "-o", &compact, "--format", "bin"]).status.success());
    let again = at("again.pitchc");
    assert!(setpiece(&["build", &compact, "-o", &again]).status.success());
    assert_eq!(
        std::fs::read(&text).unwrap(),
        std::fs::read(&again).unwrap(),
        "one form holds what the other does"
    );
    let whole = std::fs::read(&compact).unwrap();
    assert!(whole.len() < std::fs::read(&text).unwrap().len() * 3 / 4, "{} bytes", whole.len());
    let broken = |name: &str, change: Change<'_>| {
        let mut bytes = whole.clone();
        change(&mut bytes);
        std::fs::write(at(name), bytes).unwrap();
        at(name)
    };
    let cases: [(&str, Change<'_>, &str); 6] = [
        ("head", &|bytes| bytes.truncate(17), "truncated"),
        ("half", &|bytes| bytes.truncate(bytes.len() / 2), "truncated"),
        ("version", &|bytes| bytes[8] = 99, "version 99"),
        ("changed", &|bytes| *bytes.last_mut().unwrap() ^= 1, "checksum"),
        ("longer", &|bytes| bytes.push(0), "checksum"),
        ("other.pitchc", &|bytes| bytes[0] = b'x', "SP000"),
    ];
    for (name, change, report) in cases {
        fails(&["run", &broken(name, change)], 1, &[report]);
    }
}

#[test]
fn a_compiled_scenario_is_never_written_over_a_source() {
    let folder = folder();
    let path = write(folder.path(), "close.pitch", CLOSE);
    let other = write(folder.path(), "other.pitch", CLOSE);
    fails(&["build", &path, "-o", &path], 1, &["SP0001"]);
    fails(&["build", &path, "-o", &other], 1, &["ends in .pitchc"]);
    assert_eq!(std::fs::read_to_string(&other).unwrap(), CLOSE);
    fails(&["build", &path, "-o", &folder.path().to_string_lossy()], 1, &["it is a directory"]);
}
