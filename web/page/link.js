// A spec in a link: everything behind the #, which no server is told.
import { drained } from "./zip.js";

/** Largest spec in a link, bytes: that of a file. */
const MOST = 1 << 20;
const START = "#spec=";

/** The fragment that holds `text`. */
export async function fragmentOf(text) {
    const stream = new Blob([text]).stream().pipeThrough(new CompressionStream("deflate-raw"));
    const bytes = await drained(stream, MOST);
    const letters = Array.from(bytes, (byte) => String.fromCharCode(byte)).join("");
    return START + btoa(letters).replaceAll("+", "-").replaceAll("/", "_").replace(/=+$/, "");
}

/** The spec in `fragment`; null if there is none. Fails if the link is damaged. */
export async function textOf(fragment) {
    if (!fragment.startsWith(START)) return null;
    const letters = atob(fragment.slice(START.length).replaceAll("-", "+").replaceAll("_", "/"));
    const bytes = Uint8Array.from(letters, (letter) => letter.charCodeAt(0));
    const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate-raw"));
    return new TextDecoder("utf-8", { fatal: true }).decode(await drained(stream, MOST));
}
