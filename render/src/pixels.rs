//! Pictures as observations of an agent.

use crate::renderer::{Options, RenderError, Renderer};
use crate::scene::Scene;
use serde::{Deserialize, Serialize};

/// The shape of an observation in pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Pixels {
    /// Rows.
    pub height: usize,
    /// Columns.
    pub width: usize,
    /// One byte of gray per pixel, not three of colour.
    pub gray: bool,
}

impl Pixels {
    /// 72 rows of 96 pixels in colour.
    pub const SMALL: Pixels = Pixels { height: 72, width: 96, gray: false };
    /// 72 rows of 96 pixels in gray.
    pub const SMALL_GRAY: Pixels = Pixels { height: 72, width: 96, gray: true };

    /// Bytes per pixel.
    pub const fn channels(self) -> usize {
        if self.gray { 1 } else { 3 }
    }

    /// Bytes of one observation.
    pub const fn len(self) -> usize {
        self.height * self.width * self.channels()
    }

    /// Whether an observation has no bytes.
    pub const fn is_empty(self) -> bool {
        self.len() == 0
    }
}

/// Writes observations in pixels.
#[derive(Debug)]
pub struct PixelObserver {
    pixels: Pixels,
    renderer: Renderer,
}

impl PixelObserver {
    /// Prepares observations of a shape.
    ///
    /// # Errors
    /// [`RenderError::Size`] for sides that can't be drawn.
    pub fn new(pixels: Pixels, options: Options) -> Result<PixelObserver, RenderError> {
        Ok(PixelObserver { pixels, renderer: Renderer::new(pixels.width, pixels.height, options)? })
    }

    /// The shape.
    pub fn pixels(&self) -> Pixels {
        self.pixels
    }

    /// Writes the observation of a scene: rows from the top, [`Pixels::channels`] bytes per pixel.
    ///
    /// # Errors
    /// [`RenderError::Buffer`] if `out` has another length than [`Pixels::len`].
    pub fn observe(&mut self, scene: &Scene, out: &mut [u8]) -> Result<(), RenderError> {
        if self.pixels.gray {
            self.renderer.render_gray(scene, out)
        } else {
            self.renderer.render_rgb(scene, out)
        }
    }
}
