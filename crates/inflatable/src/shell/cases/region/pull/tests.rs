use crate::shell::cases::refinement::Family;
use crate::shell::cases::region::inflate::tube_of;
use crate::shell::cases::region::pull::{Pull, PullAtStroke, PulledCase, STROKES, pull};
use crate::shell::cases::{Fineness, FlatRegion, Watch, Wrinkles, chambers};
use crate::shell::element::Fabric;
use geom::{Line, Path, Point};

const PRESSURE: f64 = 14e3;
const LENGTH: f64 = 0.04;
const DEPTH: f64 = 0.2;
const STRETCH: f64 = 128e6 * 0.3e-3;
const POISSON: f64 = 0.39;

/// A pouch of fabric 0.3 mm thick between two long seams, along the y axis and at [`LENGTH`].
fn pouch() -> FlatRegion {
    let corners = [[0.0, 0.0], [LENGTH, 0.0], [LENGTH, DEPTH], [0.0, DEPTH]].map(|[x, y]| Point::new(x, y));
    let outline = Path::closed((0..4).map(|k| Line::new(corners[k], corners[(k + 1) % 4]).into()).collect());
    let bending = STRETCH * 0.3e-3_f64.powi(2) / (12.0 * (1.0 - POISSON * POISSON));
    FlatRegion {
        chamber: chambers(&[outline], &[], &[]).expect("a chamber").remove(0),
        fabric: Fabric::isotropic(STRETCH, bending, POISSON),
        pressure: PRESSURE,
        band: 0.003,
        probes: Vec::new(),
        partial: Vec::new(),
        plates: None,
    }
}

/// Bars along the long seams.
fn long_seams(load: Option<f64>) -> Pull {
    Pull { bars: [0.0, LENGTH].map(|x| Line::new(Point::new(x, 0.0), Point::new(x, DEPTH))), load }
}

/// The force is what the energy of both sheets loses by the stroke, whether wrinkles are resolved or averaged.
#[test]
fn the_force_is_the_loss_of_energy() {
    let flat = pouch();
    let tube = tube_of(&flat).expect("a tube");
    for wrinkles in [Wrinkles::Resolved, Wrinkles::Averaged] {
        let case = PulledCase::new(&flat, &long_seams(None), tube, wrinkles);
        let (coarsest, _) = case.chamber.mesh(2.0).expect("a mesh");
        let hold = |meshed: &_, sheet: &mut _| case.supports(meshed, sheet);
        let family = Family::new(tube, coarsest, 0, &hold);
        let numbers = family.run(&Watch::default(), |solver, meshed, equilibrium, _| {
            let mut shortened = case.blocked(solver, meshed, equilibrium);
            for stroke in [0.02, 0.1, 0.2] {
                let step = 1e-4;
                let [before, middle, after] = [stroke - step, stroke, stroke + step]
                    .map(|stroke| shortened.settle_at(solver, stroke).expect("an equilibrium"));
                let slope = 2.0 * (before.energy - after.energy) / (2.0 * step);
                assert!(
                    (middle.force / slope - 1.0).abs() < 1e-3,
                    "{wrinkles:?} at {stroke}: {} {slope}",
                    middle.force
                );
            }
            Ok([0.0])
        });
        assert!(numbers.is_ok());
    }
}

/// The force by the depth of an endless pouch at a `stroke`: two arcs of the half angle theta, which the tension p R stretches by
/// `stretch`, R = (L - s)/(2 sin theta). F = 2 p R cos theta.
fn endless_force(stroke: f64, stretch: f64) -> f64 {
    let (mut low, mut high) = (1e-6, std::f64::consts::FRAC_PI_2);
    for _ in 0..60 {
        let theta = f64::midpoint(low, high);
        let arc = LENGTH * (1.0 + PRESSURE * arc_radius(stroke, theta) / stretch);
        if 2.0 * arc_radius(stroke, theta) * theta < arc { low = theta } else { high = theta }
    }
    2.0 * PRESSURE * arc_radius(stroke, low) * libm::cos(low)
}

/// The radius of an arc of the half angle `theta` between bars at a `stroke`.
fn arc_radius(stroke: f64, theta: f64) -> f64 {
    (LENGTH - stroke) / (2.0 * libm::sin(theta))
}

/// The force is near that of an endless pouch; the ends of this one carry less.
#[test]
fn a_pouch_pulls_as_an_endless_one() {
    let load = 20.0;
    let fineness = Fineness { cells: 3.0, cuts: 2 };
    let pulled = pull(&pouch(), &long_seams(Some(load)), fineness, &Watch::default()).expect("equilibria");
    let curve: Vec<PullAtStroke> = pulled.curve;
    assert_eq!(curve.len(), STROKES);
    // At the flat distance the fabric cannot get narrower, and is stiffer by 1/(1 - nu^2).
    let blocked = curve[0].force.value / DEPTH;
    let stiff = STRETCH / (1.0 - POISSON * POISSON);
    let ends = [0.97 * endless_force(0.0, STRETCH), endless_force(0.0, stiff)];
    assert!(ends[0] < blocked && blocked < ends[1], "{blocked} N/m in {ends:?}");
    for point in &curve[1..6] {
        let part = point.force.value / (DEPTH * endless_force(point.stroke, STRETCH));
        assert!((0.82..1.02).contains(&part), "{part} of an endless pouch at {point:?}");
    }
    // Free at less than 1 - 2/pi, and the load lies on the curve.
    let contraction = pulled.free_stroke.value / LENGTH;
    assert!((0.28..0.3634).contains(&contraction), "{contraction}");
    let stroke = pulled.loaded_stroke.expect("the load is less than the blocked force").meshes[2];
    let above = curve.iter().rfind(|point| point.stroke <= stroke).expect("a stroke");
    assert!(above.force.meshes[2] >= load, "{stroke}: {above:?}");
    if let Some(below) = curve.iter().find(|point| point.stroke >= stroke) {
        assert!(load >= below.force.meshes[2], "{stroke}: {below:?}");
    }
}
