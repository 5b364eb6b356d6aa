// The page's program without a browser: its size, its files against the command's to the byte, and its response to hostile texts.
// Usage: node web_bytes.mjs PAGES TOOL OUT. OUT gets the command's builds.
import { execFileSync } from "node:child_process";
import { mkdirSync, readFileSync, readdirSync, rmSync, writeFileSync } from "node:fs";
import { basename, dirname, extname, join } from "node:path";
import { brotliCompressSync } from "node:zlib";

const [pages, tool, out] = process.argv.slice(2);
/** Most bytes of program and page as a server sends them. */
const MOST_BYTES = 1.25e6;
/** Specs and drawings that are spoilt, and the longest that one may take, ms. */
const SPOILT = 400, LONGEST = 20_000;
const source = readFileSync(new URL("../../web/page/message.js", import.meta.url));
const { asked, instance } = await import(`data:text/javascript;base64,${source.toString("base64")}`);

const problems = [];
function must(holds, what) {
    if (!holds) problems.push(what);
}

const binary = readFileSync(join(pages, "stargrip-cam.wasm"));
const compiled = await WebAssembly.compile(binary);
/** Parts of long work, 0 to 1, as the program told them. */
const parts = [];
const fresh = () => instance(compiled, (part) => parts.push(part));

/** Every spec below designs/, and the one with every feature; each with the drawing beside it. */
function specs() {
    const found = ["designs", "designs/drawings", "designs/press"].flatMap((dir) => readdirSync(dir).filter((name) => name.endsWith(".toml")).map((name) => join(dir, name)));
    const drawing = (spec) => /^file = "(.*)"$/m.exec(readFileSync(spec, "utf8"))?.[1];
    return [...found, "tests/golden/every-feature.toml"].map((spec) => ({ spec, drawing: drawing(spec) }));
}

const textOf = ({ spec }) => readFileSync(spec, "utf8");
const drawingOf = ({ spec, drawing }) => (drawing ? [{ name: drawing, bytes: readFileSync(join(dirname(spec), drawing)) }] : []);

/** All files of a build are the command's, and each proves those of the other. */
async function bytes(program) {
    for (const own of specs()) {
        const name = basename(own.spec, ".toml"), dir = join(out, name);
        rmSync(dir, { recursive: true, force: true });
        execFileSync(tool, ["build", own.spec, "-o", dir, "--quiet", "--anyway"], { stdio: ["ignore", "ignore", "ignore"] });
        const { files, faults } = asked(program, { ask: "build", spec: textOf(own), anyway: true }, drawingOf(own));
        const names = files.map((file) => file.name).sort();
        must(names.join() === readdirSync(dir).sort().join(), `${name}: other files: ${names}; ${JSON.stringify(faults)}`);
        for (const file of files) must(readFileSync(join(dir, file.name)).equals(file.bytes), `${name}: ${file.name} differs from the command's`);
        const { findings } = asked(program, { ask: "verify" }, readdirSync(dir).map((file) => ({ name: file, bytes: readFileSync(join(dir, file)) })));
        must(findings.length === 0, `${name}: the page finds ${JSON.stringify(findings)} in the command's files`);
    }
}

/** What a page has not: commands and their options. Coupons are the command's alone. */
const COMMANDS = /`stargrip-cam (?!coupon`|feedcheck`)|(^|[ (])--[a-z]|`(align|build|calibrate|check|coupon|explain|feedcheck|machines|new|optimize|predict|resume|study|verify)`/;

/** Texts of an answer about a spec, which are in the page's words. */
function speaks({ overview, faults = [] }, what) {
    const { before_you_seal: before = [], rows = [], verdict = {}, press } = overview ?? {};
    const steps = press?.instructions.flatMap(({ lines }) => lines) ?? [];
    const texts = [...before, ...rows.flat(), verdict.in_words, ...steps, ...faults.flatMap(({ found, allowed, remedy }) => [found, allowed, remedy])];
    for (const text of texts) must(!COMMANDS.test(text ?? ""), `${what} is told of a command: ${text}`);
}

/** Every spec, under a pressure, on every machine as the page shows it. */
function voices(program) {
    const { machines } = asked(program, { ask: "start" }, []);
    for (const own of specs()) for (const { name } of machines) for (const change of ["", 'feed_floor = "chop"\n', 'marks = "pause"\n']) {
        const rest = textOf(own).replace(/^\[machine\]\n(?:[^[\n].*\n|\n)*/m, "");
        const spec = `${rest}\n${/^\[load\]/m.test(rest) ? "" : '[load]\npressure = "10 kPa"\n'}[machine]\nprofile = "${name}"\n${change}`;
        speaks(asked(program, { ask: "look", spec }, drawingOf(own)), `${own.spec} on ${name}`);
    }
}

/** A coarse shell of a star and one of a drawing, which tell how far they are; the star's numbers are the command's but for the last digits. */
function shells(program) {
    const began = performance.now();
    const star = `${readFileSync("designs/paper-five-points.toml", "utf8")}\n[load]\npressure = "14 kPa"\n`;
    const { text, prediction } = asked(program, { ask: "predict", model: "shell", spec: star }, []);
    must(/mesh error|\+-/.test(text ?? ""), `the shell of a star: ${text}`);
    must(parts.length > 5 && parts.every((part) => part >= 0 && part <= 1), `progress of the shell: ${parts}`);
    const file = join(out, "shell.toml");
    writeFileSync(file, star);
    const own = JSON.parse(execFileSync(tool, ["predict", file, "--model", "shell", "--fineness", "coarse", "--no-cache", "--json"], { stdio: ["ignore", "pipe", "ignore"] }));
    const near = (a, b) => Math.abs(a - b) <= 1e-6 * Math.abs(b);
    must(near(prediction.final_radius_mm, own.final_radius_mm), `the shell's radius is ${prediction.final_radius_mm} mm, the command's ${own.final_radius_mm} mm`);
    const pillow = { spec: "designs/drawings/pillow.toml", drawing: "pillow.dxf" };
    const drawn = `${textOf(pillow)}\n[load]\npressure = "5 kPa"\n[accuracy]\nmodel = "shell"\n`;
    const quick = asked(program, { ask: "look", spec: drawn }, drawingOf(pillow));
    const whole = asked(program, { ask: "build", spec: drawn }, drawingOf(pillow));
    const says = ({ overview }) => overview?.rows.map(([label]) => label).join();
    must(says(quick) === "" && quick.sheets.length === 1 && says(whole).startsWith("inflates") && whole.proven, `the shell of a drawing: ${says(quick)}, ${says(whole)}, ${JSON.stringify(whole.faults)}`);
    return performance.now() - began;
}

/** Numbers that look random and are the same in every run. */
function random(seed) {
    let state = seed;
    return (most) => {
        state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
        return Math.floor((state / 2 ** 32) * most);
    };
}

const WORDS = ["1e308", "-1e308", "nan", "inf", "-0", "1e-300", "99999999999999999999", "0", "[", "\"", "\u0000", "\u202e", "</script><script>", "<img src=x onerror=alert(1)>",
    "&lt;", "]]>", "${7*7}", "\r\n", "\ud83d\ude00", "../../etc/passwd", "%0a", "=".repeat(4000), "[".repeat(4000), "<g>".repeat(4000)];

/** `text` with some of it taken away, doubled, moved, or replaced. */
function spoilt(text, next) {
    let now = text;
    for (let times = 1 + next(4); times > 0; times--) {
        const at = next(now.length + 1), length = next(40), word = WORDS[next(WORDS.length)];
        const numbers = [...now.matchAll(/[0-9.]+/g)];
        const number = numbers[next(Math.max(numbers.length, 1))];
        now = [
            () => now.slice(0, at) + now.slice(at + length),
            () => now.slice(0, at) + word + now.slice(at),
            () => now.slice(0, at + length) + now.slice(at),
            () => (number ? now.slice(0, number.index) + word + now.slice(number.index + number[0].length) : now),
        ][next(4)]();
    }
    return now;
}

/** Hostile specs and drawings get an answer, in time, and the instance stays alive. */
async function hostile(alive) {
    const all = specs(), next = random(20);
    let program = alive, slowest = 0;
    for (let count = 0; count < SPOILT; count++) {
        const own = all[next(all.length)], files = drawingOf(own);
        const spec = next(3) ? spoilt(textOf(own), next) : textOf(own);
        if (files.length) files[0].bytes = new TextEncoder().encode(spoilt(new TextDecoder().decode(files[0].bytes), next));
        const questions = [[{ ask: "build", spec, only: ["preview-svg"], prove: false, anyway: true }, files]];
        if (files.length) questions.push([{ ask: "drawing" }, [{ name: `${WORDS[next(WORDS.length)]}${extname(own.drawing)}`, bytes: files[0].bytes }]]);
        for (const [question, given] of questions) {
            const began = performance.now();
            try {
                const answer = asked(program, question, given), { wrong, reasons, spec: proposed } = answer;
                speaks(answer, `${own.spec}, spoilt ${count},`);
                must(!wrong, `${own.spec}, spoilt ${count}: ${wrong}`);
                if (question.ask === "drawing" && !reasons) must(typeof proposed === "string" && readable(program, proposed), `${own.drawing}, spoilt ${count}: the proposed spec cannot be read`);
            } catch (error) {
                must(false, `${own.spec}, spoilt ${count}: the instance died of ${error.message.slice(0, 300)}`);
                program = await fresh();
            }
            slowest = Math.max(slowest, performance.now() - began);
        }
    }
    must(slowest < LONGEST, `a spoilt spec took ${slowest} ms`);
    return slowest;
}

/** Whether a proposed spec is TOML; what it lacks is another matter. */
const readable = (program, spec) => asked(program, { ask: "build", spec, prove: false }).faults.every(({ code }) => code !== "toml");

mkdirSync(out, { recursive: true });
const size = brotliCompressSync(binary).length + brotliCompressSync(readFileSync(join(pages, "index.html"))).length;
must(size <= MOST_BYTES, `program and page have ${size} bytes by brotli`);
const program = await fresh();
const [, noProduct] = asked(program, { ask: "look", spec: "" }).faults;
must(noProduct.remedy.startsWith("write for instance:\n[star]\npoints = 5\n"), `an empty text is answered ${noProduct.remedy}`);
const began = performance.now();
await bytes(program);
const compared = performance.now() - began;
voices(program);
const shell = shells(program);
const slowest = await hostile(program);
for (const problem of problems) console.error(problem);
const seconds = (ms) => (ms / 1000).toFixed(1);
console.log(`web_bytes: ${(size / 1e6).toFixed(2)} MB by brotli; ${specs().length} specs in ${seconds(compared)} s, shells in ${seconds(shell)} s, a hostile spec at most ${slowest.toFixed(0)} ms; ${problems.length} problems`);
process.exit(problems.length ? 1 : 0);
