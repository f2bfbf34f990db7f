//! Scenes between two steps.

use crate::math::within;
use crate::scene::{Posture, Scene};

/// Writes the scene at a share of the way from one scene to the next, 0..1.
///
/// Places and directions move along straight lines. Everything else is as in the first scene. The
/// two must follow each other: nothing leads to a scene that was [placed](Scene::placed).
pub fn between(from: &Scene, to: &Scene, share: f32, scene: &mut Scene) {
    scene.clone_from(from);
    let share = within(share, 0.0, 1.0);
    if to.placed {
        return;
    }
    scene.between = share;
    scene.ball.pos = mixed(from.ball.pos, to.ball.pos, share);
    scene.ball.vel = mixed(from.ball.vel, to.ball.vel, share);
    for player in &mut scene.players {
        let Some(next) = to.players.iter().find(|next| next.id == player.id) else { continue };
        player.pos = mixed(player.pos, next.pos, share);
        player.vel = mixed(player.vel, next.vel, share);
        player.facing = mixed(player.facing, next.facing, share);
        player.height_m += (next.height_m - player.height_m) * share;
        // A posture that begins again doesn't run backwards.
        if player.posture == next.posture && next.progress >= player.progress {
            player.progress += (next.progress - player.progress) * share;
        } else if next.posture == Posture::Kicking && player.posture == Posture::Upright {
            (player.posture, player.progress) = (Posture::Kicking, next.progress * share);
        }
    }
}

fn mixed<const N: usize>(from: [f32; N], to: [f32; N], share: f32) -> [f32; N] {
    std::array::from_fn(|axis| from[axis] + (to[axis] - from[axis]) * share)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Id, ScenePlayer};

    fn at(x: f32, facing: [f32; 2]) -> Scene {
        let id = Id { slot: 3, ..Id::default() };
        let mut scene = Scene {
            players: vec![ScenePlayer { id, pos: [x, 0.0], facing, ..ScenePlayer::default() }],
            ..Scene::default()
        };
        scene.ball.pos = [x, 1.0, 2.0];
        scene
    }

    #[test]
    fn everything_moves_in_a_straight_line() {
        let (from, to) = (at(1.0, [1.0, 0.0]), at(2.0, [0.0, 1.0]));
        let mut scene = Scene::default();
        between(&from, &to, 0.25, &mut scene);
        assert_eq!((scene.ball.pos[0], scene.players[0].pos[0]), (1.25, 1.25));
        assert_eq!(scene.players[0].facing, [0.75, 0.25]);
        between(&from, &to, 0.0, &mut scene);
        assert_eq!(scene, from);
    }

    #[test]
    fn nothing_leads_to_a_restart() {
        let (from, mut to) = (at(1.0, [1.0, 0.0]), at(2.0, [1.0, 0.0]));
        to.placed = true;
        let mut scene = Scene::default();
        between(&from, &to, 0.5, &mut scene);
        assert_eq!(scene, from);
    }
}
