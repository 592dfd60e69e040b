//! Work without Python's lock that hears Ctrl-C.

use antumbra::schedule::Flow;
use pyo3::prelude::*;

/// Does `work` without Python's lock; `look` asks Python now and then whether Ctrl-C was pressed, which is raised.
pub fn watched<R: Send>(
    py: Python<'_>,
    work: impl FnOnce(&mut dyn FnMut() -> Flow) -> R + Send,
) -> PyResult<R> {
    let mut raised = None;
    let done = py.detach(|| {
        work(&mut || match Python::attach(|py| py.check_signals()) {
            Ok(()) => Flow::Continue,
            Err(e) => {
                raised = Some(e);
                Flow::Stop
            }
        })
    });
    raised.map_or(Ok(done), Err)
}
