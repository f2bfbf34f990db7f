//! Observations in pixels: what an agent sees of a match, drawn.

use crate::engine::environment::Environment;
use crate::engine::observe::ObserveError;
use crate::scene::seen_by;
use setpiece_render::{Options, PixelObserver, Pixels, RenderError, Scene};

/// Writes observations in pixels. It keeps the memory that drawing needs.
#[derive(Debug)]
pub struct PixelEye {
    observer: PixelObserver,
    scene: Scene,
}

impl PixelEye {
    /// Prepares observations of a shape.
    ///
    /// # Errors
    /// [`RenderError::Size`] for sides that can't be drawn.
    pub fn new(pixels: Pixels) -> Result<PixelEye, RenderError> {
        let observer = PixelObserver::new(pixels, Options::default())?;
        Ok(PixelEye { observer, scene: Scene::default() })
    }

    /// Writes what an agent sees: [`Pixels::len`] bytes.
    ///
    /// # Errors
    /// [`ObserveError::Agent`] for an unknown agent, [`ObserveError::Size`] for another number of
    /// bytes.
    pub fn write(
        &mut self,
        environment: &Environment,
        agent: usize,
        out: &mut [u8],
    ) -> Result<(), ObserveError> {
        let n_agents = environment.n_agents();
        if agent >= n_agents {
            return Err(ObserveError::Agent { agent, n_agents });
        }
        seen_by(environment.state(), agent, &mut self.scene);
        let (found, expected) = (out.len(), self.observer.pixels().len());
        self.observer.observe(&self.scene, out).map_err(|_| ObserveError::Size { expected, found })
    }
}
