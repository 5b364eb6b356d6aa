//! Edges: a part's own, or those of the tool that cuts it.

/// The lines of a drawing of a part.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CutEdge {
    /// The part's own edges: for printed parts.
    Part,
    /// The middle of the tool that cuts them, half a kerf beside.
    Tool,
}
