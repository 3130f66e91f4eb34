//! Checks of the lights.

use super::{check_amount, check_light_amount, check_unit};
use crate::error::{Item, SceneError};
use crate::light::{Attenuation, Emitter, Light};
use crate::scalar::{Real, Scalar, Vector};

fn check_place<S: Scalar>(at: Item, field: &'static str, v: S::Vec3) -> Result<(), SceneError> {
    if !v.is_finite() {
        Err(SceneError::NotFinite { at, field })
    } else if v.max_abs() > S::COORD_MAX {
        Err(SceneError::TooLarge { at, field })
    } else {
        Ok(())
    }
}

pub(super) fn check_light<S: Scalar>(at: Item, light: &Light<S>) -> Result<(), SceneError> {
    let (color, attenuation) = match light {
        Light::Directional { toward, color } => {
            check_light_amount(at, "color", *color)?;
            return check_unit::<S>(at, "toward", *toward);
        }
        Light::Point { at: place, color, attenuation }
        | Light::Spot { at: place, color, attenuation, .. } => {
            check_place::<S>(at, "at", *place)?;
            (color, attenuation)
        }
        Light::Area { emitter, color, attenuation } => {
            check_emitter(at, emitter)?;
            (color, attenuation)
        }
    };
    check_light_amount(at, "color", *color)?;
    check_attenuation(at, attenuation)?;
    let Light::Spot { cone, .. } = light else {
        return Ok(());
    };
    check_unit::<S>(at, "toward", cone.axis)?;
    let in_order =
        cone.cos_inner <= S::ONE && cone.cos_outer >= -S::ONE && cone.cos_outer < cone.cos_inner;
    if in_order {
        Ok(())
    } else {
        let allowed = "an outer angle greater than the inner one, up to 180 degrees";
        Err(SceneError::OutOfRange { at, field: "cone", allowed })
    }
}

fn check_emitter<S: Scalar>(at: Item, emitter: &Emitter<S>) -> Result<(), SceneError> {
    let radius = match emitter {
        Emitter::Rectangle { center, edges: [u, v] } => {
            check_place::<S>(at, "center", *center)?;
            check_place::<S>(at, "edges", *u)?;
            check_place::<S>(at, "edges", *v)?;
            let [u, v] = [u, v].map(|edge| S::widen_vec(*edge));
            let area = u.normalize().cross(v.normalize()).length();
            let least = S::EPSILON.widen() * S::Wide::from_i32(16);
            let short = |edge: S::WideVec| !(edge.length() >= S::LENGTH_MIN.widen());
            return if short(u) || short(v) || !(area > least) {
                Err(SceneError::Empty { at, field: "edges" })
            } else {
                Ok(())
            };
        }
        Emitter::Disc { center, normal, radius } => {
            check_place::<S>(at, "center", *center)?;
            check_unit::<S>(at, "normal", *normal)?;
            *radius
        }
        Emitter::Sphere { center, radius } => {
            check_place::<S>(at, "center", *center)?;
            *radius
        }
    };
    let field = "radius";
    if !radius.is_finite() {
        Err(SceneError::NotFinite { at, field })
    } else if !(radius >= S::LENGTH_MIN) {
        Err(SceneError::NotPositive { at, field })
    } else if radius > S::COORD_MAX {
        Err(SceneError::TooLarge { at, field })
    } else {
        Ok(())
    }
}

fn check_attenuation<S: Scalar>(at: Item, attenuation: &Attenuation<S>) -> Result<(), SceneError> {
    check_amount(at, "attenuation", attenuation.constant)?;
    check_amount(at, "attenuation", attenuation.linear)?;
    check_amount(at, "attenuation", attenuation.quadratic)?;
    if attenuation.constant < S::from_ratio(1, 10_000) {
        let allowed = "at least 0.0001 in its constant part";
        return Err(SceneError::OutOfRange { at, field: "attenuation", allowed });
    }
    Ok(())
}
