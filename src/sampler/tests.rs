//! Every spread with every number of samples: stratified, without bias, the same everywhere.

extern crate std;

use std::collections::{BTreeMap, BTreeSet};
use std::vec;
use std::vec::Vec;

use super::*;
use crate::{Q16, Q32};

const PIXELS: [[u32; 2]; 3] = [[0, 0], [3, 1], [70_000, 12_345]];

fn sampler(spread: Spread, samples: u16, seed: u32) -> Sampler {
    Sampler { spread, filter: PixelFilter::Box, samples, seed }
}

/// The points of a pixel in steps of 2⁻¹⁶.
fn points(sampler: &Sampler, pixel: [u32; 2], dimension: Dimension) -> Vec<[u16; 2]> {
    (0..sampler.samples).map(|index| sampler.point(pixel, index, dimension)).collect()
}

/// Which of `count` equal cells a number of steps lies in.
fn cell(steps: u16, count: u16) -> usize {
    (usize::from(steps) * usize::from(count)) >> 16
}

/// Whether each cell of each axis holds exactly one of the points.
fn rooks(points: &[[u16; 2]]) -> bool {
    let count = points.len() as u16;
    (0..2).all(|axis| {
        let mut hit = vec![false; points.len()];
        points.iter().for_each(|point| hit[cell(point[axis], count)] = true);
        hit.into_iter().all(|hit| hit)
    })
}

#[test]
fn every_row_and_column_is_hit_once_for_any_number_of_samples() {
    for samples in 2..=SAMPLES_MAX {
        for spread in [Spread::Rooks, Spread::MultiJitter] {
            for (seed, pixel) in (0..).zip(PIXELS) {
                for dimension in [Dimension::PIXEL, Dimension(7)] {
                    let points = points(&sampler(spread, samples, seed), pixel, dimension);
                    assert!(rooks(&points), "{spread:?}, {samples} at {pixel:?}: {points:?}");
                }
            }
        }
    }
}

#[test]
fn every_cell_of_equal_area_is_hit_once_for_any_number_of_samples() {
    for samples in 2..=SAMPLES_MAX {
        let cells = Cells::of(NonZeroU32::new(samples.into()).unwrap());
        let (rows, base) = (cells.rows.get(), cells.base.get());
        assert!(rows.abs_diff(base) <= 1, "{samples} in {rows} rows of {base}");
        assert_eq!(rows * base + cells.longer, u32::from(samples));
        for spread in [Spread::Grid, Spread::Jitter] {
            let points = points(&sampler(spread, samples, 5), [9, 9], Dimension::PIXEL);
            let mut found = points.iter();
            let mut above = 0;
            for row in 0..rows {
                let length = (base + u32::from(row < cells.longer)) as u16;
                for column in 0..length {
                    let [x, y] = *found.next().unwrap();
                    assert_eq!(cell(x, length), usize::from(column), "{spread:?} {samples}");
                    let stratum = cell(y, samples);
                    assert!((above..above + usize::from(length)).contains(&stratum));
                }
                above += usize::from(length);
            }
        }
    }
}

#[test]
fn squares_are_stratified_in_two_dimensions_too() {
    for side in 2..=16_u16 {
        for spread in [Spread::Grid, Spread::Jitter, Spread::MultiJitter] {
            let points = points(&sampler(spread, side * side, 1), [4, 2], Dimension(3));
            let mut hit = vec![false; points.len()];
            for [x, y] in points {
                hit[cell(y, side) * usize::from(side) + cell(x, side)] = true;
            }
            assert!(hit.iter().all(|hit| *hit), "{spread:?} of {side} by {side}");
        }
    }
}

/// The mean over many pixels of how many points lie in each of 8×8 cells must be the same: here by the
/// statistic χ² of 63 degrees of freedom, whose 99.9th percentile is 103; strata make it less.
#[test]
fn no_place_in_the_pixel_is_preferred() {
    for samples in [2, 3, 4, 5, 7, 12, 16, 17, 31, 100, 255] {
        for spread in [Spread::Jitter, Spread::Rooks, Spread::MultiJitter] {
            for dimension in [Dimension::PIXEL, Dimension(11)] {
                let mut hits = [0_u32; 64];
                let mut total = 0;
                for pixel in 0..4000 / u32::from(samples) + 200 {
                    let sampler = sampler(spread, samples, 77);
                    for [x, y] in points(&sampler, [pixel % 64, pixel / 64], dimension) {
                        hits[cell(y, 8) * 8 + cell(x, 8)] += 1;
                        total += 1;
                    }
                }
                let mean = f64::from(total) / 64.0;
                let chi: f64 =
                    hits.iter().map(|&n| f64::from(n) - mean).map(|d| d * d / mean).sum();
                assert!(chi <= 103.0, "{spread:?} {samples} {dimension:?}: χ² {chi}");
            }
        }
    }
}

#[test]
fn permutations_are_permutations_and_reach_all_of_a_few() {
    for len in 1..=256_u32 {
        let count = NonZeroU32::new(len).unwrap();
        for key in 0..8 {
            let mut hit = vec![false; len as usize];
            (0..len).for_each(|index| hit[permute(index, count, key) as usize] = true);
            assert!(hit.into_iter().all(|hit| hit), "{len} numbers, key {key}");
        }
    }
    for (len, all) in [(2, 2), (3, 6), (4, 24), (5, 120)] {
        let count = NonZeroU32::new(len).unwrap();
        let mut seen = BTreeMap::<Vec<u32>, u32>::new();
        for key in 0..all * 400 {
            let order = (0..len).map(|index| permute(index, count, hash(3, key))).collect();
            *seen.entry(order).or_default() += 1;
        }
        assert_eq!(seen.len() as u32, all, "permutations of {len}");
        assert!(seen.values().all(|&times| (100..=1200).contains(&times)), "{len}: {seen:?}");
    }
}

/// Every format samples the same points, for their steps are exact in all.
#[test]
fn offsets_are_the_same_numbers_in_every_format() {
    fn check<S: Scalar>() {
        for filter in [PixelFilter::Box, PixelFilter::Tent] {
            for samples in [1, 2, 9, 16, 200] {
                let sampler = Sampler { filter, seed: 3, ..Sampler::new(samples) };
                for index in 0..samples {
                    let here = sampler.offset::<S>(5, 6, index).map(|part| part.to_f64());
                    let there = sampler.offset::<f64>(5, 6, index);
                    assert_eq!(here, there, "{} {filter:?} {samples} {index}", S::NAME);
                    let steps = there.map(|part| part * 65536.0);
                    assert!(steps.iter().all(|part| libm::floor(*part) == *part));
                }
            }
        }
    }
    check::<f32>();
    check::<Q16>();
    check::<Q32>();
}

#[test]
fn one_sample_is_the_middle() {
    for spread in Spread::ALL {
        for filter in [PixelFilter::Box, PixelFilter::Tent] {
            let sampler = Sampler { filter, ..sampler(spread, 1, 9) };
            assert_eq!(sampler.offset::<f32>(3, 4, 0), [0.5; 2]);
        }
    }
}

/// The tent's mean is the middle, its variance 1/6 of a pixel squared, and it ends at the neighbours.
#[test]
fn tent_has_the_moments_of_a_triangle() {
    let (mut sum, mut squares, mut fourth) = (0.0, 0.0, 0.0);
    for share in 0..=u16::MAX {
        let at = tent::<f64>(share) + 0.5 / 65536.0;
        assert!((-1.0..1.0).contains(&at));
        (sum, squares, fourth) = (sum + at, squares + at * at, fourth + at * at * at * at);
    }
    let mean = |sum: f64| sum / 65536.0;
    assert!(mean(sum).abs() <= 2e-5, "{}", mean(sum));
    assert!((mean(squares) - 1.0 / 6.0).abs() <= 2e-5, "{}", mean(squares));
    assert!((mean(fourth) - 1.0 / 15.0).abs() <= 2e-5, "{}", mean(fourth));
    let warped = Sampler { filter: PixelFilter::Tent, ..Sampler::new(256) };
    let mut squares = 0.0;
    for index in 0..256 {
        let [x, y] = warped.offset::<f64>(8, 1, index);
        assert!([x, y].iter().all(|part| (-0.5..1.5).contains(part)));
        squares += (x - 0.5) * (x - 0.5) + (y - 0.5) * (y - 0.5);
    }
    assert!((squares / 512.0 - 1.0 / 6.0).abs() <= 1e-3, "{}", squares / 512.0);
}

/// Different pixels, seeds and dimensions have different points.
#[test]
fn nothing_repeats_from_pixel_to_pixel() {
    let with =
        |seed, pixel, dimension| points(&sampler(Spread::MultiJitter, 16, seed), pixel, dimension);
    let mut seen = BTreeSet::new();
    for seed in 0..4 {
        for x in 0..16 {
            for y in 0..16 {
                for dimension in 0..3 {
                    assert!(seen.insert(with(seed, [x, y], Dimension(dimension))));
                }
            }
        }
    }
    // Places in the pixel and in another dimension do not go together.
    let (mut products, mut count) = (0.0, 0.0);
    for x in 0..400 {
        let (a, b) = (with(1, [x, 7], Dimension::PIXEL), with(1, [x, 7], Dimension(1)));
        for (a, b) in a.iter().zip(b) {
            products += (f64::from(a[0]) / 65536.0 - 0.5) * (f64::from(b[0]) / 65536.0 - 0.5);
            count += 1.0;
        }
    }
    // Of independent numbers: 0 ± 1/12/√count.
    assert!((products / count).abs() <= 4.0 / 12.0 / libm::sqrt(count), "{}", products / count);
}
