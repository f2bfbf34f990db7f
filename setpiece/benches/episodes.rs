//! Steps per CPU-second, and resets.
//!
//! Times are the thread's CPU time, so that other load on the machine matters little. The bot plays
//! the steps on one core, and the simple115v2 observation of every step is written, as for an
//! agent. Throughput is steps per CPU-second.
#![allow(
    missing_docs,
    clippy::panic,
    reason = "criterion's macros write undocumented functions; a benchmark fails by panicking"
)]

#[path = "measure/cpu.rs"]
mod cpu;

use cpu::CpuTime;
use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use setpiece::engine::environment::{Environment, EnvironmentOptions, Physics, Scratch};
use setpiece::engine::observe;
use setpiece::scenario::Action;
use std::hint::black_box;
use std::time::Duration;

/// Steps of one sample.
const STEPS: u64 = 1000;

fn environment(name: &str, physics: Physics) -> Environment {
    let loaded = setpiece::load(name).unwrap_or_else(|error| panic!("{error}"));
    let options = EnvironmentOptions { physics: Some(physics), ..EnvironmentOptions::default() };
    Environment::new(loaded.scenario, options).unwrap_or_else(|error| panic!("{error}"))
}

fn steps(c: &mut Criterion<CpuTime>) {
    let mut group = c.benchmark_group("steps");
    group.throughput(Throughput::Elements(STEPS));
    let cases = [
        ("11_vs_11_stochastic", Physics::Gated, "gated"),
        ("academy_3_vs_1_with_keeper", Physics::Gated, "gated"),
        ("11_vs_11_stochastic", Physics::Full, "full"),
    ];
    for (name, physics, label) in cases {
        let mut environment = environment(name, physics);
        let mut scratch = Scratch::default();
        let mut floats = vec![0.0; observe::layout::SIMPLE115];
        let mut seed = 0;
        group.bench_function(format!("{name}/{label}"), |b| {
            b.iter(|| {
                for _ in 0..STEPS {
                    if !environment.is_running() {
                        seed += 1;
                        environment
                            .reset(Some(seed), None)
                            .unwrap_or_else(|error| panic!("{error}"));
                    }
                    environment
                        .step(&[Action::BuiltinAi], &mut scratch)
                        .unwrap_or_else(|error| panic!("{error}"));
                    observe::simple115(environment.state(), 0, &mut floats)
                        .unwrap_or_else(|error| panic!("{error}"));
                    black_box(&floats);
                }
            });
        });
    }
    group.finish();
}

fn resets(c: &mut Criterion<CpuTime>) {
    let mut group = c.benchmark_group("reset");
    for name in ["11_vs_11_stochastic", "academy_3_vs_1_with_keeper"] {
        let mut environment = environment(name, Physics::Gated);
        let mut seed = 0;
        group.bench_function(name, |b| {
            b.iter(|| {
                seed += 1;
                black_box(environment.reset(Some(seed), None))
                    .unwrap_or_else(|error| panic!("{error}"));
            });
        });
    }
    group.finish();
}

criterion_group! {
    name = all;
    config = Criterion::default()
        .with_measurement(CpuTime)
        .sample_size(20)
        .warm_up_time(Duration::from_secs(1))
        .measurement_time(Duration::from_secs(3));
    targets = steps, resets
}
criterion_main!(all);
