//! The dialects, and their tables, each from its controller's documentation and source.

use spec::{Comments, Controller, DwellUnit, Vocabulary};

/// The strictest of GRBL (0.005 mm, or 0.1 % up to 0.5 mm) and LinuxCNC (about 0.028 mm).
const STRICTEST: ArcTolerance = ArcTolerance { free: 0.005, relative: 0.001, limit: 0.028 };

impl Dialect {
    /// The plain subset that every controller reads alike: capital letters, `;` comments, arcs by I and J.
    ///
    /// Parentheses are refused (some controllers end a comment at the first `)`), and so are `!`, `~` and `?`, which GRBL obeys
    /// even inside comments. The line length is GRBL's 80 with a reserve. G61 is left out. Arcs, and G91.1 with them, are read
    /// only for a profile with `arcs = true`. G0 is read as G1, at the feed in force, as three of the controllers do.
    pub const GENERIC: Self = Self {
        name: "generic",
        vocabulary: Vocabulary::for_dialect(spec::Dialect::Generic),
        line_length: 72,
        comments: Comments::Semicolon,
        forbidden: "()!~?",
        travel_at_feed: true,
        dwell: DwellUnit::Seconds,
        dwell_step: 0.0,
        arcs: STRICTEST,
    };

    /// LinuxCNC: lines up to 255.
    pub const LINUXCNC: Self = Self {
        name: "linuxcnc",
        vocabulary: Vocabulary::for_dialect(spec::Dialect::LinuxCnc),
        line_length: 255,
        travel_at_feed: false,
        ..Self::GENERIC
    };

    /// GRBL 1.1: lines up to 80 (protocol.h), no G90.1, arcs by gcode.c, dwells in steps of 50 ms (nuts_bolts.c).
    pub const GRBL: Self = Self {
        name: "grbl",
        vocabulary: Vocabulary::for_dialect(spec::Dialect::Grbl),
        line_length: 80,
        travel_at_feed: false,
        dwell_step: 0.05,
        arcs: ArcTolerance { free: 0.005, relative: 0.001, limit: 0.5 },
        ..Self::GENERIC
    };

    /// grblHAL: as GRBL, lines up to 256 (protocol.h).
    pub const GRBLHAL: Self = Self { name: "grblhal", line_length: 256, ..Self::GRBL };

    /// FluidNC: as GRBL, lines up to 255 (Protocol.h), dwells in whole milliseconds (NutsBolts.cpp).
    pub const FLUIDNC: Self = Self { name: "fluidnc", line_length: 255, dwell_step: 0.0, ..Self::GRBL };

    /// Marlin without its options: no arcs, planes or inches; lines up to 95 (MAX_CMD_SIZE); G4 P in ms; G0 as G1.
    pub const MARLIN: Self = Self {
        name: "marlin",
        vocabulary: Vocabulary::for_dialect(spec::Dialect::Marlin),
        line_length: 95,
        forbidden: "()!~?*",
        dwell: DwellUnit::Milliseconds,
        ..Self::GENERIC
    };

    /// Klipper without `[gcode_arcs]`: G4 P in ms, PAUSE of `[pause_resume]`, extended commands; G0 as G1.
    pub const KLIPPER: Self = Self {
        name: "klipper",
        vocabulary: Vocabulary::for_dialect(spec::Dialect::Klipper),
        line_length: 255,
        ..Self::MARLIN
    };

    /// RepRapFirmware 3: G4 P in ms, arc centres always from the start; G0 as G1, as printers have it.
    pub const REPRAPFIRMWARE: Self = Self {
        name: "reprapfirmware",
        vocabulary: Vocabulary::for_dialect(spec::Dialect::RepRapFirmware),
        line_length: 255,
        ..Self::MARLIN
    };

    /// The table of a controller of family `dialect`.
    pub fn new(dialect: spec::Dialect) -> Self {
        match dialect {
            spec::Dialect::Generic => Self::GENERIC,
            spec::Dialect::LinuxCnc => Self::LINUXCNC,
            spec::Dialect::Grbl => Self::GRBL,
            spec::Dialect::GrblHal => Self::GRBLHAL,
            spec::Dialect::FluidNc => Self::FLUIDNC,
            spec::Dialect::Marlin => Self::MARLIN,
            spec::Dialect::Klipper => Self::KLIPPER,
            spec::Dialect::RepRapFirmware => Self::REPRAPFIRMWARE,
        }
    }

    /// The table for `controller`: its dialect, its words, its comments, and its lines if they are shorter.
    pub fn for_controller(controller: &Controller) -> Self {
        let family = Self::new(controller.dialect);
        let dialect = Self {
            line_length: family.line_length.min(controller.line_length),
            vocabulary: Vocabulary::for_controller(controller),
            comments: controller.comments,
            ..family
        };
        match controller.comments {
            Comments::Semicolon => dialect,
            Comments::Parentheses => Self { forbidden: ";!~?", ..dialect },
        }
    }

    /// Duration of a dwell with this P word, s.
    pub fn dwell_seconds(&self, p: f64) -> f64 {
        let seconds = match self.dwell {
            DwellUnit::Seconds => p,
            DwellUnit::Milliseconds => p / 1000.0,
        };
        if self.dwell_step > 0.0 { (seconds / self.dwell_step).ceil() * self.dwell_step } else { seconds }
    }
}

/// Largest difference of the distances from an arc's centre to its two ends, mm.
///
/// Accepted: a difference up to `free`, or one up to both `relative` times the radius and `limit`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ArcTolerance {
    /// Always accepted.
    pub free: f64,
    /// Accepted as a fraction of the radius ...
    pub relative: f64,
    /// ... as long as it is no larger than this.
    pub limit: f64,
}

/// A dialect: all properties of a controller that the interpreter needs. The tables are in the room `dialects`.
#[derive(Clone, Debug, PartialEq)]
pub struct Dialect {
    /// Name of the dialect in machine profiles.
    pub name: &'static str,
    /// Longest line, in bytes without the line end.
    pub line_length: usize,
    /// The words that it understands.
    pub vocabulary: Vocabulary,
    /// The form of comments.
    pub comments: Comments,
    /// Characters that must not occur anywhere, comments included.
    pub forbidden: &'static str,
    /// Whether G0 moves at the feed in force, as G1 does.
    pub travel_at_feed: bool,
    /// Unit of a dwell's P word.
    pub dwell: DwellUnit,
    /// A dwell lasts for a multiple of this, rounded up, s; 0 for exactly the programmed time.
    pub dwell_step: f64,
    /// The limits beyond which an arc is refused.
    pub arcs: ArcTolerance,
}
