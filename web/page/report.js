// The report and its scene in a frame. A report is loaded unseen, takes the place, view and sliders of the one before, and is then shown.
import { byId, element } from "./dom.js";

export class ReportView {
    #frame = null;
    #next = null;
    /** The place in the report, as it told it: scroll, sliders, views. */
    #place = null;
    #isSolid = false;

    constructor() {
        window.addEventListener("message", ({ source, data }) => this.#heard(source, data ?? {}));
    }

    /** Whether there is a report to be shown. */
    get isThere() {
        return this.#frame !== null;
    }

    /** Shows the scene alone, or the whole report. */
    set isSolid(isSolid) {
        this.#isSolid = isSolid;
        this.#frame?.contentWindow.postMessage({ solid: isSolid }, "*");
    }

    /** Shows the report `html`. */
    show(html) {
        this.#next?.remove();
        this.#next = element("iframe", { title: "Report", srcdoc: html, className: "next" });
        this.#next.setAttribute("sandbox", "allow-scripts");
        byId("report-box").append(this.#next);
    }

    #heard(source, { report, place }) {
        if (report === "ready" && source === this.#next?.contentWindow) source.postMessage({ place: this.#place, solid: this.#isSolid }, "*");
        if (report === "placed" && source === this.#next?.contentWindow) {
            this.#next.className = "";
            this.#frame?.remove();
            this.#frame = this.#next;
            this.#next = null;
            byId("report-note").textContent = "";
        }
        if (report === "place" && source === this.#frame?.contentWindow) this.#place = place;
    }
}
