// The page in Chromium, with real clicks and keys, at a desk and on a phone, without a network.
// Usage: node web.mjs PAGES TOOL OUT, with NODE_PATH at playwright-core and axe-core. OUT gets pictures and builds.
import { execFileSync, spawnSync } from "node:child_process";
import { mkdirSync, readFileSync, rmSync } from "node:fs";
import { createServer } from "node:http";
import { createRequire } from "node:module";
import { extname, join, resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { deflateRawSync } from "node:zlib";

const packages = createRequire(resolve(process.env.NODE_PATH) + "/");
const { chromium } = packages("playwright-core");
const axe = readFileSync(packages.resolve("axe-core/axe.min.js"), "utf8");
const [pages, tool, out] = process.argv.slice(2);
const ORDINARY = 30_000;
/** Most of the window that may move unasked: what a browser calls a good layout shift is below 0.1. */
const SHIFT = 0.02;
const ONE_FILE = pathToFileURL(resolve(pages, "stargrip-cam.html")).href;

const problems = [], times = {};
function must(holds, what) {
    if (!holds) problems.push(what);
}

/** A page on which every complaint of the browser is a problem, and so is what moves unasked. */
async function opened(browser, what, viewport, url, { ready = "#zip:not([disabled])", offline = true } = {}) {
    const context = await browser.newContext({ viewport, acceptDownloads: true, hasTouch: viewport.width < 500, offline });
    await context.addInitScript(() => {
        window.shift = 0;
        new PerformanceObserver((list) => list.getEntries().forEach((entry) => (window.shift += entry.hadRecentInput ? 0 : entry.value))).observe({ type: "layout-shift", buffered: true });
    });
    const page = await context.newPage();
    page.on("console", (message) => must(!["error", "warning"].includes(message.type()) || message.text().includes("GPU stall"), `${what}: console says ${message.text()}`));
    page.on("pageerror", (error) => must(false, `${what}: ${error}`));
    page.on("dialog", (dialog) => must(false, `${what}: a dialog says ${dialog.message()}`));
    page.on("request", (request) => must(!offline || /^(file|blob|data):/.test(request.url()), `${what}: asks for ${request.url().slice(0, 80)}`));
    page.setDefaultTimeout(ORDINARY);
    await page.goto(url);
    await page.waitForSelector(ready);
    return page;
}

const ready = (page) => page.waitForSelector("#zip:not([disabled])");
const noted = (page, text) => page.waitForFunction((start) => document.getElementById("note").textContent.startsWith(start), text);

async function fits(page, what) {
    const over = await page.evaluate(() => document.documentElement.scrollWidth - document.documentElement.clientWidth);
    must(over <= 0, `${what}: ${over} px too wide`);
    const shift = await page.evaluate(() => window.shift);
    must(shift <= SHIFT, `${what}: the layout shifts by ${shift}`);
    await page.evaluate(axe);
    const { violations } = await page.evaluate(() => window.axe.run(document, { iframes: false }));
    const serious = violations.filter(({ impact }) => ["serious", "critical"].includes(impact));
    for (const { id, nodes } of serious) must(false, `${what}: axe finds ${id} at ${nodes.slice(0, 3).map(({ html }) => html.slice(0, 120)).join(" | ")}`);
}

/** Downloads the ZIP; the command proves what is in it. */
async function zipped(page, what, folder, least) {
    const [download] = await Promise.all([page.waitForEvent("download"), page.click("#zip")]);
    const file = join(out, `${what}.zip`), dir = join(out, what);
    await download.saveAs(file);
    rmSync(dir, { recursive: true, force: true });
    execFileSync("python3", ["-m", "zipfile", "-e", file, dir]);
    const { status, stdout } = spawnSync(tool, ["verify", join(dir, folder), "--json"], { encoding: "utf8" });
    must(status === 0 && JSON.parse(stdout).proven.length > least, `${what}: verify ends with ${status}: ${stdout.slice(0, 400)}`);
    return file;
}

/** From the object to the ZIP, which the command accepts, and the page as well. */
async function bottle(page, what) {
    await page.getByLabel("Width across").fill("75 mm");
    await page.getByLabel("Mass").first().fill("1.2 kg");
    await page.getByText("More about the task").click();
    await page.locator("#object-form [name=friction]").fill("1.0");
    await page.locator("#object-form [name=sheet]").fill("400x400");
    await page.locator("#object-form [name=name]").fill("bottle");
    await page.keyboard.press("Enter");
    await page.waitForFunction(() => document.getElementById("spec").value.includes("bottle"));
    await ready(page);
    must((await page.innerText("#verdict")).startsWith("holds the object"), `${what}: the bottle's verdict is ${await page.innerText("#verdict")}`);
    const file = await zipped(page, `${what}-bottle`, "bottle", 15);
    await page.setInputFiles("#open", file);
    await noted(page, "Proven, no findings");
}

/** A typo is told at its place and mended from its message; a slider changes the text and keeps its comments. */
async function mended(page, what) {
    const spec = page.locator("#spec");
    await spec.fill((await spec.inputValue()).replace(/^tube_width/m, "tube_wdith") + "\n# my own words\n");
    await page.waitForSelector("#faults button:text('write tube_width')");
    must(await page.isDisabled("#zip"), `${what}: files of a refused spec can be had`);
    await page.click("#faults button:text('write tube_width')");
    await ready(page);
    const points = page.getByLabel("points, slider");
    const before = await points.inputValue();
    await points.focus();
    await page.keyboard.press("ArrowRight");
    const after = String(Number(before) + 1);
    await page.waitForFunction((number) => document.getElementById("spec").value.includes(`points = ${number}`), after);
    must((await spec.inputValue()).includes("# my own words"), `${what}: a comment is lost`);
}

/** A link holds the spec as it stands. */
async function reopened(browser, page, what, viewport) {
    await page.click("#copy-link");
    await page.waitForFunction(() => location.hash.startsWith("#spec="));
    const other = await opened(browser, `${what}, link`, viewport, page.url(), { ready: "#preview:not([hidden])" }); // nine points no longer hold the bottle
    must((await other.inputValue("#spec")) === (await page.inputValue("#spec")), `${what}: the link holds another spec`);
    await other.close();
}

async function report(page, what) {
    await page.getByText("Report: player").click();
    await page.frameLocator("#report").locator("#name").filter({ hasText: "bottle" }).waitFor();
    must(await page.locator("#report").isVisible(), `${what}: no report`);
}

/** A drawing that is dropped becomes a spec, and then files that the command accepts. */
async function drawn(page, what) {
    const svg = readFileSync("designs/drawings/hand-rest.svg", "utf8");
    await page.evaluate((text) => {
        const dataTransfer = new DataTransfer();
        dataTransfer.items.add(new File([text], "hand-rest.svg"));
        window.dispatchEvent(new DragEvent("drop", { dataTransfer, cancelable: true }));
    }, svg);
    await noted(page, "A spec of hand-rest.svg: 3 layers");
    must((await page.inputValue("#spec")).includes("[drawing.layers]"), `${what}: no spec of the drawing`);
    await ready(page);
    await zipped(page, `${what}-drawing`, "hand-rest", 5);
}

/** Names that would do something if they were taken for more than text; broken links; an instance that dies. */
async function hostile(page, what) {
    const shipped = readFileSync("designs/paper-five-points.toml", "utf8");
    for (const name of ["<img src=x onerror=alert(1)>", "</script><script>alert(1)</script>", "${alert(1)}", "&lt;b&gt;", "javascript:alert(1)", "../../x", "]]>", "a\\\" onload=\\\"alert(1)"]) {
        await page.fill("#spec", shipped.replace(/^name = .*/m, `name = "${name}"`));
        await ready(page);
    }
    const bomb = deflateRawSync(Buffer.alloc(1 << 26)).toString("base64url");
    for (const link of ["%", "AAAA", bomb]) {
        await page.evaluate((fragment) => (location.hash = fragment), `spec=${link}`);
        await noted(page, "This broke off");
        must((await page.inputValue("#spec")).includes("[star]"), `${what}: a bad link takes the text`);
        await page.evaluate(() => (document.getElementById("note").textContent = ""));
    }
    for (const worker of page.workers()) await worker.evaluate("program = null");
    await page.fill("#spec", `${shipped}\n# more\n`);
    await noted(page, "This broke off");
    must((await page.inputValue("#spec")).endsWith("# more\n"), `${what}: the text is lost with the instance`);
    await page.fill("#spec", shipped);
    await page.waitForSelector("#preview:not([hidden])");
    await ready(page);
}

/** The page on a server: installed, it opens without one. */
async function served(browser) {
    const types = { ".html": "text/html", ".js": "text/javascript", ".wasm": "application/wasm", ".svg": "image/svg+xml", ".webmanifest": "application/manifest+json" };
    const server = createServer(({ url }, answer) => {
        const name = url === "/" ? "index.html" : url.slice(1);
        answer.writeHead(200, { "Content-Type": types[extname(name)] ?? "text/plain" }).end(readFileSync(join(pages, name)));
    });
    await new Promise((listens) => server.listen(0, "127.0.0.1", listens));
    const page = await opened(browser, "server", { width: 1280, height: 900 }, `http://127.0.0.1:${server.address().port}/`, { offline: false });
    await page.evaluate(async () => {
        const { active, installing, waiting } = await navigator.serviceWorker.ready;
        const worker = active ?? waiting ?? installing;
        if (worker.state !== "activated") await new Promise((is) => worker.addEventListener("statechange", () => worker.state === "activated" && is()));
    });
    server.closeAllConnections();
    await new Promise((closed) => server.close(closed));
    await page.reload();
    await ready(page);
    await page.context().close();
}

/** How long a person waits, ms: a preview after opening, one after an edit, all files with their proof. */
async function waits(page) {
    const first = await page.evaluate(() => performance.getEntriesByName("preview")[0]?.startTime);
    const edits = [], builds = [];
    const text = readFileSync("designs/paper-gripper.toml", "utf8");
    for (let i = 0; i < 7; i++) {
        await page.fill("#spec", `${text}\n# ${i}\n`);
        await ready(page);
        edits.push(Number(await page.evaluate(() => document.documentElement.dataset.look)));
        builds.push(Number(await page.evaluate(() => document.documentElement.dataset.built)));
    }
    const middle = (list) => list.sort((a, b) => a - b)[list.length >> 1];
    Object.assign(times, { first: Math.round(first), edit: middle(edits), build: middle(builds) });
}

mkdirSync(out, { recursive: true });
const browser = await chromium.launch({ executablePath: "/usr/bin/chromium", args: ["--no-sandbox"] });
for (const [what, viewport] of [["desktop", { width: 1280, height: 900 }], ["phone", { width: 360, height: 740 }]]) {
    try {
        const page = await opened(browser, what, viewport, ONE_FILE);
        await fits(page, what);
        await page.screenshot({ path: join(out, `${what}.png`), fullPage: true });
        if (what === "desktop") await waits(page);
        await bottle(page, what);
        await mended(page, what);
        await reopened(browser, page, what, viewport);
        await report(page, what);
        await page.screenshot({ path: join(out, `${what}-worked.png`), fullPage: true });
        await drawn(page, what);
        await page.screenshot({ path: join(out, `${what}-drawn.png`), fullPage: true });
        if (what === "desktop") await hostile(page, what);
    } catch (error) {
        must(false, `${what}: ${error.message.split("\n").slice(0, 3).join(" ")}`);
    }
}
await served(browser).catch((error) => must(false, `server: ${error.message.split("\n")[0]}`));
await browser.close();
for (const problem of problems) console.error(problem);
console.log(`web: first preview ${times.first} ms after opening, ${times.edit} ms after an edit, files proven in ${times.build} ms; ${problems.length} problems`);
process.exit(problems.length ? 1 : 0);
