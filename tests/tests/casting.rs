//! Casts: an `ai` from outside replaces the text's.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test fails by panicking")]

use setpiece::scenario::{Ai, Scenario, Team};
use setpiece::{Cast, CastTarget, Error, compile_text_cast, load_cast};

const TEXT: &str = r"
/// Runs at the ball.
behavior chaser(pace: length = 1m) { repeat { do move_to(ball) } }

scenario first extends academy {
    ball at centre
    team left { CF at (-0.5, 0) CM at (-0.6, 0.2) }
    team right { CB at (0.3, 0) CB at (0.3, 0.2) { ai: hold } LB at (0.3, 0.3) }
}

/// The other way round.
scenario second extends first { mirror: ends }
";

fn cast(casts: &[(CastTarget, &str)]) -> Result<Scenario, Error> {
    let casts: Vec<Cast> =
        casts.iter().map(|(target, ai)| Cast { target: *target, ai: (*ai).to_owned() }).collect();
    compile_text_cast(TEXT, "<text>", &casts).map(|loaded| Scenario::clone(&loaded.scenario))
}

fn ais(scenario: &Scenario) -> Vec<(Team, Ai)> {
    scenario.players.iter().map(|player| (player.team, player.ai)).collect()
}

/// A cast for the last scenario, which is mirrored: its left team is the right team of the text.
#[test]
fn a_cast_gives_a_team_and_single_players_their_ai() {
    use Ai::{Behavior, Bot, Hold, Lazy};
    use Team::{Left, Right};
    let plain = cast(&[]).unwrap();
    let teams = |found: &Scenario| ais(found).into_iter().map(|(_, ai)| ai).collect::<Vec<_>>();
    assert_eq!(ais(&plain), [(Left, Bot), (Left, Hold), (Left, Bot), (Right, Bot), (Right, Bot)]);
    let side = cast(&[(CastTarget::Team(Left), "lazy")]).unwrap();
    assert_eq!(teams(&side), [Lazy, Hold, Lazy, Bot, Bot], "a player keeps their own `ai`");
    let single = cast(&[
        (CastTarget::Player(Left, 1), "chaser(2m)"),
        (CastTarget::Player(Right, 0), "lazy"),
    ])
    .unwrap();
    assert_eq!(teams(&single), [Bot, Behavior(0), Bot, Lazy, Bot]);
    assert_eq!(single.behaviors.len(), 1);
    let both =
        cast(&[(CastTarget::Team(Left), "chaser"), (CastTarget::Player(Left, 0), "bot")]).unwrap();
    assert_eq!(teams(&both), [Bot, Hold, Behavior(0), Bot, Bot]);
}

#[test]
fn a_cast_changes_nothing_else() {
    let (plain, mut cast) =
        (cast(&[]).unwrap(), cast(&[(CastTarget::Player(Team::Right, 1), "lazy")]).unwrap());
    let changed = cast.players.iter_mut().find(|player| player.ai == Ai::Lazy).unwrap();
    changed.ai = Ai::Bot;
    assert_eq!(cast, plain);
}

#[test]
fn an_unknown_cast_is_reported() {
    for (ai, message) in [
        ("chase", "no player's `ai` is called `chase`"),
        (
            "lazy } } } scenario x { ball at centre team left { each all { ai: lazy",
            "is not who plays a player",
        ),
        ("lazy, difficulty: 1", "is not who plays a player"),
        ("lazy } } } //", "is not who plays a player"),
        ("3", "expected who plays the player"),
        ("chaser(", ""),
        ("", ""),
        ("script \"nowhere.rhai\"", "nowhere.rhai"),
    ] {
        let Err(Error::Compile(failure)) = cast(&[(CastTarget::Team(Team::Left), ai)]) else {
            panic!("{ai} was taken")
        };
        let expected =
            failure.problems.iter().any(|problem| problem.words().message.contains(message));
        assert!(expected, "{ai}: {:?}", failure.problems);
    }
    let Err(Error::Compile(_)) = cast(&[(CastTarget::Player(Team::Left, 7), "lazy")]) else {
        panic!("nobody was cast")
    };
}

/// The text of a cast has separate names, which hide none of the scenario's.
#[test]
fn a_behavior_may_have_any_name() {
    let text = TEXT.replace("chaser", "cast");
    let cast = [Cast { target: CastTarget::Team(Team::Left), ai: "cast".to_owned() }];
    let scenario = compile_text_cast(&text, "<text>", &cast).unwrap().scenario;
    assert_eq!(scenario.behaviors.len(), 1);
}

#[test]
fn a_compiled_file_keeps_who_plays() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("duel.pitchc");
    let text = setpiece::scenario::file::to_json(&cast(&[]).unwrap()).unwrap();
    std::fs::write(&path, text).unwrap();
    let lazy = [Cast { target: CastTarget::Team(Team::Left), ai: "lazy".to_owned() }];
    let error = load_cast(&path, &lazy).unwrap_err();
    assert!(matches!(error, Error::Cast { .. }), "{error}");
    assert!(error.help().is_some());
}
