// The form: the values that matter for the product first, then all keys in groups; those at their defaults are folded.
import { byId, element, processNames } from "./dom.js";
import { Field } from "./fields.js";

/** For each product the keys that come first, with other words where the key's own say too little; and its groups in order. */
const PRODUCTS = {
    star: {
        first: ["star.points", "star.inner_radius", "star.tube_width", "star.tip_angle", "load.pressure", "machine.profile"],
        groups: ["load", "star", "stack", "fabric", "seal", "press", "machine", "inlet", "sheet", "mask", "frame", "cut", "accuracy", "build"],
        without: [],
    },
    drawing: {
        first: ["load.pressure", "machine.profile", "seal.band", "fabric.seal_strength", "sheet.copies"],
        groups: ["drawing", "seal", "press", "fabric", "machine", "inlet", "mask", "sheet", "cut", "accuracy", "build"],
        without: ["inlet.length", "inlet.tip", "inlet.fillet", "inlet.none", "seal.hole_allowance", "mask.extent", "mask.border", "mask.mirror", "mask.thickness", "mask.bed"],
    },
};
const TITLES = { load: "Object and pressure", star: "Star", stack: "Stack", fabric: "Fabric", seal: "Sealing", press: "Heat press", machine: "Machine", inlet: "Hose", sheet: "Sheet", mask: "Mask", frame: "Frame", cut: "Cutting", accuracy: "Accuracy", build: "Files", drawing: "Drawing" };
/** The sections that have a place here; others of the schema come behind them. */
const PLACED = Object.values(PRODUCTS).flatMap(({ groups }) => groups);
/** The profile among the values: whatever is no press has an iron or a laser, the machine of which has a choice of its own above. */
const SEALED_BY = { words: "sealed by", choices: [["", "iron or laser"], ["press", "heat press"]] };

export class Form {
    #schema;
    #tell;
    #settle;
    /** The product and its processes, of which the form is made. */
    #layout = "";
    #fields = new Map();
    #groups = [];

    /** Fields of `schema`; `change(key, value, kind)` receives a new value for the text: TOML, or null; `settle` ends a step. */
    constructor(schema, { change, settle }) {
        this.#schema = schema;
        this.#tell = change;
        this.#settle = settle;
    }

    /** The keys of a section, each with its property; a process has those of all processes. */
    #keys(section) {
        const { properties } = this.#schema;
        return (section.startsWith("process.") ? properties.process.additionalProperties : properties[section])?.properties ?? {};
    }

    /** The field of a key; undefined if it has none. */
    #make(path) {
        const end = path.lastIndexOf("."), key = path.slice(end + 1);
        const property = end > 0 ? this.#keys(path.slice(0, end))[key] : this.#schema.properties[key];
        // A list whose order or number counts is text.
        const isText = property?.type === "object" || (property?.type === "array" && !(property.items?.enum && property.uniqueItems));
        if (!property || isText) return undefined;
        const tell = (value, isDragged = false) => this.#tell(path, value, isDragged ? `slide ${path}` : null);
        const field = new Field(path, property, { tell, settle: this.#settle, ...(path === "machine.profile" && SEALED_BY) });
        this.#fields.set(path, field);
        return field;
    }

    /** Makes the form of a product: the first fields, then the groups; each of the `processes` has one behind [seal]. */
    #build(product, processes) {
        this.#fields.clear();
        const { first, groups, without } = PRODUCTS[product];
        const top = ["name", ...first].map((path) => this.#make(path)).filter(Boolean);
        const all = [...groups, ...Object.keys(this.#schema.properties).filter((section) => !PLACED.includes(section))];
        const sections = all.flatMap((section) => (section === "seal" ? [section, ...processes] : [section]));
        this.#groups = sections.filter((section) => Object.keys(this.#keys(section)).length > 0).map((section) => {
            const keys = Object.keys(this.#keys(section)).map((key) => `${section}.${key}`);
            const fields = keys.filter((path) => !first.includes(path) && !without.includes(path)).map((path) => [path, this.#make(path)]).filter(([, field]) => field);
            const count = element("small"), given = element("div"), rest = element("div"), more = element("summary");
            const folded = element("details", {}, more, rest);
            const box = element("details", {}, element("summary", {}, TITLES[section] ?? (section.charAt(0).toUpperCase() + section.slice(1)).replace(".", " "), count), given, folded);
            return { section, fields: new Map(fields), box, count, given, rest, more, folded };
        });
        byId("form").replaceChildren(...top.map(({ box }) => box), ...this.#groups.map(({ box }) => box));
    }

    /** Shows the values of the spec: settings [{ section, key, value, given }], for a star or for a drawing. */
    show(settings, isDrawn) {
        const product = isDrawn ? "drawing" : "star";
        const processes = processNames(settings).map((name) => `process.${name}`);
        const layout = [product, ...processes].join();
        if (layout !== this.#layout) this.#build(product, processes);
        this.#layout = layout;
        const given = new Set();
        for (const setting of settings) {
            const path = setting.section ? `${setting.section}.${setting.key}` : setting.key, field = this.#fields.get(path);
            if (!field) continue;
            const value = path === "machine.profile" && !/^press$|\.toml$/.test(setting.value) ? "" : setting.value;
            field.show({ ...setting, value });
            if (setting.given) given.add(path);
        }
        // A process lists the keys that it has: all others are those of [seal].
        for (const [path, field] of this.#fields) if (path.startsWith("process.") && !given.has(path)) field.show({ value: "", given: false });
        for (const group of this.#groups) this.#fold(group, given);
    }

    /** Puts the fields of a group that are given before those at their defaults. A field in use stays where it is. */
    #fold({ fields, count, given, rest, more, folded, box }, paths) {
        for (const [path, field] of fields) {
            const home = paths.has(path) ? given : rest;
            if (field.box.parentElement !== home && !field.box.contains(document.activeElement)) home.append(field.box);
        }
        const own = [...fields.keys()].filter((path) => paths.has(path)).length, others = fields.size - own;
        count.textContent = own > 0 ? `${own} set` : "";
        more.textContent = `${others} at their defaults`;
        more.hidden = own === 0;
        folded.hidden = others === 0;
        if (own === 0) folded.open = true;
        box.hidden = fields.size === 0;
    }

    /** Marks the fields with faults. */
    mark(faults) {
        const keys = new Set(faults.filter(({ warning }) => !warning).map(({ key }) => key));
        for (const [path, field] of this.#fields) field.mark(keys.has(path));
        for (const { fields, box, folded } of this.#groups) {
            const faulty = [...fields.keys()].filter((path) => keys.has(path));
            if (faulty.length === 0) continue;
            box.open = true;
            folded.open = true;
        }
        byId("tab-values").classList.toggle("fault", [...keys].some((key) => this.#fields.has(key)));
    }

    /** Whether the field with the focus has a text that the spec does not have yet. */
    get isTyped() {
        return [...this.#fields.values()].some((field) => field.isTyped);
    }
}
