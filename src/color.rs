//! Linear colour, and the bytes that a display wants.

mod dither;

pub use dither::{Dither, luma};

use core::ops::{Add, AddAssign, Mul};

use crate::scalar::Scalar;

/// A colour or an amount of light: linear red, green and blue.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Rgb<S> {
    /// Red.
    pub r: S,
    /// Green.
    pub g: S,
    /// Blue.
    pub b: S,
}

impl<S> Rgb<S> {
    /// The colour of three parts.
    pub const fn new(r: S, g: S, b: S) -> Self {
        Self { r, g, b }
    }
}

impl<S: Scalar> Rgb<S> {
    /// No light.
    pub const BLACK: Self = Self::new(S::ZERO, S::ZERO, S::ZERO);
    /// One of each.
    pub const WHITE: Self = Self::new(S::ONE, S::ONE, S::ONE);

    /// Each part by itself.
    #[inline]
    pub fn map(self, f: impl Fn(S) -> S) -> Self {
        Self::new(f(self.r), f(self.g), f(self.b))
    }

    /// The parts in order.
    #[inline]
    pub fn to_array(self) -> [S; 3] {
        [self.r, self.g, self.b]
    }

    /// The greatest part.
    #[inline]
    pub fn max_part(self) -> S {
        self.r.max(self.g).max(self.b)
    }

    /// Every part is finite.
    pub fn is_finite(self) -> bool {
        self.r.is_finite() && self.g.is_finite() && self.b.is_finite()
    }

    /// No light at all.
    #[inline]
    pub fn is_black(self) -> bool {
        self.r == S::ZERO && self.g == S::ZERO && self.b == S::ZERO
    }

    /// Three bytes, each part clamped to 0..=1 and sent through the transfer curve.
    pub fn to_rgb8(self, transfer: Transfer) -> [u8; 3] {
        self.to_array().map(|part| transfer.encode(part.to_unit_bits()))
    }
}

impl<S: Scalar> Add for Rgb<S> {
    type Output = Self;
    #[inline]
    fn add(self, other: Self) -> Self {
        Self::new(self.r + other.r, self.g + other.g, self.b + other.b)
    }
}

impl<S: Scalar> AddAssign for Rgb<S> {
    #[inline]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl<S: Scalar> Mul<S> for Rgb<S> {
    type Output = Self;
    #[inline]
    fn mul(self, factor: S) -> Self {
        self.map(|part| part * factor)
    }
}

impl<S: Scalar> Mul for Rgb<S> {
    type Output = Self;
    #[inline]
    fn mul(self, other: Self) -> Self {
        Self::new(self.r * other.r, self.g * other.g, self.b * other.b)
    }
}

/// How linear light becomes a byte.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Transfer {
    /// The curve of IEC 61966-2-1, to the nearest code.
    #[default]
    Srgb,
    /// In proportion, to the nearest code.
    Linear,
}

impl Transfer {
    /// The byte for a part of light in units of 2⁻³².
    pub fn encode(self, bits: u32) -> u8 {
        match self {
            Self::Srgb => {
                // The number of thresholds at or below: binary search over 255 of them.
                SRGB_THRESHOLDS.partition_point(|&threshold| threshold <= bits) as u8
            }
            Self::Linear => {
                let scaled = u64::from(bits) * 255 + (1 << 31);
                (scaled >> 32) as u8
            }
        }
    }

    /// The linear light of a byte, in units of 2⁻²⁴.
    pub fn decode(self, code: u8) -> u32 {
        match self {
            Self::Srgb => SRGB_LIGHT.get(usize::from(code)).copied().unwrap_or(0),
            Self::Linear => ((u32::from(code) << 24) + 127) / 255,
        }
    }
}

/// The linear light, in units of 2⁻³² and rounded up, from which on each code after 0 is the
/// nearest in sRGB: the inverse of the curve at (code − ½) / 255.
#[rustfmt::skip]
static SRGB_THRESHOLDS: [u32; 255] = [
    651820, 1955458, 3259097, 4562735, 5866374, 7170012, 8473651, 9777289,
    11080927, 12384566, 13693649, 15072155, 16528387, 18063551, 19678822, 21375354,
    23154273, 25016685, 26963674, 28996302, 31115614, 33322635, 35618372, 38003817,
    40479942, 43047709, 45708060, 48461926, 51310223, 54253855, 57293711, 60430671,
    63665601, 66999356, 70432781, 73966708, 77601962, 81339356, 85179694, 89123770,
    93172371, 97326272, 101586243, 105953043, 110427424, 115010131, 119701900, 124503460,
    129415534, 134438836, 139574075, 144821952, 150183163, 155658395, 161248333, 166953651,
    172775021, 178713107, 184768569, 190942061, 197234230, 203645720, 210177169, 216829209,
    223602469, 230497571, 237515134, 244655771, 251920091, 259308700, 266822197, 274461179,
    282226237, 290117958, 298136927, 306283723, 314558921, 322963093, 331496808, 340160629,
    348955118, 357880831, 366938322, 376128141, 385450834, 394906946, 404497016, 414221580,
    424081173, 434076325, 444207563, 454475412, 464880392, 475423022, 486103818, 496923292,
    507881954, 518980311, 530218867, 541598123, 553118579, 564780730, 576585071, 588532092,
    600622281, 612856125, 625234108, 637756710, 650424411, 663237686, 676197010, 689302855,
    702555690, 715955983, 729504198, 743200799, 757046245, 771040997, 785185510, 799480238,
    813925635, 828522150, 843270232, 858170327, 873222880, 888428333, 903787126, 919299699,
    934966488, 950787927, 966764451, 982896491, 999184475, 1015628832, 1032229988, 1048988367,
    1065904391, 1082978482, 1100211059, 1117602539, 1135153338, 1152863871, 1170734550, 1188765786,
    1206957989, 1225311567, 1243826925, 1262504470, 1281344605, 1300347730, 1319514248, 1338844556,
    1358339052, 1377998133, 1397822192, 1417811624, 1437966819, 1458288169, 1478776062, 1499430887,
    1520253029, 1541242873, 1562400803, 1583727203, 1605222452, 1626886930, 1648721017, 1670725088,
    1692899522, 1715244691, 1737760970, 1760448731, 1783308346, 1806340183, 1829544612, 1852922001,
    1876472715, 1900197120, 1924095581, 1948168459, 1972416118, 1996838917, 2021437216, 2046211374,
    2071161747, 2096288694, 2121592567, 2147073723, 2172732513, 2198569290, 2224584405, 2250778208,
    2277151048, 2303703273, 2330435229, 2357347263, 2384439720, 2411712943, 2439167276, 2466803060,
    2494620637, 2522620346, 2550802527, 2579167519, 2607715657, 2636447279, 2665362720, 2694462314,
    2723746395, 2753215296, 2782869348, 2812708883, 2842734230, 2872945718, 2903343676, 2933928431,
    2964700310, 2995659638, 3026806741, 3058141941, 3089665563, 3121377928, 3153279359, 3185370175,
    3217650697, 3250121244, 3282782134, 3315633684, 3348676211, 3381910032, 3415335461, 3448952812,
    3482762399, 3516764536, 3550959533, 3585347702, 3619929355, 3654704799, 3689674346, 3724838302,
    3760196976, 3795750674, 3831499703, 3867444367, 3903584973, 3939921822, 3976455220, 4013185468,
    4050112869, 4087237723, 4124560331, 4162080993, 4199800007, 4237717674, 4275834290,
];

/// The linear light of each code of sRGB, in units of 2⁻²⁴.
#[rustfmt::skip]
static SRGB_LIGHT: [u32; 256] = [
    0, 5092, 10185, 15277, 20369, 25462, 30554, 35646, 40739, 45831,
    50923, 56146, 61682, 67524, 73676, 80144, 86931, 94043, 101483, 109255,
    117364, 125813, 134607, 143749, 153244, 163095, 173306, 183880, 194821, 206133,
    217819, 229883, 242327, 255157, 268373, 281981, 295983, 310382, 325182, 340386,
    355996, 372016, 388449, 405298, 422565, 440255, 458369, 476910, 495881, 515286,
    535127, 555406, 576126, 597291, 618902, 640963, 663476, 686443, 709868, 733752,
    758099, 782910, 808189, 833938, 860159, 886854, 914027, 941680, 969814, 998433,
    1027538, 1057133, 1087218, 1117798, 1148873, 1180447, 1212520, 1245097, 1278179, 1311767,
    1345865, 1380475, 1415598, 1451237, 1487394, 1524071, 1561270, 1598994, 1637244, 1676023,
    1715332, 1755173, 1795550, 1836463, 1877915, 1919907, 1962442, 2005522, 2049149, 2093324,
    2138049, 2183328, 2229161, 2275550, 2322497, 2370005, 2418074, 2466708, 2515908, 2565675,
    2616012, 2666920, 2718402, 2770458, 2823092, 2876304, 2930097, 2984472, 3039432, 3094977,
    3151110, 3207832, 3265145, 3323052, 3381553, 3440650, 3500346, 3560641, 3621538, 3683038,
    3745144, 3807855, 3871176, 3935106, 3999648, 4064803, 4130573, 4196960, 4263965, 4331589,
    4399836, 4468706, 4538200, 4608321, 4679069, 4750448, 4822457, 4895099, 4968376, 5042288,
    5116838, 5192027, 5267856, 5344328, 5421443, 5499204, 5577611, 5656667, 5736372, 5816729,
    5897738, 5979402, 6061722, 6144699, 6228335, 6312631, 6397589, 6483210, 6569496, 6656448,
    6744068, 6832357, 6921317, 7010948, 7101253, 7192233, 7283889, 7376223, 7469237, 7562930,
    7657306, 7752366, 7848110, 7944540, 8041658, 8139465, 8237963, 8337152, 8437035, 8537612,
    8638885, 8740855, 8843524, 8946893, 9050964, 9155737, 9261215, 9367397, 9474287, 9581885,
    9690192, 9799210, 9908940, 10019383, 10130542, 10242416, 10355008, 10468318, 10582349, 10697100,
    10812575, 10928773, 11045697, 11163346, 11281724, 11400831, 11520668, 11641236, 11762538, 11884573,
    12007344, 12130852, 12255098, 12380082, 12505807, 12632274, 12759484, 12887438, 13016137, 13145583,
    13275776, 13406719, 13538412, 13670857, 13804054, 13938006, 14072712, 14208175, 14344396, 14481375,
    14619114, 14757615, 14896878, 15036905, 15177696, 15319253, 15461578, 15604671, 15748533, 15893166,
    16038571, 16184750, 16331702, 16479430, 16627934, 16777216,
];

#[cfg(test)]
mod tests {
    use super::*;

    /// The curve of IEC 61966-2-1, from linear light to a code in 0..=255, not rounded.
    fn curve(light: f64) -> f64 {
        let encoded = if light <= 0.0031308 {
            12.92 * light
        } else {
            1.055 * libm::pow(light, 1.0 / 2.4) - 0.055
        };
        encoded * 255.0
    }

    #[test]
    fn srgb_is_the_nearest_code_everywhere() {
        for step in 0..=1_000_000_u32 {
            let light = f64::from(step) / 1e6;
            let code = f64::from(Transfer::Srgb.encode(light.to_unit_bits()));
            assert!((code - curve(light)).abs() <= 0.5 + 1e-3, "{light} becomes {code}");
        }
    }

    #[test]
    fn each_threshold_is_where_the_code_changes() {
        for (code, threshold) in (0..=254_u8).zip(SRGB_THRESHOLDS) {
            assert_eq!(Transfer::Srgb.encode(threshold - 1), code);
            assert_eq!(Transfer::Srgb.encode(threshold), code + 1);
        }
        assert_eq!(Transfer::Srgb.encode(u32::MAX), 255);
    }

    #[test]
    fn bytes_come_back_from_their_light() {
        for code in 0..=255_u8 {
            for transfer in [Transfer::Srgb, Transfer::Linear] {
                let light = transfer.decode(code);
                assert!(light <= 1 << 24);
                assert_eq!(transfer.encode(light.saturating_mul(256)), code);
            }
            let light = f64::from(Transfer::Srgb.decode(code)) / 16_777_216.0;
            assert!((curve(light) - f64::from(code)).abs() <= 3e-4, "{code} is {light}");
        }
    }

    #[test]
    fn linear_is_rounded_to_nearest() {
        for code in 0..=255_u8 {
            let light = f64::from(code) / 255.0;
            assert_eq!(Transfer::Linear.encode(light.to_unit_bits()), code);
            let below = (f64::from(code) - 0.500_001) / 255.0;
            assert_eq!(Transfer::Linear.encode(below.to_unit_bits()), code.saturating_sub(1));
        }
    }

    #[test]
    fn light_out_of_range_is_clamped() {
        let bytes = |v: f32| Rgb::new(v, v, v).to_rgb8(Transfer::Srgb);
        assert_eq!(bytes(-3.0), [0; 3]);
        assert_eq!(bytes(1.0), [255; 3]);
        assert_eq!(bytes(1e30), [255; 3]);
        assert_eq!(bytes(f32::INFINITY), [255; 3]);
        assert_eq!(bytes(f32::NAN), [0; 3]);
    }
}
