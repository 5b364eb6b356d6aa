// The text of the spec: an ordinary text field, above a copy that carries line numbers and the marks of faults.
import { element } from "./form.js";

const LINE_HEIGHT = 24, TOP = 12;
const LIKELY = /did you mean [`"]([^`"]+)[`"]/;

export class Editor {
    #area = document.getElementById("spec");
    #mirror = document.getElementById("mirror");
    #callouts = document.getElementById("callouts");
    #list = document.getElementById("faults");
    #count = document.getElementById("fault-count");
    #faults = [];
    /** The faults of the list, as JSON. */
    #shown = "";
    #typed;
    #explain;

    /** `typed` is called after every change by the user; `explain(code)` gives the meaning of a code. */
    constructor(typed, explain) {
        this.#typed = typed;
        this.#explain = explain;
        this.#area.addEventListener("input", () => this.#changed());
        document.addEventListener("selectionchange", () => document.activeElement === this.#area && this.#callout());
        this.#area.addEventListener("scroll", () => this.#area.scrollTo(0, 0));
        this.#area.addEventListener("blur", () => this.#callout());
    }

    get text() {
        return this.#area.value;
    }

    /** Sets another text, which was not typed here; the caret stays where possible. */
    set text(text) {
        if (text === this.#area.value) return;
        const { selectionStart, selectionEnd } = this.#area;
        this.#area.value = text;
        if (document.activeElement === this.#area) this.#area.setSelectionRange(selectionStart, selectionEnd);
        this.#faults = [];
        this.#draw();
    }

    /** Shows the faults of the present text. */
    show(faults) {
        const shown = JSON.stringify(faults);
        if (shown === this.#shown && this.#faults.length === faults.length) return;
        this.#shown = shown;
        this.#faults = faults;
        this.#draw();
        const errors = faults.filter(({ warning }) => !warning).length, warnings = faults.length - errors;
        const some = (number, word) => (number ? [`${number} ${word}${number === 1 ? "" : "s"}`] : []);
        const told = [...some(errors, "error"), ...some(warnings, "warning")].join(", ") || "No faults.";
        if (this.#count.textContent !== told) this.#count.textContent = told;
        this.#list.replaceChildren(...faults.map((fault) => this.#told(fault)));
    }

    #changed() {
        this.#faults = [];
        this.#draw();
        this.#typed();
    }

    /** The copy of the text, one element a line, with its marks. */
    #draw() {
        const text = this.#area.value;
        let at = 0;
        const lines = text.split("\n").map((line) => {
            const own = element("span"), start = at;
            at += line.length + 1;
            let done = 0;
            for (const { place, warning } of this.#faults) {
                if (!place) continue;
                const from = Math.max(place[0] - start, done), to = Math.min(Math.max(place[1], place[0] + 1) - start, line.length);
                const begins = place[0] >= start && place[0] <= start + line.length;
                if (begins) own.className = warning && own.className !== "bad" ? "fair" : "bad";
                if (!begins || to <= from) continue;
                own.append(line.slice(done, from), element("mark", { className: warning ? "warning" : "" }, line.slice(from, to)));
                done = to;
            }
            own.append(line.slice(done));
            return own;
        });
        this.#mirror.replaceChildren(...lines);
        this.#callout();
    }

    /** The fault of the caret's line, or else the first error, under its line. */
    #callout() {
        const isHere = document.activeElement === this.#area;
        const line = this.#area.value.slice(0, this.#area.selectionStart).split("\n").length;
        const placed = this.#faults.filter(({ place }) => place);
        const shown = (isHere && placed.find((fault) => fault.line === line)) || placed.find(({ warning }) => !warning);
        this.#callouts.replaceChildren();
        if (!shown) return;
        const text = [shown.found, shown.allowed, shown.remedy].filter(Boolean).join("; ");
        const box = element("div", { className: shown.warning ? "callout warning" : "callout", "aria-hidden": "true" }, text);
        box.style.top = `${TOP + shown.line * LINE_HEIGHT}px`;
        this.#callouts.append(box);
    }

    /** A fault as an entry of the list: place, found, allowed, remedy. */
    #told(fault) {
        const { code, found, allowed, remedy, line, column, place, warning, file } = fault;
        const where = place ? element("button", { type: "button", className: "plain", onclick: () => this.#go(place) }, `line ${line}, column ${column}`) : file ?? "";
        const entry = element("li", { className: warning ? "warning" : "" }, element("p", {}, where, " ", element("strong", {}, found), " "));
        entry.firstChild.append(element("button", { type: "button", className: "plain", "aria-label": `explain ${code}`, onclick: ({ target }) => this.#meaning(target, code) }, code));
        for (const text of [allowed, remedy]) if (text) entry.append(element("p", {}, text));
        const likely = place && LIKELY.exec(remedy ?? "");
        if (likely) entry.append(element("button", { type: "button", onclick: () => this.#mend(place, likely[1]) }, `write ${likely[1]}`));
        return entry;
    }

    /** The meaning of a code, in the place of the button that asked for it. */
    async #meaning(button, code) {
        const { meaning } = await this.#explain(code).catch(() => ({}));
        button.replaceWith(element("span", {}, `${code}: ${meaning ?? "no explanation"}`));
    }

    #go([start, end]) {
        this.#area.focus();
        this.#area.setSelectionRange(start, end);
        document.getElementById("editor").scrollTop = this.#area.value.slice(0, start).split("\n").length * LINE_HEIGHT - 100;
    }

    /** Writes `word` in the place of the fault; quotes around it are kept. */
    #mend([start, end], word) {
        const old = this.#area.value.slice(start, end), quote = /^["']/.exec(old)?.[0] ?? "";
        this.#area.setRangeText(quote + word + quote, start, end, "end");
        this.#area.focus();
        this.#changed();
    }
}
