//! Scripts of Google Research Football: what is read of them, and the texts that they become.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

use proptest::prelude::*;
use setpiece::dsl::format::format;
use setpiece::dsl::source::Source;
use setpiece::grf::{GrfFault, GrfPlayer, GrfScenario, GrfScript, identifier, scripts, to_pitch};
use setpiece::scenario::vocabulary::Role;

const WHOLE: &str = r#"# An author's own drill.
"""Two against a keeper."""
from . import *
import math

WIDE = 0.2
HALF = WIDE / 2


def build_scenario(builder):
  """Builds it."""
  config = builder.config()
  config.game_duration = 60 * 2  # steps
  config.second_half, = 12,
  config.offsides = False
  builder.config().end_episode_on_score = True
  builder.config().right_team_difficulty = 0.05
  builder.SetBallPosition(0.62, -HALF)
  builder.SetTeam(Team.e_Left)
  builder.AddPlayer(-1.0, 0.0, e_PlayerRole_GK)
  builder.AddPlayer(
      0.6, -(HALF + 0.01) * 2,
      PlayerRole.e_PlayerRole_CM,  # the carrier
      lazy=False,
  )
  builder.AddPlayer(0.7, WIDE, e_PlayerRole_CF, controllable=False, lazy=True)
  builder.SetTeam(Team.e_Right)
  builder.AddPlayer(-1.0, 0.0, e_PlayerRole_GK)
"#;

/// The text of a script, which compiles and has the one layout.
fn text(script: &str, name: &str) -> String {
    let text = GrfScript::read(script).expect("a script").to_pitch(name).expect("a text");
    if let Err(why) = setpiece::compile_text(&text, "script.pitch") {
        panic!("{why:?}\n{text}");
    }
    let source = Source { name: String::new(), text: text.as_str().into() };
    assert_eq!(format(&source).expect("it can be read"), text);
    text
}

fn script(body: &str) -> String {
    format!("from . import *\n\ndef build_scenario(builder):\n{body}")
}

#[test]
fn a_script_becomes_a_text() {
    assert_eq!(
        text(WHOLE, "drill"),
        "\
// An author's own drill.
// Two against a keeper.
// Builds it.

// These lines of the script are left out. `setpiece import grf` of the Python package
// runs a script, and so translates them too.
//   config.second_half, = 12,

/// drill, as a script of Google Research Football has it.
scenario drill {
    rules { offside: off, kickoff_circle: off }
    ball at (0.62, -0.1)

    team left {
        difficulty: 1
        GK at (-1.011, 0)
        CM at (0.6066, -0.2236)
        CF at (0.7077, 0.2033) { ai: lazy, controllable: off }
    }

    team right {
        difficulty: 0.05
        GK at own (-1.011, 0)
    }

    reward scoring

    end success scored when goal by left
    end failure conceded when goal by right
    end limit 120 steps
}
"
    );
}

#[test]
fn episodes_take_turns() {
    let turns = script(
        "  if builder.EpisodeNumber() % 2 == 0:
    side = -1
    builder.SetBallPosition(-0.9, 0.3)
  else:
    side = 1
    builder.SetBallPosition(0.9, -0.3)
  builder.SetTeam(Team.e_Left)
  builder.AddPlayer(-1.0, 0.0, e_PlayerRole_GK)
  builder.AddPlayer(0.5 * side, 0.1 if side < 0 else 0.3, e_PlayerRole_RM)
",
    );
    let written = text(&turns, "turns");
    for expected in [
        "ball at (alternate(-0.9, 0.9), alternate(0.3, -0.3))",
        "RM at (alternate(-0.5055, 0.5055), alternate(0.1016, 0.3049))",
        // A team without players has GRF's lazy keeper.
        "GK at own (-1.011, 0.4268) { ai: lazy }",
    ] {
        assert!(written.contains(expected), "{expected}\n{written}");
    }
}

#[test]
fn sides_that_take_turns_kick_off_alternately() {
    let kickoff = script(
        "  if builder.EpisodeNumber() % 2 == 0:
    first, second = Team.e_Left, Team.e_Right
    first_team = Team.e_Left
    second_team = Team.e_Right
  else:
    first_team = Team.e_Right
    second_team = Team.e_Left
  builder.config().second_half = 150
  builder.config().game_duration = 300
  builder.SetTeam(first_team)
  builder.AddPlayer(-1.0, 0.0, e_PlayerRole_GK, controllable=False)
  builder.AddPlayer(0.0, 0.02, e_PlayerRole_RM)
  builder.AddPlayer(0.0, -0.02, e_PlayerRole_CF)
  builder.SetTeam(second_team)
  builder.AddPlayer(-1.0, 0.0, e_PlayerRole_GK, controllable=False)
  builder.AddPlayer(-0.04, 0.04, e_PlayerRole_RM)
  builder.AddPlayer(-0.04, -0.04, e_PlayerRole_CF)
",
    );
    // A formation's name can't begin with a digit, as the scenario's can.
    for (name, stem) in [("turns", "turns"), ("3_vs_3", "_3_vs_3")] {
        let written = text(&kickoff, name);
        let statement = format!(
            "kickoff alternate(left, right) {{ kicking: {stem}_kicking, receiving: {stem}_receiving }}"
        );
        for expected in
            [statement.as_str(), "half_time: 150 steps", "GK at (-1.011, 0) { controllable: off }"]
        {
            assert!(written.contains(expected), "{expected}\n{written}");
        }
        assert!(
            written.contains("//     first, second = Team.e_Left, Team.e_Right\n"),
            "{written}"
        );
    }
}

/// What can't be read is named, and what depends on it is left out too.
#[test]
fn what_cannot_be_read_is_left_out() {
    for (body, kept, left_out) in [
        (
            "  y = 0.1\n  for n in range(3):\n    y = y + 0.1\n    builder.AddPlayer(0, y, 5)\n  \
             builder.AddPlayer(0.5, y, 9)\n  builder.AddPlayer(0.4, 0, 9)\n",
            "CF at (0.4044, 0)",
            "    y = y + 0.1|  builder.AddPlayer(0.5, y, 9)",
        ),
        (
            "  import random\n  builder.AddPlayer(random.random(), 0, 9)\n  \
             builder.AddPlayer(0.4, 0, 9)\n",
            "CF at (0.4044, 0)",
            "  builder.AddPlayer(random.random(), 0, 9)",
        ),
        (
            "  for team in (0, 1):\n    builder.SetTeam(team)\n  builder.AddPlayer(0.5, 0, 9)\n  \
             builder.SetTeam(Team.e_Left)\n  builder.AddPlayer(0.4, 0, 9)\n  \
             builder.SetTeam(1)\n  builder.AddPlayer(-1, 0, 0)\n",
            "CF at (0.4044, 0)",
            "    builder.SetTeam(team)|  builder.AddPlayer(0.5, 0, 9)",
        ),
        (
            "  def wall(n):\n    builder.SetTeam(n)\n  wall(1)\n  builder.AddPlayer(0.5, 0, 9)\n  \
             builder.SetTeam(0); builder.AddPlayer(0.4, 0, 9)\n  \
             builder.SetTeam(1)\n  builder.AddPlayer(-1, 0, 0)\n",
            "CF at (0.4044, 0)",
            "  wall(1)|  builder.AddPlayer(0.5, 0, 9)",
        ),
        (
            "  if is_wide():\n    y = 1\n  elif False:\n    pass\n  else:\n    y = 2\n  \
             builder.config().game_duration = y\n  builder.AddPlayer(0.4, 0, 9)\n",
            "end limit 3000 steps",
            "    y = 1|    y = 2|  builder.config().game_duration = y",
        ),
        (
            "  builder.config().deterministic = True\n  \
             builder.config().game_engine_random_seed = 7\n  builder.AddPlayer(0.4, 0, 9)\n",
            "stochastic: off",
            "  builder.config().game_engine_random_seed = 7",
        ),
    ] {
        let script = script(body);
        let read = GrfScript::read(&script).expect("a script");
        for line in left_out.split('|') {
            assert!(read.left_out.iter().any(|it| it == line), "{line}: {:?}", read.left_out);
        }
        let written = text(&script, "partly");
        assert!(written.contains(kept), "{kept}\n{written}");
        assert_eq!(written.matches("CF at").count(), 1, "{written}");
    }
}

/// What the file doesn't say isn't guessed.
#[test]
fn what_is_not_known_is_not_invented() {
    let behind =
        "  builder.AddPlayer(-1, 0, 0)\n  builder.SetTeam(1)\n  builder.AddPlayer(-1, 0, 0)\n";
    for (head, body, left_out) in [
        ("X = 0.2\nfrom .places import FAR as X\n", "  builder.AddPlayer(X, 0, 9)\n", 1),
        ("X = 0.2\nfrom .places import *\n", "  builder.AddPlayer(X, 0, 9)\n", 1),
        (
            "",
            "  away = lambda: builder.SetTeam(1)\n  builder.SetTeam(0)\n  away()\n  builder.AddPlayer(0.5, 0, 9)\n  builder.SetTeam(0)\n",
            3,
        ),
        (
            "",
            "  s = Setup(builder)\n  builder.SetTeam(0)\n  s.away()\n  builder.AddPlayer(0.5, 0, 9)\n  builder.SetTeam(0)\n",
            3,
        ),
        (
            "W = 0.3\ndef widen():\n  global W\n  W = 0.4\n",
            "  widen()\n  builder.SetTeam(0)\n  builder.AddPlayer(W, 0, 9)\n",
            5,
        ),
    ] {
        let script = format!("{head}{}{behind}", script(body));
        let read = GrfScript::read(&script).unwrap_or_else(|fault| panic!("{fault}: {script}"));
        assert_eq!(read.left_out.len(), left_out, "{script}\n{:?}", read.left_out);
        assert_eq!(read.even.left_team.len(), 1, "{script}");
    }
    let default = "def build_scenario(builder, GAP=0.1):\n  builder.AddPlayer(GAP, 0, 9)\n";
    let read = GrfScript::read(&format!("GAP = 0.3\n{default}{behind}")).expect("a script");
    assert_eq!((read.left_out.len(), read.even.left_team.len()), (1, 1));
    let all_in_a_loop = "  builder.SetBallPosition(0, 0)\n  for x, y, r in PLACES:\n    builder.AddPlayer(x, y, r)\n";
    assert!(GrfScript::read(&script(all_in_a_loop)).is_err());
    let ended = format!("{behind}  return builder\n  builder.AddPlayer(0.5, 0, 9)\n");
    assert_eq!(GrfScript::read(&script(&ended)).expect("a script").even.right_team.len(), 1);
}

#[test]
fn values_are_those_of_python() {
    for (value, expected) in [
        ("7 // 2", "3"),
        ("-7 // 2", "-4"),
        ("-7 % 3", "2"),
        ("True + 1", "2"),
        ("1_0", "10"),
        ("4 if not 0 and 2 > 1 else 5", "4"),
        ("0 or 3", "3"),
        ("-(-2) - -3", "5"),
        ("(\n 1 + # one\n 2)", "3"),
        ("1 + \\\n 2", "3"),
        ("builder.EpisodeNumber() // 100 + 3", "3"),
    ] {
        let script = script(&format!("  builder.config().game_duration = {value}\n"));
        let read = GrfScript::read(&script).expect(value);
        assert_eq!(read.even.game_duration.to_string(), expected, "{value}");
        assert_eq!(read.left_out, [""; 0], "{value}");
    }
    for value in
        ["2 ** 3", "1 / 0", "4 / 2", "9999999999999999999", "'1'", "1 < 2 < 3", "(1", "f(1)", "1 1"]
    {
        let script = script(&format!("  builder.config().game_duration = {value}\n"));
        assert_eq!(GrfScript::read(&script), Err(GrfFault::Empty), "{value}");
    }
    let of = |body: &str| GrfScript::read(&script(body)).expect(body).even;
    assert_eq!(
        of("  builder.config().ball_position = [0.1, -0.2, 0]\n").ball_position,
        [0.1, -0.2]
    );
    assert_eq!(of("  builder.config().ball_position[1] = 1 / 4\n").ball_position, [0.0, 0.25]);
    assert_eq!(
        of("  x = y = .5; x -= 1.\n  builder.SetBallPosition(x, y=y)\n").ball_position,
        [-0.5, 0.5]
    );
}

/// Episodes that aren't as one of the first two can't be said, nor can a list of too many players.
#[test]
fn what_no_text_can_have_is_not_read() {
    let third = "  builder.AddPlayer(0.1 * (builder.EpisodeNumber() % 3), 0, e_PlayerRole_CM)\n";
    assert_eq!(GrfScript::read(&script(third)), Err(GrfFault::Turns));
    let many = "  builder.AddPlayer(0.1, 0, e_PlayerRole_CM)\n".repeat(12);
    assert_eq!(GrfScript::read(&script(&many)), Err(GrfFault::Crowd));
    assert_eq!(GrfScript::read(&script("  pass\n")), Err(GrfFault::Empty));
    let rule = "  builder.config().offsides = builder.EpisodeNumber() % 2 == 0\n";
    let why = GrfScript::read(&script(rule)).expect("a script").to_pitch("rule").unwrap_err();
    assert!(why.to_string().starts_with("`offsides` is True in even and False in odd"), "{why}");
    let lazy = "  builder.AddPlayer(0, 0.1, 5, lazy=builder.EpisodeNumber() % 2 == 0)\n";
    let why = GrfScript::read(&script(lazy)).expect("a script").to_pitch("lazy").unwrap_err();
    assert!(why.to_string().starts_with("the left team has other players"), "{why}");
}

#[test]
fn scripts_are_found_between_other_texts() {
    let other = "/// Another one.\nscenario other extends academy {\n    ball at (0, 0)\n}\n";
    for (above, below) in [("", ""), (other, ""), ("", other), (other, other)] {
        let text = format!("{above}\n{WHOLE}\n\n{below}");
        let found: Vec<&str> = scripts(&text).into_iter().map(|it| &text[it]).collect();
        assert_eq!(found, [WHOLE.trim_end()], "{text}");
    }
    let both = format!("{WHOLE}\n{WHOLE}");
    assert_eq!(scripts(&both).len(), 2);
    for found in scripts(&both) {
        assert_eq!(both[found].trim(), WHOLE.trim());
    }
    assert_eq!(scripts(other), []);
    assert_eq!(scripts("def build(builder):\n  pass\n"), []);
    let windows = WHOLE.replace('\n', "\r\n");
    assert_eq!(text(&windows, "drill"), text(WHOLE, "drill"));
}

#[test]
fn names_are_those_of_files() {
    for (path, name) in [
        ("drills/my drill-2.py", "my_drill_2"),
        ("a\\b\\ü.py", "_"),
        (".py", "scenario"),
        ("a.b.py", "a_b"),
        ("tests.penalty", "tests_penalty"),
    ] {
        assert_eq!(identifier(path), name, "{path}");
    }
}

/// A line that is too wide is laid out as `setpiece fmt` does.
#[test]
fn wide_lines_are_wrapped() {
    let player =
        |x: f64| GrfPlayer { place: [x, x / 3.0], role: Role::CF, lazy: true, controllable: false };
    let with = |x: f64| GrfScenario {
        ball_position: [0.5, 0.0],
        right_team: vec![player(x), player(x)],
        ..GrfScenario::default()
    };
    let text = to_pitch(&with(-0.123456), &with(-0.654321), "wide").expect("a text");
    let source = Source { name: String::new(), text: text.as_str().into() };
    assert_eq!(format(&source).expect("it can be read"), text);
    assert!(text.contains("alternate(-0.1248, -0.6615)"), "{text}");
}

/// Pieces of scripts, in any order.
const PIECES: &[&str] = &[
    "def build_scenario(builder):\n",
    "from . import *\n",
    "  ",
    "    ",
    "\t",
    "\n",
    "\\\n",
    "\r\n",
    "builder",
    ".",
    "SetTeam",
    "AddPlayer",
    "SetBallPosition",
    "config()",
    "(",
    ")",
    "[",
    "]",
    "{",
    "}",
    ",",
    ";",
    ":",
    "=",
    "==",
    "+=",
    "-",
    "*",
    "/",
    "//",
    "%",
    "**",
    "0",
    "1",
    "0.5",
    "1e400",
    "9223372036854775807",
    "-9223372036854775808",
    "e_PlayerRole_GK",
    "Team.e_Left",
    "if ",
    "elif ",
    "else:",
    "for x in y:",
    "not ",
    "and ",
    "x",
    "\"",
    "'",
    "\"\"\"",
    "#",
    "é",
    "\u{1F600}",
    "return",
    "builder.AddPlayer(0.1, 0, 5)\n",
    "builder.EpisodeNumber()",
    "builder.config().offsides = x\n",
    "scenario s {\n",
    "}\n",
    "lambda",
    "@",
    "ball_position",
    "[0]",
];

proptest! {
    #[test]
    fn no_text_makes_it_panic(text in "\\PC{0,200}") {
        read_all(&text);
    }

    #[test]
    fn no_pieces_make_it_panic(
        pieces in prop::collection::vec(prop::sample::select(PIECES), 0..80)
    ) {
        let text = pieces.concat();
        read_all(&text);
        read_all(&format!("def build_scenario(builder):\n  {text}"));
    }

    /// A script with a piece of it gone or doubled.
    #[test]
    fn no_damage_makes_it_panic(at in 0..WHOLE.len(), length in 0_usize..60, doubled: bool) {
        let end = (at + length).min(WHOLE.len());
        let (from, to) = if doubled { (end, at) } else { (at, end) };
        read_all(&format!("{}{}", &WHOLE[..from], &WHOLE[to..]));
    }
}

/// Reads every script of a text; whatever becomes a text says the same names.
fn read_all(text: &str) {
    for range in scripts(text) {
        let Some(Ok(script)) = text.get(range).map(GrfScript::read) else { continue };
        if let Ok(written) = script.to_pitch("any") {
            assert!(written.contains("scenario any {"), "{written}");
        }
    }
}

#[test]
fn depth_and_length_are_no_danger() {
    for piece in
        ["(", "-", "not ", "[", "x if y else ", "'", "\"\"\"", "\\\n", "#", "\n\"", "x=(\n"]
    {
        let deep = piece.repeat(20_000);
        read_all(&script(&format!("  builder.config().game_duration = {deep}")));
        read_all(&script(&deep));
        read_all(&format!("{deep}\n{WHOLE}"));
    }
    let stairs: String = (1..1500).map(|depth| format!("{}if x:\n", " ".repeat(depth))).collect();
    read_all(&script(&stairs));
    read_all(&script(&"  else: x\n".repeat(50_000)));
}
