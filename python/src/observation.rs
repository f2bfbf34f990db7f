//! Observations: the engine's writers on `NumPy` arrays.

use crate::errors;
use numpy::ndarray::arr0;
use numpy::{Element, PyArray1, PyArrayDyn, PyArrayMethods, PyUntypedArrayMethods, ToPyArray};
use pyo3::intern;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple};
use setpiece::engine::environment::Environment as Engine;
use setpiece::engine::observe::layout::{SIMPLE115, simple115_bounds};
use setpiece::engine::observe::{ObserveError, Raw, RawTeam, SMM_HEIGHT, SMM_WIDTH, raw, simple115, smm};

/// Rows, columns and planes of a super mini map.
pub(crate) const SMM_SHAPE: (usize, usize, usize) = (SMM_HEIGHT, SMM_WIDTH, 4);

/// What is observed.
#[derive(Clone, Copy)]
pub(crate) enum Kind {
    /// float32 `(115,)`.
    Simple115v2,
    /// uint8 `(72, 96, 4)`.
    Smm,
    /// A dict.
    Raw,
    /// float32 `(n,)`: the scenario's own.
    Vector,
}

impl Kind {
    /// The kind of a name in `setpiece.make`.
    pub(crate) fn from_name(name: &str) -> Option<Kind> {
        match name {
            "simple115v2" => Some(Kind::Simple115v2),
            "smm" => Some(Kind::Smm),
            "raw" => Some(Kind::Raw),
            "vector" => Some(Kind::Vector),
            _ => None,
        }
    }
}

/// Writes observations; with several agents an array has a leading axis, raw observations are a tuple.
pub(crate) enum Observer {
    Simple115v2(Buffer<f32>),
    Smm(Buffer<u8>),
    Raw,
    Vector(Buffer<f32>),
}

/// An array of a shape: the same one every time, or a new one.
pub(crate) struct Buffer<T> {
    shape: Vec<usize>,
    shared: Option<Py<PyArrayDyn<T>>>,
}

impl Observer {
    /// Prepares observations of every agent; without `copy` arrays are written over by the next step.
    pub(crate) fn new(py: Python<'_>, kind: Kind, engine: &Engine, copy: bool) -> Observer {
        let n_agents = engine.n_agents();
        match kind {
            Kind::Simple115v2 => Observer::Simple115v2(Buffer::new(py, n_agents, &[SIMPLE115], copy)),
            Kind::Smm => Observer::Smm(Buffer::new(py, n_agents, &[SMM_SHAPE.0, SMM_SHAPE.1, SMM_SHAPE.2], copy)),
            Kind::Raw => Observer::Raw,
            Kind::Vector => Observer::Vector(Buffer::new(py, n_agents, &[engine.observed_names().len()], copy)),
        }
    }

    /// What the agents see of the match as it stands.
    pub(crate) fn observe<'py>(&self, py: Python<'py>, engine: &mut Engine) -> PyResult<Bound<'py, PyAny>> {
        let n_agents = engine.n_agents();
        if let Observer::Vector(buffer) = self {
            return buffer.fill(py, n_agents, |agent, out| engine.observe_vector(agent, out));
        }
        let game = engine.state();
        match self {
            Observer::Vector(_) => Ok(py.None().into_bound(py)),
            Observer::Simple115v2(buffer) => buffer.fill(py, n_agents, |agent, out| simple115(game, agent, out)),
            Observer::Smm(buffer) => {
                buffer.fill(py, n_agents, |agent, out| smm(game, agent, SMM_WIDTH, SMM_HEIGHT, out))
            }
            Observer::Raw => {
                let part = |agent| raw_to_python(py, &raw(game, agent).map_err(|why| from_observe(py, why))?);
                if n_agents == 1 {
                    return Ok(part(0)?.into_any());
                }
                let parts: PyResult<Vec<_>> = (0..n_agents).map(part).collect();
                Ok(PyTuple::new(py, parts?)?.into_any())
            }
        }
    }
}

impl<T: Element> Buffer<T> {
    fn new(py: Python<'_>, n_agents: usize, one: &[usize], copy: bool) -> Buffer<T> {
        let mut shape = one.to_vec();
        if n_agents != 1 {
            shape.insert(0, n_agents);
        }
        let shared = (!copy).then(|| PyArrayDyn::zeros(py, shape.clone(), false).unbind());
        Buffer { shape, shared }
    }

    fn fill<'py>(
        &self,
        py: Python<'py>,
        n_agents: usize,
        mut write: impl FnMut(usize, &mut [T]) -> Result<(), ObserveError>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let array = match &self.shared {
            Some(array) => array.bind(py).clone(),
            None => PyArrayDyn::zeros(py, self.shape.as_slice(), false),
        };
        // Only a shared array can be: a user has set its flag.
        let read_only =
            "the array of observations is read-only: leave it writeable, or make the environment with `copy=True`";
        let locked = || errors::raise_plain(py, "SetpieceError", read_only);
        let mut guard = array.try_readwrite().map_err(|_| locked())?;
        let values = guard.as_slice_mut().map_err(|_| locked())?;
        for (agent, out) in values.chunks_exact_mut((array.len() / n_agents.max(1)).max(1)).enumerate() {
            write(agent, out).map_err(|why| from_observe(py, why))?;
        }
        drop(guard);
        Ok(array.into_any())
    }
}

fn from_observe(py: Python<'_>, why: ObserveError) -> PyErr {
    errors::raise_plain(py, "SetpieceError", &why.to_string())
}

/// Least and greatest value of every number of `simple115v2`: two float32 `(115,)`.
#[pyfunction]
pub(crate) fn simple115v2_bounds(py: Python<'_>) -> (Bound<'_, PyArray1<f32>>, Bound<'_, PyArray1<f32>>) {
    let (low, high) = simple115_bounds();
    (low.to_pyarray(py), high.to_pyarray(py))
}

fn raw_to_python<'py>(py: Python<'py>, raw: &Raw) -> PyResult<Bound<'py, PyDict>> {
    let dict = PyDict::new(py);
    dict.set_item(intern!(py, "ball"), raw.ball.to_pyarray(py))?;
    dict.set_item(intern!(py, "ball_direction"), raw.ball_direction.to_pyarray(py))?;
    dict.set_item(intern!(py, "ball_rotation"), raw.ball_rotation.to_pyarray(py))?;
    dict.set_item(intern!(py, "ball_owned_team"), raw.ball_owned_team)?;
    dict.set_item(intern!(py, "ball_owned_player"), raw.ball_owned_player)?;
    write_team(&dict, "left_team", &raw.left)?;
    write_team(&dict, "right_team", &raw.right)?;
    dict.set_item(intern!(py, "designated"), raw.designated)?;
    dict.set_item(intern!(py, "active"), raw.active)?;
    dict.set_item(intern!(py, "sticky_actions"), raw.sticky_actions.to_pyarray(py))?;
    dict.set_item(intern!(py, "score"), raw.score.to_pyarray(py))?;
    dict.set_item(intern!(py, "steps_left"), arr0(raw.steps_left).to_pyarray(py))?;
    dict.set_item(intern!(py, "game_mode"), raw.game_mode)?;
    Ok(dict)
}

fn write_team(dict: &Bound<'_, PyDict>, side: &str, team: &RawTeam) -> PyResult<()> {
    let py = dict.py();
    let pairs = |pairs: &[[f64; 2]]| pairs.as_flattened().to_pyarray(py).reshape([pairs.len(), 2]);
    dict.set_item(side, pairs(&team.places)?)?;
    dict.set_item(format!("{side}_direction"), pairs(&team.directions)?)?;
    dict.set_item(format!("{side}_tired_factor"), team.tired_factors.to_pyarray(py))?;
    dict.set_item(format!("{side}_yellow_card"), team.yellow_cards.to_pyarray(py))?;
    dict.set_item(format!("{side}_active"), team.active.to_pyarray(py))?;
    dict.set_item(format!("{side}_roles"), team.roles.to_pyarray(py))
}
