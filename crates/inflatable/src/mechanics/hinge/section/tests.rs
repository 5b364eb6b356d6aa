//! The section against finite differences, finer meshes, its limits, and chance.

use super::*;
use crate::mechanics::hinge::section::potential::{Potential, value};
use sha2::{Digest, Sha256};

/// The section with `elements`, unchecked: limits lie outside of its range.
fn section(bendability: f64, stiffness: f64, poisson: f64, elements: usize) -> Section {
    Section { scales: Scales { bendability, stiffness, poisson, hoop: Hoop::Stiff }, elements }
}

/// Numbers in [0, 1) that are the same on every run.
fn draws(mut seed: u64) -> impl FnMut() -> f64 {
    move || {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        f64::from(u32::try_from(seed >> 32).expect("32 bits")) / 4_294_967_296.0
    }
}

#[test]
fn gradient_and_hessian_are_the_derivatives_of_the_potential() {
    let scales = section(100.0, 300.0, 0.39, 0).scales;
    for r_star in [0.0, 0.1, 2.0] {
        let mesh = MeridianMesh::new(r_star, 5);
        let mut search = ShapeSearch::new(scales, mesh.clone());
        // Any shape will do; a bent and stretched one leaves no term out.
        let mut draw = draws(3);
        search.shape.iter_mut().for_each(|x| *x += 0.02 * draw());
        mesh.pinned().for_each(|pinned| search.shape[pinned] = 0.0);
        let (lambda, shape) = (1.15, search.shape);
        let assembled = |lambda: f64, shape: &[f64]| {
            let mut potential = Potential::new(mesh.unknowns());
            potential.assemble(&scales, &mesh, lambda, shape, true);
            potential
        };
        let center = assembled(lambda, &shape);
        // Differences of fourth order: the innermost element is so short that those of second order are too rough.
        let step = 2e-6;
        let difference = |f: &dyn Fn(f64) -> f64| {
            (8.0 * (f(step) - f(-step)) - (f(2.0 * step) - f(-2.0 * step))) / (12.0 * step)
        };
        let moved = |i: usize, by: f64| {
            let mut moved = shape.clone();
            moved[i] += by;
            moved
        };
        let free = || (0..shape.len()).filter(|i| mesh.pinned().all(|pinned| pinned != *i));
        let largest = |of: &[f64]| of.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        for i in free() {
            let of_value = |by: f64| value(&scales, &mesh, lambda, &moved(i, by)).expect("finite");
            let error = difference(&of_value) - center.gradient[i];
            assert!(error.abs() < 1e-8 * largest(&center.gradient), "R* {r_star}, gradient {i}: {error:.1e}");
            let unit: Vec<f64> = (0..shape.len()).map(|j| f64::from(u8::from(i == j))).collect();
            let column = center.hessian.times(&unit);
            for j in free() {
                let error = difference(&|by| assembled(lambda, &moved(i, by)).gradient[j]) - column[j];
                assert!(error.abs() < 1e-6 * largest(&column), "R* {r_star}, H {i} {j}: {error:.1e}");
            }
            let error = difference(&|by| assembled(lambda, &moved(i, by)).slope) - center.mixed[i];
            assert!(error.abs() < 1e-6 * largest(&center.mixed), "R* {r_star}, mixed {i}: {error:.1e}");
        }
        let of_lambda = |by: f64| value(&scales, &mesh, lambda + by, &shape).expect("finite");
        assert!((difference(&of_lambda) - center.slope).abs() < 1e-8, "R* {r_star}, slope");
        let bend = difference(&|by| assembled(lambda + by, &shape).slope);
        assert!((bend - center.curvature).abs() < 1e-6 * center.curvature, "R* {r_star}, curvature");
    }
}

#[test]
fn a_hundred_nodes_are_as_good_as_eight_hundred() {
    for (bendability, thickness) in [(10.0, 0.003), (330.0, 0.003), (1e3, 0.003), (1e3, 0.03), (1e4, 0.003)] {
        for r_star in [0.0, 0.1, 3.0] {
            let section = Section::new(bendability, thickness, 0.39).expect("in range");
            let [coarse, hundred, fine] = [ELEMENTS, 100, 800].map(|elements| {
                let state = Section { elements, ..section }.target(r_star).expect("found");
                (state.lambda, state.curvature)
            });
            let errors = |one: (f64, f64)| ((one.0 - fine.0).abs(), (one.1 / fine.1 - 1.0).abs());
            let place = format!("{bendability} {thickness} {r_star}: {coarse:?} {hundred:?} {fine:?}");
            assert!(errors(hundred).0 < 1e-4 && errors(hundred).1 < 5e-3, "{place}");
            assert!(errors(coarse).0 < 1e-4 && errors(coarse).1 < 2e-3, "{place}");
        }
    }
}

#[test]
fn a_sharp_rim_tends_to_a_point() {
    // (1/eps, t/W, largest step of lambda): a sheet that stretches by p W / Y = 0.09 would need a finer core than it is thick.
    for (bendability, thickness, most) in [(330.0, 0.015, 5e-5), (1e3, 0.003, 5e-5), (1e3, 0.03, 8e-3)] {
        let section = Section::new(bendability, thickness, 0.39).expect("in range");
        let point = section.target(0.0).expect("found").lambda;
        for r_star in [1e-9, 1e-6, 1e-5] {
            let rim = section.target(r_star).expect("found").lambda;
            assert!((rim - point).abs() < most, "{bendability} {thickness} {r_star}: {rim} {point}");
        }
    }
}

/// With B -> 0, Y -> infinity and no hoop compression.
#[test]
fn the_tension_field_tends_to_the_ring() {
    use crate::mechanics::hinge::ring::Ring;
    let mut previous = f64::MAX;
    for bendability in [1e5, 1e6] {
        let field = section(bendability, 1e3, 0.0, 200).slack();
        let exact = Ring.target(0.1).expect("solved");
        let rest = field.target(0.1).expect("found");
        let gap = (rest.lambda - exact.lambda).abs();
        assert!(gap < previous && gap < 5e-3, "{bendability}: {} {}", rest.lambda, exact.lambda);
        previous = gap;
    }
}

/// W. H. Paulsen, "What Is the Shape of a Mylar Balloon?" (1994): of flat radius 1 it is 1/I wide, I = int_0^1 dx / sqrt(1 - x^4), and
/// its thickness over its flat width is int_0^1 x^2 dx / sqrt(1 - x^4) / I.
#[test]
fn a_slack_disc_is_the_mylar_balloon() {
    let [width, thickness] = section(1e6, 1e6, 0.0, 96).slack().disc().expect("found");
    assert!((width - 0.762_76).abs() < 2e-4, "{width}");
    assert!((thickness - 0.456_95).abs() < 2e-4, "{thickness}");
    let [stiff, _] = section(100.0, 1e3, 0.0, 96).slack().disc().expect("found");
    assert!(stiff > width + 0.01, "bending keeps it wide: {stiff}");
}

#[test]
fn slope_and_curvature_are_those_of_one_branch() {
    for (bendability, thickness, r_star) in [(330.0, 0.015, 0.0), (2e3, 0.01, 0.1), (50.0, 0.02, 1.0)] {
        let section = Section::new(bendability, thickness, 0.3).expect("in range");
        let rest = section.target(r_star).expect("found");
        assert!(rest.slope.abs() < 1e-7 && rest.curvature < 0.0);
        for lambda in [rest.lambda - 0.1, rest.lambda, rest.lambda + 0.05] {
            let step = 1e-4;
            let [low, center, high] =
                [-step, 0.0, step].map(|d| section.state(r_star, lambda + d).expect("found"));
            let curvature = (high.slope - low.slope) / (2.0 * step);
            assert!(
                (curvature / center.curvature - 1.0).abs() < 1e-4,
                "{r_star} {lambda}: {curvature} {center:?}"
            );
        }
        let curve = section.curve(r_star, &[rest.lambda - 0.05, rest.lambda - 0.1]).expect("found");
        let single = section.state(r_star, rest.lambda - 0.1).expect("found");
        assert!((curve[1].slope - single.slope).abs() < 1e-7 * single.slope.abs());
    }
}

#[test]
fn a_straight_tube_pulls_with_one_over_pi() {
    // Thin fabric that does not stretch, far from the axis: a circle of circumference 2 W.
    let section = Section::new(1e4, 0.01, 0.3).expect("in range");
    let rest = section.target(3.0).expect("found");
    let load = crate::mechanics::hinge::seal_load(3.0, &rest).expect("R* > 0");
    assert!(load > 0.32 && load < 0.38, "{load}");
    let meridian = section.meridian(3.0).expect("found");
    // Hoop compression stays small against the tension of a cylinder of radius W / pi.
    assert!((meridian.largest(|point| point.tension) - load).abs() < 0.02);
    assert!(meridian.largest(|point| point.stretch) < 1.2 * section.stretch());
}

/// A hinge of many widths is a bent tube. lambda is that of another program for the same equations, at t/W = 0.015 and 1/eps = 330.
#[test]
fn a_slender_hinge_is_a_bent_tube() {
    let section = Section::new(330.0, 0.015, 0.39).expect("in range");
    for (r_star, lambda) in
        [(0.1, 1.1534), (1.0, 1.1876), (3.0, 1.2272), (5.0, 1.2396), (10.0, 1.2475), (20.0, 1.2500)]
    {
        let coiling = section.target(r_star).expect("found").lambda;
        assert!((coiling - lambda).abs() < 3e-4, "{r_star}: {coiling} {lambda}");
    }
    // C of the whole bend falls as 1 / R*, its bending stiffness becoming that of the tube. Twice the elements leave it but for rounding,
    // a part of 1e-5 of what it is the difference of.
    let stiffness = |r_star: f64, elements| {
        let state = Section { elements, ..section }.target(r_star).expect("found");
        -state.curvature * (r_star + 0.5)
    };
    let [at_50, at_100] = [50.0, 100.0].map(|r_star| stiffness(r_star, ELEMENTS));
    assert!((at_100 / at_50 - 1.0).abs() < 3e-3, "{at_50} {at_100}");
    let finer = stiffness(100.0, 96);
    assert!((finer / at_100 - 1.0).abs() < 1e-2, "{at_100} {finer}");
}

/// A round section that bears hoop compression and does not stretch: the least squares of its hoop strain, lambda = 4/pi.
#[test]
fn a_stiff_slender_bend_tends_to_four_over_pi() {
    let exact = 4.0 / std::f64::consts::PI;
    let mut previous = f64::MAX;
    for r_star in [25.0, 50.0, 100.0] {
        let coiling = section(1e4, 1e3, 0.0, ELEMENTS).target(r_star).expect("found").lambda;
        let gap = (coiling - exact).abs();
        assert!(gap < previous && coiling < exact, "{r_star}: {coiling}");
        previous = gap;
    }
    assert!(previous < 1e-3, "{previous}");
}

#[test]
fn volume_is_the_work_of_the_pressure() {
    // dPi/dp = -V per sheet at rest: in units of p W^3 with B and Y fixed, Pi p grows by V dp / 2.
    let meridian = Section::new(330.0, 0.015, 0.39).expect("in range").meridian(0.1).expect("found");
    let potential = |factor: f64| {
        let section = Section::new(330.0 * factor, 0.015, 0.39).expect("in range");
        let search = section.rest(0.1).expect("found");
        factor * value(&search.scales, &search.mesh, search.lambda, &search.shape).expect("finite")
    };
    let slope = (potential(1.001) - potential(0.999)) / 0.002;
    assert!((-2.0 * slope / meridian.volume - 1.0).abs() < 1e-5, "{slope} {}", meridian.volume);
}

/// A few hundred of the ten thousand that `crates/research/examples/section_random.rs` draws.
#[test]
fn no_hinge_in_range_fails() {
    let mut draw = draws(11);
    let mut computed = 0;
    while computed < 150 {
        let (bendability, thickness) = (10.0 * 1e3_f64.powf(draw()), 0.003 * 10_f64.powf(draw()));
        let poisson = 0.49 * draw();
        // Every tenth hinge is slender.
        let r_star =
            if computed % 10 == 0 { 3.0 * 33.3_f64.powf(draw()) } else { (4.0 * draw() - 1.0).max(0.0) };
        let Ok(section) = Section::new(bendability, thickness, poisson) else { continue };
        let place = format!("{bendability} {thickness} {poisson} {r_star}");
        let rest = section.target(r_star).unwrap_or_else(|fault| panic!("{place}: {fault}"));
        assert!(rest.lambda > 1.0 && rest.lambda < 1.35 && rest.curvature < 0.0, "{place}: {rest:?}");
        computed += 1;
    }
}

#[test]
fn what_is_out_of_range_is_refused_in_words() {
    let refused = |b: f64, t: f64, nu: f64| Section::new(b, t, nu).expect_err("out of range").to_string();
    assert_eq!(refused(9.0, 0.01, 0.3), "1/eps = p W^3 / B is 9, allowed is 10 to 10000");
    assert!(refused(f64::NAN, 0.01, 0.3).contains("1/eps") && refused(100.0, 0.04, 0.3).contains("t/W"));
    assert!(refused(100.0, 0.01, 0.5).contains("nu is 0.5"));
    assert!(refused(1e4, 0.03, 0.3).starts_with("p W / Y is 0.82"), "{}", refused(1e4, 0.03, 0.3));
    let section = Section::new(100.0, 0.01, 0.3).expect("in range");
    assert!(
        section.target(101.0).is_err() && section.target(f64::NAN).is_err() && section.target(-1.0).is_err()
    );
    assert!(section.state(0.1, 0.2).is_err() && section.state(0.1, f64::NAN).is_err());
}

#[test]
fn the_shipped_table_is_whole() {
    let text = include_str!("table.txt");
    assert!(text.len() < 200_000, "{}", text.len());
    let body: String =
        text.lines().filter(|line| !line.starts_with('#')).flat_map(|line| [line, "\n"]).collect();
    let hash = Sha256::digest(body).iter().fold(String::new(), |text, byte| text + &format!("{byte:02x}"));
    assert!(text.contains(&format!("lines below: {hash}\n")), "{hash}");
}

/// Held-out hinges, half of them at even R*, half at even logarithms.
#[test]
fn the_table_is_the_solver_within_its_bounds() {
    let table = SectionTable::shipped().expect("readable");
    let mut draw = draws(5);
    let mut compared = 0;
    while compared < 60 {
        let (bendability, thickness) = (10.0 * 1e3_f64.powf(draw()), 0.003 * 10_f64.powf(draw()));
        let (poisson, even) = (0.49 * draw(), draw());
        let r_star = if compared % 2 == 0 { 3.0 * even } else { 1e-3 * 3e3_f64.powf(even) };
        let Ok(section) = Section::new(bendability, thickness, poisson) else { continue };
        compared += 1;
        let rest = section.target(r_star).expect("found");
        let edges = rest.edges.expect("known");
        let entry = table.entry(bendability, thickness, poisson, r_star).expect("in range");
        let place = format!("{bendability} {thickness} {poisson} {r_star}: {entry:?} {rest:?}");
        assert!((entry.lambda - rest.lambda).abs() < SectionTable::COILING_ERROR, "{place}");
        assert!((entry.stiffness / -rest.curvature - 1.0).abs() < SectionTable::STIFFNESS_ERROR, "{place}");
        assert!(
            (entry.opening / (edges.tension * rest.lambda) - 1.0).abs() < SectionTable::STIFFNESS_ERROR,
            "{place}"
        );
        assert!((entry.width - edges.width).abs() < SectionTable::COILING_ERROR, "{place}");
        // The moment that holds it open at half the way to its flat angle.
        let lambda = 0.5 + 0.5 * rest.lambda;
        let held_open = section.state(r_star, lambda).expect("found").slope;
        let moment = table.moment([bendability, thickness, poisson], r_star, &entry).expect("in range");
        let folds = thickness < 0.006;
        assert!(
            folds || (moment.slope(lambda) / held_open - 1.0).abs() < SectionTable::MOMENT_ERROR,
            "{place}: {held_open}"
        );
    }
    assert!(table.entry(9.0, 0.01, 0.3, 0.1).is_err() && table.entry(100.0, 0.01, 0.3, f64::NAN).is_err());
}
