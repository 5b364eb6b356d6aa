// A spec in a link: in the fragment after #, which is not sent to a server. Small profiles and drawings of the spec are included.
import { drained } from "./zip.js";

/** Largest text in a link, bytes: that of a file. */
const MOST = 1 << 20;
/** Longest drawing in a link, letters: mail and chat programs break longer links. */
const LONGEST_DRAWING = 1 << 15;

async function letters(bytes) {
    const packed = await drained(new Blob([bytes]).stream().pipeThrough(new CompressionStream("deflate-raw")), MOST);
    const binary = Array.from(packed, (byte) => String.fromCharCode(byte)).join("");
    return btoa(binary).replaceAll("+", "-").replaceAll("/", "_").replace(/=+$/, "");
}

function bytesOf(letters) {
    const packed = Uint8Array.from(atob(letters.replaceAll("-", "+").replaceAll("_", "/")), (letter) => letter.charCodeAt(0));
    return drained(new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate-raw")), MOST);
}

/** The fragment with { text, machine, drawing }, and whether the drawing was too large for it. */
export async function fragmentOf({ text, machine, drawing }) {
    let fragment = `#spec=${await letters(text)}`;
    if (machine !== undefined) fragment += `&machine=${await letters(machine)}`;
    const drawn = drawing && drawing.bytes.length <= MOST ? await letters(drawing.bytes) : "";
    const isLong = Boolean(drawing) && (drawn === "" || drawn.length > LONGEST_DRAWING);
    if (drawing && !isLong) fragment += `&file=${encodeURIComponent(drawing.name)}&drawing=${drawn}`;
    return { fragment, isLong };
}

/** The content of `fragment`, { text, machine, drawing }; null if it holds no spec. Fails if the link is damaged. */
export async function heldBy(fragment) {
    if (!fragment.startsWith("#spec=")) return null;
    const parts = new Map(fragment.slice(1).split("&").map((part) => part.split("=")));
    const text = async (name) => new TextDecoder("utf-8", { fatal: true }).decode(await bytesOf(parts.get(name)));
    const held = { text: await text("spec") };
    if (parts.has("machine")) held.machine = await text("machine");
    if (parts.has("drawing")) held.drawing = { name: decodeURIComponent(parts.get("file") ?? ""), bytes: await bytesOf(parts.get("drawing")) };
    return held;
}
