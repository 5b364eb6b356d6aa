// The first fault, at the picture: what is wrong, what may be done, and a button for a remedy that was tried and helps.
import { byId, element, prose } from "./dom.js";

const LIKELY = /did you mean (["\u0060])(.+?)\1/;
/** A whole number of a text, never a part of it; its unit; and where both end. */
const NUMBER = String.raw`-?\d+(?:\.\d+)?(?![\d.]*\d)`;
const UNIT = "mm/s|mm|kPa|deg|C|N/mm|MPa|%|N|kg|g|um";
const NUMBER_END = String.raw`(?=[\s,;:.)]|$)`;
const ASSIGNED = new RegExp(String.raw`\u0060?\b([a-z]\w*) = ("[^"\n]*"|${NUMBER}|true|false|\[[^\]\n]*\])\u0060?(?: in \[([a-z.]+)\])?`, "g");
const BOUND = String.raw`(at least|at most|above|below|more than|less than) (${NUMBER})( ?(?:${UNIT}))?${NUMBER_END}`;
const BOUNDED = new RegExp(String.raw`\u0060?\b([a-z]\w*)\u0060? (?:of )?${BOUND}`, "g");
const LIMIT = new RegExp(String.raw`\b${BOUND}`, "g");
const RANGE = new RegExp(String.raw`\bfrom (${NUMBER}(?: ?(?:${UNIT}))?) to (${NUMBER}(?: ?(?:${UNIT}))?)${NUMBER_END}`, "g");

/** Number of proposals that are tried, and of those that are offered. */
const MOST_TRIED = 6, MOST_OFFERED = 3;

/** The texts of a fault that may hold a remedy. */
const remedies = ({ allowed, remedy }) => [allowed, remedy].filter(Boolean).join("; ");

/** A value within a bound, as TOML: the bound itself, or beyond one that is excluded by at least a unit of its third digit. */
function within(word, bound, unit = "") {
    const number = Number(bound), step = 10 ** (Math.floor(Math.log10(Math.abs(number) || 1)) - 2);
    const beyond = ["above", "more than"].includes(word) ? Math.floor(number / step) + 1 : Math.ceil(number / step) - 1;
    const text = (word.startsWith("at ") ? bound : String(Number((beyond * step).toPrecision(6)))) + unit;
    return unit ? JSON.stringify(text) : text;
}

/** The changes that the words of a fault propose, the likeliest first: { label, place, word } for a word in its place, { label, key, value } for a key. */
export function proposals(fault) {
    const { place, key } = fault, text = remedies(fault), list = [];
    const home = key?.split(".").slice(0, -1).join(".");
    const likely = place && LIKELY.exec(text);
    if (likely) list.push({ label: `write ${likely[2]}`, place, word: likely[2] });
    for (const [, name, value, section] of text.matchAll(ASSIGNED)) {
        const sections = [section, home].filter((word) => word !== undefined);
        for (const own of new Set(sections)) list.push({ label: `write ${name} = ${value}`, key: own ? `${own}.${name}` : name, value });
    }
    const propose = (path, value) => list.push({ label: `write ${path.split(".").pop()} = ${value}`, key: path, value });
    for (const [, name, ...bound] of home ? text.matchAll(BOUNDED) : []) propose(`${home}.${name}`, within(...bound));
    // Of the ends of a range the one that is passed.
    const ends = [...text.matchAll(LIMIT)].map(([, ...bound]) => within(...bound));
    for (const [, ...range] of text.matchAll(RANGE)) ends.push(...range.map((end) => (/[a-zA-Z%]/.test(end) ? JSON.stringify(end) : end)));
    const size = (words) => Number.parseFloat(words?.replace('"', "")), present = size(/ is \u0060?(-?[\d.]+)/.exec(fault.found)?.[1]);
    if (Number.isFinite(present)) ends.sort((a, b) => Math.abs(size(a) - present) - Math.abs(size(b) - present)).splice(1);
    for (const end of key ? ends : []) propose(key, end);
    const unit = /is not a unit .*must be one of ([^\s,]+)/.exec(text)?.[1];
    if (key && unit && Number.isFinite(present)) propose(key, JSON.stringify(`${present} ${unit}`));
    if (key && /\bdelete (it|this|\[)/.test(text)) list.push({ label: `delete ${key.split(".").pop()}`, key, value: undefined });
    return list;
}

/** `text` with `word` in the place of a fault; quotes around it are kept. */
function replaced(text, [start, end], word) {
    const quote = /^["']/.exec(text.slice(start, end))?.[0] ?? "";
    return text.slice(0, start) + quote + word + quote + text.slice(end);
}

/** Whether `errors`, those of a text in which `key` has another value, are better than `before`: fewer of the kind of `fault`, not more
 * in all, and none about that value. */
function helps(fault, key, before, errors) {
    const alike = (list) => list.filter((other) => other.code === fault.code && other.key === fault.key).length;
    return alike(errors) < alike(before) && errors.length <= before.length && !errors.some((error) => key && error.key === key);
}

/** The proposals that remove `fault` from the spec `text`, which has the errors `before`: { label, text }, one after the other. */
async function* helpful(fault, text, before, { edit, look }) {
    const labels = new Set();
    for (const { label, place, word, key, value } of proposals(fault).slice(0, MOST_TRIED)) {
        const spec = word === undefined ? (await edit(text, key, value)).spec : replaced(text, place, word);
        if (spec === undefined || spec === text || labels.has(label)) continue;
        const errors = (await look(spec)).faults.filter(({ warning }) => !warning);
        if (!helps(fault, key, before, errors)) continue;
        labels.add(label);
        yield { label, text: spec };
        if (labels.size === MOST_OFFERED) return;
    }
}

export class FaultBox {
    #ask;
    #write;
    #show;
    #faults = [];
    #index = 0;
    /** The text of which the faults are. */
    #text = "";

    /** `ask`: { edit(text, key, value), look(text) }; `write(text)` sets the spec; `show(fault)` goes to its place in the text. */
    constructor(ask, { write, show }) {
        this.#ask = ask;
        this.#write = write;
        this.#show = show;
    }

    /** Shows the errors among `faults` of `text`; hides the box if there are none. */
    show(faults, text) {
        const errors = faults.filter(({ warning }) => !warning);
        byId("fault").hidden = errors.length === 0;
        const isSame = JSON.stringify(errors) === JSON.stringify(this.#faults) && text === this.#text;
        if (isSame) return;
        this.#faults = errors;
        this.#text = text;
        this.#index = 0;
        if (errors.length > 0) this.#draw();
    }

    #draw() {
        const fault = this.#faults[this.#index], count = this.#faults.length, text = this.#text;
        const buttons = element("div", { className: "buttons" });
        if (fault.place) buttons.append(element("button", { type: "button", id: "fault-show", onclick: () => this.#show(fault) }, fault.line ? `Show line ${fault.line}` : "Show"));
        if (count > 1) {
            const next = () => {
                this.#index = (this.#index + 1) % count;
                this.#draw();
            };
            buttons.append(element("button", { type: "button", id: "fault-next", onclick: next }, `${this.#index + 1} of ${count}: next`));
        }
        const why = [fault.allowed, fault.remedy].filter(Boolean).map((words) => element("p", { className: "why" }, ...prose(words)));
        byId("fault").replaceChildren(element("p", {}, element("strong", {}, ...prose(fault.found))), ...why, buttons);
        this.#offer(fault, buttons).catch(() => {}); // another text came
    }

    /** Adds a button for each remedy that helps, before the other buttons. */
    async #offer(fault, buttons) {
        const text = this.#text, [first] = buttons.children;
        for await (const { label, text: mended } of helpful(fault, text, this.#faults, this.#ask)) {
            if (this.#text !== text || this.#faults[this.#index] !== fault) return;
            const button = element("button", { type: "button", className: "remedy", onclick: () => this.#write(mended) }, label);
            if (first) first.before(button);
            else buttons.append(button);
        }
    }
}
