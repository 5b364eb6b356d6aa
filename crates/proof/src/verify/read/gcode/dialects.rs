//! The dialects, and their tables, each from its controller's documentation and source.

use spec::{Comments, Controller, DwellUnit, Vocabulary};

/// The strictest of GRBL (0.005 mm, or 0.1 % up to 0.5 mm) and LinuxCNC (about 0.028 mm).
const STRICTEST: ArcTolerance = ArcTolerance { free: 0.005, relative: 0.001, limit: 0.028 };
/// GRBL's: 0.005 mm, or 0.1 % up to 0.5 mm (gcode.c).
const GRBL: ArcTolerance = ArcTolerance { free: 0.005, relative: 0.001, limit: 0.5 };

/// A row of the table: how a dialect reads lines, time and arcs. Every dialect writes every column.
struct ReadingRules {
    line_length: usize,
    forbidden: &'static str,
    travel_at_feed: bool,
    dwell: DwellUnit,
    dwell_step: f64,
    arcs: ArcTolerance,
}

/// The rules of a mill: its longest line, the step to which it rounds dwells up, s, and the arcs that it takes.
const fn mill(line_length: usize, dwell_step: f64, arcs: ArcTolerance) -> ReadingRules {
    let dwell = DwellUnit::Seconds;
    ReadingRules { line_length, forbidden: "()!~?", travel_at_feed: false, dwell, dwell_step, arcs }
}

/// The rules of a printer: its longest line. G4 P is in ms, G0 moves as G1.
const fn printer(line_length: usize) -> ReadingRules {
    let dwell = DwellUnit::Milliseconds;
    ReadingRules {
        line_length,
        forbidden: "()!~?*",
        travel_at_feed: true,
        dwell,
        dwell_step: 0.0,
        arcs: STRICTEST,
    }
}

/// The rules of `dialect`.
///
/// Generic: the plain subset that every controller reads alike, with capital letters, `;` comments, arcs by I and J. Parentheses are
/// refused (some controllers end a comment at the first `)`), and so are `!`, `~` and `?`, which GRBL obeys even inside comments. The
/// line length is GRBL's 80 with a reserve. G0 is read as G1, at the feed in force, as three of the controllers do.
///
/// LinuxCNC: lines up to 255. GRBL 1.1: lines up to 80 (protocol.h), arcs by gcode.c, dwells in steps of 50 ms (nuts_bolts.c).
/// grblHAL: as GRBL, lines up to 256 (protocol.h). FluidNC: as GRBL, lines up to 255 (Protocol.h), dwells in whole milliseconds
/// (NutsBolts.cpp). Marlin without its options, Klipper without `[gcode_arcs]`, RepRapFirmware 3; Marlin's lines up to 95
/// (`MAX_CMD_SIZE`). Bambu as Marlin.
const fn rules(dialect: spec::Dialect) -> ReadingRules {
    match dialect {
        spec::Dialect::Generic => ReadingRules {
            line_length: 72,
            forbidden: "()!~?",
            travel_at_feed: true,
            dwell: DwellUnit::Seconds,
            dwell_step: 0.0,
            arcs: STRICTEST,
        },
        spec::Dialect::LinuxCnc => mill(255, 0.0, STRICTEST),
        spec::Dialect::Grbl => mill(80, 0.05, GRBL),
        spec::Dialect::GrblHal => mill(256, 0.05, GRBL),
        spec::Dialect::FluidNc => mill(255, 0.0, GRBL),
        spec::Dialect::Marlin | spec::Dialect::Bambu => printer(95),
        spec::Dialect::Klipper | spec::Dialect::RepRapFirmware => printer(255),
    }
}

impl Dialect {
    /// The plain subset that every controller reads alike.
    pub const GENERIC: Self = Self::new(spec::Dialect::Generic);

    /// The table of a controller of family `dialect`: its words from the vocabulary, its rules, comments from `;` to the line end.
    pub const fn new(dialect: spec::Dialect) -> Self {
        let ReadingRules { line_length, forbidden, travel_at_feed, dwell, dwell_step, arcs } = rules(dialect);
        Self {
            name: dialect.name(),
            line_length,
            vocabulary: Vocabulary::for_dialect(dialect),
            comments: Comments::Semicolon,
            forbidden,
            travel_at_feed,
            dwell,
            dwell_step,
            arcs,
            shift: [0.0; 3],
        }
    }

    /// The table for `controller`: its dialect, its words, its comments, and its lines if they are shorter.
    pub fn for_controller(controller: &Controller) -> Self {
        let family = Self::new(controller.dialect);
        let dialect = Self {
            line_length: family.line_length.min(controller.line_length),
            vocabulary: Vocabulary::for_controller(controller),
            comments: controller.comments,
            shift: controller.place.shift(),
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
    /// The place of the sheet's lower left corner, on the release layer, in the numbers of programs, mm. Positions are read in the
    /// sheet's frame.
    pub shift: [f64; 3],
}
