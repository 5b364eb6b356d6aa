// Files that a user drops or opens, and their kinds.
import { unzipped } from "./zip.js";

/** Largest drawing that is read, bytes: as for the command. */
const MOST_DRAWING = 64 << 20;

/** Whether a TOML file is a machine profile, which alone has this key. */
const isProfile = ({ name, bytes }) => name.endsWith(".toml") && /^\s*dialect\s*=/m.test(new TextDecoder().decode(bytes));
const isDrawing = ({ name }) => /\.(svg|dxf)$/i.test(name);

/** The content of `list`, files of the browser: the texts `spec` and `machine`, a `drawing`, and all files of a `build`, each if present. */
export async function sorted(list) {
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
