//! What is built in a simulation: ropes, walls and force fields.

use crate::camera::Camera;
use crate::draw::canvas::Canvas;
use crate::draw::palette::{READY, WAIT, fade};
use crate::words::Key;
use microsim_core::geometry::nearest_on_segment;
use microsim_core::glam::{BVec2, Vec2};
use microsim_core::parry2d::{math::Pose, shape::SharedShape};
use microsim_core::{
    Collider, FieldKind, ForceField, JointEnd, JointKind, JointSpec, Obstacle, QueryFilter, Region, Side, World,
};

/// Half the thickness of walls, and the radius of fields, units.
const WALL: f32 = 1.0;
const FIELD: f32 = 14.0;
/// What a field does, units/s2.
const ACCELERATION: f32 = 30.0;

/// Makes what a field does around a place.
type Make = fn(Vec2) -> FieldKind;

const FIELDS: [(Key, Make); 2] = [
    (Key::FieldVortex, |centre| FieldKind::Vortex { centre, acceleration: ACCELERATION }),
    (Key::FieldStream, |_| FieldKind::Uniform { acceleration: ACCELERATION * Vec2::X }),
];

/// What is being built.
#[derive(Debug, Default)]
pub(super) struct Building {
    /// What the next rope holds at its first end.
    first: Option<JointEnd>,
    /// Where the next wall begins.
    from: Option<Vec2>,
    field: usize,
}

impl Building {
    /// What the next field does.
    pub(super) fn field_name(&self) -> Key {
        FIELDS[self.field].0
    }

    /// The other kind of field.
    pub(super) fn change_field(&mut self) {
        self.field = (self.field + 1) % FIELDS.len();
    }

    /// Forgets what was begun.
    pub(super) fn let_go(&mut self) {
        (self.first, self.from) = (None, None);
    }

    /// Takes away the joint at a point, or takes the first end of a rope, or the second one. Returns why nothing is done.
    pub(super) fn join(&mut self, world: &mut World, at: Vec2, within: f32) -> Option<Key> {
        let end = end_at(world, at, within);
        let Some(first) = self.first.take() else {
            let is_near = |[a, b]: [Vec2; 2]| nearest_on_segment(a, b, at).distance(at) < within;
            let joint = world.joints().find(|joint| is_near(joint.ends)).map(|joint| joint.id);
            match joint {
                Some(joint) => _ = world.remove_joint(joint),
                None => self.first = Some(end),
            }
            return None;
        };
        let places = place_of(world, first).zip(place_of(world, end));
        let rope = |max_length| JointSpec::new(first, end, JointKind::Rope { max_length });
        let rope = places.map(|(a, b)| rope(distance(world, a, b)));
        let joined = rope.is_some_and(|rope| world.add_joint(rope).is_ok());
        (!joined).then_some(Key::SandboxNothing)
    }

    /// Takes away the obstacle at a point, or begins a wall there.
    pub(super) fn begin_wall(&mut self, world: &mut World, at: Vec2, within: f32) {
        self.from = None;
        match nearest(world, at, 0.25 * within, &QueryFilter::surfaces()) {
            Some((Collider::Obstacle(id), _)) => _ = world.remove_obstacle(id),
            _ => self.from = Some(at),
        }
    }

    /// Ends the wall that was begun. Returns why there is none.
    pub(super) fn end_wall(&mut self, world: &mut World, to: Vec2, within: f32) -> Option<Key> {
        let from = self.from.take()?;
        if from.distance(to) < within {
            return Some(Key::SandboxShort);
        }
        let wall = Obstacle::new(SharedShape::capsule(from, to, WALL), Pose::IDENTITY);
        world.add_obstacle(wall).err().map(|_| Key::SandboxOccupied)
    }

    /// Takes away the field around a point, or puts one there.
    pub(super) fn put_field(&self, world: &mut World, at: Vec2) -> Option<Key> {
        let is_here = |region: &Region| *region != Region::All && region.contains(at);
        let here = world.fields().find(|(_, field)| is_here(&field.region)).map(|(id, _)| id);
        let region = Region::Circle { centre: at, radius: FIELD };
        let done = match here {
            Some(id) => world.remove_field(id),
            None => world.add_field(ForceField { region, kind: FIELDS[self.field].1(at) }).map(drop),
        };
        done.err().map(|_| Key::SandboxCrowded)
    }

    /// Draws what was begun, with its other end at a point.
    pub(super) fn draw(&self, canvas: &mut Canvas, world: &World, camera: &Camera, to: Vec2) {
        let rope = self.first.and_then(|end| place_of(world, end)).map(|at| (at, 2.0));
        let begun = rope.or(self.from.map(|at| (at, 2.0 * WALL * camera.scale())));
        if let Some((from, width)) = begun {
            canvas.segment(camera.to_screen(from), camera.to_screen(to), width, fade(READY, 0.6));
        }
    }
}

/// Draws the joints of a world.
pub(super) fn draw_joints(canvas: &mut Canvas, world: &World, camera: &Camera) {
    for joint in world.joints() {
        let [from, to] = joint.ends.map(|end| camera.to_screen(end));
        canvas.segment(from, to, 2.0, fade(WAIT, 0.9));
    }
}

/// Draws the fields of a world faintly: their edges, and strokes with a dot at the end to which they push.
pub(super) fn draw_fields(canvas: &mut Canvas, world: &World, camera: &Camera) {
    let colour = fade(WAIT, 0.7);
    for (_, field) in world.fields() {
        let Region::Circle { centre, radius } = field.region else { continue };
        canvas.circle(camera.to_screen(centre), radius * camera.scale(), 1.5, colour);
        for k in 0..8u8 {
            let at = centre + 0.6 * radius * Vec2::from_angle(f32::from(k) * std::f32::consts::FRAC_PI_4);
            let to = camera.to_screen(at + 0.2 * radius * world.field_at(at).normalize_or_zero());
            canvas.segment(camera.to_screen(at), to, 1.5, colour);
            canvas.circle(to, 2.0, 1.0, colour);
        }
    }
}

/// What is nearest to a point, and which of its particles.
fn nearest(world: &World, at: Vec2, within: f32, filter: &QueryFilter<'_>) -> Option<(Collider, Option<u32>)> {
    world.queries().nearest(at, within, filter).map(|found| (found.collider, found.node))
}

/// What a rope holds at a point: the nearest particle or obstacle, or else the place.
fn end_at(world: &World, at: Vec2, within: f32) -> JointEnd {
    match nearest(world, at, within, &QueryFilter::default()) {
        Some((Collider::Organism(organism), Some(particle))) => {
            let mut particles = world.view().organism(organism).into_iter().flat_map(|body| body.particles());
            let node = particles.position(|it| it.index == particle).unwrap_or_default() as u32;
            JointEnd::Node { organism, node }
        }
        Some((Collider::Obstacle(obstacle), _)) => {
            let pose = world.obstacle(obstacle).map_or(Pose::IDENTITY, |obstacle| obstacle.pose);
            JointEnd::Obstacle { obstacle, at: pose.inverse_transform_point(at) }
        }
        _ => JointEnd::Point(at),
    }
}

/// Where an end is; `None` if that is gone.
fn place_of(world: &World, end: JointEnd) -> Option<Vec2> {
    match end {
        JointEnd::Node { organism, node } => {
            world.view().organism(organism)?.particles().nth(node as usize).map(|particle| particle.position)
        }
        JointEnd::Obstacle { obstacle, at } => Some(world.obstacle(obstacle)?.pose.transform_point(at)),
        JointEnd::Point(at) => Some(at),
        _ => None,
    }
}

/// Distance of a place to the nearest image of another.
fn distance(world: &World, from: Vec2, to: Vec2) -> f32 {
    let (config, way) = (world.config(), to - from);
    let repeats = BVec2::new(config.sides.left == Side::Periodic, config.sides.bottom == Side::Periodic);
    Vec2::select(repeats, way - (way / config.size).round() * config.size, way).length()
}

#[cfg(test)]
mod tests {
    use super::*;
    use microsim_core::{AgarSpec, AmoeboidCellSpec, Inputs, Intent, Placement, Sides, WorldConfig};

    fn room() -> World {
        World::new(WorldConfig::default()).unwrap()
    }

    fn counts(world: &World) -> [usize; 3] {
        [world.joints().count(), world.obstacles().count(), world.fields().count()]
    }

    #[test]
    fn a_rope_is_clicked_from_body_to_body_or_place_and_away() {
        let mut world = room();
        let [a, b] = [40.0, 60.0].map(|x| world.spawn(&AgarSpec::default().into(), Placement::at(x, 40.0)).unwrap());
        let mut building = Building::default();
        assert_eq!(building.join(&mut world, Vec2::new(40.5, 40.0), 1.0), None);
        assert_eq!(counts(&world), [0; 3]);
        assert_eq!(building.join(&mut world, Vec2::new(60.0, 40.0), 1.0), None);
        let ends = world.joints().next().unwrap().ends;
        assert!(ends[0].distance(ends[1]) > 19.9 && counts(&world)[0] == 1);
        world.push(b, Vec2::new(20.0, 0.0)).unwrap();
        (0..60).for_each(|_| world.step(&Inputs::new()));
        assert!(world.centroid(a).unwrap().x > 41.0, "it is towed");
        let between = 0.5 * (world.centroid(a).unwrap() + world.centroid(b).unwrap());
        assert_eq!(building.join(&mut world, between, 1.0), None);
        assert_eq!(counts(&world), [0; 3]);
        for at in [Vec2::new(20.0, 20.0), Vec2::new(30.0, 20.0)] {
            let told = building.join(&mut world, at, 1.0);
            assert_eq!(told.is_some(), at.x > 25.0, "nothing is held at either end");
        }
    }

    #[test]
    fn a_rope_over_a_periodic_side_is_as_long_as_the_way_there() {
        let sides = Sides { left: Side::Periodic, right: Side::Periodic, ..Sides::default() };
        let mut world = World::new(WorldConfig { sides, ..WorldConfig::default() }).unwrap();
        for x in [4.0, 156.0] {
            world.spawn(&AgarSpec::default().into(), Placement::at(x, 40.0)).unwrap();
        }
        let mut building = Building::default();
        for x in [4.0, 156.0] {
            assert_eq!(building.join(&mut world, Vec2::new(x, 40.0), 1.0), None);
        }
        let rope = world.joints().next().unwrap().spec.kind;
        assert!(matches!(rope, JointKind::Rope { max_length } if (max_length - 8.0).abs() < 1e-3), "{rope:?}");
    }

    #[test]
    fn a_cell_on_a_rope_goes_no_farther() {
        let mut world = room();
        let cell = world.spawn(&AmoeboidCellSpec::default().into(), Placement::at(60.0, 45.0)).unwrap();
        let rear = world.view().organism(cell).unwrap().bounds().0.x;
        let mut building = Building::default();
        for at in [Vec2::new(rear + 0.2, 45.0), Vec2::new(rear - 10.0, 45.0)] {
            assert_eq!(building.join(&mut world, at, 1.0), None);
        }
        let mut inputs = Inputs::new();
        inputs.set(cell, Intent::toward(Vec2::new(150.0, 45.0)).unwrap());
        (0..600).for_each(|_| world.step(&inputs));
        assert!(world.validate().is_ok() && counts(&world)[0] == 1);
        assert!(world.centroid(cell).unwrap().x < 95.0, "{}", world.centroid(cell).unwrap());
    }

    #[test]
    fn a_wall_is_dragged_where_there_is_room_and_clicked_away() {
        let mut world = room();
        world.spawn(&AgarSpec::default().into(), Placement::at(50.0, 40.0)).unwrap();
        let mut building = Building::default();
        let mut wall = |world: &mut World, from: Vec2, to: Vec2| {
            building.begin_wall(world, from, 1.0);
            building.end_wall(world, to, 1.0)
        };
        assert_eq!(wall(&mut world, Vec2::new(40.0, 40.0), Vec2::new(60.0, 40.0)), Some(Key::SandboxOccupied));
        assert_eq!(wall(&mut world, Vec2::new(40.0, 40.0), Vec2::new(40.5, 40.0)), Some(Key::SandboxShort));
        assert_eq!(wall(&mut world, Vec2::new(40.0, 50.0), Vec2::new(60.0, 52.0)), None);
        assert_eq!(counts(&world), [0, 1, 0]);
        let (there, away) = (Vec2::new(50.0, 51.0), Vec2::new(90.0, 51.0));
        assert_eq!((wall(&mut world, there, away), counts(&world)), (None, [0; 3]));
        // What was begun by a click that never ended is forgotten.
        assert_eq!(wall(&mut world, Vec2::new(40.0, 50.0), Vec2::new(60.0, 52.0)), None);
        building.begin_wall(&mut world, Vec2::new(20.0, 20.0), 1.0);
        building.begin_wall(&mut world, there, 1.0);
        assert_eq!((building.end_wall(&mut world, away, 1.0), counts(&world)), (None, [0; 3]));
    }

    #[test]
    fn a_field_of_either_kind_is_put_and_taken_away() {
        let mut world = room();
        let mut building = Building::default();
        for expected in [Vec2::Y, Vec2::X] {
            let at = Vec2::new(50.0, 40.0);
            assert_eq!(building.put_field(&mut world, at), None);
            assert!(world.field_at(at + 5.0 * Vec2::X).normalize().dot(expected) > 0.9);
            let camera = Camera::whole(world.config().size, Vec2::new(640.0, 360.0));
            let mut canvas = Canvas::bare();
            draw_fields(&mut canvas, &world, &camera);
            assert!(canvas.count(fade(WAIT, 0.7)) > 8);
            assert_eq!(building.put_field(&mut world, at + Vec2::X), None);
            assert_eq!(counts(&world), [0; 3]);
            building.change_field();
        }
    }
}
