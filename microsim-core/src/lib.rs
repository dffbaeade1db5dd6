#![doc = include_str!("../README.md")]
//!
//! A [`World`] holds organisms made of discs that constraints hold together. Each [`World::step`] runs the same list of phases
//! (see [`Phase`]): what organisms want becomes velocities, pairs that may touch are found once, and then small substeps predict
//! positions, correct them (fluid, constraints, contacts, walls) and turn the corrections back into velocities.

#![cfg_attr(test, allow(clippy::disallowed_methods, reason = "tests measure; only stepping has to be bit-exact"))]

mod actuation;
mod arena;
#[cfg(any(feature = "microscope", feature = "scenario"))]
mod bare_text;
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
mod instruction_set;
mod joint;
mod kind;
#[cfg_attr(not(feature = "microscope"), allow(dead_code, reason = "only the microscope reads the rest"))]
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
mod supply;
mod template;
mod value_walk;
mod world;

pub use {glam, parry2d};

#[doc(hidden)]
pub use {
    bodies::*, contacts::*, controllers::*, forces::*, joints::*, measures::*, media::*, obstacles::*, organisms::*,
    queries::*, simulation::*, supplies::*, views::*,
};

/// What most programs need: `use microsim_core::prelude::*;`.
///
/// ```
/// use microsim_core::prelude::*;
///
/// let mut world = World::new(WorldConfig { gravity: Vec2::new(0.0, -10.0), ..WorldConfig::default() })?;
/// world.add_obstacle(Obstacle::new(SharedShape::cuboid(20.0, 1.0), Pose::translation(40.0, 10.0)))?;
/// let ball = world.spawn(&AgarSpec::default().into(), Placement::at(40.0, 20.0))?;
/// (0..120).for_each(|_| world.step(&Inputs::new()));
/// assert!((world.centroid(ball).unwrap().y - 12.0).abs() < 0.1);
/// # Ok::<(), Error>(())
/// ```
pub mod prelude {
    pub use crate::bodies::{CollisionGroups, Material, Node, Template, TemplateId};
    pub use crate::contacts::{Collider, ContactPoint, Event, Wall};
    pub use crate::controllers::Controller;
    pub use crate::forces::{Actuation, ForceField};
    pub use crate::joints::{JointEnd, JointId, JointKind, JointSpec};
    pub use crate::obstacles::{Obstacle, ObstacleId, ObstacleMotion};
    pub use crate::organisms::{
        AgarSpec, AmoeboidCellSpec, BacillusSpec, CoccusSpec, FluidBlockSpec, Kind, OrganismId, OrganismSpec,
        Placement, PlateletSpec, ProbeSpec, RedCellSpec, RigidCellSpec,
    };
    pub use crate::queries::QueryFilter;
    pub use crate::simulation::{Error, Inputs, Intent, World, WorldConfig};
    pub use crate::supplies::{Drain, Emitter, Recipe};
    pub use crate::views::{OrganismView, View};
    pub use glam::Vec2;
    pub use parry2d::math::Pose;
    pub use parry2d::shape::SharedShape;
}

/// The world: settings, inputs, steps, errors, and comparing two of them.
pub mod simulation {
    pub use crate::config::{Side, Sides, Substrate, WorldConfig};
    pub use crate::error::{Error, ErrorKind};
    pub use crate::float_environment::with_default_float_environment;
    pub use crate::inputs::{Inputs, Intent};
    pub use crate::instruction_set::InstructionSet;
    pub use crate::rng::Rng;
    pub use crate::step::Phase;
    pub use crate::world::World;
    pub use crate::world::state::difference::Difference;
    pub use crate::world::state::validate::Violation;
}

/// The library's organisms: specs, and what they can do.
pub mod organisms {
    pub use crate::behavior::crawl::front_and_rear::MembraneRegion;
    pub use crate::capability::crawl::PseudopodParams;
    pub use crate::capability::crawl::presets::Crawl;
    pub use crate::capability::division::DivisionParams;
    pub use crate::capability::phagocytosis::{IngestionWay, MealPhase, PhagocytosisParams, PreyClass};
    pub use crate::id::OrganismId;
    pub use crate::kind::Kind;
    pub use crate::organism::agar::AgarSpec;
    pub use crate::organism::amoeboid_cell::AmoeboidCellSpec;
    pub use crate::organism::bacillus::BacillusSpec;
    pub use crate::organism::coccus::CoccusSpec;
    pub use crate::organism::fluid_block::FluidBlockSpec;
    pub use crate::organism::platelet::PlateletSpec;
    pub use crate::organism::probe::ProbeSpec;
    pub use crate::organism::red_cell::RedCellSpec;
    pub use crate::organism::rigid_cell::RigidCellSpec;
    pub use crate::organism::{OrganismSpec, Placement, SpecTable};
    pub use crate::spec_field::{FieldValue, FieldVisitor, SpecField};
}

/// Controllers: what organisms want when nobody tells them.
pub mod controllers {
    pub use crate::capability::controller::Controller;
    pub use crate::capability::controller::avoidance::{Avoidance, AvoidanceParams};
    pub use crate::capability::controller::brownian::{Brownian, BrownianParams};
    pub use crate::capability::controller::chemotaxis::{Chemotaxis, ChemotaxisParams};
    pub use crate::capability::controller::flee::{Flee, FleeParams};
    pub use crate::capability::controller::patrol::Patrol;
    pub use crate::capability::controller::persistent_walk::{PersistentWalk, PersistentWalkParams};
    pub use crate::capability::controller::pursue::{Pursue, PursueParams};
    pub use crate::capability::controller::ram::Ram;
    pub use crate::capability::controller::run_and_tumble::{RunAndTumble, RunAndTumbleParams};
    pub use crate::capability::controller::thrash::Thrash;
    pub use crate::capability::controller::wander::Wander;
}

/// Bodies of your own: templates of nodes and constraints, materials, collision groups.
pub mod bodies {
    pub use crate::id::TemplateId;
    pub use crate::particle::{CollisionGroups, Material};
    pub use crate::solver::constraint::*;
    pub use crate::template::{Half, Node, Propulsion, Role, Template, TemplateBuilder};
}

/// Forces on organisms and nodes, for a step or in a region.
pub mod forces {
    pub use crate::actuation::Actuation;
    pub use crate::force_field::{AccelerationGrid, FieldKind, ForceField, Region};
    pub use crate::id::FieldId;
}

/// Joints between nodes, organisms and places.
pub mod joints {
    pub use crate::id::JointId;
    pub use crate::joint::{JointEnd, JointKind, JointSpec};
    pub use crate::world::joint::JointView;
}

/// What organisms are in: fluids and chemicals.
pub mod media {
    pub use crate::capability::exchange::Exchange;
    pub use crate::chemical::{Chemical, ChemicalSpec};
    pub use crate::id::ChemicalId;
    pub use crate::solver::fluid::{FluidMode, FluidParams};
}

/// Emitters and drains: what comes into a world and leaves it while it runs.
pub mod supplies {
    pub use crate::event::Outlet;
    pub use crate::id::{DrainId, EmitterId};
    pub use crate::supply::{Drain, Emitter, Recipe};
}

/// Obstacles: fixed, moved, one-way, sensors.
pub mod obstacles {
    pub use crate::collision::obstacle::{Obstacle, ObstacleMotion};
    pub use crate::id::ObstacleId;
}

/// Events, and reports of contacts.
pub mod contacts {
    pub use crate::collider::{Collider, ContactPoint, ContactReporting, Wall};
    pub use crate::event::{Event, Refusal};
}

/// Queries: rays, casts of discs, nearest points, overlaps.
pub mod queries {
    pub use crate::world::query::{NearestPoint, Queries, QueryFilter, RayHit};
}

/// Reading a world for pictures.
pub mod views {
    pub use crate::look::drawn::{Colour, DrawnLook, Form, Tint};
    pub use crate::world::view::anatomy::Bond;
    pub use crate::world::view::links::YieldingLink;
    pub use crate::world::view::moment::Moment;
    pub use crate::world::view::{OrganismView, ParticleView, View};
}

/// Measures of a world.
pub mod measures {
    pub use crate::world::measure::Measure;
    pub use crate::world::measure::census::Census;
    pub use crate::world::measure::membrane_quality::{CrawlQuality, MembraneQuality};
    pub use crate::world::measure::quality::Quality;
}
