// Drawing: outlines from the block of figures as paths of a drawing, Y up as on the machine.

"use strict";

/** The corners of a polyline in mm: hundredths, each a step from the one before. */
function corners(steps) {
  const out = [];
  let x = 0;
  let y = 0;
  for (let i = 0; i + 1 < steps.length; i += 2) {
    x += steps[i];
    y += steps[i + 1];
    out.push([x / 100, y / 100]);
  }
  return out;
}

/** A path through points; Y is turned over, for drawings count downwards. */
function pathOf(points, closed) {
  const text = points.map(([x, y], i) => `${i === 0 ? "M" : "L"}${x.toFixed(2)} ${(-y).toFixed(2)}`);
  return text.join("") + (closed ? "Z" : "");
}

/** The tube of a star of `points` tips in a pose, between two shares of its width: 0 towards the hole, 1 outside. */
function tubeOf(pose, points, [from, to]) {
  const edge = (share) => {
    const out = [];
    const arc = (distance, ray, start, end, radius) => {
      const steps = 14;
      for (let i = 0; i <= steps; i += 1) {
        const turn = start + ((end - start) * i) / steps;
        out.push([distance * Math.cos(ray) + radius * Math.cos(turn), distance * Math.sin(ray) + radius * Math.sin(turn)]);
      }
    };
    const sector = Math.PI / points;
    const tip = (pose.tip_angle_deg * Math.PI) / 180;
    const half = (Math.PI - tip) / 2;
    for (let k = 0; k < points; k += 1) {
      const ray = 2 * k * sector;
      // A corner's centre lies beyond the tube, a tip's inside of it.
      const inner = pose.corner_radius_mm + (1 - share) * pose.width_mm;
      arc(pose.corner_centre_mm, ray, ray + Math.PI + (half - sector), ray + Math.PI - (half - sector), inner);
      const outer = pose.tip_radius_mm + share * pose.width_mm;
      arc(pose.tip_centre_mm, ray + sector, ray + sector - half, ray + sector + half, outer);
    }
    return pathOf(out, true);
  };
  return edge(to) + edge(from);
}

/** How far a star in a pose reaches from its axis. */
function reachOf(pose) {
  return pose.tip_centre_mm + pose.tip_radius_mm + pose.width_mm;
}

/** A pose between two others. */
function between(a, b, share) {
  const out = {};
  for (const key of Object.keys(a)) out[key] = a[key] + (b[key] - a[key]) * share;
  return out;
}
