//! `align`: the programs of a build, turned and shifted to where its sheet lies now.

use serde_json::{Value, json};
use stargrip_cam::geom::Point;
use stargrip_cam::pipeline::{align as aligned, read_mark};

use crate::commands::build::directory;
use crate::message::Message;
use crate::question::text;

/// The mark under `name`.
fn read(question: &Value, name: &str) -> Result<Point, Value> {
    read_mark(text(question, name).unwrap_or_default()).map_err(|reason| refused(&reason))
}

/// The answer without files.
fn refused(reason: &str) -> Value {
    json!({ "reason": reason })
}

/// The proven build of the programs of `files` for a sheet that was moved. Their heads state its motion.
///
/// # Errors
/// The `reason` for which there is none: a mark that cannot be read, or a sheet that cannot lie there.
pub(super) fn align(question: &Value, files: Vec<(String, Vec<u8>)>) -> Result<Message, Value> {
    let marks = [read(question, "mark1")?, read(question, "mark2")?];
    let build = directory(files);
    let sheet = question["sheet"].as_u64().and_then(|number| usize::try_from(number).ok());
    let proven = aligned(&build, sheet, marks).map_err(|fault| refused(&fault.to_string()))?;
    let files = proven.built().files().map(|(name, bytes)| (name.to_owned(), bytes.into_owned())).collect();
    let motion = proven.built().forecast.design.alignment.map(|alignment| alignment.in_words());
    Ok(Message { json: json!({ "motion": motion }), files })
}
