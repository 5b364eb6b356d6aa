// From an object to a spec: the form at the top.
import { element } from "./form.js";

const objectForm = () => document.getElementById("object-form");
const field = (name) => objectForm().elements.namedItem(name);

/** Requests a gripper with `ask(question)`; `take(spec)` receives the result. */
export async function find(ask, take) {
    const entries = [...objectForm().elements].filter(({ name }) => name);
    for (const { name } of entries) field(name).removeAttribute("aria-invalid");
    const place = document.getElementById("object-answer");
    place.textContent = "Searching ...";
    const answer = await ask({ ask: "new", ...Object.fromEntries(entries.map(({ name, value }) => [name, value])) });
    if (!answer) {
        place.textContent = "Stopped.";
        return;
    }
    place.replaceChildren(...told(answer));
    if (answer.spec) take(answer.spec);
}

/** The result of the search, as elements. */
function told({ fields, reasons, nearest, in_words, wrong }) {
    if (wrong) return [element("p", { className: "why" }, wrong)];
    if (fields) {
        field(fields[0].field)?.focus();
        return fields.map(({ field: name, found }) => {
            field(name)?.setAttribute("aria-invalid", "true");
            return element("p", { className: "why" }, `${name}: ${found}`);
        });
    }
    if (in_words) return in_words.trim().split("\n").map((line) => element("p", {}, line.trim()));
    const list = [element("p", { className: "why" }, "No gripper was found for these requirements:"), element("ul", {}, ...reasons.map((text) => element("li", {}, text.replaceAll(/--(?=[a-z])/g, ""))))];
    if (nearest) {
        const values = Object.entries(nearest).filter(([, value]) => value !== null);
        const use = () => {
            for (const [name, value] of values) field(name).value = value;
            objectForm().requestSubmit();
        };
        const named = values.map(([name, value]) => `${name} ${value}`).join(", ");
        list.push(element("p", {}, `The closest that can be made: ${named}. `), element("button", { type: "button", onclick: use }, "Use these values"));
    }
    return list;
}
