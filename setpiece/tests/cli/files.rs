//! Names and files that are not there, are no text, or lie elsewhere.

use super::{CLOSE, fails, folder, setpiece, text, text_of, write};

/// Before an agent is read that isn't there, and so before anything is played.
#[test]
fn an_output_that_cannot_be_written_is_reported_first() {
    let folder = folder();
    let out = |name: &str| folder.path().join(name).to_string_lossy().into_owned();
    let (html, png, state) = (out("no/a.html"), out("no/a.png"), out("no/a.pitchs"));
    let drill = "academy_3_vs_1_with_keeper";
    let commands: [&[&str]; 5] = [
        &["profile", "gone.onnx", drill, "-o", &html],
        &["profile", "gone.onnx", "academy", "-o", &html],
        &["render", drill, "--agent", "gone.onnx", "-o", &png],
        &["run", drill, "--agent", "gone.onnx", "--plot", &png],
        &["snapshot", drill, "--agent", "gone.onnx", "-o", &state],
    ];
    for command in commands {
        let said = fails(command, 1, &["SP0001", "can't be written"]);
        assert!(!said.contains("gone.onnx"), "{said}");
    }
    let file = write(folder.path(), "file", "");
    let check = "check \"it works\" { play academy_corner for 1 episode expect success_rate > 1% }";
    let check = write(folder.path(), "checks.pitch", check);
    fails(
        &["test", &check, "-o", &format!("{file}/failed")],
        1,
        &["can't be written", "is no folder"],
    );
    // Nothing is left behind.
    let html = out("a.html");
    fails(&["profile", "gone.onnx", drill, "-o", &html], 1, &["gone.onnx"]);
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 2);
}

#[test]
fn a_name_or_file_that_is_not_there_is_one_clear_error() {
    for name in ["3_vs_1", "3_vs_1_with_keper", "3_vs1", "3_v_1"] {
        let meant = "did you mean `academy_3_vs_1_with_keeper`?";
        fails(&["run", &format!("academy_{name}")], 1, &["SP0005", meant]);
    }
    let stderr = fails(&["run", "academ"], 1, &["SP0005"]);
    assert!(!stderr.contains("`academy`"), "a base that nobody plays: {stderr}");
    fails(&["run", "nothing/of/the/kind.pitch"], 1, &["SP0001"]);
    let folder = folder();
    let close = write(folder.path(), "close.pitch", CLOSE);
    fails(&["run", &close.replace("close", "clse")], 1, &["SP0001", "did you mean `close.pitch`?"]);
    fails(&["run", &folder.path().to_string_lossy()], 1, &["SP0006", "is a directory"]);
    fails(&["check", &folder.path().to_string_lossy()], 1, &["SP0006"]);
    fails(&["build", &close, "-o", "/no/such/folder/x.pitchc"], 1, &["SP0001", "can't be written"]);
    fails(&["build", &close, "-o", &close], 1, &["SP0001", "can't be written"]);
    assert_eq!(std::fs::read_to_string(&close).unwrap(), CLOSE, "the source is still there");
}

#[test]
fn a_file_that_is_no_text_is_one_clear_error() {
    let folder = folder();
    let check = |name: &str, content: &[u8], words: &[&str]| {
        let path = write(folder.path(), name, content);
        fails(&["run", &path], 1, words);
        fails(&["check", &path], 1, words);
    };
    check("bytes.pitch", b"scenario x {\n  \xff\xfe\n}", &["SP0003", "line 2"]);
    check("empty.pitch", b"", &["SP0"]);
    check("large.pitch", &vec![b'/'; 10 << 20], &["SP0002", "larger than"]);
    check(
        "deep.pitch",
        format!("scenario x {{ let y = {}1{} }}", "(".repeat(10_000), ")".repeat(10_000))
            .as_bytes(),
        &["SP0102"],
    );
    check("braces.pitch", "{".repeat(10_000).as_bytes(), &["SP0102"]);
}

#[test]
fn checks_names_and_files_that_have_nothing_to_run() {
    let folder = folder();
    assert!(setpiece(&["check", "academy_corner"]).status.success());
    let parts = "/// Paid per goal.\nreward mine { give 1 as \"goal\" when goal by us }\nformation pair { GK at (-1, 0)  CB at (-0.5, 0) }\n";
    let path = write(folder.path(), "parts.pitch", parts);
    let output = setpiece(&["check", &path]);
    assert!(output.status.success(), "{}", text(&output.stderr));
    let wrong = write(
        folder.path(),
        "wrong.pitch",
        parts.replace("-0.5", "fot").replace("give 1", "give 1m"),
    );
    fails(&["check", &wrong], 1, &["`fot`", "SP0302", "wrong.pitch:2", "wrong.pitch:3"]);
    let nothing = write(folder.path(), "nothing.pitch", "// only a comment\n");
    fails(&["check", &nothing], 1, &["SP0214"]);
}

#[test]
fn imports_and_scripts_stay_below_the_root() {
    let outer = folder();
    let inner = outer.path().join("inner");
    std::fs::create_dir_all(inner.join("parts")).unwrap();
    let secret = write(outer.path(), "secret.pitch", "root:x:0:0:secret\n");
    write(&inner, "parts/shared.pitch", "import \"../also.pitch\"\nconst width = 0.1\n");
    write(&inner, "also.pitch", "const also = 0.2\n");
    let scenario = |head: &str, body: &str| {
        format!(
            "{head}\nscenario s extends academy {{ ball at (0, 0) team left {{ CM at (0.1, 0) }} {body} }}\n"
        )
    };
    let below = write(
        &inner,
        "below.pitch",
        scenario("import \"parts/shared.pitch\"", "require also > width"),
    );
    assert!(setpiece(&["check", &below]).status.success());
    let paths = ["../secret.pitch", "parts/../../secret.pitch", &secret, "/etc/passwd"];
    for path in paths {
        for text in [
            scenario(&format!("import \"{path}\""), ""),
            scenario("", &format!("reward script \"{path}\" as \"r\"")),
        ] {
            let root = write(&inner, "root.pitch", text);
            let said = fails(&["check", &root], 1, &[]) + text_of(&["check", &root]).as_str();
            assert!(said.contains("lies outside of the scenario's folder"), "{path}: {said}");
            assert!(!said.contains("root:x"), "{path}: {said}");
        }
    }
    // A file imported by another one is still relative to the root's folder.
    write(&inner, "parts/outward.pitch", "import \"../../secret.pitch\"\n");
    let root = write(&inner, "root.pitch", scenario("import \"parts/outward.pitch\"", ""));
    fails(&["check", &root], 1, &["lies outside of the scenario's folder"]);
    #[cfg(unix)]
    {
        std::os::unix::fs::symlink(&secret, inner.join("link.pitch")).unwrap();
        let root = write(&inner, "root.pitch", scenario("import \"link.pitch\"", ""));
        fails(&["check", &root], 1, &["lies outside of the scenario's folder"]);
    }
    write(outer.path(), "fine.pitch", "const fine = 0.1\n");
    let root =
        write(&inner, "root.pitch", scenario("import \"../fine.pitch\"", "require fine < 1"));
    fails(&["run", &root], 1, &["`--allow-outside` isn't given"]);
    assert!(setpiece(&["check", "--allow-outside", &root]).status.success());
    assert!(setpiece(&["run", &root, "--allow-outside", "--episodes", "1"]).status.success());
}
