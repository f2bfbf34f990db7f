//! The game under an agent's control: how kicks, touches and duels come out if a key is pressed in
//! every step.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

use glam::Vec2;
use setpiece::engine::environment::{Environment, EnvironmentOptions, Scratch};
use setpiece::engine::state::{Match, PlayerId};
use setpiece::scenario::vocabulary::Action;

/// A faster ball has been kicked, m/s.
const KICKED_MPS: f32 = 11.0;

fn library(name: &str) -> Environment {
    let scenario = setpiece::load(name).unwrap().scenario;
    Environment::new(scenario, EnvironmentOptions::default()).unwrap()
}

fn written(body: &str) -> Environment {
    let text = format!("scenario hands {{ rules {{ offside: off }} {body} end limit 60 steps }}");
    let scenario =
        setpiece::compile_text(&text, "<hands>").unwrap_or_else(|error| panic!("{error}")).scenario;
    Environment::new(scenario, EnvironmentOptions::default()).unwrap()
}

/// The matches after each of an episode's first 40 steps; `key` is the action of a step.
fn played(
    environment: &mut Environment,
    episode: u64,
    key: impl Fn(usize) -> Action,
) -> Vec<Match> {
    played_for(40, environment, episode, key)
}

/// The same for this many steps.
fn played_for(
    steps: usize,
    environment: &mut Environment,
    episode: u64,
    key: impl Fn(usize) -> Action,
) -> Vec<Match> {
    let mut scratch = Scratch::default();
    environment.reset(Some(1), Some(episode)).unwrap();
    let mut matches = Vec::new();
    while environment.is_running() && matches.len() < steps {
        environment.step(&[key(matches.len())], &mut scratch).unwrap();
        matches.push(environment.state().clone());
    }
    matches
}

/// The first step from one on after which the ball is as fast as a kicked one.
fn kicked_at(matches: &[Match], from: usize) -> Option<usize> {
    (from..matches.len()).find(|&step| matches[step].ball.vel.truncate().length() > KICKED_MPS)
}

#[test]
fn the_ball_of_a_start_is_pushed_off_at_once_from_close_by_and_else_at_a_moment_of_chance() {
    let first_touch = |scenario: &str, key: Action| -> Vec<usize> {
        let mut environment = library(scenario);
        let step = |episode| {
            let matches = played(&mut environment, episode, |_| key);
            matches.iter().position(|game| game.last_touch.is_some()).unwrap()
        };
        (0..40).map(step).collect()
    };
    let near = "academy_3_vs_1_with_keeper";
    assert!(first_touch(near, Action::Right).iter().all(|&step| step == 0));
    // Who turns with the ball comes up to it first.
    let turned = [(near, Action::BottomRight), ("academy_run_to_score", Action::BottomRight)];
    for (scenario, key) in turned {
        let steps = first_touch(scenario, key);
        assert!(steps.contains(&2) && steps.contains(&3), "{scenario}: {steps:?}");
        assert!(steps.iter().all(|step| (1..=4).contains(step)), "{scenario}: {steps:?}");
    }
}

#[test]
fn whoever_presses_a_shot_in_every_step_shoots_from_where_the_ball_lies() {
    let mut environment = library("academy_empty_goal_close");
    let mut goals = 0;
    for episode in 0..20 {
        let matches = played(&mut environment, episode, |_| Action::Shot);
        let struck =
            kicked_at(&matches, 0).unwrap_or_else(|| panic!("no shot in episode {episode}"));
        assert!((7..=10).contains(&struck), "struck in step {struck}");
        assert!(
            matches[..struck].iter().all(|game| game.ball.pos.x < 42.5),
            "episode {episode}: the ball was pushed off"
        );
        goals += u32::from(environment.state().score == [1, 0]);
    }
    assert!(goals >= 18, "{goals} goals");
}

#[test]
fn a_kick_waits_until_the_turn_with_the_ball_is_played_out() {
    let mut environment = library("academy_pass_and_shoot_with_keeper");
    let mut leaves = |press: usize| -> Vec<usize> {
        let key = |step| if step == press { Action::HighPass } else { Action::Right };
        (0..12)
            .filter_map(|episode| kicked_at(&played(&mut environment, episode, key), press))
            .collect()
    };
    // Before the player reaches the ball, the kick is their first touch. After a touch that turns
    // their run it comes later.
    let (before, after) = (leaves(3), leaves(7));
    assert!(before.iter().all(|step| (5..=7).contains(step)) && before.len() == 12, "{before:?}");
    assert!(after.iter().all(|step| *step >= 10) && after.len() >= 3, "{after:?}");
}

const PASSED: &str = "ball at (0.7, 0.26)
    team left { GK at (-1, 0)  passer: CM at (0.7, 0.28)  CM at (0.67, 0) }
    agents { left: 1 }
    team right { GK at (1, 0) { ai: lazy } }";

#[test]
fn a_shot_asked_for_in_time_is_struck_first_time() {
    let mut environment = written(PASSED);
    let key = |press: usize| {
        move |step| match step {
            0..3 => Action::Top,
            3 => Action::ShortPass,
            _ if step == press => Action::Shot,
            _ => Action::Idle,
        }
    };
    let near = |game: &Match| game.players[2].pos.distance(game.ball.pos.truncate()) < 1.2;
    let ahead = |game: &Match| game.ball.vel.x > KICKED_MPS;
    let mut steps_to_shot = |before: usize, after: usize| -> Vec<usize> {
        let shot = |episode| {
            let comes = played(&mut environment, episode, key(usize::MAX)).iter().position(near)?;
            let matches = played(&mut environment, episode, key(comes + after - before));
            let arrives = matches.iter().position(near)?;
            Some((arrives..matches.len()).find(|&step| ahead(&matches[step]))? - arrives)
        };
        (0..40).filter_map(shot).collect()
    };
    let first_time = |steps: &[usize]| steps.iter().filter(|&&step| step <= 2).count();
    let (early, late) = (steps_to_shot(4, 0), steps_to_shot(0, 2));
    assert!(first_time(&early) >= 12, "{early:?}");
    assert!(first_time(&late) == 0 && late.len() > 20, "{late:?}");
}

/// A runner and a defender in their way; `difficulty` is the defender's.
fn met(difficulty: f32) -> Environment {
    written(&format!(
        "ball at (0.64, 0)
        team left {{ GK at (-1, 0)  CM at (0.62, 0) }}
        agents {{ left: 1 }}
        team right {{ difficulty: {difficulty}  GK at (1, 0)  CB at (0.75, uniform(-0.03, 0.03)) }}"
    ))
}

/// In how many of these episodes a runner loses the ball to the defender within 20 steps.
fn lost(environment: &mut Environment, episodes: u64) -> usize {
    let loses = |episode: &u64| {
        let matches = played(environment, *episode, |_| Action::Right);
        matches.iter().take(20).any(|game| game.owner.is_some_and(|owner| owner.0 >= 11))
    };
    (0..episodes).filter(loses).count()
}

#[test]
fn weak_defenders_reach_the_ball_too() {
    let (strong, weak) = (lost(&mut met(0.6), 40), lost(&mut met(0.05), 40));
    assert!(strong >= 22 && weak >= 10, "{strong} and {weak} of 40");
}

#[test]
fn a_defender_meets_a_dribbler_no_faster_than_at_a_walk() {
    let mut environment = met(0.6);
    let mut speeds = Vec::new();
    for episode in 0..20 {
        let matches = played(&mut environment, episode, |_| Action::Right);
        let gap = |game: &Match| game.players[12].pos.distance(game.ball.pos.truncate());
        let Some(meets) = matches.iter().position(|game| gap(game) < 1.0) else { continue };
        let defender = &matches[meets].players[12];
        speeds.push(
            defender
                .vel
                .dot((matches[meets].ball.pos.truncate() - defender.pos).normalize_or(Vec2::X))
                .abs(),
        );
    }
    speeds.sort_by(f32::total_cmp);
    // GRF's: at 3.4 m/s.
    let middle = speeds[speeds.len() / 2];
    assert!(speeds.len() > 15 && (2.0..4.2).contains(&middle), "{speeds:?}");
}

#[test]
fn a_defender_stops_for_a_ball_that_rolls_up() {
    let mut environment = library("academy_3_vs_1_with_keeper");
    let stops = |episode: &u64| {
        let matches = played(&mut environment, *episode, |step| {
            if step == 1 { Action::Sprint } else { Action::Right }
        });
        matches.iter().any(|game| game.players[12].body.lunge.is_some_and(|lunge| lunge.brakes))
    };
    let stopped = (0..20).filter(stops).count();
    assert!(stopped >= 10, "{stopped} of 20");
}

#[test]
fn a_sprinters_ball_rolls_past_a_keeper_who_comes_out_and_is_often_stopped_in_the_end() {
    let mut environment = library("academy_run_to_score_with_keeper");
    let keeper = PlayerId(11);
    let mut seen = [0; 2];
    for episode in 0..40 {
        let matches = played_for(90, &mut environment, episode, |step| {
            if step == 1 { Action::Sprint } else { Action::Right }
        });
        let past = matches.iter().position(|game| {
            game.ball.pos.x > game.player(keeper).pos.x + 1.0 && game.owner != Some(keeper)
        });
        let stopped = matches.iter().all(|game| game.score == [0, 0]);
        seen[0] += usize::from(past.is_some());
        seen[1] += usize::from(stopped);
    }
    assert!(seen.iter().all(|count| *count >= 10), "past, no goal: {seen:?} of 40");
}

const PASSER: &str = "ball at (-0.44, 0)
    team left { GK at (-1, 0) { ai: lazy, controllable: false }  CB at (-0.45, 0)  CM at (0.05, 0.02) { ai: lazy } }
    agents { left: 1 }
    team right { GK at (1, 0) { ai: lazy } }";

#[test]
fn passes_roll_in_one_half_of_the_episodes_and_float_in_the_other() {
    let mut environment = written(PASSER);
    let key = |step| if step == 7 { Action::ShortPass } else { Action::Idle };
    let mut peak = |episode: u64| {
        let matches = played(&mut environment, episode, key);
        matches.iter().take(30).fold(0.0f32, |peak, game| peak.max(game.ball.pos.z))
    };
    let peaks: Vec<f32> = (0..40).map(&mut peak).collect();
    let rolls = peaks.iter().filter(|peak| **peak < 0.9).count();
    let floats = peaks.iter().filter(|peak| **peak > 2.0).count();
    assert_eq!(rolls + floats, 40, "{peaks:?}");
    assert!(rolls.min(floats) >= 10, "{rolls} roll, {floats} float");
}

#[test]
fn the_nearest_defender_comes_forward_to_the_ball_of_a_start() {
    let mut environment = library("academy_counterattack_easy");
    let mut forward = |episode: u64| {
        let matches = played(&mut environment, episode, |_| Action::Right);
        let start = matches[0].players[14].pos.x;
        start - matches.iter().take(15).map(|game| game.players[14].pos.x).fold(f32::MAX, f32::min)
    };
    let forward: Vec<f32> = (0..20).map(&mut forward).collect();
    let far = forward.iter().filter(|metres| **metres > 0.8).count();
    assert!(far >= 12 && forward.iter().all(|metres| *metres > 0.6), "{forward:?}");
}

#[test]
fn players_set_off_from_a_start_when_chance_will_have_it() {
    let mut environment = library("academy_counterattack_easy");
    let mut way = |episode: u64| {
        let matches = played(&mut environment, episode, |_| Action::Right);
        matches[4].players[1].pos.distance(matches[0].players[1].pos)
    };
    let ways: Vec<f32> = (0..40).map(&mut way).collect();
    let (least, most) = ways
        .iter()
        .fold((f32::MAX, 0.0f32), |(least, most), way| (least.min(*way), most.max(*way)));
    assert!(least < 0.7 && most > 1.0, "{least} to {most}");
}

#[test]
fn a_ball_struck_at_a_body_springs_off_it() {
    let mut environment = written(
        "ball at (0.52, 0)
        team left { GK at (-1, 0)  CM at (0.5, 0) }
        agents { left: 1 }
        team right { GK at (1, 0) { ai: lazy }  CB at (0.57, 0) { ai: lazy } }",
    );
    let springs =
        |episode: &u64| {
            let matches = played(&mut environment, *episode, |step| {
                if step == 3 { Action::Shot } else { Action::Idle }
            });
            matches
                .iter()
                .any(|game| game.ball.vel.x < -2.0 && game.last_touch.is_some_and(|id| id.0 == 12))
        };
    let sprung = (0..20).filter(springs).count();
    assert!(sprung > 12, "{sprung} of 20");
}

/// How far ahead of its runner the ball gets in a straight run with opponents in lines at `beside`,
/// metres.
fn runs_ahead(beside: &str) -> f32 {
    let line: String = (0..8)
        .map(|i| format!("CB at ({}, {beside}) {{ ai: lazy }} ", 0.03 * f64::from(i)))
        .collect();
    let mut environment = written(&format!(
        "ball at (-0.18, 0)
        team left {{ GK at (-1, 0)  CM at (-0.2, 0) }}
        agents {{ left: 1 }}
        team right {{ GK at (1, 0) {{ ai: lazy }}  {line} }}",
    ));
    let matches =
        played(&mut environment, 1, |step| if step == 1 { Action::Sprint } else { Action::Right });
    let ahead = |game: &Match| game.ball.pos.truncate().distance(game.players[1].pos);
    matches.iter().skip(20).map(ahead).fold(0.0, f32::max)
}

#[test]
fn an_opponent_close_by_makes_a_dribbler_push_the_ball_further() {
    let (annoyed, alone) = (runs_ahead("0.011"), runs_ahead("0.3"));
    assert!(annoyed > alone + 0.15, "{annoyed} and {alone} m");
}

#[test]
fn a_sprinter_brakes_for_a_shot_and_follows_through() {
    let mut environment = library("academy_empty_goal");
    let matches = played(&mut environment, 1, |step| match step {
        0 => Action::Sprint,
        20 => Action::Shot,
        _ => Action::Right,
    });
    let pace = |step: usize| matches[step].players[1].vel.length();
    let leaves = kicked_at(&matches, 20).unwrap();
    assert!(pace(20) > 7.0, "{}", pace(20));
    assert!((4.5..6.8).contains(&pace(leaves)), "{} at the contact", pace(leaves));
    assert!(pace(leaves + 3) < 4.5, "{} after the kick at {leaves}", pace(leaves + 3));
    assert!(pace(leaves + 14) > 6.0, "{} later", pace(leaves + 14));
}

#[test]
fn a_shot_scatters_more_for_whoever_only_sets_off() {
    let mut environment = library("academy_empty_goal");
    let mut scatter = |press: usize| {
        let direction = |episode: u64| {
            let matches = played(&mut environment, episode, |step| {
                if step == press { Action::Shot } else { Action::Right }
            });
            let velocity = matches[kicked_at(&matches, press)?].ball.vel;
            Some((velocity.y / velocity.x).atan())
        };
        let found: Vec<f32> = (0..40).filter_map(direction).collect();
        (found.iter().map(|angle| angle * angle).sum::<f32>() / found.len() as f32).sqrt()
    };
    let (setting_off, running) = (scatter(2), scatter(13));
    assert!(setting_off > 1.3 * running, "{setting_off} and {running} rad");
}

#[test]
fn who_is_handed_to_the_bot_holds_no_key() {
    let mut environment = library("academy_empty_goal");
    let matches = played(&mut environment, 1, |step| match step {
        8..12 => Action::Shot,
        12.. => Action::BuiltinAi,
        _ => Action::Right,
    });
    let held = |step: usize| matches[step].players[1].body.kick.is_some_and(|plan| plan.held);
    assert!(held(11) && !held(12));
}

/// A runner with the ball at their feet, and a mate 40 m ahead.
const LONG_WAY: &str = "
    team left { CM at (-0.5, 0) CM at (0.25, 0) { ai: lazy } }
    team right { GK at (1, 0) { ai: lazy } }
    ball at (-0.48, 0)";

#[test]
fn a_rolling_ball_is_passed_harder_than_a_resting_one() {
    let mut environment = written(LONG_WAY);
    let runs = |step| if step == 8 { Action::ShortPass } else { Action::Right };
    let stands = |step| match step {
        0..8 => Action::Right,
        8..20 => Action::ReleaseDirection,
        20 => Action::ShortPass,
        _ => Action::Idle,
    };
    let mut fastest = |key: &dyn Fn(usize) -> Action, episode: u64| {
        let matches = played(&mut environment, episode, key);
        matches.iter().fold(0.0f32, |most, game| most.max(game.ball.vel.truncate().length()))
    };
    let (rolling, resting) = (0..8).fold((0.0, 0.0), |(rolling, resting), episode| {
        (rolling + fastest(&runs, episode) / 8.0, resting + fastest(&stands, episode) / 8.0)
    });
    assert!(rolling > 30.0 && resting < 28.5, "{rolling} m/s rolling, {resting} m/s resting");
}

#[test]
fn a_sprinters_pass_needs_no_new_touch() {
    let mut environment = written(LONG_WAY);
    let key = |press: usize| {
        move |step| match step {
            0 => Action::Sprint,
            _ if step == press => Action::HighPass,
            _ => Action::Right,
        }
    };
    let fast = |game: &Match| game.ball.vel.truncate().length();
    for episode in 0..8 {
        let free = played(&mut environment, episode, key(usize::MAX));
        let touch = (14..22).find(|&step| fast(&free[step]) > fast(&free[step - 1]) + 0.5).unwrap();
        let matches = played(&mut environment, episode, key(touch + 1));
        let leaves = kicked_at(&matches, touch + 1).unwrap();
        assert!(leaves <= touch + 8, "touched in step {touch}, kicked in step {leaves}");
    }
}

#[test]
fn a_shot_behind_the_back_is_pulled_off_the_way_to_the_goal() {
    // The shooter faces the ball that comes to them, away from the goal.
    let mut environment = written(
        "team left { CM at (0.35, 0.12) CF at (0.7, 0) }
         team right { GK at (0.9, 0.38) { ai: lazy } }
         ball at (0.365, 0.115)
         agents { left: all }",
    );
    let mut scratch = Scratch::default();
    let mut shots = Vec::new();
    for episode in 0..24 {
        environment.reset(Some(1), Some(episode)).unwrap();
        let mut asked = false;
        for step in 0..50 {
            let game = environment.state();
            let near = game.players[1].pos.distance(game.ball.pos.truncate()) < 14.0;
            let asks = step > 8 && near && !asked;
            asked |= asks;
            let first = match step {
                0..8 => Action::TopRight,
                8 => Action::ShortPass,
                _ => Action::Idle,
            };
            let second = if asks { Action::Shot } else { Action::Idle };
            environment.step(&[first, second], &mut scratch).unwrap();
            let ball = environment.state().ball.vel.truncate();
            if ball.length() > 10.5 && environment.state().last_touch == Some(PlayerId(1)) {
                shots.push(ball.y.atan2(ball.x).to_degrees());
                break;
            }
        }
    }
    let off = |degrees: f32| shots.iter().filter(|shot| shot.abs() > degrees).count();
    assert!(shots.len() >= 12 && off(80.0) == 0, "none goes back: {shots:?}");
    assert!(2 * off(40.0) < shots.len() && 4 * off(20.0) > shots.len(), "{shots:?}");
}

#[test]
fn who_sets_off_next_to_the_ball_touches_it_once_they_run() {
    let mut environment = written(
        "team left { CF at (24.75m, 0m) } team right { GK at (0.9, 0.38) { ai: lazy } }
         ball at (25.57m, 0m)",
    );
    let key = |step| if step == 0 { Action::Sprint } else { Action::Right };
    let mut running = 0;
    for episode in 0..12 {
        let matches = played(&mut environment, episode, key);
        let speeds: Vec<f32> = matches.iter().map(|game| game.ball.vel.length()).collect();
        let touches: Vec<usize> =
            (1..16).filter(|&step| speeds[step] > speeds[step - 1] + 0.5).collect();
        assert!(touches[1] - touches[0] >= 4, "{touches:?}");
        running += u32::from(speeds[touches[0]] > 3.7);
    }
    assert!(running >= 8, "{running} of 12");
}
