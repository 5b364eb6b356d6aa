//! The **report**: all that is known of a gripper on one page that opens from a file, without a network: what it does, how it is
//! sealed, what it is made of, how good each number is.
//!
//! The page is a fixed frame, `templates/report/`, and a block of figures ([`data`]) that its scripts show. Nothing else in it
//! depends on the spec but its title, so whoever reads the block has read the page.

mod data;
mod job;
mod page;
mod polyline;

use crate::design::Design;
use crate::forecast::charts::Charts;
use crate::forecast::prediction::Prediction;
use crate::forecast::verdict::Verdict;
use crate::manifest::Manifest;
use crate::plan::Program;
use crate::spec::{Machine, Spec};

/// What a report is made of.
#[derive(Clone, Copy)]
pub struct Report<'a> {
    /// The spec as read.
    pub source: &'a str,
    /// What was asked for.
    pub spec: &'a Spec,
    /// What it is made on.
    pub machine: &'a Machine,
    /// The exact geometry.
    pub design: &'a Design,
    /// The sealing programs.
    pub programs: &'a [Program],
    /// What it will do; `None` for a spec without a load.
    pub prediction: Option<&'a Prediction>,
    /// Whether it holds its object; `None` without one.
    pub verdict: Option<&'a Verdict>,
    /// The same by pressure, object and number of points.
    pub charts: &'a [Charts],
    /// The bill of materials; its files do not matter.
    pub bill: &'a Manifest,
    /// Everything in three dimensions, a GLB.
    pub scene: &'a [u8],
}

/// The report as a page for browsers.
pub fn report(report: &Report<'_>) -> String {
    page::page(&report.spec.name, &data::data(report), report.scene)
}
