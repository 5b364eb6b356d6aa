//! Reads GLB, glTF 2.0 in one binary file: the content of a viewer, in mm with +Z up.
//!
//! Meshes of indexed triangles with one morph target at most, on nodes that are moved and turned, in groups that are not.

use serde::Deserialize;

/// A node with a mesh, where the file puts it.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct GlbNode {
    /// The names of its group and its own, "group/name".
    pub(crate) name: String,
    /// The name of its mesh.
    pub(crate) mesh: String,
    /// The parts of its mesh.
    pub(crate) parts: Vec<GlbPart>,
    /// Whether an animation moves its morph target.
    pub(crate) animated: bool,
}

/// The triangles of one material.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct GlbPart {
    /// The material's name.
    pub(crate) material: String,
    /// Corners, mm.
    pub(crate) points: Vec<[f64; 3]>,
    /// Corners with the morph target in full; empty without one.
    pub(crate) inflated: Vec<[f64; 3]>,
    /// Three corners each.
    pub(crate) triangles: Vec<[usize; 3]>,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct Document {
    asset: Asset,
    scene: usize,
    scenes: Vec<Scene>,
    nodes: Vec<Node>,
    meshes: Vec<Mesh>,
    materials: Vec<Named>,
    accessors: Vec<Accessor>,
    buffer_views: Vec<View>,
    buffers: Vec<Buffer>,
    #[serde(default)]
    animations: Vec<Animation>,
}

#[derive(Deserialize)]
struct Asset {
    version: String,
}

#[derive(Deserialize)]
struct Named {
    name: String,
}

#[derive(Deserialize)]
struct Scene {
    nodes: Vec<usize>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Node {
    name: String,
    mesh: Option<usize>,
    #[serde(default)]
    children: Vec<usize>,
    #[serde(default)]
    translation: [f64; 3],
    #[serde(default = "unturned")]
    rotation: [f64; 4],
}

fn unturned() -> [f64; 4] {
    [0.0, 0.0, 0.0, 1.0]
}

#[derive(Deserialize)]
struct Mesh {
    name: String,
    primitives: Vec<Primitive>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Primitive {
    attributes: Positions,
    indices: usize,
    material: usize,
    #[serde(default)]
    targets: Vec<Positions>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Positions {
    #[serde(rename = "POSITION")]
    position: usize,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase", deny_unknown_fields)]
struct Accessor {
    buffer_view: usize,
    component_type: u32,
    count: usize,
    #[serde(rename = "type")]
    shape: String,
    #[serde(default)]
    min: Vec<f64>,
    #[serde(default)]
    max: Vec<f64>,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct View {
    buffer: usize,
    byte_offset: usize,
    byte_length: usize,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase", deny_unknown_fields)]
struct Buffer {
    byte_length: usize,
}

#[derive(Deserialize)]
struct Animation {
    channels: Vec<Channel>,
    samplers: Vec<Sampler>,
}

#[derive(Deserialize)]
struct Channel {
    sampler: usize,
    target: Target,
}

#[derive(Deserialize)]
struct Target {
    node: usize,
    path: String,
}

#[derive(Deserialize)]
struct Sampler {
    input: usize,
    output: usize,
}

/// The nodes of a GLB's scene that have a mesh, in order.
///
/// # Errors
/// The fault of the file.
pub(crate) fn read_glb(bytes: &[u8]) -> Result<Vec<GlbNode>, String> {
    let (text, numbers) = chunks(bytes).ok_or("no header and two chunks of the lengths that they say")?;
    let document: Document = serde_json::from_slice(text).map_err(|fault| fault.to_string())?;
    let [buffer] = document.buffers.as_slice() else { return Err("other than one buffer".to_owned()) };
    if document.asset.version != "2.0"
        || numbers.len().checked_sub(buffer.byte_length).is_none_or(|rest| rest > 3)
    {
        return Err("another version, or a buffer of another length".to_owned());
    }
    let file = File { document, numbers };
    let mut nodes = Vec::new();
    let scene = file.document.scenes.get(file.document.scene).ok_or("no scene")?;
    for root in &scene.nodes {
        let group = file.node(*root)?;
        if group.mesh.is_some() || group.translation != [0.0; 3] || group.rotation != unturned() {
            return Err(format!("{} is more than a group", group.name));
        }
        for child in &group.children {
            nodes.push(file.placed_node(&group.name, *child)?);
        }
    }
    Ok(nodes)
}

/// The chunks of JSON and of numbers.
fn chunks(bytes: &[u8]) -> Option<(&[u8], &[u8])> {
    let word = |at: usize| Some(u32::from_le_bytes(bytes.get(at..at + 4)?.try_into().ok()?));
    let length = |at: usize| usize::try_from(word(at)?).ok();
    if bytes.get(..4)? != b"glTF" || word(4)? != 2 || length(8)? != bytes.len() {
        return None;
    }
    let first = length(12)?;
    let second_at = first.checked_add(20)?;
    let second = length(second_at)?;
    let kinds = (bytes.get(16..20)?, bytes.get(second_at + 4..second_at + 8)?);
    let length = second_at.checked_add(8)?.checked_add(second)?;
    let right =
        kinds == (&b"JSON"[..], &b"BIN\0"[..]) && length == bytes.len() && first % 4 == 0 && second % 4 == 0;
    right.then(|| (&bytes[20..second_at], &bytes[second_at + 8..]))
}

struct File<'a> {
    document: Document,
    numbers: &'a [u8],
}

impl File<'_> {
    fn node(&self, index: usize) -> Result<&Node, String> {
        self.document.nodes.get(index).ok_or_else(|| format!("no node {index}"))
    }

    /// The node at `index` in the group called `group`, with its mesh where it belongs.
    fn placed_node(&self, group: &str, index: usize) -> Result<GlbNode, String> {
        let node = self.node(index)?;
        let name = format!("{group}/{}", node.name);
        let mesh = node.mesh.and_then(|mesh| self.document.meshes.get(mesh));
        let Some(mesh) = mesh.filter(|_| node.children.is_empty()) else {
            return Err(format!("{name} has no mesh"));
        };
        let mut parts = Vec::new();
        for primitive in &mesh.primitives {
            parts.push(self.part(node, primitive).map_err(|fault| format!("{name}: {fault}"))?);
        }
        Ok(GlbNode { name, mesh: mesh.name.clone(), parts, animated: self.animated(index)? })
    }

    fn part(&self, node: &Node, primitive: &Primitive) -> Result<GlbPart, String> {
        let material = self.document.materials.get(primitive.material).ok_or("no material")?;
        let local = self.vectors(primitive.attributes.position)?;
        let corners = self.indices(primitive.indices)?;
        if corners.is_empty() || corners.len() % 3 != 0 || corners.iter().any(|i| *i >= local.len()) {
            return Err("triangles of other corners than there are".to_owned());
        }
        let placed = |points: &[[f64; 3]]| points.iter().map(|p| z_up(node.placed(*p))).collect();
        let inflated = match primitive.targets.as_slice() {
            [] => Vec::new(),
            [target] => {
                let shifts = self.vectors(target.position)?;
                if shifts.len() != local.len() {
                    return Err("a morph target of another length".to_owned());
                }
                let sum = |(p, d): (&[f64; 3], &[f64; 3])| [p[0] + d[0], p[1] + d[1], p[2] + d[2]];
                placed(&local.iter().zip(&shifts).map(sum).collect::<Vec<_>>())
            }
            _ => return Err("more than one morph target".to_owned()),
        };
        let triangles = corners.chunks_exact(3).map(|t| [t[0], t[1], t[2]]).collect();
        Ok(GlbPart { material: material.name.clone(), points: placed(&local), inflated, triangles })
    }

    /// Whether an animation moves the morph target of the node, from 0 to 1 in rising time.
    fn animated(&self, node: usize) -> Result<bool, String> {
        let mut has_channel = false;
        for animation in &self.document.animations {
            for channel in animation.channels.iter().filter(|channel| channel.target.node == node) {
                let sampler = animation.samplers.get(channel.sampler).ok_or("no sampler")?;
                let (times, weights) = (self.scalars(sampler.input)?, self.scalars(sampler.output)?);
                let rising = times.windows(2).all(|pair| pair[0] < pair[1]) && times.len() == weights.len();
                let is_whole = weights.first() == Some(&0.0) && weights.last() == Some(&1.0);
                if channel.target.path != "weights" || !rising || !is_whole {
                    return Err("an animation that does something else than inflate".to_owned());
                }
                has_channel = true;
            }
        }
        Ok(has_channel)
    }

    /// The bytes of an accessor of these components, 4 bytes each.
    fn raw(
        &self,
        index: usize,
        component: u32,
        shape: &str,
        components: usize,
    ) -> Result<(&Accessor, &[u8]), String> {
        let accessor = self.document.accessors.get(index).ok_or_else(|| format!("no accessor {index}"))?;
        let view = self.document.buffer_views.get(accessor.buffer_view).ok_or("no view")?;
        let length = accessor.count.checked_mul(4 * components);
        let end = view.byte_offset.checked_add(view.byte_length);
        let bytes = end.and_then(|end| self.numbers.get(view.byte_offset..end));
        match bytes {
            Some(bytes)
                if Some(bytes.len()) == length
                    && view.buffer == 0
                    && view.byte_offset % 4 == 0
                    && (accessor.component_type, accessor.shape.as_str()) == (component, shape) =>
            {
                Ok((accessor, bytes))
            }
            _ => Err(format!("accessor {index} does not fit its view, or is of another type")),
        }
    }

    fn indices(&self, index: usize) -> Result<Vec<usize>, String> {
        let (_, bytes) = self.raw(index, 5125, "SCALAR", 1)?;
        let word = |raw: &[u8]| u32::from_le_bytes([raw[0], raw[1], raw[2], raw[3]]);
        bytes
            .chunks_exact(4)
            .map(|raw| usize::try_from(word(raw)).map_err(|_| "an index".to_owned()))
            .collect()
    }

    fn scalars(&self, index: usize) -> Result<Vec<f64>, String> {
        let (accessor, bytes) = self.raw(index, 5126, "SCALAR", 1)?;
        let numbers = floats(bytes);
        bounded(accessor, &numbers, 1)?;
        Ok(numbers)
    }

    fn vectors(&self, index: usize) -> Result<Vec<[f64; 3]>, String> {
        let (accessor, bytes) = self.raw(index, 5126, "VEC3", 3)?;
        let numbers = floats(bytes);
        bounded(accessor, &numbers, 3)?;
        Ok(numbers.chunks_exact(3).map(|v| [v[0], v[1], v[2]]).collect())
    }
}

impl Node {
    /// `p` turned and moved.
    fn placed(&self, p: [f64; 3]) -> [f64; 3] {
        let [x, y, z, w] = self.rotation;
        let cross = |a: [f64; 3], b: [f64; 3]| {
            [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
        };
        let twice = cross([x, y, z], p).map(|v| 2.0 * v);
        let third = cross([x, y, z], twice);
        [0, 1, 2].map(|k| p[k] + w * twice[k] + third[k] + self.translation[k])
    }
}

fn floats(bytes: &[u8]) -> Vec<f64> {
    bytes.chunks_exact(4).map(|raw| f64::from(f32::from_le_bytes([raw[0], raw[1], raw[2], raw[3]]))).collect()
}

/// All numbers are finite, and the accessor's box is theirs.
fn bounded(accessor: &Accessor, numbers: &[f64], components: usize) -> Result<(), String> {
    let bounds_agree = |said: &[f64], pick: fn(f64, f64) -> f64| {
        let ends = (0..components).map(|k| numbers.iter().skip(k).step_by(components).copied().reduce(pick));
        said.len() == components
            && ends.zip(said).all(|(end, said)| end.is_some_and(|end| is_same(end, *said)))
    };
    // The output of an animation need not have limits.
    let silent = components == 1 && accessor.min.is_empty() && accessor.max.is_empty();
    let right = bounds_agree(&accessor.min, f64::min) && bounds_agree(&accessor.max, f64::max);
    if numbers.iter().all(|x| x.is_finite()) && (silent || right) {
        Ok(())
    } else {
        Err("numbers that are not finite, or not in the box that is said".to_owned())
    }
}

/// Whether a number in text is this single precision number; reading text may take the last bit off a double.
fn is_same(number: f64, text: f64) -> bool {
    (number - text).abs() <= 1e-12 * number.abs()
}

/// From metres with +Y up to mm with +Z up.
fn z_up([x, y, z]: [f64; 3]) -> [f64; 3] {
    [1e3 * x, -1e3 * z, 1e3 * y]
}
