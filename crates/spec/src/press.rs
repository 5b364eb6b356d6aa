//! `[press]`: a heat press that seals all bands of a sheet at once, around paper that lies between the two sheets of fabric.

use crate::FaultCode;
use crate::allowed::{Allowed, EXTRA, SIZE};
use crate::fault::{Fault, quoted};
use crate::profile::builtin_machine;
use crate::release_layer::check_ptfe;
use crate::section::{Reader, Section};
use crate::shape::ValueShape;
use crate::units::{Duration, Length, Pressure, Readable, Temperature};
use crate::unknown::nearest;

/// The name of the built-in profile of a heat press.
pub const PRESS_PROFILE: &str = "press";

/// Default of `creep`, mm: by this the paper is smaller than the air, so that bands keep their width where it lies off its place.
///
/// Three errors add up as the root of their squares: 0.2 mm of play of pins in punched holes, 0.2 mm of a line that is cut by hand,
/// and 0.15 mm of a printer whose scale is off by 0.1 % over 150 mm from the middle. A knife plotter needs less.
pub const PAPER_CREEP: f64 = 0.3;

/// `[press]`
#[derive(Clone, Debug, PartialEq)]
pub struct Press {
    /// Temperature of the plates.
    pub temperature: Temperature,
    /// Time of one pressing.
    pub time: Duration,
    /// Pressure on the sheet.
    pub pressure: Pressure,
    /// From below to above, what lies between the plates.
    pub layers: Vec<PressLayer>,
    /// The edges of the paper lie this far inside the air.
    pub creep: Length,
    /// The paper from which separators are cut; `None`: paper as large as the sheet of fabric.
    pub paper: Option<PaperSize>,
    /// Extent of the plates along X and Y; `None` if unknown: the sheet is then the only limit.
    pub plates: Option<[Length; 2]>,
}

/// One layer between the plates.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PressLayer {
    /// A flat board, or felt or foam that evens the pressure out.
    Board,
    /// Baking paper or PTFE, which does not stick to the fabric.
    Release,
    /// A sheet of the fabric, its side that welds towards the other sheet.
    Fabric,
    /// The separators.
    Separator,
}

/// The size of a sheet of paper.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PaperSize {
    /// 210 x 297 mm.
    A4,
    /// 297 x 420 mm.
    A3,
    /// 8.5 x 11 in.
    Letter,
    /// Width and height.
    Custom(Length, Length),
}

impl PressLayer {
    /// All of them with the words that specs write.
    pub const ALL: [(&'static str, Self); 4] = [
        ("board", Self::Board),
        ("release", Self::Release),
        ("fabric", Self::Fabric),
        ("separator", Self::Separator),
    ];

    /// The layers of a press with a cold lower plate.
    pub const USUAL: [Self; 6] =
        [Self::Board, Self::Release, Self::Fabric, Self::Separator, Self::Fabric, Self::Release];

    /// The word of the layer in a spec.
    pub fn word(self) -> &'static str {
        Self::ALL.iter().find(|(_, layer)| *layer == self).map_or("", |(word, _)| word)
    }
}

impl PaperSize {
    /// The sizes that have names, by the words that specs write.
    pub const NAMES: [(&'static str, Self); 3] =
        [("A4", Self::A4), ("A3", Self::A3), ("letter", Self::Letter)];

    /// Width and height of the sheet, mm.
    pub fn sides(self) -> [f64; 2] {
        match self {
            Self::A4 => [210.0, 297.0],
            Self::A3 => [297.0, 420.0],
            Self::Letter => [215.9, 279.4],
            Self::Custom(width, height) => [width.0, height.0],
        }
    }
}

impl Press {
    /// The pressure as "2 bar".
    pub fn pressure_in_bar(&self) -> String {
        format!("{} bar", Readable(self.pressure.0 / 100.0))
    }

    /// The force on an area of `area` mm^2 at this pressure, N.
    pub fn force(&self, area: f64) -> f64 {
        // 1 kPa on 1 mm^2 is 1e-3 N.
        self.pressure.0 * area * 1e-3
    }
}

/// Reads `[press]`: `None` unless it is written, or the machine is the profile `press`.
pub(super) fn read(reader: &mut Reader<'_>, profile: &str) -> Option<Press> {
    let mut section = reader.section("press");
    let press = read_section(&mut section);
    let (is_written, place) = (section.is_written(), section.place());
    let is_press = profile == PRESS_PROFILE;
    // A profile of the user's own may be a press, too: it is read later, and then compared with the spec.
    if is_written && !is_press && builtin_machine(profile).is_some() {
        let message = format!("[press] beside the machine {}", quoted(profile));
        let fault = Fault::error(FaultCode::Conflict, place, message)
            .label("an iron has no plates")
            .help("write profile = \"press\" in [machine], or delete [press]");
        reader.faults.push(fault);
    }
    if !is_written && !is_press {
        return None;
    }
    refuse_iron(reader);
    Some(press)
}

/// The paths of an iron have no meaning for a press.
fn refuse_iron(reader: &mut Reader<'_>) {
    let keys = [
        ("seal", "temperature", "write `temperature` in [press]"),
        ("seal", "speed", "a press seals all bands at once: write `time` in [press]"),
        ("seal", "overlap", "a press has no path that could overlap: delete it"),
        ("seal", "height", "a press has no tip: write `pressure` in [press]"),
        ("seal", "tip", "a press has no tip: delete it"),
        ("seal", "lines", "a press seals the whole width of a band: delete it"),
        ("seal", "passes", "a press seals all bands at once: write `time` in [press]"),
        ("seal", "cool", "a press seals all bands at once: delete it"),
        ("seal", "pause", "a press seals all bands at once: delete it"),
        ("machine", "program", "a press runs no programs: delete it"),
        ("machine", "feed_floor", "a press runs no programs: delete it"),
        ("machine", "marks", "a press runs no programs: delete it"),
        ("cut", "tool", "a press runs no programs: delete it"),
    ];
    for (section, key, remedy) in keys {
        let table = reader.raw.root().get(section).and_then(|value| value.as_table());
        let Some(entry) = table.and_then(|table| table.0.iter().find(|entry| entry.key == key)) else {
            continue;
        };
        let message = format!("`{key}` in [{section}] beside the machine \"{PRESS_PROFILE}\"");
        let fault = Fault::error(FaultCode::Conflict, entry.key_span.clone(), message);
        reader.faults.push(fault.label("it is for an iron that follows the seams").help(remedy));
    }
}

/// Shortest and longest pressing, s: below a second the fabric is not warm through, and no source presses longer than minutes.
pub const PRESS_TIMES: Allowed = Allowed::closed(0.5, 600.0);
/// Pressures of a hand iron up to that of a hydraulic press, kPa.
const PRESSURES: Allowed = Allowed::closed(1.0, 5e3);
/// From body heat up; the release layer sets the upper limit.
const TEMPERATURES: Allowed = Allowed::closed(40.0, 400.0);

/// The values of `[press]`, whatever the machine.
pub(super) fn read_section(s: &mut Section<'_, '_>) -> Press {
    let press = Press {
        temperature: s.quantity("temperature", TEMPERATURES).unwrap_or(Temperature(145.0)),
        time: s.quantity("time", PRESS_TIMES).unwrap_or(Duration(10.0)),
        pressure: s.quantity("pressure", PRESSURES).unwrap_or(Pressure(200.0)),
        layers: read_layers(s),
        creep: s.length("creep", EXTRA, PAPER_CREEP),
        paper: read_paper(s),
        plates: s.area("plates", SIZE),
    };
    check_ptfe(s, press.temperature);
    press
}

/// The layers from below: two sheets of fabric with the separator between them, and a release layer towards the hot plate.
fn read_layers(s: &mut Section<'_, '_>) -> Vec<PressLayer> {
    let Some(words) = s.texts("layers") else { return PressLayer::USUAL.to_vec() };
    let mut layers = Vec::new();
    for (word, span) in words {
        if let Some((_, layer)) = PressLayer::ALL.iter().find(|(name, _)| *name == word) {
            layers.push(*layer);
            continue;
        }
        let names = PressLayer::ALL.map(|(name, _)| name);
        let fault = Fault::error(FaultCode::UnknownChoice, span, format!("a layer is {}", quoted(word)))
            .label(format!("must be one of {}", names.join(", ")));
        s.report(match nearest(word, names) {
            Some(suggestion) => fault.help(format!("did you mean \"{suggestion}\"?")),
            None => fault,
        });
        return PressLayer::USUAL.to_vec();
    }
    if let Some(allowed) = fault_of_layers(&layers) {
        let layer_words = layers.iter().map(|layer| layer.word()).collect::<Vec<_>>().join(", ");
        s.refuse(FaultCode::OutOfRange, "layers", format!("`layers` are {layer_words}"), allowed);
    }
    layers
}

/// The reason why these layers make no sealed part, as what must be instead.
fn fault_of_layers(layers: &[PressLayer]) -> Option<&'static str> {
    use PressLayer::{Fabric, Release, Separator};
    let lower = layers.windows(3).position(|three| three == [Fabric, Separator, Fabric]);
    let [fabrics, separators] =
        [Fabric, Separator].map(|layer| layers.iter().filter(|other| **other == layer).count());
    let (Some(lower), 2, 1) = (lower, fabrics, separators) else {
        return Some("must have two sheets of fabric with the separator between them");
    };
    if !layers[lower..].contains(&Release) {
        return Some("must have a release layer above the fabric, or it sticks to the hot plate");
    }
    if !layers[..lower].contains(&Release) {
        return Some("must have a release layer below the fabric, or it sticks to what lies there");
    }
    None
}

/// A size of paper by its name, or two lengths.
fn read_paper(s: &mut Section<'_, '_>) -> Option<PaperSize> {
    let names = PaperSize::NAMES.map(|(name, _)| name);
    let shape = ValueShape::Or(Box::new(ValueShape::Area(SIZE)), names.to_vec());
    let word = s.take("paper", shape.clone())?.as_text().map(str::to_lowercase);
    let named = PaperSize::NAMES.iter().find(|(name, _)| word.as_deref() == Some(&name.to_lowercase()));
    if let Some((_, size)) = named {
        return Some(*size);
    }
    if let Some(word) = word.filter(|word| !word.contains(['x', '\u{d7}'])) {
        let allowed = "must be \"A4\", \"A3\", \"letter\", or two lengths: \"600 mm x 400 mm\"";
        s.refuse(FaultCode::UnknownChoice, "paper", format!("`paper` is {}", quoted(&word)), allowed);
        return None;
    }
    let sides = s.area("paper", SIZE);
    s.narrow("paper", shape);
    sides.map(|[width, height]| PaperSize::Custom(width, height))
}
