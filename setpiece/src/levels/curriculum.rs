//! Plays a curriculum of the language.

mod phase;

use super::{ChosenLevel, LevelSource, Numbering, SourcedScenario};
use phase::{StagePhase, StageVerdict, measured_terms};
use serde::{Deserialize, Serialize};
use serde_json::Value;
use setpiece_engine::batch::EpisodeSummary;
use setpiece_engine::random::{Purpose, Stream};
use setpiece_scenario::plan::{Adapt, Curriculum, CurriculumStage, StageHow};
use setpiece_scenario::vocabulary::Type;
use setpiece_scenario::{Bindings, Param};

/// A value that adapts moves by this share of its way.
const MOVES: u32 = 20;
/// Values on the way are whole multiples of one of so many parts, SI units.
const PARTS: f64 = 1e6;

/// A curriculum while it is played.
#[derive(Clone, Debug)]
pub struct CurriculumRun {
    plan: Curriculum,
    numbering: Numbering,
    state: CurriculumState,
}

/// All that a curriculum remembers besides its numbering.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct CurriculumState {
    /// The names of the stages, so that a state goes only to its curriculum.
    stages: Vec<String>,
    /// The present stage.
    stage: usize,
    /// How far the present stage's value has moved, in parts of [`MOVES`].
    moved: u32,
    /// The tag of the levels that count for the present phase: earlier ones had another stage or
    /// value.
    tag: u64,
    phase: StagePhase,
}

impl CurriculumRun {
    /// Begins a curriculum; `None` if it has no stage.
    pub fn new(plan: Curriculum, seed: Option<u64>) -> Option<CurriculumRun> {
        let first = plan.stages.first()?;
        let state = CurriculumState {
            stages: plan.stages.iter().map(|stage| stage.name.clone()).collect(),
            stage: 0,
            moved: 0,
            tag: 1,
            phase: StagePhase::of(&first.how),
        };
        Some(CurriculumRun { plan, numbering: Numbering::of(seed), state })
    }

    /// Its text's data.
    pub fn plan(&self) -> &Curriculum {
        &self.plan
    }

    /// The place of the present stage.
    pub fn stage(&self) -> usize {
        self.state.stage
    }

    /// The value of the present stage that adapts, in SI units.
    pub fn value(&self) -> Option<f64> {
        match &self.present().how {
            StageHow::Adapt(adapt) => Some(value_at(adapt, self.state.moved)),
            StageHow::Until(_) | StageHow::Forever => None,
        }
    }

    fn present(&self) -> &CurriculumStage {
        // A state has the place of one of its stages, of which there is at least one.
        &self.plan.stages[self.state.stage]
    }

    /// The values of a stage's parameters now.
    fn bindings(&self, stage: usize) -> Bindings {
        let CurriculumStage { played, how, .. } = &self.plan.stages[stage];
        let mut bindings = played.bindings.clone();
        if let StageHow::Adapt(adapt) = how {
            // An earlier stage has come to the end of its way.
            let moved = if stage == self.state.stage { self.state.moved } else { MOVES };
            for &at in &adapt.params {
                if let (Some(value), Some(param)) =
                    (bindings.0.get_mut(at), played.scenario.params.get(at))
                {
                    *value = admitted(param, value_at(adapt, moved));
                }
            }
        }
        bindings
    }

    /// Begins a phase: of another stage, or of another value.
    fn go_to(&mut self, stage: usize, moved: u32) {
        self.state.stage = stage;
        self.state.moved = moved;
        self.state.tag = self.state.tag.saturating_add(1);
        self.state.phase = StagePhase::of(&self.present().how);
    }
}

impl LevelSource for CurriculumRun {
    fn scenarios(&self) -> Vec<SourcedScenario> {
        let of = |stage: &CurriculumStage| SourcedScenario {
            place: format!("stage `{}` of `{}`", stage.name, self.plan.name),
            scenario: stage.played.scenario.clone(),
        };
        self.plan.stages.iter().map(of).collect()
    }

    fn next(&mut self) -> Option<ChosenLevel> {
        let (seed, episode) = self.numbering.take();
        let mut stream = Stream::new(seed, episode, Purpose::Level);
        let present = self.state.stage;
        let is_earlier = present > 0 && stream.unit_f64() >= self.plan.current;
        let scenario = if is_earlier { stream.below(present as u32) as usize } else { present };
        let tag = if is_earlier { 0 } else { self.state.tag };
        let bindings = self.bindings(scenario);
        Some(ChosenLevel { scenario, bindings, seed, episode, tag })
    }

    fn report(&mut self, level: &ChosenLevel, episode: &EpisodeSummary, terms: &[String]) {
        if level.tag != self.state.tag {
            return;
        }
        let (stage, moved) = (self.state.stage, self.state.moved);
        let how = &self.plan.stages[stage].how;
        let verdict = self.state.phase.note(how, episode, terms);
        let is_last = stage + 1 == self.plan.stages.len();
        match verdict {
            StageVerdict::Reached | StageVerdict::TooEasy | StageVerdict::Kept
                if !is_last && ends(how, verdict, moved) =>
            {
                self.go_to(stage + 1, 0);
            }
            StageVerdict::TooEasy if moved < MOVES => self.go_to(stage, moved + 1),
            StageVerdict::TooHard if moved > 0 => self.go_to(stage, moved - 1),
            _ => {}
        }
    }

    fn unmeasured(&self, scenario: usize, terms: &[String]) -> Option<String> {
        let stage = self.plan.stages.get(scenario)?;
        let unpaid = measured_terms(&stage.how).find(|term| !terms.contains(term))?;
        Some(format!("the reward term `{unpaid}` isn't paid"))
    }

    fn numbering(&self) -> Numbering {
        self.numbering
    }

    fn set_numbering(&mut self, numbering: Numbering) {
        self.numbering = numbering;
    }

    fn kind(&self) -> &'static str {
        "curriculum"
    }

    fn memory(&self) -> Value {
        serde_json::to_value(&self.state).unwrap_or_default()
    }

    fn remember(&mut self, memory: Value) -> Result<(), String> {
        let state: CurriculumState =
            serde_json::from_value(memory).map_err(|why| why.to_string())?;
        if state.stages != self.state.stages {
            let names = |stages: &[String]| format!("`{}`", stages.join("`, `"));
            return Err(format!(
                "the stages are {}, and this curriculum has {}",
                names(&state.stages),
                names(&self.state.stages)
            ));
        }
        let fits = self
            .plan
            .stages
            .get(state.stage)
            .is_some_and(|stage| state.phase.fits(&stage.how) && state.moved <= MOVES);
        if !fits {
            return Err(format!("it is no state of stage {}", state.stage));
        }
        self.state = state;
        Ok(())
    }
}

/// Whether a stage ends with a verdict: a goal is reached, or its value has come to the end of its
/// way and the measure hasn't left the band.
fn ends(how: &StageHow, verdict: StageVerdict, moved: u32) -> bool {
    match how {
        StageHow::Until(_) => verdict == StageVerdict::Reached,
        StageHow::Adapt(_) => moved == MOVES,
        StageHow::Forever => false,
    }
}

/// The value after some moves.
fn value_at(adapt: &Adapt, moved: u32) -> f64 {
    if moved >= MOVES {
        return adapt.to;
    }
    let value = adapt.from + (adapt.to - adapt.from) * f64::from(moved) / f64::from(MOVES);
    // Few decimals, so that a level is short as text.
    let (low, high) = (adapt.from.min(adapt.to), adapt.from.max(adapt.to));
    ((value * PARTS).round() / PARTS).clamp(low, high)
}

/// The allowed value of a parameter that is nearest to another.
fn admitted(param: &Param, value: f64) -> f64 {
    let nearer = |a: f64, b: &f64| if (b - value).abs() < (a - value).abs() { *b } else { a };
    match param.values.split_first() {
        Some((first, others)) => others.iter().fold(*first, nearer),
        None if param.ty == Type::Int => value.round(),
        None => value,
    }
}
