//! Reasons for a refused prediction: the found and the allowed value.

use crate::numerics::RootFault;
use geom::readable::Readable;
use std::fmt;

/// Reason for a hinge's state that cannot be computed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum HingeFault {
    /// R* = R/W is not a number from 0 to `most`.
    RStar {
        /// The given value.
        found: f64,
        /// The model's largest R*.
        most: f64,
    },
    /// lambda is not a number in the model's range.
    Coiling {
        /// The given value.
        found: f64,
        /// The model's least lambda.
        least: f64,
        /// The model's largest lambda.
        most: f64,
    },
    /// A ratio of fabric, tube and pressure is outside of the model's range.
    Scale {
        /// Which ratio.
        ratio: HingeRatio,
        /// The given value.
        found: f64,
        /// The model's least.
        least: f64,
        /// The model's largest.
        most: f64,
    },
    /// The model's equations could not be solved.
    Unsolved {
        /// R*.
        r_star: f64,
        /// The coiling factor at which it happened.
        lambda: f64,
        /// Largest residual reached.
        residual: f64,
    },
}

/// A ratio of fabric, tube and pressure on which a hinge depends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum HingeRatio {
    /// Bendability 1/eps.
    Bendability,
    /// Thickness over the tube's width.
    Thickness,
    /// The fabric's Poisson ratio.
    Poisson,
    /// Stretch p W / Y.
    Stretch,
}

impl fmt::Display for HingeRatio {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Bendability => "1/eps = p W^3 / B",
            Self::Thickness => "t/W",
            Self::Poisson => "nu",
            Self::Stretch => "p W / Y",
        })
    }
}

impl fmt::Display for HingeFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (name, value, range): (&dyn fmt::Display, f64, [f64; 2]) = match self {
            Self::RStar { found, most } => (&"R* = R/W", *found, [0.0, *most]),
            Self::Coiling { found, least, most } => (&"the coiling factor", *found, [*least, *most]),
            Self::Scale { ratio, found, least, most } => (ratio, *found, [*least, *most]),
            Self::Unsolved { r_star, lambda, residual } => {
                let (r_star, lambda) = (Readable(*r_star), Readable(*lambda));
                return write!(
                    f,
                    "no section found at R* = {r_star}, lambda = {lambda}: the residual stays at {residual:.1e}"
                );
            }
        };
        let [minimum, maximum] = range.map(Readable);
        write!(f, "{name} is {}, allowed is {minimum} to {maximum}", Readable(value))
    }
}

impl std::error::Error for HingeFault {}

/// Reason for a star's response that cannot be computed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum StarFault {
    /// A property of the fabric or the load is out of range.
    Dimension {
        /// Which: its symbol.
        symbol: &'static str,
        /// The given value, in SI units.
        found: f64,
        /// The allowed values, as text.
        allowed: &'static str,
    },
    /// The inflated star never has this inner radius.
    Radius {
        /// The requested radius, m.
        found: f64,
        /// Inner radius at rest, m.
        least: f64,
        /// Inner radius at its largest, m.
        most: f64,
    },
    /// The model is one of a hinge at a pressure, and there is none.
    NoPressure,
    /// A hinge's model refused.
    Hinge(HingeFault),
    /// No equilibrium or radius in the range of angles searched.
    Root(RootFault),
}

impl fmt::Display for StarFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::Dimension { symbol, found, allowed } => {
                write!(f, "{symbol} is {}, allowed is {allowed}", Readable(found))
            }
            Self::Radius { found, least, most } => {
                let [radius, minimum, maximum] = [found, least, most].map(|m| Readable(1000.0 * m));
                write!(
                    f,
                    "the radius is {radius} mm, but the inflated star reaches only from {minimum} mm to {maximum} mm"
                )
            }
            Self::NoPressure => f.write_str("model section needs a pressure: give one, or use model ring"),
            Self::Hinge(fault) => fault.fmt(f),
            Self::Root(RootFault::NoSignChange { low, high }) => {
                let (low, high) = (Readable(low), Readable(high));
                write!(f, "no solution between the ends of the range, where the values are {low} and {high}")
            }
            Self::Root(RootFault::NotFinite { at }) => write!(f, "not defined at {}", Readable(at)),
        }
    }
}

impl std::error::Error for StarFault {}

impl From<HingeFault> for StarFault {
    fn from(fault: HingeFault) -> Self {
        Self::Hinge(fault)
    }
}

impl From<RootFault> for StarFault {
    fn from(fault: RootFault) -> Self {
        Self::Root(fault)
    }
}
