// The scene in three dimensions, by WebGL 2: turned by pointer or keys, inflated by a slider.

"use strict";

const VERTEX = `#version 300 es
in vec3 point;
in vec3 way;
uniform mat4 view;
uniform mat4 stand;
uniform float inflated;
out vec3 place;
void main() {
  vec4 world = stand * vec4(point + inflated * way, 1.0);
  place = world.xyz;
  gl_Position = view * world;
}`;

// A face's own normal, from how its place changes beside the pixel: the scene has none, and a moving mesh would need new ones.
const FRAGMENT = `#version 300 es
precision highp float;
in vec3 place;
uniform vec4 color;
uniform vec3 eye;
out vec4 seen;
void main() {
  vec3 normal = normalize(cross(dFdx(place), dFdy(place)));
  vec3 to_eye = normalize(eye - place);
  if (dot(normal, to_eye) < 0.0) normal = -normal;
  float sun = max(dot(normal, normalize(vec3(0.45, 0.8, 0.35))), 0.0);
  float sky = 0.5 + 0.5 * normal.y;
  vec3 light = color.rgb * (0.34 + 0.5 * sun + 0.26 * sky);
  vec3 shown = pow(clamp(light, 0.0, 1.0), vec3(1.0 / 2.2));
  seen = vec4(shown * color.a, color.a);
}`;

const GROUPS = [["stack", "Stack"], ["pieces", "Piece"], ["measures", "Measures"], ["object", "Object"], ["sheets", "Sheets"], ["masks", "Masks"]];
const HOME = { yaw: 0.6, pitch: 0.55, near: 1 };
const solid = { ...HOME, inflated: 0, groups: new Set(["stack", "object", "pieces", "measures"]), parts: [], drawn: 0 };

function program(gl) {
  const made = gl.createProgram();
  for (const [kind, text] of [[gl.VERTEX_SHADER, VERTEX], [gl.FRAGMENT_SHADER, FRAGMENT]]) {
    const shader = gl.createShader(kind);
    gl.shaderSource(shader, text);
    gl.compileShader(shader);
    gl.attachShader(made, shader);
  }
  gl.bindAttribLocation(made, 0, "point");
  gl.bindAttribLocation(made, 1, "way");
  gl.linkProgram(made);
  if (!gl.getProgramParameter(made, gl.LINK_STATUS)) throw new Error("the browser cannot compile the shaders");
  return made;
}

/** The part with its numbers on the graphics card. */
function loaded(gl, part) {
  const array = gl.createVertexArray();
  gl.bindVertexArray(array);
  [part.points, part.moves].forEach((numbers, place) => {
    if (!numbers) return;
    gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer());
    gl.bufferData(gl.ARRAY_BUFFER, numbers, gl.STATIC_DRAW);
    gl.enableVertexAttribArray(place);
    gl.vertexAttribPointer(place, 3, gl.FLOAT, false, 0, 0);
  });
  gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, gl.createBuffer());
  gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, part.corners, gl.STATIC_DRAW);
  gl.bindVertexArray(null);
  return { ...part, array };
}

/** Where the eye is, and the matrix from the world to the screen. */
function camera(parts, ratio) {
  const [low, high] = boxOf(parts.length > 0 ? parts : solid.parts);
  const middle = low.map((value, k) => (value + high[k]) / 2);
  const radius = Math.hypot(...low.map((value, k) => high[k] - value)) / 2;
  const field = 0.62;
  // Whatever the shape of the window, the whole of it is in sight.
  const away = (radius / Math.sin(field / 2)) * Math.max(1, 0.95 / ratio) * 0.8 * solid.near;
  const { yaw, pitch } = solid;
  const back = [Math.cos(pitch) * Math.sin(yaw), Math.sin(pitch), Math.cos(pitch) * Math.cos(yaw)];
  const right = [Math.cos(yaw), 0, -Math.sin(yaw)];
  const up = [-Math.sin(pitch) * Math.sin(yaw), Math.cos(pitch), -Math.sin(pitch) * Math.cos(yaw)];
  const eye = middle.map((value, k) => value + back[k] * away);
  const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  const turn = [
    right[0], up[0], back[0], 0, right[1], up[1], back[1], 0, right[2], up[2], back[2], 0,
    -dot(right, eye), -dot(up, eye), -dot(back, eye), 1,
  ];
  const [near, far] = [Math.max(away - 1.5 * radius, 0.02 * radius), away + 1.5 * radius];
  const f = 1 / Math.tan(field / 2);
  const lens = [f / ratio, 0, 0, 0, 0, f, 0, 0, 0, 0, (far + near) / (near - far), -1, 0, 0, (2 * far * near) / (near - far), 0];
  return { eye, view: times(lens, turn) };
}

function paint() {
  const { gl, use } = solid;
  if (!gl) return;
  const canvas = gl.canvas;
  const scale = Math.min(2, window.devicePixelRatio || 1);
  const [width, height] = [canvas.clientWidth, canvas.clientHeight].map((side) => Math.max(1, Math.round(side * scale)));
  if (canvas.width !== width || canvas.height !== height) [canvas.width, canvas.height] = [width, height];
  gl.viewport(0, 0, width, height);
  gl.clearColor(0, 0, 0, 0);
  gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
  gl.enable(gl.DEPTH_TEST);
  gl.enable(gl.BLEND);
  gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
  const parts = solid.parts.filter((part) => solid.groups.has(part.group));
  const { eye, view } = camera(parts, width / height);
  gl.useProgram(use.made);
  gl.uniformMatrix4fv(use.view, false, view);
  gl.uniform3fv(use.eye, eye);
  gl.uniform1f(use.inflated, solid.inflated);
  // What shines through comes last, and hides nothing of itself.
  const ordered = [...parts.filter((part) => part.color[3] === 1), ...parts.filter((part) => part.color[3] < 1)];
  for (const part of ordered) {
    gl.depthMask(part.color[3] === 1);
    gl.uniformMatrix4fv(use.stand, false, part.matrix);
    const [red, green, blue, cover] = part.color;
    gl.uniform4f(use.color, red, green, blue, cover < 1 ? 0.6 * cover : 1);
    gl.bindVertexArray(part.array);
    if (!part.moves) gl.vertexAttrib3f(1, 0, 0, 0);
    gl.drawElements(gl.TRIANGLES, part.corners.length, gl.UNSIGNED_INT, 0);
  }
  gl.depthMask(true);
  labelMeasures(parts, view);
  solid.drawn += 1;
  canvas.dataset.drawn = String(solid.drawn);
}

// Each measure has its first quantity at its middle, or below others.
function labelMeasures(parts, view) {
  const { clientWidth: width, clientHeight: height } = solid.gl.canvas;
  const placed = [];
  at("solid-labels").replaceChildren(...parts.filter((part) => part.group === "measures").map(({ name, points, moves, matrix }) => {
    const middle = 3 * Math.floor(points.length / 6);
    const place = [0, 1, 2].map((axis) => points[middle + axis] + solid.inflated * moves[middle + axis]);
    const clip = times(times(view, matrix), [...place, 1, ...new Array(12).fill(0)]);
    const words = measureWords(name, solid.inflated);
    const [x, middleY] = [(width / 2) * (1 + clip[0] / clip[3]), (height / 2) * (1 - clip[1] / clip[3])];
    let y = middleY;
    while (placed.some((other) => Math.abs(other.x - x) < 4 * (other.length + words.length) && Math.abs(other.y - y) < 22)) y += 22;
    placed.push({ x, y, length: words.length });
    const label = make("span", {}, words);
    Object.assign(label.style, { left: `${x}px`, top: `${y}px` });
    return label;
  }));
}

function turn(yaw, pitch) {
  solid.yaw += yaw;
  solid.pitch = Math.min(1.55, Math.max(-1.55, solid.pitch + pitch));
  paint();
}

function nearer(factor) {
  solid.near = Math.min(2.5, Math.max(0.15, solid.near / factor));
  paint();
}

function handleSolid(canvas) {
  const keys = {
    ArrowLeft: () => turn(-0.12, 0), ArrowRight: () => turn(0.12, 0), ArrowUp: () => turn(0, 0.12), ArrowDown: () => turn(0, -0.12),
    "+": () => nearer(1.2), "=": () => nearer(1.2), "-": () => nearer(1 / 1.2), Home: goHome,
  };
  canvas.addEventListener("keydown", (event) => {
    if (!keys[event.key] || event.ctrlKey || event.metaKey) return;
    event.preventDefault();
    keys[event.key]();
  });
  canvas.addEventListener("pointerdown", (event) => canvas.setPointerCapture(event.pointerId));
  canvas.addEventListener("pointermove", (event) => {
    if (event.buttons !== 0) turn(-event.movementX / 150, event.movementY / 150);
  });
  canvas.addEventListener("wheel", (event) => {
    if (!event.ctrlKey) return;
    event.preventDefault();
    nearer(Math.exp(-event.deltaY / 300));
  }, { passive: false });
  at("solid-home").addEventListener("click", goHome);
  at("solid-top").addEventListener("click", () => {
    Object.assign(solid, { yaw: 0, pitch: 1.55 });
    paint();
  });
  at("solid-inflate").addEventListener("input", (event) => inflate(Number(event.target.value)));
}

function goHome() {
  Object.assign(solid, HOME);
  paint();
}

function inflate(share) {
  solid.inflated = share;
  at("solid-inflate").setAttribute("aria-valuetext", `${Math.round(100 * share)} %`);
  paint();
}

function showGroups() {
  const there = GROUPS.filter(([name]) => solid.parts.some((part) => part.group === name));
  at("solid-groups").append(
    ...there.map(([name, says]) => {
      const box = make("input", { type: "checkbox", checked: solid.groups.has(name), "data-group": name });
      box.addEventListener("change", () => {
        if (box.checked) solid.groups.add(name);
        else solid.groups.delete(name);
        paint();
      });
      return make("label", {}, box, make("span", {}, says));
    }),
  );
}

/** Shows the scene, or the reason why it cannot be shown. */
async function showSolid() {
  const canvas = at("solid-view");
  try {
    const gl = canvas.getContext("webgl2", { antialias: true, alpha: true, preserveDrawingBuffer: true });
    if (!gl) throw new Error("this browser has no WebGL 2");
    const made = program(gl);
    const use = { made };
    for (const name of ["view", "stand", "inflated", "color", "eye"]) use[name] = gl.getUniformLocation(made, name);
    const parts = readGlb(await sceneBytes());
    Object.assign(solid, { gl, use, parts: parts.map((part) => loaded(gl, part)) });
  } catch (error) {
    canvas.hidden = true;
    at("solid-says").textContent = `No view in three dimensions: ${error.message}. The same is in scene.glb (build --with scene-glb), for any viewer of glTF.`;
    for (const control of document.querySelectorAll("#solid .controls")) control.hidden = true;
    return;
  }
  const moving = solid.parts.some((part) => part.moves);
  at("solid-inflate").disabled = !moving;
  showGroups();
  handleSolid(canvas);
  new ResizeObserver(paint).observe(canvas);
  inflate(moving ? 1 : 0);
  at("solid-inflate").value = String(solid.inflated);
}
