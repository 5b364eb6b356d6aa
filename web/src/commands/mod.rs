//! The questions of the page, by the word in `ask`, and their answers. Each answer depends on its question alone; no state is kept.
//!
//! | ask | takes | answers |
//! |---|---|---|
//! | `start` | | the schema, the starter, the machine profiles, the kinds of file |
//! | `build` | `spec`, `machine`, the drawing, `only`, `with`, `anyway`, `prove`, `model` | faults, settings, the overview, the proof, files |
//! | `look` | `spec`, `machine`, the drawing | faults, settings, the overview, the picture: no files |
//! | `verify` | files | the proof, as with `verify --json` |
//! | `align` | the files of a build, `mark1`, `mark2`, `sheet` | the files for the sheet as it lies now and its `motion` in words, or the `reason` |
//! | `drawing` | a drawing | a spec that names its layers, or the reason why it cannot be read |
//! | `new` | `name`, `object`, `mass` and the other options of `new` | a spec and its verdict, or the reason why there is none |
//! | `edit` | `spec`, `key`, `value` | the spec with that value; without one, without the key |
//! | `role` | `spec`, `layer`, `role` | the spec with that role for a layer of its drawing |
//! | `predict` | `spec`, `machine`, the drawing, `model` | the prediction, in words and as JSON; shells are coarse |
//! | `link` | `spec`, `machine`, the drawing | the part of a link that holds them |
//! | `qr` | the same, `address` | the QR code of the link to the page there, as a path of an SVG |
//! | `explain` | `code` | what the code means |
//!
//! `faults` are errors and warnings with their places; `wrong` is a fault of the question itself.

mod align;
mod build;
mod drawing;
mod edit;
mod faults;
mod link;
mod object;
mod picture;
mod predict;
mod spec;
mod start;

use serde_json::Value;

use crate::message::Message;
use crate::question::{Tell, text, wrong};

/// Answers a question, or reports why it could not be read.
pub fn answer(question: Result<Message, String>, tell: Tell) -> Message {
    question.map_err(wrong).and_then(|question| answered(question, tell)).unwrap_or_else(Message::from_json)
}

/// The answer, or another one without files, that names the faults.
fn answered(question: Message, tell: Tell) -> Result<Message, Value> {
    let Message { json: question, files } = question;
    let word = text(&question, "ask").ok_or_else(|| wrong("the question has no `ask`"))?;
    let answer = match word {
        "start" => start::start(),
        "explain" => start::explain(&question),
        "link" => link::link(&question, &files),
        "qr" => link::qr(&question, &files),
        "build" => return build::build(&question, &files, tell),
        "look" => build::look(&question, &files)?,
        "verify" => build::verify(files),
        "align" => return align::align(&question, files),
        "predict" => predict::predict(&question, &files, tell)?,
        "drawing" => drawing::drawing(&files)?,
        "new" => object::new(&question)?,
        "edit" => edit::edit(&question)?,
        "role" => edit::role(&question)?,
        "process" => edit::process(&question)?,
        _ => return Err(wrong(format!("unknown question {word:?}"))),
    };
    Ok(Message::from_json(answer))
}
