//! A read-only view for drawing and measuring.

pub(crate) mod anatomy;
pub(crate) mod links;
mod mechanics;
pub(crate) mod moment;

use crate::behavior::crawl::front_and_rear::{MembraneRegion, region};
use crate::capability::controller::Controller;
use crate::capability::exchange::Exchange;
use crate::capability::phagocytosis::{Engulfer, MealPhase, PhagocytosisParams, PreyClass};
use crate::chemical::Chemical;
use crate::id::{ChemicalId, OrganismId};
use crate::kind::Kind;
use crate::look::drawn::DrawnLook;
use crate::organism::{Organism, look};
use crate::template::Role;
use crate::world::World;
use glam::Vec2;
use moment::Moment;

/// Borrows a world for reading.
#[derive(Clone, Copy, Debug)]
pub struct View<'a> {
    pub(in crate::world) world: &'a World,
    /// An earlier moment and the share of the time since then that has passed, see [`World::view_since`].
    pub(in crate::world) earlier: Option<(&'a Moment, f32)>,
}

/// One organism, for reading.
#[derive(Clone, Copy, Debug)]
pub struct OrganismView<'a> {
    view: View<'a>,
    organism: &'a Organism,
    id: OrganismId,
}

/// One particle, for reading.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ParticleView {
    /// Its index, which is used again after the particle is removed.
    pub index: u32,
    /// Centre, units.
    pub position: Vec2,
    /// Velocity, units/s.
    pub velocity: Vec2,
    /// Radius, units.
    pub radius: f32,
    /// What it is to its organism.
    pub role: Role,
}

impl World {
    /// A read-only view of the present state.
    #[must_use]
    pub fn view(&self) -> View<'_> {
        View { world: self, earlier: None }
    }
}

impl<'a> View<'a> {
    /// The world, as it is now.
    #[must_use]
    pub fn world(self) -> &'a World {
        self.world
    }

    /// All organisms, in a stable order.
    pub fn organisms(self) -> impl Iterator<Item = OrganismView<'a>> {
        self.world.organisms.iter().map(move |(id, organism)| OrganismView { view: self, organism, id })
    }

    /// One organism; `None` for a stale handle.
    #[must_use]
    pub fn organism(self, id: OrganismId) -> Option<OrganismView<'a>> {
        let organism = self.world.organisms.get(id)?;
        Some(OrganismView { view: self, organism, id })
    }

    /// All chemicals, in the order in which they were added.
    pub fn chemicals(self) -> impl Iterator<Item = (ChemicalId, &'a Chemical)> {
        (0..).map(ChemicalId).zip(&self.world.chemicals)
    }
}

impl<'a> OrganismView<'a> {
    /// Its handle.
    #[must_use]
    pub fn id(self) -> OrganismId {
        self.id
    }

    /// What it is.
    #[must_use]
    pub fn kind(self) -> Kind {
        self.organism.kind
    }

    /// Area that it had when it was spawned, square units: of its ellipse or disc, or within its outline. Of an amoeboid cell that
    /// another one has taken in: that which it had then.
    #[must_use]
    pub fn spawn_area(self) -> f32 {
        self.organism.spawn_area
    }

    /// Whether its state was no longer finite and it is frozen.
    #[must_use]
    pub fn is_quarantined(self) -> bool {
        self.organism.is_quarantined
    }

    /// Whether its whole block has been at rest for long enough to fall asleep. It then sleeps in every step in which nothing
    /// that moves is near ([`crate::WorldConfig::sleeps`]).
    #[must_use]
    pub fn is_at_rest(self) -> bool {
        let World { sleep, blocks, config, .. } = self.view.world;
        let lane = self.organism.body.lane(blocks);
        lane.is_some_and(|(block, _)| sleep.is_at_rest(block, config.steps_to_sleep()))
    }

    /// Its particles: those of the body in the order of their nodes, then its fluid.
    pub fn particles(self) -> impl Iterator<Item = ParticleView> + 'a {
        self.organism.particles().map(move |i| self.particle(i))
    }

    /// Lower left and upper right corner of the smallest upright box around the discs of all its particles, fluid included,
    /// units. Without particles it is empty: the lower corner
    /// is at positive infinity and the upper one at negative infinity.
    #[must_use]
    pub fn bounds(self) -> (Vec2, Vec2) {
        let radii = &self.view.world.particles.radius;
        let nothing = (Vec2::INFINITY, Vec2::NEG_INFINITY);
        self.organism.particles().fold(nothing, |(low, high), i| {
            let (at, radius) = (self.view.position(i), radii[i as usize]);
            (low.min(at - radius), high.max(at + radius))
        })
    }

    /// Centres of its outline, counter-clockwise; empty if it has none.
    pub fn outline(self) -> impl ExactSizeIterator<Item = Vec2> + 'a {
        self.organism.outline_particles().map(move |i| self.view.position(i))
    }

    /// Centre of its outline's area, or the mean of its particles if it has none.
    #[must_use]
    pub fn centroid(self) -> Vec2 {
        let outline: Vec<Vec2> = self.outline().collect();
        crate::geometry::polygon::centroid(&outline).unwrap_or_else(|| {
            let add = |(sum, count): (Vec2, f32), particle: ParticleView| (sum + particle.position, count + 1.0);
            let (sum, count) = self.particles().fold((Vec2::ZERO, 0.0), add);
            sum / count
        })
    }

    /// Its outline pushed out by the discs' radius, square to the line between its neighbours (the thesis' 3.2.1 pushes away
    /// from the centre, which a concave outline does not allow): nothing that touches leaves a gap in the picture.
    #[must_use]
    pub fn surface(self) -> Vec<Vec2> {
        let outline: Vec<Vec2> = self.outline().collect();
        let count = outline.len();
        let pushed = self.organism.outline_particles().zip(0..count).map(|(i, k)| {
            let along = outline[(k + 1) % count] - outline[(k + count - 1) % count];
            outline[k] - along.perp().normalize_or_zero() * self.view.world.particles.radius[i as usize]
        });
        pushed.collect()
    }

    /// The embedder's number, see [`World::set_user_data`].
    #[must_use]
    pub fn user_data(self) -> u128 {
        let [low, high] = self.organism.user_data;
        u128::from(high) << 64 | u128::from(low)
    }

    /// How it is drawn: form, colours and place among others.
    #[must_use]
    pub fn drawn_look(self) -> DrawnLook {
        look(self.kind()).drawn
    }

    /// Size of its body relative to its size when spawned, see [`World::set_scale`].
    #[must_use]
    pub fn scale(self) -> f32 {
        self.view.world.present_scale(self.id)
    }

    /// Speed with which it moves to its goals, units/s; less while it digests.
    #[must_use]
    pub fn speed(self) -> f32 {
        self.organism.speed
    }

    /// Share of gravity that acts on it.
    #[must_use]
    pub fn gravity_scale(self) -> f32 {
        self.organism.gravity_scale
    }

    /// Damping of its motion as a whole besides that of the medium, 1/s.
    #[must_use]
    pub fn linear_damping(self) -> f32 {
        self.organism.linear_damping
    }

    /// Damping of its rotation as a whole, 1/s.
    #[must_use]
    pub fn angular_damping(self) -> f32 {
        self.organism.angular_damping
    }

    /// Its prey in the order of first contact, each with its phase; empty for organisms that are no engulfers.
    pub fn meals(self) -> impl Iterator<Item = (OrganismId, MealPhase)> + 'a {
        self.organism.meals().iter().map(|meal| (meal.prey, meal.phase))
    }

    /// How it takes prey in; `None` for organisms that are no engulfers.
    #[must_use]
    pub fn phagocytosis(self) -> Option<&'a PhagocytosisParams> {
        self.organism.engulfer.as_ref().map(|engulfer| &engulfer.params)
    }

    /// Area of its cytoplasm, square units: the sum of its particles' areas (thesis, 3.3.1), which decides with
    /// [`PhagocytosisParams::size_ratio`] how large prey may be.
    #[must_use]
    pub fn cytoplasm_area(self) -> f32 {
        self.view.world.engulfer_area(self.organism)
    }

    /// What it is as prey; `None` for what is not taken in, and for an amoeboid cell that no other one holds.
    #[must_use]
    pub fn prey_class(self) -> Option<PreyClass> {
        self.organism.prey.map(|prey| prey.class)
    }

    /// Whether the one place for soft prey is taken, or about to be.
    #[must_use]
    pub fn is_full(self) -> bool {
        self.organism.engulfer.as_ref().is_some_and(Engulfer::slot_is_taken)
    }

    /// Its phagosomes: the prey in each, and the centres of the membrane around it, counter-clockwise. Only cups make them,
    /// see [`crate::IngestionWay`].
    pub fn phagosomes(self) -> impl Iterator<Item = (OrganismId, Vec<Vec2>)> + 'a {
        let at = move |&i: &u32| self.view.position(i);
        self.organism.phagosomes.iter().map(move |inner| (inner.prey, inner.ring.iter().map(at).collect()))
    }

    /// Time since its furrow began to close, s; `None` if it is not dividing.
    #[must_use]
    pub fn dividing_for(self) -> Option<f32> {
        self.organism.furrow().map(|furrow| furrow.elapsed)
    }

    /// Its controller, in its present state.
    #[must_use]
    pub fn controller(self) -> &'a Controller {
        &self.organism.controller
    }

    /// What it secretes and takes up.
    #[must_use]
    pub fn exchanges(self) -> &'a [Exchange] {
        &self.organism.exchanges
    }

    /// Where it wanted to go in the last step; `None` if it rested, or could not follow its own will.
    #[must_use]
    pub fn goal(self) -> Option<Vec2> {
        self.organism.goal
    }

    /// Time for which it has wanted to move without getting a third of its radius away from where it was, s.
    #[must_use]
    pub fn stalled_for(self) -> f32 {
        self.organism.progress.stalled
    }

    /// Who has taken it in, or is about to.
    #[must_use]
    pub fn held_by(self) -> Option<OrganismId> {
        self.organism.prey.and_then(|prey| prey.held_by)
    }

    /// The tier of the slide that it lies in, see [`crate::CollisionGroups::in_tier`]; `None` if it meets all.
    #[must_use]
    pub fn tier(self) -> Option<u32> {
        let groups = &self.view.world.particles.groups;
        self.organism.particles().find_map(|i| groups[i as usize].tier())
    }

    /// Its heavy centre, if it has one.
    #[must_use]
    pub fn nucleus(self) -> Option<ParticleView> {
        self.particles().find(|particle| particle.role == Role::Nucleus)
    }

    /// Its front body (soft bodies), or the centre of its front while it crawls.
    #[must_use]
    pub fn front(self) -> Option<Vec2> {
        self.front_index().map(|k| self.view.position(self.organism.body.particle(self.organism.outline[k])))
    }

    /// Position in the outline of its front, see [`OrganismView::front`].
    #[must_use]
    pub fn front_index(self) -> Option<usize> {
        self.organism.locomotion.front().map(|k| k as usize)
    }

    /// How much each node of the outline protrudes, 0 to 1, of a cell that crawls by pseudopods; `None` of others.
    #[must_use]
    pub fn protrusion(self) -> Option<Vec<f32>> {
        let network = &self.organism.locomotion.pseudopods()?.network;
        Some((0..network.len()).map(|k| network.force(k)).collect())
    }

    /// The region of each node of the outline while it crawls; `None` when it does not.
    #[must_use]
    pub fn membrane_regions(self) -> Option<Vec<MembraneRegion>> {
        let front = self.organism.locomotion.crawling_front()?;
        let count = self.organism.outline.len() as u32;
        Some((0..count).map(|k| region(k, front, count)).collect())
    }

    fn particle(self, i: u32) -> ParticleView {
        let (particles, index, position, i) = (&self.view.world.particles, i, self.view.position(i), i as usize);
        ParticleView {
            index,
            position,
            velocity: particles.velocity(i),
            radius: particles.radius[i],
            role: Role::from_u8(particles.role[i]),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{AmoeboidCellSpec, Inputs, Intent, Placement, PlateletSpec, WorldConfig};

    #[test]
    fn t52_the_surface_is_the_outline_pushed_out_by_the_discs_radius() {
        let mut world = World::new(WorldConfig::default()).unwrap();
        let id = world.spawn(&PlateletSpec::default().into(), Placement::at(60.0, 30.0)).unwrap();
        let platelet = world.view().organism(id).unwrap();
        let (centre, radius) = (platelet.centroid(), platelet.particles().last().unwrap().radius);
        assert_eq!(platelet.outline().len(), platelet.surface().len());
        for (node, pushed) in platelet.outline().zip(platelet.surface()) {
            let expected = node + (node - centre).normalize() * radius;
            assert!((pushed - expected).length() < 1e-3 && radius > 0.0, "{node} -> {pushed}");
        }
        assert!(platelet.nucleus().is_some());
    }

    #[test]
    fn a_view_tells_for_how_long_a_cell_has_got_nowhere_and_how_much_cytoplasm_it_has() {
        let mut world = World::new(WorldConfig::default()).unwrap();
        let id = world.spawn(&AmoeboidCellSpec::default().into(), Placement::at(60.0, 30.0)).unwrap();
        let mut inputs = Inputs::new();
        inputs.set(id, Intent::toward(Vec2::new(90.0, 30.0)).unwrap());
        let dt = world.config().dt;
        (0..4).for_each(|_| world.step(&inputs));
        let cell = world.view().organism(id).unwrap();
        assert!((cell.stalled_for() - 3.0 * dt).abs() < 1e-5, "from the second step on: {}", cell.stalled_for());
        let radius = |&i: &u32| world.particles.radius[i as usize];
        let squares: f32 = cell.organism.fluid_particles.iter().map(radius).map(|r| r * r).sum();
        let area = std::f32::consts::PI * squares;
        assert!(area > 10.0 && (cell.cytoplasm_area() / area - 1.0).abs() < 1e-3, "{} {area}", cell.cytoplasm_area());
    }

    #[test]
    fn bounds_hold_every_disc_and_every_side_touches_one() {
        let mut world = World::new(WorldConfig::default()).unwrap();
        let id = world.spawn(&AmoeboidCellSpec::default().into(), Placement::at(60.0, 30.0)).unwrap();
        let mut inputs = Inputs::new();
        inputs.set(id, Intent::toward(Vec2::new(90.0, 50.0)).unwrap());
        (0..60).for_each(|_| world.step(&inputs));
        let before = world.moment();
        world.step(&inputs);
        let checked = |view: View<'_>| {
            let cell = view.organism(id).unwrap();
            let (low, high) = cell.bounds();
            let discs: Vec<(Vec2, f32)> = cell.particles().map(|disc| (disc.position, disc.radius)).collect();
            assert!(discs.iter().all(|(at, r)| (*at - *r).cmpge(low).all() && (*at + *r).cmple(high).all()));
            for axis in 0..2 {
                assert!(discs.iter().any(|(at, r)| at[axis] - r == low[axis]));
                assert!(discs.iter().any(|(at, r)| at[axis] + r == high[axis]));
            }
            low
        };
        let moments = [world.view_since(&before, 0.0), world.view_since(&before, 0.5), world.view()];
        let [first, between, last] = moments.map(checked);
        assert!(first.x < between.x && between.x < last.x, "they are of the moment that is viewed");
    }
}
