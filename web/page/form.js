// The form: a field for every key of the schema. It shows the values of the spec; a changed field changes the text.

/** The sections by importance; other sections of the schema follow. */
const ORDER = ["", "star", "stack", "load", "fabric", "machine", "inlet", "seal", "sheet", "mask", "frame", "cut", "build"];
const OPEN = ["star", "load"];
/** Sections of the form for stars only, and for drawings only. */
const OF_STARS = ["star", "stack", "load", "mask", "frame"], OF_DRAWINGS = ["drawing"];
const QUANTITY = /^\s*([+-]?[0-9.]+(?:[eE][+-]?[0-9]+)?)\s*(\S.*?)\s*$/;

/** An element with properties and children. */
export function element(name, properties = {}, ...children) {
    const made = document.createElement(name);
    for (const [key, value] of Object.entries(properties)) {
        if (key.includes("-") || key === "role") made.setAttribute(key, value);
        else made[key] = value;
    }
    made.append(...children);
    return made;
}

/** Number and unit of "30 mm"; null if the text has neither. */
function quantity(text) {
    const found = QUANTITY.exec(text ?? "");
    return found && Number.isFinite(Number(found[1])) ? { number: Number(found[1]), unit: found[2] } : null;
}

/** Ends and step of a slider around `number`: values to try; the reader of the spec checks the allowed range. */
function around(number, unit) {
    const size = Math.abs(number);
    // Celsius has no natural zero: 100 to 260 C for an iron of 200 C. Above 260 C PTFE decomposes.
    if (unit.endsWith("C") && number > 0) return { min: Math.round(size / 2), max: Math.round(1.3 * size), step: 1 };
    const most = size === 0 ? (unit === "deg" ? 90 : 10) : Number((size * 2.5).toPrecision(1));
    const step = 10 ** (Math.floor(Math.log10(most)) - 2);
    return { min: number < 0 ? -most : 0, max: most, step };
}

/** The meaning of a key, without the sentences about its kind and range, which a message states when necessary. */
const short = (description) => description.replace(/(^|[.;] )(An? [^.;]*?(with its unit|whole number|plain number)|(One|Some) of |Two lengths )[^]*$/, "$1").replace(/[;. ]+$/, ".") || description;

/** A number as text, with six significant digits: no rounding errors of steps. */
const plain = (number) => String(Number(number.toPrecision(6)));

export class Form {
    #fields = new Map();
    #sections = new Map();
    #change;

    /** Fields of `schema` in `root`; `machines` are the profiles; `change(key, value)` receives the new value for the text: TOML, or null. */
    constructor(root, schema, machines, change) {
        this.#change = change;
        const { properties } = schema;
        const sections = { "": { properties: { name: properties.name }, description: "" } };
        for (const [name, section] of Object.entries(properties)) if (section.properties) sections[name] = section;
        const names = [...new Set([...ORDER, ...Object.keys(sections)])].filter((name) => sections[name]);
        for (const name of names) {
            const keys = Object.entries(sections[name].properties).filter(([, { items, type }]) => type !== "object" && (type !== "array" || items?.enum));
            const required = sections[name].required ?? [];
            keys.sort(([a], [b]) => required.includes(b) - required.includes(a));
            const fields = keys.map(([key, property]) => this.#field(name, key, property, machines));
            if (name === "") root.append(...fields);
            else {
                const section = element("details", { open: OPEN.includes(name) }, element("summary", {}, `${name} `, element("small", {}, sections[name].description ?? "")), ...fields);
                this.#sections.set(name, section);
                root.append(section);
            }
        }
    }

    #field(section, key, property, machines) {
        const path = section ? `${section}.${key}` : key, id = `field-${path}`;
        const tell = (value) => this.#change(path, value);
        const words = key.replaceAll("_", " ");
        const about = element("p", { className: "soft", id: `${id}-about`, title: property.description ?? "" }, short(property.description ?? ""));
        const state = element("span", { className: "state" }, "not set");
        const reset = element("button", { type: "button", className: "plain", hidden: true, onclick: () => tell(null) }, "default");
        const choices = path === "machine.profile" ? machines.map(({ name }) => name) : property.enum;
        const box = element("div", { className: "field" });
        let input, slider = null;
        if (property.type === "array") {
            const one = (value) => element("label", { className: "check" }, element("input", { type: "checkbox", value, onchange: () => tell(JSON.stringify(ticked())) }), value);
            input = element("div", { className: "choices", role: "group", "aria-label": words }, ...property.items.enum.map(one));
            const ticked = () => [...input.querySelectorAll("input:checked")].map(({ value }) => value);
        } else if (choices) {
            input = element("select", { id, onchange: () => tell(JSON.stringify(input.value)) }, ...choices.map((name) => element("option", {}, name)));
        } else if (property.type === "boolean") {
            input = element("input", { id, type: "checkbox", onchange: () => tell(String(input.checked)) });
        } else {
            const isNumber = ["integer", "number"].includes(property.type);
            const written = () => (input.value.trim() === "" ? tell(null) : tell(isNumber ? input.value.trim() : JSON.stringify(input.value)));
            input = element("input", { id, autocomplete: "off", spellcheck: false, onchange: written, placeholder: property.examples ? `e.g. ${property.examples[0]}` : "" });
            if (isNumber || property.pattern) {
                slider = element("input", { type: "range", hidden: true, tabIndex: 0, "aria-label": `${words}, slider` });
                slider.oninput = () => {
                    const { unit } = slider.dataset;
                    input.value = plain(Number(slider.value)) + (unit ? ` ${unit}` : "");
                    slider.setAttribute("aria-valuetext", input.value);
                    written();
                };
                slider.onchange = () => this.#slide(path);
            }
        }
        input.setAttribute("aria-describedby", about.id);
        const label = element("label", {}, words);
        if (input.id) label.htmlFor = id;
        box.append(element("div", {}, label, " ", state, reset), input);
        if (slider) about.prepend(slider);
        box.append(about);
        this.#fields.set(path, { box, input, slider, state, reset, property });
        return box;
    }

    /** Sets the ends of a slider for the value in its field. */
    #slide(path) {
        const { input, slider, property } = this.#fields.get(path);
        const isNumber = ["integer", "number"].includes(property.type);
        const found = isNumber ? input.value.trim() !== "" && { number: Number(input.value), unit: "" } : quantity(input.value);
        slider.hidden = !found || !Number.isFinite(found.number);
        if (slider.hidden) return;
        const ends = around(found.number, found.unit);
        if (property.type === "integer") Object.assign(ends, { min: property.minimum ?? 0, max: Math.min(property.maximum ?? 64, Math.max(12, 2 * found.number)), step: 1 });
        else if (property.maximum !== undefined) ends.max = Math.min(ends.max, property.maximum);
        Object.assign(slider, ends);
        slider.dataset.unit = found.unit;
        slider.value = found.number;
        slider.setAttribute("aria-valuetext", input.value);
    }

    /** Shows the values of the spec: settings [{ section, key, value, given }], for a star or for a drawing. A field in use is left alone. */
    show(settings, isDrawn) {
        for (const [name, section] of this.#sections) section.hidden = (isDrawn ? OF_STARS : OF_DRAWINGS).includes(name);
        for (const { section, key, value, given } of settings) {
            const path = section ? `${section}.${key}` : key;
            const field = this.#fields.get(path);
            if (!field) continue;
            const { box, input, slider, state, reset, property } = field;
            const isInUse = [input, slider].includes(document.activeElement);
            if (property.type === "array") {
                const listed = (value ?? "").split(", ");
                for (const one of input.querySelectorAll("input")) one.checked = listed.includes(one.value);
            } else if (property.type === "boolean") {
                input.checked = value === "true";
            } else if (!isInUse || document.activeElement === slider) {
                if (input.tagName === "SELECT" && ![...input.options].some((option) => option.value === value)) input.append(element("option", {}, value ?? ""));
                input.value = value ?? "";
            }
            if (slider && !isInUse) this.#slide(path);
            const isRequired = ["name", "star.points", "star.inner_radius", "star.tube_width", "star.tip_angle"].includes(path);
            state.textContent = given ? "" : value === null ? "not set" : "default";
            reset.textContent = property.default === undefined ? "remove" : "default";
            reset.setAttribute("aria-label", `${reset.textContent} ${key.replaceAll("_", " ")}`);
            reset.hidden = !given || isRequired;
            box.classList.toggle("default", !given);
        }
    }

    /** Marks the fields with faults. */
    mark(faults) {
        const keys = new Set(faults.filter(({ warning }) => !warning).map(({ key }) => key));
        for (const [path, { input }] of this.#fields) {
            if (keys.has(path)) input.setAttribute("aria-invalid", "true");
            else input.removeAttribute("aria-invalid");
        }
    }
}
