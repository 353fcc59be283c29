//! The functions that the page calls: bytes in, bytes out.
//!
//! ```text
//! place = uplift_allocate(n)        room for n bytes, which the page fills with a question and a file
//! bytes = uplift_answer(m)           answers; the last m of these bytes are a file
//! place = uplift_reply()            where the answer lies, until the next question
//! ```

// what crosses the border of WebAssembly is memory
#![allow(unsafe_code)]

use std::cell::RefCell;

use crate::calculator::Calculator;

thread_local! {
    static QUESTION: RefCell<Vec<u8>> = const { RefCell::new(Vec::new()) };
    static REPLY: RefCell<Vec<u8>> = const { RefCell::new(Vec::new()) };
    static CALCULATOR: RefCell<Calculator> = RefCell::new(Calculator::new());
}

/// Room for a question of so many bytes; it is valid until the next call of this function.
#[unsafe(no_mangle)]
pub(crate) extern "C" fn uplift_allocate(bytes: usize) -> *mut u8 {
    QUESTION.with_borrow_mut(|question| {
        *question = vec![0; bytes];
        question.as_mut_ptr()
    })
}

/// Answers the question in the room that was given, whose last `file_bytes` bytes are a file; how long the answer is.
#[unsafe(no_mangle)]
pub(crate) extern "C" fn uplift_answer(file_bytes: usize) -> usize {
    let question = QUESTION.take();
    let (text, file) = question.split_at(question.len().saturating_sub(file_bytes));
    let reply = CALCULATOR.with_borrow_mut(|calculator| calculator.reply(text, file));
    let bytes = reply.len();
    REPLY.set(reply.into_bytes());
    bytes
}

/// Where the last answer lies; it is valid until the next one.
#[unsafe(no_mangle)]
pub(crate) extern "C" fn uplift_reply() -> *const u8 {
    REPLY.with_borrow(Vec::as_ptr)
}
