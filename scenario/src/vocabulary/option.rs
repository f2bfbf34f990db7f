//! The keys of every pair of braces but those of `rules`, `world` and `pitch`.

use super::words;

words! {
    /// A key of `agents { … }`.
    AgentsOption {
        Left = "left", "which players of the left team agents control: a count, `all` or a list of names";
        Right = "right", "which players of the right team agents control: a count, `all` or a list of names";
        Others = "others", "what players without an agent and without their own `ai` do: `bot` or `hold`";
        Switching = "switching", "`auto`: a count of agents follows the ball; `fixed`: they keep their players";
    }
}

words! {
    /// A key of `team { … }`.
    TeamOption {
        Difficulty = "difficulty", "strength of the team's players and bots, 0..1";
        Formation = "formation", "the formation whose players the team has";
    }
}

words! {
    /// A key of a player's `{ … }`.
    PlayerOption {
        Ai = "ai", "who controls the player without an agent: `bot`, `hold`, `lazy`, an act, a behaviour, a script";
        Difficulty = "difficulty", "strength of the player, 0..1, instead of the team's";
        Controllable = "controllable", "whether agents may control the player";
        Stats = "stats", "the player's statistics, 0..1 each";
        Fatigue = "fatigue", "0 fresh to 1 exhausted";
        YellowCards = "yellow_cards", "cards that the player already has: 0 or 1";
        Velocity = "velocity", "how the player moves at the start, at most 12 m/s";
        Overlap = "overlap", "`allowed`: the player may stand on another player's spot";
    }
}

words! {
    /// A key of `substitute … { … }`.
    SubstituteOption {
        Fatigue = "fatigue", "fatigue of the one who comes on; fresh without it";
        Difficulty = "difficulty", "strength of the one who comes on, 0..1";
        Stats = "stats", "statistics of the one who comes on, 0..1 each";
    }
}

words! {
    /// A key of the ball's `{ … }`.
    BallOption {
        Velocity = "velocity", "how the ball moves at the start, at most 70 m/s";
        Height = "height", "how high the ball is above the ground, up to 50m";
        Spin = "spin", "how the ball spins about x, y, z, radians per second";
        Owner = "owner", "the player who has the ball, and who stands within 2 m of it";
    }
}

words! {
    /// A key of `start … { … }`.
    StartOption {
        Score = "score", "goals of the left and the right team, 0..99 each";
        Elapsed = "elapsed", "time on the clock for `half_time`";
    }
}
