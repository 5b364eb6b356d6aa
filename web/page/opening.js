// Files that a user drops or opens: a spec with its profile and its drawing, a drawing alone, a profile alone, or the files of a build.
import { keepFile } from "./store.js";
import { unzipped } from "./zip.js";

/** Largest drawing that is read, bytes: as for the command. */
const MOST_DRAWING = 64 << 20;

/** Whether a TOML file is a machine profile, which alone has this key. */
const isProfile = ({ name, bytes }) => name.endsWith(".toml") && /^\s*dialect\s*=/m.test(new TextDecoder().decode(bytes));
const isDrawing = ({ name }) => /\.(svg|dxf)$/i.test(name);

/** The content of `list`, files of the browser: the texts `spec` and `machine`, a `drawing`, and all files of a `build`, each if present. */
async function sorted(list) {
    let all = await Promise.all(Array.from(list, async (file) => ({ name: file.name, bytes: new Uint8Array(await file.arrayBuffer()) })));
    const archive = all.find(({ name }) => name.toLowerCase().endsWith(".zip"));
    if (archive) all = await unzipped(archive.bytes);
    const text = (file) => {
        try {
            return file && new TextDecoder("utf-8", { fatal: true }).decode(file.bytes);
        } catch {
            throw new Error(`${file.name} is not UTF-8 text`);
        }
    };
    const named = (name) => all.find((file) => file.name === name);
    const profile = named("machine.toml") ?? all.find(isProfile);
    const spec = named("spec.toml") ?? all.find((file) => file.name.endsWith(".toml") && file !== profile);
    const isBuild = Boolean(spec && named("manifest.json"));
    const drawing = isBuild ? named("drawing.svg") ?? named("drawing.dxf") : all.find(isDrawing);
    if (!spec && !drawing && !profile) throw new Error("there is no spec in it and no drawing; a spec is a TOML file, a drawing an SVG or a DXF");
    if (drawing?.bytes.length > MOST_DRAWING) throw new Error("the drawing is larger than 64 MiB");
    return { name: (spec ?? drawing ?? profile).name, spec: text(spec), machine: text(profile), drawing, build: isBuild ? all : undefined };
}

/** Takes the files of `list`; `say(text, isBad)` reports what became of them. */
export async function opened(list, page) {
    const { program, desk, take, say } = page;
    const { name, spec, machine, drawing, build } = await sorted(list);
    if (spec === undefined) {
        if (drawing) return drawn(drawing, page);
        desk.change({ machine });
        return say(`The machine profile ${name} is used if \`profile\` in [machine] names a file.`);
    }
    take({ text: spec, machine, drawing: drawing && (await keepFile(drawing)) });
    if (!build) return say(`Opened ${name}.`);
    say("Proving the files of the build ...");
    const { findings, proven, unproven, written_by: version } = await program.ask({ ask: "verify" }, { files: build, isKept: true });
    if (findings.length > 0) {
        const first = findings.slice(0, 3).map(({ file, line, code, found }) => `${file}${line ? `:${line}` : ""}: ${found} (${code})`);
        return say(`${findings.length} findings: ${first.join("; ")}`, true);
    }
    const other = version ? `, written by ${version}: read back, not compared${unproven.length ? `; not proven: ${unproven.join(", ")}` : ""}` : "";
    return say(`Proven, no findings: ${proven.length} files${other}.`);
}

/** A drawing alone: that of the present spec, if the spec names it; else a spec is proposed. */
async function drawn(drawing, { program, desk, maker, take, say }) {
    if (maker.isDrawn && desk.state.text.includes(JSON.stringify(drawing.name))) {
        desk.change({ drawing: await keepFile(drawing) });
        return say(`The drawing is now ${drawing.name} as dropped.`);
    }
    const { spec, layers, reasons } = await program.ask({ ask: "drawing" }, { files: [drawing] });
    if (reasons) return say(`${drawing.name} cannot be read: ${reasons.slice(0, 3).join("; ")}`, true);
    take({ text: spec, drawing: await keepFile(drawing) });
    return say(`${drawing.name} has ${layers.length} layer${layers.length === 1 ? "" : "s"}, each with a proposed role: click a curve in “Drawing” to change it.`);
}
