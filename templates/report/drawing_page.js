// A drawing's own figures: chambers under pressure, and the pull on their seams.

"use strict";

const drawn = data.drawing ? data.drawing.prediction : null;

/** A number with its mesh error. */
function meshed(value, unit, scale = 1) {
  if (!value) return UNKNOWN;
  return `${figure(scale * value.value, unit)} ± ${number(scale * value.mesh_error, 2)}`;
}

/** The place of a value in the drawing. */
function placeOf({ at_mm: [x, y] }) {
  return `X ${number(x)} Y ${number(y)}`;
}

/** A text of the program as a sentence. */
function sentence(text) {
  return `${text.charAt(0).toUpperCase()}${text.slice(1)}.`;
}

/** "166 × 73.1 × 32" of each inflated chamber; "" where there is none. */
function inflatedSizes() {
  const sizes = drawn.chambers.filter((one) => one.extents_mm && one.height_mm);
  return listed([...new Set(sizes.map((one) => [...one.extents_mm, one.height_mm].map(({ value }) => number(value)).join(" × ")))]);
}

// "242 × 102 mm".
function flatSize() {
  const points = corners(data.parts[0].outside);
  const side = (axis) => Math.max(...points.map((point) => point[axis])) - Math.min(...points.map((point) => point[axis]));
  return `${side(0).toFixed(0)} × ${side(1).toFixed(0)} mm`;
}

function drawingVerdict() {
  const pieces = data.bill.pieces.length;
  const sealable = `Can be sealed: ${pieces > 1 ? `${pieces} pieces of ` : ""}${several(data.bill.pieces[0].seams.length, "seam")}, ${hours(totalTime())}, ${flatSize()}`;
  if (!drawn) return [sealable, "The spec has no [load]: set a `pressure` there to inflate the shape."];
  if (drawn.model === "none") return [sealable, 'Its inflated size is not computed: `model = "shell"` in [accuracy] makes every build compute it.'];
  const warnings = drawn.evidence.warnings.map(sentence).join(" ");
  const size = inflatedSizes();
  const title = size ? `Inflates to ${size} mm` : "Inflated";
  const pressure = figure(drawn.pressure_kPa, "kPa");
  const range = drawn.burst_range_kPa;
  if (range && drawn.pressure_kPa > range[1]) return ["The seal bursts at this pressure", warnings];
  if (range && drawn.pressure_kPa > range[0]) return ["The seal may burst", warnings];
  if (warnings) return [`${title} at ${pressure}`, warnings];
  if (!range) return [`${title} at ${pressure}`, "Burst pressure unknown: measure the seal with a coupon."];
  return [`${title} at ${pressure}`, "The pressure is below the whole range of the burst pressure."];
}

function drawingFigures() {
  if (!drawn) return [];
  const out = [["Pressure", figure(drawn.pressure_kPa, "kPa"), "gauge pressure"]];
  const size = inflatedSizes();
  if (size) out.push(["Inflated size, mm", size, "length, width, height; errors are in the table"]);
  const volume = drawn.volume_mm3;
  out.push(["Volume of a piece", figure(volume ? volume.value / 1000 : null, "cm³"), volume ? `mesh error ${number(volume.mesh_error / 1000, 2)} cm³` : "the shell was not computed"]);
  const pulls = drawn.chambers.map((one) => one.seal_pull_N_per_mm).filter(Boolean);
  const most = pulls.reduce((a, b) => (a && a.value >= b.value ? a : b), null);
  out.push(["Largest pull on the seal", figure(most ? most.value : null, "N/mm"), most ? `mesh error ${number(most.mesh_error, 2)} N/mm` : "the shell was not computed"]);
  out.push(["Bursts at", figure(drawn.burst_pressure_kPa, "kPa"), span(drawn.burst_range_kPa, "kPa") || "needs the shell and a seal_strength"]);
  return out;
}

function showChambers() {
  if (!drawn) {
    at("chambers-lead").textContent = "The spec has no pressure.";
    for (const id of ["chambers", "pulls", "measures", "pull"]) at(id).parentElement.remove();
    return;
  }
  const rows = drawn.chambers.map((one) => [
    String(one.chamber),
    `${number(one.flat_extents_mm[0])} × ${figure(one.flat_extents_mm[1], "mm")}, at most ${figure(one.width_mm, "mm")} wide`,
    one.extents_mm ? `${meshed(one.extents_mm[0], "mm")} × ${meshed(one.extents_mm[1], "mm")}` : UNKNOWN,
    one.height_mm ? `${meshed(one.height_mm, "mm")} at ${placeOf(one.height_mm)}` : UNKNOWN,
    meshed(one.volume_mm3, "cm³", 0.001),
    { stays: "stays in it", leaves: "leaves it", unsure: "not sure" }[one.plane] || UNKNOWN,
  ]);
  at("chambers-lead").textContent = drawn.model === "none" ? "Flat sizes only: the inflated shape is not computed." : "Each number with its mesh error; places in the frame of the drawing, mm.";
  table("chambers", ["Chamber", "Flat", "Inflated", "Height", "Volume", "Plane"], rows);
  const pulls = drawn.chambers.flatMap(({ chamber, seams }) => (seams || []).map(({ seam, pull_N_per_mm: pull }) => [seam, String(chamber), meshed(pull, "N/mm"), pull ? placeOf(pull) : UNKNOWN]));
  if (pulls.length) table("pulls", ["Seam", "Chamber", "Largest pull", "Place"], pulls);
  else at("pulls").parentElement.remove();
  showMeasures();
  showPull();
}

// Of a measure [name, flat, inflated, unit], to thousandths: below is noise.
function quantities(measure) {
  const round = (value) => Math.round(1000 * value) / 1000;
  const words = { radius_mm: "radius", angle_deg: "angle", distance_mm: "distance", height_mm: "height", direction_deg: "direction", x_mm: "x", y_mm: "y" };
  return Object.entries(words).filter(([key]) => measure[key]).map(([key, word]) => [
    key === "angle_deg" && measure.angle_to ? `angle to ${measure.angle_to}` : word, round(measure[key].flat),
    measure[key].inflated && { value: round(measure[key].inflated.value), mesh_error: round(measure[key].inflated.mesh_error) }, key.endsWith("deg") ? "°" : "mm",
  ]);
}

// "across: distance 40 mm", flat or inflated; between them the name alone.
function measureWords(name, share) {
  const [[word, flat, inflated, unit]] = quantities(drawn.measures.find(({ measure }) => measure === name));
  return share > 0 && share < 1 ? name : `${name}: ${word} ${figure(share ? inflated && inflated.value : flat, unit)}`;
}

/** The quantities of the drawing's measures, a row each. */
function showMeasures() {
  const rows = drawn.measures.flatMap((measure) => quantities(measure).map(([word, flat, inflated, unit]) => [measure.measure, word, figure(flat, unit), meshed(inflated, unit)]));
  if (rows.length) table("measures", ["Measure", "Quantity", "Flat", "Inflated"], rows);
  else at("measures").parentElement.remove();
}

/** How hard and how far the drawing pulls at its bars. */
function showPull() {
  const { pull } = drawn;
  if (!pull) {
    at("pull").parentElement.remove();
    return;
  }
  const lifted = pull.mass_kg ? [[`under ${figure(pull.mass_kg, "kg")}`, pull.lifted_mm ? meshed(pull.lifted_mm, "mm") : "not lifted", ""]] : [];
  const curve = pull.curve.slice(1).map(([stroke, value, mesh_error]) => ["between", figure(stroke, "mm"), meshed({ value, mesh_error }, "N")]);
  table("pull", [pull.bars.join(" to "), "Stroke", "Force"], [
    ["blocked", figure(0, "mm"), meshed(pull.blocked_force_N, "N")], ...curve, ["free", meshed(pull.free_stroke_mm, "mm"), figure(0, "N")], ...lifted,
  ]);
}

function drawingEvidence() {
  if (!drawn) return [["Predictions", "none", "the spec has no [load]"]];
  if (drawn.model === "none") return [["Predictions", "none", "the shell is not computed"]];
  const unknowns = drawn.chambers.map((one) => one.unknowns[one.unknowns.length - 1]);
  return [
    ["Size, height, volume", "the shell: the whole sheet in triangles", `mesh errors are shown; ${listed(unknowns.map(String))} unknowns on the finest mesh`],
    ["Pull on the seal", "the same, as a mean over the width of the band", "without the flaps outside of the band"],
    ["Bursting", "pull against `seal_strength`", drawn.burst_pressure_kPa === null ? "unknown: peel coupons (`stargrip-cam coupon`) and set seal_strength" : "in proportion to the pressure, with a range"],
  ];
}
