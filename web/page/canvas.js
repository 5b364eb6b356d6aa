// The canvas: zoom by wheel, pinch, keys and buttons; pan by dragging; names beside the pointer.
import { byId } from "./dom.js";
import { part } from "./picture.js";

/** Room around the picture, px; and below it, where the size stands. */
const EDGE = 26, BELOW = 30;
/** Most that a picture is enlarged, times its size when it fits. */
const MOST_ZOOM = 60;

export class Canvas {
    #svg = byId("canvas");
    #hint = byId("hint");
    #labels = [];
    #box = [0, 0, 100, 100];
    /** What is in sight: its upper left corner, mm, and mm a pixel. */
    #view = { x: 0, y: 0, scale: 1 };
    #isFit = true;
    #name = "";
    #pointers = new Map();
    /** Whether the pointer moved the picture since it went down: then it clicks nothing. */
    #isDragged = false;

    constructor() {
        new ResizeObserver(() => (this.#isFit ? this.fit() : this.#draw())).observe(this.#svg);
        byId("zoom-in").addEventListener("click", () => this.zoom(1.6));
        byId("zoom-out").addEventListener("click", () => this.zoom(1 / 1.6));
        byId("zoom-fit").addEventListener("click", () => this.fit());
        this.#listen();
    }

    /** Shows a picture { content, labels, box }. The view stays as the user left it as long as the picture has the same `name`. */
    show(name, { content, labels, box }) {
        this.#svg.replaceChildren(...content, ...labels);
        this.#labels = labels;
        this.#box = box;
        this.#hint.hidden = true;
        if (this.#isFit || name !== this.#name) this.fit();
        else this.#draw();
        this.#name = name;
    }

    /** Makes `target` tell `text` beside the pointer, and when it has the focus. */
    hover(target, text) {
        const tell = () => {
            this.#hint.textContent = text;
            this.#hint.hidden = false;
        };
        const place = (x, y) => {
            const frame = byId("picture").getBoundingClientRect();
            this.#hint.style.left = `${Math.min(Math.max(x - frame.left, 90), frame.width - 90)}px`;
            this.#hint.style.top = `${Math.max(y - frame.top, 52)}px`;
        };
        target.addEventListener("pointermove", ({ clientX, clientY }) => (tell(), place(clientX, clientY)));
        target.addEventListener("focus", () => {
            const { left, top, width } = target.getBoundingClientRect();
            tell();
            place(left + width / 2, top);
        });
        for (const end of ["pointerleave", "blur"]) target.addEventListener(end, () => (this.#hint.hidden = true));
    }

    /** Shows all of the picture. */
    fit() {
        const { clientWidth: width, clientHeight: height } = this.#svg, [x, y, w, h] = this.#box;
        if (width === 0 || height === 0) return;
        // The box of a fault covers no mark.
        const below = BELOW + (this.#svg.querySelector(".mark") ? byId("fault").offsetHeight : 0);
        const scale = Math.max(w / Math.max(width - 2 * EDGE, 40), h / Math.max(height - EDGE - below, 40), 1e-3);
        this.#view = { scale, x: x + w / 2 - (scale * width) / 2, y: y + h / 2 - (scale * (height + EDGE - below)) / 2 };
        this.#isFit = true;
        this.#draw();
    }

    /** Makes it `factor` times as large about a point of the element, px. */
    zoom(factor, [px, py] = [this.#svg.clientWidth / 2, this.#svg.clientHeight / 2]) {
        const { x, y, scale } = this.#view;
        const fitted = Math.max(this.#box[2] / this.#svg.clientWidth, this.#box[3] / this.#svg.clientHeight, 1e-3);
        const next = Math.min(Math.max(scale / factor, fitted / MOST_ZOOM), 3 * fitted);
        this.#view = { scale: next, x: x + px * (scale - next), y: y + py * (scale - next) };
        this.#isFit = false;
        this.#draw();
    }

    /** Moves it by pixels. */
    #move(dx, dy) {
        this.#view.x -= dx * this.#view.scale;
        this.#view.y -= dy * this.#view.scale;
        this.#isFit = false;
        this.#draw();
    }

    #draw() {
        const { x, y, scale } = this.#view, { clientWidth: width, clientHeight: height } = this.#svg;
        this.#svg.setAttribute("viewBox", `${x} ${y} ${width * scale} ${height * scale}`);
        this.#svg.style.setProperty("--u", String(scale));
        this.#svg.classList.toggle("zoomed", !this.#isFit);
        part(this.#labels, scale);
    }

    #listen() {
        const svg = this.#svg, local = ({ clientX, clientY }) => {
            const { left, top } = svg.getBoundingClientRect();
            return [clientX - left, clientY - top];
        };
        svg.addEventListener("wheel", (event) => {
            // Where the page itself scrolls, a wheel scrolls it, and zooms with the control key.
            if (document.documentElement.scrollHeight > innerHeight + 1 && !event.ctrlKey) return;
            event.preventDefault();
            this.zoom(Math.exp(-event.deltaY / 400), local(event));
        }, { passive: false });
        svg.addEventListener("dblclick", (event) => this.zoom(2, local(event)));
        svg.addEventListener("pointerdown", (event) => {
            this.#pointers.set(event.pointerId, local(event));
            this.#isDragged = false;
        });
        svg.addEventListener("pointermove", (event) => this.#drag(event.pointerId, local(event), event.buttons));
        for (const end of ["pointerup", "pointercancel", "pointerleave"]) svg.addEventListener(end, ({ pointerId }) => this.#pointers.delete(pointerId));
        svg.addEventListener("click", (event) => this.#isDragged && event.stopPropagation(), { capture: true });
        const step = 60, keys = { "+": () => this.zoom(1.3), "=": () => this.zoom(1.3), "-": () => this.zoom(1 / 1.3), 0: () => this.fit(), ArrowLeft: () => this.#move(step, 0), ArrowRight: () => this.#move(-step, 0), ArrowUp: () => this.#move(0, step), ArrowDown: () => this.#move(0, -step) };
        svg.addEventListener("keydown", (event) => {
            if (!keys[event.key] || event.ctrlKey || event.metaKey || event.altKey) return;
            event.preventDefault();
            keys[event.key]();
        });
    }

    /** One pointer moves the picture, two zoom it. */
    #drag(pointer, place, buttons) {
        const before = this.#pointers.get(pointer);
        if (!before || buttons === 0) return;
        const other = [...this.#pointers].find(([id]) => id !== pointer)?.[1];
        if (other) {
            const distance = ([x, y]) => Math.hypot(x - other[0], y - other[1]);
            this.zoom(distance(place) / Math.max(distance(before), 1), other);
        } else if (this.#isDragged || Math.hypot(place[0] - before[0], place[1] - before[1]) > 3) {
            this.#move(place[0] - before[0], place[1] - before[1]);
        } else return;
        this.#isDragged = true;
        this.#pointers.set(pointer, place);
    }
}
