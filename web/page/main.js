// The page: the spec on the desk, the program's answers about it, and controls that change it.
import { find, listRecent, offerDesigns } from "./begin.js";
import { watch } from "./busy.js";
import { Desk } from "./desk.js";
import { byId, element, listenTabs, select } from "./dom.js";
import { Editor } from "./editor.js";
import { FaultBox } from "./fault.js";
import { Form } from "./form.js";
import { heldBy } from "./link.js";
import { Maker } from "./maker.js";
import { opened } from "./opening.js";
import { compiled, Dropped, Program } from "./program.js";
import { Result } from "./result.js";
import { hideCode, showCode } from "./share.js";
import { Stage } from "./stage.js";
import { keepFile, shelf, tab } from "./store.js";

const designs = JSON.parse(byId("designs-data").textContent);
let program, desk, maker, editor, form;

/** Shows one line; `isBad` marks an error. A line that is none goes after a while. */
let noteTimer;
function say(text, isBad = false) {
    byId("note").textContent = text;
    byId("note").className = isBad ? "bad" : "";
    clearTimeout(noteTimer);
    if (!isBad) noteTimer = setTimeout(() => (byId("note").textContent = ""), 8000);
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

/** Chooses what is beside the picture: start, values, text, or result where it has no place of its own. */
function beside(name) {
    const panels = ["start", "values", "text", "result"];
    select(panels.map((panel) => byId(`tab-${panel}`)), byId(`tab-${name}`));
    for (const panel of ["start", "values", "text"]) byId(`panel-${panel}`).hidden = panel !== name;
    document.querySelector("main").classList.toggle("on-result", name === "result");
    if (name === "start") listRecent(desk?.state.id, take);
}

/** Changes of fields, one after the other: each starts from the text after the one before. */
const changes = new Map();
async function change(key, value, kind) {
    changes.set(key, { value, kind });
    if (changes.size > 1) return;
    while (changes.size > 0) {
        const [[path, wanted]] = changes;
        const { text } = desk.state;
        const answer = await safely(() => edit(text, path, wanted.value));
        if (changes.get(path) === wanted) changes.delete(path);
        if (answer?.spec !== undefined && desk.state.text === text) desk.change({ text: answer.spec }, wanted.kind);
        else if (answer?.faults) say(`The value is not accepted: ${answer.faults[0]?.found}. Correct the spec first.`, true);
    }
}

/** The text with another value at a key; without a value its default. */
const edit = (text, key, value) => program.ask({ ask: "edit", spec: text, key, value: value ?? undefined }, { lane: "edit", isPatient: true });

/** Changes the spec as the program answers a `question` about its drawing: another role or process of a layer. */
async function changeDrawing(question) {
    const { text } = desk.state, answer = await safely(() => program.ask({ ...question, spec: text }, { lane: "edit" }));
    if (answer?.spec !== undefined && desk.state.text === text) desk.change({ text: answer.spec });
    else if (answer?.faults) say(`The ${question.ask} is not set: ${answer.faults[0]?.found}. Correct the spec first.`, true);
}
const setRole = (layer, role) => changeDrawing({ ask: "role", layer, role });
const setProcess = (name, process) => changeDrawing({ ask: "process", name, process });

/** Takes another spec, in place of the present one. */
function take(spec, options) {
    byId("anyway").checked = false;
    desk.take(spec, options);
    if (!byId("panel-start").hidden) beside("values");
    window.scrollTo(0, 0);
}

/** Takes a shipped design { spec, drawing: { name, text } }. */
async function takeDesign({ spec, drawing }) {
    const own = drawing && { name: drawing.name, bytes: new TextEncoder().encode(drawing.text) };
    take({ text: spec, drawing: own && (await keepFile(own)) }, { isShipped: true });
}

/** Requests a link or a code of the present spec. It holds no built-in profile, which every page has, and no drawing of a star. */
async function linked(question) {
    const { text, machine } = desk.state;
    return program.aside({ ...question, spec: text, machine: byId("machine").value ? undefined : machine }, maker.isDrawn ? await desk.files() : []);
}

function listenHistory() {
    const go = (by) => {
        desk.go(by);
        byId("anyway").checked = false;
    };
    byId("undo").addEventListener("click", () => go(-1));
    byId("redo").addEventListener("click", () => go(1));
    document.addEventListener("keydown", (event) => {
        const key = event.key.toLowerCase(), by = key === "z" ? (event.shiftKey ? 1 : -1) : key === "y" ? 1 : 0;
        if (!by || !(event.ctrlKey || event.metaKey) || event.altKey) return;
        // In a field the browser undoes what the spec does not have yet.
        if (event.target.closest?.("#object-form") || form.isTyped) return;
        event.preventDefault();
        go(by);
    });
    return go;
}

function listenLinks() {
    byId("copy-link").addEventListener("click", () => safely(async () => {
        const { fragment, is_long: isLong } = await linked({ ask: "link" });
        desk.show(fragment);
        const holds = isLong ? "it holds the spec, but not the drawing, which is too large: send that along" : "it holds the whole spec";
        const isCopied = await (navigator.clipboard?.writeText(location.href) ?? Promise.reject(new Error())).then(() => true, () => false);
        say(`The link is ${isCopied ? "copied" : "in the address bar"}; ${holds}.`);
    }));
    byId("show-qr").addEventListener("click", () => safely(() => showCode(location.href.split("#")[0], linked)));
    byId("qr-hide").addEventListener("click", hideCode);
    byId("forget").addEventListener("click", () => safely(async () => {
        await desk.forget();
        listRecent(desk.state.id, take);
        say("The specs that this browser kept are deleted. The text here stays until you leave the page.");
    }));
    window.addEventListener("hashchange", () => safely(async () => {
        const fragment = location.hash;
        if (desk.isLinked(fragment)) return;
        const spec = await heldBy(fragment);
        if (!spec) return;
        take({ ...spec, drawing: spec.drawing && (await keepFile(spec.drawing)) }, { link: fragment });
        say("The link is open. The spec of before is one step back.");
    }));
}

function listenFiles() {
    const taken = (list) => safely(() => opened(list, { program, desk, maker, take, say }));
    for (const id of ["open", "open-drawing"]) byId(id).addEventListener("change", ({ target }) => taken(target.files).then(() => (target.value = "")));
    const shows = (isShown) => (event) => {
        event.preventDefault();
        byId("drop").hidden = !isShown;
    };
    window.addEventListener("dragover", shows(true));
    window.addEventListener("dragleave", (event) => event.relatedTarget || shows(false)(event));
    window.addEventListener("drop", (event) => {
        shows(false)(event);
        if (event.dataTransfer.files.length) taken(event.dataTransfer.files);
    });
}

function listen() {
    byId("object-form").addEventListener("submit", async (event) => {
        event.preventDefault();
        const { state } = desk;
        await find((question) => safely(() => program.ask(question, { isLong: true })), (text) => take({ text }));
        // The search stopped what was being made of a spec that stays.
        if (desk.state === state && byId("zip").disabled) maker.build();
    });
    offerDesigns(designs, (design) => safely(() => takeDesign(design)));
    listenTabs(document.querySelector("#side > .tabs"), ({ id }) => beside(id.slice("tab-".length)));
    byId("skip-spec").addEventListener("click", () => beside("text"));
    byId("machine").addEventListener("change", ({ target }) => change("machine.profile", JSON.stringify(target.value), null));
    for (const start of ["shell-start", "inflate"]) byId(start).addEventListener("click", () => maker.shell());
    byId("anyway").addEventListener("change", () => maker.build());
    window.addEventListener("beforeprint", () => ["before", "pressing"].forEach((id) => (byId(id).open = true)));
}

/** The spec to begin with, from the link if that holds one which this tab did not take. */
async function begin() {
    const fragment = location.hash;
    if (tab()?.link === fragment) return [null, fragment, false];
    const spec = await safely(() => heldBy(fragment));
    const drawing = spec?.drawing && (await keepFile(spec.drawing));
    return [spec && { ...spec, drawing }, fragment, spec === undefined];
}

async function start() {
    const worker = URL.createObjectURL(new Blob([byId("worker-code").textContent], { type: "text/javascript" }));
    // What can be seen without the program is there while it loads.
    beside(shelf().length === 0 && !location.hash ? "start" : "values");
    const [module, [spec, fragment, isDamaged]] = await Promise.all([compiled(), begin()]);
    program = new Program(module, () => new Worker(worker));
    desk = new Desk(spec, fragment, designs["paper-gripper"].spec);
    if (isDamaged) say("The link is damaged: it holds no spec.", true);
    const { schema, machines, version } = await program.ask({ ask: "start" });
    const options = () => machines.map(({ name, description }) => element("option", { value: name, title: description }, `${name}: ${description}`));
    byId("machine").append(...options());
    byId("object-machine").append(...options());
    byId("object-machine").value = "generic";
    byId("about").textContent = `Version ${version}. Nothing leaves your machine. Predictions have ranges: test your seal before you trust it.`;
    form = new Form(schema, { change, settle: () => desk.settle() });
    const go = listenHistory();
    editor = new Editor({ typed: (text) => desk.change({ text }, "typing"), settle: () => desk.settle(), explain: (code) => program.ask({ ask: "explain", code }, { lane: `explain ${code}`, isPatient: true }), undo: go });
    const ask = { edit, look: (text) => maker.look(text, "remedy") };
    const fault = new FaultBox(ask, {
        write: (text) => desk.change({ text }),
        show: ({ place }) => (beside("text"), editor.go(place)),
    });
    const stage = new Stage({ setRole, setProcess, wantReport: () => maker.report() });
    const result = new Result();
    maker = new Maker({ program, desk, safely, shown: { editor, form, result, fault, stage } });
    result.listenMoved((question, files) => safely(() => program.ask({ ask: "align", ...question }, { files, isLong: true })));
    // A line is about the spec of before.
    desk.listen(() => say(""));
    desk.listen(() => maker.refresh());
    listen();
    listenLinks();
    listenFiles();
    watch(program);
    byId("side").inert = false;
    await maker.refresh();
}

safely(start).then(() => document.body.classList.remove("starting"));
