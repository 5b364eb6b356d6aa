// The page in Firefox, from a disk: an object, a typo and undo, a drawing that is kept. Usage: node web_firefox.mjs PAGES OUT, with NODE_PATH at puppeteer-core.
import { mkdirSync } from "node:fs";
import { createRequire } from "node:module";
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";

const packages = createRequire(resolve(process.env.NODE_PATH) + "/");
const { default: puppeteer } = await import(pathToFileURL(packages.resolve("puppeteer-core")));
const [pages, out] = process.argv.slice(2);

const problems = [];
function must(holds, what) {
    if (!holds) problems.push(what);
}

mkdirSync(out, { recursive: true });
const browser = await puppeteer.launch({ browser: "firefox", executablePath: "/usr/bin/firefox-esr" });
const page = await browser.newPage();
page.setDefaultTimeout(60_000);
page.on("console", (message) => must(!["error", "warn"].includes(message.type()), `console says ${message.text()}`));
page.on("pageerror", (error) => must(false, String(error)));
const ready = () => page.waitForSelector("#zip:not([disabled])");
const holds = (text) => page.waitForFunction((wanted) => document.getElementById("spec").value.includes(wanted), {}, text);
try {
    await page.goto(pathToFileURL(resolve(pages, "stargrip-cam.html")).href);
    await ready();
    await page.click("#tab-start");
    await page.locator("#object-form [name=object]").fill("75 mm");
    await page.locator("#object-form [name=mass]").fill("200 g");
    await page.keyboard.press("Enter");
    await holds('name = "gripper"');
    await ready();
    must((await page.$eval("#verdict", (verdict) => verdict.textContent)).startsWith("Holds the object"), "the object is not held");
    await page.click("#tab-text");
    await page.evaluate(() => {
        const area = document.getElementById("spec");
        area.value = area.value.replace(/^tube_width/m, "tube_wdith");
        area.dispatchEvent(new Event("input", { bubbles: true }));
    });
    const mend = await page.waitForSelector("::-p-text(write tube_width)");
    await mend.click();
    await ready();
    await page.click("#undo");
    await holds("tube_wdith");
    await page.keyboard.down("Control");
    await page.keyboard.press("y");
    await page.keyboard.up("Control");
    await ready();
    await (await page.$("#open")).uploadFile(resolve("designs/drawings/hand-rest.svg"));
    await holds("[drawing.layers]");
    await ready();
    await page.reload();
    await holds("[drawing.layers]");
    await ready();
    must((await page.$eval("#verdict", (verdict) => verdict.textContent)).startsWith("Can be sealed: 5 seams"), "after a reload the drawing is lost");
    await page.screenshot({ path: join(out, "firefox.png"), fullPage: true });
} catch (error) {
    const said = await page.evaluate(() => ["note", "object-answer", "verdict", "proof"].map((id) => document.getElementById(id).textContent).join(" | "));
    must(false, `${error.message.split("\n")[0]}; the page says ${said}`);
    await page.screenshot({ path: join(out, "firefox-failed.png"), fullPage: true });
}
await browser.close();
for (const problem of problems) console.error(`firefox: ${problem}`);
console.log(`web_firefox: ${problems.length} problems`);
process.exit(problems.length ? 1 : 0);
