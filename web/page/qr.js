// The link of the spec as a QR code, which leads from a printed sheet back to its parameters.
import { fragmentOf } from "./link.js";
import { save } from "./result.js";

const qrPart = (id) => document.getElementById(`qr${id}`);

/** A code as an SVG of its own, 40 mm wide; its text is the link. */
const svgOf = ({ side, path }) =>
    `<svg xmlns="http://www.w3.org/2000/svg" width="40mm" height="40mm" viewBox="0 0 ${side} ${side}" shape-rendering="crispEdges"><path fill="#fff" d="M0 0h${side}v${side}H0z"/><path d="${path}"/></svg>\n`;

/** The spec without lines that contain only comments, for a coarser code; null if a multi-line text may contain such a line. */
const bare = (text) => (/"""|'''/.test(text) ? null : text.split("\n").filter((line) => !/^\s*(#|$)/.test(line)).join("\n") + "\n");

/** Removes the code of the previous spec. */
export function hideCode() {
    qrPart("").hidden = true;
}

/** Shows the code of the link to `held`, { text, machine, drawing }, in the page at `address`; `ask(question)` makes it. */
export async function showCode(held, address, ask) {
    const short = bare(held.text), { fragment } = await fragmentOf({ ...held, text: short ?? held.text });
    const code = await ask({ ask: "qr", link: address + fragment });
    qrPart("").hidden = false;
    qrPart("-picture").hidden = qrPart("-save").hidden = !code.path;
    const comments = short ? ", without its comments" : "";
    const onDisk = address.startsWith("file:") ? " This page is on a disk, so the code works on this machine alone: use the page on a server for codes that a phone opens." : "";
    qrPart("-note").textContent = code.path ? `It opens this spec in the page${comments}.${onDisk} It is printed with the preview.` : "The link is too long for a QR code: it holds at most 2953 letters. Copy the link.";
    if (!code.path) return;
    const bytes = new TextEncoder().encode(svgOf(code));
    qrPart("-picture").src = URL.createObjectURL(new Blob([bytes], { type: "image/svg+xml" }));
    qrPart("-save").onclick = () => save("link-qr.svg", bytes);
}
