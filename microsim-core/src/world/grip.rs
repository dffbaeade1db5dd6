//! Grip of crawling cells where the slide gives none ([`Substrate::Surfaces`]): a cell pulls itself along what it touches, with a
//! finite force, and pulls other organisms the other way.

use super::World;
use super::contacts::NearPair;
use crate::collision::ObstacleContact;
use crate::config::Substrate;
use crate::id::OrganismId;
use crate::organism::Organism;
use crate::particle::mass_properties::MassProperties;
use crate::solver::drive::{Drive, Traction};
use glam::Vec2;

/// Gap that a node bridges, as a share of its radius: it is off what it crawls on for a moment now and then.
const BRIDGED_GAP: f32 = 0.25;
/// Time in which a cell as a whole reaches its speed, s: it bounds the force.
const GRIP_TIME: f32 = 0.1;
/// Length of the mean normal of what is touched above which a cell is touched from one side.
const ONE_SIDED: f32 = 0.3;

/// Where a node touches something that gives it a grip.
#[derive(Clone, Copy, Debug)]
struct Grip {
    /// Index of the organism.
    owner: u32,
    /// Unit vector to it.
    normal: Vec2,
    /// The organism that it touches; `None` for something fixed.
    on: Option<OrganismId>,
}

impl World {
    /// Takes the drives of crawling cells, which are among the first `count`, from those that act whatever a cell touches.
    pub(crate) fn part_with_crawls(&mut self, count: usize) {
        self.scratch.tractions.clear();
        if self.config.substrate == Substrate::Slide {
            return;
        }
        let drives = std::mem::take(&mut self.scratch.drives);
        let owner = |drive: &Drive| self.particles.owner[drive.particle as usize];
        for own in drives[..count].chunk_by(|a, b| owner(a) == owner(b)) {
            let organism = self.organisms.id_at(owner(&own[0])).and_then(|id| self.organisms.get(id));
            if organism.is_some_and(|organism| organism.locomotion.front().is_some()) {
                let traction = Traction { drives: own.to_vec(), along: None, on: Vec::new() };
                self.scratch.tractions.push(traction);
            } else {
                self.scratch.drives.extend(own);
            }
        }
        self.scratch.drives.extend(&drives[count..]);
    }

    /// Finds what crawling cells touch; those that touch nothing stop pulling.
    pub(crate) fn find_grips(&mut self) {
        if self.scratch.tractions.is_empty() {
            return;
        }
        let mut tractions = std::mem::take(&mut self.scratch.tractions);
        let owner = |traction: &Traction| self.particles.owner[traction.drives[0].particle as usize];
        let owners: Vec<u32> = tractions.iter().map(owner).collect();
        let mut grips: Vec<Grip> = self.grips_on_obstacles().chain(self.grips_on_organisms()).collect();
        grips.retain(|grip| owners.binary_search(&grip.owner).is_ok());
        grips.sort_by_key(|grip| (grip.owner, grip.on));
        let mut owners = owners.into_iter();
        tractions.retain_mut(|traction| {
            let owner = owners.next();
            let first = grips.partition_point(|grip| Some(grip.owner) < owner);
            let after = grips.partition_point(|grip| Some(grip.owner) <= owner);
            let held = grips.get(first..after).filter(|grips| !grips.is_empty());
            held.inspect(|grips| self.hold_on(traction, grips)).is_some()
        });
        self.scratch.tractions = tractions;
    }

    fn grips_on_obstacles(&self) -> impl Iterator<Item = Grip> + '_ {
        let p = &self.particles;
        let contacts = self.scratch.broad_phase.obstacle_contacts.iter();
        contacts.filter_map(|&ObstacleContact { particle, obstacle, .. }| {
            let (i, obstacle) = (particle as usize, &self.obstacles[obstacle as usize]);
            let (surface, is_inside) = obstacle.nearest(p.position(i));
            let way = p.position(i) - surface;
            let (way, is_near) =
                if is_inside { (-way, true) } else { (way, way.length() <= grip_distance(p.radius[i])) };
            let grips = is_near && p.fluid[i] == 0 && !(is_inside && obstacle.one_way.is_some());
            grips.then(|| Grip { owner: p.owner[i], normal: way.normalize_or_zero(), on: None })
        })
    }

    fn grips_on_organisms(&self) -> impl Iterator<Item = Grip> + '_ {
        let p = &self.particles;
        let touching = self.near_pairs().filter(|pair| {
            let [i, j] = [pair.i, pair.j].map(|i| i as usize);
            let least = if p.radius[i] < p.radius[j] { p.radius[i] } else { p.radius[j] };
            pair.gap <= BRIDGED_GAP * least && p.owner[i] != p.owner[j]
        });
        touching.flat_map(|NearPair { i, j, .. }| {
            [(i, j), (j, i)].into_iter().filter_map(|(own, other)| {
                // Fluid is no ground, neither that of others nor what a cell holds.
                let is_fluid = [own, other].iter().any(|&i| p.fluid[i as usize] != 0);
                let on = self.organisms.id_at(p.owner[other as usize]).filter(|_| !is_fluid)?;
                // What is inside a cell is no ground for it.
                let is_free = self.organisms.get(on).is_some_and(|other| !other.is_held());
                let normal = p.between(other as usize, own as usize).normalize_or_zero();
                is_free.then(|| Grip { owner: p.owner[own as usize], normal, on: Some(on) })
            })
        })
    }

    /// Bounds the force of a cell by what it touches: what is fixed takes any, organisms as much as their mass.
    fn hold_on(&self, traction: &mut Traction, grips: &[Grip]) {
        let mean = grips.iter().map(|grip| grip.normal).sum::<Vec2>() / grips.len() as f32;
        traction.along = (mean.length() > ONE_SIDED).then(|| mean.perp() / mean.length());
        let organism = self.organisms.id_at(grips[0].owner).and_then(|id| self.organisms.get(id));
        let driven: Vec<u32> = traction.drives.iter().map(|drive| drive.particle).collect();
        let (own, driven) = (self.mass_of(organism), MassProperties::of(&self.particles, &driven));
        let mut share = driven.map_or(0.0, |driven| own / driven.mass);
        if grips.iter().all(|grip| grip.on.is_some()) {
            let mut grounds: Vec<OrganismId> = grips.iter().filter_map(|grip| grip.on).collect();
            grounds.dedup();
            let grounds: Vec<&Organism> = grounds.into_iter().filter_map(|id| self.organisms.get(id)).collect();
            let ground = self.mass_of(grounds.iter().copied());
            share *= if ground > 0.0 { ground / (own + ground) } else { 1.0 };
            traction.on = grounds.into_iter().flat_map(Organism::particles).collect();
        }
        for drive in &mut traction.drives {
            let most = share * drive.velocity.length() / GRIP_TIME;
            drive.max_acceleration = if drive.max_acceleration < most { drive.max_acceleration } else { most };
        }
    }

    /// Mass of what can move of some organisms.
    fn mass_of<'a>(&self, organisms: impl IntoIterator<Item = &'a Organism>) -> f32 {
        let list: Vec<u32> = organisms.into_iter().flat_map(Organism::particles).collect();
        MassProperties::of(&self.particles, &list).map_or(0.0, |body| body.mass)
    }
}

/// Distance of a centre from a surface at which a disc still grips it.
fn grip_distance(radius: f32) -> f32 {
    radius * (1.0 + BRIDGED_GAP)
}
