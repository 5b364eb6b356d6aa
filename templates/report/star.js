// The star: flat and inflated side by side, at any pressure of the table.

"use strict";

const star = { which: 0, pumping: null };

function chartOf(which) {
  const chart = data.charts[which];
  return chart && chart.by_pressure.length > 0 ? chart : null;
}

function poseAt(which, pressure) {
  const rows = chartOf(which).by_pressure;
  const i = rows.findIndex((row) => row.pressure_kPa >= pressure);
  if (i <= 0) return i === 0 ? rows[0] : rows[rows.length - 1];
  const [a, b] = [rows[i - 1], rows[i]];
  // Between two pressures of the table that are no neighbours the pose is unknown.
  if (b.pressure_kPa - a.pressure_kPa > 1.5 * stepOf()) return pressure - a.pressure_kPa < b.pressure_kPa - pressure ? a : b;
  const share = (pressure - a.pressure_kPa) / (b.pressure_kPa - a.pressure_kPa);
  const mix = (key) => (a[key] === null || b[key] === null ? b[key] : a[key] + (b[key] - a[key]) * share);
  return { pressure_kPa: pressure, final_radius_mm: mix("final_radius_mm"), object_force_N: mix("object_force_N"), pose: between(a.pose, b.pose, share) };
}

/** From one pressure of the table to the next. */
function stepOf() {
  return data.load.pressure_kPa / 16;
}

function drawStar(svg, pose, full, says, extent) {
  const { points } = data.parts[star.which];
  const object = objectOf(star.which);
  const shapes = [draw("title", {}, says)];
  if (object) shapes.push(draw("circle", { class: "object", r: object }));
  shapes.push(draw("path", { class: "air", d: tubeOf(pose, points, [0, 1]), "fill-rule": "evenodd" }));
  // The rounder the tube, the more of it catches light along its middle.
  if (full > 0) {
    for (const [edge, shade] of [[0.14, "shine-1"], [0.27, "shine-2"], [0.39, "shine-3"]]) {
      shapes.push(draw("path", { class: shade, d: tubeOf(pose, points, [edge, 1 - edge]), "fill-rule": "evenodd", opacity: full.toFixed(2) }));
    }
  }
  shapes.push(draw("path", { class: "rim", d: tubeOf(pose, points, [0, 1]), "fill-rule": "evenodd" }));
  const radius = pose.inner_radius_mm;
  shapes.push(
    draw("path", { class: "measure", d: `M${(-radius).toFixed(2)} 0H${radius.toFixed(2)}` }),
    draw("circle", { class: "axis", r: extent / 90 }),
    draw("text", { class: "size", x: 0, y: -extent / 45, "font-size": Math.min(extent / 12, Math.max(radius / 2, extent / 26)) }, figure(2 * radius, "mm")),
  );
  svg.setAttribute("viewBox", [-extent, -extent, 2 * extent, 2 * extent].map((x) => x.toFixed(1)).join(" "));
  svg.replaceChildren(...shapes);
}

function showPressure(wanted) {
  const at_p = poseAt(star.which, wanted);
  const pressure = at_p.pressure_kPa;
  const own_kPa = data.load.pressure_kPa;
  const flat = data.flat[star.which];
  const extent = reachOf(flat) * 1.04;
  const object = objectOf(star.which);
  const radius = at_p.pose.inner_radius_mm;
  const touches = object && Math.abs(radius - object) < 0.01 * object;
  const force = touches && at_p.object_force_N !== null ? `, pressing with ${figure(at_p.object_force_N, "N")}` : "";
  const where = touches ? `on the object, ${figure(2 * object, "mm")} across${force}` : `closed to ${figure(2 * radius, "mm")} across`;
  const says = `at ${figure(pressure, "kPa")} ${where}`;
  drawStar(at("star-round"), at_p.pose, 1, `The star: ${says}`, extent);
  at("star-round-says").textContent = says;
  const own = own_kPa === pressure ? ", the spec's own" : isKnown(star.which) ? "" : `; at ${figure(own_kPa, "kPa")} it is unknown`;
  at("star-pressure-says").textContent = `${figure(pressure, "kPa")}${own}`;
  at("star-pressure").value = String(pressure);
  at("star-pressure").setAttribute("aria-valuetext", figure(pressure, "kPa"));
}

function showStar(which) {
  star.which = which;
  const flat = data.flat[which];
  const extent = reachOf(flat) * 1.04;
  drawStar(at("star-flat"), flat, 0, `Flat star, ${figure(2 * flat.inner_radius_mm, "mm")} across inside`, extent);
  at("star-flat-says").textContent = `flat: tube ${figure(flat.width_mm, "mm")} wide, arms ${figure(data.parts[which].arm_length_mm, "mm")} long, tips of ${number(flat.tip_angle_deg)}°`;
  const chart = chartOf(which);
  at("star-controls").hidden = !chart;
  at("star-round-box").hidden = !chart;
  if (!chart) return;
  const [least, most] = knownOf(which);
  at("star-pressure").min = String(least);
  at("star-pressure").max = String(most);
  showPressure(Math.min(most, Math.max(least, data.load.pressure_kPa)));
}

/** The pressures between which a star's pose is predicted. */
function knownOf(which) {
  const rows = chartOf(which).by_pressure;
  return [rows[0].pressure_kPa, rows[rows.length - 1].pressure_kPa];
}

/** Whether it is predicted at the spec's own pressure. */
function isKnown(which) {
  const [least, most] = knownOf(which);
  return data.load.pressure_kPa >= least && data.load.pressure_kPa <= most;
}

/** From the least predicted pressure to the spec's own in two seconds. */
function pump() {
  if (star.pumping !== null) cancelAnimationFrame(star.pumping);
  let first = null;
  const tick = (now) => {
    if (first === null) first = now;
    const share = Math.min(1, (now - first) / 2000);
    const [least, most] = knownOf(star.which);
    const end = Math.min(most, Math.max(least, data.load.pressure_kPa));
    showPressure(share < 1 ? least + share * (end - least) : end);
    star.pumping = share < 1 ? requestAnimationFrame(tick) : null;
  };
  star.pumping = requestAnimationFrame(tick);
}

function showStars() {
  const chart = chartOf(0);
  at("star-lead").textContent = chart
    ? "Simplified: straight arms, round tubes; real hinges wrinkle."
    : data.load && data.load.pressure_kPa ? "This star has no prediction at this pressure; only the flat star is shown." : "The spec has no pressure in [load], so only the flat star is shown.";
  if (data.parts.length > 1) {
    at("star-which").hidden = false;
    const names = data.parts.map((part, i) => make("option", { value: i }, stars(data.sheets.flatMap((sheet) => sheet.stars).filter((other) => other.part === i).map((other) => other.star))));
    at("star-choice").append(...names);
    at("star-choice").addEventListener("change", (event) => showStar(Number(event.target.value)));
  }
  at("star-pressure").addEventListener("input", (event) => {
    const own = data.load.pressure_kPa;
    const value = Number(event.target.value);
    // The spec's own pressure is easily hit.
    showPressure(isKnown(star.which) && Math.abs(value - own) < 0.008 * Number(event.target.max) ? own : value);
  });
  at("star-pressure").addEventListener("keydown", (event) => {
    const step = { ArrowRight: 1, ArrowUp: 1, ArrowLeft: -1, ArrowDown: -1, PageUp: 10, PageDown: -10 }[event.key];
    if (!step) return;
    event.preventDefault();
    const [least, most] = knownOf(star.which);
    showPressure(Math.min(most, Math.max(least, Number(event.target.value) + (step * most) / 96)));
  });
  at("star-pump").addEventListener("click", pump);
  showStar(0);
}
