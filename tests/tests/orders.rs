//! Team orders of the `full` action set, and continuous actions: each has its effect.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

use glam::Vec2;
use setpiece::engine::control::continuous;
use setpiece::engine::environment::{Environment, EnvironmentOptions, Scratch};
use setpiece::engine::football::switching;
use setpiece::engine::state::{Match, PlayerId, Steer};
use setpiece::scenario::vocabulary::{Action, EventKind, Team};

fn environment(body: &str) -> Environment {
    let text = format!(
        "scenario orders {{ rules {{ stochastic: off offside: off }} {body} end limit 200 steps }}"
    );
    let scenario = setpiece::compile_text(&text, "<orders>")
        .unwrap_or_else(|error| panic!("{error}"))
        .scenario;
    let mut environment = Environment::new(scenario, EnvironmentOptions::default()).unwrap();
    environment.reset(Some(1), None).unwrap();
    environment
}

/// The match after an action and as many idle steps.
fn after(body: &str, action: Action, steps: usize) -> Match {
    let mut environment = environment(body);
    let mut scratch = Scratch::default();
    environment.step(&[action], &mut scratch).unwrap();
    for _ in 0..steps {
        environment.step(&[Action::Idle], &mut scratch).unwrap();
    }
    environment.state().clone()
}

fn gap(game: &Match, id: usize) -> f32 {
    game.players[id].pos.distance(game.ball.pos.truncate())
}

const DEFENDING: &str = "ball at (-0.2, 0.2) { owner: runner }
    team left {
        GK at (-1, 0)
        anna: CB at (-0.3, -0.3)
        CB at (-0.4, 0.35)
        CB at (-0.5, 0)
        DM at (0, -0.3)
    }
    agents { left: [anna] }
    team right { difficulty: 1  runner: CF at own (0.2, -0.2) { ai: hold } }";

#[test]
fn a_called_keeper_comes_out_until_called_back() {
    let (called, not) =
        (after(DEFENDING, Action::KeeperRush, 30), after(DEFENDING, Action::Idle, 30));
    assert!(gap(&called, 0) < gap(&not, 0) - 10.0, "{} {}", gap(&called, 0), gap(&not, 0));
    let mut environment = environment(DEFENDING);
    let mut scratch = Scratch::default();
    for action in [Action::KeeperRush, Action::ReleaseKeeperRush] {
        environment.step(&[action], &mut scratch).unwrap();
    }
    assert!(!environment.state().play.rush[Team::Left.index()]);
}

#[test]
fn pressure_chases_the_ball() {
    let (chases, stands) =
        (after(DEFENDING, Action::Pressure, 20), after(DEFENDING, Action::Idle, 20));
    assert!(gap(&chases, 1) < gap(&stands, 1) - 8.0, "{} {}", gap(&chases, 1), gap(&stands, 1));
}

#[test]
fn team_pressure_sends_a_second_man() {
    // The teammates are too far away to hunt without an order.
    let near = [
        ("anna: CB at (-0.3, -0.3)", "anna: CB at (-0.22, 0.17)"),
        ("(-0.4, 0.35)", "(-0.8, 0.35)"),
    ];
    let body = near
        .into_iter()
        .fold(DEFENDING.replace("(-0.5, 0)", "(-0.8, 0)"), |body, (is, so)| body.replace(is, so));
    let nearest_mate = |game: &Match| (2..5).map(|id| gap(game, id)).fold(f32::MAX, f32::min);
    let (two, one) = (after(&body, Action::TeamPressure, 20), after(&body, Action::Idle, 20));
    assert!(
        nearest_mate(&two) < nearest_mate(&one) - 1.0,
        "{} {}",
        nearest_mate(&two),
        nearest_mate(&one)
    );
}

#[test]
fn switch_takes_the_mate_who_is_sooner_there() {
    let body = DEFENDING.replace("[anna]", "1");
    let mut environment = environment(&body);
    let mut scratch = Scratch::default();
    // The agent's player runs away, until another one reaches the ball sooner.
    let first = environment.agents()[0].player.unwrap();
    let sooner = |environment: &Environment| switching::sooner(environment.state(), 0);
    for action in [Action::Bottom, Action::Sprint].into_iter().chain([Action::Idle; 40]) {
        if sooner(&environment).is_none() {
            environment.step(&[action], &mut scratch).unwrap();
        }
    }
    assert_eq!(environment.agents()[0].player, Some(first), "by itself it keeps the player");
    let mate = sooner(&environment);
    environment.step(&[Action::Switch], &mut scratch).unwrap();
    assert!(mate.is_some() && environment.agents()[0].player == mate, "{mate:?}");
}

#[test]
fn switch_with_the_ball_sends_a_mate_on_a_run() {
    // With two agents nobody runs without an order.
    let body = "ball at (0, 0) { owner: anna }
        agents { left: [anna, back] }
        team left { GK at (-1, 0)  anna: CM at (-0.01, 0)  mate: CF at (0.3, 0.2)  back: CB at (-0.5, 0) }
        team right { GK at own (-1, 0)  CB at own (-0.85, 0.3)  CB at own (-0.85, -0.3) }";
    let after = |action| {
        let (mut environment, mut scratch) = (environment(body), Scratch::default());
        for step in 0..25 {
            let first = if step == 0 { action } else { Action::Idle };
            environment.step(&[first, Action::Idle], &mut scratch).unwrap();
        }
        environment.state().clone()
    };
    let (sent, not) = (after(Action::Switch), after(Action::Idle));
    let x = |game: &Match| game.players[2].pos.x;
    assert!(x(&sent) > x(&not) + 1.0, "{} {}", x(&sent), x(&not));
}

const ALONE: &str = "ball at (0.9, 0.4)
    agents { left: [anna] }
    team left { GK at (-1, 0)  anna: CM at (-0.3, 0)  CF at (0.8, 0.3) }
    team right { GK at own (-1, 0) }";

#[test]
fn a_steered_player_runs_at_any_angle_and_pace() {
    let mut scratch = Scratch::default();
    for (way, pace) in
        [(Vec2::from_angle(0.4), 1.0), (Vec2::from_angle(-1.1), 0.5), (Vec2::from_angle(2.5), 0.25)]
    {
        let mut environment = environment(ALONE);
        environment.steer(0, Some(Steer { way: way * pace, power: 0.0 }));
        for _ in 0..40 {
            environment.step(&[Action::Idle], &mut scratch).unwrap();
        }
        let player = environment.state().player(PlayerId(1));
        // +y of a direction is down the picture, like the world's y here.
        assert!(player.vel.normalize().dot(way) > 0.99, "{way} at {pace}: {}", player.vel);
        assert!(
            (player.vel.length() - 8.0 * pace).abs() < 0.9,
            "{way} at {pace}: {}",
            player.vel.length()
        );
    }
}

#[test]
fn a_key_of_a_direction_ends_steering() {
    let mut environment = environment(ALONE);
    let mut scratch = Scratch::default();
    environment.steer(0, Some(Steer { way: Vec2::X, power: 0.0 }));
    environment.step(&[Action::Sprint], &mut scratch).unwrap();
    assert!(environment.agents()[0].steer.is_some());
    environment.step(&[Action::Left], &mut scratch).unwrap();
    assert_eq!(environment.agents()[0].steer, None);
}

#[test]
fn the_power_of_a_steered_pass_is_how_far_it_goes() {
    let body = "ball at (-0.29, 0) { owner: anna }
        agents { left: [anna] }
        team left { GK at (-1, 0)  anna: CM at (-0.3, 0) }
        team right { GK at own (-1, 0) }";
    let mut scratch = Scratch::default();
    let struck = |power: f32, scratch: &mut Scratch| {
        let mut environment = environment(body);
        let (steer, action) = continuous::decode([0.02, 0.99, -0.5, power]).unwrap();
        assert_eq!(action, Action::ShortPass);
        environment.step(&[Action::Idle], scratch).unwrap();
        environment.steer(0, Some(steer));
        environment.step(&[action], scratch).unwrap();
        for _ in 0..30 {
            environment.steer(0, Some(Steer { way: Vec2::ZERO, power: 0.0 }));
            environment.step(&[Action::Idle], scratch).unwrap();
            if environment.events().iter().any(|event| event.kind == EventKind::Pass) {
                return environment.state().ball.vel;
            }
        }
        panic!("no pass");
    };
    let (near, far) = (struck(0.2, &mut scratch), struck(0.9, &mut scratch));
    assert!(near.y > 3.0 && far.y > 3.0, "along the way: {near} {far}");
    assert!(far.length() > near.length() + 3.0, "{near} {far}");
}

/// As in GRF, a held direction leads the ball over the line.
#[test]
fn an_agent_runs_the_ball_off_the_pitch() {
    for (at, action) in [("(0.9, 0.3)", Action::Right), ("(0.3, 0.38)", Action::Bottom)] {
        let body = format!(
            "ball at {at} {{ owner: anna }}
            team left {{ GK at (-1, 0) anna: CM at {at} }}
            agents {{ left: [anna] }}
            team right {{ GK at (1, 0) {{ ai: lazy }} CB at (0, 0) {{ ai: lazy }} }}"
        );
        let mut environment = environment(&body);
        let mut scratch = Scratch::default();
        let out = (0..60).any(|_| {
            environment.step(&[action], &mut scratch).unwrap();
            environment.events().iter().any(|event| event.kind == EventKind::OutOfPlay)
        });
        assert!(out, "{action:?} from {at} stays on the pitch");
    }
}

/// A lazy player takes a set piece only if all are lazy, and only after the longest allowed wait.
#[test]
fn the_lazy_take_no_set_piece_unless_all_are() {
    let kick = |team: &str, steps: u32| {
        let body = format!(
            "start free_kick for left at (0.2, 0.1) team left {{ {team} }} team right {{ GK at own (-1, 0) }}
            agents {{ left: 0 }}"
        );
        let mut environment = environment(&body);
        let mut scratch = Scratch::default();
        let taker = environment.state().play.set_piece.unwrap().taker;
        for _ in 0..steps {
            environment.step(&[], &mut scratch).unwrap();
        }
        (taker, environment.state().play.set_piece.is_none())
    };
    let mixed = "GK at (-1, 0) CM at (0.2, 0.12) { ai: lazy } CM at (-0.3, 0)";
    assert_eq!(kick(mixed, 15), (PlayerId::new(Team::Left, 2), true));
    let lazy = "GK at (-1, 0) { ai: lazy } CM at (0.2, 0.12) { ai: lazy }";
    assert_eq!(kick(lazy, 12), (PlayerId::new(Team::Left, 1), false));
    assert_eq!(kick(lazy, 40), (PlayerId::new(Team::Left, 1), true));
}
