//! Colours, and the kits: one accent per team, distinct with every kind of colour vision.

use crate::scene::{Role, ScenePlayer, Side};

/// Red, green, blue.
pub(crate) type Rgb = [u8; 3];

pub(crate) const WHITE: Rgb = [255, 255, 255];
/// Panels behind text.
pub(crate) const PANEL: Rgb = [15, 20, 28];
/// Text on a panel.
pub(crate) const INK: Rgb = [240, 244, 248];
/// Text that says less.
pub(crate) const FAINT: Rgb = [160, 172, 186];
/// Lines on grass.
pub(crate) const LINE: Rgb = [238, 246, 238];
/// Woodwork and net.
pub(crate) const WOOD: Rgb = [250, 252, 255];
/// The ring of a player that an agent plays is the team's accent on white.
pub(crate) const RING: Rgb = [255, 255, 255];
/// The ball on the radar.
pub(crate) const BALL: Rgb = [255, 255, 255];
pub(crate) const YELLOW_CARD: Rgb = [255, 222, 40];
pub(crate) const RED_CARD: Rgb = [226, 40, 44];

/// The accents of the two teams: amber and blue differ in hue and in lightness.
pub(crate) const ACCENTS: [Rgb; 2] = [[255, 170, 20], [38, 96, 228]];

/// What a player wears.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Kit {
    pub(crate) shirt: Rgb,
    pub(crate) sleeve: Rgb,
    pub(crate) shorts: Rgb,
    pub(crate) socks: Rgb,
    pub(crate) number: Rgb,
    /// Hands: skin, or a keeper's gloves.
    pub(crate) gloves: Option<Rgb>,
}

const KITS: [[Kit; 2]; 2] = [
    [
        Kit {
            shirt: ACCENTS[0],
            sleeve: [240, 150, 10],
            shorts: [46, 34, 30],
            socks: [255, 170, 20],
            number: [40, 24, 8],
            gloves: None,
        },
        Kit {
            shirt: [206, 52, 40],
            sleeve: [186, 44, 36],
            shorts: [150, 34, 30],
            socks: [206, 52, 40],
            number: WHITE,
            gloves: Some([245, 245, 235]),
        },
    ],
    [
        Kit {
            shirt: ACCENTS[1],
            sleeve: [30, 80, 205],
            shorts: [240, 243, 248],
            socks: [38, 96, 228],
            number: WHITE,
            gloves: None,
        },
        Kit {
            shirt: [96, 222, 232],
            sleeve: [76, 204, 216],
            shorts: [40, 140, 156],
            socks: [96, 222, 232],
            number: [0, 40, 50],
            gloves: Some([245, 245, 235]),
        },
    ],
];

/// A player's kit.
pub(crate) fn kit(player: &ScenePlayer) -> &'static Kit {
    &KITS[player.id.team.index()][usize::from(player.role == Role::GK)]
}

/// The colours of a shirt and of its number, for who labels pictures.
pub fn shirt(side: Side, is_keeper: bool) -> [Rgb; 2] {
    let kit = &KITS[side.index()][usize::from(is_keeper)];
    [kit.shirt, kit.number]
}

/// Skin, from dark to light, and the hair that goes with it.
const FACES: [(Rgb, Rgb); 6] = [
    ([104, 68, 48], [22, 18, 18]),
    ([236, 192, 160], [92, 58, 32]),
    ([150, 102, 72], [26, 20, 18]),
    ([224, 176, 140], [38, 28, 24]),
    ([242, 204, 174], [196, 152, 88]),
    ([190, 138, 102], [30, 24, 22]),
];

/// A player's skin and hair, the same in every scene.
pub(crate) fn face(player: &ScenePlayer) -> (Rgb, Rgb) {
    // Neighbours of a team look different, and so do the two teams.
    let pick = usize::from(player.id.slot) * 5
        + usize::from(player.id.slot) / 6
        + player.id.team.index() * 3
        + 1;
    FACES[pick % FACES.len()]
}

/// A colour times a factor.
pub(crate) fn scaled(color: Rgb, by: f32) -> Rgb {
    color.map(|part| (f32::from(part) * by) as u8)
}

/// The colour `share` of the way from `a` to `b`.
pub(crate) fn mixed(a: Rgb, b: Rgb, share: f32) -> Rgb {
    [0, 1, 2].map(|i| (f32::from(a[i]) + (f32::from(b[i]) - f32::from(a[i])) * share) as u8)
}
