//! Both readers of drawings: every dialect, laws, pages, visibility, refused files.

mod dxf_dialects;
mod laws;
mod lookup;
mod pages;
mod refusals;
mod svg_dialects;
mod visible;
