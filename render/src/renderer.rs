//! The renderer: a scene and a camera give a picture in the caller's memory.

use crate::above;
use crate::broadcast::Broadcast;
use crate::canvas::{Mask, Px, Raster};
use crate::ground::{Ground, PLAN, paint_all};
use crate::overlay::Overlays;
use crate::scene::Scene;
use crate::stands::Stands;
use crate::view::{Camera, CameraEye, CameraView, sound};
use serde::{Deserialize, Serialize};

/// Longest side of a picture, pixels. Two pictures of this size take half a gigabyte, more than any
/// screen needs.
pub const SIDE_MAX: usize = 8192;
/// Least width of a picture whose grass has a grain.
const GRAIN_FROM: usize = 320;

/// What is drawn, and from where.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Options {
    /// Where the camera is.
    pub camera: Camera,
    /// What is laid over the picture, where it has room.
    pub overlays: Overlays,
}

/// Why a picture can't be drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum RenderError {
    /// A side is 0 or too long.
    #[error("a picture is 1 to {SIDE_MAX} pixels wide and high, not {width}x{height}")]
    Size {
        /// The width asked for.
        width: usize,
        /// The height asked for.
        height: usize,
    },
    /// The caller's memory has another size than the picture.
    #[error("the picture takes {expected} bytes, and the buffer has {found}")]
    Buffer {
        /// Bytes of the picture.
        expected: usize,
        /// Bytes of the buffer.
        found: usize,
    },
}

/// Draws scenes at one size.
///
/// It keeps scratch memory and the painted surroundings, so make one and use it again: after the
/// first picture it allocates nothing, unless a scene has more players than any before. Pictures
/// don't depend on those before them.
#[derive(Debug)]
pub struct Renderer {
    width: usize,
    height: usize,
    options: Options,
    ground: Ground,
    stands: Option<Stands>,
    broadcast: Broadcast,
    mask: Mask,
    /// For pictures without an opacity.
    rgba: Vec<u8>,
}

impl Renderer {
    /// Prepares pictures of a size.
    ///
    /// # Errors
    /// [`RenderError::Size`] if a side is 0 or longer than [`SIDE_MAX`].
    pub fn new(width: usize, height: usize, options: Options) -> Result<Renderer, RenderError> {
        if !(1..=SIDE_MAX).contains(&width) || !(1..=SIDE_MAX).contains(&height) {
            return Err(RenderError::Size { width, height });
        }
        let stadium = options.camera == Camera::Broadcast;
        Ok(Renderer {
            width,
            height,
            options,
            ground: Ground::new(stadium && width >= GRAIN_FROM),
            stands: stadium.then(|| Stands::new(width, height)),
            broadcast: Broadcast::default(),
            mask: Mask::default(),
            rgba: Vec::new(),
        })
    }

    /// Width in pixels.
    pub fn width(&self) -> usize {
        self.width
    }

    /// Height in pixels.
    pub fn height(&self) -> usize {
        self.height
    }

    /// Draws a scene.
    ///
    /// - `rgba`: width · height · 4 bytes, rows from the top, red, green, blue, 255.
    ///
    /// # Errors
    /// [`RenderError::Buffer`] if `rgba` has another length.
    pub fn render(&mut self, scene: &Scene, rgba: &mut [u8]) -> Result<(), RenderError> {
        self.render_after(&[], scene, rgba)
    }

    /// [`render`](Renderer::render) with the way that led to the scene: a plan draws it as trails.
    ///
    /// - `before`: earlier scenes, the latest last. Trails go back to the last that was placed.
    ///
    /// # Errors
    /// [`RenderError::Buffer`] if `rgba` has another length.
    pub fn render_after(
        &mut self,
        before: &[Scene],
        scene: &Scene,
        rgba: &mut [u8],
    ) -> Result<(), RenderError> {
        check(rgba.len(), self.width * self.height * 4)?;
        let (px, _) = rgba.as_chunks_mut::<4>();
        self.draw(before, scene, px);
        Ok(())
    }

    /// Draws a scene as width · height · 3 bytes: red, green, blue.
    ///
    /// # Errors
    /// [`RenderError::Buffer`] if `rgb` has another length.
    pub fn render_rgb(&mut self, scene: &Scene, rgb: &mut [u8]) -> Result<(), RenderError> {
        check(rgb.len(), self.width * self.height * 3)?;
        self.draw_own(scene, |own| {
            for (to, from) in rgb.as_chunks_mut::<3>().0.iter_mut().zip(own) {
                *to = [from[0], from[1], from[2]];
            }
        });
        Ok(())
    }

    /// Draws a scene as width · height bytes of gray: see [`gray`].
    ///
    /// # Errors
    /// [`RenderError::Buffer`] if `out` has another length.
    pub fn render_gray(&mut self, scene: &Scene, out: &mut [u8]) -> Result<(), RenderError> {
        check(out.len(), self.width * self.height)?;
        self.draw_own(scene, |own| {
            for (to, from) in out.iter_mut().zip(own) {
                *to = gray([from[0], from[1], from[2]]);
            }
        });
        Ok(())
    }

    /// Draws into memory of its own and hands it over.
    fn draw_own(&mut self, scene: &Scene, take: impl FnOnce(&[Px])) {
        let mut own = std::mem::take(&mut self.rgba);
        own.resize(self.width * self.height * 4, 0);
        let (px, _) = own.as_chunks_mut::<4>();
        self.draw(&[], scene, px);
        take(px);
        self.rgba = own;
    }

    fn draw(&mut self, before: &[Scene], scene: &Scene, px: &mut [Px]) {
        let pitch = sound(&scene.pitch);
        let view =
            CameraView::new(self.options.camera, &pitch, scene.ball.pos, self.width, self.height);
        let mut canvas = Raster { px, width: self.width, height: self.height };
        if let (CameraEye::StandView(stand), Some(stands)) = (view.eye, &mut self.stands) {
            stands.paint(&mut canvas, &view, &stand, &pitch, &self.ground);
            self.broadcast.draw(&mut canvas, &mut self.mask, &view, scene, &pitch);
        } else {
            paint_all(&self.ground, &mut canvas, &view, &pitch, &PLAN);
            above::draw(&mut canvas, &mut self.mask, &view, before, scene, &pitch);
        }
        if Overlays::fit(self.width, self.height) {
            self.options.overlays.draw(&mut canvas, scene, &pitch, self.stands.is_some());
        }
    }
}

fn check(found: usize, expected: usize) -> Result<(), RenderError> {
    if found == expected { Ok(()) } else { Err(RenderError::Buffer { expected, found }) }
}

/// The brightness of a colour after Rec. 601, rounded, in whole numbers: 0.299 red, 0.587 green,
/// 0.114 blue.
#[must_use]
pub const fn gray(rgb: [u8; 3]) -> u8 {
    // Weights in 65,536ths, which is how Pillow's `convert("L")` computes it.
    let [red, green, blue] = rgb;
    ((red as u32 * 19_595 + green as u32 * 38_470 + blue as u32 * 7_471 + 0x8000) >> 16) as u8
}
