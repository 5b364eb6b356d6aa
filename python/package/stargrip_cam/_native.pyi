"""The types of the compiled part. What each thing means stands in the docstrings, which `help()` shows."""

import os
from collections.abc import Callable, Sequence
from typing import Any, Literal, Mapping, Union, final

import numpy as np
from numpy.typing import NDArray

from stargrip_cam.errors import Fault

__version__: str

_Floats = NDArray[np.float64]
_Progress = Union[bool, Callable[[float, str], object], None]
_Model = Literal["fit", "ring", "bvp", "section", "shell", "auto"]
_Fineness = Literal["coarse", "medium", "fine"]
_Range = Union[str, tuple[str, str], None]
_Interval = Union[tuple[float, float], None]

@final
class Spec:
    @classmethod
    def from_toml(cls, source: str | os.PathLike[str]) -> Spec: ...
    @classmethod
    def from_dict(cls, sections: Mapping[str, Any]) -> Spec: ...
    @classmethod
    def starter(cls, name: str) -> Spec: ...
    def replace(self, values: Mapping[str, Any] | None = None, /, **more: Any) -> Spec: ...
    def to_toml(self) -> str: ...
    def to_dict(self) -> dict[str, Any]: ...
    def settings(self) -> dict[str, str | None]: ...
    @property
    def name(self) -> str: ...
    @property
    def warnings(self) -> list[Fault]: ...

@final
class Line:
    @property
    def start(self) -> tuple[float, float]: ...
    @property
    def end(self) -> tuple[float, float]: ...

@final
class Arc:
    @property
    def center(self) -> tuple[float, float]: ...
    @property
    def radius_mm(self) -> float: ...
    @property
    def start_angle_deg(self) -> float: ...
    @property
    def sweep_deg(self) -> float: ...
    @property
    def start(self) -> tuple[float, float]: ...
    @property
    def end(self) -> tuple[float, float]: ...

@final
class Contour:
    @property
    def segments(self) -> tuple[Line | Arc, ...]: ...
    @property
    def closed(self) -> bool: ...
    @property
    def length_mm(self) -> float: ...
    @property
    def area_mm2(self) -> float | None: ...
    def points(self, tolerance_mm: float = 0.01) -> _Floats: ...
    @property
    def __geo_interface__(self) -> dict[str, Any]: ...

@final
class Star:
    @property
    def index(self) -> int: ...
    @property
    def sheet(self) -> int: ...
    @property
    def placement(self) -> _Floats: ...
    @property
    def points(self) -> int: ...
    @property
    def inner_radius_mm(self) -> float: ...
    @property
    def tube_width_mm(self) -> float: ...
    @property
    def tip_angle_deg(self) -> float: ...
    @property
    def corner_angle_deg(self) -> float: ...
    @property
    def arm_length_mm(self) -> float: ...
    @property
    def fabric_mm2(self) -> float: ...
    @property
    def tip_centers_mm(self) -> _Floats: ...
    @property
    def corner_centers_mm(self) -> _Floats: ...
    @property
    def arms_mm(self) -> _Floats: ...
    @property
    def edges(self) -> tuple[Contour, Contour]: ...
    @property
    def seams(self) -> tuple[Contour, Contour]: ...
    @property
    def outline(self) -> tuple[Contour, Contour]: ...
    @property
    def windows(self) -> list[Contour]: ...
    @property
    def registration_mm(self) -> _Floats: ...
    def polygon(self, tolerance_mm: float = 0.01) -> dict[str, Any]: ...
    @property
    def __geo_interface__(self) -> dict[str, Any]: ...

@final
class Design:
    @property
    def stars(self) -> list[Star]: ...
    @property
    def sheets(self) -> list[dict[str, Any]]: ...
    @property
    def warnings(self) -> list[dict[str, Any]]: ...
    def _repr_svg_(self) -> str | None: ...

@final
class Mesh:
    @property
    def nodes_mm(self) -> _Floats: ...
    @property
    def flat_mm(self) -> _Floats: ...
    @property
    def triangles(self) -> NDArray[np.int64]: ...
    @property
    def tension_N_per_mm(self) -> _Floats: ...
    @property
    def stretch(self) -> _Floats: ...
    @property
    def curvature_per_mm(self) -> _Floats: ...
    @property
    def node_stretch(self) -> _Floats: ...
    def vtu(self) -> str: ...

@final
class Prediction:
    # Those that every model has; the others of `to_dict()` come untyped.
    model: str
    arm_length_mm: float
    tip_equilibrium_angle_deg: float | None
    final_radius_mm: float | None
    contraction: float | None
    hinge_stiffness_Nm: dict[str, float] | None
    radial_stiffness_N_per_m: float | None
    preload_N: float | None
    graspable_radius_mm: _Interval
    hole_radius_mm: float
    object_radius_mm: float | None
    object_gap_mm: float | None
    object_force_N: float | None
    bendability: float | None
    operating_pressure_kPa: float
    realised_radius_mm: dict[str, float]
    burst_pressure_kPa: float | None
    mass_g: float | None
    stack_mass_g: float | None
    payload_kg: float | None
    ranges: dict[str, Any]
    evidence: dict[str, Any]
    stars: list[dict[str, Any]]
    @property
    def mesh(self) -> Mesh | None: ...
    def to_dict(self) -> dict[str, Any]: ...
    def _repr_html_(self) -> str: ...
    def __getattr__(self, name: str) -> Any: ...

@final
class ActuatorPrediction:
    model: str
    bendability: float
    stretch: float
    angle_deg: float
    coiling: float
    volume_mm3: float | None
    stiffness_Nm: float
    ranges: dict[str, Any]
    evidence: dict[str, Any]
    @property
    def mesh(self) -> Mesh | None: ...
    def to_dict(self) -> dict[str, Any]: ...
    def _repr_html_(self) -> str: ...
    def __getattr__(self, name: str) -> Any: ...

@final
class Build:
    @property
    def files(self) -> dict[str, bytes]: ...
    @property
    def manifest(self) -> dict[str, Any]: ...
    @property
    def prediction(self) -> Prediction | None: ...
    @property
    def deviation_mm(self) -> dict[str, float | None]: ...
    def write(self, path: str | os.PathLike[str]) -> str: ...
    def _repr_svg_(self) -> str | None: ...
    def _repr_html_(self) -> str: ...

@final
class Optimum:
    @property
    def spec(self) -> Spec | None: ...
    @property
    def computed(self) -> int: ...
    @property
    def best(self) -> dict[str, _Floats]: ...
    @property
    def short(self) -> list[dict[str, float]]: ...
    @property
    def front(self) -> dict[str, _Floats]: ...

def design(spec: Spec) -> Design: ...
def predict(
    spec: Spec,
    *,
    model: _Model | None = None,
    radii: str | None = None,
    fineness: _Fineness | None = None,
    progress: _Progress = None,
) -> Prediction: ...
def build(
    spec: Spec,
    *,
    only: Sequence[str] | None = None,
    with_: Sequence[str] | None = None,
    anyway: bool = False,
    progress: _Progress = None,
) -> Build: ...
def optimize(
    spec: Spec,
    *,
    goal: Literal["hold", "contraction", "stiffness", "fabric"] | None = None,
    points: int | tuple[int, int] | None = None,
    tip_angle: _Range = None,
    tube_width: _Range = None,
    tip_radius: _Range = None,
    corner_radius: _Range = None,
    inner_radius: _Range = None,
    pressure: _Range = None,
    count: int | tuple[int, int] | None = None,
    grasp: _Range = None,
    payload: float | None = None,
    largest_force: float | None = None,
    burst_margin: float | None = None,
    progress: _Progress = None,
) -> Optimum: ...
def actuator(
    *,
    tube_width: str,
    radius: str,
    arm_length: str,
    angle: str,
    pressure: str,
    thickness: str | None = None,
    young_modulus: str | None = None,
    poisson_ratio: float | None = None,
    model: _Model | None = None,
    angles: str | None = None,
    fineness: _Fineness | None = None,
    progress: _Progress = None,
) -> ActuatorPrediction: ...
def sweep(
    spec: Spec,
    vary: Mapping[str, str | Sequence[Any]] | None = None,
    *,
    study: str | None = None,
    outputs: Sequence[str] | None = None,
    part: tuple[int, int] | None = None,
    threads: int | None = None,
    progress: _Progress = None,
) -> dict[str, NDArray[Any]]: ...
def repeat(spec: Spec, model: _Model | None, times: int) -> None: ...
def prove(path: str, progress: _Progress) -> dict[str, Any]: ...
def run(args: Sequence[str], file: str) -> int: ...
