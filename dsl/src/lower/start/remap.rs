//! Values and the start in other registers: where a program's registers went, or what a step
//! program reads instead.

use crate::lower::value::{Repr, SetValue, Value};
use setpiece_scenario::{
    Agents, BallStart, Kickoff, KickoffPlaces, PitchSetting, PlayerSlot, PlayerStart, Reg, Require,
    RuleSetting, SideAgents, Start, WorldSetting,
};
use std::sync::Arc;

impl<'w> Value<'w> {
    /// The same value in other registers.
    pub(crate) fn map(&self, f: &mut dyn FnMut(Reg) -> Reg) -> Value<'w> {
        let repr = match &self.repr {
            Repr::One(a) => Repr::One(f(*a)),
            Repr::Two(a, b) => Repr::Two(f(*a), f(*b)),
            Repr::Three(a, b, c) => Repr::Three(f(*a), f(*b), f(*c)),
            Repr::Choice(a, words) => Repr::Choice(f(*a), words.clone()),
            Repr::Set(set) => {
                Repr::Set(SetValue { team: f(set.team), except: set.except.map(&mut *f) })
            }
            Repr::Region(value) => Repr::Region(Arc::new(value.map(f))),
            Repr::List(list) => Repr::List(list.iter().map(|value| value.map(f)).collect()),
            Repr::Nothing | Repr::Text(_) | Repr::Formation(_) => self.repr.clone(),
        };
        Value { ty: self.ty, repr }
    }
}

pub(super) fn map_start(start: &Start, f: &mut dyn FnMut(Reg) -> Reg) -> Start {
    let mut pair = |p: &(Reg, Reg)| (f(p.0), f(p.1));
    let score = start.score.as_ref().map(&mut pair);
    let kickoff_places = start.kickoff.as_ref().map(|kickoff| {
        let place = |p: &KickoffPlaces| KickoffPlaces {
            kicking: pair(&p.kicking),
            receiving: pair(&p.receiving),
        };
        kickoff.places.iter().map(place).collect::<Vec<_>>()
    });
    let mut triple = |p: &(Reg, Reg, Reg)| (f(p.0), f(p.1), f(p.2));
    let velocity = start.ball.velocity.as_ref().map(&mut triple);
    let spin = start.ball.spin.as_ref().map(&mut triple);
    Start {
        program: start.program.clone(),
        lets: start.lets.iter().map(|&reg| f(reg)).collect(),
        ball: BallStart {
            x: f(start.ball.x),
            y: f(start.ball.y),
            height: start.ball.height.map(&mut *f),
            velocity,
            spin,
            owner: start.ball.owner.map(&mut *f),
        },
        kind: start.kind,
        taker: start.taker.map(&mut *f),
        score,
        elapsed: start.elapsed.map(&mut *f),
        kickoff: start.kickoff.as_ref().map(|kickoff| Kickoff {
            first: f(kickoff.first),
            places: kickoff_places.unwrap_or_default(),
        }),
        difficulty: start.difficulty.map(&mut *f),
        rules: start
            .rules
            .iter()
            .map(|s| RuleSetting { rule: s.rule, value: f(s.value) })
            .collect(),
        world: start
            .world
            .iter()
            .map(|s| WorldSetting { figure: s.figure, value: f(s.value) })
            .collect(),
        pitch: start
            .pitch
            .iter()
            .map(|s| PitchSetting { figure: s.figure, value: f(s.value) })
            .collect(),
        limit: start.limit.map(&mut *f),
        rounds: start.rounds.map(&mut *f),
        requires: start
            .requires
            .iter()
            .map(|require| Require {
                condition: f(require.condition),
                probability: require.probability.map(&mut *f),
                label: require.label.clone(),
            })
            .collect(),
    }
}

pub(super) fn map_slot(slot: &PlayerSlot, f: &mut dyn FnMut(Reg) -> Reg) -> PlayerSlot {
    let s = &slot.start;
    PlayerSlot {
        sometimes: slot.sometimes.iter().map(|(when, ai)| (f(*when), *ai)).collect(),
        stats: slot.stats.iter().map(|(stat, reg)| (*stat, f(*reg))).collect(),
        start: PlayerStart {
            x: f(s.x),
            y: f(s.y),
            heading: s.heading.map(&mut *f),
            velocity: s.velocity.map(|v| (f(v.0), f(v.1))),
            fatigue: s.fatigue.map(&mut *f),
            yellow_cards: s.yellow_cards.map(&mut *f),
            difficulty: s.difficulty.map(&mut *f),
            present: s.present.map(&mut *f),
            active: s.active.map(&mut *f),
        },
        ..slot.clone()
    }
}

pub(super) fn map_agents(agents: &Agents, f: &mut dyn FnMut(Reg) -> Reg) -> Agents {
    let mut side = |side: &SideAgents| match side {
        SideAgents::Count(reg) => SideAgents::Count(f(*reg)),
        other => other.clone(),
    };
    Agents { sides: [side(&agents.sides[0]), side(&agents.sides[1])], ..agents.clone() }
}
