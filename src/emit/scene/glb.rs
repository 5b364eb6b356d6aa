//! GLB: glTF 2.0 in one binary file, a chunk of JSON and a chunk of numbers.
//!
//! Positions are written in metres with +Y up, as glTF demands: a point (x, y, z) in mm becomes (x, z, -y) / 1000. They are
//! rounded to a thousandth of a millimetre, so the bytes do not hang on the last bits of a sine.

use serde_json::{Value, json};

use crate::emit::palette::{SURFACES, SceneSurface, linear};
use crate::emit::scene::mesh::Mesh;
use program::number::{Decimals, single};

/// Decimals of a coordinate in mm, and of a node's rotation.
const DECIMALS: [u32; 2] = [3, 9];
/// The times, s, at which the animation begins, is at full pressure, and ends.
const TIMES: [f32; 3] = [0.0, 2.0, 3.0];
/// Share of the inflation at these times.
const WEIGHTS: [f32; 3] = [0.0, 1.0, 1.0];

// glTF's own numbers: types of components, and purposes of a view.
const UNSIGNED_INT: u32 = 5125;
const FLOAT: u32 = 5126;
const VERTICES: u32 = 34962;
const INDICES: u32 = 34963;

/// A node that shows a mesh.
pub(super) struct Node {
    pub(super) name: String,
    /// Index of the mesh.
    pub(super) mesh: usize,
    /// The place of its origin, mm.
    pub(super) at: [f64; 3],
    /// Rotation about +Z, rad.
    pub(super) turn: f64,
}

/// The content of one file.
#[derive(Default)]
pub(super) struct Glb {
    /// The surfaces that its meshes may have.
    surfaces: Vec<SceneSurface>,
    numbers: Vec<u8>,
    views: Vec<Value>,
    accessors: Vec<Value>,
    meshes: Vec<Value>,
}

impl Glb {
    /// The content of a file whose meshes have these surfaces; empty.
    pub(super) fn new(surfaces: &[SceneSurface]) -> Self {
        Self { surfaces: surfaces.to_vec(), ..Self::default() }
    }

    /// Adds a mesh of parts, each with its surface; all of them move, or none. Its number.
    pub(super) fn mesh(&mut self, name: &str, parts: &[(SceneSurface, Mesh)]) -> usize {
        let primitives: Vec<Value> =
            parts.iter().map(|(surface, mesh)| self.primitive(*surface, mesh)).collect();
        let mut value = json!({ "name": name, "primitives": primitives });
        if parts.iter().any(|(_, mesh)| !mesh.inflated.is_empty()) {
            value["weights"] = json!([0.0]);
            value["extras"] = json!({ "targetNames": ["inflated"] });
        }
        self.meshes.push(value);
        self.meshes.len() - 1
    }

    /// Adds a mesh again by another name, with shared numbers; returns its index. Viewers find the target of an animation by the name
    /// of its mesh.
    pub(super) fn copy_mesh(&mut self, mesh: usize, name: &str) -> usize {
        let mut copy = self.meshes[mesh].clone();
        copy["name"] = name.into();
        self.meshes.push(copy);
        self.meshes.len() - 1
    }

    /// The file of the nodes in these groups, each with its name, and of the first `surface_count` surfaces.
    pub(super) fn finish(
        mut self,
        name: &str,
        groups: &[(&str, Vec<Node>)],
        surface_count: usize,
    ) -> Vec<u8> {
        // glTF refers to everything by index, so the nodes of all groups get their numbers before the groups that hold
        // them. Nodes whose mesh has a closed shape are animated together.
        let nodes: Vec<&Node> = groups.iter().flat_map(|(_, nodes)| nodes).collect();
        let moving: Vec<usize> =
            (0..nodes.len()).filter(|i| self.meshes[nodes[*i].mesh].get("weights").is_some()).collect();
        let mut node_values: Vec<Value> = nodes.into_iter().map(node).collect();
        let mut first = 0;
        let mut roots = Vec::new();
        for (group, nodes) in groups {
            let children: Vec<usize> = (first..first + nodes.len()).collect();
            first += nodes.len();
            if !children.is_empty() {
                roots.push(node_values.len());
                node_values.push(json!({ "name": group, "children": children }));
            }
        }
        let mut document = json!({
            "asset": { "version": "2.0", "generator": env!("CARGO_PKG_NAME") },
            "scene": 0,
            "scenes": [{ "name": name, "nodes": roots }],
            "nodes": node_values,
            "meshes": self.meshes,
            "materials": self.surfaces[..surface_count].iter().copied().map(material).collect::<Vec<_>>(),
        });
        if !moving.is_empty() {
            document["animations"] = json!([self.animation(&moving)]);
        }
        document["accessors"] = self.accessors.into();
        document["bufferViews"] = self.views.into();
        document["buffers"] = json!([{ "byteLength": self.numbers.len() }]);
        container(document.to_string().into_bytes(), self.numbers)
    }

    fn primitive(&mut self, surface: SceneSurface, mesh: &Mesh) -> Value {
        let material = self.surfaces.iter().position(|own| *own == surface);
        let positions: Vec<[f64; 3]> = mesh.points.iter().map(|p| rounded(*p)).collect();
        let indices: Vec<u8> = mesh.triangles.iter().flatten().flat_map(|i| i.to_le_bytes()).collect();
        let indices = self.accessor(
            &indices,
            INDICES,
            json!({
                "componentType": UNSIGNED_INT, "count": 3 * mesh.triangles.len(), "type": "SCALAR",
            }),
        );
        let mut value = json!({
            "attributes": { "POSITION": self.vectors(&positions) }, "indices": indices, "material": material,
        });
        if !mesh.inflated.is_empty() {
            let shift = |(from, to): (&[f64; 3], &[f64; 3])| {
                let to = rounded(*to);
                [to[0] - from[0], to[1] - from[1], to[2] - from[2]]
            };
            let shifts: Vec<[f64; 3]> = positions.iter().zip(&mesh.inflated).map(shift).collect();
            value["targets"] = json!([{ "POSITION": self.vectors(&shifts) }]);
        }
        value
    }

    /// Vectors in mm, +Z up, with their box.
    fn vectors(&mut self, vectors: &[[f64; 3]]) -> usize {
        let vectors: Vec<[f32; 3]> = vectors.iter().map(|v| y_up(*v).map(single)).collect();
        let [minimum, maximum] = [f32::min, f32::max].map(|pick: fn(f32, f32) -> f32| {
            let extreme = vectors.iter().copied().reduce(|a, b| [0, 1, 2].map(|k| pick(a[k], b[k])));
            extreme.unwrap_or_default().map(f64::from)
        });
        let description = json!({
            "componentType": FLOAT, "count": vectors.len(), "type": "VEC3", "min": minimum, "max": maximum,
        });
        let bytes: Vec<u8> = vectors.iter().flatten().flat_map(|x| x.to_le_bytes()).collect();
        self.accessor(&bytes, VERTICES, description)
    }

    /// All nodes that move do so at once.
    fn animation(&mut self, nodes: &[usize]) -> Value {
        let [input, output] = [&TIMES[..], &WEIGHTS[..]].map(|values: &[f32]| {
            let bytes: Vec<u8> = values.iter().flat_map(|x| x.to_le_bytes()).collect();
            let ends = [values.first(), values.last()].map(|x| [f64::from(x.copied().unwrap_or_default())]);
            self.accessor(&bytes, 0, json!({
                "componentType": FLOAT, "count": values.len(), "type": "SCALAR", "min": ends[0], "max": ends[1],
            }))
        });
        let sampler = json!({ "input": input, "output": output, "interpolation": "LINEAR" });
        let channel = |node: &usize| json!({ "sampler": 0, "target": { "node": node, "path": "weights" } });
        json!({ "name": "inflate", "samplers": [sampler], "channels": nodes.iter().map(channel).collect::<Vec<_>>() })
    }

    /// Adds numbers of a given type, all of 4 bytes; 0 for a view of no special use.
    fn accessor(&mut self, bytes: &[u8], target: u32, mut description: Value) -> usize {
        let mut view = json!({ "buffer": 0, "byteOffset": self.numbers.len(), "byteLength": bytes.len() });
        if target != 0 {
            view["target"] = target.into();
        }
        self.numbers.extend(bytes);
        self.views.push(view);
        description["bufferView"] = (self.views.len() - 1).into();
        self.accessors.push(description);
        self.accessors.len() - 1
    }
}

fn material(surface: SceneSurface) -> Value {
    let (_, name, color, cover) = SURFACES[surface as usize];
    let [red, green, blue] = linear(color);
    json!({
        "name": name,
        "alphaMode": if cover < 1.0 { "BLEND" } else { "OPAQUE" },
        "doubleSided": true,
        "pbrMetallicRoughness": {
            "baseColorFactor": [red, green, blue, cover], "metallicFactor": 0.0, "roughnessFactor": 0.9,
        },
    })
}

fn node(node: &Node) -> Value {
    let mut value = json!({ "name": node.name, "mesh": node.mesh });
    let translation = y_up(rounded(node.at));
    if translation != [0.0; 3] {
        value["translation"] = json!(translation);
    }
    if node.turn != 0.0 {
        let (sin, cos) = libm::sincos(node.turn / 2.0);
        let [sin, cos] = [sin, cos].map(|number| Decimals::exactly(DECIMALS[1]).round(number));
        value["rotation"] = json!([0.0, sin, 0.0, cos]);
    }
    value
}

fn rounded(point: [f64; 3]) -> [f64; 3] {
    point.map(|x| Decimals::exactly(DECIMALS[0]).round(x))
}

/// From mm with +Z up to metres with +Y up; no -0.
fn y_up([x, y, z]: [f64; 3]) -> [f64; 3] {
    [x, z, -y].map(|x| x / 1000.0 + 0.0)
}

/// Header and chunks, each filled up to whole fours: JSON with blanks, numbers with zeros.
fn container(mut text: Vec<u8>, mut numbers: Vec<u8>) -> Vec<u8> {
    text.resize(text.len().next_multiple_of(4), b' ');
    numbers.resize(numbers.len().next_multiple_of(4), 0);
    let total_length = length(&text).saturating_add(length(&numbers)).saturating_add(28);
    let head = [u32::from_le_bytes(*b"glTF"), 2, total_length];
    let mut container: Vec<u8> = head.iter().flat_map(|x| x.to_le_bytes()).collect();
    for (name, bytes) in [(b"JSON", text), (b"BIN\0", numbers)] {
        container.extend(length(&bytes).to_le_bytes());
        container.extend(name);
        container.extend(bytes);
    }
    container
}

fn length(bytes: &[u8]) -> u32 {
    u32::try_from(bytes.len()).unwrap_or(u32::MAX)
}
