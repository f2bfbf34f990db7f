//! What authors write never steers the terminal.

use super::{CLOSE, fails, folder, text_of, write};

#[test]
fn what_an_author_writes_does_not_steer_the_terminal() {
    let folder = folder();
    let clear = "\u{1B}[2J\u{1B}]0;title\u{7}\u{9B}31m\u{202E}";
    let body = format!(
        "scenario s extends academy {{ ball at (0, 0) {clear} foo\n let a = \"{clear}\" + 1 }}\n"
    );
    let sources = [
        body,
        format!("import \"{clear}.pitch\"\n"),
        format!("scenario s {{ reward script \"{clear}\" }}"),
    ];
    for source in sources {
        let path = write(folder.path(), "steers.pitch", source);
        for colour in ["never", "always"] {
            let said = fails(&["--color", colour, "check", &path], 1, &[]);
            let controls = ["\u{1B}[2J", "\u{1B}]", "\u{7}", "\u{9B}", "\u{202E}"];
            assert!(controls.iter().all(|control| !said.contains(control)), "{said:?}");
            assert!(colour == "always" || !said.contains('\u{1B}'), "{said:?}");
        }
    }
    let said = fails(&["check", "no\u{1B}[31msuch.pitch"], 1, &["SP0001"]);
    assert!(!said.contains('\u{1B}'), "{said:?}");
}

#[test]
fn names_and_words_of_a_scenario_set_no_colours() {
    let folder = folder();
    let text = CLOSE.replace("ball at", "reward r\n    ball at");
    let text = format!(
        "/// A \u{1b}[7mtitle\u{1b}[0m\n{text}\nreward r {{ give 0.1 as \"\u{1b}[31mred\u{1b}]0;x\u{7}\" }}\n"
    );
    let file = write(folder.path(), "loud.pitch", text);
    let output = text_of(&["run", &file, "--color", "always", "--episodes", "2"]);
    assert!(output.contains("␛[31mred") && output.contains("A ␛[7mtitle"), "{output}");
    assert!(output.contains("\u{1b}[1mclose"), "the command's own styles are kept: {output}");
    assert!(
        !output.contains("\u{1b}[31mred")
            && !output.contains("\u{1b}[7m")
            && !output.contains('\u{7}'),
        "{output}"
    );
}
