//! What is said: scenes that are built, read from files and refused, and the commands.

mod builder;
#[path = "../command/mod.rs"]
mod command;
mod needs;
mod probe;
mod refusals;
mod render;
mod texture_files;
mod texture_validation;
mod validation;
