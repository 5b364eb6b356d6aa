//! Both readers of drawings: every dialect, laws, pages, visibility, refused files.

mod dialects;
mod laws;
mod pages;
mod refusals;
mod visible;
