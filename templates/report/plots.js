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
  const all = [...line.flat(), ...dots.map(([px, py, range]) => [px, range ? range[1] : py]), ...band.flat().map(([at_x, , hi]) => [at_x, hi]), ...(own ? [[own.x, own.range ? own.range[1] : own.y]] : [])];
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
  for (const run of band) {
    const back = [...run].reverse().map(([px, lo]) => [px, lo]);
    shapes.push(draw("path", { class: "band", d: `M${[...run.map(([px, , hi]) => [px, hi]), ...back].map(place).join("L")}Z` }));
  }
  for (const run of line) shapes.push(draw("path", { class: "curve", d: `M${run.map(place).join("L")}` }));
  for (const [px, , range] of dots) {
    if (range) shapes.push(draw("path", { class: "spread", d: `M${across(px)} ${up(range[0])}V${up(range[1])}` }));
  }
  for (const dot of dots) shapes.push(draw("circle", { class: "dot", cx: across(dot[0]), cy: up(dot[1]), r: 4 }));
  if (own) {
    const px = across(own.x);
    if (own.range) shapes.push(draw("path", { class: "whisker", d: `M${px} ${up(own.range[0])}V${up(own.range[1])}M${px - 6} ${up(own.range[0])}h12M${px - 6} ${up(own.range[1])}h12` }));
    shapes.push(draw("circle", { class: "own", cx: px, cy: up(own.y), r: 6 }));
    const taken = [...line.flatMap((run) => steps(run.map((point) => place(point).split(" ").map(Number)))), ...dots.map(([dx, dy]) => [across(dx), up(dy)])];
    for (const [dx, , range] of [...dots, [own.x, own.y, own.range]]) if (range) taken.push(...steps([[across(dx), up(range[0])], [across(dx), up(range[1])]]));
    const [tx, ty] = freePlace([px, up(own.y)], own.says.length * 8.8, taken);
    shapes.push(draw("text", { class: "own-says middle", x: tx, y: ty, dy: "0.35em" }, own.says));
  }
  const svg = draw("svg", { role: "img", viewBox: `0 0 ${PLOT.width} ${PLOT.height}` }, ...shapes);
  const points = line.flat();
  const values = points.length > 12 ? points.filter((_, i) => i % Math.ceil(points.length / 12) === 0 || i === points.length - 1) : [...points, ...dots];
  const rows = values.map(([px, py]) => make("tr", {}, make("td", {}, number(px)), make("td", {}, number(py))));
  const numbers = make(
    "details", {}, make("summary", {}, "As numbers"),
    make("table", {}, make("caption", {}, title), make("thead", {}, make("tr", {}, make("th", { scope: "col" }, x.label), make("th", { scope: "col" }, y.label))), make("tbody", {}, ...rows)),
  );
  return make("figure", { class: "plot" }, make("h3", {}, title), svg, make("figcaption", {}, note), numbers);
}

/** Places along a broken line, at most 4 apart. */
function steps(run) {
  return run.flatMap((point, i) => {
    const [x, y] = run[i - 1] || point;
    const count = Math.max(1, Math.ceil(Math.hypot(point[0] - x, point[1] - y) / 4));
    return Array.from({ length: count }, (_, k) => [x + ((point[0] - x) * (k + 1)) / count, y + ((point[1] - y) * (k + 1)) / count]);
  });
}

/** The middle of a label of this width near a mark: the nearest place that covers nothing of what is `taken`, or as little as can be. */
function freePlace([x, y], width, taken) {
  const [half, high] = [width / 2 + 4, 11];
  let best = null;
  for (const away of [0, 12, 26, 44, 66, 92]) {
    for (let k = 0; k < 16; k += 1) {
      const turn = (2 * Math.PI * k) / 16 - Math.PI / 4;
      const tx = x + (half + 8 + away) * Math.cos(turn);
      const ty = y + (high + 8 + away) * Math.sin(turn);
      const inside = tx - half >= PLOT.left && tx + half <= PLOT.width && ty - high >= 0 && ty + high <= PLOT.height - PLOT.bottom;
      if (!inside) continue;
      const covers = taken.filter(([px, py]) => Math.abs(px - tx) < half + 3 && Math.abs(py - ty) < high + 3).length + (Math.abs(x - tx) < half + 6 && Math.abs(y - ty) < high + 6 ? 9 : 0);
      const cost = covers * 1000 + away + Math.abs(turn + Math.PI / 4) / 100;
      if (best === null || cost < best.cost) best = { cost, at: [tx, ty] };
    }
  }
  return best ? best.at : [x, y - 18];
}

/** The rows in runs of neighbours, no two further apart than `most`; what stands alone is no line. */
function runsOf(rows, most = Infinity) {
  const out = [];
  for (const row of rows) {
    const run = out[out.length - 1];
    if (run && row[0] - run[run.length - 1][0] <= most) run.push(row);
    else out.push([row]);
  }
  return out.filter((run) => run.length > 1);
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
    at("curves-lead").textContent = load && load.pressure_kPa ? "The behaviour of this star at these pressures is unknown." : "Curves need a pressure in [load].";
    return;
  }
  const several_stars = data.parts.length > 1 ? " Star 1; the others differ." : "";
  at("curves-lead").textContent = `One star at ${figure(load.pressure_kPa, "kPa")} unless stated.${several_stars} Dot: this design; bar: its range. Unknown values have no line.`;
  const own = data.prediction.stars[0];
  const force = own.object_force_N;
  const object = objectOf(0);
  const held = object && force !== null && force > 0;
  const says = (range, unit) => (span(range, unit) ? `Range of this design: ${span(range, unit)}.` : "The range of this design is unknown.");
  const percent = (range) => (range ? range.map((end) => 100 * end) : null);
  const banded = (rows, x, range) => rows.filter((row) => row[range]).map((row) => [row[x], ...row[range]]);
  const rangeF = rangeOf(own, "object_force_N");
  const across = (ends) => ends.map((end) => 2 * end);
  const closed = rangeOf(own, "final_radius_mm");
  const rangeR = closed ? across(closed) : null;
  const rangeC = percent(rangeOf(own, "contraction"));
  const known = own.final_radius_mm !== null;
  const plots = [
    chart.by_radius.length > 1 && plot({
      title: "Force by the object's width", x: { label: "object, mm across" }, y: { label: "radial force, N" },
      line: runsOf(chart.by_radius.map((row) => [2 * row.radius_mm, row.force_N])), band: runsOf(banded(chart.by_radius, "radius_mm", "force_range_N").map(([x, ...ends]) => [2 * x, ...ends])),
      own: held ? { x: 2 * object, y: force, range: rangeF, says: figure(force, "N") } : null,
      note: held ? says(rangeF, "N") : "This design's object is not on the curve.",
    }),
    chart.by_pressure.length > 1 && plot({
      title: "Closed width by pressure", x: { label: "pressure, kPa", from: 0 }, y: { label: "closes to, mm across" },
      line: runsOf(chart.by_pressure.map((row) => [row.pressure_kPa, 2 * row.final_radius_mm]), 1.5 * stepOf()), band: runsOf(banded(chart.by_pressure, "pressure_kPa", "radius_range_mm").map(([x, ...ends]) => [x, ...across(ends)]), 1.5 * stepOf()),
      own: known ? { x: load.pressure_kPa, y: 2 * own.final_radius_mm, range: rangeR, says: figure(2 * own.final_radius_mm, "mm") } : null,
      note: says(rangeR, "mm"),
    }),
    chart.by_points.length > 1 && plot({
      title: "Contraction by the number of points", x: { label: "points", whole: true }, y: { label: "contraction, %" },
      dots: chart.by_points.map((row) => [row.points, 100 * row.contraction, percent(row.contraction_range)]),
      own: known ? { x: data.parts[0].points, y: 100 * own.contraction, range: rangeC, says: figure(100 * own.contraction, "%") } : null,
      note: `${says(rangeC, "%")} Radius, width and angle are those of this design.`,
    }),
  ];
  at("plots").append(...plots.filter(Boolean));
}
