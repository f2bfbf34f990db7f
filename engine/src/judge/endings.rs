//! When an episode ends, and with which outcome.

use crate::in_place::clone_in_place;
use crate::judge::machine::{Crew, Input, Machine, Registers, truth};
use crate::judge::script::{Done, HookScene, Memory, Perspective, ScriptError, Scripts, Shelf};
use crate::snapshot::{Archive, SnapshotError};
use crate::state::event::{Event, Events};
use crate::state::{ComingOn, Match, PlayerId};
use setpiece_scenario::vocabulary::{EventKind, Qualifier, Stat, Team, Verdict};
use setpiece_scenario::{Ending, Endings, LIMIT, ROUNDS, Reg};
use std::sync::Arc;

/// How an episode ended.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Outcome {
    /// The ending's name; `limit` for the limit.
    pub label: Arc<str>,
    /// Success or failure of the side that has agents, if the ending says so.
    pub verdict: Option<Verdict>,
    /// Whether the limit ended it.
    pub truncated: bool,
}

/// The endings of an environment.
#[derive(Debug)]
pub struct EndingJudge {
    endings: Arc<Endings>,
    /// Those of the endings, then those of the limit and of the last round.
    labels: Arc<[Arc<str>]>,
    regs: Registers,
    cells: Vec<[f64; 1]>,
    /// One per ending, if any has a script.
    memories: Vec<Memory>,
    faults: u32,
    at_start: Option<usize>,
    /// Whether the round was over in the last step.
    round_over: bool,
    /// Whether each substitution has been made.
    made: Vec<[f64; 1]>,
}

clone_in_place! {
    EndingJudge { endings, labels, regs, cells, memories, faults, at_start, round_over,
        made }
}

impl EndingJudge {
    /// Prepares a scenario's endings.
    pub fn new(endings: Arc<Endings>) -> EndingJudge {
        let scripted = endings.list.iter().any(|ending| ending.script.is_some());
        EndingJudge {
            labels: endings
                .list
                .iter()
                .map(|ending| ending.label.as_str())
                .chain([LIMIT, ROUNDS])
                .map(Arc::from)
                .collect(),
            regs: Registers::of(&endings.program),
            cells: vec![[0.0]; endings.program.cells as usize],
            memories: vec![Memory::default(); if scripted { endings.list.len() } else { 0 }],
            faults: 0,
            at_start: None,
            round_over: false,
            made: vec![[0.0]; endings.substitutions.len()],
            endings,
        }
    }

    /// Begins an episode; `input` shows the start state.
    pub fn reset(&mut self, input: &Input<'_>) {
        self.cells.fill([0.0]);
        self.memories.fill(Memory::default());
        self.faults = 0;
        self.round_over = false;
        self.made.fill([0.0]);
        let input = Input { silent: true, ..*input };
        self.machine(&input).begin();
        self.machine(&input).run();
        let holds = |ending: &Ending| ending.when.is_some_and(|when| truth(self.regs.value(when)));
        self.at_start = self.endings.list.iter().position(holds);
    }

    /// Writes or reads what it remembers; on the way in [`Self::reset`] has come before.
    pub(crate) fn archive(
        &mut self,
        archive: &mut Archive<'_>,
        shelf: &mut Shelf,
    ) -> Result<(), SnapshotError> {
        archive.slots("cells", &mut self.cells)?;
        archive.slots("made", &mut self.made)?;
        for memory in &mut self.memories {
            memory.archive("this", archive, shelf)?;
        }
        archive.value("faults", &mut self.faults)?;
        let mut at_start = self.at_start.map(|which| which as u32);
        archive.value("at_start", &mut at_start)?;
        self.at_start = at_start.map(|which| which as usize);
        if self.at_start.is_some_and(|which| which >= self.endings.list.len()) {
            return Err(SnapshotError::damaged("at_start", "is an ending that is not there"));
        }
        Ok(())
    }

    /// The first ending that held in the start state. Such an episode is over before its first
    /// step.
    pub fn holds_at_start(&self) -> Option<&str> {
        self.at_start.map(|which| &*self.labels[which])
    }

    /// Computes again what no step of a round changes.
    pub fn renew(&mut self, input: &Input<'_>) {
        self.made.fill([0.0]);
        self.machine(input).begin();
    }

    /// Calls `make` for each substitution whose time has come in the step just judged.
    pub fn substitutions(&mut self, make: &mut dyn FnMut(&ComingOn)) {
        let share = |reg: Reg| (self.regs.value(reg) as f32).clamp(0.0, 1.0);
        for (said, made) in self.endings.substitutions.iter().zip(&mut self.made) {
            if made[0] != 0.0 || !truth(self.regs.value(said.when)) {
                continue;
            }
            *made = [1.0];
            let stats = said.stats.iter().take(Stat::ALL.len());
            make(&ComingOn {
                player: PlayerId(said.player),
                fatigue: said.fatigue.map_or(0.0, share),
                difficulty: said.difficulty.map(share),
                stats: stats.map(|(stat, reg)| (*stat, share(*reg))).collect(),
            });
        }
    }

    /// Whether the round was over in the last step.
    pub fn is_round_over(&self) -> bool {
        self.round_over
    }

    /// Judges a step: the first ending that holds, in their order, else the end of the last round,
    /// else the limit.
    ///
    /// # Errors
    /// A `done` hook that failed.
    pub fn step(
        &mut self,
        game: &Match,
        input: &Input<'_>,
        last_round: bool,
        scene: Option<(&Scripts, &Arc<HookScene>)>,
    ) -> Result<Option<Outcome>, ScriptError> {
        self.machine(input).run();
        self.round_over = self.endings.round.is_some_and(|round| truth(self.regs.value(round)));
        for (which, ending) in self.endings.list.iter().enumerate() {
            let mut label = None;
            let mut holds = ending.when.is_some_and(|when| truth(self.regs.value(when)));
            if let (Some(script), Some((scripts, scene))) = (ending.script, scene) {
                let perspective = Perspective { us: input.us, me: None, agent: 0 };
                match scripts.done(script, scene, perspective, &mut self.memories[which])? {
                    Done::No => {}
                    Done::Yes => holds = true,
                    Done::Labelled(own) => {
                        holds = true;
                        label = Some(Arc::from(own));
                    }
                }
            }
            if holds {
                let label = label.unwrap_or_else(|| self.labels[which].clone());
                return Ok(Some(Outcome { label, verdict: ending.verdict, truncated: false }));
            }
        }
        if self.round_over && last_round {
            let label = self.labels[self.endings.list.len() + 1].clone();
            return Ok(Some(Outcome { label, verdict: None, truncated: false }));
        }
        let over = game.limit_steps.is_some_and(|limit| game.step >= limit);
        Ok(over.then(|| Outcome {
            label: self.labels[self.endings.list.len()].clone(),
            verdict: None,
            truncated: true,
        }))
    }

    fn machine<'a>(&'a mut self, input: &Input<'a>) -> Machine<'a> {
        let (plan, regs, points) = self.regs.parts();
        Machine {
            input: *input,
            crew: Crew::one(None),
            plan,
            regs,
            points,
            cells: &mut self.cells,
            terms: &mut [],
            faults: &mut self.faults,
            draws: None,
        }
    }
}

/// Adds the event that the episode ends.
pub fn announce(outcome: &Outcome, game: &Match, events: &mut Events) {
    events.push(Event {
        tick: game.tick,
        kind: EventKind::End,
        qualifier: outcome.verdict.map(|verdict| match verdict {
            Verdict::Success => Qualifier::Success,
            Verdict::Failure => Qualifier::Failure,
        }),
        team: None,
        by: None,
        to: None,
        at: game.ball.pos,
        length_m: 0.0,
        speed_mps: 0.0,
    });
}

/// The side that endings are judged for: the one that has agents. If both or none have, the left
/// one.
pub fn judged_side(game: &Match) -> Team {
    let has = |team: Team| game.agents.iter().any(|agent| agent.team == team);
    if has(Team::Right) && !has(Team::Left) { Team::Right } else { Team::Left }
}
