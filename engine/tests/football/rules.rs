//! Laws and bodies beyond the referee's first cases: walls, hands, deflections, crowds, challenges.

use crate::Bench;
use crate::layouts::{Layout, drawn};
use glam::{Vec2, Vec3};
use setpiece_engine::football::restart::place;
use setpiece_engine::football::{contact, foul, keeper, offside, past};
use setpiece_engine::physics::{Ball, Conditions, Forecast};
use setpiece_engine::state::PlayerId;
use setpiece_engine::state::play::Restart;
use setpiece_engine::state::player::Pose;
use setpiece_scenario::PitchSize;
use setpiece_scenario::vocabulary::{Action, EventKind, GameMode, Qualifier, Role, Rule, Team};

/// A match of eleven against eleven with some rules changed.
fn bench(rules: &[(Rule, f64)], seed: u64) -> Bench {
    let mut start = drawn(Layout::Eleven, seed);
    for (rule, value) in rules {
        start.rules[rule.index()] = *value;
    }
    Bench::of(&start)
}

#[test]
fn a_wall_stands_in_the_way_of_a_free_kick_near_goal() {
    for (spot, wall) in [(Vec2::new(30.0, 8.0), 3), (Vec2::new(5.0, 20.0), 0)] {
        let mut bench = bench(&[], 0);
        place(&mut bench.game, Restart { mode: GameMode::FreeKick, team: Team::Left, spot });
        let ahead = (Vec2::new(55.0, 0.0) - spot).normalize();
        let in_way = |pos: Vec2| {
            let away = pos - spot;
            (away.dot(ahead) - 9.15).abs() < 0.2 && ahead.perp_dot(away).abs() < 1.0
        };
        let opponents =
            bench.game.team(Team::Right).filter(|(_, player)| in_way(player.pos)).count();
        assert_eq!(opponents, wall, "at {spot}");
        for (_, rival) in bench.game.team(Team::Right).filter(|(_, player)| player.role != Role::GK)
        {
            assert!(rival.pos.distance(spot) > 9.0, "{} is too near", rival.pos);
        }
    }
}

#[test]
fn nobody_waits_offside_for_their_teams_free_kick() {
    for (i, team) in [Team::Left, Team::Right].into_iter().cycle().take(24).enumerate() {
        let spot = Vec2::new(i as f32 * 4.0 - 46.0, i as f32 * 2.5 - 30.0);
        let mut bench = bench(&[], i as u64);
        place(&mut bench.game, Restart { mode: GameMode::FreeKick, team, spot });
        let taker = bench.game.play.set_piece.unwrap().taker;
        assert_eq!(offside::positions(&bench.game, taker), 0, "{team} at {spot}");
    }
}

#[test]
fn a_long_shot_at_a_lone_keeper_is_seen_coming() {
    for x in [-10.0, -2.0, 5.0] {
        let mut goals = 0;
        for seed in 0..50 {
            let mut bench = bench(&[], seed);
            for player in &mut bench.game.players {
                player.pos = Vec2::new(-30.0, 30.0);
            }
            bench.game.players[11].pos = Vec2::new(50.0, 0.0);
            let who = PlayerId(2);
            let from = Vec2::new(x, 0.0);
            bench.game.players[who.index()].pos = from;
            let aim = (Vec2::new(55.0, (seed % 7) as f32 - 3.0) - from).normalize();
            let vel = (aim * 33.0).extend(9.0);
            bench.game.ball = Ball { pos: from.extend(0.11), vel, spin: Vec3::ZERO };
            contact::note(&mut bench.game, who, contact::Touch::Played);
            for _ in 0..60 {
                bench.step(Action::Idle);
                if bench.game.dead || bench.game.play.hands.is_some() {
                    break;
                }
            }
            goals += u32::from(bench.game.score[0]);
        }
        assert!(goals < 10, "{goals} of 50 from {x}");
    }
}

#[test]
fn a_shot_that_has_run_dead_is_off_target_whoever_comes_for_it() {
    let mut bench = bench(&[], 0);
    let (by, rival) = (PlayerId(5), PlayerId(14));
    let mut verdict = |speed: f32| {
        contact::shot_struck(&mut bench.game, &mut bench.events, by, Vec2::ZERO);
        bench.game.ball.vel = Vec3::new(speed, 0.0, 0.0);
        bench.events.clear();
        contact::touched(&mut bench.game, &mut bench.events, rival, false);
        bench.seen(EventKind::Shot).and_then(|event| event.qualifier)
    };
    assert_eq!(verdict(20.0), Some(Qualifier::Blocked));
    assert_eq!(verdict(0.0), Some(Qualifier::OffTarget));
}

#[test]
fn nobody_stands_in_anybody_at_a_kick_off() {
    let mut start = drawn(Layout::Eleven, 1);
    for player in start.players.iter_mut().skip(12).take(3).flatten() {
        player.kickoff = Some([Vec2::new(1.0, 0.5); 2]);
    }
    let mut bench = Bench::of(&start);
    place(&mut bench.game, Restart { mode: GameMode::KickOff, team: Team::Left, spot: Vec2::ZERO });
    let places: Vec<Vec2> = bench.game.players[12..15].iter().map(|player| player.pos).collect();
    for (one, two) in [(0, 1), (1, 2), (0, 2)] {
        assert!(places[one].distance(places[two]) > 0.7, "{places:?}");
    }
    assert!(places.iter().all(|place| place.length() > 9.15), "{places:?}");
}

#[test]
fn nobody_stands_in_anybody_at_a_restart() {
    for mode in [
        GameMode::GoalKick,
        GameMode::FreeKick,
        GameMode::Corner,
        GameMode::ThrowIn,
        GameMode::Penalty,
    ] {
        for (i, team) in [Team::Left, Team::Right].into_iter().cycle().take(20).enumerate() {
            let side = team.side() as f32;
            let (x, y) = (i as f32 * 5.0 - 50.0, i as f32 * 3.2 - 32.0);
            let spot = match mode {
                GameMode::GoalKick => Vec2::new(-50.6 * side, 0.0),
                GameMode::Corner => Vec2::new(55.0 * side, 36.0),
                GameMode::ThrowIn => Vec2::new(x, 36.0),
                GameMode::Penalty => Vec2::new(44.0 * side, 0.0),
                _ => Vec2::new(x, y),
            };
            let mut bench = bench(&[], i as u64);
            place(&mut bench.game, Restart { mode, team, spot });
            let places: Vec<Vec2> = bench.game.players.iter().map(|player| player.pos).collect();
            for (a, one) in places.iter().enumerate() {
                for (b, two) in places.iter().enumerate().skip(a + 1) {
                    assert!(
                        one.distance(*two) > 0.7,
                        "{mode} at {spot}: {a} and {b} at {one} and {two}"
                    );
                }
            }
        }
    }
}

#[test]
fn a_keeper_lets_go_within_six_seconds_or_gives_a_free_kick_away() {
    for (rule, given) in [(1.0, true), (0.0, false)] {
        let mut start = drawn(Layout::Eleven, 0);
        start.rules[Rule::SixSeconds.index()] = rule;
        start.agents[0].fixed = Some(PlayerId(0));
        let mut bench = Bench::of(&start);
        bench.game.ball.pos = Vec3::new(-50.0, 0.0, 1.0);
        bench.game.players[0].pos = Vec2::new(-50.4, 0.0);
        keeper::take(&mut bench.game, &mut bench.events, PlayerId(0));
        let mut after = None;
        for step in 1..=80 {
            bench.step(Action::Idle);
            if bench.seen(EventKind::FreeKick).is_some() {
                after = Some(step);
                break;
            }
        }
        assert_eq!(after.is_some(), given);
        if let Some(step) = after {
            assert!((60..=61).contains(&step), "{step}");
            assert_eq!(bench.seen(EventKind::FreeKick).unwrap().team, Some(Team::Right));
            bench.restart();
            assert!((-38.6..-38.4).contains(&bench.game.ball.pos.x), "from the edge of the box");
        }
    }
}

#[test]
fn a_deflection_plays_nobody_onside_and_a_played_ball_does() {
    let (passer, runner, defender) = (PlayerId(2), PlayerId(1), PlayerId(13));
    let set_up = || {
        let mut bench = bench(&[], 0);
        for player in &mut bench.game.players[11..] {
            player.pos.x = 20.0;
        }
        bench.game.players[11].pos = Vec2::new(54.0, 0.0);
        bench.game.players[passer.index()].pos = Vec2::new(10.0, 0.0);
        bench.game.players[runner.index()].pos = Vec2::new(35.0, 10.0);
        bench.game.ball = Ball {
            pos: Vec3::new(20.0, 5.0, 0.11),
            vel: Vec3::new(15.0, 5.0, 0.0),
            spin: Vec3::ZERO,
        };
        contact::note(&mut bench.game, passer, contact::Touch::Played);
        assert_ne!(offside::positions(&bench.game, passer) & (1 << runner.0), 0);
        bench
    };
    let mut sprang = set_up();
    contact::sprang(&mut sprang.game, &mut sprang.events, defender);
    assert!(offside::caught(&mut sprang.game, &mut sprang.events, runner));
    let mut played = set_up();
    assert!(contact::touched(&mut played.game, &mut played.events, defender, false));
    assert!(!offside::caught(&mut played.game, &mut played.events, runner));
}

#[test]
fn who_stands_on_the_ball_is_attacked_where_mates_are_about() {
    let mut won = 0;
    for seed in 0..20 {
        let mut bench = bench(&[(Rule::Assist, 0.0)], seed);
        let carrier = bench.game.agents[0].player.unwrap();
        let pos = Vec2::new(-20.0, 10.0);
        bench.game.players[carrier.index()].pos = pos;
        bench.game.ball = Ball {
            pos: (pos + Vec2::new(0.4, 0.0)).extend(0.11),
            vel: Vec3::ZERO,
            spin: Vec3::ZERO,
        };
        (bench.game.last_touch, bench.game.owner) = (Some(carrier), Some(carrier));
        for _ in 0..200 {
            bench.step(Action::Idle);
            if bench.seen(EventKind::BallWon).is_some() || bench.game.dead {
                won += 1;
                break;
            }
        }
    }
    // GRF's players do so; a player who is alone waits.
    assert!(won >= 15, "in {won} of 20 matches somebody won the ball");
}

#[test]
fn pushes_tell_and_fade() {
    let (by, victim) = (PlayerId(13), PlayerId(2));
    let mut bench = bench(&[], 0);
    bench.game.players[victim.index()].pos = Vec2::new(0.0, 30.0);
    bench.game.players[by.index()].pos = Vec2::new(0.3, 30.0);
    bench.step(Action::Idle);
    assert!(bench.game.player(victim).body.push_m > 0.005);
    bench.game.players[by.index()].pos = Vec2::new(30.0, 30.0);
    for _ in 0..10 {
        bench.step(Action::Idle);
    }
    assert!(bench.game.player(victim).body.push_m < 0.005);
}

#[test]
fn a_shot_at_the_keepers_chest_does_not_go_through() {
    let mut goals = 0;
    for seed in 0..200 {
        let mut bench = bench(&[], seed);
        for player in &mut bench.game.players {
            player.pos = Vec2::new(-10.0, 30.0);
        }
        bench.game.players[11].pos = Vec2::new(53.5, 0.0);
        let who = PlayerId(2);
        bench.game.players[who.index()].pos = Vec2::new(43.0, 0.0);
        bench.game.ball = Ball {
            pos: Vec3::new(44.0, 0.0, 0.5),
            vel: Vec3::new(25.0, 0.0, 1.5),
            spin: Vec3::ZERO,
        };
        contact::note(&mut bench.game, who, contact::Touch::Played);
        for _ in 0..8 {
            bench.step(Action::BuiltinAi);
            if bench.game.dead {
                break;
            }
        }
        goals += u32::from(bench.game.score[0]);
    }
    assert!(goals < 30, "{goals} of 200 went through the defender");
}

#[test]
fn a_ball_that_gets_past_the_first_at_it_comes_off_them() {
    // Ticks since a rival touched it, how far beside the player it is, metres, and whether it comes
    // off them.
    for (since, aside_m, comes_off) in [(30, 0.3, true), (30, 0.7, false), (10, 0.3, false)] {
        let mut bench = bench(&[], 0);
        let (striker, keeper) = (PlayerId(2), PlayerId(11));
        let game = &mut bench.game;
        game.tick += 1_000;
        game.players[keeper.index()].pos = Vec2::new(30.0, 0.0);
        game.players[striker.index()].body.touched_at = game.tick as i32 - since;
        game.last_touch = Some(striker);
        (game.owner, game.play.chaser) = (None, [None, Some(keeper)]);
        game.ball = Ball {
            pos: Vec3::new(30.1, aside_m, 0.8),
            vel: Vec3::new(30.0, 0.0, 0.0),
            spin: Vec3::ZERO,
        };
        game.play.forecast =
            Forecast::of(&game.ball, &PitchSize::USUAL, &Conditions::USUAL, game.tick);
        past::off_body(game, &mut bench.events);
        assert_eq!(bench.game.last_touch == Some(keeper), comes_off, "{since} {aside_m}");
        assert_eq!(bench.game.ball.vel.x < 15.0, comes_off, "{}", bench.game.ball.vel);
    }
}

#[test]
fn an_agents_keeper_has_hands_unless_the_rule_takes_them() {
    for (rule, caught) in [(0.0, true), (1.0, false)] {
        let mut start = drawn(Layout::Eleven, 0);
        start.rules[Rule::GrfKeeper.index()] = rule;
        start.agents[0].fixed = Some(PlayerId(0));
        let mut bench = Bench::of(&start);
        bench.game.play.driven = 1;
        bench.game.players[0].pos = Vec2::new(-50.0, 0.0);
        bench.game.ball = Ball {
            pos: Vec3::new(-49.6, 0.0, 0.11),
            vel: Vec3::new(-1.0, 0.0, 0.0),
            spin: Vec3::ZERO,
        };
        bench.game.last_touch = Some(PlayerId(13));
        let took = (0..5).any(|_| {
            bench.step(Action::Idle);
            bench.game.play.hands.is_some()
        });
        assert_eq!(took, caught);
    }
}

#[test]
fn a_keeper_does_not_carry_a_caught_ball_over_the_line() {
    let mut bench = bench(&[], 0);
    bench.game.players[0].pos = Vec2::new(-55.6, 1.0);
    bench.game.ball.pos = Vec3::new(-55.0, 1.0, 1.0);
    keeper::take(&mut bench.game, &mut bench.events, PlayerId(0));
    for _ in 0..5 {
        bench.step(Action::BuiltinAi);
        assert!(bench.game.ball.pos.x > -55.1, "{}", bench.game.ball.pos);
        assert!(bench.seen(EventKind::OutOfPlay).is_none() && bench.game.score == [0, 0]);
    }
}

#[test]
fn a_kick_off_that_nobody_takes_is_given_up() {
    for (rule, taken) in [(1.0, true), (0.0, false)] {
        let mut bench = bench(&[(Rule::AntiStalling, rule), (Rule::Assist, 0.0)], 0);
        for player in &mut bench.game.players[..11] {
            player.ai = setpiece_scenario::Ai::Lazy;
        }
        place(
            &mut bench.game,
            Restart { mode: GameMode::KickOff, team: Team::Left, spot: Vec2::ZERO },
        );
        let touched = (0..60).any(|_| {
            bench.step(Action::Idle);
            bench.seen(EventKind::Touch).is_some()
        });
        assert_eq!(touched, taken);
    }
}

#[test]
fn a_kick_off_is_a_mode_until_it_is_taken() {
    let mut bench = bench(&[], 0);
    place(&mut bench.game, Restart { mode: GameMode::KickOff, team: Team::Left, spot: Vec2::ZERO });
    assert_eq!(bench.game.mode, GameMode::KickOff);
    for _ in 0..20 {
        bench.step(Action::BuiltinAi);
        let taken = bench.seen(EventKind::Touch).is_some();
        assert_eq!(bench.game.mode, if taken { GameMode::Normal } else { GameMode::KickOff });
        if taken {
            return;
        }
    }
    panic!("nobody kicked off");
}

#[test]
fn a_throw_in_flies_from_above_the_head() {
    let mut bench = bench(&[], 0);
    let spot = Vec2::new(-10.0, 36.0);
    place(&mut bench.game, Restart { mode: GameMode::ThrowIn, team: Team::Left, spot });
    assert!(bench.game.ball.pos.z > 1.5);
    let taker = bench.game.owner;
    let mut lowest = f32::MAX;
    for _ in 0..12 {
        bench.step(Action::BuiltinAi);
        let headed = bench.seen(EventKind::Header).and_then(|event| event.by);
        assert!(headed.is_none() || headed != taker, "a throw is no header");
        if bench.game.mode == GameMode::Normal {
            let way = bench.game.ball.pos.truncate().distance(spot);
            if (1.0..4.0).contains(&way) {
                lowest = lowest.min(bench.game.ball.pos.z);
                break;
            }
        }
    }
    assert!(lowest > 1.0 && lowest < 4.0, "{lowest}");
    assert!(bench.game.possession == Some(Team::Left));
}

#[test]
fn nobody_walks_through_a_man_on_the_ground() {
    let mut bench = bench(&[], 0);
    let game = &mut bench.game;
    game.agents[0].player = Some(PlayerId(9));
    game.agents[0].fixed = true;
    game.players[9].pos = Vec2::new(-8.0, 20.0);
    game.players[9].vel = Vec2::ZERO;
    let mut least = f32::MAX;
    for _ in 0..25 {
        bench.game.players[14].pos = Vec2::new(-3.0, 20.1);
        bench.game.players[14].body.strike_pose(Pose::Down, 40);
        bench.step(Action::Right);
        least = least.min(bench.game.players[9].pos.distance(bench.game.players[14].pos));
    }
    assert!(
        bench.game.players[9].pos.x > -2.0,
        "the runner came past: {}",
        bench.game.players[9].pos
    );
    assert!(least > 0.4, "the runner went through: {least} m");
}

#[test]
fn the_last_man_of_a_team_is_shown_no_red_card() {
    let mut bench = bench(&[], 0);
    for player in &mut bench.game.players[1..11] {
        player.active = false;
    }
    foul::call(&mut bench.game, &mut bench.events, PlayerId(0), PlayerId(15), 2.0);
    assert!(bench.seen(EventKind::Foul).is_some() && bench.seen(EventKind::RedCard).is_none());
    assert!(bench.game.players[0].active);
}

#[test]
fn without_a_seed_the_game_is_the_same_game() {
    let mut bench = bench(&[(Rule::Stochastic, 0.0)], 0);
    let (mut seen, mut wide) = ([0; 2], 0);
    for _ in 0..24_000 {
        bench.step(Action::BuiltinAi);
        for event in bench.events.as_slice() {
            let kinds = [EventKind::Tackle, EventKind::Save];
            wide += u32::from(
                event.kind == EventKind::Shot && event.qualifier == Some(Qualifier::OffTarget),
            );
            if let Some(i) = kinds.iter().position(|kind| *kind == event.kind) {
                seen[i] += 1;
            }
        }
        bench.restart();
    }
    assert!(seen[0] > 5 && seen[1] > 0 && wide > 2, "{seen:?}, {wide} wide");
}

#[test]
fn who_begins_exhausted_stays_it() {
    let mut bench = bench(&[], 0);
    bench.game.players[9].fatigue = 1.0;
    bench.game.players[8].fatigue = 0.9899;
    for _ in 0..20 {
        bench.step(Action::BuiltinAi);
    }
    assert_eq!((bench.game.players[9].fatigue, bench.game.players[8].fatigue), (1.0, 0.99));
}

#[test]
fn a_keeper_who_holds_their_place_still_releases_the_ball() {
    let mut bench = bench(&[(Rule::SixSeconds, 0.0)], 0);
    bench.game.players[0].ai = setpiece_scenario::Ai::Hold;
    bench.game.ball.pos = bench.game.players[0].pos.extend(1.0);
    keeper::take(&mut bench.game, &mut bench.events, PlayerId(0));
    let released = (0..80).any(|_| {
        bench.step(Action::BuiltinAi);
        bench.game.play.hands.is_none()
    });
    assert!(released);
}

#[test]
fn a_kick_off_of_nobody_is_the_others() {
    let mut bench = bench(&[(Rule::AntiStalling, 0.0)], 0);
    for player in &mut bench.game.players[..11] {
        player.active = false;
    }
    place(&mut bench.game, Restart { mode: GameMode::KickOff, team: Team::Left, spot: Vec2::ZERO });
    assert_eq!(bench.game.play.kick_off, Some(Team::Right));
    let taken = (0..60).any(|_| {
        bench.step(Action::BuiltinAi);
        bench.seen(EventKind::Touch).is_some()
    });
    assert!(taken);
}

#[test]
fn an_agents_penalty_goes_to_the_side_that_is_held() {
    for (hold, side) in [(Action::TopRight, -1.0), (Action::BottomRight, 1.0), (Action::Top, -1.0)]
    {
        let (mut wide, mut meant) = (0, 0);
        for seed in 0..20 {
            let mut bench = bench(&[], seed);
            let spot = Vec2::new(44.0, 0.0);
            place(&mut bench.game, Restart { mode: GameMode::Penalty, team: Team::Left, spot });
            let taker = bench.game.owner.unwrap();
            bench.game.agents[0].player = Some(taker);
            bench.step(hold);
            bench.step(Action::Shot);
            for _ in 0..8 {
                bench.step(Action::Idle);
                if bench.seen(EventKind::Shot).is_some() {
                    break;
                }
            }
            let way = bench.game.ball.vel;
            meant += u32::from(way.y * side > 0.0);
            wide += u32::from((way.y / way.x * 11.0).abs() > 3.7);
        }
        assert!(meant >= 18 && wide <= 3, "{hold:?}: {meant} to that side, {wide} wide");
    }
}

#[test]
fn everybody_keeps_off_a_penalty() {
    for seed in 0..6 {
        let mut bench = bench(&[], seed);
        for _ in 0..(seed * 40) {
            bench.step(Action::BuiltinAi);
            bench.restart();
        }
        let spot = Vec2::new(-44.0, 0.0);
        place(&mut bench.game, Restart { mode: GameMode::Penalty, team: Team::Right, spot });
        let taker = bench.game.owner.unwrap();
        for (i, player) in bench.game.players.iter().enumerate() {
            let away = player.pos.distance(spot);
            let may = i == taker.index() || player.role == Role::GK;
            assert!(may || away > 9.15, "{i} stands {away} m away");
        }
    }
}

#[test]
fn an_agent_whose_player_was_sent_off_leads_nobody() {
    let played = |action: Action| {
        let mut bench = bench(&[], 0);
        bench.game.agents[0].player = Some(PlayerId(9));
        bench.game.agents[0].fixed = true;
        bench.game.players[9].active = false;
        for _ in 0..300 {
            bench.step(action);
            bench.restart();
        }
        format!("{:?} {:?}", bench.game.ball, bench.game.score)
    };
    assert_eq!(played(Action::Idle), played(Action::BuiltinAi));
}

#[test]
fn a_parry_goes_back_into_play() {
    let (mut parries, mut own_goals) = (0, 0);
    for seed in 0..600 {
        let mut bench = bench(&[], seed);
        for player in &mut bench.game.players {
            player.pos = Vec2::new(-10.0, 30.0);
        }
        bench.game.players[11].pos = Vec2::new(54.0, 0.0);
        let who = PlayerId(2);
        bench.game.players[who.index()].pos = Vec2::new(34.0, 0.0);
        let aside = (seed % 7) as f32 - 3.0;
        bench.game.ball = Ball {
            pos: Vec3::new(35.0, 0.0, 0.5),
            vel: Vec3::new(24.0, 1.15 * aside, 3.0),
            spin: Vec3::ZERO,
        };
        contact::note(&mut bench.game, who, contact::Touch::Played);
        let mut parried = false;
        for _ in 0..25 {
            bench.step(Action::BuiltinAi);
            parried |= bench.seen(EventKind::Parry).is_some();
            if bench.game.dead {
                break;
            }
        }
        parries += u32::from(parried);
        own_goals += u32::from(parried && bench.seen(EventKind::OwnGoal).is_some());
    }
    assert!(parries > 8, "{parries} parries");
    assert!(own_goals * 50 < parries, "{own_goals} own goals of {parries} parries");
}
