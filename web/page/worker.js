// The worker: holds one instance of the program and answers one question after the other.
import { asked, instance } from "./message.js";

/** Least time between two reports of progress, ms. */
const PAUSE = 100;

/** The exports of the instance, once it exists: a question may come before it. */
let program = null;
/** The running question, and the time of the last report of its progress. */
let running, reported = 0;

function report(part, what) {
    if (performance.now() - reported < PAUSE) return;
    reported = performance.now();
    self.postMessage({ number: running, part, what });
}

self.onmessage = async ({ data: { module, number, question, files } }) => {
    if (module) {
        program = instance(module, report);
        return;
    }
    try {
        const exports = await program;
        running = number;
        const answer = asked(exports, question, files);
        self.postMessage({ number, answer }, answer.files.map((file) => file.bytes.buffer));
    } catch (error) {
        self.postMessage({ number, broken: String(error.message ?? error) });
    }
};
