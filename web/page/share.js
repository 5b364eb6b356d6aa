// The link of the spec as a QR code, which leads from a printed sheet back to its parameters.
import { byId } from "./dom.js";
import { save } from "./result.js";

const qrPart = (id) => byId(`qr${id}`);

/** Least width of a code, mm, and the width of a module of a large one, so that phones read it from paper. */
const WIDTH = 40, MODULE = 0.5;

/** A code as an SVG of its own; its text is the link. */
function svgOf({ side, path }) {
    const width = Math.max(WIDTH, MODULE * side);
    return `<svg xmlns="http://www.w3.org/2000/svg" width="${width}mm" height="${width}mm" viewBox="0 0 ${side} ${side}" shape-rendering="crispEdges"><path fill="#fff" d="M0 0h${side}v${side}H0z"/><path d="${path}"/></svg>\n`;
}

/** Removes the code of the previous spec. */
export function hideCode() {
    qrPart("").hidden = true;
}

/** Shows the code of the link to a spec in the page at `address`; `ask(question)` makes it. */
export async function showCode(address, ask) {
    const onDisk = address.startsWith("file:") ? " This page is on a disk, so the code works on this machine alone: use the page on a server for codes that a phone opens." : "";
    qrPart("-note").textContent = `It opens this spec in the page, without comment lines.${onDisk} It is printed with the preview.`;
    // Its room at once, so that nothing moves later.
    qrPart("").hidden = qrPart("-picture").hidden = qrPart("-save").hidden = false;
    qrPart("-save").disabled = true;
    const code = await ask({ ask: "qr", address });
    qrPart("-save").disabled = false;
    if (!code.path) {
        qrPart("-picture").hidden = qrPart("-save").hidden = true;
        qrPart("-note").textContent = "The link is too long for a QR code: it holds at most 2953 letters. Copy the link.";
        return;
    }
    const bytes = new TextEncoder().encode(svgOf(code));
    qrPart("-picture").src = URL.createObjectURL(new Blob([bytes], { type: "image/svg+xml" }));
    qrPart("-save").onclick = () => save("link-qr.svg", bytes);
}
