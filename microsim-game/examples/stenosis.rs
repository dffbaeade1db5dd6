//! Blood in a narrowed vessel: `cargo run --release -p microsim-game --example stenosis [FILE.png]`.
//!
//! Red cells and cocci are driven by a field. What comes to the right end goes, and comes in again at the left one.

mod toy;

use microsim_core::{FieldKind, Region, Rng, prelude::*};

const SIZE: Vec2 = Vec2::new(128.0, 40.0);
/// Cells that are there at most.
const CELLS: usize = 60;

fn main() -> Result<(), Error> {
    let mut world = World::new(WorldConfig { size: SIZE, damping: 1.0, ..WorldConfig::default() })?;
    for y in [-10.0, SIZE.y + 10.0] {
        let bulge = SharedShape::ball(27.0);
        world.add_obstacle(Obstacle::new(bulge, Pose::translation(0.5 * SIZE.x, y)))?;
    }
    let acceleration = Vec2::new(40.0, 0.0);
    world.add_field(ForceField { region: Region::All, kind: FieldKind::Uniform { acceleration } })?;
    let outlet = Obstacle::new(SharedShape::cuboid(2.0, SIZE.y), Pose::translation(SIZE.x, 0.0));
    let outlet = world.add_obstacle(Obstacle { is_sensor: true, ..outlet })?;
    let mut rng = Rng::new(3, 1);

    toy::run("stenosis", world, move |world, _| {
        let gone = world.events().iter().filter_map(|event| match event {
            Event::SensorEntered { sensor, organism, .. } if *sensor == outlet => Some(*organism),
            _ => None,
        });
        for organism in gone.collect::<Vec<_>>() {
            world.remove(organism)?;
        }
        if world.organisms().count() < CELLS && world.step_index() % 6 == 0 {
            let spec: OrganismSpec = match rng.next_u32() % 4 {
                0 => CoccusSpec { radius: 1.0, speed: 0.0, ..CoccusSpec::default() }.into(),
                _ => RedCellSpec::default().into(),
            };
            let at = Vec2::new(6.0, rng.range(6.0, SIZE.y - 6.0));
            if world.queries().overlap_disc(at, 4.5, &QueryFilter::default()).is_empty() {
                world.spawn(&spec, Placement::at(at.x, at.y))?;
            }
        }
        Ok(())
    });
    Ok(())
}
