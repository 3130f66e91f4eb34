//! What rays meet: every solid and its combinations against oracles that share no code with them.

mod accuracy;
mod blob;
mod coincident;
mod conditioned;
mod csg;
mod extremes;
mod fixed_accuracy;
mod implicit;
mod lathe;
mod mesh;
mod metamorphic;
#[path = "../oracle/mod.rs"]
mod oracle;
mod patch;
mod prism;
mod quadric;
mod secondary;
mod thin;
mod torus;
mod watertight;
