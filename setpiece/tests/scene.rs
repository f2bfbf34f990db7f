//! What a scene says of a match, at every step of an episode.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

use setpiece::engine::control::agents::Agent;
use setpiece::engine::environment::{Environment, EnvironmentOptions, Scratch};
use setpiece::engine::random::{Purpose, Stream};
use setpiece::engine::state::player::Pose;
use setpiece::engine::state::{Match, PlayerId};
use setpiece::render::Scene;
use setpiece::render::scene::{NewsKind, Posture, ScenePlayer, Side};
use setpiece::scene::{SceneWriter, of_match, player_id};
use std::collections::BTreeSet;

fn environment(name: &str) -> Environment {
    Environment::new(setpiece::load(name).unwrap().scenario, EnvironmentOptions::default()).unwrap()
}

/// Plays an episode and looks at every scene of it.
fn play(name: &str, agent: Agent, episode: u64, look: &mut dyn FnMut(&Environment, &Scene)) {
    let mut environment = environment(name);
    environment.reset(Some(4), Some(episode)).unwrap();
    let (mut writer, mut scene) = (SceneWriter::default(), Scene::default());
    let (mut stream, mut scratch) = (Stream::new(4, episode, Purpose::Agent), Scratch::default());
    writer.begin();
    writer.write(&environment, &mut scene);
    look(&environment, &scene);
    while environment.is_running() && environment.steps() < 600 {
        let actions: Vec<_> = (0..environment.n_agents())
            .map(|slot| agent.act(environment.state(), slot, &mut stream))
            .collect();
        environment.step(&actions, &mut scratch).unwrap();
        writer.note(&environment);
        writer.write(&environment, &mut scene);
        look(&environment, &scene);
    }
}

fn agrees(game: &Match, player: &ScenePlayer) {
    let id = player_id(player.id);
    let body = game.player(id);
    assert_eq!(player.pos, body.pos.to_array());
    assert_eq!(player.vel, body.vel.to_array());
    assert_eq!(player.facing, body.body.facing.to_array());
    assert_eq!((player.tired, player.yellow_cards), (body.fatigue, body.yellow_cards));
    assert_eq!(player.present, body.active);
    assert_eq!(player.agent, game.agents.iter().any(|agent| agent.player == Some(id)));
    assert_eq!(format!("{:?}", player.role), body.role.name());
    assert_eq!(usize::from(player.number), id.in_team() + 1);
    let expected: &[Posture] = match body.body.pose {
        Pose::Up => &[Posture::Upright, Posture::Kicking, Posture::Jumping],
        Pose::Stumbling { .. } => &[Posture::Stumbling],
        Pose::Sliding => &[Posture::Sliding],
        Pose::Down => &[Posture::Fallen],
        Pose::Diving => &[Posture::Diving],
    };
    assert!(expected.contains(&player.posture), "{:?} of {:?}", player.posture, body.body.pose);
    assert!((0.0..=1.0).contains(&player.progress) && player.height_m >= 0.0);
}

#[test]
fn a_scene_says_what_the_state_says() {
    for name in ["11_vs_11_easy_stochastic", "academy_corner", "academy_3_vs_1_with_keeper"] {
        play(name, Agent::Bot, 0, &mut |environment, scene| {
            let game = environment.state();
            assert_eq!(scene.step, environment.steps());
            assert_eq!(scene.score, game.score);
            assert_eq!(scene.ball.pos, game.ball.pos.to_array());
            assert_eq!(scene.ball.vel, game.ball.vel.to_array());
            assert_eq!(scene.ball.owner.map(player_id), game.owner);
            assert_eq!(scene.players.len(), game.squad.ids().count());
            scene.players.iter().for_each(|player| agrees(game, player));
            assert_eq!(scene.possession.is_some(), game.possession.is_some());
            let paid: f64 = scene.rewards.iter().map(|term| f64::from(term.value)).sum();
            assert!((paid - environment.terms(0).iter().sum::<f64>()).abs() < 1e-5);
            assert_eq!(scene.rewards.len(), environment.term_names().len());
        });
    }
}

#[test]
fn bodies_do_in_a_scene_whatever_they_do_in_a_match() {
    let mut seen = BTreeSet::new();
    // Bots seldom slide, an agent at random often does.
    let bots = (0..5).map(|episode| (Agent::Bot, episode));
    for (agent, episode) in bots.chain([(Agent::Random, 5), (Agent::Random, 6)]) {
        play("11_vs_11_hard_stochastic", agent, episode, &mut |_, scene| {
            seen.extend(scene.players.iter().map(|player| format!("{:?}", player.posture)));
        });
    }
    let all = ["Diving", "Fallen", "Jumping", "Kicking", "Sliding", "Stumbling", "Upright"];
    let missing: Vec<_> = all.iter().filter(|posture| !seen.contains(**posture)).collect();
    assert!(missing.is_empty(), "never seen: {missing:?}");
}

#[test]
fn a_goal_is_news_of_the_team_that_scored() {
    let mut scored = None;
    play("academy_empty_goal_close", Agent::RunAndShoot, 0, &mut |environment, scene| {
        let news = scene.news.iter().find(|news| news.kind == NewsKind::Goal);
        assert_eq!(news.is_some(), environment.score() == [1, 0]);
        scored = scored.or(news.map(|news| (news.team, news.age_steps, news.number)));
    });
    let (team, age_steps, number) = scored.expect("the ball goes in");
    assert_eq!((team, age_steps), (Side::Left, 0));
    assert_eq!(number, Some(setpiece::scene::number(PlayerId(1))));
}

#[test]
fn a_scene_is_the_same_whatever_it_held_before() {
    let mut old = Scene::default();
    play("11_vs_11_easy_stochastic", Agent::Random, 1, &mut |environment, _| {
        let mut new = Scene::default();
        of_match(environment.state(), &mut new);
        of_match(environment.state(), &mut old);
        assert_eq!(new, old);
    });
}
