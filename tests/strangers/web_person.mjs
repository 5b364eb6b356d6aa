// Ten tasks of a person at the page, by clicks and keys: each control and each answer is at most one scroll away. A browser drives them by
// { click, fill, choose, focus, press, wait, read, drop, download, framed }, with CSS selectors, and functions that run in the page.
import { readFileSync } from "node:fs";
import { join } from "node:path";

const drawing = (name) => [name, readFileSync(join("designs/drawings", name), "utf8")];

/** Distance of the element from the window, in heights of what scrolls it; 0 if it is in sight. Runs in the page. */
function distanceOf(selector) {
    const element = document.querySelector(selector), { top, bottom, height } = element.getBoundingClientRect();
    const scrolled = (part) => part && (part.scrollHeight > part.clientHeight + 1 && /auto|scroll/.test(getComputedStyle(part).overflowY) ? part : scrolled(part.parentElement));
    const frame = scrolled(element.parentElement)?.getBoundingClientRect() ?? { top: 0, bottom: innerHeight, height: innerHeight };
    const part = Math.min(height, 40);
    return Math.max(frame.top - (bottom - part), top + part - Math.min(frame.bottom, innerHeight), 0) / Math.min(frame.height, innerHeight);
}

/** Letters of the picture: how many have a place, of all, and the height of the smallest, px. Runs in the page. */
export function lettersOf() {
    const all = [...document.querySelectorAll("#canvas text")], shown = all.filter((text) => !text.closest("[style*=none]"));
    return { all: all.length, shown: shown.length, least: Math.min(...shown.map((text) => parseFloat(getComputedStyle(text).fontSize) * text.getScreenCTM().a)) };
}

/** The tasks for a browser `use`, in which `must(holds, what)` counts what does not hold, each under its name. */
export function tasks(use, must) {
    /** Checks that `selector` is at most one scroll away. */
    async function near(selector) {
        await use.wait((wanted) => document.querySelector(wanted)?.getClientRects().length > 0, selector);
        const far = await use.read(distanceOf, selector);
        must(far <= 1, `${selector} is ${far.toFixed(1)} windows away`);
        return selector;
    }
    /** Opens what is beside the picture: start, values, text or result, which may have a place of its own. */
    const beside = async (name) => {
        if (await use.read((tab) => document.getElementById(tab).getClientRects().length > 0, `tab-${name}`)) await use.click(`#tab-${name}`);
    };
    const click = async (selector) => use.click(await near(selector));
    const fill = async (selector, text) => use.fill(await near(selector), text);
    const inner = (selector) => use.read((wanted) => document.querySelector(wanted).innerText, selector);
    const spec = () => use.read(() => document.getElementById("spec").value);
    const holds = (text) => use.wait((wanted) => document.getElementById("spec").value.includes(wanted), text);
    const inSight = async (selector) => must((await use.read(distanceOf, selector)) === 0, `${selector} is out of sight`);
    const verdict = async (pattern) => {
        await use.wait((source) => new RegExp(source).test(document.getElementById("verdict").textContent), pattern.source);
        await near("#verdict");
    };
    const ready = () => use.wait(() => !document.getElementById("zip").disabled);

    return {
        "hold an object": async () => {
            await beside("start");
            await fill("#object-form [name=object]", "75 mm");
            await fill("#object-form [name=mass]", "200 g");
            await use.press("Enter");
            await holds('name = "gripper"');
            await verdict(/^Holds the object with [\d.]+ N \([\d.]+ to [\d.]+[;)]/);
        },
        "try a value and take it back": async () => {
            await beside("values");
            const before = await spec();
            await use.focus(await near("[aria-label='points, slider']"));
            await use.press("ArrowRight");
            await use.wait((text) => document.getElementById("spec").value !== text, before);
            await use.press("Control+z");
            await use.wait((text) => document.getElementById("spec").value === text, before);
        },
        "learn why a machine refuses, and mend it": async () => {
            await use.choose(await near("#machine"), "grbl");
            await near("#fault strong");
            const fault = await inner("#fault strong");
            must(/runs this at/.test(fault), `the box says ${fault}`);
            await inSight("#fault strong");
            await click("#fault .remedy");
            await holds('feed_floor = "chop"');
            await verdict(/^Holds/);
        },
        "find a fault in the text": async () => {
            await beside("text");
            await use.fill("#spec", (await spec()).replace(/^tube_width/m, "tube_wdith"));
            await click("#fault-show");
            must(await use.read(() => document.getElementById("spec").value.slice(document.getElementById("spec").selectionStart).startsWith("tube_wdith")), '"Show" selects something else');
            await inSight("#mirror .bad");
            await click("#fault .remedy");
            await verdict(/^Holds/);
        },
        "download all files": async () => {
            await ready();
            await beside("result");
            const name = await use.download(await near("#zip"));
            must(name === "gripper.zip", `the file is ${name}`);
            const first = await inner("#files button");
            must(first.includes("trace"), `the first file is ${first}, not the trace`);
        },
        "read the names on the picture": async () => {
            await beside("start");
            await use.choose(await near("#designs"), "hand-rest");
            await verdict(/^Can be sealed: 5 seams, 2 h 16 min, 242 × 102 mm/);
            await click("#zoom-in");
            await use.focus("#canvas .feel");
            const seam = await inner("#hint");
            must(/^crease-left of piece 1, sealed 1st, 32 mm/.test(seam), `the seam is called ${seam}`);
            await click("#zoom-fit");
        },
        "seal an own drawing": async () => {
            await use.drop(drawing("letters.svg"));
            await holds("letters.svg");
            await verdict(/^Can be sealed: 2 seams/);
        },
        "say what a curve is": async () => {
            await click("#view-drawing");
            await use.focus("#canvas .feel[aria-label*=port]");
            await use.press("Enter");
            await near("#roles [value=ignore]");
            const unseen = await use.read(() => {
                const line = document.querySelector("#canvas .figure"), before = line.getAttribute("class");
                const list = [...document.querySelectorAll("#roles input")].map(({ value }) => value).filter((role) => {
                    line.setAttribute("class", `figure ${role}-role`);
                    return getComputedStyle(line).stroke === "none";
                });
                line.setAttribute("class", before);
                return list;
            });
            must(unseen.length === 0, `curves of a role cannot be seen: ${unseen}`);
            await click("#roles label:has([value=ignore])");
            await near("#fault strong");
            await use.wait(() => document.querySelector("#canvas .mark") && document.querySelector("#legend .ignore"));
            await inSight("#fault strong");
            must((await inner("#fault strong")).includes("no port"), "the fault is another one");
            const isFree = await use.read(() => {
                const mark = document.querySelector("#canvas .mark"), { left, top, width, height } = mark.getBoundingClientRect();
                return mark.parentElement.contains(document.elementFromPoint(left + width / 2, top + height / 2));
            });
            must(isFree, "something covers the mark of the fault");
            await click("#undo");
            await verdict(/^Can be sealed: 2 seams/);
            await click("#view-sheet");
        },
        "give it a pressure and see it in three dimensions": async () => {
            await beside("values");
            await fill("#field-load\\.pressure", "5 kPa");
            await use.press("Enter");
            await holds('pressure = "5 kPa"');
            await click("#view-solid");
            await use.framed("body.only-solid #solid-view");
            await inSight("#inflate");
            await click("#view-sheet");
        },
        "send a link, and find an earlier spec again": async () => {
            await click("#copy-link");
            await use.wait(() => location.hash.startsWith("#spec="));
            await beside("start");
            await use.wait(() => {
                const entry = [...document.querySelectorAll("#recent-list .open")].find((open) => open.querySelector("b").textContent === "gripper");
                if (entry) entry.id = "earlier";
                return Boolean(entry);
            });
            await click("#earlier");
            await holds('name = "gripper"');
            await verdict(/^Holds the object/);
        },
    };
}
