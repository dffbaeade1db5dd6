//! How organisms look: the words in which each organism's file says it, as data. What the data mean is the business of the
//! microscope's specimen, of drawings, and of the painted view.

pub(crate) mod drawn;

use drawn::{DrawnLook, Form, Tint};
use glam::Vec3;
use std::ops::{AddAssign, Mul};

/// Refraction: radians of delay per micrometre of something whose index exceeds the medium's by 1, at 0.55 micrometres.
pub(crate) const WAVE: f32 = std::f32::consts::TAU / 0.55;

/// How an organism looks.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Look {
    /// Under the microscope.
    pub image: ImageLook,
    /// In drawings.
    pub drawn: DrawnLook,
    /// In the painted view of the thesis (3.2).
    pub painted: PaintedLook,
}

/// Colours of a painted body, each channel 0 to 1.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PaintedLook {
    pub body: Vec3,
    pub rim: Vec3,
    /// Strength of the mottling.
    pub mottle: f32,
}

/// The way in which an organism is imaged.
#[derive(Clone, Copy, Debug)]
pub(crate) enum ImageLook {
    /// A body that can be described from its centre outwards.
    Round(&'static RoundLook),
    /// A cell of any shape that crawls, by the radius of its membrane's nodes, micrometres.
    Amoeboid(fn(f32) -> &'static AmoeboidLook),
    /// A rod from its first particle to its last.
    Rod(&'static Matter),
    /// Each of its particles for itself.
    Drops(&'static Matter),
}

impl Look {
    /// A plain cell: for bodies that the library does not know.
    pub(crate) const PLAIN: Self = Self {
        image: ImageLook::PLAIN,
        drawn: DrawnLook { form: Form::Plain, tint: Tint::hex([0xD9C9E6, 0xB094CB, 0x70538F, 0x70538F]), layer: 3 },
        painted: PaintedLook { body: Vec3::new(0.55, 0.62, 0.70), rim: Vec3::new(0.3, 0.35, 0.42), mottle: 0.05 },
    };
}

impl ImageLook {
    const PLAIN: Self = Self::Round(&RoundLook {
        matter: Matter { phase: 0.9, haemoglobin: 0.0, cytoplasm: 0.8, nucleus: 0.0 },
        variation: 0.1,
        texture: Texture { amount: 0.08, size: 0.5 },
        outline: OutlineLook::uneven(0.01),
        inclusions: &[Inclusion {
            count: [1, 1],
            radius: [0.30, 0.38],
            place: [0.0, 0.2],
            matter: Matter { phase: 0.25, haemoglobin: 0.0, cytoplasm: 0.0, nucleus: 0.8 },
            shape: SpotShape::Ball,
            grains: [0, 0],
        }],
        ..RoundLook::PLAIN
    });
}

/// What lies in the light's way at one place; amounts of things that lie over each other add up.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Matter {
    /// Delay of the light relative to the medium, radians at 0.55 micrometres; negative where it is thinner.
    pub phase: f32,
    /// Haemoglobin, 1 in the thickest part of a red cell.
    pub haemoglobin: f32,
    /// What eosin stains, 1 in a neutrophil's body.
    pub cytoplasm: f32,
    /// What basic dyes and nucleic acid probes stain, 1 in a nucleus.
    pub nucleus: f32,
}

impl Matter {
    pub(crate) const NONE: Self = Self { phase: 0.0, haemoglobin: 0.0, cytoplasm: 0.0, nucleus: 0.0 };

    /// As a graphics card keeps it.
    pub(crate) fn to_array(self) -> [f32; 4] {
        [self.phase, self.haemoglobin, self.cytoplasm, self.nucleus]
    }

    /// Whether matter is missing rather than there, and how much: it adds to a target or is taken from it.
    pub(crate) fn magnitude(self) -> (bool, Self) {
        if self.phase < 0.0 { (true, self * -1.0) } else { (false, self) }
    }

    /// Nothing but a delay.
    pub(crate) const fn phase(phase: f32) -> Self {
        Self { phase, ..Self::NONE }
    }
}

impl Mul<f32> for Matter {
    type Output = Self;

    fn mul(self, share: f32) -> Self {
        Self {
            phase: self.phase * share,
            haemoglobin: self.haemoglobin * share,
            cytoplasm: self.cytoplasm * share,
            nucleus: self.nucleus * share,
        }
    }
}

impl AddAssign for Matter {
    fn add_assign(&mut self, other: Self) {
        self.phase += other.phase;
        self.haemoglobin += other.haemoglobin;
        self.cytoplasm += other.cytoplasm;
        self.nucleus += other.nucleus;
    }
}

/// A body described from its centre outwards. Lengths are in its mean radii unless they say otherwise.
#[derive(Debug)]
pub(crate) struct RoundLook {
    pub profile: Profile,
    /// Where the body is thickest.
    pub matter: Matter,
    /// Standard deviation of the logarithm of an individual's thickness.
    pub variation: f32,
    pub texture: Texture,
    pub outline: OutlineLook,
    pub inclusions: &'static [Inclusion],
    pub cilia: Option<&'static Cilia>,
    pub pellicle: Option<&'static Pellicle>,
    /// Most of the tapering processes that its edge is drawn out into.
    pub filopodia: u32,
}

impl RoundLook {
    /// A smooth dome of nothing, to start from.
    pub(crate) const PLAIN: Self = Self {
        profile: Profile::Dome(0.5),
        matter: Matter::NONE,
        variation: 0.0,
        texture: Texture { amount: 0.0, size: 1.0 },
        outline: OutlineLook::EVEN,
        inclusions: &[],
        cilia: None,
        pellicle: None,
        filopodia: 0,
    };
}

/// How the outlines of individuals differ from the body's. Lengths are in its mean radii.
#[derive(Clone, Copy, Debug)]
pub(crate) struct OutlineLook {
    /// Their median size, in the body's, and the standard deviation of its logarithm.
    pub median: f32,
    pub size: f32,
    /// Median size of the wave of order 2 and of that of order 3 around the outline; if the first is 0, the outline is the body's.
    pub waves: [f32; 2],
    /// Power of the order by which higher ones are smaller, and standard deviation of the logarithm of all.
    pub decay: f32,
    pub spread: f32,
    /// Shares that are ovals, have a tail, have a bite.
    pub ovals: f32,
    pub tails: f32,
    pub bites: f32,
    /// Fewest and most spikes.
    pub spikes: [u32; 2],
}

impl OutlineLook {
    /// None.
    pub(crate) const EVEN: Self = Self::uneven(0.0);

    /// A few low waves of about this size.
    pub(crate) const fn uneven(size: f32) -> Self {
        let waves = [0.6 * size, 0.4 * size];
        Self {
            median: 1.0,
            size: 0.0,
            waves,
            decay: 1.2,
            spread: 0.4,
            ovals: 0.0,
            tails: 0.0,
            bites: 0.0,
            spikes: [0, 0],
        }
    }
}

/// Thickness from the centre outwards, `rho` from 0 to 1.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Profile {
    /// `(1 - rho^2)^power`: 0.5 is a ball.
    Dome(f32),
    /// A red cell: `sqrt(1 - rho^2) (c0 + c2 rho^2 - c4 rho^4)`, micrometres of 2.56 (Evans and Fung 1972); `c0` of
    /// individuals lies within the range.
    Biconcave { c0: [f32; 2], c2: f32, c4: f32 },
}

/// Unevenness of what is inside.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Texture {
    /// As a share of the matter there.
    pub amount: f32,
    /// Size of its features, micrometres.
    pub size: f32,
}

/// Things inside that keep their place in the body.
#[derive(Debug)]
pub(crate) struct Inclusion {
    /// Fewest and most.
    pub count: [u32; 2],
    /// Smallest and largest radius, before the size of the region in which it lies.
    pub radius: [f32; 2],
    /// Nearest and farthest from the centre, `rho`.
    pub place: [f32; 2],
    /// Each at its thickest.
    pub matter: Matter,
    pub shape: SpotShape,
    /// Fewest and most soft grains inside each.
    pub grains: [u32; 2],
}

/// How a small round thing fades outwards.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum SpotShape {
    /// Softly, without an edge.
    Bump,
    /// As thick as a ball.
    Ball,
    /// A wall around nothing.
    Ring,
    /// A point above or below the plane of focus: rings that get narrower outwards. A wave of Gaussian width `sigma` that
    /// went on by `z` is `exp(-r^2 / 2s)` with `s = sigma^2 + i lambda z / (2 pi n)`; the number is the ratio of the
    /// imaginary part of `1 / s` to the real one.
    Defocused(f32),
}

/// A fringe of beating hairs.
#[derive(Debug)]
pub(crate) struct Cilia {
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
pub(crate) struct Pellicle {
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
pub(crate) struct AmoeboidLook {
    /// In the body, where it is thickest.
    pub matter: Matter,
    /// Width of the rim in which the body rises, and width of that without granules; both are uneven.
    pub rim: f32,
    pub ectoplasm: f32,
    pub texture: Texture,
    pub lamella: Lamella,
    pub nucleus: NucleusLook,
    /// Carried by the cytoplasm.
    pub granules: &'static [GranuleLook],
    /// Mitochondria, per square micrometre, and the longest.
    pub mitochondria: f32,
    pub longest_mitochondrion: f32,
    /// Retraction fibres that the tail drags behind it.
    pub fibres: u32,
    /// Thin processes that come and go around it: their number, and the longest.
    pub processes: u32,
    pub longest_process: f32,
    /// Smallest and largest bleb of those that come and go while it holds prey.
    pub blebs: [f32; 2],
}

/// The thin front without organelles.
#[derive(Debug)]
pub(crate) struct Lamella {
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
pub(crate) struct NucleusLook {
    /// Fewest and most lobes.
    pub lobes: [u32; 2],
    /// Smallest and largest, in the cell's mean radii.
    pub radius: [f32; 2],
    /// Share of a crawling cell's length by which it lies behind the centre.
    pub behind: f32,
    /// Distance of the lobes from the middle of the nucleus, in the cell's mean radii.
    pub spread: f32,
    /// How far it is bent out of shape, in the cell's mean radii.
    pub bent: f32,
    pub matter: Matter,
    pub texture: Texture,
    /// Fewest and most nucleoli of a lobe.
    pub nucleoli: [u32; 2],
}

/// One sort of granules.
#[derive(Debug)]
pub(crate) struct GranuleLook {
    /// Per square micrometre.
    pub density: f32,
    /// Median radius, its standard deviation as a logarithm, smallest and largest.
    pub radius: f32,
    pub spread: f32,
    pub limits: [f32; 2],
    /// How much they keep to the surroundings of the nucleus and to patches, 0 to 1.
    pub gathered: f32,
    /// Smaller ones that a granule has grown together with, at most.
    pub companions: u32,
    /// Of a granule one micrometre thick.
    pub matter: Matter,
    pub shape: SpotShape,
}
