// The tasks of a person in Chromium, at a desk and on a phone; then the page at six sizes as it begins, and the letters of its pictures.
// Usage: node web_tasks.mjs PAGES OUT, with NODE_PATH at playwright-core and axe-core. OUT gets pictures.
import { mkdirSync } from "node:fs";
import { join } from "node:path";
import { beside, dropped, ended, fits, launched, must, onDisk, opened } from "./web_page.mjs";
import { lettersOf, tasks } from "./web_person.mjs";

const [pages, out] = process.argv.slice(2);
/** Height of the smallest letters of a picture, px. */
const LEAST_LETTERS = 11;

const driver = (page) => ({
    click: (selector) => page.locator(selector).first().click(),
    fill: (selector, text) => page.fill(selector, text),
    choose: (selector, value) => page.selectOption(selector, value),
    focus: (selector) => page.locator(selector).first().focus(),
    press: (key) => page.keyboard.press(key),
    wait: (holds, value) => page.waitForFunction(holds, value),
    read: (work, value) => page.evaluate(work, value),
    drop: (...files) => dropped(page, ...files),
    download: async (selector) => (await Promise.all([page.waitForEvent("download"), page.click(selector)]))[0].suggestedFilename(),
    framed: (selector) => page.frameLocator("#report-box iframe:not(.next)").locator(selector).waitFor(),
});

/** Every letter of every shipped picture can be read: at once, or, where another one is in its place, after two clicks. */
async function letters(page, what) {
    for (const name of await page.$$eval("#designs option", (options) => options.map(({ value }) => value).filter(Boolean))) {
        await beside(page, "start");
        const before = await page.locator("#canvas").innerHTML();
        await page.selectOption("#designs", name);
        await page.waitForFunction((picture) => document.getElementById("canvas").innerHTML !== picture, before);
        const { least } = await page.evaluate(lettersOf);
        for (let i = 0; i < 2; i++) await page.click("#zoom-in");
        const { all, shown, least: zoomed } = await page.evaluate(lettersOf);
        must(Math.min(least, zoomed) >= LEAST_LETTERS - 0.01, `${what}, ${name}: letters of ${least} px`);
        must(shown === all, `${what}, ${name}: after two clicks ${all - shown} of ${all} names are hidden`);
        await page.click("#zoom-fit");
        if (!(await page.isVisible("#view-drawing"))) continue;
        await page.click("#view-drawing");
        const hidden = await page.$$eval("#canvas .feel", (curves) => curves.filter((curve) => {
            const { a, d, e, f } = curve.getScreenCTM(), length = curve.getTotalLength();
            const places = [0, 1, 2, 3, 4, 5, 6].map((part) => curve.getPointAtLength((part * length) / 7));
            return !places.some(({ x, y }) => document.elementFromPoint(a * x + e, d * y + f) === curve);
        }).map((curve) => curve.getAttribute("aria-label")));
        must(hidden.length === 0, `${what}, ${name}: a pointer does not find ${hidden}`);
        await page.click("#view-sheet");
    }
}

mkdirSync(out, { recursive: true });
const browser = await launched();
const sizes = [["desk", { width: 1366, height: 768 }], ["phone", { width: 390, height: 844 }]];
await Promise.all(sizes.map(async ([what, viewport]) => {
    const page = await opened(browser, what, viewport, onDisk(pages));
    let task = what;
    for (const [name, work] of Object.entries(tasks(driver(page), (holds, problem) => must(holds, `${task}: ${problem}`)))) {
        task = `${what}, ${name}`;
        await work().catch((error) => must(false, `${task}: ${error.message.split("\n").slice(0, 2).join(" ")}`));
        await page.screenshot({ path: join(out, `task-${what}-${name.replaceAll(/\W+/g, "-")}.png`) });
    }
    await fits(page, what, 0.1);
}));
await Promise.all([[1366, 768], [1920, 1080], [1024, 768], [768, 1024], [390, 844], [740, 360]].map(async ([width, height]) => {
    const what = `${width} x ${height}`, page = await opened(browser, what, { width, height }, onDisk(pages));
    await fits(page, what);
    const nested = await page.evaluate(() => {
        const scrolls = (part) => part.scrollHeight > part.clientHeight + 1 && /auto|scroll/.test(getComputedStyle(part).overflowY);
        return [...document.querySelectorAll("main *")].filter((part) => scrolls(part) && part.parentElement.closest("main *") && [...document.querySelectorAll("main *")].some((other) => other !== part && other.contains(part) && scrolls(other))).length;
    });
    must(nested === 0, `${what}: ${nested} scrolls within a scroll`);
    await page.screenshot({ path: join(out, `page-${width}.png`) });
    await letters(page, what);
    await page.context().close();
}));
await browser.close();
ended("web_tasks", `10 tasks at ${sizes.length} sizes, letters at 6`);
