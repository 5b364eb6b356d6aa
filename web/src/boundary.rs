//! The interface with JavaScript: five exported functions, two of them for panics, and one imported function for the progress of long work.
//! All of it is safe code. Only the exported names are unsafe, since two libraries might have the same; this one is linked with no other.
#![allow(unsafe_code, reason = "the attributes of exported and imported names; there is no unsafe block")]

use std::cell::RefCell;
use std::panic;
use std::sync::Once;

use crate::commands::answer;
use crate::message::Message;

/// The buffers between the page and the instance.
#[derive(Default)]
struct Mailbox {
    question: Vec<u8>,
    answer: Vec<u8>,
    panic: Vec<u8>,
}

#[cfg(target_arch = "wasm32")]
#[link(wasm_import_module = "page")]
unsafe extern "C" {
    /// Receives the part that is done, 0 to 1, and the current step in `length` bytes at `text`.
    safe fn progress(part: f64, text: *const u8, length: usize);
}

/// Reports to the page the `part` of the work that is done, 0 to 1, and the current step. Outside of a page it has no effect.
fn tell(part: f64, step: &str) {
    #[cfg(target_arch = "wasm32")]
    progress(part, step.as_ptr(), step.len());
    #[cfg(not(target_arch = "wasm32"))]
    let _ = (part, step);
}

thread_local! {
    // The instance has one thread.
    static MAILBOX: RefCell<Mailbox> = RefCell::default();
}

static HEARS_PANICS: Once = Once::new();

/// Allocates a question of `length` bytes; returns its address.
#[unsafe(no_mangle)]
pub extern "C" fn question(length: usize) -> *const u8 {
    MAILBOX.with_borrow_mut(|mailbox| {
        mailbox.question = vec![0; length];
        mailbox.question.as_ptr()
    })
}

/// Answers the question; returns the length of the answer, bytes.
#[unsafe(no_mangle)]
pub extern "C" fn ask() -> usize {
    HEARS_PANICS.call_once(|| panic::set_hook(Box::new(|info| keep(&info.to_string()))));
    let question = MAILBOX.with_borrow_mut(|mailbox| std::mem::take(&mut mailbox.question));
    let reply = answer(Message::from_bytes(&question), tell).into_bytes();
    MAILBOX.with_borrow_mut(|mailbox| {
        mailbox.answer = reply;
        mailbox.answer.len()
    })
}

/// The address of the answer, valid until the next question.
#[unsafe(no_mangle)]
pub extern "C" fn answered() -> *const u8 {
    MAILBOX.with_borrow(|mailbox| mailbox.answer.as_ptr())
}

/// Length of the message of the panic that ended this instance, bytes.
#[unsafe(no_mangle)]
pub extern "C" fn panic_length() -> usize {
    MAILBOX.with_borrow(|mailbox| mailbox.panic.len())
}

/// The address of that message.
#[unsafe(no_mangle)]
pub extern "C" fn panicked() -> *const u8 {
    MAILBOX.with_borrow(|mailbox| mailbox.panic.as_ptr())
}

/// Stores the message of a panic, unless it happens while the mailbox is in use.
fn keep(text: &str) {
    MAILBOX.with(|mailbox| {
        if let Ok(mut mailbox) = mailbox.try_borrow_mut() {
            mailbox.panic = text.as_bytes().to_vec();
        }
    });
}
