// The verdict, and the figures that it rests on.

"use strict";

function showHead() {
  const { bill, parts, load } = data;
  const points = [...new Set(parts.map((part) => part.points))];
  at("name").textContent = data.name;
  const words = [
    `${several(bill.stars.length, "star")} of ${listed(points)} points`,
    load && load.pressure_kPa ? `at ${figure(load.pressure_kPa, "kPa")}` : null,
    `${figure(totalSeam() / 1000, "m")} of seam in ${hours(totalTime())}`,
    `sealed at ${data.seal.temperature} and ${data.seal.speed}`,
    `machine: ${data.machine.name}`,
  ];
  at("summary").textContent = words.filter(Boolean).join(" · ");
  at("made").textContent = `Made by ${bill.tool.name} ${bill.tool.version}. Nothing on this page came from a network.`;
}

function totalSeam() {
  return data.bill.stars.reduce((sum, star) => sum + star.seam_mm, 0);
}

function totalTime() {
  return data.programs.reduce((sum, program) => sum + program.time_s, 0);
}

/** What becomes of the object: how sure, in one sentence, and why. */
function verdict() {
  const { prediction, load } = data;
  if (!prediction) {
    return ["plain", "Nothing is predicted", "The spec has no [load]: write a pressure, and the radius of an object, and this page says whether it is held."];
  }
  const { pressure_kPa: pressure, object_radius_mm: object } = load;
  const found = prediction.verdict;
  if (!pressure) {
    return ["plain", "No verdict without a pressure", "The spec's [load] names no pressure, on which everything depends that a star does."];
  }
  if (!found) {
    const closed = prediction.final_radius_mm;
    const title = closed === null ? "Nothing is known at this pressure" : `Closes to a radius of ${figure(closed, "mm")}`;
    return ["plain", title, `At ${figure(pressure, "kPa")}. Write an object_radius in [load], and this page says whether it is held.`];
  }
  const reasons = found.reasons.map((reason) => `${reason.charAt(0).toUpperCase()}${reason.slice(1)}.`).join(" ");
  if (found.holds === "no") return ["bad", "Does not hold the object", reasons];
  const range = span(found.force_range_N, "N");
  const force = found.force_N === null || found.holds !== "yes" ? "" : `${several(data.bill.stars.length, "star")} press${data.bill.stars.length === 1 ? "es" : ""} on an object of radius ${figure(object, "mm")} with ${range || figure(found.force_N, "N")} at ${figure(pressure, "kPa")}. `;
  const needed = found.needed_N === null ? "" : `Friction needs ${figure(found.needed_N, "N")} to hold its ${figure(load.mass_kg, "kg")}. `;
  const tone = found.holds === "yes" ? ["good", "Holds the object"] : ["fair", "May hold the object"];
  return [...tone, `${force}${needed}${reasons}`];
}

/** Name, value, range or a note below it, for each key figure. */
function keyFigures() {
  const { prediction, bill, load } = data;
  const out = [];
  const predicted = (name, quantity, unit, scale = 1, note = null) => {
    const value = prediction ? prediction[quantity] : null;
    const range = rangeOf(prediction, quantity);
    const scaled = range ? range.map((end) => (end === null ? null : end * scale)) : null;
    const below = value === null || value === undefined ? note : span(scaled, unit) || note || "range unknown";
    out.push([name, figure(value === null || value === undefined ? null : value * scale, unit), below]);
  };
  if (prediction) {
    predicted("Force on the object, each star", "object_force_N", "N", 1, prediction.object_force_N === null ? "needs a pressure and an object" : null);
    predicted("It carries, whole stack", "payload_kg", "kg", 1, prediction.payload_kg === null ? "needs friction and an object" : null);
    predicted("Closes to a radius of", "final_radius_mm", "mm");
    predicted("Contraction", "contraction", "%", 100);
    out.push(["Holds radii", span(prediction.graspable_radius_mm, "mm") || UNKNOWN, `between closed and open; the cut hole has ${figure(prediction.hole_radius_mm, "mm")}`]);
    predicted("Radial stiffness, each star", "radial_stiffness_N_per_m", "N/m");
    out.push(["Pressure", figure(load.pressure_kPa, "kPa"), `full actuation from ${figure(prediction.operating_pressure_kPa, "kPa")}`]);
    predicted("Bursts at", "burst_pressure_kPa", "kPa", 1, prediction.burst_pressure_kPa === null ? "needs a seal_strength" : null);
  }
  out.push(["Fabric", figure(bill.fabric_mm2 / 100, "cm²"), "both sheets of all stars"]);
  out.push(["Mass of the fabric", figure(bill.mass_g === undefined ? null : bill.mass_g, "g"), bill.mass_g === undefined ? "needs an areal_density" : "all stars"]);
  out.push(["Seam", figure(totalSeam() / 1000, "m"), several(data.programs.length, "program")]);
  out.push(["Sealing takes", hours(totalTime()), "heating and pauses not counted"]);
  return out;
}

function showVerdict() {
  const [tone, title, why] = verdict();
  at("banner").classList.add(tone);
  at("verdict-title").textContent = title;
  at("verdict-why").textContent = why;
  const cards = keyFigures().map(([name, value, note]) =>
    make("div", { class: value === UNKNOWN ? "card missing" : "card" }, make("dt", {}, name), make("dd", {}, make("b", {}, value), make("span", {}, note || ""))),
  );
  at("figures").append(...cards);
  const weak = data.loads.flatMap((places) => places.map((place) => place.weakness).filter(Boolean));
  const notes = [...(data.prediction ? data.prediction.evidence.warnings : []), ...weak, ...data.notes];
  at("watch").hidden = notes.length === 0;
  at("watch-list").append(...[...new Set(notes)].map((note) => make("li", {}, note)));
}
