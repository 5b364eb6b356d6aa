//! The order of service lines: the machine is homed before it is levelled, and warm before it moves.

use std::ops::Range;

use crate::FaultCode;
use crate::fault::{Fault, quoted};
use crate::section::Section;
use crate::service::{Service, WARMEST, WarmPart, Warming};

/// A service line of the profile.
pub(super) struct ServiceLine {
    pub(super) service: Service,
    pub(super) text: String,
    pub(super) span: Range<usize>,
}

/// Whether a service may be among the last lines of a program: it turns something off.
pub(super) fn is_last(service: Service) -> bool {
    match service {
        Service::Warm(Warming { celsius, waits, .. }) => celsius == 0.0 && !waits,
        Service::FanOff => true,
        Service::Home(_)
        | Service::Level
        | Service::FeedOverride(_)
        | Service::EndstopsOff
        | Service::MotorsOn => false,
    }
}

/// Reports the service lines of `start` that are unsafe or in an unsafe order, axes that they leave without zero, and parts that stay
/// warm after the lines of `end`.
pub(super) fn check_services(program: &mut Section<'_, '_>, start: &[ServiceLine], end: &[ServiceLine]) {
    let mut homed = [false; 3];
    let mut warm: Vec<(Warming, &ServiceLine)> = Vec::new();
    let mut is_prepared = false;
    for line in start {
        let allowed = match line.service {
            Service::Home(_) if is_prepared => {
                Some("must come before levelling and M211: homing undoes both")
            }
            Service::Level | Service::EndstopsOff if homed != [true; 3] => {
                Some("must come after X, Y and Z are homed, G28")
            }
            Service::FeedOverride(percent) if percent != 100.0 => Some("must be 100 per cent"),
            Service::Warm(Warming { celsius, .. }) if celsius > WARMEST.0 => {
                Some("must be at most 60 C: the fabric softens, and its coated sides stick together")
            }
            _ => None,
        };
        if let Some(allowed) = allowed {
            refuse(program, line, allowed);
        }
        match line.service {
            Service::Home(axes) => homed = std::array::from_fn(|i| homed[i] || axes[i]),
            Service::Level | Service::EndstopsOff => is_prepared = true,
            Service::Warm(warming) => {
                warm.retain(|(other, _)| other.part != warming.part);
                warm.push((warming, line));
            }
            Service::FanOff | Service::FeedOverride(_) | Service::MotorsOn => {}
        }
    }
    check_homed(program, start, homed);
    for (warming, line) in warm.iter().filter(|(warming, _)| warming.celsius > 0.0) {
        if !warming.waits {
            refuse(
                program,
                line,
                "must be followed by the line that waits, M190 or M191: Z shifts as it warms",
            );
        }
        if !end.iter().any(|last| turns_off(last.service, warming.part)) {
            let word = if warming.part == WarmPart::Bed { "M140 S0" } else { "M141 S0" };
            let problem = format!("`end` leaves the {} warm", warming.part.name());
            program.refuse(FaultCode::ProgramLine, "end", problem, format!("must hold {word}"));
        }
    }
}

/// Reports a `start` that homes some axes only.
fn check_homed(program: &mut Section<'_, '_>, start: &[ServiceLine], homed: [bool; 3]) {
    let first = start.iter().find(|line| matches!(line.service, Service::Home(_)));
    if let Some(line) = first.filter(|_| homed != [true; 3]) {
        let axes: Vec<&str> = ["X", "Y", "Z"]
            .into_iter()
            .zip(homed)
            .filter_map(|(axis, known)| (!known).then_some(axis))
            .collect();
        refuse(
            program,
            line,
            &format!("must be followed by a line that homes {} as well", axes.join(" and ")),
        );
    }
}

fn turns_off(service: Service, part: WarmPart) -> bool {
    matches!(service, Service::Warm(warming) if warming.part == part && warming.celsius == 0.0)
}

fn refuse(program: &mut Section<'_, '_>, line: &ServiceLine, allowed: &str) {
    let message = format!("a line of the profile is {}", quoted(&line.text));
    program.report(Fault::error(FaultCode::ProgramLine, line.span.clone(), message).label(allowed));
}

#[cfg(test)]
mod tests {
    use crate::source::Source;
    use crate::{builtin_machine, read_machine};

    /// The number of faults of Marlin's profile with these lines before its own, and `end` before its last.
    fn faults(start: &str, end: &str) -> usize {
        let text = builtin_machine("marlin").expect("built in");
        let text = text.replacen("start = [", &format!("start = [{start}"), 1);
        let text = text.replacen("end = [", &format!("end = [{end}"), 1);
        read_machine(&Source::new("own", text)).err().map_or(0, |faults| {
            assert!(faults.list().iter().all(|fault| fault.code == "program-line"), "{faults}");
            faults.list().len()
        })
    }

    #[test]
    fn services_have_an_order() {
        let bed_off = "\"M140 S0\", ";
        for (start, end, number) in [
            ("\"G28\", \"G29\", \"M211 S0\", \"M107\", \"M220 S100\", \"M17\", ", "\"M107\", ", 0),
            ("\"G28 X Y\", \"G28 Z\", \"M420 S1\", ", "", 0),
            ("\"M190 S45\", \"G28\", ", bed_off, 0),
            ("\"M140 S45\", \"G28\", \"M190 S45\", ", bed_off, 0),
            ("\"G28 X Y\", ", "", 1),
            ("\"G29\", \"G28\", ", "", 2),
            ("\"M420 S1\", ", "", 1),
            ("\"M211 S0\", ", "", 1),
            ("\"G28\", \"M211 S0\", \"G28 Z\", ", "", 1),
            ("\"M140 S45\", ", bed_off, 1),
            ("\"M190 S45\", ", "", 1),
            ("\"M190 S61\", ", bed_off, 1),
            ("\"M191 S120\", ", "\"M141 S0\", ", 1),
            ("\"M220 S50\", ", "", 1),
            ("", "\"G28\", ", 1),
            ("", "\"M190 S45\", ", 1),
            ("", "\"M190 S0\", ", 1),
            ("", "\"M211 S0\", ", 1),
        ] {
            assert_eq!(faults(start, end), number, "{start}| {end}");
        }
    }
}
