//! What the numbers of structures, records and hazard may plausibly be: one table for every reader of files and
//! arguments.
//!
//! A number outside is refused where it is read, with the range, the value, the unit and what was probably meant:
//! beyond these ranges lie mistakes of unit, runs without end and arithmetic that overflows. They are generous: models
//! on a shaking table or in a centrifuge, blocks of a kilometre, the Moon are inside, and a published value that is not
//! is a reason to widen one.
//!
//! ```
//! use uplift_plausible::GRAVITY;
//! assert!(GRAVITY.contains(9.81) && GRAVITY.contains(1.62));
//! let refused = GRAVITY.check("gravity_m_s2", 981.0e3).unwrap_err();
//! assert!(refused.to_string().starts_with("gravity_m_s2 is 981000 m/s2: it must be from 0.1 to 2000 m/s2"));
//! ```
//!
//! What is possible but unlikely has the narrower `USUAL_…` ranges: it is used, and said ([`Unlikely`]).
//!
//! Bounds that only a combination of numbers shows, such as the frequency of an oscillator, stand where it is made.

mod decimal;
mod range;
mod table;
mod usual;

pub use decimal::{AmbiguousMarks, DecimalMarks, may_be_thousands, with_point};
pub use range::{Implausible, Range, Unlikely, after_value, counted, short_number};
pub use table::*;
pub use usual::*;
