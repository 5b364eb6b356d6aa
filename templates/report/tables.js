// Tables: material, spec, evidence, and the checklists' texts.

"use strict";

function showBill() {
  const { bill, hose, seal } = data;
  const rows = [];
  const row = (what, count, size, note) => rows.push([what, String(count), size, note]);
  data.parts.forEach((part, i) => {
    const alike = data.sheets.flatMap((sheet) => sheet.stars).filter((other) => other.part === i).map((other) => other.star);
    if (KIND === "drawing") {
      row(`Fabric of ${stars(alike)}`, alike.length, `${figure(bill.fabric_mm2 / 100 / alike.length, "cm²")} each`, bill.mass_g === undefined ? "two sheets" : `${figure(bill.mass_g / alike.length, "g")} each, two sheets`);
      return;
    }
    const own = bill.stars.find((other) => other.index === alike[0]);
    const mass = own.mass_g === undefined ? "" : `${figure(own.mass_g, "g")} each, `;
    row(`Fabric of ${stars(alike)}`, alike.length, `${figure(own.fabric_mm2 / 100, "cm²")} each`, `${mass}two sheets, hole ${figure(2 * own.clear_radius_mm, "mm")} across stays free`);
  });
  for (const sheet of data.sheets) row(`Sheet ${sheet.sheet}`, 2, `${figure(sheet.width_mm, "mm", 4)} × ${figure(sheet.height_mm, "mm", 4)}`, "coated sides face each other");
  for (const plates of bill.plates) row(`Plates ${listed(plates.plates.map(String))}`, plates.plates.length, `${figure(2 * plates.radius_mm, "mm", 4)} across, ${figure(plates.thickness_mm, "mm")} thick`, `opening ${figure(2 * plates.opening_mm, "mm")} across; middle ${listed(plates.heights_mm.map((height) => number(height, 4)))} mm high`);
  for (const posts of bill.posts) row("Posts", posts.count, `${figure(posts.length_mm, "mm", 4)} long`, `diameter ${figure(data.post_diameter_mm, "mm")}`);
  if (hose && KIND === "star") row("Hose", bill.stars.length, `outer diameter ${figure(hose.diameter_mm, "mm")}`, `one for each inlet, which is ${figure(hose.length_mm, "mm")} long`);
  for (const mask of bill.masks) {
    const pieces = mask.pieces && mask.pieces.length > 1 ? `, printed in ${mask.pieces.length} pieces` : "";
    row(`Mask for ${stars(mask.stars)}`, 1, `${figure(mask.area_mm2 / 100, "cm²")}`, `${figure(mask.volume_mm3 / 1000, "cm³")} if printed${pieces}; coating ${span(mask.coating_um, "µm")} thick`);
  }
  row("Seam", data.programs.reduce((sum, one) => sum + one.seams.length, 0), figure(totalSeam() / 1000, "m", 4), data.processes ? `${hours(totalTime())} at ${sealedAt()}` : `${hours(totalTime())} at ${seal.speed}, ${seal.temperature}`);
  table("parts", ["What", "Number", "Size", "Note"], rows);
}

function showSettings() {
  const sections = [...new Set(data.settings.map((setting) => setting.section))];
  at("setting-list").append(
    ...sections.map((section) => {
      const own = data.settings.filter((setting) => setting.section === section && (setting.given || setting.value !== null));
      if (own.length === 0) return "";
      const lines = own.map((setting) =>
        make("div", { class: setting.given ? "given" : "default", title: setting.meaning || null }, make("dt", {}, setting.key), make("dd", {}, setting.value, make("span", { class: "mark" }, setting.given ? "" : "default"))),
      );
      return make("div", { class: "group" }, make("h3", {}, section === "" ? "whole spec" : section), make("dl", {}, ...lines));
    }),
  );
}

const KNOWN = {
  fit: "published constants",
  ring: "exact limit of a membrane that neither bends nor stretches",
  bvp: "the paper's boundary value problem at finite stiffness",
  section: "a cut through the hinge, with bending and stretch; corrected by computed shells",
  shell: "the whole sheet in triangles, with contact",
};

function showEvidence() {
  const { prediction, load } = data;
  const rows = [
    ["Lengths, areas, seams", "exact geometry", "lines and arcs of the design; every file was read back and compared with it"],
    ["Times", "the programs, step by step", "lengths over speeds, travels with their acceleration; heating and pauses not counted"],
  ];
  if (KIND === "star") rows.push(["Thickness of the coating", "an estimate", data.bill.masks.length > 0 ? data.bill.masks[0].coating_assumes : ""]);
  if (KIND === "drawing") {
    rows.push(...drawingEvidence());
  } else if (prediction) {
    const { evidence } = prediction;
    const model = KNOWN[prediction.model] || "a model of the hinge";
    const sure = (quantity, unit, other, scale = 1) => {
      const range = rangeOf(prediction, quantity);
      return range ? `${span(range.map((end) => scale * end), unit)} in 95 of 100 simulated grippers` : other;
    };
    rows.push(
      ["Closes to, across", model, sure("final_radius_mm", "mm", prediction.final_radius_mm === null ? evidence.choice : "range unknown", 2)],
      ["Contraction", "closed width over that of the flat star", sure("contraction", "%", "range unknown", 100)],
      ["Force on the object", model, sure("object_force_N", "N", "range unknown")],
      ["Radial stiffness", model, sure("radial_stiffness_N_per_m", "N/m", "range unknown")],
      ["Payload", "friction times force of all stars on the object's slopes, until arms fold", payloadRange(prediction, load)],
      ["Bursting", "membrane ring at the realised radius", prediction.burst_pressure_kPa === null ? "unknown: peel coupons (`stargrip-cam coupon`) and set seal_strength" : sure("burst_pressure_kPa", "kPa", "conservative: a sharp corner yields before it peels")],
      ["Mass", "areal_density times fabric", prediction.mass_g === null ? "needs an areal_density" : "as accurate as the given areal density"],
    );
  } else {
    rows.push(["Predictions", "none", "the spec has no [load]"]);
  }
  if (KIND === "drawing") at("evidence-lead").textContent = "Geometry and times are exact. Numbers of the shell have their mesh error; no drawn piece was measured for them.";
  else at("evidence-lead").textContent = prediction
    ? "Ranges come from computed shells: 95 of 100 simulated grippers lay in them. No gripper was measured; where no range is given, nothing was compared."
    : "Geometry and times are exact; nothing is predicted without [load].";
  table("sources", ["Figure", "Comes from", "Accuracy"], rows.map((row) => row.map(prose)));
}

/** The range of the payload, and of what it is made: no simulated gripper varies friction. */
function payloadRange(prediction, load) {
  const range = rangeOf(prediction, "payload_kg");
  if (!range) return "as accurate as the force and the given friction";
  const [least, most] = [load.friction_least, load.friction_most].map((end) => (end === null || end === undefined ? load.friction : end));
  const friction = least < most ? `friction from ${number(least)} to ${number(most)}` : `a friction of ${number(load.friction)}`;
  return `${span(range, "kg")} from the force's range and ${friction}`;
}

/** The highest friction that bare fabric has on a smooth object (docs/choosing.md). */
const BARE = 0.42;

/** The checklists' texts for this design. */
function sayings() {
  const { bill, seal, hose, load, machine, prediction } = data;
  const speed = Number.parseFloat(seal.speed);
  const plates = bill.plates.map((plate) => `${listed(plate.plates.map(String))} with the opening of ${figure(2 * plate.opening_mm, "mm")} across at ${listed(plate.heights_mm.map((height) => number(height, 4)))} mm`);
  const coating = bill.masks.map((mask) => span(mask.coating_um, "µm"));
  const angles = data.stack ? data.stack.turns_deg : [];
  const turns = angles.map((turn, i) => `${number(turn)}°${angles.length > 1 ? ` (star ${i + 1})` : ""}`);
  const same = new Set(angles).size === 1;
  const across = (radius) => 2 * radius;
  const range = rangeOf(prediction, "final_radius_mm");
  const closed = prediction ? prediction.final_radius_mm : null;
  const closes = range ? span(range.map(across), "mm") : closed === null ? null : figure(across(closed), "mm");
  const flap = data.settings.find((setting) => setting.section === "seal" && setting.key === "hole_allowance");
  return {
    "check-time": Number.isFinite(speed) && speed > 0 && seal.speed.includes("mm/s") ? `${number(10 / speed)} s` : "10 mm over the seal's speed",
    requires: machine.requires.join("; "),
    sheets: listed(data.sheets.map((sheet) => `${figure(sheet.width_mm, "mm", 4)} × ${figure(sheet.height_mm, "mm", 4)}`)),
    temperature: `${data.processes ? data.processes.map((other) => `${other.temperature} (${other.name})`).join(", then ") : seal.temperature}${machine.heats_itself ? ", set by the program" : ", set by hand"}`,
    "job-time": hours(totalTime()),
    "hole-flap": flap ? flap.value : "",
    hose: hose ? figure(hose.diameter_mm, "mm") : "",
    pressure: load && load.pressure_kPa ? figure(load.pressure_kPa, "kPa") : "the working pressure",
    coating: [...new Set(coating)].join(", "),
    posts: bill.posts.map((posts) => `${several(posts.count, "post")} of ${figure(posts.length_mm, "mm", 4)}, diameter ${figure(data.post_diameter_mm, "mm")}`).join(", "),
    plates: plates.join("; "),
    turns: same ? turns[0].split(" ")[0] : turns.join(", "),
    closes: closes || "",
    bare: load && load.friction > 0 && load.friction <= BARE ? `a friction of ${number(load.friction)}` : "",
  };
}

function showChecks() {
  const says = sayings();
  for (const element of document.querySelectorAll("[data-say]")) element.textContent = says[element.dataset.say];
  for (const element of document.querySelectorAll("[data-when]")) element.hidden = !says[element.dataset.when];
  at("check-programs").append(
    ...data.programs.map((one, i) => {
      const text = `Program ${i + 1}, ${stars(one.stars)} on sheet ${one.sheet}: ${hours(one.time_s)}; started at `;
      const blank = make("input", { class: "blank", type: "text", "aria-label": `when program ${i + 1} was started` });
      return make("li", {}, make("label", {}, make("input", { type: "checkbox" }), " ", make("span", {}, text, blank)));
    }),
  );
}
