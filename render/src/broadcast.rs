//! The picture from the stand: everything that stands on the ground, the furthest first.

use crate::ball;
use crate::canvas::{Mask, Raster};
use crate::color::{ACCENTS, WOOD, scaled};
use crate::figure::BodyShape;
use crate::goal::{BANDS, Goal};
use crate::math::{Vec3, ground, sin};
use crate::pose::time_s;
use crate::scene::{Pitch, Scene};
use crate::view::CameraView;

/// Something to draw, and its y: the greater, the nearer.
#[derive(Clone, Copy, Debug)]
struct Drawable {
    y: f32,
    what: What,
}

#[derive(Clone, Copy, Debug)]
enum What {
    ScenePlayer(u32),
    Goal { right: bool, band: u8 },
    Flag { right: bool, near: bool },
    SceneBall,
}

/// Memory that is used again for each picture.
#[derive(Debug, Default)]
pub(crate) struct Broadcast {
    items: Vec<Drawable>,
}

impl Broadcast {
    /// Draws everything that stands on the ground.
    pub(crate) fn draw(
        &mut self,
        canvas: &mut Raster<'_>,
        mask: &mut Mask,
        view: &CameraView,
        scene: &Scene,
        pitch: &Pitch,
    ) {
        let goals = [-1.0, 1.0].map(|side| Goal::new(scene, pitch, side));
        let time = time_s(scene);
        self.collect(scene, pitch, &goals);
        let figure = |index: u32| {
            let player = scene.players.get(index as usize)?;
            Some(BodyShape { player, time_s: time, owner: scene.ball.owner == Some(player.id) })
        };
        for item in &self.items {
            if let What::ScenePlayer(index) = item.what
                && let Some(figure) = figure(index)
            {
                figure.below(canvas, view, mask);
            }
        }
        ball::below(canvas, view, &scene.ball);
        for item in &self.items {
            match item.what {
                What::ScenePlayer(index) => {
                    if let Some(figure) = figure(index) {
                        figure.draw(canvas, view);
                    }
                }
                What::Goal { right, band } => {
                    goals[usize::from(right)].draw(canvas, view, usize::from(band));
                }
                What::Flag { right, near } => flag(canvas, view, pitch, right, near, time),
                What::SceneBall => ball::draw(canvas, view, &scene.ball, time),
            }
        }
    }

    /// Lists everything, the furthest first.
    fn collect(&mut self, scene: &Scene, pitch: &Pitch, goals: &[Goal; 2]) {
        self.items.clear();
        for (index, player) in scene.players.iter().enumerate().filter(|(_, player)| player.present)
        {
            self.items
                .push(Drawable { y: ground(player.pos).y, what: What::ScenePlayer(index as u32) });
        }
        // A ball at someone's feet is in front of them.
        self.items.push(Drawable { y: ball::place(&scene.ball).y + 0.12, what: What::SceneBall });
        for right in [false, true] {
            for band in 0..BANDS as u8 {
                let y = goals[usize::from(right)].band_y(usize::from(band));
                self.items.push(Drawable { y, what: What::Goal { right, band } });
            }
            for near in [false, true] {
                let y = pitch.width_m * if near { 0.5 } else { -0.5 };
                self.items.push(Drawable { y, what: What::Flag { right, near } });
            }
        }
        // Sorting by insertion is stable and takes no memory; scenes have a few dozen items.
        for i in 1..self.items.len() {
            let mut at = i;
            while at > 0 && self.items[at - 1].y > self.items[at].y {
                self.items.swap(at - 1, at);
                at -= 1;
            }
        }
    }
}

/// A corner flag, which the wind moves.
fn flag(
    canvas: &mut Raster<'_>,
    view: &CameraView,
    pitch: &Pitch,
    right: bool,
    near: bool,
    time_s: f32,
) {
    let side = if right { 1.0 } else { -1.0 };
    let foot =
        Vec3::new(side * pitch.length_m * 0.5, pitch.width_m * if near { 0.5 } else { -0.5 }, 0.0);
    let wave = sin(time_s * std::f32::consts::TAU * 0.8 + side) * 0.07;
    let points = [
        foot,
        foot + Vec3::Z * 1.5,
        foot + Vec3::Z * 1.48,
        foot + Vec3::new(0.46, 0.0, 1.3 + wave),
        foot + Vec3::Z * 1.12,
    ]
    .map(|point| view.spot(point));
    let [Some(low), Some(high), Some(a), Some(b), Some(c)] = points else { return };
    if low.scale < 3.0 {
        canvas.stroke(low.at, high.at, 0.35, WOOD, 0.7);
        return;
    }
    canvas.triangle([a.at, b.at, c.at], scaled(ACCENTS[usize::from(right)], 0.95), 1.0);
    canvas.stroke(low.at, high.at, (0.03 * low.scale).max(0.5), WOOD, 1.0);
}
