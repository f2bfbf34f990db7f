//! Suites: their entries, and how agents and policies do in them.

use crate::levels::Levels;
use crate::params::bind;
use crate::patience::interruptible;
use crate::scenario::Scenario;
use crate::{errors, given};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use setpiece::agent::ChosenAgent;
use setpiece::engine::environment::EnvironmentOptions;
use setpiece::evaluate::refuse_endless;
use setpiece::plans::{PlansOf, library_plans, suite_of};
use setpiece::scenario as compiled;
use setpiece::scenario::plan::{self, PlannedEpisodes};
use setpiece::suite::{self, SuiteAgent, SuiteTable};

/// A suite.
#[pyclass(frozen, module = "setpiece._native")]
pub(crate) struct Suite {
    plan: plan::Suite,
}

/// A row of a table.
#[pyclass(frozen, module = "setpiece._native")]
pub(crate) struct SuiteRow {
    row: suite::SuiteRow,
}

/// A value, and the ends of its 95 % interval.
type Bounded = (f64, f64, f64);

#[pymethods]
impl Suite {
    /// A suite of a text, a file or the library. Without a name it is the only one.
    #[new]
    #[pyo3(signature = (source, is_text, name, allow_outside))]
    fn new(
        py: Python<'_>,
        source: Option<&Bound<'_, PyAny>>,
        is_text: bool,
        name: Option<String>,
        allow_outside: bool,
    ) -> PyResult<Suite> {
        let of = match source {
            None => PlansOf::Library,
            Some(text) if is_text => PlansOf::Text(given::text("text", text)?),
            Some(path) => PlansOf::File(given::path("source", path)?),
        };
        let plan = interruptible(py, move || suite_of(&of, name.as_deref(), allow_outside))?;
        Ok(Suite { plan: plan.map_err(|error| errors::from_facade(py, &error))? })
    }

    /// A scenario with each of some parameters, as many episodes of each.
    #[staticmethod]
    fn over(
        py: Python<'_>,
        scenario: &Scenario,
        params: Vec<Bound<'_, PyDict>>,
        count: u64,
        seed: u64,
    ) -> PyResult<Suite> {
        let scenario = scenario.inner();
        let entry = |params: &Bound<'_, PyDict>| {
            let bindings = bind(py, &scenario.params, params)?;
            let played = plan::Played { scenario: scenario.clone(), bindings };
            Ok(PlannedEpisodes { played, count, seed })
        };
        let entries = params.iter().map(entry).collect::<PyResult<Vec<_>>>()?;
        let (name, doc) = (scenario.name.clone(), scenario.doc.clone());
        Ok(Suite { plan: plan::Suite { name, doc, entries } })
    }

    #[getter]
    fn name(&self) -> &str {
        &self.plan.name
    }

    #[getter]
    fn doc(&self) -> &str {
        &self.plan.doc
    }

    /// Of each entry its label, its number of episodes and its seed.
    #[getter]
    fn entries(&self) -> Vec<(String, u64, u64)> {
        let entry = |entry: &PlannedEpisodes| (entry.played.label(), entry.count, entry.seed);
        self.plan.entries.iter().map(entry).collect()
    }

    /// The scenario of an entry, with its parameters as defaults.
    fn scenario(&self, py: Python<'_>, at: usize) -> PyResult<Scenario> {
        let plan::Played { scenario, bindings } = &self.entry(py, at)?.played;
        let mut scenario = compiled::Scenario::clone(scenario);
        for (param, value) in scenario.params.iter_mut().zip(&bindings.0) {
            param.default = *value;
        }
        Ok(Scenario::of(py, scenario))
    }

    /// The levels of an entry, each once.
    fn levels(&self, py: Python<'_>, at: usize) -> PyResult<Levels> {
        let entry = self.entry(py, at)?;
        refuse_endless(&entry.played.scenario).map_err(|error| errors::from_facade(py, &error))?;
        Ok(Levels::planned(entry.clone()))
    }

    /// The levels of all entries, again and again.
    fn listed(&self, py: Python<'_>) -> PyResult<Levels> {
        Levels::of_suite(&self.plan)
            .ok_or_else(|| errors::parameter(py, "levels", "the suite has no entry"))
    }

    /// Makes sure that an agent of the command can play every entry.
    fn check(&self, py: Python<'_>, agent: &str, rewards: Option<Vec<String>>) -> PyResult<()> {
        let Some(agent) = ChosenAgent::from_name(agent) else { return Ok(()) };
        let options = EnvironmentOptions { rewards, ..EnvironmentOptions::default() };
        suite::refuse_unplayable(&self.plan.entries, &options, &[agent])
            .map_err(|error| errors::from_facade(py, &error))
    }

    /// Plays an entry with an agent of the command.
    fn play(
        &self,
        py: Python<'_>,
        at: usize,
        agent: &str,
        rewards: Option<Vec<String>>,
        threads: usize,
    ) -> PyResult<SuiteRow> {
        let entry = self.entry(py, at)?.clone();
        let Some(agent) = ChosenAgent::from_name(agent) else {
            let message = format!("no agent is called `{agent}`");
            return Err(errors::parameter(py, "policy", &message));
        };
        let options = EnvironmentOptions { rewards, ..EnvironmentOptions::default() };
        let row =
            interruptible(py, move || suite::row(&entry, &options, &[agent], threads, || ()))?;
        Ok(SuiteRow { row: row.map_err(|error| errors::from_facade(py, &error))? })
    }

    /// The row of an entry whose levels a policy has played.
    fn row(&self, py: Python<'_>, at: usize, policy: &str, levels: &Levels) -> PyResult<SuiteRow> {
        let entry = self.entry(py, at)?;
        let Some(results) = levels.results() else {
            return Err(errors::parameter(py, "levels", "not all episodes have ended"));
        };
        Ok(SuiteRow { row: suite::row_of(entry, policy, &results) })
    }
}

impl Suite {
    fn entry(&self, py: Python<'_>, at: usize) -> PyResult<&PlannedEpisodes> {
        let missing = || errors::parameter(py, "at", &format!("the suite has no entry {at}"));
        self.plan.entries.get(at).ok_or_else(missing)
    }
}

#[pymethods]
impl SuiteRow {
    #[getter]
    fn entry(&self) -> &str {
        &self.row.entry
    }

    #[getter]
    fn episodes(&self) -> u64 {
        self.row.episodes
    }

    #[getter]
    fn seed(&self) -> u64 {
        self.row.seed
    }

    /// Success rate, mean score, mean return and mean length in seconds.
    #[getter]
    fn measured(&self) -> Vec<Bounded> {
        let of = |it: &SuiteAgent| {
            [it.success_rate, it.score, it.mean_return, it.length]
                .map(|it| (it.value, it.low, it.high))
        };
        self.row.agents.first().map_or(Vec::new(), |agent| of(agent).to_vec())
    }

    #[getter]
    fn digest(&self) -> &str {
        self.row.agents.first().map_or("", |agent| &agent.digest)
    }
}

/// The table of some rows as text.
#[pyfunction]
pub(crate) fn suite_text(rows: Vec<PyRef<'_, SuiteRow>>) -> String {
    let rows: Vec<suite::SuiteRow> = rows.iter().map(|row| row.row.clone()).collect();
    let table = SuiteTable::of(&rows);
    let (head, lines) = table.aligned();
    let note = table.note.map(|note| format!("\n  {note}"));
    [head].into_iter().chain(lines).chain(note).collect::<Vec<_>>().join("\n")
}

/// Of each suite of the library its name, its first line and its number of episodes.
#[pyfunction]
pub(crate) fn library_suites(py: Python<'_>) -> PyResult<Vec<(String, String, u64)>> {
    let plans = py.detach(library_plans).map_err(|error| errors::from_facade(py, &error))?;
    let entry = |suite: plan::Suite| {
        let (title, episodes) = (suite.title().to_owned(), suite.episodes());
        (suite.name, title, episodes)
    };
    Ok(plans.suites.into_iter().map(entry).collect())
}
