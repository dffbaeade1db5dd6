//! A body that the library does not know, from particles and constraints alone: a square of jelly.
//!
//! ```text
//!   o---o---o---o     o  nodes: discs that collide with everything but their own jelly
//!   | X | X | X |     -  stiff links along the grid, X softer links across each square
//!   o---o---o---o        and one area constraint around the outline: squeezed, it bulges instead of shrinking
//!   | X | X | X |
//!   o---o---o---o
//! ```
//!
//! Such a body is a [`Template`]: described and checked once, then spawned as often as needed at any place, angle and
//! scale. The eight instances of a block are solved side by side, as the library's own organisms are.
//!
//! `cargo run -p microsim-core --example custom_body`

use microsim_core::geometry::signed_area;
use microsim_core::{
    Area, Error, Inputs, Material, Node, OrganismId, Placement, Role, Template, TemplateBuilder, World, WorldConfig,
    glam::Vec2,
};

/// Nodes along a side.
const SIDE: u32 = 4;
/// Distance of neighbours in the template; [`Placement::scaled`] multiplies it.
const PITCH: f32 = 2.0;
/// Inverse stiffness of the links across a square: more than 0, so that the jelly can shear.
const SHEAR_COMPLIANCE: f32 = 1e-4;

fn main() -> Result<(), Error> {
    let gravity = Vec2::new(0.0, -30.0);
    let mut world = World::new(WorldConfig { size: Vec2::new(60.0, 60.0), gravity, ..WorldConfig::default() })?;
    let jelly = world.add_template(jelly()?);
    let pile: Vec<OrganismId> = (0u8..6)
        .map(|k| {
            let place = Placement::at(28.0 + f32::from(k % 2), 6.0 + 9.0 * f32::from(k));
            world.spawn_template(jelly, place.turned(0.2 * f32::from(k)).scaled(1.0 - 0.05 * f32::from(k)))
        })
        .collect::<Result<_, _>>()?;
    let before = areas(&world, &pile);
    for _ in 0..600 {
        world.step(&Inputs::new());
    }

    // Ten seconds later the pile has come down: each jelly lies on the floor or on another one, none has left the room,
    // and each still has its area to within 1 %.
    let after = areas(&world, &pile);
    for (jelly, (before, after)) in pile.iter().zip(before.iter().zip(&after)) {
        let centre = world.centroid(*jelly).unwrap_or(Vec2::NAN);
        assert!(centre.y > 2.0 && centre.y < 12.0, "at {centre}");
        assert!((after / before - 1.0).abs() < 0.01, "area {before} -> {after}");
        println!("jelly at {centre:.1}, area {before:.1} -> {after:.1}");
    }
    let quality = world.quality();
    assert!(quality.penetration_max < 0.1, "deepest overlap: {} radii", quality.penetration_max);
    Ok(())
}

/// Links neighbours along the grid and across each square.
fn link(builder: &mut TemplateBuilder) {
    for row in 0..SIDE {
        for column in 0..SIDE {
            let (right, up) = (column + 1 < SIDE, row + 1 < SIDE);
            if right {
                builder.link(slot(row, column), slot(row, column + 1), 0.0);
            }
            if up {
                builder.link(slot(row, column), slot(row + 1, column), 0.0);
            }
            if right && up {
                builder.link(slot(row, column), slot(row + 1, column + 1), SHEAR_COMPLIANCE);
                builder.link(slot(row, column + 1), slot(row + 1, column), SHEAR_COMPLIANCE);
            }
        }
    }
}

/// The recipe: nodes row by row, links, outline, area.
fn jelly() -> Result<Template, Error> {
    let mut builder = Template::builder();
    let material = Material { friction: 0.6, restitution: 0.0 };
    let width = PITCH * (SIDE - 1) as f32;
    for row in 0..SIDE {
        for column in 0..SIDE {
            let position = Vec2::new(column as f32, row as f32) * PITCH - 0.5 * width;
            let role = if is_border(row) || is_border(column) { Role::Membrane } else { Role::Plain };
            builder.node(Node { material, role, ..Node::disc(position, 1.0, 0.5 * PITCH) });
        }
    }
    link(&mut builder);
    let ring = outline();
    let rest_area = width * width;
    builder.constraint(Area { ring: ring.clone(), rest_area, compliance: 0.0, is_upper_bound: false });
    builder.outline(&ring);
    builder.build()
}

fn slot(row: u32, column: u32) -> u32 {
    row * SIDE + column
}

fn is_border(k: u32) -> bool {
    k == 0 || k + 1 == SIDE
}

/// The border's slots, counter-clockwise from the lower left corner.
fn outline() -> Vec<u32> {
    let last = SIDE - 1;
    let sides: [Vec<u32>; 4] = [
        (0..last).map(|k| slot(0, k)).collect(),
        (0..last).map(|k| slot(k, last)).collect(),
        (0..last).map(|k| slot(last, last - k)).collect(),
        (0..last).map(|k| slot(last - k, 0)).collect(),
    ];
    sides.concat()
}

/// Area within each one's outline.
fn areas(world: &World, bodies: &[OrganismId]) -> Vec<f32> {
    let views = bodies.iter().filter_map(|&id| world.view().organism(id));
    views.map(|body| signed_area(&body.outline().collect::<Vec<_>>())).collect()
}
