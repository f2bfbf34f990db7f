//! Teams, roles and the statistics of a player.

use super::words;

words! {
    /// A team. The left team attacks towards +x.
    Team {
        Left = "left", "the team whose goal is at x = -1";
        Right = "right", "the team whose goal is at x = 1";
    }
}

impl Team {
    /// The other team.
    #[inline]
    #[must_use]
    pub const fn other(self) -> Team {
        match self {
            Team::Left => Team::Right,
            Team::Right => Team::Left,
        }
    }

    /// +1 for the left team, -1 for the right: multiplies world coordinates into the own frame and
    /// back.
    #[inline]
    pub const fn side(self) -> f64 {
        match self {
            Team::Left => 1.0,
            Team::Right => -1.0,
        }
    }
}

words! {
    /// A player's role; the order is Google Research Football's numbering.
    Role {
        GK = "GK", "goalkeeper";
        CB = "CB", "centre back";
        LB = "LB", "left back";
        RB = "RB", "right back";
        DM = "DM", "defensive midfielder";
        CM = "CM", "central midfielder";
        LM = "LM", "left midfielder";
        RM = "RM", "right midfielder";
        AM = "AM", "attacking midfielder";
        CF = "CF", "centre forward";
    }
}

impl Role {
    /// Where the role stands in a 4-3-3, normalised own frame. A pair stands on either side of it.
    ///
    /// Source: the default kick-off layout of Google Research Football's full matches.
    pub const fn zone(self) -> (f64, f64) {
        match self {
            Role::GK => (-1.0, 0.0),
            Role::CB => (-0.5, 0.0),
            Role::LB => (-0.422, -0.19576),
            Role::RB => (-0.422, 0.19576),
            Role::DM => (-0.35, 0.0),
            Role::CM => (-0.267574, 0.0),
            Role::LM => (-0.01, -0.2161),
            Role::RM => (-0.01, 0.2161),
            Role::AM => (-0.1, 0.0),
            Role::CF => (-0.01, 0.0),
        }
    }
}

words! {
    /// A statistic of a player, 0..1.
    Stat {
        Balance = "balance", "keeps their feet in duels and collisions";
        Reaction = "reaction", "shortens the delay with which they see the game";
        Acceleration = "acceleration", "gains speed quickly";
        Speed = "speed", "top speed, 7.2 m/s at 0 to 8.0 m/s at 1";
        Stamina = "stamina", "tires slowly";
        Agility = "agility", "turns sharply at speed";
        ShotPower = "shot_power", "strikes the ball hard";
        StandingTackle = "standing_tackle", "wins the ball standing";
        SlidingTackle = "sliding_tackle", "wins the ball sliding";
        BallControl = "ball_control", "first touch and close control";
        Dribble = "dribble", "keeps the ball near while running";
        ShortPass = "short_pass", "accuracy of short and long passes on the ground";
        HighPass = "high_pass", "accuracy of lofted passes";
        Header = "header", "heads the ball well";
        Shot = "shot", "accuracy of shots";
        Volley = "volley", "strikes a moving or bouncing ball cleanly";
        Calmness = "calmness", "is not hurried by opponents";
        Workrate = "workrate", "runs off the ball";
        Resilience = "resilience", "recovers after knocks";
        DefensivePositioning = "defensive_positioning", "stands right in defence";
        OffensivePositioning = "offensive_positioning", "finds space in attack";
        Vision = "vision", "reads where the ball will go";
    }
}
