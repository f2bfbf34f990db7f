//! The colours: teams are distinguishable with every kind of colour vision, light on a dark page.

use crate::scenario::Team;

/// Red, green, blue, opacity.
pub type Colour = [u8; 4];

/// Around the frames.
pub const PAGE: Colour = [17, 22, 28, 255];
/// Behind a caption.
pub const CARD: Colour = [30, 37, 46, 255];
/// Text.
pub const INK: Colour = [238, 242, 245, 255];
/// Less important text.
pub const FAINT: Colour = [158, 170, 182, 255];
/// Outlines on grass, and the ball's seams.
pub const DARK: Colour = [16, 20, 24, 255];
/// The ring of a player controlled by an agent.
pub const AGENT: Colour = [255, 255, 255, 255];
/// A goal, in words.
pub const GOAL: Colour = [255, 214, 102, 255];
/// An ending that is a success, and one that is a failure.
pub const VERDICTS: [Colour; 2] = [[126, 211, 133, 255], [255, 130, 120, 255]];

/// The colours of a shirt.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ShirtColours {
    /// The shirt.
    pub cloth: Colour,
    /// The number.
    pub number: Colour,
}

/// The shirt of a team's outfield player or keeper, as pictures show it.
pub fn shirt(team: Team, keeper: bool) -> ShirtColours {
    let opaque = |[red, green, blue]: [u8; 3]| [red, green, blue, 255];
    let [cloth, number] = setpiece_render::shirt(crate::scene::side(team), keeper).map(opaque);
    ShirtColours { cloth, number }
}

/// A colour with another opacity, 0..1 of its own.
#[must_use]
pub fn faded(colour: Colour, share: f32) -> Colour {
    let [red, green, blue, opacity] = colour;
    [red, green, blue, (f32::from(opacity) * share.clamp(0.0, 1.0)) as u8]
}
