// Renews the pictures of the page and of its report in docs/, as Chromium shows them: run it after a change of what they show, and look at them.
// Usage: node web_pictures.mjs PAGES, with NODE_PATH at playwright-core.
import { writeFileSync } from "node:fs";
import { join } from "node:path";
import { beside, ended, holds, launched, must, onDisk, opened, ready } from "./web_page.mjs";

const [pages] = process.argv.slice(2);
/** Largest picture, bytes, and the quality of its packing. */
const LARGEST = 80_000, QUALITY = 0.78;
const browser = await launched();

/** Writes what `page` shows as docs/NAME.webp: the browser packs it, too. */
async function picture(page, name) {
    const shot = (await page.screenshot()).toString("base64");
    const letters = await page.evaluate(async ([png, quality]) => {
        const image = await createImageBitmap(new Blob([Uint8Array.from(atob(png), (letter) => letter.charCodeAt(0))]));
        const canvas = new OffscreenCanvas(image.width, image.height);
        canvas.getContext("2d").drawImage(image, 0, 0);
        const bytes = new Uint8Array(await (await canvas.convertToBlob({ type: "image/webp", quality })).arrayBuffer());
        return btoa(Array.from(bytes, (byte) => String.fromCharCode(byte)).join(""));
    }, [shot, QUALITY]);
    const bytes = Buffer.from(letters, "base64");
    must(bytes.length <= LARGEST, `${name} has ${bytes.length} bytes`);
    writeFileSync(join("docs", `${name}.webp`), bytes);
}

/** The workshop: the paper's gripper with its values. */
const page = await opened(browser, "page", { width: 1366, height: 768 }, onDisk(pages));
await beside(page, "values");
await picture(page, "page");

/** A drawing under pressure, inflated. */
await beside(page, "start");
await page.selectOption("#designs", "hand-rest");
await holds(page, "hand rest");
await page.fill("#field-load\\.pressure", "10 kPa");
await page.keyboard.press("Enter");
await ready(page);
await page.click("#shell-start");
await page.waitForFunction(() => document.getElementById("shell-note").textContent.startsWith("Computed"), null, { timeout: 200_000 });
await page.waitForTimeout(500);
await picture(page, "page-inflated");

/** The report of the paper's gripper in a window of its own size: its head, then the player of its path in the middle of a seam. */
const narrow = await opened(browser, "report", { width: 820, height: 900 }, onDisk(pages));
await narrow.click("#view-report");
const frame = narrow.frameLocator("#report-box iframe:not(.next)");
await frame.locator("#solid-view").waitFor();
await narrow.evaluate(() => Object.assign(document.getElementById("report-box").style, { position: "fixed", inset: 0, zIndex: 99 }));
await frame.locator("#name").waitFor();
await narrow.waitForTimeout(800);
await picture(narrow, "report");
await frame.locator("#job-time").evaluate((slider) => {
    slider.value = String(0.4 * Number(slider.max));
    slider.dispatchEvent(new Event("input", { bubbles: true }));
    document.getElementById("seal").scrollIntoView({ behavior: "instant" });
});
await narrow.waitForTimeout(500);
await picture(narrow, "report-player");
await browser.close();
ended("web_pictures", "docs/page.webp, page-inflated.webp, report.webp, report-player.webp");
