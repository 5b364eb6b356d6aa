// The beginning: from an object to a spec, from a shipped design, from one of the last specs.
import { byId, element, prose, readable, shape } from "./dom.js";
import { shelf } from "./store.js";

const objectForm = () => byId("object-form");
const field = (name) => objectForm().elements.namedItem(name);

/** Requests a gripper with `ask(question)`; `take(spec)` receives the result. */
export async function find(ask, take) {
    const entries = [...objectForm().elements].filter(({ name }) => name);
    for (const { name } of entries) field(name).removeAttribute("aria-invalid");
    const place = byId("object-answer");
    place.textContent = "Searching ...";
    const answer = await ask({ ask: "new", ...Object.fromEntries(entries.map(({ name, value }) => [name, value])) });
    if (!answer) {
        place.textContent = "Stopped.";
        return;
    }
    place.replaceChildren(...result(answer));
    if (answer.spec) take(answer.spec);
}

/** The result of the search, as elements. */
function result({ fields, reasons, nearest, in_words: words, wrong }) {
    if (wrong) return [element("p", { className: "why" }, wrong)];
    if (fields) {
        field(fields[0].field)?.focus();
        return fields.map(({ field: name, found }) => {
            field(name)?.setAttribute("aria-invalid", "true");
            return element("p", { className: "why" }, `${name}: ${found}`);
        });
    }
    if (words) return words.trim().split("\n").map((line) => element("p", {}, ...prose(readable(line.trim()))));
    const list = [element("p", { className: "why" }, "No gripper was found for these requirements:"), element("ul", {}, ...reasons.map((text) => element("li", {}, text)))];
    if (nearest) {
        const values = Object.entries(nearest).filter(([, value]) => value !== null);
        const use = () => {
            for (const [name, value] of values) field(name).value = value;
            objectForm().requestSubmit();
        };
        const named = values.map(([name, value]) => `${name} ${value}`).join(", ");
        list.push(element("p", {}, `The closest that can be made: ${named}. `), element("button", { type: "button", onclick: use }, "Use these values"));
    }
    return list;
}

/** Offers the shipped `designs`, { name: { spec, drawing } }; `take(design)` receives the chosen one. */
export function offerDesigns(designs, take) {
    const group = (label, isDrawn) => {
        const names = Object.keys(designs).filter((name) => Boolean(designs[name].drawing) === isDrawn);
        return element("optgroup", { label }, ...names.map((name) => element("option", { value: name }, name.replaceAll("-", " "))));
    };
    byId("designs").append(group("Star grippers", false), group("Drawings", true));
    byId("designs").addEventListener("change", ({ target }) => {
        const design = designs[target.value];
        target.value = "";
        if (design) take(design);
    });
}

/** Time passed since `time`, in words. */
function ago(time) {
    const minutes = Math.round((Date.now() - time) / 60_000);
    if (minutes < 1) return "just now";
    if (minutes < 60) return `${minutes} min ago`;
    return minutes < 24 * 60 ? `${Math.round(minutes / 60)} h ago` : new Date(time).toLocaleDateString();
}

/** Lists the last specs; `take(entry)` receives the one that is clicked. */
export function listRecent(present, take) {
    const entries = shelf();
    byId("recent").hidden = entries.length === 0;
    byId("recent-list").replaceChildren(...entries.map((entry) => {
        const { picture, name, time, id } = entry;
        const small = picture ? shape("svg", { viewBox: picture.box.join(" "), "aria-hidden": "true" }, shape("path", { d: picture.cut, fill: "var(--flap)", "fill-rule": "evenodd" }), shape("path", { d: picture.air, fill: "var(--air)", "fill-rule": "evenodd" })) : element("span", { className: "blank" });
        const when = id === present ? "on the desk" : ago(time);
        const open = element("button", { type: "button", className: "open", onclick: () => id !== present && take(entry) }, small, element("span", {}, element("b", {}, name), element("small", {}, when)));
        return element("li", { className: "buttons" }, open);
    }));
}

