//! The events of an episode as analysts list them: a pass or shot is one event, with how it ended.

use super::{FRAME_MS, TrackedEvent, flat, words};
use crate::engine::environment::Environment;
use crate::engine::state::PlayerId;
use crate::engine::state::event::Event;
use setpiece_scenario::pitch::TICKS_PER_STEP;
use setpiece_scenario::{EventKind, Qualifier};

/// Ticks after a strike in which the ball may still touch the same foot.
const STRIKE_TICKS: u32 = 20;

/// The events so far.
#[derive(Default)]
pub(super) struct EventLog {
    events: Vec<TrackedEvent>,
    /// The tick at the end of the last step.
    tick: u32,
    /// A pass or shot under way.
    open: Option<Struck>,
    /// A touch that may end it; what it means comes with the same tick.
    met: Option<Moment>,
    /// The last shot that was on target, until the next tick.
    on_target: Option<(usize, u32)>,
    /// A set piece that was taken in this tick, with the taker, if nothing is known of it yet.
    taken: Option<(Moment, EventKind, PlayerId)>,
    /// The last pass that was intercepted.
    intercepted: Option<usize>,
    /// The goalkeeper who holds the ball.
    holds: Option<PlayerId>,
    /// Who headed the ball last, and when.
    headed: Option<(PlayerId, u32)>,
    /// Where the ball was last.
    ball: [f32; 2],
}

/// A pass or shot under way.
#[derive(Clone, Copy)]
struct Struck {
    at: usize,
    by: PlayerId,
    tick: u32,
    is_shot: bool,
    woodwork: bool,
}

/// When and where.
#[derive(Clone, Copy)]
struct Moment {
    tick: u32,
    time_ms: u32,
    frame: u32,
    second_half: bool,
    at: [f32; 2],
}

impl EventLog {
    /// Adds the events of the last step.
    pub(super) fn step(&mut self, environment: &Environment) {
        let frame = environment.steps();
        let (game, judged) = (environment.state(), environment.judged_state());
        let (half, ball) = (judged.half(), judged.ball.pos.truncate());
        self.ball = flat(ball.clamp(-half, half));
        for event in environment.events() {
            let ticks = event.tick.saturating_sub(self.tick).min(TICKS_PER_STEP);
            let now = Moment {
                tick: event.tick,
                time_ms: frame.saturating_sub(1) * FRAME_MS + ticks * FRAME_MS / TICKS_PER_STEP,
                frame,
                second_half: judged.play.second_half,
                at: flat(event.at.truncate()),
            };
            self.settle(event.tick);
            let place = place_at(environment.events(), event.tick).unwrap_or(self.ball);
            self.event(event, now, place);
        }
        self.tick = game.tick;
    }

    /// Ends what is under way and returns all events, in the order in which they began.
    pub(super) fn finish(mut self) -> Vec<TrackedEvent> {
        self.settle(u32::MAX);
        let (ball, frame) = (self.ball, self.events.last().map_or(0, |event| event.frame));
        self.close("interrupted", ball, frame);
        let mut order: Vec<usize> = (0..self.events.len()).collect();
        order.sort_by_key(|&at| self.events[at].time_ms);
        let mut places = vec![0; order.len()];
        for (place, &at) in order.iter().enumerate() {
            places[at] = place;
        }
        for event in &mut self.events {
            for related in &mut event.related {
                *related = places[*related];
            }
        }
        order.into_iter().map(|at| self.events[at].clone()).collect()
    }

    /// Concludes what no event of an earlier tick has explained.
    fn settle(&mut self, tick: u32) {
        if let Some(met) = self.met.take_if(|met| met.tick < tick) {
            self.close("deflected", met.at, met.frame);
        }
        if let Some((now, kind, by)) = self.taken.take_if(|(now, ..)| now.tick < tick) {
            let (kind, sub_kind) = words::of(kind);
            self.push(now, kind, Some(sub_kind), Some(by));
        }
        self.on_target.take_if(|(_, then)| *then < tick);
    }

    fn event(&mut self, event: &Event, now: Moment, place: [f32; 2]) {
        let by = event.by;
        match (event.kind, event.qualifier, by) {
            (EventKind::Pass, None | Some(Qualifier::Attempted), Some(by)) => {
                self.strike(now, by, false);
            }
            (EventKind::Shot, None, Some(by)) => self.strike(now, by, true),
            (EventKind::Pass, Some(verdict), _) => self.arrive(event, now, verdict),
            (EventKind::Shot, Some(verdict), _) => self.judge(now, verdict, place),
            (EventKind::Goal, ..) => self.goal(event, now),
            (EventKind::OwnGoal, ..) => {
                let ball = self.ball;
                self.close("own_goal", ball, now.frame);
                let at = self.push(now, "shot", None, by);
                self.events[at].body = Some("other");
                self.events[at].outcome = "own_goal";
                self.events[at].success = false;
                self.events[at].end = Some((ball, now.frame));
            }
            (kind, Some(Qualifier::Taken), Some(by)) => self.taken = Some((now, kind, by)),
            _ => self.other(event, now),
        }
        match (event.kind, by) {
            (EventKind::Catch, Some(by)) => self.holds = Some(by),
            (EventKind::Header, Some(by)) => self.headed = Some((by, now.tick)),
            (EventKind::Touch, by) if by != self.holds => self.holds = None,
            _ => {}
        }
    }

    /// A pass or shot begins.
    fn strike(&mut self, now: Moment, by: PlayerId, is_shot: bool) {
        self.close("interrupted", now.at, now.frame);
        let set_piece = self.taken.take().filter(|&(_, _, taker)| taker == by);
        let sub_kind = set_piece.map(|(_, kind, _)| words::of(kind).1);
        let at = self.push(now, if is_shot { "shot" } else { "pass" }, sub_kind, Some(by));
        let by_hand = self.holds == Some(by) || sub_kind == Some("throw_in");
        let body = match self.headed {
            _ if by_hand => "hands",
            Some((who, tick)) if who == by && tick == now.tick => "head",
            _ => "feet",
        };
        self.events[at].body = Some(body);
        self.events[at].success = false;
        self.open = Some(Struck { at, by, tick: now.tick, is_shot, woodwork: false });
        (self.met, self.holds) = (None, None);
    }

    /// A pass ends at a player.
    fn arrive(&mut self, event: &Event, now: Moment, verdict: Qualifier) {
        let Some(open) = self.open.take_if(|open| !open.is_shot && Some(open.by) == event.by)
        else {
            return;
        };
        self.met = None;
        let completed = verdict == Qualifier::Completed;
        let pass = &mut self.events[open.at];
        pass.end = Some((now.at, now.frame));
        pass.success = completed;
        pass.outcome = if completed { "successful" } else { "intercepted" };
        pass.received = event.to.filter(|_| completed).map(|to| (to, now.time_ms));
        self.intercepted = (!completed).then_some(open.at);
    }

    /// What became of a shot.
    fn judge(&mut self, now: Moment, verdict: Qualifier, place: [f32; 2]) {
        let Some(open) = self.open.filter(|open| open.is_shot) else { return };
        let outcome = match verdict {
            Qualifier::OnTarget => "saved",
            Qualifier::Blocked => "blocked",
            _ if open.woodwork => "woodwork",
            _ => "wide",
        };
        self.close(outcome, place, now.frame);
        if verdict == Qualifier::OnTarget {
            self.on_target = Some((open.at, now.tick));
        }
    }

    fn goal(&mut self, event: &Event, now: Moment) {
        let ball = self.ball;
        if let Some((shot, _)) = self.on_target.take() {
            self.events[shot].outcome = "successful";
            self.events[shot].success = true;
            self.events[shot].end = Some((ball, now.frame));
            return;
        }
        let own = self.events.last().is_some_and(|last| {
            last.outcome == "own_goal" && last.by == event.by && last.time_ms == now.time_ms
        });
        if !own {
            self.close("goal", ball, now.frame);
            self.push(
                now,
                if event.by.is_some() { "misc" } else { "referee" },
                Some("goal"),
                event.by,
            );
        }
    }

    /// Everything but passes, shots and goals.
    fn other(&mut self, event: &Event, now: Moment) {
        let kind = event.kind;
        match kind {
            EventKind::OutOfPlay => self.close("out_of_play", now.at, now.frame),
            EventKind::Offside => self.close("offside", now.at, now.frame),
            EventKind::Woodwork => {
                if let Some(open) = &mut self.open {
                    open.woodwork = true;
                }
            }
            kind if words::is_set_piece(kind) => self.close("interrupted", now.at, now.frame),
            kind if words::is_touch(kind) => self.meet(event, now),
            _ => {}
        }
        let (word, sub_kind) = words::of(kind);
        // What is awarded to a team is the referee's, and so is what nobody did.
        let by = event.by.filter(|_| word != "referee" && !words::is_set_piece(kind));
        let at = self.push(now, if by.is_some() { word } else { "referee" }, Some(sub_kind), by);
        match kind {
            EventKind::End => {
                self.events[at].outcome = event.qualifier.map_or("end", Qualifier::name)
            }
            EventKind::HalfTime | EventKind::FullTime => self.events[at].outcome = "end",
            kind if words::is_set_piece(kind) => self.events[at].outcome = "awarded",
            kind if words::is_called(kind) && by.is_some() => {
                let call = self.push(now, "referee", Some(sub_kind), None);
                self.events[call].outcome = sub_kind;
                self.relate(at, call);
            }
            EventKind::Interception => {
                if let Some(pass) = self.intercepted.take() {
                    self.relate(pass, at);
                }
            }
            _ => {}
        }
    }

    /// The ball meets a player while a pass or shot is under way.
    fn meet(&mut self, event: &Event, now: Moment) {
        let Some(open) = self.open else { return };
        if event.by != Some(open.by) {
            self.met = self.met.or(Some(now));
        } else if now.tick > open.tick + STRIKE_TICKS {
            self.close("interrupted", now.at, now.frame);
        }
    }

    /// Ends the pass or shot under way, if there is one.
    fn close(&mut self, outcome: &'static str, at: [f32; 2], frame: u32) {
        self.met = None;
        if let Some(open) = self.open.take() {
            self.events[open.at].outcome = outcome;
            self.events[open.at].end = Some((at, frame));
        }
    }

    fn relate(&mut self, one: usize, other: usize) {
        self.events[one].related.push(other);
        self.events[other].related.push(one);
    }

    /// Adds an event that succeeded, and returns its place.
    fn push(
        &mut self,
        now: Moment,
        kind: &'static str,
        sub_kind: Option<&'static str>,
        by: Option<PlayerId>,
    ) -> usize {
        self.events.push(TrackedEvent {
            kind,
            sub_kind,
            outcome: "successful",
            success: true,
            time_ms: now.time_ms,
            frame: now.frame,
            second_half: now.second_half,
            by,
            at: now.at,
            end: None,
            received: None,
            body: None,
            related: Vec::new(),
        });
        self.events.len() - 1
    }
}

/// Where the ball was at a tick: the place of a shot's event is that of the strike.
fn place_at(events: &[Event], tick: u32) -> Option<[f32; 2]> {
    let of_strike = |kind| matches!(kind, EventKind::Shot | EventKind::Goal | EventKind::OwnGoal);
    let at = events.iter().find(|event| event.tick == tick && !of_strike(event.kind))?;
    Some(flat(at.at.truncate()))
}
