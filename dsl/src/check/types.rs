//! The types of expressions: the language's own, with units as exponents.

pub(crate) use setpiece_scenario::Dimension as Dim;
use setpiece_scenario::vocabulary::{Type, Unit};

/// The type of an expression.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Ty {
    /// Of a broken expression: agrees with everything, so that one mistake gives one report.
    Error,
    /// A plain number.
    Number,
    /// A whole number.
    Int,
    /// A share, written `60%`.
    Percent,
    /// A number with a unit.
    Quantity(Dim),
    /// A truth value.
    Bool,
    /// A place on the pitch, metres in the world frame.
    Point,
    /// A difference of places, metres.
    Vector,
    /// A velocity, m/s.
    Velocity,
    /// A part of the pitch.
    Region,
    /// A player, or nobody.
    Player,
    /// The ball.
    Ball,
    /// Some players.
    Set,
    /// A team.
    Team,
    /// Places for a team.
    Formation,
    /// A word.
    String,
    /// A game mode.
    Mode,
    /// A role.
    Role,
    /// A player's action.
    Action,
    /// A list of values.
    List,
    /// The goals of both teams.
    Score,
    /// The event of an `on` block.
    Event,
}

impl Ty {
    /// A length.
    pub(crate) const LENGTH: Ty = Ty::Quantity(Dim::LENGTH);
    /// A duration.
    pub(crate) const DURATION: Ty = Ty::Quantity(Dim::DURATION);
    /// A speed.
    pub(crate) const SPEED: Ty = Ty::Quantity(Dim::SPEED);
    /// An angle.
    pub(crate) const ANGLE: Ty = Ty::Quantity(Dim::ANGLE);

    /// A type that is written in a declaration.
    pub(crate) fn of(ty: Type) -> Ty {
        match ty {
            Type::Number => Ty::Number,
            Type::Int => Ty::Int,
            Type::Bool => Ty::Bool,
            Type::Percent => Ty::Percent,
            Type::Length => Ty::LENGTH,
            Type::Duration => Ty::DURATION,
            Type::Speed => Ty::SPEED,
            Type::Angle => Ty::ANGLE,
            Type::Point => Ty::Point,
            Type::Vector => Ty::Vector,
            Type::Region => Ty::Region,
            Type::Player => Ty::Player,
            Type::Set => Ty::Set,
            Type::Team => Ty::Team,
            Type::Formation => Ty::Formation,
            Type::Behavior => Ty::Error,
            Type::String => Ty::String,
            Type::Mode => Ty::Mode,
            Type::Role => Ty::Role,
            Type::Action => Ty::Action,
        }
    }

    /// The type of a scenario's parameter; `None` where a parameter can't be of this type.
    pub(crate) fn param(self) -> Option<Type> {
        Some(match self {
            Ty::Number => Type::Number,
            Ty::Int => Type::Int,
            Ty::Bool => Type::Bool,
            Ty::Percent => Type::Percent,
            Ty::LENGTH => Type::Length,
            Ty::DURATION => Type::Duration,
            Ty::SPEED => Type::Speed,
            Ty::ANGLE => Type::Angle,
            Ty::Team => Type::Team,
            Ty::String => Type::String,
            _ => return None,
        })
    }

    /// The word by which a declaration asks for such a value; `None` where there is none.
    pub(crate) fn written(self) -> Option<&'static str> {
        Some(match self {
            Ty::Point | Ty::Ball => Type::Point.name(),
            Ty::Vector => Type::Vector.name(),
            Ty::Region => Type::Region.name(),
            Ty::Player => Type::Player.name(),
            Ty::Set => Type::Set.name(),
            Ty::Formation => Type::Formation.name(),
            Ty::Mode => Type::Mode.name(),
            Ty::Role => Type::Role.name(),
            ty => ty.param()?.name(),
        })
    }

    /// The type of a number with a unit.
    pub(crate) fn of_unit(unit: Unit) -> Ty {
        Ty::of(unit.ty())
    }

    /// The exponents of a number; `None` of anything else.
    pub(crate) fn dim(self) -> Option<Dim> {
        match self {
            Ty::Number | Ty::Int | Ty::Percent => Some(Dim::NONE),
            Ty::Quantity(dim) => Some(dim),
            _ => None,
        }
    }

    /// The type of a number with these exponents.
    pub(crate) fn with_dim(dim: Dim) -> Ty {
        if dim == Dim::NONE { Ty::Number } else { Ty::Quantity(dim) }
    }

    /// Whether it is a number without a unit.
    pub(crate) fn is_plain(self) -> bool {
        self.dim() == Some(Dim::NONE)
    }

    /// Whether it has a place on the pitch.
    pub(crate) fn is_place(self) -> bool {
        matches!(self, Ty::Point | Ty::Player | Ty::Ball)
    }

    /// Whether a value of this type may stand where `wanted` is asked for.
    pub(crate) fn fits(self, wanted: Ty) -> bool {
        self == wanted
            || self == Ty::Error
            || wanted == Ty::Error
            || match wanted {
                Ty::Number | Ty::Percent => self.is_plain(),
                Ty::Point => self.is_place(),
                Ty::Set => matches!(self, Ty::Team),
                _ => false,
            }
    }

    /// The type of `a` and `b` together, as branches of one expression.
    pub(crate) fn join(self, other: Ty) -> Option<Ty> {
        if self == Ty::Error || other == Ty::Error {
            return Some(Ty::Error);
        }
        if self == other {
            return Some(self);
        }
        if self.is_plain() && other.is_plain() {
            return Some(Ty::Number);
        }
        (self.is_place() && other.is_place()).then_some(Ty::Point)
    }

    /// The type in a sentence: "a length".
    pub(crate) fn noun(self) -> String {
        match self {
            Ty::Error => "something else",
            Ty::Number => "a number",
            Ty::Int => "a whole number",
            Ty::Percent => "a percentage",
            Ty::LENGTH => "a length",
            Ty::DURATION => "a duration",
            Ty::SPEED => "a speed",
            Ty::ANGLE => "an angle",
            Ty::Quantity(dim) => return format!("a quantity in {dim}"),
            Ty::Bool => "a condition",
            Ty::Point => "a point",
            Ty::Vector => "a vector",
            Ty::Velocity => "a velocity",
            Ty::Region => "a region",
            Ty::Player => "a player",
            Ty::Ball => "the ball",
            Ty::Set => "a set of players",
            Ty::Team => "a team",
            Ty::Formation => "a formation",
            Ty::String => "a string",
            Ty::Mode => "a game mode",
            Ty::Role => "a role",
            Ty::Action => "an action",
            Ty::List => "a list",
            Ty::Score => "the score",
            Ty::Event => "an event",
        }
        .to_owned()
    }

    /// How a value of the type is written, for help.
    pub(crate) fn example(self) -> Option<&'static str> {
        Some(match self {
            Ty::Number => "0.5",
            Ty::Int => "3",
            Ty::Percent => "60%",
            Ty::LENGTH => "12m",
            Ty::DURATION => "2s` or `20 steps",
            Ty::SPEED => "8m/s",
            Ty::ANGLE => "30deg",
            Ty::Point => "(0.5, 0.1)` or `(27m, 8m)",
            Ty::Vector => "(2m, 0m)",
            Ty::Velocity => "(5m/s, 0m/s)",
            Ty::Region => "right.box",
            Ty::Bool => "me has ball",
            Ty::Team => "left` or `right",
            _ => return None,
        })
    }
}
