// The inflated sheet, computed in triangles: it takes seconds, so it is computed on request only.

const part = (id) => document.getElementById(`shell-${id}`);

/** Removes the answer about the previous spec. */
export function clear() {
    part("answer").hidden = true;
    part("note").textContent = "";
}

/** Computes it with `ask(question)`, which returns undefined if it is stopped. */
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
