// The measures of an inflated drawing in words, with mesh error or range: "angle to base 23 ± 2°", which is flat "0°".

/** The quantities of a measure in the order of their weight: key, word, unit. */
const QUANTITIES = [["angle_deg", "angle", "°"], ["radius_mm", "radius", " mm"], ["distance_mm", "distance", " mm"], ["height_mm", "height", " mm"], ["direction_deg", "direction", "°"], ["x_mm", "x", " mm"], ["y_mm", "y", " mm"]];

/** A number with three digits, and three decimals at most, below which a mesh has noise. */
const figure = (number) => String(Number(Number(number.toPrecision(3)).toFixed(3)));

/** The quantities of a `measure` in words, [{ inflated, flat }]; those that are not computed are left out. */
export function measured(measure) {
    return QUANTITIES.filter(([key]) => measure[key]?.inflated).map(([key, word, unit]) => {
        const { flat, inflated, range } = measure[key], name = key === "angle_deg" && measure.angle_to ? `angle to ${measure.angle_to}` : word;
        const error = range ? ` (${range.map(figure).join(" to ")})` : ` ± ${Number(inflated.mesh_error.toPrecision(1))}`;
        return { inflated: `${name} ${figure(inflated.value)}${error}${unit}`, flat: figure(flat) + unit };
    });
}
