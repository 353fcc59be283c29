//! Sections, and parts of them, that both kinds of study have.
//!
//! | module | what it reads |
//! |---|---|
//! | `top` | `kind`, `title` and `gravity_m_s2` at the top of the file |
//! | `record_source` | where records come from: `manifest` or `[records.synthetic]` |
//! | `selection` | `[records.select]`: which of them are used |
//! | `strengths` | `[strengths]` |
//! | `stiffness` | what the keys of `[oscillator]` make together |
//! | `name` | the name of a site or record set |
//! | `output` | `[output]` |
//! | `uncertainty` | `[uncertainty]`: what of a structure is not known exactly |

pub(crate) mod name;
pub(crate) mod output;
pub(crate) mod record_source;
pub(crate) mod selection;
pub(crate) mod stiffness;
pub(crate) mod strengths;
pub(crate) mod top;
pub(crate) mod uncertainty;
