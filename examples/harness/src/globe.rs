//! The map of a world that is not there: seas, shelves, land from sand to snow, and ice at the poles.

use nostray::glam::DVec3;
use nostray::texture::noise::{fbm, turbulence};
use nostray::{Number, Octaves, Transfer};

use crate::moves::sin_cos_degrees;

/// A colour of the land or of the sea, and the height from which on it holds; linear.
type Zone = (f64, [f64; 3]);

const SEA: &[Zone] =
    &[(-0.30, [0.004, 0.018, 0.075]), (-0.10, [0.008, 0.045, 0.15]), (0.0, [0.05, 0.21, 0.31])];

const LAND: &[Zone] = &[
    (0.0, [0.44, 0.37, 0.22]),
    (0.03, [0.09, 0.20, 0.035]),
    (0.12, [0.05, 0.13, 0.025]),
    (0.20, [0.22, 0.17, 0.09]),
    (0.30, [0.33, 0.29, 0.25]),
    (0.40, [0.85, 0.87, 0.9]),
];

const DESERT: [f64; 3] = [0.50, 0.36, 0.17];
const ICE: [f64; 3] = [0.86, 0.90, 0.94];

/// The sRGB bytes of the map, twice as wide as high: longitude to the right, the north pole above.
pub(crate) fn globe(width: u16) -> Vec<u8> {
    let height = width / 2;
    let mut bytes = Vec::with_capacity(usize::from(width) * usize::from(height) * 3);
    for row in 0..height {
        let latitude = 90.0 - (f64::from(row) + 0.5) / f64::from(height) * 180.0;
        for column in 0..width {
            let longitude = (f64::from(column) + 0.5) / f64::from(width) * 360.0 - 180.0;
            let color = ground(longitude, latitude);
            bytes.extend(color.map(|part| {
                // In units of 2⁻³².
                Transfer::Srgb.encode((part * 4_294_967_295.0) as u32)
            }));
        }
    }
    bytes
}

/// The colour of the ground.
fn ground(longitude: f64, latitude: f64) -> [f64; 3] {
    let ((east, toward), (up, out)) = (sin_cos_degrees(longitude), sin_cos_degrees(latitude));
    let p = DVec3::new(toward * out, up, east * out);
    let coast = fbm::<f64>(p * 1.4, 21, &Octaves { count: 8, gain: 0.62 }) * 1.6;
    let ridges = 0.5 - turbulence::<f64>(p * 3.5, 5, &Octaves::new(6)) * 1.6;
    let height = coast - 0.02;
    let rough = fbm::<f64>(p * 7.0, 9, &Octaves::new(6));
    let land = height + if height > 0.0 { ridges * Number::min(height * 3.0, 0.5) } else { 0.0 };
    let mut color =
        if height > 0.0 { zoned(LAND, land + rough * 0.03) } else { zoned(SEA, height) };
    // Dry belts on both sides of the equator.
    let north = up.abs();
    if height > 0.0 {
        let dry = smooth(0.22, 0.42, north) * (1.0 - smooth(0.45, 0.62, north));
        let dry = dry * (1.0 - smooth(0.18, 0.3, land)) * (0.75 + rough);
        color = mixed(color, DESERT, Number::clamp(dry, 0.0, 0.9));
    }
    let edge = north + rough * 0.12 + if height > 0.0 { 0.05 } else { 0.0 };
    mixed(color, ICE, smooth(0.86, 0.92, edge))
}

/// The colour of a height.
fn zoned(zones: &[Zone], height: f64) -> [f64; 3] {
    let mut color = zones.first().map_or([0.0; 3], |zone| zone.1);
    for pair in zones.windows(2) {
        if let [(from, _), (to, next)] = pair {
            color = mixed(color, *next, share(*from, *to, height));
        }
    }
    color
}

fn mixed(a: [f64; 3], b: [f64; 3], share: f64) -> [f64; 3] {
    let mut color = a;
    for (part, other) in color.iter_mut().zip(b) {
        *part += (other - *part) * share;
    }
    color
}

/// From 0 to 1 between two ends, without a bend at either.
fn smooth(from: f64, to: f64, v: f64) -> f64 {
    let share = share(from, to, v);
    share * share * (3.0 - 2.0 * share)
}

/// From 0 to 1 between two ends.
fn share(from: f64, to: f64, v: f64) -> f64 {
    Number::clamp((v - from) / (to - from), 0.0, 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_map_is_a_world_with_seas_land_and_ice() {
        let map = globe(64);
        assert_eq!(map.len(), 64 * 32 * 3);
        let pixels: Vec<&[u8]> = map.chunks(3).collect();
        let blue = pixels.iter().filter(|p| p[2] > p[0] && p[0] < 120).count();
        let white = pixels.iter().filter(|p| p.iter().all(|part| *part > 215)).count();
        let land = pixels.len() - blue - white;
        assert!(blue > 600 && land > 400 && white > 200, "{blue} {land} {white}");
        // The seam is no sharper than the sharpest coast.
        let gap = |a: &[u8], b: &[u8]| a.iter().zip(b).map(|(a, b)| a.abs_diff(*b)).max();
        let coasts = pixels.chunks(64).flat_map(|row| row.windows(2));
        let sharpest = coasts.map(|pair| gap(pair[0], pair[1])).max().flatten();
        for row in 0..32 {
            let (left, right) = (pixels[row * 64], pixels[row * 64 + 63]);
            assert!(gap(left, right) <= sharpest, "row {row}: {left:?} {right:?}, {sharpest:?}");
        }
    }
}
