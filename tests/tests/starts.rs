//! A scenario may start with a set piece: ball, taker and mode follow the laws, everybody else
//! stands where the text places them.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

use setpiece::engine::environment::{Environment, EnvironmentOptions, Scratch};
use setpiece::scenario::{Action, EventKind, GameMode, Instr, Qualifier, Team};

fn environment(start: &str) -> Environment {
    let text = format!(
        "scenario s extends academy {{
            {start}
            team left {{ GK at own (-1, 0)  taker: CM at (0.6, 0.1)  CF at (0.8, 0.05)  LM at (0.5, -0.2) }}
            team right {{ GK at own (-1, 0)  CB at (0.85, 0) facing 90deg  RM at (0.2, 0) }}
            remove end out
            remove end possession
            end limit 100 steps
        }}"
    );
    let loaded =
        setpiece::compile_text(&text, "<test>").unwrap_or_else(|error| panic!("{start}: {error}"));
    let mut environment = Environment::new(loaded.scenario, EnvironmentOptions::default()).unwrap();
    environment.reset(Some(1), Some(0)).unwrap();
    environment
}

#[test]
fn a_set_piece_starts_as_one_and_is_taken() {
    let cases = [
        ("start corner for left", GameMode::Corner, (55.0, -36.0), Team::Left, EventKind::Corner),
        (
            "start corner for left at right.corner.bottom",
            GameMode::Corner,
            (55.0, 36.0),
            Team::Left,
            EventKind::Corner,
        ),
        (
            "start free_kick for left at (0.5, 0.2)",
            GameMode::FreeKick,
            (27.2, 16.72),
            Team::Left,
            EventKind::FreeKick,
        ),
        (
            "start throw_in for left at (0.5, 0.43)",
            GameMode::ThrowIn,
            (27.2, 36.0),
            Team::Left,
            EventKind::ThrowIn,
        ),
        (
            "start goal_kick for right",
            GameMode::GoalKick,
            (50.6, 0.0),
            Team::Right,
            EventKind::GoalKick,
        ),
        ("start penalty for left", GameMode::Penalty, (44.0, 0.0), Team::Left, EventKind::Penalty),
    ];
    for (start, mode, (x, y), team, kind) in cases {
        let mut environment = environment(start);
        let game = environment.state();
        assert_eq!(game.mode, mode, "{start}");
        assert!(
            (game.ball.pos.x - x).abs() < 0.05 && (game.ball.pos.y - y).abs() < 0.05,
            "{start}: {}",
            game.ball.pos
        );
        let taker = game.owner.unwrap();
        assert_eq!(taker.team(), team, "{start}");
        assert!(game.player(taker).pos.distance(game.ball.pos.truncate()) < 3.1, "{start}");
        let defender = &game.players[12];
        assert!(
            taker.index() == 12 || (defender.pos.x - 46.24).abs() < 0.01,
            "{start}: {}",
            defender.pos
        );
        assert!(
            taker.index() == 12
                || (defender.heading_rad - std::f32::consts::FRAC_PI_2).abs() < 1e-5,
            "{start}"
        );
        let mut scratch = Scratch::default();
        let mut taken = None;
        while environment.is_running() && taken.is_none() {
            environment.step(&[Action::BuiltinAi], &mut scratch).unwrap();
            taken = environment
                .events()
                .iter()
                .find(|event| event.qualifier == Some(Qualifier::Taken))
                .copied();
        }
        let taken = taken.unwrap_or_else(|| panic!("{start}: never taken"));
        assert_eq!((taken.kind, taken.team), (kind, Some(team)), "{start}");
        assert!(environment.steps() <= 40, "{start}: {} steps", environment.steps());
        assert_eq!(environment.state().mode, GameMode::Normal, "{start}");
    }
}

#[test]
fn a_kick_off_is_the_teams_that_is_named() {
    for (start, team) in
        [("start kickoff for left", Team::Left), ("start kickoff for right", Team::Right)]
    {
        let environment = environment(start);
        assert_eq!(environment.state().possession, Some(team), "{start}");
        assert!(environment.state().ball.pos.truncate().length() < 0.01, "{start}");
    }
}

#[test]
fn score_and_clock_begin_where_the_start_says() {
    let mut environment =
        environment("start corner for left { score: [2, 1], elapsed: 300 steps }");
    assert_eq!(environment.score(), [2, 1]);
    assert_eq!(environment.start().unwrap().elapsed_steps, 300);
}

#[test]
fn a_set_piece_of_a_team_without_players_is_taken_by_the_others() {
    let text = "scenario s {
        param whose: team = left
        start throw_in for whose at (0.5, -0.43)
        agents { left: 0, right: 0 }
        team right { GK at (1, 0)  CF at (0.2, 0.1)  CM at (0, 0) }
        end limit 600 steps
    }";
    let mut environment = setpiece_tests::environment(text);
    environment.reset(Some(1), Some(0)).unwrap();
    let mut scratch = Scratch::default();
    let mut touches = 0;
    while environment.is_running() {
        let owner = environment.state().owner;
        assert!(
            owner.is_none_or(|owner| environment.state().player(owner).active),
            "{owner:?} is not there"
        );
        environment.step(&[], &mut scratch).unwrap();
        touches +=
            environment.events().iter().filter(|event| event.kind == EventKind::Touch).count();
    }
    assert!(touches > 10, "{touches}");
}

/// Everybody's place in an episode, normalised.
fn places(text: &str, index: u64) -> Vec<[f32; 2]> {
    let loaded =
        setpiece::compile_text(text, "<test>").unwrap_or_else(|error| panic!("{text}: {error}"));
    let mut environment = Environment::new(loaded.scenario, EnvironmentOptions::default()).unwrap();
    environment.reset(Some(1), Some(index)).unwrap();
    let game = environment.state();
    let players = game.squad.ids().map(|id| game.player(id));
    players.map(|player| [player.pos.x / 54.4, player.pos.y / 83.6]).collect()
}

fn near(found: &[[f32; 2]], expected: &[[f32; 2]]) -> bool {
    let close =
        |(a, b): (&[f32; 2], &[f32; 2])| (a[0] - b[0]).abs() < 1e-5 && (a[1] - b[1]).abs() < 1e-5;
    found.len() == expected.len() && found.iter().zip(expected).all(close)
}

#[test]
fn a_role_without_a_place_stands_in_its_zone() {
    let teams = "team left { GK  RM } team right { LB }";
    let text = |more: &str| {
        format!(
            "scenario s {{ ball at (0.5, 0) agents {{ left: 1 }} {more} {teams} end limit 9 steps }}"
        )
    };
    let plain = places(&text(""), 0);
    assert!(near(&plain, &[[-1.0, 0.0], [-0.01, 0.2161], [0.422, 0.19576]]), "{plain:?}");
    let flanks = places(&text("mirror: flanks"), 0);
    assert!(near(&flanks, &[[-1.0, 0.0], [-0.01, -0.2161], [0.422, -0.19576]]), "{flanks:?}");
}

#[test]
fn a_formation_may_be_chosen_by_a_draw() {
    let text = "formation narrow { GK  RM at (-0.1, 0.1) } formation wide { GK  RM at (-0.1, 0.3) }
        scenario s { agents { left: 1 } ball at (0.5, 0) let up = uniform(0, 1) > 0.5
            team left { formation: if up then narrow else wide } team right { formation: if up then wide else narrow }
            end limit 9 steps }";
    let mut seen = [0, 0];
    for index in 0..20 {
        let found = places(text, index);
        let layout = |left: f32, right: f32| [[-1.0, 0.0], [-0.1, left], [1.0, 0.0], [0.1, -right]];
        let which =
            [layout(0.1, 0.3), layout(0.3, 0.1)].iter().position(|expected| near(&found, expected));
        seen[which.unwrap_or_else(|| panic!("{found:?}"))] += 1;
    }
    assert!(seen[0] > 3 && seen[1] > 3, "{seen:?}");
}

/// The compiler rejects such places, but a compiled file may still contain them.
#[test]
fn nobody_begins_beyond_the_rim_and_no_ball_below_the_grass() {
    let changed = |text: &str, from: f64, to: f64| {
        let loaded =
            setpiece::compile_text(text, "<test>").unwrap_or_else(|error| panic!("{error}"));
        let mut scenario = std::sync::Arc::unwrap_or_clone(loaded.scenario);
        let code = &mut scenario.start.program.code;
        code.iter_mut()
            .filter(|instr| **instr == Instr::Const(from))
            .for_each(|instr| *instr = Instr::Const(to));
        let mut environment =
            Environment::new(scenario.into(), EnvironmentOptions::default()).unwrap();
        environment.reset(Some(1), Some(0)).map(|()| environment)
    };
    let high = "scenario s { agents { left: 1 } ball at (0.5, 0) { height: 7m } team left { GK } end limit 9 steps }";
    assert!((changed(high, 7.0, -60.0).unwrap().state().ball.pos.z - 0.11).abs() < 1e-6);
    let far = "scenario s { agents { left: 1 } ball at (0.5, 0) team left { GK CM at (13m, 0m) } end limit 9 steps }";
    assert!(
        changed(far, 13.0, 130.0).is_err_and(|error| error.requirement.contains("on the pitch"))
    );
    // Layouts for later kick-offs don't belong to the start.
    let layouts = "formation a { GK CM at (-13m, 0m) } formation b { GK CM at (-17m, 0m) }
        scenario s { agents { left: 1 } kickoff left { kicking: a, receiving: b } end limit 9 steps }";
    let environment = changed(layouts, -17.0, -170.0).unwrap();
    let game = environment.state();
    let kickoffs = game.squad.ids().flat_map(|id| game.player(id).body.kickoff);
    let furthest = kickoffs.map(|at| at.x.abs()).fold(0.0, f32::max);
    assert!((59.0..=60.0).contains(&furthest), "{furthest}");
}

#[test]
fn nobody_is_moved_behind_the_rim_to_stand_apart() {
    // At the end, in the corner, and at the side of the picture.
    let pairs = [
        ("(-59.7m, 16m)", "(-59.99m, 16.1m)"),
        ("(-59.99m, 16m)", "(-59.7m, 16.1m)"),
        ("(59.8m, -39.8m)", "(59.95m, -39.95m)"),
        ("(10m, 39.7m)", "(10.1m, 39.99m)"),
        ("(10m, -39.99m)", "(10.1m, -39.7m)"),
    ];
    for (first, second) in pairs {
        for (left, right) in [(first, second), (second, first)] {
            let text = format!(
                "scenario s {{
                    start kickoff for left
                    ball at centre
                    team left {{ CM at {left} {{ overlap: allowed }}  CF at (-1m, 0m) }}
                    team right {{ CM at {right} {{ overlap: allowed }} }}
                    end limit 10 steps
                }}"
            );
            let places: Vec<_> =
                places(&text, 0).iter().map(|[x, y]| [x * 54.4, y * 83.6]).collect();
            for [x, y] in &places {
                assert!(x.abs() < 60.001 && y.abs() < 40.001, "{left} and {right}: {places:?}");
            }
            let apart = (places[0][0] - places[2][0]).hypot(places[0][1] - places[2][1]);
            assert!(apart > 0.7, "{left} and {right}: {places:?}");
        }
    }
}
