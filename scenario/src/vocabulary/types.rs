//! The types and units of the language.

use super::words;

words! {
    /// A type of the language. Values are SI inside a program.
    Type {
        Number = "number", "a plain number";
        Int = "int", "a whole number";
        Bool = "bool", "true or false, on or off";
        Percent = "percent", "a share, written 60%";
        Length = "length", "metres";
        Duration = "duration", "seconds; a step is 0.1 s";
        Speed = "speed", "metres per second";
        Angle = "angle", "radians inside, degrees in text";
        Point = "point", "a place on the pitch";
        Vector = "vector", "a difference of points";
        Region = "region", "a part of the pitch";
        Player = "player", "one player, or nobody";
        Set = "set", "some players";
        Team = "team", "left, right or none";
        Formation = "formation", "eleven places in the own frame";
        Behavior = "behavior", "a scripted player";
        String = "string", "a word";
        Mode = "game_mode", "a game mode";
        Role = "role", "a player's role";
        Action = "action", "a player's action of one step";
    }
}

impl Type {
    /// The type in a sentence, with an example if its notation isn't obvious.
    pub const fn noun(self) -> &'static str {
        match self {
            Type::Number => "a number",
            Type::Int => "a whole number",
            Type::Bool => "`on` or `off`",
            Type::Percent => "a share such as 60%",
            Type::Length => "a length such as 12m",
            Type::Duration => "a duration such as 3s or 30 steps",
            Type::Speed => "a speed such as 5m/s",
            Type::Angle => "an angle such as 45deg",
            Type::Point => "a point",
            Type::Vector => "a vector",
            Type::Region => "a region",
            Type::Player => "a player",
            Type::Set => "some players",
            Type::Team => "`left`, `right` or `none`",
            Type::Formation => "a formation",
            Type::Behavior => "a behavior",
            Type::String => "a word",
            Type::Mode => "a game mode",
            Type::Role => "a role",
            Type::Action => "an action",
        }
    }
}

words! {
    /// A unit that directly follows its number.
    Unit {
        MetrePerSecond = "m/s", "metres per second";
        KilometrePerHour = "km/h", "kilometres per hour";
        Degree = "deg", "degrees";
        Radian = "rad", "radians";
        Millisecond = "ms", "milliseconds";
        Metre = "m", "metres";
        Second = "s", "seconds";
        Percent = "%", "hundredths";
        Step = "steps", "steps of 0.1 s";
        Episode = "episodes", "episodes";
    }
}

impl Unit {
    /// The type of a number with this unit.
    pub const fn ty(self) -> Type {
        match self {
            Unit::MetrePerSecond | Unit::KilometrePerHour => Type::Speed,
            Unit::Degree | Unit::Radian => Type::Angle,
            Unit::Millisecond | Unit::Second | Unit::Step => Type::Duration,
            Unit::Metre => Type::Length,
            Unit::Percent => Type::Percent,
            Unit::Episode => Type::Int,
        }
    }

    /// A number of this unit in SI, rounded once, so that 3 steps equal 0.3 s and 300 ms.
    pub const fn si(self, number: f64) -> f64 {
        match self {
            Unit::KilometrePerHour => number / 3.6,
            Unit::Degree => number * (std::f64::consts::PI / 180.0),
            Unit::Millisecond => number / 1000.0,
            Unit::Percent => number / 100.0,
            Unit::Step => number / crate::pitch::STEPS_PER_S,
            _ => number,
        }
    }
}
