//! The link to a spec that previews and report carry as a QR code, where `link` in `[build]` requests it.

use crate::link::{LinkCode, LinkedSpec, MOST_LETTERS};
use crate::pipeline::{Forecast, Sources};
use design::{RefusalCode, Warning};
use spec::{Spec, key};

impl<'a> Sources<'a> {
    /// The code of the link to `spec`; `None` if it asks for none, or the link is too long.
    pub(super) fn code(self, spec: &Spec) -> Option<LinkCode> {
        self.linked(spec).code(spec.build.link.as_ref()?)
    }

    /// `spec` with the profile and the drawing that a page does not have.
    fn linked(self, spec: &'a Spec) -> LinkedSpec<'a> {
        let is_built_in = spec::builtin_machine(&spec.machine.profile).is_some();
        let drawing = spec.drawing.as_ref();
        let drawing = drawing.and_then(|own| Some((own.file_name(), own.content.as_ref()?.bytes())));
        LinkedSpec { spec: self.spec, machine: (!is_built_in).then_some(self.machine), drawing }
    }
}

impl Forecast {
    /// Notes for the user about the design and its files.
    pub fn warnings(&self, sources: Sources<'_>) -> Vec<Warning> {
        let mut warnings = self.design.warnings.clone();
        warnings.extend(long_link(&self.spec, sources));
        warnings
    }
}

/// That the link which `spec` asks for is too long for a code.
fn long_link(spec: &Spec, sources: Sources<'_>) -> Option<Warning> {
    let length = sources.linked(spec).short_link(spec.build.link.as_ref()?).len();
    let message = format!("the link to this spec has {length} characters");
    let remedy = format!(
        "a QR code holds at most {MOST_LETTERS}: previews and report have none; leave out `link` in [build], or shorten the \
         spec, its own profile or its drawing"
    );
    (length > MOST_LETTERS).then(|| Warning::new(key::build::LINK, RefusalCode::LongLink, message, remedy))
}
