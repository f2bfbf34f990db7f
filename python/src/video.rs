//! Videos of recorded episodes and of scenes.

use crate::errors;
use crate::picture::camera_of;
use crate::replay::Replay;
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use setpiece::film::replayed;
use setpiece::render::Scene;
use setpiece::video::{Quality, VideoError, VideoFormat, VideoOptions, video};

/// A moment of a match as it is drawn, to be kept for a video.
#[pyclass(frozen, module = "setpiece._native")]
pub(crate) struct Moment {
    scene: Scene,
}

impl Moment {
    pub(crate) fn of(scene: Scene) -> Moment {
        Moment { scene }
    }
}

/// What a video looks like.
#[derive(FromPyObject)]
pub(crate) struct VideoForm {
    #[pyo3(item)]
    format: String,
    #[pyo3(item)]
    size: (usize, usize),
    #[pyo3(item)]
    camera: String,
    #[pyo3(item)]
    speed: f64,
    #[pyo3(item)]
    quality: String,
}

impl VideoForm {
    fn read(&self, py: Python<'_>) -> PyResult<(VideoFormat, VideoOptions)> {
        let wrong =
            |name: &str, value: &str| errors::parameter(py, name, &format!("no {name} `{value}`"));
        let format =
            VideoFormat::of_ending(&self.format).ok_or_else(|| wrong("format", &self.format))?;
        let quality =
            Quality::from_name(&self.quality).ok_or_else(|| wrong("quality", &self.quality))?;
        let options = VideoOptions {
            size: self.size,
            camera: camera_of(py, &self.camera)?,
            speed: self.speed,
            steps: 0..=u32::MAX,
            quality,
        };
        Ok((format, options))
    }
}

fn from_video(py: Python<'_>, why: &VideoError) -> PyErr {
    let name = match why {
        VideoError::Render(_) | VideoError::Odd { .. } => "size",
        VideoError::Speed(_) => "speed",
        VideoError::Empty { .. } | VideoError::Encode(_) => "path",
    };
    errors::parameter(py, name, &why.to_string())
}

fn encoded<'py>(
    py: Python<'py>,
    scenes: &[Scene],
    form: &VideoForm,
) -> PyResult<Bound<'py, PyBytes>> {
    let (format, options) = form.read(py)?;
    let made = py.detach(|| video(scenes, format, &options, &mut |_, _| {}));
    Ok(PyBytes::new(py, &made.map_err(|why| from_video(py, &why))?))
}

/// The video of a recorded episode, as the bytes of its file.
#[pyfunction]
pub(crate) fn replay_video<'py>(
    py: Python<'py>,
    replay: &Replay,
    form: VideoForm,
) -> PyResult<Bound<'py, PyBytes>> {
    let film =
        py.detach(|| replayed(replay.inner())).map_err(|error| errors::from_facade(py, &error))?;
    encoded(py, &film.scenes, &form)
}

/// The video of moments that follow each other, as the bytes of its file.
#[pyfunction]
pub(crate) fn moments_video<'py>(
    py: Python<'py>,
    moments: Vec<PyRef<'py, Moment>>,
    form: VideoForm,
) -> PyResult<Bound<'py, PyBytes>> {
    let scenes: Vec<Scene> = moments.iter().map(|moment| moment.scene.clone()).collect();
    encoded(py, &scenes, &form)
}
