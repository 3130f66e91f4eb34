//! What a blob must be.

use super::{Blob, Component};
use crate::scalar::{Number, Real, Scalar, Vector};
use crate::shape::{Flaw, Tables, check_centre, check_length, check_point};

/// The indices, and all numbers one by one.
pub(super) fn check<S: Scalar>(
    blob: &Blob<S>,
    placed: bool,
    tables: &Tables<'_, S>,
) -> Result<(), Flaw> {
    check_centre::<S>(blob.center, placed)?;
    if blob.count == 0 {
        return Err(Flaw::Empty("components"));
    }
    if 2 * blob.spans_max() > u32::from(u16::MAX) {
        return Err(Flaw::TooLarge("components"));
    }
    let two = 2 * u32::from(blob.count);
    let beyond = |table, first: u32, count: u32, len: usize| {
        let end = first.saturating_add(count);
        let flaw = Flaw::Beyond { table, index: end.saturating_sub(1), len: len as u32 };
        if end as usize <= len { Ok(()) } else { Err(flaw) }
    };
    beyond("points", blob.points, two, tables.points.len())?;
    beyond("numbers", blob.numbers, two + 1, tables.numbers.len())?;
    for &point in blob.points(tables) {
        check_point::<S>(point, "components")?;
    }
    for numbers in blob.numbers(tables).chunks_exact(2) {
        let &[radius, strength] = numbers else { continue };
        check_length(radius, "radius")?;
        if !strength.is_finite() {
            return Err(Flaw::NotFinite("strength"));
        }
        if strength.abs() > S::COORD_MAX {
            return Err(Flaw::TooLarge("strength"));
        }
    }
    check_field(blob, tables)
}

/// There is something to see, and it can be told from nothing.
fn check_field<S: Scalar>(blob: &Blob<S>, tables: &Tables<'_, S>) -> Result<(), Flaw> {
    let threshold = tables.numbers.get(blob.numbers as usize).copied().unwrap_or(S::ZERO);
    if !threshold.is_finite() {
        return Err(Flaw::NotFinite("threshold"));
    }
    if !(threshold > S::ZERO) {
        return Err(Flaw::NotPositive("threshold"));
    }
    let (mut cylinders, mut most, mut all) = (0, S::Wide::ZERO, S::Wide::ZERO);
    for Component { ends: [from, to], radius, strength } in blob.components(tables) {
        cylinders += u32::from((to - from).length_squared() > S::Wide::ZERO);
        most = most.max(strength);
        all += strength.abs();
        // Smaller than this, it is not where it was said to be.
        let reach = from.max_abs().max(to.max_abs());
        if radius < S::rounding(reach) * S::Wide::from_i32(16) {
            return Err(Flaw::NotPositive("radius"));
        }
    }
    if cylinders != u32::from(blob.cylinders) {
        return Err(Flaw::OutOfRange("cylinders", "the number of components that are not balls"));
    }
    if !(most > S::Wide::ZERO) {
        return Err(Flaw::OutOfRange("strength", "greater than 0 for one component at least"));
    }
    if threshold.widen() < all * S::Wide::EPSILON * S::Wide::from_i32(64) {
        return Err(Flaw::OutOfRange("threshold", "large enough to tell beside the strengths"));
    }
    Ok(())
}
