//! Tables of numbers: read from files, looked up in the frame of whoever reads them.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

use setpiece::Error;
use setpiece::engine::environment::{Environment, EnvironmentOptions, Scratch};
use setpiece::scenario::pitch::{HALF_LENGTH_M, X_SCALE_M};
use setpiece::scenario::vocabulary::Action;

/// A folder with a table, and a scenario that reads it.
fn with_table(csv: &str, text: &str) -> Result<setpiece::load::Loaded, Error> {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("threat.csv"), csv).unwrap();
    let path = folder.path().join("s.pitch");
    std::fs::write(&path, text).unwrap();
    setpiece::load(path)
}

const BOTH: &str = r#"
table threat from "threat.csv"
reward worth {
    give threat(ball) as "cell"
    give threat(ball, linear) as "linear"
    give sum(threat(q) for q in grid(4, 2)) as "sum"
    give max_by(threat(q) for q in grid(4, 2)).x as "best"
}
scenario s {
    agents { left: 1, right: 1 }
    ball at (0.6, 0.3)
    team left { CM at (-0.9, -0.3) }
    team right { CM at (-0.9, 0.3) }
    reward worth
    end limit 5 steps
}
"#;

#[test]
fn a_file_is_read_and_each_team_looks_in_its_own_frame() {
    let csv = "# expected threat\n\n0, 1, 2, 3\r\n4; 5;6;70\n";
    let loaded = with_table(csv, BOTH).unwrap();
    let mut environment = Environment::new(loaded.scenario, EnvironmentOptions::default()).unwrap();
    environment.reset(Some(1), Some(0)).unwrap();
    environment.step(&[Action::Idle, Action::Idle], &mut Scratch::default()).unwrap();
    let terms = [environment.terms(0), environment.terms(1)];
    // x = 0.6 lies in the last of four columns, y = 0.3 in the second row; turned, in the first.
    assert_eq!(terms[0][..1], [70.0]);
    assert_eq!(terms[1][..1], [0.0]);
    let share = (0.6 * X_SCALE_M + HALF_LENGTH_M) / (2.0 * HALF_LENGTH_M);
    let between = 6.0 + (share * 4.0 - 0.5 - 2.0) * 64.0;
    assert!((terms[0][1] - between).abs() < 0.1, "{} {between}", terms[0][1]);
    assert_eq!([terms[0][2], terms[1][2]], [91.0, 91.0]);
    // The best point lies ahead for both, in the centre of the last cell.
    let ahead = 0.75 * HALF_LENGTH_M / X_SCALE_M;
    assert!(terms.iter().all(|terms| (terms[3] - ahead).abs() < 1e-6), "{terms:?}");
}

#[test]
fn what_a_file_gets_wrong_is_shown_there() {
    for (csv, code, marked) in [
        ("x, y\n1, 2\n", "SP0301", ("threat.csv", "x")),
        ("1, 2\n3, inf\n", "SP0301", ("threat.csv", "inf")),
        ("1, 2\n3\n", "SP0303", ("threat.csv", "3")),
        ("1,,2\n", "SP0301", ("threat.csv", "")),
        ("1,5;2,5\n", "SP0301", ("threat.csv", "1,5")),
        ("1 2\n3  4x\n", "SP0301", ("threat.csv", "4x")),
        ("# nothing\n", "SP0301", ("s.pitch", "\"threat.csv\"")),
    ] {
        let Err(Error::Compile(failure)) = with_table(csv, BOTH) else { panic!("{csv:?}") };
        let [problem] = failure.problems.as_slice() else { panic!("{:?}", failure.problems) };
        let at = problem.place();
        let file = failure.sources.get(at.file).unwrap();
        assert_eq!(problem.code().to_string(), code, "{csv:?}");
        assert!(file.name.ends_with(marked.0), "{}", file.name);
        assert_eq!(&file.text[at.start as usize..at.end as usize], marked.1);
    }
}
