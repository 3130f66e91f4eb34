//! Noise: a random field without any memory, the same in every number format up to its rounding.
//!
//! | field | range | mean | deviation | where its power lies |
//! | --- | --- | --- | --- | --- |
//! | [`noise`] | within ±[`NOISE_MAX`] | 0 | 0.27 | along a line 99 % below 1 cycle per unit of length, half of it above 0.33 |
//! | [`fbm`] of 5 octaves | within ±[`NOISE_MAX`] | 0 | 0.16 | octave k the same at 2ᵏ times the cycles, with `gain`²ᵏ of the power |
//! | [`turbulence`] of 5 octaves | 0 to [`NOISE_MAX`] | 0.22 | 0.09 | the same octaves, with creases where a summand is 0 |
//!
//! The lattice has the corners at whole coordinates; they are taken modulo 2³², so the fields repeat
//! after 2³² units. A float so large that it has no fraction is a corner, where [`noise`] is 0; so
//! is one that is not finite.
//!
//! Sources: K. Perlin, "Improving Noise" (2002), with its fade curve of fifth degree and its twelve gradients,
//! which need no multiplication; the corners are hashed by C. Wellons' `lowbias32` ("Prospecting for Hash
//! Functions", 2018) instead of a table. Sums of octaves: F. K. Musgrave in Ebert et al., *Texturing and
//! Modeling* (2003), chapter 16.

use crate::scalar::{Number, Scalar, Vector};

/// The most octaves of a sum.
pub const OCTAVES_MAX: u8 = 10;

/// The greatest magnitude of [`noise`], rounded up.
pub const NOISE_MAX: f64 = 1.0364;

/// A sum of noise at scales that halve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Octaves<S> {
    /// How many; 1 to [`OCTAVES_MAX`].
    pub count: u8,
    /// The strength of each over that of the one before; 0 to 1.
    pub gain: S,
}

impl<S: Scalar> Octaves<S> {
    /// One octave.
    pub const ONE: Self = Self { count: 1, gain: S::HALF };

    /// So many octaves, each half as strong as the one before.
    pub const fn new(count: u8) -> Self {
        Self { count, gain: S::HALF }
    }
}

/// A value of a field, and its slope along each axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Slope<S: Scalar> {
    /// The value.
    pub value: S,
    /// How fast it grows along x, y and z.
    pub gradient: S::Vec3,
}

/// Every bit of the result depends on every bit of `h`.
pub(crate) const fn mix(mut h: u32) -> u32 {
    h ^= h >> 16;
    h = h.wrapping_mul(0x7feb_352d);
    h ^= h >> 15;
    h = h.wrapping_mul(0x846c_a68b);
    h ^ (h >> 16)
}

/// The hash of a cell, or of a corner of the lattice.
pub(crate) const fn hash_cell([x, y, z]: [u32; 3], seed: u32) -> u32 {
    mix(mix(mix(seed.wrapping_add(x)).wrapping_add(y)).wrapping_add(z))
}

/// A number in 0..1 in steps of 2⁻¹⁰ from ten bits of a hash.
pub(crate) fn tenth_bits<S: Scalar>(hash: u32, shift: u32) -> S {
    S::from_i32((hash >> shift & 1023) as i32) * S::HALF.powi(10)
}

/// A point as a cell of the lattice and the place in the cell.
#[derive(Clone, Copy)]
pub(crate) struct Lattice<S> {
    /// The corner of the cell with the least coordinates, modulo 2³².
    pub(crate) cell: [u32; 3],
    /// How far the point lies from there; in 0..=1.
    pub(crate) within: [S; 3],
}

impl<S: Scalar> Lattice<S> {
    pub(crate) fn of(p: S::Vec3) -> Self {
        let p = p.to_array();
        let within = p.map(|v| {
            let fraction = v - v.floor();
            if fraction.is_finite() { fraction } else { S::ZERO }
        });
        Self { cell: p.map(|v| v.floor_i64() as u32), within }
    }

    /// The point twice as far from the origin, exactly, and moved by a part of a cell: else the corners
    /// of all octaves would lie on each other.
    fn next_octave(&self) -> Self {
        let parts = [11, 19, 27].map(|n| S::from_i32(n) * S::HALF.powi(5));
        let mut next = *self;
        for ((cell, within), part) in next.cell.iter_mut().zip(&mut next.within).zip(parts) {
            *cell = cell.wrapping_mul(2);
            *within += *within;
            for step in [S::ZERO, part] {
                *within += step;
                if !(*within < S::ONE) {
                    *within -= S::ONE;
                    *cell = cell.wrapping_add(1);
                }
            }
        }
        next
    }

    /// The hashes of the eight corners: x changes first.
    fn corners(&self, seed: u32) -> [u32; 8] {
        let [x, y, z] = self.cell;
        let next = |v: u32| v.wrapping_add(1);
        let (x0, x1) = (mix(seed.wrapping_add(x)), mix(seed.wrapping_add(next(x))));
        let below = |h: u32| mix(h.wrapping_add(y));
        let above = |h: u32| mix(h.wrapping_add(next(y)));
        let [a, b, c, d] = [below(x0), below(x1), above(x0), above(x1)];
        let near = |h: u32| mix(h.wrapping_add(z));
        let far = |h: u32| mix(h.wrapping_add(next(z)));
        [near(a), near(b), near(c), near(d), far(a), far(b), far(c), far(d)]
    }

    /// The point as seen from the eight corners, in the same order.
    fn seen_from_corners(&self) -> [[S; 3]; 8] {
        let [x, y, z] = self.within;
        let (far_x, far_y, far_z) = (x - S::ONE, y - S::ONE, z - S::ONE);
        [
            [x, y, z],
            [far_x, y, z],
            [x, far_y, z],
            [far_x, far_y, z],
            [x, y, far_z],
            [far_x, y, far_z],
            [x, far_y, far_z],
            [far_x, far_y, far_z],
        ]
    }
}

/// Which of the twelve gradients, from the middle of a cube to the middles of its edges: the two
/// axes that it has a part along (1 or −1), by the one that it has none along.
fn edge(hash: u32) -> (u32, bool, bool) {
    let edge = ((hash >> 8) * 12) >> 24;
    (edge >> 2, edge & 1 == 1, edge & 2 == 2)
}

fn signed<S: Number>(negative: bool, v: S) -> S {
    if negative { -v } else { v }
}

/// The gradient of a corner times the point as seen from it.
fn slant<S: Scalar>(hash: u32, [x, y, z]: [S; 3]) -> S {
    let (across, first, second) = edge(hash);
    let (a, b) = match across {
        0 => (y, z),
        1 => (z, x),
        _ => (x, y),
    };
    signed(first, a) + signed(second, b)
}

fn gradient_of<S: Scalar>(hash: u32) -> S::Vec3 {
    let (across, first, second) = edge(hash);
    let (a, b) = (signed(first, S::ONE), signed(second, S::ONE));
    match across {
        0 => S::Vec3::new(S::ZERO, a, b),
        1 => S::Vec3::new(b, S::ZERO, a),
        _ => S::Vec3::new(a, b, S::ZERO),
    }
}

/// 6t⁵ − 15t⁴ + 10t³: from 0 to 1 with no slope and no bend at either end.
fn fade<S: Scalar>(t: S) -> S {
    let inner = t * (t * S::from_i32(6) - S::from_i32(15)) + S::from_i32(10);
    t * t * (t * inner)
}

/// 30t⁴ − 60t³ + 30t²
fn fade_slope<S: Scalar>(t: S) -> S {
    (t * (t - S::ONE)).squared() * S::from_i32(30)
}

/// Eight values at the corners of a cell, mixed.
fn mixed<T, S: Scalar>([x, y, z]: [S; 3], v: [T; 8]) -> T
where
    T: Copy
        + core::ops::Add<Output = T>
        + core::ops::Sub<Output = T>
        + core::ops::Mul<S, Output = T>,
{
    let between = |t: S, a: T, b: T| a + (b - a) * t;
    let [a, b, c, d, e, f, g, h] = v;
    let near = between(y, between(x, a, b), between(x, c, d));
    let far = between(y, between(x, e, f), between(x, g, h));
    between(z, near, far)
}

#[inline(never)]
fn lattice_noise<S: Scalar>(at: &Lattice<S>, seed: u32) -> S {
    let (corners, seen) = (at.corners(seed), at.seen_from_corners());
    let mut values = [S::ZERO; 8];
    for ((value, hash), from) in values.iter_mut().zip(corners).zip(seen) {
        *value = slant(hash, from);
    }
    mixed(at.within.map(fade), values)
}

#[inline(never)]
fn lattice_slope<S: Scalar>(at: &Lattice<S>, seed: u32) -> Slope<S> {
    let (corners, seen) = (at.corners(seed), at.seen_from_corners());
    let (mut values, mut gradients) = ([S::ZERO; 8], [S::Vec3::ZERO; 8]);
    let slots = values.iter_mut().zip(&mut gradients);
    for (((value, gradient), hash), from) in slots.zip(corners).zip(seen) {
        (*value, *gradient) = (slant(hash, from), gradient_of::<S>(hash));
    }
    let [x, y, z] = at.within.map(fade);
    let [dx, dy, dz] = at.within.map(fade_slope);
    // How the value changes from one side of the cell to the other.
    let [a, b, c, d, e, f, g, h] = values;
    let flat = |u: S, v: S, [a, b, c, d]: [S; 4]| {
        let (low, high) = (a + (b - a) * u, c + (d - c) * u);
        low + (high - low) * v
    };
    let across = S::Vec3::new(
        dx * flat(y, z, [b - a, d - c, f - e, h - g]),
        dy * flat(x, z, [c - a, d - b, g - e, h - f]),
        dz * flat(x, y, [e - a, f - b, g - c, h - d]),
    );
    Slope { value: mixed([x, y, z], values), gradient: mixed([x, y, z], gradients) + across }
}

/// Gradient noise: smooth, without any direction that stands out, 0 at the corners of the lattice.
///
/// Continuous with its first and second derivatives. For the range and the mean see [the module](self).
pub fn noise<S: Scalar>(p: S::Vec3, seed: u32) -> S {
    lattice_noise(&Lattice::of(p), seed)
}

/// [`noise`] with its gradient, each component of which is within ±4.
pub fn noise_slope<S: Scalar>(p: S::Vec3, seed: u32) -> Slope<S> {
    lattice_slope(&Lattice::of(p), seed)
}

/// The sum of what `each` makes of the octaves of a point and their scales (1, 2, 4, …), each times its
/// strength, over the sum of the strengths.
fn octaves<S: Scalar, T>(
    p: S::Vec3,
    octaves: &Octaves<S>,
    zero: T,
    mut each: impl FnMut(&Lattice<S>, u32, S) -> T,
) -> T
where
    T: Copy + core::ops::Add<Output = T> + core::ops::Mul<S, Output = T>,
{
    let mut at = Lattice::of(p);
    let (mut strength, mut scale) = (S::ONE, S::ONE);
    let (mut sum, mut whole) = (zero, S::ZERO);
    for octave in 0..octaves.count.min(OCTAVES_MAX) {
        if octave > 0 {
            at = at.next_octave();
        }
        sum = sum + each(&at, u32::from(octave), scale) * strength;
        whole += strength;
        strength *= octaves.gain;
        scale += scale;
    }
    if whole > S::ONE { sum * (S::ONE / whole) } else { sum }
}

/// The seed of an octave: octaves of one field have nothing in common.
fn seed_of(seed: u32, octave: u32) -> u32 {
    seed ^ octave.wrapping_mul(0x9e37_79b9)
}

/// Fractional Brownian motion: octaves of [`noise`] at half the scale each, over the sum of their strengths.
#[inline(never)]
pub fn fbm<S: Scalar>(p: S::Vec3, seed: u32, sum: &Octaves<S>) -> S {
    octaves(p, sum, S::ZERO, |at, octave, _| lattice_noise(at, seed_of(seed, octave)))
}

/// Turbulence: the same with the magnitude of each octave.
#[inline(never)]
pub fn turbulence<S: Scalar>(p: S::Vec3, seed: u32, sum: &Octaves<S>) -> S {
    octaves(p, sum, S::ZERO, |at, octave, _| lattice_noise(at, seed_of(seed, octave)).abs())
}

/// [`fbm`] with its gradient.
#[inline(never)]
pub fn fbm_slope<S: Scalar>(p: S::Vec3, seed: u32, sum: &Octaves<S>) -> Slope<S> {
    let zero = Slope { value: S::ZERO, gradient: S::Vec3::ZERO };
    octaves(p, sum, zero, |at, octave, scale| {
        let Slope { value, gradient } = lattice_slope(at, seed_of(seed, octave));
        Slope { value, gradient: gradient * scale }
    })
}

/// [`turbulence`] with its gradient; at a crease that of either side.
#[inline(never)]
pub fn turbulence_slope<S: Scalar>(p: S::Vec3, seed: u32, sum: &Octaves<S>) -> Slope<S> {
    let zero = Slope { value: S::ZERO, gradient: S::Vec3::ZERO };
    octaves(p, sum, zero, |at, octave, scale| {
        let Slope { value, gradient } = lattice_slope(at, seed_of(seed, octave));
        let scale = signed(value < S::ZERO, scale);
        Slope { value: value.abs(), gradient: gradient * scale }
    })
}

impl<S: Scalar> core::ops::Add for Slope<S> {
    type Output = Self;
    #[inline]
    fn add(self, other: Self) -> Self {
        Self { value: self.value + other.value, gradient: self.gradient + other.gradient }
    }
}

impl<S: Scalar> core::ops::Mul<S> for Slope<S> {
    type Output = Self;
    #[inline]
    fn mul(self, factor: S) -> Self {
        Self { value: self.value * factor, gradient: self.gradient * factor }
    }
}
