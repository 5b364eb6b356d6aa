//! The process of every seam of a drawn piece: by the seam's name, or by the elements, layers or roles that it is drawn by.

use std::collections::BTreeMap;

use crate::{Refusal, RefusalCode};
use artwork::{Artwork, Element, Figure};
use geom::Path;
use sealed::Seam;
use spec::{DEFAULT_PROCESS, DrawingSpec, DrawnPlace, LayerRole, key, nearest};

/// Places of a seam at which the element that it is drawn by is looked for.
const PLACES: u32 = 64;
/// Slack on the distance of a seam from its element, mm: joints and repairs move it.
const SLACK: f64 = 0.05;

/// The processes of the seams of all pieces of a drawing, and the names of the spec that decided one.
pub(super) struct SeamProcesses<'a> {
    drawing: &'a Artwork,
    spec: &'a DrawingSpec,
    half_band: f64,
    /// Whether the name of each entry of the spec has decided a process.
    is_used: Vec<bool>,
}

impl<'a> SeamProcesses<'a> {
    /// The processes of the seams of `drawing`, whose bands are `band` wide.
    pub(super) fn new(drawing: &'a Artwork, spec: &'a DrawingSpec, band: f64) -> Self {
        Self { drawing, spec, half_band: band / 2.0, is_used: vec![false; spec.processes.len()] }
    }

    /// The name of the process of `seam`: that of its own name, else that of its elements.
    ///
    /// # Errors
    /// If its elements have different processes.
    pub(super) fn of_seam(&mut self, seam: &Seam) -> Result<String, Refusal> {
        if self.spec.processes.is_empty() {
            return Ok(DEFAULT_PROCESS.to_owned());
        }
        let by_name = self.spec.processes.iter().position(|(name, _)| *name == seam.name);
        let entries: BTreeMap<Option<usize>, &Element> = match by_name {
            Some(_) => BTreeMap::new(),
            None => self
                .elements_of(seam)
                .into_iter()
                .map(|element| (process_entry(self.spec, element), element))
                .collect(),
        };
        let mut names: Vec<&str> = entries.keys().map(|entry| self.process_name(*entry)).collect();
        names.dedup();
        if names.iter().any(|name| *name != names[0]) {
            return Err(two_processes(
                seam,
                &entries
                    .iter()
                    .map(|(entry, element)| (self.process_name(*entry), *element))
                    .collect::<Vec<_>>(),
            ));
        }
        let deciding: Vec<usize> = by_name.into_iter().chain(entries.into_keys().flatten()).collect();
        for entry in &deciding {
            self.is_used[*entry] = true;
        }
        Ok(self.process_name(deciding.first().copied()).to_owned())
    }

    /// The process of an entry of the spec; the default one without an entry.
    fn process_name(&self, entry: Option<usize>) -> &str {
        entry.map_or(DEFAULT_PROCESS, |entry| &self.spec.processes[entry].1)
    }

    /// The elements along which `seam` is drawn.
    fn elements_of(&self, seam: &Seam) -> Vec<&'a Element> {
        let curves: Vec<(&Element, &Path, bool)> =
            self.drawing.elements.iter().filter_map(|element| self.curve(element)).collect();
        let mut votes = vec![0_u32; curves.len()];
        let (slack, length) = (SLACK + self.spec.join.0, seam.center_line.length());
        for i in 0..PLACES {
            let Some(point) = seam.center_line.point_at(length * (f64::from(i) + 0.5) / f64::from(PLACES))
            else {
                continue;
            };
            // A band lies along a drawn seam, beside an edge of air, or along an edge with air on both sides.
            let miss = |(_, path, is_edge): &(&Element, &Path, bool)| {
                let distance = path.distance(point);
                if *is_edge { distance.min((distance - self.half_band).abs()) } else { distance }
            };
            let misses: Vec<f64> = curves.iter().map(miss).collect();
            let best = (0..misses.len()).min_by(|a, b| misses[*a].total_cmp(&misses[*b]));
            if let Some(best) = best.filter(|best| misses[*best] <= slack) {
                votes[best] += 1;
            }
        }
        // One place alone may lie at the end of a neighbour.
        let most_votes = votes.iter().copied().max().unwrap_or(0);
        curves
            .iter()
            .zip(votes)
            .filter(|(_, votes)| *votes > 0 && (*votes > 1 || most_votes == 1))
            .map(|((element, ..), _)| *element)
            .collect()
    }

    /// The curve of an element that seams are made of, and whether it is an edge of air.
    fn curve(&self, element: &'a Element) -> Option<(&'a Element, &'a Path, bool)> {
        let Figure::Path(path) = &element.figure else { return None };
        match self.spec.role(element.names())? {
            LayerRole::Air => Some((element, path, true)),
            LayerRole::Seam => Some((element, path, false)),
            LayerRole::Port
            | LayerRole::Cut
            | LayerRole::Hole
            | LayerRole::Valve
            | LayerRole::Measure
            | LayerRole::Pull
            | LayerRole::Ignore => None,
        }
    }

    /// The names that decide the process of no seam, given the names of all `seams`.
    pub(super) fn without_seam(&self, seams: &[&str]) -> Vec<Refusal> {
        let unused = self.spec.processes.iter().zip(&self.is_used).filter(|(_, is_used)| !**is_used);
        unused.map(|((name, process), _)| self.unused(name, process, seams)).collect()
    }

    fn unused(&self, name: &str, process: &str, seams: &[&str]) -> Refusal {
        let is_drawn = self.drawing.elements.iter().any(|element| element.names().any(|own| own == name));
        let fault = if is_drawn {
            format!("no seam lies along {name:?}, which process {process} is to seal")
        } else {
            format!("the drawing has nothing called {name:?}, which process {process} is to seal")
        };
        let names = self.drawing.elements.iter().flat_map(Element::names).chain(seams.iter().copied());
        let remedy = match nearest(name, names).filter(|_| !is_drawn) {
            Some(near) => format!("did you mean {near:?}?"),
            None => format!(
                "name a layer or an element with the role air or seam, one of these roles, or a seam: {}",
                seams.join(", ")
            ),
        };
        Refusal::new(key::drawing::PROCESS, RefusalCode::ProcessWithoutSeam, fault, remedy)
    }
}

/// The position of the entry in `spec` that gives `element` a process: that of its innermost name, else of its role.
pub(super) fn process_entry(spec: &DrawingSpec, element: &Element) -> Option<usize> {
    let by_role = || entry_position(spec, spec.role(element.names())?.word());
    element.names().find_map(|name| entry_position(spec, name)).or_else(by_role)
}

/// The position of the entry for `name` in `spec`.
fn entry_position(spec: &DrawingSpec, name: &str) -> Option<usize> {
    spec.processes.iter().position(|(entry, _)| entry == name)
}

/// The refusal of a seam whose elements have different processes.
fn two_processes(seam: &Seam, elements: &[(&str, &Element)]) -> Refusal {
    let elements_in_words: Vec<String> =
        elements.iter().map(|(process, element)| format!("{} ({process})", element.id)).collect();
    let fault = format!(
        "the seam {:?} is drawn by elements of different processes: {}",
        seam.name,
        elements_in_words.join(", ")
    );
    let remedy = format!(
        "a seam has one process: name the seam itself, {:?}, or draw its parts as seams of their own",
        seam.name
    );
    let place = DrawnPlace {
        elements: elements.iter().map(|(_, element)| element.id.clone()).collect(),
        at: seam.center_line.start().map(|start| [start.x, start.y]),
    };
    Refusal::new(key::drawing::PROCESS, RefusalCode::SeamOfTwoProcesses, fault, remedy).drawn_at(place)
}
