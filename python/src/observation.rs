//! Observations: the engine's writers on `NumPy` arrays.

use crate::errors;
use numpy::ndarray::arr0;
use numpy::{Element, PyArray1, PyArrayDyn, PyArrayMethods, PyUntypedArrayMethods, ToPyArray};
use pyo3::intern;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple};
use setpiece::engine::environment::Environment as Engine;
use setpiece::engine::observe::{Floats, ObserveError, Raw, RawTeam, raw, smm};
use setpiece::pixels::PixelEye;
use setpiece::render::Pixels;

/// Planes of a super mini map.
const PLANES: usize = 4;

/// The kind of an observation.
#[derive(Clone, Copy, PartialEq)]
pub(crate) enum ObservationKind {
    /// float32 `(n,)`.
    Floats(Floats),
    /// uint8 `(height, width, 4)`.
    Smm {
        /// Pixels across.
        width: usize,
        /// Pixels down.
        height: usize,
    },
    /// uint8 `(height, width, 3)`, or `(height, width, 1)` in gray.
    Pixels(Pixels),
    /// A dict.
    Raw,
}

impl ObservationKind {
    /// The kind of a name in `setpiece.make`; `size` is the width and height of a map or a picture.
    fn from_name(name: &str, (width, height): (usize, usize)) -> Option<ObservationKind> {
        Some(match name {
            "simple115" => ObservationKind::Floats(Floats::Simple115),
            "simple115v2" => ObservationKind::Floats(Floats::Simple115v2),
            "simple115v2+sticky" => ObservationKind::Floats(Floats::Simple115v2Sticky),
            "egocentric" => ObservationKind::Floats(Floats::Egocentric),
            "vector" => ObservationKind::Floats(Floats::Vector),
            "smm" => ObservationKind::Smm { width, height },
            "pixels" => ObservationKind::Pixels(Pixels { height, width, gray: false }),
            "pixels_gray" => ObservationKind::Pixels(Pixels { height, width, gray: true }),
            "raw" => ObservationKind::Raw,
            _ => return None,
        })
    }

    /// The scaled form; none for kinds without floats or without known units.
    fn scaled(self) -> Option<ObservationKind> {
        let ObservationKind::Floats(floats) = self else { return None };
        floats.scaled().map(ObservationKind::Floats)
    }

    /// The shape of one agent's observation, `stack` of them on the last axis; empty for a dict.
    pub(crate) fn shape(self, engine: &Engine, stack: usize) -> Vec<usize> {
        match self {
            ObservationKind::Floats(floats) => vec![engine.layout(floats).len() * stack],
            ObservationKind::Smm { width, height } => vec![height, width, PLANES * stack],
            ObservationKind::Pixels(pixels) => {
                vec![pixels.height, pixels.width, pixels.channels() * stack]
            }
            ObservationKind::Raw => Vec::new(),
        }
    }

    /// Numbers on the last axis of one observation.
    pub(crate) fn planes(self, engine: &Engine) -> usize {
        self.shape(engine, 1).last().copied().unwrap_or_default()
    }
}

/// The observation that a caller requests.
#[derive(Clone, Copy)]
pub(crate) struct Wanted<'a> {
    /// Its name in `setpiece.make`.
    pub(crate) name: &'a str,
    /// Width and height of a map.
    pub(crate) size: (usize, usize),
    /// Whether floats are scaled.
    pub(crate) scale: bool,
}

impl Wanted<'_> {
    /// The kind of observation, if the scenario has it.
    pub(crate) fn of(self, py: Python<'_>, engine: &Engine) -> PyResult<ObservationKind> {
        let name = self.name;
        let kind = ObservationKind::from_name(name, self.size).ok_or_else(|| {
            errors::parameter(py, "observation", &format!("no observation `{name}`"))
        })?;
        if kind == ObservationKind::Floats(Floats::Vector) && engine.observed_names().is_empty() {
            let scenario = &engine.scenario().name;
            let message =
                format!("`{scenario}` declares no observation: it has no `observe vector {{ … }}`");
            return Err(errors::parameter(py, "observation", &message));
        }
        if !self.scale {
            return Ok(kind);
        }
        kind.scaled()
            .ok_or_else(|| errors::parameter(py, "scale", &format!("`{name}` can't be scaled")))
    }
}

/// How observations are returned.
#[derive(Clone, Copy)]
pub(crate) struct ObservationForm {
    /// How many of the latest observations are shown at once.
    pub(crate) stack: usize,
    /// Whether every call returns a new array.
    pub(crate) copy: bool,
}

impl ObservationForm {
    /// One observation, in a new array.
    pub(crate) const FRESH: ObservationForm = ObservationForm { stack: 1, copy: true };
}

/// A block of numbers on the last axis of an observation of floats.
#[pyclass(frozen, get_all, module = "setpiece._native")]
pub(crate) struct BlockInfo {
    /// The first of its numbers.
    start: usize,
    /// How many there are.
    length: usize,
    /// Their meaning.
    meaning: String,
    /// Their unit.
    unit: &'static str,
}

/// Writes the observation of one agent as floats.
pub(crate) fn write_floats(
    floats: Floats,
    engine: &mut Engine,
    agent: usize,
    out: &mut [f32],
) -> Result<(), ObserveError> {
    engine.observe(floats, agent, out)
}

/// Writes observations of bytes.
pub(crate) enum ByteWriter {
    /// A super mini map, with its width and height.
    Map(usize, usize),
    /// A picture.
    Picture(Box<PixelEye>),
}

impl ByteWriter {
    /// The writer of a kind of observation; none for those that aren't bytes.
    pub(crate) fn of(py: Python<'_>, kind: ObservationKind) -> PyResult<Option<ByteWriter>> {
        Ok(match kind {
            ObservationKind::Smm { width, height } => Some(ByteWriter::Map(width, height)),
            ObservationKind::Pixels(pixels) => {
                let eye = PixelEye::new(pixels)
                    .map_err(|why| errors::parameter(py, "size", &why.to_string()))?;
                Some(ByteWriter::Picture(Box::new(eye)))
            }
            ObservationKind::Floats(_) | ObservationKind::Raw => None,
        })
    }

    /// Writes what one agent sees.
    pub(crate) fn write(
        &mut self,
        engine: &Engine,
        agent: usize,
        out: &mut [u8],
    ) -> Result<(), ObserveError> {
        match self {
            ByteWriter::Map(width, height) => smm(engine.state(), agent, *width, *height, out),
            ByteWriter::Picture(eye) => eye.write(engine, agent, out),
        }
    }
}

/// The latest observations of several agents, stacked on the last axis, the oldest first.
#[derive(Clone)]
pub(crate) struct Stack<T> {
    depth: usize,
    planes: usize,
    fresh: Vec<T>,
}

impl<T: Element + Copy + Default> Stack<T> {
    /// For observations of `one` numbers, `planes` of them on the last axis.
    pub(crate) fn new(depth: usize, planes: usize, one: usize) -> Stack<T> {
        Stack { depth, planes, fresh: if depth > 1 { vec![T::default(); one] } else { Vec::new() } }
    }

    /// Appends the latest observation to those in `held`, replacing the oldest. The first one of an
    /// episode fills all places.
    pub(crate) fn push(
        &mut self,
        held: &mut [T],
        first: bool,
        write: impl FnOnce(&mut [T]) -> Result<(), ObserveError>,
    ) -> Result<(), ObserveError> {
        if self.depth == 1 {
            return write(held);
        }
        write(&mut self.fresh)?;
        let (planes, row) = (self.planes.max(1), self.planes.max(1) * self.depth);
        // One move for all pixels: what comes from the next pixel is overwritten below.
        held.copy_within(planes.min(held.len()).., 0);
        let written = if first { 0 } else { row - planes };
        for (pixel, fresh) in held.chunks_exact_mut(row).zip(self.fresh.chunks_exact(planes)) {
            // No slices are copied: calls for a few bytes would cost more than the bytes.
            for place in pixel[written..].chunks_exact_mut(planes) {
                for (place, fresh) in place.iter_mut().zip(fresh) {
                    *place = *fresh;
                }
            }
        }
        Ok(())
    }
}

/// Writes observations; with several agents an array has a leading axis, raw observations are a
/// tuple.
pub(crate) enum Observer {
    /// Arrays of float32.
    Floats(Floats, ObservationArrays<f32>),
    /// Arrays of uint8.
    Bytes(ByteWriter, ObservationArrays<u8>),
    /// Dicts, with this number of held actions.
    Raw(usize),
}

/// The arrays of an environment: always the same one, or a new one each time.
pub(crate) struct ObservationArrays<T> {
    shape: Vec<usize>,
    shared: Option<Py<PyArrayDyn<T>>>,
    stack: Stack<T>,
    /// The content of all agents' stacks; empty without stacks.
    held: Vec<T>,
}

impl Observer {
    /// Prepares observations of every agent; without `copy` the next step overwrites the arrays.
    pub(crate) fn new(
        py: Python<'_>,
        kind: ObservationKind,
        engine: &Engine,
        ObservationForm { stack, copy }: ObservationForm,
        held_actions: usize,
    ) -> PyResult<Observer> {
        let (shape, planes) = (kind.shape(engine, stack), kind.planes(engine));
        let n_agents = engine.n_agents();
        if let Some(writer) = ByteWriter::of(py, kind)? {
            let arrays = ObservationArrays::new(py, n_agents, shape, (stack, planes), copy);
            return Ok(Observer::Bytes(writer, arrays));
        }
        Ok(match kind {
            ObservationKind::Floats(floats) => Observer::Floats(
                floats,
                ObservationArrays::new(py, n_agents, shape, (stack, planes), copy),
            ),
            _ => Observer::Raw(held_actions),
        })
    }

    /// The agents' observations of the current match; `first` in an episode.
    pub(crate) fn observe<'py>(
        &mut self,
        py: Python<'py>,
        engine: &mut Engine,
        first: bool,
    ) -> PyResult<Bound<'py, PyAny>> {
        let n_agents = engine.n_agents();
        match self {
            Observer::Floats(floats, film) => film
                .fill(py, n_agents, first, |agent, out| write_floats(*floats, engine, agent, out)),
            Observer::Bytes(writer, film) => {
                film.fill(py, n_agents, first, |agent, out| writer.write(engine, agent, out))
            }
            Observer::Raw(held) => {
                let game = engine.state();
                let part = |agent| {
                    let raw = raw(game, agent).map_err(|why| from_observe(py, why))?;
                    raw_to_python(py, &raw, *held)
                };
                if n_agents == 1 {
                    return Ok(part(0)?.into_any());
                }
                let parts: PyResult<Vec<_>> = (0..n_agents).map(part).collect();
                Ok(PyTuple::new(py, parts?)?.into_any())
            }
        }
    }

    /// The content of a stack, as bytes; empty without a stack.
    pub(crate) fn frames(&self) -> Vec<u8> {
        match self {
            Observer::Floats(_, film) => {
                film.held.iter().flat_map(|value| value.to_le_bytes()).collect()
            }
            Observer::Bytes(_, film) => film.held.clone(),
            Observer::Raw(_) => Vec::new(),
        }
    }

    /// Restores the content of a stack; no-op if the size differs.
    pub(crate) fn set_frames(&mut self, bytes: &[u8]) {
        match self {
            Observer::Floats(_, film) if bytes.len() == 4 * film.held.len() => {
                for (held, value) in film.held.iter_mut().zip(bytes.chunks_exact(4)) {
                    *held = f32::from_le_bytes([value[0], value[1], value[2], value[3]]);
                }
            }
            Observer::Bytes(_, film) if bytes.len() == film.held.len() => {
                film.held.copy_from_slice(bytes);
            }
            _ => {}
        }
    }
}

impl<T: Element + Copy + Default> ObservationArrays<T> {
    fn new(
        py: Python<'_>,
        n_agents: usize,
        one: Vec<usize>,
        (depth, planes): (usize, usize),
        copy: bool,
    ) -> ObservationArrays<T> {
        let numbers: usize = one.iter().product();
        let mut shape = one;
        if n_agents != 1 {
            shape.insert(0, n_agents);
        }
        let shared = (!copy).then(|| PyArrayDyn::zeros(py, shape.clone(), false).unbind());
        let held = if depth > 1 { vec![T::default(); numbers * n_agents] } else { Vec::new() };
        ObservationArrays {
            shape,
            shared,
            stack: Stack::new(depth, planes, numbers / depth.max(1)),
            held,
        }
    }

    fn fill<'py>(
        &mut self,
        py: Python<'py>,
        n_agents: usize,
        first: bool,
        mut write: impl FnMut(usize, &mut [T]) -> Result<(), ObserveError> + Send,
    ) -> PyResult<Bound<'py, PyAny>> {
        let array = match &self.shared {
            Some(array) => array.bind(py).clone(),
            None => PyArrayDyn::zeros(py, self.shape.as_slice(), false),
        };
        // Only a shared array can be read-only, if the user has set its flag.
        let read_only = "the array of observations is read-only: leave it writeable, or make the environment with `copy=True`";
        let locked = || errors::raise_plain(py, "SetpieceError", read_only);
        let mut guard = array.try_readwrite().map_err(|_| locked())?;
        let values = guard.as_slice_mut().map_err(|_| locked())?;
        let one = (array.len() / n_agents.max(1)).max(1);
        let target = if self.held.is_empty() { &mut *values } else { &mut self.held };
        let stack = &mut self.stack;
        let written = py.detach(|| {
            let mut agents = target.chunks_exact_mut(one).enumerate();
            agents.try_for_each(|(agent, out)| stack.push(out, first, |out| write(agent, out)))
        });
        written.map_err(|why| from_observe(py, why))?;
        if !self.held.is_empty() {
            values.copy_from_slice(&self.held);
        }
        drop(guard);
        Ok(array.into_any())
    }
}

/// The exception of an observation that can't be written.
pub(crate) fn from_observe(py: Python<'_>, why: ObserveError) -> PyErr {
    errors::raise_plain(py, "SetpieceError", &why.to_string())
}

/// The blocks of an observation of floats; none for others.
pub(crate) fn blocks(kind: ObservationKind, engine: &Engine) -> Vec<BlockInfo> {
    let ObservationKind::Floats(floats) = kind else { return Vec::new() };
    let blocks = engine.layout(floats).blocks.into_iter();
    blocks
        .map(|block| BlockInfo {
            start: block.start,
            length: block.len,
            meaning: block.meaning,
            unit: block.unit,
        })
        .collect()
}

/// Bounds of every number of one observation of floats, float32 `(n,)`.
#[pyclass(frozen, get_all, module = "setpiece._native")]
pub(crate) struct Bounds {
    low: Py<PyArray1<f32>>,
    high: Py<PyArray1<f32>>,
}

/// The bounds of an observation of floats.
pub(crate) fn bounds(py: Python<'_>, floats: Floats, engine: &Engine) -> Bounds {
    let (low, high) = engine.layout(floats).bounds();
    Bounds { low: low.to_pyarray(py).unbind(), high: high.to_pyarray(py).unbind() }
}

fn raw_to_python<'py>(py: Python<'py>, raw: &Raw, held: usize) -> PyResult<Bound<'py, PyDict>> {
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
    dict.set_item(
        intern!(py, "sticky_actions"),
        raw.sticky_actions[..held.min(raw.sticky_actions.len())].to_pyarray(py),
    )?;
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
