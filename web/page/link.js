// Reads a spec from the fragment of a link, which is not sent to a server. The program writes it (src/link/mod.rs).
import { drained } from "./zip.js";

/** Largest text in a link, bytes: that of a file. */
const MOST = 1 << 20;

function bytesOf(letters) {
    const packed = Uint8Array.from(atob(letters.replaceAll("-", "+").replaceAll("_", "/")), (letter) => letter.charCodeAt(0));
    return drained(new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate-raw")), MOST);
}

/** The content of `fragment`, { text, machine, drawing }; null if it holds no spec. Fails if the link is damaged. */
export async function heldBy(fragment) {
    if (!fragment.startsWith("#spec=")) return null;
    return read(fragment).catch(() => Promise.reject(new Error("the link is damaged, or holds more than a spec may")));
}

async function read(fragment) {
    const parts = new Map(fragment.slice(1).split("&").map((part) => part.split("=")));
    const text = async (name) => new TextDecoder("utf-8", { fatal: true }).decode(await bytesOf(parts.get(name)));
    const held = { text: await text("spec") };
    if (parts.has("machine")) held.machine = await text("machine");
    if (parts.has("drawing")) held.drawing = { name: decodeURIComponent(parts.get("file") ?? ""), bytes: await bytesOf(parts.get("drawing")) };
    return held;
}
