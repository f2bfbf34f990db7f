//! Where the time of a step goes.

/// A part of an episode's work.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Phase {
    /// Drawing a start and setting up the match.
    Draw,
    /// Behaviours and bots decide, and actions become intents.
    Bots,
    /// Where the ball will be and who is there first; restarts too.
    Reach,
    /// Players run, and are kept apart.
    Movement,
    /// Hands, slides, kicks, touches.
    Play,
    /// The free ball flies, and meets hard objects.
    Physics,
    /// Possession, out of play, offside, fouls, advantage.
    Referee,
    /// Rewards, endings, records, statistics.
    Judge,
    /// Writing observations.
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

/// Adds up the time of each phase, by a clock that the caller provides. The engine reads no clock
/// itself, and measuring doesn't influence play.
#[derive(Clone, Debug, Default)]
pub struct Laps {
    clock: Option<fn() -> u64>,
    last: u64,
    spent: [u64; Phase::NAMED.len()],
    counts: [u64; Phase::NAMED.len()],
}

impl Laps {
    /// Measures by a clock, in any unit. The clock must not run backwards.
    pub fn with(clock: fn() -> u64) -> Laps {
        Laps { clock: Some(clock), last: clock(), ..Laps::default() }
    }

    /// Starts the next phase; its time goes to the phase that ends next.
    pub fn start(&mut self) {
        if let Some(clock) = self.clock {
            self.last = clock();
        }
    }

    /// Ends a phase.
    pub fn end(&mut self, phase: Phase) {
        if let Some(clock) = self.clock {
            let now = clock();
            self.spent[phase as usize] += now.saturating_sub(self.last);
            self.counts[phase as usize] += 1;
            self.last = now;
        }
    }

    /// The time of a phase, in the clock's unit, and how often it ended. Each end costs one reading
    /// of the clock.
    pub fn of(&self, phase: Phase) -> (u64, u64) {
        (self.spent[phase as usize], self.counts[phase as usize])
    }
}
