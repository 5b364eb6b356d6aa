// The text of the spec: an ordinary text field, above a copy that carries line numbers and the marks of faults. The desk undoes, not the browser.
import { byId, element, prose } from "./dom.js";

export class Editor {
    #area = byId("spec");
    #faults = [];
    /** The faults of the list, as JSON. */
    #shown = "";
    #explain;

    /** `typed(text)` is called after every change by the user; `explain(code)` gives the meaning of a code; `settle` ends a step of the
     * history; `undo(by)` undoes or redoes. */
    constructor({ typed, settle, explain, undo }) {
        this.#explain = explain;
        this.#area.addEventListener("input", () => {
            this.#faults = [];
            this.#draw();
            typed(this.#area.value);
        });
        this.#area.addEventListener("change", settle);
        this.#area.addEventListener("beforeinput", (event) => {
            const by = { historyUndo: -1, historyRedo: 1 }[event.inputType];
            if (!by) return;
            event.preventDefault();
            undo(by);
        });
        document.addEventListener("selectionchange", () => document.activeElement === this.#area && this.#callout());
        this.#area.addEventListener("blur", () => this.#callout());
        new ResizeObserver(() => this.#callout()).observe(this.#area);
    }

    /** Shows the text, if it is not typed here; the caret goes to the end of what changed. */
    set text(text) {
        const old = this.#area.value;
        if (text === old) return;
        let start = 0, end = 0;
        while (start < Math.min(text.length, old.length) && text[start] === old[start]) start++;
        while (end < Math.min(text.length, old.length) - start && text.at(-1 - end) === old.at(-1 - end)) end++;
        this.#area.value = text;
        if (document.activeElement === this.#area) this.#area.setSelectionRange(text.length - end, text.length - end);
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
        const some = (number, word) => (number ? [`${number} ${word}${number === 1 ? "" : "s"}, listed below`] : []);
        const count = [...some(errors, "error"), ...some(warnings, "warning")].join("; ") || "No faults.";
        if (byId("fault-count").textContent !== count) byId("fault-count").textContent = count;
        byId("faults").replaceChildren(...faults.map((fault) => this.#entry(fault)));
        byId("tab-text").classList.toggle("fault", errors > 0);
    }

    /** The copy of the text, one element a line, with its marks. */
    #draw() {
        let end = 0;
        const lines = this.#area.value.split("\n").map((line) => {
            const copy = element("span"), start = end;
            end += line.length + 1;
            let done = 0;
            for (const { place, warning } of this.#faults) {
                if (!place) continue;
                const from = Math.max(place[0] - start, done), to = Math.min(Math.max(place[1], place[0] + 1) - start, line.length);
                const begins = place[0] >= start && place[0] <= start + line.length;
                if (begins) copy.className = warning && copy.className !== "bad" ? "fair" : "bad";
                if (!begins || to <= from) continue;
                copy.append(line.slice(done, from), element("mark", { className: warning ? "warning" : "" }, line.slice(from, to)));
                done = to;
            }
            copy.append(line.slice(done));
            return copy;
        });
        byId("mirror").replaceChildren(...lines);
        this.#callout();
    }

    /** The fault of the caret's line, or else the first error, under its line. */
    #callout() {
        const isHere = document.activeElement === this.#area;
        const line = this.#area.value.slice(0, this.#area.selectionStart).split("\n").length;
        const placed = this.#faults.filter(({ place }) => place);
        const shown = (isHere && placed.find((fault) => fault.line === line)) || placed.find(({ warning }) => !warning);
        byId("callouts").replaceChildren();
        const copy = shown && byId("mirror").children[shown.line - 1];
        if (!copy) return;
        const text = [shown.found, shown.allowed, shown.remedy].filter(Boolean).join("; ");
        const box = element("div", { className: shown.warning ? "callout warning" : "callout", "aria-hidden": "true" }, ...prose(text));
        box.style.top = `${copy.offsetTop + copy.offsetHeight}px`;
        byId("callouts").append(box);
    }

    /** A fault as an entry of the list: place, found, allowed, remedy. */
    #entry(fault) {
        const { code, found, allowed, remedy, line, column, place, warning, file } = fault;
        const where = place ? element("button", { type: "button", className: "plain", onclick: () => this.go(place) }, `line ${line}, column ${column}`) : file ?? "";
        const entry = element("li", { className: warning ? "warning" : "" }, element("p", {}, where, " ", element("strong", {}, ...prose(found)), " "));
        entry.firstChild.append(element("button", { type: "button", className: "plain", "aria-label": `explain ${code}`, onclick: ({ target }) => this.#meaning(target, code) }, code));
        for (const text of [allowed, remedy]) if (text) entry.append(element("p", {}, ...prose(text)));
        return entry;
    }

    /** The meaning of a code, in the place of the button that asked for it. */
    async #meaning(button, code) {
        const { meaning } = await this.#explain(code).catch(() => ({}));
        button.replaceWith(element("span", {}, `${code}: ${meaning ?? "no explanation"}`));
    }

    /** Selects the place of a fault and brings it into sight. */
    go([start, end]) {
        this.#area.focus({ preventScroll: true });
        this.#area.setSelectionRange(start, end);
        const line = this.#area.value.slice(0, start).split("\n").length;
        byId("mirror").children[line - 1]?.scrollIntoView({ block: "center" });
    }
}
