// GLB: the page's own scene, unpacked and read: meshes, where they stand, and where their corners go when inflated.

"use strict";

/** The bytes of the scene. */
async function sceneBytes() {
  const text = atob(at("scene-data").textContent.trim());
  const packed = Uint8Array.from(text, (character) => character.charCodeAt(0));
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Response(stream).arrayBuffer();
}

/** The numbers of an accessor. */
function accessor(document, buffer, start, index) {
  const { bufferView, componentType, count, type } = document.accessors[index];
  const from = start + document.bufferViews[bufferView].byteOffset;
  const length = count * (type === "VEC3" ? 3 : 1);
  return componentType === 5125 ? new Uint32Array(buffer, from, length) : new Float32Array(buffer, from, length);
}

/** Every part of the scene: the group it is in, its name, its matrix, colour, corners, and where these go. */
function readGlb(buffer) {
  const words = new DataView(buffer);
  const length = words.getUint32(12, true);
  const document = JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, 20, length)));
  const start = 20 + length + 8;
  const read = (index) => (index === undefined ? null : accessor(document, buffer, start, index));
  const out = [];
  for (const root of document.scenes[0].nodes) {
    const group = document.nodes[root];
    for (const child of group.children) {
      const node = document.nodes[child];
      for (const part of document.meshes[node.mesh].primitives) {
        out.push({
          group: group.name,
          name: node.name,
          matrix: matrixOf(node),
          color: document.materials[part.material].pbrMetallicRoughness.baseColorFactor,
          points: read(part.attributes.POSITION),
          moves: part.targets ? read(part.targets[0].POSITION) : null,
          corners: read(part.indices),
        });
      }
    }
  }
  return out;
}

/** Column by column: first turned, then moved. */
function matrixOf({ translation: [x, y, z] = [0, 0, 0], rotation: [a, b, c, w] = [0, 0, 0, 1] }) {
  return [
    1 - 2 * (b * b + c * c), 2 * (a * b + c * w), 2 * (a * c - b * w), 0,
    2 * (a * b - c * w), 1 - 2 * (a * a + c * c), 2 * (b * c + a * w), 0,
    2 * (a * c + b * w), 2 * (b * c - a * w), 1 - 2 * (a * a + b * b), 0,
    x, y, z, 1,
  ];
}

/** The product of two matrices, column by column. */
function times(a, b) {
  const out = new Array(16).fill(0);
  for (let i = 0; i < 16; i += 1) for (let k = 0; k < 4; k += 1) out[i] += a[(i % 4) + 4 * k] * b[4 * Math.floor(i / 4) + k];
  return out;
}

/** The box around the parts, flat and inflated, in metres. */
function boxOf(parts) {
  const low = [Infinity, Infinity, Infinity];
  const high = [-Infinity, -Infinity, -Infinity];
  for (const { points, matrix } of parts) {
    for (let i = 0; i < points.length; i += 3) {
      for (let k = 0; k < 3; k += 1) {
        const value = matrix[k] * points[i] + matrix[4 + k] * points[i + 1] + matrix[8 + k] * points[i + 2] + matrix[12 + k];
        low[k] = Math.min(low[k], value);
        high[k] = Math.max(high[k], value);
      }
    }
  }
  return [low, high];
}
