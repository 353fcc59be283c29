//! What the crate promises: sensitivity indices of functions whose indices are known.

mod sensitivity;
