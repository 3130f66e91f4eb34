//! An oracle for Bézier patches in double precision that shares nothing with the tracer: all points of a patch on
//! a line by Newton's method from every cell of a grid that may hold one, certified by the winding number of the border.
#![allow(dead_code, unreachable_pub, reason = "each test program uses a part of the oracle")]
#![allow(clippy::expect_used, clippy::panic, clippy::indexing_slicing, reason = "tests may panic")]

use crate::oracle::{along, length};

/// Control points: four rows of four.
pub type Net = [[[f64; 3]; 4]; 4];

/// A point of a patch on a line.
#[derive(Clone, Copy, Debug)]
pub struct Crossing {
    pub t: f64,
    pub at: [f64; 2],
    /// The sign with which the border winds around it.
    pub sign: i32,
    /// How far from tangential: the area of du and dv across the line over the product of their lengths in space.
    pub slope: f64,
    /// The cosine of the angle between the line and the normal.
    pub cosine: f64,
}

pub fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// By de Casteljau's construction: a point of a curve and its derivative.
fn curve(p: [[f64; 3]; 4], s: f64) -> [[f64; 3]; 2] {
    let mix = |a: [f64; 3], b: [f64; 3]| [0, 1, 2].map(|i| (1.0 - s) * a[i] + s * b[i]);
    let [ab, bc, cd] = [mix(p[0], p[1]), mix(p[1], p[2]), mix(p[2], p[3])];
    let [abc, bcd] = [mix(ab, bc), mix(bc, cd)];
    [mix(abc, bcd), along(bcd, -1.0, abc).map(|x| 3.0 * x)]
}

/// A point of a patch, du and dv.
pub fn surface(net: &Net, [u, v]: [f64; 2]) -> [[f64; 3]; 3] {
    let rows = net.map(|row| curve(row, u));
    let [point, dv] = curve(rows.map(|row| row[0]), v);
    let [du, _] = curve(rows.map(|row| row[1]), v);
    [point, du, dv]
}

/// The parameters of the point of a patch nearest to a point close to it, by Gauss and Newton.
pub fn nearest(net: &Net, mut at: [f64; 2], to: [f64; 3]) -> [f64; 2] {
    for _ in 0..20 {
        let [point, du, dv] = surface(net, at);
        let off = along(to, -1.0, point);
        let (uu, uv, vv) = (dot(du, du), dot(du, dv), dot(dv, dv));
        let (u, v, det) = (dot(du, off), dot(dv, off), uu * vv - uv * uv);
        let step = [(u * vv - v * uv) / det, (v * uu - u * uv) / det];
        if step.iter().any(|x| !x.is_finite()) {
            break;
        }
        let next = [0, 1].map(|i| (at[i] + step[i]).clamp(0.0, 1.0));
        if length(along(to, -1.0, surface(net, next)[0])) >= length(off) {
            break;
        }
        at = next;
    }
    at
}

/// A patch across a line: two coordinates at right angles to it, and the way along it in `t`.
pub struct Seen {
    net: Net,
    dir: [f64; 3],
    /// The greatest second derivatives across the line, by u and u, by u and v, by v and v.
    bends: [f64; 3],
    /// The greatest derivatives across the line, by u and by v.
    slopes: [f64; 2],
    size: f64,
}

/// The greatest length across the line of differences between neighbours of a net.
fn greatest(net: &[Vec<[f64; 3]>], along_u: bool) -> (Vec<Vec<[f64; 3]>>, f64) {
    let less = |a: [f64; 3], b: [f64; 3]| along(b, -1.0, a);
    let differences: Vec<Vec<_>> = if along_u {
        net.iter().map(|row| row.windows(2).map(|w| less(w[0], w[1])).collect()).collect()
    } else {
        let rows = net.windows(2);
        rows.map(|w| w[0].iter().zip(&w[1]).map(|(&a, &b)| less(a, b)).collect()).collect()
    };
    let most = differences.iter().flatten().fold(0.0_f64, |m, d| m.max(d[0].hypot(d[1])));
    (differences, most)
}

impl Seen {
    pub fn new(net: &Net, origin: [f64; 3], dir: [f64; 3]) -> Self {
        let speed = length(dir);
        let w = dir.map(|x| x / speed);
        let least = (0..3).min_by(|&i, &j| w[i].abs().total_cmp(&w[j].abs())).expect("three");
        let mut helper = [0.0; 3];
        helper[least] = 1.0;
        let a = cross(helper, w);
        let a = a.map(|x| x / length(a));
        let b = cross(w, a);
        let seen = |p: [f64; 3]| {
            let from = along(p, -1.0, origin);
            [dot(from, a), dot(from, b), dot(from, w) / speed]
        };
        let net = net.map(|row| row.map(seen));
        let rows: Vec<Vec<_>> = net.iter().map(|row| row.to_vec()).collect();
        let (du, most_u) = greatest(&rows, true);
        let (dv, most_v) = greatest(&rows, false);
        let (most_uu, most_uv) = (greatest(&du, true).1, greatest(&du, false).1);
        let bends = [6.0 * most_uu, 9.0 * most_uv, 6.0 * greatest(&dv, false).1];
        let size = net.iter().flatten().fold(0.0_f64, |m, p| m.max(p[0].hypot(p[1])));
        Self { net, dir, bends, slopes: [3.0 * most_u, 3.0 * most_v], size }
    }

    /// Whether a cell may hold a point of the line, by the derivatives at its centre and the greatest second ones.
    fn may_hold(&self, centre: [f64; 2], half: f64) -> bool {
        let [p, du, dv] = surface(&self.net, centre);
        let [uu, uv, vv] = self.bends;
        let first = half * (du[0].hypot(du[1]) + dv[0].hypot(dv[1]));
        let second = half * half * (0.5 * uu + uv + 0.5 * vv);
        p[0].hypot(p[1]) <= first + second + 1e-14 * self.size
    }

    /// The cells of a grid of 2^levels a side that may hold a point of the line.
    fn cells(&self, levels: u32) -> Vec<[f64; 2]> {
        let (mut cells, mut half) = (vec![[0.5, 0.5]], 0.5);
        for _ in 0..levels {
            half *= 0.5;
            let quarters = |c: [f64; 2]| {
                [(-1.0, -1.0), (1.0, -1.0), (-1.0, 1.0), (1.0, 1.0)]
                    .map(|(i, j)| [c[0] + i * half, c[1] + j * half])
            };
            cells =
                cells.into_iter().flat_map(quarters).filter(|&c| self.may_hold(c, half)).collect();
        }
        cells
    }

    fn newton(&self, from: [f64; 2]) -> Option<[f64; 2]> {
        let mut at = from;
        for _ in 0..40 {
            let [p, du, dv] = surface(&self.net, at);
            let area = du[0] * dv[1] - du[1] * dv[0];
            let step = [(p[1] * dv[0] - p[0] * dv[1]) / area, (du[1] * p[0] - du[0] * p[1]) / area];
            if !(step[0].abs() < 0.5 && step[1].abs() < 0.5) {
                return None;
            }
            at = [at[0] + step[0], at[1] + step[1]];
            if step[0].abs() + step[1].abs() < 1e-14 {
                return Some(at);
            }
        }
        let [p, ..] = surface(&self.net, at);
        (p[0].hypot(p[1]) < 1e-14 * self.size).then_some(at)
    }

    /// How often the border goes around the line, counterclockwise; `None` where it comes too near to tell.
    fn winding(&self) -> Option<i32> {
        let corners = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
        let mut turned = 0.0;
        for i in 0..4 {
            let (from, to) = (corners[i], corners[(i + 1) % 4]);
            let slope = self.slopes[i % 2];
            let place = |s: f64| {
                let [p, ..] = surface(&self.net, [0, 1].map(|i| from[i] + (to[i] - from[i]) * s));
                p
            };
            let (mut s, mut p, mut steps) = (0.0, place(0.0), 0);
            while s < 1.0 {
                // So far the curve cannot go around, whatever way it takes.
                let step = p[0].hypot(p[1]) / slope;
                steps += 1;
                if step < 1e-11 || steps > 5000 {
                    return None;
                }
                s += step;
                let q = place(f64::min(s, 1.0));
                turned += (p[0] * q[1] - p[1] * q[0]).atan2(p[0] * q[0] + p[1] * q[1]);
                p = q;
            }
        }
        Some((turned / (2.0 * std::f64::consts::PI)).round() as i32)
    }

    /// The crossings found from some cells, in order of t, and whether they are certain: none is
    /// tangential or at the border, and the border winds as often as they say.
    fn crossings_from(&self, cells: &[[f64; 2]]) -> (Vec<Crossing>, bool) {
        let mut found: Vec<Crossing> = Vec::new();
        let mut certain = true;
        for at in cells.iter().filter_map(|&cell| self.newton(cell)) {
            let beyond = at.iter().fold(f64::NEG_INFINITY, |m, &x| m.max(x - 1.0).max(-x));
            certain &= beyond.abs() > 1e-9;
            let [p, du, dv] = surface(&self.net, at);
            let area = du[0] * dv[1] - du[1] * dv[0];
            let known = |c: &Crossing| {
                let apart = (c.at[0] - at[0]).abs() + (c.at[1] - at[1]).abs();
                apart < 1e-7 && c.sign == area.signum() as i32
            };
            if beyond > 0.0 || found.iter().any(known) {
                continue;
            }
            let speed = length(self.dir);
            let space = |v: [f64; 3]| [v[0], v[1], v[2] * speed];
            let normal = cross(space(du), space(dv));
            let cosine = normal[2].abs() / length(normal);
            let slope = area.abs() / (self.slopes[0] * self.slopes[1]);
            certain &= slope > 1e-9;
            found.push(Crossing { t: p[2], at, sign: area.signum() as i32, slope, cosine });
        }
        found.sort_by(|a, b| a.t.total_cmp(&b.t));
        let wound = self.winding() == Some(found.iter().map(|c| c.sign).sum::<i32>());
        (found, certain && wound)
    }

    /// All crossings; whether a finer grid was needed for them; and whether they are certain. Where no cell may
    /// hold one, that is a proof.
    pub fn crossings(&self) -> (Vec<Crossing>, bool, bool) {
        let cells = self.cells(6);
        if cells.is_empty() {
            return (Vec::new(), false, true);
        }
        let (found, certain) = self.crossings_from(&cells);
        let plain = found.iter().all(|c| c.slope > 1e-3);
        if plain && certain && cells.len() <= 8 * found.len() {
            return (found, false, true);
        }
        // A pair that is nearly tangential, or one cell that leads nowhere.
        let (fine, certain) = self.crossings_from(&self.cells(12));
        (fine, true, certain)
    }
}
