// The page on a server that packs it, as Lighthouse measures it on its phone (a slow network, a slow processor) and at a desk.
// Usage: node web_lighthouse.mjs PAGES OUT, with NODE_PATH at lighthouse and playwright-core. OUT gets its reports.
import { mkdirSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { pathToFileURL } from "node:url";
import { ended, must, packages, serving } from "./web_page.mjs";

const { default: lighthouse, desktopConfig } = await import(pathToFileURL(packages.resolve("lighthouse")));
const { launch } = await import(pathToFileURL(packages.resolve("chrome-launcher")));
const [pages, out] = process.argv.slice(2);
/** Least scores. That of speed is lower than on a machine that does nothing else, which is the only one to which it means much. */
const LEAST = { performance: 75, accessibility: 100, "best-practices": 100, seo: 100 };
/** Most of the window that may move, and longest time until what is largest is there, ms. */
const SHIFT = 0.005, LARGEST = 2500;

const server = await serving(pages, { isPacked: true });
for (const name of ["", "stargrip-cam.wasm"]) await (await fetch(server.address + name)).arrayBuffer(); // is packed before it is measured
mkdirSync(out, { recursive: true });
const chrome = await launch({ chromePath: "/usr/bin/chromium", chromeFlags: ["--headless=new", "--no-sandbox"] });
const lines = [];
for (const [what, config] of [["phone", undefined], ["desk", desktopConfig]]) {
    const { lhr, report } = await lighthouse(server.address, { port: chrome.port, output: "html", logLevel: "error" }, config);
    writeFileSync(join(out, `lighthouse-${what}.html`), report);
    const value = (id) => lhr.audits[id].numericValue;
    const shift = value("cumulative-layout-shift"), largest = value("largest-contentful-paint");
    const scores = Object.entries(LEAST).map(([id, least]) => {
        const score = Math.round(100 * lhr.categories[id].score);
        const failed = lhr.categories[id].auditRefs.filter((audit) => audit.weight > 0 && (lhr.audits[audit.id].score ?? 1) < 1);
        must(score >= least, `${what}: ${id} ${score}, because of ${failed.map((audit) => audit.id)}`);
        return `${id} ${score}`;
    });
    must(shift <= SHIFT, `${what}: the layout shifts by ${shift}`);
    must(largest <= LARGEST, `${what}: what is largest comes after ${Math.round(largest)} ms`);
    const times = [["first paint", "first-contentful-paint"], ["largest", "largest-contentful-paint"], ["blocked", "total-blocking-time"]];
    lines.push(`${what}: ${scores.join(", ")}; ${times.map(([words, id]) => `${words} ${Math.round(value(id))} ms`).join(", ")}`);
}
chrome.kill();
await server.close();
ended("web_lighthouse", lines.join("; "));
