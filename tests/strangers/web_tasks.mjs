// Ten tasks of a person, by clicks and keys in Chromium, at a desk and on a phone: each control and each answer is at most one scroll away.
// Usage: node web_tasks.mjs PAGES OUT, with NODE_PATH at playwright-core and axe-core. OUT gets pictures.
import { mkdirSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { beside, dropped, ended, fits, holds, launched, must, onDisk, opened, ready } from "./web_page.mjs";

const [pages, out] = process.argv.slice(2);
const drawing = (name) => [name, readFileSync(join("designs/drawings", name), "utf8")];

/** Distance of an element from the window, in heights of what scrolls it; 0 if it is in sight. */
const distance = (page, selector) => page.locator(selector).first().evaluate((element) => {
    const { top, bottom, height } = element.getBoundingClientRect();
    const own = (part) => part && (part.scrollHeight > part.clientHeight + 1 && /auto|scroll/.test(getComputedStyle(part).overflowY) ? part : own(part.parentElement));
    const frame = own(element.parentElement)?.getBoundingClientRect() ?? { top: 0, bottom: innerHeight, height: innerHeight };
    const part = Math.min(height, 40);
    return Math.max(frame.top - (bottom - part), top + part - Math.min(frame.bottom, innerHeight), 0) / Math.min(frame.height, innerHeight);
});

/** Checks that `selector` is at most one scroll away, and returns it. */
async function near(page, task, selector) {
    await page.waitForSelector(selector);
    const far = await distance(page, selector);
    must(far <= 1, `${task}: ${selector} is ${far.toFixed(1)} windows away`);
    return page.locator(selector).first();
}

const click = async (page, task, selector) => (await near(page, task, selector)).click();
const fill = async (page, task, selector, text) => (await near(page, task, selector)).fill(text);
const verdict = async (page, task, pattern) => {
    await page.waitForFunction(([source]) => new RegExp(source).test(document.getElementById("verdict").textContent), [pattern.source]);
    await near(page, task, "#verdict");
};

const TASKS = {
    "hold an object": async (page, task) => {
        await beside(page, "start");
        await fill(page, task, "#object-form [name=object]", "75 mm");
        await fill(page, task, "#object-form [name=mass]", "200 g");
        await page.keyboard.press("Enter");
        await holds(page, 'name = "gripper"');
        await verdict(page, task, /^Holds the object/);
    },
    "try a value and take it back": async (page, task) => {
        await beside(page, "values");
        const before = await page.inputValue("#spec");
        await (await near(page, task, "[aria-label='points, slider']")).focus();
        await page.keyboard.press("ArrowRight");
        await page.waitForFunction((text) => document.getElementById("spec").value !== text, before);
        await page.keyboard.press("Control+z");
        await page.waitForFunction((text) => document.getElementById("spec").value === text, before);
    },
    "learn why a machine refuses, and mend it": async (page, task) => {
        await (await near(page, task, "#machine")).selectOption("grbl");
        await near(page, task, "#fault strong");
        must(/runs this at/.test(await page.innerText("#fault strong")), `${task}: the box says ${await page.innerText("#fault")}`);
        must((await distance(page, "#fault strong")) === 0, `${task}: the fault is out of sight`);
        await click(page, task, "#fault .remedy");
        await holds(page, 'feed_floor = "chop"');
        await verdict(page, task, /^Holds/);
    },
    "find a fault in the text": async (page, task) => {
        await beside(page, "text");
        await page.fill("#spec", (await page.inputValue("#spec")).replace(/^tube_width/m, "tube_wdith"));
        await click(page, task, "#fault-show");
        must((await page.evaluate(() => document.getElementById("spec").value.slice(document.getElementById("spec").selectionStart).startsWith("tube_wdith"))), `${task}: "show" selects something else`);
        must((await distance(page, "#mirror .bad")) === 0, `${task}: the line is out of sight`);
        await click(page, task, "#fault .remedy");
        await verdict(page, task, /^Holds/);
    },
    "download all files": async (page, task) => {
        await ready(page);
        await beside(page, "result");
        const [download] = await Promise.all([page.waitForEvent("download"), click(page, task, "#zip")]);
        must(download.suggestedFilename() === "gripper.zip", `${task}: the file is ${download.suggestedFilename()}`);
        const first = await page.locator("#files button").first().innerText();
        must(first.includes("trace"), `${task}: the first file is ${first}, not the trace`);
    },
    "read the names on the picture": async (page, task) => {
        await beside(page, "start");
        await (await near(page, task, "#designs")).selectOption("hand-rest");
        await verdict(page, task, /^Can be sealed: 5 seams, 2 h 16 min, 242 x 102 mm/);
        await click(page, task, "#zoom-in");
        await page.locator("#canvas .feel").first().focus();
        must(/^crease-left of piece 1, sealed 1st, 32 mm/.test(await page.innerText("#hint")), `${task}: the seam is called ${await page.innerText("#hint")}`);
        const letters = await page.$$eval("#canvas text", (list) => list.map((text) => text.getBoundingClientRect().height).filter((height) => height > 0));
        must(letters.length > 0 && Math.min(...letters) >= 11, `${task}: letters of ${Math.min(...letters)} px`);
        await click(page, task, "#zoom-fit");
    },
    "seal an own drawing": async (page, task) => {
        await dropped(page, drawing("letters.svg"));
        await holds(page, "letters.svg");
        await verdict(page, task, /^Can be sealed: 2 seams/);
    },
    "say what a curve is": async (page, task) => {
        await click(page, task, "#view-drawing");
        await page.locator("#canvas .feel[aria-label*=port]").first().focus();
        await page.keyboard.press("Enter");
        await click(page, task, "#roles label:has([value=ignore])");
        await page.waitForSelector("#canvas .mark");
        must((await distance(page, "#fault strong")) === 0 && (await page.innerText("#fault strong")).includes("no port"), `${task}: the fault is not at the drawing`);
        await click(page, task, "#undo");
        await verdict(page, task, /^Can be sealed: 2 seams/);
        await click(page, task, "#view-sheet");
    },
    "give it a pressure and see it in three dimensions": async (page, task) => {
        await beside(page, "values");
        await fill(page, task, "#field-load\\.pressure", "5 kPa");
        await page.keyboard.press("Enter");
        await holds(page, 'pressure = "5 kPa"');
        await click(page, task, "#view-solid");
        await page.frameLocator("#report-box iframe:not(.next)").locator("body.only-solid #solid-view").waitFor();
        await click(page, task, "#view-sheet");
    },
    "send a link, and find an earlier spec again": async (page, task) => {
        await click(page, task, "#copy-link");
        await page.waitForFunction(() => location.hash.startsWith("#spec="));
        await beside(page, "start");
        await click(page, task, "#recent-list .open:has(b:text-is('gripper'))");
        await holds(page, 'name = "gripper"');
        await verdict(page, task, /^Holds the object/);
    },
};

mkdirSync(out, { recursive: true });
const browser = await launched();
const sizes = [["desk", { width: 1366, height: 768 }], ["phone", { width: 390, height: 844 }]];
await Promise.all(sizes.map(async ([what, viewport]) => {
    const page = await opened(browser, what, viewport, onDisk(pages));
    for (const [name, work] of Object.entries(TASKS)) {
        const task = `${what}, ${name}`;
        await work(page, task).catch((error) => must(false, `${task}: ${error.message.split("\n").slice(0, 2).join(" ")}`));
        await page.screenshot({ path: join(out, `task-${what}-${name.replaceAll(/\W+/g, "-")}.png`) });
    }
    await fits(page, what, 0.1);
}));
// The page at five sizes, as it begins.
for (const [width, height] of [[1366, 768], [1920, 1080], [1024, 768], [768, 1024], [390, 844]]) {
    const page = await opened(browser, `${width}`, { width, height }, onDisk(pages));
    await fits(page, `${width} x ${height}`);
    const nested = await page.evaluate(() => {
        const scrolls = (part) => part.scrollHeight > part.clientHeight + 1 && /auto|scroll/.test(getComputedStyle(part).overflowY);
        return [...document.querySelectorAll("main *")].filter((part) => scrolls(part) && part.parentElement.closest("main *") && [...document.querySelectorAll("main *")].some((other) => other !== part && other.contains(part) && scrolls(other))).length;
    });
    must(nested === 0, `${width} x ${height}: ${nested} scrolls within a scroll`);
    await page.screenshot({ path: join(out, `page-${width}.png`) });
    await page.context().close();
}
await browser.close();
ended("web_tasks", `${Object.keys(TASKS).length} tasks at ${sizes.length} sizes`);
