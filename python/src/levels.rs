//! Sources of levels: curricula, lists, samplers.

use crate::patience::interruptible;
use crate::scenario::Scenario;
use crate::{errors, given, params};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use setpiece::evaluate::Results;
use setpiece::levels::{
    CurriculumRun, LevelScore, LevelSource, ListedLevel, ListedLevels, Numbering, PlannedLevels,
    PrioritizedLevels, RandomizedLevels, ReplayOptions, SourcedScenario,
};
use setpiece::plans::{PlansOf, curriculum_of};
use setpiece::scenario::Bindings;
use setpiece::scenario::plan::{PlannedEpisodes, Played, Suite};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// What chooses the levels of a batch; batches share it.
#[pyclass(frozen, module = "setpiece._native")]
pub(crate) struct Levels {
    kind: SourceKind,
}

enum SourceKind {
    Planned(Arc<Mutex<PlannedLevels>>),
    Curriculum(Arc<Mutex<CurriculumRun>>),
    Prioritized(Arc<Mutex<PrioritizedLevels>>),
    Other(Arc<Mutex<dyn LevelSource>>),
}

/// A level of a list: the place of its scenario, its parameters, and its seed and index if it is
/// one episode.
type GivenListed<'py> = (usize, Bound<'py, PyDict>, Option<(u64, u64)>);

/// How `Levels.prioritized` keeps levels; the package has validated it.
#[derive(FromPyObject)]
pub(crate) struct PrioritizedArguments {
    capacity: usize,
    replay: f64,
    staleness: f64,
    temperature: f64,
    edit: f64,
    scale: f64,
    learnability: bool,
}

#[pymethods]
impl Levels {
    /// A curriculum of a text, a file or the library. Without a name it is the only one.
    #[staticmethod]
    #[pyo3(signature = (source, is_text, name, seed, allow_outside))]
    fn curriculum(
        py: Python<'_>,
        source: Option<&Bound<'_, PyAny>>,
        is_text: bool,
        name: Option<String>,
        seed: Option<u64>,
        allow_outside: bool,
    ) -> PyResult<Levels> {
        let of = match source {
            None => PlansOf::Library,
            Some(text) if is_text => PlansOf::Text(given::text("text", text)?),
            Some(path) => PlansOf::File(given::path("levels", path)?),
        };
        let plan = interruptible(py, move || curriculum_of(&of, name.as_deref(), allow_outside))?;
        let plan = plan.map_err(|error| errors::from_facade(py, &error))?;
        let run = CurriculumRun::new(plan, seed)
            .ok_or_else(|| errors::parameter(py, "levels", "the curriculum has no stage"))?;
        Ok(Levels { kind: SourceKind::Curriculum(Arc::new(Mutex::new(run))) })
    }

    /// A list of levels: the place of each one's scenario, its parameters, and its seed and index,
    /// or none for an episode that is another one every time.
    #[staticmethod]
    fn listed(
        py: Python<'_>,
        scenarios: Vec<PyRef<'_, Scenario>>,
        levels: Vec<GivenListed<'_>>,
    ) -> PyResult<Levels> {
        let level = |(scenario, given, episode): GivenListed<'_>| {
            let of = scenarios.get(scenario).map_or(&[][..], |it| &it.inner().params);
            Ok(ListedLevel { scenario, bindings: params::bind(py, of, &given)?, episode })
        };
        let levels: PyResult<Vec<ListedLevel>> = levels.into_iter().map(level).collect();
        let sourced = scenarios.iter().map(|scenario| SourcedScenario {
            place: format!("`{}` of the list", scenario.inner().name),
            scenario: scenario.inner().clone(),
        });
        let list = ListedLevels::new(sourced.collect(), levels?)
            .ok_or_else(|| errors::parameter(py, "levels", "the list of levels is empty"))?;
        Ok(Levels { kind: SourceKind::Other(Arc::new(Mutex::new(list))) })
    }

    /// Levels of a scenario that draw some parameters, those at `varied`.
    #[staticmethod]
    fn randomized(scenario: PyRef<'_, Scenario>, varied: Vec<usize>, seed: Option<u64>) -> Levels {
        let levels = randomized(&scenario, varied, seed);
        Levels { kind: SourceKind::Other(Arc::new(Mutex::new(levels))) }
    }

    /// The same, which plays some of them again.
    #[staticmethod]
    fn prioritized(
        scenario: PyRef<'_, Scenario>,
        varied: Vec<usize>,
        seed: Option<u64>,
        arguments: PrioritizedArguments,
    ) -> Levels {
        let score =
            if arguments.learnability { LevelScore::Learnability } else { LevelScore::Given };
        let options = ReplayOptions {
            capacity: arguments.capacity,
            replay: arguments.replay,
            staleness: arguments.staleness,
            temperature: arguments.temperature,
            edit: arguments.edit,
            scale: arguments.scale,
            score,
        };
        let levels = PrioritizedLevels::new(randomized(&scenario, varied, seed), options);
        Levels { kind: SourceKind::Prioritized(Arc::new(Mutex::new(levels))) }
    }

    /// The seed; None if nobody has given one.
    #[getter]
    fn seed(&self) -> Option<u64> {
        lock(&*self.source()).numbering().seed
    }

    /// Numbers the next levels from 0 under a seed.
    fn reseed(&self, seed: u64) {
        lock(&*self.source()).set_numbering(Numbering::of(Some(seed)));
    }

    /// Everything that it remembers, as JSON.
    fn state(&self) -> String {
        lock(&*self.source()).save()
    }

    /// Takes back a state.
    fn set_state(&self, py: Python<'_>, state: &str) -> PyResult<()> {
        let restored = lock(&*self.source()).restore(state);
        restored.map_err(|why| {
            errors::parameter(py, "state", &format!("this is no state of these levels: {why}"))
        })
    }

    /// How many episodes of a suite's entry have not ended yet.
    #[getter]
    fn n_unfinished(&self) -> usize {
        let SourceKind::Planned(levels) = &self.kind else { return 0 };
        lock(&**levels).n_unfinished()
    }

    /// The place and the name of a curriculum's stage, and the value that it adapts.
    fn stage(&self) -> Option<(usize, String, Option<f64>)> {
        let SourceKind::Curriculum(run) = &self.kind else { return None };
        let run = lock(&**run);
        let name = run.plan().stages[run.stage()].name.clone();
        Some((run.stage(), name, run.value()))
    }

    /// The names of a curriculum's stages.
    fn stages(&self) -> Vec<String> {
        let SourceKind::Curriculum(run) = &self.kind else { return Vec::new() };
        lock(&**run).plan().stages.iter().map(|stage| stage.name.clone()).collect()
    }

    /// How many levels are kept to be played again.
    fn kept(&self) -> usize {
        let SourceKind::Prioritized(levels) = &self.kind else { return 0 };
        lock(&**levels).kept()
    }

    /// Gives a level its score.
    fn score(
        &self,
        py: Python<'_>,
        params: &Bound<'_, PyDict>,
        seed: u64,
        episode: u64,
        score: f64,
    ) -> PyResult<()> {
        let SourceKind::Prioritized(levels) = &self.kind else { return Ok(()) };
        let mut levels = lock(&**levels);
        let scenario = levels.scenarios().remove(0).scenario;
        let bindings = params::bind(py, &scenario.params, params)?;
        levels.score(&bindings, seed, episode, score);
        Ok(())
    }
}

impl Levels {
    /// The episodes of a suite's entry, each once.
    pub(crate) fn planned(plan: PlannedEpisodes) -> Levels {
        Levels { kind: SourceKind::Planned(Arc::new(Mutex::new(PlannedLevels::new(plan)))) }
    }

    /// The episodes of all entries of a suite, again and again.
    pub(crate) fn of_suite(suite: &Suite) -> Option<Levels> {
        let list = ListedLevels::of_suite(suite)?;
        Some(Levels { kind: SourceKind::Other(Arc::new(Mutex::new(list))) })
    }

    /// The results of such episodes; `None` before all of them have ended.
    pub(crate) fn results(&self) -> Option<Results> {
        let SourceKind::Planned(levels) = &self.kind else { return None };
        lock(&**levels).results()
    }

    /// The source, for a batch.
    pub(crate) fn source(&self) -> Arc<Mutex<dyn LevelSource>> {
        match &self.kind {
            SourceKind::Curriculum(run) => run.clone(),
            SourceKind::Prioritized(levels) => levels.clone(),
            SourceKind::Planned(levels) => levels.clone(),
            SourceKind::Other(source) => source.clone(),
        }
    }

    /// What of a scenario it would measure in vain.
    pub(crate) fn unmeasured(&self, scenario: usize, terms: &[String]) -> Option<String> {
        lock(&*self.source()).unmeasured(scenario, terms)
    }

    /// The scenarios that it plays, and where.
    pub(crate) fn scenarios(&self) -> Vec<SourcedScenario> {
        lock(&*self.source()).scenarios()
    }
}

fn lock<T: ?Sized>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

fn randomized(scenario: &Scenario, varied: Vec<usize>, seed: Option<u64>) -> RandomizedLevels {
    let scenario = scenario.inner().clone();
    let bindings = Bindings::defaults(&scenario.params);
    RandomizedLevels::new(Played { scenario, bindings }, varied, seed)
}
