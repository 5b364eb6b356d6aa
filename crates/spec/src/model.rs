//! The spec itself: one struct a section, every field complete and in range.

use crate::accuracy::Accuracy;
use crate::cut::CutSpec;
use crate::press::Press;
use crate::processes::DEFAULT_PROCESS;
use crate::product::ProductKind;
use crate::units::{Angle, ArealDensity, BendingStiffness, Force, Length, LineForce, Mass, Pressure};
use crate::{DrawingSpec, KeyPath, ProcessSpec, Seal, key};

/// A complete and valid specification of a gripper, or of a piece by a drawing.
#[derive(Clone, Debug, PartialEq)]
pub struct Spec {
    /// The user's name for it: 1 to 80 characters, none of them a control character.
    pub name: String,
    /// `[fabric]`
    pub fabric: Fabric,
    /// The stars from bottom to top: `[star]` with the values of `[stack]` and `[[stack.star]]`; empty where there is a drawing.
    pub stars: Vec<StarSpec>,
    /// `[drawing]`; `None` where there are stars.
    pub drawing: Option<DrawingSpec>,
    /// `[inlet]`; `None` if the tube is closed all around.
    pub inlet: Option<Inlet>,
    /// `[seal]`
    pub seal: Seal,
    /// `[process.NAME]`, in the order of the alphabet.
    pub processes: Vec<ProcessSpec>,
    /// `[mask]`
    pub mask: Mask,
    /// `[frame]`
    pub frame: FrameSpec,
    /// `[cut]`
    pub cut: CutSpec,
    /// `[sheet]`
    pub sheet: Sheet,
    /// `[machine]`
    pub machine: MachineChoice,
    /// `[press]`; `None` where the machine moves an iron.
    pub press: Option<Press>,
    /// `[load]`; `None` if no prediction is requested.
    pub load: Option<Load>,
    /// `[accuracy]`
    pub accuracy: Accuracy,
    /// `[build]`
    pub build: BuildSpec,
}

/// The files that a build makes.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct BuildSpec {
    /// Files that every build of this spec makes beside the default ones; no duplicates.
    pub with: Vec<Extra>,
    /// Address of the page that the QR code of previews and report leads to; `None` for no code.
    pub link: Option<String>,
}

crate::choices! {
    /// A kind of file that comes only where it is named.
    Extra,
    /// The name of the kind of file.
    name;
    /// A one-page report of the gripper.
    Report: "report",
    /// The products in three dimensions.
    SceneGlb: "scene-glb",
    /// A reduced model for MuJoCo.
    Mjcf: "mjcf",
    /// The picture in pixels.
    PreviewPng: "preview-png",
    /// The cut on paper.
    OutlinePdf: "outline-pdf",
    /// A plate of the frame on paper.
    FramePdf: "frame-pdf",
    /// A plate of the frame as a solid.
    FrameStl: "frame-stl",
}

/// The fabric of one sheet.
#[derive(Clone, Debug, PartialEq)]
pub struct Fabric {
    /// Thickness t.
    pub thickness: Length,
    /// Young's modulus E.
    pub young_modulus: Pressure,
    /// Poisson ratio nu, in (-1, 0.5].
    pub poisson_ratio: f64,
    /// Peel strength T_max of the seal, from the user's own T-peel test.
    pub seal_strength: Option<LineForce>,
    /// Mass of one sheet per area.
    pub areal_density: Option<ArealDensity>,
    /// Measured bending stiffness B of one sheet, in place of E t^3 / [12 (1 - nu^2)].
    pub bending_stiffness: Option<BendingStiffness>,
    /// Measured stretch stiffness Y of one sheet, in place of E t.
    pub stretch_stiffness: Option<LineForce>,
    /// Shear modulus G between warp and weft; isotropic, E / [2 (1 + nu)], without one.
    pub shear_modulus: Option<Pressure>,
    /// Angle of the warp on the sheet, counterclockwise from X, along which each star has its first corner.
    pub warp: Angle,
}

/// One star, flat.
#[derive(Clone, Debug, PartialEq)]
pub struct StarSpec {
    /// Number of points n, 3 to 64.
    pub points: u32,
    /// Inner radius rho_0: from the axis to the tube's edge at a reentrant corner.
    pub inner_radius: Length,
    /// Tube width W, between the inner edges of the bands.
    pub tube_width: Length,
    /// Internal angle phi_i0 between the two arms of a point.
    pub tip_angle: Angle,
    /// Inner radius of curvature R_i of the tips.
    pub tip_radius: Length,
    /// Inner radius of curvature R_e of the reentrant corners.
    pub corner_radius: Length,
    /// Rotation against the star below (of star 1: against the frame).
    pub rotation: Angle,
    /// Distance to the star below (of star 1: unused).
    pub pitch: Length,
    /// The tip that carries the inlet, 1 to n.
    pub inlet_tip: u32,
    /// The process of the inner loop.
    pub inner_process: String,
    /// The process of the outer loop.
    pub outer_process: String,
}

impl Spec {
    /// The distance between the air's edges and those of the paper that goes between the sheets, mm; `None` where no paper does.
    pub fn paper_creep(&self) -> Option<f64> {
        match &self.press {
            Some(press) => Some(press.creep.0),
            None => (self.mask.kind == MaskKind::Separator).then_some(self.mask.creep.0),
        }
    }

    /// The product that it describes.
    pub fn product(&self) -> ProductKind {
        if self.drawing.is_some() { ProductKind::Drawing } else { ProductKind::Stars }
    }

    /// Whether it is a gripper of stars.
    pub fn has_stars(&self) -> bool {
        match self.product() {
            ProductKind::Stars => true,
            ProductKind::Drawing => false,
        }
    }
}

impl StarSpec {
    /// The paper's star with `points` points: rho_0 = 50 mm, W = 30 mm, phi_i0 = 30 deg, sharp hinges.
    pub fn paper(points: u32) -> Self {
        Self {
            points,
            inner_radius: Length(50.0),
            tube_width: Length(30.0),
            tip_angle: Angle(30.0),
            tip_radius: Length(0.0),
            corner_radius: Length(0.0),
            rotation: Angle(0.0),
            pitch: Length(40.0),
            inlet_tip: 1,
            inner_process: DEFAULT_PROCESS.to_owned(),
            outer_process: DEFAULT_PROCESS.to_owned(),
        }
    }

    /// Whether the flat parts are the same; their places in the stack may differ.
    pub fn same_part(&self, other: &Self) -> bool {
        let [flat, other_flat] =
            [self, other].map(|star| Self { rotation: Angle(0.0), pitch: Length(0.0), ..star.clone() });
        flat == other_flat
    }
}

/// The channel through which the tube is inflated.
#[derive(Clone, Debug, PartialEq)]
pub struct Inlet {
    /// Outer diameter d of the hose; the flat channel is pi d / 2 wide.
    pub tube_diameter: Length,
    /// From the tip's outer arc, along its ray, to the mouth.
    pub length: Length,
    /// Radius where the channel meets the tip's arc.
    pub fillet: Length,
}

/// The masks.
#[derive(Clone, Debug, PartialEq)]
pub struct Mask {
    /// The purpose of the masks.
    pub kind: MaskKind,
    /// Reach of the coated zone along both arms from a corner's apex; `None`: the star's own W.
    pub extent: Option<Length>,
    /// The windows, or the separator, shrink by this.
    pub creep: Length,
    /// Plate beyond the outline.
    pub border: Length,
    /// Whether a mirrored copy for the other face is made too.
    pub mirror: bool,
    /// Thickness of the 3-D printed mask.
    pub thickness: Length,
    /// The bed of the 3-D printer; `None`: masks are printed whole.
    pub bed: Option<Bed>,
}

/// The purpose of a mask.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MaskKind {
    /// A plate with windows, through which the corners of a star are coated.
    Coating,
    /// Paper between the sheets of a drawn shape in a heat press, where they must not weld.
    Separator,
}

/// The bed of a 3-D printer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bed {
    /// Extent along X.
    pub width: Length,
    /// Extent along Y.
    pub depth: Length,
}

/// The frame that keeps the arms in their planes.
#[derive(Clone, Debug, PartialEq)]
pub struct FrameSpec {
    /// Thickness of a plate.
    pub plate_thickness: Length,
    /// Clearance around the moving parts.
    pub clearance: Length,
    /// Diameter of a post.
    pub post_diameter: Length,
    /// Number of posts, 3 to 64.
    pub posts: u32,
    /// Width of the cut; default: the kerf of `[cut]`.
    pub kerf: Length,
}

/// Colours of cutting drawings, by which laser programs tell what to do with a line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Colours {
    /// Everything is cut in one colour; the file's order is the order of the cuts.
    One,
    /// Holes, windows and outer edges each in a colour of their own, for programs that order their work by colour.
    Ordered,
}

/// The fabric as it lies on the machine.
#[derive(Clone, Debug, PartialEq)]
pub struct Sheet {
    /// Width along X; `None`: as large as the parts need.
    pub width: Option<Length>,
    /// Height along Y; `None`: as large as the parts need.
    pub height: Option<Length>,
    /// Number of copies of a drawn piece.
    pub copies: u32,
    /// Free strip along the sheet's border.
    pub margin: Length,
    /// Distance between parts.
    pub gap: Length,
    /// Whether parts may be turned to fit.
    pub turn: bool,
    /// Diameter of the registration holes; 0 for none.
    pub hole_diameter: Length,
}

/// The machine and how it is driven.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MachineChoice {
    /// A built-in profile's name, or a path relative to the spec.
    pub profile: String,
    /// One program a piece or one a sheet.
    pub program: ProgramScope,
    /// The action below the controller's lowest feed.
    pub feed_floor: FeedFloor,
    /// Stops above the marks of a sheet.
    pub marks: Marks,
}

/// Stops of traces and sealing programs above two marks of the sheet, by which it is found again.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Marks {
    /// None.
    #[default]
    Ignored,
    /// A pause above each.
    Pause,
}

/// The scope of one G-code program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ProgramScope {
    /// One piece.
    Piece,
    /// All pieces of one sheet.
    Sheet,
}

/// The action when the seal speed is below the lowest feed that the controller holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FeedFloor {
    /// Refuse to write the program.
    Refuse,
    /// Write micro-moves with dwells.
    Chop,
}

/// The load of the gripper; without it nothing is predicted.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Load {
    /// Gauge pressure p.
    pub pressure: Option<Pressure>,
    /// Radius of the object where it is widest: half of `object_diameter`, or `object_radius`.
    pub object_radius: Option<Length>,
    /// Whether `object_radius` gives the object's size, not `object_diameter`.
    pub by_radius: bool,
    /// Height of the object; absent: as tall as wide.
    pub object_height: Option<Length>,
    /// Shape of the object; absent: a ball.
    pub object_shape: Option<ObjectShape>,
    /// Friction coefficient mu between corner and object.
    pub friction: Option<f64>,
    /// Least that mu may be; absent: mu.
    pub friction_least: Option<f64>,
    /// Most that mu may be; absent: mu.
    pub friction_most: Option<f64>,
    /// Mass of the object that friction shall hold; of a drawing what hangs on the lower one of its bars.
    pub mass: Option<Mass>,
    /// Largest radial force of one star that the object bears.
    pub largest_force: Option<Force>,
    /// Gauge pressures of chambers of a drawing that differ from `pressure`, by the names of their ports.
    pub chambers: Vec<(String, Pressure)>,
    /// Distance of two rigid level plates between which a drawing's chambers are inflated.
    pub plates: Option<Length>,
}

impl Load {
    /// Range of mu: mu itself at both ends unless the spec gives others. It always contains mu, which a study may vary alone.
    pub fn friction_range(&self) -> Option<[f64; 2]> {
        let mu = self.friction?;
        Some([self.friction_least.unwrap_or(mu).min(mu), self.friction_most.unwrap_or(mu).max(mu)])
    }

    /// The key that gave the object's size, or the documented one.
    pub fn size_key(&self) -> KeyPath {
        if self.by_radius { key::load::OBJECT_RADIUS } else { key::load::OBJECT_DIAMETER }
    }
}

crate::choices! {
    /// The shape of an object whose axis is the gripper's.
    ObjectShape,
    /// The word of the shape in specs and arguments.
    word;
    /// A cylinder: as wide everywhere.
    Cylinder: "cylinder",
    /// A ball; an ellipsoid of revolution where it is not as tall as wide.
    Ball: "ball",
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Source, read};

    #[test]
    fn a_spec_is_of_the_product_whose_section_it_has() {
        for (section, product) in ProductKind::ALL {
            let keys = match product {
                ProductKind::Stars => {
                    "points = 5\ninner_radius = \"50 mm\"\ntube_width = \"30 mm\"\ntip_angle = \"30 deg\"\n"
                }
                ProductKind::Drawing => "file = \"a.svg\"\nlayers = { air = [\"a\"] }\n",
            };
            let text = format!("schema = 1\nname = \"x\"\n[{section}]\n{keys}");
            let spec = read(&Source::new("spec", text)).expect("valid").spec;
            assert_eq!((spec.product(), product.section()), (product, section));
        }
    }
}
