//! Writes pictures of the sample scenes, and prints what a picture costs.
//!
//! `cargo run --release -p setpiece-render --example frames -- [FOLDER | --cost] [WIDTH HEIGHT]`
#![allow(clippy::print_stdout, reason = "a command prints")]

#[path = "../tests/samples/scenes.rs"]
mod scenes;

use cpu_time::ThreadTime;
use setpiece_render::{Camera, Options, Overlays, PitchRegion, Renderer, Scene};
use std::error::Error;
use std::fs::File;
use std::io::BufWriter;
use std::path::Path;

fn main() -> Result<(), Box<dyn Error>> {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let side =
        |at: usize, usual: usize| words.get(at).and_then(|word| word.parse().ok()).unwrap_or(usual);
    match words.first().map(String::as_str) {
        None => [(1280, 720), (640, 360), (96, 72), (84, 84)]
            .iter()
            .try_for_each(|(width, height)| cost(*width, *height)),
        Some("--cost") => cost(side(1, 1280), side(2, 720)),
        Some(folder) => pictures(Path::new(folder), side(1, 1280), side(2, 720)),
    }
}

fn pictures(folder: &Path, width: usize, height: usize) -> Result<(), Box<dyn Error>> {
    std::fs::create_dir_all(folder)?;
    for (name, scene) in scenes::all() {
        for (camera, view) in
            [("broadcast", Camera::Broadcast), ("above", Camera::Above(PitchRegion::Whole))]
        {
            let overlays = Overlays { terms: true, ..Overlays::default() };
            let mut renderer = Renderer::new(width, height, Options { camera: view, overlays })?;
            let mut rgba = vec![0; width * height * 4];
            let before = trail(&scene);
            renderer.render_after(&before, &scene, &mut rgba)?;
            let file = BufWriter::new(File::create(folder.join(format!("{camera}-{name}.png")))?);
            let mut encoder = png::Encoder::new(file, width as u32, height as u32);
            encoder.set_color(png::ColorType::Rgba);
            encoder.write_header()?.write_image_data(&rgba)?;
        }
    }
    Ok(())
}

/// Scenes that lead to one, everyone straight on.
fn trail(scene: &Scene) -> Vec<Scene> {
    let back = |steps: u32| {
        let mut then = scene.clone();
        let seconds = steps as f32 * 0.1;
        for player in &mut then.players {
            player.pos =
                [player.pos[0] - player.vel[0] * seconds, player.pos[1] - player.vel[1] * seconds];
        }
        for axis in 0..2 {
            then.ball.pos[axis] -= then.ball.vel[axis] * seconds;
        }
        then
    };
    (1..=10).rev().map(back).collect()
}

/// Prints the least time of five runs, each long enough for the clock.
fn cost(width: usize, height: usize) -> Result<(), Box<dyn Error>> {
    let count = (60_000_000 / (width * height)).clamp(8, 8000);
    for (name, camera) in
        [("broadcast", Camera::Broadcast), ("above", Camera::Above(PitchRegion::Whole))]
    {
        let mut renderer = Renderer::new(width, height, Options { camera, ..Options::default() })?;
        let mut rgba = vec![0; width * height * 4];
        let all = scenes::all();
        let mut best = f64::MAX;
        for _ in 0..5 {
            let start = ThreadTime::now();
            for turn in 0..count {
                renderer.render(&all[turn % all.len()].1, &mut rgba)?;
            }
            best = best.min(start.elapsed().as_secs_f64() / count as f64);
        }
        println!("{width}x{height} {name}: {:.0} frames/s, {:.1} us", 1.0 / best, best * 1e6);
    }
    Ok(())
}
