//! What there is to draw at one moment, in units of the room; and the moments in between two steps.

use microsim_core::glam::Vec2;
use microsim_core::{Kind, OrganismId, Role, World};
use std::ops::Range;

/// All organisms at one moment.
#[derive(Clone, Debug, Default)]
pub struct Picture {
    /// In the world's order.
    pub shapes: Vec<Shape>,
    points: Vec<Vec2>,
    discs: Vec<Disc>,
}

/// One organism.
#[derive(Clone, Debug, PartialEq)]
pub struct Shape {
    /// Its handle.
    pub id: OrganismId,
    /// What it is.
    pub kind: Kind,
    /// Position of its front in its outline.
    pub front: Option<usize>,
    discs: Range<usize>,
    outline: Range<usize>,
    surface: Range<usize>,
    /// One after the other.
    phagosomes: Vec<Range<usize>>,
}

/// What a particle looks like, apart from its place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Disc {
    /// Radius, units.
    pub radius: f32,
    /// Speed, units/s.
    pub speed: f32,
    /// What it is to its organism.
    pub role: Role,
}

impl Picture {
    /// The present state of a world.
    #[must_use]
    pub fn of(world: &World) -> Self {
        let mut picture = Self::default();
        for organism in world.view().organisms() {
            let discs = picture.points.len();
            for particle in organism.particles() {
                picture.points.push(particle.position);
                picture.discs.resize(picture.points.len(), NO_DISC);
                picture.discs[picture.points.len() - 1] =
                    Disc { radius: particle.radius, speed: particle.velocity.length(), role: particle.role };
            }
            let outline = picture.points.len();
            picture.points.extend(organism.outline());
            let surface = picture.points.len();
            picture.points.extend(organism.surface());
            let end = picture.points.len();
            let phagosomes = organism.phagosomes().map(|(_, ring)| {
                let start = picture.points.len();
                picture.points.extend(ring);
                start..picture.points.len()
            });
            let phagosomes = phagosomes.collect();
            picture.shapes.push(Shape {
                id: organism.id(),
                kind: organism.kind(),
                front: organism.front_index(),
                discs: discs..outline,
                outline: outline..surface,
                surface: surface..end,
                phagosomes,
            });
        }
        picture
    }

    /// The moment `alpha` of the way from `before` to `self`. What was not there before is where it is now.
    #[must_use]
    pub fn since(&self, before: &Self, alpha: f32) -> Self {
        let mut between = self.clone();
        for (k, shape) in self.shapes.iter().enumerate() {
            let same = |old: &&Shape| old.id == shape.id;
            let at_same_place = before.shapes.get(k).filter(same);
            let Some(old) = at_same_place.or_else(|| before.shapes.iter().find(same)) else {
                continue;
            };
            if old.lengths().eq(shape.lengths()) {
                let (from, to) = (&before.points[old.all()], &mut between.points[shape.all()]);
                from.iter().zip(to).for_each(|(from, to)| *to = from.lerp(*to, alpha));
            }
        }
        between
    }

    /// Its particles, with where they are.
    pub fn discs(&self, shape: &Shape) -> impl Iterator<Item = (Vec2, Disc)> + '_ {
        let places = self.points[shape.discs.clone()].iter().copied();
        places.zip(self.discs[shape.discs.clone()].iter().copied())
    }

    /// Centres of its outline, counter-clockwise.
    #[must_use]
    pub fn outline(&self, shape: &Shape) -> &[Vec2] {
        &self.points[shape.outline.clone()]
    }

    /// Its outline pushed out by the discs' radius.
    #[must_use]
    pub fn surface(&self, shape: &Shape) -> &[Vec2] {
        &self.points[shape.surface.clone()]
    }

    /// Centres of the membrane around each prey that a cup has taken in, counter-clockwise.
    pub fn phagosomes(&self, shape: &Shape) -> impl Iterator<Item = &[Vec2]> {
        shape.phagosomes.iter().map(|ring| &self.points[ring.clone()])
    }

    /// The first of its particles in this role.
    #[must_use]
    pub fn find(&self, shape: &Shape, role: Role) -> Option<(Vec2, Disc)> {
        self.discs(shape).find(|(_, disc)| disc.role == role)
    }

    /// Mean of its outline, or of its particles.
    #[must_use]
    pub fn middle(&self, shape: &Shape) -> Option<Vec2> {
        let points = match self.outline(shape) {
            [] => &self.points[shape.discs.clone()],
            outline => outline,
        };
        (!points.is_empty()).then(|| points.iter().sum::<Vec2>() / points.len() as f32)
    }

    /// One organism.
    #[must_use]
    pub fn shape(&self, id: OrganismId) -> Option<&Shape> {
        self.shapes.iter().find(|shape| shape.id == id)
    }
}

/// Stands at points that are no particle.
const NO_DISC: Disc = Disc { radius: 0.0, speed: 0.0, role: Role::Plain };

impl Shape {
    fn all(&self) -> Range<usize> {
        self.discs.start..self.phagosomes.last().map_or(self.surface.end, |last| last.end)
    }

    fn lengths(&self) -> impl Iterator<Item = usize> + '_ {
        let rings = self.phagosomes.iter().map(|ring| ring.len());
        [self.discs.len(), self.outline.len(), self.surface.len()].into_iter().chain(rings)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use microsim_core::{AgarSpec, Inputs, Placement, PlateletSpec, WorldConfig};

    fn world() -> World {
        let gravity = Vec2::new(0.0, -10.0);
        World::new(WorldConfig { gravity, ..WorldConfig::default() }).unwrap()
    }

    #[test]
    fn the_moment_between_lies_in_the_middle() {
        let mut world = world();
        let agar = world.spawn(&AgarSpec::default().into(), Placement::at(30.0, 30.0)).unwrap();
        let before = Picture::of(&world);
        (0..30).for_each(|_| world.step(&Inputs::new()));
        let now = Picture::of(&world);
        let height = |picture: &Picture| picture.middle(picture.shape(agar).unwrap()).unwrap().y;
        let (from, to) = (height(&before), height(&now));
        assert!(to < from - 0.5);
        assert!((height(&now.since(&before, 0.25)) - (0.75 * from + 0.25 * to)).abs() < 1e-4);
        assert_eq!(height(&now.since(&before, 1.0)), to);
    }

    #[test]
    fn what_came_or_went_does_not_disturb_the_others() {
        let mut world = world();
        let gone = world.spawn(&AgarSpec::default().into(), Placement::at(20.0, 30.0)).unwrap();
        let stays = world.spawn(&PlateletSpec::default().into(), Placement::at(60.0, 30.0)).unwrap();
        let before = Picture::of(&world);
        world.remove(gone).unwrap();
        let came = world.spawn(&PlateletSpec::default().into(), Placement::at(90.0, 30.0)).unwrap();
        let between = Picture::of(&world).since(&before, 0.5);
        assert!(between.shape(gone).is_none());
        let at = |id| between.middle(between.shape(id).unwrap()).unwrap();
        assert!((at(stays) - Vec2::new(60.0, 30.0)).length() < 0.1);
        assert!((at(came) - Vec2::new(90.0, 30.0)).length() < 0.1);
    }

    #[test]
    fn a_platelet_has_an_outline_a_surface_and_a_nucleus() {
        let mut world = world();
        world.spawn(&PlateletSpec::default().into(), Placement::at(60.0, 30.0)).unwrap();
        let picture = Picture::of(&world);
        let shape = &picture.shapes[0];
        assert_eq!(picture.outline(shape).len(), picture.surface(shape).len());
        assert!(picture.find(shape, Role::Nucleus).is_some());
        assert!(picture.find(shape, Role::Fluid).is_none());
    }
}
