// Chromium opens report.html: as a person at a desk and one with a phone, by day and by night; every control is worked by real
// clicks and keys. Usage: node report.mjs FOLDER OUT all|some, with NODE_PATH at playwright-core and axe-core. Pictures are left in OUT.
import { readFileSync, writeFileSync, mkdirSync } from "node:fs";
import { createRequire } from "node:module";
import { basename, join, resolve } from "node:path";
import { execFileSync } from "node:child_process";
import { pathToFileURL } from "node:url";
import { isDeepStrictEqual } from "node:util";

const packages = createRequire(resolve(process.env.NODE_PATH) + "/");
const { chromium } = packages("playwright-core");
const axe = readFileSync(packages.resolve("axe-core/axe.min.js"), "utf8");

const [folder, out, views] = process.argv.slice(2);
const name = basename(folder);
const file = join(folder, "report.html");
const page_url = pathToFileURL(resolve(file)).href;
const prediction = read("prediction.json");
const manifest = read("manifest.json");
const SIZES = { desktop: { width: 1280, height: 900 }, phone: { width: 360, height: 740 } };
const PAGES = 5;
mkdirSync(out, { recursive: true });

function read(own) {
    try {
        return JSON.parse(readFileSync(join(folder, own), "utf8"));
    } catch {
        return null;
    }
}

const problems = [];
function must(holds, what) {
    if (!holds) problems.push(`${name}: ${what}`);
}

/** A page on which every complaint of the browser is a problem. */
async function opened(browser, size, scheme) {
    const context = await browser.newContext({ viewport: SIZES[size], colorScheme: scheme, deviceScaleFactor: 1, hasTouch: size === "phone", reducedMotion: "reduce" });
    const page = await context.newPage();
    page.on("console", (message) => must(!["error", "warning"].includes(message.type()) || message.text().includes("GPU stall"), `${size}, ${scheme}: console says ${message.text()}`));
    page.on("pageerror", (error) => must(false, `${size}, ${scheme}: ${error}`));
    page.on("request", (request) => must(request.url() === page_url, `${size}, ${scheme}: asks for ${request.url().slice(0, 80)}`));
    await page.addInitScript(() => {
        window.shifts = 0;
        new PerformanceObserver((list) => {
            for (const entry of list.getEntries()) if (!entry.hadRecentInput) window.shifts += entry.value;
        }).observe({ type: "layout-shift", buffered: true });
    });
    await page.goto(page_url);
    await page.waitForFunction(() => document.getElementById("solid-view").dataset.drawn || document.getElementById("solid-view").hidden);
    return page;
}

const text = (page, id) => page.locator(`#${id}`).innerText();

/** Nothing is wider than the window, and what has to be seen has a box. */
async function fits(page, what) {
    const wide = await page.evaluate(() => {
        const most = document.documentElement.clientWidth;
        const inside = (element) => element.closest(".scroll, svg, .skip");
        const over = [...document.querySelectorAll("body *")].filter((element) => !inside(element) && element.getBoundingClientRect().right > most + 1);
        return { over: over.map((element) => `${element.tagName}#${element.id}.${element.className}`).slice(0, 5), whole: document.documentElement.scrollWidth - most };
    });
    must(wide.whole <= 0 && wide.over.length === 0, `${what}: ${wide.whole} px too wide: ${wide.over}`);
    for (const id of ["banner", "figures", "star-flat", "job", "solid-view", "seams", "parts", "setting-list", "sources"]) {
        const box = await page.locator(`#${id}`).boundingBox();
        must(box && box.width > 100 && box.height > 60, `${what}: #${id} has the box ${JSON.stringify(box)}`);
    }
    const shifts = await page.evaluate(() => window.shifts);
    must(shifts < 0.02, `${what}: the page shifts by ${shifts}`);
}

/** The block of figures is that of the files beside it, and shown. */
async function figures(page) {
    const data = await page.evaluate(() => JSON.parse(document.getElementById("data").textContent));
    must(isDeepStrictEqual(data.prediction, prediction), "another prediction than prediction.json");
    must(data.bill.fabric_mm2 === manifest.fabric_mm2, "another bill than manifest.json");
    must((await text(page, "name")) === manifest.name, "another name");
    if (prediction && prediction.final_radius_mm) {
        const shown = await text(page, "figures");
        // As many digits as its range leaves: three, or one less where the last is a zero.
        const size = (2 * prediction.final_radius_mm).toPrecision(3);
        must([size, `${Number(size)}`].some((mm) => shown.includes(`${mm} mm`)), `no final diameter in ${shown}`);
    }
    const rows = await page.locator("#seams tbody tr").count();
    must(rows === manifest.stars.flatMap((star) => star.seams).length, `${rows} rows of seams`);
}

/** The slider of pressure opens and closes the star. */
async function pressure(page) {
    if (!(await page.locator("#star-controls").isVisible())) return must(!prediction || prediction.final_radius_mm === null, "no slider of pressure");
    const radius = async () => Number((await page.locator("#star-round .size").textContent()).split(" ")[0]);
    const flat = Number((await page.locator("#star-flat .size").textContent()).split(" ")[0]);
    const shut = await radius();
    must(shut < flat, `inflated ${shut} mm, flat ${flat} mm`);
    await page.locator("#star-pressure").focus();
    await page.keyboard.press("Home");
    const least = await radius();
    must(least < flat && least >= shut, `${least} mm at the least pressure that is known, ${flat} mm flat`);
    for (let i = 0; i < 4; i += 1) await page.keyboard.press("PageUp");
    must((await radius()) <= least, "keys do not inflate");
    const box = await page.locator("#star-pressure").boundingBox();
    await page.mouse.click(box.x + box.width * 0.98, box.y + box.height / 2);
    must((await radius()) <= shut + 0.5, "a click near the end does not close it");
    await page.locator("#star-pump").click();
    const same = (size) => Number(document.querySelector("#star-round .size").textContent.split(" ")[0]) === size;
    await page.waitForFunction(same, shut, { timeout: 30000 }).catch(() => must(false, "pumped up, it is not as at the beginning"));
    return undefined;
}

/** The player: time, layers, zoom, seams. */
async function player(page, size) {
    const iron = () => page.locator("#job .iron").getAttribute("transform");
    const begin = await iron();
    const sealed = () => page.locator("#job .done").evaluateAll((paths) => paths.map((path) => Number(path.getAttribute("stroke-dasharray").split(" ")[0])));
    must((await sealed()).every((part) => part === 0), "sealed before the beginning");
    const slider = page.locator("#job-time");
    await slider.scrollIntoViewIfNeeded();
    const box = await slider.boundingBox();
    await page.mouse.click(box.x + box.width * 0.1, box.y + box.height / 2);
    must((await iron()) !== begin, "a click on the time does not move the iron");
    const early = (await sealed()).reduce((a, b) => a + b, 0);
    await slider.focus();
    await page.keyboard.press("PageUp");
    const later = (await sealed()).reduce((a, b) => a + b, 0);
    must(early > 0 && later > early, `sealed ${early}, a key later ${later}`);
    await page.locator("#job-play").click();
    const on = (before) => [...document.querySelectorAll("#job .done")].reduce((sum, path) => sum + Number(path.getAttribute("stroke-dasharray").split(" ")[0]), 0) > before;
    await page.waitForFunction(on, later, { timeout: 30000 }).catch(() => must(false, "play does not go on"));
    await page.locator("#job-play").click();
    const paused = await iron();
    await page.waitForTimeout(200);
    must((await iron()) === paused, "pause goes on");
    for (const layer of ["fabric", "tube", "bands", "travels"]) {
        const shown = () => page.locator(`#job .layer.${layer}`).evaluate((group) => getComputedStyle(group).display !== "none");
        const before = await shown();
        await page.locator(`[data-layer="${layer}"]`).click();
        must((await shown()) === !before, `layer ${layer} is not switched`);
        await page.locator(`[data-layer="${layer}"]`).press("Space");
        must((await shown()) === before, `layer ${layer} is not switched back by a key`);
    }
    const view = () => page.locator("#job").getAttribute("viewBox");
    const whole = await view();
    await page.locator("#job-in").click();
    const near = await view();
    must(Number(near.split(" ")[2]) < Number(whole.split(" ")[2]), "zoom in");
    await page.locator("#job").focus();
    await page.keyboard.press("ArrowRight");
    must(Number((await view()).split(" ")[0]) > Number(near.split(" ")[0]), "an arrow does not move");
    await page.keyboard.press("0");
    must((await view()) === whole, "0 does not show all");
    const feel = page.locator("#job .feel").first();
    await feel.focus();
    const says = await text(page, "seam-says");
    const seam = manifest.stars[0].seams[0];
    must(says.includes("Seam 1: inner loop") && says.includes(`${Number(seam.length_mm.toPrecision(4))} mm`), `the first seam says ${says}`);
    if (size === "desktop") {
        const at = await page.locator("#job .feel").nth(1).evaluate((path) => {
            const point = path.getPointAtLength(path.getTotalLength() * 0.3).matrixTransform(path.getScreenCTM());
            return [point.x, point.y];
        });
        await page.mouse.move(...at);
        must((await text(page, "seam-says")).includes("Seam 2"), "a seam does not feel the pointer");
    }
    await page.locator("#seams button").last().click();
    must((await text(page, "job-now")).includes("down along the seam"), `the last seam's button: ${await text(page, "job-now")}`);
    await slider.focus();
    await page.keyboard.press("End");
    must((await sealed()).every((part) => part === 1), "not all is sealed in the end");
}

/** What the canvas holds: the part of it that is not empty, and its mean colour. */
function painted(page) {
    return page.evaluate(() => {
        const canvas = document.getElementById("solid-view");
        const copy = document.createElement("canvas");
        [copy.width, copy.height] = [canvas.width, canvas.height];
        const pen = copy.getContext("2d");
        pen.drawImage(canvas, 0, 0);
        const { data } = pen.getImageData(0, 0, copy.width, copy.height);
        let [full, sum, edge] = [0, 0, 0];
        const colours = new Set();
        for (let i = 0; i < data.length; i += 4) {
            if (data[i + 3] < 20) continue;
            full += 1;
            sum += data[i] * 3 + data[i + 1] * 5 + data[i + 2] * 7 + (i % 9973);
            colours.add((data[i] >> 4) * 256 + (data[i + 1] >> 4) * 16 + (data[i + 2] >> 4));
            const [x, y] = [(i / 4) % copy.width, Math.floor(i / 4 / copy.width)];
            if (x === 0 || y === 0 || x === copy.width - 1 || y === copy.height - 1) edge += 1;
        }
        return { share: full / (data.length / 4), sum, colours: colours.size, edge };
    });
}

async function solid(page) {
    if (!(await page.locator("#solid-view").isVisible())) return must(false, `no 3-D: ${await text(page, "solid-says")}`);
    await page.locator("#solid-view").scrollIntoViewIfNeeded();
    const first = await painted(page);
    must(first.share > 0.1 && first.share < 0.9 && first.colours > 20 && first.edge === 0, `the canvas holds ${JSON.stringify(first)}`);
    const changed = async (what, before) => {
        const now = await painted(page);
        must(now.sum !== before.sum && now.share > 0.04, `${what} does not change the view: ${JSON.stringify(now)}`);
        return now;
    };
    await page.locator("#solid-view").focus();
    await page.keyboard.press("ArrowLeft");
    let last = await changed("an arrow", first);
    await page.keyboard.press("+");
    last = await changed("+", last);
    const box = await page.locator("#solid-view").boundingBox();
    await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
    await page.mouse.down();
    await page.mouse.move(box.x + box.width / 2 + 60, box.y + box.height / 2 + 20, { steps: 4 });
    await page.mouse.up();
    last = await changed("the pointer", last);
    await page.locator("#solid-top").click();
    last = await changed("from above", last);
    if (await page.locator("#solid-inflate").isEnabled()) {
        await page.locator("#solid-inflate").focus();
        await page.keyboard.press("Home");
        last = await changed("letting the air out", last);
    }
    await page.locator('[data-group="sheets"]').click();
    last = await changed("the sheets", last);
    await page.locator('[data-group="sheets"]').click();
    await page.locator("#solid-home").click();
    await changed("home", last);
    return undefined;
}

async function accessible(page, what) {
    await page.evaluate(axe);
    const { violations } = await page.evaluate(() => window.axe.run(document, { resultTypes: ["violations"] }));
    for (const { id, impact, help, nodes } of violations) {
        const where = nodes.slice(0, 3).map((node) => `${node.target} (${(node.any[0] || node.all[0] || node.none[0] || {}).message || ""})`).join(" | ");
        must(!["serious", "critical"].includes(impact), `${what}: ${impact} ${id}: ${help}: ${where}`);
    }
}

/** Every check box is one on paper, and there are as many pages as there are parts; what was zoomed into is all there. */
async function printed(page) {
    for (let i = 0; i < 4; i += 1) await page.locator("#job-in").click();
    const near = await page.locator("#job").getAttribute("viewBox");
    const paper = await page.evaluate(() => {
        window.dispatchEvent(new Event("beforeprint"));
        const box = document.getElementById("job").getAttribute("viewBox");
        const others = document.querySelectorAll("#job-others svg").length;
        window.dispatchEvent(new Event("afterprint"));
        return { box, others };
    });
    await page.locator("#job-fit").click();
    must(paper.box === (await page.locator("#job").getAttribute("viewBox")), `on paper the sheet is cut to ${paper.box}`);
    must(paper.others === new Set(manifest.stars.map((star) => star.sheet)).size - 1, `on paper ${paper.others} further sheets`);
    must(near !== paper.box, "the zoom does nothing");
    const path = join(out, `${name}.pdf`);
    writeFileSync(path, await page.pdf({ preferCSSPageSize: true, printBackground: true }));
    const info = execFileSync("pdfinfo", [path], { encoding: "utf8" });
    const pages = Number(/Pages:\s+(\d+)/.exec(info)[1]);
    must(pages === PAGES, `${pages} pages on paper instead of ${PAGES}`);
    must(/Page size:\s+59[45](\.\d+)? x 84[12]/.test(info), `no A4: ${info}`);
    const words = execFileSync("pdftotext", ["-layout", path, "-"], { encoding: "utf8" });
    for (const word of ["Checklists for the workshop", "Bill of materials", "Seams, in the order of sealing", "Sources of the numbers"]) {
        must(words.includes(word), `on paper there is no "${word}"`);
    }
}

const browser = await chromium.launch({
    executablePath: "/usr/bin/chromium",
    args: ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist"],
});
try {
    for (const size of Object.keys(SIZES)) {
        for (const scheme of ["light", "dark"]) {
            if (views === "some" && (size === "desktop") !== (scheme === "light")) continue;
            const page = await opened(browser, size, scheme);
            await fits(page, `${size}, ${scheme}`);
            await page.screenshot({ path: join(out, `${name}-${size}-${scheme}.png`), fullPage: scheme === "light", timeout: 120000 });
            await accessible(page, `${size}, ${scheme}`);
            if (scheme === "light") {
                await figures(page);
                await pressure(page);
                await player(page, size);
                await solid(page);
                await fits(page, `${size}, afterwards`);
                await page.screenshot({ path: join(out, `${name}-${size}-worked.png`), timeout: 120000 });
            }
            if (size === "desktop" && scheme === (views === "some" ? "light" : "dark")) await printed(page);
            await page.context().close();
        }
    }
} finally {
    await browser.close();
}
if (problems.length > 0) {
    console.error(problems.join("\n"));
    process.exit(1);
}
console.log(`${file}: opened at a desk and on a phone, worked, and printed on ${PAGES} pages`);
