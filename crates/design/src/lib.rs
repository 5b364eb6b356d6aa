//! From a valid spec to the exact geometry of everything that is sealed and cut.
//!
//! A [`Star`] is the flat geometry with its hinges; a [`Contour`] is a curve at a constant distance
//! from the tube's edge; an [`Outline`] is the cut. A [`StarDesign`] makes a sealed shape of them and holds all of one star in the star's own frame (axis at the origin,
//! corner 1 on +X); a [`Design`] places stars on sheets, and a [`Drawing`] is what lies on one sheet, layer by layer.
#![cfg_attr(not(test), warn(clippy::disallowed_methods))] // the last digits of std differ between systems (clippy.toml)

mod alignment;
mod assembly;
mod code;
mod contour;
mod coverage;
mod cut;
mod drawing;
mod drawn;
mod flat;
mod frame;
mod inlet;
mod job;
mod joint;
mod label;
mod lettering;
mod mask;
mod mask_tiles;
mod object;
mod offset;
mod outline;
mod overview;
mod paper;
mod paper_sheet;
mod part;
mod placement;
mod press_plan;
mod refusal;
mod registration;
mod seam_lines;
mod separator;
mod sheet;
mod solid;
mod stack;
mod stand;
mod star;
mod star_fault;
mod star_seam;
mod tube;
mod window;

pub use alignment::{Alignment, AlignmentFault};
pub use assembly::StarAssembly;
pub use code::RefusalCode;
pub use contour::{Contour, Part, Side};
pub use cut::{CutEdge, CutLines};
pub use drawing::{Drawing, Layer, Origin, Shape};
pub use drawn::{
    DrawnCut, DrawnLabels, DrawnPiece, DrawnPieces, LayerProposal, Measure, MeasureForm, RoledFigure,
    drawing_notes, figures, propose_layers, roled_figures, unit_question,
};
pub use flat::{FlatPiece, PieceCut};
pub use frame::{Frame, Plate, opening, shut_reach};
pub use inlet::Channel;
pub use job::{SealContact, SealJob, SealStop};
pub use lettering::lettered;
pub use mask::{COATING_ASSUMES, MaskPlate};
pub use mask_tiles::{MaskTile, MaskTiles};
pub use object::{Meeting, Object, does_not_enter, room};
pub use outline::{Circle, Outline, cut_area};
pub use paper::{Page as PaperPage, Paper};
pub use paper_sheet::{PaperSheet, PlacedSeparator};
pub use part::{Realised, SHEETS, StarDesign, realised_radius};
pub use placement::{PlacedPart, SheetLayout};
pub use press_plan::{PlanSection, PressPlan};
pub use refusal::{Refusal, Refusals, Warning};
pub use seam_lines::SeamLines;
pub use separator::PaperSeparator;
pub use sheet::{Design, Product};
pub use stack::{Stack, inflated_height, least_pitch, pitch_for};
pub use stand::Stand;
pub use star::Star;
pub use star_fault::arm_length;
pub use star_seam::MOUTH_OVERRUN;
pub use tube::{round_tube, tube_height};
