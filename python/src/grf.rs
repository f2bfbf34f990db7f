//! Texts of scenario scripts of Google Research Football.

use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use setpiece::grf::{GrfPlayer, GrfScenario, TranslationError, identifier, to_pitch};
use setpiece::scenario::vocabulary::Role;

/// A valid name for a scenario: that of a level, or of a path without folder and ending.
#[pyfunction]
pub(crate) fn grf_name(name: &str) -> String {
    identifier(name)
}

/// The text of a recorded script: its `ScenarioConfig` of an even episode, and that of an odd one.
/// `TranslationError` if a text can't alternate between them.
#[pyfunction]
pub(crate) fn grf_text(
    py: Python<'_>,
    recorded: &Bound<'_, PyAny>,
    other: &Bound<'_, PyAny>,
    name: &str,
) -> PyResult<String> {
    to_pitch(&scenario(recorded)?, &scenario(other)?, name).map_err(|why| raised(py, &why))
}

fn raised(py: Python<'_>, why: &TranslationError) -> PyErr {
    let raise = || {
        let fields = PyDict::new(py);
        fields.set_item("help", why.help())?;
        let class = py.import("setpiece.gfootball._translation")?.getattr("TranslationError")?;
        class.call((why.to_string(),), Some(&fields))
    };
    raise().map_or_else(|failed: PyErr| failed, PyErr::from_value)
}

fn scenario(given: &Bound<'_, PyAny>) -> PyResult<GrfScenario> {
    let flag = |name: &str| -> PyResult<bool> { given.getattr(name)?.is_truthy() };
    let number = |name: &str| -> PyResult<f64> { given.getattr(name)?.extract() };
    let count = |name: &str| -> PyResult<i64> { whole(&given.getattr(name)?) };
    let players = |name: &str| -> PyResult<Vec<GrfPlayer>> {
        given.getattr(name)?.try_iter()?.map(|it| player(&it?)).collect()
    };
    let ball = given.getattr("ball_position")?;
    Ok(GrfScenario {
        ball_position: point(&ball)?,
        left_team: players("left_team")?,
        right_team: players("right_team")?,
        left_agents: count("left_agents")?,
        right_agents: count("right_agents")?,
        game_duration: count("game_duration")?,
        second_half: count("second_half")?,
        deterministic: flag("deterministic")?,
        offsides: flag("offsides")?,
        end_episode_on_score: flag("end_episode_on_score")?,
        end_episode_on_out_of_play: flag("end_episode_on_out_of_play")?,
        end_episode_on_possession_change: flag("end_episode_on_possession_change")?,
        left_team_difficulty: number("left_team_difficulty")?,
        right_team_difficulty: number("right_team_difficulty")?,
        control_all_players: flag("control_all_players")?,
        use_magnet: flag("use_magnet")?,
        game_engine_random_seed: count("game_engine_random_seed")?,
        real_time: flag("real_time")?,
    })
}

fn player(given: &Bound<'_, PyAny>) -> PyResult<GrfPlayer> {
    let role: usize = given.getattr("role")?.extract()?;
    let role = Role::ALL.get(role).copied();
    Ok(GrfPlayer {
        place: point(&given.getattr("position")?)?,
        role: role.ok_or_else(|| PyValueError::new_err("no such role"))?,
        lazy: given.getattr("lazy")?.is_truthy()?,
        controllable: given.getattr("controllable")?.is_truthy()?,
    })
}

fn point(given: &Bound<'_, PyAny>) -> PyResult<[f64; 2]> {
    Ok([given.get_item(0)?.extract()?, given.get_item(1)?.extract()?])
}

/// A whole number; one that is too large for the engine is the largest that isn't.
fn whole(given: &Bound<'_, PyAny>) -> PyResult<i64> {
    match given.extract::<i64>() {
        Ok(whole) => Ok(whole),
        Err(_) if given.gt(0)? => Ok(i64::MAX),
        Err(_) => Ok(i64::MIN),
    }
}
