//! The switches of the game, its modes, starts and verdicts.

use super::words;

words! {
    /// A key of `rules { … }`.
    Rule {
        Offside = "offside", "the offside rule";
        Fouls = "fouls", "fouls are called";
        Cards = "cards", "fouls earn yellow and red cards";
        Penalties = "penalties", "a foul in the box gives a penalty, else a free kick";
        Handball = "handball", "deliberate handball is called";
        KickoffCircle = "kickoff_circle", "opponents keep out of the centre circle at a kick-off";
        BackPass = "back_pass", "the keeper may not handle a deliberate back pass";
        Fatigue = "fatigue", "running tires";
        Stochastic = "stochastic", "chance in play follows the seed";
        Assist = "assist", "the controlled player runs to a ball that is theirs (GRF's magnet)";
        AntiStalling = "anti_stalling", "a set piece that the agent does not take is taken for it";
        HalfTime = "half_time", "step of the half-time, 0 for none";
        GrfKeeper = "grf_keeper", "an agent's keeper can't use their hands, as in GRF";
        SixSeconds = "six_seconds", "a keeper who holds the ball for longer than six seconds gives a free kick away";
        Physics = "physics", "gated: rapier resolves contacts; full: rapier runs on every tick";
    }
}

impl Rule {
    /// The default value: 1 is on, 0 off; `physics` is 0 for gated, 1 for full.
    pub const fn default_value(self) -> f64 {
        match self {
            Rule::Handball | Rule::HalfTime | Rule::GrfKeeper | Rule::Physics => 0.0,
            _ => 1.0,
        }
    }
}

words! {
    /// GRF's `game_mode`, by its numbers.
    GameMode {
        Normal = "normal", "open play";
        KickOff = "kick_off", "a kick-off waits";
        GoalKick = "goal_kick", "a goal kick waits";
        FreeKick = "free_kick", "a free kick waits";
        Corner = "corner", "a corner waits";
        ThrowIn = "throw_in", "a throw-in waits";
        Penalty = "penalty", "a penalty waits";
    }
}

words! {
    /// How an episode starts.
    StartKind {
        Open = "open", "play is on at once, wherever the ball lies";
        Kickoff = "kickoff", "a kick-off";
        Corner = "corner", "a corner";
        FreeKick = "free_kick", "a free kick";
        ThrowIn = "throw_in", "a throw-in";
        GoalKick = "goal_kick", "a goal kick";
        Penalty = "penalty", "a penalty";
    }
}

words! {
    /// The verdict of an ending on the episode.
    Verdict {
        Success = "success", "the side with agents reached its aim";
        Failure = "failure", "the side with agents failed";
    }
}
