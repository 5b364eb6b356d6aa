// The program's answer about the present spec: verdict, picture, numbers; and the files of a proven build.
import { element } from "./form.js";
import { zipped } from "./zip.js";

const byId = (id) => document.getElementById(id);
/** Time for which a saved or printed file stays available, ms. */
const LIFETIME = 60_000;

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
    /** The preview that is shown. */
    #svg = "";
    /** Time of the last change of the spec, ms. */
    #began = 0;

    constructor() {
        byId("zip").addEventListener("click", () => {
            const folder = byId("zip").dataset.folder;
            save(`${folder}.zip`, zipped(folder, this.#files));
        });
    }

    /** Disables downloads until the present text is proven. */
    withdraw() {
        this.#files = [];
        this.#began = performance.now();
        byId("result").classList.add("old");
        byId("zip").disabled = true;
        byId("files").inert = true;
        byId("proof").textContent = "";
    }

    /** Shows an answer: verdict, numbers and picture; without an overview the spec is refused. */
    show({ overview, unfit, files }) {
        byId("anyway-box").hidden = !unfit;
        const verdict = byId("verdict");
        if (!overview) {
            byId("files").classList.add("none");
            verdict.className = "bad";
            verdict.textContent = "Refused. The faults are listed below the spec.";
            return;
        }
        byId("result").classList.remove("old");
        const { holds, in_words } = overview.verdict;
        verdict.className = unfit || holds === false ? "bad" : holds ? "good" : "";
        verdict.textContent = in_words;
        this.#rows(overview);
        byId("precautions").replaceChildren(...overview.before_you_seal.map((text) => element("li", {}, text)));
        byId("before").hidden = overview.before_you_seal.length === 0;
        this.#picture(files.find(({ name }) => name.endsWith("preview.svg")));
    }

    #rows({ rows, sealing_time_s, sheets_mm }) {
        const minutes = Math.round(sealing_time_s / 60);
        const time = `${Math.floor(minutes / 60)} h ${String(minutes % 60).padStart(2, "0")} min, without heating and pauses`;
        const sheets = sheets_mm.map((sides) => sides.map((side) => Math.ceil(side)).join(" x ")).join(", ");
        const all = [...rows, ["sealing", time], ["sheets", `${sheets} mm`]];
        byId("rows").replaceChildren(...all.flatMap(([label, text]) => [element("dt", {}, label), element("dd", {}, text)]));
    }

    #picture(file) {
        const text = file && new TextDecoder().decode(file.bytes);
        if (!file || text === this.#svg) return;
        this.#svg = text;
        const image = byId("preview"), old = image.src;
        image.src = URL.createObjectURL(new Blob([file.bytes], { type: "image/svg+xml" }));
        image.onload = () => {
            performance.mark("preview");
            document.documentElement.dataset.look = Math.round(performance.now() - this.#began);
            if (old) URL.revokeObjectURL(old);
        };
        image.alt = "Sheet with seams, cut and inlet, as it will be sealed";
        image.hidden = false;
        byId("preview-note").textContent = "Sheet 1 as it will be sealed and cut, seen from the iron's side.";
    }

    /** Offers the files of a proven build; `isWanted`: also those of a spec that fails its own load. */
    offer({ files, kinds, proven, unfit, name }, isWanted) {
        if (!proven) {
            byId("files").classList.add("none");
            byId("proof").textContent = unfit && !isWanted ? "No files: this gripper does not do what its own [load] requires." : "No files.";
            return;
        }
        this.#files = files;
        byId("zip").disabled = false;
        byId("zip").dataset.folder = stem(name);
        byId("proof").textContent = `Proven: ${proven}.`;
        byId("files").replaceChildren(...files.map((file) => this.#entry(file, kinds[file.name] ?? "")));
        byId("files").classList.remove("none");
        byId("files").inert = false;
    }

    /** A file of the list. PDFs contain the instruction to print them at their own size. */
    #entry({ name, bytes }, title) {
        const entry = element("li", {}, element("button", { type: "button", className: "plain", title, onclick: () => save(name, bytes) }, name, element("small", {}, size(bytes))));
        if (name.endsWith(".pdf")) {
            const print = () => window.open(address(bytes, "application/pdf"), "_blank");
            entry.append(element("button", { type: "button", className: "plain print", "aria-label": `print 1:1: ${name}`, onclick: print }, "print 1:1"));
        }
        return entry;
    }
}
