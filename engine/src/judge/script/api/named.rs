//! What scripts read by name: values, regions and tables of the scenario and the file.

use super::super::budget::{Failable, count_operations};
use super::functions::place;
use super::{Argument, Point, ShownState};
use crate::judge::machine::{Crew, Input, Machine, Registers, truth};
use crate::judge::view::Sight;
use rhai::{Dynamic, Engine, Map};
use setpiece_scenario::bounds::named_work;
use setpiece_scenario::{NamedKind, NamedValue, Reg, Scenario};
use std::sync::Arc;

/// Instructions of a program that count as one operation of a script.
const INSTRUCTIONS_PER_OPERATION: u64 = 8;

/// What one script reads by name.
pub(in super::super) type NamedList = Arc<[NamedProgram]>;

/// A name, and what computes it.
#[derive(Debug)]
pub(in super::super) struct NamedProgram {
    name: String,
    kind: NamedKind,
    registers: Registers,
    values: Vec<Reg>,
    /// Its cost in operations.
    operations: u64,
}

/// What is the same in a whole episode.
#[derive(Debug)]
pub(crate) struct EpisodeNames {
    /// By the scripts' indices.
    pub(in super::super) scripts: Vec<NamedList>,
    /// The parameters.
    pub(crate) params: Vec<f64>,
    /// The drawn `let`s.
    pub(crate) lets: Vec<f64>,
    /// The round, from 1 on.
    pub(crate) round: u32,
    /// Steps from the episode's start to when it began.
    pub(crate) round_start: u32,
}

/// A region.
#[derive(Clone)]
pub(in super::super) struct SeenRegion(pub(super) ShownState, pub(super) u32);
/// A table.
#[derive(Clone)]
pub(in super::super) struct SeenTable(pub(super) ShownState, pub(super) u32);

impl NamedProgram {
    /// Prepares what a script of a scenario reads by name.
    pub(in super::super) fn list(scenario: &Scenario, named: &[NamedValue]) -> NamedList {
        let prepared = named.iter().map(|named| NamedProgram {
            name: named.name.clone(),
            kind: named.kind,
            registers: Registers::of(&named.program),
            values: named.values.clone(),
            operations: named_work(scenario, named) / INSTRUCTIONS_PER_OPERATION,
        });
        prepared.collect()
    }
}

impl ShownState {
    fn named_list(&self) -> &[NamedProgram] {
        let episode = self.scene.episode.get();
        episode.and_then(|episode| episode.scripts.get(self.script as usize)).map_or(&[], |of| of)
    }

    /// What a script reads by name in this state.
    pub(super) fn named(&self) -> Dynamic {
        let entry = |(at, named): (usize, &NamedProgram)| {
            let value = match named.kind {
                NamedKind::Value(ty) => {
                    let values = self.computed(named, None);
                    self.argument(&Argument { name: &named.name, ty, values })
                }
                NamedKind::Region => Dynamic::from(SeenRegion(self.clone(), at as u32)),
                NamedKind::Table => Dynamic::from(SeenTable(self.clone(), at as u32)),
            };
            (named.name.as_str().into(), value)
        };
        let map: Map = self.named_list().iter().enumerate().map(entry).collect();
        map.into()
    }

    /// Computes what a name stands for; zeros beyond its registers. A place is in world metres.
    fn computed(&self, named: &NamedProgram, place: Option<[f64; 2]>) -> [f64; 2] {
        // Running it is work. If no operations are left, the next one fails.
        count_operations(named.operations);
        let Some(episode) = self.scene.episode.get() else { return [0.0; 2] };
        let input = Input {
            now: Some(Sight::Kept(self.view())),
            prev: Some(Sight::Kept(&self.scene.prev)),
            events: &[],
            params: &episode.params,
            lets: &episode.lets,
            index: self.scene.index,
            round: episode.round,
            round_start: episode.round_start,
            us: self.perspective.us,
            terminated: false,
            silent: true,
        };
        let mut registers = named.registers.clone();
        let mut cells = place.unwrap_or_default().map(|number| [number]);
        let (plan, regs, points) = registers.parts();
        let mut machine = Machine {
            input,
            crew: Crew::one(None),
            plan,
            regs,
            points,
            cells: if place.is_some() { &mut cells } else { &mut [] },
            terms: &mut [],
            faults: &mut 0,
            draws: None,
        };
        machine.begin();
        machine.run();
        let value = |at: usize| named.values.get(at).map_or(0.0, |&reg| machine.value(reg));
        [value(0), value(1)]
    }

    /// Asks a region or a table about a place.
    fn asked(&self, at: u32, of: Point) -> [f64; 2] {
        let named = self.named_list().get(at as usize);
        named.map_or([0.0; 2], |named| self.computed(named, Some(of.metres)))
    }
}

/// Registers what regions and tables are asked.
pub(in super::super) fn register_named(engine: &mut Engine) {
    engine.register_fn("contains", |region: &mut SeenRegion, of: Dynamic| -> Failable<bool> {
        Ok(truth(region.0.asked(region.1, place(&of)?)[0]))
    });
    engine.register_fn("at", |table: &mut SeenTable, of: Dynamic| -> Failable<f64> {
        Ok(table.0.asked(table.1, place(&of)?)[0])
    });
    engine.register_fn("linear", |table: &mut SeenTable, of: Dynamic| -> Failable<f64> {
        Ok(table.0.asked(table.1, place(&of)?)[1])
    });
}
