//! Where a player can first meet the ball: the search skips points, and finds the same as a scan of
//! every point.

use glam::{Vec2, Vec3};
use proptest::prelude::*;
use setpiece_engine::football::reach::{PLAYABLE_M, Way, meeting};
use setpiece_engine::physics::Forecast;
use setpiece_engine::physics::left_pitch;
use setpiece_engine::physics::{Ball, Conditions};
use setpiece_engine::state::Player;
use setpiece_engine::state::player::Body;
use setpiece_scenario::Ai;
use setpiece_scenario::PitchSize;
use setpiece_scenario::vocabulary::Role;

fn player(pos: [f32; 2], vel: [f32; 2], speed_top_mps: f32) -> Player {
    Player {
        active: true,
        role: Role::CM,
        ai: Ai::Bot,
        controllable: true,
        pos: pos.into(),
        vel: vel.into(),
        heading_rad: 0.0,
        fatigue: 0.0,
        yellow_cards: 0,
        difficulty: 1.0,
        body: Body { speed_top_mps, ..Body::blank() },
    }
}

/// The meeting that a scan of every point finds; `None` if they can't be there in time. Their
/// current run fades over 0.7 s, while they start to run the other way. A ball so fast that it
/// could pass them between two points is met where it is nearest.
fn met(player: &Player, forecast: &Forecast, tick: u32) -> Option<(Vec2, f32)> {
    let speed = 0.94 * player.body.speed_top_mps;
    let foot = player.pos + player.vel * 0.01 + player.vel.clamp_length_max(0.1);
    let fast = forecast.stride_m() > 0.56;
    let on_pitch = forecast
        .from(tick)
        .take_while(|(_, point)| left_pitch(&PitchSize::USUAL, *point).is_none());
    let now = forecast.at(tick).truncate();
    let (mut before, mut before_s, mut before_at) = (now - foot, 0.0, now);
    for (time_s, point) in on_pitch {
        let changing_s = time_s.min(0.7);
        let changed_s = changing_s * changing_s * (0.5 / 0.7);
        let radius = 0.28 + speed * (changed_s + time_s - changing_s);
        let (at, point_m) = (point.truncate(), point.z);
        let off = at - (foot + player.vel * (changing_s - changed_s));
        let way = before - off;
        let back = if fast && way.length_squared() > 0.0 {
            (-off.dot(way) / way.length_squared()).clamp(0.0, 1.0)
        } else {
            0.0
        };
        if point_m <= PLAYABLE_M && (off + way * back).length_squared() <= radius * radius {
            let (point, time_s) = (at.lerp(before_at, back), time_s + (before_s - time_s) * back);
            // A player who arrives within a moment counts as sooner the nearer they are.
            let apart = (player.pos + player.vel * 0.08).distance(point);
            let sooner_s = 0.08 * (apart / 0.6).min(1.0);
            return Some((point, if time_s < 0.08 { sooner_s } else { time_s }));
        }
        (before, before_s, before_at) = (off, time_s, at);
    }
    None
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(4000))]

    #[test]
    fn a_leaping_search_finds_what_a_look_at_every_point_finds(
        ball in (-54.0f32..54.0, -35.0f32..35.0, 0.11f32..3.0),
        vel in prop::array::uniform3(-25.0f32..25.0),
        spin in prop::array::uniform3(-30.0f32..30.0),
        rolls: bool,
        from in (-60.0f32..60.0, -40.0f32..40.0),
        running in prop::array::uniform2(-8.0f32..8.0),
        speed in prop_oneof![9 => 4.0f32..9.0, 1 => Just(0.0)],
        still in prop::bool::weighted(0.1),
        later in 0u32..120,
    ) {
        let (height, rise) = if rolls { (0.11, 0.0) } else { (ball.2, vel[2]) };
        let pos = Vec3::new(ball.0, ball.1, height);
        let vel = if still { Vec3::ZERO } else { Vec3::new(vel[0], vel[1], rise) };
        let pos = if still { pos.with_z(0.11) } else { pos };
        let ball = Ball { pos, vel, spin: spin.into() };
        let forecast = Forecast::of(&ball, &PitchSize::USUAL, &Conditions::USUAL, 700);
        let player = player([from.0, from.1], running, speed);
        let tick = 700 + later;
        let found = meeting(&player, &Way::of(&forecast, tick));
        if let Some(expected) = met(&player, &forecast, tick) {
            let apart = (found.0.distance(expected.0), (found.1 - expected.1).abs());
            prop_assert!(apart.0 < 1e-3 && apart.1 < 1e-4, "{found:?} {expected:?}");
        } else {
            // Nowhere in time: the player runs to the path's end, and is late.
            let inside = |(_, point): &(f32, Vec3)| left_pitch(&PitchSize::USUAL, *point).is_none();
            let way: Vec<_> = forecast.from(tick).take_while(inside).collect();
            let end = way.last().map(|(time_s, point)| (point.truncate(), *time_s));
            let end = end.unwrap_or((player.pos, 0.0));
            prop_assert!(found.0 == end.0 && (found.1 >= end.1 || found.1.is_nan()), "{found:?} {end:?}");
        }
    }
}
