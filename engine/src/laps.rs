//! Where the time of a step goes.

/// A part of an episode's work.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Phase {
    /// A start is drawn, and the match set up.
    Draw,
    /// Behaviours and bots decide, actions become intents.
    Bots,
    /// Where the ball will be, and who is there first; restarts too.
    Reach,
    /// Players run, and keep apart.
    Movement,
    /// Hands, slides, kicks, touches.
    Play,
    /// The free ball flies, and meets what is hard.
    Physics,
    /// Possession, out of play, offside, fouls, advantage.
    Referee,
    /// Rewards, endings, records, statistics.
    Judge,
    /// Observations are written.
    Observe,
}

impl Phase {
    /// Every phase with its name, in the order of a step.
    pub const NAMED: [(Phase, &'static str); 9] = [
        (Phase::Draw, "draw"),
        (Phase::Bots, "bots"),
        (Phase::Reach, "reach"),
        (Phase::Movement, "movement"),
        (Phase::Play, "play"),
        (Phase::Physics, "physics"),
        (Phase::Referee, "referee"),
        (Phase::Judge, "judge"),
        (Phase::Observe, "observe"),
    ];
}

/// Adds up the time that each phase takes, by a clock that the caller brings: the engine reads none of its own, and what
/// is measured has no influence on what is played.
#[derive(Clone, Debug, Default)]
pub struct Laps {
    clock: Option<fn() -> u64>,
    last: u64,
    spent: [u64; Phase::NAMED.len()],
    counts: [u64; Phase::NAMED.len()],
}

impl Laps {
    /// Measures by a clock, in whatever unit it has; it must not run backwards.
    pub fn with(clock: fn() -> u64) -> Laps {
        Laps { clock: Some(clock), last: clock(), ..Laps::default() }
    }

    /// What follows belongs to the next phase that ends.
    pub fn start(&mut self) {
        if let Some(clock) = self.clock {
            self.last = clock();
        }
    }

    /// A phase ends here.
    pub fn end(&mut self, phase: Phase) {
        if let Some(clock) = self.clock {
            let now = clock();
            self.spent[phase as usize] += now.saturating_sub(self.last);
            self.counts[phase as usize] += 1;
            self.last = now;
        }
    }

    /// What a phase took, in the clock's unit, and how often it ended: each time has cost a reading of the clock.
    pub fn of(&self, phase: Phase) -> (u64, u64) {
        (self.spent[phase as usize], self.counts[phase as usize])
    }
}
