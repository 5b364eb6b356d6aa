"""ezdxf audits the drawing: no errors, no fixes, millimetres, every polyline on a named layer."""
import sys

import ezdxf
from ezdxf import units

path = sys.argv[1]
doc = ezdxf.readfile(path)
audit = doc.audit()
problems = [str(entry.message) for entry in audit.errors + audit.fixes]
if doc.units != units.MM:
    problems.append(f"units {doc.units}, not millimetres")
layers = {layer.dxf.name for layer in doc.layers}
shapes = list(doc.modelspace())
problems += [f"{e.dxftype()} on unknown layer {e.dxf.layer}" for e in shapes if e.dxf.layer not in layers]
if not shapes:
    problems.append("nothing in model space")
if problems:
    sys.exit(f"{path}: " + "; ".join(problems))
