//! The paper that goes between the sheets of a piece in a heat press, wherever they must not weld.

use std::iter::successors;

use crate::cut::{largest, tool_around, tool_inside};
use crate::{Channel, PlacedPart, Refusal, RefusalCode, Star, lettering};
use geom::{Isometry, Path, Point, Vec2};
use sealed::{AirSide, SealedShape, Separator, Tongue};
use spec::units::{Most, Readable};
use spec::{KeyPath, Spec, key};

/// The separator of a piece, in the piece's frame.
#[derive(Clone, Debug, PartialEq)]
pub struct PaperSeparator {
    /// The paper's own edges.
    pub part: Separator,
    /// The lines that a tool follows to cut it.
    pub tool: Separator,
    /// Width of the cut, mm.
    pub kerf: f64,
    /// By which it is pulled out, in the order of the ports.
    pub tongues: Vec<Tongue>,
}

/// Height of a number on a tongue, as a part of the tongue's width.
const LABEL_SHARE: f64 = 0.45;
/// Heights of numbers, mm: one that can be read, and one that is high enough.
const LABEL_HEIGHTS: (f64, f64) = (1.5, 3.5);

impl PaperSeparator {
    /// The separator of `shape`, whose seams enclose `air`, with creep and kerf of `spec`; `None` where no paper is used.
    ///
    /// # Errors
    /// If a creep or a kerf leaves no paper in one piece for each chamber.
    pub(super) fn new(spec: &Spec, shape: &SealedShape, air: &AirSide) -> Result<Option<Self>, Refusal> {
        let Some(creep) = spec.paper_creep() else { return Ok(None) };
        let kerf = spec.cut.kerf.0;
        let key = if spec.press.is_some() { key::press::CREEP } else { key::mask::CREEP };
        let part = air
            .separator(shape, creep)
            .ok_or_else(|| no_separator(key, creep, |creep| air.separator(shape, creep).is_some()))?;
        let pieces = part.pieces.iter().map(|path| tool_around(path, kerf, "a separator"));
        let windows = part.windows.iter().map(|path| tool_inside(path, kerf, "a window of a separator"));
        let tool = Separator {
            pieces: pieces.collect::<Result<_, _>>()?,
            windows: windows.collect::<Result<_, _>>()?,
        };
        let tongues = shape.cut.as_ref().map_or_else(Vec::new, |cut| air.tongues(cut));
        Ok(Some(Self { part, tool, kerf, tongues }))
    }

    /// The piece's name on each tongue that is wide enough, along the tongue and read from outside.
    pub(super) fn labels(&self, piece: &PlacedPart) -> Vec<Path> {
        let text = name(piece);
        self.tongues.iter().flat_map(|tongue| label(tongue, &text)).collect()
    }
}

/// Kind and number of a piece where room is short: "S1" for star 1.
pub(crate) fn name(piece: &PlacedPart) -> String {
    let initial = piece.kind.chars().next().map_or(' ', |letter| letter.to_ascii_uppercase());
    format!("{initial}{}", piece.index)
}

/// The strokes of `text` on a tongue; none where it is too narrow.
fn label(tongue: &Tongue, text: &str) -> Vec<Path> {
    let height = (LABEL_SHARE * tongue.width).min(LABEL_HEIGHTS.1);
    if height < LABEL_HEIGHTS.0 {
        return Vec::new();
    }
    let inwards = -tongue.outwards;
    let start = tongue.end + inwards * height - inwards.perp() * (height / 2.0);
    let motion = Isometry { shift: start - Point::ORIGIN, ..Isometry::rotation(inwards.angle()) };
    lettering::lettered(text, Point::ORIGIN, height).iter().map(|path| motion.path(path)).collect()
}

/// The air of a star with this `channel`, by its tube's realised edges: the closed one at the hole, and the outer one, which the
/// channel opens.
pub(super) fn air_of_star(star: &Star, edges: &[Path; 2], channel: Option<&Channel>) -> AirSide {
    let [hole, outer_edge] = edges;
    let tongue = channel.map(|channel| Tongue {
        port: 0,
        end: channel.mouth_center(star),
        outwards: Vec2::unit(star.tip_ray(channel.tip)),
        width: 2.0 * channel.half_width,
        length: channel.mouth - star.tip_reach(),
    });
    let outer = if channel.is_some() { Channel::mouth_cut(outer_edge.clone()) } else { outer_edge.clone() };
    let air_edges = vec![outer.counterclockwise(), hole.counterclockwise().reversed()];
    AirSide::of_edges(air_edges.clone(), air_edges, tongue.as_slice())
}

/// The refusal of a creep that cuts the paper up, with the largest one that does not; `is_made` tests a creep.
fn no_separator(key: KeyPath, creep: f64, is_made: impl Fn(f64) -> bool) -> Refusal {
    let code = RefusalCode::NoWindow;
    if !is_made(0.0) {
        let problem = "the seams leave no paper in one piece for each chamber";
        let remedy =
            "draw seams in the air farther from each other, or without sharp bends; or delete [mask]";
        return Refusal::new(key, code, problem, remedy);
    }
    let fits = largest(creep, &is_made);
    // What is printed is itself tried: rounded down, a creep may be another that fails.
    let hundredths = successors(Some((fits * 100.0).floor()), |last| Some(last - 1.0));
    let largest_creep = hundredths.map(|last| last / 100.0).find(|most| *most <= 0.0 || is_made(*most));
    let problem = format!("a creep of {} mm closes a port or a passage of the separator", Readable(creep));
    Refusal::new(
        key,
        code,
        problem,
        format!("creep must be at most {} mm", Most(largest_creep.unwrap_or(0.0))),
    )
}
