//! Files with one fault each, and the findings of `verify`.

use std::borrow::Cow;

use stargrip_cam::artifact::KindRequest;
use stargrip_cam::pipeline::{Built, Sources, build, prove_files, read_back};
use stargrip_cam::spec;
use stargrip_cam::spec::Source;
use stargrip_cam::verify::OutputFiles;

use super::specs::Message;
use crate::zip;

/// A build with one changed file.
#[derive(Clone, Copy)]
struct Edit {
    code: &'static str,
    base: Base,
    file: &'static str,
    old: &'static str,
    new: &'static str,
}

/// The build to change.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Base {
    Plain,
    Hotend,
    Arcs,
    Chopped,
    Predicted,
    /// A mask in pieces.
    Tiled,
    /// A clamp in a corner of the sheet.
    Clamped,
    /// Sealed by a heat press.
    Pressed,
    /// A wait after each seam.
    Cooled,
    /// A printer that homes.
    Homed,
    /// Stops above the marks of the sheet.
    Marked,
    /// A package for a printer.
    Packed,
    /// Sealed by a laser.
    Laser,
}

const SEAL: &str = "star-1-seal.gcode";
const TRACE: &str = "star-1-trace.gcode";
const SVG: &str = "sheet-1-seal.svg";
const DXF: &str = "sheet-1-seal.dxf";
const PAPER_SVG: &str = "paper-1-separator.svg";
const PACKAGE: &str = "star-1-seal.gcode.3mf";
const MOVE: &str = "G1 X256.9069 Y220.6945\n";

const fn edit(code: &'static str, file: &'static str, old: &'static str, new: &'static str) -> Edit {
    Edit { code, base: Base::Plain, file, old, new }
}

const fn edit_of(base: Base, edit: Edit) -> Edit {
    Edit { base, ..edit }
}

const EDITS: &[Edit] = &[
    edit("after-end", SEAL, "M2\n", "M2\nG0 Z30 F1200\n"),
    edit("backwards", SEAL, MOVE, "G1 X256.9069 Y220.6945\nG1 X253.9406 Y217.0314\n"),
    edit_of(Base::Arcs, edit("bad-arc", "star-1-seal.ngc", " I", " I1")),
    edit("bad-character", SEAL, "; name: paper", "; name: p\u{e4}per"),
    edit("bad-comment", SEAL, "M2\n", "; heat: by=hand\nM2\n"),
    edit("bad-dxf", DXF, "  0\nSECTION", "  x\nSECTION"),
    edit("bad-feed", SEAL, "F6", "F0"),
    edit("bad-number", SEAL, "Y220.6945", "Y"),
    edit("bad-path", SVG, "A31 31 0 0 1 173", "A31 31 0 2 1 173"),
    edit_of(Base::Packed, edit("bad-zip", PACKAGE, "G28", "G27")),
    edit_of(Base::Clamped, edit("clamp-in-the-way", SEAL, "M2\n", "G0 X4 Y330 F1200\nM2\n")),
    edit("bad-xml", SVG, "</title>", "</titel>"),
    edit_of(Base::Laser, edit("beam-at-end", SEAL, "M5\nM2\n", "M4 S0\nM2\n")),
    edit_of(Base::Laser, edit("beam-at-rest", SEAL, "M4 S0\n", "M4 S80\n")),
    edit_of(Base::Laser, edit("beam-constant", SEAL, "M4 S0\n", "M3 S0\n")),
    edit_of(Base::Laser, edit("beam-in-travel", SEAL, "M5\nG0 X", "G0 X1 Y1 S80\nM5\nG0 X")),
    edit_of(Base::Laser, edit("beam-off-focus", SEAL, " S0\nM5\n", "\nM5\n")),
    edit_of(Base::Laser, edit("wrong-power", SEAL, " S80\n", " S88\n")),
    edit_of(Base::Chopped, edit("below-floor", SEAL, "F103.096168697", "F10")),
    edit("blind-move", SEAL, "G0 Z30 F1200\n; heat", "G0 Z5 F1200\n; heat"),
    edit("cold-seal", SEAL, "M0\n", "\n"),
    edit("deviation", SEAL, "X256.9069", "X256.9169"),
    edit("differs", SVG, "#0000ff", "#0000fe"),
    edit("extra-seam", SEAL, "M2\n", "G0 Z5\nG1 X1 Y1 Z-0.3 F6\nG1 X2 Y2 Z5\nG0 Z30 F1200\nM2\n"),
    edit("formats-disagree", DXF, "  8\nseal-inner\n", "  8\nseal-outer\n"),
    edit("hash", SVG, "#0000ff", "#0000fe"),
    edit("heat-without-pause", SEAL, "M2\n", "; heat: temperature_C=200\nM2\n"),
    edit("hot-trace", TRACE, "G0 X10 Y10", "M0\nG0 X10 Y10"),
    edit("iron-at-rest", SEAL, MOVE, "G1 X256.9069 Y220.6945\nG4 P9\n"),
    edit(
        "jump",
        SEAL,
        "G1 X259.8731 Y224.3576\n",
        "G1 X259.8731 Y224.3576 Z1\nG1 X262.8394 Y228.0206 Z-0.3\n",
    ),
    edit("missing-overlap", SEAL, "G1 X254.1209 Y217.2541\nG1 X256.0089", "G1 X256.0089"),
    edit_of(Base::Marked, edit("missing-mark", TRACE, "look, press start\nM0\n", "look, press start\n")),
    edit_of(Base::Cooled, edit("missing-wait", SEAL, "G4 P3\n", "")),
    edit("transform", SVG, "<path d=", "<path transform=\"scale(1)\" d="),
    edit(
        "late-start",
        SEAL,
        "G1 X250.9743 Y213.3684 Z-0.3 F6\nG1 X253.9406 Y217.0314\n",
        "G1 X253.9406 Y217.0314 Z-0.3 F6\n",
    ),
    edit(
        "line-too-long",
        SEAL,
        "; frame: origin",
        "; frame: the origin of all coordinates that are in this file lies",
    ),
    edit_of(
        Base::Chopped,
        edit(
            "long-stroke",
            SEAL,
            "G4 P1134\nG1 X249.1684 Y211.1383 Z4.7696\nG4 P1134\nG1 X249.2095 Y211.189 Z4.6543\n",
            "G4 P1134\nG1 X249.2095 Y211.189 Z4.6543\n",
        ),
    ),
    edit("low-trace", TRACE, "G0 Z5 ", "G0 Z4 "),
    edit("manifest", "manifest.json", "\"tool\"", "\"tools\""),
    edit("modal-conflict", SEAL, "G0 X249.0863", "G0 G1 X249.0863"),
    edit("mode-unset", SEAL, "G21\n", ""),
    edit("more-findings", SEAL, "F6", "F12"),
    edit("open-loop", SVG, " Z\"", "\""),
    edit("other-comment", SEAL, "overlap_mm=5", "overlap_mm=6"),
    edit("outside-page", SVG, "M250.9743", "M950.9743"),
    edit("outside-work-area", SEAL, "G0 Z30 F1200\nG0 X0", "G0 Z90 F1200\nG0 X0"),
    edit("path-count", SVG, "Z\" stroke", "ZM0 0L1 1Z\" stroke"),
    edit("path-length", SVG, "L271.7383 97.4902", "L171.7383 97.4902"),
    edit("plunge", SEAL, "G1 X250.9743 Y213.3684 Z-0.3 F6", "G1 Z-0.3 F6\nG1 X250.9743 Y213.3684"),
    edit_of(Base::Predicted, edit("prediction", "prediction.json", "\"section\"", "\"ring\"")),
    edit("profile-line", SEAL, "G90\n", "G90\nG61\n"),
    edit("rapid-in-contact", SEAL, "G1 X256.9069", "G0 X256.9069"),
    edit("repeated-word", SEAL, "X256.9069", "X256.9069 X1"),
    edit_of(
        Base::Chopped,
        edit(
            "short-stroke",
            SEAL,
            "G1 X249.1684 Y211.1383 Z4.7696\n",
            "G1 X249.1376 Y211.1 Z4.88\nG4 P100\nG1 X249.1684 Y211.1383 Z4.7696\n",
        ),
    ),
    edit("size", SVG, "paper", "papers"),
    edit_of(Base::Homed, edit("feed-override", SEAL, "M220 S100", "M220 S50")),
    edit_of(Base::Homed, edit("hot-bed", SEAL, "M107\n", "M107\nM190 S120\n")),
    edit_of(Base::Homed, edit("unhomed-axis", SEAL, "G28\n", "G28 X Y\n")),
    edit_of(Base::Hotend, edit("stray-heat", SEAL, "G0 Z5 F1200", "M104 S250\nG0 Z5 F1200")),
    edit("stray-travel", SEAL, "G0 X249.0863", "G0 X248.0863"),
    edit("too-deep", SEAL, "Z-0.3", "Z-0.9"),
    edit("travel-feed", SEAL, "Y211.037 F1200", "Y211.037 F12"),
    edit("truncated", SEAL, "; end of program", "; the end"),
    edit("unknown-layer", SVG, "seal-inner", "other"),
    edit("unknown-position", SEAL, "G0 X249.0863 Y211.037", "G1 X249.0863 Y211.037"),
    edit("unknown-word", SEAL, "G94\n", "G94\nM7\n"),
    edit("unreadable", "spec.toml", "points = 5", "points = 2"),
    edit("unused-word", SEAL, "G0 X249", "G0 I1 X249"),
    edit("wrong-feed", SEAL, "Z-0.3 F6", "Z-0.3 F12"),
    edit("wrong-scale", SVG, "width=\"333.1mm\"", "width=\"333.1px\""),
    edit("wrong-size", SVG, "width=\"333.1mm\"", "width=\"334.1mm\""),
    edit("wrong-title", SVG, "seal, sheet 1", "seal, sheet 2"),
    edit("bad-stl", "star-1-mask.stl", "of star", "star"),
];

const LASER: &str =
    "[seal]\npower = \"8 %\"\nspeed = \"10 mm/s\"\ntip = \"1 mm\"\n[machine]\nprofile = \"grbl-laser\"\n";
const PAPER: &str = include_str!("../../../designs/paper-five-points.toml");

/// A profile with a clamp that no way of the program comes near to.
fn clamped() -> String {
    let generic = spec::builtin_machine("generic").expect("built in");
    let place = "x = \"1 mm\"\ny = \"300 mm\"\nwidth = \"6 mm\"\ndepth = \"6 mm\"\n";
    format!("{generic}\n[[keep_out]]\nname = \"vice\"\n{place}")
}

fn built(base: Base) -> Built {
    let rest = match base {
        Base::Plain => "",
        Base::Hotend => "[machine]\nprofile = \"klipper\"\n",
        Base::Arcs => "[machine]\nprofile = \"linuxcnc\"\n",
        Base::Chopped => "[machine]\nprofile = \"marlin\"\nfeed_floor = \"chop\"\n",
        Base::Predicted => "[load]\npressure = \"37 kPa\"\n",
        Base::Tiled => "[mask]\nbed = \"220 mm x 220 mm\"\n",
        Base::Clamped => "[machine]\nprofile = \"own.toml\"\n",
        Base::Pressed => "[machine]\nprofile = \"press\"\n",
        Base::Homed => "[machine]\nprofile = \"klipper-printer\"\n",
        Base::Cooled => "[seal]\ncool = \"3 s\"\n",
        Base::Marked => "[machine]\nmarks = \"pause\"\n",
        Base::Packed => "[machine]\nprofile = \"bambu\"\n",
        Base::Laser => LASER,
    };
    // A printer's bed is smaller than the paper's star.
    let star = if base == Base::Packed {
        PAPER.replace("50 mm", "26 mm").replace("30 mm", "16 mm")
    } else {
        PAPER.to_owned()
    };
    let text = format!("{star}{rest}");
    let read = spec::read(&Source::new("spec.toml", text.as_str())).expect("valid").spec;
    let profile = spec::builtin_machine(&read.machine.profile).map_or_else(clamped, str::to_owned);
    let machine = spec::read_machine(&Source::new("machine.toml", profile.as_str())).expect("valid");
    let sources = Sources { spec: &text, machine: &profile };
    build(&read, &machine, sources, &KindRequest::default()).unwrap_or_else(|refusals| panic!("{refusals}"))
}

fn all_builds() -> Vec<(Base, Built)> {
    let bases = [
        Base::Plain,
        Base::Hotend,
        Base::Arcs,
        Base::Chopped,
        Base::Predicted,
        Base::Tiled,
        Base::Clamped,
        Base::Pressed,
        Base::Cooled,
        Base::Homed,
        Base::Marked,
        Base::Packed,
        Base::Laser,
    ];
    bases.into_iter().map(|base| (base, built(base))).collect()
}

/// The findings in a build with a changed file, with a missing file, and with an extra one.
pub(crate) fn messages() -> Vec<Message> {
    // Most faults are one change of a text in one file of a build. The others change the list of files, a whole drawing, or a solid.
    let builds = all_builds();
    let mut messages = Vec::new();
    for &Edit { code, base, file, old, new } in EDITS {
        let (_, build) = builds.iter().find(|(known, _)| *known == base).expect("built");
        messages.extend(message_after(code, build.output_files(), |files| {
            if let Some((_, bytes)) = files.files.iter_mut().find(|(name, _)| name == file) {
                *bytes = replaced(bytes, old.as_bytes(), new.as_bytes()).into();
            }
        }));
    }
    let (_, plain) = &builds[0];
    messages.extend(message_after("missing-file", plain.output_files(), |files| {
        files.files.retain(|(name, _)| name != SVG);
    }));
    messages.extend(message_after("not-a-file", plain.output_files(), |files| {
        files.files.retain(|(name, _)| name != SVG);
        files.others.push((SVG.into(), "a link"));
    }));
    messages.extend(message_after("unnamed-file", plain.output_files(), |files| {
        files.files.push(("notes.txt".into(), Cow::Borrowed(b"x")));
    }));
    messages.extend(message_after("not-text", plain.output_files(), |files| {
        let (_, bytes) = files.files.iter_mut().find(|(name, _)| name == SVG).expect("a file");
        bytes.to_mut()[1] = 0xff;
    }));
    messages.extend(message_after("missing-seam", plain.output_files(), |files| {
        change_text(files, SEAL, |program| {
            let (head, rest) = program.split_once("; seam: seam=2").expect("two seams");
            let (_, end) = rest.rsplit_once("G0 Z30").expect("the end");
            format!("{head}G0 Z30{end}")
        });
    }));
    messages.extend(message_after("order", plain.output_files(), |files| {
        change_text(files, SVG, |drawing| {
            let renamed = drawing.replace("seal-inner", "?").replace("seal-outer", "seal-inner");
            renamed.replace('?', "seal-outer")
        });
    }));
    messages.extend(message_after("wrong-volume", plain.output_files(), |files| {
        move_corners(files, "star-1-mask.stl", 1.01, 0.0);
    }));
    messages.extend(paper_messages(&builds));
    let (_, packed) = builds.iter().find(|(base, _)| *base == Base::Packed).expect("built");
    messages.extend(message_after("wrong-package", packed.output_files(), |files| {
        let (_, bytes) = files.files.iter_mut().find(|(name, _)| name == PACKAGE).expect("a package");
        let mut list = zip::parts(bytes);
        list.retain(|(name, _)| name != "3D/3dmodel.model");
        *bytes = zip::archive(&list).into();
    }));
    let (_, tiled) = builds.iter().find(|(base, _)| *base == Base::Tiled).expect("built");
    messages.extend(message_after("wrong-joint", tiled.output_files(), |files| {
        move_corners(files, "star-1-mask-piece-2.stl", 1.0, 0.3);
    }));
    messages.extend(message_after("not-watertight", plain.output_files(), |files| {
        let (_, bytes) = files.files.iter_mut().find(|(name, _)| name == "star-1-mask.stl").expect("a file");
        bytes.to_mut()[96] ^= 0x40;
    }));
    messages
}

/// The findings in paper that does not fit the seams of a pressed star.
fn paper_messages(builds: &[(Base, Built)]) -> Vec<Message> {
    let mut messages = Vec::new();
    let (_, pressed) = builds.iter().find(|(base, _)| *base == Base::Pressed).expect("built");
    for (code, layer) in [("narrow-band", "separator-window"), ("welded-air", "separator-edge")] {
        messages.extend(message_after(code, pressed.output_files(), |files| {
            change_text(files, PAPER_SVG, |drawing| without_path(drawing, layer));
        }));
    }
    messages.extend(message_after("stray-paper", pressed.output_files(), |files| {
        // A strip of paper across the cut, far from the port.
        let strip = "<path d=\"M0 160 L120 160 L120 176 L0 176 Z\"";
        change_text(files, PAPER_SVG, |drawing| {
            let (start, paper) = drawing.rsplit_once("<path d=").expect("the paper's edge");
            let (_, style) = paper.split_once("\" ").expect("the attributes of a path");
            let (style, _) = style.split_once('>').expect("an element");
            format!("{start}{strip} {style}><path d={paper}")
        });
    }));
    messages
}

/// `drawing` without the first path of the group `layer`.
fn without_path(drawing: &str, layer: &str) -> String {
    let (start, group) = drawing.split_once(&format!("id=\"{layer}\"")).expect("a layer");
    let (head, path) = group.split_once("<path").expect("a path");
    let (_, rest) = path.split_once("/>").expect("its end");
    format!("{start}id=\"{layer}\"{head}{rest}")
}

/// Changes the text of the file `name`.
fn change_text(files: &mut OutputFiles<'_>, name: &str, change: impl Fn(&str) -> String) {
    let (_, bytes) = files.files.iter_mut().find(|(file, _)| file == name).expect("a file");
    *bytes = change(std::str::from_utf8(bytes).expect("text")).into_bytes().into();
}

/// Moves every corner of the solid `name`: `scale` times as far from the origin, and then by `shift` mm along X.
fn move_corners(files: &mut OutputFiles<'_>, name: &str, scale: f32, shift: f32) {
    let (_, bytes) = files.files.iter_mut().find(|(file, _)| file == name).expect("a file");
    for facet in bytes.to_mut()[84..].chunks_exact_mut(50) {
        for (axis, word) in facet[12..48].chunks_exact_mut(4).enumerate() {
            let coordinate = scale * f32::from_le_bytes([word[0], word[1], word[2], word[3]]);
            let moved = if axis % 3 == 0 { coordinate + shift } else { coordinate };
            word.copy_from_slice(&moved.to_le_bytes());
        }
    }
}

/// The finding of `code` after a `change`, by reading alone or else by bytes, too.
fn message_after(
    code: &str,
    mut files: OutputFiles<'_>,
    change: impl FnOnce(&mut OutputFiles<'_>),
) -> Option<Message> {
    change(&mut files);
    let of_code =
        |findings: Vec<stargrip_cam::verify::Finding>| findings.into_iter().find(|one| one.code == code);
    let finding = of_code(read_back(&files).findings).or_else(|| of_code(prove_files(&files).findings))?;
    Some((code.to_owned(), finding.to_string().replacen(&format!("{code}: "), "", 1)))
}

/// `bytes` with the first `old` in them replaced; unchanged if there is none, so that no finding follows.
fn replaced(bytes: &[u8], old: &[u8], new: &[u8]) -> Vec<u8> {
    match bytes.windows(old.len()).position(|part| part == old) {
        Some(at) => [&bytes[..at], new, &bytes[at + old.len()..]].concat(),
        None => bytes.to_vec(),
    }
}
