//! Stars by `section` from its table, at the edges of its domain.

use std::fmt::Write;

use stargrip_cam::design::Star;
use stargrip_cam::forecast::case::Case;
use stargrip_cam::forecast::interval::mm;
use stargrip_cam::forecast::model_selection::tabled;
use stargrip_cam::forecast::outcome::Outcome;
use stargrip_cam::forecast::ranges::Domain;
use stargrip_cam::forecast::ranges::shown::optional_with_range;
use stargrip_cam::spec::{Source, read};

/// Keys and values in place of the paper's.
type Edits = &'static [(&'static str, &'static str)];

const HEAD: &str = "1/eps, t/W, p W/Y, l/W | stars like it | rho_f | K |\n|---|---|---|---|---|\n";

/// The spec of the paper's star at 37 kPa with `edits`.
fn spec(edits: Edits) -> String {
    let mut keys = vec![
        ("star", "points", "5"),
        ("star", "inner_radius", "\"50 mm\""),
        ("star", "tube_width", "\"30 mm\""),
        ("star", "tip_angle", "\"30 deg\""),
        ("fabric", "thickness", "\"0.3 mm\""),
        ("load", "pressure", "\"37 kPa\""),
    ];
    for (key, value) in edits {
        if let Some(known) = keys.iter_mut().find(|(_, name, _)| name == key) {
            known.2 = value;
        } else {
            keys.push((if key.ends_with("stiffness") { "fabric" } else { "star" }, key, value));
        }
    }
    let mut out = String::from("schema = 1\nname = \"star\"\n");
    for table in ["star", "fabric", "load"] {
        let _ = writeln!(out, "[{table}]");
        for (_, key, value) in keys.iter().filter(|(of, ..)| *of == table) {
            let _ = writeln!(out, "{key} = {value}");
        }
    }
    out
}

/// The prediction of the star with `edits` by `section`.
fn said(edits: Edits) -> Result<String, String> {
    let spec = read(&Source::new("star", spec(edits))).map_err(|faults| faults.to_string())?.spec;
    let star = Star::new(&spec.stars[0]).map_err(|refusal| refusal.to_string())?;
    let case = Case::of_star(&spec, &star).map_err(|fault| fault.to_string())?;
    let pressure = case.pressure.unwrap_or_default();
    let model = tabled(&case, pressure).map_err(|fault| fault.to_string())?;
    let (case, own) = Outcome::by_model(&case, &model).map_err(|fault| fault.to_string())?;
    let (width, arm) = (case.mechanism.width, case.mechanism.arm);
    let standing = match own.ranges.domain {
        Domain::Validated if own.ranges.stiffness.is_none() => "tried; its arms touch",
        Domain::Validated => "tried",
        Domain::Extrapolated => "near: wider",
        Domain::Unknown => "none",
    };
    Ok(format!(
        "{:.0}, {:.4}, {:.4}, {:.2} | {standing} | {} | {}",
        case.sheet.bendability(pressure, width),
        case.sheet.thickness / width,
        case.sheet.stretch(pressure, width),
        arm / width,
        optional_with_range(Some(1e3 * own.rest.radius), own.ranges.radius.map(mm), "mm"),
        optional_with_range(Some(own.rest.stiffness), own.ranges.stiffness, "N/m"),
    ))
}

fn table(head: &str, rows: &[(&str, Edits)]) -> String {
    let mut out = format!("| {head} | {HEAD}");
    for (what, edits) in rows {
        let _ = match said(edits) {
            Ok(text) => writeln!(out, "| {what} | {text} |"),
            Err(fault) => writeln!(out, "| {what} | refused: {} | | | |", fault.replace('\n', " ")),
        };
    }
    out + "\n"
}

/// Stars at the edges of the tables and of the validated domain.
pub(crate) fn edges() -> String {
    table(
        "the paper's star at 37 kPa, but",
        &[
            ("nothing", &[]),
            ("W = 29.9 mm", &[("tube_width", "\"29.9 mm\"")]),
            ("W = 30.1 mm", &[("tube_width", "\"30.1 mm\"")]),
            ("W = 40 mm", &[("tube_width", "\"40 mm\"")]),
            ("p = 1.2 kPa", &[("pressure", "\"1.2 kPa\"")]),
            ("p = 1.3 kPa", &[("pressure", "\"1.3 kPa\"")]),
            ("p = 62 kPa", &[("pressure", "\"62 kPa\"")]),
            ("p = 64 kPa", &[("pressure", "\"64 kPa\"")]),
            ("p = 90 kPa", &[("pressure", "\"90 kPa\"")]),
            ("p = 100 kPa", &[("pressure", "\"100 kPa\"")]),
            ("p = 130 kPa", &[("pressure", "\"130 kPa\"")]),
            ("t = 0.6 mm, p = 255 kPa", &[("thickness", "\"0.6 mm\""), ("pressure", "\"255 kPa\"")]),
            ("t = 0.6 mm, p = 257 kPa", &[("thickness", "\"0.6 mm\""), ("pressure", "\"257 kPa\"")]),
            ("t = 0.9 mm", &[("thickness", "\"0.9 mm\"")]),
            ("t = 0.91 mm", &[("thickness", "\"0.91 mm\"")]),
            ("R = 9 mm", &[("tip_radius", "\"9 mm\""), ("corner_radius", "\"9 mm\"")]),
            ("R = 9.1 mm", &[("tip_radius", "\"9.1 mm\""), ("corner_radius", "\"9.1 mm\"")]),
            ("R_i = 13.6 mm", &[("tip_radius", "\"13.6 mm\"")]),
            ("rho_0 = 26 mm", &[("inner_radius", "\"26 mm\"")]),
            ("rho_0 = 25.8 mm", &[("inner_radius", "\"25.8 mm\"")]),
            ("rho_0 = 23 mm", &[("inner_radius", "\"23 mm\"")]),
            ("rho_0 = 85 mm", &[("inner_radius", "\"85 mm\"")]),
            ("rho_0 = 86 mm", &[("inner_radius", "\"86 mm\"")]),
            ("rho_0 = 119 mm", &[("inner_radius", "\"119 mm\"")]),
            ("n = 8", &[("points", "8")]),
            ("n = 9", &[("points", "9")]),
            ("n = 13, rho_0 = 100 mm", &[("points", "13"), ("inner_radius", "\"100 mm\"")]),
            ("phi_i0 = 20 deg", &[("tip_angle", "\"20 deg\"")]),
            ("phi_i0 = 15 deg", &[("tip_angle", "\"15 deg\"")]),
            ("phi_i0 = 14 deg", &[("tip_angle", "\"14 deg\"")]),
            ("B = 0.17 N mm, measured", &[("bending_stiffness", "\"0.17 N mm\"")]),
            ("B = 0.68 N mm, measured", &[("bending_stiffness", "\"0.68 N mm\"")]),
            ("Y = 19 N/mm, measured", &[("stretch_stiffness", "\"19 N/mm\"")]),
            ("Y = 76 N/mm, measured", &[("stretch_stiffness", "\"76 N/mm\"")]),
        ],
    )
}

/// The paper's star in other sizes and at other pressures.
pub(crate) fn sizes() -> String {
    table(
        "rho_0, W, t, p",
        &[
            ("50 mm, 30 mm, 0.3 mm, 14 kPa", &[("pressure", "\"14 kPa\"")]),
            ("50 mm, 30 mm, 0.3 mm, 37 kPa", &[]),
            ("50 mm, 30 mm, 0.3 mm, 60 kPa", &[("pressure", "\"60 kPa\"")]),
            (
                "25 mm, 15 mm, 0.15 mm, 37 kPa",
                &[("inner_radius", "\"25 mm\""), ("tube_width", "\"15 mm\""), ("thickness", "\"0.15 mm\"")],
            ),
            (
                "500 mm, 300 mm, 3 mm, 37 kPa",
                &[("inner_radius", "\"500 mm\""), ("tube_width", "\"300 mm\""), ("thickness", "\"3 mm\"")],
            ),
            ("25 mm, 15 mm, 0.3 mm, 37 kPa", &[("inner_radius", "\"25 mm\""), ("tube_width", "\"15 mm\"")]),
        ],
    )
}
