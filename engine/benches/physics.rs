//! What a tick of the ball costs: free, at the goal, and with rapier on every tick.
//!
//! Times are thread CPU time, so that other load on the machine matters little.
#![allow(missing_docs, reason = "criterion's macros write the entry point")]

#[path = "../../setpiece/benches/measure/cpu.rs"]
mod cpu;

use cpu::CpuTime;
use criterion::{BenchmarkGroup, Criterion, SamplingMode, criterion_group, criterion_main};
use glam::Vec3;
use setpiece_engine::physics::{Ball, Conditions, Scratch, advance_ball, predict::places};
use setpiece_scenario::PitchSize;
use std::hint::black_box;
use std::time::Duration;

const FLYING: Ball = Ball {
    pos: Vec3::new(0.0, 0.0, 1.0),
    vel: Vec3::new(20.0, 3.0, 4.0),
    spin: Vec3::new(2.0, -15.0, 8.0),
};
const ROLLING: Ball =
    Ball { pos: Vec3::new(0.0, 0.0, 0.11), vel: Vec3::new(12.0, 3.0, 0.0), spin: Vec3::ZERO };
const AT_POST: Ball =
    Ball { pos: Vec3::new(54.8, 3.7, 1.0), vel: Vec3::new(25.0, 0.0, 0.0), spin: Vec3::ZERO };
const IN_MOUTH: Ball =
    Ball { pos: Vec3::new(55.5, 0.0, 1.0), vel: Vec3::new(25.0, 0.0, 0.0), spin: Vec3::ZERO };

fn one_tick(c: &mut BenchmarkGroup<'_, CpuTime>, name: &str, ball: Ball, full: bool) {
    let mut scratch = Scratch::default();
    c.bench_function(name, |b| {
        b.iter(|| {
            let mut moved = black_box(ball);
            black_box(advance_ball(
                &mut moved,
                &PitchSize::USUAL,
                &Conditions::USUAL,
                full,
                &mut scratch,
            ));
            moved
        });
    });
}

fn ticks(c: &mut Criterion<CpuTime>) {
    let mut group = c.benchmark_group("ball");
    group.sampling_mode(SamplingMode::Flat);
    let c = &mut group;
    one_tick(c, "tick/gated/flying", FLYING, false);
    one_tick(c, "tick/gated/rolling", ROLLING, false);
    one_tick(c, "tick/gated/in_the_goal_mouth", IN_MOUTH, false);
    one_tick(c, "tick/gated/at_the_post", AT_POST, false);
    one_tick(c, "tick/full/flying", FLYING, true);
    c.bench_function("forecast/300_ticks", |b| {
        b.iter(|| places(black_box(&FLYING), &Conditions::USUAL, 10).take(30).last());
    });
}

criterion_group! {
    name = benches;
    config = Criterion::default().with_measurement(CpuTime).sample_size(20)
        .warm_up_time(Duration::from_millis(300)).measurement_time(Duration::from_secs(3));
    targets = ticks
}
criterion_main!(benches);
