//! Stability of a chamber: with z = 0 as its plane of symmetry, and against leaving that plane.
//!
//! Let one sheet move by d and the other by the image of d, or by that of -d. In both cases the energy of both is twice that of one sheet
//! to second order, and the two kinds of motion do not mix. Where both sheets are joined the first kind stays at z = 0, the second moves
//! along z only. A plate that touches one sheet is met by its image, and resists both kinds alike. So the lowest eigenvalue of the whole is the lower of two of the same sheet with two kinds of supports.

use crate::shell::assembly::State;
use crate::shell::cases::region::supports::{SealedNodes, antisymmetric};
use crate::shell::solver::{Solver, rigid_motions};

/// The lowest eigenvalues of both kinds by p/W; not a number where the mesh is too large.
pub(super) fn lowest(
    solver: &mut Solver,
    (state, pressure): (&State, f64),
    sealed: &SealedNodes,
) -> [f64; 2] {
    let sheet = &solver.assembly.sheet;
    let (plane_motions, space_motions) =
        (rigid_motions(sheet, &state.points, &[0, 1, 5]), rigid_motions(sheet, &state.points, &[2, 3, 4]));
    let mut other = Solver::new(sheet.clone(), antisymmetric(sealed));
    if let Some(other) = &mut other {
        other.contact.clone_from(&solver.contact);
    }
    let symmetric = solver.lowest_eigenvalue(state, pressure, &plane_motions);
    let antisymmetric = other.and_then(|mut other| other.lowest_eigenvalue(state, pressure, &space_motions));
    [symmetric, antisymmetric].map(|value| value.map_or(f64::NAN, |value| value / pressure))
}
