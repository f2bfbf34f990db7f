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
/// The two greens of the lawn.
pub const GRASS: [Colour; 2] = [[53, 116, 66, 255], [60, 125, 73, 255]];
/// Beside the pitch.
pub const VERGE: Colour = [44, 100, 57, 255];
/// The lines.
pub const LINE: Colour = [236, 243, 236, 205];
/// Woodwork.
pub const WOOD: Colour = [255, 255, 255, 255];
/// Shadows on the grass.
pub const SHADOW: Colour = [8, 22, 12, 110];
/// The ball.
pub const BALL: Colour = [255, 255, 255, 255];
/// Outlines on grass, and the ball's seams.
pub const DARK: Colour = [16, 20, 24, 255];
/// The ring of a player controlled by an agent.
pub const AGENT: Colour = [255, 255, 255, 255];
/// A yellow card.
pub const CARD_YELLOW: Colour = [255, 225, 40, 255];
/// A goal, in words.
pub const GOAL: Colour = [255, 214, 102, 255];
/// An ending that is a success, and one that is a failure.
pub const VERDICTS: [Colour; 2] = [[126, 211, 133, 255], [255, 130, 120, 255]];

/// The colours of a shirt.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shirt {
    /// The shirt.
    pub cloth: Colour,
    /// Its outline and the mark for the player's direction.
    pub edge: Colour,
    /// The number.
    pub number: Colour,
}

/// The shirt of a team's outfield player or keeper: the left team wears warm colours, the right
/// cool ones.
pub const fn shirt(team: Team, keeper: bool) -> Shirt {
    const BLACK: Colour = [30, 18, 0, 255];
    const WHITE: Colour = [255, 255, 255, 255];
    match (team, keeper) {
        (Team::Left, false) => {
            Shirt { cloth: [255, 176, 0, 255], edge: [92, 58, 0, 255], number: BLACK }
        }
        (Team::Left, true) => {
            Shirt { cloth: [226, 74, 28, 255], edge: [84, 22, 4, 255], number: WHITE }
        }
        (Team::Right, false) => {
            Shirt { cloth: [47, 109, 246, 255], edge: [10, 34, 100, 255], number: WHITE }
        }
        (Team::Right, true) => {
            Shirt { cloth: [96, 224, 236, 255], edge: [6, 66, 78, 255], number: [0, 34, 42, 255] }
        }
    }
}

/// A colour with another opacity, 0..1 of its own.
#[must_use]
pub fn faded(colour: Colour, share: f32) -> Colour {
    let [red, green, blue, opacity] = colour;
    [red, green, blue, (f32::from(opacity) * share.clamp(0.0, 1.0)) as u8]
}
