//! The stack: values of single stars that differ, and the tips of the inlets.

use stargrip_cam::spec::{RawSpec, key};
use stargrip_cam::units::{Angle, Length};

use super::{SHORTEST, codes, spec, try_read};

fn with_rest(rest: &str) -> String {
    format!("{SHORTEST}{rest}")
}

#[test]
fn one_star_is_the_default() {
    let spec = spec(SHORTEST);
    assert_eq!(spec.stars.len(), 1);
    let star = &spec.stars[0];
    assert_eq!((star.points, star.inlet_tip), (5, 1));
    assert_eq!((star.rotation, star.pitch), (Angle(0.0), Length(40.0)));
    assert_eq!((star.tip_radius, star.corner_radius), (Length(0.0), Length(0.0)));
    assert!(spec.inlet.is_some(), "no [inlet] means an inlet by default");
}

#[test]
fn stars_differ_where_they_say_so() {
    let spec = spec(&with_rest(
        "[stack]\ncount = 3\nrotation = '36 deg'\npitch = '3 cm'\n[inlet]\ntip = 2\n\
         [[stack.star]]\nindex = 3\ninner_radius = '45 mm'\npoints = 7\ninlet_tip = 7\n\
         [[stack.star]]\nindex = 1\nrotation = '5 deg'\npitch = '50 mm'\n",
    ));
    let star_of = |index: usize| &spec.stars[index - 1];
    assert_eq!([1, 2, 3].map(|i| star_of(i).rotation.0), [5.0, 36.0, 36.0]);
    assert_eq!([1, 2, 3].map(|i| star_of(i).pitch.0), [50.0, 30.0, 30.0]);
    assert_eq!([1, 2, 3].map(|i| star_of(i).inner_radius.0), [50.0, 50.0, 45.0]);
    assert_eq!([1, 2, 3].map(|i| star_of(i).points), [5, 5, 7]);
    assert_eq!([1, 2, 3].map(|i| star_of(i).inlet_tip), [2, 2, 7]);
    assert_eq!([1, 2, 3].map(|i| star_of(i).tube_width.0), [30.0; 3]);
}

#[test]
fn the_bottom_star_is_not_turned_against_a_star_that_is_not_there() {
    let spec = spec(&with_rest("[stack]\ncount = 2\nrotation = '36 deg'\n"));
    assert_eq!(spec.stars[0].rotation, Angle(0.0));
    assert_eq!(spec.stars[1].rotation, Angle(36.0));
}

#[test]
fn stars_may_be_written_inline() {
    let inline = spec(&with_rest("[stack]\ncount = 2\nstar = [{ index = 2, tip_radius = '1 mm' }]\n"));
    let headed = spec(&with_rest("[stack]\ncount = 2\n[[stack.star]]\nindex = 2\ntip_radius = '1 mm'\n"));
    assert_eq!(inline, headed);
}

#[test]
fn indices_are_stars_of_the_stack_once_each() {
    assert_eq!(codes(&with_rest("[[stack.star]]\nindex = 2\n")), ["out-of-range"]);
    assert_eq!(codes(&with_rest("[[stack.star]]\nindex = 0\n")), ["out-of-range"]);
    assert_eq!(codes(&with_rest("[[stack.star]]\npoints = 3\n")), ["missing-key"]);
    assert_eq!(
        codes(&with_rest("[[stack.star]]\nindex = 1\n[[stack.star]]\nindex = 1\n")),
        ["duplicate-index"]
    );
    assert_eq!(codes(&with_rest("[stack.star]\nindex = 1\n")), ["wrong-type"]);
    assert_eq!(codes(&with_rest("[stack]\nstar = [1, 'a']\n")), ["wrong-type", "wrong-type"]);
    // A count that is refused does not refuse the indices too.
    assert_eq!(codes(&with_rest("[stack]\ncount = 65\n[[stack.star]]\nindex = 64\n")), ["out-of-range"]);
}

#[test]
fn an_inlet_is_at_a_tip_that_its_star_has() {
    assert_eq!(codes(&with_rest("[inlet]\ntip = 5\n")), [""; 0]);
    assert_eq!(codes(&with_rest("[inlet]\ntip = 6\n")), ["out-of-range"]);
    // One fault at the one key that is wrong for both stars.
    assert_eq!(codes(&with_rest("[inlet]\ntip = 6\n[stack]\ncount = 2\n")), ["out-of-range"]);
    assert_eq!(
        codes(&with_rest("[stack]\ncount = 2\n[[stack.star]]\nindex = 2\ninlet_tip = 6\n")),
        ["out-of-range"]
    );
    assert_eq!(
        codes(&with_rest("[inlet]\ntip = 4\n[[stack.star]]\nindex = 1\npoints = 3\n")),
        ["out-of-range"]
    );
}

#[test]
fn none_is_no_inlet_and_allows_nothing_beside_it() {
    assert_eq!(spec(&with_rest("[inlet]\nnone = true\n")).inlet, None);
    assert!(spec(&with_rest("[inlet]\nnone = false\ntip = 2\n")).inlet.is_some());
    assert_eq!(codes(&with_rest("[inlet]\nnone = true\ntip = 2\nlength = '5 mm'\n")), ["conflict"]);
    assert_eq!(
        codes(&with_rest("[inlet]\nnone = true\n[[stack.star]]\nindex = 1\ninlet_tip = 2\n")),
        ["conflict"]
    );
}

#[test]
fn a_later_stage_finds_what_decided_a_value() {
    let text = with_rest(
        "[inlet]\ntip = 2\n[stack]\ncount = 2\npitch = '41 mm'\n[[stack.star]]\nindex = 2\npoints = 6\n",
    );
    let raw: RawSpec = try_read(&text).expect("valid").raw;
    let text_at = |span: std::ops::Range<usize>| &text[span];
    assert_eq!(text_at(raw.span_of(key::star::POINTS)), "5");
    assert_eq!(text_at(raw.span_of(key::star::POINTS.of_star(1))), "5");
    assert_eq!(text_at(raw.span_of(key::star::POINTS.of_star(2))), "6");
    assert_eq!(text_at(raw.span_of(key::stack::PITCH.of_star(2))), "'41 mm'");
    assert_eq!(text_at(raw.span_of(key::inlet::TIP.of_star(2))), "2");
    // The place of a missing key: its section, else the start.
    assert_eq!(raw.find(key::star::TIP_RADIUS), None);
    assert_eq!(text_at(raw.span_of(key::star::TIP_RADIUS)), "[star]");
    assert_eq!(text_at(raw.span_of(key::root::SCHEMA)), "1");
    // Beyond the end, where the section would be added.
    assert!(raw.span_of(key::seal::BAND).start > text.len());
}
