// The page in Chromium, with real clicks and keys, at a desk and on a phone, without a network.
// Usage: node web.mjs PAGES TOOL OUT, with NODE_PATH at playwright-core, axe-core and jsqr. OUT gets pictures and builds.
import { execFileSync, spawnSync } from "node:child_process";
import { mkdirSync, readFileSync, readdirSync, rmSync, writeFileSync } from "node:fs";
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { deflateRawSync, inflateRawSync } from "node:zlib";
import { ORDINARY, beside, dropped, ended, fits, fitsAlways, holds, launched, must, noted, onDisk, opened, packages, ready, serving } from "./web_page.mjs";

const jsQR = packages("jsqr");
const [pages, tool, out] = process.argv.slice(2);
const ONE_FILE = onDisk(pages);
const times = {};

/** Every control can be reached by the Tab key, and none holds it. */
async function keyboard(page, what) {
    const wanted = ["undo", "copy-link", "show-qr", "tab-text", "spec", "canvas", "zoom-in", "zip"], reached = new Set();
    await beside(page, "text");
    await page.locator("h1").click();
    for (let i = 0; i < 100 && !wanted.every((id) => reached.has(id)); i++) {
        await page.keyboard.press("Tab");
        reached.add(await page.evaluate(() => document.activeElement.id));
    }
    must(wanted.every((id) => reached.has(id)), `${what}: Tab does not reach ${wanted.filter((id) => !reached.has(id))}`);
    const nameless = await page.evaluate(() => [...document.querySelectorAll("input, select, button, textarea")].filter((one) => !(one.labels?.length || one.textContent.trim() || one.getAttribute("aria-label"))).length);
    must(nameless === 0, `${what}: ${nameless} controls without a name`);
}

/** Downloads the ZIP; the command proves what is in it. */
async function zipped(page, what, folder, least) {
    await beside(page, "result");
    const [download] = await Promise.all([page.waitForEvent("download"), page.click("#zip")]);
    const file = join(out, `${what}.zip`), dir = join(out, what);
    await download.saveAs(file);
    rmSync(dir, { recursive: true, force: true });
    execFileSync("python3", ["-m", "zipfile", "-e", file, dir]);
    const { status, stdout } = spawnSync(tool, ["verify", join(dir, folder), "--json"], { encoding: "utf8" });
    must(status === 0 && JSON.parse(stdout).proven.length > least, `${what}: verify ends with ${status}: ${stdout.slice(0, 400)}`);
    return file;
}

/** Programs for a sheet that was moved, which the command proves; a wrong mark is told. */
async function moved(page, what) {
    const before = await page.inputValue("#spec"), folder = "paper-star-5-points";
    await beside(page, "text");
    await page.fill("#spec", `${readFileSync("designs/paper-five-points.toml", "utf8")}[machine]\nmarks = "pause"\n`);
    await ready(page);
    await zipped(page, `${what}-marked`, folder, 10);
    const trace = readFileSync(join(out, `${what}-marked`, folder, "star-1-trace.gcode"), "utf8");
    const marks = [...trace.matchAll(/^; mark: .*x_mm=(\S+) y_mm=(\S+)/gm)].map(([, x, y]) => `${Number(x) + 2}, ${Number(y) + 1}`);
    await page.click("#moved summary");
    await page.fill("[name=mark1]", "here");
    await page.fill("[name=mark2]", marks[1]);
    await page.click("#moved-form button");
    await page.waitForFunction(() => document.getElementById("moved-note").textContent.startsWith("two coordinates"));
    await page.fill("[name=mark1]", marks[0]);
    const [download] = await Promise.all([page.waitForEvent("download"), page.click("#moved-form button")]);
    const note = await page.textContent("#moved-note");
    must(note.includes("turned by 0.000 deg, shifted by X 2.00 Y 1.00 mm"), `${what}: the note is ${note}`);
    const file = join(out, `${what}-moved.zip`), dir = join(out, `${what}-moved`);
    await download.saveAs(file);
    rmSync(dir, { recursive: true, force: true });
    execFileSync("python3", ["-m", "zipfile", "-e", file, dir]);
    const { status, stdout } = spawnSync(tool, ["verify", join(dir, `${folder}-aligned`), "--json"], { encoding: "utf8" });
    must(status === 0, `${what}: the aligned build ends with ${status}: ${stdout.slice(0, 400)}`);
    const aligned = readFileSync(join(dir, `${folder}-aligned`, "star-1-trace.gcode"), "utf8");
    must(/^; aligned: /m.test(aligned), `${what}: the aligned program does not state its motion`);
    await beside(page, "text");
    await page.fill("#spec", before);
    await ready(page);
}

/** From the object to the ZIP, which the command accepts, and the page as well. */
async function bottle(page, what) {
    await beside(page, "start");
    await page.getByLabel("Width across").fill("75 mm");
    await page.getByLabel("Mass").first().fill("1.2 kg");
    await page.getByText("More about the task").click();
    await page.locator("#object-form [name=friction]").fill("1.0");
    await page.locator("#object-form [name=sheet]").fill("400x400");
    await page.locator("#object-form [name=name]").fill("bottle");
    await page.keyboard.press("Enter");
    await page.waitForFunction(() => document.getElementById("spec").value.includes("bottle"));
    await ready(page);
    must((await page.innerText("#verdict")).startsWith("Holds the object"), `${what}: the bottle's verdict is ${await page.innerText("#verdict")}`);
    const file = await zipped(page, `${what}-bottle`, "bottle", 15);
    await page.setInputFiles("#open", file);
    await noted(page, "Proven, no findings");
}

/** A typo is told at its place and at the picture, and mended by its button; a slider changes the text and keeps its comments; both can be undone. */
async function mended(page, what) {
    const spec = page.locator("#spec");
    await beside(page, "text");
    await spec.fill((await spec.inputValue()).replace(/^tube_width/m, "tube_wdith") + "\n# my own words\n");
    await page.waitForSelector("#fault .remedy:text('write tube_width')");
    must(await page.isDisabled("#zip"), `${what}: files of a refused spec can be had`);
    must(await page.evaluate(() => Number(getComputedStyle(document.getElementById("rows")).opacity) < 0.6), `${what}: numbers of before look like new ones`);
    await page.click("[aria-label='explain unknown-key']");
    await page.waitForSelector("#faults span:text('No key has this name here')");
    await page.click("#fault .remedy:text('write tube_width')");
    await ready(page);
    await beside(page, "values");
    const points = page.getByLabel("points, slider");
    const before = await points.inputValue();
    await points.focus();
    await page.keyboard.press("ArrowRight");
    await holds(page, `points = ${Number(before) + 1}`);
    must((await spec.inputValue()).includes("# my own words"), `${what}: a comment is lost`);
    await page.keyboard.press("Control+z");
    await holds(page, `points = ${before}`);
    await page.keyboard.press("Control+Shift+z");
    await holds(page, `points = ${Number(before) + 1}`);
}

/** A link holds the spec as it stands. */
async function reopened(browser, page, what, viewport) {
    await page.click("#copy-link");
    await page.waitForFunction(() => location.hash.startsWith("#spec="));
    const other = await opened(browser, `${what}, link`, viewport, page.url(), { waits: (other) => other.waitForSelector("#canvas path") }); // nine points no longer hold the bottle
    must((await other.inputValue("#spec")) === (await page.inputValue("#spec")), `${what}: the link holds another spec`);
    await other.close();
}

/** A number that is out of its range is offered the end that it passed, and no part of a number is taken for one. */
async function bounded(page, what) {
    await beside(page, "text");
    const before = await page.inputValue("#spec"), spec = readFileSync("designs/paper-gripper.toml", "utf8");
    for (const [key, value, remedy] of [["count", 300, 64], ["points", 2, 3], ["friction", 30, 10]]) {
        await page.fill("#spec", spec.replace(new RegExp(`^${key} = .*`, "m"), `${key} = ${value}`));
        await page.waitForFunction((text) => document.querySelector("#fault .remedy")?.textContent === text, `write ${key} = ${remedy}`);
        const offered = await page.locator("#fault .remedy").allInnerTexts();
        must(offered.length === 1, `${what}: for ${key} = ${value} the page offers ${offered}`);
    }
    await page.fill("#spec", spec.replace("[load]", '[load]\nmass = "9 kg"'));
    await page.waitForFunction(() => document.querySelector("#fault .remedy")?.textContent.startsWith('write mass = "'));
    await page.waitForTimeout(300);
    const parts = (await page.locator("#fault .remedy").allInnerTexts()).filter((text) => !/ mass = "[\d.]+ kg"$/.test(text));
    must(parts.length === 0, `${what}: for a mass the page offers ${parts}`);
    await page.fill("#spec", before);
    await ready(page);
}

/** The report: its player, pressure slider, charts and scene; it keeps its place and sliders after an edit. */
async function report(page, what) {
    await page.click("#view-report");
    const frame = page.frameLocator("#report-box iframe:not(.next)");
    await frame.locator("#name").filter({ hasText: "bottle" }).waitFor();
    for (const part of ["canvas", "svg", "input[type=range]"]) must((await frame.locator(part).count()) > 0, `${what}: the report has no ${part}`);
    await frame.locator("#job-time").evaluate((slider) => {
        slider.value = String(Number(slider.max) / 2);
        slider.dispatchEvent(new Event("input", { bubbles: true }));
        slider.scrollIntoView({ behavior: "instant" });
    });
    await page.waitForTimeout(400);
    const place = () => frame.locator("#job-time").evaluate((slider) => [window.scrollY, Math.round((100 * Number(slider.value)) / Number(slider.max)), document.getElementById("name").textContent]);
    const [scroll, time] = await place();
    // On a phone the report fills the window, and the text is behind it.
    if (what === "phone") {
        await page.click("#view-sheet");
        return ready(page);
    }
    const spec = await page.inputValue("#spec");
    await beside(page, "text");
    await page.fill("#spec", spec.replace(/^name = .*/m, 'name = "bottle again"'));
    await frame.locator("#name").filter({ hasText: "bottle again" }).waitFor();
    const [scrollNow, timeNow] = await place();
    must(scroll > 0 && Math.abs(scroll - scrollNow) < 60 && time === timeNow, `${what}: after an edit the report is at ${scrollNow} px, ${timeNow} %, not at ${scroll} px, ${time} %`);
    await page.click("#undo");
    await page.click("#view-sheet");
    await ready(page);
}

/** The QR code, as saved, holds a link to the spec, as someone else's reader finds it. */
async function coded(page, what) {
    await page.click("#show-qr");
    const [download] = await Promise.all([page.waitForEvent("download"), page.click("#qr-save")]);
    const svg = readFileSync(await download.path(), "utf8");
    const side = Number(/viewBox="0 0 (\d+)/.exec(svg)[1]), scale = 4, width = side * scale;
    const pixels = new Uint8ClampedArray(4 * width * width).fill(255);
    for (const [, x, y, length] of svg.matchAll(/M(\d+) (\d+)h(\d+)v1h/g)) {
        for (let row = y * scale; row < (Number(y) + 1) * scale; row++) {
            for (let at = x * scale; at < (Number(x) + Number(length)) * scale; at++) pixels.fill(0, 4 * (row * width + at), 4 * (row * width + at) + 3);
        }
    }
    const link = jsQR(pixels, width, width)?.data ?? "";
    const held = inflateRawSync(Buffer.from(/#spec=(.*)$/.exec(link)?.[1] ?? "", "base64url")).toString();
    const bare = (text) => text.split("\n").filter((line) => !/^\s*(#|$)/.test(line)).join("\n");
    must(bare(held) === bare(await page.inputValue("#spec")), `${what}: the QR code holds ${link.slice(0, 80)}: ${held.slice(0, 80)}`);
    await page.click("#qr-hide");
}

/** The shell of a drawing tells how far it is, can be stopped, and is shown in three dimensions, with its size as the verdict. */
async function shell(page, what) {
    const measure = '<g id="measure" fill="none" stroke="#00f"><path id="across" d="M100 40V80"/></g></svg>';
    await dropped(page, ["measured.svg", readFileSync("designs/drawings/hand-rest.svg", "utf8").replace("</svg>", measure)]);
    await holds(page, "measured.svg");
    await beside(page, "values");
    await page.fill("#field-load\\.pressure", "10 kPa");
    await page.keyboard.press("Enter");
    await ready(page);
    await page.click("#shell-start");
    await page.waitForFunction(() => /^\d+ %/.test(document.getElementById("busy-text").textContent));
    await page.click("#stop");
    await page.waitForFunction(() => document.getElementById("shell-note").textContent === "Stopped.");
    await page.click("#shell-start");
    await page.waitForFunction(() => document.getElementById("shell-note").textContent.startsWith("Computed"), null, { timeout: 4 * ORDINARY });
    must(/^Inflates to 190 × 79/.test(await page.innerText("#verdict")), `${what}: the inflated drawing's verdict is ${await page.innerText("#verdict")}`);
    const frame = page.frameLocator("#report-box iframe:not(.next)");
    await frame.locator("body.only-solid #solid-view").waitFor();
    // The frame of before stays until the new one is drawn.
    const inflates = await frame.locator("#solid-inflate:enabled").waitFor().then(() => true, () => false);
    must(inflates, `${what}: the scene of the shell does not inflate`);
    const pulls = await frame.locator("#pulls tbody th").allTextContents();
    must(pulls.length === 5 && pulls.includes("crease-left"), `${what}: the report has the pull on ${pulls}`);
    const label = frame.locator("#solid-labels span"), words = () => label.allTextContents();
    must(/^across: distance \d{2}(\.\d)? mm$/.test((await words()).join()), `${what}: the scene measures ${await words()}`);
    const [place, scene] = [await label.boundingBox(), await frame.locator("#solid-view").boundingBox()];
    must(Math.hypot(place.x + place.width / 2 - scene.x - scene.width / 2, place.y + place.height / 2 - scene.y - scene.height / 2) < scene.height / 2, `${what}: the measure is at ${JSON.stringify(place)}`);
    await frame.locator("#solid-groups [data-group=measures]").click();
    must((await words()).length === 0, `${what}: measures that are switched off are shown`);
    await page.click("#view-drawing");
    const [length] = await page.locator("#canvas .measured").allTextContents();
    must(/^across: distance \d{2}(\.\d)?( ± [\d.]+| \([\d.]+ to [\d.]+\)) mm$/.test(length), `${what}: what is measured after inflation is ${length}`);
    await page.click("#view-sheet");
}

/** Masks are printed from a PDF, which opens beside the page. */
async function printed(page, what) {
    await beside(page, "result");
    const [opened] = await Promise.all([page.context().waitForEvent("page"), page.locator("#files .print").first().click()]);
    must(opened.url() === "" || /^(blob|about):/.test(opened.url()), `${what}: the PDF opens as ${opened.url()}`);
    await opened.close();
    const shift = await page.evaluate(() => window.shift);
    await page.emulateMedia({ media: "print" });
    must((await page.isVisible("#canvas")) && !(await page.isVisible("#side")), `${what}: the printed page is not the result`);
    await page.emulateMedia({ media: "screen" });
    // That the printed page is another one is no shift.
    await page.evaluate(() => new Promise((painted) => requestAnimationFrame(() => requestAnimationFrame(() => setTimeout(painted, 100)))));
    await page.evaluate((shift) => [window.shifts.takeRecords(), (window.shift = shift)], shift);
}

/** A profile that is dropped alone serves the spec as it stands. */
async function profiled(page, what) {
    await beside(page, "text");
    await page.fill("#spec", readFileSync("designs/paper-five-points.toml", "utf8").replace(/^profile = .*\n/m, "").replace(/^\[machine\].*\n/m, "") + '\n[machine]\nprofile = "mine.toml"\n');
    await page.waitForSelector("#faults [aria-label='explain unknown-machine']");
    await dropped(page, ["mine.toml", readFileSync("crates/spec/templates/machines/generic.toml", "utf8")]);
    await ready(page);
    await reopened(page.context().browser(), page, `${what}, profile`, page.viewportSize());
}

/** A drawing that is dropped becomes a spec, and then files that the command accepts. */
async function drawn(browser, page, what, viewport) {
    await dropped(page, ["hand-rest.svg", readFileSync("designs/drawings/hand-rest.svg", "utf8")]);
    await noted(page, "hand-rest.svg has 3 layers");
    must((await page.inputValue("#spec")).includes("[drawing.layers]"), `${what}: no spec of the drawing`);
    await ready(page);
    await page.click("#view-report");
    const title = await page.frameLocator("#report-box iframe:not(.next)").locator("#verdict-title").filter({ hasText: "sealed" }).innerText();
    must((await page.textContent("#verdict")).startsWith(title), `${what}: the report says ${title}, the page ${await page.textContent("#verdict")}`);
    await page.click("#view-sheet");
    await zipped(page, `${what}-drawing`, "hand-rest", 5);
    await reopened(browser, page, `${what}, drawing`, viewport);
    for (const bad of ["<svg", "<svg xmlns='http://www.w3.org/2000/svg'><script>alert(1)</script><path id='\"><img src=x onerror=alert(1)>' d='M0 0 h1e308 z'/></svg>", "\0".repeat(9)]) {
        await dropped(page, ["</script><img src=x onerror=alert(1)>.svg", bad]);
        await page.waitForFunction(() => /cannot be read|has \d+ layer/.test(document.getElementById("note").textContent));
        await page.evaluate(() => (document.getElementById("note").textContent = ""));
    }
}

/** A press seals all seams at once: they have no order. A note about a drawing goes with it. */
async function pressed(page, what) {
    await beside(page, "start");
    await page.selectOption("#designs", "hand-rest");
    await ready(page);
    must((await page.innerText("#note")) === "", `${what}: the note of another drawing stays`);
    const ordered = () => page.evaluate(() => [...document.querySelectorAll("#canvas .start, #legend .start, #canvas .feel[aria-label*=' sealed ']")].length);
    must((await ordered()) > 2, `${what}: the seams of an iron have no order`);
    await beside(page, "values");
    await page.selectOption("#field-machine\\.profile", "press");
    await ready(page);
    must((await ordered()) === 0, `${what}: the seams of a press have an order`);
}

/** The words that the tests of the crate call hostile, as JavaScript. */
function names() {
    const source = readFileSync("tests/design/hostile.rs", "utf8");
    const list = /const HOSTILE: [^=]*= \[(.*?)\n\];/s.exec(source)[1];
    const words = [...list.matchAll(/"((?:[^"\\]|\\.)*)"/g)].map(([, word]) => JSON.parse(`"${word.replace(/\\u\{([0-9a-f]+)\}/gi, (_, code) => String.fromCodePoint(parseInt(code, 16)))}"`));
    must(words.length >= 28, `only ${words.length} hostile words were found`);
    return words;
}

/** Names that would do something if they were taken for more than text; broken links; an instance that dies. */
async function hostile(page, what) {
    const shipped = readFileSync("designs/paper-five-points.toml", "utf8");
    await beside(page, "text");
    for (const name of [...names(), "<img src=x onerror=alert(1)>", "${alert(1)}", "javascript:alert(1)", "a\\\" onload=\\\"alert(1)"]) {
        await page.fill("#spec", shipped.replace(/^name = .*/m, () => `name = ${JSON.stringify(name)}`));
        await page.waitForFunction(() => !document.getElementById("zip").disabled || document.querySelector("#faults [aria-label='explain name']"));
    }
    const alive = await page.evaluate(() => [document.querySelectorAll("img").length, document.querySelectorAll("script, iframe").length, window.hit]);
    must(alive[2] === undefined && alive[0] === 1, `${what}: names made elements: ${alive}`);
    const bomb = deflateRawSync(Buffer.alloc(1 << 26)).toString("base64url");
    for (const link of ["%", "AAAA", bomb]) {
        await page.evaluate((fragment) => (location.hash = fragment), `spec=${link}`);
        await noted(page, "Stopped by an error");
        must((await page.inputValue("#spec")).includes("[star]"), `${what}: a bad link takes the text`);
        await page.evaluate(() => (document.getElementById("note").textContent = ""));
    }
    for (const worker of page.workers()) await worker.evaluate("program = null");
    await page.fill("#spec", `${shipped}\n# more\n`);
    await noted(page, "Stopped by an error");
    must((await page.inputValue("#spec")).endsWith("# more\n"), `${what}: the text is lost with the instance`);
    await page.fill("#spec", shipped);
    await ready(page);
}

/** A section that only the schema has, with fields; a list in which a word may come twice has none. */
async function unlisted(browser) {
    const page = await opened(browser, "schema", { width: 1280, height: 900 }, "about:blank", { waits: () => {} });
    await page.addInitScript(() => {
        const length = { type: "string", pattern: "mm", description: "Its width. A length with its unit." };
        const layers = { type: "array", items: { enum: ["board", "paper"] } };
        const kiln = { type: "object", properties: { width: length, layers } };
        window.Worker = class extends Worker {
            set onmessage(heard) {
                super.onmessage = (event) => {
                    const { schema } = event.data.answer ?? {};
                    if (schema) schema.properties.kiln = kiln;
                    heard(event);
                };
            }
        };
    });
    await page.goto(ONE_FILE);
    await ready(page);
    await beside(page, "values");
    await page.getByText("Kiln", { exact: true }).click();
    must(await page.isVisible("#field-kiln\\.width"), "schema: a new section has no field");
    must(!(await page.getByText("layers", { exact: true }).isVisible()), "schema: a list with an order has boxes to tick");
    await page.context().close();
}

/** The page on a server: installed, it opens without one. */
async function served(browser) {
    const server = await serving(pages);
    const page = await opened(browser, "server", { width: 1280, height: 900 }, server.address, { offline: false });
    await page.evaluate(async () => {
        const { active, installing, waiting } = await navigator.serviceWorker.ready;
        const worker = active ?? waiting ?? installing;
        if (worker.state !== "activated") await new Promise((is) => worker.addEventListener("statechange", () => worker.state === "activated" && is()));
    });
    await server.close();
    await page.reload();
    await ready(page);
    await page.context().close();
}

/** A spec of the book opens in the page beside it. */
async function linked(browser) {
    const book = join(out, "book"), site = join(out, "site");
    const spec = 'schema = 1\nname = "a &amp; b"\n[star]\npoints = 5\ninner_radius = &quot;50 mm&quot;\ntube_width = "30 mm"\ntip_angle = "30 deg"\n';
    mkdirSync(book, { recursive: true });
    writeFileSync(join(book, "index.html"), `<!DOCTYPE html><html lang="en"><head><link rel="icon" href="data:,"/><title>book</title></head><body><pre><code class="language-toml">${spec}</code></pre></body></html>`);
    execFileSync("web/make-site", [book, pages, site], { stdio: "ignore" });
    const server = await serving(site);
    const page = await opened(browser, "book", { width: 1280, height: 900 }, server.address, { offline: false, waits: (book) => book.waitForSelector("text=Open in the page") });
    await page.click("text=Open in the page");
    await ready(page);
    must((await page.inputValue("#spec")).includes('name = "a & b"'), "book: the link opens another spec");
    await page.context().close();
    await server.close();
}

/** What someone else's reader finds in a picture of `url`, the window of which is `viewport`. */
async function read(browser, url, viewport) {
    const page = await browser.newPage({ viewport, colorScheme: "dark" });
    await page.goto(url);
    const code = page.locator("footer svg");
    const picture = await ((await code.count()) > 0 ? code.screenshot() : page.screenshot());
    await page.goto("about:blank");
    await page.addScriptTag({ path: packages.resolve("jsqr") });
    const found = await page.evaluate(async (letters) => {
        const bytes = await createImageBitmap(new Blob([Uint8Array.from(atob(letters), (letter) => letter.charCodeAt(0))]));
        const context = new OffscreenCanvas(bytes.width, bytes.height).getContext("2d");
        context.drawImage(bytes, 0, 0);
        const { data, width, height } = context.getImageData(0, 0, bytes.width, bytes.height);
        return window.jsQR(data, width, height)?.data ?? "";
    }, picture.toString("base64"));
    await page.close();
    return found;
}

/** The codes of a preview and of a report that the command made lead back to their spec, drawing included. */
async function returned(browser) {
    // A spec takes a public address; the page that opens is this machine's.
    const server = await serving(pages), link = "https://example.org/stargrip-cam/index.html";
    for (const [name, drawing] of [["paper-gripper"], ["drawings/pillow", "pillow.dxf"]]) {
        const text = `${readFileSync(`designs/${name}.toml`, "utf8")}\n[build]\nwith = ["report", "preview-png"]\nlink = "${link}"\n`;
        const spec = join(out, "returned.toml"), dir = join(out, "returned");
        writeFileSync(spec, text);
        if (drawing) writeFileSync(join(out, drawing), readFileSync(join("designs/drawings", drawing)));
        rmSync(dir, { recursive: true, force: true });
        execFileSync(tool, ["build", spec, "-o", dir, "--quiet", "--anyway"], { stdio: "ignore" });
        execFileSync(tool, ["verify", dir], { stdio: "ignore" });
        const names = readdirSync(dir).filter((file) => /preview\.(svg|png)$|report\.html$/.test(file));
        must(names.length >= 3, `${name}: previews and report are ${names}`);
        const links = new Set();
        for (const file of names) links.add(await read(browser, pathToFileURL(resolve(dir, file)).href, { width: 1920, height: 1920 }));
        const [found] = links;
        must(links.size === 1 && found.startsWith(`${link}#spec=`), `${name}: the codes of its files hold ${[...links]}`);
        const page = await opened(browser, `${name}, returned`, { width: 1280, height: 900 }, found.replace(link, `${server.address}index.html`), { offline: false });
        const bare = (spec) => spec.split("\n").filter((line) => !/^\s*(#|$)/.test(line)).join("\n");
        must(bare(await page.inputValue("#spec")) === bare(text), `${name}: its code opens another spec`);
        await page.context().close();
    }
    await server.close();
}

/** How long a person waits, ms, at least: a preview after opening, one after an edit, all files with their proof. Others may use the machine. */
async function waits(browser, page) {
    const first = [], edits = [], builds = [];
    for (let i = 0; i < 3; i++) {
        const other = await opened(browser, "waits", { width: 1280, height: 900 }, ONE_FILE);
        first.push(await other.evaluate(() => performance.getEntriesByName("preview")[0]?.startTime));
        await other.context().close();
    }
    const text = readFileSync("designs/paper-gripper.toml", "utf8");
    await beside(page, "text");
    for (let i = 0; i < 9; i++) {
        await page.fill("#spec", text.replace('tip_angle = "30 deg"', `tip_angle = "${30 + (i + 1) / 10} deg"`));
        await ready(page);
        edits.push(Number(await page.evaluate(() => document.documentElement.dataset.look)));
        builds.push(Number(await page.evaluate(() => document.documentElement.dataset.built)));
    }
    const told = (list) => `${Math.round(Math.min(...list))} (${Math.round(Math.max(...list))})`;
    Object.assign(times, { first: told(first), edit: told(edits), build: told(builds) });
}

mkdirSync(out, { recursive: true });
const browser = await launched();
for (const [what, viewport] of [["desktop", { width: 1280, height: 900 }], ["phone", { width: 360, height: 740 }]]) {
    try {
        const page = await opened(browser, what, viewport, ONE_FILE);
        await fits(page, what);
        await page.screenshot({ path: join(out, `${what}.png`), fullPage: true });
        if (what === "desktop") await waits(browser, page);
        await bottle(page, what);
        await moved(page, what);
        await printed(page, what);
        await bounded(page, what);
        await mended(page, what);
        await reopened(browser, page, what, viewport);
        await coded(page, what);
        await report(page, what);
        await fitsAlways(page, `${what}-worked`, (scheme) => join(out, `${what}-worked-${scheme}.png`));
        await drawn(browser, page, what, viewport);
        await page.screenshot({ path: join(out, `${what}-drawn.png`), fullPage: true });
        await pressed(page, what);
        if (what === "phone") continue;
        await keyboard(page, what);
        await hostile(page, what);
        await profiled(page, what);
        await shell(page, what);
    } catch (error) {
        must(false, `${what}, at ${/web\.mjs:\d+/.exec(error.stack.replace(/^[^]*?\n    at /, ""))}: ${error.message.split("\n").slice(0, 3).join(" ")}`);
    }
}
for (const [what, work] of [["schema", unlisted], ["server", served], ["book", linked], ["files", returned]]) await work(browser).catch((error) => must(false, `${what}: ${error.message.split("\n")[0]}`));
await browser.close();
ended("web", `least (most) ms: first preview ${times.first}, preview after an edit ${times.edit}, files proven ${times.build}`);
