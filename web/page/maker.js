// The maker: what is made of the spec on the desk. First a quick look, then all files with their proof, and the report where it is in sight.
import { smallPicture } from "./picture.js";
import { byId } from "./dom.js";
import { hideCode } from "./share.js";

/** Wait after the last change before all files are made, ms. */
const PAUSE = 150;

export class Maker {
    #program;
    #desk;
    #safely;
    #shown;
    #timer;
    /** Time of the last change of the spec, ms. */
    #began = 0;
    /** The state of which the report is shown. */
    #reported = null;
    /** Whether the program said that the spec is of a drawing. */
    #isDrawn = false;

    /** `shown`: { editor, form, result, fault, stage }, which show the answers. */
    constructor({ program, desk, safely, shown }) {
        this.#program = program;
        this.#desk = desk;
        this.#safely = safely;
        this.#shown = shown;
    }

    get isDrawn() {
        return this.#isDrawn;
    }

    /** A quick answer about a `text` with the present files. */
    async look(text, lane) {
        const { machine } = this.#desk.state;
        return this.#program.ask({ ask: "look", spec: text, machine }, { files: await this.#desk.files(), lane, isPatient: lane !== "look" });
    }

    /** Shows the spec on the desk: a quick look, which is awaited, then all of its files. */
    refresh() {
        const { editor, result } = this.#shown, { state } = this.#desk;
        this.#began = performance.now();
        clearTimeout(this.#timer);
        editor.text = state.text;
        byId("undo").disabled = !this.#desk.canUndo;
        byId("redo").disabled = !this.#desk.canRedo;
        result.withdraw();
        hideCode();
        byId("shell-note").textContent = "";
        return this.#safely(async () => {
            const answer = await this.look(state.text, "look");
            if (this.#desk.state !== state) return;
            this.#show(answer);
            document.documentElement.dataset.look = Math.round(performance.now() - this.#began);
            if (!answer.overview) return;
            this.#timer = setTimeout(() => this.build({ isPatient: true }), PAUSE);
            this.#desk.describe({ name: answer.name, picture: smallPicture(answer.sheets?.[0]) });
        });
    }

    /** Makes and proves all files; `isPatient`: after what runs. */
    async build({ isPatient = false } = {}) {
        const { state } = this.#desk, anyway = byId("anyway").checked;
        byId("proof").textContent = "Making and proving the files ...";
        const answer = await this.#asked({ anyway }, { lane: "files", isPatient });
        if (this.#desk.state !== state) return;
        if (!answer) {
            byId("proof").textContent = "Stopped. The next change of the spec starts it again.";
            return;
        }
        this.#show(answer);
        this.#shown.result.offer(answer, anyway);
        document.documentElement.dataset.built = Math.round(performance.now() - this.#began);
        if (this.#shown.stage.needsReport) this.report();
    }

    /** Makes the report, for the views that show it, unless they show that of the spec on the desk. */
    async report(more = null) {
        const { state } = this.#desk;
        if (this.#reported === state && !more) return undefined;
        const answer = await this.#asked({ only: ["report"], prove: false, ...more }, { lane: "report", isPatient: true });
        const page = answer?.files.find(({ name }) => name.endsWith(".html"));
        if (!page || this.#desk.state !== state) return undefined;
        this.#reported = state;
        this.#shown.stage.showReport(new TextDecoder().decode(page.bytes));
        return answer;
    }

    /** Computes the inflated sheet in triangles, and shows it in three dimensions. */
    async shell() {
        const began = performance.now();
        byId("shell-note").textContent = "Computing ...";
        for (const start of ["shell-start", "inflate"]) byId(start).disabled = true;
        const answer = await this.report({ model: "shell" });
        for (const start of ["shell-start", "inflate"]) byId(start).disabled = false;
        byId("shell-note").textContent = answer ? `Computed in ${((performance.now() - began) / 1000).toFixed(1)} s, on coarse meshes. The report has its numbers, each with its mesh error.` : "Stopped.";
        if (!answer) return;
        this.#shown.result.show(answer);
        this.#shown.stage.show(answer);
        this.#shown.stage.choose("solid");
    }

    /** Asks for a build of the spec on the desk; undefined if it is stopped. */
    async #asked(question, options) {
        const { text, machine } = this.#desk.state;
        return this.#safely(async () => this.#program.ask({ ask: "build", spec: text, machine, ...question }, { files: await this.#desk.files(), isLong: true, ...options }));
    }

    /** Shows faults, fields, verdict and picture of an answer. */
    #show(answer) {
        const { faults = [], settings, wrong } = answer, { editor, form, result, fault, stage } = this.#shown;
        if (wrong) throw new Error(wrong);
        editor.show(faults);
        fault.show(faults, this.#desk.state.text);
        if (settings) {
            this.#isDrawn = settings.some(({ section, given }) => section === "drawing" && given);
            form.show(settings, this.#isDrawn);
            const profile = settings.find(({ section, key }) => section === "machine" && key === "profile");
            byId("machine").value = profile?.value ?? "";
            byId("name").textContent = answer.name ?? "";
        }
        form.mark(faults);
        result.show(answer);
        stage.show(answer);
    }
}
