//! The plan: discs with numbers that show where players face, what their bodies do, where they came
//! from.

use crate::canvas::{Capsule, Mask, Raster, Wash};
use crate::color::{Rgb, WHITE, WOOD, YELLOW_CARD, kit, mixed, scaled};
use crate::math::{Vec2, ground, space, within};
use crate::scene::{Pitch, Posture, Scene, ScenePlayer};
use crate::text::{Digits, Lettering};
use crate::view::{CameraEye, CameraView};

/// Radius of a player's disc, metres; its bounds are pixels and depend on the picture.
const RADIUS_M: f32 = 0.95;
const BALL_M: f32 = 0.42;
/// Discs this large carry numbers.
const NUMBERED: f32 = 6.0;
/// Pixels per metre from which nets show their threads.
const THREADS: f32 = 4.0;
/// Shadows.
const DARK: Rgb = [6, 18, 10];

/// The plan's projection.
#[derive(Clone, Copy)]
struct PlanView {
    corner: Vec2,
    scale: f32,
    radius: f32,
    ball: f32,
}

impl PlanView {
    fn new(view: &CameraView) -> Option<PlanView> {
        let CameraEye::PlanView { corner, scale } = view.eye else { return None };
        let size = view.width.min(view.height * 3 / 2) as f32;
        let radius = (RADIUS_M * scale).max(within(size / 75.0, 1.15, 8.5));
        let ball = (BALL_M * scale).max(within(size / 150.0, 0.95, 4.2));
        Some(PlanView { corner, scale, radius, ball })
    }

    fn at(&self, x: f32, y: f32) -> Vec2 {
        (Vec2::new(x, y) - self.corner) * self.scale
    }

    fn player(&self, player: &ScenePlayer) -> Vec2 {
        let place = ground(player.pos);
        self.at(place.x, place.y)
    }
}

/// Draws goals, trails, players and the ball over the grass.
pub(crate) fn draw(
    canvas: &mut Raster<'_>,
    mask: &mut Mask,
    view: &CameraView,
    before: &[Scene],
    scene: &Scene,
    pitch: &Pitch,
) {
    let Some(plan) = PlanView::new(view) else { return };
    for side in [-1.0, 1.0] {
        goal(canvas, &plan, pitch, side);
    }
    trails(canvas, mask, &plan, before, scene);
    let ranks = |player: &ScenePlayer| {
        (player.posture == Posture::Upright, scene.ball.owner == Some(player.id))
    };
    // Who lies is below who stands, and the ball's owner is on top.
    for rank in [(false, false), (false, true), (true, false), (true, true)] {
        for player in scene.players.iter().filter(|player| player.present && ranks(player) == rank)
        {
            disc(canvas, &plan, player, scene);
        }
    }
    ball(canvas, &plan, scene);
}

fn goal(canvas: &mut Raster<'_>, plan: &PlanView, pitch: &Pitch, side: f32) {
    let (line, half, depth) = (pitch.length_m * 0.5, pitch.goal_width_m * 0.5, pitch.goal_depth_m);
    let at = |behind: f32, y: f32| plan.at((line + behind) * side, y);
    let (a, b, c, d) = (at(0.0, -half), at(depth, -half), at(depth, half), at(0.0, half));
    canvas.panel(a.min(c), a.max(c), 0.5, WHITE, 0.16);
    if plan.scale >= THREADS {
        let cells = |size: f32| within(size / 0.6 + 0.5, 1.0, 40.0) as usize;
        let (rows, columns) = (cells(2.0 * half), cells(depth));
        for row in 1..rows {
            let y = -half + 2.0 * half * row as f32 / rows as f32;
            canvas.stroke(at(0.0, y), at(depth, y), 0.4, WOOD, 0.4);
        }
        for column in 1..columns {
            let behind = depth * column as f32 / columns as f32;
            canvas.stroke(at(behind, -half), at(behind, half), 0.4, WOOD, 0.4);
        }
    }
    let width = (0.07 * plan.scale).max(0.5);
    for (from, to) in [(a, b), (b, c), (c, d)] {
        canvas.stroke(from, to, width, WOOD, 0.9);
    }
    for post in [a, d] {
        canvas.disc(post, (0.22 * plan.scale).max(0.8), WOOD, 1.0);
    }
}

/// Tails from the scenes before, back to the last that was placed.
fn trails(
    canvas: &mut Raster<'_>,
    mask: &mut Mask,
    plan: &PlanView,
    before: &[Scene],
    scene: &Scene,
) {
    if scene.placed {
        return;
    }
    let first = before.iter().rposition(|scene| scene.placed).unwrap_or(0);
    let past = &before[first..];
    let count = past.len() as f32;
    // Pairs of scenes that follow each other, with how recent the second one is.
    let pairs = past
        .iter()
        .enumerate()
        .map(|(i, then)| (then, past.get(i + 1).unwrap_or(scene), (i as f32 + 1.0) / count));
    let wash = |color| Wash { color, opacity: 0.62, squash: 1.0, soft: 0.7 };
    for player in scene.players.iter().filter(|player| player.present) {
        let tail = pairs.clone().filter_map(|(then, next, new)| {
            let find = |scene: &Scene| {
                scene.players.iter().find(|it| it.id == player.id).map(|it| plan.player(it))
            };
            let radius = plan.radius * 0.6;
            Some((
                Capsule {
                    a: find(then)?,
                    b: find(next)?,
                    ra: radius * (new - 1.0 / count),
                    rb: radius * new,
                },
                new,
            ))
        });
        mask.wash(canvas, tail, wash(kit(player).shirt));
    }
    let tail = pairs.map(|(then, next, new)| {
        let (a, b) = (space(then.ball.pos), space(next.ball.pos));
        let radius = (plan.ball * 0.55 * new).max(0.5);
        (Capsule { a: plan.at(a.x, a.y), b: plan.at(b.x, b.y), ra: radius, rb: radius }, new)
    });
    mask.wash(canvas, tail, wash(WHITE));
}

fn disc(canvas: &mut Raster<'_>, plan: &PlanView, player: &ScenePlayer, scene: &Scene) {
    let (at, radius, kit) = (plan.player(player), plan.radius, kit(player));
    let edge = mixed(kit.shirt, [0, 0, 0], 0.66);
    let facing = match player.posture {
        Posture::Diving | Posture::Sliding => [player.vel, player.facing],
        _ => [player.facing, player.vel],
    };
    let unit = |v: [f32; 2]| {
        let v = ground(v).truncate();
        (v.length() > 1e-3).then(|| v.normalize())
    };
    let ahead = facing.into_iter().find_map(unit).unwrap_or(Vec2::X);
    let across = Vec2::new(-ahead.y, ahead.x);
    let along = |forward: f32, aside: f32| at + (ahead * forward + across * aside) * radius;
    if radius < 3.0 {
        // A few pixels: the shirt alone, bright against the grass, with a hint of where it faces.
        canvas.disc(at, radius + 0.5, edge, 0.55);
        canvas.disc(along(0.7, 0.0), radius * 0.5, edge, 0.5);
        canvas.disc(at, radius, kit.shirt, 1.0);
        if player.agent {
            canvas.disc(at, radius * 0.5, WHITE, 1.0);
        }
        return;
    }
    let rim = (radius * 0.14).max(1.0);
    canvas.disc(at + Vec2::new(0.12, 0.26) * radius, radius * 1.1, DARK, 0.38);
    if scene.ball.owner == Some(player.id) {
        canvas.disc(at, radius * 1.7, WHITE, 0.28);
    }
    let body = |canvas: &mut Raster<'_>, from: f32, to: f32, wide: f32| {
        let (a, b) = (along(from, 0.0), along(to, 0.0));
        canvas.stroke(a, b, radius * wide * 0.5 + rim, edge, 1.0);
        canvas.stroke(a, b, radius * wide * 0.5, kit.shirt, 1.0);
    };
    match player.posture {
        Posture::Sliding => {
            for aside in [-0.45, 0.45] {
                canvas.stroke(along(-1.0, aside), along(-2.8, aside), radius * 0.08, WHITE, 0.5);
            }
            body(canvas, 0.0, 2.0, 0.62);
        }
        Posture::Fallen => body(canvas, -1.2, 1.5, 0.8),
        Posture::Diving => {
            body(canvas, -1.3, 1.5, 0.85);
            for aside in [-0.55, 0.55] {
                canvas.disc(along(2.0, aside), radius * 0.34 + rim * 0.7, edge, 1.0);
                canvas.disc(along(2.0, aside), radius * 0.34, WHITE, 1.0);
            }
        }
        _ => {
            canvas.triangle([along(0.2, 1.15), along(2.0, 0.0), along(0.2, -1.15)], edge, 1.0);
            canvas.triangle([along(0.4, 0.8), along(1.58, 0.0), along(0.4, -0.8)], kit.shirt, 1.0);
        }
    }
    canvas.disc(at, radius, edge, 1.0);
    let fallen = player.posture == Posture::Fallen;
    let cloth = if fallen { mixed(kit.shirt, edge, 0.5) } else { kit.shirt };
    canvas.disc(at, radius - rim, cloth, 1.0);
    if player.agent {
        canvas.ellipse(at, Vec2::splat(radius + rim * 0.9), Some(rim * 1.15), [16, 20, 24], 1.0);
        canvas.ellipse(at, Vec2::splat(radius + rim * 0.9), Some(rim * 0.7), WHITE, 1.0);
    }
    if radius >= NUMBERED && player.number > 0 {
        let digits = Digits::new(u32::from(player.number.min(99)), 1);
        let mut style = Lettering::bold(radius * 1.0, kit.number);
        style.weight = 0.17;
        style.stretch = if player.number > 9 { 0.8 } else { 1.0 };
        style.centre(canvas, digits.as_str(), at);
    }
    for card in 0..player.yellow_cards.min(2) {
        let corner = at + Vec2::new(0.6 + 0.55 * f32::from(card), -1.5) * radius;
        let size = Vec2::new(0.5, 0.75) * radius;
        canvas.panel(corner - 0.8, corner + size + 0.8, 1.0, [16, 20, 24], 0.9);
        canvas.panel(corner, corner + size, 0.8, YELLOW_CARD, 1.0);
    }
}

/// The ball: the higher, the larger, and the further from its shadow.
fn ball(canvas: &mut Raster<'_>, plan: &PlanView, scene: &Scene) {
    let place = space(scene.ball.pos);
    let high = within(place.z - 0.11, 0.0, 40.0);
    let at = plan.at(place.x, place.y);
    let radius = plan.ball * (1.0 + 0.035 * high.min(20.0));
    let shade = at + Vec2::new(0.35 + high * 0.5, 0.45 + high * 0.7) * (plan.scale * 0.5).max(0.6);
    canvas.disc(shade, radius * 1.05, DARK, 0.5 / (1.0 + high * 0.05));
    let edge = (radius * 0.28).max(0.6);
    canvas.disc(at, radius + edge * 0.6, [16, 20, 24], 0.9);
    let shape = Capsule { a: at, b: at, ra: radius, rb: radius };
    canvas.capsule(shape, 1.0, |off| {
        scaled(WHITE, within(1.0 - 0.12 * (off.x + off.y).max(0.0), 0.7, 1.0))
    });
    if radius >= 4.0 {
        canvas.disc(at, radius * 0.3, [40, 44, 50], 1.0);
    }
}
