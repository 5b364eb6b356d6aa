//! The name by which an element of a drawing is best given a role: that of the level of groups that tells the elements apart.
//!
//! The root of an SVG and a group around everything (an artboard, a frame, a parent layer) tell nothing apart.

use std::collections::{BTreeMap, BTreeSet};

use crate::drawn::words::{colour_of, word_role};
use artwork::{Artwork, Element};
use spec::LayerRole;

/// The name of each element of `drawing`, in the order of the elements.
pub(super) fn layer_names<'a>(drawing: &'a Artwork, is_dxf: bool) -> Vec<&'a str> {
    let shared = Shared::new(drawing);
    let elements = || drawing.elements.iter();
    let telling: Vec<Option<&str>> = elements()
        .map(|element| if is_dxf { own_layer(element) } else { shared.telling(groups(element)) })
        .collect();
    let colours: BTreeSet<Option<&str>> = elements().map(colour_of).collect();
    let by_colour = colours.len() > 1 && telling.windows(2).all(|pair| pair[0] == pair[1]);
    let is_grouped = telling.iter().any(Option::is_some);
    let of_groups: BTreeSet<&str> = elements()
        .zip(&telling)
        .filter(|(_, name)| name.is_some())
        .filter_map(|(e, _)| colour_of(e))
        .collect();
    let is_role = |name: &&str| word_role(name).is_some_and(|role| role != LayerRole::Ignore);
    let name = |element: &'_ Element, telling: Option<&str>| -> Option<usize> {
        let place = |name: &str| element.layers.iter().position(|known| known == name);
        let colour = colour_of(element);
        if let Some(name) = colour.filter(|_| by_colour).or(telling) {
            return place(name);
        }
        let outer_names = || shared.enclosing_names(groups(element));
        let own_names = || element.layers[..element.own_names].iter().map(String::as_str);
        let (own_word, around_word) = (own_names().find(is_role), outer_names().find(is_role));
        let best = if is_grouped {
            // Names of inner levels come first, so the colour must not be one that grouped elements have.
            let free = colour.filter(|colour| !of_groups.contains(colour));
            around_word.or(free).or(outer_names().last()).or(own_word)
        } else {
            own_word.or(around_word).or(outer_names().next()).or(colour)
        };
        best.and_then(place)
    };
    let layer = |(element, telling): (&'a Element, Option<&str>)| {
        let index = name(element, telling).unwrap_or(0);
        element.layers.get(index).map_or(element.id.as_str(), String::as_str)
    };
    elements().zip(telling).map(layer).collect()
}

/// The layer on which an entity of a DXF lies itself.
pub(super) fn own_layer(element: &Element) -> Option<&str> {
    element.layers.get(element.own_names.checked_sub(1)?).map(String::as_str)
}

/// The names of the groups around an element, outermost first.
fn groups(element: &Element) -> impl Iterator<Item = &str> {
    element.layers.iter().skip(element.own_names).rev().map(String::as_str)
}

/// The names of groups that tell nothing apart.
pub(super) struct Shared<'a> {
    root: &'a [String],
    all: BTreeSet<&'a str>,
}

impl<'a> Shared<'a> {
    /// The names that all elements of `drawing` have around them.
    pub(super) fn new(drawing: &'a Artwork) -> Self {
        let mut counts: BTreeMap<&str, usize> = BTreeMap::new();
        for name in drawing.elements.iter().flat_map(groups) {
            *counts.entry(name).or_default() += 1;
        }
        let number = drawing.elements.len();
        let shared_names =
            counts.into_iter().filter(|(_, count)| *count == number).map(|(name, _)| name).collect();
        Self { root: &drawing.root, all: shared_names }
    }

    /// The outermost name that tells elements apart: one with the word of a role, else any.
    pub(super) fn telling<'n>(&self, names: impl Iterator<Item = &'n str>) -> Option<&'n str> {
        let names: Vec<&str> = names.filter(|name| !self.is_shared(name)).collect();
        let word = names.iter().find(|name| word_role(name).is_some());
        word.or(names.first()).copied()
    }

    /// Whether `name` is that of the root or of a group around everything.
    pub(super) fn is_shared(&self, name: &str) -> bool {
        self.root.iter().any(|root| root == name) || self.all.contains(name)
    }

    /// The names that all elements have, without those of the root.
    fn enclosing_names<'n>(&self, names: impl Iterator<Item = &'n str>) -> impl Iterator<Item = &'n str> {
        names.filter(|name| self.all.contains(name) && !self.root.iter().any(|root| root == name))
    }
}
