//! Prototypes: the tables `[rigid_cell.NAME]`, `[agar.NAME]` and so on, one kind of table per kind of organism.

use crate::error::Error;
use crate::organism::OrganismSpec;
use crate::scenario::reader::{Fields, Keyword};
use crate::solver::fluid::{FluidMode, FluidParams};
use crate::{
    AgarSpec, AmoeboidCellSpec, BacillusSpec, CoccusSpec, DivisionParams, FluidBlockSpec, IngestionWay,
    PhagocytosisParams, PlateletSpec, ProbeSpec, RedCellSpec, RigidCellSpec,
};
use std::collections::BTreeMap;

/// An organism that can be spawned by name.
#[derive(Clone, Debug)]
pub(crate) struct Prototype {
    pub name: String,
    spec: OrganismSpec,
    /// Farthest that it reaches from its centre, units.
    extent: f32,
}

/// Prototypes by name; `None` where its table is wrong, which is reported once, there.
pub(crate) type Prototypes = BTreeMap<String, Option<Prototype>>;

type ReadSpec = fn(&mut Fields<'_>) -> OrganismSpec;

/// Tables of prototypes and how they are read.
const KINDS: [(&str, ReadSpec); 9] = [
    ("rigid_cell", rigid_cell),
    ("amoeboid_cell", amoeboid_cell),
    ("platelet", platelet),
    ("agar", agar),
    ("probe", probe),
    ("fluid", fluid),
    ("red_cell", red_cell),
    ("coccus", coccus),
    ("bacillus", bacillus),
];

/// Reads all prototypes of a file.
pub(crate) fn read(root: &mut Fields<'_>) -> Prototypes {
    let mut prototypes = Prototypes::new();
    for (kind, read) in KINDS {
        for (name, mut fields) in root.named(kind) {
            let (path, context) = (fields.path.clone(), fields.context);
            let prototype = context.check_all(&path, || Prototype::new(name.clone(), read(&mut fields)));
            fields.finish();
            if prototypes.contains_key(&name) {
                let accepted = "a name that no other prototype has";
                context.refuse_key(&path, format!("the name `{name}` is taken"), accepted.to_owned());
            }
            prototypes.insert(name, prototype);
        }
    }
    prototypes
}

/// The prototype that the field `of` names, if it is sound; reports it if there is none of that name.
pub(crate) fn read_named(fields: &mut Fields<'_>, prototypes: &Prototypes) -> Option<Prototype> {
    let of: String = fields.required("of")?;
    if let Some(prototype) = prototypes.get(&of) {
        return prototype.clone();
    }
    fields.refuse_unknown("of", "prototype", &of, prototypes.keys().map(String::as_str));
    None
}

impl Prototype {
    fn new(name: String, spec: OrganismSpec) -> Result<Self, Error> {
        let extent = spec.extent()?;
        Ok(Self { name, spec, extent })
    }

    /// Whether anything can steer it.
    pub(crate) fn can_move(&self) -> bool {
        self.spec.can_move()
    }

    /// Whether it takes others in and grows.
    pub(crate) fn can_grow(&self) -> bool {
        matches!(self.spec, OrganismSpec::AmoeboidCell(_))
    }

    /// Farthest that it reaches from its centre when scaled, units.
    pub(crate) fn extent(&self, scale: f32) -> f32 {
        self.extent * scale
    }

    /// Particles that one of it takes.
    pub(crate) fn particles(&self, scale: f32) -> Result<u64, Error> {
        let (spec, _) = self.scaled(scale);
        spec.particle_count().map(|count| count as u64)
    }

    /// Its spec in another size, and what is left for [`crate::Placement::scale`] to do. Where fluid is part of it the
    /// spec itself is scaled: a larger cell has more nodes and more cytoplasm, not larger ones (seed, 3.1.2).
    pub(crate) fn scaled(&self, scale: f32) -> (OrganismSpec, f32) {
        match self.spec.clone() {
            OrganismSpec::AmoeboidCell(spec) => {
                let radii = spec.radii * scale;
                (AmoeboidCellSpec { radii, ..spec }.into(), 1.0)
            }
            OrganismSpec::FluidBlock(spec) => {
                let size = spec.size * scale;
                (FluidBlockSpec { size, ..spec }.into(), 1.0)
            }
            other => (other, scale),
        }
    }
}

fn rigid_cell(fields: &mut Fields<'_>) -> OrganismSpec {
    let default = RigidCellSpec::default();
    OrganismSpec::from(RigidCellSpec {
        radii: fields.required("radii").unwrap_or(default.radii),
        satellites: fields.or("satellites", default.satellites),
        layers: fields.or("layers", default.layers),
        spring_compliance: fields.or("spring_compliance", default.spring_compliance),
        spring_damping: fields.or("spring_damping", default.spring_damping),
        speed: fields.or("speed", default.speed),
    })
}

fn amoeboid_cell(fields: &mut Fields<'_>) -> OrganismSpec {
    let default = AmoeboidCellSpec::default();
    OrganismSpec::from(AmoeboidCellSpec {
        radii: fields.required("radii").unwrap_or(default.radii),
        node_radius: fields.or("node_radius", default.node_radius),
        cytoplasm_spacing: fields.or("cytoplasm_spacing", default.cytoplasm_spacing),
        viscosity: fields.or("viscosity", default.viscosity),
        speed: fields.or("speed", default.speed),
        phagocytosis: phagocytosis(fields.table("phagocytosis"), default.phagocytosis),
        division: division(fields.table("division"), default.division),
    })
}

fn division(mut fields: Fields<'_>, default: DivisionParams) -> DivisionParams {
    let params = DivisionParams {
        furrow_speed: fields.or("furrow_speed", default.furrow_speed),
        closing_length: fields.or("closing_length", default.closing_length),
        time_limit: fields.or("time_limit", default.time_limit),
        least_particles: fields.or("least_particles", default.least_particles),
        least_nodes: fields.or("least_nodes", default.least_nodes),
    };
    fields.finish();
    params
}

fn phagocytosis(mut fields: Fields<'_>, default: PhagocytosisParams) -> PhagocytosisParams {
    let params = PhagocytosisParams {
        way: fields.or("way", default.way),
        hold_time: fields.or("hold_time", default.hold_time),
        heading_cosine: fields.or("heading_cosine", default.heading_cosine),
        soft_prey_contacts: fields.or("soft_prey_contacts", default.soft_prey_contacts),
        size_ratio: fields.or("size_ratio", default.size_ratio),
        time_limit: fields.or("time_limit", default.time_limit),
        pull_speed: fields.or("pull_speed", default.pull_speed),
        pull_acceleration: fields.or("pull_acceleration", default.pull_acceleration),
        lip_speed: fields.or("lip_speed", default.lip_speed),
        closing_length: fields.or("closing_length", default.closing_length),
        soft_prey_scale: fields.or("soft_prey_scale", default.soft_prey_scale),
        digestion_time: fields.or("digestion_time", default.digestion_time),
        digestion_speed: fields.or("digestion_speed", default.digestion_speed),
        growth_yield: fields.or("growth_yield", default.growth_yield),
    };
    fields.finish();
    params
}

fn platelet(fields: &mut Fields<'_>) -> OrganismSpec {
    let default = PlateletSpec::default();
    OrganismSpec::from(PlateletSpec {
        radius: fields.required("radius").unwrap_or(default.radius),
        satellites: fields.or("satellites", default.satellites),
        core_mass: fields.or("core_mass", default.core_mass),
        spoke_compliance: fields.or("spoke_compliance", default.spoke_compliance),
        anchor_compliance: fields.or("anchor_compliance", default.anchor_compliance),
        rope_length: fields.or("rope_length", default.rope_length),
    })
}

fn agar(fields: &mut Fields<'_>) -> OrganismSpec {
    let default = AgarSpec::default();
    OrganismSpec::from(AgarSpec {
        radius: fields.required("radius").unwrap_or(default.radius),
        density: fields.or("density", default.density),
    })
}

fn probe(fields: &mut Fields<'_>) -> OrganismSpec {
    let default = ProbeSpec::default();
    OrganismSpec::from(ProbeSpec {
        radius: fields.required("radius").unwrap_or(default.radius),
        mass: fields.or("mass", default.mass),
        speed: fields.or("speed", default.speed),
        max_acceleration: fields.or("max_acceleration", default.max_acceleration),
    })
}

fn red_cell(fields: &mut Fields<'_>) -> OrganismSpec {
    let default = RedCellSpec::default();
    OrganismSpec::from(RedCellSpec {
        radius: fields.required("radius").unwrap_or(default.radius),
        satellites: fields.or("satellites", default.satellites),
        mass: fields.or("mass", default.mass),
        chord_compliance: fields.or("chord_compliance", default.chord_compliance),
        chord_damping: fields.or("chord_damping", default.chord_damping),
        area_compliance: fields.or("area_compliance", default.area_compliance),
    })
}

fn coccus(fields: &mut Fields<'_>) -> OrganismSpec {
    let default = CoccusSpec::default();
    OrganismSpec::from(CoccusSpec {
        radius: fields.required("radius").unwrap_or(default.radius),
        density: fields.or("density", default.density),
        speed: fields.or("speed", default.speed),
    })
}

fn bacillus(fields: &mut Fields<'_>) -> OrganismSpec {
    let default = BacillusSpec::default();
    OrganismSpec::from(BacillusSpec {
        radius: fields.required("radius").unwrap_or(default.radius),
        density: fields.or("density", default.density),
        speed: fields.or("speed", default.speed),
    })
}

fn fluid(fields: &mut Fields<'_>) -> OrganismSpec {
    let default = FluidBlockSpec::default();
    OrganismSpec::from(FluidBlockSpec {
        size: fields.required("size").unwrap_or(default.size),
        fluid: FluidParams {
            spacing: fields.or("spacing", default.fluid.spacing),
            particle_mass: fields.or("particle_mass", default.fluid.particle_mass),
            viscosity: fields.or("viscosity", default.fluid.viscosity),
            mode: fields.or("mode", default.fluid.mode),
        },
    })
}

impl Keyword for IngestionWay {
    const KEYWORDS: &'static [(&'static str, Self)] = &[("gate", Self::Gate), ("cup", Self::Cup)];
}

impl Keyword for FluidMode {
    const KEYWORDS: &'static [(&'static str, Self)] = &[("density", Self::Density), ("granular", Self::Granular)];
}
