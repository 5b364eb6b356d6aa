// The desk: the one place of the page's state. It holds the spec with its history; everything else is made of it.
import { History } from "./history.js";
import { fileOf, forget, keep, keepFile, keepTab, shelf, tab, tidy } from "./store.js";

/** Pause after which typing begins another step of the history, ms. */
const TYPING = 700;

const newId = () => `${Date.now().toString(36)}-${Math.random().toString(36).slice(2)}`;

export class Desk {
    #history;
    /** The fragment of the link in the address, as long as the spec is what the link holds. */
    #link;
    #listeners = [];
    #timer;

    /** The desk of this visit: with the history of this tab; else with `linked`, what the link `fragment` holds; else with the last spec, or with `first`. */
    constructor(linked, fragment, first) {
        const own = tab();
        if (own && !linked) {
            this.#history = new History(own.states, own.index);
            this.#link = own.link ?? null;
        } else if (linked) {
            this.#history = new History([...(own?.states ?? []), { ...linked, id: newId() }]);
            this.#link = fragment;
            this.#save({});
        } else {
            const [last] = shelf();
            const { text, machine, drawing } = last ?? { text: first };
            this.#history = new History([{ text, machine, drawing, id: newId() }]);
            this.#link = null;
        }
        this.#keepTab();
        tidy(this.#history.stored.states).catch(() => {});
    }

    get state() {
        return this.#history.state;
    }

    get canUndo() {
        return this.#history.canUndo;
    }

    get canRedo() {
        return this.#history.canRedo;
    }

    /** The dropped drawing of the present spec, as files of a question; without it none. */
    async files() {
        const file = await fileOf(this.state.drawing);
        return file ? [file] : [];
    }

    /** `listener` is called after every change of the state. */
    listen(listener) {
        this.#listeners.push(listener);
    }

    /** Changes the present spec: { text, machine, drawing }, each if it changes. Changes of one `kind` are one step, until `settle`. */
    change(parts, kind = null) {
        if (!this.#history.push({ ...this.state, ...parts }, kind)) return;
        if (kind !== null) {
            clearTimeout(this.#timer);
            this.#timer = setTimeout(() => this.settle(), TYPING);
        }
        this.#leaveLink();
        this.#changed(true);
    }

    /** Ends a step of the history. */
    settle() {
        this.#history.settle();
    }

    /** Takes another spec { text, machine, drawing } in place of the present one, which stays in the history. `isShipped`: it need not be kept. */
    take({ text, machine, drawing }, { isShipped = false, link = null } = {}) {
        this.#history.push({ text, machine, drawing, id: newId() });
        if (link === null) this.#leaveLink();
        this.#link = link;
        this.#changed(!isShipped);
    }

    /** The same for a spec whose drawing has its bytes. */
    async takeWithFile({ drawing, ...spec }, options) {
        this.take({ ...spec, drawing: drawing && (await keepFile(drawing)) }, options);
    }

    /** Undoes (-1) or redoes (1) a step. */
    go(by) {
        if (!this.#history.go(by)) return;
        this.#leaveLink();
        this.#changed(shelf().some(({ id }) => id === this.state.id));
    }

    /** Keeps `name` and `picture` of the present spec with it, if it is among the last specs. */
    describe({ name, picture }) {
        if (shelf().some(({ id }) => id === this.state.id)) this.#save({ name, picture });
    }

    /** Puts the address of a link to the present spec into the address bar. */
    show(fragment) {
        this.#link = fragment;
        window.history.replaceState(null, "", location.href.split("#")[0] + fragment);
        this.#keepTab();
    }

    /** Whether `fragment` is that of the link in the address bar. */
    isLinked(fragment) {
        return fragment === this.#link;
    }

    /** Deletes what the browser keeps; the present spec stays on the desk. */
    async forget() {
        this.#leaveLink();
        const state = { ...this.state, id: newId() };
        await forget();
        this.#history = new History([state]);
        this.#changed(false);
    }

    #changed(isKept) {
        if (isKept) this.#save({});
        this.#keepTab();
        for (const listener of this.#listeners) listener(this.state);
    }

    /** The present spec among the last ones; name and picture of before stay until there are new ones. */
    #save(description) {
        const before = shelf().find(({ id }) => id === this.state.id);
        const named = /^\s*name\s*=\s*"([^"\n]{1,80})"/m.exec(this.state.text)?.[1];
        keep({ picture: before?.picture, ...this.state, name: named ?? "without a name", time: Date.now(), ...description });
    }

    #keepTab() {
        keepTab({ ...this.#history.stored, link: this.#link });
    }

    /** The address no longer names a link: the spec is another one. */
    #leaveLink() {
        if (this.#link === null && !location.hash.startsWith("#spec=")) return;
        this.#link = null;
        window.history.replaceState(null, "", location.href.split("#")[0]);
    }
}
