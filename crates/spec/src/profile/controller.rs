//! The language and abilities of the controller.

use crate::FaultCode;
use crate::allowed::Allowed;
use crate::dialect::Dialect;
use crate::fault::quoted;
use crate::machine::{Comments, Controller, DwellUnit, Dwells, Heating, SheetPlace, to_micrometres};
use crate::profile::modes::{check_arcs, check_dwell_unit, check_heating};
use crate::section::Section;
use crate::units::{Duration, Length};

/// Reads the controller, from the keys before the first section; its dwells have a section of their own.
pub(super) fn read_controller(root: &mut Section<'_, '_>) -> Controller {
    let dialect = root.choice("dialect", &Dialect::ALL).unwrap_or(Dialect::Generic);
    let heating = read_heating(root);
    let comments = [("semicolon", Comments::Semicolon), ("parentheses", Comments::Parentheses)];
    let comments = root.choice("comments", &comments).unwrap_or(Comments::Semicolon);
    check_heating(root, dialect, &heating);
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
    // Places are whole micrometres, as heights are: programs state them exactly.
    let surface = Length(to_micrometres(root.length("surface", PLACE, 0.0).0));
    let place = SheetPlace { surface, ..SheetPlace::default() };
    Controller { dialect, line_length, comments, arcs, dwell: EXACT, heating, thumbnails, place, laser: None }
}

/// Heights of the release layer above the machine's zero, and places of the sheet's corner: within any machine.
pub(super) const PLACE: Allowed = Allowed::closed(0.0, 1e4);

/// Reads the way in which the iron is heated.
fn read_heating(root: &mut Section<'_, '_>) -> Heating {
    let Some((text, _)) = root.text("heating") else { return Heating::Operator };
    if let Some(heating) = Heating::read(text) {
        return heating;
    }
    let allowed = "must be \"operator\", \"hotend\", \"hotend 1\" or the number of another one, or \"heater NAME\" with at \
                   most 16 letters, digits, - and _ as NAME";
    root.refuse(FaultCode::UnknownChoice, "heating", format!("`heating` is {}", quoted(text)), allowed);
    Heating::Operator
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
