//! `info`: the data of a step besides observation and reward.

use crate::actions::ActionSet;
use crate::level;
use numpy::{PyArray1, PyArrayMethods};
use pyo3::intern;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList, PyString};
use setpiece::engine::environment::Environment as Engine;
use setpiece::engine::judge::Recorded;
use setpiece::engine::observe;
use setpiece::engine::state::PlayerId;
use setpiece::engine::state::event::Event;
use setpiece::scenario::pitch::{PLAYERS_MAX, to_normalised};
use setpiece::scenario::{Qualifier, Team, Verdict};

/// Writes the `info` of steps; keeps the recurring strings.
pub(crate) struct InfoWriter {
    /// The reward terms' names.
    terms: Vec<Py<PyString>>,
    /// The players' names, by id; `None` for empty slots.
    players: Vec<Option<Py<PyString>>>,
    options: InfoOptions,
}

/// The optional parts of `info`.
#[derive(Clone, Copy)]
pub(crate) struct InfoOptions {
    /// The actions that the mask covers.
    pub(crate) actions: ActionSet,
    /// Whether it lists events.
    pub(crate) events: bool,
    /// Whether it shows the bot's action.
    pub(crate) bot_action: bool,
}

impl InfoWriter {
    pub(crate) fn new(py: Python<'_>, engine: &Engine, options: InfoOptions) -> InfoWriter {
        let word = |text: &str| PyString::new(py, text).unbind();
        InfoWriter {
            terms: engine.term_names().iter().map(|name| word(name)).collect(),
            players: (0..PLAYERS_MAX as u8)
                .map(|id| engine.player_name(PlayerId(id)).map(|name| word(&name)))
                .collect(),
            options,
        }
    }

    /// The `info` of the step just played, or of the reset.
    pub(crate) fn write<'py>(
        &self,
        py: Python<'py>,
        engine: &Engine,
    ) -> PyResult<Bound<'py, PyDict>> {
        let info = PyDict::new(py);
        info.set_item(intern!(py, "score"), PyList::new(py, engine.score())?)?;
        info.set_item(intern!(py, "reward_terms"), self.terms(py, engine, Engine::terms)?)?;
        info.set_item(intern!(py, "action_mask"), self.action_mask(py, engine)?)?;
        if self.options.bot_action {
            info.set_item(intern!(py, "bot_action"), bot_action(py, engine)?)?;
        }
        if self.options.events {
            let events: PyResult<Vec<_>> =
                engine.events().iter().map(|event| self.event(py, event)).collect();
            info.set_item(intern!(py, "events"), events?)?;
        }
        self.sum_up(py, engine, &info)?;
        Ok(info)
    }

    /// Adds how the episode has ended, if it has: outcome, records and summary.
    pub(crate) fn sum_up<'py>(
        &self,
        py: Python<'py>,
        engine: &Engine,
        info: &Bound<'py, PyDict>,
    ) -> PyResult<()> {
        if let Some(outcome) = engine.outcome() {
            info.set_item(intern!(py, "outcome"), &*outcome.label)?;
            info.set_item(intern!(py, "records"), records(py, engine)?)?;
            let summary = PyDict::new(py);
            summary.set_item("return", self.terms(py, engine, Engine::term_sums)?)?;
            summary.set_item("length", engine.steps())?;
            summary.set_item("seed", engine.seed())?;
            summary.set_item("index", engine.index())?;
            summary.set_item("level", level::of_episode(engine, engine.bindings()))?;
            summary.set_item("digest", format!("{:016x}", engine.digest()))?;
            summary.set_item("success", outcome.verdict == Some(Verdict::Success))?;
            summary.set_item("faults", engine.faults())?;
            let observed = PyDict::new(py);
            for (name, times) in engine.observed_faults() {
                observed.set_item(name, times)?;
            }
            summary.set_item("observation_faults", observed)?;
            info.set_item(intern!(py, "setpiece"), summary)?;
        }
        Ok(())
    }

    /// Which actions have an effect: int8 `(19,)` for one agent, `(n, 19)` for n; 20 with the set
    /// `v2`, 33 with `full`, the 6 kinds with `continuous`.
    pub(crate) fn action_mask<'py>(
        &self,
        py: Python<'py>,
        engine: &Engine,
    ) -> PyResult<Bound<'py, PyAny>> {
        let n_agents = engine.n_agents();
        let size = self.options.actions.masked().len();
        let mut mask = vec![0; n_agents * size];
        for (agent, row) in mask.chunks_exact_mut(size).enumerate() {
            write_mask(self.options.actions, engine, agent, row);
        }
        let mask = PyArray1::from_vec(py, mask);
        if n_agents == 1 {
            return Ok(mask.into_any());
        }
        Ok(mask.reshape([n_agents, size])?.into_any())
    }

    /// Every player's presses in the last step, by name. Players that nobody plays are left out.
    pub(crate) fn played<'py>(
        &self,
        py: Python<'py>,
        engine: &Engine,
    ) -> PyResult<Bound<'py, PyDict>> {
        let played = PyDict::new(py);
        for (id, name) in self.players.iter().enumerate() {
            if let (Some(name), Some(action)) = (name, engine.action_of(PlayerId(id as u8))) {
                played.set_item(name, action.index())?;
            }
        }
        Ok(played)
    }

    /// Values by term: a float for one agent, float64 `(n,)` for n.
    fn terms<'py>(
        &self,
        py: Python<'py>,
        engine: &Engine,
        values: for<'a> fn(&'a Engine, usize) -> &'a [f64],
    ) -> PyResult<Bound<'py, PyDict>> {
        let terms = PyDict::new(py);
        let n_agents = engine.n_agents();
        for (which, name) in self.terms.iter().enumerate() {
            let value = |agent| values(engine, agent).get(which).copied().unwrap_or_default();
            if n_agents == 1 {
                terms.set_item(name, value(0))?;
            } else {
                terms.set_item(name, PyArray1::from_iter(py, (0..n_agents).map(value)))?;
            }
        }
        Ok(terms)
    }

    /// An event: `x`, `y` normalised and `z` in metres, in the world's frame; `length` in metres,
    /// `speed` in m/s.
    fn event<'py>(&self, py: Python<'py>, event: &Event) -> PyResult<Bound<'py, PyDict>> {
        let dict = PyDict::new(py);
        let player =
            |id: Option<PlayerId>| id.and_then(|id| self.players.get(id.index())?.as_ref());
        let (x, y) = to_normalised(f64::from(event.at.x), f64::from(event.at.y));
        dict.set_item(intern!(py, "kind"), event.kind.name())?;
        dict.set_item(intern!(py, "qualifier"), event.qualifier.map(Qualifier::name))?;
        dict.set_item(intern!(py, "team"), event.team.map(Team::name))?;
        dict.set_item(intern!(py, "by"), player(event.by))?;
        dict.set_item(intern!(py, "to"), player(event.to))?;
        dict.set_item(intern!(py, "tick"), event.tick)?;
        dict.set_item(intern!(py, "x"), x)?;
        dict.set_item(intern!(py, "y"), y)?;
        dict.set_item(intern!(py, "z"), event.at.z)?;
        dict.set_item(intern!(py, "length"), event.length_m)?;
        dict.set_item(intern!(py, "speed"), event.speed_mps)?;
        Ok(dict)
    }
}

/// The records: floats (`None` if it could not be computed), `(x, y)` for a place, float64 arrays
/// for series: `(steps,)` or `(steps, 2)`. With several agents, values that depend on the agent are
/// lists.
pub(crate) fn records<'py>(py: Python<'py>, engine: &Engine) -> PyResult<Bound<'py, PyDict>> {
    let dict = PyDict::new(py);
    for (name, value) in engine.records() {
        dict.set_item(name, recorded(py, value)?)?;
    }
    Ok(dict)
}

fn recorded(py: Python<'_>, value: Recorded) -> PyResult<Bound<'_, PyAny>> {
    Ok(match value {
        Recorded::Number(value) => value.into_pyobject(py)?,
        Recorded::Place([x, y]) if x.is_nan() || y.is_nan() => py.None().into_bound(py),
        Recorded::Place([x, y]) => (x, y).into_pyobject(py)?.into_any(),
        Recorded::Numbers(values) => PyArray1::from_vec(py, values).into_any(),
        Recorded::Places(places) => {
            let n = places.len();
            PyArray1::from_vec(py, places.into_flattened()).reshape([n, 2])?.into_any()
        }
        Recorded::PerAgent(values) => {
            let values: PyResult<Vec<_>> =
                values.into_iter().map(|value| recorded(py, value)).collect();
            PyList::new(py, values?)?.into_any()
        }
    })
}

/// What the bot would press: an integer for one agent, int64 `(n,)` for n.
fn bot_action<'py>(py: Python<'py>, engine: &Engine) -> PyResult<Bound<'py, PyAny>> {
    let actions = engine.bot_actions();
    if let [one] = actions.as_slice() {
        return Ok(one.index().into_pyobject(py)?.into_any());
    }
    Ok(PyArray1::from_iter(py, actions.iter().map(|action| action.index() as i64)).into_any())
}

/// Writes which actions of a set have an effect for an agent, 1 or 0; zeros for unknown agents.
pub(crate) fn write_mask(set: ActionSet, engine: &Engine, agent: usize, row: &mut [i8]) {
    let Ok(mask) = observe::action_mask(engine.state(), agent) else { return row.fill(0) };
    for (out, action) in row.iter_mut().zip(set.masked()) {
        *out = i8::from(mask[action.index()]);
    }
}
