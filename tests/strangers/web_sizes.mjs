// The page at five sizes of a window, by day: where its regions lie, and how light it is in squares of 32 px, against web_sizes.json beside this file.
// Both are compared within tolerances, so that another Chromium or another typeface changes nothing.
// Usage: node web_sizes.mjs PAGES OUT [--renew], with NODE_PATH at playwright-core. OUT gets the pictures; --renew writes the file: look at the pictures then.
import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { beside, ended, launched, must, onDisk, opened } from "./web_page.mjs";

const [pages, out, renew] = process.argv.slice(2);
const REFERENCE = new URL("web_sizes.json", import.meta.url);
const SIZES = [[1920, 1080], [1366, 768], [1024, 768], [844, 390], [390, 844]];
const REGIONS = ["stage", "picture", "canvas", "side", "verdict-box", "result", "files"];
/** Side of a square, px. */
const SQUARE = 32;
/** Most that an edge of a region lies elsewhere, px and share of the window. */
const MOST_PX = 6, MOST_SHARE = 0.02;
/** Levels of 0 to 255 from which a square is another one, the most such squares by their share, and the most of the mean difference. */
const OTHER = 40, MOST_OTHER = 0.03, MOST_MEAN = 5;

/** The edges of the regions in sight, px: left, top, right, bottom. */
const regions = (page) => page.evaluate((names) => Object.fromEntries(names.map((name) => {
    const { left, top, right, bottom, width } = document.getElementById(name).getBoundingClientRect();
    return [name, width > 0 ? [left, top, right, bottom].map(Math.round) : null];
})), REGIONS);

/** How light the squares of a picture are, row by row: 0 to 255, two digits each. */
const squares = (page, png) => page.evaluate(async ([letters, side]) => {
    const image = await createImageBitmap(new Blob([Uint8Array.from(atob(letters), (letter) => letter.charCodeAt(0))]));
    const canvas = new OffscreenCanvas(image.width, image.height), context = canvas.getContext("2d", { willReadFrequently: true });
    context.drawImage(image, 0, 0);
    const rows = [];
    for (let y = 0; y + side <= image.height; y += side) {
        let row = "";
        for (let x = 0; x + side <= image.width; x += side) {
            const { data } = context.getImageData(x, y, side, side);
            let sum = 0;
            for (let i = 0; i < data.length; i += 4) sum += 0.2126 * data[i] + 0.7152 * data[i + 1] + 0.0722 * data[i + 2];
            row += Math.round(sum / (side * side)).toString(16).padStart(2, "0");
        }
        rows.push(row);
    }
    return rows;
}, [png.toString("base64"), SQUARE]);

/** Edges against those of the reference. */
function compareRegions(name, edges, reference, window) {
    for (const region of REGIONS) {
        const [box, expected] = [edges[region], reference[region]];
        must(Boolean(box) === Boolean(expected), `${name}: ${region} is ${box ? "" : "not "}in sight`);
        if (!box || !expected) continue;
        const away = box.map((edge, k) => Math.abs(edge - expected[k]) - Math.max(MOST_PX, MOST_SHARE * window[k % 2]));
        must(away.every((more) => more <= 0), `${name}: ${region} lies at ${box}, not at ${expected}`);
    }
}

/** Squares against those of the reference. */
function compareSquares(name, rows, reference) {
    const parsed = (text) => (text.match(/../g) ?? []).map((word) => parseInt(word, 16));
    const [levels, expected] = [rows, reference].map((list) => parsed(list.join("")));
    const differences = levels.map((level, k) => Math.abs(level - expected[k]));
    const mean = differences.reduce((sum, difference) => sum + difference, 0) / differences.length;
    const share = differences.filter((difference) => difference > OTHER).length / differences.length;
    must(levels.length === expected.length && share <= MOST_OTHER && mean <= MOST_MEAN, `${name}: ${(100 * share).toFixed(1)} % of the squares are others, the mean difference is ${mean.toFixed(1)} of 255`);
    return share;
}

mkdirSync(out, { recursive: true });
const references = renew ? {} : JSON.parse(readFileSync(REFERENCE, "utf8"));
const browser = await launched(), shares = [];
for (const [width, height] of SIZES) {
    const name = `${width}x${height}`, page = await opened(browser, name, { width, height }, onDisk(pages));
    await beside(page, "values");
    await page.mouse.move(1, 1);
    const png = await page.screenshot({ path: join(out, `${name}.png`) });
    const edges = await regions(page), rows = await squares(page, png);
    if (renew) references[name] = { regions: edges, squares: rows };
    else {
        compareRegions(name, edges, references[name].regions, [width, height]);
        shares.push(compareSquares(name, rows, references[name].squares));
    }
    await page.context().close();
}
await browser.close();
if (renew) writeFileSync(REFERENCE, `${JSON.stringify(references, null, 1)}\n`);
ended("web_sizes", renew ? "web_sizes.json is renewed" : `${SIZES.length} sizes, at most ${(100 * Math.max(...shares)).toFixed(1)} % of the squares are others`);
