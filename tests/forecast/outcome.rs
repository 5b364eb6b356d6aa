//! The state of an object: whether it enters, is reached, and is held, and the force on it.

use crate::{case, close, paper};
use stargrip_cam::forecast::case::Case;
use stargrip_cam::forecast::outcome::{Grip, Outcome};
use stargrip_cam::mechanics::hinge::ring::Ring;
use stargrip_cam::mechanics::star::response::Inflated;

/// The linear star of the paper with `points` points and an object of `radius` m.
fn holding(points: u32, radius: f64) -> (Case, Outcome) {
    let case = case(&paper(points)).on_cylinder(radius);
    let inflated = Inflated::new(&case.mechanism, &Ring, 37e3).expect("solvable");
    let outcome = Outcome::linear(&case, &inflated);
    (case, outcome)
}

#[test]
fn an_object_is_held_between_the_final_radius_and_the_widest() {
    // Five points open beyond the cut hole, 50 mm less 2 mm of band and flap: the hole decides. 48 mm itself enters.
    let hole = holding(5, 0.03).0.hole;
    close(hole, 0.048, 1e-12);
    assert!(matches!(holding(5, hole).1.hold, Some(Grip::Held(force)) if force > 0.0));
    assert_eq!(holding(5, hole + 1e-9).1.hold, Some(Grip::TooWideToEnter));
    // Eight points do not open to 50 mm.
    let open = holding(8, 0.03).1.rest;
    assert!(open.widest.radius < 0.05);
    assert_eq!(holding(8, open.widest.radius + 1e-9).1.hold, Some(Grip::TooWideToOpen));
    assert!(matches!(holding(8, open.widest.radius - 1e-6).1.hold, Some(Grip::Held(_))));
    assert_eq!(holding(8, open.radius - 1e-9).1.hold, Some(Grip::TooThin));
    assert_eq!(holding(8, open.radius - 1e-9).1.object_force(), Some(0.0));
    assert_eq!(holding(8, 0.0501).1.object_force(), None);
}

/// A star whose arms are pressed together holds an object of just its final radius with its preload.
#[test]
fn the_force_begins_with_the_preload_and_rises_by_the_stiffness() {
    let rest = holding(8, 0.03).1;
    let (preload, stiffness) = (rest.preload.expect("a pressure"), rest.stiffness.expect("a pressure"));
    assert!(preload > 0.0);
    let force = |more: f64| holding(8, rest.rest.radius + more).1.object_force().expect("held");
    close(force(0.0), preload, 1e-9);
    close((force(1e-7) - force(0.0)) / 1e-7, stiffness, 1e-3);
}

/// m g = mu F, and with linear hinges F is proportional to the pressure.
#[test]
fn the_payload_is_friction_times_force_over_gravity() {
    let (case, outcome) = holding(5, 0.03);
    let force = outcome.object_force().expect("held");
    close(outcome.payload.expect("friction"), 0.5 * force / 9.806_65, 1e-12);
    let inflated = Inflated::new(&case.mechanism, &Ring, 3.0 * 37e3).expect("solvable");
    let harder = Outcome::linear(&case, &inflated);
    close(harder.payload.expect("friction"), 3.0 * outcome.payload.expect("friction"), 1e-9);
    close(harder.contraction, outcome.contraction, 1e-12);
    assert_eq!(Outcome::linear(&Case { friction: None, ..case }, &inflated).payload, None);
}

#[test]
fn without_a_pressure_there_are_radii_and_no_forces() {
    let (case, with) = holding(5, 0.03);
    let bare = Case { pressure: None, ..case };
    let inflated = Inflated::new(&bare.mechanism, &Ring, 1.0).expect("solvable");
    let without = Outcome::linear(&bare, &inflated);
    assert_eq!((without.stiffness, without.preload, without.hold, without.payload), (None, None, None, None));
    close(without.rest.radius, with.rest.radius, 1e-12);
    close(without.contraction, 1.0 - without.rest.radius / 0.05, 1e-12);
    assert_eq!(without.graspable, [without.rest.radius, case.hole]);
    assert_eq!(without.object_warning(&bare), None);
}

/// Arms lock where the radius has its maximum: the last sixteenth of the way there is warned of, no more of it.
#[test]
fn the_last_sixteenth_before_the_arms_lock_is_warned_of() {
    let rest = holding(7, 0.04).1.rest;
    let way = rest.widest.radius - rest.radius;
    let warned = |share: f64| {
        let (case, outcome) = holding(7, rest.widest.radius - share * way);
        outcome.object_warning(&case).is_some_and(|text| text.contains("the arms lock there"))
    };
    assert!(warned(1.0 / 16.0 - 1e-6) && !warned(1.0 / 16.0 + 1e-6));
    // With three points the motion ends at an almost straight corner, without locking.
    let rest = holding(3, 0.04).1.rest;
    assert!(rest.widest.radius > 0.05);
    let (case, outcome) = holding(3, 0.048 - 1e-6);
    assert_eq!(outcome.object_warning(&case), None);
}

#[test]
fn each_refusal_names_a_size() {
    let text = |points, radius| {
        let (case, outcome) = holding(points, radius);
        outcome.object_warning(&case).expect("a warning")
    };
    let mm = |metres: f64| format!("{:.2} mm across", 2.0 * metres * 1e3);
    let rest = holding(8, 0.03).1.rest;
    assert_eq!(
        text(8, 0.01),
        format!(
            "the object is thinner than the closed star, {}: the star does not reach it",
            mm(rest.radius)
        )
    );
    assert_eq!(text(8, 0.06), "the object is wider than the cut hole, 96.00 mm across: it does not enter");
    let wide = text(8, 0.045);
    let opens = format!("the object is wider than the inflated star opens, {}: ", mm(rest.widest.radius));
    assert!(wide.starts_with(&opens), "{wide}");
}
