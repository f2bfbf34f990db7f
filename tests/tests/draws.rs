//! Draws in regions are uniform by area, for every shape.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

use setpiece::engine::environment::{Environment, EnvironmentOptions, Scratch};
use setpiece::scenario::pitch::HALF_LENGTH_M;
use setpiece::scenario::vocabulary::{Role, Team};
use setpiece_tests::environment;
use std::collections::BTreeMap;

const DRAWS: u64 = 6000;

/// Ball places, metres, of many starts of a scenario whose ball lies in `region`.
fn balls(region: &str) -> Vec<(f64, f64)> {
    let text = format!(
        "scenario s {{ ball in {region}  team left {{ CM at (-50m, -30m) }}  end limit 1 step }}"
    );
    let loaded =
        setpiece::compile_text(&text, "<test>").unwrap_or_else(|error| panic!("{region}: {error}"));
    let mut environment = Environment::new(loaded.scenario, EnvironmentOptions::default()).unwrap();
    let place = |index| {
        environment.reset(Some(7), Some(index)).unwrap();
        let at = environment.state().ball.pos;
        (f64::from(at.x), f64::from(at.y))
    };
    (0..DRAWS).map(place).collect()
}

/// Compares the share of draws that meet a condition with the share of the area that does.
fn share(region: &str, expected: f64, meets: impl Fn(f64, f64) -> bool) {
    let places = balls(region);
    let found = places.iter().filter(|(x, y)| meets(*x, *y)).count() as f64 / DRAWS as f64;
    // Four standard deviations.
    let margin = 4.0 * (expected * (1.0 - expected) / DRAWS as f64).sqrt() + 1e-9;
    assert!(
        (found - expected).abs() <= margin,
        "{region}: {found} instead of {expected} ± {margin}"
    );
}

#[test]
fn an_l_shaped_polygon_is_filled_evenly() {
    // A square of 20 m without its upper right quarter.
    let l = "polygon((0m, 0m), (20m, 0m), (20m, 10m), (10m, 10m), (10m, 20m), (0m, 20m))";
    share(l, 1.0, |x, y| {
        (0.0..=20.0).contains(&x) && (0.0..=20.0).contains(&y) && (x <= 10.0 || y <= 10.0)
    });
    share(l, 1.0 / 3.0, |x, _| x > 10.0);
    share(l, 1.0 / 3.0, |x, y| x < 10.0 && y < 10.0);
}

#[test]
fn a_sector_is_filled_evenly() {
    let half = "sector((0m, 0m), 20m, 90deg, 270deg)";
    share(half, 1.0, |x, y| x <= 1e-4 && x.hypot(y) <= 20.001);
    share(half, 0.25, |x, y| x.hypot(y) < 10.0);
    share(half, 0.5, |_, y| y > 0.0);
    share("sector((0m, 0m), 20m, 0deg, 360deg)", 0.5, |x, _| x > 0.0);
}

#[test]
fn what_two_parts_of_a_union_share_is_not_drawn_more_often() {
    // Two rectangles of 10 m by 10 m that overlap by 5 m by 10 m: 150 m² in total.
    let union = "rect((0m, 0m), (10m, 10m)) | rect((5m, 0m), (15m, 10m))";
    share(union, 1.0, |x, y| (0.0..=15.0).contains(&x) && (0.0..=10.0).contains(&y));
    share(union, 1.0 / 3.0, |x, _| (5.0..10.0).contains(&x));
    share("rect((0m, 0m), (10m, 10m)) | rect((20m, 0m), (50m, 10m))", 0.25, |x, _| x < 10.0);
}

#[test]
fn differences_and_intersections_are_filled_evenly() {
    let ring = "circle(centre, 20m) - circle(centre, 10m)";
    share(ring, 1.0, |x, y| (9.999..=20.001).contains(&x.hypot(y)));
    share(ring, (225.0 - 100.0) / 300.0, |x, y| x.hypot(y) < 15.0);
    let corner = "right.half & flank.bottom";
    share(corner, 1.0, |x, y| x >= 0.0 && y >= 20.14);
    share(corner, 0.5, |x, _| x > 27.5);
    // The D: the part of the disc around the penalty spot outside the box.
    share("right.d", 1.0, |x, y| x <= 38.51 && (x - 44.0).hypot(y) <= 9.16);
}

#[test]
fn a_polygon_whose_corners_are_drawn_is_filled_all_the_same() {
    let text = "scenario s {
        let w = uniform(5m, 15m)
        ball in polygon((0m, -w), (20m, 0m), (0m, w))
        team left { CM at (-50m, -30m) }
        end limit 1 step
    }";
    let loaded = setpiece::compile_text(text, "<test>").unwrap();
    let mut environment = Environment::new(loaded.scenario, EnvironmentOptions::default()).unwrap();
    let mut near = 0;
    for index in 0..DRAWS {
        environment.reset(Some(3), Some(index)).unwrap();
        let at = environment.state().ball.pos;
        assert!(
            (0.0..=20.0).contains(&at.x) && at.y.abs() <= 15.0 * (1.0 - at.x / 20.0) + 1e-3,
            "{at}"
        );
        near += u32::from(at.x < 10.0);
    }
    // Three quarters of a triangle's area are in the half next to its base, however wide it is.
    let share = f64::from(near) / DRAWS as f64;
    assert!((share - 0.75).abs() < 0.023, "{share}");
}

#[test]
fn who_may_overlap_may_be_drawn_onto_another() {
    let text = |overlap: &str| {
        format!(
            "formation kicking {{ GK at (-1, 0)  CB at (-0.5, 0.1)  CB at (-0.5, 0.3) }}
            formation receiving {{ GK at (-1, 0)  CB at (-0.6, 0.1)  CB at (-0.6, 0.101) }}
            scenario close {{
                kickoff choice(left, right) {{ kicking: kicking, receiving: receiving }}
                team left {{ {overlap} }}
                team right {{ {overlap} }}
                end limit 10 steps
            }}"
        )
    };
    assert!(setpiece::compile_text(&text(""), "<test>").is_err());
    let loaded = setpiece::compile_text(&text("each all { overlap: allowed }"), "<test>").unwrap();
    let mut environment = Environment::new(loaded.scenario, EnvironmentOptions::default()).unwrap();
    environment.reset(Some(1), Some(0)).unwrap();
}

#[test]
fn a_drawn_region_is_filled_evenly() {
    let region = "choice(rect((0, 0), (0.5, 0.2)): 1, circle((-0.4, 0), 6m): 3)";
    share(region, 0.75, |x, _| x < 0.0);
    share(region, 0.125, |x, _| x > 0.25 * HALF_LENGTH_M);
    let region = "(if uniform(0, 1) < 25% then left.half & circle(centre, 9m) else right.six_yard)";
    share(region, 0.25, |x, _| x < 0.0);
}

#[test]
fn a_player_is_played_by_one_of_several_behaviours() {
    let text = "behavior up(way: angle) { do run(way) }
    scenario s {
        agents { left: 0 }
        ball at (0, 0.3)
        team left { CM at (-0.4, 0) { ai: choice(up(0deg): 1, hold: 1, run(180deg): 2) } }
        end limit 10 steps
    }";
    let mut environment = environment(text);
    let [mut forth, mut back] = [0.0; 2];
    for index in 0..600 {
        environment.reset(Some(7), Some(index)).unwrap();
        let from = environment.state().players[0].pos.x;
        for _ in 0..10 {
            environment.step(&[], &mut Scratch::default()).unwrap();
        }
        let way = environment.state().players[0].pos.x - from;
        forth += f64::from(u8::from(way > 2.0)) / 600.0;
        back += f64::from(u8::from(way < -2.0)) / 600.0;
    }
    assert!((forth - 0.25).abs() < 0.06, "{forth}");
    assert!((back - 0.5).abs() < 0.06, "{back}");
}

#[test]
fn formations_of_other_roles_share_the_places_of_a_team() {
    let text = "
    formation four { GK  LB  CB at (-0.6, 0.1)  CB at (-0.6, -0.1)  RB  CM  captain: CF }
    formation three {
        GK at (-0.9, 0)  3 CB in left.box  2 CM in left.half
        captain: AM at (0.2, 0) { fatigue: 0.5 }
    }
    scenario s {
        agents { left: all }
        ball at captain + (0.5m, 0m) { owner: captain }
        team left { formation: choice(four: 1, three: 3) }
        require min_gap(left) > 1m
        end limit 1 step
    }";
    let mut environment = environment(text);
    let mut threes = 0;
    for index in 0..600 {
        environment.reset(Some(7), Some(index)).unwrap();
        let game = environment.state();
        assert_eq!(game.agents.len(), 7);
        let players = || game.players.iter().filter(|player| player.active);
        let of = |role: Role| players().filter(|player| player.role == role).count();
        let captain = game.player(game.owner.unwrap());
        let roles = [Role::LB, Role::CB, Role::CM, Role::CF, Role::AM].map(of);
        match captain.role {
            Role::AM => {
                threes += 1;
                assert_eq!(roles, [0, 3, 2, 0, 1]);
                assert_eq!(captain.fatigue, 0.5);
            }
            _ => assert_eq!(roles, [1, 2, 1, 1, 0]),
        }
        assert_eq!(players().count(), 7);
    }
    assert!((400..500).contains(&threes), "{threes}");
}

#[test]
fn three_whole_formations_share_the_eleven_places() {
    // Together they have thirteen of the roles that no two of them need at once.
    let loaded = setpiece::load("../examples/drawn_formations.pitch").unwrap();
    let mut environment = Environment::new(loaded.scenario, EnvironmentOptions::default()).unwrap();
    let mut seen = BTreeMap::new();
    for index in 0..200 {
        environment.reset(Some(1), Some(index)).unwrap();
        let game = environment.state();
        for team in [Team::Left, Team::Right] {
            let players: Vec<_> = game.team(team).map(|(_, player)| player).collect();
            assert_eq!(players.len(), 11);
            let of = |role: Role| players.iter().filter(|player| player.role == role).count();
            let roles = [Role::GK, Role::LB, Role::CB, Role::DM, Role::CM, Role::CF].map(of);
            *seen.entry(roles).or_insert(0) += 1;
            // The role decides the place: a wide midfielder of three up front stands there.
            let wings = players.iter().filter(|player| player.role == Role::LM);
            let (side, far) = (if team == Team::Left { 1.0 } else { -1.0 }, roles[5] == 1);
            assert!(wings.into_iter().all(|wing| (wing.pos.x * side > 0.0) == far));
        }
    }
    let whole = [[1, 1, 2, 0, 2, 2], [1, 0, 3, 1, 2, 2], [1, 1, 2, 1, 2, 1]];
    assert_eq!(seen.len(), 3, "{seen:?}");
    assert!(whole.iter().all(|roles| seen.get(roles).is_some_and(|count| *count > 60)), "{seen:?}");
}

#[test]
fn players_take_part_as_often_as_the_text_says() {
    let text = "scenario s {
        let wide = uniform(0, 1) < 25%
        agents { left: all }
        ball at (0, 0) { owner: mate }
        team left {
            CM at (-0.4, 0)
            maybe 30% mate: CF at (0, 0)
            2..4 CB in left.box
            RM at (0, 0.3) when wide
        }
        team right { CB at (0.4, 0)  maybe 0% GK at (-1, 0)  LB at (0.4, 0.2) when not wide }
        require min_gap(left) > 2m
        require count(p in left) >= 3
        end limit 1 step
    }";
    let mut environment = environment(text);
    let (mut mates, mut wide, mut backs) = (0, 0, [0; 5]);
    for index in 0..DRAWS {
        environment.reset(Some(7), Some(index)).unwrap();
        let game = environment.state();
        let active: Vec<bool> = game.players.iter().map(|player| player.active).collect();
        assert_eq!(game.agents.len(), 7, "agents belong to everyone who may take part");
        assert_eq!(game.owner.is_some(), active[1], "who is absent has no ball");
        assert!(active[11] && !active[12]);
        assert_ne!(active[6], active[13]);
        mates += u32::from(active[1]);
        wide += u32::from(active[6]);
        backs[active[2..6].iter().filter(|active| **active).count()] += 1;
        let places: Vec<_> =
            (0..11).filter(|&id| active[id]).map(|id| game.players[id].pos).collect();
        for (nth, one) in places.iter().enumerate() {
            assert!(places[nth + 1..].iter().all(|other| one.distance(*other) > 2.0));
        }
    }
    let near = |found: u32, expected: f64| {
        let share = f64::from(found) / DRAWS as f64;
        assert!((share - expected).abs() < 0.04, "{share} instead of {expected}");
    };
    // Many players in one box are discarded more often, so the numbers are nearly equal.
    near(mates, 0.3);
    near(wide, 0.25);
    backs[2..=4].iter().for_each(|&n| near(n, 1.0 / 3.0));
    assert_eq!(backs[..2], [0, 0]);
}
