//! The constraint kernels: nets of one kind of constraint that hang from a fixed row and touch nothing. Measured is the
//! constraint phase alone; an element is one constraint projected once.

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use microsim_benches::{time_of_phase, warmed_up};
use microsim_core::glam::Vec2;
use microsim_core::{
    Area, CollisionGroups, Distance, MinDistance, Node, Phase, Placement, Rope, Template, TemplateBuilder, World,
    WorldConfig,
};

/// Nodes along a side of a net.
const SIDE: u32 = 24;
/// Nets in the world: full lanes.
const NETS: u32 = 32;

/// Adds the constraint between two neighbours.
type Link = fn(&mut TemplateBuilder, u32, u32);

const LINKS: [(&str, Link); 3] = [
    ("distance", |builder, a, b| {
        builder.constraint(Distance { a, b, rest_length: 1.0, compliance: 1e-6, damping: 0.01 });
    }),
    ("rope", |builder, a, b| {
        builder.constraint(Rope { a, b, max_length: 1.0 });
    }),
    ("min_distance", |builder, a, b| {
        builder.constraint(MinDistance { a, b, min_length: 1.05 });
    }),
];

/// The places of a net, the upper row fixed, with nothing between them yet.
fn net() -> TemplateBuilder {
    let mut builder = Template::builder();
    for k in 0..SIDE * SIDE {
        let position = Vec2::new((k % SIDE) as f32, -((k / SIDE) as f32));
        let is_fixed = k < SIDE;
        builder.node(if is_fixed { Node::fixed(position) } else { loose(position) });
    }
    builder
}

fn loose(position: Vec2) -> Node {
    Node { groups: CollisionGroups::NONE, ..Node::disc(position, 1.0, 0.1) }
}

fn linked_net(link: Link) -> Template {
    let mut builder = net();
    for k in SIDE..SIDE * SIDE {
        link(&mut builder, k - SIDE, k);
        if k % SIDE > 0 {
            link(&mut builder, k - 1, k);
        }
    }
    builder.build().expect("the net is valid")
}

/// One ring around the loose part of a net, with an area constraint of 0.9 of its area.
fn net_with_area() -> Template {
    let mut builder = net();
    let (first, last) = (1, SIDE - 1);
    let left = (first..last).map(|row| row * SIDE);
    let lower = (0..last).map(|column| last * SIDE + column);
    let right = (first + 1..=last).rev().map(|row| row * SIDE + last);
    let upper = (1..=last).rev().map(|column| first * SIDE + column);
    let ring = left.chain(lower).chain(right).chain(upper).collect();
    let rest_area = 0.9 * ((SIDE - 1) * (SIDE - 2)) as f32;
    builder.constraint(Area { ring, rest_area, compliance: 1e-6, is_upper_bound: false });
    builder.build().expect("the ring is valid")
}

fn hanging(template: &Template) -> World {
    let config = WorldConfig { size: Vec2::splat(400.0), gravity: Vec2::new(0.0, -20.0), ..WorldConfig::default() };
    let mut world = World::new(config).expect("the settings are valid");
    let id = world.add_template(template.clone());
    for k in 0..NETS {
        let place = Placement::at(20.0 + 40.0 * (k % 8) as f32, 100.0 + 70.0 * (k / 8) as f32);
        world.spawn_template(id, place).expect("there is room");
    }
    warmed_up(world)
}

fn constraints(criterion: &mut Criterion) {
    let linked = LINKS.map(|(name, link)| (name, linked_net(link)));
    let mut group = criterion.benchmark_group("constraints");
    for (name, template) in linked.into_iter().chain([("area", net_with_area())]) {
        let world = hanging(&template);
        let projected = template.constraints().len() as u64 * u64::from(NETS * world.config().substeps);
        group.throughput(Throughput::Elements(projected));
        group.bench_function(name, |bencher| {
            bencher.iter_custom(|steps| time_of_phase(&world, steps, Phase::ProjectConstraints));
        });
    }
}

criterion_group!(benches, constraints);
criterion_main!(benches);
