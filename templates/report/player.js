// The player: the sheet, the way of the iron over it, and a time that can be moved.

"use strict";

const LAYERS = [
  ["fabric", "Fabric and cut"],
  ["tube", "Tube"],
  ["bands", "Bands"],
  ["twice", "Sealed twice"],
  ["ramps", "Iron goes down, up"],
  ["travels", "Travels"],
  ["labels", "Numbers"],
];

/** One move of the iron, with its time in the whole job. */
function movesOf(programs) {
  const moves = [];
  let start = 0;
  programs.forEach((program, index) => {
    let begin = start;
    let place = [0, 0];
    for (const step of program.steps) {
      const end = start + step.end_s;
      const move = { what: step.do, begin, end, program: index, sheet: program.sheet, seam: step.seam, step };
      if (step.path) {
        move.points = corners(step.path);
        move.from = place;
        place = move.points[move.points.length - 1] || place;
      } else if (step.to) {
        move.from = place;
        place = [step.to[0] / 100, step.to[1] / 100];
      } else {
        move.from = place;
      }
      move.to = place;
      moves.push(move);
      begin = end;
    }
    start += program.time_s;
  });
  return moves;
}

const job = {
  moves: movesOf(data.programs),
  total: totalTime(),
  time: 0,
  sheet: null,
  drawn: new Map(),
  playing: null,
  view: null,
  /** Whether the reader moved the view. */
  isMoved: false,
};

/** The name and the data of a move's seam. */
function seamOf(move) {
  const program = data.programs[move.program];
  const seam = program.seams[move.seam];
  const before = data.programs.slice(0, move.program).reduce((sum, other) => sum + other.seams.length, 0);
  const start = job.moves.find((other) => other.program === move.program && other.seam === move.seam && other.what === "down");
  return { ...seam, order: before + move.seam + 1, start: start ? start.begin : move.begin, load: loadOf(seam) };
}

/** The heaviest load on a seam's sharpest hinges: the tips are inside the inner loop, the corners outside of the outer one. */
function loadOf(seam) {
  const placed = data.sheets.flatMap((sheet) => sheet.stars).find((star) => star.star === seam.star);
  const places = placed ? data.loads[placed.part] || [] : [];
  return places.find((place) => place.place === (seam.loop === "inner" ? "tips" : "corners")) || null;
}

function loadSays(load) {
  if (!load || load.factor === null) return UNKNOWN;
  const force = load.load_N_per_mm === null ? `${number(load.factor)} times pressure and tube width` : figure(load.load_N_per_mm, "N/mm");
  return `${force} at the ${load.place}`;
}

function sheetGroup(sheet) {
  const group = draw("g", { class: "sheet" });
  const layers = Object.fromEntries(LAYERS.map(([name]) => [name, draw("g", { class: `layer ${name}` })]));
  group.append(draw("rect", { class: "page", x: 0, y: -sheet.height_mm, width: sheet.width_mm, height: sheet.height_mm }));
  for (const star of sheet.stars) {
    const part = data.parts[star.part];
    const place = `translate(${star.x_mm} ${-star.y_mm}) rotate(${-star.turn_deg})`;
    const put = (layer, ...shapes) => layers[layer].append(draw("g", { transform: place }, ...shapes));
    const closed = (steps) => pathOf(corners(steps), true);
    put("fabric", draw("path", { class: "flap", d: closed(part.outside) + (part.insides || [part.hole]).map(closed).join(""), "fill-rule": "evenodd" }));
    put("fabric", ...part.holes.map(([x, y, d]) => draw("circle", { class: "punch", cx: x / 100, cy: -y / 100, r: d / 200 })));
    put("tube", draw("path", { class: "air", d: part.tube.map(closed).join(""), "fill-rule": "evenodd" }));
    layers.labels.append(draw("text", { class: "star-name", x: star.x_mm, y: -star.y_mm, "font-size": sheet.width_mm / 40 }, String(star.star)));
  }
  const moves = job.moves.filter((move) => move.sheet === sheet.sheet);
  const size = sheet.width_mm / 55;
  for (const move of moves) {
    if (move.points) {
      const d = pathOf(move.points, false);
      if (move.what === "seal") sealed(move, d, layers, size);
      else layers.ramps.append(draw("path", { class: "ramp", d }));
    } else if (move.what === "travel") {
      layers.travels.append(draw("path", { class: "travel", d: pathOf([move.from, move.to], false) }));
    }
  }
  group.append(...LAYERS.map(([name]) => layers[name]));
  return group;
}

/** One seam: what will be sealed, what is, and what feels for the pointer. */
function sealed(move, d, layers, size) {
  const seam = seamOf(move);
  const band = data.parts[data.sheets.flatMap((sheet) => sheet.stars).find((star) => star.star === seam.star).part].band_mm;
  const done = draw("path", { class: "done", d, pathLength: 1, "stroke-width": band, "stroke-dasharray": "0 1" });
  const says = `Seam ${seam.order}: ${seamName(seam)}, ${figure(seam.length_mm, "mm", 4)}, ${hours(seam.time_s)}`;
  const feel = draw("path", { class: "feel", d, "stroke-width": Math.max(3 * band, size / 2), tabindex: 0, role: "button", "aria-label": says });
  const show = () => showSeam(move);
  for (const event of ["pointerenter", "focus"]) feel.addEventListener(event, show);
  feel.addEventListener("keydown", (event) => {
    if (event.key === "Enter") goTo(seam.start);
  });
  feel.addEventListener("dblclick", () => goTo(seam.start));
  layers.bands.append(draw("path", { class: "open", d, "stroke-width": band }), done, feel);
  if (seam.overlap_mm > 0) {
    const before = seam.length_mm - seam.overlap_mm;
    layers.twice.append(draw("path", { class: "again", d, pathLength: seam.length_mm, "stroke-dasharray": `0 ${before} ${seam.overlap_mm}`, "stroke-width": band }));
  }
  const [x, y] = move.points[0];
  layers.labels.append(
    draw("circle", { class: "start", cx: x, cy: -y, r: size * 0.62 }),
    draw("text", { class: "order", x, y: -y, "font-size": size * 0.8, dy: "0.35em" }, String(seam.order)),
  );
  job.drawn.set(move, { done, feel });
}

function showSeam(move) {
  const seam = seamOf(move);
  for (const [other, { feel }] of job.drawn) feel.classList.toggle("on", other === move);
  document.querySelectorAll("#seams tbody tr").forEach((row, i) => row.classList.toggle("on", i + 1 === seam.order));
  at("seam-says").replaceChildren(
    make("b", {}, `Seam ${seam.order}: ${seamName(seam)}`),
    make("span", {}, `${figure(seam.length_mm, "mm", 4)} in ${hours(seam.time_s)} at ${speedOf(seam)}${seam.overlap_mm > 0 ? `, of which ${figure(seam.overlap_mm, "mm")} twice` : ""}`),
    KIND === "star" ? make("span", {}, `Load on the seal: ${loadSays(seam.load)}`) : "",
  );
}

/** Where the iron is at a time, and in which move. */
function ironAt(time) {
  const moves = job.moves;
  let low = 0;
  let high = moves.length - 1;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (moves[middle].end <= time) low = middle + 1;
    else high = middle;
  }
  const move = moves[low];
  const share = move.end > move.begin ? Math.min(1, Math.max(0, (time - move.begin) / (move.end - move.begin))) : 1;
  return { move, share };
}

/** A point at a share of the way along a move. */
function along(move, share) {
  if (!move.points) return [0, 1].map((k) => move.from[k] + (move.to[k] - move.from[k]) * share);
  const { points } = move;
  if (!move.ways) {
    move.ways = [0];
    for (let i = 1; i < points.length; i += 1) move.ways.push(move.ways[i - 1] + Math.hypot(points[i][0] - points[i - 1][0], points[i][1] - points[i - 1][1]));
  }
  const way = share * move.ways[move.ways.length - 1];
  let i = move.ways.findIndex((end) => end >= way);
  if (i < 1) i = Math.min(1, points.length - 1);
  const length = move.ways[i] - move.ways[i - 1];
  const part = length > 0 ? (way - move.ways[i - 1]) / length : 0;
  return [0, 1].map((k) => points[i - 1][k] + (points[i][k] - points[i - 1][k]) * part);
}

const DOING = {
  height: "The iron moves up or down.",
  heat: "The iron heats up; the machine waits for you.",
  pause: "The machine waits for you.",
  cool: "The seam cools.",
  travel: "The iron travels above the fabric.",
  down: "The iron goes down along the seam.",
  seal: "The iron seals.",
  up: "The iron goes up along the seam.",
};

function goTo(time) {
  job.time = Math.min(job.total, Math.max(0, time));
  const { move, share } = ironAt(job.time);
  if (move.sheet !== job.sheet) showSheet(move.sheet);
  for (const [other, { done }] of job.drawn) {
    const part = job.time >= other.end ? 1 : job.time <= other.begin ? 0 : (job.time - other.begin) / (other.end - other.begin);
    done.setAttribute("stroke-dasharray", `${part} 1`);
  }
  const [x, y] = along(move, share);
  job.iron.setAttribute("transform", `translate(${x} ${-y})`);
  job.iron.classList.toggle("hot", Boolean(move.points));
  at("job-time").value = String(job.time);
  const says = `${hours(job.time)} of ${hours(job.total)}`;
  at("job-time").setAttribute("aria-valuetext", says);
  at("job-clock").textContent = says;
  const program = data.programs[move.program];
  const seam = move.points ? seamOf(move) : null;
  const where = seam ? ` Seam ${seam.order}, ${seamName(seam)}, ${Math.round(share * 100)} %.` : "";
  const whole = data.programs.length > 1 ? `Program ${move.program + 1} of ${data.programs.length} (${stars(program.stars)}). ` : "";
  at("job-now").textContent = `${whole}${DOING[move.what]}${where}`;
}

function showSheet(number) {
  job.sheet = number;
  const sheet = data.sheets.find((other) => other.sheet === number);
  for (const child of [...at("job").children]) if (child.tagName !== "title") child.remove();
  job.drawn.clear();
  const edge = 0.03 * sheet.width_mm;
  job.whole = [-edge, -sheet.height_mm - edge, sheet.width_mm + 2 * edge, sheet.height_mm + 2 * edge];
  job.parts = partsOf(sheet);
  const size = sheet.width_mm / 70;
  job.iron = draw("g", { class: "iron" }, draw("circle", { r: size, class: "halo" }), draw("circle", { r: size * 0.45 }));
  at("job").append(sheetGroup(sheet), job.iron);
  at("job-title").textContent = `Sheet ${number} of ${data.sheets.length}, seen from the iron's side: ${stars(sheet.stars.map((star) => star.star))}`;
  job.isMoved = false;
  look(job.parts);
}

/** The box around all that lies on a sheet, hoses' channels and the iron's ramps among it, with a border. */
function partsOf(sheet) {
  const box = [Infinity, Infinity, -Infinity, -Infinity];
  const take = ([x, y]) => {
    [box[0], box[1]] = [Math.min(box[0], x), Math.min(box[1], y)];
    [box[2], box[3]] = [Math.max(box[2], x), Math.max(box[3], y)];
  };
  for (const star of sheet.stars) {
    const turn = (star.turn_deg * Math.PI) / 180;
    for (const [x, y] of corners(data.parts[star.part].outside)) {
      take([star.x_mm + x * Math.cos(turn) - y * Math.sin(turn), star.y_mm + x * Math.sin(turn) + y * Math.cos(turn)]);
    }
  }
  for (const move of job.moves) if (move.sheet === sheet.sheet && move.points) move.points.forEach(take);
  const [left, bottom, right, top] = box;
  const edge = 0.05 * Math.max(right - left, top - bottom);
  return [left - edge, -top - edge, right - left + 2 * edge, top - bottom + 2 * edge];
}

/** What is zoomed about: the iron once it is at work, else the beginning of the first seam; the middle where that is not in sight. */
function focus() {
  const { move, share } = ironAt(job.time);
  const first = job.moves.find((other) => other.sheet === job.sheet && other.points);
  const [x, y] = move.points ? along(move, share) : first ? first.points[0] : [0, 0];
  const [left, top, width, height] = job.view;
  const seen = x > left && x < left + width && -y > top && -y < top + height;
  return seen ? [x, -y] : [left + width / 2, top + height / 2];
}

/** The caption of a sheet on paper. */
function sheetTitle(sheet) {
  return `Sheet ${sheet.sheet} of ${data.sheets.length}: ${stars(sheet.stars.map((star) => star.star))}`;
}

/** On paper all parts are shown, of every sheet; afterwards all is as before. */
function printAll() {
  let before = null;
  window.addEventListener("beforeprint", () => {
    before = job.view;
    look(job.parts);
    at("job-sheet").textContent = sheetTitle(data.sheets.find((sheet) => sheet.sheet === job.sheet));
    const { drawn } = job;
    job.drawn = new Map();
    at("job-others").replaceChildren(
      ...data.sheets.filter((sheet) => sheet.sheet !== job.sheet).map((sheet) => {
        const says = sheetTitle(sheet);
        const box = partsOf(sheet).map((x) => x.toFixed(2)).join(" ");
        // The layers that are off stay off.
        const shown = { class: at("job").getAttribute("class"), role: "img", viewBox: box };
        return make("figure", {}, draw("svg", shown, draw("title", {}, says), sheetGroup(sheet)), make("figcaption", {}, says));
      }),
    );
    job.drawn = drawn;
  });
  window.addEventListener("afterprint", () => {
    at("job-others").replaceChildren();
    if (before) look(before);
  });
}

/** Shows this part of the sheet. */
function look(box) {
  job.view = box;
  at("job").setAttribute("viewBox", box.map((x) => x.toFixed(2)).join(" "));
}

/** Makes what is seen `factor` times as large, about a point of it. */
function zoom(factor, [x, y] = focus()) {
  const [left, top, width, height] = job.view;
  const most = job.whole[2] * 1.5;
  const scale = Math.min(most / width, Math.max(job.whole[2] / 60 / width, 1 / factor));
  job.isMoved = true;
  look([x - (x - left) * scale, y - (y - top) * scale, width * scale, height * scale]);
}

function move(across, down) {
  job.isMoved = true;
  look([job.view[0] + across * job.view[2], job.view[1] + down * job.view[3], job.view[2], job.view[3]]);
}

/** Plays the job in about a minute and a half. */
function play(on) {
  at("job-play").textContent = on ? "Pause" : "Play";
  at("job-play").setAttribute("aria-pressed", String(on));
  if (job.playing !== null) cancelAnimationFrame(job.playing);
  job.playing = null;
  if (!on) return;
  if (job.time >= job.total) goTo(0);
  let last = null;
  const tick = (now) => {
    if (last !== null) goTo(job.time + ((now - last) / 90000) * job.total);
    last = now;
    if (job.time >= job.total) play(false);
    else job.playing = requestAnimationFrame(tick);
  };
  job.playing = requestAnimationFrame(tick);
}

function showJob() {
  const places = data.sheets.length > 1 ? ` on ${data.sheets.length} sheets` : "";
  const lead = `${several(data.programs.length, "program")}${places}, ${hours(job.total)} in all.`;
  at("seal-lead").append(lead, make("span", { class: "on-screen" }, " Move the time slider, or point at a seam."));
  at("layers").append(
    ...LAYERS.map(([name, says]) => {
      const box = make("input", { type: "checkbox", checked: name !== "travels", "data-layer": name });
      box.addEventListener("change", () => at("job").classList.toggle(`no-${name}`, !box.checked));
      return make("label", {}, box, make("span", {}, says));
    }),
  );
  at("job").classList.add("no-travels");
  seamTable();
  const slider = at("job-time");
  slider.max = String(job.total);
  slider.addEventListener("input", () => {
    play(false);
    goTo(Number(slider.value));
  });
  slider.addEventListener("keydown", (event) => {
    // A step of a thousandth is what the eye sees; of the browser's own there would be none.
    const step = { ArrowRight: 1, ArrowUp: 1, ArrowLeft: -1, ArrowDown: -1, PageUp: 20, PageDown: -20 }[event.key];
    if (!step) return;
    event.preventDefault();
    play(false);
    goTo(job.time + (step * job.total) / 1000);
  });
  at("job-play").addEventListener("click", () => play(job.playing === null));
  at("job-in").addEventListener("click", () => zoom(1.5));
  at("job-out").addEventListener("click", () => zoom(1 / 1.5));
  at("job-fit").addEventListener("click", () => look(job.parts));
  at("job-all").addEventListener("click", () => look(job.whole));
  printAll();
  handleView();
  showSheet(data.sheets[0].sheet);
  goTo(0);
  const first = job.moves.find((other) => other.what === "seal");
  if (first) showSeam(first);
}

function handleView() {
  const svg = at("job");
  const keys = {
    "+": () => zoom(1.5), "=": () => zoom(1.5), "-": () => zoom(1 / 1.5), 0: () => look(job.parts),
    ArrowLeft: () => move(-0.1, 0), ArrowRight: () => move(0.1, 0), ArrowUp: () => move(0, -0.1), ArrowDown: () => move(0, 0.1),
    " ": () => play(job.playing === null),
  };
  svg.addEventListener("keydown", (event) => {
    if (!keys[event.key] || event.ctrlKey || event.metaKey) return;
    event.preventDefault();
    keys[event.key]();
  });
  svg.addEventListener("wheel", (event) => {
    // Without a key held the page scrolls, as it should.
    if (!event.ctrlKey) return;
    event.preventDefault();
    const place = new DOMPoint(event.clientX, event.clientY).matrixTransform(svg.getScreenCTM().inverse());
    zoom(Math.exp(-event.deltaY / 300), [place.x, place.y]);
  }, { passive: false });
  let held = null;
  svg.addEventListener("pointerdown", (event) => {
    held = { x: event.clientX, y: event.clientY, view: job.view };
  });
  svg.addEventListener("pointermove", (event) => {
    if (!held || event.buttons === 0) return;
    const scale = 1 / svg.getScreenCTM().a;
    const [left, top, width, height] = held.view;
    look([left - (event.clientX - held.x) * scale, top - (event.clientY - held.y) * scale, width, height]);
  });
  for (const end of ["pointerup", "pointercancel", "pointerleave"]) svg.addEventListener(end, () => { held = null; });
}

function seamTable() {
  const moves = job.moves.filter((other) => other.what === "seal");
  const rows = moves.map((other) => {
    const seam = seamOf(other);
    const go = make("button", { type: "button", class: "link", "aria-label": `Go to seam ${seam.order}` }, String(seam.order));
    const show = () => showSeam(other);
    go.addEventListener("focus", show);
    go.addEventListener("click", () => {
      play(false);
      goTo(seam.start);
      show();
    });
    const row = [go, String(seam.star), seam.loop, figure(seam.length_mm, "mm", 4), figure(seam.overlap_mm, "mm"), hours(seam.time_s), speedOf(seam)];
    return KIND === "star" ? [...row, loadSays(seam.load)] : row;
  });
  const head = ["Order", "Piece", "Seam", "Length", "Twice", "Time", "Speed"];
  table("seams", KIND === "star" ? ["Order", "Star", "Loop", ...head.slice(3), "Load on the seal"] : head, rows);
}
