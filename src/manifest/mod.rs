//! The manifest of a build: the record of its files, pieces, parts and prediction.
//!
//! The structures are [`proof`]'s, which reads them back; this room fills them in from design, programs and prediction.

mod bill;
mod predicted;
mod pressed;

use crate::manifest::bill::thousandths;
use design::{Design, FlatPiece, StarAssembly};
use forecast::prediction::Prediction;
use geom::order::sort_by_key;
use program::plan::{Program, SeamReport};
use sealed::{PieceName, SeamName};
use spec::{MaskKind, Spec};

pub use proof::manifest::{
    CouponChoice, CouponManifest, FEED_CHECK_MANIFEST, FeedCheckManifest, MANIFEST, Manifest,
    ManifestAlignment, ManifestCut, ManifestFile, ManifestMask, ManifestPiece, ManifestPlates, ManifestPosts,
    ManifestPrediction, ManifestSeam, ManifestStar, ManifestStarPrediction, SealedPiece, SealedSeam,
    SeamMaking, Tool, sha256,
};

/// The manifest of `design`, with `spec`, the sealing `programs`, the `cuts` of the sheets and the `prediction` at the pressure of `[load]`; its
/// list of files is still empty.
pub fn manifest_of(
    spec: &Spec,
    design: &Design,
    programs: &[Program],
    cuts: &[Program],
    prediction: Option<&Prediction>,
) -> Manifest {
    let assembly = design.assembly();
    let stars = assembly.map_or_else(Vec::new, |assembly| match &spec.press {
        Some(press) => pressed::stars(spec, press, assembly),
        None => stars(spec, assembly, programs),
    });
    let pieces = match &spec.press {
        Some(press) => pressed::pieces(press, design),
        None => programs.iter().flat_map(pieces).collect(),
    };
    let coated = assembly.filter(|_| spec.mask.kind == MaskKind::Coating);
    let parts = design.placed().iter().map(|placed| design.part(placed));
    let fabric = parts.clone().map(|part| thousandths(part.fabric())).sum();
    let mass = parts.map(|part| part.mass(&spec.fabric).map(thousandths));
    let at_pressure = prediction.filter(|prediction| prediction.first.bendability.is_some());
    Manifest {
        tool: Tool::current(),
        name: spec.name.clone(),
        files: Vec::new(),
        posts: assembly.map_or_else(Vec::new, bill::posts),
        plates: assembly.map_or_else(Vec::new, bill::plates),
        masks: coated.map_or_else(Vec::new, |assembly| bill::masks(spec, assembly)),
        fabric_mm2: thousandths(fabric),
        mass_g: mass.sum::<Option<f64>>().map(thousandths),
        pieces,
        stars,
        cuts: cuts_of(cuts),
        aligned: design.alignment.as_ref().map(ManifestAlignment::new),
        prediction: at_pressure.map(predicted::summary),
        only: Vec::new(),
        with: Vec::new(),
    }
}

/// The figures of the `programs` that cut the sheets.
fn cuts_of(programs: &[Program]) -> Vec<ManifestCut> {
    let cut = |program: &Program| ManifestCut {
        sheet: program.sheet,
        length_mm: thousandths(program.seams.iter().map(|cut| cut.length).sum()),
        time_s: thousandths(program.time),
    };
    programs.iter().map(cut).collect()
}

/// The stars of `assembly`, which the sealing `programs` make, bottom to top.
fn stars(spec: &Spec, assembly: &StarAssembly, programs: &[Program]) -> Vec<ManifestStar> {
    let mut stars: Vec<ManifestStar> = Vec::new();
    for program in programs {
        stars.extend(program.numbers().into_iter().filter_map(|index| star(spec, assembly, program, index)));
    }
    sort_by_key(&mut stars, |star| star.index);
    stars
}

/// The star `index` of `assembly`, which `program` seals; `None` for a number without a star.
fn star(spec: &Spec, assembly: &StarAssembly, program: &Program, index: usize) -> Option<ManifestStar> {
    let of_star = seam_totals(program).into_iter().filter(|seam| seam.name.piece.number() == Some(index));
    let seams: Vec<ManifestSeam> = of_star
        .map(|seam| ManifestSeam {
            loop_name: seam.name.seam.clone(),
            length_mm: thousandths(seam.length),
            overlap_mm: thousandths(seam.overlap),
            time_s: thousandths(seam.time),
            making: seam.making,
        })
        .collect();
    let part = assembly.part(assembly.stars.iter().find(|star| star.index == index)?);
    Some(ManifestStar {
        index,
        sheet: program.sheet,
        seam_mm: thousandths(seams.iter().map(|seam| seam.length_mm).sum()),
        time_s: thousandths(seams.iter().map(|seam| seam.time_s).sum()),
        clear_radius_mm: thousandths(part.clear_radius()),
        fabric_mm2: thousandths(part.fabric()),
        mass_g: FlatPiece::Star(part).mass(&spec.fabric).map(thousandths),
        seams,
    })
}

/// All contacts of one seam together.
struct SeamTotal<'a> {
    name: &'a SeamName,
    /// Path in contact, mm, and the part of it that is covered twice by one pass.
    length: f64,
    overlap: f64,
    /// Time in contact, ramps included, s.
    time: f64,
    making: SeamMaking,
}

/// The seams of `program` in the order of their first contacts.
fn seam_totals(program: &Program) -> Vec<SeamTotal<'_>> {
    let mut totals: Vec<SeamTotal<'_>> = Vec::new();
    for seam in &program.seams {
        let SeamReport { name, length, overlap, time, line, pass, .. } = seam;
        if let Some(total) = totals.last_mut().filter(|total| total.name == name) {
            (total.length, total.time) = (total.length + length, total.time + time);
            let SeamMaking { passes, lines, .. } = &mut total.making;
            *passes = (*passes).max(Some(*pass).filter(|pass| *pass > 1));
            *lines = (*lines).max(Some(*line).filter(|line| *line > 1));
            continue;
        }
        let process = &program.processes[seam.process].process;
        let process = (!process.is_default()).then(|| process.name.clone());
        let (length, overlap, time) = (*length, *overlap, *time);
        let making = SeamMaking { process, ..SeamMaking::default() };
        totals.push(SeamTotal { name, length, overlap, time, making });
    }
    totals
}

/// `seam` as the manifest has it, called `name`.
fn sealed_seam(name: String, seam: SeamTotal<'_>) -> SealedSeam {
    let SeamTotal { length, time, making, .. } = seam;
    SealedSeam { name, length_mm: thousandths(length), time_s: thousandths(time), making }
}

/// The piece of the coupon `name`, sealed by `program`.
pub fn coupon_piece(name: &str, program: &Program) -> SealedPiece {
    SealedPiece {
        name: name.to_owned(),
        kind: "coupon".to_owned(),
        time_s: Some(thousandths(program.time)),
        seams: seam_totals(program)
            .into_iter()
            .map(|seam| sealed_seam(seam.name.piece.word(), seam))
            .collect(),
    }
}

/// The pieces that `program` seals, in their order.
fn pieces(program: &Program) -> Vec<SealedPiece> {
    program.pieces.iter().map(|piece| sealed_piece(program, piece)).collect()
}

/// `piece` with its seams, sealed by `program`.
fn sealed_piece(program: &Program, piece: &PieceName) -> SealedPiece {
    let of_piece = seam_totals(program).into_iter().filter(|seam| seam.name.piece == *piece);
    let seams = of_piece.map(|seam| sealed_seam(seam.name.seam.clone(), seam)).collect();
    SealedPiece { name: piece.word(), kind: piece.kind().to_owned(), time_s: None, seams }
}
