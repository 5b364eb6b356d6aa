//! Leaks of a sealed shape as refusals: each with its place as text, and the key to change.

use design::{Refusal, RefusalCode};
use geom::Point;
use sealed::{Leak, SealedShape, seam_in_words};
use spec::key;

/// The leaks of `shape`: ways for air that are not ports. Names of seams are those of a star, or of a drawing.
pub fn shape_leaks(shape: &SealedShape, is_star: bool) -> Vec<Refusal> {
    shape.topology().leaks.iter().map(|leak| refusal(shape, is_star, leak)).collect()
}

/// The refusal of `leak`. Each kind of leak has a key whose value closes it, a code, a sentence with the seam and the first place, and a
/// remedy.
fn refusal(shape: &SealedShape, is_star: bool, leak: &Leak) -> Refusal {
    let seam = |number: &usize| seam_in_words(is_star, &shape.seams[*number].name);
    let (key, code, problem, remedy) = match leak {
        Leak::Gap(at, gap) => (
            key::seal::BAND,
            RefusalCode::SeamGap,
            format!("a gap of {gap:.6} mm in the {}", seam(at)),
            "a seam must not have a gap: change band".to_owned(),
        ),
        Leak::CrossesItself(at, places) => (
            key::seal::BAND,
            RefusalCode::SeamCrossesItself,
            format!("the {} crosses itself in {}", seam(at), listed_places(places)),
            "make band narrower, or the arms longer".to_owned(),
        ),
        Leak::Cross([a, b], places) => (
            key::star::TUBE_WIDTH,
            RefusalCode::SeamsCross,
            format!("the {} and the {} cross or touch in {}", seam(a), seam(b), listed_places(places)),
            "make tube_width larger, or the band narrower".to_owned(),
        ),
        Leak::Open(at, [end, _]) => (
            key::inlet::NONE,
            RefusalCode::WrongOpening,
            format!("the {} is open without an inlet, at X {:.1} Y {:.1} mm", seam(at), end.x, end.y),
            "change [inlet]".to_owned(),
        ),
        Leak::SealedPort(_) => (
            key::inlet::NONE,
            RefusalCode::WrongOpening,
            "the inlet is sealed: no seam has an opening there".to_owned(),
            "change [inlet]".to_owned(),
        ),
        Leak::NarrowPort(port, width) => {
            let needed_width = shape.ports[*port].width;
            (
                key::inlet::TUBE_DIAMETER,
                RefusalCode::NarrowMouth,
                format!("the inlet's mouth is {width:.3} mm wide, too narrow for the hose"),
                format!("it needs {needed_width:.3} mm: make tube_diameter smaller"),
            )
        }
    };
    Refusal::new(key, code, problem, remedy)
}

fn listed_places(places: &[Point]) -> String {
    // Seams meet in one place at least.
    format!("{} places, first at X {:.1} Y {:.1} mm", places.len(), places[0].x, places[0].y)
}
