// The first fault, at the picture: what is wrong, what may be done, and a button for a remedy that was tried and helps.
import { byId, element } from "./dom.js";

const LIKELY = /did you mean (["\u0060])(.+?)\1/;
const ASSIGNED = /`?\b([a-z]\w*) = ("[^"\n]*"|-?[\d.]+|true|false|\[[^\]\n]*\])`?(?: in \[([a-z.]+)\])?/g;
const BOUNDED = /`?\b([a-z]\w*)`? (?:of )?(at least|at most|above|below) (-?[\d.]+)( ?(?:mm\/s|mm|kPa|deg|C|N\/mm|MPa|%|N|kg|g|um))?(?=[\s,;.)]|$)/g;
const LIMIT = /\bat (?:least|most) (-?[\d.]+(?: ?(?:mm\/s|mm|kPa|deg|C|N\/mm|MPa|%|N|kg|g|um))?)(?=[\s,;.)]|$)/g;

/** Number of proposals that are tried, and of those that are offered. */
const MOST_TRIED = 6, MOST_OFFERED = 3;

/** The texts of a fault that may hold a remedy. */
const remedies = ({ allowed, remedy }) => [allowed, remedy].filter(Boolean).join("; ");

/** A number within a limit: the limit itself, or beyond one that is excluded by at least a unit of its third digit. */
function within(word, text) {
    if (word.startsWith("at ")) return text;
    const number = Number(text), step = 10 ** (Math.floor(Math.log10(Math.abs(number) || 1)) - 2);
    return String(Number(((word === "above" ? Math.floor(number / step) + 1 : Math.ceil(number / step) - 1) * step).toPrecision(6)));
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
    for (const [, name, word, number, unit] of home ? text.matchAll(BOUNDED) : []) {
        const value = unit ? JSON.stringify(within(word, number) + unit) : within(word, number);
        list.push({ label: `write ${name} = ${value}`, key: `${home}.${name}`, value });
    }
    for (const [, limit] of key ? text.matchAll(LIMIT) : []) {
        const value = /[a-zA-Z%]/.test(limit) ? JSON.stringify(limit) : limit;
        list.push({ label: `write ${key.split(".").pop()} = ${value}`, key, value });
    }
    if (key && /\bdelete (it|this|\[)/.test(text)) list.push({ label: `delete ${key.split(".").pop()}`, key, value: undefined });
    return list;
}

/** `text` with `word` in the place of a fault; quotes around it are kept. */
function replaced(text, [start, end], word) {
    const quote = /^["']/.exec(text.slice(start, end))?.[0] ?? "";
    return text.slice(0, start) + quote + word + quote + text.slice(end);
}

/** The proposals that remove `fault` from the spec `text`, which has `count` errors, and make not more: { label, text }, one after the other. */
async function* helpful(fault, text, count, { edit, look }) {
    const labels = new Set();
    for (const { label, place, word, key, value } of proposals(fault).slice(0, MOST_TRIED)) {
        const spec = word === undefined ? (await edit(text, key, value)).spec : replaced(text, place, word);
        if (spec === undefined || spec === text || labels.has(label)) continue;
        const errors = (await look(spec)).faults.filter(({ warning }) => !warning);
        const isThere = errors.some(({ code, found }) => code === fault.code && found === fault.found);
        if (isThere || errors.length > count) continue;
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
        const why = [fault.allowed, fault.remedy].filter(Boolean).map((words) => element("p", { className: "why" }, words));
        byId("fault").replaceChildren(element("p", {}, element("strong", {}, fault.found)), ...why, buttons);
        this.#offer(fault, count, buttons).catch(() => {}); // another text came
    }

    /** Adds a button for each remedy that helps, before the other buttons. */
    async #offer(fault, count, buttons) {
        const text = this.#text, [first] = buttons.children;
        for await (const { label, text: mended } of helpful(fault, text, count, this.#ask)) {
            if (this.#text !== text || this.#faults[this.#index] !== fault) return;
            const button = element("button", { type: "button", className: "remedy", onclick: () => this.#write(mended) }, label);
            if (first) first.before(button);
            else buttons.append(button);
        }
    }
}
