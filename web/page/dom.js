// Elements of the page and small words about values.

/** The element with this id. */
export const byId = (id) => document.getElementById(id);

/** An element with properties and children. */
export function element(name, properties = {}, ...children) {
    const made = document.createElement(name);
    for (const [key, value] of Object.entries(properties)) {
        if (key.includes("-") || key === "role") made.setAttribute(key, value);
        else made[key] = value;
    }
    made.append(...children);
    return made;
}

/** An element of a drawing with attributes and children. */
export function shape(name, attributes = {}, ...children) {
    const made = document.createElementNS("http://www.w3.org/2000/svg", name);
    for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
    made.append(...children);
    return made;
}

/** The names of the processes of a spec by its settings [{ section }], in their order. */
export function processNames(settings) {
    const sections = settings.map(({ section }) => section).filter((section) => section.startsWith("process."));
    return [...new Set(sections)].map((section) => section.slice("process.".length));
}

/** A text of the program, in which code is in backticks, as children of an element. */
export const marked = (text) => text.split("`").map((part, index) => (index % 2 ? element("code", {}, part) : part));

/** The same for a text that begins as a sentence does, unless with a name. */
export const prose = (text) => marked(/^[a-z]+(?![\w\u0060])/.test(text) ? text.charAt(0).toUpperCase() + text.slice(1) : text);

/** Seconds as "2 h 16 min". */
export function hours(seconds) {
    const minutes = Math.round(seconds / 60), rest = minutes % 60;
    return minutes < 60 ? `${minutes} min` : `${Math.floor(minutes / 60)} h ${String(rest).padStart(2, "0")} min`;
}

/** The program's words as the page shows them: "×" between sides, and a range in parentheses: "85 N (72 to 101)". */
export function readable(text) {
    const ranged = text.replace(/(\d) x (?=\d)/g, "$1 × ").replace(/(\d(?: [a-zA-Z]+)?), ([\d.]+ to [\d.]+)/g, (words, value, range, index, whole) => {
        const before = whole.slice(0, index);
        return before.lastIndexOf("(") > before.lastIndexOf(")") ? words : `${value} (${range})`;
    });
    return ranged.replace(/(\d)\) \(/g, "$1; ");
}

/** Marks one of `tabs`, buttons of a tab list, as selected. */
export function select(tabs, chosen) {
    for (const tab of tabs) {
        tab.setAttribute("aria-selected", String(tab === chosen));
        tab.tabIndex = tab === chosen ? 0 : -1;
    }
}

/** Lets arrow keys move between the buttons of a tab list; `choose(button)` is called for the new one. */
export function listenTabs(list, choose) {
    const tabs = () => [...list.querySelectorAll("[role=tab]")].filter((tab) => tab.offsetParent !== null);
    list.addEventListener("click", ({ target }) => target.closest("[role=tab]") && choose(target.closest("[role=tab]")));
    list.addEventListener("keydown", (event) => {
        const step = { ArrowRight: 1, ArrowLeft: -1 }[event.key], all = tabs(), index = all.indexOf(event.target);
        if (!step || index < 0) return;
        event.preventDefault();
        const next = all[(index + step + all.length) % all.length];
        next.focus();
        choose(next);
    });
}
