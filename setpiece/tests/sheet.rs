//! `setpiece render`, through the real binary and the library: what the pictures show.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

use setpiece::engine::control::agents::Agent;
use setpiece::engine::environment::{Environment, EnvironmentOptions, Scratch};
use setpiece::film::{Film, FilmOptions, film, replayed};
use setpiece::render::scene::{Posture, Role, ScenePlayer};
use setpiece::render::{Options, Overlays, Renderer, Scene};
use setpiece::replay::{Recorder, Replay};
use setpiece::scenario::{Action, PitchSize};
use setpiece::scene::team;
use setpiece::sheet::colours::{AGENT, Colour, shirt};
use setpiece::sheet::{Region, frame, sheet};
use std::path::Path;
use std::process::{Command, Output};
use tiny_skia::{Pixmap, Point};

fn setpiece(folder: &Path, args: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_setpiece")).args(args).current_dir(folder).output().unwrap()
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).unwrap()
}

/// Runs it and reads the picture.
fn rendered(args: &[&str]) -> Pixmap {
    let folder = tempfile::tempdir().unwrap();
    let output = setpiece(folder.path(), &[&["render", "-o", "picture.png"], args].concat());
    assert!(output.status.success(), "{args:?}: {}", text(&output.stderr));
    assert!(text(&output.stdout).contains("picture.png"), "{}", text(&output.stdout));
    Pixmap::load_png(folder.path().join("picture.png")).unwrap()
}

/// Runs it and expects one clear error, and no picture.
fn fails(args: &[&str], code: i32, words: &[&str]) {
    let folder = tempfile::tempdir().unwrap();
    let output = setpiece(folder.path(), &[&["render"], args].concat());
    let stderr = text(&output.stderr);
    assert_eq!(output.status.code(), Some(code), "{args:?}: {stderr}");
    for word in words {
        assert!(stderr.contains(word), "{args:?}: no `{word}` in {stderr}");
    }
    assert!(!stderr.contains("panicked"), "{stderr}");
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0, "{args:?}");
}

fn played(name: &str, agent: Agent) -> Film {
    let options = FilmOptions {
        seed: 0,
        episode: 0,
        agent: agent.into(),
        environment: EnvironmentOptions::default(),
        until_step: None,
    };
    film(&setpiece::load(name).unwrap().scenario, &options).unwrap()
}

/// A scene on the whole pitch, 10 pixels per metre.
fn drawn(scenes: &[Scene]) -> Pixmap {
    let mut picture = Pixmap::new(1200, 800).unwrap();
    let options = Options { camera: Region::WHOLE.camera(), overlays: Overlays::NONE };
    let mut renderer = Renderer::new(1200, 800, options).unwrap();
    let (scene, before) = scenes.split_last().unwrap();
    renderer.render_after(before, scene, picture.data_mut()).unwrap();
    picture
}

/// How many pixels of a colour are within this distance of a point.
fn count(picture: &Pixmap, middle: Point, within: f32, [red, green, blue, _]: Colour) -> usize {
    let (width, height) = (picture.width() as usize, picture.height() as usize);
    let near = |index: usize| {
        let (x, y) = ((index % width) as f32 - middle.x, (index / width) as f32 - middle.y);
        x.hypot(y) <= within
    };
    let pixels = picture.pixels();
    assert_eq!(pixels.len(), width * height);
    let hit = |index: &usize| {
        let pixel = pixels[*index].demultiply();
        near(*index) && [pixel.red(), pixel.green(), pixel.blue()] == [red, green, blue]
    };
    (0..pixels.len()).filter(hit).count()
}

fn spot(x_m: f32, y_m: f32) -> Point {
    let (x, y) = PitchSize::USUAL.rim();
    Point { x: (x_m + x as f32) * 10.0, y: (y_m + y as f32) * 10.0 }
}

#[test]
fn a_sheet_is_a_picture_of_the_whole_episode() {
    let picture = rendered(&["academy_3_vs_1_with_keeper", "--seed", "3", "--agent", "random"]);
    assert_eq!(picture.width(), 2580);
    assert!((1000..3500).contains(&picture.height()), "{}", picture.height());
}

#[test]
fn a_step_is_one_large_frame() {
    let start = rendered(&["academy_corner", "--step", "0"]);
    let later = rendered(&["academy_corner", "--step", "10"]);
    assert_eq!((start.width(), later.width()), (1720, 1720));
    assert!(start.height() > 1200 && start.data() != later.data());
}

#[test]
fn a_recorded_episode_is_drawn_as_it_was_played() {
    let mut environment = Environment::new(
        setpiece::load("11_vs_11_stochastic").unwrap().scenario,
        EnvironmentOptions::default(),
    )
    .unwrap();
    let (mut recorder, mut scratch) = (Recorder::default(), Scratch::default());
    environment.reset(Some(7), Some(0)).unwrap();
    recorder.begin(None);
    for _ in 0..12 {
        recorder.note(Action::Idle, None);
        environment.step(&[Action::Idle], &mut scratch).unwrap();
    }
    let replay = Replay::of(&environment, &recorder).unwrap();
    let film = replayed(&replay).unwrap();
    assert_eq!((film.length(), film.origin.as_str()), (12, "seed 7"));
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("a.pitchr"), replay.to_bytes().unwrap()).unwrap();
    let output = setpiece(folder.path(), &["render", "a.pitchr", "-o", "a.png"]);
    assert!(
        text(&output.stdout).contains("11_vs_11_stochastic, seed 7 · 12 steps → a.png"),
        "{}",
        text(&output.stderr)
    );
    let output = setpiece(folder.path(), &["render", "a.pitchr", "--step", "13", "-o", "a.png"]);
    assert!(text(&output.stderr).contains("there is no step 13"), "{}", text(&output.stderr));
    let output = setpiece(folder.path(), &["run", "a.pitchr"]);
    assert!(
        text(&output.stderr).contains("`a.pitchr` is a replay, not a scenario"),
        "{}",
        text(&output.stderr)
    );
}

#[test]
fn the_same_command_draws_the_same_bytes() {
    let folder = tempfile::tempdir().unwrap();
    let draw = |name: &str, rest: &[&str]| {
        let args = [&["render", "academy_counterattack_easy", "-o", name], rest].concat();
        assert!(setpiece(folder.path(), &args).status.success());
        std::fs::read(folder.path().join(name)).unwrap()
    };
    let first = draw("a.png", &[]);
    assert_eq!(first, draw("b.png", &["--seed", "0", "--agent", "bot"]));
    for other in
        [["--seed", "1"], ["--episode", "1"], ["--agent", "idle"], ["--set", "difficulty=0"]]
    {
        assert_ne!(first, draw("c.png", &other), "{other:?}");
    }
}

#[test]
fn players_are_drawn_in_their_colours_at_their_places() {
    let film = played("academy_3_vs_1_with_keeper", Agent::Idle);
    let start = &film.scenes[0];
    let picture = drawn(&film.scenes[..1]);
    assert_eq!(start.players.len(), 6);
    for player in &start.players {
        let (team, at) = (team(player.id.team), spot(player.pos[0], player.pos[1]));
        let cloth = shirt(team, player.role == Role::GK).cloth;
        assert!(count(&picture, at, 12.0, cloth) > 80, "{player:?}");
        let opposite = spot(-player.pos[0], player.pos[1] + 3.0);
        assert_eq!(count(&picture, opposite, 5.0, cloth), 0, "{player:?}");
        let ringed = count(&picture, at, 14.0, AGENT);
        assert_eq!(player.agent, ringed > 50, "{player:?}: {ringed}");
    }
}

#[test]
fn poses_cards_and_the_way_a_player_faces_are_seen() {
    let scene = &played("academy_3_vs_1_with_keeper", Agent::Idle).scenes[0];
    let changed = |change: &dyn Fn(&mut ScenePlayer)| {
        let mut scene = scene.clone();
        change(&mut scene.players[3]);
        drawn(&[scene]).data().to_vec()
    };
    let mut pictures = vec![
        changed(&|_| {}),
        changed(&|player| player.facing = [0.0, 1.0]),
        changed(&|player| player.yellow_cards = 1),
        changed(&|player| player.agent = !player.agent),
        changed(&|player| player.posture = Posture::Sliding),
        changed(&|player| player.posture = Posture::Fallen),
        changed(&|player| player.posture = Posture::Diving),
    ];
    let all = pictures.len();
    pictures.sort();
    pictures.dedup();
    assert_eq!(pictures.len(), all);
}

#[test]
fn the_height_of_the_ball_is_seen() {
    let mut scene = played("academy_3_vs_1_with_keeper", Agent::Idle).scenes[0].clone();
    scene.ball.pos = [0.0, 20.0, 0.11];
    let white = |scene: &Scene, y_m: f32| {
        count(&drawn(std::slice::from_ref(scene)), spot(0.0, y_m), 9.0, AGENT)
    };
    let low = white(&scene, 20.0);
    assert!(low > 10);
    scene.ball.pos[2] = 9.0;
    let high = white(&scene, 20.0);
    assert!(high > low, "the higher the ball, the larger it is: {high} after {low}");
}

#[test]
fn a_trail_leads_to_a_moment_but_never_over_a_restart() {
    let film = played("academy_empty_goal", Agent::RunAndShoot);
    let way = &film.scenes[..10];
    assert_ne!(drawn(way).data(), drawn(&way[9..]).data());
    let mut placed = way.to_vec();
    placed[9].placed = true;
    assert_eq!(drawn(&placed).data(), drawn(&way[9..]).data());
}

#[test]
fn every_example_and_every_kind_of_agents_can_be_drawn() {
    let examples = Path::new(env!("CARGO_MANIFEST_DIR")).join("../examples");
    let mut seen = 0;
    for entry in std::fs::read_dir(examples).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_some_and(|ending| ending == "pitch") {
            let film = played(path.to_str().unwrap(), Agent::Random);
            assert!(sheet(&film).is_some() && frame(&film, 0).is_some(), "{}", path.display());
            seen += 1;
        }
    }
    assert!(seen >= 19, "{seen}");
    let match_of_all = played("11_vs_11_kaggle", Agent::Bot);
    assert!((4000..=30_000_000).contains(&sheet(&match_of_all).unwrap().pixels().len()));
}

#[test]
fn a_picture_that_cannot_be_made_is_one_clear_error() {
    fails(&["academy_corner"], 2, &["--output"]);
    for name in ["corner.jpg", "corner"] {
        fails(&["academy_corner", "-o", name], 1, &["SP0011", "`corner.mp4` or `corner.png`"]);
    }
    let video = ["academy_empty_goal", "-o", "a.mp4"];
    for (args, words) in [
        (["--size", "641x360"], ["SP0011", "write `--size 640x360`"]),
        (["--speed", "0"], ["SP0011", "a speed is a number in 0.05..20"]),
        (["--speed", "NaN"], ["SP0011", "a speed is a number in 0.05..20"]),
        (["--steps", "900..901"], ["SP0011", "none of 900..901"]),
        (["--step", "3"], ["SP0011", "`--steps 20..80`"]),
        (["--size", "9000x90"], ["SP0011", "1 to 8192 pixels"]),
    ] {
        fails(&[&video[..], &args].concat(), 1, &words);
    }
    for args in [["--steps", "5"], ["--steps", "9..5"], ["--size", "40"], ["--camera", "side"]] {
        fails(&[&video[..], &args].concat(), 2, &[args[0]]);
    }
    fails(&["academy_corner", "-o", "a.png", "--size", "40x40"], 1, &["SP0011", "a sheet has"]);
    fails(&["academy_corner", "-o", "no/such/folder/a.png"], 1, &["SP0001", "can't be written"]);
    fails(&["academy_cornr", "-o", "a.png"], 1, &["SP0005", "did you mean `academy_corner`?"]);
    fails(
        &["academy_corner", "-o", "a.png", "--set", "dificulty=1"],
        1,
        &["SP0008", "did you mean `difficulty`?"],
    );
    fails(&["academy_corner", "-o", "a.png", "--agent", "genius"], 2, &["--agent"]);
    fails(&["academy_corner", "-o", "a.png", "--step", "-1"], 2, &["--step"]);
    fails(
        &["academy_corner", "-o", "a.png", "--step", "9999"],
        1,
        &["SP0012", "the episode has", "help: "],
    );
}

#[test]
fn an_episode_without_an_end_is_drawn_up_to_a_step() {
    let folder = tempfile::tempdir().unwrap();
    let endless = "scenario s { ball at centre  team left { CM at (-0.1, 0) } }";
    std::fs::write(folder.path().join("endless.pitch"), endless).unwrap();
    let output = setpiece(folder.path(), &["render", "endless.pitch", "-o", "a.png"]);
    assert!(text(&output.stderr).contains("SP0703"), "{}", text(&output.stderr));
    assert!(
        setpiece(folder.path(), &["render", "endless.pitch", "-o", "a.png", "--step", "30"])
            .status
            .success()
    );
    let output = setpiece(folder.path(), &["render", "endless.pitch", "-o", "endless.pitch"]);
    assert_eq!(output.status.code(), Some(1));
    assert_eq!(std::fs::read_to_string(folder.path().join("endless.pitch")).unwrap(), endless);
}

/// Runs `render` into a file and returns its bytes.
#[cfg(feature = "video")]
fn written(name: &str, args: &[&str]) -> Vec<u8> {
    let folder = tempfile::tempdir().unwrap();
    let output = setpiece(folder.path(), &[&["render", "-o", name], args].concat());
    assert!(output.status.success(), "{args:?}: {}", text(&output.stderr));
    assert_eq!(text(&output.stderr), "", "{args:?}");
    std::fs::read(folder.path().join(name)).unwrap()
}

#[cfg(feature = "video")]
#[test]
fn an_episode_is_a_video() {
    let short = ["academy_empty_goal_close", "--steps", "0..8", "--size", "160x90"];
    let whole = written("a.mp4", &short);
    assert_eq!(&whole[4..8], b"ftyp");
    // 3 frames for each of 8 steps, and the last scene for a second.
    let folder = tempfile::tempdir().unwrap();
    let output = setpiece(folder.path(), &[&["render", "-o", "a.mp4"], &short[..]].concat());
    assert!(text(&output.stdout).contains("54 frames → a.mp4"), "{}", text(&output.stdout));
    assert_eq!(whole, written("b.mp4", &short), "the same command writes the same bytes");
    for other in [["--speed", "0.5"], ["--camera", "above"], ["--quality", "low"]] {
        assert_ne!(whole, written("c.mp4", &[&short[..], &other].concat()), "{other:?}");
    }
}

#[cfg(feature = "video")]
#[test]
fn a_gif_shows_every_frame_for_its_time() {
    let args = ["academy_empty_goal_close", "--steps", "0..8", "--size", "96x54"];
    let bytes = written("a.gif", &args);
    let mut decoder = gif::DecodeOptions::new();
    decoder.set_color_output(gif::ColorOutput::RGBA);
    let mut reader = decoder.read_info(bytes.as_slice()).unwrap();
    assert_eq!((reader.width(), reader.height()), (96, 54));
    let mut frames = 0;
    while let Some(frame) = reader.read_next_frame().unwrap() {
        assert_eq!(frame.delay, 5);
        frames += 1;
    }
    assert_eq!(frames, 2 * 8 + 20);
}

#[test]
fn a_moment_is_drawn_for_print_and_from_the_stand() {
    let folder = tempfile::tempdir().unwrap();
    let draw = |args: &[&str]| {
        let output = setpiece(folder.path(), &[&["render", "academy_corner"], args].concat());
        assert!(output.status.success(), "{}", text(&output.stderr));
    };
    draw(&["-o", "start.svg"]);
    let svg = std::fs::read_to_string(folder.path().join("start.svg")).unwrap();
    assert!(svg.starts_with("<svg") && svg.matches(">GK<").count() == 2, "{svg}");
    draw(&["-o", "later.svg", "--step", "9"]);
    assert_ne!(svg, std::fs::read_to_string(folder.path().join("later.svg")).unwrap());
    draw(&["-o", "stand.png", "--step", "9", "--camera", "broadcast", "--size", "320x180"]);
    let picture = Pixmap::load_png(folder.path().join("stand.png")).unwrap();
    assert_eq!((picture.width(), picture.height()), (320, 180));
}

#[test]
fn a_run_draws_what_its_terms_pay_over_time() {
    let folder = tempfile::tempdir().unwrap();
    let run = |args: &[&str]| {
        let args = [&["run", "academy_empty_goal_close", "-n", "5"], args].concat();
        setpiece(folder.path(), &args)
    };
    let output = run(&["--agent", "run_and_shoot", "--plot", "a.svg", "--format", "json"]);
    assert!(output.status.success(), "{}", text(&output.stderr));
    let summary: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    let picture = std::fs::read_to_string(folder.path().join("a.svg")).unwrap();
    let mean = format!("{:+.3} return", summary["mean_return"].as_f64().unwrap());
    assert!(picture.contains(&mean), "no `{mean}` in {picture}");
    assert!(run(&["--plot", "a.png"]).status.success());
    assert!(Pixmap::load_png(folder.path().join("a.png")).is_ok());
    let output = run(&["--plot", "a.pdf"]);
    assert_eq!(output.status.code(), Some(1));
    assert!(text(&output.stderr).contains("name it `a.svg`"), "{}", text(&output.stderr));
}

#[test]
fn an_episode_is_shown_live_step_by_step() {
    let folder = tempfile::tempdir().unwrap();
    let scenario = "scenario short { ball at centre  team left { CM at (-1m, 0m) }
        reward pace { give 0.5 as \"step\" }  end limit 3 steps }";
    std::fs::write(folder.path().join("short.pitch"), scenario).unwrap();
    let begin = std::time::Instant::now();
    let output = setpiece(folder.path(), &["run", "short.pitch", "-n", "1", "--live"]);
    let shown = text(&output.stdout);
    assert!(output.status.success(), "{}", text(&output.stderr));
    // The start and three steps, a tenth of a second apart.
    assert_eq!(shown.matches('┌').count(), 4, "{shown}");
    assert!(shown.contains("+1.500 pace/step") && shown.contains("0 : 0  limit"), "{shown}");
    assert!(begin.elapsed().as_secs_f64() >= 0.3);
}
