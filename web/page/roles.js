// The menu over a drawing: the role of the layer of a curve, and the process by which its seams are made.
import { byId, element } from "./dom.js";

const ROLES = [["air", "edge of the air"], ["seam", "weld or wall: the middle of a band"], ["port", "a hose goes in here"], ["cut", "outline that is cut"], ["hole", "opening that is cut out"], ["valve", "hole in one sheet, for a valve in the face"], ["measure", "measured after inflation"], ["pull", "one of two bars that pull"], ["ignore", "left out"]];

/** Closes the menu. */
export function closeRoles() {
    byId("roles").hidden = true;
    for (const line of document.querySelectorAll("#canvas .feel.on")) line.classList.remove("on");
}

/** The choice of a process for a figure that is sealed, among `processes` and one more; `assign(process)` receives it, "" for that of [seal].
 * Where a name that is no layer decides, the choice tells it. */
function processChoice({ process, process_of: decider, layers }, processes, assign) {
    const more = ["weak", "strong", `process-${processes.length + 1}`].find((name) => !processes.includes(name));
    const seal = decider && !layers.includes(decider) ? `as [seal] says, for ${decider}` : "as [seal] says";
    const options = [["", seal], ...processes.map((name) => [name, name]), [more, `new: ${more}`]].map(([value, words]) => element("option", { value, selected: value === (process ?? "") }, words));
    return element("label", { className: "process" }, "Process ", element("select", { onchange: ({ target }) => (closeRoles(), assign(target.value)) }, ...options));
}

/** Asks for the role of `figure`, whose line is `line`, and for its process among `processes`; `choose(layer, role)` and
 * `assign(name, process)` receive them. Both may be for its layer, or for the curve alone. The entry of its own id goes before that of a layer,
 * and only the entry that decides can be taken away. */
export function askRole(figure, line, { processes, choose, assign }) {
    closeRoles();
    line.classList.add("on");
    const names = [...new Set([figure.layer, ...figure.layers])].filter(Boolean);
    const which = element("select", { "aria-label": "For" }, ...names.map((name) => element("option", { value: name }, name === figure.layer ? `layer ${name}` : name)));
    const choice = ([role, meaning]) => {
        const input = element("input", { type: "radio", name: "role", value: role, checked: role === figure.role, onchange: () => (closeRoles(), choose(which.value, role)) });
        return element("label", { className: "check" }, input, element("span", {}, element("b", {}, role), ` ${meaning}`));
    };
    const close = element("button", { type: "button", className: "plain", onclick: closeRoles }, "close");
    const decider = figure.process_of;
    const named = (process) => (decider && (process === "" || decider === figure.id) ? decider : which.value);
    const isSealed = figure.role === "seam" || figure.role === "air";
    byId("roles").replaceChildren(element("h2", {}, figure.id, close), which, ...ROLES.map(choice), ...(isSealed ? [processChoice(figure, processes, (process) => assign(named(process), process))] : []));
    byId("roles").hidden = false;
    byId("roles").onkeydown = ({ key }) => key === "Escape" && (closeRoles(), line.focus());
    (byId("roles").querySelector("input:checked") ?? which).focus();
}
