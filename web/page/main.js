// The page: a text, the program's answers about it, and controls that change it.
import { Program, Dropped } from "./program.js";
import { Form, element } from "./form.js";
import { Editor } from "./editor.js";
import { Result } from "./result.js";
import { hideCode, showCode } from "./qr.js";
import { find } from "./search.js";
import { clear, compute } from "./shell.js";
import { watch } from "./busy.js";
import { heldBy } from "./link.js";
import { keep, kept, forget } from "./kept.js";
import { sorted } from "./opening.js";

/** Wait after the last change before all files are made, ms. */
const PAUSE = 150;

const by = (id) => document.getElementById(id);
const designs = JSON.parse(by("designs-data").textContent);
/** The machine profile and the drawing that were dropped, for a spec that names files. */
let machine, drawing;
let program, form, editor, result, timer;

/** Shows one line; `isBad` marks an error. */
function say(text, isBad = false) {
    by("note").textContent = text;
    by("note").className = isBad ? "bad" : "";
}

/** Runs a part of the page's work: an exception is shown, and the text stays. */
async function safely(work) {
    try {
        return await work();
    } catch (error) {
        if (error instanceof Dropped) return undefined;
        say(`Stopped by an error: ${error.message}. Your text is kept.`, true);
        return undefined;
    }
}

/** The compiled program: from the page itself, or from the file beside it. It is compiled while it loads. */
async function compiled() {
    const streamed = (body) => WebAssembly.compileStreaming(new Response(body, { headers: { "Content-Type": "application/wasm" } }));
    const own = by("program-data");
    if (!own) {
        const beside = await fetch("stargrip-cam.wasm");
        if (!beside.ok) throw new Error(`the program could not be loaded (${beside.status}); load the page again`);
        navigator.serviceWorker?.register("offline.js").catch(() => {}); // without it the page needs its network
        return streamed(beside.body);
    }
    const packed = Uint8Array.fromBase64?.(own.textContent) ?? Uint8Array.from(atob(own.textContent), (letter) => letter.charCodeAt(0));
    own.remove();
    return streamed(new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip")));
}

/** A quick check of the present text, which is awaited, then all of its files. */
function refresh() {
    const spec = editor.text;
    keep({ text: spec, machine, drawing });
    clearTimeout(timer);
    result.withdraw();
    clear();
    hideCode();
    return safely(async () => {
        const answer = await program.ask({ ask: "build", spec, machine, only: ["preview-svg"], prove: false, quick: true }, { files: drawings(), lane: "look" });
        if (editor.text !== spec) return;
        show(answer);
        if (answer.overview) timer = setTimeout(() => build(spec), PAUSE);
    });
}

/** Makes and proves all files. */
async function build(spec) {
    const began = performance.now(), anyway = by("anyway").checked;
    by("proof").textContent = "Making and proving the files ...";
    const answer = await safely(() => program.ask({ ask: "build", spec, machine, anyway }, { files: drawings(), lane: "files", isLong: true }));
    if (editor.text !== spec) return;
    if (!answer) {
        by("proof").textContent = "Stopped. The next change of the spec starts it again.";
        return;
    }
    show(answer);
    result.offer(answer, anyway);
    document.documentElement.dataset.built = Math.round(performance.now() - began);
    if (by("report-box").open) report(spec);
}

function report(spec) {
    safely(async () => {
        const answer = await program.ask({ ask: "build", spec, machine, only: ["report"], prove: false }, { files: drawings(), lane: "report", isLong: true, isPatient: true });
        const page = answer.files.find(({ name }) => name.endsWith(".html"));
        if (page && editor.text === spec) by("report").srcdoc = new TextDecoder().decode(page.bytes);
    });
}

/** Shows faults, fields, verdict and picture of an answer. */
function show(answer) {
    const { faults = [], settings, wrong } = answer;
    if (wrong) throw new Error(wrong);
    editor.show(faults);
    form.mark(faults);
    if (settings) {
        const profile = settings.find(({ section, key }) => section === "machine" && key === "profile");
        form.show(settings, isDrawn());
        by("machine").value = profile?.value ?? "";
    }
    result.show(answer);
}

/** Whether the spec is of a drawing; otherwise it is of stars. */
const isDrawn = () => /^\s*\[drawing\]/m.test(editor.text);

/** The dropped drawing as files of a question. */
const drawings = () => (drawing ? [drawing] : []);

/** Requests a link or a code of the current spec. It holds no built-in profile, which every page has, and no drawing of a star. */
const linked = (question) => program.aside({ ...question, spec: editor.text, machine: by("machine").value ? undefined : machine }, isDrawn() ? drawings() : []);

/** Sets another spec, with its profile and its drawing. */
function take(text, own = {}) {
    ({ machine, drawing } = own);
    by("anyway").checked = false;
    editor.text = text;
    refresh();
}

/** Changes of fields, one after the other: each starts from the text after the one before. */
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
            say(`The value is not accepted: ${answer.faults[0]?.found}. Correct the spec first.`, true);
        }
    }
}

/** Dropped or opened files: a spec, with its profile and its drawing; a drawing alone; or the files of a build, which are proven. */
async function opened(list) {
    const found = await sorted(list);
    if (found.spec === undefined) return found.drawing ? drawn(found.drawing) : profiled(found);
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

/** A machine profile alone: for the present spec. */
function profiled({ name, machine: profile }) {
    take(editor.text, { machine: profile, drawing });
    say(`The machine profile ${name} is used if \`profile\` in [machine] names a file.`);
}

/** A drawing alone: that of the present spec, if the spec names it; else a spec is proposed. */
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

/** The first spec: from the link, from local storage, or a shipped one. */
async function first() {
    const own = await safely(() => heldBy(location.hash));
    if (own === undefined) say("The link is damaged: it holds no spec.", true);
    return own ?? kept() ?? { text: designs["paper-gripper"] ?? Object.values(designs)[0] };
}

function listen() {
    const long = (question) => safely(() => program.ask(question, { isLong: true }));
    by("object-form").addEventListener("submit", (event) => {
        event.preventDefault();
        find(long, (spec) => take(spec));
    });
    by("shell-start").addEventListener("click", () => compute((question) => {
        const whole = { ...question, spec: editor.text, machine };
        return safely(() => program.ask(whole, { files: drawings(), lane: "shell", isLong: true, isPatient: true }));
    }));
    by("copy-link").addEventListener("click", () => safely(async () => {
        const { fragment, is_long: isLong } = await linked({ ask: "link" });
        const link = location.href.split("#")[0] + fragment;
        history.replaceState(null, "", link);
        const holds = isLong ? "it holds the spec, but not the drawing, which is too large: send that along" : "it holds the whole spec";
        const isCopied = await (navigator.clipboard?.writeText(link) ?? Promise.reject(new Error())).then(() => true, () => false);
        say(`The link is ${isCopied ? "copied" : "in the address bar"}; ${holds}.`);
    }));
    by("show-qr").addEventListener("click", () => safely(async () => {
        await showCode(location.href.split("#")[0], linked);
        by("qr").scrollIntoView({ block: "nearest" });
    }));
    by("qr-hide").addEventListener("click", hideCode);
    by("forget").addEventListener("click", () => {
        forget();
        history.replaceState(null, "", location.href.split("#")[0]);
        say("The spec that this browser stored is deleted. The text here stays until you leave the page.");
    });
    by("designs").addEventListener("change", ({ target }) => target.value && take(designs[target.value]));
    by("machine").addEventListener("change", ({ target }) => change("machine.profile", JSON.stringify(target.value)));
    by("anyway").addEventListener("change", () => build(editor.text));
    by("report-box").addEventListener("toggle", ({ target }) => target.open && report(editor.text));
    by("open").addEventListener("change", ({ target }) => safely(() => opened(target.files)).then(() => (target.value = "")));
    window.addEventListener("hashchange", () => safely(async () => {
        const { text, ...own } = (await heldBy(location.hash)) ?? { text: editor.text, machine, drawing };
        take(text, own);
    }));
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
    editor = new Editor(refresh, (code) => program.ask({ ask: "explain", code }, { lane: `explain ${code}`, isPatient: true }));
    result = new Result();
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
    watch(program);
    if (by("note").className !== "bad") say("");
    await refresh();
}

safely(start).then(() => document.querySelector("main").classList.remove("starting"));
