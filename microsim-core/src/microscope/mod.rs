//! The microscope: pictures of a world as light would make them.
//!
//! ```text
//!   World --> specimen --> waves of light --> optics --> film --> bytes
//!             matter:      E, and the        one image   grain,
//!             phase, dyes  surround S        per mode    levels
//! ```
//!
//! Everything on the slide has an optical thickness and takes up dye (its look: data, in the file of each organism). The optics
//! make an image of that (`optics`: one file per mode), and the film records it. Lengths are in micrometres, phases in
//! radians at 0.55 micrometres.
//!
//! Taking a picture reads the world and nothing else: no clock, no memory of earlier pictures. Equal worlds and settings
//! give equal bytes on every platform. An [`Exposure`] is computed in rows, in any portions and order, so that a caller
//! may spread it over threads of its own.
//!
//! ```
//! use microsim_core::microscope::{Field, Film, Microscope, Optics};
//! use microsim_core::{AmoeboidCellSpec, Placement, World, WorldConfig, glam::Vec2};
//!
//! let mut world = World::new(WorldConfig::default())?;
//! world.spawn(&AmoeboidCellSpec::default().into(), Placement::at(80.0, 45.0))?;
//! let field = Field { centre: Vec2::new(80.0, 45.0), width: 40.0, pixels: [64, 48] };
//! let microscope = Microscope { optics: Optics::PHASE_CONTRAST, film: Film::CINE };
//! let exposure = microscope.expose(&world, field)?;
//! let bytes = exposure.rows(0..48);
//! assert_eq!(bytes.len(), 64 * 48 * 3);
//! # Ok::<(), microsim_core::Error>(())
//! ```

pub mod coding;
mod exposure;
mod field;
mod film;
mod glsl;
mod gpu;
mod maths;
mod matter;
mod noise;
mod optics;
mod painting;
mod raster;
pub mod recipe;
mod sensor;
mod specimen;
mod surround_wave;
mod wave;

pub use exposure::{Exposure, Microscope};
pub use field::Field;
pub use film::Film;
pub use optics::Optics;
