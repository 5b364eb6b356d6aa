// The line at the lower edge while the program works for longer: what it does, how far it is, and a button that stops it.

const shown = (id) => document.getElementById(id);
/** Work that is over sooner gets no line, ms. */
const LONG_WORK = 700;
/** Between two looks at the program, ms. */
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
