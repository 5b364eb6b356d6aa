// What the browser keeps: the last ten specs for all tabs, the history of this tab, and the drawings of both. Texts are written at once;
// a drawing is written before the first text that needs it.

const SHELF = "stargrip-cam.specs", TAB = "stargrip-cam.tab", FILES = "stargrip-cam";
/** Number of specs that are kept. */
export const MOST_SPECS = 10;

function readStored(storage, key) {
    try {
        return JSON.parse(storage().getItem(key));
    } catch {
        return null; // nothing is kept, or the browser lets a page keep nothing
    }
}

function writeStored(storage, key, value) {
    try {
        if (value === null) storage().removeItem(key);
        else storage().setItem(key, JSON.stringify(value));
        return true;
    } catch {
        return false;
    }
}

const local = () => localStorage, session = () => sessionStorage;

/** Whether `state` has the form of a stored one. */
const isState = (state) => typeof state?.text === "string" && typeof state.id === "string";

/** The last specs, the newest first: [{ id, text, machine, drawing, name, time, picture }]. */
export function shelf() {
    const list = readStored(local, SHELF);
    return Array.isArray(list) ? list.filter(isState) : [];
}

/** Keeps `entry` as the newest one; of equal ids only the newest stays. */
export function keep(entry) {
    const others = shelf().filter(({ id }) => id !== entry.id);
    for (let room = MOST_SPECS - 1; room >= 0; room--) if (writeStored(local, SHELF, [entry, ...others.slice(0, room)])) return;
}


/** The stored history of this tab with the link that it took: { states, index, link }; null if there is none. */
export function tab() {
    const own = readStored(session, TAB);
    return own && Array.isArray(own.states) && own.states.every(isState) && own.states[own.index] ? own : null;
}

/** Keeps the history of this tab: if it is too long, its newer part. */
export function keepTab({ states, index, link }) {
    for (let first = 0; first <= index; first = Math.max(first * 2, first + 1)) {
        if (writeStored(session, TAB, { states: states.slice(first), index: index - first, link })) return;
    }
    writeStored(session, TAB, { states: [states[index]], index: 0, link });
}

/** Deletes all specs and drawings, and the history of this tab. */
export async function forget() {
    writeStored(local, SHELF, null);
    writeStored(session, TAB, null);
    await withFiles((files) => files.clear()).catch(() => {});
}

/** The database of drawings; it is opened once. */
let database;
function openDatabase() {
    database ??= new Promise((resolve, reject) => {
        const request = indexedDB.open(FILES, 1);
        request.onupgradeneeded = () => request.result.createObjectStore("files");
        request.onsuccess = () => resolve(request.result);
        request.onerror = () => reject(request.error);
    });
    return database;
}

/** Runs `work(files)`, which returns a request, and waits until it is written. */
async function withFiles(work, mode = "readwrite") {
    const transaction = (await openDatabase()).transaction("files", mode);
    const request = work(transaction.objectStore("files"));
    return new Promise((resolve, reject) => {
        transaction.oncomplete = () => resolve(request?.result);
        transaction.onabort = transaction.onerror = () => reject(transaction.error);
    });
}

/** The hash of `bytes`, 64 bits of two FNV sums: names for a person's own files, without an attacker. */
function hashOf(bytes) {
    let low = 0x811c9dc5, high = 0x01000193;
    for (const byte of bytes) {
        low = Math.imul(low ^ byte, 0x01000193);
        high = Math.imul(high ^ byte, 0x85ebca6b) ^ (low >>> 15);
    }
    return [low, high, bytes.length].map((number) => (number >>> 0).toString(16)).join("-");
}

/** Drawings of this visit, so that each is read once. */
const files = new Map();

/** Keeps a drawing { name, bytes }; returns what a state has of it: { name, hash }. */
export async function keepFile({ name, bytes }) {
    const hash = hashOf(bytes);
    files.set(hash, bytes);
    await withFiles((store) => store.put({ bytes, time: Date.now() }, hash)).catch(() => {});
    return { name, hash };
}

/** The drawing of a state with its bytes, or undefined if the browser no longer has it. */
export async function fileOf(drawing) {
    if (!drawing) return undefined;
    if (!files.has(drawing.hash)) files.set(drawing.hash, (await withFiles((store) => store.get(drawing.hash), "readonly").catch(() => undefined))?.bytes);
    const bytes = files.get(drawing.hash);
    return bytes && { name: drawing.name, bytes };
}

/** Deletes drawings that neither the last specs nor `states` need, and that no other tab may need: they are older than a week. */
export async function tidy(states) {
    const needed = new Set([...shelf(), ...states].map(({ drawing }) => drawing?.hash)), oldest = Date.now() - 7 * 24 * 3600 * 1000;
    const keys = await withFiles((store) => store.getAllKeys(), "readonly").catch(() => []);
    for (const key of keys.filter((key) => !needed.has(key))) {
        const { time } = await withFiles((store) => store.get(key), "readonly");
        if (time < oldest) await withFiles((store) => store.delete(key));
    }
}
