//! Calls that change nothing: queries, and copies that answer and go on as their original does.

use super::{Outcome, Sequence};
use microsim_core::glam::Vec2;
use microsim_core::{Collider, Measure, QueryFilter, World};

impl Sequence<'_> {
    /// Keeps the world as it is, or returns to the one that was kept: either way what was put in the place of another world
    /// answers as its original does, and goes on as it.
    pub(super) fn save_or_restore(&mut self) -> Outcome {
        let is_saved = self.choices.flag();
        let Self { world, saved, .. } = self;
        let (from, into) = if is_saved { (&*world, saved) } else { (&*saved, world) };
        into.clone_from(from);
        assert_eq!(answers(into), answers(from), "a clone in the place of another world answers otherwise");
        let mut clones = [from.clone(), into.clone()];
        self.digest_saved = into.digest();
        clones.iter_mut().for_each(|clone| clone.step(&self.inputs));
        assert_eq!(clones[0].digest(), clones[1].digest(), "a clone in the place of another world goes on otherwise");
        Ok(())
    }

    /// Asks everything, also with handles that are stale and numbers that make no sense.
    pub(super) fn ask(&mut self) -> Outcome {
        let (a, b) = (self.place(), self.place());
        let radius = self.choices.number(0.0, 10.0);
        let world = &self.world;
        let found = world.organisms_at(a).count() + world.organisms_in_circle(a, radius).count();
        let boxed = world.organisms_in_box(a, b).count();
        assert!(found <= 2 * world.organisms().count() && boxed <= world.organisms().count());
        self.query(a, b, radius);
        let world = &self.world;
        for &id in &self.handles {
            let is_alive = world.kind(id).is_some();
            assert_eq!(is_alive, world.view().organism(id).is_some());
            assert_eq!(is_alive, world.centroid(id).is_some());
            assert!(is_alive || world.membrane_quality(id).is_none());
        }
        assert!(Measure::ALL.iter().all(|measure| measure.of(world).is_finite()));
        Ok(())
    }

    /// All queries agree with each other.
    fn query(&self, a: Vec2, b: Vec2, radius: f32) {
        let (queries, all) = (self.world.queries(), QueryFilter { sensors: true, ..QueryFilter::default() });
        let is_known = |collider: Collider| match collider {
            Collider::Organism(id) => self.world.kind(id).is_some(),
            Collider::Obstacle(id) => self.world.obstacle(id).is_some(),
            Collider::Wall(_) => true,
        };
        let hits = queries.cast_ray_all(a, b - a, 10.0 * radius, &all);
        let first = queries.cast_ray(a, b - a, 10.0 * radius, &all);
        assert_eq!(hits.first().map(|hit| hit.distance), first.map(|hit| hit.distance));
        assert!(hits.iter().all(|hit| is_known(hit.collider)));
        let cast = queries.cast_disc(a, b - a, 10.0 * radius, radius, &all);
        let is_sooner = !radius.is_finite()
            || first.is_none_or(|first| cast.is_some_and(|cast| cast.distance <= first.distance + 0.01));
        assert!(is_sooner, "a disc of {radius} from {a} to {b}: {cast:?}, a ray {first:?}");
        let boxed = queries.overlap_box(a, b, &all);
        let near = [queries.overlap_disc(a, radius, &all), boxed, queries.overlap_polygon(&[a, b, a + b], &all)];
        assert!(near.iter().flatten().all(|&collider| is_known(collider)));
        let nearest = queries.nearest(a, radius, &all);
        assert!(nearest.is_none_or(|nearest| nearest.distance <= radius));
        let fresh = self.world.clone();
        let fresh = fresh.queries();
        assert_eq!(fresh.cast_ray_all(a, b - a, 10.0 * radius, &all), hits, "what was kept is out of date");
        assert_eq!(fresh.nearest(a, radius, &all), nearest, "what was kept is out of date");
    }

    /// Goes on with what is read of what the world is written as.
    pub(super) fn write_and_read(&mut self) -> Outcome {
        let bytes = self.world.to_snapshot().expect("all obstacles have a record");
        let mut read = World::from_snapshot(&bytes).expect("what was written can be read");
        assert_eq!(read.digest(), self.world.digest(), "what was read is not what was written");
        [&mut read, &mut self.world].into_iter().for_each(|world| world.step(&self.inputs));
        assert_eq!(read.digest(), self.world.digest(), "what was read goes on otherwise");
        self.world = read;
        Ok(())
    }
}

/// What depends on the last step's search, and some of the rest.
fn answers(world: &World) -> (u64, Vec<u64>, Vec<[Vec2; 2]>) {
    let measures = Measure::ALL.iter().map(|measure| measure.of(world).to_bits()).collect();
    (world.digest(), measures, world.view().contacts().collect())
}
