//! A player from the stand: a figure of tapered, shaded capsules, with fewer of them the smaller it
//! is.

use crate::canvas::{Capsule, Mask, Raster, Wash};
use crate::color::{ACCENTS, Kit, RING, Rgb, YELLOW_CARD, face, kit, scaled};
use crate::math::{Vec2, Vec3, ground, space, unit_or, within};
use crate::pose::LimbPose;
use crate::scene::{Posture, ScenePlayer};
use crate::skeleton::{GROWN, Skeleton};
use crate::text::{Digits, Lettering};
use crate::view::{CameraView, Spot};

/// Pixels per metre from which a figure has all its parts, and from which it has limbs at all.
const FULL: f32 = 12.0;
const LIMBS: f32 = 5.5;
/// Pixels per metre from which a shirt shows its number.
const NUMBERED: f32 = 15.0;
/// Most parts of a figure.
const PARTS: usize = 28;
/// Where the light comes from: left, above, and from the camera's side.
const LIGHT: Vec3 = Vec3::new(-0.42, -0.62, 0.66);
/// The colour of shadows on grass.
const SHADE: Rgb = [8, 26, 12];
/// Where a shadow falls, metres per metre of height.
const CAST: Vec2 = Vec2::new(0.42, -0.3);

/// A capsule of a figure, and how far it is from the camera.
#[derive(Clone, Copy)]
struct BodyPart {
    shape: Capsule,
    color: Rgb,
    away: f32,
}

/// The parts of a figure, the furthest first.
struct BodyParts {
    list: [BodyPart; PARTS],
    count: usize,
}

/// How a figure is drawn.
#[derive(Clone, Copy)]
pub(crate) struct BodyShape<'a> {
    pub(crate) player: &'a ScenePlayer,
    pub(crate) time_s: f32,
    pub(crate) owner: bool,
}

impl BodyShape<'_> {
    /// Draws what lies on the ground: the shadow, and the ring of a player that an agent plays.
    pub(crate) fn below(&self, canvas: &mut Raster<'_>, view: &CameraView, mask: &mut Mask) {
        let at = ground(self.player.pos);
        let Some(foot) = view.spot(at) else { return };
        if !near(canvas, &foot) {
            return;
        }
        let squash = view.squash();
        if foot.scale < LIMBS {
            let radii =
                Vec2::new((0.5 * foot.scale).max(0.8), (0.5 * foot.scale * squash).max(0.5));
            canvas.ellipse(foot.at, radii, None, [10, 24, 12], 0.4);
        } else {
            let skeleton = Skeleton::new(&LimbPose::of(self.player, self.time_s), at);
            let capsules = shadow(&skeleton, view);
            let wash =
                Wash { color: SHADE, opacity: 0.52, squash, soft: (foot.scale * 0.05).max(0.7) };
            mask.wash(canvas, capsules.iter().map(|shape| (*shape, 1.0)), wash);
        }
        if self.player.agent {
            let radius = (0.78 * foot.scale).max(1.6);
            let line = (0.042 * foot.scale).max(0.45);
            let radii = Vec2::new(radius, radius * squash);
            let accent = ACCENTS[self.player.id.team.index()];
            if foot.scale >= LIMBS {
                canvas.ellipse(foot.at, radii, None, accent, 0.28);
                canvas.ellipse(foot.at, radii, Some(line * 1.8), scaled(accent, 0.55), 0.8);
            }
            canvas.ellipse(foot.at, radii, Some(line), RING, 0.95);
        }
    }

    /// Draws the figure.
    pub(crate) fn draw(&self, canvas: &mut Raster<'_>, view: &CameraView) {
        let at = ground(self.player.pos);
        let Some(foot) = view.spot(at) else { return };
        if !near(canvas, &foot) {
            return;
        }
        if foot.scale < LIMBS {
            self.tiny(canvas, view, at, &foot);
            return;
        }
        let skeleton = Skeleton::new(&LimbPose::of(self.player, self.time_s), at);
        let mut parts = BodyParts::new();
        if foot.scale >= FULL {
            full(&mut parts, &skeleton, self.player, view);
        } else {
            simple(&mut parts, &skeleton, self.player, view);
        }
        parts.sort();
        for part in &parts.list[..parts.count] {
            let color = part.color;
            canvas.capsule(part.shape, 1.0, |off| lit(color, off));
        }
        if foot.scale >= NUMBERED {
            number(canvas, view, &skeleton, self.player);
        }
        self.tags(canvas, view, &skeleton, &foot);
    }

    /// A figure of a few pixels: legs, trunk, head.
    fn tiny(&self, canvas: &mut Raster<'_>, view: &CameraView, at: Vec3, foot: &Spot) {
        let (kit, (skin, _)) = (kit(self.player), face(self.player));
        let lift =
            if self.player.height_m.is_nan() { 0.0 } else { self.player.height_m.clamp(0.0, 3.0) };
        let way = unit_or(space([self.player.vel[0], self.player.vel[1], 0.0]), Vec3::ZERO);
        let (up, hips) = match self.player.posture {
            Posture::Sliding => (Vec3::Z * 0.5 - way * 0.8, 0.25),
            Posture::Fallen => {
                (-unit_or(space([self.player.facing[0], self.player.facing[1], 0.0]), Vec3::X), 0.2)
            }
            Posture::Diving => (way + Vec3::Z * 0.25, 0.6),
            _ => (Vec3::Z, 0.85),
        };
        let at = at + Vec3::Z * lift;
        let hips = at + Vec3::Z * hips;
        let feet = if up == Vec3::Z { at } else { hips - up * 0.8 };
        let spots = [feet, hips, hips + up * 0.5, hips + up * 0.85].map(|p| view.spot(p));
        let [Some(feet), Some(hips), Some(chest), Some(head)] = spots else { return };
        let wide = (0.26 * foot.scale).max(0.72);
        canvas.stroke(feet.at, hips.at, wide * 0.8, kit.shorts, 1.0);
        let trunk = Capsule { a: hips.at, b: chest.at, ra: wide, rb: wide * 1.12 };
        canvas.capsule(trunk, 1.0, |_| kit.shirt);
        canvas.disc(head.at, (0.16 * foot.scale).max(0.5), skin, 1.0);
    }

    /// A booked player's card, and the mark of who has the ball.
    fn tags(&self, canvas: &mut Raster<'_>, view: &CameraView, skeleton: &Skeleton, foot: &Spot) {
        let Some(head) = view.spot(skeleton.head + Vec3::Z * 0.35) else { return };
        let size = (foot.scale * 0.13).max(2.0);
        let mut at = head.at - Vec2::new(0.0, size * 0.6);
        if self.owner {
            let color = ACCENTS[self.player.id.team.index()];
            let wide = size * 1.25;
            let corners = |grow: f32| {
                [
                    at + Vec2::new(-wide - grow, -wide - grow),
                    at + Vec2::new(wide + grow, -wide - grow),
                    at + Vec2::new(0.0, wide * 0.35 + grow * 1.4),
                ]
            };
            canvas.triangle(corners(1.0), [14, 18, 24], 0.75);
            canvas.triangle(corners(0.0), color, 1.0);
            at.y -= size * 2.2;
        }
        if self.player.yellow_cards > 0 {
            let half = Vec2::new(size * 0.62, size * 0.85);
            let at = at + Vec2::new(size * 1.3, -size * 0.2);
            canvas.panel(at - half - 0.8, at + half + 0.8, size * 0.3, [20, 20, 16], 0.8);
            canvas.panel(at - half, at + half, size * 0.2, YELLOW_CARD, 1.0);
        }
    }
}

/// Whether anything of a figure can be in the picture.
fn near(canvas: &Raster<'_>, foot: &Spot) -> bool {
    let pad = 4.0 * foot.scale + 4.0;
    let (width, height) = (canvas.width as f32, canvas.height as f32);
    foot.at.x > -pad && foot.at.x < width + pad && foot.at.y > -pad && foot.at.y < height + pad
}

/// The colour of a point of a capsule, from its offset to the axis.
#[inline]
fn lit(color: Rgb, off: Vec2) -> Rgb {
    let bulge = (1.0 - off.x * off.x - off.y * off.y).max(0.0).sqrt();
    let light = off.x * LIGHT.x + off.y * LIGHT.y + bulge * LIGHT.z;
    let by = (0.61 + 0.51 * light.max(-0.25)) * 256.0;
    let by = by as u32;
    color.map(|part| ((u32::from(part) * by) >> 8).min(255) as u8)
}

/// The shadow's capsules on the screen.
fn shadow(skeleton: &Skeleton, view: &CameraView) -> [Capsule; 9] {
    let flat = |p: Vec3| {
        let on = Vec3::new(p.x + p.z * CAST.x, p.y + p.z * CAST.y, 0.0);
        view.spot(on).unwrap_or(Spot { at: Vec2::splat(-1e4), scale: 1.0 })
    };
    let bar = |a: Vec3, b: Vec3, ra: f32, rb: f32| {
        let (a, b) = (flat(a), flat(b));
        Capsule { a: a.at, b: b.at, ra: ra * a.scale, rb: rb * b.scale }
    };
    let s = skeleton;
    [
        bar(s.hip[0], s.knee[0], 0.12, 0.08),
        bar(s.hip[1], s.knee[1], 0.12, 0.08),
        bar(s.knee[0], s.ankle[0], 0.08, 0.07),
        bar(s.knee[1], s.ankle[1], 0.08, 0.07),
        bar(s.hips, s.chest, 0.16, 0.2),
        bar(s.shoulder[0], s.elbow[0], 0.08, 0.06),
        bar(s.shoulder[1], s.elbow[1], 0.08, 0.06),
        bar(s.ankle[0], s.toe[0], 0.1, 0.07),
        bar(s.head, s.head, 0.13, 0.13),
    ]
}

/// Every part.
fn full(parts: &mut BodyParts, s: &Skeleton, player: &ScenePlayer, view: &CameraView) {
    let kit: &Kit = kit(player);
    let (skin, hair) = face(player);
    let boot = [32, 32, 36];
    let hand = kit.gloves.unwrap_or(skin);
    let palm = if kit.gloves.is_some() { 0.075 } else { 0.05 };
    for side in [0, 1] {
        let (hip, knee, ankle) = (s.hip[side], s.knee[side], s.ankle[side]);
        let hem = hip.lerp(knee, 0.62);
        let sock = knee.lerp(ankle, 0.3);
        parts.add(view, hem, knee, 0.088, 0.068, skin);
        parts.add(view, hip, hem, 0.125, 0.112, kit.shorts);
        parts.add(view, knee, sock, 0.068, 0.064, skin);
        parts.add(view, sock, ankle, 0.074, 0.056, kit.socks);
        parts.add(view, ankle - Vec3::Z * 0.02, s.toe[side], 0.06, 0.05, boot);
        let (shoulder, elbow) = (s.shoulder[side], s.elbow[side]);
        let cuff = shoulder.lerp(elbow, 0.62);
        let long = kit.gloves.is_some();
        parts.add(view, cuff, elbow, 0.06, 0.05, if long { kit.sleeve } else { skin });
        parts.add(view, elbow, s.hand[side], 0.05, 0.04, if long { kit.sleeve } else { skin });
        parts.add(view, s.hand[side], s.hand[side], palm, palm, hand);
        parts.add(view, shoulder, cuff, 0.088, 0.074, kit.sleeve);
    }
    parts.add(view, s.hip[0], s.hip[1], 0.125, 0.125, kit.shorts);
    let waist = s.hips + s.up * 0.12;
    parts.add(view, waist, s.chest - s.up * 0.12, 0.145, 0.178, kit.shirt);
    parts.add(view, s.shoulder[0], s.shoulder[1], 0.088, 0.088, kit.shirt);
    parts.add(view, s.neck, s.head, 0.055, 0.05, skin);
    parts.add(view, s.head, s.head - s.up * 0.03 + s.front * 0.01, 0.108, 0.09, skin);
    let crown = s.head + s.up * 0.045 - s.front * 0.035;
    parts.add(view, crown, crown - s.front * 0.02, 0.1, 0.098, hair);
}

/// Fewer parts.
fn simple(parts: &mut BodyParts, s: &Skeleton, player: &ScenePlayer, view: &CameraView) {
    let kit = kit(player);
    let (skin, hair) = face(player);
    for side in [0, 1] {
        parts.add(view, s.hip[side], s.knee[side], 0.13, 0.09, kit.shorts);
        parts.add(view, s.knee[side], s.ankle[side], 0.085, 0.075, kit.socks);
        parts.add(view, s.elbow[side], s.hand[side], 0.065, 0.06, kit.gloves.unwrap_or(skin));
        parts.add(view, s.shoulder[side], s.elbow[side], 0.095, 0.075, kit.sleeve);
    }
    parts.add(view, s.hips, s.chest - s.up * 0.06, 0.17, 0.21, kit.shirt);
    parts.add(view, s.head, s.head, 0.125, 0.125, skin);
    let crown = s.head + s.up * 0.05 - s.front * 0.04;
    parts.add(view, crown, crown, 0.11, 0.11, hair);
}

impl BodyParts {
    fn new() -> BodyParts {
        let none = Capsule { a: Vec2::ZERO, b: Vec2::ZERO, ra: 0.0, rb: 0.0 };
        BodyParts { list: [BodyPart { shape: none, color: [0; 3], away: 0.0 }; PARTS], count: 0 }
    }

    fn add(&mut self, view: &CameraView, a: Vec3, b: Vec3, ra: f32, rb: f32, color: Rgb) {
        let (ra, rb) = (ra * GROWN, rb * GROWN);
        let (Some(from), Some(to)) = (view.spot(a), view.spot(b)) else { return };
        let shape = Capsule {
            a: from.at,
            b: to.at,
            ra: (ra * from.scale).max(0.6),
            rb: (rb * to.scale).max(0.6),
        };
        // The nearest point counts: a shirt lies over the shorts that it hangs over.
        let depth = |p: Vec3, radius: f32| -p.y * 0.89 - p.z * 0.45 - radius;
        let away = (depth(a, ra) + depth(b, rb)) * 0.5;
        if let Some(place) = self.list.get_mut(self.count) {
            *place = BodyPart { shape, color, away };
            self.count += 1;
        }
    }

    /// Puts the furthest first; parts at one distance stay in order.
    fn sort(&mut self) {
        let parts = &mut self.list[..self.count];
        for i in 1..parts.len() {
            let mut at = i;
            while at > 0 && parts[at - 1].away < parts[at].away {
                parts.swap(at - 1, at);
                at -= 1;
            }
        }
    }
}

/// The number on chest or back, as far as it faces the camera.
fn number(canvas: &mut Raster<'_>, view: &CameraView, skeleton: &Skeleton, player: &ScenePlayer) {
    if player.number == 0 {
        return;
    }
    let shown = skeleton.front.y;
    let upright = skeleton.up.z;
    if shown.abs() < 0.5 || upright < 0.7 {
        return;
    }
    let middle = skeleton.hips.lerp(skeleton.chest, 0.66);
    let side = if shown > 0.0 { 0.14 } else { -0.14 };
    let Some(spot) = view.spot(middle + skeleton.front * side) else { return };
    let digits = Digits::new(u32::from(player.number.min(99)), 1);
    let mut style = Lettering::bold(0.3 * spot.scale, kit(player).number);
    style.weight = 0.2;
    style.stretch =
        within(shown.abs() * 1.1 - 0.1, 0.4, 1.0) * if player.number > 9 { 0.62 } else { 0.9 };
    style.centre(canvas, digits.as_str(), spot.at);
}
