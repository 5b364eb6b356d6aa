//! Every key of an answer with its type and its meaning, for those who read answers elsewhere: Python's attributes are made of it.

use KeyKind::{Hinges, List, Number, Object, Pair, Rows, Text, Variant};

/// The type of a key's value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum KeyKind {
    /// A word or a sentence.
    Text,
    /// A number.
    Number,
    /// Two numbers: the ends of an interval.
    Pair,
    /// `tip` and `corner`: a number each, or null.
    Hinges,
    /// Named values.
    Object,
    /// Rows of named values.
    List,
    /// Rows of numbers.
    Rows,
    /// A value whose type depends on the model.
    Variant,
}

/// One key.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Key {
    /// Its name, with the unit.
    pub name: &'static str,
    /// Its type.
    pub kind: KeyKind,
    /// Whether every answer has this key. Otherwise it may be null or absent.
    pub always: bool,
    /// Its meaning, in sentences.
    pub about: &'static str,
}

const fn always(name: &'static str, kind: KeyKind, about: &'static str) -> Key {
    Key { name, kind, always: true, about }
}

const fn maybe(name: &'static str, kind: KeyKind, about: &'static str) -> Key {
    Key { name, kind, always: false, about }
}

/// The keys of `predict --json`, by hinges' models and by the shell.
pub const PREDICTION: &[Key] = &[
    always("model", Text, "Model that answered: fit, ring, bvp, section or shell."),
    maybe(
        "verdict",
        Object,
        "Whether the gripper holds the object: `holds` (yes, no or unknown), the force with its range, the needed force and reasons.",
    ),
    always("lambda_t", Hinges, "Target coiling factor of the hinges. By hinges' models only."),
    always(
        "lambda_c",
        Hinges,
        "Coiling factor at the onset of hoop tension away from the rim. Some models have none.",
    ),
    always(
        "d2v_dlambda2",
        Hinges,
        "Second derivative of the dimensionless volume by the coiling factor, at the target. By hinges' models only.",
    ),
    always("arm_length_mm", Number, "Length of the straight arms, mm."),
    maybe(
        "tip_target_angle_deg",
        Number,
        "Target angle of a free tip, degrees. Below 0 its arms would cross.",
    ),
    maybe("corner_target_angle_deg", Number, "Target angle of a free corner, degrees."),
    maybe(
        "tip_equilibrium_angle_deg",
        Number,
        "Angle of the star's tips at equilibrium, degrees, not clamped where arms touch.",
    ),
    maybe(
        "tip_angle_deg",
        Number,
        "Angle between the arms of a tip, degrees, with or without contact. By the shell only.",
    ),
    maybe(
        "final_radius_mm",
        Number,
        "Inner radius of the inflated, empty star, mm: from the axis to the apex of a corner's inner rim.",
    ),
    maybe("contraction", Number, "1 - final radius / inner radius of the flat star."),
    maybe(
        "hinge_stiffness_Nm",
        Hinges,
        "Stiffness of the hinges at the target, N m per rad. Needs a pressure.",
    ),
    maybe(
        "radial_stiffness_N_per_m",
        Number,
        "Radial stiffness at rest, all corners together, N/m. Needs a pressure.",
    ),
    maybe(
        "preload_N",
        Number,
        "Radial force stored in a star whose arms press on each other, N; 0 if they are free. Needs a pressure.",
    ),
    maybe(
        "arm_contact_N",
        Number,
        "Force with which the two arms of a tip press on each other, N; 0 if they do not touch. By the shell only.",
    ),
    maybe(
        "arm_contact_mm2",
        Number,
        "Flat area of an arm's sheet that touches the next arm, mm^2. By the shell only.",
    ),
    maybe("volume_mm3", Number, "Volume of the inflated star, mm^3. By the shell only."),
    maybe(
        "graspable_radius_mm",
        Pair,
        "Smallest and largest radius of a round object that the star can hold, mm.",
    ),
    maybe(
        "hole_radius_mm",
        Number,
        "Radius of the hole's cut edge, mm. A wider object does not enter the flat star.",
    ),
    maybe(
        "flap_edge_radius_mm",
        Number,
        "Radius of the hole's cut edge in front of the corners of the closed star, mm: the final radius less band and flap. It touches first.",
    ),
    maybe(
        "flap_force_N",
        Number,
        "Radial force of one star on the object while the flap in front of its corners stays straight, N: the largest that it can be. `object_force_N` is that of a flap which gives way.",
    ),
    maybe(
        "flap_load_N_per_mm",
        Number,
        "Load under which the flap in front of the corners buckles, N per mm of contact, if both of its sheets are fused.",
    ),
    maybe(
        "object_radius_mm",
        Number,
        "Radius of the object at the star's height, mm; 0 if the star passes above or below it.",
    ),
    maybe(
        "object_gap_mm",
        Number,
        "Room between the cut hole and the object before inflation, mm. Below 0 the object does not enter.",
    ),
    maybe(
        "object_force_N",
        Number,
        "Radial force of one star on the object, N. Needs a pressure and an object.",
    ),
    maybe(
        "force_curve",
        Rows,
        "Rows of an object's radius (mm), the radial force of one star (N) and the ends of its range, for the radii that were asked for; null where the star does not hold such an object.",
    ),
    maybe(
        "bendability",
        Number,
        "Pressure over the fabric's resistance to bending, 1/eps = p W^3 / B. Needs a pressure.",
    ),
    always("operating_pressure_kPa", Number, "Pressure from which the hinges are fully coiled, kPa."),
    always(
        "realised_radius_mm",
        Hinges,
        "Inner radius of curvature of the hinges as the sealed band makes them, mm.",
    ),
    maybe(
        "seal_load",
        Hinges,
        "Seal load k at the realised radius: the inner edge carries k p W per length.",
    ),
    maybe(
        "seal_pull_N_per_mm",
        Number,
        "Largest force that pulls one sheet off the seam's plane, N per mm of seam, as a T-peel test measures it. Needs a pressure.",
    ),
    maybe("seal_pull_at", Text, "The hinges at which the seal's pull is largest: tips or corners."),
    maybe(
        "seal_pull_at_mm",
        Pair,
        "Where on the flat star the seal's pull is largest, mm. By the shell only.",
    ),
    maybe(
        "burst_pressure_kPa",
        Number,
        "Pressure at which the pull on the seal is `seal_strength`, kPa. Needs `seal_strength`.",
    ),
    maybe(
        "seal_tension",
        Object,
        "Largest pull across the rim: `value` in N/mm, its mesh error and its place on the flat star. By the shell only.",
    ),
    maybe("mass_g", Number, "Mass of the fabric of one star, both sheets, g. Needs `areal_density`."),
    maybe(
        "payload_kg",
        Number,
        "Mass that friction holds, kg: of the whole stack, in `stars` of each star. Needs a pressure, an object and friction.",
    ),
    maybe(
        "stretch",
        Variant,
        "Stretch p W / Y of the fabric. By the shell the largest principal stretch with mesh error and place. Needs a pressure.",
    ),
    maybe("burst_margin", Number, "Burst pressure over the pressure. Needs both."),
    maybe(
        "ranges_of",
        Text,
        "Whose values the ranges hold: those of computed shells. No gripper was measured.",
    ),
    always(
        "ranges",
        Object,
        "For each number that depends on a model the interval that holds a computed shell's value in at least 95 % of cases. Some may be unknown.",
    ),
    maybe("pressures", List, "What the star does at several pressures. Only if the spec has no pressure."),
    maybe(
        "nonlinear",
        Object,
        "The same star with the model's own, asymmetric hinges instead of linear ones. By ring and bvp only.",
    ),
    always(
        "evidence",
        Object,
        "Why this model answered, residuals, iterations, error estimates and `warnings`.",
    ),
    maybe("stack_mass_g", Number, "Mass of the fabric of all stars, g. Needs `areal_density`."),
    always(
        "stars",
        List,
        "The same keys for each star, bottom first. Those at the top are star 1's, except `payload_kg`.",
    ),
];

/// The keys of `actuator --json`.
pub const ACTUATOR: &[Key] = &[
    always("model", Text, "Model that answered: fit, ring, bvp, section or shell."),
    always("bendability", Number, "Pressure over the fabric's resistance to bending, 1/eps = p W^3 / B."),
    always("stretch", Number, "Stretch p W / Y of the fabric."),
    always("angle_deg", Number, "Angle between the arms at rest under pressure, degrees."),
    always("coiling", Number, "Coiling factor (pi - phi) / (pi - phi_0) at rest."),
    maybe("volume_mm3", Number, "Volume of the whole actuator, mm^3. Unknown to models of the hinge alone."),
    always("stiffness_Nm", Number, "Stiffness d2U/dphi2 at rest, whole tube, N m per rad."),
    maybe(
        "moment",
        Rows,
        "Rows of an angle (deg) and the applied moment dU/dphi (N m) that holds it, for the angles that were asked for. A positive one opens.",
    ),
    always(
        "ranges",
        Object,
        "For each of these numbers the interval that holds a computed shell's value in at least 95 % of cases. Some may be unknown.",
    ),
    always("evidence", Object, "Residuals, iterations, error estimates and `warnings`."),
];

/// The keys of `predict --json` about a drawing.
pub const DRAWN: &[Key] = &[
    always("model", Text, "Model that answered: shell, or none, which knows what is flat only."),
    maybe("pressure_kPa", Number, "Gauge pressure, kPa."),
    maybe("mass_g", Number, "Mass of the fabric of one piece, both sheets, g. Needs `areal_density`."),
    maybe(
        "volume_mm3",
        Object,
        "Volume of all chambers of a piece, mm^3: `value` and `mesh_error`. By the shell only.",
    ),
    maybe(
        "burst_pressure_kPa",
        Number,
        "Least pressure at which a chamber's seal peels, kPa. Needs `seal_strength` and the shell.",
    ),
    maybe("burst_range_kPa", Pair, "Its range: mesh errors, and how the pull may grow with the pressure."),
    maybe("burst_margin", Number, "Burst pressure over the pressure. Needs both."),
    maybe(
        "leaves_plane",
        Variant,
        "Whether a chamber may leave the plane of the drawing. By the shell only.",
    ),
    always(
        "chambers",
        List,
        "Of each chamber: size and area when flat, `bendability` and `stretch`; by the shell `extents_mm`, `height_mm`, `volume_mm3`, \
         `seal_pull_N_per_mm`, `largest_stretch`, `largest_tension_N_per_mm` and `plane_eigenvalue`, each with its mesh error, and `seams`: \
         the largest pull on each, with rows of x, y, pull and mesh error along it.",
    ),
    always("evidence", Object, "Why this model answered, and `warnings`."),
];
