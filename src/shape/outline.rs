//! What plane outlines have in common.

use crate::scalar::{Number, Scalar};

/// Two segments cross at a point inside of both.
pub(super) fn cross_properly<S: Scalar>(
    [a, b]: [[S::Wide; 2]; 2],
    [c, d]: [[S::Wide; 2]; 2],
) -> bool {
    let zero = S::Wide::ZERO;
    let parted = |line: [[S::Wide; 2]; 2], [p, q]: [[S::Wide; 2]; 2]| {
        let (p, q) = (side::<S>(line, p), side::<S>(line, q));
        (p < zero && zero < q) || (q < zero && zero < p)
    };
    parted([a, b], [c, d]) && parted([c, d], [a, b])
}

/// Two segments cross or touch, other than at a common end.
pub(super) fn meet<S: Scalar>(first: [[S::Wide; 2]; 2], second: [[S::Wide; 2]; 2]) -> bool {
    let ([a, b], [c, d]) = (first, second);
    if a == c || a == d || b == c || b == d {
        return cross_properly::<S>(first, second);
    }
    let zero = S::Wide::ZERO;
    let apart = |line: [[S::Wide; 2]; 2], ends: [[S::Wide; 2]; 2]| {
        let [p, q] = ends.map(|end| side::<S>(line, end));
        (p < zero && q < zero) || (zero < p && zero < q)
    };
    let beside =
        |a: S::Wide, b: S::Wide, c: S::Wide, d: S::Wide| a.max(b) < c.min(d) || c.max(d) < a.min(b);
    let boxes_apart = beside(a[0], b[0], c[0], d[0]) || beside(a[1], b[1], c[1], d[1]);
    !(boxes_apart || apart(first, second) || apart(second, first))
}

/// On which side of the line through two points a third one lies.
fn side<S: Scalar>([a, b]: [[S::Wide; 2]; 2], p: [S::Wide; 2]) -> S::Wide {
    S::det2(b[0] - a[0], p[1] - a[1], b[1] - a[1], p[0] - a[0])
}
