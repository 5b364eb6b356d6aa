"""FreeCAD reads masks and frames: closed wires, faces with all holes, areas and volumes as in the manifest.

Usage: freecad.py DIRECTORY..., by the Python that FreeCAD is built for (Debian's), which knows it as a module.
"""
import json
import os
import sys

sys.path += ["/usr/lib/freecad-python3/lib", "/usr/lib/freecad/Mod/Draft", "/usr/lib/freecad/Ext"]
import FreeCAD
import Import
import Mesh
import Part
import importSVG

# Tolerance of an area and of a length. The areas of an SVG are not compared: its arcs become splines of the right
# length, and within one closed spline FreeCAD integrates to some thousandths only.
SHARE = {"dxf": 1e-6, "svg": 1e-6}


def edges(file):
    document = FreeCAD.newDocument("drawing")
    if file.endswith(".dxf"):
        Import.readDXF(file)
    else:
        importSVG.insert(file, document.Name)
    found = [edge for item in document.Objects if hasattr(item, "Shape") for edge in item.Shape.Edges]
    FreeCAD.closeDocument(document.Name)
    return found


def face(file):
    """The face within the largest closed wire without the others; closed letters of a label are straight and small."""
    wires = [Part.Wire(group) for group in Part.sortEdges(edges(file))]
    faces = sorted((Part.Face(wire) for wire in wires if wire.isClosed()), key=lambda face: face.Area)
    round_or_large = lambda face: face.Area > 50.0 or len(face.Edges) <= 2
    holes = [face for face in faces[:-1] if round_or_large(face)]
    return faces[-1].cut(holes), len(holes)


def flat(file, area, holes):
    shape, found = face(file)
    share = SHARE[file[-3:]]
    if not shape.isValid():
        yield "a face that is not valid"
    if found != holes:
        yield f"{found} holes, the manifest says {holes}"
    if file.endswith(".svg"):
        length = lambda form: sum(edge.Length for edge in edges(file[:-3] + form))
        what, off = f"{length('svg'):.3f} mm of lines", length("svg") / length("dxf") - 1.0
    else:
        what, off = f"{shape.Area:.3f} mm2", shape.Area / area - 1.0
    if abs(off) > share:
        yield f"{what}, {off:+.1e} of what is right"
    print(f"{file}: {what}, {found} holes, {off:+.1e} of what is right")


def solid(file, volume):
    mesh = Mesh.Mesh(file)
    if not mesh.isSolid() or mesh.hasNonManifolds() or mesh.hasSelfIntersections() or mesh.countComponents() != 1:
        yield "no single solid without faults"
    if not 0.999 < mesh.Volume / volume < 1.0002:
        yield f"{mesh.Volume:.3f} mm3, the manifest says {volume:.3f}"
    print(f"{file}: {mesh.Volume:.1f} mm3, {mesh.Volume / volume - 1.0:+.1e} of the manifest's")


def main():
    problems = []
    for folder in map(os.path.abspath, sys.argv[1:]):
        manifest = json.load(open(os.path.join(folder, "manifest.json"), encoding="utf-8"))
        posts = manifest["posts"][0]["count"]
        for entry in manifest["files"]:
            file, (subject, _, form) = os.path.join(folder, entry["path"]), entry["kind"].partition("-")
            if subject == "mask" and form in ("dxf", "svg", "stl"):
                mask = next(mask for mask in manifest["masks"] if mask["star"] == entry["star"])
                # All windows are equal, and there are three registration holes of 3 mm.
                windows = round((face_area(folder, entry) - mask["area_mm2"]) / mask["window_mm2"])
                found = solid(file, mask["volume_mm3"]) if form == "stl" else flat(file, mask["area_mm2"], windows + 3)
            elif subject == "frame":
                plate = next(plate for plate in manifest["plates"] if entry["plate"] in plate["plates"])
                found = flat(file, plate["area_mm2"], posts + 1)
            else:
                continue
            problems += [f"{file}: FreeCAD: {problem}" for problem in found]
    if problems:
        sys.exit("\n".join(problems))


def face_area(folder, entry):
    """Area within the largest closed wire of the mask's DXF."""
    name = os.path.splitext(entry["path"])[0] + ".dxf"
    wires = [Part.Wire(group) for group in Part.sortEdges(edges(os.path.join(folder, name)))]
    return max(Part.Face(wire).Area for wire in wires if wire.isClosed())


main()
