//! The pull on the seams of a drawn chamber.

use crate::interval::Interval;
use crate::meshed::MeshedPlace;
use crate::prediction::groups_of_equals;
use crate::seal_load::burst_of_drawn;
use design::DrawnPieces;
use geom::Point;
use geom::order::sort_by;
use inflatable::shell::cases::{InflatedRegion, RegionSeam, SeamPull};
use sealed::Seam;
use serde::Serialize;
use spec::units::{Length, LineForce, Pressure};
use spec::{SealProcess, Spec};
use std::collections::BTreeMap;

/// The pull on one seam of a chamber.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[allow(non_snake_case, reason = "keys contain units in their usual spelling")]
pub struct SeamPrediction {
    /// Name of the seam, as on drawings and in programs.
    pub seam: String,
    /// The largest pull.
    pub pull_N_per_mm: MeshedPlace,
    /// Rows of a place (x, y, mm), the pull there (N/mm) and its mesh error, along the seam.
    pub along: Vec<[f64; 4]>,
}

/// The seam that peels at the least pressure.
pub(super) struct SeamOpening {
    /// Name of the seam.
    pub seam: String,
    /// Name of the piece, "piece-2", where several have a seam of this name.
    pub piece: Option<String>,
    /// Name of its process.
    pub process: String,
    /// The pressure, Pa.
    pub burst: f64,
    /// Range of the pressure, Pa.
    pub range: Interval,
}

/// Name of a seam that has none of its own.
const ONLY: &str = "seam";

/// The name under which `seam` is reported.
fn name_of(seam: &Seam) -> &str {
    if seam.name.is_empty() { ONLY } else { &seam.name }
}

/// The process and the peel strength of every seam of drawn pieces.
pub(super) struct SeamStrengths {
    /// By the index of the piece and the name of the seam; of seams of a piece with one name the weakest.
    seams: BTreeMap<(usize, String), SealProcess>,
    default: SealProcess,
}

impl SeamStrengths {
    pub(super) fn new(spec: &Spec, pieces: &DrawnPieces) -> Self {
        let mut seams: BTreeMap<(usize, String), SealProcess> = BTreeMap::new();
        for (index, piece) in pieces.pieces.iter().enumerate() {
            for (seam, lines) in piece.shape.seams.iter().zip(&piece.seam_lines) {
                let process = spec.process(&lines.process);
                let key = (index, name_of(seam).to_owned());
                if seams.get(&key).is_none_or(|weakest| process.strength < weakest.strength) {
                    let _ = seams.insert(key, process);
                }
            }
        }
        Self { seams, default: spec.default_process() }
    }

    /// Whether seams are sealed by more than one process.
    pub(super) fn differ(&self) -> bool {
        let mut names = self.seams.values().map(|process| &process.name);
        names.next().is_some_and(|first| names.any(|name| name != first))
    }

    /// The one of `seams` of `pieces` that peels at the least pressure; `None` if a strength is unknown. The pulls are those at `pressure`.
    pub(super) fn first_opening(
        &self,
        seams: &[SeamPrediction],
        pieces: &DrawnPieces,
        pressure: Pressure,
    ) -> Option<SeamOpening> {
        let mut first: Option<SeamOpening> = None;
        for SeamPrediction { seam, pull_N_per_mm, .. } in seams {
            let bearing = pieces_with(seam, pieces, pull_N_per_mm.at_mm);
            let index = bearing.first().copied();
            let own_process = index.and_then(|index| self.seams.get(&(index, seam.clone())));
            let process = own_process.unwrap_or(&self.default);
            let peel = process.strength?.newtons_per_metre();
            let pull = [pull_N_per_mm.value, pull_N_per_mm.mesh_error]
                .map(|pull| LineForce(pull).newtons_per_metre());
            let Some((burst, range)) = burst_of_drawn(peel, pressure.pascals(), pull) else { continue };
            if first.as_ref().is_none_or(|least| burst <= least.burst) {
                let piece = index.filter(|_| bearing.len() > 1).and_then(|index| piece_word(index, pieces));
                let (seam, process) = (seam.clone(), process.name.clone());
                first = Some(SeamOpening { seam, piece, process, burst, range });
            }
        }
        first
    }
}

/// The indices of the `pieces` that have a seam called `name`, the one whose seam is nearest to `place`, mm, first.
fn pieces_with(name: &str, pieces: &DrawnPieces, place: [f64; 2]) -> Vec<usize> {
    let shapes = pieces.pieces.iter().map(|piece| &piece.shape.seams).enumerate();
    let mut distances: Vec<(usize, f64)> =
        shapes.filter_map(|(index, seams)| Some((index, least_distance(name, seams, place)?))).collect();
    sort_by(&mut distances, |a, b| a.1.total_cmp(&b.1));
    distances.into_iter().map(|(index, _)| index).collect()
}

/// The distance of `place` from the nearest of `seams` that is called `name`, mm; `None` if none is.
fn least_distance(name: &str, seams: &[Seam], [x, y]: [f64; 2]) -> Option<f64> {
    let of_name = seams.iter().filter(|seam| name_of(seam) == name);
    of_name.map(|seam| seam.center_line.distance(Point::new(x, y))).min_by(f64::total_cmp)
}

/// The name of a piece as in the manifest: that of its first copy.
fn piece_word(index: usize, pieces: &DrawnPieces) -> Option<String> {
    pieces.copies.iter().find(|copy| copy.distinct == index).map(|copy| copy.name().word())
}

/// Rows of one seam at most.
const MOST_ROWS: usize = 48;

/// The seams of `pieces` that bound the region, in the order in which they are met, each with its largest pull.
///
/// The shell knows edges and welds of the region only. A pull belongs to the seam whose centre line is nearest to its place.
pub(super) fn seam_predictions(region: &InflatedRegion, pieces: &DrawnPieces) -> Vec<SeamPrediction> {
    let names = groups_of_equals(region.seams.iter().map(|pull| seam_name(pull, pieces)));
    let of_name = names.into_iter().filter_map(|(name, numbers)| {
        let pulls: Vec<&SeamPull> = numbers.iter().map(|number| &region.seams[number - 1]).collect();
        of_seam(name, &pulls, region.is_parted)
    });
    of_name.collect()
}

/// The name of the seam of `pieces` whose centre line is nearest to a pull; "seam" for the only one.
fn seam_name(pull: &SeamPull, pieces: &DrawnPieces) -> String {
    let [x, y] = pull.at.map(|length| Length::from_metres(length).0);
    let seams = pieces.pieces.iter().flat_map(|piece| &piece.shape.seams);
    let by_distance = seams.map(|seam| (seam.center_line.distance(Point::new(x, y)), seam));
    let nearest = by_distance.min_by(|a, b| a.0.total_cmp(&b.0));
    nearest.map_or(ONLY, |(_, seam)| name_of(seam)).to_owned()
}

fn of_seam(seam: String, pulls: &[&SeamPull], is_parted: bool) -> Option<SeamPrediction> {
    // Each edge of a weld's band bears the pull of its own side. Between chambers of different pressure one side may bear all of it.
    let places: Vec<MeshedPlace> = pulls
        .iter()
        .map(|pull| {
            let share = if matches!(pull.seam, RegionSeam::Weld(_)) && !is_parted { 0.5 } else { 1.0 };
            MeshedPlace::rounded(pull.pull.scaled(share * 1e-3), pull.at)
        })
        .collect();
    // Compared on the finest mesh, as in the shell.
    let (largest, _) =
        places.iter().zip(pulls).max_by(|(_, a), (_, b)| a.pull.meshes[2].total_cmp(&b.pull.meshes[2]))?;
    let row = |place: &MeshedPlace| {
        let MeshedPlace { value, mesh_error, at_mm: [x, y] } = *place;
        [x, y, value, mesh_error]
    };
    Some(SeamPrediction {
        seam,
        pull_N_per_mm: *largest,
        along: places.iter().step_by(pulls.len().div_ceil(MOST_ROWS).max(1)).map(row).collect(),
    })
}
