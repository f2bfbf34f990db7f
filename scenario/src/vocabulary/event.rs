//! The events of a match.

use super::{Type, words};

words! {
    /// An event. `by` is the player who did it, `to` the one who received it or was hurt.
    EventKind {
        Goal = "goal", "a goal; by the team whose score rose, or the player who touched last";
        OwnGoal = "own_goal", "a goal by a player of the conceding team; by the scorer";
        Shot = "shot", "a shot; by the shooter";
        Save = "save", "the keeper stopped a shot; by the keeper";
        Catch = "catch", "the keeper holds the ball; by the keeper";
        Parry = "parry", "the keeper pushed the ball away; by the keeper";
        Woodwork = "woodwork", "the ball hit a post or the bar; by the last toucher";
        Pass = "pass", "a pass; by the passer, to the intended or actual receiver";
        Touch = "touch", "a player touched the ball";
        Header = "header", "a player headed the ball";
        Tackle = "tackle", "a standing tackle won the ball; by the tackler, to the victim";
        Slide = "slide", "a slide tackle began; by the slider";
        Interception = "interception", "an opponents' pass was cut out; by the interceptor";
        BallWon = "ball_won", "possession changed; by its new owner";
        BallLost = "ball_lost", "possession changed; by its last owner";
        Foul = "foul", "a foul; by the offender, to the victim";
        Handball = "handball", "a handball; by the offender";
        Offside = "offside", "an offside was called; by the offender";
        YellowCard = "yellow_card", "a yellow card; by the offender";
        RedCard = "red_card", "a sending-off; by the offender";
        Advantage = "advantage", "a foul was waved on; by the offender, to the victim";
        ThrowIn = "throw_in", "a throw-in; by the team it is awarded to";
        Corner = "corner", "a corner; by the team it is awarded to";
        GoalKick = "goal_kick", "a goal kick; by the team it is awarded to";
        FreeKick = "free_kick", "a free kick; by the team it is awarded to";
        Penalty = "penalty", "a penalty; by the team it is awarded to";
        Kickoff = "kickoff", "a kick-off; by the team it is awarded to";
        OutOfPlay = "out_of_play", "the ball left the pitch; by its last toucher";
        HalfTime = "half_time", "half-time";
        FullTime = "full_time", "full time";
        End = "end", "the episode ends";
        Assist = "assist", "a goal by the receiver of a pass; by the passer, to the scorer";
    }
}

words! {
    /// A refinement of an event.
    Qualifier {
        Attempted = "attempted", "of a pass: it was struck (the meaning of a bare `pass`)";
        Completed = "completed", "of a pass: a teammate received it";
        Intercepted = "intercepted", "of a pass: an opponent got it";
        OnTarget = "on_target", "of a shot: a goal, or saved on its way in";
        OffTarget = "off_target", "of a shot: it missed";
        Blocked = "blocked", "of a shot: an outfield opponent stopped it";
        Taken = "taken", "of a set piece: its taker has played it";
        Success = "success", "of the end: the episode succeeded";
        Failure = "failure", "of the end: the episode failed";
    }
}

impl EventKind {
    /// The qualifiers that the event can have.
    pub const fn qualifiers(self) -> &'static [Qualifier] {
        match self {
            EventKind::Pass => {
                &[Qualifier::Attempted, Qualifier::Completed, Qualifier::Intercepted]
            }
            EventKind::Shot => &[Qualifier::OnTarget, Qualifier::OffTarget, Qualifier::Blocked],
            EventKind::ThrowIn
            | EventKind::Corner
            | EventKind::GoalKick
            | EventKind::FreeKick
            | EventKind::Penalty
            | EventKind::Kickoff => &[Qualifier::Taken],
            EventKind::End => &[Qualifier::Success, Qualifier::Failure],
            _ => &[],
        }
    }

    /// Whether the event names a receiver or victim.
    pub const fn has_receiver(self) -> bool {
        matches!(
            self,
            EventKind::Pass
                | EventKind::Tackle
                | EventKind::Foul
                | EventKind::Advantage
                | EventKind::Assist
        )
    }

    /// Whether the event names the player who did it.
    pub const fn has_actor(self) -> bool {
        !matches!(self, EventKind::HalfTime | EventKind::FullTime | EventKind::End)
    }
}

words! {
    /// The fields that an `on` block may read of its event.
    EventField {
        By = "by", "the player who did it";
        To = "to", "the player who received it or was hurt";
        X = "x", "world x of the place, metres";
        Y = "y", "world y of the place, metres";
        Length = "length", "how far the ball travelled, metres";
        Speed = "speed", "the ball's speed, m/s";
        ByTeam = "by_team", "the team of the player who did it";
    }
}

impl EventField {
    /// The fields that the language shows as `event.NAME`, with their types; `at` is made of `X`
    /// and `Y`.
    pub const NAMED: &'static [(&'static str, Type)] = &[
        ("by", Type::Player),
        ("to", Type::Player),
        ("at", Type::Point),
        ("length", Type::Length),
        ("speed", Type::Speed),
    ];
}
