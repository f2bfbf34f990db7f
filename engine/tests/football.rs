//! The game as a whole: movement against the measured curves, the referee's cases, agents on
//! scenarios, full matches.

#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "helpers of tests fail by panicking"
)]

#[path = "football/layouts.rs"]
mod layouts;

#[path = "football/movement.rs"]
mod movement;
#[path = "football/play.rs"]
mod play;
#[path = "football/referee.rs"]
mod referee;
#[path = "football/rules.rs"]
mod rules;
#[path = "football/scenarios.rs"]
mod scenarios;
#[path = "football/set_pieces.rs"]
mod set_pieces;
#[path = "football/statistics.rs"]
mod statistics;

use layouts::{Layout, drawn};
use setpiece_engine::physics::Scratch;
use setpiece_engine::state::Match;
use setpiece_engine::state::event::{Event, Events};
use setpiece_engine::state::player::NEVER;
use setpiece_engine::step;
use setpiece_scenario::vocabulary::{Action, EventKind};

/// A match and what is needed to play it.
struct Bench {
    game: Match,
    events: Events,
    scratch: Scratch,
}

impl Bench {
    fn new(layout: Layout, seed: u64) -> Bench {
        Bench::of(&drawn(layout, seed))
    }

    fn of(start: &setpiece_engine::start::Drawn) -> Bench {
        let mut game = step::begin(start);
        // In the middle of a match everybody may touch the ball.
        for player in &mut game.players {
            player.body.ready_at = NEVER;
        }
        Bench { game, events: Events::new(), scratch: Scratch::default() }
    }

    /// Plays a step; the events stay readable until the next.
    fn step(&mut self, action: Action) {
        self.events.clear();
        if self.game.step > 0 {
            step::prepare(&mut self.game);
        }
        step::hand_over(&mut self.game);
        step::play(&mut self.game, &[action], &mut self.events, &mut self.scratch);
    }

    fn restart(&mut self) {
        step::go_on(&mut self.game);
    }

    fn seen(&self, kind: EventKind) -> Option<Event> {
        self.events.as_slice().iter().copied().find(|event| event.kind == kind)
    }
}
