//! Meshes in Wavefront's OBJ format: `v`, `vt`, `vn` and `f`. Names, groups and materials are passed over,
//! for a mesh has one material; curves, lines and points are refused, for they have no area.
//!
//! Source: Wavefront Technologies, *Advanced Visualizer Manual*, appendix B1 (1991).

use std::fmt;
use std::str::SplitAsciiWhitespace;

use nostray::Vector;
use nostray::glam::DVec3;

use crate::figure::Figure;
use crate::triangulate::triangulate;

/// The most corners of one face: the time to divide it may grow with the cube.
const CORNERS_MAX: usize = 512;

/// Why a text is not a mesh.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ObjError {
    /// The line, from 1.
    pub line: usize,
    /// What is wrong there.
    pub message: String,
}

impl fmt::Display for ObjError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.line, self.message)
    }
}

impl std::error::Error for ObjError {}

/// A corner of a face: a point, and texture coordinates and a normal if it has them.
type Corner = [Option<usize>; 3];

/// What has been read.
#[derive(Default)]
struct Reader {
    points: Vec<[f64; 3]>,
    uvs: Vec<[f64; 2]>,
    normals: Vec<[f64; 3]>,
    triangles: Vec<[Corner; 3]>,
}

/// Reads a mesh. Faces with more than three corners are divided into triangles, and those without any
/// area left out. Normals and texture coordinates are there if all corners have them; a normal
/// of length 0 counts as none.
///
/// # Errors
/// The first line that is not one of a mesh.
pub fn read_obj(text: &str) -> Result<Figure, ObjError> {
    let mut reader = Reader::default();
    let mut lines = (1..).zip(text.lines());
    let mut joined = String::new();
    while let Some((line, mut content)) = lines.next() {
        // A line that ends in a backslash goes on in the next one.
        if content.trim_end().ends_with('\\') {
            joined.clear();
            while let Some(part) = content.trim_end().strip_suffix('\\') {
                joined.push_str(part);
                joined.push(' ');
                content = lines.next().map_or("", |(_, next)| next);
            }
            joined.push_str(content);
            content = &joined;
        }
        let told = content.split('#').next().unwrap_or_default();
        reader.line(told).map_err(|message| ObjError { line, message })?;
    }
    Ok(reader.figure())
}

impl Reader {
    fn line(&mut self, text: &str) -> Result<(), String> {
        let mut words = text.split_ascii_whitespace();
        let Some(keyword) = words.next() else {
            return Ok(());
        };
        match keyword {
            // A weight or a colour may follow.
            "v" => self.points.push(numbers(words, 3..=7)?),
            "vt" => self.uvs.push(numbers(words, 1..=3)?),
            "vn" => self.normals.push(numbers(words, 3..=3)?),
            "f" => self.face(words)?,
            "o" | "g" | "s" | "mg" | "usemtl" | "mtllib" | "usemap" | "maplib" => {}
            other => return Err(format!("{other:?} is not supported: only v, vt, vn and f are")),
        }
        Ok(())
    }

    fn face(&mut self, words: SplitAsciiWhitespace<'_>) -> Result<(), String> {
        let mut corners = Vec::new();
        for word in words {
            if corners.len() == CORNERS_MAX {
                return Err(format!("a face has more than {CORNERS_MAX} corners"));
            }
            corners.push(self.corner(word)?);
        }
        if corners.len() < 3 {
            return Err(format!("a face needs three corners and has {}", corners.len()));
        }
        let place = |corner: &Corner| corner[0].and_then(|index| self.points.get(index));
        let places: Vec<DVec3> =
            corners.iter().filter_map(place).map(|&p| DVec3::from_array(p)).collect();
        let divided = if corners.len() == 3 { vec![[0, 1, 2]] } else { triangulate(&places) };
        for triangle in divided {
            let [a, b, c] = triangle.map(|index| places[index]);
            let area = Vector::cross(Vector::normalize(b - a), Vector::normalize(c - a));
            if area != DVec3::ZERO {
                self.triangles.push(triangle.map(|index| corners[index]));
            }
        }
        Ok(())
    }

    /// A corner, as `v`, `v/vt`, `v//vn` or `v/vt/vn`.
    fn corner(&self, word: &str) -> Result<Corner, String> {
        let mut parts = word.split('/');
        let counts = [("v", self.points.len()), ("vt", self.uvs.len()), ("vn", self.normals.len())];
        let mut corner = [None; 3];
        for (slot, (name, count)) in corner.iter_mut().zip(counts) {
            let Some(part) = parts.next() else { break };
            if part.is_empty() && name != "v" {
                continue;
            }
            let index: i64 =
                part.parse().map_err(|_| format!("{part:?} in {word:?} is not an index"))?;
            // From 1 on, or back from the last one so far.
            let found = if index < 0 { count as i64 + index } else { index - 1 };
            let found = usize::try_from(found).ok().filter(|&found| found < count);
            *slot = Some(found.ok_or(format!("there is no {name} {index} in {word:?}"))?);
        }
        if parts.next().is_some() {
            return Err(format!("{word:?} has more than three parts"));
        }
        Ok(corner)
    }

    /// The mesh of all faces.
    fn figure(self) -> Figure {
        let Self { points, uvs, mut normals, triangles } = self;
        let part = |part: usize| -> Option<Vec<[u32; 3]>> {
            let part = |triangle: &[Corner; 3]| {
                let [a, b, c] = triangle.map(|corner| corner[part].map(|index| index as u32));
                Some([a?, b?, c?])
            };
            triangles.iter().map(part).collect()
        };
        let corners = part(0).unwrap_or_default();
        let uv_corners = part(1).filter(|_| !uvs.is_empty()).unwrap_or_default();
        let mut normal_corners = Vec::new();
        if triangles.iter().flatten().any(|corner| corner[2].is_some()) {
            for (triangle, &[a, b, c]) in triangles.iter().zip(&corners) {
                let [a, b, c] = [a, b, c].map(|index| DVec3::from_array(points[index as usize]));
                let mut flat = None;
                normal_corners.push(triangle.map(|corner| {
                    let given = corner[2].filter(|&index| normals[index] != [0.0; 3]);
                    let index = given.or(flat).unwrap_or_else(|| {
                        let normal =
                            Vector::cross(Vector::normalize(b - a), Vector::normalize(c - a));
                        normals.push(Vector::normalize(normal).to_array());
                        normals.len() - 1
                    });
                    if given.is_none() {
                        flat = Some(index);
                    }
                    index as u32
                }));
            }
        } else {
            normals.clear();
        }
        let uvs = if uv_corners.is_empty() { Vec::new() } else { uvs };
        Figure { points, normals, uvs, corners, normal_corners, uv_corners }
    }
}

/// So many numbers, of which the first are kept; what may be left out is 0.
fn numbers<const N: usize>(
    words: SplitAsciiWhitespace<'_>,
    count: std::ops::RangeInclusive<usize>,
) -> Result<[f64; N], String> {
    let (mut kept, mut seen) = ([0.0; N], 0);
    for word in words {
        let number: f64 = word.parse().map_err(|_| format!("{word:?} is not a number"))?;
        if !number.is_finite() {
            return Err(format!("{word:?} is not a finite number"));
        }
        if let Some(slot) = kept.get_mut(seen) {
            *slot = number;
        }
        seen += 1;
    }
    if count.contains(&seen) {
        Ok(kept)
    } else {
        Err(format!("{} numbers are needed, and there are {seen}", count.start()))
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test may fail loudly")]

    use super::*;

    fn message(text: &str) -> (usize, String) {
        let error = read_obj(text).unwrap_err();
        (error.line, error.message)
    }

    const SQUARE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

    #[test]
    fn faces_become_triangles_of_their_corners() {
        let figure = read_obj(&format!("{SQUARE}g one\nf 1 2 3 4\nf -4 -3 -1 # again\n")).unwrap();
        assert_eq!(figure.points.len(), 4);
        assert_eq!(figure.corners, [[3, 0, 1], [3, 1, 2], [0, 1, 3]]);
        assert!(figure.normals.is_empty() && figure.uvs.is_empty());
    }

    #[test]
    fn concave_faces_keep_their_outline() {
        let text = "v 0 0 0\nv 4 0 0\nv 4 4 0\nv 2 1 0\nv 0 4 0\nf 1 2 \\\n 3 4 5\n";
        let figure = read_obj(text).unwrap();
        let area: f64 = figure
            .corners
            .iter()
            .map(|triangle| {
                let [a, b, c] =
                    triangle.map(|index| DVec3::from_array(figure.points[index as usize]));
                Vector::cross(b - a, c - a).z / 2.0
            })
            .sum();
        assert_eq!((figure.corners.len(), area), (3, 10.0));
    }

    #[test]
    fn corners_have_normals_and_coordinates() {
        let text =
            format!("{SQUARE}vt 0 0\nvt 1 0\nvn 0 0 1\nf 1/1/1 2/2/1 3/1/1\nf 1/1 3/2 4/1\n");
        let figure = read_obj(&text).unwrap();
        assert_eq!(figure.uv_corners, [[0, 1, 0], [0, 1, 0]]);
        // The second face has its own normal at each corner.
        assert_eq!(figure.normal_corners, [[0, 0, 0], [1, 1, 1]]);
        assert_eq!(figure.normals, [[0.0, 0.0, 1.0], [0.0, 0.0, 1.0]]);
    }

    #[test]
    fn faces_without_area_are_left_out() {
        let figure = read_obj(&format!("{SQUARE}f 1 2 2\nf 1 2 3\n")).unwrap();
        assert_eq!(figure.corners, [[0, 1, 2]]);
    }

    #[test]
    fn what_is_wrong_is_told_by_line() {
        assert_eq!(message("v 1 2\n"), (1, "3 numbers are needed, and there are 2".to_owned()));
        assert_eq!(message("\nv 1 2 x\n"), (2, "\"x\" is not a number".to_owned()));
        assert_eq!(message("v 1 2 inf\n").1, "\"inf\" is not a finite number");
        assert_eq!(
            message(&format!("{SQUARE}f 1 2\n")),
            (5, "a face needs three corners and has 2".to_owned())
        );
        assert_eq!(message(&format!("{SQUARE}f 1 2 5\n")).1, "there is no v 5 in \"5\"");
        assert_eq!(message(&format!("{SQUARE}f 1 2 0\n")).1, "there is no v 0 in \"0\"");
        assert_eq!(message(&format!("{SQUARE}f 1 2 -5\n")).1, "there is no v -5 in \"-5\"");
        assert_eq!(message(&format!("{SQUARE}f 1//1 2 3\n")).1, "there is no vn 1 in \"1//1\"");
        assert_eq!(
            message(&format!("{SQUARE}f 1/2/3/4 2 3\n")).1,
            "there is no vt 2 in \"1/2/3/4\""
        );
        assert_eq!(message(&format!("{SQUARE}f a 2 3\n")).1, "\"a\" in \"a\" is not an index");
        assert_eq!(
            message("curv 0 1 1 2\n").1,
            "\"curv\" is not supported: only v, vt, vn and f are"
        );
        let many = format!("{SQUARE}f{}\n", " 1 2 3 4".repeat(200));
        assert_eq!(message(&many).1, "a face has more than 512 corners");
    }
}
