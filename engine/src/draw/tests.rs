use super::*;
use crate::testing::scenario;
use setpiece_scenario::vocabulary::Role;
use setpiece_scenario::{BinaryOp, Distribution, Instr, PlayerSlot, Require, SideAgents};

fn push(scenario: &mut Scenario, instr: Instr) -> Reg {
    scenario.start.program.code.push(instr);
    Reg(scenario.start.program.code.len() as u32 - 1)
}

fn uniform(scenario: &mut Scenario, key: u64, low: f64, high: f64) -> Reg {
    let (low, high) = (push(scenario, Instr::Const(low)), push(scenario, Instr::Const(high)));
    push(scenario, Instr::Random { key, from: Box::new(Distribution::Uniform(low, high)) })
}

/// A striker somewhere along the middle line, between two ends, and a keeper.
fn striker(low: f64, high: f64) -> Scenario {
    let mut scenario = scenario(&[
        (Team::Left, Role::CF, 0.0, 0.0),
        (Team::Left, Role::GK, -50.0, 0.0),
        (Team::Right, Role::GK, 50.0, 0.0),
    ]);
    scenario.players[0].start.x = uniform(&mut scenario, 1, low, high);
    scenario
}

fn draw(scenario: &Scenario, seed: u64, index: u64) -> Result<Drawn, DrawError> {
    setpiece_scenario::verify::verify(scenario).unwrap();
    let bindings = Bindings::defaults(&scenario.params);
    let roster = Roster::new(scenario, &bindings, None).unwrap();
    Drawer::new(scenario).draw(scenario, &bindings, &roster, seed, index)
}

fn x(drawn: &Drawn) -> f32 {
    drawn.players[0].as_ref().unwrap().pos.x
}

#[test]
fn the_seed_and_index_decide() {
    let scenario = striker(-20.0, 20.0);
    let first = draw(&scenario, 5, 0).unwrap();
    assert_eq!(first, draw(&scenario, 5, 0).unwrap());
    assert_ne!(x(&first), x(&draw(&scenario, 5, 1).unwrap()));
    assert_ne!(x(&first), x(&draw(&scenario, 6, 0).unwrap()));
}

#[test]
fn a_new_draw_shifts_no_other() {
    let plain = striker(-20.0, 20.0);
    let mut more = scenario(&[
        (Team::Left, Role::CF, 0.0, 0.0),
        (Team::Left, Role::GK, -50.0, 0.0),
        (Team::Right, Role::GK, 50.0, 0.0),
    ]);
    // The other draw comes before.
    more.start.ball.y = uniform(&mut more, 77, -3.0, 3.0);
    more.players[0].start.x = uniform(&mut more, 1, -20.0, 20.0);
    assert_eq!(x(&draw(&plain, 9, 4).unwrap()), x(&draw(&more, 9, 4).unwrap()));
}

#[test]
fn what_is_required_holds() {
    let mut scenario = striker(-20.0, 20.0);
    let at = scenario.players[0].start.x;
    let least = push(&mut scenario, Instr::Const(15.0));
    let condition = push(&mut scenario, Instr::Binary(BinaryOp::Gt, at, least));
    scenario.start.requires.push(Require {
        condition,
        probability: None,
        label: "far up".to_owned(),
    });
    for index in 0..50 {
        assert!(x(&draw(&scenario, 1, index).unwrap()) > 15.0);
    }
}

#[test]
fn a_required_share_is_not_biased_by_redraws() {
    let mut scenario = striker(-20.0, 20.0);
    let at = scenario.players[0].start.x;
    let zero = push(&mut scenario, Instr::Const(0.0));
    let condition = push(&mut scenario, Instr::Binary(BinaryOp::Gt, at, zero));
    let probability = Some(push(&mut scenario, Instr::Const(0.6)));
    scenario.start.requires.push(Require { condition, probability, label: "ahead".to_owned() });
    let ahead = (0..2000).filter(|&index| x(&draw(&scenario, 3, index).unwrap()) > 0.0).count();
    // 0.6 + 0.4 / 2 of them.
    assert!((1540..1660).contains(&ahead), "{ahead}");
}

#[test]
fn the_requirement_that_fails_most_is_named() {
    let mut scenario = striker(-20.0, 20.0);
    let at = scenario.players[0].start.x;
    let far = push(&mut scenario, Instr::Const(10.0));
    let up = push(&mut scenario, Instr::Binary(BinaryOp::Gt, at, far));
    scenario.start.requires.push(Require {
        condition: up,
        probability: None,
        label: "up".to_owned(),
    });
    let down = push(&mut scenario, Instr::Binary(BinaryOp::Lt, at, far));
    scenario.start.requires.push(Require {
        condition: down,
        probability: None,
        label: "down".to_owned(),
    });
    let error = draw(&scenario, 1, 0).unwrap_err();
    assert_eq!(error.attempts, ATTEMPTS_MAX);
    assert_eq!(error.requirement, "up");
    assert!(error.failures > ATTEMPTS_MAX / 2, "{error}");

    // A requirement that no draw can change is tried once.
    let never = push(&mut scenario, Instr::Const(0.0));
    scenario
        .start
        .requires
        .insert(0, Require { condition: never, probability: None, label: "impossible".to_owned() });
    let error = draw(&scenario, 1, 0).unwrap_err();
    assert_eq!((error.attempts, error.requirement.as_str()), (1, "impossible"));
}

#[test]
fn random_players_stay_on_the_pitch_and_apart() {
    let off = draw(&striker(70.0, 80.0), 1, 0).unwrap_err();
    assert!(off.requirement.contains("on the pitch"), "{off}");
    let crowded = draw(&striker(49.9, 50.1), 1, 0).unwrap_err();
    assert!(crowded.requirement.contains("0.6 m"), "{crowded}");
    // Fixed places may coincide.
    let fixed = scenario(&[(Team::Left, Role::CF, 1.0, 1.0), (Team::Left, Role::CF, 1.0, 1.0)]);
    assert!(draw(&fixed, 1, 0).is_ok());
}

#[test]
fn of_players_who_share_a_place_one_takes_part() {
    let mut scenario = striker(-20.0, 20.0);
    let other = PlayerSlot { instead: true, ..scenario.players[0].clone() };
    let others = std::iter::repeat_n(other, 30);
    scenario.players.splice(1..1, others);
    let refused = draw(&scenario, 1, 0).unwrap_err();
    assert!(refused.requirement.contains("instead of each other"), "{refused}");
    let absent = push(&mut scenario, Instr::Const(0.0));
    for player in &mut scenario.players[1..31] {
        player.start.active = Some(absent);
    }
    assert!(draw(&scenario, 1, 0).is_ok());
}

#[test]
fn numbers_that_play_cannot_go_on_from_are_no_start() {
    let refused = |change: &dyn Fn(&mut Scenario, Reg)| {
        let mut scenario = striker(-20.0, 20.0);
        let huge = push(&mut scenario, Instr::Const(1.0e39));
        change(&mut scenario, huge);
        draw(&scenario, 1, 0).unwrap_err().requirement
    };
    let zero = Reg(0);
    for requirement in [
        refused(&|scenario, huge| scenario.start.ball.height = Some(huge)),
        refused(&|scenario, huge| scenario.players[0].start.heading = Some(huge)),
    ] {
        assert!(requirement.contains("within their bounds"), "{requirement}");
    }
    let large = |change: &dyn Fn(&mut Scenario, Reg)| {
        refused(&|scenario, _| {
            let large = push(scenario, Instr::Const(3.4e38));
            change(scenario, large);
        })
    };
    for requirement in [
        large(&|scenario, large| scenario.start.ball.spin = Some((zero, zero, large))),
        large(&|scenario, large| scenario.start.ball.velocity = Some((large, zero, zero))),
        large(&|scenario, large| scenario.players[1].start.velocity = Some((zero, large))),
    ] {
        assert!(requirement.contains("within their bounds"), "{requirement}");
    }
    let mut scenario = striker(-20.0, 20.0);
    let huge = push(&mut scenario, Instr::Const(1.0e39));
    (scenario.start.score, scenario.start.elapsed) = (Some((huge, huge)), Some(huge));
    scenario.players[0].start.yellow_cards = Some(huge);
    let drawn = draw(&scenario, 1, 0).unwrap();
    let cards = drawn.players[0].as_ref().unwrap().yellow_cards;
    assert_eq!((drawn.score, drawn.elapsed_steps, cards), ([99, 99], 1_000_000, 1));
}

#[test]
fn a_start_that_costs_much_is_looked_for_less_long() {
    let mut scenario = striker(-20.0, 20.0);
    for key in 0..1_000 {
        let (mean, sd) =
            (push(&mut scenario, Instr::Const(0.0)), push(&mut scenario, Instr::Const(1.0)));
        let from = Box::new(Distribution::TruncatedNormal(mean, sd, mean, sd));
        push(&mut scenario, Instr::Random { key: 100 + key, from });
    }
    let (at, far) = (scenario.players[0].start.x, push(&mut scenario, Instr::Const(30.0)));
    let condition = push(&mut scenario, Instr::Binary(BinaryOp::Gt, at, far));
    scenario.start.requires.push(Require { condition, probability: None, label: "up".to_owned() });
    let attempts = draw(&scenario, 1, 0).unwrap_err().attempts;
    assert!((100..1_000).contains(&attempts), "{attempts}");
}

#[test]
fn without_a_draw_one_attempt_is_enough() {
    let mut scenario = scenario(&[(Team::Left, Role::CF, 100.0, 0.0)]);
    assert_eq!(draw(&scenario, 1, 0).unwrap_err().attempts, 1);
    scenario.players[0].start.x = push(&mut scenario, Instr::Const(3.0));
    let drawn = draw(&scenario, 1, 0).unwrap();
    assert_eq!(
        (x(&drawn), drawn.limit_steps, drawn.ball_pos.z),
        (3.0, Some(50), BALL_RADIUS_M as f32)
    );
}

#[test]
fn agents_are_given_players() {
    let mut scenario = scenario(&[
        (Team::Left, Role::GK, -50.0, 0.0),
        (Team::Left, Role::CM, 0.0, 0.0),
        (Team::Left, Role::CF, 9.0, 0.0),
        (Team::Right, Role::GK, 50.0, 0.0),
    ]);
    scenario.players[0].controllable = true;
    let bindings = Bindings::default();
    let roster = |scenario: &Scenario, choice: Option<&AgentsChoice>| {
        Roster::new(scenario, &bindings, choice).unwrap().agents
    };
    let left = |id: u8| (Team::Left, Some(PlayerId(id)));
    assert_eq!(roster(&scenario, None), [(Team::Left, None)]);
    let count = |n, fixed| AgentsChoice {
        sides: [SideChoice::Count(n), SideChoice::Scenario],
        fixed: Some(fixed),
    };
    // The keeper comes last.
    assert_eq!(roster(&scenario, Some(&count(2, true))), [left(1), left(2)]);
    // Everybody, in source order, whether or not agents switch.
    assert_eq!(roster(&scenario, Some(&count(3, false))), [left(0), left(1), left(2)]);
    scenario.agents.sides[0] = SideAgents::Players(vec![2, 0]);
    assert_eq!(roster(&scenario, None), [left(2), left(0)]);
    let error = Roster::new(&scenario, &bindings, Some(&count(4, true))).unwrap_err();
    assert_eq!(error.to_string(), "4 agents on the left side, which has 3 controllable players");
    let named = |names: &[&str]| AgentsChoice {
        sides: [
            SideChoice::Players(names.iter().map(|name| (*name).to_owned()).collect()),
            SideChoice::Scenario,
        ],
        fixed: None,
    };
    assert_eq!(roster(&scenario, Some(&named(&["left_CF_1", "left_GK_1"]))), [left(2), left(0)]);
    let refused = |names: &[&str]| {
        Roster::new(&scenario, &bindings, Some(&named(names))).unwrap_err().to_string()
    };
    let known = "its controllable players are `left_GK_1`, `left_CM_1`, `left_CF_1`";
    assert_eq!(
        refused(&["left_CB_1"]),
        format!("no agent can play `left_CB_1` of the left side: {known}")
    );
    assert_eq!(refused(&["left_CM_1", "left_CM_1"]), "`left_CM_1` is requested twice");
}
