"""The types of the compiled part. `python/stubs.py` writes the docstrings, and the attributes of predictions."""

import os
from collections.abc import Callable, Sequence
from typing import Any, Literal, Mapping, Union, final

import numpy as np
from numpy.typing import NDArray

from stargrip_cam._words import CouponKind, FileKind, Fineness, Model
from stargrip_cam.errors import Fault

__version__: str

_Floats = NDArray[np.float64]
_Progress = Union[bool, Callable[[float, str], object], None]
_Range = Union[str, tuple[str, str], None]
_Interval = Union[tuple[float, float], None]

@final
class Spec:
    """The specification of a gripper: valid TOML. It never changes; `replace` makes another.

    Quantities are strings with a unit, "50 mm"; a bare number where a unit is needed is refused.
    """
    @classmethod
    def from_toml(cls, source: str | os.PathLike[str]) -> Spec:
        """Reads a spec: `source` is its text, or names its file, as a path or as a string that ends in ".toml" (no spec is one
        line). A machine profile named by path is looked for beside the file; of a text, in the current directory.

        Raises SpecError with all faults at once, OSError if there is no such file.
        """
    @classmethod
    def from_dict(cls, sections: Mapping[str, Any]) -> Spec:
        """Makes a spec from a dict, as `to_dict` returns it: sections are dicts, `stack["star"]` a list of dicts.

        Raises SpecError with all faults at once; their lines are those of `to_toml()`.
        """
    @classmethod
    def starter(cls, name: str) -> Spec:
        """The commented spec of the paper's star, with every key and its default."""
    @classmethod
    def for_object(
        cls,
        object: str,
        mass: str,
        *,
        name: str = "gripper",
        height: str | None = None,
        shape: Literal["ball", "cylinder"] | None = None,
        pressure: str | None = None,
        friction: float | None = None,
        fragile: str | None = None,
        sheet: str | None = None,
        machine: str | None = None,
    ) -> Spec:
        """Finds a gripper that holds an object, as `stargrip-cam new` does: the spec that holds it best within its sheet and machine.

        object: width of the object where it is gripped, "75 mm".
        mass: "1.2 kg".
        name: of the gripper.
        height: of the object, default as wide; shape: "ball" (default) or "cylinder".
        pressure: of the pump; default: the best from 5 to 60 kPa.
        friction: between corners and object; default 0.3.
        fragile: largest radial force of one star that the object bears, "20 N".
        sheet: size of the fabric, "400x400" in mm, or "A3".
        machine: a built-in profile or the path of one; default: generic.

        Raises DesignError with the reasons and the nearest objects if there is none, UsageError for wrong arguments.
        """
    def replace(self, values: Mapping[str, Any] | None = None, /, **more: Any) -> Spec:
        """A spec with other values: `replace({"star.points": 6})`, or `replace(**{"star.points": 6})`. None takes a key away, so
        that its default holds. Comments and layout stay. Only all values together need be valid.

        Raises SpecError; its lines are those of the text with the new values.
        """
    def to_toml(self) -> str:
        """The text."""
    def to_dict(self) -> dict[str, Any]:
        """The keys in the text, as a dict of sections."""
    def settings(self) -> dict[str, str | None]:
        """Every key with its value, defaults included, as strings: {"star.points": "5", ...}; None where a key has no default."""
    @property
    def name(self) -> str:
        """Name of the gripper in the spec."""
    @property
    def warnings(self) -> list[Fault]:
        """Warnings about the valid spec: Faults."""

@final
class Line:
    """A straight piece of a contour, from `start` to `end`: (x, y) in mm."""
    def __new__(cls, start: tuple[float, float], end: tuple[float, float]) -> Line: ...
    @property
    def start(self) -> tuple[float, float]:
        """First point, (x, y) in mm."""
    @property
    def end(self) -> tuple[float, float]:
        """Last point, (x, y) in mm."""

@final
class Arc:
    """A circular piece of a contour: around `center`, (x, y) in mm, from the direction `start_angle_deg`, turning by `sweep_deg`,
    counterclockwise if positive.
    """
    def __new__(
        cls, center: tuple[float, float], radius_mm: float, start_angle_deg: float, sweep_deg: float
    ) -> Arc: ...
    @property
    def center(self) -> tuple[float, float]:
        """Centre of the circle, (x, y) in mm."""
    @property
    def radius_mm(self) -> float:
        """Radius, mm."""
    @property
    def start_angle_deg(self) -> float:
        """Direction from the centre to the first point, degrees."""
    @property
    def sweep_deg(self) -> float:
        """Turn from the first to the last point, degrees, counterclockwise if positive."""
    @property
    def start(self) -> tuple[float, float]:
        """First point, (x, y) in mm."""
    @property
    def end(self) -> tuple[float, float]:
        """Last point, (x, y) in mm."""

@final
class Contour:
    """A chain of lines and arcs, exact, in mm."""
    @property
    def segments(self) -> tuple[Line | Arc, ...]:
        """Pieces in order, each a Line or an Arc."""
    @property
    def closed(self) -> bool:
        """Whether it ends where it begins."""
    @property
    def length_mm(self) -> float:
        """Length of the contour, mm."""
    @property
    def area_mm2(self) -> float | None:
        """The area that it encloses, mm^2, positive if it runs counterclockwise; None if it is open."""
    def points(self, tolerance_mm: float = 0.01) -> _Floats:
        """Corners of a polygon that leaves the contour by `tolerance_mm` at most: an array of shape (N, 2), mm. A closed one does not
        repeat its first point.
        """
    @property
    def __geo_interface__(self) -> dict[str, Any]:
        """As GeoJSON, within 0.01 mm, for shapely.geometry.shape and other readers."""

@final
class Star:
    """One star of a design, in its own frame: the axis at the origin, corner 1 on +X."""
    @property
    def index(self) -> int:
        """Number of the star, 1 = bottom."""
    @property
    def sheet(self) -> int:
        """Number of its sheet, from 1."""
    @property
    def placement(self) -> _Floats:
        """From the star's frame to its sheet's: an array of shape (2, 3), `xy_sheet = placement[:, :2] @ xy + placement[:, 2]`."""
    @property
    def points(self) -> int:
        """Number of points n."""
    @property
    def inner_radius_mm(self) -> float:
        """Inner radius rho_0, mm."""
    @property
    def tube_width_mm(self) -> float:
        """Tube width W between the inner edges of the bands, mm."""
    @property
    def tip_angle_deg(self) -> float:
        """Internal angle phi_i0 of the tips, degrees."""
    @property
    def corner_angle_deg(self) -> float:
        """External angle phi_e0 of the reentrant corners, degrees."""
    @property
    def arm_length_mm(self) -> float:
        """Arm length l, mm."""
    @property
    def fabric_mm2(self) -> float:
        """Fabric of both sheets, mm^2."""
    @property
    def tip_centers_mm(self) -> _Floats:
        """Centres of the tips' arcs: (n, 2), mm, tip 1 first."""
    @property
    def corner_centers_mm(self) -> _Floats:
        """Centres of the corners' arcs: (n, 2), mm, corner 1 first."""
    @property
    def arms_mm(self) -> _Floats:
        """The straight tubes as rectangles: (2n, 4, 2), mm. Arm 2k - 1 runs from corner k to tip k, arm 2k on to corner k + 1; of each
        the start and the end of its edge towards the hole, then the end and the start of the outer one.
        """
    @property
    def edges(self) -> tuple[Contour, Contour]:
        """The tube's edges as drawn, towards the hole and outside; that one is open where the inlet is."""
    @property
    def seams(self) -> tuple[Contour, Contour]:
        """The iron's paths, inner and outer loop: the centre lines of the bands, without overlap."""
    @property
    def outline(self) -> tuple[Contour, Contour]:
        """The cut edges: around the star and around the hole."""
    @property
    def windows(self) -> list[Contour]:
        """The windows of the coating mask."""
    @property
    def registration_mm(self) -> _Floats:
        """Registration holes: (m, 3), centre and diameter, mm."""
    def polygon(self, tolerance_mm: float = 0.01) -> dict[str, Any]:
        """The cut fabric as a GeoJSON polygon with its hole, within `tolerance_mm`: shapely.geometry.shape(star.polygon())."""
    @property
    def __geo_interface__(self) -> dict[str, Any]:
        """The polygon within 0.01 mm: shapely.geometry.shape(star)."""

@final
class Seam:
    """One seam of a piece: the centre line of its band, from where the sealing starts."""
    def __new__(cls, name: str, band_mm: float, center_line: Contour) -> Seam: ...
    @property
    def name(self) -> str:
        """Name of the seam, as on drawings, in programs and in predictions."""
    @property
    def band_mm(self) -> float:
        """Width of its band, mm."""
    @property
    def center_line(self) -> Contour:
        """The centre line of its band."""
    @property
    def length_mm(self) -> float:
        """Length of the centre line, mm."""
    @property
    def __geo_interface__(self) -> dict[str, Any]:
        """The centre line as GeoJSON, within 0.01 mm: shapely.geometry.shape(seam).buffer(seam.band_mm / 2) is the band."""

@final
class Piece:
    """One piece of a design, star or drawn, in its own frame: that of the star, or of the drawing. Lengths in mm."""
    @property
    def name(self) -> str:
        """Name of the piece, as in files and messages: "star 2"."""
    @property
    def sheet(self) -> int:
        """Number of its sheet, from 1."""
    @property
    def outline(self) -> list[Contour]:
        """The cut edges: around it, then those of its holes."""
    @property
    def seams(self) -> list[Seam]:
        """The seams, in the order in which they are sealed."""
    @property
    def air(self) -> list[Contour]:
        """The edges of the air, as the iron makes them."""
    @property
    def ports_mm(self) -> _Floats:
        """The ports: (k, 3), the middle of the mouth and the width between the bands, mm."""
    @property
    def registration_mm(self) -> _Floats:
        """Registration holes: (m, 3), centre and diameter, mm."""
    @property
    def fabric_mm2(self) -> float:
        """Fabric of both sheets, mm^2."""
    def polygon(self, tolerance_mm: float = 0.01) -> dict[str, Any]:
        """The cut fabric as a GeoJSON polygon with its holes, within `tolerance_mm`: shapely.geometry.shape(piece.polygon())."""
    @property
    def __geo_interface__(self) -> dict[str, Any]:
        """The cut fabric within 0.01 mm: shapely.geometry.shape(piece)."""

@final
class Design:
    """The exact flat geometry of a gripper. Lengths in mm, angles in degrees; everything counts counterclockwise seen from above."""
    @property
    def stars(self) -> list[Star]:
        """Stars of the design, bottom first; empty for a drawing, which has `pieces`."""
    @property
    def pieces(self) -> list[Piece]:
        """The pieces, stars or drawn ones, with their outlines and seams."""
    @property
    def sheets(self) -> list[dict[str, Any]]:
        """The sheets: dicts of `index`, `width_mm` and `height_mm`."""
    @property
    def warnings(self) -> list[dict[str, Any]]:
        """Warnings before it is made: dicts of code, key, found and remedy."""
    def _repr_svg_(self) -> str | None:
        """The preview of its first sheet, for notebooks: None if the machine cannot seal it."""

@final
class Mesh:
    """The sheet of a shell model, at rest under pressure, on its finest mesh: N nodes, M triangles. For a star it is one of the two sheets of
    half a sector beside corner 1, for a V-actuator one sheet of half: `whole()` adds the mirror images.
    """
    @property
    def nodes_mm(self) -> _Floats:
        """Positions of the nodes: (N, 3), mm; the axis of a star is z."""
    @property
    def flat_mm(self) -> _Floats:
        """Positions of the nodes on the flat sheet: (N, 2), mm."""
    @property
    def triangles(self) -> NDArray[np.int64]:
        """The nodes of each triangle: (M, 3), int64, from 0."""
    @property
    def tension_N_per_mm(self) -> _Floats:
        """Principal tensions of each triangle, the larger first: (M, 2), N/mm. Below 0 it is compressed."""
    @property
    def stretch(self) -> _Floats:
        """Stretches of each triangle along the principal tensions: (M, 2); 0.01 is one per cent longer."""
    @property
    def curvature_per_mm(self) -> _Floats:
        """Principal curvatures of each triangle: (M, 2), 1/mm."""
    @property
    def node_stretch(self) -> _Floats:
        """Largest stretch of each node's triangles: (N,), for plots that colour nodes."""
    def whole(self) -> Body:
        """The whole body, closed: both sheets and all mirror images, with named seams."""
    def vtu(self) -> str:
        """The sheet as the text of a VTU file, which ParaView reads."""

@final
class Body:
    """A whole inflated body in triangles: both sheets and all their mirror images, closed, N nodes, M triangles, counterclockwise from outside:
    `trimesh.Trimesh(body.nodes_mm, body.triangles)` is watertight.
    """
    @property
    def nodes_mm(self) -> _Floats:
        """Positions of the nodes: (N, 3), mm."""
    @property
    def flat_mm(self) -> _Floats:
        """Positions of the nodes on the flat sheets: (N, 2), mm."""
    @property
    def triangles(self) -> NDArray[np.int64]:
        """The nodes of each triangle: (M, 3), int64, from 0. The first half is the upper sheet."""
    @property
    def images(self) -> NDArray[np.int64]:
        """For each triangle the one of the `Mesh` of which it is an image: (M,), int64. `mesh.stretch[body.images]` is the stretch of each."""
    @property
    def seams(self) -> dict[str, NDArray[np.int64]]:
        """The nodes of each seam by its name: arrays of int64. There the sheets are sealed to each other."""
    def stl(self) -> bytes:
        """The body as a binary STL file, mm."""
    def obj(self) -> str:
        """The body as the text of an OBJ file, mm: groups of triangles for the sheets, and groups of lines for the seams."""

@final
class Prediction:
    """The predicted behaviour of a star gripper. Every key of `predict --json` is an attribute: lengths in mm, angles in degrees, forces in N,
    with the unit in the name. None where the value is unknown, or needs something that the spec does not give.
    """
    @property
    def model(self) -> str:
        """Model used: fit, ring, bvp, section or shell."""
    @property
    def lambda_t(self) -> dict[str, float | None]:
        """Target coiling factor of the hinges. By hinges' models only."""
    @property
    def lambda_c(self) -> dict[str, float | None]:
        """Coiling factor at the onset of hoop tension away from the rim. Some models have none."""
    @property
    def d2v_dlambda2(self) -> dict[str, float | None]:
        """Second derivative of the dimensionless volume by the coiling factor, at the target. By hinges' models only."""
    @property
    def arm_length_mm(self) -> float:
        """Length of the straight arms, mm."""
    @property
    def tip_target_angle_deg(self) -> float | None:
        """Target angle of a free tip, degrees. Below 0 its arms would cross."""
    @property
    def corner_target_angle_deg(self) -> float | None:
        """Target angle of a free corner, degrees."""
    @property
    def tip_equilibrium_angle_deg(self) -> float | None:
        """Angle of the star's tips at equilibrium, degrees, not clamped where arms touch."""
    @property
    def tip_angle_deg(self) -> float | None:
        """Angle between the arms of a tip, degrees, with or without contact. By the shell only."""
    @property
    def final_radius_mm(self) -> float | None:
        """Inner radius of the inflated, empty star, mm: from the axis to the apex of a corner's inner rim."""
    @property
    def contraction(self) -> float | None:
        """1 - final radius / inner radius of the flat star."""
    @property
    def hinge_stiffness_Nm(self) -> dict[str, float | None] | None:
        """Stiffness of the hinges at the target, N m per rad. Needs a pressure."""
    @property
    def radial_stiffness_N_per_m(self) -> float | None:
        """Radial stiffness at rest, all corners together, N/m. Needs a pressure."""
    @property
    def preload_N(self) -> float | None:
        """Radial force stored in a star whose arms press on each other, N; 0 if they are free. Needs a pressure."""
    @property
    def arm_contact_N(self) -> float | None:
        """Force with which the two arms of a tip press on each other, N; 0 if they do not touch. By the shell only."""
    @property
    def arm_contact_mm2(self) -> float | None:
        """Flat area of an arm's sheet that touches the next arm, mm^2. By the shell only."""
    @property
    def volume_mm3(self) -> float | None:
        """Volume of the inflated star, mm^3. By the shell only."""
    @property
    def graspable_radius_mm(self) -> tuple[float, float] | None:
        """Smallest and largest radius of a round object that the star can hold, mm; at most `hole_radius_mm`, since wider ones do not enter."""
    @property
    def hole_radius_mm(self) -> float:
        """Radius of the hole's cut edge, mm. A wider object does not enter the flat star."""
    @property
    def flap_edge_radius_mm(self) -> float | None:
        """Radius of the hole's cut edge in front of the corners of the closed star, mm: the final radius less band and flap, or 0. It touches first."""
    @property
    def flap_force_N(self) -> float | None:
        """Radial force of one star on the object while the flap in front of its corners stays straight, N: the largest that it can be. `object_force_N` is that of a flap which gives way."""
    @property
    def flap_load_N_per_mm(self) -> float | None:
        """Load under which the flap in front of the corners buckles, N per mm of contact, if both of its sheets are fused."""
    @property
    def object_radius_mm(self) -> float | None:
        """Radius of the object at the star's height, mm; 0 if the star passes above or below it."""
    @property
    def object_gap_mm(self) -> float | None:
        """Room between the cut hole and the object before inflation, mm. Below 0 the object does not enter."""
    @property
    def object_force_N(self) -> float | None:
        """Radial force of one star on the object, N. Needs a pressure and an object."""
    @property
    def object_force_friction_N(self) -> tuple[float, float] | None:
        """The least and the largest `object_force_N` where the corners rub on the object with the spec's largest friction, N. By the shell only."""
    @property
    def force_curve(self) -> list[tuple[float | None, ...]] | None:
        """Rows of an object's radius (mm), the radial force of one star (N) and the ends of its range, for the radii that were requested; null where the star does not hold such an object."""
    @property
    def bendability(self) -> float | None:
        """Pressure over the fabric's resistance to bending, 1/eps = p W^3 / B. Needs a pressure."""
    @property
    def operating_pressure_kPa(self) -> float:
        """Pressure from which the hinges are fully coiled, kPa."""
    @property
    def realised_radius_mm(self) -> dict[str, float | None]:
        """Inner radius of curvature of the hinges as the sealed band makes them, mm."""
    @property
    def seal_load(self) -> dict[str, float | None]:
        """Tension of the ring over p W at the realised radius, at an inner rim that cannot stretch. `seal_pull_N_per_mm` is the seal's own load."""
    @property
    def seal_pull_N_per_mm(self) -> float | None:
        """Largest force that pulls one sheet off the seam's plane, N per mm of seam, as a T-peel test measures it: averaged over the width of the band. Needs a pressure."""
    @property
    def seal_pull_at(self) -> str | None:
        """The hinges at which the seal's pull is largest: tips or corners."""
    @property
    def seal_pull_at_mm(self) -> tuple[float, float] | None:
        """Where on the flat star the seal's pull is largest, mm. By the shell only."""
    @property
    def burst_pressure_kPa(self) -> float | None:
        """Pressure at which the pull on the seal is the strength of its seam, kPa. Needs the strengths of both loops."""
    @property
    def seal_tension(self) -> dict[str, Any] | None:
        """Largest pull across the rim: `value` in N/mm, its mesh error and its place on the flat star. By the shell only."""
    @property
    def mass_g(self) -> float | None:
        """Mass of the fabric of one star, both sheets, g. Needs `areal_density`."""
    @property
    def payload_kg(self) -> float | None:
        """Mass that friction holds until arms fold, kg: of the whole stack on the object's slopes, in `stars` of each star on an upright surface. Needs a pressure, an object and friction."""
    @property
    def arm_wrinkling_kg(self) -> float | None:
        """Mass on one star at which its arms wrinkle between plate and object, kg. Needs a pressure and an object."""
    @property
    def arm_folding_kg(self) -> float | None:
        """Mass on one star at which its arms fold, kg: the most that it carries."""
    @property
    def stretch(self) -> Any:
        """Stretch p W / Y of the fabric. By the shell the largest principal stretch with mesh error and place. Needs a pressure."""
    @property
    def burst_margin(self) -> float | None:
        """Burst pressure over the pressure. Needs both."""
    @property
    def ranges_of(self) -> str:
        """Source of the ranges: computed shells. No gripper was measured."""
    @property
    def ranges(self) -> dict[str, Any]:
        """For each number that depends on a model the interval that holds a computed shell's value in at least 95 % of cases. Some may be unknown."""
    @property
    def pressures(self) -> list[dict[str, Any]] | None:
        """Predictions at several pressures. Only if the spec has no pressure."""
    @property
    def nonlinear(self) -> dict[str, Any] | None:
        """The star with the model's own, asymmetric hinges instead of linear ones. By ring and bvp only."""
    @property
    def evidence(self) -> dict[str, Any]:
        """Why this model was used, residuals, iterations, error estimates and `warnings`."""
    @property
    def verdict(self) -> dict[str, Any] | None:
        """Whether the gripper holds the object: `holds` (yes, no or unknown), the force with its range, the needed force and reasons."""
    @property
    def stack_mass_g(self) -> float | None:
        """Mass of the fabric of all stars, g. Needs `areal_density`."""
    @property
    def stars(self) -> list[dict[str, Any]]:
        """The same keys for each star, bottom first. Those at the top are star 1's, except `payload_kg`."""
    @property
    def mesh(self) -> Mesh | None:
        """The sheet in the shell model; None for every other model."""
    def to_dict(self) -> dict[str, Any]:
        """All keys, equal to the JSON of the command's `--json`."""
    def _repr_html_(self) -> str:
        """The answer as a table of its numbers with their ranges, for notebooks."""

@final
class DrawnPrediction:
    """The predicted behaviour of a drawn piece. Every key of `predict --json` is an attribute, with the unit in the name; None where the value is
    unknown, or needs the shell. Numbers of a shell are dicts of `value` and `mesh_error`.
    """
    @property
    def model(self) -> str:
        """Model used: shell, or none: flat sizes only."""
    @property
    def pressure_kPa(self) -> float | None:
        """Gauge pressure, kPa."""
    @property
    def pressures_kPa(self) -> list[dict[str, Any]] | None:
        """Pressures of chambers that differ from it, by port."""
    @property
    def mass_g(self) -> float | None:
        """Mass of the fabric of one piece, both sheets, g. Needs `areal_density`."""
    @property
    def volume_mm3(self) -> dict[str, Any] | None:
        """Volume of all chambers of a piece, mm^3: `value` and `mesh_error`. By the shell only."""
    @property
    def burst_pressure_kPa(self) -> float | None:
        """Least pressure at which a chamber's seal peels, kPa. Needs the strength of every seam, and the shell with wrinkles that are not averaged."""
    @property
    def burst_range_kPa(self) -> tuple[float, float] | None:
        """Range of the burst pressure: mesh errors, and how the pull may grow with the pressure."""
    @property
    def bursts_first(self) -> dict[str, Any] | None:
        """The seam that opens first: `seam`, with `piece` where several have a seam of this name, `process`, `pressure_kPa` and `range`. Where seams are sealed by several processes; needs the strength of each."""
    @property
    def burst_margin(self) -> float | None:
        """Burst pressure over the pressure. Needs both."""
    @property
    def leaves_plane(self) -> Any:
        """Whether a chamber may leave the plane of the drawing. By the shell only."""
    @property
    def chambers(self) -> list[Chamber]:
        """Chambers, each with flat size and area, `bendability` and `stretch`; by the shell `extents_mm`, `height_mm`, `volume_mm3`, `seal_pull_N_per_mm`, `largest_stretch`, `largest_tension_N_per_mm` and `plane_eigenvalue`, each with its mesh error; where `wrinkles` are blended or averaged, or there is a `second_shape`, `ranges` of height, extents, volume and pull; `seams`: the largest pull on each, with rows of x, y, pull and mesh error along it."""
    @property
    def measures(self) -> list[dict[str, Any]]:
        """Measures of the drawing's role `measure`: distances, directions, angles, radii, positions and heights, flat and by the shell."""
    @property
    def pull(self) -> dict[str, Any] | None:
        """The pull at two bars, of the drawing's role `pull`: `blocked_force_N`, `free_stroke_mm`, `lifted_mm`, and `curve` with rows of stroke, force and its mesh error. By the shell only."""
    @property
    def evidence(self) -> dict[str, Any]:
        """Why this model was used, and `warnings`."""
    @property
    def mesh(self) -> Mesh | None:
        """The sheet in the shell model; None for every other model."""
    def to_dict(self) -> dict[str, Any]:
        """All keys, equal to the JSON of the command's `--json`."""
    def _repr_html_(self) -> str:
        """The answer as a table of its numbers with their ranges, for notebooks."""

@final
class Chamber:
    """One chamber of a drawn piece. Every key of a chamber in `predict --json` is an attribute, with the unit in the name; None where the value
    is unknown, or needs the shell. Numbers of a shell are dicts of `value` and `mesh_error`, some with a place.
    """
    @property
    def chamber(self) -> float:
        """Number of the chamber, from 1."""
    @property
    def at_mm(self) -> tuple[float, float]:
        """The middle of its box."""
    @property
    def width_mm(self) -> float:
        """Diameter W of the largest circle in the flat chamber."""
    @property
    def flat_area_mm2(self) -> float:
        """Flat area of one sheet."""
    @property
    def flat_extents_mm(self) -> tuple[float, float]:
        """Extents of the flat chamber along x and y."""
    @property
    def bendability(self) -> float | None:
        """Bendability p W^3 / B."""
    @property
    def stretch(self) -> float | None:
        """Stretch p W / Y of the fabric."""
    @property
    def wrinkles(self) -> str | None:
        """Whether wrinkles are on the mesh (resolved), partly on a stiffer sheet's (blended), or the shape is their mean (averaged)."""
    @property
    def ranges(self) -> dict[str, Any] | None:
        """Ranges where they are blended or averaged, or there is a second shape."""
    @property
    def second_shape(self) -> dict[str, Any] | None:
        """The other stable shape at this pressure, if one was found."""
    @property
    def plates(self) -> dict[str, Any] | None:
        """Contact with each plate, between `plates` of `[load]`: `force_N` and `contact_area_mm2`."""
    @property
    def height_mm(self) -> dict[str, Any] | None:
        """Largest distance between the sheets."""
    @property
    def extents_mm(self) -> list[dict[str, Any]] | None:
        """Extents of the inflated chamber where it lies best on the flat one."""
    @property
    def volume_mm3(self) -> dict[str, Any] | None:
        """Volume."""
    @property
    def seal_pull_N_per_mm(self) -> dict[str, Any] | None:
        """Largest pull of one sheet on a seam."""
    @property
    def burst_pressure_kPa(self) -> float | None:
        """Pressure at which the seal peels."""
    @property
    def burst_range_kPa(self) -> tuple[float, float] | None:
        """Range of the burst pressure."""
    @property
    def bursts_first(self) -> dict[str, Any] | None:
        """The seam that opens first, where seams are sealed by several processes."""
    @property
    def largest_stretch(self) -> dict[str, Any] | None:
        """Largest principal stretch."""
    @property
    def largest_tension_N_per_mm(self) -> dict[str, Any] | None:
        """Largest principal tension, N/mm."""
    @property
    def plane_eigenvalue(self) -> dict[str, Any] | None:
        """Lowest eigenvalue by p / W for leaving the plane of the drawing."""
    @property
    def plane(self) -> str | None:
        """Whether it stays in that plane."""
    @property
    def leaves_plane(self) -> Any:
        """Whether it may leave that plane: it leaves it, or the mesh error is too large to tell."""
    @property
    def seams(self) -> list[dict[str, Any]] | None:
        """Seams of the chamber."""
    @property
    def unknowns(self) -> Any:
        """Unknowns of each mesh, coarse to fine."""
    @property
    def iterations(self) -> float | None:
        """Newton steps of all meshes."""
    def to_dict(self) -> dict[str, Any]:
        """All keys, equal to the JSON of the command's `--json`."""

@final
class ActuatorPrediction:
    """The predicted behaviour of a V-actuator. Every key of `actuator --json` is an attribute, None where the value is unknown."""
    @property
    def model(self) -> str:
        """Model used: fit, ring, bvp, section or shell."""
    @property
    def bendability(self) -> float:
        """Pressure over the fabric's resistance to bending, 1/eps = p W^3 / B."""
    @property
    def stretch(self) -> float:
        """Stretch p W / Y of the fabric."""
    @property
    def angle_deg(self) -> float:
        """Angle between the arms at rest under pressure, degrees."""
    @property
    def coiling(self) -> float:
        """Coiling factor (pi - phi) / (pi - phi_0) at rest."""
    @property
    def volume_mm3(self) -> float | None:
        """Volume of the whole actuator, mm^3. Models of the hinge alone do not have it."""
    @property
    def stiffness_Nm(self) -> float:
        """Stiffness d2U/dphi2 at rest, whole tube, N m per rad."""
    @property
    def moment(self) -> list[tuple[float | None, ...]] | None:
        """Rows of an angle (deg) and the applied moment dU/dphi (N m) that holds it, for the requested angles. A positive one opens."""
    @property
    def ranges(self) -> dict[str, Any]:
        """For each of these numbers the interval that holds a computed shell's value in at least 95 % of cases. Some may be unknown."""
    @property
    def evidence(self) -> dict[str, Any]:
        """Residuals, iterations, error estimates and `warnings`."""
    @property
    def mesh(self) -> Mesh | None:
        """The sheet in the shell model; None for every other model."""
    def to_dict(self) -> dict[str, Any]:
        """All keys, equal to the JSON of the command's `--json`."""
    def _repr_html_(self) -> str:
        """The answer as a table of its numbers with their ranges, for notebooks."""

@final
class Build:
    """All files of a gripper, in memory. They have been read back and agree with the design; other files cannot be written."""
    @property
    def files(self) -> dict[str, bytes]:
        """Name and content of every file, the manifest last: the bytes that the command writes."""
    @property
    def manifest(self) -> dict[str, Any]:
        """The manifest, as in `manifest.json`."""
    @property
    def prediction(self) -> Prediction | DrawnPrediction | None:
        """The prediction, without a mesh; None if the spec has no [load]."""
    @property
    def deviation_mm(self) -> dict[str, float | None]:
        """Largest deviation of every measured file from the exact design, mm."""
    def write(self, path: str | os.PathLike[str]) -> str:
        """Writes the files into the directory `path`, completely or not at all, as the command does. Returns notes, one a line; "" without
        any. Raises PublishError, and then leaves the directory unchanged.
        """
    def _repr_svg_(self) -> str | None:
        """The preview of its first sheet; None if none was built."""
    def _repr_html_(self) -> str: ...

@final
class Optimum:
    """The result of a search: the best star, and the designs that it was compared with."""
    @property
    def spec(self) -> Spec | None:
        """The spec with the best star that can be built; None if no design meets all constraints and can be built."""
    @property
    def computed(self) -> int:
        """The number of designs that were computed."""
    @property
    def best(self) -> dict[str, _Floats]:
        """The best design for each number of points, not only the best of all: a dict of arrays, one for each column. Entry 0 of each is
        the best design. NaN where a number is unknown; `violation` is 0 where all constraints are met.
        """
    @property
    def short(self) -> list[dict[str, float]]:
        """For each design in `best` the constraints that it violates, and by which fraction."""
    @property
    def front(self) -> dict[str, _Floats]:
        """The designs that meet all constraints, and that none beats in contraction, stiffness and fabric at once: a dict of arrays, one
        for each column, by falling contraction.
        """

def design(spec: Spec) -> Design:
    """The exact geometry of `spec`. Raises DesignError with all reasons if there is none."""
def predict(
    spec: Spec,
    *,
    model: Model | None = None,
    radii: str | None = None,
    fineness: Fineness | None = None,
    accuracy: str | None = None,
    progress: _Progress = None,
) -> Prediction | DrawnPrediction:
    """Predicts the behaviour of the gripper of `spec`: a Prediction of stars, or a DrawnPrediction with chambers.

    model: "fit", "ring", "bvp", "section", "shell" or "auto"; default: the spec's own.
    radii: also the force on round objects of these radii, "20 mm..40 mm/5".
    fineness: of the shell's meshes: "coarse" (default for drawings), "medium" (default for stars) or "fine".
    accuracy: the cheapest model with an error of at most this, "2 %"; without model and fineness.
    progress: True shows a line with the progress; a callable gets the part that is done, 0 to 1, and a text.

    Raises DesignError if there is no such gripper, PredictionError if the model has no answer, UsageError for wrong arguments.
    """
def build(
    spec: Spec,
    *,
    only: Sequence[FileKind] | None = None,
    with_: Sequence[FileKind] | None = None,
    anyway: bool = False,
    progress: _Progress = None,
) -> Build:
    """Builds the files of `spec` in memory and proves every one.

    only: the only kinds of file to make, a list: `["seal-gcode"]`. Default: all but the kinds that only `with_` adds (docs/spec.md, `build.with`).
    with_: kinds to make in addition: `["report"]`.
    anyway: True builds a gripper that bursts, does not hold its own object, presses too hard on it, or lies outside every model. It also
    computes a shell of any size.
    progress: True shows a line with the progress; a callable gets the part that is done, 0 to 1, and a text.

    Raises DesignError if there is no such gripper or it is refused, ProofError for a fault of the program.
    """
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
) -> Optimum:
    """Searches around `spec` for the best star. The keywords are the options of the command `optimize`. Ranges are pairs or texts:
    points=(3, 8), tip_angle=("20 deg", "60 deg") or "20 deg..60 deg".

    goal: "hold" (the object's mass with the least fabric), "contraction", "stiffness" or "fabric" (the least). Default: "hold" if
        [load] has an object, else "contraction".
    points: numbers of points; default: (3, 12).
    tip_angle: tip angles; default: 10 to 90 deg.
    tube_width: tube widths; default: half to one and a half times the spec's.
    tip_radius, corner_radius, inner_radius, pressure: default: the spec's.
    count: numbers of stars; default: the spec's.
    grasp: radii of objects that the star must close to and open to.
    payload: least payload of the stack, kg.
    largest_force: largest radial force of one star, N; default: that of [load].
    burst_margin: least burst pressure over the pressure; default: 1 if the seal's strength is known.
    progress: True shows a line with the progress; a callable gets the part that is done, 0 to 1, and a text.

    Raises UsageError for wrong arguments. A search that is interrupted stops at its next design.
    """
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
    model: Model | None = None,
    angles: str | None = None,
    fineness: Fineness | None = None,
    progress: _Progress = None,
) -> ActuatorPrediction:
    """Predicts what a V-actuator does: two arms, one hinge, sealed ends. The keywords are the options of the command `actuator`;
    quantities are strings with a unit. The first five are required.

    tube_width: flat width of the tube.
    radius: inner radius of the flat hinge.
    arm_length: straight length from the hinge's end to the sealed end.
    angle: flat angle between the arms.
    pressure: gauge pressure.
    thickness, young_modulus, poisson_ratio: of the fabric; default: those of a spec.
    model: "fit", "ring", "bvp", "section", "shell" or "auto", which is section.
    angles: also the moment that holds the hinge at each of these angles, "30 deg..90 deg/7".
    fineness: of the shell's meshes: "coarse", "medium" (default) or "fine".
    progress: True shows a line with the progress; a callable gets the part that is done, 0 to 1, and a text.

    Raises PredictionError if the model has no answer, UsageError for wrong arguments.
    """
def sweep(
    spec: Spec,
    vary: Mapping[str, str | Sequence[Any]] | None = None,
    *,
    study: str | None = None,
    outputs: Sequence[str] | None = None,
    part: tuple[int, int] | None = None,
    threads: int | None = None,
    progress: _Progress = None,
) -> dict[str, NDArray[Any]]:
    """Computes many designs around `spec`. Returns a dict of arrays, one for each column: NaN where a number is unknown; columns of text
    are arrays of str and None.

    vary: a dict from keys to values, each a list or "10 mm..40 mm/31". Every combination is computed; the last key runs fastest.
    study: instead of `vary`, the text of a study file. Its own `spec` is not read.
    outputs: a list of the columns to compute; default: all.
    part: (k, n) computes part k of n, from 1. Rows do not depend on how a sweep is split.
    threads: the number of threads; default: one a core.
    progress: True shows a line with the progress; a callable gets the part that is done, 0 to 1, and a text.

    Raises SpecError for a study or a column that is refused, UsageError for wrong arguments.
    """
def sweep_columns(
    spec: Spec,
    vary: Mapping[str, str | Sequence[Any]] | None = None,
    *,
    study: str | None = None,
    outputs: Sequence[str] | None = None,
) -> tuple[int, str, list[tuple[str, str | None, str]]]:
    """The columns of a sweep with these arguments: (number of rows, fingerprint, columns), each column as (name, unit, meaning)."""

def coupon(
    spec: Spec,
    *,
    temperatures: Sequence[str] | None = None,
    powers: Sequence[str] | None = None,
    speeds: Sequence[str] | None = None,
    heights: Sequence[str] | None = None,
    focuses: Sequence[str] | None = None,
    times: Sequence[str] | None = None,
    only: Sequence[CouponKind] | None = None,
    repeats: int | None = None,
) -> dict[str, bytes]:
    """The files of test pieces for the machine, the fabric and the tube of `spec`, by name: programs, drawings, and the table to fill in.
    They have been read back.

    temperatures: of the grid of strips, `["180 C", "200 C"]`; default: the spec's.
    powers: of a laser, in place of temperatures and heights, `["8 %", "10 %"]`; default: three quarters, once and five quarters of the spec's.
    speeds: of the grid, `["0.1 mm/s", "0.2 mm/s"]`; default: once, twice and five times the spec's; of a laser half, once and twice.
    heights: of the tip in contact, `["0 mm", "0.1 mm"]`; default: the profile's.
    focuses: of a laser, heights of its focus above the sheet, `["11 mm", "12 mm"]`; default: the spec's.
    times: of a heat press, in place of speeds and heights, `["10 s", "20 s"]`; default: half, once and twice the spec's.
    only: the only kinds of coupons to make, a list: `["strips", "disc"]`; default: all.
    repeats: how often each setting is sealed, 1 to 20; default: 3.

    Raises DesignError if the machine cannot seal one of them, UsageError for wrong arguments.
    """
def feed_check(spec: Spec) -> dict[str, bytes]:
    """The program that measures the real speed of the machine of `spec`, and its manifest, by name. The program has been read back.

    Raises DesignError if the machine's profile contradicts the seal.
    """
@final
class Aligned:
    """The programs of a build, turned and shifted to where its sheet lies now. They have been read back and agree with the design there."""
    @property
    def files(self) -> dict[str, bytes]:
        """Name and content of every file, the manifest last: the bytes that the command `align` writes."""
    @property
    def sheet(self) -> int:
        """The number of the sheet, from 1."""
    @property
    def turn_deg(self) -> float:
        """The turn of the sheet, deg, counterclockwise seen from above."""
    @property
    def shift_mm(self) -> tuple[float, float]:
        """The shift of the sheet along X and Y, mm."""
    @property
    def stretch_mm(self) -> float:
        """The measured distance of the marks less the one of the design, mm."""
    def write(self, path: str | os.PathLike[str]) -> str:
        """Writes the files into the directory `path`, completely or not at all, as the command does. Returns notes, one a line; "" without
        any. Raises PublishError, and then leaves the directory unchanged.
        """
def align(build: Build | str | os.PathLike[str], mark1: str, mark2: str, *, sheet: int | None = None) -> Aligned:
    """The programs of `build` for a sheet that was moved: turned and shifted by where its two marks lie now.

    build: a Build, or the directory of a published one.
    mark1: the first mark as the machine shows it, in mm: "126.9, 14.2".
    mark2: the second mark: "129.6, 319.6".
    sheet: the number of the sheet that lies on the machine, from 1, if there are several.

    Raises Error if the sheet cannot lie there, or the build has no programs or was not made by this version; UsageError for wrong marks.
    """
def machines() -> dict[str, str]:
    """The built-in machine profiles: name and description."""
def rest(
    program: str,
    spec: Spec | None = None,
    *,
    line: int | None = None,
    at: str | None = None,
    near: str | None = None,
    overlap: str | None = None,
) -> tuple[str, int, float, float, float]:
    """The program for the rest of the interrupted sealing program with the text `program`, with the place where it goes on:
    `stargrip_cam.resume` has its arguments.
    """
def keys() -> dict[str, list[tuple[str, str]]]:
    """Name and type of every key of each class, for `python/stubs.py`."""
def repeat(spec: Spec, model: Model | None, times: int) -> None:
    """Repeats the computation of `predict` `times` times, without Python: the reference of tests/overhead.py."""
def prove(path: str, progress: _Progress) -> dict[str, Any]:
    """The proof of the build in the directory `path`, as `verify --json` prints it."""
def run(args: Sequence[str], file: str) -> int:
    """Runs the command with `args`, of which the first is its name; returns the exit code. `file` is the library with this code."""
