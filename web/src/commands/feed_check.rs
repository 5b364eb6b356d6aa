//! `feed-check`: the program that measures whether the machine moves and stops as its profile says.

use serde_json::{Value, json};
use stargrip_cam::artifact::program_ending;
use stargrip_cam::manifest::FEED_CHECK_MANIFEST;
use stargrip_cam::pipeline::{FeedCheckFault, PACKAGE_ENDING, ProvenFeedCheck, Sources};
use stargrip_cam::pipeline::{feed_check as proven, feed_check_ways};
use stargrip_cam::plan::CHECK_LENGTH;

use crate::commands::faults::of_design;
use crate::commands::spec::Given;
use crate::message::Message;

/// The program with its manifest, and its package where the machine takes one; and the `task` in words, or the `reason` for which there is no
/// program.
///
/// # Errors
/// The faults of the spec.
pub(super) fn feed_check(question: &Value, files: &[(String, Vec<u8>)]) -> Result<Message, Value> {
    let Given { source, reading, machine, machine_text } = Given::read(question, files)?;
    let sources = Sources { spec: &source.text, machine: &machine_text };
    let name = format!("feedcheck.{}", program_ending(machine.controller.dialect));
    let check = match proven(&reading.spec, &machine, sources, &name) {
        Ok(check) => check,
        Err(FeedCheckFault::Refused(refusals)) => {
            let faults = of_design(&source, &reading, refusals);
            return Ok(Message::from_json(json!({ "reason": faults.first().map(|fault| &fault["found"]) })));
        }
        Err(FeedCheckFault::Wrong(findings)) => {
            return Ok(Message::from_json(
                json!({ "reason": findings.first().map(|finding| &finding.found) }),
            ));
        }
    };
    let ProvenFeedCheck { text, package, manifest } = check;
    let seconds = CHECK_LENGTH / reading.spec.seal.speed.0;
    let task = format!(
        "Each of its {} must take {seconds:.0} s. At each {} it must stop and wait, at the X, Y and Z in the comment before it. If it runs on, \
         or stops elsewhere, do not seal with this profile.",
        feed_check_ways(&machine),
        machine.script.pause
    );
    let mut files =
        vec![(name.clone(), text.into_bytes()), (format!("{name}{FEED_CHECK_MANIFEST}"), manifest.to_json())];
    files.extend(package.map(|bytes| (format!("{name}{PACKAGE_ENDING}"), bytes)));
    Ok(Message { json: json!({ "task": task }), files })
}
