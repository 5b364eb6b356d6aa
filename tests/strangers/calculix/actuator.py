"""Half a V-actuator by CalculiX: a mesh of our own, S6 shells from flat up to pressure, angle at rest and volume.

Nothing here shares code with the program. Lengths in mm, forces in N, pressures in MPa. See README.md.
"""

import argparse
import json
import math
import pathlib
import subprocess

# The case: tube width, hinge's inner radius, arm's length, angle, fabric, pressure.
W, R, L, PHI_0 = 20.0, 2.0, 80.0, math.radians(60.0)
E, NU, T, P = 128.0, 0.39, 0.3, 0.014


class Sheet:
    """The upper sheet's half: the mirror plane is y = 0, the hinge's centre the origin, the arm leaves to the left."""

    def __init__(self, across):
        half_arc = 0.5 * (math.pi - PHI_0)
        hinge = max(2, round(across * half_arc * (R + 0.6 * W) / W))
        arm = max(4, round(across * L / W * 0.75))
        # Twice as many points as elements, for the nodes in the middle of their edges.
        self.rows, self.columns = 2 * across, 2 * (hinge + arm)
        self.hinge_columns = 2 * hinge
        self.half_arc = half_arc
        self.flat, self.number = {}, {}
        for j in range(self.rows + 1):
            # Elements four times as narrow at the inner rim as at the outer one.
            v = j / self.rows
            across_tube = W * v * (1.0 + 1.5 * v) / 2.5
            for i in range(self.columns + 1):
                self.flat[i, j] = self.place(i, R + across_tube)
        self.elements = []
        for i in range(0, self.columns, 2):
            for j in range(0, self.rows, 2):
                rising = (i // 2 + j // 2) % 2 == 0
                self.elements += self.cell(i, j, rising)
        used = sorted({node for element in self.elements for node in element})
        self.number = {node: k for k, node in enumerate(used, 1)}

    def along(self, i):
        """Flat distance behind the hinge's end."""
        return L * (i - self.hinge_columns) / (self.columns - self.hinge_columns)

    def place(self, i, r):
        turn = self.half_arc * min(1.0, i / self.hinge_columns)
        x, y = r * math.cos(turn), r * math.sin(turn)
        behind = max(0.0, self.along(i))
        return x - behind * math.sin(turn), y + behind * math.cos(turn)

    @staticmethod
    def cell(i, j, rising):
        """Two triangles, counterclockwise from above: corners, then the middles of their edges."""
        # i runs counterclockwise around the hinge, j outwards: (i, j), (i, j + 2), (i + 2, j + 2) turns left.
        a, b, c, d = (i, j), (i, j + 2), (i + 2, j + 2), (i + 2, j)
        corners = [(a, b, c), (a, c, d)] if rising else [(a, b, d), (b, c, d)]
        middle = lambda p, q: ((p[0] + q[0]) // 2, (p[1] + q[1]) // 2)
        return [(p, q, r, middle(p, q), middle(q, r), middle(r, p)) for p, q, r in corners]

    def deck(self, asked):
        lines = ["*NODE, NSET=ALL"]
        for node, k in self.number.items():
            x, y = self.flat[node]
            lines.append(f"{k}, {x:.12g}, {y:.12g}, 0.")
        lines.append("*ELEMENT, TYPE=S6, ELSET=SHEET")
        for k, element in enumerate(self.elements, 1):
            lines.append(", ".join(str(v) for v in (k, *(self.number[node] for node in element))))
        lines += ["*MATERIAL, NAME=FABRIC", "*ELASTIC", f"{E}, {NU}", "*SHELL SECTION, ELSET=SHEET, MATERIAL=FABRIC", f"{T}"]
        lines.append("*BOUNDARY")
        for (i, j), k in self.number.items():
            if i == 0:
                # The normal stays in the mirror plane: it turns about y only.
                lines += [f"{k}, 2, 2", f"{k}, 4, 4", f"{k}, 6, 6"]
            if j in (0, self.rows) or i == self.columns:
                lines.append(f"{k}, 3, 3")
        lines.append(f"{self.number[0, 0]}, 1, 1")
        lines += ["*STEP, NLGEOM, INC=2000", "*CONTROLS, PARAMETERS=FIELD", f"{asked.residual}, 1."]
        lines += ["*STATIC", f"{asked.first}, 1., 1e-7, {asked.largest}"]
        # S6 are expanded to solids, and P acts on the lower face: upwards it is the inner face, downwards the outer one.
        lines += ["*DLOAD", f"SHEET, P, {P if asked.face == 'inner' else -P}", "*NODE FILE, OUTPUT=2D", "U", "*END STEP", ""]
        return "\n".join(lines)


def displacements(frd):
    """(share of the load, displacement of each node) of every converged increment."""
    share, block, found = None, None, []
    for line in frd.read_text().splitlines():
        if line.startswith("  100CL"):
            share = float(line[12:24])
        elif line.startswith(" -4"):
            block = {} if line.split()[1] == "DISP" else None
        elif line.startswith(" -1") and block is not None:
            block[int(line[3:13])] = tuple(float(line[13 + 12 * k : 25 + 12 * k]) for k in range(3))
        elif line.startswith(" -3") and block is not None:
            found.append((share, block))
            block = None
    return found


def inflated(sheet, moved, up):
    at = {}
    for node, k in sheet.number.items():
        (x, y), (u, v, w) = sheet.flat[node], moved[k]
        at[node] = (x + u, y + v, up * w)
    return at


def angle(sheet, at):
    """Twice the angle between the mirror plane and lines fitted to the rims, one W away from the hinge and from the end."""
    halves = []
    for j in (0, sheet.rows):
        rim = [i for i in range(sheet.columns + 1) if W - 1e-9 <= sheet.along(i) <= L - W + 1e-9]
        xy = [at[i, j][:2] for i in rim]
        x0, y0 = (sum(p[k] for p in xy) / len(xy) for k in (0, 1))
        xx = sum((x - x0) ** 2 for x, _ in xy)
        yy = sum((y - y0) ** 2 for _, y in xy)
        xy2 = 2.0 * sum((x - x0) * (y - y0) for x, y in xy)
        line = 0.5 * math.atan2(xy2, xx - yy)  # of least squares, mod 180 deg
        # Flat, the arm makes the angle phi_0 / 2 with the mirror plane, to the left of the hinge.
        halves.append((-line) % math.pi)
    return 2.0 * math.degrees(sum(halves) / 2.0)


# Quadrature of degree 5 on the triangle: (weight of 1, two of its coordinates).
GAUSS = [(0.225, 1 / 3, 1 / 3)]
for a, weight in ((0.470142064105115, 0.132394152788506), (0.101286507323456, 0.125939180544827)):
    GAUSS += [(weight, a, a), (weight, 1 - 2 * a, a), (weight, a, 1 - 2 * a)]


def volume(sheet, at):
    """Under both sheets of both halves: four times the integral of z over the projected area."""
    total = 0.0
    for element in sheet.elements:
        points = [at[node] for node in element]
        for weight, u, v in GAUSS:
            w = 1.0 - u - v
            n = (w * (2 * w - 1), u * (2 * u - 1), v * (2 * v - 1), 4 * w * u, 4 * u * v, 4 * v * w)
            n_u = (1 - 4 * w, 4 * u - 1, 0.0, 4 * (w - u), 4 * v, -4 * v)
            n_v = (1 - 4 * w, 0.0, 4 * v - 1, -4 * u, 4 * u, 4 * (w - v))
            mean = lambda n, k: sum(f * p[k] for f, p in zip(n, points))
            jacobian = mean(n_u, 0) * mean(n_v, 1) - mean(n_v, 0) * mean(n_u, 1)
            total += 0.5 * weight * mean(n, 2) * jacobian
    return 4.0 * total


def solve(across, folder, asked):
    folder.mkdir(parents=True, exist_ok=True)
    sheet = Sheet(across)
    (folder / "actuator.inp").write_text(sheet.deck(asked))
    with open(folder / "ccx.log", "w") as log:
        code = subprocess.run([asked.ccx, "actuator"], cwd=folder, stdout=log, stderr=log, check=False).returncode
    ladder = []
    for share, moved in displacements(folder / "actuator.frd"):
        at = inflated(sheet, moved, 1.0 if asked.face == "inner" else -1.0)
        ladder.append({"kPa": 1e3 * P * share, "angle_deg": angle(sheet, at), "volume_mm3": volume(sheet, at)})
    found = {"across": across, "face": asked.face, "elements": len(sheet.elements), "nodes": len(sheet.number)}
    return {**found, "code": code, "ladder": ladder}


def extrapolated(coarse, fine, key):
    """The value at elements of zero size, if the error falls as their square; the last step is the error to quote."""
    a, b = (found["ladder"][-1][key] for found in (coarse, fine))
    return b + (b - a) / ((fine["across"] / coarse["across"]) ** 2 - 1.0)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--across", type=int, nargs="+", default=[6], help="elements across the tube, a mesh each")
    parser.add_argument("--face", choices=["inner", "outer"], default="inner", help="the face that the pressure acts on")
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("target/calculix"))
    parser.add_argument("--first", type=float, default=0.003, help="first share of the load")
    parser.add_argument("--largest", type=float, default=0.05, help="largest step of the load's share")
    parser.add_argument("--residual", type=float, default=0.005, help="largest residual, by the mean force")
    parser.add_argument("--ccx", default="ccx")
    asked = parser.parse_args()
    before = None
    for across in asked.across:
        folder = asked.out / f"{asked.face}-{across}"
        found = solve(across, folder, asked)
        (folder / "found.json").write_text(json.dumps(found, indent=1))
        print(json.dumps({**found, "ladder": found["ladder"][-1:]}), flush=True)
        if before:
            keys = ("angle_deg", "volume_mm3")
            print(json.dumps({"extrapolated": {key: extrapolated(before, found, key) for key in keys}}), flush=True)
        before = found


if __name__ == "__main__":
    main()
