// The inflated sheet, computed in triangles: seconds of work, so only if it is asked for.

const part = (id) => document.getElementById(`shell-${id}`);

/** Shows no answer of another spec. */
export function clear() {
    part("answer").hidden = true;
    part("note").textContent = "";
}

/** Computes it, by `ask(question)`, which gives undefined if it is stopped. */
export async function compute(ask) {
    clear();
    part("start").disabled = true;
    part("note").textContent = "Computing ...";
    const began = performance.now();
    const answer = await ask({ ask: "predict", model: "shell" });
    part("start").disabled = false;
    if (!answer) {
        part("note").textContent = "Stopped.";
        return;
    }
    const { text, faults, wrong } = answer;
    const fault = faults?.find(({ warning }) => !warning);
    part("note").textContent = text ? `Computed in ${((performance.now() - began) / 1000).toFixed(1)} s.` : `No answer: ${[wrong, fault?.found, fault?.remedy].filter(Boolean).join("; ")}.`;
    part("answer").textContent = text ?? "";
    part("answer").hidden = !text;
}
