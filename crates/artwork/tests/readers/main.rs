//! Both readers of drawings: every dialect, laws, refused files.

mod dialects;
mod laws;
mod refusals;
