//! Rendering: Ctrl-C and the caller's own callback are looked at about twenty times a second, the lock is free between.

use antumbra::light::Light;
use antumbra::light::sky::Sky;
use antumbra::render;
use antumbra::scene::{Message, builtin};
use antumbra::schedule::{Flow, Progress};
use antumbra::settings::Settings;
use pyo3::prelude::*;

use crate::picture::Picture;
use crate::scene::{PyScene, environment_file};
use crate::{errors, settings};

/// What the watcher of a render found out.
#[derive(Default)]
struct Watched {
    interrupted: bool,
    raised: Option<PyErr>,
}

#[pymethods]
impl PyScene {
    /// Renders: the picture (None if no pass was done), and whether Ctrl-C ended it. `watch(passes_done, passes, share)`
    /// is called about twenty times a second; `False` ends the render.
    #[pyo3(signature = (words, watch = None))]
    fn render(
        &self,
        py: Python<'_>,
        words: Vec<(String, String)>,
        watch: Option<Py<PyAny>>,
    ) -> PyResult<(Option<Picture>, bool)> {
        let mut settings = settings::parse(&words)?;
        self.relate(&mut settings);
        let (around, told) = environment(py, &settings)?;
        let scene = self.scene(py)?;
        let mut watched = Watched::default();
        let rendered = py.detach(|| {
            render::render(&scene, &settings, around, &mut |progress| {
                Python::attach(|py| look(py, watch.as_ref(), progress, &mut watched))
            })
        });
        if let Some(error) = watched.raised {
            return Err(error);
        }
        let mut rendered = rendered.map_err(|e| errors::scene(&e, self.file()))?;
        rendered.messages.extend(told);
        let some = rendered.passes_done > 0;
        Ok((some.then(|| Picture::new(rendered, &settings)), watched.interrupted))
    }

    /// Width and height of the picture that these settings ask for.
    fn picture_size(&self, py: Python<'_>, words: Vec<(String, String)>) -> PyResult<[u32; 2]> {
        let mut settings = settings::parse(&words)?;
        self.relate(&mut settings);
        let scene = self.scene(py)?;
        render::picture_size(&scene, &settings).map_err(|e| errors::scene(&e, self.file()))
    }
}

/// One look: Ctrl-C first, then the caller's callback.
fn look(py: Python<'_>, watch: Option<&Py<PyAny>>, progress: Progress, watched: &mut Watched) -> Flow {
    if py.check_signals().is_err() {
        watched.interrupted = true;
        return Flow::Stop;
    }
    let Some(watch) = watch else { return Flow::Continue };
    let share = progress.done as f64 / progress.total.max(1) as f64;
    match watch.call1(py, (progress.passes_done, progress.passes, share)) {
        Ok(answer) if answer.bind(py).is(pyo3::types::PyBool::new(py, false).as_any()) => Flow::Stop,
        Ok(_) => Flow::Continue,
        Err(error) => {
            watched.raised = Some(error);
            Flow::Stop
        }
    }
}

/// Lights with their names that take the place of a scene's environment; `None`: the scene's own.
type Around = Option<Vec<(String, Light)>>;

/// Texels around of a sky that is given in words: 0.35° each, fine against everything in it but the sun, which is a light
/// of its own.
pub const SKY_WIDTH: u32 = 1024;

/// The light from all around that the settings ask for (`None` = the scene's own), and what its file made us say.
pub fn environment(py: Python<'_>, settings: &Settings) -> PyResult<(Around, Vec<Message>)> {
    let one = |light: Light| Some(vec![("environment".into(), light)]);
    let Some(words) = settings.environment.as_deref() else { return Ok((None, Vec::new())) };
    if let Some(sky) = Sky::from_words(words) {
        let lights = sky.and_then(|sky| py.detach(|| sky.lights(SKY_WIDTH)));
        return Ok((Some(lights.map_err(errors::value)?.into()), Vec::new()));
    }
    Ok(match words {
        "none" => (Some(Vec::new()), Vec::new()),
        "sky" => (one(builtin::default_sky()), Vec::new()),
        path => {
            let (light, messages) = environment_file(py, path)?;
            (one(light.into()), messages)
        }
    })
}
