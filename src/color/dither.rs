//! Few levels that look like many: ordered dithering.

/// How light is brought to the levels that a display has.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Dither {
    /// To the nearest level, everywhere alike.
    Off,
    /// To the one above or below, by the place in a pattern of 8×8 pixels: their mean is the level that
    /// the display lacks. A pixel depends on nothing but its own light and place.
    ///
    /// Source: B. E. Bayer, "An optimum method for two-level rendition of continuous-tone
    /// pictures" (1973).
    #[default]
    Ordered,
}

impl Dither {
    /// The level in `0..=max` for a byte at a place: 0 for 0, `max` for 255, and those between in
    /// equal steps.
    #[inline]
    pub const fn level(self, byte: u8, max: u8, x: u32, y: u32) -> u8 {
        // In 255ths of a level; the offset is less than one level.
        let offset = match self {
            Self::Off => 127,
            Self::Ordered => (2 * bayer(x, y) + 1) * 255 / 128,
        };
        ((byte as u32 * max as u32 + offset) / 255) as u8
    }
}

/// The luma of Rec. 709 of three bytes, rounded.
pub const fn luma([red, green, blue]: [u8; 3]) -> u8 {
    ((54 * red as u32 + 183 * green as u32 + 19 * blue as u32 + 128) >> 8) as u8
}

/// The place of a pixel in the order of 8×8 in which they light up, in 0..64: the bits of x ⊕ y and
/// of y by turns, the lowest first.
const fn bayer(x: u32, y: u32) -> u32 {
    let (mut across, mut along) = (x ^ y, y);
    let (mut order, mut step) = (0, 0);
    while step < 3 {
        order = order << 2 | (across & 1) << 1 | (along & 1);
        across >>= 1;
        along >>= 1;
        step += 1;
    }
    order
}

#[cfg(test)]
mod tests {
    extern crate std;
    use std::collections::BTreeSet;

    use super::*;

    const PLACES: u32 = 8;

    #[test]
    fn the_pattern_holds_every_number_once_and_repeats() {
        let all: BTreeSet<u32> =
            (0..64).map(|place| bayer(place % PLACES, place / PLACES)).collect();
        assert_eq!(all, (0..64).collect());
        assert_eq!(bayer(3, 5), bayer(11, 21));
        // The beginning of the pattern, as it is printed in textbooks.
        let first: std::vec::Vec<u32> = (0..4).map(|x| bayer(x, 0)).collect();
        assert_eq!(first, [0, 32, 8, 40]);
    }

    #[test]
    fn the_mean_of_a_pattern_is_the_light() {
        for max in [1, 3, 15, 31, 63, 255] {
            for byte in 0..=255 {
                let levels = (0..64).map(|place| {
                    u32::from(Dither::Ordered.level(byte, max, place % PLACES, place / PLACES))
                });
                let mean = f64::from(levels.sum::<u32>()) / 64.0;
                let exact = f64::from(byte) * f64::from(max) / 255.0;
                assert!((mean - exact).abs() <= 1.0 / 64.0, "{byte} of {max}: {mean}, {exact}");
            }
        }
    }

    #[test]
    fn black_white_and_every_level_of_the_display_stay() {
        for dither in [Dither::Off, Dither::Ordered] {
            for place in 0..64 {
                let (x, y) = (place % PLACES, place / PLACES);
                for max in [1, 3, 15, 255] {
                    // These divide 255, so that a byte is exactly a level.
                    for level in 0..=max {
                        assert_eq!(dither.level(level * (255 / max), max, x, y), level);
                    }
                }
                assert_eq!(dither.level(0, 31, x, y), 0);
                assert_eq!(dither.level(255, 31, x, y), 31);
            }
        }
    }

    #[test]
    fn without_dithering_the_nearest_level_is_taken() {
        for max in [1_u8, 3, 15, 31, 63] {
            for byte in 0..=255_u8 {
                let exact = f64::from(byte) * f64::from(max) / 255.0;
                let level = f64::from(Dither::Off.level(byte, max, 5, 9));
                assert!((level - exact).abs() <= 0.5, "{byte} of {max}");
            }
        }
    }

    #[test]
    fn grey_has_its_own_luma() {
        for byte in 0..=255 {
            assert_eq!(luma([byte; 3]), byte);
        }
        assert!(luma([0, 255, 0]) > luma([255, 0, 0]) && luma([255, 0, 0]) > luma([0, 0, 255]));
    }
}
