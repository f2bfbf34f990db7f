//! Frames for people.

use crate::errors;
use numpy::{PyArray3, PyArrayMethods};
use pyo3::prelude::*;
use setpiece::engine::environment::Environment as Engine;
use setpiece::render::{Camera, Options, PitchRegion, Renderer, Scene};
use setpiece::scene::{SceneWriter, of_match};

/// The camera of a name.
pub(crate) fn camera_of(py: Python<'_>, name: &str) -> PyResult<Camera> {
    match name {
        "broadcast" => Ok(Camera::Broadcast),
        "above" => Ok(Camera::Above(PitchRegion::Whole)),
        other => Err(errors::parameter(py, "camera", &format!("no camera `{other}`"))),
    }
}

/// Draws a match for people.
#[derive(Default)]
pub(crate) struct Frames {
    writer: SceneWriter,
    scene: Scene,
    renderer: Option<(Camera, Renderer)>,
}

impl Frames {
    /// Follows an episode: call it after each reset.
    pub(crate) fn begin(&mut self) {
        self.writer.begin();
    }

    /// Follows an episode: call it after each step.
    pub(crate) fn note(&mut self, engine: &Engine) {
        self.writer.note(engine);
    }

    /// The current moment; `judged`: where play was stopped, before the restart.
    pub(crate) fn moment(&self, engine: &Engine, judged: bool) -> Scene {
        let mut scene = Scene::default();
        if judged {
            self.writer.write_judged(engine, &mut scene);
        } else {
            self.writer.write(engine, &mut scene);
        }
        scene
    }

    /// The current frame: uint8 `(height, width, 3)`. Without `news` it depends on the state alone.
    pub(crate) fn frame<'py>(
        &mut self,
        py: Python<'py>,
        engine: &Engine,
        (width, height): (usize, usize),
        camera: &str,
        news: bool,
    ) -> PyResult<Bound<'py, PyArray3<u8>>> {
        let camera = camera_of(py, camera)?;
        let fits = |(held, renderer): &(Camera, Renderer)| {
            *held == camera && (renderer.width(), renderer.height()) == (width, height)
        };
        if !self.renderer.as_ref().is_some_and(fits) {
            let options = Options { camera, ..Options::default() };
            let renderer = Renderer::new(width, height, options)
                .map_err(|why| errors::parameter(py, "render_size", &why.to_string()))?;
            self.renderer = Some((camera, renderer));
        }
        let array = PyArray3::zeros(py, [height, width, 3], false);
        let mut guard = array.readwrite();
        if let (Some((_, renderer)), Ok(pixels)) = (&mut self.renderer, guard.as_slice_mut()) {
            let (writer, scene) = (&self.writer, &mut self.scene);
            let drawn = py.detach(|| {
                if news {
                    writer.write(engine, scene);
                } else {
                    of_match(engine.state(), scene);
                }
                renderer.render_rgb(scene, pixels)
            });
            drawn.map_err(|why| errors::parameter(py, "render_size", &why.to_string()))?;
        }
        drop(guard);
        Ok(array)
    }
}
