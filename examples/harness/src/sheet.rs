//! Pictures side by side on one sheet.

use nostray::{Depth, Rgb, Scene, SceneError, Stats};

use crate::raster::{Order, Raster, render};

/// A sheet of pictures: white where there is none.
#[derive(Clone, Debug)]
pub struct Sheet {
    width: usize,
    pixels: Vec<Rgb<f32>>,
}

/// So many pixels of a picture in a row and in a column for one of its place on a sheet.
const MEAN_OF: usize = 4;

impl Sheet {
    /// A white sheet.
    pub fn new(width: usize, height: usize) -> Self {
        Self { width, pixels: vec![Rgb::WHITE; width * height] }
    }

    /// Renders a scene to a place on the sheet, each pixel the mean, in linear light, of 16 of a larger picture.
    ///
    /// # Errors
    /// If the scene cannot be rendered.
    pub fn place(
        &mut self,
        scene: &Scene<'_, f32>,
        [left, top]: [usize; 2],
        [width, height]: [usize; 2],
    ) -> Result<(), SceneError> {
        let (wide, high) = ((width * MEAN_OF) as u32, (height * MEAN_OF) as u32);
        let depth = Depth::fixed(8);
        let threads = std::thread::available_parallelism().map_or(1, usize::from);
        let order =
            Order { width: wide, height: high, rows: 0..high, depth, threads, counted: false };
        let picture = render(scene, &order, &|| ())?;
        let mut sums = vec![Rgb::BLACK; width * height];
        for (index, &color) in picture.pixels.iter().enumerate() {
            let (x, y) = (index % wide as usize / MEAN_OF, index / wide as usize / MEAN_OF);
            if let Some(sum) = sums.get_mut(y * width + x) {
                // What is brighter than white must not outshine its neighbours.
                *sum += color.map(|part| if part < 1.0 { part } else { 1.0 });
            }
        }
        let share = 1.0 / (MEAN_OF * MEAN_OF) as f32;
        for (index, sum) in sums.into_iter().enumerate() {
            self.set(left + index % width, top + index / width, sum * share);
        }
        Ok(())
    }

    /// Gives a pixel a colour; what lies beyond the sheet is left out.
    pub fn set(&mut self, x: usize, y: usize, color: Rgb<f32>) {
        let inside = x < self.width;
        if let Some(pixel) = self.pixels.get_mut(y * self.width + x).filter(|_| inside) {
            *pixel = color;
        }
    }

    /// The finished sheet.
    pub fn raster(self) -> Raster<f32> {
        let height = self.pixels.len().checked_div(self.width).unwrap_or(0) as u32;
        let (width, pixels) = (self.width as u32, self.pixels);
        Raster { width, height, pixels, spent: 0.0, stats: Stats::default() }
    }
}
