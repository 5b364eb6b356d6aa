// Stores the last spec in the browser for the next visit, if the browser lets a page store anything.

const KEPT = "stargrip-cam.spec";
/** Largest drawing that is stored, bytes: browsers give a page a few MB. */
const MOST_KEPT = 1 << 20;

/** Stores { text, machine, drawing }. */
export function keep({ text, machine, drawing }) {
    const own = drawing && drawing.bytes.length <= MOST_KEPT ? { name: drawing.name, letters: btoa(Array.from(drawing.bytes, (byte) => String.fromCharCode(byte)).join("")) } : undefined;
    try {
        localStorage.setItem(KEPT, JSON.stringify({ text, machine, drawing: own }));
    } catch { /* then it is not kept */ }
}

/** The spec in local storage; null if there is none, or if it cannot be read. */
export function kept() {
    try {
        const { text, machine, drawing } = JSON.parse(localStorage.getItem(KEPT));
        if (typeof text !== "string") return null;
        const own = drawing && { name: String(drawing.name), bytes: Uint8Array.from(atob(drawing.letters), (letter) => letter.charCodeAt(0)) };
        return { text, machine: typeof machine === "string" ? machine : undefined, drawing: own };
    } catch {
        return null;
    }
}

/** Deletes the stored spec. */
export function forget() {
    try {
        localStorage.removeItem(KEPT);
    } catch { /* nothing was kept */ }
}
