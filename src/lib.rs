//! An allocation-free, deterministic recursive ray tracer for microcontrollers and kernels:
//! the same bits on every target.
//!
//! The modules are listed in the order of the data, from a number to a picture; each knows
//! those before it and none after:
//!
//! | module | holds |
//! | --- | --- |
//! | [`scalar`] | the number that everything is made of, its companions, and the vector of three |
//! | [`fixed_point`] | that number in fixed point; the floats need no names |
//! | [`ray`], [`place`] | rays and where they start; the coordinates of placed solids |
//! | [`span`], [`bounds`], [`hierarchy`] | intervals of a ray and set operations on them; boxes, and boxes in boxes |
//! | [`shape`], [`solid`] | the solids; trees of them by set operations |
//! | [`stats`] | what was done |
//! | [`color`], [`texture`], [`material`] | what a surface looks like |
//! | [`light`], [`camera`], [`background`] | what it is lit by, and seen from and against |
//! | [`error`] | what can be wrong with a scene |
//! | [`scene`] | tables of all this, borrowed and checked; nearest hit and shadows |
//! | [`render`] | the picture, ray by ray, on a bounded stack |
//! | `display` | a picture on a display, with the feature `embedded-graphics` |
#![no_std]
#![forbid(unsafe_code)]

pub mod scalar;

mod float;

pub mod fixed_point;
mod math;
pub mod needs;
#[allow(dead_code, reason = "solids of a higher degree use one basis or the other")]
mod roots;

mod interval;

pub mod ray;

pub mod place;

pub mod span;

pub mod bounds;

pub mod hierarchy;

pub mod shape;

pub mod solid;

pub mod stats;

pub mod color;

pub mod texture;

pub mod material;

pub mod light;

pub mod camera;

pub mod background;

pub mod error;

pub mod scene;

mod look;
mod shade;

pub mod render;

#[cfg(feature = "embedded-graphics")]
pub mod display;

pub use background::Background;
pub use bounds::Bounds;
pub use camera::{Camera, Projection};
pub use color::{Dither, Rgb, Transfer};
pub use error::{Item, SceneError};
pub use fixed;
pub use fixed_point::{Q16, Q32};
pub use glam;
pub use hierarchy::Branch;
pub use light::{Attenuation, Light, Spotlight};
pub use material::{Fresnel, Highlight, Material};
pub use place::{Affine, Placement};
pub use ray::Ray;
pub use render::{Depth, Pixel, Render, Step};
pub use scalar::{Axis, Number, Real, Scalar, Vector};
pub use scene::{
    Corners, Fixed, Form, Heights, Hit, Limits, Metaball, Object, Parts, Profile, Scene,
    SceneBuilder, Storage, Store, Triangles,
};
pub use shape::{
    Blob, Cone, Cuboid, Curve, Cylinder, Filled, Implicit, Lathe, Mesh, Patches, Plane, Polygon,
    Prism, Quadric, Shape, Sphere, Tables, Torus, Triangle, Winding,
};
pub use solid::{Leaf, Node};
pub use span::{Boundary, Operator, Passage, Spans};
pub use stats::{Event, Stats, Tally};
pub use texture::{
    Blend, Channel, Channels, Filter, Format, Image, Mapping, Paint, Parameter, Pattern, Ramp,
    Space, Spot, Stop, Texture, Wrap, noise::Octaves,
};

/// The examples of the README, which must compile and hold.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
