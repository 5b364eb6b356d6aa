// Plots: a curve, the range around it where one is known, and this design marked on it.

"use strict";

const PLOT = { width: 420, height: 280, left: 66, right: 16, top: 16, bottom: 52 };

/** Round numbers from `low` to `high`, some five of them. */
function ticks(low, high) {
  const rough = (high - low) / 5 || 1;
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 5, 10].map((k) => k * power).find((k) => k >= rough);
  const out = [];
  for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; k += 1) out.push(k * step);
  return out;
}

/** A scale from values to places. */
function scaleOf([low, high], [from, to]) {
  return (value) => from + ((value - low) / (high - low || 1)) * (to - from);
}

/** A figure with its plot: `line` of [x, y], `band` of [x, lo, hi], `dots` of [x, y, range], `own` {x, y, range} for this design. */
function plot({ title, x, y, line = [], band = [], dots = [], own, note }) {
  const all = [...line, ...dots.map(([px, py, range]) => [px, range ? range[1] : py]), ...band.map(([at_x, , hi]) => [at_x, hi]), ...(own ? [[own.x, own.range ? own.range[1] : own.y]] : [])];
  const xs = all.map(([value]) => value);
  const wide = x.whole ? [Math.min(...xs) - 0.5, Math.max(...xs) + 0.5] : [x.from ?? Math.min(...xs), Math.max(...xs)];
  const low = Math.min(0, ...all.map(([, value]) => value), ...dots.map(([, , range]) => (range ? range[0] : 0)));
  const high = ticksAbove(Math.max(...all.map(([, value]) => value)), low);
  const across = scaleOf(wide, [PLOT.left, PLOT.width - PLOT.right]);
  const up = scaleOf([low, high], [PLOT.height - PLOT.bottom, PLOT.top]);
  const place = ([px, py]) => `${across(px).toFixed(1)} ${up(py).toFixed(1)}`;
  const shapes = [draw("title", {}, title)];
  for (const value of ticks(low, high)) {
    const at_y = up(value);
    shapes.push(draw("path", { class: "grid", d: `M${PLOT.left} ${at_y.toFixed(1)}H${PLOT.width - PLOT.right}` }));
    shapes.push(draw("text", { class: "tick end", x: PLOT.left - 8, y: at_y, dy: "0.35em" }, value === 0 ? "0" : number(value, 2)));
  }
  for (const value of x.whole ? xs.filter((v, i) => xs.indexOf(v) === i).sort((a, b) => a - b) : ticks(...wide)) {
    shapes.push(draw("text", { class: "tick middle", x: across(value), y: PLOT.height - PLOT.bottom + 20 }, value === 0 ? "0" : number(value, 3)));
  }
  shapes.push(draw("path", { class: "axis-line", d: `M${PLOT.left} ${up(low)}H${PLOT.width - PLOT.right}` }));
  shapes.push(draw("text", { class: "label middle", x: (PLOT.left + PLOT.width - PLOT.right) / 2, y: PLOT.height - 8 }, x.label));
  shapes.push(draw("text", { class: "label middle", transform: `translate(14 ${(PLOT.top + PLOT.height - PLOT.bottom) / 2}) rotate(-90)` }, y.label));
  if (band.length > 1) {
    const back = [...band].reverse().map(([px, lo]) => [px, lo]);
    shapes.push(draw("path", { class: "band", d: `M${[...band.map(([px, , hi]) => [px, hi]), ...back].map(place).join("L")}Z` }));
  }
  if (line.length > 1) shapes.push(draw("path", { class: "curve", d: `M${line.map(place).join("L")}` }));
  for (const [px, , range] of dots) {
    if (range) shapes.push(draw("path", { class: "spread", d: `M${across(px)} ${up(range[0])}V${up(range[1])}` }));
  }
  for (const dot of dots) shapes.push(draw("circle", { class: "dot", cx: across(dot[0]), cy: up(dot[1]), r: 4 }));
  if (own) {
    const px = across(own.x);
    if (own.range) shapes.push(draw("path", { class: "whisker", d: `M${px} ${up(own.range[0])}V${up(own.range[1])}M${px - 6} ${up(own.range[0])}h12M${px - 6} ${up(own.range[1])}h12` }));
    shapes.push(draw("circle", { class: "own", cx: px, cy: up(own.y), r: 6 }));
    const left = px > PLOT.width * 0.62;
    const above = up(own.y) > PLOT.top + 30;
    shapes.push(draw("text", { class: `own-says ${left ? "end" : ""}`, x: px + (left ? -10 : 10), y: up(own.y) + (above ? -10 : 20) }, own.says));
  }
  const svg = draw("svg", { role: "img", viewBox: `0 0 ${PLOT.width} ${PLOT.height}` }, ...shapes);
  const values = line.length > 12 ? line.filter((_, i) => i % Math.ceil(line.length / 12) === 0 || i === line.length - 1) : [...line, ...dots];
  const rows = values.map(([px, py]) => make("tr", {}, make("td", {}, number(px)), make("td", {}, number(py))));
  const numbers = make(
    "details", {}, make("summary", {}, "As numbers"),
    make("table", {}, make("caption", {}, title), make("thead", {}, make("tr", {}, make("th", { scope: "col" }, x.label), make("th", { scope: "col" }, y.label))), make("tbody", {}, ...rows)),
  );
  return make("figure", { class: "plot" }, make("h3", {}, title), svg, make("figcaption", {}, note), numbers);
}

/** The next round number above. */
function ticksAbove(high, low) {
  const marks = ticks(low, high);
  const step = marks.length > 1 ? marks[1] - marks[0] : high || 1;
  return Math.ceil(high / step - 1e-9) * step || 1;
}

function showPlots() {
  const chart = chartOf(0);
  const { load } = data;
  if (!chart) {
    at("curves-lead").textContent = load && load.pressure_kPa ? "No model covers this star." : "Curves need a pressure in [load].";
    return;
  }
  const several_stars = data.parts.length > 1 ? " Star 1; the others differ." : "";
  at("curves-lead").textContent = `By model “${chart.model}”, one star at ${figure(load.pressure_kPa, "kPa")} where nothing else is said.${several_stars} The dot is this design, the whisker its range, where one is known.`;
  const own = data.prediction.stars[0];
  const force = own.object_force_N;
  const held = load.object_radius_mm && force !== null && force > 0;
  const says = (range, unit) => (span(range, unit) ? `Range of this design: ${span(range, unit)}.` : "The range of this design is unknown.");
  const percent = (range) => (range ? range.map((end) => 100 * end) : null);
  const banded = (rows, x, range) => rows.filter((row) => row[range]).map((row) => [row[x], ...row[range]]);
  const rangeF = rangeOf(own, "object_force_N");
  const rangeR = rangeOf(own, "final_radius_mm");
  const rangeC = percent(rangeOf(own, "contraction"));
  const known = own.final_radius_mm !== null;
  const plots = [
    chart.by_radius.length > 1 && plot({
      title: "Force by the object's radius", x: { label: "radius of the object, mm" }, y: { label: "radial force, N" },
      line: chart.by_radius.map((row) => [row.radius_mm, row.force_N]), band: banded(chart.by_radius, "radius_mm", "force_range_N"),
      own: held ? { x: load.object_radius_mm, y: force, range: rangeF, says: figure(force, "N") } : null,
      note: held ? says(rangeF, "N") : "This design's object is not on the curve.",
    }),
    chart.by_pressure.length > 1 && plot({
      title: "Closed radius by pressure", x: { label: "pressure, kPa", from: 0 }, y: { label: "inner radius, mm" },
      line: chart.by_pressure.map((row) => [row.pressure_kPa, row.final_radius_mm]), band: banded(chart.by_pressure, "pressure_kPa", "radius_range_mm"),
      own: known ? { x: load.pressure_kPa, y: own.final_radius_mm, range: rangeR, says: figure(own.final_radius_mm, "mm") } : null,
      note: says(rangeR, "mm"),
    }),
    chart.by_points.length > 1 && plot({
      title: "Contraction by the number of points", x: { label: "points", whole: true }, y: { label: "contraction, %" },
      dots: chart.by_points.map((row) => [row.points, 100 * row.contraction, percent(row.contraction_range)]),
      own: known ? { x: data.parts[0].points, y: 100 * own.contraction, range: rangeC, says: figure(100 * own.contraction, "%") } : null,
      note: `${says(rangeC, "%")} Radius, width and angle as they are.`,
    }),
  ];
  at("plots").append(...plots.filter(Boolean));
}
