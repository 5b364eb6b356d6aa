//! Clamps: distances that the iron must keep, clamps that it may cross, and the agreement of plan and verifier.

use stargrip_cam::design::{Design, RefusalCode};
use stargrip_cam::geom::{Bounds, Path, Point, Segment};
use stargrip_cam::pipeline::read_back;
use stargrip_cam::plan::{Program, Step, seal_programs, trace_programs};
use stargrip_cam::verify::Finding;

use crate::{built, machine, profile, spec, spec_text, try_built};

/// Half the default band, mm: the iron's reach beside its path.
const REACH: f64 = 1.0;

fn sheet() -> String {
    spec_text("[sheet]\nwidth = \"300 mm\"\nheight = \"300 mm\"\nmargin = \"30 mm\"\n")
}

fn programs() -> [Vec<Program>; 2] {
    let (spec, machine) = (spec(&sheet()), machine(profile("generic")));
    let design = Design::new(&spec, &machine).expect("makeable");
    [seal_programs(&spec, &machine, &design), trace_programs(&spec, &machine, &design)]
}

/// Bounds of all paths on or above the fabric, without travels.
fn followed(programs: &[Program]) -> Bounds {
    let steps = programs.iter().flat_map(|program| &program.steps);
    let pieces: Vec<Segment> = steps
        .flat_map(|step| match step {
            Step::TouchDown(ramp) | Step::Lift(ramp) => ramp.pieces.clone(),
            Step::Seal(pieces) | Step::Trace(pieces) => pieces.clone(),
            _ => Vec::new(),
        })
        .collect();
    Path::open(pieces).bounds()
}

/// The generic machine with a clamp on `place`.
fn clamped(place: Bounds, height: Option<f64>) -> String {
    let height = height.map_or(String::new(), |mm| format!("height = \"{mm} mm\"\n"));
    format!(
        "{}\n[[keep_out]]\nname = \"vice\"\nx = \"{} mm\"\ny = \"{} mm\"\nwidth = \"{} mm\"\ndepth = \"{} mm\"\n{height}",
        profile("generic"),
        place.min.x,
        place.min.y,
        place.width(),
        place.height(),
    )
}

/// Clamps 6 mm wide along each side of `inner`, at the distance `distance`.
fn side_clamps(inner: Bounds, distance: f64) -> [Bounds; 4] {
    let (a, c, wide) = (inner.min, inner.max, 6.0);
    let clamp =
        |x: f64, y: f64, x_to: f64, y_to: f64| Bounds { min: Point::new(x, y), max: Point::new(x_to, y_to) };
    [
        clamp(a.x - distance - wide, a.y, a.x - distance, c.y),
        clamp(c.x + distance, a.y, c.x + distance + wide, c.y),
        clamp(a.x, a.y - distance - wide, c.x, a.y - distance),
        clamp(a.x, c.y + distance, c.x, c.y + distance + wide),
    ]
}

/// The plan's refusal of a clamp; empty if the gripper builds.
fn refused(place: Bounds, height: Option<f64>) -> String {
    match try_built(&sheet(), &clamped(place, height)) {
        Ok(_) => String::new(),
        Err(refusals) => {
            assert!(
                refusals.iter().all(|refusal| refusal.code == RefusalCode::ClampInTheWay),
                "{refusals:?}"
            );
            // No height helps a seal.
            let is_low = refusals[0].found.starts_with("the seal");
            assert_eq!(refusals[0].remedy.contains("give its height"), height.is_none() && !is_low);
            refusals[0].found.split(" at X ").next().unwrap_or_default().to_owned()
        }
    }
}

/// The findings when the profile of a finished build gets a clamp.
fn findings_of(place: Bounds, height: Option<f64>) -> Vec<Finding> {
    let build = built(&sheet(), profile("generic"));
    let mut files = build.output_files();
    for (name, bytes) in &mut files.files {
        if name == "machine.toml" {
            *bytes = clamped(place, height).into_bytes().into();
        }
    }
    let findings = read_back(&files).findings;
    findings.into_iter().filter(|finding| finding.code == "clamp-in-the-way").collect()
}

#[test]
fn a_low_clamp_keeps_half_a_band_off_the_seal_on_every_side() {
    let [seals, _] = programs();
    let low = Some(0.5);
    for (near, far) in side_clamps(followed(&seals), REACH - 1e-6)
        .into_iter()
        .zip(side_clamps(followed(&seals), REACH + 1e-6))
    {
        assert_eq!(refused(near, low), "the seal of star 1 meets the clamp \"vice\"");
        assert_eq!(refused(far, low), "");
    }
    // The verifier allows for the rounding of a file.
    for (near, far) in side_clamps(followed(&seals), REACH - 0.01)
        .into_iter()
        .zip(side_clamps(followed(&seals), REACH + 0.01))
    {
        assert!(!findings_of(near, low).is_empty());
        assert_eq!(findings_of(far, low), []);
    }
}

#[test]
fn the_iron_passes_above_a_clamp_that_is_lower_than_it_travels() {
    let [seals, traces] = programs();
    let travel = machine(profile("generic")).process.heights.travel.0;
    // The trace follows the cut, well outside of the seal.
    let (seal, trace) = (followed(&seals), followed(&traces));
    assert!(trace.min.x < seal.min.x - 2.0 * REACH);
    // On some sides the path to a seam is met first.
    let expected = "the trace of star 1 meets the clamp \"vice\"";
    let sides = side_clamps(trace, -1e-6).into_iter().zip(side_clamps(trace, 1e-6));
    let sides: Vec<_> = sides.filter(|(touching, _)| refused(*touching, None) == expected).collect();
    assert!(sides.len() >= 2, "{sides:?}");
    for (touching, free) in sides {
        for height in [Some(travel), Some(travel + 1.0)] {
            assert_eq!(refused(touching, height), expected);
        }
        assert_eq!(
            (refused(free, None), refused(touching, Some(travel - 0.01))),
            (String::new(), String::new())
        );
    }
}

/// Programs begin and end at X0 Y0: the way to the first seam is another than that from the last.
#[test]
fn the_way_to_the_first_seam_counts_too() {
    let [seals, _] = programs();
    let first = seals[0].steps.iter().find_map(|step| match step {
        Step::Travel(to) => Some(*to),
        _ => None,
    });
    let (middle, half) =
        (Point::ORIGIN.lerp(first.expect("a seam"), 0.5), Point::new(0.1, 0.1) - Point::ORIGIN);
    let speck = Bounds { min: middle + half * -1.0, max: middle + half };
    let travel = machine(profile("generic")).process.heights.travel.0;
    assert_eq!(refused(speck, None), "the way to or from a seam of star 1 meets the clamp \"vice\"");
    assert_eq!(refused(speck, Some(travel - 0.01)), "");
}

/// A tall clamp is passed above if travel and park height are raised as the remedy says.
#[test]
fn the_remedy_for_a_tall_clamp_names_both_heights() {
    let [seals, _] = programs();
    let Bounds { min, .. } = followed(&seals);
    let corner = Bounds { min: Point::ORIGIN, max: Point::new(min.x - 5.0, min.y - 5.0) };
    let tall = clamped(corner, Some(40.0));
    let refusals = try_built(&sheet(), &tall).expect_err("in the way");
    let remedy = "or raise the travel height above 40 mm, and the park height above that";
    assert!(refusals[0].remedy.contains(remedy), "{refusals}");
    let raised = tall.replacen("travel = \"5 mm\"", "travel = \"40.1 mm\"", 1);
    let raised = raised.replacen("park = \"30 mm\"", "park = \"40.2 mm\"", 1);
    let message = |profile: &str| try_built(&sheet(), profile).err().map(|refusals| refusals.to_string());
    let refusal = message(&raised).unwrap_or_default();
    assert!(!refusal.contains("clamp"), "{refusal}");
}

#[test]
fn the_way_between_two_seams_counts_too() {
    let [seals, _] = programs();
    let mut position: Option<Point> = None;
    let mut ways = Vec::new();
    for step in &seals[0].steps {
        match step {
            Step::Travel(to) => {
                ways.extend(
                    position.filter(|from| from.distance(*to) > 3.0 * REACH).map(|from| from.lerp(*to, 0.5)),
                );
                position = Some(*to);
            }
            Step::Lift(ramp) => position = ramp.pieces.last().map(Segment::end),
            _ => {}
        }
    }
    let middle = *ways.first().expect("from the inner loop to the outer one");
    let half = Point::new(0.1, 0.1) - Point::ORIGIN;
    let speck = Bounds { min: middle + half * -1.0, max: middle + half };
    let travel = machine(profile("generic")).process.heights.travel.0;
    assert_eq!(refused(speck, None), "the way to or from a seam of star 1 meets the clamp \"vice\"");
    assert_eq!(refused(speck, Some(travel - 0.01)), "");
    assert!(!findings_of(speck, None).is_empty());
    assert_eq!(findings_of(speck, Some(travel - 0.01)), []);
}

/// A clamp under the whole star has no side near the seal: the paths inside meet it.
#[test]
fn a_clamp_around_everything_is_met() {
    let [seals, _] = programs();
    let Bounds { min, max } = followed(&seals);
    let margin = Point::new(5.0, 5.0) - Point::ORIGIN;
    let around_all = Bounds { min: min + margin * -1.0, max: max + margin };
    assert_eq!(refused(around_all, Some(0.5)), "the seal of star 1 meets the clamp \"vice\"");
    assert!(!findings_of(around_all, Some(0.5)).is_empty());
}
