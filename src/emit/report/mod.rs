//! The **report**: all that is known of a gripper on one page that opens from a file, without a network: what it does, how it is
//! sealed, what it is made of, how good each number is.
//!
//! The page is a fixed frame, `templates/report/`, and a block of figures ([`data`]) that its scripts show. Nothing else in it
//! depends on the spec but its title, so whoever reads the block has read the page.

mod data;
mod job;
mod page;
mod polyline;
mod subject;

pub use subject::Report;

/// The report as a page for browsers.
pub fn report(report: &Report<'_>) -> String {
    page::page(&report.spec.name, &data::data(report), report.scene)
}
