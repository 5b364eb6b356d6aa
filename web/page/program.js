// The program as the page uses it: questions in, promises out. It runs in a worker, so the page never waits. A question of a lane replaces
// the earlier one in that lane; long work is stopped by ending its worker. A worker that fails is replaced.

/** Longest time for which a short question may delay the next one, ms. */
const PATIENCE = 300;

/** The compiled program: from the page itself, or from the file beside it. It is compiled while it loads. */
export async function compiled() {
    const streamed = (body) => WebAssembly.compileStreaming(new Response(body, { headers: { "Content-Type": "application/wasm" } }));
    const packedProgram = document.getElementById("program-data");
    if (!packedProgram) {
        const answer = await fetch("stargrip-cam.wasm");
        if (!answer.ok) throw new Error(`the program could not be loaded (${answer.status}); load the page again`);
        navigator.serviceWorker?.register("offline.js").catch(() => {}); // without it the page needs its network
        // The browser itself passes the bytes on, if it trusts their type: it keeps what it compiled for the next visit.
        return answer.headers.get("Content-Type") === "application/wasm" ? WebAssembly.compileStreaming(answer) : streamed(answer.body);
    }
    const packed = Uint8Array.fromBase64?.(packedProgram.textContent) ?? Uint8Array.from(atob(packedProgram.textContent), (letter) => letter.charCodeAt(0));
    packedProgram.remove();
    return streamed(new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip")));
}

/** The error of a question that was replaced or stopped. */
export class Dropped extends Error {}

export class Program {
    #module;
    #newWorker;
    #worker = null;
    #spare = null;
    #running = null;
    #waiting = [];
    #number = 0;

    /** `module`: the compiled program; `newWorker` makes a worker. */
    constructor(module, newWorker) {
        this.#module = module;
        this.#newWorker = newWorker;
        this.#worker = this.#made();
        this.#spare = this.#made();
    }

    /** Asks. A later question of the same `lane` replaces this one. A question stops one with `isLong`, unless that `isKept` or the new one `isPatient`. */
    ask(question, { files = [], lane = question.ask, isLong = false, isKept = false, isPatient = false } = {}) {
        return new Promise((resolve, reject) => {
            this.#waiting = this.#waiting.filter((other) => other.lane !== lane || other.reject(new Dropped()));
            this.#waiting.push({ number: ++this.#number, question, files, lane, isLong, isKept, resolve, reject });
            const { isLong: isStopped, isKept: stays, since } = this.#running ?? {};
            if (!stays && !isPatient && (isStopped || performance.now() - since > PATIENCE)) this.stop();
            else this.#next();
        });
    }

    /** Answers a short question in a worker of its own: it neither waits for the running question nor stops it. */
    aside(question, files = []) {
        return new Promise((resolve, reject) => {
            const worker = this.#newWorker();
            worker.onmessage = ({ data: { answer, broken } }) => {
                worker.terminate();
                if (broken === undefined) resolve(answer);
                else reject(new Error(broken));
            };
            worker.postMessage({ module: this.#module });
            worker.postMessage({ number: 0, question, files });
        });
    }

    /** Ends the running question. */
    stop() {
        const stopped = this.#running;
        if (!stopped) return;
        this.#replace();
        stopped.reject(new Dropped());
        this.#next();
    }

    /** The running question: its start (ms), the `part` of it that is done (0 to 1), and the step `what`, if they are known. */
    get running() {
        return this.#running;
    }

    #made() {
        const worker = this.#newWorker();
        worker.onmessage = ({ data }) => worker === this.#worker && this.#heard(data);
        worker.onerror = (event) => {
            event.preventDefault();
            if (worker === this.#worker) this.#heard({ number: this.#running?.number, broken: event.message ?? "the worker broke" });
        };
        worker.postMessage({ module: this.#module });
        return worker;
    }

    /** Ends the worker; the spare one takes its place, or a new one if what broke it may have broken that, too. */
    #replace(isBroken = false) {
        this.#running = null;
        this.#worker.terminate();
        if (isBroken) this.#spare.terminate();
        this.#worker = isBroken ? this.#made() : this.#spare;
        this.#spare = this.#made();
    }

    #next() {
        if (this.#running || this.#waiting.length === 0) return;
        this.#running = { ...this.#waiting.shift(), since: performance.now() };
        const { number, question, files } = this.#running;
        this.#worker.postMessage({ number, question, files });
    }

    #heard({ number, answer, broken, part, what }) {
        const running = this.#running;
        if (!running || running.number !== number) return;
        if (part !== undefined) {
            Object.assign(running, { part, what });
            return;
        }
        if (broken === undefined) {
            this.#running = null;
            running.resolve(answer);
        } else {
            this.#replace(true);
            running.reject(new Error(broken));
        }
        this.#next();
    }
}
