//! Whole builds: their files have the right content, parts fit together, and each fault in a file is found.

mod agree;
mod assembly;
mod build;
mod corrupted;
mod cuts;
mod drawn;
mod edits;
mod forged;
mod hostile;
mod layers;
mod links;
mod marks;
mod model;
mod one_layer;
mod packages;
mod parts;
mod pictures;
mod pressed;
mod published;
mod readers;
mod remedies;
mod report;
mod roundings;
mod scene;
#[path = "../support/mod.rs"]
mod support;
