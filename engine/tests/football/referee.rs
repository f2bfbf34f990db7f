//! The referee's cases, each set up by hand.

use crate::Bench;
use crate::layouts::{Layout, drawn};
use glam::{Vec2, Vec3};
use setpiece_engine::football::{contact, foul, stumble};
use setpiece_engine::physics::Ball;
use setpiece_engine::state::PlayerId;
use setpiece_engine::state::event::Event;
use setpiece_engine::state::player::{Aim, Lunge, Pose};
use setpiece_scenario::vocabulary::{Action, EventKind, GameMode, Qualifier, Rule, Team};

/// Starts the ball as if a player had touched it last, and plays until play stops.
fn roll(bench: &mut Bench, from: Vec3, vel: Vec3, last: PlayerId) {
    // Nobody is near enough to meet it.
    for player in &mut bench.game.players {
        player.pos = Vec2::new(0.0, 39.0);
    }
    bench.game.ball = Ball { pos: from, vel, spin: Vec3::ZERO };
    bench.game.last_touch = Some(last);
    for _ in 0..10 {
        bench.step(Action::BuiltinAi);
        if bench.game.dead {
            return;
        }
    }
    panic!("play did not stop");
}

const LEFT_MAN: PlayerId = PlayerId(7);
const RIGHT_MAN: PlayerId = PlayerId(18);

#[test]
fn over_the_side_line_is_a_throw_in_for_the_others() {
    let mut bench = Bench::new(Layout::Eleven, 0);
    roll(&mut bench, Vec3::new(10.0, -35.5, 0.11), Vec3::new(1.0, -12.0, 0.0), LEFT_MAN);
    assert_eq!(bench.seen(EventKind::OutOfPlay).unwrap().by, Some(LEFT_MAN));
    let awarded = bench.seen(EventKind::ThrowIn).unwrap();
    assert_eq!((awarded.team, awarded.at.y), (Some(Team::Right), -36.0));
    assert_eq!(bench.seen(EventKind::OutOfPlay).unwrap().at.y, -36.0);
    bench.restart();
    assert_eq!(bench.game.mode, GameMode::ThrowIn);
    assert_eq!(bench.game.ball.pos.y, -36.0);
    assert_eq!(bench.game.owner.map(PlayerId::team), Some(Team::Right));
}

#[test]
fn over_the_goal_line_is_a_goal_kick_or_a_corner_by_the_last_toucher() {
    for (last, kind, team) in
        [(LEFT_MAN, EventKind::GoalKick, Team::Right), (RIGHT_MAN, EventKind::Corner, Team::Left)]
    {
        let mut bench = Bench::new(Layout::Eleven, 0);
        roll(&mut bench, Vec3::new(54.5, 12.0, 0.11), Vec3::new(15.0, 0.0, 0.0), last);
        assert_eq!(bench.seen(kind).unwrap().team, Some(team));
        bench.restart();
        let spot =
            if kind == EventKind::Corner { Vec2::new(55.0, 36.0) } else { Vec2::new(50.6, 0.0) };
        assert!(bench.game.ball.pos.truncate().distance(spot) < 1e-3);
        for (_, rival) in bench.game.team(team.other()).filter(|(id, _)| id.in_team() != 0) {
            assert!(rival.pos.distance(spot) > 9.0, "{:?} is too near", rival.pos);
        }
    }
}

#[test]
fn a_goal_counts_and_an_own_goal_for_the_others() {
    for (last, own) in [(LEFT_MAN, false), (RIGHT_MAN, true)] {
        let mut bench = Bench::new(Layout::Eleven, 0);
        roll(&mut bench, Vec3::new(54.0, 1.0, 0.5), Vec3::new(20.0, 0.0, 0.0), last);
        assert_eq!(bench.game.score, [1, 0]);
        let goal = bench.seen(EventKind::Goal).unwrap();
        assert_eq!((goal.team, goal.by), (Some(Team::Left), Some(last)));
        assert!(
            (goal.at.truncate().distance(Vec2::new(55.0, 1.0))) < 0.1,
            "on the line: {}",
            goal.at
        );
        assert_eq!(bench.seen(EventKind::OwnGoal).is_some(), own);
        assert!(bench.seen(EventKind::OutOfPlay).is_none());
        bench.restart();
        assert_eq!(bench.game.ball.pos.truncate(), Vec2::ZERO);
        assert_eq!(bench.game.possession, Some(Team::Right));
        let near = |team| bench.game.team(team).map(|(_, p)| p.pos.length()).fold(99.0, f32::min);
        assert!(near(Team::Right) < 2.5, "nobody to kick off");
        assert!(near(Team::Left) >= 9.15, "inside the circle");
    }
}

#[test]
fn a_player_beyond_the_line_is_offside_when_playing_the_pass() {
    for on in [true, false] {
        let mut start = drawn(Layout::Eleven, 0);
        start.rules[Rule::Offside.index()] = f64::from(u8::from(on));
        let mut bench = Bench::of(&start);
        let (passer, runner) = (PlayerId(2), PlayerId(1));
        for (i, player) in bench.game.players.iter_mut().enumerate() {
            let side = if i < 11 { 1.0 } else { -1.0 };
            player.pos = Vec2::new(-20.0 * side, 3.0 * (i % 11) as f32 - 15.0);
        }
        bench.game.players[11].pos = Vec2::new(54.0, 0.0);
        bench.game.players[passer.index()].pos = Vec2::new(25.0, 30.0);
        bench.game.players[runner.index()].pos = Vec2::new(35.0, 30.0);
        bench.game.ball.pos = Vec3::new(25.5, 30.0, 0.11);
        bench.game.play.offside =
            setpiece_engine::football::offside::positions(&bench.game, passer);
        bench.game.last_touch = Some(passer);
        bench.game.ball = Ball {
            pos: Vec3::new(34.0, 30.0, 0.11),
            vel: Vec3::new(8.0, 0.0, 0.0),
            spin: Vec3::ZERO,
        };
        let mut called = false;
        for _ in 0..8 {
            bench.step(Action::BuiltinAi);
            called |= bench.seen(EventKind::Offside).is_some();
            if bench.game.dead {
                break;
            }
        }
        assert_eq!(called, on);
        if on {
            bench.restart();
            assert_eq!(bench.game.mode, GameMode::FreeKick);
            assert_eq!(bench.game.owner.map(PlayerId::team), Some(Team::Right));
        }
    }
}

#[test]
fn a_keeper_may_not_pick_up_a_mates_back_pass() {
    for (rule, caught) in [(1.0, false), (0.0, true)] {
        let mut start = drawn(Layout::Eleven, 0);
        start.rules[Rule::BackPass.index()] = rule;
        let mut bench = Bench::of(&start);
        let game = &mut bench.game;
        game.players[0].pos = Vec2::new(-50.0, 0.0);
        game.ball = Ball {
            pos: Vec3::new(-49.5, 0.0, 0.11),
            vel: Vec3::new(-1.0, 0.0, 0.0),
            spin: Vec3::ZERO,
        };
        game.last_touch = Some(PlayerId(4));
        game.play.kicked_by = Some(PlayerId(4));
        // Until the keeper has played it with a foot.
        while bench.game.play.hands.is_none() && bench.game.last_touch == Some(PlayerId(4)) {
            bench.step(Action::BuiltinAi);
        }
        assert_eq!(bench.game.play.hands.is_some(), caught);
    }
}

#[test]
fn a_set_piece_waits_for_its_taker_and_no_longer_than_allowed() {
    let mut bench = Bench::new(Layout::Eleven, 0);
    roll(&mut bench, Vec3::new(54.5, 12.0, 0.11), Vec3::new(15.0, 0.0, 0.0), RIGHT_MAN);
    bench.restart();
    assert_eq!(bench.game.mode, GameMode::Corner);
    let mut waited = 0;
    while bench.game.mode != GameMode::Normal {
        bench.step(Action::Idle);
        waited += 1;
        assert!(waited < 40);
    }
    assert!((20..28).contains(&waited), "an idle agent's corner was taken after {waited} steps");
    assert!(
        bench
            .events
            .as_slice()
            .iter()
            .any(|e| e.qualifier == Some(setpiece_scenario::vocabulary::Qualifier::Taken))
    );
}

#[test]
fn half_time_gives_the_others_the_kick_off() {
    let mut start = drawn(Layout::Eleven, 0);
    start.rules[Rule::HalfTime.index()] = 30.0;
    start.limit_steps = Some(60);
    let mut bench = Bench::of(&start);
    let mut halves = 0;
    for step in 1..=60 {
        bench.step(Action::BuiltinAi);
        if bench.seen(EventKind::HalfTime).is_some() {
            halves += 1;
            assert!(step >= 30);
            bench.restart();
            assert_eq!(bench.game.possession, Some(Team::Right));
            assert!(bench.game.players.iter().all(|p| p.fatigue == 0.0));
        } else if bench.game.dead {
            bench.restart();
        }
        assert_eq!(bench.seen(EventKind::FullTime).is_some(), step == 60);
    }
    assert_eq!(halves, 1);
}

/// A bench where only the named players stand near anything.
fn alone(rules: &[(Rule, f64)], seed: u64) -> Bench {
    let mut start = drawn(Layout::Eleven, seed);
    for (rule, value) in rules {
        start.rules[rule.index()] = *value;
    }
    let mut bench = Bench::of(&start);
    for (i, player) in bench.game.players.iter_mut().enumerate() {
        player.pos = Vec2::new(if i < 11 { -40.0 } else { -50.0 }, 3.0 * (i % 11) as f32 - 15.0);
    }
    bench
}

/// A standing foul of the right player on the left one, who has the ball.
fn fouled(bench: &mut Bench) {
    bench.game.players[LEFT_MAN.index()].pos = Vec2::new(10.0, 5.0);
    bench.game.players[RIGHT_MAN.index()].pos = Vec2::new(10.8, 5.0);
    bench.game.ball = Ball { pos: Vec3::new(10.3, 5.0, 0.11), vel: Vec3::ZERO, spin: Vec3::ZERO };
    (bench.game.last_touch, bench.game.possession) = (Some(LEFT_MAN), Some(Team::Left));
    bench.game.owner = Some(LEFT_MAN);
    foul::call_or_let_run(&mut bench.game, &mut bench.events, RIGHT_MAN, LEFT_MAN, 1.2);
    assert_eq!(bench.seen(EventKind::Foul).unwrap().to, Some(LEFT_MAN));
    assert!(!bench.game.dead && bench.seen(EventKind::FreeKick).is_none(), "it was let run");
}

/// Plays until play stops or an event occurs.
fn until(bench: &mut Bench, steps: usize, kind: EventKind) -> Option<usize> {
    (1..=steps).find(|_| {
        bench.step(Action::BuiltinAi);
        bench.game.dead || bench.seen(kind).is_some()
    })
}

#[test]
fn a_foul_is_called_back_where_the_advantage_is_lost() {
    let mut bench = alone(&[], 0);
    fouled(&mut bench);
    bench.game.players[LEFT_MAN.index()].pos = Vec2::new(-40.0, 20.0);
    (bench.game.last_touch, bench.game.possession) = (Some(RIGHT_MAN), Some(Team::Right));
    assert_eq!(until(&mut bench, 20, EventKind::FreeKick), Some(7), "after 600 ms");
    let awarded = bench.seen(EventKind::FreeKick).unwrap();
    assert_eq!(awarded.team, Some(Team::Left));
    assert!(bench.seen(EventKind::Advantage).is_none());
    bench.restart();
    assert_eq!(
        (bench.game.mode, bench.game.ball.pos.truncate()),
        (GameMode::FreeKick, Vec2::new(10.0, 5.0))
    );
    assert_eq!(bench.game.play.advantage, None);
}

#[test]
fn a_team_that_keeps_the_ball_has_had_its_advantage() {
    let mut bench = alone(&[], 0);
    fouled(&mut bench);
    bench.game.players[RIGHT_MAN.index()].pos = Vec2::new(-50.0, 20.0);
    assert_eq!(until(&mut bench, 40, EventKind::Advantage), Some(31), "after 3 s");
    assert!(!bench.game.dead);
    let advantage = bench.seen(EventKind::Advantage).unwrap();
    assert_eq!((advantage.by, advantage.to), (Some(RIGHT_MAN), Some(LEFT_MAN)));
}

#[test]
fn a_ball_that_goes_out_after_a_foul_gives_the_free_kick_and_a_goal_counts() {
    let mut bench = alone(&[], 0);
    fouled(&mut bench);
    bench.game.players[RIGHT_MAN.index()].pos = Vec2::new(-50.0, 20.0);
    bench.game.ball = Ball {
        pos: Vec3::new(10.0, -35.8, 0.11),
        vel: Vec3::new(0.0, -9.0, 0.0),
        spin: Vec3::ZERO,
    };
    until(&mut bench, 5, EventKind::ThrowIn);
    assert!(bench.seen(EventKind::FreeKick).is_some() && bench.seen(EventKind::ThrowIn).is_none());

    let mut bench = alone(&[], 0);
    fouled(&mut bench);
    bench.game.ball =
        Ball { pos: Vec3::new(54.5, 0.0, 0.5), vel: Vec3::new(20.0, 0.0, 0.0), spin: Vec3::ZERO };
    until(&mut bench, 5, EventKind::Goal);
    assert!(bench.seen(EventKind::Goal).is_some() && bench.seen(EventKind::Advantage).is_some());
    assert_eq!(bench.game.score, [1, 0]);
}

#[test]
fn a_card_or_a_penalty_is_not_let_run() {
    for (spot, severity, mode) in [(10.0, 1.6, GameMode::FreeKick), (50.0, 1.2, GameMode::Penalty)]
    {
        let mut bench = alone(&[], 0);
        bench.game.players[LEFT_MAN.index()].pos = Vec2::new(spot, 0.0);
        foul::call_or_let_run(&mut bench.game, &mut bench.events, RIGHT_MAN, LEFT_MAN, severity);
        assert!(bench.game.dead);
        bench.restart();
        assert_eq!(bench.game.mode, mode);
    }
}

/// Whether a player with the ball at this speed and an opponent who comes at them lose their
/// balance as they meet, and whether a foul was called. `lunges`: whether the opponent's leg is
/// out.
fn meeting(mps: f32, lunges: bool) -> ([Pose; 2], bool) {
    let mut bench = alone(&[], 0);
    let now = bench.game.tick as i32;
    let [left, right] = [LEFT_MAN.index(), RIGHT_MAN.index()];
    let spot = bench.game.players[left].pos;
    (bench.game.players[left].vel, bench.game.players[left].body.facing) =
        (Vec2::new(mps, 0.0), Vec2::X);
    bench.game.players[left].body.push_m = 0.1;
    bench.game.players[right].pos = spot + Vec2::new(0.5, 0.0);
    bench.game.players[right].body.facing = -Vec2::X;
    bench.game.ball.pos = (spot + Vec2::new(0.3, 0.0)).extend(0.11);
    (bench.game.owner, bench.game.last_touch, bench.game.possession) =
        (Some(LEFT_MAN), Some(LEFT_MAN), Some(Team::Left));
    let lunge = Lunge {
        at: now + 10,
        out: 1,
        back: 18,
        changes_feet: false,
        aim: Aim::Poke,
        place: spot.extend(0.11),
        brakes: true,
        out_dmps: 9,
        at_dmps: None,
        wish: -Vec2::X,
        steps_before: Vec2::ZERO,
        steps_after: Vec2::ZERO,
    };
    bench.game.players[right].body.lunge = lunges.then_some(lunge);
    let vel = [left, right].map(|i| bench.game.players[i].vel);
    stumble::meet(&mut bench.game, &mut bench.events, [LEFT_MAN, RIGHT_MAN], vel, 0.72);
    ([left, right].map(|i| bench.game.players[i].body.pose), bench.seen(EventKind::Foul).is_some())
}

#[test]
fn who_runs_into_a_rival_loses_their_balance_and_who_stands_does_not() {
    let runs = |mps: f32| meeting(mps, false).0[0];
    assert_eq!(runs(0.0), Pose::Up);
    assert!(matches!(runs(7.0), Pose::Stumbling { .. }));
    let foul = meeting(7.0, false).1;
    assert!(!foul, "nobody had a leg out");
    assert!(meeting(7.0, true).1, "a leg that is out brings a sprinter down");
}

#[test]
fn a_sprinter_who_is_held_up_stumbles_as_slowly_as_they_feel() {
    let stumble = |felt: f32| {
        let mut bench = alone(&[], 0);
        let [left, right] = [LEFT_MAN.index(), RIGHT_MAN.index()];
        let spot = bench.game.players[left].pos;
        (bench.game.players[left].vel, bench.game.players[left].body.facing) =
            (Vec2::new(7.5, 0.0), Vec2::X);
        bench.game.players[left].body.push_m = 0.1;
        bench.game.players[right].pos = spot + Vec2::new(0.4, 0.0);
        bench.game.players[right].body.facing = -Vec2::X;
        bench.game.ball.pos = (spot + Vec2::new(0.3, 0.0)).extend(0.11);
        (bench.game.owner, bench.game.last_touch) = (Some(LEFT_MAN), Some(LEFT_MAN));
        let vel = [Vec2::new(felt, 0.0), Vec2::ZERO];
        stumble::meet(&mut bench.game, &mut bench.events, [LEFT_MAN, RIGHT_MAN], vel, 0.72);
        let player = &bench.game.players[left];
        (player.vel.x, player.body.pose_ticks)
    };
    let ((slow, briefly), (fast, long)) = (stumble(5.0), stumble(7.5));
    assert_eq!((slow, fast), (5.0, 7.5));
    assert!(0 < briefly && briefly < long, "{briefly} and {long} ticks");
}

/// Shoots at a player's chest: the handballs of each seed, and what was given.
fn handballs(
    rules: &[(Rule, f64)],
    who: PlayerId,
    at: Vec2,
    height: f32,
) -> Vec<(Event, GameMode)> {
    let mut called = Vec::new();
    for seed in 0..400 {
        let mut bench = alone(rules, seed);
        bench.game.players[who.index()].pos = at;
        let from = Vec3::new(at.x - 3.0, at.y, height);
        bench.game.ball = Ball { pos: from, vel: Vec3::new(25.0, 0.0, 0.5), spin: Vec3::ZERO };
        contact::note(&mut bench.game, LEFT_MAN, contact::Touch::Played);
        contact::shot_struck(&mut bench.game, &mut bench.events, LEFT_MAN, from.truncate());
        bench.step(Action::BuiltinAi);
        bench.step(Action::BuiltinAi);
        if let Some(event) = bench.seen(EventKind::Handball) {
            assert_eq!(bench.game.player(who).yellow_cards, 1, "it stopped a shot");
            bench.restart();
            called.push((event, bench.game.mode));
        }
    }
    called
}

#[test]
fn handball_is_rare_and_only_where_the_rule_is_on() {
    let on = [(Rule::Handball, 1.0)];
    let (middle, near_goal) = (Vec2::new(0.0, 10.0), Vec2::new(48.0, 5.0));
    let called = handballs(&on, RIGHT_MAN, middle, 1.0);
    assert!((4..=40).contains(&called.len()), "{} of 400", called.len());
    assert!(
        called
            .iter()
            .all(|(event, mode)| event.by == Some(RIGHT_MAN) && *mode == GameMode::FreeKick)
    );
    let called = handballs(&on, RIGHT_MAN, near_goal, 1.0);
    assert!(!called.is_empty() && called.iter().all(|(_, mode)| *mode == GameMode::Penalty));
    for (rules, who, at, height) in [
        (&[] as &[_], RIGHT_MAN, middle, 1.0),
        (&on, RIGHT_MAN, middle, 0.2),
        (&on, PlayerId(11), near_goal, 1.0),
        (&[(Rule::Handball, 1.0), (Rule::Stochastic, 0.0)], RIGHT_MAN, middle, 1.0),
    ] {
        assert_eq!(handballs(rules, who, at, height), []);
    }
}

/// However a shot ends, its event names the place it was struck from.
#[test]
fn a_goal_and_a_shots_verdict_name_where_it_was_struck() {
    for (y, verdict) in [(1.0, Qualifier::OnTarget), (12.0, Qualifier::OffTarget)] {
        let mut bench = Bench::new(Layout::Eleven, 0);
        let struck = Vec2::new(40.0, y);
        contact::shot_struck(&mut bench.game, &mut bench.events, LEFT_MAN, struck);
        roll(&mut bench, Vec3::new(54.0, y, 0.5), Vec3::new(20.0, 0.0, 0.0), LEFT_MAN);
        let verdicts: Vec<Event> = bench
            .events
            .as_slice()
            .iter()
            .copied()
            .filter(|it| it.qualifier == Some(verdict))
            .collect();
        assert_eq!(verdicts.len(), 1);
        for event in verdicts.into_iter().chain(bench.seen(EventKind::Goal)) {
            assert_eq!(event.at.truncate(), struck, "{:?}", event.kind);
            assert!((event.length_m - struck.distance(Vec2::new(55.0, 0.0))).abs() < 1e-4);
        }
        assert_eq!(bench.seen(EventKind::Goal).is_some(), verdict == Qualifier::OnTarget);
    }
}
