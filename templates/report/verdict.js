// The verdict, and the figures that it rests on.

"use strict";

function showHead() {
  const { bill, parts, load } = data;
  const points = [...new Set(parts.map((part) => part.points))];
  const pieces = data.sheets.flatMap((sheet) => sheet.stars).length;
  at("name").textContent = data.name;
  const words = [
    KIND === "star" ? `${several(pieces, "star")} of ${listed(points)} points` : `${several(pieces, "piece")} by a drawing`,
    load && load.pressure_kPa ? `at ${figure(load.pressure_kPa, "kPa")}` : null,
    `${figure(totalSeam() / 1000, "m")} of seam in ${hours(totalTime())}`,
    `sealed at ${sealedAt()}`,
    `machine: ${data.machine.name}`,
  ];
  at("summary").textContent = words.filter(Boolean).join(" · ");
  at("made").textContent = `Made by ${bill.tool.name} ${bill.tool.version}. Nothing on this page came from a network.`;
}

function totalSeam() {
  if (KIND === "star") return data.bill.stars.reduce((sum, star) => sum + star.seam_mm, 0);
  return data.bill.pieces.flatMap((piece) => piece.seams).reduce((sum, seam) => sum + seam.length_mm, 0);
}

function totalTime() {
  return data.programs.reduce((sum, program) => sum + program.time_s, 0);
}

/** What becomes of the object: how sure, in one sentence, and why. */
function verdict() {
  const { prediction, load } = data;
  if (KIND === "drawing") return drawingVerdict();
  if (!prediction) {
    return ["Nothing is predicted", "The spec has no [load]: set a pressure and the diameter of an object to see here whether it is held."];
  }
  const { pressure_kPa: pressure, object_radius_mm: object } = load;
  const found = prediction.verdict;
  if (!pressure) {
    return ["No verdict without a pressure", "The spec's [load] has no pressure; every prediction of a star depends on it."];
  }
  if (!found) {
    const closed = prediction.final_radius_mm;
    const title = closed === null ? "No prediction at this pressure" : `Closes to ${figure(2 * closed, "mm")} across`;
    return [title, `At ${figure(pressure, "kPa")}. Set an \`object_diameter\` in [load] to see here whether it is held.`];
  }
  const reasons = [...found.reasons, ...data.remarks].map((reason) => `${reason.charAt(0).toUpperCase()}${reason.slice(1)}.`).join(" ");
  const friction = load.friction === null ? "" : `Computed with a friction of ${number(load.friction)}. `;
  if (bursts(1)) return ["The seal bursts at this pressure", `${friction}${reasons}`];
  if (found.holds === "no") return ["Does not hold the object", `${reasons} ${friction}`];
  const force = found.force_N === null || found.holds !== "yes" ? "" : `${several(data.bill.stars.length, "star")} press${data.bill.stars.length === 1 ? "es" : ""} on an object ${figure(2 * object, "mm")} across with ${figure(found.force_N, "N")}${simulated(found.force_range_N, "N")} at ${figure(pressure, "kPa")}. `;
  const needed = found.needed_N === null ? friction : `With a friction of ${number(load.friction)}, ${figure(found.needed_N, "N")} are needed to hold its ${figure(load.mass_kg, "kg")}. `;
  if (found.holds !== "yes") return ["May hold the object", `${force}${needed}${reasons}`];
  const strength = prediction.stars.every((star) => star.burst_pressure_kPa !== null);
  if (!strength) return ["Holds the object, if the seal holds", `${force}${needed}Burst pressure unknown: measure the seal with a coupon. ${reasons}`];
  return ["Holds the object", `${force}${needed}${reasons}`];
}

/** Whether some star bursts below so many times its pressure. */
function bursts(times) {
  return data.prediction.stars.some((star) => star.burst_margin !== null && star.burst_margin < times);
}

/** A range in brackets, with what it is. */
function simulated(range, unit) {
  const text = span(range, unit);
  return text ? ` (${text} in 95 of 100 simulated grippers)` : "";
}

/** Name, value, range or a note below it, for each key figure. */
function keyFigures() {
  const { prediction, bill, load } = data;
  const out = KIND === "drawing" ? drawingFigures() : [];
  const predicted = (name, quantity, unit, scale = 1, note = null) => {
    const value = prediction ? prediction[quantity] : null;
    const range = rangeOf(prediction, quantity);
    const scaled = range ? range.map((end) => (end === null ? null : end * scale)) : null;
    const below = value === null || value === undefined ? note : span(scaled, unit) || note || "range unknown";
    out.push([name, figure(value === null || value === undefined ? null : value * scale, unit), below]);
  };
  if (prediction) {
    predicted("Force on the object, each star", "object_force_N", "N", 1, prediction.object_force_N === null ? "needs a pressure and an object" : null);
    predicted("Payload, whole stack", "payload_kg", "kg", 1, prediction.payload_kg === null ? "needs friction and an object" : null);
    if (prediction.payload_kg !== null && load.friction !== null) out[out.length - 1][2] += `, friction ${number(load.friction)}`;
    predicted("Closes to, across", "final_radius_mm", "mm", 2);
    const across = prediction.graspable_radius_mm ? prediction.graspable_radius_mm.map((radius) => 2 * radius) : null;
    predicted("Contraction", "contraction", "%", 100);
    out.push(["Holds objects across", span(across, "mm") || UNKNOWN, `between closed and open; the cut hole is ${figure(2 * prediction.hole_radius_mm, "mm")} across`]);
    predicted("Radial stiffness, each star", "radial_stiffness_N_per_m", "N/m");
    out.push(["Pressure", figure(load.pressure_kPa, "kPa"), "gauge pressure"]);
    predicted("Bursts at", "burst_pressure_kPa", "kPa", 1, prediction.burst_pressure_kPa === null ? "peel a coupon, set seal_strength" : null);
  }
  out.push(["Fabric", figure(bill.fabric_mm2 / 100, "cm²"), `both sheets of all ${PIECE}s`]);
  out.push(["Mass of the fabric", figure(bill.mass_g === undefined ? null : bill.mass_g, "g"), bill.mass_g === undefined ? "needs an areal_density" : `all ${PIECE}s`]);
  out.push(["Seam", figure(totalSeam() / 1000, "m"), several(data.programs.length, "program")]);
  out.push(["Sealing takes", hours(totalTime()), "heating and pauses not counted"]);
  return out;
}

// Warnings of the design on the page: more than a printed sheet has room for are counted.
const MOST_NOTES = 12;

function showVerdict() {
  const [title, why] = verdict();
  at("banner").classList.add(data.tone);
  at("verdict-title").textContent = title;
  at("verdict-why").replaceChildren(...prose(why.trim()));
  const cards = keyFigures().map(([name, value, note]) =>
    make("div", { class: value === UNKNOWN ? "card missing" : "card" }, make("dt", {}, name), make("dd", {}, make("b", {}, value), make("span", {}, note || ""))),
  );
  at("figures").append(...cards);
  at("ranges-say").hidden = !data.prediction || !data.prediction.ranges.final_radius_mm;
  const notes = data.notes.slice(0, MOST_NOTES);
  const more = data.notes.length - notes.length;
  if (more > 0) notes.push(`${more} more warnings: \`check --json\` lists them`);
  const watched = [...data.watch, ...notes.map((text) => ({ code: "design", text }))];
  at("watch").hidden = watched.length === 0;
  at("watch-list").append(...watched.map(({ code, text }) => make("li", { "data-code": code }, ...prose(text))));
}
