//! The release layer of PTFE between the hot tool and the fabric, which limits every temperature.

use crate::FaultCode;
use crate::fault::Fault;
use crate::section::Section;
use crate::units::Temperature;

/// From here on the PTFE release layer gives off toxic fumes: no seal is this hot.
pub const TOXIC: Temperature = Temperature(300.0);

/// Between iron and fabric lies a release layer of PTFE: above 260 C it ages, from 300 C its fumes are toxic.
pub(super) fn check_ptfe(s: &mut Section<'_, '_>, temperature: Temperature) {
    let message = format!("`temperature` is {temperature}");
    if temperature.0 >= TOXIC.0 {
        let allowed = "must be less than 300 C: from there the PTFE release layer gives off toxic fumes";
        s.refuse(FaultCode::Ptfe, "temperature", message, allowed);
    } else if temperature.0 > 260.0 {
        let fault = Fault::warning(FaultCode::Ptfe, s.place_of("temperature"), message)
            .label("above 260 C the PTFE release layer decomposes slowly")
            .help("seal at 260 C or below, or ensure good ventilation");
        s.report(fault);
    }
}
