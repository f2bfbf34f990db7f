//! Full matches of the bot against itself; a seed repeats.

use crate::Bench;
use crate::layouts::{Layout, drawn, set_level};
use glam::{Vec2, Vec3};
use setpiece_engine::football::{bounce, contact};
use setpiece_engine::physics::Ball;
use setpiece_engine::state::player::{Aim, Lunge};
use setpiece_engine::state::{Match, PlayerId};
use setpiece_scenario::vocabulary::{Action, EventKind, Qualifier, Role, Rule, Team};

/// Everything visible of a match.
fn seen(game: &Match) -> String {
    format!(
        "{:?} {:?} {:?} {:?} {:?}",
        game.ball, game.players, game.score, game.owner, game.agents
    )
}

/// Plays this many steps of bot against bot.
fn play(bench: &mut Bench, steps: u32) {
    for _ in 0..steps {
        bench.step(Action::BuiltinAi);
        if bench.game.dead {
            bench.restart();
        }
    }
}

#[test]
fn a_seed_repeats_and_another_differs() {
    let run = |seed| {
        let mut bench = Bench::new(Layout::Eleven, seed);
        play(&mut bench, 300);
        seen(&bench.game)
    };
    assert_eq!(run(4), run(4));
    assert_ne!(run(4), run(6));
}

#[test]
fn without_chance_the_seed_is_of_no_account() {
    let run = |seed| {
        let mut start = drawn(Layout::Eleven, seed);
        start.rules[Rule::Stochastic.index()] = 0.0;
        let mut bench = Bench::of(&start);
        play(&mut bench, 300);
        seen(&bench.game)
    };
    assert_eq!(run(2), run(4));
}

#[test]
fn a_copy_goes_on_like_the_match_it_was_taken_from() {
    let mut bench = Bench::new(Layout::Eleven, 1);
    play(&mut bench, 120);
    let copy = bench.game.clone();
    play(&mut bench, 150);
    let straight = seen(&bench.game);
    bench.game = copy;
    bench.scratch = setpiece_engine::physics::Scratch::default();
    play(&mut bench, 150);
    assert_eq!(straight, seen(&bench.game));
}

#[test]
fn bots_play_football() {
    let (mut steps, mut crowd, mut thirds) = (0u32, 0.0f64, [0u32; 3]);
    let (mut passes, mut completed, mut shots, mut goals, mut spells) =
        (0u32, 0u32, 0u32, 0u32, 0u32);
    let matches = 6;
    for seed in 0..matches {
        let mut bench = Bench::new(Layout::Eleven, seed);
        let mut last = None;
        for _ in 0..3000 {
            bench.step(Action::BuiltinAi);
            steps += 1;
            for event in bench.events.as_slice() {
                match (event.kind, event.qualifier) {
                    (EventKind::Pass, Some(Qualifier::Attempted)) => passes += 1,
                    (EventKind::Pass, Some(Qualifier::Completed)) => completed += 1,
                    (EventKind::Shot, None) => shots += 1,
                    (EventKind::Goal, _) => goals += 1,
                    _ => {}
                }
            }
            assert_eq!(bench.events.dropped(), 0);
            let game = &bench.game;
            let ball = game.ball.pos;
            assert!(
                ball.is_finite() && ball.x.abs() < 60.0 && ball.y.abs() < 40.0 && ball.z < 30.0,
                "ball at {ball}"
            );
            let field: Vec<_> =
                game.players.iter().filter(|p| p.active && p.role != Role::GK).collect();
            crowd += field.iter().filter(|p| p.pos.distance(ball.truncate()) < 8.0).count() as f64
                / field.len() as f64;
            thirds[if ball.x < -18.33 {
                0
            } else if ball.x < 18.33 {
                1
            } else {
                2
            }] += 1;
            if game.possession.is_some() && game.possession != last {
                last = game.possession;
                spells += 1;
            }
            assert_eq!(game.squad.len(), 22);
            for player in game.players.iter().filter(|p| p.active) {
                assert!(
                    player.pos.is_finite()
                        && player.pos.x.abs() <= 60.5
                        && player.pos.y.abs() <= 40.5
                );
                assert!(player.vel.length() < 12.0, "{} m/s", player.vel.length());
            }
            if bench.game.dead {
                bench.restart();
            }
        }
        assert_eq!(bench.game.step, 3000);
    }
    let per_match = |count: u32| f64::from(count) / matches as f64;
    assert!((40.0..250.0).contains(&per_match(passes)), "{} passes", per_match(passes));
    assert!(f64::from(completed) >= 0.45 * f64::from(passes), "{completed} of {passes} completed");
    assert!((2.0..40.0).contains(&per_match(shots)), "{} shots", per_match(shots));
    assert!((0.3..8.0).contains(&per_match(goals)), "{} goals", per_match(goals));
    let spell = f64::from(steps) / f64::from(spells);
    assert!((10.0..100.0).contains(&spell), "spells of {spell} steps");
    assert!(crowd / f64::from(steps) < 0.3, "{} near the ball", crowd / f64::from(steps));
    for third in thirds {
        assert!(f64::from(third) >= 0.08 * f64::from(steps), "thirds {thirds:?}");
    }
}

#[test]
fn the_stronger_side_wins() {
    let mut difference = 0i32;
    for seed in 0..4 {
        let mut start = drawn(Layout::Eleven, seed);
        set_level(&mut start, [1.0, 0.05]);
        let mut bench = Bench::of(&start);
        play(&mut bench, 3000);
        difference += i32::from(bench.game.score[0]) - i32::from(bench.game.score[1]);
    }
    assert!(difference >= 1, "goal difference {difference} in 4 matches");
}

#[test]
fn a_pass_hands_control_to_its_receiver_and_a_fixed_slot_keeps_its_player() {
    for fixed in [false, true] {
        let mut start = drawn(Layout::ThreeVersusOne, 0);
        if fixed {
            start.agents[0].fixed = Some(setpiece_engine::state::PlayerId(1));
        }
        let mut bench = Bench::of(&start);
        for _ in 0..4 {
            bench.step(Action::Idle);
        }
        assert_eq!(bench.game.agents[0].player.map(|id| id.0), Some(1));
        bench.step(Action::TopRight);
        let mut receiver = None;
        for step in 0..8 {
            bench.step(if step == 0 { Action::ShortPass } else { Action::Idle });
            receiver = receiver.or(bench.seen(EventKind::Pass).and_then(|pass| pass.to));
        }
        let receiver = receiver.expect("a pass is struck within eight steps");
        let now = bench.game.agents[0].player.unwrap();
        assert_eq!(now, if fixed { setpiece_engine::state::PlayerId(1) } else { receiver });
    }
}

#[test]
fn a_kick_pressed_in_the_first_step_is_not_heard() {
    let mut bench = Bench::new(Layout::RunToScore, 0);
    for step in 0..20 {
        bench.step(if step == 0 { Action::Shot } else { Action::Idle });
        assert_eq!(bench.seen(EventKind::Shot), None);
    }
    bench.step(Action::Shot);
    assert!((0..20).any(|_| {
        bench.step(Action::Idle);
        bench.seen(EventKind::Shot).is_some()
    }));
}

#[test]
fn a_kick_pressed_before_the_ball_comes_is_the_first_touch() {
    for (action, kind) in [(Action::Shot, EventKind::Shot), (Action::ShortPass, EventKind::Pass)] {
        let mut bench = Bench::new(Layout::RunToScore, 0);
        let mut touches = 0;
        let kicked = (0..20).any(|step| {
            bench.step(if step == 1 { action } else { Action::Idle });
            touches += bench
                .events
                .as_slice()
                .iter()
                .filter(|event| event.kind == EventKind::Touch)
                .count();
            bench.seen(kind).is_some()
        });
        assert!(kicked, "{action:?} is never struck");
        assert_eq!(touches, 1, "{action:?} is struck after {touches} touches");
        assert_eq!(bench.game.possession, None, "{action:?} leaves nobody an owner");
    }
}

#[test]
fn an_agents_first_action_goes_to_the_player_at_the_ball() {
    let mut bench = Bench::new(Layout::EmptyGoalClose, 0);
    assert_eq!(bench.game.agents[0].player, Some(PlayerId(0)), "the start gives it the keeper");
    bench.step(Action::Left);
    assert_eq!(bench.game.agents[0].player, Some(PlayerId(1)));
    for _ in 0..4 {
        bench.step(Action::Idle);
    }
    assert!(bench.game.ball.vel.x < 0.0, "the ball goes where the first key said");
}

#[test]
fn whoever_waits_at_the_ball_of_a_start_pushes_it_on_and_sets_off_after_it() {
    let mut start = drawn(Layout::EmptyGoalClose, 0);
    start.players[1].as_mut().unwrap().pos.x = start.ball_pos.x - 0.7;
    let mut bench = Bench::of(&start);
    let at = |bench: &Bench| (bench.game.ball.vel.x, bench.game.player(PlayerId(1)).vel.x);
    bench.step(Action::Right);
    let (ball, runs) = at(&bench);
    assert!((2.4..3.5).contains(&ball), "the ball is pushed on at {ball} m/s");
    assert!((1.5..2.5).contains(&runs), "the player follows at {runs} m/s");
    for step in 0..10 {
        bench.step(if step == 0 { Action::Sprint } else { Action::Right });
    }
    let (_, runs) = at(&bench);
    assert!(runs > 5.0, "the player sprints at {runs} m/s");
}

#[test]
fn who_turns_with_the_ball_keeps_it_close_and_hardly_slows_down() {
    let mut bench = Bench::new(Layout::RunToScore, 0);
    for _ in 0..14 {
        bench.step(Action::Right);
    }
    let mut slowest = f32::MAX;
    for _ in 0..9 {
        bench.step(Action::TopRight);
        let player = bench.game.player(PlayerId(1));
        let gap = player.pos.distance(bench.game.ball.pos.truncate());
        assert!(gap < 0.8, "the ball is {gap} m away");
        slowest = slowest.min(player.vel.length());
    }
    assert!(slowest > 3.4, "the player slows down to {slowest} m/s");
    let run = bench.game.player(PlayerId(1)).vel;
    assert!((run.y / run.x + 1.0).abs() < 0.2, "the run leads to the top right: {run}");
}

#[test]
fn a_defender_reaches_for_the_ball_that_a_sprinter_pushes_ahead() {
    let mut bench = Bench::new(Layout::ThreeVersusOne, 0);
    let stopped = (0..40).any(|_| {
        bench.step(Action::Sprint);
        bench.game.team(Team::Right).any(|(_, rival)| rival.body.lunge.is_some())
    });
    assert!(stopped, "nobody reaches for the ball of a sprinter");
}

#[test]
fn a_leg_that_swings_at_the_ball_does_not_reach_for_it_as_well() {
    let mut bench = Bench::new(Layout::Eleven, 1);
    let mut swings = 0;
    for step in 0..1500 {
        play(&mut bench, 1);
        for (i, player) in bench.game.players.iter().enumerate() {
            let body = &player.body;
            swings += u32::from(body.swings());
            assert!(!(body.swings() && body.lunge.is_some()), "player {i} in step {step}");
        }
    }
    assert!(swings > 50, "{swings} steps of swings");
}

#[test]
fn a_leg_far_from_the_ball_is_drawn_back_in_its_time() {
    let mut bench = Bench::new(Layout::Eleven, 3);
    let far = PlayerId(0);
    let lunge = Lunge {
        at: bench.game.tick as i32 + 5,
        out: 5,
        back: 3,
        changes_feet: false,
        aim: Aim::Poke,
        place: Vec3::ZERO,
        brakes: true,
        out_dmps: 0,
        at_dmps: None,
        wish: Vec2::X,
        steps_before: Vec2::ZERO,
        steps_after: Vec2::ZERO,
    };
    bench.game.players[far.index()].body.lunge = Some(lunge);
    bench.step(Action::BuiltinAi);
    assert_eq!(bench.game.player(far).body.lunge, None);
}

#[test]
fn a_shot_that_springs_off_a_rival_is_blocked_and_off_a_keeper_saved() {
    let mut bench = Bench::new(Layout::Eleven, 0);
    let (striker, [keeper, defender]) = (PlayerId(9), [PlayerId(11), PlayerId(12)]);
    for (by, verdict) in [(defender, Qualifier::Blocked), (keeper, Qualifier::OnTarget)] {
        bench.events.clear();
        contact::shot_struck(&mut bench.game, &mut bench.events, striker, Vec2::new(40.0, 0.0));
        bench.events.clear();
        contact::sprang(&mut bench.game, &mut bench.events, by);
        let shot = bench.seen(EventKind::Shot).expect("the shot is settled");
        assert_eq!((shot.qualifier, shot.by), (Some(verdict), Some(striker)));
        assert_eq!(bench.seen(EventKind::Save).is_some(), by == keeper);
        assert_eq!(bench.game.play.shot, None);
    }
}

/// The velocity, along its way, of a 20 m/s ball that meets a body so long after a touch.
fn goes_on(toucher: PlayerId, ago_ticks: u32, high_m: f32) -> f32 {
    let mut bench = Bench::new(Layout::Eleven, 0);
    let (defender, at) = (PlayerId(12), Vec2::new(20.0, 5.0));
    let game = &mut bench.game;
    game.tick = 1000;
    game.last_touch = Some(toucher);
    game.players[toucher.index()].body.touched_at = (game.tick - ago_ticks) as i32;
    game.players[defender.index()].pos = at;
    game.players[defender.index()].vel = Vec2::ZERO;
    let pos = (at - Vec2::X * 0.1).extend(high_m);
    game.ball = Ball { pos, vel: Vec3::X * 20.0, spin: Vec3::ZERO };
    bounce::off_bodies(game, &mut bench.events, [defender].into_iter().collect());
    bench.game.ball.vel.x
}

#[test]
fn a_ball_springs_off_whoever_could_not_see_it_coming_and_off_nobody_else() {
    let (rival, mate) = (PlayerId(9), PlayerId(13));
    assert!(goes_on(rival, 5, 0.3) < -5.0, "{} m/s back", goes_on(rival, 5, 0.3));
    assert_eq!(goes_on(rival, 20, 0.3), 20.0, "0.2 s after the touch everybody has seen it");
    assert_eq!(goes_on(mate, 5, 0.3), 20.0, "a teammate's ball");
    assert_eq!(goes_on(rival, 5, 2.2), 20.0, "over the head");
}
