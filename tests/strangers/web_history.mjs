// Nothing is lost: random sequences of what a person does, against a model of the history, in Chromium.
// Usage: node web_history.mjs PAGES [SEQUENCES], with NODE_PATH at playwright-core and axe-core.
import { existsSync, readFileSync } from "node:fs";
import { deflateRawSync } from "node:zlib";
import { beside, dropped, ended, launched, must, onDisk, opened, ready } from "./web_page.mjs";

const [pages, sequences = "200"] = process.argv.slice(2);
/** Steps of a sequence, and one of how many is a reload, which takes as long as all others. */
const STEPS = 5, RELOADS = 20;
/** Windows that work beside each other. */
const WINDOWS = 2;
const drawing = readFileSync("designs/drawings/hand-rest.svg", "utf8"), spec = readFileSync("designs/drawings/hand-rest.toml", "utf8");

/** Numbers that look random and are the same in every run: of `seed`. */
const randomOf = (seed) => (most) => {
    seed = (Math.imul(seed, 1664525) + 1013904223) >>> 0;
    return Math.floor((seed / 2 ** 32) * most);
};

/** The model: every state that the spec ever had; a change after an undo comes behind all of them. */
class Model {
    states;
    index = 0;
    /** Number of texts that no other state has. */
    count = 0;

    constructor(text, random) {
        this.states = [text];
        this.random = random;
    }

    get text() {
        return this.states[this.index];
    }

    change(text) {
        if (text === this.text) return;
        if (this.index < this.states.length - 1) this.states.push(this.text);
        this.index = this.states.push(text) - 1;
    }

    go(by) {
        this.index = Math.min(Math.max(this.index + by, 0), this.states.length - 1);
    }
}

const browser = await launched();
/** Links to specs of their own. */
const links = Array.from({ length: 40 }, (_, number) => `#spec=${deflateRawSync(`schema = 1\nname = "link ${number}"\n[star]\npoints = ${3 + (number % 5)}\ninner_radius = "50 mm"\ntube_width = "30 mm"\ntip_angle = "30 deg"\n`).toString("base64url")}`);
let lost = 0;

const started = (page) => page.waitForFunction(() => !document.body.classList.contains("starting"));
/** The text once it is another one than `before`. */
const changed = (page, before) => page.waitForFunction((old) => document.getElementById("spec").value !== old, before, { polling: "raf" }).then(() => page.inputValue("#spec"));

/** What a person does in a window, and the model after it. */
const actions = {
    edit: async (page, model) => {
        const text = `${model.text.slice(0, model.random(model.text.length + 1))}# ${++model.count}\n${model.text}`;
        await beside(page, "text");
        await page.fill("#spec", text);
        await page.dispatchEvent("#spec", "change");
        model.change(text);
    },
    choose: async (page, model) => {
        const names = await page.$$eval("#designs option", (list) => list.map(({ value }) => value).filter(Boolean));
        const name = names[model.random(names.length)];
        const folder = ["", "drawings/", "press/"].find((folder) => existsSync(`designs/${folder}${name}.toml`));
        const text = readFileSync(`designs/${folder}${name}.toml`, "utf8");
        await beside(page, "start");
        await page.selectOption("#designs", name);
        if (text !== model.text) await changed(page, model.text);
        model.change(text);
    },
    drop: async (page, model) => {
        const text = `# dropped ${++model.count}\n${spec}`;
        await dropped(page, ["hand-rest.toml", text], ["hand-rest.svg", drawing]);
        await changed(page, model.text);
        model.change(text);
    },
    link: async (page, model) => {
        const fragment = links[model.count++ % links.length];
        await page.evaluate((link) => (location.hash = link), fragment);
        model.change(await changed(page, model.text));
        must(model.text.startsWith("schema = 1\nname = \"link"), `a link opens ${model.text.slice(0, 60)}`);
    },
    undo: async (page, model) => {
        await page.keyboard.press("Control+z");
        model.go(-1);
    },
    redo: async (page, model) => {
        await page.click("#redo");
        model.go(1);
    },
    reload: async (page) => {
        await page.reload();
        await started(page);
    },
};

/** One sequence in a window, whose texts are numbered from `count`: the text is the model's after each step, and all states are still there at the end. */
async function sequence(page, random, count) {
    const model = Object.assign(new Model(await page.inputValue("#spec"), random), { count }), done = [];
    const step = async (word) => {
        done.push(word);
        await actions[word](page, model);
        const shown = await page.inputValue("#spec");
        if (shown === model.text) return true;
        lost += 1;
        must(false, `after ${done.join(", ")} the text is ${JSON.stringify(shown.slice(0, 50))}, not ${JSON.stringify(model.text.slice(0, 50))}`);
        return false;
    };
    for (let number = 0; number < STEPS; number++) {
        const words = ["edit", "edit", "choose", "drop", "link", "undo", "undo", "redo"];
        let word = random(RELOADS) === 0 ? "reload" : words[random(words.length)];
        // Steps of the sequence before are not the model's.
        if ((word === "undo" && model.index === 0) || (word === "redo" && model.index === model.states.length - 1)) word = "edit";
        if (!(await step(word))) return;
    }
    while (model.index < model.states.length - 1) if (!(await step("redo"))) return;
    while (model.index > 0) if (!(await step("undo"))) return;
}

const windows = await Promise.all(Array.from({ length: WINDOWS }, () => opened(browser, "history", { width: 1366, height: 768 }, onDisk(pages))));
await Promise.all(windows.map(async (page, index) => {
    const random = randomOf(7 + index);
    for (let number = 0; number < Number(sequences) / WINDOWS && lost < 4; number++) await sequence(page, random, number * STEPS);
}));

// A drawing comes back with its spec after a reload; a link in another window leaves the work of this one alone.
const [page] = windows;
await page.evaluate((link) => (location.hash = link), links[0]);
await page.waitForFunction(() => location.hash !== "");
await dropped(page, ["hand-rest.toml", `# mine\n${spec}`], ["hand-rest.svg", drawing]);
await ready(page);
await page.reload();
await ready(page);
must((await page.inputValue("#spec")).startsWith("# mine") && !page.url().includes("#"), "a reload brings another spec than that of the edited page");
const other = await opened(browser, "another window", null, `${onDisk(pages)}${links[1]}`, { context: page.context() });
await beside(other, "text");
await other.fill("#spec", `# edited\n${await other.inputValue("#spec")}`);
await other.reload();
await started(other);
must((await other.inputValue("#spec")).startsWith("# edited"), "an edited link is opened again as it was");
await page.reload();
await started(page);
must((await page.inputValue("#spec")).startsWith("# mine"), "a link in another window replaces the work in this one");
await beside(page, "start");
const kept = await page.$$eval("#recent-list b", (list) => list.map(({ textContent }) => textContent));
must(kept.length <= 10 && kept.includes("hand rest") && kept.includes("link 1"), `the last specs are ${kept}`);
await browser.close();
ended("web_history", `${sequences} sequences of ${STEPS} steps, ${lost} lost edits`);
