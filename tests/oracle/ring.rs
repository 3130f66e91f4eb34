//! The exact twin of the torus: all roots of its quartic, by Sturm's theorem, and membership
//! between them.
#![allow(dead_code, unreachable_pub, reason = "each test program uses a part of the oracle")]
#![allow(clippy::expect_used, clippy::panic, clippy::indexing_slicing, reason = "tests may panic")]

use super::{Path, Point, Real, dot};

/// A polynomial in ascending powers.
#[derive(Clone, Debug)]
pub struct Polynomial(pub Vec<Real>);

impl Polynomial {
    pub fn value(&self, t: &Real) -> Real {
        self.0.iter().rev().fold(Real::from(0.0), |value, c| value * t + c)
    }

    pub fn times(&self, other: &Self) -> Self {
        let mut product = vec![Real::from(0.0); self.0.len() + other.0.len() - 1];
        for (i, a) in self.0.iter().enumerate() {
            for (j, b) in other.0.iter().enumerate() {
                product[i + j] = &product[i + j] + a * b;
            }
        }
        Self(product)
    }

    fn derivative(&self) -> Self {
        let c = self.0.iter().enumerate().skip(1).map(|(i, c)| c * Real::from(i as f64));
        Self(c.collect())
    }

    fn greatest(&self) -> Real {
        let larger = |most: Real, c: Real| if most < c { c } else { most };
        self.0.iter().map(Real::abs).fold(Real::from(0.0), larger)
    }

    /// Without leading coefficients that, beside a size, are 0 but for the rounding of 300 bits.
    fn trimmed(mut self, size: &Real) -> Self {
        let least = size * Real::from(f64::powi(2.0, -250));
        while self.0.last().is_some_and(|c| c.abs() <= least) {
            self.0.pop();
        }
        self
    }

    /// The remainder of a division, turned round.
    fn negated_rest(&self, by: &Self) -> Self {
        let (mut rest, by, size) = (self.0.clone(), &by.0, self.greatest());
        while rest.len() >= by.len() {
            let factor = &rest[rest.len() - 1] / &by[by.len() - 1];
            let shift = rest.len() - by.len();
            for (i, b) in by.iter().enumerate() {
                rest[i + shift] = &rest[i + shift] - &factor * b;
            }
            rest.pop();
        }
        Self(rest.iter().map(|c| -c).collect()).trimmed(&size)
    }

    /// All different real roots between two ends, ascending, each to about 120 bits.
    pub fn roots(&self, low: &Real, high: &Real) -> Vec<Real> {
        let first = self.clone().trimmed(&self.greatest());
        if first.0.len() < 2 {
            return Vec::new();
        }
        let mut chain = vec![first.clone(), first.derivative()];
        while let [.., a, b] = &chain[..]
            && b.0.len() > 1
        {
            let next = a.negated_rest(b);
            if next.0.is_empty() {
                break;
            }
            chain.push(next);
        }
        let changes = |t: &Real| {
            let signs: Vec<i32> =
                chain.iter().map(|p| p.value(t).sign()).filter(|&sign| sign != 0).collect();
            signs.windows(2).filter(|pair| pair[0] != pair[1]).count()
        };
        let mut found = Vec::new();
        let mut waiting = vec![(low.clone(), changes(low), high.clone(), changes(high), 0)];
        while let Some((a, at_a, b, at_b, depth)) = waiting.pop() {
            if at_a <= at_b {
                continue;
            }
            let changes_sign = first.value(&a).sign() != first.value(&b).sign();
            if at_a - at_b == 1 && changes_sign {
                found.push(first.root(a, b));
                continue;
            }
            let middle = (&a + &b) / Real::from(2.0);
            if depth == 120 {
                // A root of even multiplicity; nearer to it the sign is that of rounding.
                found.push(middle);
                continue;
            }
            let at_middle = changes(&middle);
            waiting.push((middle.clone(), at_middle, b, at_b, depth + 1));
            waiting.push((a, at_a, middle, at_middle, depth + 1));
        }
        found
    }

    /// The one root in a bracket: bisection until Newton's method may finish.
    fn root(&self, mut a: Real, mut b: Real) -> Real {
        let (slope, sign) = (self.derivative(), self.value(&a).sign());
        let two = Real::from(2.0);
        for steps in 0..240 {
            let middle = (&a + &b) / &two;
            if steps % 8 == 4 {
                let mut t = middle.clone();
                for _ in 0..7 {
                    let step = self.value(&t) / slope.value(&t);
                    let fine = step.abs() <= t.abs() * Real::from(f64::powi(2.0, -70));
                    t = &t - step;
                    if !(a < t && t < b) {
                        break;
                    } else if fine {
                        return t;
                    }
                }
            }
            if self.value(&middle).sign() == sign { a = middle } else { b = middle }
        }
        (a + b) / two
    }
}

/// A torus by its exact parameters, in coordinates `rows · (world − offset)`; about the y axis.
#[derive(Clone, Debug)]
pub struct Ring {
    pub rows: [Point; 3],
    pub offset: Point,
    pub major: Real,
    pub minor: Real,
}

impl Ring {
    /// Within `minor + grow` of the circle, by the definition.
    pub fn contains(&self, [x, y, z]: &Point, grow: &Real) -> bool {
        let minor = &self.minor + grow;
        // (ρ − R)² + y² ≤ r², without a root: ρ² + y² + R² − r² ≤ 2Rρ.
        let square = x * x + z * z;
        let left = &square + y * y + &self.major * &self.major - &minor * &minor;
        left.sign() <= 0 || (&left * &left) <= &self.major * &self.major * square * Real::from(4.0)
    }

    /// Where a line goes in and out, ascending; an even number.
    pub fn ends(&self, path: &Path, grow: &Real) -> Vec<Real> {
        let Path { origin, dir } = path.through(&self.rows, &self.offset);
        let (dd, two) = (dot(&dir, &dir), Real::from(2.0));
        let middle = -&(dot(&origin, &dir) / &dd);
        let nearest: Point = [0, 1, 2].map(|i| &origin[i] + &middle * &dir[i]);
        let minor = &self.minor + grow;
        let size = &self.major + &minor;
        let half = &size * Real::from(1.5) / dd.sqrt();
        // (|q|² + R² − r²)² − 4R²ρ².
        let along = |v: &Point, w: &Point| Polynomial(vec![dot(v, v), dot(v, w) * &two, dot(w, w)]);
        let mut whole = along(&nearest, &dir);
        whole.0[0] = &whole.0[0] + &self.major * &self.major - &minor * &minor;
        let flat = |v: &Point| [v[0].clone(), Real::from(0.0), v[2].clone()];
        let across = along(&flat(&nearest), &flat(&dir));
        let factor = &self.major * &self.major * Real::from(4.0);
        let mut quartic = whole.times(&whole);
        for (c, a) in quartic.0.iter_mut().zip(&across.0) {
            *c = &*c - &factor * a;
        }
        let roots = quartic.roots(&-&half, &half);
        let place = |t: &Real| [0, 1, 2].map(|i| &nearest[i] + t * &dir[i]);
        // A root is an end where membership changes: not where the line only touches, nor on the
        // lens of a spindle.
        let mut inside = false;
        let mut ends = Vec::new();
        for (index, root) in roots.iter().enumerate() {
            let next = roots.get(index + 1).unwrap_or(&half);
            let behind = self.contains(&place(&((root + next) / &two)), grow);
            if behind != inside {
                ends.push(root + &middle);
                inside = behind;
            }
        }
        assert!(!inside, "a torus is bounded");
        ends
    }
}
