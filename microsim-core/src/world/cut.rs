//! Division of bodies by the cut of their template. Everything is checked before anything changes.

use super::World;
use super::mass::MASSES;
use super::occupancy::{bounds_of, discs};
use super::scale::SCALES;
use crate::capability::division::Divider;
use crate::capability::progress::Progress;
use crate::error::{Error, ErrorKind, in_range};
use crate::event::{Event, Refusal};
use crate::geometry::ring::{direction_or, rotate};
use crate::id::{OrganismId, TemplateId};
use crate::kind::Kind;
use crate::organism::{Blueprint, Organism, Storage, TOUCHING};
use crate::particle::mass_properties::{LEAST_INERTIA, MassProperties};
use crate::particle::{CollisionGroups, GRID, NO_OWNER, Particle};
use crate::rng::Rng;
use crate::template::{Half, Node, Template};
use glam::Vec2;

/// Overlap of halves with others and each other, as a share of the sum of two radii.
const OVERLAP: f32 = 0.5;

/// A half as it will be.
pub(super) struct PlannedHalf {
    blueprint: Blueprint,
    template: Template,
    scale: f32,
    speed: f32,
    particles: Vec<Particle>,
    /// Rows of plastic strains in the length state of a block, and what they are.
    strains: Vec<(u32, f32)>,
}

/// What becomes of the slots of a half.
struct Transfer<'a> {
    nodes: &'a [Node],
    scale: f32,
    /// Groups that the whole body was given.
    groups: CollisionGroups,
}

impl World {
    /// Whether a body can divide, as far as its template goes.
    pub(in crate::world) fn divides(&self, organism: &Organism) -> bool {
        self.template_of(organism).is_some_and(|template| template.cut().is_some())
    }

    pub(in crate::world) fn template_of(&self, organism: &Organism) -> Option<&Template> {
        let Storage::Lane { block, .. } = organism.body else { return None };
        self.templates.get(self.blocks.get(block as usize)?.template as usize)
    }

    /// Divides the bodies that were told to.
    pub(crate) fn divide_bodies(&mut self) {
        if self.templates.iter().all(|template| template.cut().is_none()) {
            return;
        }
        let is_told = |organism: &Organism| {
            organism.body.membrane().is_none()
                && organism.divider.as_ref().is_some_and(|divider| divider.order.is_some())
        };
        let told: Vec<OrganismId> =
            self.organisms.iter().filter(|(_, organism)| is_told(organism)).map(|(id, _)| id).collect();
        // Since places were noted, everything has moved.
        self.scratch.occupancy.clear();
        for id in told {
            if let Some(divider) = self.divider_mut(id) {
                divider.order = None;
            }
            match self.plan_cut(id) {
                Ok(halves) => self.cut(id, halves),
                Err(error) => {
                    let reason = self.reason(id, &error);
                    self.events.push(Event::DivisionRefused { organism: id, reason });
                }
            }
        }
        self.scratch.occupancy.clear();
    }

    fn reason(&self, id: OrganismId, error: &Error) -> Refusal {
        match error.kind() {
            _ if self.organisms.get(id).is_some_and(|organism| organism.is_quarantined) => Refusal::Quarantined,
            ErrorKind::TooMany { .. } => Refusal::WorldFull,
            ErrorKind::Overlap { .. } | ErrorKind::OutsideWorld { .. } => Refusal::NoRoom,
            _ => Refusal::UnfitHalf,
        }
    }

    /// The two halves of a body, where it is.
    pub(in crate::world) fn plan_cut(&mut self, id: OrganismId) -> Result<[PlannedHalf; 2], Error> {
        let organism = self.organisms.get(id).ok_or_else(|| Error::stale("organism"))?;
        let is_free = !organism.is_quarantined && !organism.is_held();
        let Some(template) = self.template_of(organism).filter(|_| is_free) else {
            return Err(Error::unsupported("organism", "one that is neither frozen nor held"));
        };
        let Some([one, other]) = template.cut() else {
            return Err(Error::unsupported("organism", "a body whose template has a cut"));
        };
        let [one, other] =
            [(one, "cut[0]"), (other, "cut[1]")].map(|(half, name)| (self.plan_half(organism, template, half), name));
        let halves = [one.0.map_err(|error| error.within(one.1))?, other.0.map_err(|error| error.within(other.1))?];
        self.check_halves(id, &halves)?;
        Ok(halves)
    }

    fn plan_half(&self, organism: &Organism, whole: &Template, half: &Half) -> Result<PlannedHalf, Error> {
        let id = self.template_of_half(organism, half)?;
        let template = self.templates[id.0 as usize].clone();
        if !template.nodes().iter().all(|node| node.mass.is_finite()) {
            return Err(Error::unsupported("template", "a template of nodes that can move"));
        }
        let blueprint = Blueprint::custom(id, template.clone());
        let speed = if whole.propulsion().is_some() { organism.speed } else { blueprint.speed };
        let has_outline = !template.outline().is_empty();
        self.check_controller(&organism.controller, &blueprint.locomotion, speed, has_outline)?;
        let scale = self.scale_of(organism) * half.scale;
        let most = self.greatest_scale(template.nodes());
        in_range("scale", scale, SCALES[0], if most < SCALES[1] { most } else { SCALES[1] })?;
        self.check_period(&blueprint, scale)?;
        self.check_kicks(&blueprint, scale, organism.linear_damping)?;
        let transfer = Transfer { nodes: template.nodes(), scale, groups: self.groups_of(organism, whole) };
        let planned = self.particles_of_half(organism, whole, half, &transfer);
        let particles = planned.ok_or_else(|| Error::unsupported("slots", "slots that can move"))?;
        for particle in &particles {
            in_range("mass", 1.0 / particle.inv_mass, MASSES[0], MASSES[1])?;
        }
        let strains = self.strains_of_half(organism, &half.slots, &template);
        Ok(PlannedHalf { blueprint, template, scale, speed, particles, strains })
    }

    fn template_of_half(&self, organism: &Organism, half: &Half) -> Result<TemplateId, Error> {
        match organism.kind {
            Kind::Custom(own) if half.template.is_empty() => Ok(own),
            _ => self
                .template_named(&half.template)
                .ok_or_else(|| Error::reference("template", "the name of a template of this world")),
        }
    }

    /// Groups that an organism was given besides those of its nodes: what its discs have lost of theirs is left out.
    fn groups_of(&self, organism: &Organism, template: &Template) -> CollisionGroups {
        let discs = organism.particles().map(|i| self.particles.groups[i as usize]);
        discs.zip(template.nodes()).fold(CollisionGroups::ALL, |all, (disc, node)| CollisionGroups {
            memberships: all.memberships & (disc.memberships | !node.groups.memberships),
            filter: all.filter & (disc.filter | !node.groups.filter),
        })
    }

    fn particles_of_half(
        &self,
        organism: &Organism,
        whole: &Template,
        half: &Half,
        transfer: &Transfer<'_>,
    ) -> Option<Vec<Particle>> {
        let p = &self.particles;
        let list: Vec<u32> = half.slots.iter().map(|&slot| organism.body.particle(slot)).collect();
        if list.len() == transfer.nodes.len() {
            let taken_over = transfer.nodes.iter().zip(&list);
            return Some(taken_over.map(|(node, &i)| transfer.particle(node, p.get(i as usize))).collect());
        }
        let body = MassProperties::of(p, &list)?;
        let all: Vec<u32> = organism.particles().collect();
        let place = |slot: u32| whole.nodes()[slot as usize].position;
        let turn = MassProperties::of(p, &all)
            .map_or(Vec2::X, |body| body.rotation(p, &all, whole.nodes().iter().map(|node| node.position)));
        let turn = direction_or(turn, Vec2::X);
        let turn = direction_or(body.rotation(p, &list, half.slots.iter().map(|&slot| place(slot))), turn);
        let spin = body.angular_momentum(p, &list);
        let (mut centre, limit) = (p.get(body.reference), self.config.speed_limit());
        (centre.offset, centre.velocity) = (centre.offset + body.centre, body.velocity);
        Some(transfer.at_rest(centre, body.mass, turn, spin, limit))
    }

    /// Checks that there is room for halves, and in the world.
    fn check_halves(&mut self, id: OrganismId, halves: &[PlannedHalf; 2]) -> Result<(), Error> {
        let before = self.organisms.get(id).map_or(0, |organism| organism.particles().count());
        let after: usize = halves.iter().map(|half| half.particles.len()).sum();
        let asked = (self.particles.live_count() + after - before) as u64;
        let limit = u64::from(self.config.max_particles);
        if asked > limit {
            return Err(Error::new(ErrorKind::TooMany { asked, limit }, "particles"));
        }
        self.check_room_of_half(id, &halves[0]).map_err(|error| error.within("cut[0]"))?;
        self.check_room_of_half(id, &halves[1]).map_err(|error| error.within("cut[1]"))?;
        let share = if halves.iter().all(|half| half.template.outline().is_empty()) { OVERLAP } else { TOUCHING };
        let [one, other] = halves.each_ref().map(|half| &half.particles);
        let is_free = one.iter().all(|a| other.iter().all(|b| !overlap(a, b, share)));
        let refused = || Error::new(ErrorKind::Overlap { with: "the other half".to_owned() }, "cut[1]");
        is_free.then_some(()).ok_or_else(refused)
    }

    /// Checks that a half is within the walls and overlaps nobody else by much.
    fn check_room_of_half(&mut self, id: OrganismId, half: &PlannedHalf) -> Result<(), Error> {
        let all: Vec<Particle> = half.particles.iter().filter(|disc| disc.groups.memberships != 0).copied().collect();
        if all.is_empty() {
            return Ok(());
        }
        let ([low, high], size) = (self.config.walls(), self.config.size);
        for disc in &all {
            let (at, reach) = (disc.position(), disc.radius * (1.0 - TOUCHING));
            if !((at - reach).cmpge(low).all() && (at + reach).cmple(high).all()) {
                let accepted = format!("everything within 0 to {} by 0 to {}", size.x, size.y);
                return Err(Error::new(ErrorKind::OutsideWorld { accepted }, "at"));
            }
        }
        let share = if half.template.outline().is_empty() { OVERLAP } else { TOUCHING };
        let is_other = |world: &Self, organism: &Organism| {
            organism.first_node().is_none_or(|i| world.particles.owner[i as usize] != id.index)
        };
        let with = self.first_hit(&all, |world, organism, all, bounds| {
            is_other(world, organism) && (world.touches(organism, all, bounds, share) || world.encloses(organism, all))
        });
        with.map_or(Ok(()), |with| Err(Error::new(ErrorKind::Overlap { with }, "at")))
    }

    /// Puts the halves in the place of a body: the first one keeps its handle.
    fn cut(&mut self, id: OrganismId, [one, other]: [PlannedHalf; 2]) {
        let Some(whole) = self.organisms.get(id).cloned() else { return };
        let Storage::Lane { block, first } = whole.body else { return };
        let gone: Vec<u32> = whole.particles().collect();
        self.lose_joints(|i| gone.contains(&i));
        self.wake_up_touching(id);
        self.empty_lane(block, first);
        let daughter_id = self.organisms.next_id();
        let rng = Rng::new(self.config.seed, daughter_id.stream());
        let home = bounds_of(discs(&other.particles)).center();
        self.exemptions.inherit(id.index, daughter_id.index);
        let parent = self.settle(id, whole.clone(), one);
        let daughter = self.settle(daughter_id, Organism { rng, home, ..whole }, other);
        if let Some(place) = self.organisms.get_mut(id) {
            *place = parent;
        }
        self.organisms.insert(daughter);
        self.events.push(Event::Divided { parent: id, daughter: daughter_id });
    }

    /// An organism that is a half from now on.
    fn settle(&mut self, id: OrganismId, organism: Organism, half: PlannedHalf) -> Organism {
        let PlannedHalf { blueprint, template, scale, speed, mut particles, strains } = half;
        particles.iter_mut().for_each(|particle| particle.owner = id.index);
        self.note_place(id.index, bounds_of(discs(&particles)));
        let (outline, slots) = (template.outline().to_vec(), template.nodes().len() as u32);
        let crawl = Rng::new(self.config.seed, id.crawl_stream());
        let body = self.add_to_block(template, id.index, scale, &particles);
        self.set_strains(&body, &strains);
        Organism {
            kind: blueprint.kind,
            body,
            slots,
            locomotion: blueprint.locomotion.begun(crawl, outline.len()),
            outline,
            speed,
            spawn_area: blueprint.area * scale * scale,
            spawn_scale: scale,
            full_scale: 1.0,
            divider: blueprint.divider.map(Divider::new),
            goal: None,
            progress: Progress::default(),
            ..organism
        }
    }
}

impl Transfer<'_> {
    /// A node with the place, velocity and mass of a particle.
    fn particle(&self, node: &Node, at: Particle) -> Particle {
        Particle {
            radius: node.radius * self.scale,
            groups: node.groups.and(self.groups),
            material: node.material,
            role: node.role as u8,
            owner: NO_OWNER,
            fluid: 0,
            ..at
        }
    }

    /// All nodes in the form of the template, with this mass, turned, around a centre that moves, with this angular momentum.
    fn at_rest(&self, centre: Particle, mass: f32, turn: Vec2, spin: f32, speed_limit: f32) -> Vec<Particle> {
        let total: f32 = self.nodes.iter().map(|node| node.mass).sum();
        let middle = self.nodes.iter().map(|node| node.position * node.mass).sum::<Vec2>() / total;
        let share = mass / total;
        let arms: Vec<Vec2> =
            self.nodes.iter().map(|node| rotate((node.position - middle) * self.scale, turn)).collect();
        let inertia: f32 =
            self.nodes.iter().zip(&arms).map(|(node, arm)| node.mass * share * arm.length_squared()).sum();
        let rate = if inertia > LEAST_INERTIA { spin / inertia } else { 0.0 };
        let place = |(node, arm): (&Node, Vec2)| {
            let velocity = (centre.velocity + arm.perp() * rate).clamp_length_max(speed_limit);
            let inv_mass = 1.0 / (node.mass * share);
            let (origin, offset) = near_origin(centre.origin, centre.offset + arm);
            self.particle(node, Particle { origin, offset, velocity, inv_mass, ..centre })
        };
        self.nodes.iter().zip(arms).map(place).collect()
    }
}

/// The same place from the nearest origin on the grid.
fn near_origin(origin: Vec2, offset: Vec2) -> (Vec2, Vec2) {
    let by = (offset / GRID).round() * GRID;
    (origin + by, offset - by)
}

/// Whether two discs overlap by more than a share of the sum of their radii.
fn overlap(a: &Particle, b: &Particle, share: f32) -> bool {
    let least = (a.radius + b.radius) * (1.0 - share);
    a.groups.meets(b.groups) && (a.position() - b.position()).length_squared() < least * least
}

#[cfg(test)]
mod tests {
    use crate::{CollisionGroups, Half, Inputs, Node, Placement, Template, World, WorldConfig};
    use glam::Vec2;

    #[test]
    fn a_half_is_in_the_groups_of_its_template_but_for_those_that_the_whole_was_not_given() {
        let groups = |memberships, filter| CollisionGroups { memberships, filter };
        for (given, expected) in [(None, groups(2, 6)), (Some(groups(!0, 5)), groups(2, 4))] {
            let mut world = World::new(WorldConfig::default()).unwrap();
            let at = |x: f32, groups| Node { groups, ..Node::disc(Vec2::new(x, 0.0), 1.0, 0.5) };
            let mut half = Template::builder();
            half.name("half").node(at(0.0, groups(2, 6)));
            world.add_template(half.build().unwrap());
            let mut whole = Template::builder();
            let slots = [0.0, 1.0].map(|x| whole.node(at(x, groups(1, 7))));
            whole.cut(slots.map(|slot| Half::of([slot]).named("half")));
            let whole = world.add_template(whole.build().unwrap());
            let id = world.spawn_template(whole, Placement::at(50.0, 50.0)).unwrap();
            if let Some(given) = given {
                world.set_collision_groups(id, given).unwrap();
            }
            world.divide(id).unwrap();
            world.step(&Inputs::new());
            let found: Vec<_> = world.particles.live().map(|i| world.particles.groups[i]).collect();
            assert_eq!(found, [expected; 2]);
        }
    }
}
