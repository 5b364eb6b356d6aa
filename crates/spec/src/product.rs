//! The products that a spec can describe.

crate::choices! {
    /// The product of a spec.
    ProductKind,
    /// The section that describes the product.
    section;
    /// A gripper of stars.
    Stars: "star",
    /// Pieces by a person's own drawing.
    Drawing: "drawing",
}
