//! `Q16` and `Q32`: scalars in integer arithmetic alone, for machines without floats.
//!
//! Positions have 16 or 32 bits behind the point, directions 30 or 62. Sums of products are
//! exact in integers of twice the width and rounded once; what needs more goes through
//! [`Wide`]. Everything saturates, nothing wraps.

mod functions;
mod number;
mod scalar;
mod triple;
mod wide;

pub use number::{Q16, Q32, Unit16, Unit32};
pub use scalar::{Inverse16, Inverse32};
pub use triple::Triple;
pub use wide::Wide;
