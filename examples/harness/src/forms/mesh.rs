//! A mesh of a document, from its file or from its lists.

use std::fs::File;
use std::io::Read;

use nostray::{Corners, Form, Scalar, Triangles, Vector};

use crate::document::Solid;
use crate::figure::Figure;
use crate::flaw::{Flaw, Path};
use crate::obj::read_obj;
use crate::written::Triple;

/// The most bytes of a file.
const BYTES_MAX: u64 = 1 << 28;

/// The lists of a mesh, in the number format of the scene.
pub(super) struct Lists<S: Scalar> {
    points: Vec<S::Vec3>,
    normals: Vec<S::Vec3>,
    uvs: Vec<[S; 2]>,
    figure: Figure,
    closed: bool,
}

impl<S: Scalar> Default for Lists<S> {
    fn default() -> Self {
        let (points, normals, uvs) = (Vec::new(), Vec::new(), Vec::new());
        Self { points, normals, uvs, figure: Figure::default(), closed: false }
    }
}

impl<S: Scalar> Lists<S> {
    /// Those of a mesh of a document.
    pub(super) fn of(solid: &Solid, path: &Path<'_>) -> Result<Self, Flaw> {
        let Solid::Mesh { file, points, closed, smooth, .. } = solid else {
            return Err(Flaw::new(path, "is not a mesh"));
        };
        let mut figure = match file {
            None => of_lists(solid, path)?,
            Some(_) if !points.is_empty() => {
                return Err(Flaw::new(path, "has either a file or points, not both"));
            }
            Some(file) => {
                let told =
                    |message: String| Flaw::new(path.field("file"), format!("{file}{message}"));
                let text = text_of(file).map_err(|message| told(format!(": {message}")))?;
                let figure = read_obj(&text).map_err(|error| told(format!(":{error}")))?;
                if figure.corners.is_empty() {
                    return Err(told(": has no triangles".to_owned()));
                }
                figure
            }
        };
        if *smooth && figure.normal_corners.is_empty() {
            figure.smooth();
        }
        let vectors = |list: &[[f64; 3]]| {
            list.iter().map(|&v| S::Vec3::from_array(v.map(S::from_f64))).collect()
        };
        let (points, normals) = (vectors(&figure.points), vectors(&figure.normals));
        let uvs = figure.uvs.iter().map(|&uv| uv.map(S::from_f64)).collect();
        Ok(Self { points, normals, uvs, figure, closed: *closed })
    }

    pub(super) fn form(&self) -> Form<'_, S> {
        let Figure { corners, normal_corners, uv_corners, .. } = &self.figure;
        let has = |triangles: &Vec<[u32; 3]>| !triangles.is_empty();
        Form::Mesh(Triangles {
            points: Corners { values: &self.points, triangles: corners },
            normals: has(normal_corners)
                .then_some(Corners { values: &self.normals, triangles: normal_corners }),
            uvs: has(uv_corners).then_some(Corners { values: &self.uvs, triangles: uv_corners }),
            closed: self.closed,
        })
    }
}

/// A mesh as it is written in the document, where normals and texture coordinates go with the points.
fn of_lists(solid: &Solid, path: &Path<'_>) -> Result<Figure, Flaw> {
    let Solid::Mesh { points, triangles, normals, uvs, .. } = solid else {
        return Err(Flaw::new(path, "is not a mesh"));
    };
    let along = |name: &str, len: usize| {
        if len == 0 || len == points.len() {
            return Ok(len > 0);
        }
        let message = format!("there are {len} for {} points", points.len());
        Err(Flaw::new(path.field(name), message))
    };
    let (has_normals, has_uvs) = (along("normals", normals.len())?, along("uvs", uvs.len())?);
    let corners: Vec<[u32; 3]> = triangles.iter().map(|triangle| triangle.0).collect();
    let triples = |list: &[Triple]| list.iter().map(|triple| triple.0).collect();
    Ok(Figure {
        points: triples(points),
        normals: triples(normals),
        uvs: uvs.iter().map(|uv| uv.0).collect(),
        normal_corners: if has_normals { corners.clone() } else { Vec::new() },
        uv_corners: if has_uvs { corners.clone() } else { Vec::new() },
        corners,
    })
}

/// The text of a file of moderate size.
fn text_of(file: &str) -> Result<String, String> {
    let mut bytes = Vec::new();
    let from = File::open(file).map_err(|error| error.to_string())?;
    from.take(BYTES_MAX + 1).read_to_end(&mut bytes).map_err(|error| error.to_string())?;
    if bytes.len() as u64 > BYTES_MAX {
        return Err(format!("is larger than {} MiB", BYTES_MAX >> 20));
    }
    String::from_utf8(bytes).map_err(|_| "is not UTF-8 text".to_owned())
}
