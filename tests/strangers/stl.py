"""trimesh reads the solid: watertight, wound outwards, one body, of the volume that the manifest says."""
import json
import os
import re
import sys

import trimesh

path = sys.argv[1]
folder, name = os.path.split(path)
manifest = json.load(open(os.path.join(folder, "manifest.json"), encoding="utf-8"))
entry = next(f for f in manifest["files"] if f["path"] == name)
mask = next(m for m in manifest["masks"] if m["star"] == entry["star"])
mesh = trimesh.load_mesh(path)
problems = []
if not mesh.is_watertight:
    problems.append("not watertight")
if not mesh.is_winding_consistent:
    problems.append("winding not consistent")
if abs(mesh.volume - mask["volume_mm3"]) > 2e-3 * mask["volume_mm3"]:
    problems.append(f"{mesh.volume:.1f} mm3, the manifest says {mask['volume_mm3']:.1f}")
# One disc with k holes through it has the Euler number 2 - 2 k: the windows and the registration holes.
svg = open(path.removesuffix(".stl") + ".svg", encoding="utf-8").read()
windows = re.search(r'<g[^>]*id="mask-window"[^>]*>(.*?)</g>', svg, re.S).group(1)
holes = windows.count("<path") + svg.count("<circle")
if mesh.euler_number != 2 - 2 * holes:
    problems.append(f"Euler number {mesh.euler_number} with {holes} holes")
if problems:
    sys.exit(f"{path}: " + "; ".join(problems))
