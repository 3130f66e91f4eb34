//! What is seen: light, textures, depth, and the pictures of the gallery to the bit.

mod channels;
mod depth;
mod display;
mod fixed_point;
mod golden;
mod light;
mod noise;
#[path = "../oracle/mod.rs"]
mod oracle;
mod textures;
