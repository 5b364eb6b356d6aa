// The worker: holds one instance of the program and answers one question after the other.
import { asked } from "./message.js";

let program = null;

self.onmessage = async ({ data: { module, number, question, files } }) => {
    try {
        if (module) {
            program = (await WebAssembly.instantiate(module, {})).exports;
            self.postMessage({ ready: true });
            return;
        }
        const answer = asked(program, question, files);
        self.postMessage({ number, answer }, answer.files.map((file) => file.bytes.buffer));
    } catch (error) {
        self.postMessage({ number, broken: String(error.message ?? error) });
    }
};
