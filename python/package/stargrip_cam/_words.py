"""Words that arguments take, as types."""

from __future__ import annotations

from typing import Literal

Model = Literal["fit", "ring", "bvp", "section", "shell", "auto"]
Fineness = Literal["coarse", "medium", "fine"]
FileKind = Literal[
    "spec",
    "machine",
    "drawing-svg",
    "drawing-dxf",
    "seal-gcode",
    "seal-3mf",
    "trace-gcode",
    "trace-3mf",
    "cut-gcode",
    "cut-3mf",
    "seal-svg",
    "seal-dxf",
    "outline-svg",
    "outline-dxf",
    "outline-pdf",
    "mask-svg",
    "mask-dxf",
    "mask-pdf",
    "mask-stl",
    "separator-svg",
    "separator-dxf",
    "separator-pdf",
    "press-plan",
    "pieces-svg",
    "frame-svg",
    "frame-dxf",
    "frame-pdf",
    "frame-stl",
    "preview-svg",
    "preview-png",
    "prediction",
    "scene-glb",
    "mjcf",
    "report",
]
CouponKind = Literal["strips", "disc", "v-actuator", "burst"]
