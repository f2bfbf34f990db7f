//! What pictures of scenes are: the same everywhere, never a panic, and fine enough to see a metre.
#![allow(missing_docs, reason = "tests")]
#![allow(clippy::unwrap_used, reason = "a test may stop")]

#[path = "samples/scenes.rs"]
mod scenes;

use proptest::prelude::*;
use setpiece_render::scene::{
    Id, Mode, News, NewsKind, Pitch, Posture, Role, ScenePlayer, Side, Term,
};
use setpiece_render::{
    Camera, Options, Overlays, PitchRegion, PixelObserver, Pixels, RenderError, Renderer, SIDE_MAX,
    Scene, gray,
};

const ABOVE: Camera = Camera::Above(PitchRegion::Whole);

fn picture(scene: &Scene, camera: Camera, width: usize, height: usize) -> Vec<u8> {
    let options = Options { camera, overlays: Overlays { terms: true, ..Overlays::default() } };
    let mut rgba = vec![0; width * height * 4];
    Renderer::new(width, height, options).unwrap().render(scene, &mut rgba).unwrap();
    rgba
}

/// FNV-1a, 64 bits.
fn digest(bytes: &[u8]) -> u64 {
    bytes.iter().fold(0xcbf2_9ce4_8422_2325, |hash, byte| {
        (hash ^ u64::from(*byte)).wrapping_mul(0x0100_0000_01b3)
    })
}

/// Golden pictures: a digest changes only in a commit that says what looks different.
#[test]
fn the_sample_scenes_look_as_they_did() {
    let sizes = [(640, 360), (96, 72)];
    let mut found = String::new();
    for (name, scene) in
        [("kick-off", scenes::kick_off()), ("goal", scenes::goal()), ("slide", scenes::slide())]
    {
        for (camera, view) in [("broadcast", Camera::Broadcast), ("above", ABOVE)] {
            for (width, height) in sizes {
                let digest = digest(&picture(&scene, view, width, height));
                found.push_str(&format!("{name} {camera} {width}x{height} {digest:016x}\n"));
            }
        }
    }
    if std::env::var_os("SETPIECE_BLESS").is_some() {
        std::fs::write(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/golden.txt"), &found).unwrap();
    }
    assert_eq!(
        found,
        include_str!("golden.txt"),
        "SETPIECE_BLESS=1 writes the digests of these pictures"
    );
}

#[test]
fn a_picture_depends_on_its_scene_alone() {
    let all = scenes::all();
    for camera in [Camera::Broadcast, ABOVE] {
        let alone: Vec<_> = all.iter().map(|(_, scene)| picture(scene, camera, 320, 180)).collect();
        let threads = std::thread::scope(|scope| {
            let draw = || {
                // One renderer for all, backwards: nothing of one picture may reach the next.
                let options =
                    Options { camera, overlays: Overlays { terms: true, ..Overlays::default() } };
                let mut renderer = Renderer::new(320, 180, options).unwrap();
                let mut pictures: Vec<_> = all
                    .iter()
                    .rev()
                    .map(|(_, scene)| {
                        let mut rgba = vec![7; 320 * 180 * 4];
                        renderer.render(scene, &mut rgba).unwrap();
                        rgba
                    })
                    .collect();
                pictures.reverse();
                pictures
            };
            let workers: Vec<_> = (0..4).map(|_| scope.spawn(draw)).collect();
            workers.into_iter().map(|worker| worker.join().unwrap()).collect::<Vec<_>>()
        });
        for pictures in threads {
            assert!(pictures == alone);
        }
    }
}

/// Every present player, one at a time, one metre in each direction, if the camera sees them.
#[test]
fn a_player_who_moves_one_metre_changes_the_small_picture() {
    for camera in [Camera::Broadcast, ABOVE] {
        for (name, scene) in scenes::all() {
            let before = picture(&scene, camera, 96, 72);
            for index in 0..scene.players.len() {
                let mut without = scene.clone();
                without.players[index].present = false;
                if picture(&without, camera, 96, 72) == before {
                    continue;
                }
                for (x, y) in [(1.0, 0.0), (-1.0, 0.0), (0.0, 1.0), (0.0, -1.0)] {
                    let mut moved = scene.clone();
                    moved.players[index].pos[0] += x;
                    moved.players[index].pos[1] += y;
                    assert!(
                        picture(&moved, camera, 96, 72) != before,
                        "{name}: player {index} by ({x}, {y})"
                    );
                }
            }
        }
    }
}

#[test]
fn everyone_near_the_ball_is_in_the_small_picture() {
    let mut seen = 0;
    for (_, scene) in scenes::all() {
        let before = picture(&scene, Camera::Broadcast, 96, 72);
        for index in 0..scene.players.len() {
            let [x, y] = scene.players[index].pos;
            if (x - scene.ball.pos[0]).abs() < 12.0 && (y - scene.ball.pos[1]).abs() < 8.0 {
                let mut without = scene.clone();
                without.players[index].present = false;
                assert!(picture(&without, Camera::Broadcast, 96, 72) != before);
                seen += 1;
            }
        }
    }
    assert!(seen > 30, "{seen}");
}

#[test]
fn the_ball_is_seen_wherever_it_is_on_the_pitch() {
    for camera in [Camera::Broadcast, ABOVE] {
        for x in -5..=5 {
            for y in -5..=5 {
                let mut scene = Scene::default();
                scene.ball.pos = [x as f32 * 11.0, y as f32 * 7.2, 0.11];
                let mut moved = scene.clone();
                // Out of sight, but where the camera looks the same way.
                moved.ball.pos[2] = 390.0;
                assert!(
                    picture(&scene, camera, 96, 72) != picture(&moved, camera, 96, 72),
                    "{:?}",
                    scene.ball.pos
                );
            }
        }
    }
}

/// A plan without text is its own mirror image if the scene is, but for the two kits.
#[test]
fn a_plan_of_a_mirrored_ball_is_the_mirrored_plan() {
    let (width, height) = (192, 128);
    let plan = |x: f32, y: f32| {
        let mut scene = Scene::default();
        scene.ball.pos = [x, y, 0.11];
        picture(&scene, ABOVE, width, height)
    };
    let (left, right) = (plan(-30.0, 12.0), plan(30.0, 12.0));
    let mut apart = 0;
    for y in 0..height {
        for x in 0..width {
            let at = |x: usize| (y * width + x) * 4;
            let (a, b) = (&left[at(x)..][..3], &right[at(width - 1 - x)..][..3]);
            // The stripes are not mirrored: the lawn has an even number of them.
            let differ = a.iter().zip(b).any(|(a, b)| a.abs_diff(*b) > 24);
            apart += usize::from(differ);
        }
    }
    // Shadows fall one way.
    assert!(apart < 24, "{apart} pixels differ");
}

#[test]
fn a_renderer_allocates_nothing_once_it_is_warm() {
    let scene = scenes::goal();
    for (camera, width, height) in
        [(Camera::Broadcast, 640, 360), (Camera::Broadcast, 96, 72), (ABOVE, 640, 400)]
    {
        let mut renderer =
            Renderer::new(width, height, Options { camera, ..Options::default() }).unwrap();
        let mut rgba = vec![0; width * height * 4];
        let mut rgb = vec![0; width * height * 3];
        let mut gray = vec![0; width * height];
        let mut draw = || {
            renderer.render(&scene, &mut rgba).unwrap();
            renderer.render_rgb(&scene, &mut rgb).unwrap();
            renderer.render_gray(&scene, &mut gray).unwrap();
        };
        draw();
        assert_eq!(allocation_counter::measure(draw).count_total, 0);
    }
}

#[test]
fn rgb_and_gray_are_the_same_picture() {
    let scene = scenes::shot();
    let rgba = picture(&scene, Camera::Broadcast, 96, 72);
    let (mut rgb, mut gray_bytes) =
        (vec![0; Pixels::SMALL.len()], vec![0; Pixels::SMALL_GRAY.len()]);
    PixelObserver::new(Pixels::SMALL, Options::default())
        .unwrap()
        .observe(&scene, &mut rgb)
        .unwrap();
    PixelObserver::new(Pixels::SMALL_GRAY, Options::default())
        .unwrap()
        .observe(&scene, &mut gray_bytes)
        .unwrap();
    for (i, px) in rgba.chunks(4).enumerate() {
        assert_eq!(&rgb[i * 3..][..3], &px[..3]);
        assert_eq!(gray_bytes[i], gray([px[0], px[1], px[2]]));
        assert_eq!(px[3], 255);
    }
    // Rec. 601 in whole numbers, as Pillow rounds it.
    assert_eq!(
        [gray([255, 0, 0]), gray([0, 255, 0]), gray([0, 0, 255]), gray([255; 3])],
        [76, 150, 29, 255]
    );
}

#[test]
fn sizes_and_buffers_that_do_not_fit_are_errors() {
    let new = |width, height| Renderer::new(width, height, Options::default()).map(|_| ());
    assert_eq!(new(0, 72), Err(RenderError::Size { width: 0, height: 72 }));
    assert_eq!(new(96, SIDE_MAX + 1), Err(RenderError::Size { width: 96, height: SIDE_MAX + 1 }));
    let mut renderer = Renderer::new(16, 16, Options::default()).unwrap();
    let error = renderer.render(&Scene::default(), &mut [0; 7]).unwrap_err();
    assert_eq!(error.to_string(), "the picture takes 1024 bytes, and the buffer has 7");
}

#[test]
fn a_scene_survives_json_and_may_leave_out_what_is_usual() {
    for (_, scene) in scenes::all() {
        let text = serde_json::to_string(&scene).unwrap();
        assert_eq!(serde_json::from_str::<Scene>(&text).unwrap(), scene);
    }
    let short: Scene = serde_json::from_str(
        r#"{"ball": {"pos": [1, 2, 0.11]}, "players": [{"id": {"team": "right", "slot": 3}, "posture": "sliding"}]}"#,
    )
    .unwrap();
    assert_eq!(short.players[0].posture, Posture::Sliding);
    assert!(short.players[0].present);
    assert_eq!(short.pitch.length_m, 110.0);
}

#[test]
fn trails_go_back_to_the_last_scene_that_was_placed() {
    let scene = scenes::open_play();
    let mut before = scene.clone();
    before.ball.pos[0] -= 5.0;
    let draw = |before: &[Scene], scene: &Scene| {
        let options = Options { camera: ABOVE, overlays: Overlays::NONE };
        let mut rgba = vec![0; 320 * 200 * 4];
        Renderer::new(320, 200, options).unwrap().render_after(before, scene, &mut rgba).unwrap();
        rgba
    };
    let plain = draw(&[], &scene);
    assert!(draw(std::slice::from_ref(&before), &scene) != plain);
    let placed = Scene { placed: true, ..scene.clone() };
    assert!(draw(std::slice::from_ref(&before), &placed) == plain);
}

/// Numbers that arithmetic stumbles over.
const ODD: [f32; 8] =
    [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, f32::MAX, f32::MIN, 1e-40, -0.0, 0.0];

/// Any number, the odd ones often.
fn number() -> impl Strategy<Value = f32> {
    prop_oneof![
        4 => -60.0_f32..60.0,
        1 => any::<f32>(),
        1 => prop::sample::select(ODD.to_vec()),
    ]
}

fn player() -> impl Strategy<Value = ScenePlayer> {
    let postures = vec![
        Posture::Upright,
        Posture::Stumbling,
        Posture::Sliding,
        Posture::Fallen,
        Posture::Jumping,
        Posture::Diving,
        Posture::Kicking,
    ];
    let body = (prop::sample::select(postures), number(), number(), number());
    let places = ([number(), number()], [number(), number()], [number(), number()]);
    let marks =
        (any::<bool>(), any::<u8>(), any::<u8>(), any::<bool>(), any::<bool>(), any::<bool>());
    (places, body, marks).prop_map(
        |((pos, vel, facing), (posture, progress, height_m, tired), marks)| {
            let (right, slot, number, keeper, agent, present) = marks;
            ScenePlayer {
                id: Id { team: if right { Side::Right } else { Side::Left }, slot },
                number,
                role: if keeper { Role::GK } else { Role::CF },
                pos,
                height_m,
                vel,
                facing,
                posture,
                progress,
                tired,
                yellow_cards: number,
                present: present || keeper,
                agent,
            }
        },
    )
}

fn scene() -> impl Strategy<Value = Scene> {
    let ball = (
        [number(), number(), number()],
        [number(), number(), number()],
        [number(), number(), number()],
    );
    let pitch = prop::collection::vec(prop_oneof![3 => Just(f32::NAN), 1 => number()], 11);
    let clock = (any::<u32>(), number(), number(), any::<[u16; 2]>(), ".{0,20}", any::<u32>());
    (ball, prop::collection::vec(player(), 0..24), pitch, clock).prop_map(
        |(ball, players, pitch, clock)| {
            let (step, between, clock_s, score, name, age_steps) = clock;
            let mut scene = Scene {
                step,
                between,
                players,
                score,
                clock_s,
                mode: Mode::Penalty,
                ..Scene::default()
            };
            (scene.ball.pos, scene.ball.vel, scene.ball.spin) = ball;
            scene.ball.owner = scene.players.first().map(|player| player.id);
            scene.names = [name.clone(), String::new()];
            scene.rewards = vec![Term { name, value: between }];
            scene.news = vec![
                News {
                    kind: NewsKind::RedCard,
                    team: Side::Right,
                    number: Some(255),
                    age_steps: age_steps % 40,
                },
                News { kind: NewsKind::Goal, team: Side::Left, number: None, age_steps },
            ];
            scene.pitch = Pitch {
                length_m: pitch[0],
                width_m: pitch[1],
                goal_width_m: pitch[2],
                goal_height_m: pitch[3],
                goal_depth_m: pitch[4],
                box_depth_m: pitch[5],
                box_width_m: pitch[6],
                six_yard_depth_m: pitch[7],
                six_yard_width_m: pitch[8],
                spot_m: pitch[9],
                circle_m: pitch[10],
            };
            scene
        },
    )
}

fn size() -> impl Strategy<Value = (usize, usize)> {
    prop_oneof![
        3 => (1_usize..140, 1_usize..140),
        1 => prop::sample::select(vec![
            (1, 1), (1, 90), (90, 1), (16, 16), (96, 72), (72, 96), (640, 360), (420, 300),
        ]),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn any_scene_can_be_drawn_at_any_size(
        scene in scene(),
        (width, height) in size(),
        low in [number(), number()],
        high in [number(), number()],
    ) {
        let regions = [PitchRegion::LeftHalf, PitchRegion::Box { low, high }].map(Camera::Above);
        let cameras = [Camera::Broadcast, ABOVE, regions[0], regions[1]];
        for camera in cameras {
            let rgba = picture(&scene, camera, width, height);
            prop_assert!(rgba.chunks(4).all(|px| px[3] == 255));
        }
    }
}
