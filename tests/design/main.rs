//! Whole builds: what their files hold, that parts fit together, and that each fault in a file is found.

mod agree;
mod assembly;
mod build;
mod corrupted;
mod drawn;
mod edits;
mod forged;
mod hostile;
mod links;
mod pictures;
mod published;
mod readers;
mod report;
mod scene;
#[path = "../support/mod.rs"]
mod support;
