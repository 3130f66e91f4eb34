//! What a profile must be, and where it is filled.

use super::profile::{Piece, Profile, Spot, differences};
use super::{Curve, Filled, Lathe};
use crate::roots::bernstein_crossings;
use crate::scalar::{Number, Real, Scalar, Vector};
use crate::shape::outline::meet;
use crate::shape::{Flaw, check_point};

/// How many chords a curve is looked at as, to see whether it crosses another.
const CHORDS: i32 = 16;

/// Checks all that a lathe says of its profile.
///
/// A closed profile must not cross or touch itself; curves are looked at as chords.
pub(super) fn check<S: Scalar>(lathe: &Lathe<S>, profile: &Profile<'_, S>) -> Result<(), Flaw> {
    if profile.points.is_empty() {
        return Err(Flaw::Index("points"));
    }
    let cubics = lathe.curve == Curve::Cubics;
    let whole = !cubics || lathe.count.saturating_sub(1).is_multiple_of(3);
    if lathe.pieces() == 0 || !whole {
        return {
            let allowed = "two or more, and for curves three for each and one";
            Err(Flaw::OutOfRange("points", allowed))
        };
    }
    for &point in profile.points {
        check_point::<S>(point, "points")?;
        if point.z() != S::ZERO {
            return Err(Flaw::NotPlanar("points"));
        }
    }
    for piece in profile.pieces() {
        check_piece::<S>(&piece)?;
    }
    let filled = filled(profile);
    if profile.is_closed() && filled == Filled::Nowhere {
        return Err(Flaw::Empty("points"));
    }
    if lathe.filled != filled {
        return Err(Flaw::OutOfRange("filled", "the side that the profile goes around"));
    }
    if profile.is_closed() && crosses_itself(profile) {
        return Err(Flaw::OutOfRange(
            "points",
            "a profile that neither crosses nor touches itself",
        ));
    }
    Ok(())
}

/// A piece has a length, lies on one side of the axis, and somewhere off it.
fn check_piece<S: Scalar>(piece: &Piece<S::Wide>) -> Result<(), Flaw> {
    let (zero, shortest) = (S::Wide::ZERO, S::LENGTH_MIN.widen());
    let ([below, above], [low, high]) = (piece.heights(), piece.distances());
    let [[first, _], [last, _]] = piece.ends();
    let mut nearest = first.min(last);
    if let Piece::Cubic(cubic) = piece {
        bernstein_crossings(&differences(cubic.rho), |u| {
            nearest = nearest.min(cubic.at(u)[0]);
        });
    }
    if nearest < zero {
        Err(Flaw::OutOfRange("points", "at least 0 from the axis, all along the profile"))
    } else if !(shortest <= (high - low).max(above - below)) || piece.reach() < shortest {
        Err(Flaw::Empty("points"))
    } else {
        Ok(())
    }
}

/// The side that is filled, by the sign of the area.
pub(super) fn filled<S: Scalar>(profile: &Profile<'_, S>) -> Filled {
    if !profile.is_closed() {
        return Filled::Nowhere;
    }
    // Twice the area to the left.
    let mut area = S::Wide::ZERO;
    for piece in profile.pieces() {
        area += match piece {
            Piece::Line([[a, b], [c, d]]) => (a + c) * (d - b),
            Piece::Cubic(cubic) => cubic.area() * S::Wide::TWO,
        };
    }
    if area > S::Wide::ZERO {
        Filled::Left
    } else if area < S::Wide::ZERO {
        Filled::Right
    } else {
        Filled::Nowhere
    }
}

/// Two chords of the profile cross or touch.
fn crosses_itself<S: Scalar>(profile: &Profile<'_, S>) -> bool {
    for (index, first) in profile.pieces().enumerate() {
        for second in profile.pieces().skip(index) {
            if !may_meet(&first, &second) {
                continue;
            }
            for chord in chords(first) {
                if chords(second).any(|other| meet::<S>(chord, other)) {
                    return true;
                }
            }
        }
    }
    false
}

/// The boxes around two pieces meet.
fn may_meet<T: Real>(first: &Piece<T>, second: &Piece<T>) -> bool {
    let [[a, b], [c, d]] = [first, second].map(Piece::heights);
    let [[e, f], [g, h]] = [first, second].map(Piece::distances);
    a <= d && c <= b && e <= h && g <= f
}

fn chords<T: Real>(piece: Piece<T>) -> impl Iterator<Item = [Spot<T>; 2]> {
    let count = if matches!(piece, Piece::Line(_)) { 1 } else { CHORDS };
    (0..count).map(move |index| match &piece {
        Piece::Line(ends) => *ends,
        Piece::Cubic(cubic) => {
            [index, index + 1].map(|index| cubic.at(T::from_ratio(index, CHORDS)))
        }
    })
}
