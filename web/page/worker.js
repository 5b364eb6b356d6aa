// The worker: holds one instance of the program and answers one question after the other.
import { asked } from "./message.js";

/** The exports of the instance, when there is one: a question may come before it. */
let program = null;

self.onmessage = async ({ data: { module, number, question, files } }) => {
    if (module) {
        program = WebAssembly.instantiate(module, {}).then(({ exports }) => exports);
        return;
    }
    try {
        const answer = asked(await program, question, files);
        self.postMessage({ number, answer }, answer.files.map((file) => file.bytes.buffer));
    } catch (error) {
        self.postMessage({ number, broken: String(error.message ?? error) });
    }
};
