"""trimesh reads solids: watertight, wound outwards, one body, of the area and the extents in the manifest.

The area is that of its bottom face, and the volume that area times the thickness.

Of a mask in pieces the first one is looked at together with all others: moved back to where they belong, they are the plate of the
mask's drawing. The Euler number counts holes: a disc with k of them has 2 - 2 k.

Usage: stl.py FILE...
"""
import json
import math
import os
import re
import sys

import numpy
import trimesh


def problems_of(path):
    folder, name = os.path.split(path)
    manifest = json.load(open(os.path.join(folder, "manifest.json"), encoding="utf-8"))
    entry = next(f for f in manifest["files"] if f["path"] == name)
    problems = []

    def load(file):
        return trimesh.load_mesh(os.path.join(folder, file))

    def shapes(file):
        """The number of closed shapes by layer of a drawing, without labels."""
        svg = open(os.path.join(folder, file), encoding="utf-8").read()
        groups = re.findall(r'<g[^>]*\bid="([a-z-]+)"[^>]*>(.*?)</g>', svg, re.S)
        return {layer: body.count("<path") + body.count("<circle") for layer, body in groups if layer != "label"}

    mesh = load(name)
    if not mesh.is_watertight:
        problems.append("not watertight")
    if not mesh.is_winding_consistent:
        problems.append("winding not consistent")
    head = open(path, "rb").read(80).decode("ascii").strip()
    if not head or head.startswith("solid") or manifest["name"][:10] not in head:
        problems.append(f"the head says {head!r}")

    def foot(solid):
        """Area of the faces that look down."""
        return solid.area_faces[solid.face_normals[:, 2] < -0.99].sum()

    def whole(solids, area, thickness, euler, holes):
        stands, volume = sum(map(foot, solids)), sum(solid.volume for solid in solids)
        if abs(stands - area) > 1e-3 * area:
            problems.append(f"stands on {stands:.1f} mm2, the manifest says {area:.1f}")
        if not 0.999 * area * thickness < volume < 1.0001 * area * thickness:
            problems.append(f"{volume:.1f} mm3, the manifest says {area * thickness:.1f}")
        if euler != 2 - 2 * holes:
            problems.append(f"Euler number {euler} with {holes} holes")

    if entry["kind"] == "frame-stl":
        plate = next(p for p in manifest["plates"] if entry["plate"] in p["plates"])
        holes = sum(shapes(name.replace(".stl", ".svg")).values()) - 1
        whole([mesh], plate["area_mm2"], plate["thickness_mm"], mesh.euler_number, holes)
    else:
        mask = next(m for m in manifest["masks"] if m["star"] == entry["star"])
        drawing = re.sub(r"(-piece-\d+)?\.stl$", ".svg", name)
        holes = sum(count for layer, count in shapes(drawing).items() if layer in ("mask-window", "registration"))
        piece = next((p for p in mask.get("pieces", []) if p["piece"] == entry.get("piece", 1)), None)
        if piece is not None and any(abs(a - b) > 0.05 for a, b in zip(mesh.extents, piece["size_mm"])):
            problems.append(f"{mesh.extents[:2]} mm, the manifest says {piece['size_mm']}")
        if piece is not None and max(mesh.extents) > 220.0:
            problems.append(f"{mesh.extents[:2]} mm do not fit on 220 x 220 mm")
        if "piece" not in entry:
            whole([mesh], mask["area_mm2"], mask["volume_mm3"] / mask["area_mm2"], mesh.euler_number, holes)
        elif entry["piece"] == 1:
            pieces = [load(re.sub(r"piece-1\.stl$", f"piece-{p['piece']}.stl", name)) for p in mask["pieces"]]
            # Each is a disc of its own: together they have one 2 for every piece.
            euler = sum(p.euler_number for p in pieces) - 2 * (len(pieces) - 1)
            whole(pieces, mask["area_mm2"], mask["volume_mm3"] / mask["area_mm2"], euler, holes)
            sign = -1.0 if entry.get("mirrored") else 1.0
            points = []
            for p, where in zip(pieces, mask["pieces"]):
                back = -sign * math.radians(where["turn_deg"])
                turn = numpy.array([[math.cos(back), -math.sin(back)], [math.sin(back), math.cos(back)]])
                points.append(p.vertices[:, :2] @ turn.T)
            low, high = numpy.min([p.min(0) for p in points], 0), numpy.max([p.max(0) for p in points], 0)
            svg = open(os.path.join(folder, drawing), encoding="utf-8").read()
            page = [float(x) for x in re.search(r'viewBox="([^"]*)"', svg).group(1).split()]
            # A drawing's page ends one to two millimetres beyond the plate.
            if any(not 0.98 < page[2 + k] - (high - low)[k] < 4.0 for k in range(2)):
                problems.append(f"together {high - low} mm, on a page of {page[2:]}")
    return [f"{path}: {problem}" for problem in problems]


every = [problem for path in sys.argv[1:] for problem in problems_of(path)]
if every:
    sys.exit("\n".join(every))
