//! Stars computed as shells, with which predictions without a shell are compared.
//!
//! Three sets are drawn by seed ([`draw`]) that have no star in common: to **fit** the few numbers beyond the hinge models, to
//! determine **ranges** of errors, and to **test** both. Each star is computed as a self-contained text ([`computed`]);
//! all of them joined are [`shipped`], with a checksum.

pub mod computed;
pub mod draw;
pub mod finest;
pub mod shipped;
