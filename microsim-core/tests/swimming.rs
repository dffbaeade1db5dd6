//! Drag of links (`LinkDrag`): filaments that swim by waves of bending, and rods that sink aslant, as resistive force theory says.
#![allow(clippy::disallowed_methods, reason = "tests measure; only stepping has to be bit-exact")]

use microsim_core::glam::Vec2;
use microsim_core::{
    Distance, FieldKind, ForceField, Inputs, LinkDrag, Node, OrganismId, Placement, Region, Template, World,
    WorldConfig,
};
use std::f32::consts::TAU;

/// Columns of nodes in a wave, and in the filament: muscles on both sides of a strand that keeps its length and has the drag, a unit
/// from node to node and from side to side.
const WAVE: u32 = 12;
const COLUMNS: u32 = 4 * WAVE + 1;
/// Mass of a node; resistance to motion along the filament.
const MASS: f32 = 0.03;
const ALONG: f32 = 2.0;

/// A filament whose sides lengthen and shorten by turns, by a share `strain` of their length.
#[derive(Clone, Copy)]
struct Filament {
    strain: f32,
    /// Resistance across over that along.
    ratio: f32,
    /// Time of a beat, s; negative for waves that run the other way.
    period: f32,
    substeps: u32,
}

impl Filament {
    fn template(&self) -> Template {
        let mut builder = Template::builder();
        for k in 0..3 * COLUMNS {
            builder.node(Node::disc(Vec2::new((k / 3) as f32, 0.5 * (k % 3) as f32), MASS, 0.3));
        }
        let scale = [1.0 - self.strain, 1.0 + self.strain];
        let channels: Vec<u32> = (0..WAVE).map(|_| builder.channel(scale)).collect();
        for column in 0..COLUMNS {
            let [a, middle, b] = [0, 1, 2].map(|strand| 3 * column + strand);
            builder.link(a, middle, 0.0).link(middle, b, 0.0).link(a, b, 0.0);
            if column == COLUMNS - 1 {
                break;
            }
            for (strand, opposite) in [(a, b), (b, a)] {
                let channel = channels[((column + (strand - a) * WAVE / 4) % WAVE) as usize];
                let next = Distance { a: strand, b: strand + 3, rest_length: 1.0, compliance: 0.0, damping: 0.0 };
                builder.muscle(channel, next);
                builder.link(strand, opposite + 3, 1e-4);
            }
            builder.link(middle, middle + 3, 0.0);
            builder.constraint(LinkDrag { a: middle, b: middle + 3, along: ALONG, across: self.ratio * ALONG });
        }
        builder.build().unwrap()
    }

    /// Swims for some beats: the shape and the speed over all but the first two.
    fn swim(&self, beats: u32) -> Swim {
        let config = WorldConfig {
            size: Vec2::new(200.0, 60.0),
            damping: 0.0,
            substeps: self.substeps,
            ..WorldConfig::default()
        };
        let mut world = World::new(config).unwrap();
        let template = world.add_template(self.template());
        let id = world.spawn_template(template, Placement::at(80.0, 30.0)).unwrap();
        let (steps, mut inputs, mut swim) = ((60.0 * self.period.abs()).round() as u32, Inputs::new(), Swim::default());
        let mut start = Vec2::ZERO;
        for step in 0..beats * steps {
            if step == 2 * steps {
                start = world.centroid(id).unwrap();
            }
            for channel in 0..WAVE {
                let turn = channel as f32 / WAVE as f32 - world.time() as f32 / self.period;
                let grown = (step as f32 / steps as f32).min(1.0);
                inputs.activate(id, channel, 0.5 + 0.5 * grown * (TAU * turn).sin()).unwrap();
            }
            world.step(&inputs);
            if step >= 2 * steps {
                swim.add(&middle(&world, id), (beats - 2) * steps);
            }
        }
        assert!(world.validate().is_ok());
        swim.speed =
            (world.centroid(id).unwrap() - start).dot(swim.axis.normalize()) / ((beats - 2) * steps) as f32 * 60.0;
        swim.period = steps as f32 / 60.0;
        swim
    }
}

/// The middle strand.
fn middle(world: &World, id: OrganismId) -> Vec<Vec2> {
    let nodes: Vec<Vec2> = world.view().organism(id).unwrap().particles().map(|node| node.position).collect();
    nodes.chunks(3).map(|column| column[1]).collect()
}

#[derive(Clone, Copy, Debug, Default)]
struct Swim {
    speed: f32,
    period: f32,
    /// Means over links and steps: length, and the cosine of its angle with the axis and its square.
    length: f32,
    cosine: f32,
    squared: f32,
    /// The same of the square of the slope times the cosine.
    rise: f32,
    /// The direction of its ends, summed.
    axis: Vec2,
}

impl Swim {
    fn add(&mut self, line: &[Vec2], steps: u32) {
        let share = 1.0 / (steps * (COLUMNS - 1)) as f32;
        let axis = (line[line.len() - 1] - line[0]).normalize();
        self.axis += axis;
        for link in line.windows(2).map(|pair| pair[1] - pair[0]) {
            let cosine = link.dot(axis) / link.length();
            self.length += share * link.length();
            self.cosine += share * cosine;
            self.squared += share * cosine * cosine;
            self.rise += share * (1.0 - cosine * cosine) / cosine;
        }
    }

    /// How fast waves run along the axis.
    fn wave_speed(&self) -> f32 {
        WAVE as f32 * self.length * self.cosine / self.period
    }
}

/// What the derivation in docs/physics.md says, from the inclination of the links, and Gray and Hancock's formula for a small
/// amplitude; speed over that of the wave.
fn laws(swim: &Swim, ratio: f32) -> [f32; 2] {
    let excess = (ratio - 1.0) * (1.0 - swim.squared);
    let steep = swim.rise / swim.cosine; // b^2 k^2 / 2 of a sine: the mean square of the slope along the axis
    [excess / (1.0 + excess), (ratio - 1.0) * steep / (1.0 + ratio * steep)]
}

#[test]
fn a_filament_swims_as_fast_as_gray_and_hancock_say() {
    for (strain, ratio, period) in
        [(0.1, 2.0, 1.0), (0.1, 2.0, 2.0), (0.14, 2.0, 2.0), (0.1, 4.0, 2.0), (0.14, 1.5, 3.0)]
    {
        for substeps in [4, 8, 16] {
            let swim = Filament { strain, ratio, period, substeps }.swim(5);
            let (relative, [law, small]) = (-swim.speed / swim.wave_speed(), laws(&swim, ratio));
            assert!((relative / law - 1.0).abs() < 0.1, "{strain} {ratio} {period} {substeps}: {relative}, law {law}");
            assert!((relative / small - 1.0).abs() < 0.15, "{strain} {ratio} {period} {substeps}: {relative}, {small}");
        }
    }
}

#[test]
fn a_reversed_wave_swims_back_and_equal_resistance_goes_nowhere() {
    let filament = Filament { strain: 0.14, ratio: 2.0, period: 2.0, substeps: 8 };
    let [there, back] = [2.0, -2.0].map(|period| Filament { period, ..filament }.swim(5));
    assert!(there.speed < -0.5 && (back.speed / there.speed + 1.0).abs() < 0.1, "{there:?} {back:?}");
    let equal = Filament { ratio: 1.0, ..filament }.swim(5);
    assert!(equal.speed.abs() < 1e-3, "{equal:?}");
}

/// A rod of two nodes, 2 units long, and its speed after three seconds of sinking.
fn sink(angle: f32, drag: [f32; 2], substeps: u32) -> Vec2 {
    let mut builder = Template::builder();
    let [a, b] = [-1.0, 1.0].map(|x| builder.node(Node::disc(Vec2::new(x, 0.0), 0.5, 0.2)));
    builder.link(a, b, 0.0).constraint(LinkDrag { a, b, along: drag[0], across: drag[1] });
    let gravity = Vec2::new(0.0, -10.0);
    let mut world = World::new(WorldConfig { gravity, damping: 0.0, substeps, ..WorldConfig::default() }).unwrap();
    let rod = world.add_template(builder.build().unwrap());
    let rod = world.spawn_template(rod, Placement::at(80.0, 60.0).turned(angle)).unwrap();
    (0..180).for_each(|_| world.step(&Inputs::new()));
    let nodes: Vec<_> = world.view().organism(rod).unwrap().particles().collect();
    let turned = (nodes[1].position - nodes[0].position).angle_to(Vec2::from_angle(angle));
    assert!(turned.abs() < 1e-3, "nothing turns it: {turned}");
    0.5 * (nodes[0].velocity + nodes[1].velocity)
}

#[test]
fn a_rod_sinks_aslant_by_the_ratio_of_its_resistances() {
    for substeps in [4, 8, 16] {
        for (angle, drag) in [
            (0.0f32, [2.0f32, 4.0]),
            (0.3, [2.0, 4.0]),
            (0.8, [2.0, 4.0]),
            (0.8, [1.0, 5.0]),
            (-1.2, [3.0, 6.0]),
            (0.8, [2.0, 2.0]),
        ] {
            let ([along, across], (sin, cos)) = (drag, angle.sin_cos());
            let (tangent, normal) = (Vec2::new(cos, sin), Vec2::new(-sin, cos));
            let law = -5.0 * (tangent * sin / along + normal * cos / across); // weight over length
            let speed = sink(angle, drag, substeps);
            assert!((speed - law).length() < 0.01 * law.length(), "{angle} {drag:?} {substeps}: {speed}, law {law}");
        }
    }
}

#[test]
fn what_rests_in_a_viscous_medium_stays() {
    let config = WorldConfig { damping: 0.0, ..WorldConfig::default() };
    let mut world = World::new(config).unwrap();
    let template = Filament { strain: 0.1, ratio: 2.0, period: 1.0, substeps: 8 }.template();
    let template = world.add_template(template);
    let id = world.spawn_template(template, Placement::at(80.0, 30.0).turned(0.5)).unwrap();
    let mut inputs = Inputs::new();
    (0..WAVE).for_each(|channel| inputs.activate(id, channel, 0.5).unwrap());
    (0..120).for_each(|_| world.step(&inputs));
    let before = middle(&world, id);
    (0..120).for_each(|_| world.step(&inputs));
    let moved = before.iter().zip(middle(&world, id)).map(|(a, b)| a.distance(b)).fold(0.0, f32::max);
    assert!(moved < 1e-3, "{moved}");
}

#[test]
fn no_world_has_links_with_drag_and_a_thermal_field() {
    let mut builder = Template::builder();
    let [a, b] = [0.0, 1.0].map(|x| builder.node(Node::disc(Vec2::new(x, 0.0), 1.0, 0.5)));
    builder.link(a, b, 0.0).constraint(LinkDrag { a, b, along: 1.0, across: 2.0 });
    let heat = ForceField { region: Region::All, kind: FieldKind::Thermal { mobility: 0.1 } };
    let mut world = World::new(WorldConfig::default()).unwrap();
    let rod = world.add_template(builder.build().unwrap());
    let id = world.spawn_template(rod, Placement::at(50.0, 50.0)).unwrap();
    assert!(world.add_field(heat.clone()).unwrap_err().to_string().contains("drag of links"));
    world.remove(id).unwrap();
    world.add_field(heat).unwrap();
    let refused = world.spawn_template(rod, Placement::at(50.0, 50.0)).unwrap_err();
    assert!(refused.field() == "template" && world.validate().is_ok(), "{refused}");
}
