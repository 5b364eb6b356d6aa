//! stargrip-cam for a web page: a question as bytes, an answer as bytes.
//!
//! The page's worker writes a [`message`] into the instance's memory and calls `ask` ([`boundary`]). The only import
//! from JavaScript is a function that reports progress. A message is JSON and the bytes of files. [`commands`] has
//! the questions; their answers are those of the command line.
//!
//! A panic ends the instance. Its message can still be read, and the page makes a new instance.

pub mod boundary;
pub mod commands;
pub mod message;
pub mod question;

pub use message::Message;
