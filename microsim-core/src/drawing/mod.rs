//! A world as shapes: outlines, discs and lines in the colours of their roles, to be written or painted by others.
//!
//! [`draw`] reads a [`View`] and returns [`Item`]s, the lowest first. Places and widths are in units of the world, y
//! upwards.

mod chemical;
mod images;
mod obstacle;
mod organism;
pub mod palette;
pub mod shape;

use crate::{Kind, OrganismView, View};
use glam::Vec2;
use palette::{PAGE, ROOM, ROOM_EDGE, WALL};
use shape::{DrawnPart, Geometry, Item, Paint, Stroke};

/// Width of the border around the room, as a share of the room's longer side.
pub const MARGIN: f32 = 0.035;

/// A group of items that lies above or below another one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DrawingLayer {
    /// The floor of the room.
    Room,
    /// Chemicals.
    Chemicals,
    /// Bright seams around thick cells, below everything that they could hide.
    Halos,
    /// Obstacles.
    Obstacles,
    /// Organisms, what can be eaten below what eats it.
    Organisms,
    /// The line around the room, and the border that hides what lies outside.
    Walls,
}

impl DrawingLayer {
    /// All layers, the lowest first.
    pub const ALL: [Self; 6] =
        [Self::Room, Self::Chemicals, Self::Halos, Self::Obstacles, Self::Organisms, Self::Walls];
}

/// Draws these layers of a world, in this order. Organisms that lie outside of `window` (its low and high corners) are
/// left out, as is whatever is not finite.
#[must_use]
pub fn draw(view: View<'_>, window: [Vec2; 2], layers: &[DrawingLayer]) -> Vec<Item> {
    let [low, high] = window;
    let config = view.world().config();
    let is_seen = |(from, to): (Vec2, Vec2)| from.cmple(high).all() && to.cmpge(low).all();
    let images = |organism: &OrganismView<'_>| {
        let (from, to) = organism.bounds();
        let shifts = images::shifts(config, [from, to]).into_iter();
        shifts.filter(move |shift| is_seen((from + *shift, to + *shift)))
    };
    let is_near = |organism: &OrganismView<'_>| is_seen(organism.bounds()) || images(organism).next().is_some();
    let mut organisms: Vec<_> = view.organisms().filter(is_near).collect();
    // Cells that others hold come last of their layer: they lie in these.
    let is_in_another = |it: &OrganismView<'_>| it.kind() == Kind::AmoeboidCell && it.held_by().is_some();
    organisms.sort_by_cached_key(|organism| (organism.drawn_look().layer, is_in_another(organism)));
    let size = config.size;
    let mut items = Vec::new();
    for layer in layers {
        match layer {
            DrawingLayer::Room => items.push(room(size)),
            DrawingLayer::Chemicals => items.extend(chemical::draw(view)),
            DrawingLayer::Halos => {
                for &organism in &organisms {
                    let first = items.len();
                    items.extend(organism::halo(organism));
                    images::add(first, images(&organism), size, &mut items);
                }
            }
            DrawingLayer::Obstacles => {
                let world = view.world();
                let obstacles = world.obstacles().filter_map(|id| world.obstacle(id));
                for obstacle in obstacles.filter(|obstacle| obstacle.is_solid()) {
                    let (first, aabb) = (items.len(), obstacle.shape.compute_aabb(&obstacle.pose));
                    items.extend(obstacle::draw(obstacle));
                    images::add(first, images::shifts(config, [aabb.mins, aabb.maxs]), size, &mut items);
                }
            }
            DrawingLayer::Organisms => {
                for &organism in &organisms {
                    let first = items.len();
                    organism::draw(organism, &mut items);
                    images::add(first, images(&organism), size, &mut items);
                }
            }
            DrawingLayer::Walls => items.extend(walls(size)),
        }
    }
    items.retain(|item| item.geometry.is_finite());
    items
}

fn room(size: Vec2) -> Item {
    let paint = Paint::Radial { centre: size * 0.5, radius: size.length() * 0.5, inner: ROOM, outer: ROOM_EDGE };
    Item::filled(DrawnPart::Room, Geometry::Polygons(vec![corners(size).into()]), paint)
}

/// The line around the room lies outside of it, above a border that hides what obstacles have beyond the room.
fn walls(size: Vec2) -> [Item; 2] {
    let longest = size.max_element();
    let around = |part, width: f32, colour| {
        let half = Vec2::splat(width * 0.5);
        let outside = corners(size + half * 2.0).map(|corner| corner - half);
        Item::stroked(part, Geometry::Polygons(vec![outside.into()]), Stroke { colour, width })
    };
    [around(DrawnPart::Border, longest * MARGIN * 2.0, PAGE), around(DrawnPart::Wall, longest * 0.004, WALL)]
}

fn corners(size: Vec2) -> [Vec2; 4] {
    [Vec2::ZERO, Vec2::new(size.x, 0.0), size, Vec2::new(0.0, size.y)]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{AgarSpec, AmoeboidCellSpec, FluidBlockSpec, Inputs, Placement, Side, Sides, World, WorldConfig};

    const EVERYWHERE: [Vec2; 2] = [Vec2::MIN, Vec2::MAX];

    fn parts(world: &World, window: [Vec2; 2]) -> Vec<DrawnPart> {
        draw(world.view(), window, &DrawingLayer::ALL).iter().map(|item| item.part).collect()
    }

    #[test]
    fn the_layers_lie_in_order() {
        let mut world = World::new(WorldConfig::default()).unwrap();
        assert_eq!(parts(&world, EVERYWHERE), [DrawnPart::Room, DrawnPart::Border, DrawnPart::Wall]);
        world.spawn(&AmoeboidCellSpec::default().into(), Placement::at(60.0, 40.0)).unwrap();
        world.spawn(&AgarSpec::default().into(), Placement::at(20.0, 20.0)).unwrap();
        let found = parts(&world, EVERYWHERE);
        let at = |part| found.iter().position(|&found| found == part).unwrap();
        let expected = [
            DrawnPart::Room,
            DrawnPart::Halo,
            DrawnPart::Bead,
            DrawnPart::Body,
            DrawnPart::Membrane,
            DrawnPart::Border,
            DrawnPart::Wall,
        ];
        assert!(expected.windows(2).all(|pair| at(pair[0]) < at(pair[1])), "{found:?}");
    }

    #[test]
    fn organisms_outside_of_the_window_are_left_out() {
        let mut world = World::new(WorldConfig::default()).unwrap();
        world.spawn(&AgarSpec::default().into(), Placement::at(20.0, 20.0)).unwrap();
        assert!(parts(&world, [Vec2::splat(15.0), Vec2::splat(19.9)]).contains(&DrawnPart::Bead));
        assert!(!parts(&world, [Vec2::splat(40.0), Vec2::splat(50.0)]).contains(&DrawnPart::Bead));
    }

    #[test]
    fn what_reaches_over_a_periodic_side_is_drawn_at_both() {
        let sides = Sides { left: Side::Periodic, right: Side::Periodic, ..Sides::default() };
        let mut world = World::new(WorldConfig { sides, ..WorldConfig::default() }).unwrap();
        world.spawn(&AgarSpec::default().into(), Placement::at(159.5, 20.0)).unwrap();
        let items = draw(world.view(), EVERYWHERE, &[DrawingLayer::Organisms]);
        let discs = items.iter().filter(|item| item.part == DrawnPart::Bead).map(|item| item.geometry.segments());
        let centres: Vec<_> = discs.flatten().collect();
        let circle = |x: f32| shape::Segment::Circle(Vec2::new(x, 20.0), 0.84);
        assert_eq!(centres, [circle(159.5), circle(-0.5)]);
        assert!(parts(&world, [Vec2::ZERO, Vec2::new(0.3, 40.0)]).contains(&DrawnPart::Bead));
    }

    #[test]
    fn of_fluid_that_reaches_over_a_periodic_side_only_what_is_seen_there_is_drawn_again() {
        let sides = Sides { left: Side::Periodic, right: Side::Periodic, ..Sides::default() };
        let mut world = World::new(WorldConfig { sides, ..WorldConfig::default() }).unwrap();
        let block = FluidBlockSpec { size: Vec2::new(160.0, 4.0), ..FluidBlockSpec::default() };
        let id = world.spawn(&block.into(), Placement::at(80.0, 20.0)).unwrap();
        world.push(id, Vec2::new(3.0, 0.0)).unwrap();
        (0..10).for_each(|_| world.step(&Inputs::new()));
        let items = draw(world.view(), EVERYWHERE, &[DrawingLayer::Organisms]);
        let discs: Vec<_> = items.iter().flat_map(|item| item.geometry.segments()).collect();
        let is_near = |segment: &shape::Segment| matches!(*segment, shape::Segment::Circle(at, radius) if at.x > -radius && at.x < 160.0 + radius);
        assert!(discs.iter().all(is_near));
        let beyond = |segment: &&shape::Segment| matches!(**segment, shape::Segment::Circle(at, _) if at.x < 0.0);
        assert!(discs.iter().filter(beyond).count() > 3, "those of the right side are drawn at the left one");
    }
}
