// The line at the lower edge during long work: the current step, the progress, and a button that stops it.

const shown = (id) => document.getElementById(id);
/** Shorter work gets no line, ms. */
const LONG_WORK = 700;
/** Interval of checks of the program, ms. */
const BETWEEN = 100;

/** Watches `program`. */
export function watch(program) {
    shown("stop").addEventListener("click", () => program.stop());
    setInterval(() => {
        const { since, part, what } = program.running ?? {};
        const isLong = performance.now() - since > LONG_WORK;
        if (shown("busy").hidden === isLong) shown("busy").hidden = !isLong;
        if (!isLong) return;
        const bar = shown("progress");
        if (part === undefined) bar.removeAttribute("value");
        else bar.value = part;
        const text = part === undefined ? "Computing ..." : `${Math.round(part * 100)} %, ${what}`;
        if (shown("busy-text").textContent !== text) shown("busy-text").textContent = text;
    }, BETWEEN);
}
