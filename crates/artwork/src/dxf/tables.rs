//! Sections of the file: header, layers, blocks, entities.

use std::collections::BTreeMap;

use super::group::{CodeGroup, EntityRecord, records};

/// A block: the entities that an INSERT repeats.
#[derive(Debug)]
pub(super) struct Block<'a, 'g> {
    /// The BLOCK record, which has the base point and the flags.
    pub(super) head: EntityRecord<'a, 'g>,
    /// Entities of the block.
    pub(super) entities: Vec<EntityRecord<'a, 'g>>,
}

/// Visibility of a layer.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct TableLayer {
    /// Switched off: the layer's colour is negative.
    pub(super) off: bool,
    /// Frozen: inserts on it show nothing either.
    pub(super) frozen: bool,
}

/// The parts of a file that are read. Names of layers and blocks have no case, so keys are in lower case.
#[derive(Debug, Default)]
pub(super) struct Sections<'a, 'g> {
    /// $INSUNITS, as written.
    pub(super) units: Option<&'a str>,
    pub(super) layers: BTreeMap<String, TableLayer>,
    pub(super) blocks: BTreeMap<String, Block<'a, 'g>>,
    pub(super) entities: Vec<EntityRecord<'a, 'g>>,
    /// Whether there is a section ENTITIES.
    pub(super) has_entities: bool,
}

/// Finds the sections of a file.
pub(super) fn sections<'a, 'g>(groups: &'g [CodeGroup<'a>]) -> Sections<'a, 'g> {
    let mut sections = Sections::default();
    let mut index = 0;
    while index + 1 < groups.len() {
        let (start, name) = (&groups[index], &groups[index + 1]);
        if start.code != 0 || start.value != "SECTION" || name.code != 2 {
            index += 1;
            continue;
        }
        let from = index + 2;
        let length = groups[from..].iter().position(|group| group.code == 0 && group.value == "ENDSEC");
        let to = length.map_or(groups.len(), |length| from + length);
        let body = &groups[from..to];
        match name.value {
            "HEADER" => sections.units = header(body, "$INSUNITS"),
            "TABLES" => sections.layers = layers(&records(body, from)),
            "BLOCKS" => sections.blocks = blocks(records(body, from)),
            "ENTITIES" => {
                sections.has_entities = true;
                sections.entities = records(body, from);
                sections.entities.retain(|record| record.kind != "EOF");
            }
            _ => {}
        }
        index = to;
    }
    sections
}

/// The value of a header variable.
fn header<'a>(groups: &[CodeGroup<'a>], name: &str) -> Option<&'a str> {
    let place = groups.iter().position(|group| group.code == 9 && group.value == name)?;
    groups.get(place + 1).map(|group| group.value)
}

fn layers(records: &[EntityRecord<'_, '_>]) -> BTreeMap<String, TableLayer> {
    let layer = |record: &&EntityRecord<'_, '_>| record.kind == "LAYER";
    let read = |record: &EntityRecord<'_, '_>| {
        let [colour, flags] =
            [62, 70].map(|code| record.text(code).and_then(|value| value.parse::<i64>().ok()).unwrap_or(0));
        let name = record.text(2).unwrap_or_default().to_lowercase();
        (name, TableLayer { off: colour < 0, frozen: flags & 1 != 0 })
    };
    records.iter().filter(layer).map(read).collect()
}

fn blocks<'a, 'g>(records: Vec<EntityRecord<'a, 'g>>) -> BTreeMap<String, Block<'a, 'g>> {
    let mut blocks = BTreeMap::new();
    let mut open: Option<Block<'a, 'g>> = None;
    for record in records {
        match (record.kind, open.as_mut()) {
            ("BLOCK", _) => open = Some(Block { head: record, entities: Vec::new() }),
            ("ENDBLK", _) => {
                if let Some(block) = open.take() {
                    let name = block.head.text(2).unwrap_or_default().to_lowercase();
                    drop(blocks.insert(name, block));
                }
            }
            (_, Some(block)) => block.entities.push(record),
            (_, None) => {}
        }
    }
    blocks
}
