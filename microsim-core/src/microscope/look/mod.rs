//! How organisms look: data, one file each. What the data mean is [`super::specimen`]'s matter.
//!
//! A new organism is a new file here with one constant, and an arm in [`Look::of`].

mod agar;
mod amoeba;
mod bacillus;
mod coccus;
mod fluid;
mod neutrophil;
mod paramecium;
mod plain;
mod platelet;
mod probe;
mod red_cell;

use super::matter::Matter;
use crate::kind::Kind;
use crate::template::Role;
use crate::world::view::OrganismView;

/// Refraction: radians of delay per micrometre of something whose index exceeds the medium's by 1, at 0.55 micrometres.
pub(super) const WAVE: f32 = std::f32::consts::TAU / 0.55;

/// Radius of the membrane's discs, micrometres, from which an amoeboid cell is an amoeba rather than a blood cell: its
/// daughters have the same.
const AMOEBA_NODE: f32 = 0.6;

/// The way in which an organism is imaged.
#[derive(Clone, Copy, Debug)]
pub(super) enum Look {
    /// A body that can be described from its centre outwards.
    Round(&'static RoundLook),
    /// A cell of any shape that crawls.
    Amoeboid(&'static AmoeboidLook),
    /// A rod from its first particle to its last.
    Rod(&'static Matter),
    /// Each of its particles for itself.
    Drops(&'static Matter),
}

impl Look {
    pub(super) fn of(organism: OrganismView<'_>) -> Self {
        match organism.kind() {
            Kind::RigidCell => Self::Round(&paramecium::LOOK),
            Kind::AmoeboidCell => {
                let node = organism.particles().find(|particle| particle.role == Role::Membrane);
                let is_amoeba = node.is_some_and(|node| node.radius > AMOEBA_NODE);
                Self::Amoeboid(if is_amoeba { &amoeba::LOOK } else { &neutrophil::LOOK })
            }
            Kind::Platelet => Self::Round(&platelet::LOOK),
            Kind::RedCell => Self::Round(&red_cell::LOOK),
            Kind::Agar => Self::Round(&agar::LOOK),
            Kind::Coccus => Self::Round(&coccus::LOOK),
            Kind::Probe => Self::Round(&probe::LOOK),
            Kind::Bacillus => Self::Rod(&bacillus::LOOK),
            Kind::FluidBlock => Self::Drops(&fluid::LOOK),
            Kind::Custom => Self::Round(&plain::LOOK),
        }
    }
}

/// A body described from its centre outwards. Lengths are in its mean radii unless they say otherwise.
#[derive(Debug)]
pub(super) struct RoundLook {
    pub profile: Profile,
    /// Where the body is thickest.
    pub matter: Matter,
    /// Largest share by which one individual is thicker or thinner than another.
    pub variation: f32,
    pub texture: Texture,
    /// Size of the irregularities of the outline.
    pub unevenness: f32,
    pub inclusions: &'static [Inclusion],
    pub cilia: Option<&'static Cilia>,
    pub pellicle: Option<&'static Pellicle>,
}

impl RoundLook {
    /// A smooth dome of nothing, to start from.
    const PLAIN: Self = Self {
        profile: Profile::Dome(0.5),
        matter: Matter::NONE,
        variation: 0.0,
        texture: Texture { amount: 0.0, size: 1.0 },
        unevenness: 0.0,
        inclusions: &[],
        cilia: None,
        pellicle: None,
    };
}

/// Thickness from the centre outwards, `rho` from 0 to 1.
#[derive(Clone, Copy, Debug)]
pub(super) enum Profile {
    /// `(1 - rho^2)^power`: 0.5 is a ball.
    Dome(f32),
    /// A red cell: `sqrt(1 - rho^2) (c0 + c2 rho^2 - c4 rho^4)`, micrometres of 2.56 (Evans and Fung 1972); `c0` of
    /// individuals lies within the range.
    Biconcave { c0: [f32; 2], c2: f32, c4: f32 },
}

/// Unevenness of what is inside.
#[derive(Clone, Copy, Debug)]
pub(super) struct Texture {
    /// As a share of the matter there.
    pub amount: f32,
    /// Size of its features, micrometres.
    pub size: f32,
}

/// Things inside that keep their place in the body.
#[derive(Debug)]
pub(super) struct Inclusion {
    /// Fewest and most.
    pub count: [u32; 2],
    /// Smallest and largest radius.
    pub radius: [f32; 2],
    /// Nearest and farthest from the centre, `rho`.
    pub place: [f32; 2],
    /// Each at its thickest.
    pub matter: Matter,
    pub shape: SpotShape,
}

/// How a small round thing fades outwards.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum SpotShape {
    /// Softly, without an edge.
    Bump,
    /// As thick as a ball.
    Ball,
    /// A wall around nothing.
    Ring,
}

/// A fringe of beating hairs.
#[derive(Debug)]
pub(super) struct Cilia {
    /// Number at most, and their distance at least, micrometres.
    pub most: f32,
    pub apart: f32,
    /// Of each, in radii.
    pub length: f32,
    /// Of each, micrometres.
    pub width: f32,
    pub phase: f32,
    /// Waves around the body, and beats per second: the metachronal wave.
    pub waves: f32,
    pub rate: f32,
}

/// What a ciliate's body has besides.
#[derive(Debug)]
pub(super) struct Pellicle {
    /// Furrows across the body, and their strength as a share of the matter.
    pub furrows: f32,
    pub furrow_depth: f32,
    /// Share of the matter that the oral groove lacks.
    pub groove: f32,
    /// Of the tube that leads on from its end.
    pub gullet_phase: f32,
    /// Share by which the outline differs from the body's: blunt in front, pointed behind, hollow along the groove.
    pub slipper: f32,
    /// Radius of a full contractile vacuole, and the time between two emptyings, s.
    pub vacuole: f32,
    pub vacuole_period: f32,
    pub vacuole_phase: f32,
}

/// A cell that crawls. Lengths are micrometres unless they say otherwise.
#[derive(Debug)]
pub(super) struct AmoeboidLook {
    /// In the body, where it is thickest.
    pub matter: Matter,
    /// Width of the rim in which the body rises.
    pub rim: f32,
    pub texture: Texture,
    pub lamella: Lamella,
    pub nucleus: NucleusLook,
    /// Carried by the cytoplasm.
    pub granules: &'static [GranuleLook],
    /// Retraction fibres that the tail drags behind it.
    pub fibres: u32,
    /// Smallest and largest bleb of those that come and go while it holds prey.
    pub blebs: [f32; 2],
}

/// The thin front without organelles.
#[derive(Debug)]
pub(super) struct Lamella {
    /// Share of the cell's length.
    pub length: f32,
    /// Its matter as a share of the body's.
    pub thickness: f32,
    /// Delay of the ruffles along its edge, radians, and how far inside it they run.
    pub ruffle: f32,
    pub ruffle_inset: f32,
    /// Irregularity of its edge.
    pub rags: f32,
    /// Period with which it swells and thins, s.
    pub pulse: f32,
}

/// A nucleus in lobes.
#[derive(Debug)]
pub(super) struct NucleusLook {
    /// Fewest and most lobes.
    pub lobes: [u32; 2],
    /// Smallest and largest, in the cell's mean radii.
    pub radius: [f32; 2],
    /// Share of a crawling cell's length by which it lies behind the centre.
    pub behind: f32,
    /// Distance of the lobes from the middle of the nucleus, in the cell's mean radii.
    pub spread: f32,
    pub matter: Matter,
    pub texture: Texture,
}

/// One sort of granules.
#[derive(Debug)]
pub(super) struct GranuleLook {
    /// Per square micrometre.
    pub density: f32,
    /// Median radius, its standard deviation as a logarithm, smallest and largest.
    pub radius: f32,
    pub spread: f32,
    pub limits: [f32; 2],
    /// Of a granule one micrometre thick.
    pub matter: Matter,
    pub shape: SpotShape,
}
