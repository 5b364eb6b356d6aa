// The first fault, at the picture: what is wrong, what may be done, and a button for a remedy that was tried and helps.
import { byId, element, paged } from "./dom.js";

const LIKELY = /did you mean [`"]([^`"]+)[`"]/;
const ASSIGNED = /`?\b([a-z]\w*) = ("[^"\n]*"|-?[\d.]+|true|false|\[[^\]\n]*\])`?(?: in \[([a-z.]+)\])?/g;
const LIMIT = /\bat (?:least|most) (-?[\d.]+(?: ?(?:mm\/s|mm|kPa|deg|C|N\/mm|MPa|%|N|kg|g|um))?)(?=[\s,;.)]|$)/g;

/** The texts of a fault that may hold a remedy. */
const remedies = ({ allowed, remedy }) => [allowed, remedy].filter(Boolean).join("; ");

/** The changes that the words of a fault propose, the likeliest first: { label, place, word } for a word in its place, { label, key, value } for a key. */
export function proposals(fault) {
    const { place, key } = fault, text = remedies(fault), list = [];
    const likely = place && LIKELY.exec(text);
    if (likely) list.push({ label: `write ${likely[1]}`, place, word: likely[1] });
    for (const [, name, value, section] of text.matchAll(ASSIGNED)) {
        const sections = [section, key?.split(".").slice(0, -1).join(".")].filter((word) => word !== undefined);
        for (const own of new Set(sections)) list.push({ label: `write ${name} = ${value}`, key: own ? `${own}.${name}` : name, value });
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

/** The first proposal that removes `fault` from the spec `text` and makes no further errors: { label, text }; undefined if none does. */
async function remedy(fault, text, count, { edit, look }) {
    for (const { label, place, word, key, value } of proposals(fault).slice(0, 4)) {
        const spec = word === undefined ? (await edit(text, key, value)).spec : replaced(text, place, word);
        if (spec === undefined || spec === text) continue;
        const errors = (await look(spec)).faults.filter(({ warning }) => !warning);
        const isThere = errors.some(({ code, found }) => code === fault.code && found === fault.found);
        if (!isThere && errors.length < count) return { label, text: spec };
    }
    return undefined;
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
        const why = [fault.allowed, fault.remedy].filter(Boolean).map((words) => element("p", { className: "why" }, paged(words)));
        byId("fault").replaceChildren(element("p", {}, element("strong", {}, paged(fault.found))), ...why, buttons);
        remedy(fault, text, count, this.#ask).then((own) => {
            if (!own || this.#text !== text || this.#faults[this.#index] !== fault) return;
            buttons.prepend(element("button", { type: "button", className: "remedy", onclick: () => this.#write(own.text) }, own.label));
        }).catch(() => {}); // another text came
    }
}
