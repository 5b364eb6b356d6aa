//! The walk over the entities: layers, inserts, notes.

use geom::Point;

use super::figures::{mirrored, read};
use super::geometry::{EntityShape, Geometry};
use super::group::{EntityRecord, Flaw};
use super::tables::{Block, Sections, TableLayer};
use crate::affine::Affine;
use crate::collector::{Collector, ReadingStop};
use crate::{Place, Weight};

/// Entities that show nothing of their own.
const INVISIBLE: [&str; 4] = ["SEQEND", "VIEWPORT", "ATTDEF", "VERTEX"];
/// Entities that explain a drawing, or help to construct it, and are no edges of it.
const ANNOTATIONS: [&str; 15] = [
    "TEXT",
    "MTEXT",
    "ATTRIB",
    "DIMENSION",
    "ARC_DIMENSION",
    "LARGE_RADIAL_DIMENSION",
    "LEADER",
    "MULTILEADER",
    "MLEADER",
    "TOLERANCE",
    "ACAD_TABLE",
    "HATCH",
    "XLINE",
    "RAY",
    "RTEXT",
];
/// The text of the note on them.
const ANNOTATION: &str = "Texts, dimensions, hatches and construction lines are not read; it is left out.";

/// The context of an entity: the drawing, or an inserted block.
#[derive(Clone)]
struct EntityContext {
    map: Affine,
    /// Ids of the inserts around, each with " > " behind it.
    path: String,
    /// Layers and colours of the inserts around, innermost first.
    layers: Vec<String>,
    /// Number of these up to the layer of the innermost insert, which an entity on layer 0 inherits.
    inherited: usize,
    /// Names of the blocks around, as keys.
    blocks: Vec<String>,
}

/// The state of the walk.
pub(super) struct DxfWalk<'s, 'a, 'g, 'c, 'o> {
    sections: &'s Sections<'a, 'g>,
    out: &'c mut Collector<'o>,
}

impl<'s, 'a, 'g, 'c, 'o> DxfWalk<'s, 'a, 'g, 'c, 'o> {
    pub(super) fn new(sections: &'s Sections<'a, 'g>, collector: &'c mut Collector<'o>) -> Self {
        Self { sections, out: collector }
    }

    /// Reads all entities of the drawing; `map` leads to mm.
    pub(super) fn run(&mut self, map: &Affine) -> Result<(), ReadingStop> {
        let context = EntityContext {
            map: *map,
            path: String::new(),
            layers: Vec::new(),
            inherited: 0,
            blocks: Vec::new(),
        };
        self.entities(&self.sections.entities, &context)
    }

    fn entities(
        &mut self,
        entities: &[EntityRecord<'a, 'g>],
        context: &EntityContext,
    ) -> Result<(), ReadingStop> {
        // A POLYLINE takes the VERTEX records behind it along. Hidden entities are passed over in silence, annotations
        // with one note for all. A flaw becomes a fault or a note with its line, and reading goes on; only a limit
        // ends it.
        let mut index = 0;
        while let Some(record) = entities.get(index) {
            index += 1;
            let parts = match record.kind {
                "POLYLINE" => entities[index..].iter().take_while(|part| part.kind == "VERTEX").count(),
                _ => 0,
            };
            let vertices = &entities[index..index + parts];
            index += parts;
            self.out.visit()?;
            let inner = [record].into_iter().chain(vertices);
            self.out.text(inner.map(|record| 4 * record.groups.len()).sum())?;
            let place = self.place(record, vertices, context)?;
            if self.is_hidden(record, &place) || INVISIBLE.contains(&record.kind) {
                continue;
            }
            let read = match record.kind {
                "INSERT" => self.insert(record, &place, context),
                kind if ANNOTATIONS.contains(&kind) => {
                    self.out.note_alike(Weight::Annotation, place, ANNOTATION);
                    continue;
                }
                _ => self.entity(record, vertices, &place, context),
            };
            match read {
                Ok(()) => {}
                Err(Flaw::At { text, line }) => self.out.fault(
                    Place { line: Some(line), ..place },
                    text,
                    "Export the drawing again, or remove the entity.",
                ),
                Err(Flaw::Lost(text)) => self.out.note(Weight::Lost, place, text),
                Err(Flaw::Limit) => return Err(ReadingStop),
            }
        }
        Ok(())
    }

    /// Id, layers, line and a first point of an entity.
    fn place(
        &mut self,
        record: &EntityRecord<'_, '_>,
        vertices: &[EntityRecord<'_, '_>],
        context: &EntityContext,
    ) -> Result<Place, ReadingStop> {
        let handle = match record.text(5) {
            Some(handle) => format!("{} {handle}", record.kind),
            None => format!("{} at line {}", record.kind, record.line),
        };
        let layer = record.text(8).unwrap_or("0");
        let inherits = layer == "0" && !context.layers.is_empty();
        let mut layers: Vec<String> = colour(record).into_iter().collect();
        if !inherits {
            layers.push(layer.to_owned());
        }
        let own_names = layers.len() + if inherits { context.inherited } else { 0 };
        layers.extend(context.layers.iter().filter(|name| inherits || **name != layer).cloned());
        let id = format!("{}{handle}", context.path);
        self.out.text(id.len() + layers.iter().map(|name| 24 + name.len()).sum::<usize>())?;
        // The first point of a hatch is its height, and a polyline's own is one of its vertices.
        let (located, nth) = match record.kind {
            "HATCH" => (record, 1),
            "POLYLINE" => (vertices.first().unwrap_or(record), 0),
            _ => (record, 0),
        };
        let [x, y] = [10, 20].map(|code| {
            let mut values = located.groups.iter().filter(|group| group.code == code);
            values.nth(nth)?.value.parse::<f64>().ok()
        });
        let point = x.zip(y).map(|(x, y)| context.map.point(Point::new(x, y)));
        let point = point.filter(|point| point.x.is_finite() && point.y.is_finite());
        Ok(Place { element: Some(id), layers, own_names, colour: None, line: Some(record.line), at: point })
    }

    fn layer(&self, name: &str) -> TableLayer {
        self.sections.layers.get(&name.to_lowercase()).copied().unwrap_or_default()
    }

    /// Notes an entity that the drawing does not show: on paper, invisible, or on a layer that is off or frozen.
    fn is_hidden(&mut self, record: &EntityRecord<'_, '_>, place: &Place) -> bool {
        let layer = place.own_names.checked_sub(1).and_then(|last| place.layers.get(last));
        let name = layer.map_or("0", String::as_str);
        let layer = self.layer(name);
        let [is_on_paper, is_invisible] = [67, 60].map(|code| record.flags(code).unwrap_or(0) == 1);
        let reason = if is_on_paper {
            "It is on a paper layout, and is left out.".to_owned()
        } else if is_invisible {
            "It is invisible, and is left out.".to_owned()
        } else if layer.frozen {
            format!("Its layer {name} is frozen; it is left out.")
        } else if layer.off && record.kind != "INSERT" {
            format!("Its layer {name} is off; it is left out.")
        } else {
            return false;
        };
        if !INVISIBLE.contains(&record.kind) {
            self.out.note(Weight::Hidden, place.clone(), reason);
        }
        true
    }

    fn entity(
        &mut self,
        record: &EntityRecord<'a, 'g>,
        parts: &[EntityRecord<'a, 'g>],
        place: &Place,
        context: &EntityContext,
    ) -> Result<(), Flaw> {
        let geometry = read(record, parts)?;
        self.heights(&geometry, place);
        if let Some(remark) = geometry.remark {
            self.out.note(Weight::Information, place.clone(), remark);
        }
        let mirror = if geometry.mirrored { Affine::scale(-1.0, 1.0) } else { Affine::IDENTITY };
        let map = context.map.following(&mirror);
        let place = Place { at: None, ..place.clone() };
        match geometry.shape {
            EntityShape::Point(point) => self.out.point(place, &map, point),
            EntityShape::Chain(chain) => self.out.chain(place, &map, &chain)?,
        }
        Ok(())
    }

    /// Notes an entity that does not lie at z = 0.
    fn heights(&mut self, geometry: &Geometry, place: &Place) {
        let [low, high] = geometry.heights;
        if high - low > 1e-6 {
            let text = format!("It is not flat (z {low} to {high}); it is read as if z were 0.");
            self.out.note(Weight::Changed, place.clone(), text);
        } else if low.abs() > 1e-6 {
            let text = format!("It lies at z = {low}; it is read as if at 0.");
            self.out.note(Weight::Information, place.clone(), text);
        }
    }

    /// Reads the block of an INSERT, once for each row and column.
    fn insert(
        &mut self,
        record: &EntityRecord<'a, 'g>,
        place: &Place,
        context: &EntityContext,
    ) -> Result<(), Flaw> {
        // A block that contains itself, is too deep, or stands in another file is refused. Its entities are read once
        // for each row and column. Each copy has its number in its elements' names.
        let sections = self.sections;
        let name = record.text(2).unwrap_or_default();
        let key = name.to_lowercase();
        let limit = self.out.options.limits.depth;
        let block = match sections.blocks.get(&key) {
            Some(_) if context.blocks.contains(&key) => {
                return Err(record.flaw(format!("The block \"{name}\" contains itself.")));
            }
            Some(_) if context.blocks.len() >= limit => {
                return Err(record.flaw(format!("Blocks are more than {limit} levels deep.")));
            }
            Some(block) => block,
            None => return Err(record.flaw(format!("The block \"{name}\" is not defined."))),
        };
        if block.head.flags(70).is_ok_and(|flags| flags & 4 != 0) {
            return Err(Flaw::Lost(format!("The block \"{name}\" is in another file; it is left out.")));
        }
        let (counts, map) = copies(record, block)?;
        let id = place.element.clone().unwrap_or_default();
        let mut inner =
            EntityContext { layers: place.layers.clone(), inherited: place.own_names, ..context.clone() };
        inner.blocks.push(key);
        for row in 0..counts[1] {
            for column in 0..counts[0] {
                self.out.visit()?;
                let index =
                    if counts == [1, 1] { String::new() } else { format!("[{},{}]", column + 1, row + 1) };
                inner.path = format!("{id}{index} > ");
                inner.map = context.map.following(&map(column, row));
                self.entities(&block.entities, &inner)?;
            }
        }
        Ok(())
    }
}

/// The name of the colour that an entity has of its own: "#rrggbb", or "color 1" by its number; `None` of one with its layer's colour.
fn colour(record: &EntityRecord<'_, '_>) -> Option<String> {
    match record.flags(420) {
        Ok(code) if record.text(420).is_some() => {
            (0..=0xff_ff_ff).contains(&code).then(|| format!("#{code:06x}"))
        }
        _ => {
            let number = record.flags(62).ok().filter(|number| (1..=255).contains(number))?;
            Some(format!("color {number}"))
        }
    }
}

/// The columns and rows of an INSERT.
fn counts(record: &EntityRecord<'_, '_>) -> Result<[u32; 2], Flaw> {
    Ok([count(record, 70)?, count(record, 71)?])
}

/// A number of columns or rows, at least 1.
fn count(record: &EntityRecord<'_, '_>, code: i32) -> Result<u32, Flaw> {
    let count = record.flags(code)?.max(1);
    u32::try_from(count).map_err(|_| record.flaw(format!("Code {code} of INSERT is {count}.")))
}

/// A map for each column and row, from 0.
type Copies = Box<dyn Fn(u32, u32) -> Affine>;

/// The columns and rows of an INSERT, and the maps of its block's entities.
fn copies(record: &EntityRecord<'_, '_>, block: &Block<'_, '_>) -> Result<([u32; 2], Copies), Flaw> {
    let mirror = if mirrored(record)? { Affine::scale(-1.0, 1.0) } else { Affine::IDENTITY };
    let base = [block.head.number_or(10, 0.0)?, block.head.number_or(20, 0.0)?];
    let base = Affine::translate(-base[0], -base[1]);
    let turn = Affine::rotate(record.number_or(50, 0.0)?);
    let scale = Affine::scale(record.number_or(41, 1.0)?, record.number_or(42, 1.0)?);
    let insertion = Affine::translate(record.number(10)?, record.number(20)?);
    let rows_and_columns = counts(record)?;
    let steps = [record.number_or(44, 0.0)?, record.number_or(45, 0.0)?];
    let map = move |column: u32, row: u32| {
        let step = Affine::translate(f64::from(column) * steps[0], f64::from(row) * steps[1]);
        mirror.following(&insertion).following(&turn).following(&step).following(&scale).following(&base)
    };
    Ok((rows_and_columns, Box::new(map)))
}
