//! Static geometry: the tables `[[wall]]`, `[[block]]`, `[[disc]]` and `[[polygon]]`.

use crate::WorldConfig;
use crate::collision::obstacle::Obstacle;
use crate::geometry::{is_simple, signed_area, triangulate};
use crate::particle::Material;
use crate::scenario::reader::{DEGREE, Fields, Read, ReadContext, SpannedValue, ValueType, mismatch};
use glam::Vec2;
use parry2d::bounding_volume::{Aabb, BoundingVolume};
use parry2d::math::Pose;
use parry2d::shape::SharedShape;

/// Most corners of a polygon: cutting it into triangles takes up to the third power of their number.
const MAX_CORNERS: usize = 200;
const LEAST_CORNERS: usize = 3;
/// Lengths and coordinates that make sense.
const LENGTH: [f32; 2] = [0.01, WorldConfig::MAX_SIZE];
const NEAR: [f32; 2] = [-WorldConfig::MAX_SIZE, WorldConfig::MAX_SIZE];

type ReadShape = fn(&mut Fields<'_>) -> Option<(SharedShape, Pose)>;

/// Tables of obstacles and how they are read.
const KINDS: [(&str, ReadShape); 4] = [("wall", wall), ("block", block), ("disc", disc), ("polygon", polygon)];

/// Reads all obstacles of a file for a room of this size.
pub(crate) fn read(root: &mut Fields<'_>, size: Vec2) -> Vec<Obstacle> {
    let mut obstacles = Vec::new();
    for (kind, read) in KINDS {
        for mut fields in root.list(kind) {
            let shape = read(&mut fields);
            let friction = fields.number("friction", Material::default().friction, [0.0, 10.0]);
            if let Some((shape, pose)) = shape {
                check_place(&fields, shape.compute_aabb(&pose), size);
                let material = Material { friction, ..Material::default() };
                obstacles.push(Obstacle { material, ..Obstacle::new(shape, pose) });
            }
            fields.finish();
        }
    }
    obstacles
}

/// Refuses an obstacle outside the room: it would have no effect.
fn check_place(fields: &Fields<'_>, bounds: Aabb, size: Vec2) {
    if !bounds.intersects(&Aabb::new(Vec2::ZERO, size)) {
        let place = ["at", "from", "points"].into_iter().find(|field| fields.has(field)).unwrap_or_default();
        let accepted = format!("something within 0 to {} by 0 to {}", size.x, size.y);
        fields.refuse(place, "lies wholly outside the room", accepted);
    }
}

/// A straight wall with round ends.
fn wall(fields: &mut Fields<'_>) -> Option<(SharedShape, Pose)> {
    let from = point(fields, "from");
    let to = point(fields, "to");
    let thickness = length(fields, "thickness");
    let (from, to, thickness) = (from?, to?, thickness?);
    if (to - from).length() < LENGTH[0] {
        fields.refuse("to", "the wall has no length", "a point away from `from`");
        return None;
    }
    let middle = (from + to) * 0.5;
    let shape = SharedShape::capsule(from - middle, to - middle, 0.5 * thickness);
    Some((shape, Pose::translation(middle.x, middle.y)))
}

/// A rectangle.
fn block(fields: &mut Fields<'_>) -> Option<(SharedShape, Pose)> {
    let at = point(fields, "at");
    let size = fields.required::<Vec2>("size");
    let angle = fields.number("angle", 0.0, [-36_000.0, 36_000.0]);
    let (at, size) = (at?, size?);
    let is_sound = fields.is_within("size.0", size.x, LENGTH) & fields.is_within("size.1", size.y, LENGTH);
    if !is_sound {
        return None;
    }
    let turned = crate::geometry::unit_vector(angle * DEGREE);
    let rotation = parry2d::math::Rot2::from_cos_sin_unchecked(turned.x, turned.y);
    let pose = Pose::from_parts(at, rotation);
    Some((SharedShape::cuboid(0.5 * size.x, 0.5 * size.y), pose))
}

/// A disc.
fn disc(fields: &mut Fields<'_>) -> Option<(SharedShape, Pose)> {
    let at = point(fields, "at");
    let radius = length(fields, "radius");
    let (at, radius) = (at?, radius?);
    Some((SharedShape::ball(radius), Pose::translation(at.x, at.y)))
}

/// A simple polygon, convex or not, as triangles.
fn polygon(fields: &mut Fields<'_>) -> Option<(SharedShape, Pose)> {
    let Corners(points) = fields.required("points")?;
    let is_near = |point: &Vec2| point.abs().cmple(Vec2::splat(WorldConfig::MAX_SIZE)).all();
    if !points.iter().all(is_near) || !is_simple(&points) || signed_area(&points).abs() < LENGTH[0] {
        let accepted =
            format!("corners in order around an area, edges that do not cross, within ±{}", WorldConfig::MAX_SIZE);
        fields.refuse("points", "no usable outline", accepted);
        return None;
    }
    let corner = |k: u32| points[k as usize];
    let triangles = triangulate(&points).into_iter();
    let triangle = |[a, b, c]: [u32; 3]| (Pose::IDENTITY, SharedShape::triangle(corner(a), corner(b), corner(c)));
    Some((SharedShape::compound(triangles.map(triangle).collect()), Pose::IDENTITY))
}

/// Corners of a polygon.
struct Corners(Vec<Vec2>);

impl Read for Corners {
    fn accepted() -> String {
        format!("{LEAST_CORNERS} to {MAX_CORNERS} corners, each [x, y]")
    }

    fn value_type() -> ValueType {
        ValueType::List(Box::new(Vec2::value_type()), [LEAST_CORNERS, MAX_CORNERS])
    }

    fn written(&self) -> String {
        self.0.written()
    }

    fn read(value: &SpannedValue<'_>, path: &str, context: &ReadContext<'_>) -> Option<Self> {
        match value.get_ref().as_array().map(|corners| corners.len()) {
            Some(LEAST_CORNERS..=MAX_CORNERS) => Vec::read(value, path, context).map(Self),
            _ => mismatch(value, path, context),
        }
    }
}

fn point(fields: &mut Fields<'_>, field: &'static str) -> Option<Vec2> {
    let point: Vec2 = fields.required(field)?;
    let [x, y] = [format!("{field}.0"), format!("{field}.1")];
    let is_near = fields.is_within(&x, point.x, NEAR) & fields.is_within(&y, point.y, NEAR);
    is_near.then_some(point)
}

fn length(fields: &mut Fields<'_>, field: &'static str) -> Option<f32> {
    let length = fields.required(field)?;
    fields.is_within(field, length, LENGTH).then_some(length)
}
