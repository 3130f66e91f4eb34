//! The entities that are not objects: the view, the lights and the surfaces.

use nostray::{Camera, Material, Number, Paint, Projection, Rgb, Scalar, Vector};

use super::{Lamp, NffError, Reader};

impl<S: Scalar> Reader<'_, S> {
    pub(super) fn view(&mut self, line: usize) -> Result<(), NffError> {
        if self.has_view {
            return Err(NffError::new(line, "a second view `v`"));
        }
        let (mut from, mut at, mut up, mut angle) = (None, None, None, None);
        while let Some(word) = self.words.peek() {
            match word.text.to_ascii_lowercase().as_str() {
                "from" => from = Some(self.after_key(|reader| reader.point("from"))?),
                "at" => at = Some(self.after_key(|reader| reader.point("at"))?),
                "up" => up = Some(self.after_key(|reader| reader.direction("up"))?),
                "angle" => angle = Some(self.after_key(|reader| reader.angle())?),
                "hither" => drop(self.after_key(|reader| reader.words.number("hither"))?),
                "yon" => drop(self.after_key(|reader| reader.words.number("yon"))?),
                "resolution" => self.scene.size = Some(self.after_key(|reader| reader.size())?),
                _ => break,
            }
        }
        let end = self
            .words
            .peek()
            .map_or(String::new(), |word| format!(" before `{}` in line {}", word.text, word.line));
        let missing = |name| {
            let message = format!("the view `v` has no `{name}`{end}");
            move || NffError::new(line, message)
        };
        let eye: S::Vec3 = from.ok_or_else(missing("from"))?;
        let look_at = at.ok_or_else(missing("at"))?;
        let up = up.ok_or_else(missing("up"))?;
        let fov = angle.ok_or_else(missing("angle"))?;
        let forward = (look_at - eye).normalize();
        if forward == S::Vec3::ZERO || !forward.is_finite() {
            return Err(NffError::new(line, "`from` and `at` of the view are too close together"));
        }
        let up = upright::<S>(forward, up);
        let projection = Projection::Pinhole { fov };
        self.scene.builder.camera = Camera { eye, look_at, up, projection };
        self.has_view = true;
        Ok(())
    }

    /// Takes the key that was peeked at, and reads what follows it.
    fn after_key<T>(
        &mut self,
        read: impl FnOnce(&mut Self) -> Result<T, NffError>,
    ) -> Result<T, NffError> {
        self.words.take();
        read(self)
    }

    fn angle(&mut self) -> Result<S, NffError> {
        let degrees = self.words.number("angle")?;
        // Bounded first: not every number format can hold what the file says.
        let angle = S::from_f64(Number::clamp(degrees, 0.0, 180.0));
        if angle > S::ZERO && angle < S::from_i32(180) {
            return Ok(angle);
        }
        Err(self.refuse(format!("`angle` must be between 0 and 180 degrees, not {degrees}")))
    }

    fn size(&mut self) -> Result<(u32, u32), NffError> {
        let mut side = || {
            let pixels = self.words.count("resolution")?;
            let legal = u32::try_from(pixels).ok().filter(|&pixels| pixels > 0);
            legal.ok_or_else(|| {
                NffError::new(self.words.line(), format!("`resolution` cannot be {pixels} pixels"))
            })
        };
        Ok((side()?, side()?))
    }

    pub(super) fn light(&mut self) -> Result<(), NffError> {
        let at = self.point("l")?;
        let color = if self.words.number_follows() { Some(self.color("l")?) } else { None };
        self.lamps.push(Lamp { at, color });
        Ok(())
    }

    pub(super) fn fill(&mut self, line: usize) -> Result<(), NffError> {
        let color = self.color("f")?;
        let diffuse = self.amount("f: Kd")?;
        let specular = self.amount("f: Ks")?;
        let shine = self.words.number("f: Shine")?;
        if shine < 0.0 {
            return Err(self.refuse(format!("f: Shine must not be negative, and is {shine}")));
        }
        let shininess = S::from_f64(Number::min(shine, S::COORD_MAX.to_f64()));
        let transmit = self.amount("f: T")?;
        let stated = self.words.number("f: index of refraction")?;
        if transmit > S::ZERO && !(0.1..=10.0).contains(&stated) {
            let message = "f: the index of refraction must be between 0.1 and 10 where T is not 0";
            return Err(self.refuse(format!("{message}, and is {stated}")));
        }
        let ior = if transmit > S::ZERO { S::from_f64(stated) } else { S::ONE };
        let material = Material {
            color: Paint::Solid(color),
            diffuse,
            specular,
            shininess,
            reflect: specular,
            transmit,
            ior,
            ..Material::matte(color)
        };
        let Rgb { r, g, b } = color;
        let key = [r, g, b, diffuse, specular, shininess, transmit, ior];
        let key = key.map(|number| number.to_f64().to_bits());
        let index = match self.known.get(&key) {
            Some(&index) => index,
            None => {
                let added = self.scene.builder.material(material);
                let index = added.map_err(|error| NffError::new(line, error.to_string()))?;
                self.known.insert(key, index);
                index
            }
        };
        self.material = Some(index);
        Ok(())
    }

    /// A direction, scaled so that any number format can hold it.
    fn direction(&mut self, of: &str) -> Result<S::Vec3, NffError> {
        let direction = within_one(self.words.numbers(of)?);
        direction
            .map(|parts| S::Vec3::from_array(parts.map(S::from_f64)))
            .ok_or_else(|| self.refuse(format!("`{of}` has no length")))
    }
}

/// A direction that can be up for a unit line of sight: the wanted one, unless the two are parallel.
fn upright<S: Scalar>(forward: S::Vec3, wanted: S::Vec3) -> S::Vec3 {
    if forward.cross(wanted.normalize()).length() > S::EPSILON * S::from_i32(32) {
        return wanted;
    }
    if forward.z().abs() < S::from_ratio(9, 10) {
        S::Vec3::new(S::ZERO, S::ZERO, S::ONE)
    } else {
        S::Vec3::new(S::ZERO, S::ONE, S::ZERO)
    }
}

/// The same direction with 1 as its greatest magnitude, however small or large it was; `None`
/// for one without a length.
pub(super) fn within_one(direction: [f64; 3]) -> Option<[f64; 3]> {
    let size = direction.iter().fold(0.0, |size, part| Number::max(size, Number::abs(*part)));
    (size > 0.0).then(|| direction.map(|part| part / size))
}
