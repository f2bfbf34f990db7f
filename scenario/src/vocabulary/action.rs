//! The actions of an agent: Google Research Football's, by its names and numbers.

use super::words;

words! {
    /// An action, in the order of GRF's `full` set; the first 19 are its `default` set, the 20th
    /// completes its `v2` set.
    Action {
        Idle = "idle", "no change; held directions, sprint and dribble go on";
        Left = "left", "run towards the own goal";
        TopLeft = "top_left", "run back and up";
        Top = "top", "run up (negative y)";
        TopRight = "top_right", "run forward and up";
        Right = "right", "run towards the opponents' goal";
        BottomRight = "bottom_right", "run forward and down";
        Bottom = "bottom", "run down (positive y)";
        BottomLeft = "bottom_left", "run back and down";
        LongPass = "long_pass", "a ground pass ahead of a team mate";
        HighPass = "high_pass", "a lofted pass or cross";
        ShortPass = "short_pass", "a ground pass to a team mate's feet";
        Shot = "shot", "a shot at goal: a held direction chooses the part of the goal mouth; a key that is held charges it";
        Sprint = "sprint", "sprint until released";
        ReleaseDirection = "release_direction", "stop running";
        ReleaseSprint = "release_sprint", "stop sprinting";
        Sliding = "sliding", "a slide tackle; only without the ball";
        Dribble = "dribble", "slow close control until released";
        ReleaseDribble = "release_dribble", "stop dribbling";
        BuiltinAi = "builtin_ai", "the bot plays this step; held actions are cleared";
        KeeperRush = "keeper_rush", "the own keeper comes out to the ball until released";
        Pressure = "pressure", "chase whoever has the ball until released";
        TeamPressure = "team_pressure", "a team mate presses too until released";
        Switch = "switch", "take the mate who is sooner at the ball; in possession send a mate on a run";
        ReleaseLongPass = "release_long_pass", "nothing: a key that kicks is let go by itself";
        ReleaseHighPass = "release_high_pass", "nothing: a key that kicks is let go by itself";
        ReleaseShortPass = "release_short_pass", "nothing: a key that kicks is let go by itself";
        ReleaseShot = "release_shot", "nothing: a key that kicks is let go by itself";
        ReleaseKeeperRush = "release_keeper_rush", "call the keeper back";
        ReleaseSliding = "release_sliding", "nothing: a key that slides is let go by itself";
        ReleasePressure = "release_pressure", "stop chasing";
        ReleaseTeamPressure = "release_team_pressure", "call the mate back";
        ReleaseSwitch = "release_switch", "nothing: a key that switches is let go by itself";
    }
}

impl Action {
    /// Size of GRF's `default` action set.
    pub const DEFAULT_SET: usize = 19;
    /// Size of GRF's `v2` action set.
    pub const V2_SET: usize = 20;
    /// Size of GRF's `full` action set.
    pub const FULL_SET: usize = 33;

    /// The unit direction of a direction action in the own frame (+x forward, +y down the picture).
    pub fn direction(self) -> Option<(f64, f64)> {
        let d = std::f64::consts::FRAC_1_SQRT_2;
        Some(match self {
            Action::Left => (-1.0, 0.0),
            Action::TopLeft => (-d, -d),
            Action::Top => (0.0, -1.0),
            Action::TopRight => (d, -d),
            Action::Right => (1.0, 0.0),
            Action::BottomRight => (d, d),
            Action::Bottom => (0.0, 1.0),
            Action::BottomLeft => (-d, d),
            _ => return None,
        })
    }
}

words! {
    /// A held action, in the order of GRF's `sticky_actions` vector; the first 10 are those of the
    /// `default` set.
    StickyAction {
        Left = "left", "held direction";
        TopLeft = "top_left", "held direction";
        Top = "top", "held direction";
        TopRight = "top_right", "held direction";
        Right = "right", "held direction";
        BottomRight = "bottom_right", "held direction";
        Bottom = "bottom", "held direction";
        BottomLeft = "bottom_left", "held direction";
        Sprint = "sprint", "held sprint";
        Dribble = "dribble", "held dribble";
        KeeperRush = "keeper_rush", "held keeper rush";
        Pressure = "pressure", "held pressure";
        TeamPressure = "team_pressure", "held team pressure";
    }
}

impl StickyAction {
    /// How many of them GRF's `default` and `v2` sets have.
    pub const DEFAULT_SET: usize = 10;
}
