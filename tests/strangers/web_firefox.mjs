// The tasks of a person in Firefox, from a disk, at a desk and on a phone; at the desk then a reload, which keeps a drawing.
// Usage: node web_firefox.mjs PAGES OUT, with NODE_PATH at puppeteer-core. OUT gets pictures.
import { mkdirSync } from "node:fs";
import { createRequire } from "node:module";
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { tasks } from "./web_person.mjs";

const packages = createRequire(resolve(process.env.NODE_PATH) + "/");
const { default: puppeteer } = await import(pathToFileURL(packages.resolve("puppeteer-core")));
const [pages, out] = process.argv.slice(2);

const problems = [];
function must(holds, what) {
    if (!holds) problems.push(what);
}

/** Presses keys such as "Control+z". */
async function press(page, keys) {
    const [key, ...held] = keys.split("+").reverse();
    for (const name of held) await page.keyboard.down(name);
    await page.keyboard.press(key);
    for (const name of held) await page.keyboard.up(name);
}

const driver = (page) => ({
    // Out from under the picture, which sticks to the top of a phone.
    click: async (selector) => {
        await page.evaluate((wanted) => document.querySelector(wanted).scrollIntoView({ block: "nearest" }), selector);
        await page.locator(selector).click();
    },
    // As if typed, so that the browser tells of the change.
    fill: (selector, text) => page.evaluate(([wanted, typed]) => {
        const field = document.querySelector(wanted);
        field.focus();
        field.select();
        document.execCommand("insertText", false, typed);
    }, [selector, text]),
    choose: (selector, value) => page.select(selector, value),
    focus: (selector) => page.evaluate((wanted) => document.querySelector(wanted).focus(), selector),
    press: (keys) => press(page, keys),
    wait: (holds, value) => page.waitForFunction(holds, {}, value),
    read: (work, value) => page.evaluate(work, value),
    drop: (...files) => page.evaluate((list) => {
        const dataTransfer = new DataTransfer();
        for (const [name, content] of list) dataTransfer.items.add(new File([content], name));
        window.dispatchEvent(new DragEvent("drop", { dataTransfer, cancelable: true }));
    }, files),
    // The name of what the page saves: this browser reports no downloads.
    download: async (selector) => {
        await page.evaluate(() => (HTMLAnchorElement.prototype.click = function () { window.saved = this.download; }));
        await page.locator(selector).click();
        return page.evaluate(() => window.saved);
    },
    framed: async (selector) => {
        const end = Date.now() + 30_000;
        for (;;) {
            for (const frame of page.frames()) if (frame !== page.mainFrame() && (await frame.$(selector).catch(() => null))) return;
            if (Date.now() > end) throw new Error(`no frame has ${selector}`);
            await new Promise((passed) => setTimeout(passed, 100));
        }
    },
});

mkdirSync(out, { recursive: true });
const browser = await puppeteer.launch({ browser: "firefox", executablePath: "/usr/bin/firefox-esr" });
// One after the other: a page in the background draws nothing, and nothing that waits for a picture goes on.
for (const [what, viewport] of [["desk", { width: 1366, height: 768 }], ["phone", { width: 390, height: 844 }]]) {
    const context = await browser.createBrowserContext(), page = await context.newPage();
    page.setDefaultTimeout(20_000);
    page.on("console", (message) => must(!["error", "warn"].includes(message.type()), `${what}: console says ${message.text()}`));
    page.on("pageerror", (error) => must(false, `${what}: ${error}`));
    await page.setViewport(viewport);
    await page.goto(pathToFileURL(resolve(pages, "stargrip-cam.html")).href);
    await page.waitForSelector("#zip:not([disabled])");
    let task = what;
    for (const [name, work] of Object.entries(tasks(driver(page), (holds, problem) => must(holds, `${task}: ${problem}`)))) {
        task = `${what}, ${name}`;
        await work().catch((error) => must(false, `${task}: ${error.message.split("\n")[0]}`));
        await page.screenshot({ path: join(out, `firefox-${what}-${name.replaceAll(/\W+/g, "-")}.png`) });
    }
    if (what === "phone") break;
    await (await page.$("#open")).uploadFile(resolve("designs/drawings/hand-rest.svg"));
    const isThere = () => page.waitForFunction(() => document.getElementById("spec").value.includes("[drawing.layers]") && document.getElementById("verdict").textContent.startsWith("Can be sealed: 5 seams"));
    await isThere();
    await page.reload();
    await isThere().catch(() => must(false, "after a reload the drawing is lost"));
    await context.close();
}
await browser.close();
for (const problem of problems) console.error(`web_firefox: ${problem}`);
console.log(`web_firefox: 10 tasks at 2 sizes; ${problems.length} problems`);
process.exit(problems.length ? 1 : 0);
