"""Fabrication CAM for fabric star soft grippers: design, predict, build and prove them.

A specification is TOML text, read into a `Spec`. From a spec follow its exact geometry (`design`), its prediction (`predict`), its
files (`build`), and other specs (`Spec.replace`, `optimize`); `Spec.for_object` finds one, `sweep` computes many at once. Quantities as arguments are
strings with a unit, "50 mm"; numbers in results have their unit in their name: lengths mm, angles deg, forces N.

    >>> import stargrip_cam as sg
    >>> spec = sg.Spec.starter("my star").replace({"load.pressure": "37 kPa"})
    >>> round(sg.predict(spec).final_radius_mm, 1)
    17.0
"""

from stargrip_cam._native import (
    ActuatorPrediction,
    Aligned,
    Arc,
    Body,
    Build,
    Chamber,
    Contour,
    Design,
    DrawnPrediction,
    Line,
    Mesh,
    Optimum,
    Piece,
    Prediction,
    Seam,
    Spec,
    Star,
    __version__,
    actuator,
    align,
    build,
    coupon,
    design,
    feed_check,
    machines,
    optimize,
    predict,
    sweep,
)
from stargrip_cam._parquet import sweep_to_parquet
from stargrip_cam._proof import Proof, verify
from stargrip_cam._workshop import Resumed, resume
from stargrip_cam.errors import (
    DesignError,
    Error,
    Fault,
    PredictionError,
    ProofError,
    PublishError,
    SpecError,
    UsageError,
)

__all__ = [
    "ActuatorPrediction",
    "Aligned",
    "Arc",
    "Body",
    "Build",
    "Chamber",
    "Contour",
    "Design",
    "DesignError",
    "DrawnPrediction",
    "Error",
    "Fault",
    "Line",
    "Mesh",
    "Optimum",
    "Piece",
    "Prediction",
    "PredictionError",
    "Proof",
    "ProofError",
    "PublishError",
    "Resumed",
    "Seam",
    "Spec",
    "SpecError",
    "Star",
    "UsageError",
    "__version__",
    "actuator",
    "align",
    "build",
    "coupon",
    "design",
    "feed_check",
    "machines",
    "optimize",
    "predict",
    "resume",
    "sweep",
    "sweep_to_parquet",
    "verify",
]
