//! The fields of the match that programs read, and the names that the language gives them.

use super::{Type, words};

words! {
    /// One number that [`Instr::Load`](crate::Instr::Load) reads; SI units, world frame.
    Field {
        BallX = "ball_x", "metres";
        BallY = "ball_y", "metres";
        BallHeight = "ball_height", "metres above the ground, of the ball's centre";
        BallVx = "ball_vx", "m/s";
        BallVy = "ball_vy", "m/s";
        BallVz = "ball_vz", "m/s";
        BallOwner = "ball_owner", "id of the player who has the ball now, or -1";
        Possession = "possession", "the team that had the ball last: 0, 1, or -1 before anyone had";
        PlayerX = "player_x", "metres";
        PlayerY = "player_y", "metres";
        PlayerVx = "player_vx", "m/s";
        PlayerVy = "player_vy", "m/s";
        PlayerHeading = "player_heading", "radians, 0 towards +x, positive towards +y";
        PlayerFatigue = "player_fatigue", "0 fresh to 1 exhausted";
        PlayerYellowCards = "player_yellow_cards", "count";
        PlayerRole = "player_role", "index of the role";
        PlayerActive = "player_active", "1 while on the pitch";
        PlayerControlled = "player_controlled", "1 while an agent controls the player";
        PlayerAction = "player_action", "index of the action of the last step";
        PlayerSprinting = "player_sprinting", "1 while the player holds sprint";
        PlayerDribbling = "player_dribbling", "1 while the player holds dribble";
        Score = "score", "goals of a team";
        TeamHasBall = "team_has_ball", "1 while a player of the team has the ball";
        OffsideLine = "offside_line", "world x of the line beyond which the team's players are offside, metres";
        Elapsed = "elapsed", "seconds since the episode's start";
        Remaining = "remaining", "seconds until the episode's limit; infinite without one";
        GameMode = "game_mode", "index of the game mode";
        BallDead = "ball_dead", "1 while play is stopped";
    }
}

impl Field {
    /// Whether the load takes a player, a team or nothing as its subject.
    pub const fn subject(self) -> Owner {
        match self {
            Field::PlayerX
            | Field::PlayerY
            | Field::PlayerVx
            | Field::PlayerVy
            | Field::PlayerHeading
            | Field::PlayerFatigue
            | Field::PlayerYellowCards
            | Field::PlayerRole
            | Field::PlayerActive
            | Field::PlayerControlled
            | Field::PlayerAction
            | Field::PlayerSprinting
            | Field::PlayerDribbling => Owner::Player,
            Field::Score | Field::TeamHasBall | Field::OffsideLine => Owner::Team,
            Field::BallX
            | Field::BallY
            | Field::BallHeight
            | Field::BallVx
            | Field::BallVy
            | Field::BallVz
            | Field::BallOwner => Owner::Ball,
            _ => Owner::Match,
        }
    }
}

words! {
    /// The owner of a property.
    Owner {
        Ball = "ball", "the ball";
        Player = "player", "a player";
        Team = "team", "a team";
        Match = "match", "the match";
    }
}

/// A property as an author writes it: `ball.height`, `me.fatigue`, `elapsed`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Property {
    /// Its owner.
    pub owner: Owner,
    /// The name after the dot (or alone, for the match).
    pub name: &'static str,
    /// Its type.
    pub ty: Type,
    /// One line of documentation.
    pub doc: &'static str,
}

const fn property(owner: Owner, name: &'static str, ty: Type, doc: &'static str) -> Property {
    Property { owner, name, ty, doc }
}

/// Every property of the language, by owner.
pub const PROPERTIES: &[Property] = &[
    property(Owner::Ball, "x", Type::Number, "normalised x in the reader's frame"),
    property(Owner::Ball, "y", Type::Number, "normalised y in the reader's frame"),
    property(Owner::Ball, "metres", Type::Vector, "its place in metres from the centre spot"),
    property(Owner::Ball, "height", Type::Length, "of its centre above the ground; 0.11 m at rest"),
    property(Owner::Ball, "speed", Type::Speed, "in three dimensions"),
    property(Owner::Ball, "velocity", Type::Vector, "along the ground, m/s"),
    property(Owner::Ball, "heading", Type::Angle, "direction of its motion in the reader's frame"),
    property(Owner::Ball, "owner", Type::Player, "the player who has it now, or nobody"),
    property(Owner::Player, "x", Type::Number, "normalised x in the reader's frame"),
    property(Owner::Player, "y", Type::Number, "normalised y in the reader's frame"),
    property(Owner::Player, "metres", Type::Vector, "their place in metres from the centre spot"),
    property(Owner::Player, "speed", Type::Speed, "along the ground"),
    property(Owner::Player, "velocity", Type::Vector, "along the ground, m/s"),
    property(
        Owner::Player,
        "heading",
        Type::Angle,
        "the direction the player faces, in the reader's frame",
    ),
    property(Owner::Player, "fatigue", Type::Number, "0 fresh to 1 exhausted"),
    property(Owner::Player, "yellow_cards", Type::Int, "cards so far"),
    property(Owner::Player, "role", Type::Role, "the player's role"),
    property(Owner::Player, "team", Type::Team, "the player's team"),
    property(Owner::Player, "active", Type::Bool, "still on the pitch"),
    property(Owner::Player, "controlled", Type::Bool, "whether an agent controls the player now"),
    property(Owner::Player, "action", Type::Action, "the player's action of the last step"),
    property(Owner::Player, "sprinting", Type::Bool, "holds sprint"),
    property(Owner::Player, "dribbling", Type::Bool, "holds dribble"),
    property(Owner::Match, "possession", Type::Team, "the team that had the ball last"),
    property(Owner::Match, "elapsed", Type::Duration, "since the episode's start"),
    property(Owner::Match, "remaining", Type::Duration, "until the episode's limit"),
    property(Owner::Match, "game_mode", Type::Mode, "open play or which set piece waits"),
    property(Owner::Match, "ball_dead", Type::Bool, "play is stopped"),
];
