//! What gravity, the wind, the air and the ground do to a ball, measured.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

use glam::{Vec2, Vec3};
use setpiece_engine::physics::constants::BALL_RADIUS;
use setpiece_engine::physics::{Ball, Conditions, Scratch, advance_ball, flight, predict::places};
use setpiece_scenario::PitchSize;
use setpiece_scenario::vocabulary::WorldFigure as Figure;

/// A ball's way until it lies still or a minute is over, a place per tick.
fn way(from: Vec3, vel: Vec3, spin: Vec3, changes: &[(Figure, f64)]) -> Vec<Vec3> {
    let conditions = Conditions::with(changes.iter().copied());
    let mut ball = Ball { pos: from, vel, spin };
    let mut scratch = Scratch::default();
    let mut way = Vec::new();
    while !flight::lies_still(&ball) && way.len() < 6000 {
        advance_ball(&mut ball, &PitchSize::USUAL, &conditions, false, &mut scratch);
        way.push(ball.pos);
    }
    way
}

const SPOT: Vec3 = Vec3::new(0.0, 0.0, BALL_RADIUS);

/// Where a ball that is kicked from the centre spot comes to rest, metres.
fn rest(vel: Vec3, changes: &[(Figure, f64)]) -> Vec2 {
    let way = way(SPOT, vel, Vec3::ZERO, changes);
    assert!(way.len() < 6000, "{changes:?}: the ball rolls for a minute");
    way.last().unwrap().truncate()
}

/// Where a lofted ball first comes down, and after how many ticks.
fn landing(vel: Vec3, spin: Vec3, changes: &[(Figure, f64)]) -> (Vec2, usize) {
    let way = way(SPOT, vel, spin, changes);
    let tick = way.iter().skip(1).position(|pos| pos.z <= BALL_RADIUS).unwrap() + 1;
    (way[tick].truncate(), tick)
}

const LOFTED: Vec3 = Vec3::new(18.0, 0.0, 12.0);

#[test]
fn a_ball_rolls_further_on_slippery_ground() {
    let roll = |friction| rest(Vec3::new(12.0, 0.0, 0.0), &[(Figure::Friction, friction)]).x;
    let (usual, slippery, tall) = (roll(1.0), roll(0.5), roll(2.0));
    assert!((14.0..16.0).contains(&usual), "{usual}");
    assert!(slippery > 1.5 * usual && tall < 0.65 * usual, "{slippery}, {usual}, {tall}");
}

#[test]
fn the_wind_carries_a_lofted_ball() {
    let calm = landing(LOFTED, Vec3::ZERO, &[]).0;
    assert!(calm.y.abs() < 1e-6);
    let across = landing(LOFTED, Vec3::ZERO, &[(Figure::WindY, 8.0)]).0;
    assert!((2.0..8.0).contains(&across.y), "{across}");
    let with = landing(LOFTED, Vec3::ZERO, &[(Figure::WindX, 8.0)]).0;
    let against = landing(LOFTED, Vec3::ZERO, &[(Figure::WindX, -8.0)]).0;
    assert!(with.x > calm.x + 3.0 && against.x < calm.x - 3.0, "{with}, {calm}, {against}");
    let other = landing(LOFTED, Vec3::ZERO, &[(Figure::WindY, -8.0)]).0;
    assert_eq!(across.y, -other.y, "the wind from the other side does the same");
}

#[test]
fn a_ball_on_the_ground_lies_in_the_lee() {
    let storm = [(Figure::WindX, 20.0)];
    let mut ball = Ball { pos: SPOT, vel: Vec3::ZERO, spin: Vec3::ZERO };
    let mut scratch = Scratch::default();
    for _ in 0..1000 {
        advance_ball(&mut ball, &PitchSize::USUAL, &Conditions::with(storm), false, &mut scratch);
    }
    assert_eq!(ball.pos, SPOT);
    let (calm, blown) = (rest(Vec3::X * 12.0, &[]), rest(Vec3::X * 12.0, &storm));
    assert_eq!(calm, blown);
}

#[test]
fn gravity_shortens_a_flight() {
    let ticks = |g| landing(LOFTED, Vec3::ZERO, &[(Figure::Gravity, g)]).1 as f32;
    let (moon, usual, heavy) = (ticks(1.62), ticks(9.81), ticks(20.0));
    assert!((200.0..260.0).contains(&usual), "{usual}");
    assert!((0.45..0.55).contains(&(heavy / usual)), "{heavy}, {usual}");
    assert!(moon > 4.0 * usual, "{moon}, {usual}");
}

#[test]
fn drag_swerve_and_spin_decay_shape_a_flight() {
    let far = |drag| landing(LOFTED, Vec3::ZERO, &[(Figure::Drag, drag)]).0.x;
    let vacuum = 18.0 * 24.0 / 9.81;
    assert!(far(0.2) < vacuum && far(0.2) > 0.87 * vacuum, "{} of {vacuum}", far(0.2));
    assert!(far(1.0) < 0.85 * vacuum && far(2.0) < 0.9 * far(1.0));
    let spin = Vec3::new(0.0, 0.0, 40.0);
    let aside = |figure, value| landing(LOFTED, spin, &[(figure, value)]).0.y;
    let usual = aside(Figure::Swerve, 1.0);
    assert!(usual > 3.0, "{usual}");
    assert_eq!(aside(Figure::Swerve, 0.0), 0.0);
    assert!(aside(Figure::Swerve, 2.0) > 1.6 * usual);
    assert!(aside(Figure::SpinDecay, 0.9) < 0.75 * usual);
}

#[test]
fn a_lively_ball_bounces_higher() {
    let second = |bounce| {
        let way =
            way(Vec3::new(0.0, 0.0, 3.0), Vec3::ZERO, Vec3::ZERO, &[(Figure::Bounce, bounce)]);
        let first = way.iter().position(|pos| pos.z <= BALL_RADIUS).unwrap();
        way[first..].iter().fold(0.0_f32, |top, pos| top.max(pos.z)) - BALL_RADIUS
    };
    let (dead, usual, lively) = (second(0.0), second(0.62), second(0.85));
    assert_eq!(dead, 0.0);
    assert!((0.85..1.15).contains(&usual), "{usual}");
    assert!((1.7..2.0).contains(&lively), "{lively}");
}

/// Every corner of the ranges, in calm air and in a gale along x.
fn extremes() -> Vec<Vec<(Figure, f64)>> {
    let mut all = vec![Vec::new()];
    for &figure in Figure::ALL.iter().filter(|figure| **figure != Figure::WindY) {
        let (low, high) = figure.range();
        let low = if figure == Figure::WindX { 0.0 } else { low };
        let with = |value: f64| {
            move |base: &Vec<(Figure, f64)>| [base.clone(), vec![(figure, value)]].concat()
        };
        let (lows, highs): (Vec<_>, Vec<_>) =
            (all.iter().map(with(low)).collect(), all.iter().map(with(high)).collect());
        all = [lows, highs].concat();
    }
    all
}

#[test]
fn a_ball_comes_to_rest_under_every_extreme_and_the_wind_carries_it_no_faster_than_itself() {
    for changes in extremes() {
        // A gale may keep a spinning ball in the air.
        let calm = !changes.iter().any(|(figure, wind)| *figure == Figure::WindX && *wind != 0.0);
        let conditions = Conditions::with(changes.iter().copied());
        let mut ball =
            Ball { pos: SPOT, vel: Vec3::new(6.0, 2.0, 4.0), spin: Vec3::new(10.0, -20.0, 30.0) };
        let mut scratch = Scratch::default();
        let mut ticks = 0;
        while !flight::lies_still(&ball) && (calm || ticks < 3000) {
            ball.pos.x = ball.pos.x.clamp(-50.0, 50.0);
            advance_ball(&mut ball, &PitchSize::USUAL, &conditions, false, &mut scratch);
            ticks += 1;
            assert!(ball.pos.is_finite() && ball.vel.length() < 60.0, "{changes:?}: {ball:?}");
            assert!(ticks < 20_000, "{changes:?}: {ball:?} never rests");
        }
    }
}

/// Where players expect a flying ball is where it flies.
#[test]
fn the_forecast_knows_the_world() {
    for changes in [
        vec![(Figure::WindY, 10.0), (Figure::WindX, -6.0)],
        vec![(Figure::Gravity, 4.0)],
        vec![(Figure::Gravity, 20.0), (Figure::Bounce, 0.8)],
        vec![(Figure::Friction, 0.3), (Figure::Drag, 2.5)],
        vec![(Figure::Friction, 3.0), (Figure::Drag, 0.2)],
    ] {
        let conditions = Conditions::with(changes.iter().copied());
        for vel in [Vec3::new(16.0, 3.0, 8.0), Vec3::new(14.0, 0.0, 0.0)] {
            let ball = Ball { pos: SPOT, vel, spin: Vec3::new(0.0, -10.0, 5.0) };
            let (mut flown, mut scratch) = (ball, Scratch::default());
            for (i, place) in places(&ball, &conditions, 5).take(20).enumerate() {
                for _ in 0..5 {
                    advance_ball(&mut flown, &PitchSize::USUAL, &conditions, false, &mut scratch);
                }
                let off = place.distance(flown.pos);
                assert!(off < 0.25, "{changes:?}, point {i}: {place}, flown {}", flown.pos);
            }
        }
    }
}

#[test]
fn figures_out_of_range_become_the_nearest_and_no_number_the_usual_one() {
    let with = |figure, value| Conditions::with([(figure, value)]).figures();
    assert_eq!(with(Figure::Gravity, -3.0)[Figure::Gravity.index()], 1.0);
    assert_eq!(with(Figure::Bounce, f64::INFINITY)[Figure::Bounce.index()], 0.95);
    assert_eq!(Conditions::with([(Figure::Friction, f64::NAN)]), Conditions::USUAL);
    let wind = Conditions::with([(Figure::WindX, 3.0), (Figure::WindY, -2.0)]);
    assert_eq!(wind.turned().turned(), wind);
    assert_ne!(wind.turned(), wind);
}
