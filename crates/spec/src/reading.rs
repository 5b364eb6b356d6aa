//! From a raw spec to the [`Spec`]: each section with its defaults and its ranges.
//!
//! After a fault, reading goes on with a substitute for the faulty value; a substitute never leaves this room, because the faults
//! then refuse the spec.

use crate::accuracy::{Accuracy, ModelChoice};
use crate::allowed::{Allowed, EXTRA, SIZE};
use crate::cut::read_cut;
use crate::fault::{Fault, quoted};
use crate::faults::Faults;
use crate::foreign::{self, Document};
use crate::model::{
    Bed, BuildSpec, Extra, Fabric, FeedFloor, FrameSpec, MachineChoice, Marks, Mask, MaskKind, ProgramScope,
    Sheet, Spec,
};
use crate::processes::{check_uses, read_processes, refuse_processes};
use crate::raw::RawSpec;
use crate::seal::{STRENGTHS, read_seal, read_strength};
use crate::section::{Reader, Section};
use crate::shape::ValueShape;
use crate::source::Source;
use crate::units::{Angle, Length, LineForce, Percent, Pressure};
use crate::{Code, DrawingContent, FaultCode, KeyPath, drawing, key, laser, load, press, stars};
use std::ops::Range;

/// A spec that was read, and the warnings about its text.
#[derive(Clone, Debug)]
pub struct Reading {
    /// The complete, valid spec.
    pub spec: Spec,
    /// Warnings about a valid spec; often empty.
    pub warnings: Faults,
    /// The parsed text, to find the place of a key that a later stage refuses.
    pub raw: RawSpec,
}

impl Reading {
    /// This reading with the `bytes` of the drawing that the spec names, if it names one.
    #[must_use]
    pub fn with_drawing(mut self, bytes: &[u8]) -> Self {
        if let Some(drawing) = &mut self.spec.drawing {
            drawing.content = Some(DrawingContent::new(bytes));
        }
        self
    }
}

/// Reads a spec. A drawing that it names is not read: see [`Reading::with_drawing`].
///
/// Ranges, ends included unless noted otherwise: sizes 1 um to 100 m; radii, allowances, margins, creep, kerf, overlap
/// and fillet 0 to 100 m; `hole_diameter` 0 or from 0.2 mm; `points` and `posts` 3 to 64; `count` 1 to 64; `tip` and `inlet_tip` 1 to the star's points;
/// `tip_angle` between 0 and 180 deg, both excluded; `rotation` up to 3600 deg either way; `temperature` above 0 C and
/// below 300 C, with a warning above 260 C; `speed` 0.001 to 1000 mm/s; `power` above 0, to 100 %; `focus` above 0, to 500 mm; `passes` and `lines` 1 to 20; `cool` 0 to 1 h; `young_modulus` 1 Pa to 1 TPa; `poisson_ratio`
/// above -1, to 0.5; `seal_strength` 1e-6 to 1e4 N/mm; `areal_density` 1e-6 to 1e4 kg/m^2; `bending_stiffness`
/// 1e-9 to 1e9 N mm; `stretch_stiffness` 1e-6 to 1e9 N/mm; `pressure` 1 Pa to 1 GPa;
/// `friction` above 0, to 10; `path` 0.0001 to 1 mm; `response` above 0, to 100 %; `name` as in [`check_name`](crate::name::check_name);
/// `link` an address of at most 200 letters.
///
/// # Errors
/// All faults of the text at once, warnings among them, if at least one refuses it.
pub fn read(source: &Source) -> Result<Reading, Faults> {
    let (spec, warnings, raw) = read_with(source, Document::Spec, read_spec)?;
    Ok(Reading { spec, warnings, raw })
}

/// The name of the machine profile that `source` gives, with its place, whatever faults the spec has; `None` if it gives none.
pub fn written_profile(source: &Source) -> Option<(String, Range<usize>)> {
    let (raw, _) = RawSpec::parse(&source.text);
    raw.text_of(key::machine::PROFILE).map(|(name, place)| (name.to_owned(), place))
}

/// Parses `source`, which should be a `document`, lets `body` take its keys, and collects the faults of both.
pub(super) fn read_with<T>(
    source: &Source,
    document: Document,
    body: impl FnOnce(&mut Reader<'_>) -> T,
) -> Result<(T, Faults, RawSpec), Faults> {
    let (raw, mut faults) = RawSpec::parse(&source.text);
    if let Some(fault) = foreign::fault(&source.text).filter(|_| !faults.is_empty()) {
        return Err(Faults::new(source, vec![fault]));
    }
    if let Some(fault) = document.mistaken(raw.root()) {
        return Err(Faults::new(source, vec![fault]));
    }
    let mut reader = Reader::new(&raw);
    let value = body(&mut reader);
    let unread_keys = reader.finish();
    faults.extend(if faults.is_empty() {
        unread_keys
    } else {
        beyond_syntax(unread_keys, &faults, &source.text)
    });
    let faults = Faults::new(source, faults);
    if faults.refuse() { Err(faults) } else { Ok((value, faults, raw)) }
}

/// Near broken syntax, keys are lost and values are the parser's guesses: keeps the faults of `key_faults` that do not come from
/// that.
fn beyond_syntax(key_faults: Vec<Fault>, syntax: &[Fault], text: &str) -> Vec<Fault> {
    let broken_lines: Vec<usize> = syntax.iter().map(|fault| line_of(text, fault.span.start)).collect();
    // Without the bracket of its header, a section's keys are read as others.
    let unclosed = syntax.iter().find(|fault| fault.message.starts_with("unclosed table")).map(|fault| {
        let (start, end) = (fault.span.start, text.len());
        start..text.get(start..).and_then(|rest| rest.find("\n[")).map_or(end, |length| start + length)
    });
    let is_sound = |fault: &Fault| {
        fault.code != FaultCode::MissingKey.as_str()
            && fault.span != (0..0)
            && !unclosed.as_ref().is_some_and(|lost| lost.contains(&fault.span.start))
            && !broken_lines.contains(&line_of(text, fault.span.start))
    };
    key_faults.into_iter().filter(is_sound).collect()
}

/// Number of the line, from 0, of the byte `place` of `text`.
fn line_of(text: &str, place: usize) -> usize {
    text.as_bytes().iter().take(place).filter(|byte| **byte == b'\n').count()
}

/// Reports a `schema` that is not `version`, the only supported one.
pub(super) fn read_schema(root: &mut Section<'_, '_>, version: u32) {
    let schema = root.count("schema", 0, u32::MAX);
    root.narrow("schema", ValueShape::Count(version, version));
    if let Some(schema) = schema.filter(|schema| *schema != version) {
        let allowed = format!("must be {version}, the only version this program supports");
        root.refuse(FaultCode::Schema, "schema", format!("`schema` is {schema}"), allowed);
    }
}

pub(super) fn read_spec(reader: &mut Reader<'_>) -> Spec {
    // Each section is read on its own, so that all faults are told at once. What concerns two sections is checked
    // where both are known.
    let mut root = reader.root();
    root.require(&[("schema", "1"), ("name", "\"five-point star\"")]);
    read_schema(&mut root, 1);
    let name = root.name().unwrap_or_default();
    let (seal, strength) = read_seal(&mut reader.section("seal"));
    let processes = read_processes(reader, &seal);
    let fabric = read_fabric_with(reader, strength);
    let drawing = drawing::read(reader);
    let (stars, inlet) = stars::read(reader, drawing.is_some());
    let cut = read_cut(&mut reader.section("cut"));
    let machine = read_choice(&mut reader.section("machine"));
    let press = press::read(reader, &machine.profile);
    if press.is_some() {
        refuse_processes(reader);
    }
    reader.faults.extend(laser::faults(reader.raw, &machine.profile));
    let spec = Spec {
        name,
        fabric,
        stars,
        drawing,
        inlet,
        seal,
        processes,
        mask: read_mask(&mut reader.section("mask")),
        frame: read_frame(&mut reader.section("frame"), cut.kerf),
        cut,
        sheet: read_sheet(&mut reader.section("sheet")),
        machine,
        press,
        load: load::read_load(&mut reader.section("load")),
        accuracy: read_accuracy(&mut reader.section("accuracy")),
        build: read_build(&mut reader.section("build")),
    };
    check_product(reader, &spec);
    check_uses(reader, &spec.processes);
    spec
}

/// Values that only one of the products can have.
fn check_product(reader: &mut Reader<'_>, spec: &Spec) {
    if spec.has_stars() && spec.sheet.copies > 1 {
        let message = format!("`copies` is {} without a [drawing]", spec.sheet.copies);
        report_conflict(reader, key::sheet::COPIES, message, "stars are counted by `count` in [stack]");
    }
    if spec.press.is_some() && spec.mask.kind == MaskKind::Separator && spec.mask.creep.0 > 0.0 {
        let message = format!("`creep` in [mask] is {} beside [press]", spec.mask.creep);
        let label = "the paper of a press has `creep` in [press]: write it there";
        report_conflict(reader, key::mask::CREEP, message, label);
    }
    let of_stars = [
        (Extra::FramePdf, "only stacked stars have a frame"),
        (Extra::FrameStl, "only stacked stars have a frame"),
        (Extra::Mjcf, "only stars have a model for MuJoCo"),
    ];
    for (extra, label) in of_stars {
        if !spec.has_stars() && spec.build.with.contains(&extra) {
            let message = format!("`with` names {:?} beside [drawing]", extra.name());
            report_conflict(reader, key::build::WITH, message, label);
        }
    }
}

fn report_conflict(reader: &mut Reader<'_>, key: KeyPath, message: String, label: &str) {
    let fault = Fault::error(FaultCode::Conflict, reader.raw.span_of(key), message).label(label);
    reader.faults.push(fault);
}

/// `[fabric]` beside the peel strength that `[seal]` states.
pub(super) fn read_fabric_with(reader: &mut Reader<'_>, strength: Option<LineForce>) -> Fabric {
    let fabric = read_fabric(&mut reader.section("fabric"));
    Fabric { seal_strength: read_strength(reader, fabric.seal_strength, strength), ..fabric }
}

pub(super) fn read_fabric(s: &mut Section<'_, '_>) -> Fabric {
    Fabric {
        thickness: s.length("thickness", SIZE, 0.3),
        young_modulus: s.quantity("young_modulus", Allowed::closed(1e-3, 1e9)).unwrap_or(Pressure(128e3)),
        poisson_ratio: s.number("poisson_ratio", Allowed::half_open(-1.0, 0.5)).unwrap_or(0.39),
        seal_strength: s.quantity("seal_strength", STRENGTHS),
        areal_density: s.quantity("areal_density", Allowed::closed(1e-6, 1e4)),
        bending_stiffness: s.quantity("bending_stiffness", Allowed::closed(1e-9, 1e9)),
        stretch_stiffness: s.quantity("stretch_stiffness", Allowed::closed(1e-6, 1e9)),
        shear_modulus: s.quantity("shear_modulus", Allowed::closed(1e-3, 1e9)),
        warp: s.quantity("warp", Allowed::closed(-180.0, 180.0)).unwrap_or(Angle(0.0)),
    }
}

fn read_mask(s: &mut Section<'_, '_>) -> Mask {
    let kinds = [("coating", MaskKind::Coating), ("separator", MaskKind::Separator)];
    Mask {
        kind: s.choice("kind", &kinds).unwrap_or(MaskKind::Coating),
        extent: s.quantity("extent", SIZE),
        creep: s.length("creep", EXTRA, 0.0),
        border: s.length("border", EXTRA, 10.0),
        mirror: s.truth("mirror").unwrap_or(false),
        thickness: s.length("thickness", SIZE, 2.0),
        bed: s.area("bed", SIZE).map(|[width, depth]| Bed { width, depth }),
    }
}

/// Fewest posts of a frame.
pub const FEWEST_POSTS: u32 = 3;

fn read_frame(s: &mut Section<'_, '_>, kerf: Length) -> FrameSpec {
    FrameSpec {
        plate_thickness: s.length("plate_thickness", SIZE, 5.0),
        clearance: s.length("clearance", EXTRA, 5.0),
        post_diameter: s.length("post_diameter", SIZE, 6.0),
        posts: s.count("posts", FEWEST_POSTS, 64).unwrap_or(4),
        kerf: s.quantity("kerf", EXTRA).unwrap_or(kerf),
    }
}

/// Smallest diameter of a hole in a file, mm: those of the coarsest `path` round coordinates to a tenth.
pub const SMALLEST_HOLE: f64 = 0.2;

/// The diameter of the registration holes; 0 for none.
fn read_hole(s: &mut Section<'_, '_>) -> Length {
    let diameter = s.length("hole_diameter", EXTRA, 3.0);
    if diameter.0 > 0.0 && diameter.0 < SMALLEST_HOLE {
        let message = format!("`hole_diameter` is {diameter}");
        let allowed = "must be at least 0.2 mm, or 0 mm for no registration holes";
        s.refuse(FaultCode::OutOfRange, "hole_diameter", message, allowed);
    }
    diameter
}

pub(super) fn read_sheet(s: &mut Section<'_, '_>) -> Sheet {
    Sheet {
        width: s.quantity("width", SIZE),
        height: s.quantity("height", SIZE),
        copies: s.count("copies", 1, 1000).unwrap_or(1),
        margin: s.length("margin", EXTRA, 10.0),
        gap: s.length("gap", EXTRA, 10.0),
        turn: s.truth("turn").unwrap_or(false),
        hole_diameter: read_hole(s),
    }
}

pub(super) fn read_choice(s: &mut Section<'_, '_>) -> MachineChoice {
    let allowed = "must be the name of a built-in profile, or a path relative to the spec";
    let scopes =
        [("star", ProgramScope::Piece), ("piece", ProgramScope::Piece), ("sheet", ProgramScope::Sheet)];
    MachineChoice {
        profile: s.path("profile", FaultCode::Profile, allowed).unwrap_or_else(|| "generic".to_owned()),
        program: s.choice("program", &scopes).unwrap_or(ProgramScope::Piece),
        feed_floor: s
            .choice("feed_floor", &[("refuse", FeedFloor::Refuse), ("chop", FeedFloor::Chop)])
            .unwrap_or(FeedFloor::Refuse),
        marks: s.choice("marks", &[("none", Marks::Ignored), ("pause", Marks::Pause)]).unwrap_or_default(),
    }
}

fn read_build(s: &mut Section<'_, '_>) -> BuildSpec {
    BuildSpec { with: s.choices("with", &Extra::ALL).unwrap_or_default(), link: read_link(s) }
}

/// Longest address of the page, letters.
const LINK_LENGTH: usize = 200;

/// The address of the page that a QR code leads to.
fn read_link(s: &mut Section<'_, '_>) -> Option<String> {
    let (link, span) = s.text("link")?;
    let page = link.strip_prefix("https://").unwrap_or_default();
    let host = page.split(['/', '?']).next().unwrap_or_default();
    // What precedes an @ is a user and a password, and may look like the host of another page.
    let is_open = !host.is_empty() && !host.contains('@');
    let is_of_address = |byte: u8| byte.is_ascii_graphic() && !b"#\"<>\\^`{|}".contains(&byte);
    if !is_open || link.len() > LINK_LENGTH || !link.bytes().all(is_of_address) {
        let label = format!(
            "must be an address of the page that begins with https://, of at most {LINK_LENGTH} characters, without # and without a user"
        );
        let fault = Fault::error(FaultCode::Link, span, format!("`link` is {}", quoted(link)));
        s.report(fault.label(label).help("for example \"https://example.org/stargrip-cam/\""));
        return None;
    }
    Some(link.to_owned())
}

fn read_accuracy(s: &mut Section<'_, '_>) -> Accuracy {
    Accuracy {
        path: s.length("path", Allowed::closed(1e-4, 1.0), 0.001),
        model: s.choice("model", &ModelChoice::ALL).unwrap_or(ModelChoice::Auto),
        response: s.quantity("response", Allowed::half_open(0.0, 100.0)).unwrap_or(Percent(50.0)),
    }
}
