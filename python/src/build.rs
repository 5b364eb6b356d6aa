//! `Build`: files that have been read back, in memory; and the proof of a directory.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::{PyDict, PyTuple, PyType};
use stargrip_cam::answer::proof;
use stargrip_cam::artifact::{Kind, KindRequest};
use stargrip_cam::cli::embedded;
use stargrip_cam::cli::embedded::{GripperAnswer, Loaded};
use stargrip_cam::cli::publish;
use stargrip_cam::design::{RefusalCode, Refusals};
use stargrip_cam::manifest::Tool;
use stargrip_cam::pipeline::{Forecast, Planned, Proven, no_requested_programs};
use stargrip_cam::units::count_text;
use stargrip_cam::verify::Finding;

use crate::answer::of_gripper;
use crate::arguments;
use crate::equality::hash_of_text;
use crate::faults::{of_design, of_failure, of_findings, plain};
use crate::options::refuse_unknown;
use crate::spec::Spec;
use crate::waiting::{Line, wait};
use crate::workshop::files;

/// All files of a gripper, in memory. They have been read back and agree with the design; other files cannot be written.
#[pyclass(frozen, module = "stargrip_cam")]
pub(crate) struct Build {
    given: Arc<Loaded>,
    request: KindRequest,
    anyway: bool,
    pub(crate) proven: Proven,
    files: PyOnceLock<Py<PyDict>>,
}

/// The reason why there is no build.
enum Stopped {
    Refused(Refusals),
    Wrong(Vec<Finding>),
    Cancelled,
}

/// Builds the files of `spec` in memory and proves every one.
///
/// only: the only kinds of file to make, a list: `["seal-gcode"]`. Default: all but the kinds that only `with_` adds (docs/spec.md, `build.with`).
/// with_: kinds to make in addition: `["report"]`.
/// anyway: True builds a gripper that bursts, does not hold its own object, presses too hard on it, or lies outside every model. It also
/// computes a shell of any size.
/// progress: True shows a line with the progress; a callable gets the part that is done, 0 to 1, and a text.
///
/// Raises DesignError if there is no such gripper or it is refused, ProofError for a fault of the program.
#[pyfunction]
#[pyo3(
    signature = (spec, *, only = None, with_ = None, anyway = false, progress = None, **unknown),
    text_signature = "(spec, *, only=None, with_=None, anyway=False, progress=None)"
)]
pub(crate) fn build(
    py: Python<'_>,
    spec: &Spec,
    #[pyo3(from_py_with = arguments::only_kinds)] only: Option<Vec<Kind>>,
    #[pyo3(from_py_with = arguments::more_kinds)] with_: Option<Vec<Kind>>,
    anyway: bool,
    progress: Option<&Bound<'_, PyAny>>,
    unknown: Option<&Bound<'_, PyDict>>,
) -> PyResult<Build> {
    refuse_unknown("build", &["only", "with_", "anyway", "progress"], unknown)?;
    let request = KindRequest { only: only.unwrap_or_default(), with: with_.unwrap_or_default() };
    let result = {
        let (loaded, request) = (Arc::clone(&spec.given), request.clone());
        wait(py, progress, move |line| build_proven(&loaded, &request, anyway, line))?
    };
    let loaded = Arc::clone(&spec.given);
    match result {
        Ok(proven) => Ok(Build { given: loaded, request, anyway, proven, files: PyOnceLock::new() }),
        Err(Stopped::Refused(refusals)) => Err(of_design(py, &loaded, refusals)),
        Err(Stopped::Wrong(findings)) => Err(of_findings(py, &findings)),
        Err(Stopped::Cancelled) => Err(of_failure(py, &embedded::Failure::Interrupted)),
    }
}

fn build_proven(
    loaded: &Loaded,
    request: &KindRequest,
    anyway: bool,
    line: &Line,
) -> Result<Proven, Stopped> {
    no_requested_programs(&loaded.reading.spec, &loaded.machine, request).map_err(Stopped::Refused)?;
    line.tell(0.0, "design, plan and prediction");
    let planned =
        Planned::new(loaded.reading.spec.clone(), loaded.machine.clone()).map_err(Stopped::Refused)?;
    let forecast = line.watched(anyway, |watch| planned.forecast(watch)).map_err(|mut refusals| {
        refusals.offer(RefusalCode::LargeShell, "`build(..., anyway=True)` computes it");
        Stopped::Refused(refusals)
    })?;
    if !anyway {
        forecast.unfit().or_value(()).map_err(Stopped::Refused)?;
    }
    line.goes_on().ok_or(Stopped::Cancelled)?;
    line.tell(0.2, "files");
    let built = forecast.build(loaded.sources(), request);
    line.goes_on().ok_or(Stopped::Cancelled)?;
    line.tell(0.5, "reading them back");
    built.prove().map_err(Stopped::Wrong)
}

#[pymethods]
impl Build {
    /// Name and content of every file, the manifest last: the bytes that the command writes.
    #[getter]
    fn files<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let cached =
            self.files.get_or_try_init(py, || files(py, self.proven.built().files()).map(Bound::unbind))?;
        cached.bind(py).copy()
    }

    /// The manifest, as in `manifest.json`.
    #[getter]
    fn manifest<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        Ok(pythonize::pythonize(py, &self.proven.built().manifest)?)
    }

    /// The prediction, without a mesh; None if the spec has no [load].
    #[getter]
    fn prediction(&self, py: Python<'_>) -> PyResult<Option<Py<PyAny>>> {
        let Forecast { prediction, drawn: drawing, .. } = &self.proven.built().forecast;
        let star = prediction.clone().map(|star| GripperAnswer::Star(Box::new(star)));
        let drawn_answer =
            drawing.as_ref().map(|drawing| GripperAnswer::Drawn(Box::new(drawing.prediction.clone())));
        star.or(drawn_answer).map(|answer| of_gripper(py, Arc::clone(&self.given), answer, None)).transpose()
    }

    /// Largest deviation of every measured file from the exact design, mm.
    #[getter]
    fn deviation_mm<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let deviations = PyDict::new(py);
        for file in &self.proven.proof().files {
            deviations.set_item(&file.path, file.deviation)?;
        }
        Ok(deviations)
    }

    /// Writes the files into the directory `path`, completely or not at all, as the command does. Returns notes, one a line; "" without
    /// any. Raises PublishError, and then leaves the directory unchanged.
    fn write(&self, py: Python<'_>, path: PathBuf) -> PyResult<String> {
        publish_into(py, &path, &self.proven)
    }

    /// The preview of its first sheet; None if none was built.
    fn _repr_svg_(&self) -> Option<String> {
        let mut files = self.proven.built().artifacts.iter();
        let preview = files.find(|file| file.output.kind == Kind::PreviewSvg)?;
        String::from_utf8(preview.bytes.clone()).ok()
    }

    fn _repr_html_<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        slf.py().import("stargrip_cam._shown")?.getattr("build")?.call1((slf,))
    }

    /// Called by `__reduce__`: a build must have been read back, so it is built again.
    #[classmethod]
    fn _restored(
        _class: &Bound<'_, PyType>,
        py: Python<'_>,
        spec: &Spec,
        #[pyo3(from_py_with = arguments::only_kinds)] only: Option<Vec<Kind>>,
        #[pyo3(from_py_with = arguments::more_kinds)] with_: Option<Vec<Kind>>,
        anyway: bool,
        version: &str,
    ) -> PyResult<Self> {
        let version_here = Tool::current().version;
        if version != version_here {
            let text = format!(
                "a build of version {version} was pickled, this is version {version_here}: build it again"
            );
            return Err(plain(py, "Error", "refused", &text));
        }
        build(py, spec, only, with_, anyway, None, None)
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyTuple>)> {
        let Self { given: loaded, request, anyway, .. } = slf.get();
        let spec = Spec { given: Arc::clone(loaded) };
        let state =
            (spec, kind_names(&request.only), kind_names(&request.with), *anyway, Tool::current().version);
        Ok((slf.get_type().getattr("_restored")?, state.into_pyobject(slf.py())?))
    }

    fn __eq__(&self, other: &Bound<'_, PyAny>) -> bool {
        other.cast::<Self>().is_ok_and(|other| has_same_files(&self.proven, &other.get().proven))
    }

    fn __hash__(slf: &Bound<'_, Self>) -> PyResult<isize> {
        hash_of_text(slf)
    }

    fn __repr__(&self) -> String {
        let built = self.proven.built();
        format!("<Build {:?}: {}>", built.manifest.name, count_text(built.artifacts.len() + 1, "file"))
    }
}

/// Whether two builds have the same files: the manifest has the hash of each.
pub(crate) fn has_same_files(proven: &Proven, other: &Proven) -> bool {
    proven.built().manifest.to_json() == other.built().manifest.to_json()
}

/// The notes of publishing `proven` into the directory `path`.
pub(crate) fn publish_into(py: Python<'_>, path: &Path, proven: &Proven) -> PyResult<String> {
    let published = py.detach(|| publish(path, proven));
    let notes = published.map_err(|fault| plain(py, "PublishError", "publish", &fault.to_string()))?;
    Ok(notes.to_string())
}

/// The proof of the build in the directory `path`, as `verify --json` prints it.
#[pyfunction]
pub(crate) fn prove<'py>(
    py: Python<'py>,
    path: PathBuf,
    progress: Option<&Bound<'py, PyAny>>,
) -> PyResult<Bound<'py, PyAny>> {
    let proof = wait(py, progress, move |_| embedded::prove(&path))?;
    let proof = proof.map_err(|failure| of_failure(py, &failure))?;
    py.import("json")?.call_method1("loads", (proof::json(&proof),))
}

/// The names of `kinds`.
fn kind_names(kinds: &[Kind]) -> Vec<&'static str> {
    kinds.iter().map(|kind| kind.name()).collect()
}
