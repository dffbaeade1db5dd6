//! Deterministic position-based physics for deforming single-celled organisms.
//!
//! A [`World`] holds organisms made of discs that constraints hold together. Each [`World::step`] runs the same list of
//! phases (see [`Phase`]): what organisms want becomes velocities, pairs that may touch are found once, and then small
//! substeps predict positions, correct them (fluid, constraints, contacts, walls) and turn the corrections back into
//! velocities.
//!
//! ```
//! use microsim_core::{AgarSpec, AmoeboidCellSpec, Inputs, Intent, Placement, World, WorldConfig, glam::Vec2};
//!
//! let mut world = World::new(WorldConfig { size: Vec2::new(100.0, 60.0), ..WorldConfig::default() })?;
//! let cell = world.spawn(&AmoeboidCellSpec::default().into(), Placement::at(30.0, 30.0))?;
//! world.spawn(&AgarSpec { radius: 1.0, ..AgarSpec::default() }.into(), Placement::at(70.0, 30.0))?;
//!
//! let start = world.centroid(cell).unwrap();
//! let mut inputs = Inputs::new();
//! inputs.set(cell, Intent::toward(Vec2::new(70.0, 30.0))?);
//! for _ in 0..120 {
//!     world.step(&inputs);
//! }
//! assert!(world.centroid(cell).unwrap().x > start.x + 3.0);
//! assert_eq!(world.census().leaks, 0);
//! # Ok::<(), microsim_core::Error>(())
//! ```
//!
//! The library does no input or output, reads no clock, prints nothing and has no threads of its own (feature `parallel`
//! uses rayon's current pool) and no global state. Stepping
//! cannot fail; everything handed in is checked when it is handed in. Equal configuration, seed and inputs give equal
//! bits on every platform ([`World::digest`]).

#![cfg_attr(test, allow(clippy::disallowed_methods, reason = "tests measure; only stepping has to be bit-exact"))]

mod actuation;
mod arena;
mod behavior;
mod capability;
mod chemical;
mod collider;
mod collision;
mod config;
#[cfg(feature = "drawing")]
pub mod drawing;
mod error;
mod event;
mod float_environment;
mod fnv;
mod force_field;
pub mod geometry;
mod id;
mod inputs;
mod joint;
mod kind;
#[cfg_attr(not(feature = "microscope"), allow(dead_code, reason = "only the microscope reads it"))]
mod look;
#[cfg(feature = "microscope")]
pub mod microscope;
mod organism;
mod parallel;
mod particle;
#[cfg(all(feature = "scenario", feature = "snapshot"))]
pub mod replay;
mod rng;
#[cfg(feature = "scenario")]
pub mod scenario;
mod shared;
#[cfg(feature = "snapshot")]
pub mod snapshot;
mod solver;
mod spec_field;
mod step;
mod template;
mod walk;
mod world;

pub use actuation::Actuation;
pub use behavior::crawl::MembraneRegion;
pub use capability::controller::Controller;
pub use capability::controller::avoidance::{Avoidance, AvoidanceParams};
pub use capability::controller::brownian::{Brownian, BrownianParams};
pub use capability::controller::chemotaxis::{Chemotaxis, ChemotaxisParams};
pub use capability::controller::flee::{Flee, FleeParams};
pub use capability::controller::patrol::Patrol;
pub use capability::controller::persistent_walk::{PersistentWalk, PersistentWalkParams};
pub use capability::controller::pursue::{Pursue, PursueParams};
pub use capability::controller::ram::Ram;
pub use capability::controller::run_and_tumble::{RunAndTumble, RunAndTumbleParams};
pub use capability::controller::thrash::Thrash;
pub use capability::controller::wander::Wander;
pub use capability::division::DivisionParams;
pub use capability::exchange::Exchange;
pub use capability::phagocytosis::{IngestionWay, MealPhase, PhagocytosisParams, PreyClass};
pub use chemical::{Chemical, ChemicalSpec};
pub use collider::{Collider, ContactPoint, Wall};
pub use collision::obstacle::{Obstacle, ObstacleMotion};
pub use config::WorldConfig;
pub use error::{Error, ErrorKind};
pub use event::{Event, Refusal};
pub use float_environment::with_default_float_environment;
pub use force_field::{FieldKind, ForceField, Region};
pub use id::{ChemicalId, FieldId, JointId, ObstacleId, OrganismId, TemplateId};
pub use inputs::{Inputs, Intent};
pub use joint::{JointEnd, JointKind, JointSpec};
pub use kind::Kind;
pub use organism::agar::AgarSpec;
pub use organism::amoeboid_cell::AmoeboidCellSpec;
pub use organism::bacillus::BacillusSpec;
pub use organism::coccus::CoccusSpec;
pub use organism::fluid_block::FluidBlockSpec;
pub use organism::platelet::PlateletSpec;
pub use organism::probe::ProbeSpec;
pub use organism::red_cell::RedCellSpec;
pub use organism::rigid_cell::RigidCellSpec;
pub use organism::{OrganismSpec, Placement, SpecTable};
pub use particle::{CollisionGroups, Material};
pub use rng::Rng;
pub use solver::constraint::*;
pub use solver::fluid::{FluidMode, FluidParams};
pub use solver::instruction_set::InstructionSet;
pub use spec_field::{FieldValue, FieldVisitor, SpecField};
pub use step::Phase;
pub use template::{Node, Propulsion, Role, Template, TemplateBuilder};
pub use world::World;
pub use world::contact_report::ContactReporting;
pub use world::joint::JointView;
pub use world::measure::Measure;
pub use world::measure::census::Census;
pub use world::measure::membrane_quality::{CrawlQuality, MembraneQuality};
pub use world::measure::quality::Quality;
pub use world::query::{NearestPoint, Queries, QueryFilter, RayHit};
pub use world::state::difference::Difference;
pub use world::state::validate::Violation;
pub use world::view::anatomy::Bond;
pub use world::view::moment::Moment;
pub use world::view::{OrganismView, ParticleView, View};

pub use {glam, parry2d};

/// The READMEs' examples, compiled and run with the tests.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
#[doc = include_str!("../../README.md")]
struct Readme;
