//! The values that have a name of the language and are no properties.

use super::words;

words! {
    /// A value that the language names.
    ValueWord {
        Left = "left", "the left team, which attacks to the right";
        Right = "right", "the right team";
        None = "none", "no team";
        Us = "us", "the team that is rewarded or that a behaviour's player belongs to, and its players";
        Them = "them", "the other team, and its players";
        Me = "me", "the agent's player, or the player of the behaviour";
        Mates = "mates", "`us` without `me`";
        Players = "players", "the players of both teams";
        Nobody = "nobody", "no player";
        Ball = "ball", "the ball, and where it is";
        Centre = "centre", "the centre spot";
        Score = "score", "the goals: `score.left`, `score.us`";
        Round = "round", "the round of the episode, from 1 on; 1 without `rounds`";
        RoundElapsed = "round_elapsed", "the time since the round began";
        Event = "event", "the event of an `on`: `event.by`, `event.at`";
    }
}
