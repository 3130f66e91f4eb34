//! Images whose bytes lie in flash.

use super::mapping::Wrap;
use crate::color::{Rgb, Transfer};
use crate::scalar::Scalar;

/// How the pixels of an image are stored, from left to right and from top to bottom.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// Three bytes: red, green and blue.
    Rgb8,
    /// One byte.
    Grey8,
    /// Two bytes, the high one first: five bits of red, six of green, five of blue.
    Rgb565,
    /// One bit, the highest of a byte first, 1 for white; each row begins with a new byte.
    Mono1,
}

impl Format {
    /// The bytes of a row of so many pixels.
    pub const fn row_bytes(self, width: u16) -> u32 {
        let width = width as u32;
        match self {
            Self::Rgb8 => width * 3,
            Self::Grey8 => width,
            Self::Rgb565 => width * 2,
            Self::Mono1 => width.div_ceil(8),
        }
    }
}

/// What lies between the middles of pixels.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Filter {
    /// The colour of the nearest pixel.
    Nearest,
    /// A mixture of the four around.
    #[default]
    Bilinear,
}

/// An image: where its bytes lie among those of all, and what they mean.
///
/// Its pixels fill the square from (0, 0), at the left below, to (1, 1).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Image {
    /// The first of its bytes.
    pub first: u32,
    /// Pixels from left to right; at least 1.
    pub width: u16,
    /// Pixels from top to bottom; at least 1.
    pub height: u16,
    /// How pixels are stored.
    pub format: Format,
    /// How the stored numbers stand for light.
    pub transfer: Transfer,
}

impl Image {
    /// How many bytes it has; `None` beyond 2³².
    pub fn bytes(&self) -> Option<u32> {
        self.format.row_bytes(self.width).checked_mul(u32::from(self.height))
    }

    /// The light of a pixel, by its column and its row from the top; black beyond the image.
    fn pixel<S: Scalar>(&self, pixels: &[u8], column: u32, row: u32) -> Rgb<S> {
        let start =
            self.first.saturating_add(row.saturating_mul(self.format.row_bytes(self.width)));
        let byte = |n: u32| pixels.get(start.saturating_add(n) as usize).copied().unwrap_or(0);
        let light = |code: u8| {
            let units = self.transfer.decode(code);
            // In two parts, each of which every format holds exactly.
            let low = S::from_i32((units & 1023) as i32) * S::HALF.powi(10);
            (S::from_i32((units >> 10) as i32) + low) * S::HALF.powi(14)
        };
        match self.format {
            Format::Rgb8 => {
                let at = column.saturating_mul(3);
                Rgb::new(light(byte(at)), light(byte(at + 1)), light(byte(at + 2)))
            }
            Format::Grey8 => {
                let grey = light(byte(column));
                Rgb::new(grey, grey, grey)
            }
            Format::Rgb565 => {
                let at = column.saturating_mul(2);
                let [high, low] = [byte(at), byte(at + 1)];
                let (red, blue) = (high >> 3, low & 31);
                let green = (high & 7) << 3 | low >> 5;
                let five = |v: u8| light(v << 3 | v >> 2);
                Rgb::new(five(red), light(green << 2 | green >> 4), five(blue))
            }
            Format::Mono1 => {
                let white = byte(column >> 3) >> (7 - (column & 7)) & 1 == 1;
                if white { Rgb::WHITE } else { Rgb::BLACK }
            }
        }
    }

    /// The colour at a place, and the number of the pixel where the filter is [`Nearest`](Filter::Nearest).
    pub(super) fn at<S: Scalar>(
        &self,
        pixels: &[u8],
        [u, v]: [S; 2],
        filter: Filter,
        wrap: [Wrap; 2],
    ) -> (Rgb<S>, u32) {
        let (width, height) = (u32::from(self.width), u32::from(self.height));
        // From the top, as rows are counted.
        let v = S::ONE - fold(v, wrap[1]);
        let [x, y] = [(fold(u, wrap[0]), width), (v, height)]
            .map(|(part, of)| part * S::from_i32(of as i32));
        if filter == Filter::Nearest {
            let (column, row) = (index(x, width), index(y, height));
            return (self.pixel(pixels, column, row), row.wrapping_mul(width).wrapping_add(column));
        }
        let (left, right, x) = neighbours(x, width, wrap[0]);
        let (top, bottom, y) = neighbours(y, height, wrap[1]);
        let row = |row: u32| {
            let (a, b) = (self.pixel(pixels, left, row), self.pixel(pixels, right, row));
            mix(a, b, x)
        };
        (mix(row(top), row(bottom), y), 0)
    }
}

/// A coordinate brought into 0..=1. An image repeats where nothing else is said.
fn fold<S: Scalar>(v: S, wrap: Wrap) -> S {
    let wrap = if wrap == Wrap::Endless { Wrap::Repeat } else { wrap };
    wrap.fold(v)
}

/// `a` and `b` in proportion.
fn mix<S: Scalar>(a: Rgb<S>, b: Rgb<S>, share: S) -> Rgb<S> {
    a * (S::ONE - share) + b * share
}

/// The pixel that a place in 0..=`count` lies in.
fn index<S: Scalar>(v: S, count: u32) -> u32 {
    let index = u32::try_from(v.floor_i64()).unwrap_or(0);
    index.min(count.saturating_sub(1))
}

/// The two pixels whose middles a place lies between, and how far it is from the first.
fn neighbours<S: Scalar>(v: S, count: u32, wrap: Wrap) -> (u32, u32, S) {
    let from = v - S::HALF;
    let share = from - from.floor();
    let last = count.saturating_sub(1);
    let around = matches!(wrap, Wrap::Endless | Wrap::Repeat);
    let before = from.floor_i64();
    let first = match u32::try_from(before) {
        Ok(first) => first.min(last),
        Err(_) if around => last,
        Err(_) => 0,
    };
    let second = if before < 0 {
        0
    } else if first < last {
        first + 1
    } else if around {
        0
    } else {
        last
    };
    (first, second, share)
}

#[cfg(test)]
mod tests {
    use super::*;

    const SQUARE: Image =
        Image { first: 1, width: 2, height: 2, format: Format::Grey8, transfer: Transfer::Linear };
    /// The rows 0, 255 and 102, 51 behind a byte of another image.
    const GREYS: [u8; 5] = [77, 0, 255, 102, 51];

    fn grey(u: f64, v: f64, filter: Filter, wrap: Wrap) -> f64 {
        SQUARE.at::<f64>(&GREYS, [u, v], filter, [wrap; 2]).0.r
    }

    fn near(a: f64, b: f64) -> bool {
        (a - b).abs() <= 1e-6
    }

    #[test]
    fn pixels_stand_where_they_are_said_to() {
        let nearest = |u, v| grey(u, v, Filter::Nearest, Wrap::Repeat);
        assert!(near(nearest(0.2, 0.9), 0.0) && near(nearest(0.7, 0.9), 1.0));
        assert!(near(nearest(0.2, 0.2), 0.4) && near(nearest(0.7, 0.2), 0.2));
        for (u, v) in [(1.2, 0.9), (-0.8, -0.1), (3.2, 5.9)] {
            assert!(near(nearest(u, v), 0.0));
        }
        let mirror = |u, v| grey(u, v, Filter::Nearest, Wrap::Mirror);
        assert!(near(mirror(1.2, 0.9), 1.0) && near(mirror(-0.2, -0.2), 0.4));
        let clamp = |u, v| grey(u, v, Filter::Nearest, Wrap::Clamp);
        assert!(near(clamp(9.0, 9.0), 1.0) && near(clamp(-9.0, -9.0), 0.4));
    }

    #[test]
    fn between_pixels_there_is_a_mixture() {
        for (wrap, edge) in [(Wrap::Repeat, 0.5), (Wrap::Clamp, 0.0), (Wrap::Mirror, 0.0)] {
            let at = |u, v| grey(u, v, Filter::Bilinear, wrap);
            assert!(near(at(0.25, 0.75), 0.0) && near(at(0.75, 0.75), 1.0));
            assert!(near(at(0.5, 0.75), 0.5) && near(at(0.25, 0.5), 0.2));
            assert!(near(at(0.5, 0.5), 0.4));
            assert!(near(at(0.0, 0.75), edge), "{wrap:?}");
        }
        // The seam of a repeated image has no step.
        for v in [0.1, 0.5, 0.9, 0.0, 1.0] {
            let at = |u| grey(u, v, Filter::Bilinear, Wrap::Endless);
            assert!(near(at(1e-9), at(1.0 - 1e-9)) && at(0.0) == at(1.0));
        }
    }

    #[test]
    fn formats_are_read_as_they_are_written() {
        let with = |format, width| Image {
            first: 0,
            width,
            height: 1,
            format,
            transfer: Transfer::Linear,
        };
        let pixel = |image: Image, bytes: &[u8], column| {
            image.pixel::<f64>(bytes, column, 0).to_array().map(|v| (v * 255.0 + 0.5) as u8)
        };
        let rgb = with(Format::Rgb8, 2);
        assert_eq!(pixel(rgb, &[1, 2, 3, 4, 5, 6], 1), [4, 5, 6]);
        // 10110 110011 01101
        let small = with(Format::Rgb565, 1);
        assert_eq!(pixel(small, &[0b1011_0110, 0b0110_1101], 0), [181, 207, 107]);
        let mono = with(Format::Mono1, 10);
        assert_eq!(mono.bytes(), Some(2));
        let bits: [u8; 10] =
            core::array::from_fn(|n| pixel(mono, &[0b0100_0001, 0b1000_0000], n as u32)[0] / 255);
        assert_eq!(bits, [0, 1, 0, 0, 0, 0, 0, 1, 1, 0]);
        let curved = Image { transfer: Transfer::Srgb, ..with(Format::Grey8, 1) };
        assert!(near(curved.pixel::<f64>(&[188], 0, 0).r, 0.502_886));
    }

    #[test]
    fn any_place_has_a_colour() {
        for filter in [Filter::Nearest, Filter::Bilinear] {
            for wrap in [Wrap::Endless, Wrap::Repeat, Wrap::Mirror, Wrap::Clamp] {
                for v in [0.0, -0.0, 1.0, 1e-17, -1e-17, 0.999_999_999_999_999_9, 1e15, -1e15] {
                    let (color, _) = SQUARE.at::<f64>(&GREYS, [v, v], filter, [wrap; 2]);
                    assert!(color.r >= 0.0 && color.r <= 1.0, "{v}: {color:?}");
                }
            }
        }
    }
}
