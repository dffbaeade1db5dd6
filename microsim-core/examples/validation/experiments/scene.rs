//! What experiments share: how time is stepped, discs, and positions of particles.

use microsim_core::glam::Vec2;
use microsim_core::parry2d::{math::Pose, shape::SharedShape};
use microsim_core::{
    Error, Inputs, Material, Node, Obstacle, OrganismId, ParticleView, Placement, Template, World, WorldConfig,
};

/// Acceleration of free fall, units/s2.
pub(crate) const GRAVITY: f32 = 10.0;

/// Step and number of substeps.
#[derive(Clone, Copy)]
pub(crate) struct Stepping {
    pub dt: f32,
    pub substeps: u32,
}

impl Stepping {
    pub(crate) const DEFAULT: Self = Self { dt: 1.0 / 60.0, substeps: 8 };

    pub(crate) fn of_substeps(substeps: u32) -> Self {
        Self { substeps, ..Self::DEFAULT }
    }

    /// Time of a substep, s.
    pub(crate) fn substep(self) -> f64 {
        f64::from(self.dt) / f64::from(self.substeps)
    }

    /// A room with this size and downward gravity, without drag.
    pub(crate) fn room(self, size: Vec2, gravity: f32) -> WorldConfig {
        let gravity = Vec2::new(0.0, -gravity);
        let Self { dt, substeps } = self;
        WorldConfig { dt, substeps, size, gravity, damping: 0.0, max_speed: 100.0, ..WorldConfig::default() }
    }
}

/// Steps for so long, s.
pub(crate) fn run(world: &mut World, seconds: f32) {
    run_observed(world, seconds, |_| {});
}

/// Steps for so long, s, and looks at the world after each step.
pub(crate) fn run_observed(world: &mut World, seconds: f32, mut observe: impl FnMut(&World)) {
    for _ in 0..(seconds / world.config().dt).round() as u32 {
        world.step(&Inputs::new());
        observe(world);
    }
}

/// A disc of this mass, radius and surface.
pub(crate) fn spawn_disc(world: &mut World, at: Vec2, size: [f32; 2], material: Material) -> Result<OrganismId, Error> {
    let mut builder = Template::builder();
    builder.node(Node { material, ..Node::disc(Vec2::ZERO, size[0], size[1]) });
    let template = world.add_template(builder.build()?);
    world.spawn_template(template, Placement::at(at.x, at.y))
}

/// Adds a block over the whole width of the room, from its bottom to this height.
pub(crate) fn add_floor(world: &mut World, height: f32, material: Material) -> Result<(), Error> {
    let half = Vec2::new(world.config().size.x, 0.5 * height);
    let shape = SharedShape::cuboid(half.x, half.y);
    let floor = Obstacle::new(shape, Pose::translation(0.5 * half.x, half.y));
    world.add_obstacle(Obstacle { material, ..floor }).map(drop)
}

/// The particles of an organism.
pub(crate) fn particles(world: &World, id: OrganismId) -> Vec<ParticleView> {
    world.view().organism(id).map_or(Vec::new(), |organism| organism.particles().collect())
}

/// The last particle of an organism: of a disc the only one, of a pendulum its bob.
pub(crate) fn last_particle(world: &World, id: OrganismId) -> ParticleView {
    particles(world, id).pop().expect("organisms of these experiments have particles and stay")
}

pub(crate) fn mean(values: impl Iterator<Item = f64>) -> f64 {
    let (sum, count) = values.fold((0.0, 0.0), |(sum, count), value| (sum + value, count + 1.0));
    sum / count
}

/// The line through points that is nearest to them: its slope and its value at 0.
pub(crate) fn fit(points: &[[f64; 2]]) -> [f64; 2] {
    let count = points.len() as f64;
    let mean = [0, 1].map(|k| points.iter().map(|point| point[k]).sum::<f64>() / count);
    let product = |k: usize| points.iter().map(|point| (point[0] - mean[0]) * (point[k] - mean[k])).sum::<f64>();
    let slope = product(1) / product(0);
    [slope, mean[1] - slope * mean[0]]
}

/// Exponent of the power law that is nearest to points.
pub(crate) fn exponent(points: &[[f64; 2]]) -> f64 {
    let logarithms: Vec<[f64; 2]> = points.iter().map(|point| point.map(f64::ln)).collect();
    fit(&logarithms)[0]
}

/// Value of a curve of points with rising abscissa, linear between them.
pub(crate) fn value_at(points: &[[f64; 2]], x: f64) -> f64 {
    let after = points.partition_point(|point| point[0] < x).clamp(1, points.len() - 1);
    let ([x0, y0], [x1, y1]) = (points[after - 1], points[after]);
    y0 + (y1 - y0) * (x - x0) / (x1 - x0)
}
