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
    let elements = &drawing.elements;
    let telling: Vec<Option<&str>> = elements
        .iter()
        .map(|element| if is_dxf { own_layer(element) } else { shared.telling(groups(element)) })
        .collect();
    let colours: BTreeSet<Option<&str>> = elements.iter().map(colour_of).collect();
    let by_colour = colours.len() > 1 && telling.windows(2).all(|pair| pair[0] == pair[1]);
    let is_grouped = telling.iter().any(Option::is_some);
    let group_colours: BTreeSet<&str> = elements
        .iter()
        .zip(&telling)
        .filter(|(_, name)| name.is_some())
        .filter_map(|(e, _)| colour_of(e))
        .collect();
    let names = elements.iter().zip(telling).map(|(element, telling)| {
        let colour = colour_of(element);
        if let Some(name) = colour.filter(|_| by_colour).or(telling) {
            Some(name)
        } else if is_grouped {
            // Names of inner levels come first, so the colour must not be one that grouped elements have.
            let free_colour = colour.filter(|colour| !group_colours.contains(colour));
            shared.name_in_groups(element, free_colour)
        } else {
            shared.name_without_groups(element, colour)
        }
    });
    let layer = |(element, name): (&'a Element, Option<&str>)| {
        let layer_name = name.and_then(|name| element.layers.iter().find(|layer| *layer == name));
        layer_name.or(element.layers.first()).map_or(element.id.as_str(), String::as_str)
    };
    elements.iter().zip(names).map(layer).collect()
}

/// The layer on which an entity of a DXF lies itself.
pub(super) fn own_layer(element: &Element) -> Option<&str> {
    element.layers.get(element.own_names.checked_sub(1)?).map(String::as_str)
}

/// The names of the groups around an element, outermost first.
fn groups(element: &Element) -> impl Iterator<Item = &str> {
    element.layers.iter().skip(element.own_names).rev().map(String::as_str)
}

/// Whether `name` is the word of a role other than to be ignored.
fn has_role(name: &&str) -> bool {
    word_role(name).is_some_and(|role| role != LayerRole::Ignore)
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

    /// The name of an element where no group tells elements apart: an own one with the word of a role comes first.
    fn name_without_groups<'n>(&self, element: &'n Element, colour: Option<&'n str>) -> Option<&'n str> {
        let mut own_names = element.layers[..element.own_names].iter().map(String::as_str);
        let own_word = own_names.find(has_role);
        own_word
            .or_else(|| self.enclosing_names(groups(element)).find(has_role))
            .or_else(|| self.enclosing_names(groups(element)).next())
            .or(colour)
    }

    /// The name of an element outside the groups that tell elements apart: one around everything with the word of a role comes first.
    fn name_in_groups<'n>(&self, element: &'n Element, free_colour: Option<&'n str>) -> Option<&'n str> {
        let mut own_names = element.layers[..element.own_names].iter().map(String::as_str);
        let outer_word = self.enclosing_names(groups(element)).find(has_role);
        outer_word
            .or(free_colour)
            .or_else(|| self.enclosing_names(groups(element)).last())
            .or_else(|| own_names.find(has_role))
    }
}
