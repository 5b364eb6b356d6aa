//! Numerical methods; they know no sheets.
