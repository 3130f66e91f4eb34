//! What a surface of revolution is, by its definition: a point is inside if the way from it outward, at its
//! height, goes through the profile an odd number of times.
#![allow(dead_code, unreachable_pub, reason = "each test program uses a part of the oracle")]
#![allow(clippy::expect_used, clippy::panic, clippy::indexing_slicing, reason = "tests may panic")]
#![allow(
    clippy::disallowed_methods,
    reason = "a measure of errors need not be the same to the bit"
)]

use super::{Path, Real, dot, scaled, sub};

/// A distance from the axis and a height.
pub type Spot = [f64; 2];

#[derive(Clone, Debug)]
pub enum Piece {
    Line([Spot; 2]),
    Cubic([Spot; 4]),
}

impl Piece {
    /// The point at `u`, from the powers of `u`.
    pub fn at(&self, u: f64) -> Spot {
        [0, 1].map(|i| match self {
            Self::Line([a, b]) => (1.0 - u) * a[i] + u * b[i],
            Self::Cubic([a, b, c, d]) => {
                let v = 1.0 - u;
                v * v * v * a[i]
                    + 3.0 * v * v * u * b[i]
                    + 3.0 * v * u * u * c[i]
                    + u * u * u * d[i]
            }
        })
    }

    /// Where the height turns, with the ends.
    fn turns(&self) -> Vec<f64> {
        let mut turns = vec![0.0];
        if let Self::Cubic([a, b, c, d]) = self {
            let (p, q, r) = (b[1] - a[1], c[1] - b[1], d[1] - c[1]);
            // p(1−u)² + 2q(1−u)u + ru²
            let (a, b, c) = (p - 2.0 * q + r, q - p, p);
            let mut roots = if a.abs() < 1e-14 * (p.abs() + q.abs() + r.abs()) {
                vec![-c / (2.0 * b)]
            } else {
                let root = (b * b - a * c).max(0.0).sqrt();
                vec![(-b - root) / a, (-b + root) / a]
            };
            roots.sort_by(f64::total_cmp);
            turns.extend(roots.into_iter().filter(|u| *u > 0.0 && *u < 1.0));
        }
        turns.push(1.0);
        turns
    }
}

/// A closed profile.
#[derive(Clone, Debug)]
pub struct Profile {
    pub pieces: Vec<Piece>,
    monotone: Vec<(usize, f64, f64)>,
    chords: Vec<Chord>,
}

/// A short part of a piece.
#[derive(Clone, Debug)]
struct Chord {
    piece: usize,
    u: (f64, f64),
    ends: [Spot; 2],
}

impl Chord {
    fn length(&self) -> f64 {
        let [a, b] = self.ends;
        (b[0] - a[0]).hypot(b[1] - a[1])
    }

    /// How far a place is from the straight line between its ends.
    fn distance(&self, [rho, y]: Spot) -> f64 {
        let [a, b] = self.ends;
        let (dr, dy) = (b[0] - a[0], b[1] - a[1]);
        let square = dr * dr + dy * dy;
        let share = ((rho - a[0]) * dr + (y - a[1]) * dy) / square;
        let share = if share > 0.0 { share.min(1.0) } else { 0.0 };
        if share == 0.0 {
            return (rho - a[0]).hypot(y - a[1]);
        }
        if share == 1.0 {
            return (rho - b[0]).hypot(y - b[1]);
        }
        ((rho - a[0]) * dy - (y - a[1]) * dr).abs() / square.sqrt()
    }
}

impl Profile {
    pub fn new(pieces: Vec<Piece>) -> Self {
        let mut monotone = Vec::new();
        for (index, piece) in pieces.iter().enumerate() {
            for ends in piece.turns().windows(2) {
                monotone.push((index, ends[0], ends[1]));
            }
        }
        let mut chords = Vec::new();
        for (index, piece) in pieces.iter().enumerate() {
            let count = if matches!(piece, Piece::Line(_)) { 1 } else { 64 };
            for i in 0..count {
                let u = (f64::from(i) / f64::from(count), f64::from(i + 1) / f64::from(count));
                chords.push(Chord { piece: index, u, ends: [piece.at(u.0), piece.at(u.1)] });
            }
        }
        Self { pieces, monotone, chords }
    }

    /// By the even-odd rule.
    pub fn contains(&self, [rho, y]: Spot) -> bool {
        let mut inside = false;
        for &(index, from, to) in &self.monotone {
            let piece = &self.pieces[index];
            let ([a, b], [c, d]) = (piece.at(from), piece.at(to));
            if (b < y) == (d < y) {
                continue;
            }
            if let Piece::Line(_) = piece {
                inside ^= a + (c - a) * ((y - b) / (d - b)) > rho;
                continue;
            }
            let (mut low, mut high) = (from, to);
            for _ in 0..60 {
                let middle = 0.5 * (low + high);
                if (piece.at(middle)[1] < y) == (b < y) { low = middle } else { high = middle }
            }
            inside ^= piece.at(0.5 * (low + high))[0] > rho;
        }
        inside
    }

    /// About how far a place is from the profile, by chords.
    pub fn about(&self, spot: Spot) -> f64 {
        self.chords.iter().map(|chord| chord.distance(spot)).fold(f64::INFINITY, f64::min)
    }

    /// How far a place is from the profile.
    pub fn distance(&self, spot: Spot) -> f64 {
        let about = self.about(spot);
        let mut least = f64::INFINITY;
        for chord in &self.chords {
            let piece = &self.pieces[chord.piece];
            let (mut low, mut high) = chord.u;
            let Piece::Cubic(_) = piece else {
                least = least.min(chord.distance(spot));
                continue;
            };
            // A curve is nearer to its chord than the chord is long.
            if chord.distance(spot) > about + 0.1 * chord.length() {
                continue;
            }
            let away = |u: f64| {
                let at = piece.at(u);
                (at[0] - spot[0]).hypot(at[1] - spot[1])
            };
            for _ in 0..76 {
                let (a, b) = (low + 0.382 * (high - low), low + 0.618 * (high - low));
                if away(a) < away(b) { high = b } else { low = a }
            }
            least = least.min(away(low)).min(away(high));
        }
        least
    }

    /// About how large it is: the farthest that any point is from the origin.
    pub fn size(&self) -> f64 {
        let points =
            self.pieces.iter().flat_map(|piece| (0..=16).map(|i| piece.at(f64::from(i) / 16.0)));
        points.map(|[rho, y]| rho.hypot(y)).fold(0.0, f64::max)
    }
}

/// A ray in the coordinates of a profile, from the point nearest to their origin.
#[derive(Clone, Debug)]
pub struct Aim {
    pub exact: Path,
    /// The exact parameter of that point.
    pub shift: Real,
    pub origin: [f64; 3],
    pub dir: [f64; 3],
}

impl Aim {
    pub fn new(path: &Path, centre: &super::Point) -> Self {
        let from = sub(&path.origin, centre);
        let shift = -&(dot(&from, &path.dir) / dot(&path.dir, &path.dir));
        let origin = sub(&from, &scaled(&path.dir, &-&shift));
        let exact = Path { origin: origin.clone(), dir: path.dir.clone() };
        let [origin, dir] = [origin, path.dir.clone()].map(|v| v.map(|x| x.to_f64()));
        Self { exact, shift, origin, dir }
    }

    /// The place at a parameter that counts from the nearest point.
    pub fn spot(&self, t: f64) -> Spot {
        let [x, y, z] = super::along(self.origin, t, self.dir);
        [x.hypot(z), y]
    }

    /// A parameter of the ray, counted from the nearest point.
    pub fn local(&self, t: &Real) -> f64 {
        (t - &self.shift).to_f64()
    }
}
