// The page: its program against the command, file by file, then in Chromium with real clicks and keys, at a desk and on a phone.
// Usage: node web.mjs PAGES TOOL OUT, with NODE_PATH at playwright-core and axe-core. OUT gets pictures and builds.
import { execFileSync, spawnSync } from "node:child_process";
import { mkdirSync, readFileSync, readdirSync, rmSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { basename, join, resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { brotliCompressSync } from "node:zlib";

const packages = createRequire(resolve(process.env.NODE_PATH) + "/");
const { chromium } = packages("playwright-core");
const axe = readFileSync(packages.resolve("axe-core/axe.min.js"), "utf8");
const [pages, tool, out] = process.argv.slice(2);
const MOST_BYTES = 1.2e6;
const ORDINARY = 20_000;
const source = readFileSync(new URL("../../web/page/message.js", import.meta.url));
const { asked } = await import(`data:text/javascript;base64,${source.toString("base64")}`);

const problems = [];
function must(holds, what) {
    if (!holds) problems.push(what);
}

/** Files with predicted numbers. The libm of WebAssembly is another, so their last digits may differ; nothing that a machine runs has any. */
const PREDICTED = ["prediction.json", "manifest.json"];
const DIGITS = 12;

/** Whether two files say the same: to the byte, predicted numbers to twelve digits. The manifest has the hash of the prediction. */
function same(name, own, other) {
    if (own.equals(other)) return true;
    const plain = (bytes) => {
        const said = JSON.parse(Buffer.from(bytes), (_, value) => (typeof value === "number" ? Number(value.toPrecision(DIGITS)) : value));
        for (const file of said.files ?? []) if (file.path === "prediction.json") delete file.sha256, delete file.bytes;
        return JSON.stringify(said);
    };
    return PREDICTED.includes(name) && plain(own) === plain(other);
}

/** Every file of every shipped design is the command's. */
async function bytes(program) {
    for (const design of readdirSync("designs")) {
        const spec = join("designs", design), dir = join(out, basename(design, ".toml"));
        rmSync(dir, { recursive: true, force: true });
        execFileSync(tool, ["build", spec, "-o", dir, "--quiet"], { stdio: ["ignore", "ignore", "ignore"] });
        const { files, faults } = asked(program, { ask: "build", spec: readFileSync(spec, "utf8") });
        const names = files.map(({ name }) => name).sort();
        must(names.join() === readdirSync(dir).sort().join(), `${design}: other files: ${names}; ${JSON.stringify(faults)}`);
        for (const { name, bytes } of files) {
            const own = readFileSync(join(dir, name));
            must(same(name, own, bytes), `${design}: ${name} differs from the command's`);
        }
    }
}

/** A page on which every complaint of the browser is a problem. */
async function opened(browser, what, viewport, url, ready = "#zip:not([disabled])") {
    const context = await browser.newContext({ viewport, acceptDownloads: true, hasTouch: viewport.width < 500, offline: true });
    const page = await context.newPage();
    page.on("console", (message) => must(!["error", "warning"].includes(message.type()) || message.text().includes("GPU stall"), `${what}: console says ${message.text()}`));
    page.on("pageerror", (error) => must(false, `${what}: ${error}`));
    page.on("request", (request) => must(/^(file|blob|data):/.test(request.url()), `${what}: asks for ${request.url().slice(0, 80)}`));
    page.setDefaultTimeout(ORDINARY);
    await page.goto(url);
    await page.waitForSelector(ready);
    return page;
}

async function fits(page, what) {
    const over = await page.evaluate(() => document.documentElement.scrollWidth - document.documentElement.clientWidth);
    must(over <= 0, `${what}: ${over} px too wide`);
    await page.evaluate(axe);
    const { violations } = await page.evaluate(() => window.axe.run(document, { iframes: false }));
    const serious = violations.filter(({ impact }) => ["serious", "critical"].includes(impact));
    for (const { id, nodes } of serious) must(false, `${what}: axe finds ${id} at ${nodes.slice(0, 3).map(({ html }) => html.slice(0, 120)).join(" | ")}`);
}

/** From the object to the ZIP, which the command accepts. */
async function bottle(page, what) {
    await page.getByLabel("Width across").fill("75 mm");
    await page.getByLabel("Mass").first().fill("1.2 kg");
    await page.getByText("More about the task").click();
    await page.locator("#object-form [name=friction]").fill("1.0");
    await page.locator("#object-form [name=sheet]").fill("400x400");
    await page.locator("#object-form [name=name]").fill("bottle");
    await page.keyboard.press("Enter");
    await page.waitForFunction(() => document.getElementById("spec").value.includes("bottle"));
    await page.waitForSelector("#zip:not([disabled])");
    must((await page.innerText("#verdict")).startsWith("holds the object"), `${what}: the bottle's verdict is ${await page.innerText("#verdict")}`);
    const [download] = await Promise.all([page.waitForEvent("download"), page.click("#zip")]);
    const file = join(out, `${what}.zip`), dir = join(out, what);
    await download.saveAs(file);
    rmSync(dir, { recursive: true, force: true });
    execFileSync("python3", ["-m", "zipfile", "-e", file, dir]);
    const verified = spawnSync(tool, ["verify", join(dir, "bottle"), "--json"], { encoding: "utf8" });
    const { findings, proven } = JSON.parse(verified.stdout);
    const others = findings.filter(({ file, code }) => !PREDICTED.includes(file) || code !== "differs");
    must(others.length === 0 && proven.length > 15, `${what}: verify finds ${JSON.stringify(others)}`);
    await page.setInputFiles("#open", file);
    await page.waitForFunction(() => document.getElementById("note").textContent.startsWith("Proven, no findings"));
}

/** A typo is told at its place and mended from its message; a slider changes the text and keeps its comments. */
async function mended(page, what) {
    const spec = page.locator("#spec");
    await spec.fill((await spec.inputValue()).replace(/^tube_width/m, "tube_wdith") + "\n# my own words\n");
    await page.waitForSelector("#faults button:text('write tube_width')");
    must(await page.isDisabled("#zip"), `${what}: files of a refused spec can be had`);
    await page.click("#faults button:text('write tube_width')");
    await page.waitForSelector("#zip:not([disabled])");
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
    const other = await opened(browser, `${what}, link`, viewport, page.url(), "#preview:not([hidden])"); // nine points no longer hold the bottle
    must((await other.inputValue("#spec")) === (await page.inputValue("#spec")), `${what}: the link holds another spec`);
    await other.close();
}

async function report(page, what) {
    await page.getByText("Report: player").click();
    await page.frameLocator("#report").locator("#name").filter({ hasText: "bottle" }).waitFor();
    must(await page.locator("#report").isVisible(), `${what}: no report`);
}

mkdirSync(out, { recursive: true });
const binary = readFileSync(join(pages, "stargrip-cam.wasm"));
const size = brotliCompressSync(binary).length;
must(size <= MOST_BYTES, `the program has ${size} bytes by brotli`);
const { exports: program } = await WebAssembly.instantiate(await WebAssembly.compile(binary), {});
await bytes(program);
const browser = await chromium.launch({ executablePath: "/usr/bin/chromium", args: ["--no-sandbox"] });
for (const [what, viewport] of [["desktop", { width: 1280, height: 900 }], ["phone", { width: 360, height: 740 }]]) {
    try {
        const page = await opened(browser, what, viewport, pathToFileURL(resolve(pages, "stargrip-cam.html")).href);
        await fits(page, what);
        await page.screenshot({ path: join(out, `${what}.png`), fullPage: true });
        await bottle(page, what);
        await mended(page, what);
        await reopened(browser, page, what, viewport);
        await report(page, what);
        await page.screenshot({ path: join(out, `${what}-worked.png`), fullPage: true });
    } catch (error) {
        must(false, `${what}: ${error.message.split("\n").slice(0, 3).join(" ")}`);
    }
}
await browser.close();
writeFileSync(join(out, "problems.txt"), problems.join("\n"));
for (const problem of problems) console.error(problem);
console.log(`web: the program has ${(size / 1e6).toFixed(2)} MB by brotli; ${problems.length} problems`);
process.exit(problems.length ? 1 : 0);
