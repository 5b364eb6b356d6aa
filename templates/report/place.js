// Place: inside another page the report keeps scroll, sliders and views when a new report replaces it; that page stores them.

"use strict";

/** The controls that have a place: sliders, choices, and boxes of layers and groups. */
function controls() {
  return [...document.querySelectorAll("input[type=range], select, input[data-layer], input[data-group]")];
}

/** What identifies a control in every report. */
function controlName({ id, dataset }) {
  return id || `${dataset.layer || ""}/${dataset.group || ""}`;
}

/** The place: scroll, values of controls, the part of the sheet in sight, the view of the scene. */
function place() {
  const values = controls().map((one) => [controlName(one), one.type === "checkbox" ? one.checked : one.max ? Number(one.value) / Number(one.max) : one.value]);
  return { scroll: window.scrollY, values, sheet: job.sheet, view: job.isMoved ? job.view : null, solid: { yaw: solid.yaw, pitch: solid.pitch, near: solid.near } };
}

/** Takes the place of another report, as far as this one has it. */
function takePlace({ scroll, values, view, solid: eye }) {
  const known = new Map(values);
  for (const one of controls()) {
    const value = known.get(controlName(one));
    if (value === undefined) continue;
    if (one.type === "checkbox") one.checked = value;
    else one.value = one.max ? String(value * Number(one.max)) : value;
    one.dispatchEvent(new Event(one.type === "range" ? "input" : "change"));
  }
  if (view) look(view);
  Object.assign(solid, eye);
  paint();
  window.scrollTo({ top: scroll, behavior: "instant" });
}

/** Tells the page around this one that the report can be shown, and where its reader is. */
function keepPlace() {
  if (window.parent === window) return;
  const tell = (message) => window.parent.postMessage(message, "*");
  let waiting = null;
  const told = () => {
    clearTimeout(waiting);
    waiting = setTimeout(() => tell({ report: "place", place: place() }), 100);
  };
  window.addEventListener("message", ({ source, data: message }) => {
    if (source !== window.parent || !message) return;
    document.body.classList.toggle("only-solid", Boolean(message.solid));
    if ("place" in message) {
      if (message.place) takePlace(message.place);
      tell({ report: "placed" });
    }
  });
  for (const event of ["scroll", "input", "change", "pointerup", "keyup", "wheel"]) window.addEventListener(event, told, { passive: true, capture: true });
  tell({ report: "ready" });
}
