// Words: rounded figures, and the elements that show them.

"use strict";

const data = JSON.parse(document.getElementById("data").textContent);
const UNKNOWN = "unknown";
// A manifest leaves out what a product does not have.
for (const key of ["stars", "plates", "posts", "masks"]) data.bill[key] = data.bill[key] || [];
/** The kind of product: a page about a drawing has its own block. */
const KIND = data.drawing ? "drawing" : "star";
const PIECE = data.drawing ? "piece" : "star";

/** The element with this id. */
function at(id) {
  return document.getElementById(id);
}

/** A new element; what is given as children is text or other elements, never markup. */
function make(tag, attributes, ...children) {
  return filled(document.createElement(tag), attributes, children);
}

/** A new element of a drawing; its namespace is taken from the page's own drawings. */
function draw(tag, attributes, ...children) {
  return filled(document.createElementNS(at("job").namespaceURI, tag), attributes, children);
}

function filled(element, attributes, children) {
  for (const [key, value] of Object.entries(attributes || {})) {
    if (value !== null && value !== undefined && value !== false) element.setAttribute(key, value === true ? key : String(value));
  }
  element.append(...children.filter((child) => child !== null && child !== undefined));
  return element;
}

/** A number to `digits` significant digits; a value that is exact with fewer, as 0.3, has no trailing zeros. */
function number(value, digits = 3) {
  if (value === 0) return "0";
  const size = Math.floor(Math.log10(Math.abs(value)));
  const decimals = Math.min(6, Math.max(0, digits - 1 - size));
  const text = value.toFixed(decimals);
  const exact = Math.abs(Number(text) - value) <= 1e-9 * Math.abs(value);
  return (exact ? String(Number(text)) : text).replace("-", "−");
}

/** A number with its unit; "unknown" where there is none. */
function figure(value, unit, digits) {
  if (value === null || value === undefined) return UNKNOWN;
  return unit ? `${number(value, digits)}${unit === "°" ? "" : " "}${unit}` : number(value, digits);
}

/** From ... to ..., with the unit once; `null` where it is unknown. */
function span(range, unit, digits = 3) {
  if (!range || range.some((end) => end === null)) return null;
  return `${number(range[0], digits)} to ${figure(range[1], unit, digits)}`;
}

/** Seconds as hours and minutes. */
function hours(seconds) {
  const minutes = Math.round(seconds / 60);
  const rest = minutes % 60;
  if (minutes < 60) return `${minutes} min`;
  return `${Math.floor(minutes / 60)} h ${String(rest).padStart(2, "0")} min`;
}

/** A word for one or several. */
function several(count, one, many = `${one}s`) {
  return `${count} ${count === 1 ? one : many}`;
}

/** "1, 2 and 3". */
function listed(words) {
  return words.length < 2 ? words.join("") : `${words.slice(0, -1).join(", ")} and ${words[words.length - 1]}`;
}

/** "stars 1 to 3", "star 2". */
function stars(numbers) {
  const [first] = numbers;
  const last = numbers[numbers.length - 1];
  if (numbers.length === 1) return `${PIECE} ${first}`;
  return last - first + 1 === numbers.length ? `${PIECE}s ${first} to ${last}` : `${PIECE}s ${listed(numbers)}`;
}

/** The range of a quantity in the prediction, of one of its hinges if it has two; `null` where there is none. */
function rangeOf(prediction, quantity, hinge) {
  const range = prediction && prediction.ranges ? prediction.ranges[quantity] : null;
  if (!range) return null;
  return hinge ? range[hinge] || null : range;
}

/** The radius of the object where a star of the stack meets it, mm, from its prediction; `null` where it passes it, or without an object. */
function objectOf(which) {
  if (!data.load || !data.load.object_radius_mm) return null;
  const placed = data.sheets.flatMap((sheet) => sheet.stars).find((other) => other.part === which);
  const own = data.prediction && placed ? data.prediction.stars[placed.star - 1].object_radius_mm : undefined;
  return (own === undefined || own === null ? data.load.object_radius_mm : own) || null;
}

/** Temperature and speed of sealing; of several processes each, in the order of sealing. */
function sealedAt() {
  const { processes, seal } = data;
  if (!processes) return `${seal.temperature} and ${seal.speed}`;
  return processes.map((other) => `${other.temperature} and ${other.speed} (${other.name}, ${hours(other.time_s)})`).join(", then ");
}

/** The speed of a seam. */
function speedOf(seam) {
  const process = (data.processes || []).find((other) => other.name === seam.process);
  return process ? `${process.speed} (${process.name})` : data.seal.speed;
}

/** What a seam is called, with its piece. */
function seamName(seam) {
  return KIND === "star" ? `${seam.loop} loop of star ${seam.star}` : `${seam.loop || "seam"} of piece ${seam.star}`;
}

/** Hides what pages about another product have. */
function showKind() {
  for (const element of document.querySelectorAll("[data-only]")) element.hidden = element.dataset.only !== KIND;
  if (KIND === "drawing") document.querySelector(".kind").textContent = "Report";
}

/** A sentence of the program: what stands in backticks is shown as code. */
function prose(text) {
  return text.split("`").map((part, i) => (i % 2 === 1 ? make("code", {}, part) : part));
}

/** Fills a table: a head, and rows whose first cell names them. */
function table(id, head, rows) {
  const cell = (tag, text, i, scope) => make(tag, { scope, "data-head": scope === "col" ? null : head[i] }, ...(Array.isArray(text) ? text : [text]));
  at(id).append(
    make("thead", {}, make("tr", {}, ...head.map((text, i) => cell("th", text, i, "col")))),
    make("tbody", {}, ...rows.map((row) => make("tr", {}, ...row.map((text, i) => (i === 0 ? cell("th", text, i, "row") : cell("td", text, i)))))),
  );
}

/** Marks every box that scrolls sideways, as long as part of it is hidden. */
function hintScrolling() {
  for (const box of document.querySelectorAll(".scroll")) {
    const look = () => box.classList.toggle("more", box.scrollLeft + box.clientWidth < box.scrollWidth - 8);
    box.addEventListener("scroll", look, { passive: true });
    new ResizeObserver(look).observe(box);
  }
}
