//! What surfaces look like: materials, textures, and what those are made of.

use super::{SceneBuilder, Storage, Store, add, add_narrow};
use crate::error::SceneError;
use crate::material::Material;
use crate::scalar::Scalar;
use crate::texture::{Blend, Channel, Channels, Image, Ramp, Stop, Texture};

/// Adds entries one after another, or none at all; gives the index of the first.
fn add_run<T: Copy>(
    store: &mut impl Store<T>,
    table: &'static str,
    entries: &[T],
) -> Result<[u16; 2], SceneError> {
    let before = store.entries().len();
    let mut run = [u16::try_from(before).unwrap_or(u16::MAX), 0];
    for &entry in entries {
        if let Err(error) = add_narrow(store, table, entry) {
            store.truncate(before);
            return Err(error);
        }
        run[1] += 1;
    }
    Ok(run)
}

impl<S: Scalar, M: Storage> SceneBuilder<S, M> {
    /// Adds a material and gives its index.
    ///
    /// # Errors
    /// If there is no room for it.
    pub fn material(&mut self, material: Material<S>) -> Result<u16, SceneError> {
        add_narrow(&mut self.materials, "materials", material)
    }

    /// Adds a texture and gives its index. It may name the textures before it.
    ///
    /// # Errors
    /// If there is no room for it.
    pub fn texture(&mut self, texture: Texture<S>) -> Result<u16, SceneError> {
        add_narrow(&mut self.textures, "textures", texture)
    }

    /// Adds the stops of a ramp.
    ///
    /// # Errors
    /// If there is no room for them.
    pub fn ramp(&mut self, stops: &[Stop<S>], blend: Blend) -> Result<Ramp, SceneError> {
        let [first, count] = add_run(&mut self.stops, "stops", stops)?;
        Ok(Ramp { first, count, blend })
    }

    /// Adds an image with its bytes, and gives its index. Where its bytes lie is found out here, whatever it says.
    ///
    /// # Errors
    /// If there is no room for it.
    pub fn image(&mut self, image: Image, bytes: &[u8]) -> Result<u16, SceneError> {
        let before = self.pixels.entries().len();
        let image = Image { first: before as u32, ..image };
        let added = bytes.iter().try_for_each(|&byte| {
            add(&mut self.pixels, "pixels", byte)?;
            Ok(())
        });
        let added = added.and_then(|()| add_narrow(&mut self.images, "images", image));
        added.inspect_err(|_| self.pixels.truncate(before))
    }

    /// Adds the channels of a material.
    ///
    /// # Errors
    /// If there is no room for them.
    pub fn channels(&mut self, channels: &[Channel<S>]) -> Result<Channels, SceneError> {
        let [first, count] = add_run(&mut self.channels, "channels", channels)?;
        Ok(Channels { first, count })
    }
}
