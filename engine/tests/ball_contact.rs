//! The ball against hard objects (woodwork, nets), and the fast mode against the full one.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

use glam::Vec3;
use setpiece_engine::physics::constants::{BALL_RADIUS, FRAME_RADIUS};
use setpiece_engine::physics::{self, Ball};
use setpiece_engine::physics::{Conditions, Contact, Scratch};
use setpiece_engine::random::{Purpose, Stream};
use setpiece_scenario::PitchSize;
use setpiece_scenario::vocabulary::{PitchFigure, Team};

/// A tick of the ball on the usual pitch, on a usual day.
fn advance_ball(
    ball: &mut Ball,
    conditions: &Conditions,
    full: bool,
    scratch: &mut Scratch,
) -> Option<Contact> {
    physics::advance_ball(ball, &PitchSize::USUAL, conditions, full, scratch)
}

fn crossed_goal_line(before: Vec3, after: Vec3) -> Option<Team> {
    physics::crossed_goal_line(&PitchSize::USUAL, before, after)
}

/// A draw from the test's own stream.
struct Draw(Stream);

impl Draw {
    fn new(seed: u64) -> Draw {
        Draw(Stream::new(seed, 0, Purpose::Draw))
    }

    fn within(&mut self, low: f32, high: f32) -> f32 {
        self.0.range(low, high)
    }

    fn point(&mut self, low: [f32; 3], high: [f32; 3]) -> Vec3 {
        Vec3::new(
            self.within(low[0], high[0]),
            self.within(low[1], high[1]),
            self.within(low[2], high[2]),
        )
    }

    fn sign(&mut self) -> f32 {
        if self.0.bits() & 1 == 0 { -1.0 } else { 1.0 }
    }
}

/// A ball from one point through another, against gravity.
fn aimed(from: Vec3, at: Vec3, speed: f32, spin: Vec3) -> Ball {
    let away = at - from;
    let flight_s = away.length() / speed;
    let vel = away.normalize() * speed + Vec3::Z * (0.5 * 9.81 * flight_s);
    Ball { pos: from, vel, spin }
}

/// Shots of every kind, from all over the pitch, at either goal.
fn shots(count: usize) -> Vec<Ball> {
    let mut draw = Draw::new(11);
    (0..count).map(|i| shot(i % 7, &mut draw)).collect()
}

fn shot(kind: usize, draw: &mut Draw) -> Ball {
    let side = draw.sign();
    let from = draw.point([20.0, -30.0, BALL_RADIUS], [52.0, 30.0, BALL_RADIUS]);
    let mouth = draw.point([55.0, -3.4, 0.2], [55.0, 3.4, 2.4]);
    let post_y = 3.7 * draw.sign();
    let speed = draw.within(14.0, 36.0);
    let ball = match kind {
        0 => Ball {
            pos: from,
            vel: (mouth - from).truncate().normalize().extend(0.0) * speed,
            spin: Vec3::ZERO,
        },
        1 => aimed(from, mouth, speed, Vec3::ZERO),
        2 => aimed(from, mouth, speed, draw.point([-20.0, -20.0, -60.0], [20.0, 20.0, 60.0])),
        3 => aimed(
            from,
            Vec3::new(55.0, post_y + draw.within(-0.2, 0.2), mouth.z),
            speed,
            Vec3::ZERO,
        ),
        4 => aimed(from, Vec3::new(55.0, mouth.y, 2.5 + draw.within(-0.2, 0.2)), speed, Vec3::ZERO),
        5 => {
            // Nets from outside: from behind the goal line.
            let behind = draw.point([55.5, -20.0, BALL_RADIUS], [59.5, 20.0, BALL_RADIUS]);
            aimed(behind, draw.point([55.2, -3.7, 0.2], [57.5, 3.7, 2.4]), speed, Vec3::ZERO)
        }
        _ => {
            let anywhere = draw.point([-52.0, -34.0, BALL_RADIUS], [52.0, 34.0, 2.0]);
            Ball {
                pos: anywhere,
                vel: draw.point([-30.0, -30.0, -5.0], [30.0, 30.0, 15.0]),
                spin: Vec3::ZERO,
            }
        }
    };
    let turn = |v: Vec3| Vec3::new(v.x * side, v.y * side, v.z);
    Ball { pos: turn(ball.pos), vel: turn(ball.vel), spin: turn(ball.spin) }
}

#[test]
fn the_fast_mode_agrees_with_the_full_one_over_2400_shots() {
    let (mut gated, mut full) = (Scratch::default(), Scratch::default());
    let (mut met, mut goals, mut different, mut grazes) = (0, 0, 0, 0);
    let shots = shots(2400);
    for (i, start) in shots.iter().enumerate() {
        let (mut fast, mut exact) = (*start, *start);
        let (mut fast_goal, mut exact_goal) = (None, None);
        let mut free = true;
        for tick in 0..250 {
            let before = (fast.pos, exact.pos);
            let one = advance_ball(&mut fast, &Conditions::USUAL, false, &mut gated);
            let other = advance_ball(&mut exact, &Conditions::USUAL, true, &mut full);
            assert!(
                fast.pos.is_finite() && fast.vel.is_finite() && fast.spin.is_finite(),
                "{fast:?}"
            );
            fast_goal = fast_goal.or(crossed_goal_line(before.0, fast.pos));
            exact_goal = exact_goal.or(crossed_goal_line(before.1, exact.pos));
            if free && (one.is_some() || other.is_some()) {
                // Only one of two balls that lie centimetres apart may touch the edge of the net.
                grazes += usize::from(one != other);
                met += 1;
                free = false;
            }
            if free {
                assert!(
                    (fast.pos - exact.pos).length() < 0.10,
                    "shot {i}, tick {tick}: {fast:?} {exact:?}"
                );
                assert!(
                    (fast.vel - exact.vel).length() < 0.3,
                    "shot {i}, tick {tick}: {fast:?} {exact:?}"
                );
            }
            if fast.vel == Vec3::ZERO && exact.vel == Vec3::ZERO || fast.pos.x.abs() > 70.0 {
                break;
            }
        }
        goals += usize::from(fast_goal.is_some());
        different += usize::from(fast_goal != exact_goal);
    }
    println!("{met} met something, {goals} goals, {different} different verdicts");
    assert!(
        met > 1000 && goals > 400,
        "the shots must test something: {met} met something, {goals} goals"
    );
    assert!(grazes <= 2, "{grazes} first contacts differ");
    assert!(different * 100 <= shots.len(), "{different} of {} verdicts differ", shots.len());
}

#[test]
fn what_a_scratch_did_before_leaves_no_trace() {
    let shots = shots(64);
    let mut shared = Scratch::default();
    let mut together: Vec<Ball> = shots.clone();
    for _ in 0..200 {
        for ball in &mut together {
            advance_ball(ball, &Conditions::USUAL, true, &mut shared);
        }
    }
    for (i, (start, interleaved)) in shots.iter().zip(&together).enumerate() {
        let mut alone = *start;
        let mut fresh = Scratch::default();
        for _ in 0..200 {
            advance_ball(&mut alone, &Conditions::USUAL, true, &mut fresh);
        }
        assert_eq!(alone, *interleaved, "shot {i}");
    }
}

#[test]
fn both_goals_are_alike_to_the_bit() {
    let mut scratch = Scratch::default();
    for start in shots(200) {
        let turn = |v: Vec3| Vec3::new(-v.x, -v.y, v.z);
        let mut one = start;
        let mut other = Ball { pos: turn(start.pos), vel: turn(start.vel), spin: turn(start.spin) };
        for _ in 0..200 {
            let touched = advance_ball(&mut one, &Conditions::USUAL, false, &mut scratch);
            assert_eq!(touched, advance_ball(&mut other, &Conditions::USUAL, false, &mut scratch));
            assert_eq!((one.pos, one.vel), (turn(other.pos), turn(other.vel)));
        }
    }
}

#[test]
fn woodwork_gives_back_four_fifths_of_the_speed() {
    let mut scratch = Scratch::default();
    for speed in [8.0f32, 15.0, 25.0, 35.0, 45.0] {
        for (what, at) in [("post", Vec3::new(55.0, 3.7, 1.2)), ("bar", Vec3::new(55.0, 1.0, 2.5))]
        {
            let from = at - Vec3::X * 0.4;
            let mut ball = Ball { pos: from, vel: Vec3::X * speed, spin: Vec3::ZERO };
            let mut touched = None;
            for _ in 0..40 {
                touched =
                    touched.or(advance_ball(&mut ball, &Conditions::USUAL, false, &mut scratch));
                if ball.vel.x < 0.0 {
                    break;
                }
            }
            assert_eq!(touched, Some(Contact::Woodwork), "{what} at {speed}");
            let share = ball.vel.length() / speed;
            assert!((0.70..0.85).contains(&share), "{what} at {speed}: share {share}");
            assert!(ball.pos.x < 55.0 - FRAME_RADIUS, "{what} at {speed}: thrown back");
        }
    }
}

/// Whether the ball's centre is inside the net.
fn inside(pos: Vec3) -> bool {
    pos.x.abs() > 55.0 && pos.x.abs() < 57.55 && pos.y.abs() < 3.7 && pos.z < 2.5
}

#[test]
fn a_ball_in_the_net_stays_there_at_any_speed() {
    let mut draw = Draw::new(3);
    let mut scratch = Scratch::default();
    for i in 0..1500 {
        let from = draw.point([40.0, -3.0, 0.11], [54.8, 3.0, 2.2]);
        let at = draw.point([57.5, -3.5, 0.2], [57.5, 3.5, 2.3]);
        let vel = (at - from).normalize() * draw.within(20.0, 45.0);
        let mut ball = Ball { pos: from, vel, spin: draw.point([-50.0; 3], [50.0; 3]) };
        let mut was_in = false;
        for _ in 0..250 {
            advance_ball(&mut ball, &Conditions::USUAL, false, &mut scratch);
            was_in = ball.pos.x > 55.0 && (was_in || inside(ball.pos));
            let out_through_net = was_in && !inside(ball.pos);
            assert!(!out_through_net, "ball {i} left through the net: {ball:?}");
        }
    }
}

#[test]
fn a_ball_from_behind_never_gets_into_the_goal() {
    let mut draw = Draw::new(4);
    let mut scratch = Scratch::default();
    for i in 0..1500 {
        let side = draw.sign();
        let from = match i % 3 {
            0 => draw.point([58.0, -6.0, 0.11], [60.0, 6.0, 3.0]),
            1 => draw.point([55.4, 4.2, 0.11], [58.0, 9.0, 3.0]),
            _ => draw.point([55.4, -3.5, 2.9], [57.0, 3.5, 6.0]),
        };
        let at = draw.point([55.6, -3.0, 0.2], [57.3, 3.0, 2.3]);
        let vel = (at - from).normalize() * draw.within(5.0, 45.0);
        let turn = |v: Vec3| Vec3::new(v.x * side, v.y * side, v.z);
        let mut ball = Ball { pos: turn(from), vel: turn(vel), spin: Vec3::ZERO };
        for _ in 0..300 {
            advance_ball(&mut ball, &Conditions::USUAL, false, &mut scratch);
            if ball.pos.x.abs() < 55.0 {
                break;
            }
            assert!(!inside(ball.pos), "ball {i} came in through the net: {ball:?}");
        }
    }
}

#[test]
fn a_thousand_balls_left_at_net_and_posts_lie_still_for_a_minute() {
    let mut draw = Draw::new(5);
    let mut scratch = Scratch::default();
    let mut at_hard_parts = 0;
    for i in 0..1000 {
        let side = draw.sign();
        let from = match i % 4 {
            0 => draw.point([55.3, -3.4, 0.11], [57.3, 3.4, 2.2]),
            1 => draw.point([54.5, 3.3, 0.11], [55.6, 4.1, 2.9]),
            2 => draw.point([57.7, -4.2, 0.11], [58.2, 4.2, 2.4]),
            _ => draw.point([54.9, -3.6, 2.7], [57.6, 3.6, 3.2]),
        };
        let vel = draw.point([-2.0, -2.0, -3.0], [3.0, 2.0, 1.0]);
        let turn = |v: Vec3| Vec3::new(v.x * side, v.y * side, v.z);
        let mut ball = Ball { pos: turn(from), vel: turn(vel), spin: Vec3::ZERO };
        let mut ticks = 0;
        while ball.vel != Vec3::ZERO {
            let start = ball;
            advance_ball(&mut ball, &Conditions::USUAL, false, &mut scratch);
            ticks += 1;
            assert!(
                ball.pos.is_finite() && ball.vel.is_finite(),
                "ball {i}: {start:?} -> {ball:?}"
            );
            assert!(ticks < 2000, "ball {i} from {from} with {vel} finds no rest: {ball:?}");
        }
        let rest = ball.pos;
        at_hard_parts +=
            usize::from(rest.x.abs() > 54.8 && rest.x.abs() < 57.8 && rest.y.abs() < 4.0);
        for _ in 0..6000 {
            advance_ball(&mut ball, &Conditions::USUAL, false, &mut scratch);
            assert!(
                (ball.pos - rest).length() < 0.01,
                "ball {i} crept from {rest} to {}",
                ball.pos
            );
        }
    }
    assert!(at_hard_parts > 400, "{at_hard_parts} rested at the goal");
}

#[test]
fn hard_things_add_no_energy() {
    let mut draw = Draw::new(6);
    let mut scratch = Scratch::default();
    for i in 0..600 {
        let mut ball = shot(i % 6, &mut draw);
        for tick in 0..200 {
            let motion = |b: &Ball| 9.81 * b.pos.z + 0.5 * b.vel.length_squared();
            let turning = BALL_RADIUS * BALL_RADIUS / 3.0 * ball.spin.length_squared();
            let before = motion(&ball) + turning;
            let touched = advance_ball(&mut ball, &Conditions::USUAL, false, &mut scratch);
            // Grass may turn a ball faster than its braking could.
            let after = motion(&ball);
            // Pushed out of an overlap of millimetres, the ball may gain that much height.
            assert!(
                after <= before * 1.001 + 0.1,
                "shot {i}, tick {tick}, {touched:?}: {before} -> {after}"
            );
        }
    }
}

#[test]
fn a_scratch_can_go_to_another_worker() {
    fn assert_send<T: Send>() {}
    assert_send::<Scratch>();
}

#[test]
fn goals_of_another_pitch_stand_on_its_lines_and_have_its_size() {
    let short = PitchSize::with([(PitchFigure::Length, 60.0)]);
    let small = PitchSize::with([
        (PitchFigure::Length, 60.0),
        (PitchFigure::Goal, 4.0),
        (PitchFigure::GoalHeight, 2.0),
    ]);
    let mut draw = Draw::new(11);
    let (mut usual, mut other) = (Scratch::default(), Scratch::default());
    let mut woodwork = [0; 2];
    for shot in 0..300 {
        let from = draw.point([45.0, -6.0, 0.2], [52.0, 6.0, 2.0]);
        let at = draw.point([55.0, -4.2, 0.1], [55.0, 4.2, 2.8]);
        let vel = (at - from).normalize() * 25.0;
        let ball = Ball { pos: from, vel, spin: Vec3::ZERO };
        let (mut far, mut near) = (ball, Ball { pos: from - Vec3::X * 25.0, ..ball });
        let mut little = near;
        for _ in 0..60 {
            let met = advance_ball(&mut far, &Conditions::USUAL, false, &mut usual);
            let conditions = &Conditions::USUAL;
            let moved = physics::advance_ball(&mut near, &short, conditions, false, &mut other);
            assert_eq!(met, moved, "shot {shot}: the same goal, 25 m nearer");
            assert!(far.pos.distance(near.pos + Vec3::X * 25.0) < 0.01, "shot {shot}");
            woodwork[0] += u32::from(met == Some(Contact::Woodwork));
        }
        for _ in 0..60 {
            let before = little.pos;
            let conditions = &Conditions::USUAL;
            let met = physics::advance_ball(&mut little, &small, conditions, false, &mut other);
            woodwork[1] += u32::from(met == Some(Contact::Woodwork));
            if let Some(team) = physics::crossed_goal_line(&small, before, little.pos) {
                assert_eq!(team, Team::Right);
                assert!(little.pos.y.abs() < 2.0 && little.pos.z < 2.0, "shot {shot}");
            }
        }
    }
    assert!(woodwork.iter().all(|hits| *hits > 10), "{woodwork:?}");
}
