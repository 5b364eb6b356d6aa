//! The **report**: one page about a gripper that opens from a file, without a network: verdict, sealing, parts, evidence.
//!
//! The page is a fixed frame, `templates/report/`, and a block of figures ([`data`]) that its scripts show. Of the rest
//! only the title depends on the spec, so a reader of the block has read the page.

mod bare;
mod data;
mod job;
mod page;
mod polyline;
mod subject;

use design::PressPlan;

pub use subject::Report;

/// The report as a page for browsers.
pub fn report(report: &Report<'_>) -> String {
    let plan = PressPlan::new(report.spec, report.design);
    page::page(&report.spec.name, &data::data(report), report.scene, report.code, plan.as_ref())
}
