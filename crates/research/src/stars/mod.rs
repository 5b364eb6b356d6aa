//! Stars computed as shells, with which predictions without a shell are compared.
//!
//! Three sets are drawn by seed ([`draw`]) that have no star in common: to **fit** the few numbers that hinges do not know, to
//! take **ranges** of errors from, and to **test** both on; a fourth has stars unlike those. Each star is computed as a text that stands alone ([`computed`]);
//! all of them joined are [`shipped`], with a checksum.

pub mod computed;
pub mod draw;
pub mod finest;
pub mod shipped;
