//! What is laid over a picture: the scoreboard, the radar, the banner, the reward's terms.

mod banner;
mod radar;
mod scoreboard;
mod terms;

use crate::canvas::Raster;
use crate::scene::{Pitch, Scene};

/// Least size of a picture that has room for an overlay, pixels.
const LEAST: [usize; 2] = [400, 225];

/// Which overlays are drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(default)]
pub struct Overlays {
    /// Teams, score, clock and set piece.
    pub scoreboard: bool,
    /// The whole pitch in small, in pictures from the stand.
    pub radar: bool,
    /// Goals, offsides and cards, in large letters.
    pub banner: bool,
    /// The terms of the step's reward that paid something.
    pub terms: bool,
}

impl Default for Overlays {
    fn default() -> Overlays {
        Overlays { scoreboard: true, radar: true, banner: true, terms: false }
    }
}

impl Overlays {
    /// Nothing over the picture.
    pub const NONE: Overlays =
        Overlays { scoreboard: false, radar: false, banner: false, terms: false };

    /// Whether a picture has room for them.
    pub(crate) fn fit(width: usize, height: usize) -> bool {
        width >= LEAST[0] && height >= LEAST[1]
    }

    /// Draws them.
    pub(crate) fn draw(self, canvas: &mut Raster<'_>, scene: &Scene, pitch: &Pitch, radar: bool) {
        let unit = (canvas.height as f32 / 720.0).min(canvas.width as f32 / 960.0).max(0.45);
        if self.radar && radar {
            radar::draw(canvas, scene, pitch, unit);
        }
        if self.scoreboard {
            scoreboard::draw(canvas, scene, unit);
        }
        if self.terms {
            terms::draw(canvas, scene, unit);
        }
        if self.banner {
            banner::draw(canvas, scene, unit);
        }
    }
}
