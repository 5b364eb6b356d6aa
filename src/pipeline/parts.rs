//! The files of what is not sealed: masks and plates of the frame.

use crate::artifact::{Artifact, Kind, Variant};
use crate::design::{Design, Drawing, MaskPlate, Paper};
use crate::emit;
use crate::spec::Spec;

/// The masks of every distinct star, for its other face too if the spec says so.
pub(super) fn masks(spec: &Spec, design: &Design, wanted: &dyn Fn(Kind) -> bool, out: &mut Vec<Artifact>) {
    let faces: &[bool] = if spec.mask.mirror { &[false, true] } else { &[false] };
    for (placed, mirrored) in design.firsts().flat_map(|placed| faces.iter().map(move |face| (placed, *face)))
    {
        let star = placed.index;
        let Some(drawing) = Drawing::mask(design, star, mirrored) else { continue };
        let stem = format!("star-{star}-mask{}", if mirrored { "-mirrored" } else { "" });
        let title = format!("{stem}: {}", spec.name);
        let mut add = |ending: &str, kind, paper, bytes| {
            let name = format!("{stem}{ending}");
            let variant = Variant { paper, mirrored, ..Variant::default() };
            out.push(Artifact { name, kind, sheet: None, star: Some(star), variant, bytes });
        };
        if wanted(Kind::MaskSvg) {
            add(".svg", Kind::MaskSvg, None, emit::svg(&title, &drawing, spec.accuracy.path).into_bytes());
        }
        if wanted(Kind::MaskDxf) {
            add(".dxf", Kind::MaskDxf, None, emit::dxf(&drawing, spec.accuracy.path).into_bytes());
        }
        if wanted(Kind::MaskStl) {
            add(".stl", Kind::MaskStl, None, emit::stl(&drawing, spec.mask.thickness.0));
        }
        for paper in Paper::ALL.into_iter().filter(|_| wanted(Kind::MaskPdf)) {
            let pages = paper.pages(&drawing, &MaskPlate::caption(star, mirrored));
            if !pages.is_empty() {
                let ending = paper.name().map_or(".pdf".to_owned(), |name| format!("-{name}.pdf"));
                add(&ending, Kind::MaskPdf, paper.name(), emit::pdf(&title, &pages));
            }
        }
    }
}

/// Every distinct plate of the frame.
pub(super) fn plates(spec: &Spec, design: &Design, wanted: &dyn Fn(Kind) -> bool, out: &mut Vec<Artifact>) {
    for plate in &design.frame.plates {
        let number = plate.numbers.first().copied();
        let stem = format!("plate-{}-frame", number.unwrap_or(0));
        let drawing = Drawing::plate(design, plate);
        let mut add = |ending: &str, kind, text: String| {
            let variant = Variant { plate: number, ..Variant::default() };
            let name = format!("{stem}.{ending}");
            out.push(Artifact { name, kind, sheet: None, star: None, variant, bytes: text.into_bytes() });
        };
        if wanted(Kind::FrameSvg) {
            let title = format!("{stem}: {}", spec.name);
            add("svg", Kind::FrameSvg, emit::svg(&title, &drawing, spec.accuracy.path));
        }
        if wanted(Kind::FrameDxf) {
            add("dxf", Kind::FrameDxf, emit::dxf(&drawing, spec.accuracy.path));
        }
    }
}
