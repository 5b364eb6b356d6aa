"""ezdxf audits drawings: no errors, no fixes, millimetres, every polyline on a named layer. Usage: dxf.py FILE..."""
import sys

import ezdxf
from ezdxf import units


def problems(path):
    doc = ezdxf.readfile(path)
    audit = doc.audit()
    found = [str(entry.message) for entry in audit.errors + audit.fixes]
    if doc.units != units.MM:
        found.append(f"units {doc.units}, not millimetres")
    layers = {layer.dxf.name for layer in doc.layers}
    shapes = list(doc.modelspace())
    found += [f"{e.dxftype()} on unknown layer {e.dxf.layer}" for e in shapes if e.dxf.layer not in layers]
    if not shapes:
        found.append("nothing in model space")
    return [f"{path}: {problem}" for problem in found]


every = [problem for path in sys.argv[1:] for problem in problems(path)]
if every:
    sys.exit("\n".join(every))
