//! The spec of a gripper for an object.

use std::collections::BTreeMap;

use pyo3::prelude::*;
use pyo3::types::PyDict;
use stargrip_cam::answer::new_gripper::NearRequest;
use stargrip_cam::answer::object::{NoGripper, Request, base, read_value, sheet};
use stargrip_cam::cli::embedded;
use stargrip_cam::spec::starter;

use crate::faults::{of_failure, of_spec, plain, usage};
use crate::options::unexpected;

/// The keywords beside object, mass and name.
const MORE: [&str; 7] = ["height", "shape", "pressure", "friction", "fragile", "sheet", "machine"];

/// The text of the keyword `name`; `None` if it is left out.
fn text_of<'t>(texts: &'t BTreeMap<String, String>, name: &str) -> Option<&'t str> {
    texts.get(name).map(String::as_str)
}

/// The text of a spec for the object with these width and mass, called `name`; `keywords` has the others.
///
/// All values are read first, so that all wrong ones are named at once; then the gripper is searched.
pub(crate) fn for_object(
    py: Python<'_>,
    [object, mass, name]: [&str; 3],
    keywords: Option<&Bound<'_, PyDict>>,
) -> PyResult<String> {
    let mut texts =
        BTreeMap::from([("object".to_owned(), object.to_owned()), ("mass".to_owned(), mass.to_owned())]);
    for (keyword, value) in keywords.into_iter().flatten() {
        let keyword = keyword.extract::<String>()?;
        if !MORE.contains(&keyword.as_str()) {
            let names: Vec<String> = MORE.iter().map(ToString::to_string).collect();
            return Err(unexpected("for_object", &names, &keyword));
        }
        if !value.is_none() {
            let _ = texts.insert(keyword, value.str()?.to_string());
        }
    }
    let mut wrong = Vec::new();
    let size = read_value("sheet", text_of(&texts, "sheet"), sheet, &mut wrong);
    let request = Request::read(|name| text_of(&texts, name))
        .map_err(|values| wrong.extend(values))
        .ok()
        .filter(|_| wrong.is_empty());
    let Some(request) = request else {
        let wrong: Vec<String> =
            wrong.iter().map(|value| format!("{}: {}", value.name, value.reason)).collect();
        return Err(usage(py, wrong.join("\n")));
    };
    let text = starter("base").map_err(|fault| usage(py, fault))?;
    let spec = base(text, text_of(&texts, "machine"), size).map_err(|faults| of_spec(py, &faults))?;
    let machine = embedded::machine(&spec.machine.profile).map_err(|failure| of_failure(py, &failure))?;
    py.detach(|| request.gripper(name, &spec, &machine)).map(|made| made.text).map_err(|why| match why {
        NoGripper::Fault(text) => refused(py, &text),
        NoGripper::Infeasible(reasons, nearest) => {
            let nearest = nearest.iter().map(NearRequest::offer);
            refused(py, &reasons.into_iter().chain(nearest).collect::<Vec<_>>().join("\n"))
        }
    })
}

fn refused(py: Python<'_>, text: &str) -> PyErr {
    plain(py, "DesignError", "refused", text)
}
