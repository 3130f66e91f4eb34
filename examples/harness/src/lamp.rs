//! The lights of a document in the words of the core.

use nostray::{Attenuation, Emitter, Light, Real, Scalar, Spotlight, Vector};

use crate::assemble::{rgb, vector};
use crate::document;
use crate::flaw::{Flaw, Path};
use crate::moves::sin_cos_degrees;
use crate::written::Triple;

/// The name of a light's kind, as files spell it.
pub(crate) fn variant(light: &document::Light) -> &'static str {
    match light {
        document::Light::Point { .. } => "Point",
        document::Light::Directional { .. } => "Directional",
        document::Light::Spot { .. } => "Spot",
        document::Light::Rectangle { .. } => "Rectangle",
        document::Light::Disc { .. } => "Disc",
        document::Light::Sphere { .. } => "Sphere",
    }
}

/// A light in the number format of the scene.
pub(crate) fn light<S: Scalar>(light: &document::Light, path: &Path<'_>) -> Result<Light<S>, Flaw> {
    let area = |emitter, color, attenuation| {
        Ok(Light::Area { emitter, color: rgb(color), attenuation: weakening(attenuation) })
    };
    match *light {
        document::Light::Point { at, color, attenuation: a } => {
            Ok(Light::Point { at: vector::<S>(at), color: rgb(color), attenuation: weakening(a) })
        }
        document::Light::Directional { toward, color } => {
            let toward = unit::<S>(toward, &path.field("toward"))?;
            Ok(Light::Directional { toward, color: rgb(color) })
        }
        document::Light::Spot { at, toward, inner, outer, color, attenuation } => {
            let cone = Spotlight {
                axis: unit::<S>(toward, &path.field("toward"))?,
                cos_inner: cosine(inner, &path.field("inner"))?,
                cos_outer: cosine(outer, &path.field("outer"))?,
            };
            let (at, color) = (vector::<S>(at), rgb(color));
            Ok(Light::Spot { at, cone, color, attenuation: weakening(attenuation) })
        }
        document::Light::Rectangle { center, edges, color, attenuation } => {
            let (center, edges) = (vector::<S>(center), edges.0.map(vector::<S>));
            area(Emitter::Rectangle { center, edges }, color, attenuation)
        }
        document::Light::Disc { center, normal, radius, color, attenuation } => {
            let normal = unit::<S>(normal, &path.field("normal"))?;
            let (center, radius) = (vector::<S>(center), S::from_f64(radius));
            area(Emitter::Disc { center, normal, radius }, color, attenuation)
        }
        document::Light::Sphere { center, radius, color, attenuation } => {
            let (center, radius) = (vector::<S>(center), S::from_f64(radius));
            area(Emitter::Sphere { center, radius }, color, attenuation)
        }
    }
}

fn weakening<S: Scalar>(written: document::Attenuation) -> Attenuation<S> {
    Attenuation {
        constant: S::from_f64(written.constant),
        linear: S::from_f64(written.linear),
        quadratic: S::from_f64(written.quadratic),
    }
}

/// A direction, made a unit vector before it is rounded.
fn unit<S: Scalar>(written: Triple, path: &Path<'_>) -> Result<S::Dir, Flaw> {
    let direction = vector::<f64>(written);
    if !direction.is_finite() {
        return Err(Flaw::new(path, "is not a finite number"));
    }
    if direction == <f64 as Scalar>::Vec3::ZERO {
        return Err(Flaw::new(path, "must not be zero"));
    }
    let unit = Vector::to_array(Vector::normalize(direction)).map(S::Wide::from_f64);
    Ok(S::narrow_dir(S::WideVec::from_array(unit)))
}

fn cosine<S: Scalar>(degrees: f64, path: &Path<'_>) -> Result<S, Flaw> {
    if (0.0..=180.0).contains(&degrees) {
        Ok(S::from_f64(sin_cos_degrees(degrees).1))
    } else {
        Err(Flaw::new(path, "must be between 0 and 180 degrees"))
    }
}
