// What the tests of the page in Chromium share: a page on which every complaint of the browser is a problem, and what a person does there.
import { readFileSync } from "node:fs";
import { createServer } from "node:http";
import { createRequire } from "node:module";
import { extname, join, resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { brotliCompressSync, constants } from "node:zlib";

export const packages = createRequire(resolve(process.env.NODE_PATH) + "/");
const { chromium } = packages("playwright-core");
const axe = readFileSync(packages.resolve("axe-core/axe.min.js"), "utf8");
/** Longest wait for anything but a shell, ms. */
export const ORDINARY = 30_000;
/** Most of the window that may move unasked: while the page opens, and while one works with it, which browsers call good below 0.1. */
const SHIFT = 0.005, SHIFT_AT_WORK = 0.1;

const problems = [];
export function must(holds, what) {
    if (!holds) problems.push(what);
}

export const launched = () => chromium.launch({ executablePath: "/usr/bin/chromium", args: ["--no-sandbox"] });

/** The page that works from a disk. */
export const onDisk = (pages) => pathToFileURL(resolve(pages, "stargrip-cam.html")).href;

/** Waits until all files of the present spec are proven. */
export const ready = (page) => page.waitForSelector("#zip:not([disabled])", { state: "attached" });
/** Waits for a note that begins with `text`. */
export const noted = (page, text) => page.waitForFunction((start) => document.getElementById("note").textContent.startsWith(start), text);
/** Waits until the text of the spec holds `text`. */
export const holds = (page, text) => page.waitForFunction((wanted) => document.getElementById("spec").value.includes(wanted), text);
/** Opens what is beside the picture: start, values, text or result. */
export async function beside(page, name) {
    if (await page.isVisible(`#tab-${name}`)) await page.click(`#tab-${name}`);
}

/** A window of the page, in a browser context of its own or in `context`. */
export async function opened(browser, what, viewport, url, { waits = ready, offline = true, colorScheme = "light", context } = {}) {
    const own = context ?? (await browser.newContext({ viewport, acceptDownloads: true, hasTouch: viewport.width < 500, offline, colorScheme, reducedMotion: "reduce" }));
    const page = await own.newPage();
    await page.addInitScript(() => {
        window.shift = 0;
        window.shifts = new PerformanceObserver((list) => list.getEntries().forEach((entry) => (window.shift += entry.hadRecentInput ? 0 : entry.value)));
        window.shifts.observe({ type: "layout-shift", buffered: true });
    });
    page.on("console", (message) => must(!["error", "warning"].includes(message.type()) || message.text().includes("GPU stall"), `${what}: console says ${message.text()}`));
    page.on("pageerror", (error) => must(false, `${what}: ${error}`));
    page.on("dialog", (dialog) => must(false, `${what}: a dialog says ${dialog.message()}`));
    page.on("request", (request) => must(!offline || /^(file|blob|data|about):/.test(request.url()), `${what}: asks for ${request.url().slice(0, 80)}`));
    page.setDefaultTimeout(ORDINARY);
    await page.goto(url);
    await waits(page);
    return page;
}

/** Nothing is too wide, nothing moved unasked, and axe finds nothing. */
export async function fits(page, what, most = SHIFT) {
    const over = await page.evaluate(() => document.documentElement.scrollWidth - document.documentElement.clientWidth);
    must(over <= 0, `${what}: ${over} px too wide`);
    const shift = await page.evaluate(() => window.shift);
    must(shift <= most, `${what}: the layout shifts by ${shift}`);
    await page.evaluate(axe);
    const { violations } = await page.evaluate(() => window.axe.run(document, { iframes: false, runOnly: ["wcag2a", "wcag2aa", "wcag21a", "wcag21aa", "wcag22aa"], rules: { "target-size": { enabled: true } } }));
    for (const { id, nodes } of violations) must(false, `${what}: axe finds ${id} at ${nodes.slice(0, 3).map(({ html }) => html.slice(0, 120)).join(" | ")}`);
}

/** The same by night; and nothing moves for who wants no motion. `picture(scheme)` names the file of a picture. */
export async function fitsAlways(page, what, picture) {
    for (const colorScheme of ["light", "dark"]) {
        await page.emulateMedia({ colorScheme });
        await fits(page, `${what}, ${colorScheme}`, SHIFT_AT_WORK);
        await page.screenshot({ path: picture(colorScheme) });
    }
    await page.emulateMedia({ colorScheme: "light" });
    const moving = await page.evaluate(() => document.getAnimations().length);
    must(moving === 0, `${what}: ${moving} things move in spite of reduced motion`);
}

/** Drops files, each [name, content], on the page. */
export async function dropped(page, ...files) {
    await page.evaluate((list) => {
        const dataTransfer = new DataTransfer();
        for (const [name, content] of list) dataTransfer.items.add(new File([content], name));
        window.dispatchEvent(new DragEvent("drop", { dataTransfer, cancelable: true }));
    }, files);
}

const TYPES = { ".html": "text/html", ".js": "text/javascript", ".wasm": "application/wasm", ".svg": "image/svg+xml", ".webmanifest": "application/manifest+json" };

/** A server of the files below `directory`, packed by brotli if `isPacked`. */
export async function serving(directory, { isPacked = false } = {}) {
    const answers = new Map();
    /** A file, or null without it: a browser asks for some by itself. */
    const content = (name) => {
        try {
            const bytes = readFileSync(join(directory, name));
            return isPacked ? brotliCompressSync(bytes, { params: { [constants.BROTLI_PARAM_QUALITY]: 9 } }) : bytes;
        } catch {
            return null;
        }
    };
    const server = createServer(({ url }, answer) => {
        const path = new URL(url, "http://x").pathname, name = path.endsWith("/") ? `${path}index.html` : path;
        if (!answers.has(name)) answers.set(name, content(name));
        const bytes = answers.get(name), headers = { "Content-Type": TYPES[extname(name)] ?? "text/plain", ...(isPacked && { "Content-Encoding": "br" }) };
        answer.writeHead(bytes ? 200 : 404, bytes ? headers : {}).end(bytes ?? "");
    });
    await new Promise((listens) => server.listen(0, "127.0.0.1", listens));
    return { address: `http://127.0.0.1:${server.address().port}/`, close: () => (server.closeAllConnections(), new Promise((closed) => server.close(closed))) };
}

/** Ends a test called `name`: prints the problems and `summary`. */
export function ended(name, summary) {
    for (const problem of problems) console.error(`${name}: ${problem}`);
    console.log(`${name}: ${summary}; ${problems.length} problems`);
    process.exit(problems.length ? 1 : 0);
}
