// The menu over a drawing: the role of the layer of a curve.
import { byId, element } from "./dom.js";

const ROLES = [["air", "edge of the air"], ["seam", "weld or wall: the middle of a band"], ["port", "a hose goes in here"], ["cut", "outline that is cut"], ["hole", "opening that is cut out"], ["valve", "hole in one sheet, for a valve in the face"], ["measure", "measured after inflation"], ["ignore", "left out"]];

/** Closes the menu. */
export function closeRoles() {
    byId("roles").hidden = true;
    for (const line of document.querySelectorAll("#canvas .feel.on")) line.classList.remove("on");
}

/** Asks for the role of `figure`, whose line is `line`; `choose(layer, role)` receives it. A role may be for its layer, or for the curve alone. */
export function askRole(figure, line, choose) {
    closeRoles();
    line.classList.add("on");
    const names = [...new Set([figure.layer, ...figure.layers])].filter(Boolean);
    const which = element("select", { "aria-label": "For" }, ...names.map((name) => element("option", { value: name }, name === figure.layer ? `layer ${name}` : name)));
    const choice = ([role, meaning]) => {
        const input = element("input", { type: "radio", name: "role", value: role, checked: role === figure.role, onchange: () => (closeRoles(), choose(which.value, role)) });
        return element("label", { className: "check" }, input, element("span", {}, element("b", {}, role), ` ${meaning}`));
    };
    const close = element("button", { type: "button", className: "plain", onclick: closeRoles }, "close");
    byId("roles").replaceChildren(element("h2", {}, figure.id, close), which, ...ROLES.map(choice));
    byId("roles").hidden = false;
    byId("roles").onkeydown = ({ key }) => key === "Escape" && (closeRoles(), line.focus());
    (byId("roles").querySelector("input:checked") ?? which).focus();
}
