//! What a picture costs, in thread CPU time: both cameras at the sizes for people and for agents,
//! 22 players.
#![allow(missing_docs, reason = "criterion's macros write the entry point")]
#![allow(clippy::expect_used, reason = "a benchmark may stop")]

#[path = "../../setpiece/benches/measure/cpu.rs"]
mod cpu;
#[path = "../tests/samples/scenes.rs"]
mod scenes;

use cpu::CpuTime;
use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use setpiece_render::{Camera, Options, PitchRegion, PixelObserver, Pixels, Renderer};
use std::hint::black_box;

fn frames(c: &mut Criterion<CpuTime>) {
    let mut group = c.benchmark_group("frames");
    group.throughput(Throughput::Elements(1));
    let all = scenes::all();
    for (width, height) in [(1280, 720), (640, 360), (96, 72)] {
        for (name, camera) in
            [("broadcast", Camera::Broadcast), ("above", Camera::Above(PitchRegion::Whole))]
        {
            let options = Options { camera, ..Options::default() };
            let mut renderer =
                Renderer::new(width, height, options).expect("the size can be drawn");
            let mut rgba = vec![0; width * height * 4];
            let mut turn = 0;
            group.bench_function(format!("{name} {width}x{height}"), |b| {
                b.iter(|| {
                    turn += 1;
                    renderer
                        .render(black_box(&all[turn % all.len()].1), &mut rgba)
                        .expect("the buffer fits");
                });
            });
        }
    }
    let mut observer =
        PixelObserver::new(Pixels::SMALL_GRAY, Options::default()).expect("the size can be drawn");
    let mut out = vec![0; Pixels::SMALL_GRAY.len()];
    group.bench_function("observation 96x72 gray", |b| {
        b.iter(|| observer.observe(black_box(&all[2].1), &mut out).expect("the buffer fits"));
    });
    group.finish();
}

criterion_group! {
    name = benches;
    config = Criterion::default().with_measurement(CpuTime);
    targets = frames
}
criterion_main!(benches);
