//! Scenes that tests, benchmark and example share.
#![allow(dead_code, reason = "each of them uses some")]

use setpiece_render::Scene;
use setpiece_render::scene::{Id, Mode, News, NewsKind, Posture, Role, ScenePlayer, Side, Term};

/// Where the left team stands in open play, and who is who; the right team mirrors it.
const LINEUP: [(Role, f32, f32); 11] = [
    (Role::GK, -52.0, 0.0),
    (Role::LB, -26.0, -20.0),
    (Role::CB, -31.0, -7.0),
    (Role::CB, -30.0, 8.0),
    (Role::RB, -25.0, 21.0),
    (Role::DM, -17.0, 1.0),
    (Role::CM, -10.0, -12.0),
    (Role::CM, -9.0, 11.0),
    (Role::LM, 1.0, -24.0),
    (Role::CF, 4.0, -2.0),
    (Role::RM, 0.0, 22.0),
];

/// A player of the line-up, moved along.
fn player(team: Side, slot: usize, shift: f32) -> ScenePlayer {
    let (role, x, y) = LINEUP[slot];
    let sign = if team == Side::Left { 1.0 } else { -1.0 };
    let x = if role == Role::GK { x } else { x + shift * sign };
    let run = 1.0 + (slot * 7 % 11) as f32 * 0.6;
    // Directions all around, by the half-angle formula: a sample must be the same on every machine.
    let half = [0.2, 1.4, -3.0, -0.9, 0.5, 6.0, -0.3, 2.2, -1.6, 0.05, -0.6]
        [(slot * 3 + team.index() * 5) % 11];
    let (x_way, y_way) =
        ((1.0 - half * half) / (1.0 + half * half), 2.0 * half / (1.0 + half * half));
    let vel = if role == Role::GK { [0.0; 2] } else { [run * x_way, run * y_way] };
    ScenePlayer {
        id: Id { team, slot: slot as u8 },
        number: [1, 3, 4, 5, 2, 6, 8, 10, 11, 9, 7][slot],
        role,
        pos: [x * sign, y * sign],
        vel,
        facing: if role == Role::GK { [sign, 0.0] } else { [x_way, y_way] },
        ..ScenePlayer::default()
    }
}

/// Everyone, with the play shifted along x.
pub(crate) fn squads(shift: f32) -> Vec<ScenePlayer> {
    let team = |team, shift| (0..11).map(move |slot| player(team, slot, shift));
    team(Side::Left, shift).chain(team(Side::Right, -shift)).collect()
}

fn base(step: u32, shift: f32, ball: [f32; 3]) -> Scene {
    let mut scene =
        Scene { step, clock_s: step as f32 * 0.1, players: squads(shift), ..Scene::default() };
    scene.ball.pos = ball;
    scene
}

fn at(scene: &mut Scene, index: usize, pos: [f32; 2], vel: [f32; 2]) -> &mut ScenePlayer {
    let player = &mut scene.players[index];
    player.pos = pos;
    player.vel = vel;
    if vel != [0.0; 2] {
        player.facing = vel;
    }
    player
}

/// The kick-off: everyone in their own half, the left team takes it.
pub(crate) fn kick_off() -> Scene {
    let mut scene = base(3, 0.0, [0.0, 0.0, 0.11]);
    scene.mode = Mode::KickOff;
    scene.mode_team = Some(Side::Left);
    for player in &mut scene.players {
        let sign = if player.id.team == Side::Left { 1.0 } else { -1.0 };
        player.vel = [0.0; 2];
        player.facing = [sign, 0.0];
        player.pos[0] = sign * (player.pos[0] * sign - 4.0).min(-2.5);
        if player.pos[0].abs() < 10.0 && player.pos[1].abs() < 9.0 && player.id.team == Side::Right
        {
            player.pos[0] = 10.5;
        }
    }
    at(&mut scene, 9, [-0.5, -0.4], [0.0; 2]).facing = [0.3, 1.0];
    scene.players[9].agent = true;
    at(&mut scene, 10, [-1.0, 6.0], [0.0; 2]).facing = [0.2, -1.0];
    scene.ball.owner = Some(scene.players[9].id);
    scene
}

/// A corner: a crowd in the box, one jumps.
pub(crate) fn corner() -> Scene {
    let mut scene = base(2412, 30.0, [50.5, -6.0, 2.6]);
    scene.score = [1, 1];
    scene.mode = Mode::Corner;
    scene.mode_team = Some(Side::Left);
    scene.ball.vel = [-4.0, 14.0, 1.0];
    scene.ball.spin = [10.0, 0.0, 40.0];
    at(&mut scene, 10, [54.6, -35.6], [-0.4, 1.5]).posture = Posture::Kicking;
    scene.players[10].progress = 0.8;
    let box_places =
        [(48.5, -4.0), (46.0, 2.0), (49.5, 4.0), (43.5, -1.5), (45.0, 7.0), (38.0, 3.0)];
    for (i, (x, y)) in box_places.into_iter().enumerate() {
        at(&mut scene, 4 + i, [x, y], [2.5, -1.0 - 0.3 * i as f32]);
        at(&mut scene, 14 + i, [x + 1.1, y - 0.5], [0.5, -1.5]);
    }
    let head = at(&mut scene, 4, [49.6, -5.6], [1.5, -1.5]);
    head.posture = Posture::Jumping;
    head.progress = 0.5;
    head.height_m = 0.55;
    head.agent = true;
    let rival = at(&mut scene, 14, [50.4, -4.6], [0.5, -1.0]);
    rival.posture = Posture::Jumping;
    rival.progress = 0.4;
    rival.height_m = 0.35;
    at(&mut scene, 11, [54.0, -1.0], [0.0, -1.5]).facing = [-0.4, -1.0];
    scene
}

/// A shot in the box, seen just as the ball leaves the foot.
pub(crate) fn shot() -> Scene {
    let mut scene = base(7570, 32.0, [44.6, 4.1, 0.5]);
    scene.score = [1, 0];
    scene.ball.vel = [24.0, -6.0, 4.0];
    scene.ball.spin = [3.0, 40.0, 9.0];
    let striker = at(&mut scene, 9, [43.6, 4.4], [3.0, -0.6]);
    striker.posture = Posture::Kicking;
    striker.progress = 0.66;
    striker.agent = true;
    let places = [
        (46.5, 1.0, -2.0, 2.5),
        (42.0, 8.0, 5.0, -3.0),
        (47.5, 6.5, -3.0, -1.0),
        (38.0, -6.0, 6.0, 2.0),
    ];
    for (i, (x, y, u, v)) in places.into_iter().enumerate() {
        at(&mut scene, 12 + i, [x, y], [u, v]);
    }
    at(&mut scene, 10, [45.0, 14.0], [6.5, -3.0]);
    at(&mut scene, 8, [42.0, -9.0], [7.5, 2.0]);
    at(&mut scene, 7, [35.0, 5.0], [5.0, 0.5]);
    at(&mut scene, 11, [53.6, 0.6], [-0.6, 0.8]).facing = [-1.0, 0.35];
    scene.players[13].yellow_cards = 1;
    scene.rewards = vec![
        Term { name: "shaping/approach".to_owned(), value: 0.0123 },
        Term { name: "shaping/box entry".to_owned(), value: 0.1 },
        Term { name: "cost/time".to_owned(), value: -0.001 },
    ];
    scene
}

/// A goal: the ball is in the net, which bulges.
pub(crate) fn goal() -> Scene {
    let mut scene = shot();
    scene.step += 9;
    scene.score = [2, 0];
    scene.ball.pos = [57.25, -1.6, 1.1];
    scene.ball.vel = [6.0, -1.0, 0.0];
    scene.news =
        vec![News { kind: NewsKind::Goal, team: Side::Left, number: Some(9), age_steps: 5 }];
    at(&mut scene, 9, [46.0, 3.0], [5.0, -3.0]).posture = Posture::Upright;
    let keeper = at(&mut scene, 11, [53.9, -1.0], [-0.3, -3.0]);
    keeper.posture = Posture::Diving;
    keeper.progress = 0.75;
    keeper.facing = [-1.0, 0.0];
    scene
}

/// A tackle in midfield.
pub(crate) fn slide() -> Scene {
    let mut scene = base(1188, 8.0, [12.9, 9.0, 0.11]);
    scene.ball.vel = [4.0, 1.0, 0.0];
    scene.ball.spin = [-9.0, 36.0, 0.0];
    let dribbler = at(&mut scene, 7, [12.2, 8.6], [6.2, 1.4]);
    dribbler.agent = true;
    scene.ball.owner = Some(scene.players[7].id);
    let tackler = at(&mut scene, 17, [14.9, 10.4], [-5.0, -3.2]);
    tackler.posture = Posture::Sliding;
    tackler.progress = 0.5;
    let fallen = at(&mut scene, 16, [8.0, 5.0], [0.0; 2]);
    fallen.posture = Posture::Fallen;
    fallen.yellow_cards = 1;
    fallen.facing = [0.8, 0.5];
    at(&mut scene, 15, [19.0, 3.0], [-4.0, 3.0]);
    at(&mut scene, 18, [17.0, 17.0], [-3.0, -5.0]).posture = Posture::Stumbling;
    scene.news =
        vec![News { kind: NewsKind::YellowCard, team: Side::Right, number: Some(4), age_steps: 8 }];
    scene
}

/// A keeper's dive, at the left goal.
pub(crate) fn dive() -> Scene {
    let mut scene = base(4630, -30.0, [-52.6, 2.7, 1.0]);
    scene.score = [0, 3];
    scene.ball.vel = [-22.0, 3.0, 1.0];
    scene.ball.spin = [0.0, -30.0, 12.0];
    let keeper = at(&mut scene, 0, [-53.4, 1.6], [0.4, 4.5]);
    keeper.posture = Posture::Diving;
    keeper.progress = 0.35;
    keeper.facing = [1.0, 0.3];
    let shooter = at(&mut scene, 20, [-40.0, 1.0], [-3.0, 0.4]);
    shooter.posture = Posture::Kicking;
    shooter.progress = 0.95;
    at(&mut scene, 2, [-42.5, -1.0], [3.0, 3.0]);
    at(&mut scene, 3, [-45.0, 5.0], [3.5, -3.0]);
    at(&mut scene, 19, [-41.0, -9.0], [-6.0, 2.0]);
    scene
}

/// A penalty about to be taken.
pub(crate) fn penalty() -> Scene {
    let mut scene = base(8130, 24.0, [44.0, 0.0, 0.11]);
    scene.score = [1, 1];
    scene.mode = Mode::Penalty;
    scene.mode_team = Some(Side::Left);
    for player in &mut scene.players {
        if player.pos[0] > 37.0 {
            player.pos[0] = 37.0 - f32::from(player.id.slot) * 0.4;
        }
        player.vel = [0.0; 2];
        player.facing = [1.0, -0.02 * player.pos[1]];
    }
    let taker = at(&mut scene, 9, [41.0, 1.0], [3.5, -0.8]);
    taker.agent = true;
    at(&mut scene, 11, [54.8, 0.0], [0.0; 2]).facing = [-1.0, 0.0];
    at(&mut scene, 0, [-52.0, 0.0], [0.0; 2]);
    scene
}

/// Open play in the middle.
pub(crate) fn open_play() -> Scene {
    let mut scene = base(512, 10.0, [9.0, -3.0, 0.11]);
    scene.ball.vel = [8.0, 3.0, 0.0];
    scene.ball.spin = [-27.0, 72.0, 0.0];
    scene.players[9].agent = true;
    scene.ball.owner = Some(scene.players[9].id);
    scene
}

/// All of them by name.
pub(crate) fn all() -> [(&'static str, Scene); 8] {
    [
        ("kick-off", kick_off()),
        ("corner", corner()),
        ("shot", shot()),
        ("goal", goal()),
        ("slide", slide()),
        ("dive", dive()),
        ("penalty", penalty()),
        ("open-play", open_play()),
    ]
}
