//! The tools of the language, by the real binary: `explain`, `fmt`, and the consoles of the error
//! pages.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

use std::io::Write;
use std::path::Path;
use std::process::{Command, Output, Stdio};

fn run(folder: &Path, args: &[&str], input: &str) -> (Option<i32>, String, String) {
    let mut child = Command::new(env!("CARGO_BIN_EXE_setpiece"))
        .args(args)
        .current_dir(folder)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    // A command that reads nothing may already have ended.
    let _ = child.stdin.take().unwrap().write_all(input.as_bytes());
    let Output { status, stdout, stderr } = child.wait_with_output().unwrap();
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
    (status.code(), text(stdout), text(stderr))
}

fn folder() -> tempfile::TempDir {
    tempfile::tempdir().unwrap()
}

#[test]
fn explain_prints_the_page_of_a_code_however_it_is_written() {
    let dir = folder();
    let (code, page, _) = run(dir.path(), &["explain", "SP0203"], "");
    assert_eq!(code, Some(0));
    assert!(page.starts_with("SP0203: no such role\n\n"), "{page}");
    assert!(page.contains("    team left { CBB at (0.5, 0) }") && !page.contains("```"), "{page}");
    for other in ["sp0203", "203", "0203"] {
        assert_eq!(run(dir.path(), &["explain", other], "").1, page, "{other}");
    }
}

#[test]
fn explain_lists_every_code_and_suggests_one() {
    let dir = folder();
    let (_, list, _) = run(dir.path(), &["explain"], "");
    assert_eq!(list.lines().count(), setpiece::dsl::problem::Code::ALL.len());
    assert!(list.contains("SP0213  warning  a name is never used"), "{list}");
    let (code, out, err) = run(dir.path(), &["explain", "SP02033"], "");
    assert_eq!((code, out.as_str()), (Some(1), ""));
    assert!(err.contains("SP0010") && err.contains("did you mean `SP0203`?"), "{err}");
    for wrong in ["", "SP", "SP-1", "99999999999", "role", "ß0203"] {
        let (code, _, err) = run(dir.path(), &["explain", wrong], "");
        assert_eq!(code, Some(1), "{wrong}: {err}");
        assert!(err.contains("help: "), "{wrong}: {err}");
    }
}

#[test]
fn every_console_of_the_error_pages_shows_what_happens() {
    let mut seen = 0;
    for code in setpiece::dsl::problem::Code::ALL {
        let dir = folder();
        std::fs::write(dir.path().join("truncated.pitchc"), "{\"format\": \"setpiece scenario\"")
            .unwrap();
        let page = setpiece::explain::page(*code).unwrap();
        for block in page.split("```").skip(1).step_by(2) {
            let (info, text) = block.split_once('\n').unwrap();
            if let Some(name) = info.strip_prefix("pitch file=") {
                std::fs::write(dir.path().join(name), text).unwrap();
            }
            if info != "console" {
                continue;
            }
            let (command, shown) = text.split_once('\n').unwrap();
            let args: Vec<&str> = command.strip_prefix("$ setpiece ").unwrap().split(' ').collect();
            let (_, _, err) = run(dir.path(), &args, "");
            assert!(err.contains(shown.trim_end()), "{code}: `{command}` prints\n{err}");
            seen += 1;
        }
    }
    assert!(seen >= 9, "{seen}");
}

const UNTIDY: &str = "scenario s extends academy{ // why
 ball at(0.6,0)

 team left{CM at (0.5,0)}}";
const TIDY: &str = "scenario s extends academy { // why
    ball at (0.6, 0)

    team left { CM at (0.5, 0) }
}
";

#[test]
fn fmt_writes_files_and_folders_and_says_which() {
    let dir = folder();
    let deep = dir.path().join("drills/set pieces");
    std::fs::create_dir_all(&deep).unwrap();
    std::fs::create_dir_all(dir.path().join(".hidden")).unwrap();
    for name in ["a.pitch", "drills/set pieces/b.pitch", ".hidden/c.pitch", "notes.txt"] {
        std::fs::write(dir.path().join(name), UNTIDY).unwrap();
    }
    std::fs::write(dir.path().join("tidy.pitch"), TIDY).unwrap();
    let read = |name: &str| std::fs::read_to_string(dir.path().join(name)).unwrap();

    let (code, out, _) = run(dir.path(), &["fmt", "--check"], "");
    assert_eq!((code, out.lines().count()), (Some(1), 2), "{out}");
    assert_eq!(read("a.pitch"), UNTIDY, "a check writes nothing");

    let (code, out, err) = run(dir.path(), &["fmt"], "");
    assert_eq!(code, Some(0));
    assert!(
        out.contains("a.pitch") && out.contains("b.pitch") && !out.contains("tidy.pitch"),
        "{out}"
    );
    assert!(err.contains("2 files formatted, 1 unchanged"), "{err}");
    assert_eq!(
        (read("a.pitch").as_str(), read("drills/set pieces/b.pitch").as_str()),
        (TIDY, TIDY)
    );
    assert_eq!((read(".hidden/c.pitch").as_str(), read("notes.txt").as_str()), (UNTIDY, UNTIDY));
    let left = std::fs::read_dir(dir.path()).unwrap().count();
    assert_eq!(left, 5, "no temporary file stays");

    let (code, out, _) = run(dir.path(), &["fmt", "--check", "a.pitch", "drills"], "");
    assert_eq!((code, out.as_str()), (Some(0), ""));
}

#[test]
fn fmt_reads_standard_input() {
    let dir = folder();
    assert_eq!(run(dir.path(), &["fmt", "-"], UNTIDY), (Some(0), TIDY.to_owned(), String::new()));
    assert_eq!(run(dir.path(), &["fmt", "-", "--check"], UNTIDY).0, Some(1));
    assert_eq!(
        run(dir.path(), &["fmt", "--check", "-"], TIDY),
        (Some(0), String::new(), String::new())
    );
}

#[test]
fn fmt_leaves_what_it_cannot_read_alone_and_goes_on() {
    let dir = folder();
    let broken = "scenario s{ ball at (0.6, 0 }";
    std::fs::write(dir.path().join("broken.pitch"), broken).unwrap();
    std::fs::write(dir.path().join("whole.pitch"), UNTIDY).unwrap();
    let (code, out, err) =
        run(dir.path(), &["fmt", "broken.pitch", "absent.pitch", "whole.pitch"], "");
    assert_eq!(code, Some(1));
    for word in [
        "SP0104",
        "broken.pitch:1:",
        "SP0001",
        "`absent.pitch`",
        "1 file formatted, 0 unchanged, 2 left alone",
    ] {
        assert!(err.contains(word), "no `{word}` in {err}");
    }
    assert!(out.contains("whole.pitch"), "{out}");
    assert_eq!(std::fs::read_to_string(dir.path().join("broken.pitch")).unwrap(), broken);
    let (code, out, err) = run(dir.path(), &["fmt", "-"], broken);
    assert_eq!((code, out.as_str()), (Some(1), ""));
    assert!(err.contains("<stdin>:1:"), "{err}");
}

#[cfg(unix)]
#[test]
fn fmt_keeps_links_and_permissions() {
    use std::os::unix::fs::PermissionsExt;
    let dir = folder();
    let (file, link) = (dir.path().join("real.pitch"), dir.path().join("link.pitch"));
    std::fs::write(&file, UNTIDY).unwrap();
    std::fs::set_permissions(&file, std::fs::Permissions::from_mode(0o640)).unwrap();
    std::os::unix::fs::symlink(&file, &link).unwrap();
    assert_eq!(run(dir.path(), &["fmt", "link.pitch"], "").0, Some(0));
    assert!(link.is_symlink());
    assert_eq!(std::fs::read_to_string(&file).unwrap(), TIDY);
    assert_eq!(std::fs::metadata(&file).unwrap().permissions().mode() & 0o777, 0o640);
}

#[test]
fn doc_describes_every_scenario_of_the_library() {
    let dir = folder();
    for entry in setpiece::list() {
        let (code, page, err) = run(dir.path(), &["doc", &entry.name], "");
        assert_eq!(code, Some(0), "{err}");
        assert!(page.starts_with(&format!("# {}\n\n{}", entry.name, entry.title)), "{page}");
        for part in [
            "## Parameters",
            "| `difficulty` | `number` |",
            "## Players",
            "### scoring",
            "`scoring/goal`",
            "## Rules",
        ] {
            assert!(page.contains(part), "{}: no `{part}` in {page}", entry.name);
        }
        assert!(page.ends_with("|\n") && !page.contains("\n\n\n"), "{page}");
        let rows = page
            .lines()
            .filter(|line| line.starts_with("| left |") || line.starts_with("| right |"))
            .count();
        assert_eq!(rows, entry.players[0] + entry.players[1], "{page}");
    }
}

#[test]
fn doc_tells_what_the_author_wrote() {
    let dir = folder();
    let text = "/// Two | of ours.\n/// Another line.
scenario duel extends academy {
    /// How far | they stand.
    param gap: length = 8m in 3m..15m
    ball at (0.6, 0)
    team left { anna: CM behind ball by gap }
    team right { CB at (0.7, 0) { ai: lazy } }
    rules { offside: on, half_time: 100 steps }
    record shots = count of shot by left
    reward shaping { give 0.1 once when ball in them.box as \"entry\" }
    end success close when
        ball in right.six_yard
    end limit 25s
}
";
    std::fs::write(dir.path().join("duel.pitch"), text).unwrap();
    let (code, page, err) = run(dir.path(), &["doc", "duel.pitch"], "");
    assert_eq!(code, Some(0), "{err}");
    for part in [
        "# duel\n\nTwo | of ours.\nAnother line.\n",
        "| `gap` | `length` | `8m` | 3m..15m | How far \\| they stand. |",
        "| left | anna | CM | (0.453, 0) | bot |",
        "| right |  | CB | (0.7, 0) | lazy |",
        "Agents play 1 of the left team and 0 of the right.",
        "### shaping\n\nTerms: `shaping/entry`\n",
        "- **scored** (success): `end success scored when goal by left`",
        "- **close** (success): `end success close when ball in right.six_yard`",
        "- after 250 steps (25 s)",
        "## Records\n\n- `shots`\n",
        "| `offside` | on |",
        "| `half_time` | 100 steps |",
        "In scope too: `checkpoints`",
    ] {
        assert!(page.contains(part), "no {part:?} in {page}");
    }
}

#[test]
fn doc_writes_the_page_and_the_picture_beside_it() {
    let dir = folder();
    let (code, out, err) = run(
        dir.path(),
        &["doc", "academy_corner", "-o", "corner.md", "--picture", "corner.svg", "--seed", "3"],
        "",
    );
    assert_eq!((code, out.as_str()), (Some(0), ""), "{err}");
    let page = std::fs::read_to_string(dir.path().join("corner.md")).unwrap();
    assert!(page.contains("![A start of academy_corner](corner.svg)"), "{page}");
    let picture = std::fs::read_to_string(dir.path().join("corner.svg")).unwrap();
    assert!(picture.starts_with("<svg ") && picture.ends_with("</svg>\n"), "{picture}");
    assert_eq!(picture.matches(">CB</text>").count(), 4, "two centre backs a side");
    assert_eq!(picture.matches("<g").count(), picture.matches("</g>").count());
    assert_eq!(picture.matches("font-weight").count(), 22, "eleven a side");
    assert!(!picture.contains("NaN") && !picture.contains("inf"), "{picture}");
}

#[test]
fn doc_refuses_other_pictures_and_its_own_source() {
    let dir = folder();
    for name in ["a.png", "a", "a.svgz"] {
        let (code, _, err) = run(dir.path(), &["doc", "academy_corner", "--picture", name], "");
        assert_eq!(code, Some(1), "{err}");
        assert!(err.contains("SP0011") && err.contains("name it `a.svg`"), "{err}");
    }
    let text = "scenario s extends academy { ball at (0.6, 0) team left { CM at (0.5, 0) } }";
    std::fs::write(dir.path().join("s.pitch"), text).unwrap();
    assert_eq!(run(dir.path(), &["doc", "s.pitch", "-o", "s.pitch"], "").0, Some(1));
    assert_eq!(std::fs::read_to_string(dir.path().join("s.pitch")).unwrap(), text);
}
