//! Plays matches and scenarios without a scenario file and prints their statistics: the bench on which the game is tuned.
//!
//! `cargo run -p setpiece-engine --example matchlab -- [full|scenarios|look|curves|kicks|shots|random] [N] [LEFT RIGHT]`

#![allow(
    clippy::print_stdout,
    clippy::print_stderr,
    clippy::unwrap_used,
    clippy::format_push_string,
    clippy::comparison_chain,
    reason = "a bench prints its figures"
)]

#[path = "matchlab/layouts.rs"]
mod layouts;
#[path = "matchlab/tally.rs"]
mod tally;

use layouts::{Layout, drawn};
use setpiece_engine::control::agents::Agent;
use setpiece_engine::event::Events;
use setpiece_engine::football;
use setpiece_engine::physics::Scratch;
use setpiece_engine::random::Stream;
use setpiece_engine::state::Match;
use setpiece_scenario::vocabulary::{Action, EventKind};
use tally::Tally;

fn main() {
    let args: Vec<String> = std::env::args().skip(1).collect();
    let count = args.get(1).and_then(|n| n.parse().ok()).unwrap_or(20);
    let level = |i: usize, default: f32| args.get(i).and_then(|n| n.parse().ok()).unwrap_or(default);
    match args.first().map_or("full", String::as_str) {
        "full" => full(count, level(2, 1.0), level(3, 0.6)),
        "scenarios" => scenarios(count),
        "look" => look(count as u64, level(2, 1.0), level(3, 0.6)),
        "curves" => curves(),
        "kicks" => kicks(),
        "shots" => shots(),
        "random" => random(count),
        other => eprintln!("unknown mode {other}"),
    }
}

fn full(count: usize, left: f32, right: f32) {
    let mut total = Tally::default();
    for i in 0..count {
        let mut start = drawn(Layout::Eleven, i as u64);
        layouts::set_level(&mut start, [left, right]);
        let mut game = football::begin(&start);
        let (mut events, mut scratch) = (Events::new(), Scratch::default());
        for _ in 0..3000 {
            events.clear();
            football::play_step(&mut game, &[Action::BuiltinAi], &mut events, &mut scratch);
            total.step(&game, &events);
            if game.dead {
                football::restart(&mut game, &mut events);
            }
        }
        total.matched(&game);
    }
    println!("{left} v {right}\n{total}");
}

/// Plays an Academy scenario to its end: 1 a goal by left, -1 one by right, 0 else; and the length.
fn episode(layout: Layout, agent: Agent, seed: u64) -> (i32, u32, &'static str) {
    let start = drawn(layout, seed);
    let mut game = football::begin(&start);
    let (mut events, mut scratch) = (Events::new(), Scratch::default());
    let mut stream = Stream::new(seed, 0, setpiece_engine::random::Purpose::Agent);
    let mut held = None;
    for step in 1..=400 {
        let action = agent.act(&game, 0, &mut stream);
        events.clear();
        football::play_step(&mut game, &[action], &mut events, &mut scratch);
        if game.score != [0, 0] {
            return (i32::from(game.score[0]) - i32::from(game.score[1]), step, "goal");
        }
        if events.as_slice().iter().any(|e| e.kind == EventKind::OutOfPlay) || game.dead {
            return (0, step, "out");
        }
        if let Some(owner) = game.owner {
            if held.is_some_and(|team| team != owner.team()) {
                return (0, step, "lost");
            }
            held = Some(owner.team());
        }
    }
    (0, 400, "limit")
}

fn scenarios(count: usize) {
    for layout in Layout::ACADEMY {
        for agent in [Agent::RunAndShoot, Agent::Idle, Agent::Random] {
            let (mut score, mut wins, mut length) = (0, 0, 0);
            let mut ends = std::collections::BTreeMap::new();
            for i in 0..count {
                let (goal, steps, end) = episode(*layout, agent, i as u64);
                score += goal;
                wins += i32::from(goal > 0);
                length += steps;
                *ends.entry(end).or_insert(0) += 1;
            }
            let n = count as f32;
            println!(
                "{layout:?} {agent:?}: success {:.3} score {:+.3} length {:.1} {ends:?}",
                wins as f32 / n,
                score as f32 / n,
                length as f32 / n
            );
        }
    }
}

fn look(seed: u64, left: f32, right: f32) {
    let mut start = drawn(Layout::Eleven, seed);
    layouts::set_level(&mut start, [left, right]);
    let mut game = football::begin(&start);
    let (mut events, mut scratch) = (Events::new(), Scratch::default());
    for step in 0..600 {
        events.clear();
        football::play_step(&mut game, &[Action::BuiltinAi], &mut events, &mut scratch);
        for e in events.as_slice() {
            if !matches!(e.kind, EventKind::Touch) {
                println!(
                    "  {step:4} {:?} {:?} by {:?} to {:?} at {:.1} v {:.1}",
                    e.kind,
                    e.qualifier,
                    e.by.map(|p| p.0),
                    e.to.map(|p| p.0),
                    e.at,
                    e.speed_mps
                );
            }
        }
        if step % 15 == 0 {
            print_pitch(&game);
        }
        if game.dead {
            football::restart(&mut game, &mut events);
        }
    }
}

fn print_pitch(game: &Match) {
    const W: usize = 112;
    const H: usize = 37;
    let mut rows = vec![vec![' '; W]; H];
    let mut put = |x: f32, y: f32, c: char| {
        let col = ((x + 56.0).clamp(0.0, 111.0)) as usize;
        let row = (((y + 37.0) * 0.5).clamp(0.0, 36.0)) as usize;
        rows[row][col] = c;
    };
    for (i, p) in game.players.iter().enumerate().filter(|(_, p)| p.active) {
        let c = if i < 11 { char::from(b'a' + i as u8) } else { char::from(b'A' + (i - 11) as u8) };
        put(p.pos.x, p.pos.y, c);
    }
    put(game.ball.pos.x, game.ball.pos.y, '*');
    println!(
        "step {} score {:?} owner {:?} ball {:.1} v {:.1}",
        game.step,
        game.score,
        game.owner.map(|p| p.0),
        game.ball.pos,
        game.ball.vel
    );
    for row in rows {
        println!("|{}|", row.into_iter().collect::<String>());
    }
}

fn curves() {
    for (name, keys, with_ball) in [
        ("sprint", vec![Action::Right, Action::Sprint], false),
        ("walk", vec![Action::Right], false),
        ("dribble", vec![Action::Right, Action::Dribble], false),
        ("sprint+ball", vec![Action::Right, Action::Sprint], true),
        ("walk+ball", vec![Action::Right], true),
        ("dribble+ball", vec![Action::Right, Action::Dribble], true),
    ] {
        let start = drawn(if with_ball { Layout::AloneWithBall } else { Layout::Alone }, 0);
        let mut game = football::begin(&start);
        let (mut events, mut scratch) = (Events::new(), Scratch::default());
        let mut line = String::new();
        let id = game.agents[0].player.unwrap();
        let mut before = game.player(id).pos;
        for step in 0..60 {
            let action = keys.get(step).copied().unwrap_or(Action::Idle);
            events.clear();
            football::play_step(&mut game, &[action], &mut events, &mut scratch);
            let now = game.player(id).pos;
            if step < 24 || step % 6 == 0 {
                line += &format!("{:.2} ", now.distance(before) * 10.0);
            }
            before = now;
            if game.dead {
                break;
            }
        }
        println!("{name}: {line} owner {:?} pos {:.1} ball {:.1}", game.owner, before, game.ball.pos);
    }
}

/// The kicks of an agent: what the ball does after each, against the measured figures.
fn kicks() {
    use setpiece_engine::start::DrawnPlayer;
    for (action, name) in
        [(Action::ShortPass, "short"), (Action::LongPass, "long"), (Action::HighPass, "high"), (Action::Shot, "shot")]
    {
        for ahead in [0.2f32, 0.4, 0.8] {
            let mut line = String::new();
            let (mut top, mut rise, mut delay, mut wide) = (0.0f32, 0.0f32, 0u32, 0.0f32);
            for seed in 0..8 {
                let mut start = drawn(Layout::AloneWithBall, seed);
                let mate =
                    DrawnPlayer { pos: start.players[1].as_ref().unwrap().pos, ..start.players[0].clone().unwrap() };
                let at = glam::Vec2::new(-20.0, 0.0);
                start.players[1].as_mut().unwrap().pos = at;
                start.ball_pos = (at + glam::Vec2::new(0.5, 0.0)).extend(0.11);
                start.players[2] = Some(DrawnPlayer { pos: at + glam::Vec2::new(ahead * 54.4, 0.0), ..mate });
                let mut game = football::begin(&start);
                let (mut events, mut scratch) = (Events::new(), Scratch::default());
                let (mut best, mut high, mut left) = (0.0f32, 0.0f32, 0);
                for step in 0..30 {
                    let action = match step {
                        8 => Action::Right,
                        9 if name != "shot" => Action::Idle,
                        10 => action,
                        _ => Action::Idle,
                    };
                    if name == "shot" && step == 8 {
                        continue;
                    }
                    let before = game.ball.pos;
                    events.clear();
                    football::play_step(&mut game, &[action], &mut events, &mut scratch);
                    let speed = (game.ball.pos - before).truncate().length() * 10.0;
                    if step >= 10 && speed > 9.0 && left == 0 {
                        left = step - 10;
                        let way = (game.ball.pos - before).truncate();
                        wide += (way.y / way.x).abs();
                    }
                    best = best.max(speed);
                    high = high.max(game.ball.pos.z);
                    if seed == 0 && step >= 10 && step % 2 == 0 {
                        line += &format!("{speed:.0}/{:.1} ", game.ball.pos.z);
                    }
                }
                top += best / 8.0;
                rise += high / 8.0;
                delay += left;
            }
            println!(
                "{name} {ahead}: leaves after {:.1}, top {top:.1}, height {rise:.2}, aside {:.3}: {line}",
                delay as f32 / 8.0,
                wide / 8.0
            );
        }
    }
}

/// The share of goals of a standing shot at a keeper, by distance.
fn shots() {
    for y in [0.0f32, 0.25] {
        let mut line = String::new();
        for x in [0.95f32, 0.9, 0.85, 0.8, 0.7, 0.6, 0.5] {
            let mut goals = 0;
            for seed in 0..200 {
                let mut start = drawn(Layout::AloneWithBall, seed);
                let jitter = ((seed * 7919) % 61) as f32 / 1000.0 - 0.03;
                let at = glam::Vec2::new((x + jitter * 0.3) * 54.4 - 0.5, (y + jitter * 0.5) * 83.6);
                start.players[1].as_mut().unwrap().pos = at;
                start.ball_pos = (at + glam::Vec2::new(0.5, 0.0)).extend(0.11);
                let keeper = start.players[11].as_mut().unwrap();
                keeper.ai = setpiece_scenario::Ai::Bot;
                keeper.pos = glam::Vec2::new(54.4, 0.0);
                let mut game = football::begin(&start);
                let (mut events, mut scratch) = (Events::new(), Scratch::default());
                for step in 0..45 {
                    let action = if step == 6 { Action::Shot } else { Action::Idle };
                    events.clear();
                    football::play_step(&mut game, &[action], &mut events, &mut scratch);
                    if game.dead {
                        break;
                    }
                }
                goals += u32::from(game.score[0]);
            }
            line += &format!("{x}: {:.2}  ", f64::from(goals) / 200.0);
        }
        println!("y {y}: {line}");
    }
}

/// What happens to a random agent.
fn random(count: usize) {
    for seed in 0..count as u64 {
        let start = drawn(Layout::ThreeVersusOne, seed);
        let mut game = football::begin(&start);
        let (mut events, mut scratch) = (Events::new(), Scratch::default());
        let mut stream = Stream::new(seed, 0, setpiece_engine::random::Purpose::Agent);
        println!("episode {seed}");
        for step in 0..400 {
            let action = Agent::Random.act(&game, 0, &mut stream);
            events.clear();
            football::play_step(&mut game, &[action], &mut events, &mut scratch);
            for e in events.as_slice().iter().filter(|e| !matches!(e.kind, EventKind::Touch | EventKind::BallLost)) {
                println!(
                    "  {step:4} {:?} {:?} by {:?} to {:?} at {:.1} v {:.1} me {:?}",
                    e.kind,
                    e.qualifier,
                    e.by.map(|p| p.0),
                    e.to.map(|p| p.0),
                    e.at,
                    e.speed_mps,
                    game.agents[0].player.map(|p| p.0)
                );
            }
            if game.dead || events.as_slice().iter().any(|e| e.kind == EventKind::BallWon) {
                break;
            }
        }
    }
}
