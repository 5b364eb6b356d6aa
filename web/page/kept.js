// What a browser keeps of the last spec for the next visit, if it lets a page keep anything.

const KEPT = "stargrip-cam.spec";
/** Largest drawing that is kept, bytes: browsers give a page a few MB. */
const MOST_KEPT = 1 << 20;

/** Keeps { text, machine, drawing }. */
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

/** Keeps nothing. */
export function forget() {
    try {
        localStorage.removeItem(KEPT);
    } catch { /* nothing was kept */ }
}
