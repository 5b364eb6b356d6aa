//! `[cut]`: how masks, outlines and frames are cut, and the tool that cuts the sheet on the machine after the seal.

use crate::allowed::{Allowed, EXTRA};
use crate::fault::Fault;
use crate::laser::{CUT_BY_LASER, POWERS, read_focus};
use crate::seal::read_height;
use crate::section::Section;
use crate::units::{Duration, Length, Percent, Speed, Temperature};
use crate::{Colours, FaultCode, FeedFloor, MachineChoice, Seal, SealPause, Spec};

/// Speeds of a cut, mm/s.
const SPEEDS: Allowed = Allowed::closed(1e-2, 1e3);
/// Temperatures of a hot tip, degrees Celsius: the release layer is off while it cuts.
const TEMPERATURES: Allowed = Allowed::half_open(0.0, 500.0);
/// Distances from the axis of a drag knife to the tip of its blade, mm.
const OFFSETS: Allowed = Allowed::closed(0.0, 5.0);

/// The cutting method of masks, outlines and frames.
#[derive(Clone, Debug, PartialEq)]
pub struct CutSpec {
    /// Width of the cut.
    pub kerf: Length,
    /// The meaning of a drawing's colours: layer and order of the cuts.
    pub colours: Colours,
    /// The cut of the sheet on the machine, after the seal; `None`: no program cuts.
    pub program: Option<CutProcess>,
}

/// The way in which a program cuts the sheet.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CutProcess {
    /// The tool in the place of the iron.
    pub tool: CutTool,
    /// Speed of the tool along the cut.
    pub speed: Speed,
    /// Height of the tool's tip while it cuts, or of a laser's lens at its focus; 0 is the top of the release layer.
    pub height: Length,
}

/// A tool that cuts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum CutTool {
    /// A hot tip, which melts its way through both sheets.
    HotTip {
        /// Temperature of the tip.
        temperature: Temperature,
    },
    /// A blade that is drawn behind the axis of its holder, and swivels about its own tip at corners.
    DragKnife {
        /// Distance from the axis to the tip of the blade.
        blade_offset: Length,
    },
    /// The laser that sealed before, with more power.
    Laser {
        /// Part of full power.
        power: Percent,
    },
}

impl CutTool {
    /// The word of the tool in specs and programs.
    pub fn word(self) -> &'static str {
        match self {
            Self::HotTip { .. } => ToolWord::HotTip.name(),
            Self::DragKnife { .. } => ToolWord::DragKnife.name(),
            Self::Laser { .. } => ToolWord::Laser.name(),
        }
    }

    /// The tool in words: "hot tip".
    pub fn in_words(self) -> &'static str {
        match self {
            Self::HotTip { .. } => "hot tip",
            Self::DragKnife { .. } => "drag knife",
            Self::Laser { .. } => "laser",
        }
    }

    /// The temperature of the tool; `None` for a cold one.
    pub fn temperature(self) -> Option<Temperature> {
        match self {
            Self::HotTip { temperature } => Some(temperature),
            Self::DragKnife { .. } | Self::Laser { .. } => None,
        }
    }

    /// The power of a laser; `None` of another tool.
    pub fn power(self) -> Option<Percent> {
        match self {
            Self::Laser { power } => Some(power),
            Self::HotTip { .. } | Self::DragKnife { .. } => None,
        }
    }

    /// Distance from the tool's axis to the point that cuts.
    pub fn blade_offset(self) -> Length {
        match self {
            Self::HotTip { .. } | Self::Laser { .. } => Length(0.0),
            Self::DragKnife { blade_offset } => blade_offset,
        }
    }
}

impl Spec {
    /// The spec with the cut by `process` in the place of its seal, for programs that cut: one pass at the speed of the cut, without strokes
    /// and dwells.
    #[must_use]
    pub fn cut_by(&self, process: &CutProcess) -> Self {
        let seal = Seal {
            temperature: process.tool.temperature().unwrap_or(Temperature(0.0)),
            power: process.tool.power(),
            speed: process.speed,
            height: Some(process.height),
            passes: 1,
            lines: None,
            tip: None,
            cool: Duration(0.0),
            pause: SealPause::Never,
            ..self.seal.clone()
        };
        let machine = MachineChoice { feed_floor: FeedFloor::Refuse, ..self.machine.clone() };
        Self { seal, processes: Vec::new(), machine, ..self.clone() }
    }
}

/// `[cut]`.
pub(super) fn read_cut(s: &mut Section<'_, '_>) -> CutSpec {
    CutSpec {
        kerf: s.length("kerf", EXTRA, 0.0),
        colours: s
            .choice("colours", &[("one", Colours::One), ("ordered", Colours::Ordered)])
            .unwrap_or(Colours::One),
        program: read_process(s),
    }
}

/// A choice of a tool, whose settings are keys of their own.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum ToolWord {
    HotTip,
    DragKnife,
    Laser,
}

impl ToolWord {
    const ALL: [(&'static str, Self); 3] = [
        (Self::HotTip.name(), Self::HotTip),
        (Self::DragKnife.name(), Self::DragKnife),
        (Self::Laser.name(), Self::Laser),
    ];

    /// The word in specs and programs.
    const fn name(self) -> &'static str {
        match self {
            Self::HotTip => "hot-tip",
            Self::DragKnife => "drag-knife",
            Self::Laser => CUT_BY_LASER,
        }
    }

    /// The keys of the tool's settings, each with an example.
    const fn settings(self) -> [(&'static str, &'static str); 3] {
        match self {
            Self::HotTip => [("temperature", "\"350 C\""), ("speed", "\"5 mm/s\""), ("height", "\"-1 mm\"")],
            Self::DragKnife => {
                [("blade_offset", "\"0.25 mm\""), ("speed", "\"20 mm/s\""), ("height", "\"-1 mm\"")]
            }
            Self::Laser => [("power", "\"60 %\""), ("speed", "\"10 mm/s\""), ("focus", "\"12 mm\"")],
        }
    }
}

/// The tool with its settings. All keys are read, so that each is known and in range; a key that the tool lacks is reported, and so is
/// one of another tool.
fn read_process(s: &mut Section<'_, '_>) -> Option<CutProcess> {
    let word = s.choice("tool", &ToolWord::ALL);
    let temperature = s.quantity("temperature", TEMPERATURES);
    let speed = s.quantity("speed", SPEEDS);
    let height = read_height(s);
    let blade_offset = s.quantity("blade_offset", OFFSETS);
    let power = s.quantity("power", POWERS);
    let focus = read_focus(s);
    let settings = word.map_or_else(Vec::new, |word| word.settings().to_vec());
    for (key, example) in settings.iter().filter(|(key, _)| !s.contains(key)).copied().collect::<Vec<_>>() {
        let message = format!("`tool` in [cut] without `{key}`");
        let fault = Fault::error(FaultCode::MissingKey, s.place_of("tool"), message);
        s.report(fault.label("the tool needs it").help(format!("for example {key} = {example}")));
    }
    for key in ["temperature", "speed", "height", "blade_offset", "power", "focus"] {
        let is_other = s.contains(key) && !settings.iter().any(|(setting, _)| *setting == key);
        if is_other && (word.is_some() || !s.contains("tool")) {
            let tool = word
                .map_or("without a `tool`".to_owned(), |word| format!("beside the tool {:?}", word.name()));
            let fault =
                Fault::error(FaultCode::Conflict, s.place_of(key), format!("`{key}` in [cut] {tool}"));
            s.report(fault.label("it would have no effect").help("delete it, or write another `tool`"));
        }
    }
    let (tool, height) = match word? {
        ToolWord::HotTip => (CutTool::HotTip { temperature: temperature? }, height?),
        ToolWord::DragKnife => (CutTool::DragKnife { blade_offset: blade_offset? }, height?),
        ToolWord::Laser => (CutTool::Laser { power: power? }, focus?),
    };
    Some(CutProcess { tool, speed: speed?, height })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Faults, Reading, Source, read};

    fn reading(cut: &str) -> Result<Reading, Faults> {
        let star =
            "[star]\npoints = 5\ninner_radius = \"50 mm\"\ntube_width = \"30 mm\"\ntip_angle = \"30 deg\"\n";
        read(&Source::new("x", format!("schema = 1\nname = \"x\"\n{star}[cut]\n{cut}")))
    }

    #[test]
    fn a_tool_has_its_settings() {
        let cut =
            "tool = \"drag-knife\"\nblade_offset = \"0.25 mm\"\nspeed = \"20 mm/s\"\nheight = \"-0.8 mm\"\n";
        let program = reading(cut).unwrap_or_else(|faults| panic!("{faults}")).spec.cut.program;
        let tool = CutTool::DragKnife { blade_offset: Length(0.25) };
        assert_eq!(program, Some(CutProcess { tool, speed: Speed(20.0), height: Length(-0.8) }));
        assert_eq!(reading("").unwrap_or_else(|faults| panic!("{faults}")).spec.cut.program, None);
    }

    #[test]
    fn every_fault_of_a_tool_has_its_code() {
        let common = "speed = \"5 mm/s\"\nheight = \"-1 mm\"\n";
        let hot = format!("{common}tool = \"hot-tip\"\n");
        for (cut, codes) in [
            (hot.clone(), vec!["missing-key"]),
            (format!("{hot}temperature = \"350 C\"\nblade_offset = \"0 mm\"\n"), vec!["conflict"]),
            ("tool = \"hot-tip\"\n".to_owned(), vec!["missing-key"; 3]),
            (common.to_owned(), vec!["conflict"; 2]),
            (format!("{common}tool = \"saw\"\n"), vec!["unknown-choice"]),
            (format!("{hot}temperature = \"900 C\"\n"), vec!["out-of-range"]),
            (
                "tool = \"hot-tip\"\ntemperature = \"350 C\"\nspeed = \"0 mm/s\"\nheight = \"1 mm\"\n"
                    .to_owned(),
                vec!["out-of-range"; 2],
            ),
            (format!("{hot}temperature = \"nan C\"\n"), vec!["not-a-number"]),
        ] {
            let faults = reading(&cut).expect_err("a fault");
            let fault_codes: Vec<&str> = faults.list().iter().map(|fault| fault.code).collect();
            assert_eq!(fault_codes, codes, "{cut}: {faults}");
        }
    }
}
