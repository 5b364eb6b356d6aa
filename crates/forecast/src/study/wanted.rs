//! The columns of a study.

use crate::study::output::{ModelKinds, OutputColumn};
use crate::study::outputs::{MORE, PLAIN, SHELL_OUTPUTS};
use spec::study::Wanted;
use spec::{Fault, FaultCode, Faults, Source, nearest};

/// Every column, in order.
fn all_columns() -> impl Iterator<Item = &'static OutputColumn> {
    PLAIN.iter().chain(&MORE).chain(&SHELL_OUTPUTS)
}

/// The columns that `sweep --vary` has.
pub(super) fn plain() -> Vec<&'static OutputColumn> {
    PLAIN.iter().collect()
}

/// All columns that one of the models in `kinds` has.
pub(super) fn available(kinds: ModelKinds) -> Vec<&'static OutputColumn> {
    all_columns().filter(|output| output.is_known(kinds)).collect()
}

/// The columns selected by `names` in the study `source`, in that order.
pub(super) fn by_names(
    names: &[Wanted],
    source: &Source,
    kinds: ModelKinds,
) -> Result<Vec<&'static OutputColumn>, Faults> {
    // Each name is looked up among all columns. A second one of a name, one of a model that no row uses, and one that does
    // not exist are faults, which are all reported.
    let mut faults = Vec::new();
    let mut outputs: Vec<&'static OutputColumn> = Vec::new();
    for column in names {
        let name = &column.name;
        let output = all_columns().find(|output| output.name == name);
        match output {
            Some(output) if outputs.iter().any(|other| other.name == output.name) => {
                faults.push(
                    output_fault(column, FaultCode::TwoColumns, "it is named twice")
                        .help("delete one of them"),
                );
            }
            Some(output) if !output.is_known(kinds) => {
                let (problem, help) = if kinds.shells {
                    ("shells have no such column", "use another model, or leave it out")
                } else {
                    ("only shells have this column", "write model = \"shell\", or leave it out")
                };
                faults.push(output_fault(column, FaultCode::NoColumn, problem).help(help));
            }
            Some(output) => outputs.push(output),
            None => {
                let names: Vec<&str> = available(kinds).iter().map(|output| output.name).collect();
                let help = match nearest(name, names.iter().copied()) {
                    Some(near) => format!("did you mean \"{near}\"?"),
                    None => format!("columns are {}", names.join(", ")),
                };
                faults.push(output_fault(column, FaultCode::NoColumn, "no column has this name").help(help));
            }
        }
    }
    if faults.is_empty() { Ok(outputs) } else { Err(Faults::new(source, faults)) }
}

fn output_fault(column: &Wanted, code: FaultCode, label: &str) -> Fault {
    Fault::error(code, column.place.clone(), format!("`outputs` names `{}`", column.name)).label(label)
}
