//! The scenarios that a batch plays: whoever learns sees no difference between them.

use crate::observation::ObservationKind;
use setpiece::engine::environment::{Environment as Engine, EnvironmentError, EnvironmentOptions};
use setpiece::levels::ChosenLevel;
use setpiece::scenario::{Bindings, Team};
use std::sync::Arc;

/// A scenario of a batch.
pub(super) struct BatchStage {
    /// An engine that has played nothing; lanes copy it.
    pub(super) engine: Engine,
    /// The column of each of its reward terms among those of the batch.
    pub(super) columns: Vec<usize>,
    /// The observation of every lane.
    pub(super) kind: ObservationKind,
}

/// A level that a lane begins next.
pub(super) struct Upcoming {
    pub(super) stage: Arc<BatchStage>,
    pub(super) bindings: Bindings,
    pub(super) seed: u64,
    pub(super) episode: u64,
    /// What the source has chosen, if it wants to know the result.
    pub(super) chosen: Option<ChosenLevel>,
}

/// Why a level can't begin.
pub(super) enum Unfit {
    /// Its parameters aren't allowed.
    Engine(EnvironmentError),
    /// It would change the spaces of the vector: how.
    Spaces(String),
}

impl BatchStage {
    /// Writes an agent's terms into the row of the batch's, whose other columns are 0.
    pub(super) fn enter(&self, terms: &[f64], row: &mut [f64]) {
        if terms.len() < row.len() {
            row.fill(0.0);
        }
        for (&column, &paid) in self.columns.iter().zip(terms) {
            row[column] = paid;
        }
    }

    /// Binds parameters of an engine of this stage. If they change who plays, another engine takes
    /// its place.
    pub(super) fn bind(&self, engine: &mut Engine, bindings: &Bindings) -> Result<(), Unfit> {
        match engine.set_bindings(bindings) {
            Err(EnvironmentError::Roster) => {}
            other => return other.map_err(Unfit::Engine),
        }
        let options =
            EnvironmentOptions { bindings: Some(bindings.clone()), ..engine.options().clone() };
        let other = Engine::new(engine.scenario().clone(), options).map_err(Unfit::Engine)?;
        differs(self.kind, &self.engine, &other).map_or(Ok(()), |how| Err(Unfit::Spaces(how)))?;
        *engine = other;
        Ok(())
    }
}

/// How the agents or the observations of two engines differ, in words; none if they don't.
pub(super) fn differs(kind: ObservationKind, first: &Engine, other: &Engine) -> Option<String> {
    let agents = |engine: &Engine| {
        let of = |team| engine.roster().agents.iter().filter(|(its, _)| *its == team).count();
        [of(Team::Left), of(Team::Right)]
    };
    let ([left, right], [other_left, other_right]) = (agents(first), agents(other));
    if (left, right) != (other_left, other_right) {
        return Some(format!(
            "it has {other_left} agents on the left and {other_right} on the right, and the vector has {left} and {right}"
        ));
    }
    let (shape, other_shape) = (kind.shape(first, 1), kind.shape(other, 1));
    if shape != other_shape {
        return Some(format!(
            "its observations have the shape {other_shape:?}, and those of the vector {shape:?}"
        ));
    }
    let ObservationKind::Floats(floats) = kind else { return None };
    (first.layout(floats) != other.layout(floats))
        .then(|| "its observations have other numbers than those of the vector".to_owned())
}
