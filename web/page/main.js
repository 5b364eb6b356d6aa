// The page: a text, what the program says of it, and ways to change it.
import { Program, Dropped } from "./program.js";
import { Form, element } from "./form.js";
import { Editor } from "./editor.js";
import { zipped } from "./zip.js";
import { fragmentOf, textOf } from "./link.js";
import { keep, kept, forget } from "./kept.js";
import { sorted } from "./opening.js";

/** Wait after the last change before all files are made, ms. */
const PAUSE = 150;

const by = (id) => document.getElementById(id);
const designs = JSON.parse(by("designs-data").textContent);
/** The machine profile and the drawing that were dropped, for a spec that names files. */
let machine, drawing;
let program, form, editor, timer;
/** Files of the last proven build. */
let files = [];

/** Says one line; `isBad` if something went wrong. */
function say(text, isBad = false) {
    by("note").textContent = text;
    by("note").className = isBad ? "bad" : "";
}

/** Runs a piece of work of the page: what breaks is told, and the text stays. */
async function safely(work) {
    try {
        return await work();
    } catch (error) {
        if (error instanceof Dropped) return undefined;
        say(`This broke off: ${error.message}. Your text is kept.`, true);
        return undefined;
    }
}

/** The compiled program: from the page itself, or from the file beside it. It is compiled while it comes. */
async function compiled() {
    const streamed = (body) => WebAssembly.compileStreaming(new Response(body, { headers: { "Content-Type": "application/wasm" } }));
    const own = by("program-data");
    if (!own) {
        const beside = await fetch("stargrip-cam.wasm");
        if (!beside.ok) throw new Error(`the program could not be loaded (${beside.status}); load the page again`);
        navigator.serviceWorker?.register("offline.js").catch(() => {}); // without it the page wants its network
        return streamed(beside.body);
    }
    const packed = Uint8Array.fromBase64?.(own.textContent) ?? Uint8Array.from(atob(own.textContent), (letter) => letter.charCodeAt(0));
    own.remove();
    return streamed(new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip")));
}

/** A quick look at the text as it stands, for which it waits, then all of its files. */
function refresh() {
    const spec = editor.text;
    keep({ text: spec, machine, drawing });
    clearTimeout(timer);
    by("result").classList.add("old");
    withdraw();
    const began = performance.now();
    return safely(async () => {
        const answer = await program.ask({ ask: "build", spec, machine, only: ["preview-svg"], prove: false }, { files: drawings(), lane: "look" });
        if (editor.text !== spec) return;
        show(answer);
        document.documentElement.dataset.look = Math.round(performance.now() - began);
        if (answer.overview) timer = setTimeout(() => build(spec), PAUSE);
    });
}

/** Makes and proves all files. */
function build(spec) {
    const began = performance.now();
    by("proof").textContent = "Making and proving the files ...";
    safely(async () => {
        const answer = await program.ask({ ask: "build", spec, machine, anyway: by("anyway").checked }, { files: drawings(), lane: "files", isLong: true });
        if (editor.text !== spec) return;
        offer(answer);
        document.documentElement.dataset.built = Math.round(performance.now() - began);
        if (by("report-box").open && !isDrawn()) report(spec);
    });
}

function report(spec) {
    safely(async () => {
        const answer = await program.ask({ ask: "build", spec, machine, only: ["report"], prove: false }, { files: drawings(), lane: "report", isLong: true });
        const page = answer.files.find(({ name }) => name.endsWith(".html"));
        if (page && editor.text === spec) by("report").srcdoc = new TextDecoder().decode(page.bytes);
    });
}

/** Shows faults, fields, verdict and picture. */
function show({ faults = [], settings, overview, unfit, files: made, wrong }) {
    if (wrong) throw new Error(wrong);
    editor.show(faults);
    form.mark(faults);
    if (settings) {
        const profile = settings.find(({ section, key }) => section === "machine" && key === "profile");
        form.show(settings, isDrawn());
        by("machine").value = profile?.value ?? "";
        by("report-box").hidden = isDrawn(); // of drawings there is none
    }
    by("anyway-box").hidden = !unfit;
    const verdict = by("verdict");
    if (!overview) {
        by("files").replaceChildren();
        verdict.className = "bad";
        verdict.textContent = "Refused: the faults stand under the spec.";
        return;
    }
    by("result").classList.remove("old");
    const { holds, in_words } = overview.verdict;
    verdict.className = unfit || holds === false ? "bad" : holds ? "good" : "";
    verdict.textContent = in_words;
    const minutes = Math.round(overview.sealing_time_s / 60);
    const rows = [...overview.rows, ["sealing", `${Math.floor(minutes / 60)} h ${String(minutes % 60).padStart(2, "0")} min, heating and pauses not counted`],
        ["sheets", overview.sheets_mm.map((sides) => sides.map((side) => Math.ceil(side)).join(" x ")).join(", ") + " mm"]];
    by("rows").replaceChildren(...rows.flatMap(([label, text]) => [element("dt", {}, label), element("dd", {}, text)]));
    by("precautions").replaceChildren(...overview.before_you_seal.map((text) => element("li", {}, text)));
    by("before").hidden = overview.before_you_seal.length === 0;
    picture(made.find(({ name }) => name.endsWith("preview.svg")));
}

function picture(file) {
    if (!file) return;
    const image = by("preview"), old = image.src;
    image.src = URL.createObjectURL(new Blob([file.bytes], { type: "image/svg+xml" }));
    image.onload = () => {
        performance.mark("preview");
        if (old) URL.revokeObjectURL(old);
    };
    image.alt = "Sheet with seams, cut and inlet, as it will be sealed";
    image.hidden = false;
    by("preview-note").textContent = "Sheet 1 as it will be sealed and cut, seen from the side that the iron touches.";
}

/** Nothing can be downloaded until the text as it stands is proven. */
function withdraw() {
    files = [];
    by("zip").disabled = true;
    by("files").inert = true;
    by("proof").textContent = "";
}

/** Offers the files of a proven build. */
function offer({ faults, files: made, kinds, proven, unfit, name }) {
    editor.show(faults);
    if (!proven) {
        by("files").replaceChildren();
        by("proof").textContent = unfit && !by("anyway").checked ? "Nothing is handed out: it does not do what its own [load] asks." : "Nothing can be handed out.";
        return;
    }
    files = made;
    by("zip").disabled = false;
    by("zip").dataset.folder = stem(name);
    by("proof").textContent = `Proven: ${proven}.`;
    const size = (bytes) => (bytes.length < 1000 ? `${bytes.length} B` : `${(bytes.length / 1000).toPrecision(3)} kB`);
    const entry = (file) => element("li", {}, element("button", { type: "button", className: "plain", title: kinds[file.name] ?? "", onclick: () => save(file.name, new Blob([file.bytes])) }, file.name, element("small", {}, size(file.bytes))));
    by("files").replaceChildren(...made.map(entry));
    by("files").inert = false;
}

/** A name as a file name anywhere. */
const stem = (name) => name.toLowerCase().replace(/[^a-z0-9]+/g, "-").replace(/^-+|-+$/g, "") || "star";

function save(name, blob) {
    const link = element("a", { href: URL.createObjectURL(blob), download: name });
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
}

/** Whether the spec is of a drawing; else it is of stars. */
const isDrawn = () => /^\s*\[drawing\]/m.test(editor.text);

/** The dropped drawing as files of a question. */
const drawings = () => (drawing ? [drawing] : []);

/** Another spec, with the profile and the drawing that came with it. */
function take(text, own = {}) {
    ({ machine, drawing } = own);
    by("anyway").checked = false;
    editor.text = text;
    refresh();
}

/** Changes of fields, one after the other: each starts from the text that the one before has left. */
const changes = new Map();
async function change(key, value) {
    changes.set(key, value);
    if (changes.size > 1) return;
    while (changes.size > 0) {
        const [[own, wanted]] = changes;
        const spec = editor.text;
        const answer = await safely(() => program.ask({ ask: "edit", spec, key: own, value: wanted ?? undefined }, { lane: "edit" }));
        if (changes.get(own) === wanted) changes.delete(own);
        if (answer?.spec !== undefined && editor.text === spec) {
            editor.text = answer.spec;
            refresh();
        } else if (answer?.faults) {
            say(`The value cannot be taken: ${answer.faults[0]?.found}. Mend the spec first.`, true);
        }
    }
}

/** From an object to a spec. */
async function find(event) {
    event.preventDefault();
    const entries = [...by("object-form").elements].filter(({ name }) => name);
    for (const { name } of entries) field(name).removeAttribute("aria-invalid");
    const question = Object.fromEntries(entries.map(({ name, value }) => [name, value]));
    by("object-answer").textContent = "Searching ...";
    by("stop").hidden = false;
    const answer = await safely(() => program.ask({ ask: "new", ...question }, { isLong: true }));
    by("stop").hidden = true;
    if (!answer) {
        by("object-answer").textContent = by("note").className === "bad" ? "" : "Stopped.";
        return;
    }
    by("object-answer").replaceChildren(...told(answer));
    if (answer.spec) take(answer.spec);
}

const field = (name) => by("object-form").elements.namedItem(name);

/** What the search has come to, as elements. */
function told({ fields, reasons, nearest, in_words, wrong }) {
    if (wrong) return [element("p", { className: "why" }, wrong)];
    if (fields) {
        field(fields[0].field)?.focus();
        return fields.map(({ field: name, found }) => {
            field(name)?.setAttribute("aria-invalid", "true");
            return element("p", { className: "why" }, `${name}: ${found}`);
        });
    }
    if (in_words) return in_words.trim().split("\n").map((line) => element("p", {}, line.trim()));
    const list = [element("p", { className: "why" }, "No gripper was found that does all of this:"), element("ul", {}, ...reasons.map((text) => element("li", {}, text)))];
    if (nearest) {
        const use = () => {
            for (const [name, value] of Object.entries(nearest)) if (value !== null) field(name).value = value;
            by("object-form").requestSubmit();
        };
        const named = Object.entries(nearest).filter(([, value]) => value !== null).map(([name, value]) => `${name} ${value}`);
        list.push(element("p", {}, `This can be had: ${named.join(", ")}. `), element("button", { type: "button", onclick: use }, "Take these values"));
    }
    return list;
}

/** Dropped or opened files: a spec, with its profile and its drawing; a drawing alone; or the files of a build, which are proven. */
async function opened(list) {
    const found = await sorted(list);
    if (found.spec === undefined) return drawn(found.drawing);
    take(found.spec, found);
    if (!found.build) return say(`Opened ${found.name}.`);
    say("Proving the files of the build ...");
    const { findings, proven, unproven, written_by } = await program.ask({ ask: "verify" }, { files: found.build, isKept: true });
    if (findings.length > 0) {
        const first = findings.slice(0, 3).map(({ file, line, code, found }) => `${file}${line ? `:${line}` : ""}: ${found} (${code})`);
        return say(`${findings.length} findings: ${first.join("; ")}`, true);
    }
    const other = written_by ? `, written by ${written_by}: read back, not compared${unproven.length ? `; not proven: ${unproven.join(", ")}` : ""}` : "";
    return say(`Proven, no findings: ${proven.length} files${other}.`);
}

/** A drawing alone: that of the spec as it stands, if this one names it; else a spec is proposed. */
async function drawn(drawing) {
    if (isDrawn() && editor.text.includes(JSON.stringify(drawing.name))) {
        take(editor.text, { machine, drawing });
        return say(`The drawing is now ${drawing.name} as dropped.`);
    }
    const { spec, layers, reasons } = await program.ask({ ask: "drawing" }, { files: [drawing] });
    if (reasons) return say(`${drawing.name} cannot be read: ${reasons.slice(0, 3).join("; ")}`, true);
    take(spec, { drawing });
    return say(`A spec of ${drawing.name}: ${layers.length} layers, each with a proposed role. Look at the roles in it.`);
}

/** The spec of the link, or what is kept, or a shipped spec. */
async function first() {
    const linked = await safely(() => textOf(location.hash));
    if (linked === undefined) say("The link is damaged: it holds no spec.", true);
    return linked ? { text: linked } : kept() ?? { text: designs["paper-gripper"] ?? Object.values(designs)[0] };
}

function listen() {
    by("object-form").addEventListener("submit", find);
    by("stop").addEventListener("click", () => program.stop());
    by("copy-link").addEventListener("click", () => safely(async () => {
        const link = location.href.split("#")[0] + (await fragmentOf(editor.text));
        history.replaceState(null, "", link);
        const holds = drawing ? "it holds the spec, but not the drawing: send that along" : "it holds the whole spec";
        const isCopied = await (navigator.clipboard?.writeText(link) ?? Promise.reject(new Error())).then(() => true, () => false);
        say(`The link is ${isCopied ? "copied" : "in the address bar"}; ${holds}.`);
    }));
    by("forget").addEventListener("click", () => {
        forget();
        history.replaceState(null, "", location.href.split("#")[0]);
        say("What this browser kept of your spec is gone. The text here stays until you leave.");
    });
    by("designs").addEventListener("change", ({ target }) => target.value && take(designs[target.value]));
    by("machine").addEventListener("change", ({ target }) => change("machine.profile", JSON.stringify(target.value)));
    by("anyway").addEventListener("change", () => build(editor.text));
    by("report-box").addEventListener("toggle", ({ target }) => target.open && report(editor.text));
    by("zip").addEventListener("click", () => save(`${by("zip").dataset.folder}.zip`, zipped(by("zip").dataset.folder, files)));
    by("open").addEventListener("change", ({ target }) => safely(() => opened(target.files)).then(() => (target.value = "")));
    window.addEventListener("hashchange", () => safely(async () => take((await textOf(location.hash)) ?? editor.text)));
    const shows = (isShown) => (event) => {
        event.preventDefault();
        by("drop").hidden = !isShown;
    };
    window.addEventListener("dragover", shows(true));
    window.addEventListener("dragleave", (event) => event.relatedTarget || shows(false)(event));
    window.addEventListener("drop", (event) => {
        shows(false)(event);
        if (event.dataTransfer.files.length) safely(() => opened(event.dataTransfer.files));
    });
}

async function start() {
    const worker = URL.createObjectURL(new Blob([by("worker-code").textContent], { type: "text/javascript" }));
    editor = new Editor(refresh);
    const [module, begun] = await Promise.all([compiled(), first()]);
    program = new Program(module, () => new Worker(worker));
    ({ machine, drawing } = begun);
    editor.text = begun.text;
    const { schema, machines, version } = await program.ask({ ask: "start" });
    const options = () => machines.map(({ name, description }) => element("option", { value: name }, `${name}: ${description}`));
    by("machine").append(...options());
    by("object-machine").append(...options());
    by("object-machine").value = "generic";
    by("designs").append(...Object.keys(designs).map((name) => element("option", {}, name)));
    by("version").textContent = `Version ${version}.`;
    form = new Form(by("form"), schema, machines, change);
    listen();
    if (by("note").className !== "bad") say("");
    await refresh();
}

safely(start).then(() => document.querySelector("main").classList.remove("starting"));
