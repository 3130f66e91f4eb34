//! Tables of textures, ramps, images and channels that are refused, each by the field that is wrong.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    clippy::indexing_slicing,
    reason = "that is how a test fails"
)]

use nostray::glam::Vec3;
use nostray::*;

/// The tables, to be spoilt one thing at a time: a checker of grey and of noise, and an image.
#[derive(Clone)]
struct Tables {
    textures: Vec<Texture<f32>>,
    stops: Vec<Stop<f32>>,
    images: Vec<Image>,
    pixels: Vec<u8>,
    channels: Vec<Channel<f32>>,
    materials: Vec<Material<f32>>,
    placements: Vec<Placement<f32>>,
}

const GREY: Rgb<f32> = Rgb::new(0.5, 0.5, 0.5);

impl Tables {
    fn good() -> Self {
        let image = Pattern::Image { image: 0, filter: Filter::Bilinear };
        let (format, transfer) = (Format::Rgb8, Transfer::Srgb);
        let relief = Channel::Relief { texture: 2, depth: 0.1, step: 0.01 };
        let share = Channel::Share { of: Parameter::Diffuse, texture: 0, low: 0.0, high: 1.0 };
        let channels = Channels { first: 0, count: 2 };
        Self {
            textures: vec![
                Texture::new(Pattern::Noise, Ramp::GREY),
                Texture::new(Pattern::Checker, Ramp::new(0, 2)),
                Texture::new(image, Ramp::GREY),
            ],
            stops: vec![
                Stop::color(0.0, GREY),
                Stop { at: 1.0, paint: Paint::Texture(0) },
                Stop::color(0.5, GREY),
            ],
            images: vec![Image { first: 2, width: 3, height: 2, format, transfer }],
            pixels: vec![7; 20],
            channels: vec![share, relief],
            materials: vec![Material { channels, ..Material::matte(GREY) }],
            placements: vec![Placement::new(&Affine::identity()).unwrap()],
        }
    }

    fn scene(&self) -> Result<Scene<'_, f32>, SceneError> {
        Scene::new(Parts {
            textures: &self.textures,
            stops: &self.stops,
            images: &self.images,
            pixels: &self.pixels,
            channels: &self.channels,
            materials: &self.materials,
            placements: &self.placements,
            ..Parts::seen_by(Camera::pinhole(Vec3::Z, Vec3::ZERO, Vec3::Y, 40.0))
        })
    }
}

/// Why the good tables are refused after a change.
fn refused(spoil: impl FnOnce(&mut Tables)) -> SceneError {
    let mut tables = Tables::good();
    assert!(tables.scene().is_ok());
    spoil(&mut tables);
    tables.scene().expect_err("it is spoilt")
}

/// The field that is named.
fn field(spoil: impl FnOnce(&mut Tables)) -> (Item, &'static str) {
    match refused(spoil) {
        SceneError::NotFinite { at, field }
        | SceneError::NotPositive { at, field }
        | SceneError::TooLarge { at, field }
        | SceneError::OutOfRange { at, field, .. } => (at, field),
        other => panic!("{other}"),
    }
}

#[test]
fn numbers_of_textures_are_in_their_ranges() {
    let of = |change: fn(&mut Texture<f32>)| {
        let (at, field) = field(|tables| change(&mut tables.textures[0]));
        assert_eq!(at, Item::Texture(0));
        field
    };
    assert_eq!(of(|t| t.size = [1.0, 1.0, -1.0]), "size");
    assert_eq!(of(|t| t.size = [1.0, 1e30, 1.0]), "size");
    assert_eq!(of(|t| t.size = [f32::NAN; 3]), "size");
    assert_eq!(of(|t| t.warp = 101.0), "warp");
    assert_eq!(of(|t| t.warp = f32::INFINITY), "warp");
    assert_eq!(of(|t| t.octaves.count = 0), "octaves");
    assert_eq!(of(|t| t.octaves.count = 11), "octaves");
    assert_eq!(of(|t| t.octaves.gain = -0.1), "gain");
    assert_eq!(of(|t| t.octaves.gain = f32::NAN), "gain");
    assert_eq!(of(|t| t.mapping = Mapping::Toroidal { major: 0.0 }), "major");
    assert_eq!(of(|t| t.pattern = Pattern::Wood { wobble: f32::NAN }), "wobble");
    assert_eq!(of(|t| t.pattern = Pattern::Marble { strength: 1e9 }), "strength");
    assert_eq!(of(|t| t.pattern = Pattern::Agate { strength: f32::NAN }), "strength");
    assert_eq!(of(|t| t.pattern = Pattern::Spots { radius: 0.0 }), "radius");
    assert_eq!(of(|t| t.pattern = Pattern::Checker), "ramp", "parts need stops");
    assert_eq!(
        of(|t| (t.mapping, t.space) = (Mapping::Uv, Space::Shape)),
        "place",
        "a surface's own coordinates are in no space"
    );
    let with = |pattern| field(|tables| tables.textures[1].pattern = pattern).1;
    assert_eq!(with(Pattern::Brick { mortar: 1.5 }), "mortar");
    assert_eq!(with(Pattern::Hexagons { gap: -0.5 }), "gap");
    let image = Pattern::Image { image: 0, filter: Filter::Nearest };
    assert_eq!(with(image), "ramp", "an image has no stops");
}

#[test]
fn ramps_are_in_order_and_in_their_table() {
    let of = |change: fn(&mut Tables)| {
        let (at, field) = field(change);
        assert_eq!((at, field), (Item::Texture(1), "ramp"));
    };
    of(|t| t.stops[0].at = -0.1);
    of(|t| t.stops[1].at = 1.5);
    of(|t| t.stops[1].at = f32::NAN);
    of(|t| t.stops[0].at = 1.0 + 1e-6);
    of(|t| (t.stops[0].at, t.stops[1].at) = (0.75, 0.5));
    of(|t| t.textures[1].ramp.count = 300);
    let joint = |t: &mut Tables| {
        t.textures[1] = Texture::new(Pattern::Brick { mortar: 0.1 }, Ramp::new(0, 1));
    };
    of(joint);
    let beyond = |index, len| SceneError::IndexOutOfRange {
        at: Item::Texture(1),
        table: "stops",
        index,
        len,
    };
    assert_eq!(refused(|t| t.textures[1].ramp.first = 2), beyond(3, 3));
    assert_eq!(refused(|t| t.textures[1].ramp.first = u16::MAX), beyond(65_536, 3));
    let dark = refused(|t| t.stops[0].paint = Paint::Solid(Rgb::new(0.0, -1.0, 0.0)));
    let allowed = "at least 0";
    assert_eq!(dark, SceneError::OutOfRange { at: Item::Texture(1), field: "color", allowed });
    let order = refused(|t| t.stops[1].paint = Paint::Texture(1));
    assert_eq!(order, SceneError::TextureOrder { at: Item::Texture(1), names: 1 });
}

#[test]
fn images_have_all_their_pixels() {
    let at = Item::Texture(2);
    let pixels = |index, len| SceneError::IndexOutOfRange { at, table: "pixels", index, len };
    assert_eq!(refused(|t| t.pixels.truncate(19)), pixels(19, 19));
    assert_eq!(refused(|t| t.images[0].height = 3), pixels(28, 20));
    assert_eq!(refused(|t| t.images[0].first = u32::MAX), pixels(u32::MAX, 20));
    assert_eq!(field(|t| t.images[0].width = 0), (at, "image"));
    assert_eq!(field(|t| t.images[0].height = 0), (at, "image"));
    let missing = SceneError::IndexOutOfRange { at, table: "images", index: 0, len: 0 };
    assert_eq!(refused(|t| t.images.clear()), missing);
    let most = |t: &mut Tables| {
        t.images[0] = Image { width: u16::MAX, height: u16::MAX, ..t.images[0] };
    };
    assert_eq!(refused(most), pixels(u32::MAX, 20), "an image has less than 2³² bytes");
}

#[test]
fn channels_are_legal() {
    let at = Item::Material(0);
    let beyond = |table, index, len| SceneError::IndexOutOfRange { at, table, index, len };
    assert_eq!(refused(|t| t.channels.truncate(1)), beyond("channels", 1, 1));
    let with = |channel| move |t: &mut Tables| t.channels[0] = channel;
    let relief = |texture, depth, step| Channel::Relief { texture, depth, step };
    assert_eq!(refused(with(relief(3, 0.1, 0.1))), beyond("textures", 3, 3));
    assert_eq!(field(with(relief(0, f32::NAN, 0.1))), (at, "depth"));
    assert_eq!(field(with(relief(0, 1e6, 0.1))), (at, "depth"));
    assert_eq!(field(with(relief(0, 0.1, 0.0))), (at, "step"));
    assert_eq!(field(with(relief(0, 0.1, 1e-6))), (at, "step"), "heights must be told apart");
    assert_eq!(field(with(relief(0, 0.1, f32::NAN))), (at, "step"));
    let share = |low, high| Channel::Share { of: Parameter::Ambient, texture: 0, low, high };
    for (low, high) in [(-0.1, 1.0), (0.0, 1.1), (f32::NAN, 1.0), (0.0, f32::INFINITY)] {
        assert_eq!(field(with(share(low, high))), (at, "share"));
    }
}

#[test]
fn the_ways_through_a_texture_are_bounded() {
    // Each texture names the one before over and over: the ways multiply.
    let mut tables = Tables::good();
    tables.textures.clear();
    tables.stops.clear();
    tables.materials.clear();
    for index in 0..6_u16 {
        let first = tables.stops.len() as u16;
        for n in 0..8 {
            let paint = match index.checked_sub(1) {
                Some(before) => Paint::Texture(before),
                None => Paint::Solid(GREY),
            };
            tables.stops.push(Stop { at: n as f32 / 8.0, paint });
        }
        tables.textures.push(Texture::new(Pattern::Noise, Ramp::new(first, 8)));
    }
    let at = Item::Texture(3);
    assert_eq!(tables.scene().err(), Some(SceneError::TooDeep { at, limit: 8 }));
    tables.textures.truncate(3);
    assert!(tables.scene().is_ok());
}

#[test]
fn the_builder_takes_back_what_has_no_room() {
    let mut builder: SceneBuilder<f32, Fixed<1, 1, 2, 3, 0, 4>> = SceneBuilder::new();
    let stops = [Stop::color(0.0, GREY); 4];
    let full = |table, capacity| SceneError::Full { table, capacity };
    assert_eq!(builder.ramp(&stops, Blend::Linear), Err(full("stops", 3)));
    assert_eq!(builder.ramp(&stops[..2], Blend::Linear), Ok(Ramp::new(0, 2)));
    assert_eq!(builder.ramp(&stops[..2], Blend::Linear), Err(full("stops", 3)));
    let (format, transfer) = (Format::Grey8, Transfer::Srgb);
    let image = Image { first: 9, width: 2, height: 2, format, transfer };
    assert_eq!(builder.image(image, &[0; 5]), Err(full("pixels", 4)));
    assert_eq!(builder.image(image, &[1, 2, 3, 4]), Ok(0));
    assert_eq!(builder.scene().unwrap().parts().images[0].first, 0);
    assert_eq!(builder.scene().unwrap().parts().pixels, [1, 2, 3, 4]);
    let relief = Channel::Relief { texture: 0, depth: 0.1, step: 0.1 };
    assert_eq!(builder.channels(&[relief; 3]), Err(full("channels", 2)));
    assert_eq!(builder.channels(&[relief; 2]), Ok(Channels { first: 0, count: 2 }));
}
