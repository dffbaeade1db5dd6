//! Blueprint: the particles, constraints and capabilities that a spec amounts to.

use crate::capability::Locomotion;
use crate::capability::division::DivisionParams;
use crate::capability::phagocytosis::{PhagocytosisParams, PreyClass};
use crate::error::Error;
use crate::kind::Kind;
use crate::solver::fluid::FluidParams;
use crate::template::{Node, Template};
use glam::Vec2;

/// What a spec amounts to.
#[derive(Clone, Debug)]
pub(crate) struct Blueprint {
    pub kind: Kind,
    /// Its discs and constraints; none for fluid on its own.
    pub template: Option<Template>,
    /// Size of the organism relative to the template: templates of equal shape are shared by all sizes ...
    pub scale: f32,
    /// ... and masses.
    pub mass: f32,
    /// Radius of its membrane at rest less that of its content, units, see [`crate::solver::membrane::Membrane::rim`]; none
    /// if its outline is no membrane, which may grow, but a ring that the template's constraints hold together.
    pub rim: Option<f32>,
    pub fluid: Option<FluidPlan>,
    pub locomotion: Locomotion,
    /// Speed when it moves, units/s.
    pub speed: f32,
    /// Area when spawned, square units (thesis, 3.3.1: of the initial ellipse).
    pub area: f32,
    pub engulfer: Option<PhagocytosisParams>,
    pub prey: Option<PreyClass>,
    pub divider: Option<DivisionParams>,
}

/// Fluid that comes with an organism.
#[derive(Clone, Debug)]
pub(crate) struct FluidPlan {
    pub params: FluidParams,
    /// Places in the organism's own frame.
    pub points: Vec<Vec2>,
    /// Whether it is held by a membrane of its own rather than mixing with other fluid of its kind.
    pub is_enclosed: bool,
}

impl Blueprint {
    /// Nothing yet but its area: at rest, without capabilities.
    pub(crate) fn of(kind: Kind, area: f32) -> Self {
        Self {
            kind,
            template: None,
            scale: 1.0,
            mass: 1.0,
            rim: None,
            fluid: None,
            locomotion: Locomotion::None,
            speed: 0.0,
            area,
            engulfer: None,
            prey: None,
            divider: None,
        }
    }

    /// One disc.
    pub(crate) fn disc(kind: Kind, radius: f32, mass: f32) -> Result<Self, Error> {
        let mut builder = Template::builder();
        builder.node(Node::disc(Vec2::ZERO, 1.0, 1.0));
        let template = Some(builder.build()?);
        Ok(Self { template, scale: radius, mass, ..Self::of(kind, std::f32::consts::PI * radius * radius) })
    }

    /// Whether it is fluid or a membrane around fluid.
    pub(crate) fn holds_fluid(&self) -> bool {
        self.rim.is_some() || self.fluid.is_some()
    }

    pub(crate) fn particle_count(&self) -> usize {
        let nodes = self.template.as_ref().map_or(0, |template| template.nodes().len());
        nodes + self.fluid.as_ref().map_or(0, |fluid| fluid.points.len())
    }

    pub(crate) fn extent(&self) -> f32 {
        let body = self.template.as_ref().map_or(0.0, |template| template.extent() * self.scale);
        self.fluid
            .iter()
            .flat_map(|fluid| fluid.points.iter().map(|p| p.length() + 0.5 * fluid.params.spacing))
            .fold(body, |far, reach| if reach > far { reach } else { far })
    }
}
