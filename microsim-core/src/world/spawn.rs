//! Spawning and removing organisms. Everything is checked before anything changes.

use super::World;
use super::change::WorldChange;
use super::occupancy::{bounds_of, discs};
use super::vacancies::Vacancy;
use crate::capability::Locomotion;
use crate::capability::division::{Divider, DivisionParams};
use crate::capability::phagocytosis::{Engulfer, Prey};
use crate::capability::progress::Progress;
use crate::collision::obstacle::Obstacle;
use crate::config::WorldConfig;
use crate::error::{Error, ErrorKind};
use crate::float_environment::with_default_float_environment;
use crate::geometry::polygon::contains_point;
use crate::id::{OrganismId, TemplateId};
use crate::kind::Kind;
use crate::organism::{Blueprint, FluidPlan, Organism, OrganismSpec, Placement, Storage, TOUCHING};
use crate::particle::{CollisionGroups, Material, NO_OWNER, Particle};
use crate::rng::Rng;
use crate::solver::block::Block;
use crate::solver::fluid::{Fluid, FluidParams};
use crate::solver::lanes::LANES;
use crate::solver::membrane::Membrane;
use crate::template::{Node, Propulsion, Role, Template};
use glam::Vec2;
use parry2d::bounding_volume::{Aabb, BoundingVolume};

impl World {
    /// Puts an organism into the world.
    ///
    /// # Errors
    /// When a field of the spec or the placement is out of range, when the organism would lie outside the walls, inside a membrane
    /// or overlap what is already there, when substeps are too long for its membrane, when a thermal field would kick it beyond the
    /// speed limit, when a room with periodic sides cannot hold it ([`Side::Periodic`](crate::Side::Periodic)), or when the world would
    /// hold too many particles.
    /// Nothing is changed then.
    pub fn spawn(&mut self, spec: &OrganismSpec, placement: Placement) -> Result<OrganismId, Error> {
        let spawn = || self.spawn_blueprint(spec.blueprint()?, placement.clone());
        let id = with_default_float_environment(spawn)?;
        self.changed(|| WorldChange::Spawn(Box::new((spec.clone(), placement))));
        Ok(id)
    }

    /// Puts an instance of a custom template into the world.
    ///
    /// # Errors
    /// As for [`World::spawn`], and when the template is not one of this world's.
    pub fn spawn_template(&mut self, template: TemplateId, placement: Placement) -> Result<OrganismId, Error> {
        let known = self.templates.get(template.0 as usize).cloned();
        let known = known.ok_or_else(|| Error::new(ErrorKind::Stale, "template"))?;
        let spawn = || self.spawn_blueprint(Blueprint::custom(template, known), placement.clone());
        let id = with_default_float_environment(spawn)?;
        self.changed(|| WorldChange::SpawnTemplate(template.0, Box::new(placement)));
        Ok(id)
    }

    /// Removes an organism. Prey that it holds is released and returns to its full size.
    ///
    /// # Errors
    /// When the handle is stale.
    pub fn remove(&mut self, id: OrganismId) -> Result<(), Error> {
        self.organism_or_stale(id, "organism")?;
        with_default_float_environment(|| self.release_meals(id));
        self.wake_up_touching(id);
        let Some(organism) = self.organisms.remove(id) else { return Ok(()) };
        self.exemptions.forget(id.index);
        if let Some(fluid) = organism.fluid {
            let fluid = &mut self.fluids[fluid as usize];
            fluid.particles.retain(|i| self.particles.owner[*i as usize] != id.index);
        }
        match organism.body {
            Storage::Lane { block, first } => self.empty_lane(block, first),
            Storage::Loose { particles, .. } => particles.into_iter().for_each(|i| self.particles.remove(i)),
        }
        organism.fluid_particles.into_iter().for_each(|i| self.particles.remove(i));
        self.changed(|| WorldChange::Remove(id));
        Ok(())
    }

    /// Puts what a blueprint says into the world.
    pub(super) fn spawn_blueprint(&mut self, blueprint: Blueprint, placement: Placement) -> Result<OrganismId, Error> {
        self.check_spawn(&blueprint, &placement)?;
        let scale = blueprint.scale * placement.scale;
        let id = self.organisms.next_id();
        let planned = plan_particles(&blueprint, &placement, scale, id.index);
        let nodes = blueprint.template.as_ref().map_or(0, |template| template.nodes().len());
        let ring = &planned[..if blueprint.rim.is_some() { nodes } else { 0 }];
        self.check_place(&planned, ring, if has_outline(&blueprint) { TOUCHING } else { placement.overlap })?;
        self.note_place(id.index, bounds_of(discs(&planned)));

        let (body_plan, fluid_plan) = planned.split_at(nodes);
        let (body, outline, slots) = match blueprint.template {
            Some(template) if blueprint.rim.is_none() => {
                let outline = template.outline().to_vec();
                (self.add_to_block(template, id.index, scale, body_plan), outline, nodes as u32)
            }
            _ => {
                let (body, outline) = self.add_loose(body_plan, blueprint.rim);
                (body, outline, 0)
            }
        };
        let (fluid, fluid_particles) = self.add_fluid(blueprint.fluid, fluid_plan);
        let seed = self.config.seed;
        let organism = Organism {
            kind: blueprint.kind,
            body,
            slots,
            locomotion: blueprint.locomotion.begun(Rng::new(seed, id.crawl_stream()), outline.len()),
            outline,
            fluid,
            fluid_particles,
            speed: blueprint.speed,
            controller: placement.controller,
            rng: Rng::new(seed, id.stream()),
            spawn_area: blueprint.area * placement.scale * placement.scale,
            spawn_scale: scale,
            full_scale: 1.0,
            engulfer: blueprint.engulfer.map(Engulfer::new),
            prey: blueprint.prey.map(|class| Prey { class, held_by: None }),
            phagosomes: Vec::new(),
            divider: blueprint.divider.map(Divider::new),
            exchanges: Vec::new(),
            goal: None,
            relative_speed: 1.0,
            progress: Progress::default(),
            home: placement.at,
            is_quarantined: false,
            gravity_scale: 1.0,
            linear_damping: placement.linear_damping,
            angular_damping: placement.angular_damping,
            user_data: [0; 2],
        };
        Ok(self.organisms.insert(organism))
    }

    /// Checks all of a blueprint and its placement but for what is there already.
    fn check_spawn(&self, blueprint: &Blueprint, placement: &Placement) -> Result<(), Error> {
        placement.validate()?;
        self.config.check_damping("linear_damping", placement.linear_damping)?;
        self.config.check_damping("angular_damping", placement.angular_damping)?;
        self.check_substeps(blueprint)?;
        self.check_periodic_placement(blueprint, placement)?;
        self.check_kicks(blueprint, placement.scale, placement.linear_damping)?;
        self.check_controller(&placement.controller, &blueprint.locomotion, blueprint.speed, has_outline(blueprint))?;
        check_fluid(blueprint, placement)?;
        let asked = self.particles.live_count() as u64 + blueprint.particle_count() as u64;
        let limit = u64::from(self.config.max_particles);
        if asked > limit {
            return Err(Error::new(ErrorKind::TooMany { asked, limit }, "particles"));
        }
        Ok(())
    }

    /// Checks that planned discs lie inside the walls and overlap nothing, organisms without an outline by at most a share, and
    /// that the ring of their membrane, if they have one, holds nothing.
    fn check_place(&mut self, planned: &[Particle], ring: &[Particle], share: f32) -> Result<(), Error> {
        let size = self.config.size;
        let colliding = |p: &&Particle| p.groups.memberships != 0;
        let may_reach = self.may_reach_over(planned);
        for p in planned {
            let (low, high) = (Vec2::splat(p.radius), size - p.radius);
            let is_inside = (p.position().cmpge(low) & p.position().cmple(high) | may_reach).all();
            if !is_inside {
                let accepted = format!("everything within 0 to {} by 0 to {}", size.x, size.y);
                return Err(Error::new(ErrorKind::OutsideWorld { accepted }, "at"));
            }
        }
        if let Some(with) = self.overlap(&planned.iter().filter(colliding).copied().collect::<Vec<_>>(), ring, share) {
            return Err(Error::new(ErrorKind::Overlap { with }, "at"));
        }
        Ok(())
    }

    /// Describes an obstacle or organism that overlaps the discs, if there is one.
    fn overlap(&mut self, planned: &[Particle], ring: &[Particle], share: f32) -> Option<String> {
        if planned.is_empty() {
            return None;
        }
        let outline: Vec<Vec2> = ring.iter().map(Particle::position).collect();
        let groups = ring.first().map_or(CollisionGroups::NONE, |node| node.groups);
        self.first_hit(planned, |world, organism, planned, bounds| {
            world.touches(organism, planned, bounds, share)
                || world.encloses(organism, planned)
                || world.is_enclosed(organism, &outline, groups)
        })
    }

    /// Describes an organism that a new obstacle would overlap, if there is one.
    pub(super) fn overlapped_by(&self, obstacle: &Obstacle) -> Option<String> {
        let (hit, _) = self.organisms.iter().find(|(_, organism)| self.is_in_obstacle(organism, obstacle))?;
        self.with_its_place(hit)
    }

    pub(super) fn with_its_place(&self, id: OrganismId) -> Option<String> {
        let organism = self.view().organism(id)?;
        let (centre, name) = (organism.centroid(), organism.template_name().unwrap_or(organism.kind().name()));
        Some(format!("the {name} at [{:.1}, {:.1}]", centre.x, centre.y))
    }

    /// Whether an organism has one of the discs inside its membrane, which would hold it in.
    pub(super) fn encloses(&self, organism: &Organism, discs: &[Particle]) -> bool {
        let Some(&node) = organism.outline.first().filter(|_| organism.body.membrane().is_some()) else { return false };
        let groups = self.particles.groups[organism.body.particle(node) as usize];
        let outline = self.outline_of(organism);
        let bounds = bounds_of(outline.iter().map(|&at| (at, 0.0)));
        let is_inside = |at: Vec2| bounds.contains_local_point(at) && contains_point(&outline, at);
        discs.iter().any(|disc| disc.groups.meets(groups) && is_inside(disc.position()))
    }

    /// Whether a membrane along an outline would hold a part of an organism in.
    fn is_enclosed(&self, organism: &Organism, outline: &[Vec2], groups: CollisionGroups) -> bool {
        let p = &self.particles;
        let is_inside = |i: usize| p.groups[i].meets(groups) && contains_point(outline, p.position(i));
        !outline.is_empty() && organism.particles().any(|i| is_inside(i as usize))
    }

    pub(super) fn touches(&self, organism: &Organism, discs: &[Particle], bounds: &Aabb, share: f32) -> bool {
        let p = &self.particles;
        let share = if organism.outline.is_empty() { share } else { TOUCHING };
        organism.particles().map(|i| i as usize).any(|i| {
            let near = bounds.loosened(p.radius[i]);
            near.contains_local_point(p.position(i))
                && discs.iter().any(|disc| {
                    let least = (disc.radius + p.radius[i]) * (1.0 - share);
                    disc.groups.meets(p.groups[i]) && (disc.position() - p.position(i)).length_squared() < least * least
                })
        })
    }

    /// Takes a body out of its lane.
    pub(super) fn empty_lane(&mut self, block: u32, first: u32) {
        let index = block as usize;
        let block = &mut self.blocks[index];
        self.scratch.vacancies.add(block, index);
        block.owner[(first - block.base) as usize] = NO_OWNER;
        (0..block.slots).for_each(|slot| self.particles.clear_entry(first as usize + slot as usize * LANES));
    }

    /// Puts a body into a lane of a block of its template.
    pub(super) fn add_to_block(&mut self, template: Template, owner: u32, scale: f32, planned: &[Particle]) -> Storage {
        let slots = template.nodes().len();
        let at_rest: Vec<[f32; LANES]> = template.rest_state().into_iter().map(|rest| [rest; LANES]).collect();
        let template = self.template_index(template);
        let Self { blocks, particles, scratch, .. } = self;
        let vacancies = &mut scratch.vacancies;
        let index = vacancies.find(Vacancy::Lane(template), blocks);
        let index = index.or_else(|| vacancies.find(Vacancy::Block(slots as u32), blocks)).unwrap_or_else(|| {
            blocks.push(Block::new(template, slots, particles));
            blocks.len() - 1
        });
        let block = &mut blocks[index];
        if block.template != template || block.length_state.len() != at_rest.len() {
            block.length_state.clone_from(&at_rest);
        }
        block.template = template;
        vacancies.add(block, index);
        let lane = block.free_lane().unwrap_or(0);
        block.owner[lane] = owner;
        block.scale[lane] = scale;
        for (row, rest) in block.length_state.iter_mut().zip(&at_rest) {
            row[lane] = rest[lane];
        }
        self.sleep.wake_up(index as u32, lane);
        for (slot, particle) in (0u32..).zip(planned) {
            self.particles.set(block.particle(slot, lane) as usize, particle);
        }
        Storage::Lane { block: index as u32, first: block.particle(0, lane) }
    }

    /// Adds the nodes of a membrane (or none) as loose particles; the nodes are its outline.
    fn add_loose(&mut self, planned: &[Particle], rim: Option<f32>) -> (Storage, Vec<u32>) {
        let particles: Vec<u32> = planned.iter().map(|particle| self.particles.insert(particle)).collect();
        let membrane = planned.first().zip(rim).map(|(node, rim)| {
            let count = planned.len();
            let length = |k: usize| (planned[(k + 1) % count].offset - planned[k].offset).length();
            Membrane::new((0..count).map(length).sum::<f32>() / count as f32, node.radius, rim, count)
        });
        self.particles.link_ring(&particles);
        (Storage::Loose { particles: particles.clone(), membrane }, particles)
    }

    /// Adds an organism's fluid to the fluid that it mixes with, or to one of its own.
    fn add_fluid(&mut self, plan: Option<FluidPlan>, planned: &[Particle]) -> (Option<u32>, Vec<u32>) {
        let Some(plan) = plan else {
            return (None, Vec::new());
        };
        let index = self.fluid_for(plan.params, plan.is_enclosed);
        let in_fluid = |particle: &Particle| Particle { fluid: index as u32 + 1, ..*particle };
        let particles: Vec<u32> = planned.iter().map(|p| self.particles.insert(&in_fluid(p))).collect();
        self.fluids[index].particles.extend(&particles);
        (Some(index as u32), particles)
    }

    /// The fluid that new particles mix with, or an empty one of their own.
    pub(super) fn fluid_for(&mut self, params: FluidParams, is_enclosed: bool) -> usize {
        let mixes = |fluid: &Fluid| {
            let is_same = !is_enclosed && fluid.params == params && !fluid.is_enclosed;
            is_same || fluid.particles.is_empty()
        };
        let index = self.fluids.iter().position(mixes).unwrap_or(self.fluids.len());
        if index == self.fluids.len() {
            self.fluids.push(Fluid::new(params, is_enclosed));
        } else if self.fluids[index].particles.is_empty() {
            self.fluids[index] = Fluid::new(params, is_enclosed);
        }
        index
    }
}

impl Blueprint {
    /// Of a template of the embedder's own.
    pub(super) fn custom(id: TemplateId, template: Template) -> Self {
        let outline: Vec<Vec2> =
            template.outline().iter().map(|&slot| template.nodes()[slot as usize].position).collect();
        let area = crate::geometry::polygon::signed_area(&outline);
        let (locomotion, speed) = match template.propulsion() {
            Some(Propulsion { speed, max_acceleration }) => (Locomotion::Propel { max_acceleration }, speed),
            None => (Locomotion::None, 0.0),
        };
        let divider = template.cut().map(|_| DivisionParams::default());
        Self { template: Some(template), locomotion, speed, divider, ..Self::of(Kind::Custom(id), area) }
    }
}

/// The particles of a blueprint in the world: nodes first, then fluid.
fn plan_particles(blueprint: &Blueprint, placement: &Placement, scale: f32, owner: u32) -> Vec<Particle> {
    let nodes = blueprint.template.iter().flat_map(Template::nodes);
    // The centre of a body may lie far from the room.
    let origin = placement.at.clamp(Vec2::splat(-WorldConfig::MAX_SIZE), Vec2::splat(WorldConfig::MAX_SIZE)).round();
    let body = nodes.map(|node: &Node| Particle {
        origin,
        offset: placement.place(node.position, scale, origin),
        velocity: Vec2::ZERO,
        inv_mass: 1.0 / (node.mass * blueprint.mass),
        radius: node.radius * scale,
        groups: node.groups.and(placement.groups),
        material: node.material,
        role: node.role as u8,
        owner,
        fluid: 0,
    });
    let fluid = blueprint.fluid.iter().flat_map(|plan| {
        plan.points.iter().map(|&point| Particle {
            origin,
            offset: placement.place(point, placement.scale, origin),
            velocity: Vec2::ZERO,
            inv_mass: 1.0 / plan.params.particle_mass,
            radius: 0.5 * plan.params.spacing,
            groups: CollisionGroups::ALL,
            material: Material { friction: plan.params.surface_friction(), restitution: 0.0 },
            role: if plan.is_enclosed { Role::Cytoplasm } else { Role::Fluid } as u8,
            owner,
            fluid: 0,
        })
    });
    body.chain(fluid).collect()
}

fn has_outline(blueprint: &Blueprint) -> bool {
    blueprint.template.as_ref().is_some_and(|template| !template.outline().is_empty())
}

/// Checks that what is fluid has the size of its spec and meets everybody.
fn check_fluid(blueprint: &Blueprint, placement: &Placement) -> Result<(), Error> {
    if blueprint.fluid.is_some() && placement.scale != 1.0 {
        return Err(Error::unsupported("scale", "1 for what holds fluid: its spec has the size"));
    }
    if blueprint.holds_fluid() && placement.groups != CollisionGroups::ALL {
        return Err(Error::unsupported("groups", "all groups for what has a membrane or is fluid"));
    }
    Ok(())
}
