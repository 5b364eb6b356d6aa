//! Numerical tools: forward derivatives, quadrature, Newton and bracketing roots, banded factors, Chebyshev series,
//! collocation.
//!
//! This module does not depend on sheets or grippers. Its results are finite, or an error.

pub mod band;
pub mod chebyshev;
pub mod cholesky;
pub mod collocation;
pub mod dual;
pub mod gauss;
pub mod newton;
pub mod range;
pub mod root;
mod threads;
mod vector;

pub use chebyshev::Chebyshev;
pub use cholesky::SymmetricBand;
pub use dual::Dual;
pub use newton::{NewtonFault, NewtonReport, newton};
pub use range::spans;
pub use root::{RootFault, bracketed_root, last_holding};
pub(crate) use threads::Threads;
pub use threads::mapped;
pub use vector::dot;
pub(crate) use vector::single;
