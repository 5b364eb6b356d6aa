// The program's answer about the present spec in words: verdict, numbers, precautions; and the files of a proven build.
import { byId, element, hours, marked, prose, readable } from "./dom.js";
import { zipped } from "./zip.js";

/** Time for which a saved or printed file stays available, ms. */
const LIFETIME = 60_000;
/** The files by what is done with them, in that order; a kind begins with one of the words. */
const USES = [
    ["Run on the machine: first the trace, in the air", ["trace", "seal-gcode", "seal-3mf", "cut-"]],
    ["Cut", ["outline", "cut", "seal-"]],
    ["Coat, separate, stack", ["mask", "separator", "pieces", "frame", "press"]],
    ["Look at and keep", ["report", "preview", "scene", "surface", "spec", "machine", "drawing", "prediction", ""]],
];

/** A temporary address of `bytes`. */
function address(bytes, type) {
    const url = URL.createObjectURL(new Blob([bytes], { type }));
    setTimeout(() => URL.revokeObjectURL(url), LIFETIME);
    return url;
}

/** Makes the browser save a file. */
export function save(name, bytes) {
    element("a", { href: address(bytes, "application/octet-stream"), download: name }).click();
}

/** A name as a portable file name. */
const stem = (name) => name.toLowerCase().replace(/[^a-z0-9]+/g, "-").replace(/^-+|-+$/g, "") || "star";

const size = ({ length }) => (length < 1000 ? `${length} B` : `${(length / 1000).toPrecision(3)} kB`);

export class Result {
    #files = [];

    constructor() {
        byId("zip").addEventListener("click", () => {
            const folder = byId("zip").dataset.folder;
            save(`${folder}.zip`, zipped(folder, this.#files));
        });
    }

    /** Saves the programs for a sheet that was moved, where `ask(question, files)` makes them of the present files, or tells why there are none. */
    listenMoved(ask) {
        byId("moved-form").addEventListener("submit", async (event) => {
            event.preventDefault();
            const answer = await ask({ ...Object.fromEntries(new FormData(event.target)), sheet: Number(byId("sheets").value) + 1 }, this.#files);
            if (!answer) return;
            const { reason, motion, files } = answer, folder = `${byId("zip").dataset.folder}-aligned`;
            byId("moved-note").textContent = reason ?? `Proven where the sheet lies now; ${motion}.`;
            if (!reason) save(`${folder}.zip`, zipped(folder, files));
        });
    }

    /** Disables downloads until the present text is proven. */
    withdraw() {
        this.#files = [];
        byId("zip").disabled = byId("moved").hidden = true;
        byId("files").inert = true;
        byId("proof").textContent = "";
    }

    /** Shows an answer: verdict and numbers; without an overview the spec is refused. */
    show({ overview, unfit, faults = [] }) {
        byId("anyway-box").hidden = !unfit;
        if (!overview) {
            const errors = faults.filter(({ warning }) => !warning).length;
            byId("proof").textContent = "Not made: the spec is refused.";
            this.#verdict("bad", errors > 1 ? `Refused, for ${errors} reasons` : "Refused", "The picture shows why. The values below are those of before.");
            return;
        }
        const { tone, in_words: words } = overview.verdict;
        const [headline, ...rest] = words.split("; ");
        this.#verdict(tone, readable(headline), readable(rest.join("; ")));
        this.#rows(overview);
        byId("precautions").replaceChildren(...overview.before_you_seal.map((text) => element("li", {}, ...prose(readable(text)))));
        byId("before").hidden = overview.before_you_seal.length === 0;
        byId("pressing").hidden = !overview.press;
        const steps = overview.press?.instructions ?? [];
        byId("steps").replaceChildren(...steps.flatMap(({ heading, lines }) => [element("h3", {}, heading), element("ol", {}, ...lines.map((line) => element("li", {}, ...prose(readable(line)))))]));
        const isDrawn = overview.stars === 0;
        byId("shell-box").hidden = !isDrawn || !overview.prediction;
    }

    #verdict(tone, headline, rest) {
        const verdict = byId("verdict");
        verdict.className = tone;
        verdict.replaceChildren(...prose(headline), ...(rest ? [element("span", {}, ...prose(rest))] : []));
    }

    #rows({ rows, sealing_time_s, sheets_mm, press }) {
        const sheets = sheets_mm.map((sides) => sides.map((side) => Math.ceil(side)).join(" × ")).join(", ");
        const sealing = press ? ["pressing", `${press.pressings === 1 ? "once" : `${press.pressings} times`}, ${press.settings}`] : ["sealing takes", `${hours(sealing_time_s)}; without heating and pauses`];
        const all = [...rows, sealing, [sheets_mm.length > 1 ? "sheets" : "sheet", `${sheets} mm`]];
        byId("rows").replaceChildren(...all.flatMap(([label, text]) => {
            const [value, ...rest] = readable(text).split("; ");
            return [element("dt", {}, label), element("dd", {}, ...marked(value), ...(rest.length ? [element("span", { className: "soft" }, ...prose(rest.join("; ")))] : []))];
        }));
    }

    /** Offers the files of a proven build; `isWanted`: also those of a spec that fails its own load. */
    offer({ files, kinds, proven, unfit, name }, isWanted) {
        if (!proven) {
            byId("files").replaceChildren();
            byId("proof").textContent = unfit && !isWanted ? "No files: this gripper does not do what its own [load] requires." : "No files.";
            return;
        }
        this.#files = files;
        byId("zip").disabled = false;
        byId("moved").hidden = !Object.values(kinds).includes("trace-gcode");
        byId("zip").dataset.folder = stem(name);
        byId("proof").textContent = `Proven: ${proven}.`;
        const rest = new Set(files), groups = USES.map(([use, words]) => {
            const own = words.flatMap((word) => [...rest].filter((file) => (kinds[file.name] ?? "").startsWith(word) && rest.delete(file)));
            return own.length === 0 ? [] : [element("h3", {}, use), element("ul", {}, ...own.map((file) => this.#entry(file)))];
        });
        byId("files").replaceChildren(...groups.flat());
        byId("files").inert = false;
    }

    /** A file of the list. PDFs contain the instruction to print them at their own size. */
    #entry({ name, bytes }) {
        const entry = element("li", {}, element("button", { type: "button", className: "plain", onclick: () => save(name, bytes) }, name, element("small", {}, size(bytes))));
        if (name.endsWith(".pdf")) {
            const print = () => window.open(address(bytes, "application/pdf"), "_blank");
            entry.append(element("button", { type: "button", className: "plain print", "aria-label": `print 1:1: ${name}`, onclick: print }, "print 1:1"));
        }
        return entry;
    }
}
