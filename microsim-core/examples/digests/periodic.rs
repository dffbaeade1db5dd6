//! A room that repeats along both axes: bodies, water and a rope that lie over its sides, and a filament that swims.

use microsim_core::glam::Vec2;
use microsim_core::{
    AgarSpec, Distance, Error, FieldKind, FluidBlockSpec, FluidParams, ForceField, Inputs, JointEnd, JointKind,
    JointSpec, LinkDrag, Node, OrganismId, Placement, PlateletSpec, RedCellSpec, Region, Side, Sides, Template, World,
    WorldConfig,
};

const SIZE: Vec2 = Vec2::new(80.0, 48.0);
/// Columns of nodes in the filament, and in a wave of it.
const COLUMNS: u32 = 24;
const WAVE: u32 = 8;

/// The world of the scene, and what swims in it.
#[derive(Clone)]
pub(crate) struct Periodic {
    pub world: World,
    swimmer: OrganismId,
}

impl Periodic {
    /// # Errors
    /// When something is refused.
    pub(crate) fn build() -> Result<Self, Error> {
        let side = Side::Periodic;
        let sides = Sides { bottom: side, top: side, left: side, right: side };
        let mut world = World::new(WorldConfig { size: SIZE, sides, damping: 0.2, ..WorldConfig::default() })?;
        let water = FluidBlockSpec { size: Vec2::new(24.0, 8.0), fluid: FluidParams::default() };
        world.spawn(&water.into(), Placement::at(67.5, 43.5))?;
        for k in 0..6u8 {
            world.spawn(&PlateletSpec::default().into(), Placement::at(6.0 + 12.0 * f32::from(k), 12.0))?;
            world.spawn(&RedCellSpec::default().into(), Placement::at(6.0 + 12.0 * f32::from(k), 34.0))?;
        }
        for (x, speed) in [(4.0, -15.0), (76.0, 15.0)] {
            // They meet over the right side.
            let id = world.spawn(&RedCellSpec::default().into(), Placement::at(x, 5.0))?;
            world.push(id, Vec2::new(speed, 0.0))?;
        }
        let ends =
            [(1.0, 24.0), (79.0, 24.0)].map(|(x, y)| world.spawn(&AgarSpec::default().into(), Placement::at(x, y)));
        let [a, b] = [ends[0].clone()?, ends[1].clone()?].map(|organism| JointEnd::Node { organism, node: 0 });
        world.add_joint(JointSpec::new(a, b, JointKind::Rope { max_length: 4.0 }))?;
        world.add_field(ForceField {
            region: Region::Circle { centre: Vec2::new(40.0, 24.0), radius: 20.0 },
            kind: FieldKind::Uniform { acceleration: Vec2::new(30.0, 8.0) },
        })?;
        let template = world.add_template(filament()?);
        let swimmer = world.spawn_template(template, Placement::at(30.0, 24.0))?;
        Ok(Self { world, swimmer })
    }

    /// Takes a step, in which a wave of bending runs along the filament.
    ///
    /// # Errors
    /// When an input is refused.
    pub(crate) fn step(&mut self) -> Result<(), Error> {
        let mut inputs = Inputs::new();
        for channel in 0..WAVE {
            let at = (self.world.step_index() + u64::from(channel) * 64 / u64::from(WAVE)) % 64;
            inputs.activate(self.swimmer, channel, if at < 32 { at } else { 64 - at } as f32 / 32.0)?;
        }
        self.world.step(&inputs);
        Ok(())
    }
}

/// Three strands: those at the sides are muscles, the middle one has the drag.
fn filament() -> Result<Template, Error> {
    let mut builder = Template::builder();
    for k in 0..3 * COLUMNS {
        builder.node(Node::disc(Vec2::new((k / 3) as f32, 0.5 * (k % 3) as f32), 0.05, 0.25));
    }
    let channels: Vec<u32> = (0..WAVE).map(|_| builder.channel([0.9, 1.1])).collect();
    for column in 0..COLUMNS {
        let [a, middle, b] = [0, 1, 2].map(|strand| 3 * column + strand);
        builder.link(a, middle, 0.0).link(middle, b, 0.0);
        if column + 1 < COLUMNS {
            for (strand, phase) in [(a, 0), (b, WAVE / 2)] {
                let next = Distance { a: strand, b: strand + 3, rest_length: 1.0, compliance: 0.0, damping: 0.0 };
                builder.muscle(channels[((column + phase) % WAVE) as usize], next);
            }
            builder.link(a, b + 3, 1e-4).link(b, a + 3, 1e-4).link(middle, middle + 3, 0.0);
            builder.constraint(LinkDrag { a: middle, b: middle + 3, along: 2.0, across: 4.0 });
        }
    }
    builder.build()
}
