//! Reads the work area and the clamps.

use crate::spec::FaultCode;
use crate::spec::allowed::{Allowed, SIZE};
use crate::spec::fault::{Fault, quoted};
use crate::spec::machine::{Bench, KeepOut};
use crate::spec::name::check_name;
use crate::spec::profile::known::{known, known_as};
use crate::spec::profile::process::HEIGHT;
use crate::spec::section::{Reader, Section};
use crate::units::Length;

/// Reads the bench, from `[work_area]` and each `[[keep_out]]`.
pub(super) fn read_bench(reader: &mut Reader<'_>) -> Bench {
    Bench { work_area: read_work_area(&mut reader.section("work_area")), keep_out: read_keep_out(reader) }
}

/// Both sizes, or neither: an absent one and "unknown" mean the same.
fn read_work_area(s: &mut Section<'_, '_>) -> Option<(Length, Length)> {
    // A faulty side counts as set, so that it is not reported as missing too.
    let mut side =
        |key| known_as(s, key, |s| s.quantity(key, SIZE).or_else(|| s.has(key).then_some(Length(1.0))));
    match (side("x"), side("y")) {
        (Some(x), Some(y)) => Some((x, y)),
        (None, None) => None,
        _ => {
            let fault = Fault::error(FaultCode::Conflict, s.place(), "[work_area] has one side only")
                .label("must set both `x` and `y`, or neither, or \"unknown\" for both");
            s.report(fault);
            None
        }
    }
}

fn read_keep_out(reader: &mut Reader<'_>) -> Vec<KeepOut> {
    let Some(list) = reader.raw.root_list("keep_out") else {
        // Registers the section, even where the profile has none.
        let _ = reader.section("keep_out");
        return Vec::new();
    };
    list.iter()
        .map(|value| {
            let mut s = reader.element("keep_out", value);
            s.require(&[
                ("x", "\"0 mm\""),
                ("y", "\"0 mm\""),
                ("width", "\"20 mm\""),
                ("depth", "\"20 mm\""),
            ]);
            let place = Allowed::closed(-1e5, 1e5);
            let name = s.text("name");
            let mut side = |key, allowed, default| s.quantity(key, allowed).unwrap_or(Length(default));
            let (x, y) = (side("x", place, 0.0), side("y", place, 0.0));
            let (width, depth) = (side("width", SIZE, 1.0), side("depth", SIZE, 1.0));
            let height = known(&mut s, "height", HEIGHT);
            let name = name.map_or("clamp".to_owned(), |(name, span)| {
                if let Err(reason) = check_name(name) {
                    let fault = Fault::error(FaultCode::Name, span, format!("`name` is {}", quoted(name)));
                    s.report(fault.label(reason.to_string()));
                }
                name.to_owned()
            });
            KeepOut { name, x, y, width, depth, height }
        })
        .collect()
}
