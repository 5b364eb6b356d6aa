// The stage: one of four views of the spec, and the faults in front of it.
import { Canvas } from "./canvas.js";
import { byId, element, listenTabs, processNames, select } from "./dom.js";
import { drawingPicture, sheetPicture } from "./picture.js";
import { ReportView } from "./report.js";
import { askRole, closeRoles } from "./roles.js";

const VIEWS = ["sheet", "drawing", "solid", "report"];
const LEGENDS = {
    sheet: [["air", "air"], ["band", "sealed band"], ["flap", "flap"], ["cut", "cut"], ["start", "start, in order"]],
    drawing: [["air", "air"], ["seam", "seam"], ["port", "port, valve"], ["cut", "cut, hole"], ["measure", "measured, pulled"], ["ignore", "ignored"], ["none", "no role"]],
};
/** Roles with the colour of another one. */
const COLOURS = { valve: "port", hole: "cut", pull: "measure" };

export class Stage {
    #canvas = new Canvas();
    #report = new ReportView();
    /** The view that the user chose. */
    #view = "sheet";
    #sheets = [];
    #drawing = null;
    #faults = [];
    /** What the drawing measures when it is inflated, as far as that is computed. */
    #measures = [];
    #isRefused = false;
    /** Whether the drawing has a pressure, but no computed shape. */
    #isFlat = false;
    /** The drawing with its faults as it is shown, as text; empty in other views. */
    #shownDrawing = "";
    #processes = [];
    #setRole;
    #setProcess;
    #wantReport;

    /** `setRole(layer, role)` and `setProcess(layer, process)` change the spec; `wantReport()` is called when a view needs the report. */
    constructor({ setRole, setProcess, wantReport }) {
        this.#setRole = setRole;
        this.#setProcess = setProcess;
        this.#wantReport = wantReport;
        listenTabs(document.querySelector("#stage > .tabs"), ({ id }) => this.choose(id.slice("view-".length)));
        byId("sheets").addEventListener("change", () => this.#draw());
        this.#draw();
    }

    /** Chooses a view: sheet, drawing, solid or report. */
    choose(view) {
        this.#view = view;
        this.#report.isSolid = view === "solid";
        this.#draw();
        if (!this.needsReport) return;
        if (!this.#report.isThere) byId("report-note").textContent = "Making the report ...";
        this.#wantReport();
    }

    /** Whether the present view is made of the report. */
    get needsReport() {
        return this.#view === "solid" || this.#view === "report";
    }

    /** Shows an answer: its sheets, its drawing and its faults. */
    show({ sheets, drawing, faults = [], overview, settings }) {
        const { value } = byId("sheets");
        this.#isRefused = !overview;
        if (sheets) this.#sheets = sheets;
        if (sheets || drawing) this.#drawing = drawing ?? null;
        if (settings) this.#processes = processNames(settings);
        if (overview) this.#isFlat = overview.stars === 0 && overview.prediction?.model === "none";
        const measures = overview?.prediction?.measures ?? [];
        if (sheets || measures.length > 0) this.#measures = measures;
        this.#faults = faults;
        byId("sheets").replaceChildren(...this.#sheets.map((_, index) => element("option", { value: index }, `Sheet ${index + 1} of ${this.#sheets.length}`)));
        byId("sheets").value = value in this.#sheets ? value : 0;
        document.body.classList.toggle("stale", this.#isRefused);
        this.#draw();
    }

    /** Shows the report `html` in its views. */
    showReport(html) {
        this.#report.show(html);
    }

    /** The view that is shown: faults of a drawing are on the drawing. */
    get #shown() {
        const isDrawn = Boolean(this.#drawing);
        const isEmpty = this.needsReport && this.#isRefused && !this.#report.isThere;
        if (isEmpty || this.#view === "sheet") return this.#isRefused && isDrawn ? "drawing" : "sheet";
        return this.#view === "drawing" && !isDrawn ? "sheet" : this.#view;
    }

    #draw() {
        const view = this.#shown, isPicture = view === "sheet" || view === "drawing", isDrawn = Boolean(this.#drawing);
        select(VIEWS.map((name) => byId(`view-${name}`)), byId(`view-${view}`));
        byId("view-drawing").hidden = !isDrawn;
        byId("picture").hidden = !isPicture;
        byId("picture").setAttribute("aria-labelledby", `view-${view}`);
        byId("report-box").hidden = isPicture;
        byId("inflate").hidden = view !== "solid" || !this.#isFlat;
        byId("sheets").hidden = view !== "sheet" || this.#sheets.length < 2;
        document.body.classList.toggle("reading", view === "report");
        // A drawing that stays the same is not drawn again: a menu over it stays open while files are made.
        const drawing = view === "drawing" ? JSON.stringify([this.#drawing, this.#faults, this.#measures]) : "";
        if (drawing && drawing === this.#shownDrawing) return;
        this.#shownDrawing = drawing;
        closeRoles();
        if (!isPicture) return;
        const hover = (line, text) => this.#canvas.hover(line, text), sheet = this.#sheets[byId("sheets").value || 0];
        const roles = new Set(this.#drawing?.figures.map(({ role }) => COLOURS[role] ?? role ?? "none"));
        const isOrdered = sheet?.pieces.some(({ seams }) => seams.some((seam) => seam.time_s));
        byId("legend").replaceChildren(...LEGENDS[view].filter(([name]) => (view === "sheet" ? name !== "start" || isOrdered : roles.has(name))).map(([name, words]) => element("li", { className: name }, element("i"), words)));
        // A drawing that is shown as it is does not fade with the numbers.
        byId("picture").classList.toggle("fresh", view === "drawing");
        if (view === "drawing") {
            const choose = (figure, line) => askRole(figure, line, { processes: this.#processes, choose: this.#setRole, assign: this.#setProcess });
            this.#canvas.show("drawing", drawingPicture(this.#drawing, { faults: this.#faults, measures: this.#measures }, { hover, choose }));
        } else if (sheet) this.#canvas.show(`sheet ${byId("sheets").value}`, sheetPicture(sheet, isDrawn, hover));
        if (!document.documentElement.dataset.look) performance.mark("preview");
    }
}
