//! Predictions against stars computed as shells, as the tables of docs/ranges.md.
//!
//! `cargo run --release -p research --example ranges`

use research::residuals::is_used;
use research::stars::draw::Set;
use research::validation::{Comparison, Opened, Pair, Pressed, compare_all, opened};
use std::fmt::Write;

fn main() {
    print!("{}", tables());
}

/// A group of stars with the same use in the validation: a name, a set, its first and last star.
type Group = (&'static str, Set, u32, u32);

const GROUPS: [Group; 9] = [
    ("fit", Set::Fit, 1, u32::MAX),
    ("range", Set::Range, 1, u32::MAX),
    ("paper", Set::Paper, 1, u32::MAX),
    ("test, 1 to 360", Set::Test, 1, 360),
    ("wide, 1 to 40", Set::Wide, 1, 40),
    ("narrow, 1 to 40", Set::Narrow, 1, 40),
    ("test, 361 to 456", Set::Test, 361, 456),
    ("wide, 41 to 60", Set::Wide, 41, 60),
    ("narrow, 41 to 60", Set::Narrow, 41, 60),
];

/// All tables, in the order of the page.
///
/// # Panics
/// If a computed star is shipped twice.
pub fn tables() -> String {
    let all = compare_all().expect("no star is there twice");
    let of = |(_, set, first, last): Group| {
        all.iter().filter(move |one| one.set == set && (first..=last).contains(&one.number))
    };
    let mut out = String::from(
        "| set | stars | quantity | numbers | 2.5 % | median | 97.5 % | in range | strictly | mean width / mean error |\n\
         |---|---|---|---|---|---|---|---|---|---|\n",
    );
    for set in GROUPS {
        let stars = of(set).count();
        let opened = |opening: f64| {
            let forces = of(set).flat_map(|one| &one.forces).filter(move |one| one.opening == opening);
            forces.map(|one| one.force).collect()
        };
        let rows: [(&str, Vec<Pair>); 6] = [
            ("radius, W / sin(pi/n)", of(set).map(|one| one.radius).collect()),
            ("angle, deg", of(set).filter_map(|one| one.angle).map(in_degrees).collect()),
            ("stiffness, ratio", of(set).filter_map(|one| one.stiffness).collect()),
            ("force, 0.15 W open, ratio", opened(0.15)),
            ("force, 0.45 W open, ratio", opened(0.45)),
            ("force, 0.9 W open, ratio", opened(0.9)),
        ];
        for (what, pairs) in rows.into_iter().filter(|(_, pairs)| !pairs.is_empty()) {
            let _ = writeln!(out, "| {} | {stars} | {what} | {} |", set.0, row(&pairs));
        }
    }
    out.push('\n');
    out += "| set | rho_f off by, rms | in the middle | at most | 4 to 8 points within 4 % |\n|---|---|---|---|---|\n";
    for set in GROUPS {
        let off = |one: &Comparison| (one.radius.predicted / one.radius.shell - 1.0).abs();
        let mut parts: Vec<f64> = of(set).map(off).collect();
        parts.sort_by(f64::total_cmp);
        let [middle, most] = [0.5, 1.0].map(|part| 100.0 * quantile(&parts, part));
        let many: Vec<&Comparison> = of(set).filter(|one| one.points > 3).collect();
        let near = many.iter().filter(|one| off(one) <= 0.04).count();
        let _ = writeln!(
            out,
            "| {} | {:.1} % | {middle:.1} % | {most:.1} % | {near} of {} |",
            set.0,
            100.0 * rms(&parts),
            many.len()
        );
    }
    out.push('\n');
    out += &forces(&all);
    out.push('\n');
    out += &forces_by_gap(&all);
    out.push('\n');
    out += &coarse_forces();
    out
}

/// Errors of forces on the same object, as for a user, and with shell and model opened equally far: of all, of those on
/// objects that pass the hole of a spec with the default flap, and by opening and by n.
fn forces(all: &[Comparison]) -> String {
    let mut out = String::from(
        "| set | objects | forces | same opening: rms | within 15 % | same object: rms | within 15 % | within 15 % and the mesh error | strictly in range |\n\
         |---|---|---|---|---|---|---|---|---|\n",
    );
    for (name, is_of_group) in FORCE_GROUPS {
        let each = |one: &Comparison| one.forces.iter().map(|force| (one.points, *force)).collect::<Vec<_>>();
        let forces: Vec<(u32, Pressed)> = all.iter().filter(|one| is_of_group(one)).flat_map(each).collect();
        let mut row = |objects: &str, is_meant: &dyn Fn(u32, &Pressed) -> bool| {
            let of_row = forces.iter().filter(|(points, one)| is_meant(*points, one));
            let pairs: Vec<Pair> = of_row.map(|(_, one)| one.force).collect();
            if !pairs.is_empty() {
                let _ = writeln!(out, "| {name} | {objects} | {} |", shares(&pairs));
            }
        };
        row("all", &|_, _| true);
        row("wider than the default hole", &|_, one| !one.passes);
        row("that pass the default hole", &|_, one| one.passes);
        for opening in [0.15, 0.45, 0.9] {
            row(&format!("of these, {opening} W open"), &|_, one| one.passes && one.opening == opening);
        }
        for n in 3..=8 {
            row(&format!("all, {n} points"), &|points, _| points == n);
        }
    }
    out
}

/// Errors of forces at the same opening, by the gap between the object and the flat tube's hole.
fn forces_by_gap(all: &[Comparison]) -> String {
    let (left_out, new): (Vec<&Comparison>, Vec<&Comparison>) =
        all.iter().partition(|one| is_used(one.set, one.number));
    let mut out = String::from(
        "| forces | gap by W | numbers | 2.5 % | median | 97.5 % | in range | strictly | mean width / mean error |\n\
         |---|---|---|---|---|---|---|---|---|\n",
    );
    for (what, stars) in [("each left out", left_out), ("not used", new)] {
        for (gap, [least, most]) in
            [("0 to 0.1", [0.0, 0.1]), ("0.1 to 0.2", [0.1, 0.2]), ("above 0.2", [0.2, f64::INFINITY])]
        {
            let of_gap =
                stars.iter().flat_map(|one| &one.forces).filter(|one| (least..most).contains(&one.gap));
            let _ = writeln!(
                out,
                "| {what} | {gap} | {} |",
                row(&of_gap.map(|one| one.force).collect::<Vec<_>>())
            );
        }
    }
    out
}

/// Forces of coarse shells on the same object: of stars whose arms touch, and on objects that open a star by more than 0.95 W.
fn coarse_forces() -> String {
    let (touching, apart): (Vec<Opened>, Vec<Opened>) = opened().into_iter().partition(|one| one.touches);
    let (wide, others): (Vec<Opened>, Vec<Opened>) = apart.into_iter().partition(|one| one.opening > 0.95);
    let mut out = String::from(
        "| coarse shells | stars | forces | rms | within 15 % | in range | strictly |\n|---|---|---|---|---|---|---|\n",
    );
    for (what, group) in [
        ("arms touch", touching),
        ("arms apart, 0.95 to 1.6 W open", wide),
        ("arms apart, less open", others),
    ] {
        let mut stars: Vec<_> = group.iter().map(|one| (one.star.0.name(), one.star.1)).collect();
        stars.dedup();
        let off: Vec<f64> = group.iter().map(|one| one.force.predicted / one.force.shell - 1.0).collect();
        let near = off.iter().filter(|off| off.abs() <= NEAR).count();
        let count = |holds: fn(&Pair) -> bool| group.iter().filter(|one| holds(&one.force)).count();
        let _ = writeln!(
            out,
            "| {what} | {} | {} | {:.0} % | {near} | {} | {} |",
            stars.len(),
            group.len(),
            100.0 * rms(&off),
            count(Pair::is_in_range),
            count(Pair::holds_strictly)
        );
    }
    out
}

/// Which stars of the comparison a row counts.
type Choice = fn(&Comparison) -> bool;

/// Stars of the table of residuals, each predicted from the others, and those not used before.
const FORCE_GROUPS: [(&str, Choice); 4] = [
    ("each left out", |one| one.set != Set::Narrow && is_used(one.set, one.number)),
    ("narrow, 1 to 40", |one| one.set == Set::Narrow && is_used(one.set, one.number)),
    ("test, 361 to 456", |one| one.set == Set::Test && !is_used(one.set, one.number)),
    ("narrow, 41 to 60", |one| one.set == Set::Narrow && !is_used(one.set, one.number)),
];

/// Number of forces, and their errors.
fn shares(pairs: &[Pair]) -> String {
    let opening: Vec<f64> = pairs.iter().map(|pair| 1.0 / pair.error - 1.0).collect();
    let object: Vec<f64> = pairs.iter().map(|pair| pair.predicted / pair.shell - 1.0).collect();
    #[expect(clippy::cast_precision_loss, reason = "a few hundred forces")]
    let percent = |count: usize| 100.0 * count as f64 / pairs.len() as f64;
    let within = |off: &[f64]| percent(off.iter().filter(|off| off.abs() <= NEAR).count());
    let open = pairs.iter().zip(&object).filter(|(pair, off)| off.abs() <= NEAR + pair.mesh / pair.shell);
    let strictly = pairs.iter().filter(|pair| pair.holds_strictly()).count();
    format!(
        "{} | {:.0} % | {:.0} % | {:.0} % | {:.0} % | {:.0} % | {strictly}",
        pairs.len(),
        100.0 * rms(&opening),
        within(&opening),
        100.0 * rms(&object),
        within(&object),
        percent(open.count())
    )
}

/// Error below which a force counts as near.
const NEAR: f64 = 0.15;

fn in_degrees(pair: Pair) -> Pair {
    let Pair { error, .. } = pair;
    Pair { error: error.to_degrees(), ..pair }
}

fn row(pairs: &[Pair]) -> String {
    let mut errors: Vec<f64> = pairs.iter().map(|pair| pair.error).collect();
    errors.sort_by(f64::total_cmp);
    let [low, middle, high] = [0.025, 0.5, 0.975].map(|part| quantile(&errors, part));
    let inside = pairs.iter().filter(|pair| pair.is_in_range()).count();
    let strictly = pairs.iter().filter(|pair| pair.holds_strictly()).count();
    let mean = |of: fn(&Pair) -> f64| pairs.iter().map(of).sum::<f64>();
    let width = mean(|pair| pair.range[1] - pair.range[0]) / mean(|pair| (pair.shell - pair.predicted).abs());
    format!("{} | {low:.3} | {middle:.3} | {high:.3} | {inside} | {strictly} | {width:.1}", pairs.len())
}

/// The value below which `part` of the sorted `values` lie.
fn quantile(values: &[f64], part: f64) -> f64 {
    let Some(last) = values.len().checked_sub(1) else { return f64::NAN };
    #[expect(clippy::cast_precision_loss, reason = "a few dozen stars")]
    let place = part * last as f64;
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "between 0 and the last")]
    let below = place.floor() as usize;
    let above = (below + 1).min(last);
    values[below] + place.fract() * (values[above] - values[below])
}

fn rms(values: &[f64]) -> f64 {
    #[expect(clippy::cast_precision_loss, reason = "a few dozen stars")]
    let count = values.len() as f64;
    (values.iter().map(|value| value * value).sum::<f64>() / count).sqrt()
}
