//! One file for each section of the format: its fields with their defaults and ranges, and what is made of them.

pub(crate) mod checks;
pub(crate) mod chemical;
pub(crate) mod command;
pub(crate) mod controller;
pub(crate) mod field;
pub(crate) mod game;
pub(crate) mod group;
pub(crate) mod medium;
pub(crate) mod obstacle;
pub(crate) mod output;
pub(crate) mod prototype;
pub(crate) mod slide;
pub(crate) mod spawn;
pub(crate) mod supply;
pub(crate) mod world;
