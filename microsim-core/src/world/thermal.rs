//! The kicks of molecules: Brownian motion of the bodies in thermal fields.

use super::World;
use crate::config::WorldConfig;
use crate::error::{Error, out_of_range};
use crate::force_field::{FieldKind, ForceField};
use crate::id::FieldId;
use crate::organism::{Blueprint, Organism, Storage};
use crate::particle::mass_properties::MassProperties;
use crate::rng::Rng;
use crate::solver::constraint::Constraint;
use crate::template::Template;
use glam::Vec2;
use std::f32::consts::PI;

/// Odd factor that spreads the number of a step over 64 bits.
const SCRAMBLE: u64 = 0x9e37_79b9_7f4a_7c15;
/// Least speed limit, in standard deviations of a body's speed along an axis: it takes 0.4 % of the diffusion away at most, 6 % at 3.
const SPEED_LIMIT: f32 = 4.0;

impl World {
    /// Kicks the bodies in thermal fields, once per step. A kick `v` moves a body by `v (1 + g h) / g` in all, with a damping of
    /// `g`, its own included, and substeps of `h`; its variance is such that the kicks of a second add up to `2 D` along each axis.
    pub(crate) fn kick_bodies(&mut self) {
        if !self.fields.iter().any(|(_, field)| matches!(field.kind, FieldKind::Thermal { .. })) {
            return;
        }
        let period = self.period();
        let Self { config, fields, organisms, particles, sleep, step_index, .. } = self;
        let step = *step_index + 1;
        for (id, organism) in organisms.iter() {
            let sleeps = matches!(organism.body, Storage::Lane { block, .. } if sleep.is_asleep(block));
            if sleeps || organism.slots == 0 || organism.goal.is_some() || organism.is_held() || organism.is_quarantined
            {
                continue;
            }
            let list: Vec<u32> = organism.particles().collect();
            let Some(body) = MassProperties::of(particles, &list) else { continue };
            let at = body.position(particles);
            let at = at + period.into_room(at);
            let mobility: f32 = fields.iter().map(|(_, field)| field.mobility_at(at)).sum();
            let radius = (organism.full_area().abs() / PI).sqrt();
            if mobility <= 0.0 || radius <= 0.0 {
                continue;
            }
            let root = (mobility / radius).sqrt();
            let [kick, spin] =
                [organism.linear_damping, organism.angular_damping].map(|own| kick_per_root(config, own) * root);
            let mut rng = kicks(config.seed, step, id.thermal_stream());
            let velocity = Vec2::new(rng.normal(), rng.normal()) * kick;
            let turn = 0.75_f32.sqrt() * spin * rng.normal() / radius;
            for i in list.into_iter().map(|i| i as usize).filter(|&i| particles.inv_mass[i] > 0.0) {
                let change = velocity + body.arm(particles, i).perp() * turn;
                particles.vx[i] += change.x;
                particles.vy[i] += change.y;
            }
        }
    }

    /// Mobility by all thermal fields at a point.
    pub(super) fn mobility_at(&self, point: Vec2) -> f32 {
        self.fields.iter().map(|(_, field)| field.mobility_at(point)).sum()
    }

    /// Checks that the speed limit leaves a body of a blueprint, at a scale and with a damping of its own, the kicks of the hottest
    /// place.
    pub(super) fn check_kicks(&self, blueprint: &Blueprint, scale: f32, own: f32) -> Result<(), Error> {
        let is_kicked = blueprint.template.is_some() && blueprint.rim.is_none();
        let area = if is_kicked { blueprint.area * (scale * scale) } else { 0.0 };
        check_drag(blueprint.template.as_ref(), self.most_mobile())?;
        check(area, own, self.most_mobile(), &self.config)
    }

    /// The same of an organism at a scale relative to its size when spawned.
    pub(super) fn check_kicks_at_scale(&self, organism: &Organism, scale: f32) -> Result<(), Error> {
        let area = organism.spawn_area * (scale * scale);
        check(area, organism.linear_damping, self.most_mobile(), &self.config)
    }

    /// The same of an organism with another damping of its own.
    pub(super) fn check_kicks_at_damping(&self, organism: &Organism, own: f32) -> Result<(), Error> {
        let area = if organism.slots > 0 { organism.full_area() } else { 0.0 };
        check(area, own, self.most_mobile(), &self.config)
    }

    /// The same of all bodies with other settings.
    pub(super) fn check_all_kicks(&self, config: &WorldConfig) -> Result<(), Error> {
        self.check_bodies(self.most_mobile(), config)
    }

    /// The same with one more field, or one in the place of another.
    pub(super) fn check_field(&self, old: Option<FieldId>, new: &ForceField) -> Result<(), Error> {
        let others = self.fields().filter(|(id, _)| Some(*id) != old).map(|(_, field)| field);
        let mobility = most_mobile(others.chain([new]));
        self.check_bodies(mobility, &self.config).map_err(|error| error.within("kind"))
    }

    fn most_mobile(&self) -> f32 {
        most_mobile(self.fields.iter().map(|(_, field)| &**field))
    }

    fn check_bodies(&self, mobility: f32, config: &WorldConfig) -> Result<(), Error> {
        let mut bodies = self.organisms.iter().filter(|(_, organism)| organism.slots > 0);
        bodies.try_for_each(|(_, organism)| {
            check_drag(self.template_of(organism), mobility)?;
            check(organism.full_area(), organism.linear_damping, mobility, config)
        })?;
        let emitted = self.emitters.iter().filter_map(|(_, record)| self.blueprint_of(&record.emitter.recipe).ok());
        let mut emitted = emitted.filter(|blueprint| blueprint.template.is_some() && blueprint.rim.is_none());
        emitted.try_for_each(|blueprint| {
            check_drag(blueprint.template.as_ref(), mobility)?;
            check(blueprint.area, 0.0, mobility, config)
        })
    }
}

/// Random numbers of the kicks of a body in a step. A generator's first numbers for seeds in arithmetic progression hang together, so
/// that kicks would not be independent: every bit of its seed depends on all bits of the step (the end of SplitMix64: Steele, Lea and
/// Flood 2014, "Fast Splittable Pseudorandom Number Generators").
fn kicks(seed: u64, step: u64, stream: u64) -> Rng {
    let bits = seed ^ step.wrapping_mul(SCRAMBLE);
    let bits = (bits ^ (bits >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let bits = (bits ^ (bits >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    Rng::new(bits ^ (bits >> 31), stream)
}

/// Largest mobility anywhere, by fields that may lie over each other.
fn most_mobile<'a>(fields: impl Iterator<Item = &'a ForceField>) -> f32 {
    let mobility = |field: &ForceField| if let FieldKind::Thermal { mobility } = field.kind { mobility } else { 0.0 };
    let thermal: Vec<&ForceField> = fields.filter(|field| mobility(field) > 0.0).collect();
    let sums = thermal.iter().map(|one| {
        let over = thermal.iter().filter(|other| other.region.may_meet(&one.region));
        over.map(|other| mobility(other)).sum::<f32>()
    });
    sums.fold(0.0, |most, sum| if sum > most { sum } else { most })
}

/// Checks that the links of a body have no drag, which would take from the kicks more than they know of.
fn check_drag(template: Option<&Template>, mobility: f32) -> Result<(), Error> {
    let has_drag =
        |template: &Template| template.constraints().iter().any(|link| matches!(link, Constraint::LinkDrag(_)));
    if mobility > 0.0 && template.is_some_and(has_drag) {
        return Err(Error::unsupported("template", "one without drag of links, in a world with a thermal field"));
    }
    Ok(())
}

/// Checks that a body of this area and with this damping of its own is not kicked beyond the speed limit.
fn check(area: f32, own: f32, mobility: f32, config: &WorldConfig) -> Result<(), Error> {
    let radius = (area.abs() / PI).sqrt();
    let slowest = SPEED_LIMIT * speed_by_kicks(config, own);
    if mobility <= 0.0 || radius <= 0.0 || slowest <= 0.0 {
        return Ok(());
    }
    let root = config.speed_limit() / slowest;
    let most = radius * (root * root);
    let accepted = || {
        let (damping, max_speed) = (damping(config, own), config.max_speed);
        format!(
            "0 to {most:.3} in all with a body of radius {radius:.3}, a `damping` of {damping} and a `max_speed` of {max_speed}"
        )
    };
    (mobility <= most).then_some(()).ok_or_else(|| out_of_range("mobility", mobility.into(), accepted()))
}

/// Standard deviation along an axis of the velocity after a kick, units/s, of a body with a diffusion coefficient of 1: `sqrt(g)`
/// in short steps.
fn speed_by_kicks(config: &WorldConfig, own: f32) -> f32 {
    let loss = damping(config, own) * config.substep();
    if loss <= 0.0 {
        return 0.0;
    }
    let lost = (0..2 * config.substeps).fold(0.0, |lost, _| (lost + loss) / (1.0 + loss));
    kick_per_root(config, own) / f32::sqrt(lost)
}

/// Damping of a body by the medium and by its own, 1/s: its own comes first in each substep.
fn damping(config: &WorldConfig, own: f32) -> f32 {
    let g = config.damping;
    g + own + g * own * config.substep()
}

/// Standard deviation of a kick along an axis over the root of the diffusion coefficient.
fn kick_per_root(config: &WorldConfig, own: f32) -> f32 {
    damping(config, own) * (2.0 * config.dt).sqrt() / (1.0 + config.damping * config.substep())
}

#[cfg(test)]
mod tests {
    use crate::{
        AgarSpec, CollisionGroups, Emitter, FieldKind, ForceField, Inputs, Node, OrganismId, OrganismSpec, Placement,
        RedCellSpec, Region, Template, World, WorldConfig,
    };
    use glam::Vec2;

    /// Many balls far from each other, with damping of their own, in a warm room.
    fn warm_damped(mobility: f32, damping: f32, own: [f32; 2]) -> (World, Vec<OrganismId>) {
        let size = Vec2::splat(400.0);
        let mut world = World::new(WorldConfig { size, damping, ..WorldConfig::default() }).unwrap();
        let kind = FieldKind::Thermal { mobility };
        world.add_field(ForceField { region: Region::All, kind }).unwrap();
        let place = |k: u32| Placement::at(20.0 + 9.0 * (k % 40) as f32, 20.0 + 9.0 * (k / 40) as f32);
        let ball = AgarSpec { radius: 0.5, ..AgarSpec::default() };
        let spawn = |k| world.spawn(&ball.clone().into(), place(k).damped(own[0], own[1])).unwrap();
        let balls = (0..1500).map(spawn).collect();
        (world, balls)
    }

    fn warm(mobility: f32, damping: f32) -> (World, Vec<OrganismId>) {
        warm_damped(mobility, damping, [0.0; 2])
    }

    /// Mean squared displacement after so many seconds over that of an Ornstein-Uhlenbeck walk from rest with a drag of 4 1/s, of balls
    /// with a radius of 0.5: 4 D (t - (3 - 4 e + e^2) / 2 g) with e = exp(-g t).
    fn spread(world: &mut World, balls: &[OrganismId], mobility: f32, time: f32) -> f32 {
        let start: Vec<Vec2> = balls.iter().map(|&id| world.centroid(id).unwrap()).collect();
        (0..(60.0 * time) as u32).for_each(|_| world.step(&Inputs::new()));
        let squares = balls.iter().zip(&start).map(|(&id, &at)| (world.centroid(id).unwrap() - at).length_squared());
        squares.sum::<f32>() / balls.len() as f32 / (4.0 * (mobility / 0.5) * (time - 1.5 / 4.0))
    }

    #[test]
    fn bodies_diffuse_by_their_radius_once_drag_has_acted_of_the_medium_or_their_own() {
        for (damping, own) in [(4.0, [0.0, 0.0]), (0.0, [4.0, 6.0])] {
            let (mut world, balls) = warm_damped(0.1, damping, own);
            let spread = spread(&mut world, &balls, 0.1, 6.0);
            assert!((spread - 1.0).abs() < 0.06, "{damping}, {own:?}: {spread} of what it should be");
        }
    }

    /// Mobility of what has a standard deviation of its speed of a quarter of the limit, 20 units/s: `D g = 25` with a radius of 0.5.
    fn most_mobile(damping: f32) -> f32 {
        0.5 * 25.0 / damping
    }

    #[test]
    fn what_the_speed_limit_accepts_diffuses_as_fast_as_it_should() {
        let damping = 4.0;
        let mobility = 0.93 * most_mobile(damping);
        let (mut world, balls) = warm(mobility, damping);
        balls.iter().for_each(|&ball| world.set_collision_groups(ball, CollisionGroups::NONE).unwrap());
        let spread = spread(&mut world, &balls, mobility, 2.0);
        assert!((spread - 1.0).abs() < 0.06, "{spread} of what it should be");
        let field = ForceField { region: Region::All, kind: FieldKind::Thermal { mobility: most_mobile(damping) } };
        let (id, _) = world.fields().next().unwrap();
        let refused = world.set_field(id, field).unwrap_err();
        assert_eq!(refused.field(), "kind.mobility");
        assert!(refused.to_string().contains("`kind.mobility` is 3.125, accepted: 0 to 2.963 in all"), "{refused}");
    }

    #[test]
    fn kicks_beyond_the_speed_limit_are_refused_wherever_they_come_from() {
        let (mut world, balls) = warm(0.9 * most_mobile(4.0), 4.0);
        let small = AgarSpec { radius: 0.4, ..AgarSpec::default() };
        let at = Placement::at(390.0, 390.0);
        assert_eq!(world.spawn(&small.clone().into(), at.clone()).unwrap_err().field(), "mobility");
        let emitter = Emitter::new(Region::All, OrganismSpec::from(small.clone()).into(), 1.0);
        assert_eq!(world.add_emitter(emitter).unwrap_err().field(), "mobility");
        assert_eq!(world.set_scale(balls[0], 0.5).unwrap_err().field(), "mobility");
        assert_eq!(world.set_damping(6.0).unwrap_err().field(), "mobility");
        assert_eq!(world.set_max_speed(15.0).unwrap_err().field(), "mobility");
        world.set_max_speed(30.0).unwrap();
        world.spawn(&small.into(), at).unwrap();
        world.validate().unwrap();
    }

    #[test]
    fn only_fields_that_lie_over_each_other_count_together() {
        let mut world = World::new(WorldConfig { damping: 4.0, ..WorldConfig::default() }).unwrap();
        world.spawn(&AgarSpec { radius: 0.5, ..AgarSpec::default() }.into(), Placement::at(30.0, 30.0)).unwrap();
        let field = |x: f32| {
            let [low, high] = [Vec2::new(x, 0.0), Vec2::new(x + 40.0, 90.0)];
            ForceField {
                region: Region::Box { low, high },
                kind: FieldKind::Thermal { mobility: 0.6 * most_mobile(4.0) },
            }
        };
        world.add_field(field(0.0)).unwrap();
        let other = world.add_field(field(50.0)).unwrap();
        assert_eq!(world.add_field(field(30.0)).unwrap_err().field(), "kind.mobility");
        assert_eq!(world.set_field(other, field(30.0)).unwrap_err().field(), "kind.mobility");
        world.set_field(other, field(60.0)).unwrap();
    }

    #[test]
    fn kicks_of_different_steps_are_independent() {
        for seed in [0, 3, 7, 9] {
            let mut total = 0.0;
            for body in 0..3000 {
                for window in 0..10 {
                    let sum = |sum: Vec2, step: u64| {
                        let mut rng = super::kicks(seed, 120 * window + step, body ^ (1 << 61));
                        sum + Vec2::new(rng.normal(), rng.normal())
                    };
                    total += f64::from((1..=120).fold(Vec2::ZERO, sum).length_squared());
                }
            }
            let variance = total / (30_000.0 * 240.0);
            assert!((variance - 1.0).abs() < 0.015, "seed {seed}: {variance}");
        }
    }

    #[test]
    fn kicks_hang_on_the_step_alone_and_nothing_without_drag_is_kicked() {
        let (mut world, balls) = warm(0.1, 0.0);
        let before = world.centroid(balls[0]);
        (0..30).for_each(|_| world.step(&Inputs::new()));
        assert_eq!(world.centroid(balls[0]), before);
        let mut cell = World::new(WorldConfig { damping: 3.0, ..WorldConfig::default() }).unwrap();
        cell.add_field(ForceField { region: Region::All, kind: FieldKind::Thermal { mobility: 0.2 } }).unwrap();
        let id = cell.spawn(&RedCellSpec::default().into(), Placement::at(40.0, 40.0)).unwrap();
        (0..120).for_each(|_| cell.step(&Inputs::new()));
        assert!(!cell.view().organism(id).unwrap().is_at_rest());
        let mut twin = cell.clone();
        (0..60).for_each(|_| [&mut cell, &mut twin].into_iter().for_each(|world| world.step(&Inputs::new())));
        assert_eq!(cell.digest(), twin.digest());
    }

    #[test]
    fn a_sleeper_around_a_thermal_region_is_not_kicked() {
        let mut builder = Template::builder();
        let [a, b] = [-4.0, 4.0].map(|x| builder.node(Node::disc(Vec2::new(x, 0.0), 1.0, 0.5)));
        // Wound clockwise, so that its area is negative.
        let c = builder.node(Node::disc(Vec2::new(0.0, 6.0), 1.0, 0.5));
        builder.link(a, b, 0.0).link(b, c, 0.0).link(c, a, 0.0).outline(&[a, c, b]);
        let template = builder.build().unwrap();
        let at_rest = |region: Region| {
            let mut world = World::new(WorldConfig { damping: 3.0, ..WorldConfig::default() }).unwrap();
            let template = world.add_template(template.clone());
            let body = world.spawn_template(template, Placement::at(40.0, 40.0)).unwrap();
            (0..120).for_each(|_| world.step(&Inputs::new()));
            world.add_field(ForceField { region, kind: FieldKind::Thermal { mobility: 5.0 } }).unwrap();
            (0..10).for_each(|_| world.step(&Inputs::new()));
            world.validate().unwrap();
            let body = world.view().organism(body).unwrap();
            (body.velocity() == Vec2::ZERO, body.is_quarantined())
        };
        let middle = Region::Circle { centre: Vec2::new(40.0, 42.0), radius: 0.5 };
        assert_eq!([middle, Region::All].map(at_rest), [(true, false), (false, false)]);
    }
}
