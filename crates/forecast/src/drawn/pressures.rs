//! Pressures of the chambers of a drawn piece: that of the load, or one of their own by the names of their ports.

use crate::drawn::chambers::DrawnChamber;
use crate::predict::PredictFault;
use design::{DrawnPiece, DrawnPieces};
use geom::Point;
use inflatable::shell::cases::PartialPressure;
use sealed::{PortPlace, Topology};
use serde::Serialize;
use spec::units::{Length, Pressure, Readable};
use spec::{Load, key};

/// The pressure in front of one port.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[allow(non_snake_case, reason = "keys contain units in their usual spelling")]
pub struct PortPressure {
    /// The name of the port in the drawing.
    pub port: String,
    /// Gauge pressure, kPa.
    pub pressure_kPa: f64,
}

/// One chamber between bands, and its pressure.
struct Airspace {
    /// A point in it, mm.
    inside: Point,
    /// The middles of its ports' mouths, mm.
    mouths: Vec<Point>,
    pressure: Pressure,
    /// The port whose name gave the pressure.
    port: Option<String>,
}

/// The pressure of one region of connected sheets, and the parts of it between walls that have less.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct RegionPressure {
    /// The highest pressure in it.
    pub(super) highest: Pressure,
    /// Chambers in it with a lower one.
    pub(super) partial: Vec<PartialPressure>,
}

/// The pressure of each of `regions` under `load`, where `pressure` is that of chambers without one of their own.
///
/// Each name of `[load.chambers]` is that of a port, and the port leads into one chamber between bands. A region has the highest pressure of
/// the chambers in it; the others are parts of it.
///
/// # Errors
/// If no port has a name of the load, two ports of a chamber have different pressures, or a whole region has none.
pub(super) fn region_pressures(
    load: &Load,
    pressure: Pressure,
    pieces: &DrawnPieces,
    regions: &[DrawnChamber],
) -> Result<Vec<RegionPressure>, PredictFault> {
    if load.chambers.is_empty() {
        return Ok(vec![RegionPressure { highest: pressure, partial: Vec::new() }; regions.len()]);
    }
    let mut airspaces = all_airspaces(pieces, pressure);
    for (name, pressure) in &load.chambers {
        set_pressure(&mut airspaces, pieces, name, *pressure)?;
    }
    regions.iter().map(|region| region_pressure(region, pressure, &airspaces)).collect()
}

/// The pressures that `load` gives by port, for the answer.
pub(super) fn port_pressures(load: &Load) -> Option<Vec<PortPressure>> {
    let pressures = load.chambers.iter();
    let rows =
        pressures.map(|(port, pressure)| PortPressure { port: port.clone(), pressure_kPa: pressure.0 });
    (!load.chambers.is_empty()).then(|| rows.collect())
}

/// The chambers of all pieces, each at `pressure`.
fn all_airspaces(pieces: &DrawnPieces, pressure: Pressure) -> Vec<Airspace> {
    let of_piece = |piece: &DrawnPiece| {
        let Topology { chambers, insides, .. } = piece.shape.topology();
        let airspaces = chambers.into_iter().zip(insides).map(|(chamber, inside)| Airspace {
            inside,
            mouths: chamber.ports.iter().map(|port| piece.shape.ports[*port].at).collect(),
            pressure,
            port: None,
        });
        airspaces.collect::<Vec<_>>()
    };
    pieces.pieces.iter().flat_map(of_piece).collect()
}

/// Gives the chamber behind port `name` its `pressure`: that with the mouth which is nearest to the port.
fn set_pressure(
    airspaces: &mut [Airspace],
    pieces: &DrawnPieces,
    name: &str,
    pressure: Pressure,
) -> Result<(), PredictFault> {
    let place = place_of_port(pieces, name)?;
    let by_distance = |a: &&mut Airspace, b: &&mut Airspace| a.distance(place).total_cmp(&b.distance(place));
    let Some(airspace) = airspaces.iter_mut().min_by(by_distance) else { return Ok(()) };
    if let Some(port) = airspace.port.as_ref().filter(|_| airspace.pressure != pressure) {
        let problem = format!(
            "ports {port:?} and {name:?} lead into one chamber, at {} and {} kPa",
            Readable(airspace.pressure.0),
            Readable(pressure.0)
        );
        return Err(refused(problem, "give one pressure for a chamber"));
    }
    (airspace.pressure, airspace.port) = (pressure, Some(name.to_owned()));
    Ok(())
}

impl Airspace {
    /// Distance from `place` to its nearest mouth, mm; infinite without one.
    fn distance(&self, place: Point) -> f64 {
        self.mouths.iter().map(|mouth| mouth.distance(place)).fold(f64::INFINITY, f64::min)
    }
}

/// The place of port `name` in the drawing.
fn place_of_port(pieces: &DrawnPieces, name: &str) -> Result<Point, PredictFault> {
    let Some(drawn_port) = pieces.ports.iter().find(|port| port.name == name) else {
        let names: Vec<&str> = pieces.ports.iter().map(|port| port.name.as_str()).collect();
        let remedy = match spec::nearest(name, names.iter().copied()) {
            Some(similar) => format!("did you mean {similar:?}?"),
            None => format!("ports are {}", names.join(", ")),
        };
        return Err(refused(format!("no port is called {name:?}"), &remedy));
    };
    Ok(match drawn_port.place {
        PortPlace::At(point) => point,
        PortPlace::Across([start, end]) => start.midpoint(end),
    })
}

/// The pressure of `region`; that of the load where no chamber of known place lies in it.
fn region_pressure(
    region: &DrawnChamber,
    pressure: Pressure,
    airspaces: &[Airspace],
) -> Result<RegionPressure, PredictFault> {
    let chambers: Vec<&Airspace> =
        airspaces.iter().filter(|airspace| region.flat.has_air(airspace.inside)).collect();
    let highest = chambers.iter().map(|chamber| chamber.pressure.0).reduce(f64::max).unwrap_or(pressure.0);
    if highest <= 0.0 {
        let bounds = region.flat.outline.bounds();
        let problem = format!(
            "no pressure in the chamber around X {:.1} Y {:.1} mm, which shares no band with another",
            bounds.center().x,
            bounds.center().y
        );
        return Err(refused(problem, "give it a pressure above 0, or leave it out of the drawing"));
    }
    let lower = chambers.iter().filter(|chamber| chamber.pressure.0 < highest);
    let partial = lower.map(|chamber| PartialPressure {
        at: [chamber.inside.x, chamber.inside.y].map(|x| Length(x).metres()),
        part: chamber.pressure.0 / highest,
    });
    Ok(RegionPressure { highest: Pressure(highest), partial: partial.collect() })
}

fn refused(problem: String, remedy: &str) -> PredictFault {
    PredictFault::new(key::load::CHAMBERS, problem).with_remedy(remedy)
}
