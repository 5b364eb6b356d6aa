//! The language and abilities of the controller.

use crate::FaultCode;
use crate::allowed::Allowed;
use crate::machine::{Comments, Controller, Dialect, DwellUnit, Dwells, Heating};
use crate::profile::modes::{check_arcs, check_dwell_unit, check_heating};
use crate::section::Section;
use crate::units::Duration;

/// Reads the controller, from the keys before the first section; its dwells have a section of their own.
pub(super) fn read_controller(root: &mut Section<'_, '_>) -> Controller {
    let dialect = root.choice("dialect", &Dialect::ALL).unwrap_or(Dialect::Generic);
    let heating = [("operator", Heating::Operator), ("hotend", Heating::Hotend)];
    let heating = root.choice("heating", &heating).unwrap_or(Heating::Operator);
    let comments = [("semicolon", Comments::Semicolon), ("parentheses", Comments::Parentheses)];
    let comments = root.choice("comments", &comments).unwrap_or(Comments::Semicolon);
    check_heating(root, dialect, heating);
    let arcs = root.truth("arcs");
    let arcs = check_arcs(root, dialect, arcs);
    let thumbnails = root.truth("thumbnails").unwrap_or(false);
    if thumbnails && comments == Comments::Parentheses {
        root.refuse(
            FaultCode::Conflict,
            "thumbnails",
            "`thumbnails` is true, but `comments` are in parentheses",
            "hosts read pictures only from comments with `;`: write false, or `comments = \"semicolon\"`",
        );
    }
    let line_length = read_line_length(root, dialect);
    Controller { dialect, line_length, comments, arcs, dwell: EXACT, heating, thumbnails }
}

/// Reads the length of a line: `verify` accepts no program with longer ones than the dialect has.
fn read_line_length(root: &mut Section<'_, '_>, dialect: Dialect) -> usize {
    let (length, longest) = (root.count("line_length", 72, 255).unwrap_or(72), dialect.longest_line());
    if length > longest {
        let name = dialect.name();
        let message = format!(
            "`line_length` is {length}, but controllers of `{name}` read no longer lines than {longest}"
        );
        root.refuse(FaultCode::Conflict, "line_length", message, format!("must be at most {longest}"));
    }
    length.min(longest) as usize
}

/// Dwells of exactly the programmed time.
const EXACT: Dwells = Dwells { unit: DwellUnit::Seconds, step: Duration(1e-3) };

/// Reads `[dwell]` of a controller of the family `dialect`.
pub(super) fn read_dwells(s: &mut Section<'_, '_>, dialect: Dialect) -> Dwells {
    let units = [("s", DwellUnit::Seconds), ("ms", DwellUnit::Milliseconds)];
    let written_unit = s.choice("unit", &units);
    Dwells {
        unit: check_dwell_unit(s, dialect, written_unit),
        step: s.quantity("step", Allowed::closed(1e-3, 1.0)).unwrap_or(EXACT.step),
    }
}
