//! Teams: players and their places.

use super::{Expr, Field, Ident, Span, Spanned};
use setpiece_scenario::vocabulary::Role;

/// A statement of a team or formation.
#[derive(Clone, Debug, PartialEq)]
pub struct TeamStmt {
    /// Its span.
    pub span: Span,
    /// What it is.
    pub kind: TeamStmtKind,
}

/// What a statement of a team is.
#[derive(Clone, Debug, PartialEq)]
pub enum TeamStmtKind {
    /// `[NAME:] [3] ROLE [PLACE] …`
    Player(PlayerStmt),
    /// `place NAME|ROLE PLACE …`
    Override {
        /// Who.
        who: Ident,
        /// What changes.
        change: PlayerStmt,
    },
    /// `each outfield|all|ROLE { … }`
    Each {
        /// Whose.
        who: Ident,
        /// Their defaults.
        fields: Vec<Field>,
    },
    /// `GK absent`
    Absent(Spanned<Role>),
    /// `difficulty: …`, `formation: …`
    Field(Field),
    /// Something that could not be read; a problem tells why.
    Broken,
}

/// A player.
#[derive(Clone, Debug, PartialEq)]
pub struct PlayerStmt {
    /// The name before the colon.
    pub name: Option<Ident>,
    /// `maybe 30%`: the share of episodes with this player.
    pub maybe: Option<Expr>,
    /// The least number, if it is drawn: `3..5`.
    pub least: Option<Spanned<u32>>,
    /// How many, at most.
    pub count: Option<Spanned<u32>>,
    /// The role; in a `place` override whatever stands for it.
    pub role: Spanned<Role>,
    /// Where.
    pub place: Option<Place>,
    /// `facing …`
    pub facing: Option<Facing>,
    /// `jitter …`
    pub jitter: Option<Expr>,
    /// `when …`
    pub when: Option<Expr>,
    /// Options.
    pub fields: Vec<Field>,
}

/// `facing [away from] …`
#[derive(Clone, Debug, PartialEq)]
pub struct Facing {
    /// `away from`
    pub away: bool,
    /// A point, or an angle.
    pub target: Expr,
}

/// A place.
#[derive(Clone, Debug, PartialEq)]
pub struct Place {
    /// All of it.
    pub span: Span,
    /// Which form.
    pub kind: PlaceKind,
}

/// The forms of a place.
#[derive(Clone, Debug, PartialEq)]
pub enum PlaceKind {
    /// `at POINT`
    At(Expr),
    /// `in REGION`
    In(Expr),
    /// `ahead of X by D`, `behind X by D`, `left of X by D`, `right of X by D`
    Relative {
        /// `ahead`, `behind`, `left` or `right`.
        direction: Ident,
        /// Whose.
        of: Expr,
        /// How far.
        by: Expr,
    },
    /// `between A and B [at S]`
    Between {
        /// From.
        a: Expr,
        /// To.
        b: Expr,
        /// The share of the way; half if absent.
        at: Option<Expr>,
    },
    /// `beyond X by D from Y`
    Beyond {
        /// What lies between.
        of: Expr,
        /// How far beyond.
        by: Expr,
        /// Seen from where.
        from: Expr,
    },
    /// `offset from X along ANGLE by D`
    Offset {
        /// From.
        from: Expr,
        /// Along.
        along: Expr,
        /// How far.
        by: Expr,
    },
}
