// The pictures of the canvas: a sheet with its named seams, or a drawing by the roles of its layers. Sizes of letters and marks are pixels at any zoom.
import { hours, shape } from "./dom.js";
import { measured } from "./measures.js";

/** Width of a letter of a label, px, for labels that keep off each other. */
const LETTER = 7.2;

/** A group at a point whose content is in pixels. */
const pixels = ([x, y], ...content) => shape("g", { transform: `translate(${x} ${y})` }, shape("g", { class: "px" }, ...content));

/** A label of `text` beside a point: `dy` px below it, or where it is free; `rank` decides which of two comes first (the lower one). */
function label(place, text, { className = "", dy = 0, rank = 1 } = {}) {
    const words = shape("text", { class: className }, text), group = pixels(place, words);
    const width = LETTER * text.length + 6, aside = width / 2 + 12, other = -dy || 18;
    const shifts = [[0, dy], [0, other], [aside, 0], [-aside, 0], [0, 2 * other], [aside, other], [-aside, other]];
    Object.assign(group, { label: { place, width, height: 17, rank, shifts, words } });
    return group;
}

/** The words about a seam, for a pointer and for readers of screens. Without a time it has no order: a press seals all at once. */
function seamWords(piece, { name, order, length_mm: length, time_s: time }) {
    const ordinal = `sealed ${order}${["th", "st", "nd", "rd"][order % 10 > 3 || Math.floor((order % 100) / 10) === 1 ? 0 : order % 10]}`;
    return [`${name || "seam"} of ${piece.name}`, ...(time ? [ordinal] : []), `${Math.round(length)} mm`, ...(time ? [hours(time)] : [])].join(", ");
}

/** A piece on its sheet. `hover(element, text)` makes an element tell its name. */
function piece(own, isAlone, hover) {
    const parts = [shape("path", { class: "fabric", d: own.cut, "fill-rule": "evenodd" }), shape("path", { class: "air", d: own.air })];
    const labels = [];
    for (const seam of own.seams) {
        const words = seamWords(own, seam);
        const feel = shape("path", { class: "feel", d: seam.path, tabindex: 0, role: "img", "aria-label": words });
        hover(feel, words);
        parts.push(shape("g", {}, feel, shape("path", { class: "band", d: seam.path, "stroke-width": own.band_mm, "pointer-events": "none" })));
        if (seam.start && seam.time_s) labels.push(Object.assign(pixels(seam.start, shape("circle", { class: "start", r: 8.5, "stroke-width": 1.5 }), shape("text", { class: "order" }, String(seam.order))), { label: { place: seam.start, width: 19, height: 19, rank: 0, shifts: [[0, 0]] } }));
        if (isAlone && seam.name && seam.middle) labels.push(label(seam.middle, seam.name, { dy: -15, rank: 2 }));
    }
    for (const [place, diameter] of own.holes) parts.push(shape("circle", { class: "hole", cx: place[0], cy: place[1], r: diameter / 2 }));
    labels.push(label(own.middle, own.name, { className: "piece", rank: isAlone ? 3 : 1 }));
    for (const port of own.ports) labels.push(label(port, isAlone ? "port" : "inlet", { dy: 16, rank: 4 }));
    return { parts, labels };
}

/** A sheet { width, height, pieces }: { content, labels, box }. */
export function sheetPicture({ width, height, pieces }, isDrawn, hover) {
    const content = [shape("rect", { class: "sheet", x: 0, y: 0, width, height })], labels = [];
    for (const own of pieces) {
        const { parts, labels: more } = piece(own, isDrawn && pieces.length === 1, hover);
        content.push(shape("g", {}, ...parts));
        labels.push(...more);
    }
    labels.push(label([width / 2, height], `${Math.ceil(width)} × ${Math.ceil(height)} mm`, { className: "size", dy: 14, rank: 0 }));
    return { content, labels, box: [0, 0, width, height] };
}

/** The point in the middle of a path of straight lines, by its corners. */
function middle(path) {
    const corners = path.replace("M", "").replace("Z", "").split("L").map((pair) => pair.split(" ").map(Number)), last = corners.length - 1;
    const [start, end] = [corners[Math.floor(last / 2)], corners[Math.ceil(last / 2)]];
    return start.map((value, k) => (value + end[k]) / 2);
}

/** A drawing { box, figures } by its roles, with `faults` that have a place, and the values of `measures`; `choose(figure, element)` is
 * called for a curve that is clicked. */
export function drawingPicture({ box, figures }, { faults, measures }, { hover, choose }) {
    const values = new Map(measures.map((measure) => [measure.measure, measured(measure)]));
    const area = ({ role }) => (role === "air" ? 0 : role === "cut" ? 1 : 2);
    const content = [...figures].sort((a, b) => area(a) - area(b)).map((figure) => {
        const words = [`${figure.id}, layer ${figure.layer}: ${figure.role ?? "without a role"}`, ...(figure.process ? [`process ${figure.process}`] : []), ...(values.get(figure.id) ?? []).map(({ inflated, flat }) => `${inflated} (flat ${flat})`)].join(", ");
        // A point is a line without a length: its round ends are seen.
        const isPoint = !figure.path.includes("L"), line = isPoint ? `${figure.path}l0 0` : figure.path;
        const feel = shape("path", { class: "feel", d: line, tabindex: 0, role: "button", "aria-label": words });
        hover(feel, words);
        feel.addEventListener("click", () => choose(figure, feel));
        feel.addEventListener("keydown", ({ key }) => key === "Enter" && choose(figure, feel));
        return shape("g", {}, feel, shape("path", { class: `figure ${isPoint ? "point " : ""}${figure.role ? `${figure.role}-role` : "no-role"}`, d: line, "pointer-events": "none" }));
    });
    const labels = faults.flatMap(({ at_mm: place, warning, found }, index) => {
        if (!place) return [];
        const mark = shape("circle", { class: warning ? "mark warning" : "mark", r: 10 });
        const group = pixels([place[0], -place[1]], mark, shape("text", { class: "number" }, String(index + 1)));
        group.firstChild.style.pointerEvents = "auto";
        hover(mark, found);
        return [group];
    });
    for (const { id, role, path } of figures) {
        const [first] = (role === "measure" && values.get(id)) || [];
        if (first) labels.push(label(middle(path), `${id}: ${first.inflated}`, { className: "measured", dy: -15 }));
    }
    return { content, labels, box };
}

/** Moves labels that would cover others, and hides those without a free place; `scale` is mm a pixel. */
export function part(labels, scale) {
    const placed = [];
    for (const group of [...labels].filter(({ label }) => label).sort((a, b) => a.label.rank - b.label.rank)) {
        const { place, width, height, shifts, words } = group.label;
        const boxes = shifts.map(([dx, dy]) => ({ dx, dy, x: place[0] / scale + dx, y: place[1] / scale + dy, width, height }));
        const free = boxes.find(({ x, y }) => placed.every((other) => Math.abs(other.x - x) > (other.width + width) / 2 || Math.abs(other.y - y) > (other.height + height) / 2));
        group.style.display = free ? "" : "none";
        if (!free) continue;
        placed.push(free);
        words?.setAttribute("x", free.dx);
        words?.setAttribute("y", free.dy);
    }
}

/** A small picture of a sheet for the list of last specs, { box, cut, air }, with few points; null without a sheet. */
export function smallPicture(sheet) {
    if (!sheet) return null;
    const least = Math.max(sheet.width, sheet.height) / 60;
    const thin = (path) => path.split(/(?=M)/).map((loop) => {
        const points = loop.replace("M", "").replace("Z", "").split("L").map((pair) => pair.split(" ").map(Number));
        let last = [Infinity, Infinity];
        const far = points.filter((point) => Math.hypot(point[0] - last[0], point[1] - last[1]) > least && (last = point));
        return `M${far.map((point) => point.map(Math.round).join(" ")).join("L")}Z`;
    }).join("");
    const all = (key) => thin(sheet.pieces.slice(0, 12).map((own) => own[key]).join(""));
    return { box: [0, 0, Math.round(sheet.width), Math.round(sheet.height)], cut: all("cut"), air: all("air") };
}
