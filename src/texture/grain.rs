//! Stone, wood, water and skin: sums of noise and waves.

use super::noise::{Octaves, fbm, mix, tenth_bits, turbulence};
use super::pattern::{Stroke, length, parts, sine};
use crate::scalar::{Scalar, Vector};

/// How far a place lies from the y axis, in rings that noise moves.
pub(super) fn wood<S: Scalar>([x, y, z]: [S; 3], wobble: S, stroke: &Stroke<S>) -> S {
    let rings = length::<S>(S::Vec3::new(x, S::ZERO, z));
    if wobble == S::ZERO {
        return rings;
    }
    // Over a few rings the noise stays the same, and along the trunk over many more.
    let (across, along) = (S::HALF.powi(2), S::HALF.powi(5));
    let along = S::Vec3::new(x * across, y * along, z * across);
    rings + fbm(along, stroke.seed, &stroke.octaves) * wobble
}

/// How far turbulence moves something.
pub(super) fn stir<S: Scalar>(p: S::Vec3, strength: S, stroke: &Stroke<S>) -> S {
    if strength == S::ZERO {
        return S::ZERO;
    }
    turbulence(p, stroke.seed, &stroke.octaves) * strength
}

/// A wave whose crests are broader than its troughs.
pub(super) fn agate<S: Scalar>(turns: S) -> S {
    let v = (sine(turns) + S::ONE) * S::HALF;
    v * (S::TWO - v)
}

/// The square of the mean of three sines.
pub(super) fn leopard<S: Scalar>(p: [S; 3]) -> S {
    let [x, y, z] = p.map(sine);
    ((x + y + z) * parts(5461)).squared()
}

/// 1 less the cube of twice the noise, where it is positive; and the slope by the noise.
pub(super) fn dent<S: Scalar>(noise: S) -> (S, S) {
    let twice = noise.max(S::ZERO) * S::TWO;
    let square = twice * twice;
    (S::ONE - square * twice, -square * S::from_i32(6))
}

/// Where ten waves go, and how many there are to a unit of length, in 1024ths: around +x, less and less
/// regular.
const WAVES: [[i16; 2]; 10] = [
    [1024, 0],
    [1063, 801],
    [1447, -769],
    [853, 1749],
    [1351, -1929],
    [2683, 669],
    [497, 3135],
    [3606, -766],
    [2754, 3169],
    [1246, -4649],
];

/// The sum of what is added for each octave, times its strength, over the sum of the strengths.
fn weighted<S: Scalar>(octaves: &Octaves<S>, mut each: impl FnMut(u32) -> S) -> S {
    let (mut strength, mut sum, mut whole) = (S::ONE, S::ZERO, S::ZERO);
    for n in 0..octaves.count.min(WAVES.len() as u8) {
        sum += each(u32::from(n)) * strength;
        whole += strength;
        strength *= octaves.gain;
    }
    if whole > S::ONE { sum / whole } else { sum }
}

/// Plane waves, each shorter and, by the gain, lower than the one before.
#[inline(never)]
pub(super) fn waves<S: Scalar>(x: S, z: S, stroke: &Stroke<S>) -> S {
    let mut waves = WAVES.iter();
    weighted(&stroke.octaves, |n| {
        let [along, across] = *waves.next().unwrap_or(&[0; 2]);
        let part = |n: i16| S::from_i32(i32::from(n)) * S::HALF.powi(10);
        let phase = tenth_bits::<S>(mix(stroke.seed.wrapping_add(n)), 0);
        sine(x * part(along) + z * part(across) + phase)
    })
}

/// Waves in rings, around the origin and around points within four units of it along x and z.
#[inline(never)]
pub(super) fn ripples<S: Scalar>(p: S::Vec3, stroke: &Stroke<S>) -> S {
    weighted(&stroke.octaves, |n| {
        let hash = mix(stroke.seed.wrapping_add(n));
        let part = |shift: u32| (tenth_bits::<S>(hash, shift) - S::HALF) * S::from_i32(8);
        let centre = match n {
            0 => S::Vec3::ZERO,
            _ => S::Vec3::new(part(0), S::ZERO, part(10)),
        };
        sine(length::<S>(p - centre))
    })
}
