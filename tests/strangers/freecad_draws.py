"""FreeCAD writes a drawing as DXF and as SVG: lines, arcs, an ellipse, a spline. `drawn_by.py` compares how both are sealed.

Usage: freecad_draws.py DIRECTORY, by the Python that FreeCAD is built for (Debian's), which knows it as a module.
"""
import math
import os
import sys

sys.path += ["/usr/lib/freecad-python3/lib", "/usr/lib/freecad/Mod/Draft", "/usr/lib/freecad/Ext"]
import FreeCAD
import Import
import Part
import importSVG
from FreeCAD import Vector

folder = sys.argv[1]
os.makedirs(folder, exist_ok=True)
document = FreeCAD.newDocument("drawing")
# An object's label becomes its layer in a DXF, its name the id of its group in an SVG.
objects = []


def at(x, y):
    return Vector(x, y, 0)


def shown(name, *wires):
    item = document.addObject("Part::Feature", name)
    item.Label, item.Shape = name, Part.makeCompound([Part.Wire(wire) for wire in wires])
    objects.append(item)


def corner(x, y, degrees):
    """A quarter of a circle of 15 mm around a place."""
    places = (15 * complex(math.cos(a), math.sin(a)) for a in (math.radians(degrees + turn) for turn in (0, 45, 90)))
    return Part.Arc(*(at(x + p.real, y + p.imag) for p in places)).toShape()


rim = [Part.makeLine(at(35, 20), at(155, 20)), corner(155, 35, 270), Part.makeLine(at(170, 35), at(170, 130)), Part.makeLine(at(170, 130), at(20, 130))]
rim += [Part.makeLine(at(20, 130), at(20, 35)), corner(35, 35, 180)]
blob = Part.BSplineCurve()
blob.interpolate([at(110, 60), at(130, 70), at(125, 95), at(105, 90)], PeriodicFlag=True)
shown("air", rim, [Part.Ellipse(at(70, 80), 12, 8).toShape()], [blob.toShape()])
shown("port", [Part.makeLine(at(16, 72), at(24, 72))])
document.recompute()
Import.writeDXFObject(objects, os.path.join(folder, "freecad.dxf"), 14, True)
importSVG.export(objects, os.path.join(folder, "freecad-plain.svg"))
