// Fields: one control for a key of the schema, with a slider where it is a quantity.
import { element } from "./dom.js";

const QUANTITY = /^\s*([+-]?[0-9.]+(?:[eE][+-]?[0-9]+)?)\s*(\S.*?)\s*$/;

/** Number and unit of "30 mm"; null if the text has neither. */
function quantity(text) {
    const parts = QUANTITY.exec(text ?? "");
    return parts && Number.isFinite(Number(parts[1])) ? { number: Number(parts[1]), unit: parts[2] } : null;
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

const REQUIRED = ["name", "star.points", "star.inner_radius", "star.tube_width", "star.tip_angle"];

export class Field {
    #path;
    #property;
    #input;
    #slider = null;
    #state = element("span", { className: "state" });
    #tell;
    /** The value that the spec has: a text that differs from it is being typed. */
    #shown = "";

    /** A field for the key `path`; `tell(value, isDragged)` receives a new value: TOML, or null for the default. `choices` replaces those of the schema. */
    constructor(path, property, { tell, settle, words = path.split(".").pop().replaceAll("_", " "), choices = property.enum }) {
        this.#path = path;
        this.#property = property;
        this.#tell = tell;
        const id = `field-${path}`, about = element("p", { className: "about", id: `${id}-about` }, short(property.description ?? ""));
        this.#input = this.#control(id, words, choices);
        this.#input.setAttribute("aria-describedby", about.id);
        const label = element("label", {}, words);
        if (this.#input.id) label.htmlFor = id;
        if (this.#isNumber || property.pattern) this.#addSlider(words, settle);
        const left = element("div", {}, label, ...(this.#slider ? [this.#slider] : []));
        this.box = element("div", { className: "field" }, left, element("div", {}, this.#input, this.#state), about);
    }

    get #isNumber() {
        return ["integer", "number"].includes(this.#property.type);
    }

    #control(id, words, choices) {
        const { type, items, examples } = this.#property;
        if (type === "array") {
            const ticked = () => [...group.querySelectorAll("input:checked")].map(({ value }) => value);
            const choice = (value) => element("label", { className: "check" }, element("input", { type: "checkbox", value, onchange: () => this.#tell(JSON.stringify(ticked())) }), value);
            const group = element("div", { className: "choices", role: "group", "aria-label": words }, ...items.enum.map(choice));
            return group;
        }
        if (choices) {
            const changed = ({ target }) => this.#tell(target.value === "" ? null : JSON.stringify(target.value));
            return element("select", { id, onchange: changed }, ...choices.map((choice) => (Array.isArray(choice) ? element("option", { value: choice[0] }, choice[1]) : element("option", {}, choice))));
        }
        if (type === "boolean") return element("input", { id, type: "checkbox", onchange: ({ target }) => this.#tell(String(target.checked)) });
        return element("input", { id, autocomplete: "off", spellcheck: false, onchange: () => this.#write(false), placeholder: examples ? `e.g. ${examples[0]}` : "" });
    }

    #write(isDragged) {
        const text = this.#input.value.trim();
        this.#tell(text === "" ? null : this.#isNumber ? text : JSON.stringify(this.#input.value), isDragged);
    }

    #addSlider(words, settle) {
        this.#slider = element("input", { type: "range", hidden: true, "aria-label": `${words}, slider` });
        this.#slider.oninput = () => {
            const { unit } = this.#slider.dataset;
            this.#input.value = plain(Number(this.#slider.value)) + (unit ? ` ${unit}` : "");
            this.#slider.setAttribute("aria-valuetext", this.#input.value);
            this.#write(true);
        };
        this.#slider.onchange = () => {
            this.#slide();
            settle();
        };
    }

    /** Sets the ends of the slider for the value in its field. */
    #slide() {
        const { minimum, maximum, type } = this.#property, text = this.#input.value;
        const value = this.#isNumber ? text.trim() !== "" && { number: Number(text), unit: "" } : quantity(text);
        this.#slider.hidden = !value || !Number.isFinite(value.number);
        if (this.#slider.hidden) return;
        const ends = around(value.number, value.unit);
        if (type === "integer") Object.assign(ends, { min: minimum ?? 0, max: Math.min(maximum ?? 64, Math.max(12, 2 * value.number)), step: 1 });
        else if (maximum !== undefined) ends.max = Math.min(ends.max, maximum);
        Object.assign(this.#slider, ends);
        this.#slider.dataset.unit = value.unit;
        this.#slider.value = value.number;
        this.#slider.setAttribute("aria-valuetext", text);
    }

    /** Whether a text is being typed here that the spec does not have yet. */
    get isTyped() {
        return document.activeElement === this.#input && this.#input.tagName === "INPUT" && this.#input.value !== this.#shown;
    }

    /** Shows the value of the spec, which is `given` or a default; a field in use is left alone. */
    show({ value, given }) {
        const isInUse = [this.#input, this.#slider].includes(document.activeElement), input = this.#input;
        if (this.#property.type === "array") {
            const listed = (value ?? "").split(", ");
            for (const box of input.querySelectorAll("input")) box.checked = listed.includes(box.value);
        } else if (this.#property.type === "boolean") {
            input.checked = value === "true";
        } else if (!this.isTyped) {
            if (input.tagName === "SELECT" && ![...input.options].some((option) => option.value === (value ?? ""))) input.append(element("option", {}, value ?? ""));
            input.value = value ?? "";
        }
        this.#shown = value ?? "";
        if (this.#slider && !(isInUse && document.activeElement === this.#slider)) this.#slide();
        this.box.classList.toggle("default", !given);
        this.#state.replaceChildren();
        if (!given || REQUIRED.includes(this.#path) || input.tagName === "SELECT") return;
        const words = this.#property.default === undefined ? "remove" : "default";
        this.#state.append(element("button", { type: "button", className: "plain", "aria-label": `${words} ${this.#path.split(".").pop().replaceAll("_", " ")}`, onclick: () => this.#tell(null) }, words));
    }

    /** Marks the field if it has a fault. */
    mark(isFaulty) {
        if (isFaulty) this.#input.setAttribute("aria-invalid", "true");
        else this.#input.removeAttribute("aria-invalid");
    }
}
