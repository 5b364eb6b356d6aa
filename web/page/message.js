// Messages between the page and the program: JSON, and files as bytes (web/src/message.rs has the same).

/** The bytes of a question: an object, and files [{ name, bytes }]. */
export function packed(question, files = []) {
    const list = files.map(({ name, bytes }) => ({ name, bytes: bytes.length }));
    const text = new TextEncoder().encode(JSON.stringify(files.length ? { ...question, files: list } : question));
    const all = new Uint8Array(4 + text.length + files.reduce((sum, { bytes }) => sum + bytes.length, 0));
    new DataView(all.buffer).setUint32(0, text.length, true);
    all.set(text, 4);
    let at = 4 + text.length;
    for (const { bytes } of files) {
        all.set(bytes, at);
        at += bytes.length;
    }
    return all;
}

/** The answer in `all`: an object, whose `files` have their bytes. */
export function unpacked(all) {
    const length = new DataView(all.buffer, all.byteOffset).getUint32(0, true);
    const answer = JSON.parse(new TextDecoder().decode(all.subarray(4, 4 + length))) ?? {};
    let at = 4 + length;
    answer.files = (answer.files ?? []).map(({ name, bytes }) => {
        const own = all.slice(at, at + bytes);
        at += bytes;
        return { name, bytes: own };
    });
    return answer;
}

/** An instance of the compiled `module`. `told(part, what)` receives the progress of long work: 0 to 1, and the current step. */
export async function instance(module, told = () => {}) {
    const progress = (part, place, length) => told(part, new TextDecoder().decode(new Uint8Array(program.memory.buffer, place, length)));
    const { exports: program } = await WebAssembly.instantiate(module, { page: { progress } });
    return program;
}

/** Asks the instance with the exports `program`; the message of a panic becomes that of the error. */
export function asked(program, question, files) {
    const bytes = packed(question, files);
    try {
        const place = program.question(bytes.length);
        new Uint8Array(program.memory.buffer, place, bytes.length).set(bytes);
        const length = program.ask();
        return unpacked(new Uint8Array(program.memory.buffer, program.answered(), length));
    } catch (error) {
        const said = new Uint8Array(program.memory.buffer, program.panicked(), program.panic_length());
        throw new Error(new TextDecoder().decode(said) || String(error));
    }
}
