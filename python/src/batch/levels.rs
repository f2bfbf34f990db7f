//! Where a batch takes its levels from, and the scenarios that it can play.

use super::stage::{BatchStage, Unfit, Upcoming, differs};
use crate::environment::{from_engine, prepare};
use crate::errors;
use crate::levels::Levels;
use crate::observation::ObservationKind;
use crate::params::bind;
use crate::scenario::Scenario;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use setpiece::engine::environment::Environment as Engine;
use setpiece::levels::LevelSource;
use setpiece::scenario as compiled;
use std::sync::{Arc, Mutex, PoisonError};

/// A level from Python: its scenario, parameters, seed and index.
#[derive(FromPyObject)]
pub(crate) struct GivenLevel<'py> {
    scenario: PyRef<'py, Scenario>,
    params: Bound<'py, PyDict>,
    seed: u64,
    episode: u64,
}

/// The `levels` of a batch.
#[derive(FromPyObject)]
pub(crate) enum LevelsArgument<'py> {
    Ours(PyRef<'py, Levels>),
    Function(Py<PyAny>),
}

/// Whatever chooses levels.
pub(super) enum LevelsOfBatch {
    /// One of ours, and the stage of each of its scenarios.
    Ours(Arc<Mutex<dyn LevelSource>>, Vec<Arc<BatchStage>>),
    /// A function from the result of the last episode, or None, to a [`GivenLevel`].
    Function(Py<PyAny>),
}

/// The scenarios of a batch.
pub(super) struct BatchStages {
    /// The first is the one that the batch was made of.
    all: Vec<Arc<BatchStage>>,
    /// The names of their reward terms, in the order of the columns.
    terms: Vec<String>,
    /// The options of the batch, for scenarios that come later.
    options: Py<PyAny>,
}

impl BatchStages {
    /// The scenario of a batch, and those of its source.
    pub(super) fn new(
        py: Python<'_>,
        engine: Engine,
        kind: ObservationKind,
        options: &Bound<'_, PyAny>,
        levels: Option<LevelsArgument<'_>>,
    ) -> PyResult<(BatchStages, Option<LevelsOfBatch>)> {
        let mut terms = engine.term_names().to_vec();
        let mut engines: Vec<Engine> = vec![engine];
        let mut places = Vec::new();
        let sourced = match &levels {
            Some(LevelsArgument::Ours(levels)) => levels.scenarios(),
            Some(LevelsArgument::Function(_)) | None => Vec::new(),
        };
        for (number, sourced) in sourced.into_iter().enumerate() {
            let known = engines.iter().position(|it| *it.scenario() == sourced.scenario);
            places.push(known.unwrap_or(engines.len()));
            if known.is_none() {
                let engine = prepare(py, &sourced.scenario, &options.extract()?)?.engine;
                if let Some(how) = differs(kind, &engines[0], &engine) {
                    return Err(other_spaces(py, &sourced.place, &how));
                }
                for name in engine.term_names() {
                    if !terms.contains(name) {
                        terms.push(name.clone());
                    }
                }
                engines.push(engine);
            }
            let engine = &engines[*places.last().unwrap_or(&0)];
            if let Some(LevelsArgument::Ours(levels)) = &levels
                && let Some(how) = levels.unmeasured(number, engine.term_names())
            {
                return Err(unmeasured(py, &sourced.place, &how));
            }
        }
        let stage = |engine: Engine| {
            let columns = columns(&engine, &terms).unwrap_or_default();
            Arc::new(BatchStage { engine, columns, kind })
        };
        let all: Vec<Arc<BatchStage>> = engines.into_iter().map(stage).collect();
        let source = levels.map(|levels| match levels {
            LevelsArgument::Ours(levels) => {
                let places = places.into_iter().map(|at| all[at].clone()).collect();
                LevelsOfBatch::Ours(levels.source(), places)
            }
            LevelsArgument::Function(function) => LevelsOfBatch::Function(function),
        });
        Ok((BatchStages { all, terms, options: options.clone().unbind() }, source))
    }

    pub(super) fn first(&self) -> &Arc<BatchStage> {
        &self.all[0]
    }

    pub(super) fn terms(&self) -> &[String] {
        &self.terms
    }

    pub(super) fn scenarios(&self, py: Python<'_>) -> Vec<Scenario> {
        let of = |stage: &Arc<BatchStage>| Scenario::of(py, stage.engine.scenario().clone());
        self.all.iter().map(of).collect()
    }

    /// A level from Python, checked.
    pub(super) fn upcoming(
        &mut self,
        py: Python<'_>,
        given: &GivenLevel<'_>,
    ) -> PyResult<Upcoming> {
        let scenario = given.scenario.inner();
        let bindings = bind(py, &scenario.params, &given.params)?;
        let stage = self.stage(py, scenario)?;
        Ok(Upcoming { stage, bindings, seed: given.seed, episode: given.episode, chosen: None })
    }

    /// The stage of a scenario, which is added if it is new.
    fn stage(
        &mut self,
        py: Python<'_>,
        scenario: &Arc<compiled::Scenario>,
    ) -> PyResult<Arc<BatchStage>> {
        let same = |stage: &&Arc<BatchStage>| Arc::ptr_eq(stage.engine.scenario(), scenario);
        if let Some(stage) = self.all.iter().find(same) {
            return Ok(stage.clone());
        }
        let engine = prepare(py, scenario, &self.options.bind(py).extract()?)?.engine;
        let place = format!("`{}`", scenario.name);
        let kind = self.first().kind;
        if let Some(how) = differs(kind, &self.first().engine, &engine) {
            return Err(other_spaces(py, &place, &how));
        }
        let columns = columns(&engine, &self.terms).map_err(|name| {
            let how = format!("it pays `{name}`, a reward term that the vector doesn't have");
            other_spaces(py, &place, &how)
        })?;
        let stage = Arc::new(BatchStage { engine, columns, kind });
        self.all.push(stage.clone());
        Ok(stage)
    }
}

impl LevelsOfBatch {
    /// Asks for the levels of some lanes, in their order; a source may have no more. `results` are
    /// those of their last episodes, for a function.
    pub(super) fn ask(
        &self,
        py: Python<'_>,
        stages: &mut BatchStages,
        lanes: &[usize],
        results: &[Py<PyAny>],
        mut begin: impl FnMut(usize, Option<Upcoming>),
    ) -> PyResult<()> {
        match self {
            LevelsOfBatch::Ours(source, places) => {
                let mut source = source.lock().unwrap_or_else(PoisonError::into_inner);
                for &at in lanes {
                    let upcoming = source.next().map(|chosen| {
                        let stage = places[chosen.scenario].clone();
                        let (seed, episode) = (chosen.seed, chosen.episode);
                        let bindings = chosen.bindings.clone();
                        Upcoming { stage, bindings, seed, episode, chosen: Some(chosen) }
                    });
                    begin(at, upcoming);
                }
            }
            LevelsOfBatch::Function(function) => {
                for (&at, result) in lanes.iter().zip(results) {
                    let level = function.bind(py).call1((result,))?;
                    begin(at, Some(stages.upcoming(py, &level.extract()?)?));
                }
            }
        }
        Ok(())
    }
}

/// The column of each of an engine's terms; the first that has none.
fn columns(engine: &Engine, terms: &[String]) -> Result<Vec<usize>, String> {
    let names = engine.term_names().iter();
    names
        .map(|name| terms.iter().position(|known| known == name).ok_or_else(|| name.clone()))
        .collect()
}

/// The exception for a source that needs a measure that nothing pays.
fn unmeasured(py: Python<'_>, place: &str, how: &str) -> PyErr {
    let message = format!("{place} can't be measured: {how}");
    errors::level(py, &message, "leave `rewards` out, or name the reward among them")
}

/// The exception for a scenario that would change the spaces of a vector.
fn other_spaces(py: Python<'_>, place: &str, how: &str) -> PyErr {
    let message = format!("{place} doesn't fit the vector: {how}");
    let help =
        "scenarios of one vector have as many agents on each side, and the same observations";
    errors::level(py, &message, help)
}

/// The exception for a level that can't begin.
pub(super) fn from_unfit(py: Python<'_>, engine: &Engine, why: Unfit) -> PyErr {
    match why {
        Unfit::Engine(why) => from_engine(py, why),
        Unfit::Spaces(how) => other_spaces(py, &format!("`{}`", engine.scenario().name), &how),
    }
}
