//! Calls for joints, force fields, emitters, drains and settings.

use super::{Outcome, Sequence};
use microsim_core::glam::Vec2;
use microsim_core::{
    AccelerationGrid, CollisionGroups, ContactReporting, Drain, Emitter, Error, FieldKind, ForceField, JointEnd,
    JointKind, JointSpec, Kind, OrganismId, Recipe, Region,
};

impl Sequence<'_> {
    fn joint_end(&mut self, id: OrganismId) -> JointEnd {
        match self.choices.below(3) {
            0 => JointEnd::Centre(id),
            1 => {
                let (at, obstacle) = (self.place(), self.obstacles.last().filter(|_| id.index() % 2 == 1));
                obstacle.map_or(JointEnd::Point(at), |&obstacle| JointEnd::Obstacle { obstacle, at })
            }
            _ => JointEnd::Node { organism: id, node: self.choices.below(60) as u32 },
        }
    }

    fn joint(&mut self, a: OrganismId, b: OrganismId) -> JointSpec {
        let (a, b, c) = (self.joint_end(a), self.joint_end(b), &mut self.choices);
        let (length, max_force) = (c.number(0.0, 20.0), c.number(0.0, 1000.0));
        let (frequency, damping_ratio) = (c.number(0.1, 20.0), c.number(0.0, 2.0));
        let kind = match c.below(8) {
            0 => JointKind::Pin,
            1 => JointKind::Distance { length },
            2 => JointKind::Rope { max_length: length },
            3 => JointKind::Spring { length, frequency, damping_ratio },
            4 => JointKind::Mouse { frequency, damping_ratio, max_force },
            5 => JointKind::LengthMotor { length, max_force },
            6 => JointKind::SpeedMotor { speed: c.number(-30.0, 30.0), max_force },
            _ => JointKind::Weld,
        };
        let spec = JointSpec::new(a, b, kind);
        if c.flag() { spec.breaking_at(c.number(0.0, 1000.0)) } else { spec }
    }

    pub(super) fn change_joint(&mut self, a: OrganismId, b: OrganismId) -> Outcome {
        let (spec, count) = (self.joint(a, b), self.joints.len());
        match self.choices.below(4) {
            0 if count > 0 => self.world.remove_joint(self.joints[self.choices.below(count)]),
            1 if count > 0 => self.world.set_joint(self.joints[self.choices.below(count)], spec),
            _ => self.world.add_joint(spec).map(|joint| self.joints.push(joint)),
        }
    }

    fn region(&mut self, centre: Vec2) -> Region {
        match self.choices.below(3) {
            0 => Region::All,
            1 => Region::Circle { centre, radius: self.choices.number(0.0, 40.0) },
            _ => Region::Box { low: self.place(), high: centre },
        }
    }

    fn recipe(&mut self) -> Recipe {
        let template = self.templates.last().copied().filter(|_| self.choices.flag());
        template.map_or_else(|| Recipe::Organism(self.choices.spec()), Recipe::Template)
    }

    pub(super) fn change_emitter(&mut self) -> Outcome {
        let (centre, count) = (self.place(), self.emitters.len());
        let recipe = self.recipe();
        let emitter = Emitter {
            velocity: self.vector(30.0),
            angle: self.choices.flag().then_some(1.0),
            ..Emitter::new(self.region(centre), recipe, self.choices.number(0.0, 50.0))
        };
        match self.choices.below(4) {
            0 if count > 0 => self.world.remove_emitter(self.emitters[self.choices.below(count)]),
            1 if count > 0 => self.world.set_emitter(self.emitters[self.choices.below(count)], emitter),
            _ => self.world.add_emitter(emitter).map(|emitter| self.emitters.push(emitter)),
        }
    }

    pub(super) fn change_drain(&mut self) -> Outcome {
        let (centre, count) = (self.place(), self.drains.len());
        let kind = [None, Some(Kind::Coccus), Some(Kind::FluidBlock), Some(Kind::AmoeboidCell)][self.choices.below(4)];
        let drain = Drain { region: self.region(centre), kind };
        match self.choices.below(4) {
            0 if count > 0 => self.world.remove_drain(self.drains[self.choices.below(count)]),
            1 if count > 0 => self.world.set_drain(self.drains[self.choices.below(count)], drain),
            _ => self.world.add_drain(drain).map(|drain| self.drains.push(drain)),
        }
    }

    fn grid(&mut self, high: Vec2) -> Result<AccelerationGrid, Error> {
        let (low, count) = (self.place(), [1, 2, 3, 5].map(|least| least + u32::from(self.choices.flag())));
        let size = [count[self.choices.below(4)], count[self.choices.below(4)]];
        let (one, other) = (self.vector(100.0), self.vector(10.0));
        AccelerationGrid::sampled(low, high, size, |at| one + other.perp() * (0.1 * (at.x - at.y)))
    }

    pub(super) fn change_field(&mut self) -> Outcome {
        let (centre, acceleration, count) = (self.place(), self.choices.number(-200.0, 200.0), self.fields.len());
        let kind = match self.choices.below(5) {
            4 => FieldKind::Grid(self.grid(centre)?),
            3 => FieldKind::Thermal { mobility: self.choices.number(0.0, 20.0) },
            0 => FieldKind::Uniform { acceleration: self.vector(100.0) },
            1 => FieldKind::Radial { centre, acceleration },
            _ => FieldKind::Vortex { centre, acceleration },
        };
        let region = self.region(centre);
        let field = ForceField { region, kind };
        match self.choices.below(4) {
            0 if count > 0 => self.world.remove_field(self.fields[self.choices.below(count)]),
            1 if count > 0 => self.world.set_field(self.fields[self.choices.below(count)], field),
            _ => self.world.add_field(field).map(|field| self.fields.push(field)),
        }
    }

    pub(super) fn set_size(&mut self) -> Outcome {
        let Vec2 { x, y } = self.world.config().size;
        let size = Vec2::new(self.choices.number(0.8 * x, 1.2 * x), self.choices.number(0.8 * y, 1.2 * y));
        self.world.set_size(if size.max_element() > 300.0 { size.min(Vec2::splat(300.0)) } else { size })
    }

    pub(super) fn damp(&mut self, id: OrganismId) -> Outcome {
        let damping = self.choices.number(0.0, 12.0);
        if self.choices.flag() {
            self.world.set_linear_damping(id, damping)
        } else {
            self.world.set_angular_damping(id, damping)
        }
    }

    pub(super) fn change_setting(&mut self, id: OrganismId) -> Outcome {
        let groups = CollisionGroups { memberships: self.choices.byte().into(), filter: self.choices.byte().into() };
        let gravity = self.vector(30.0);
        match self.choices.below(13) {
            0 => self.world.set_gravity(gravity),
            6 => self.world.set_scale(id, self.choices.number(0.7, 1.5)),
            7 => {
                let (recipe, placement) = (self.recipe(), self.choices.placement(self.world.config().size));
                self.world.replace(id, &recipe, placement).map(|new| self.handles.push(new))
            }
            8 => self.world.set_speed(id, self.choices.number(0.0, 30.0)),
            9 => self.world.set_phagocytosis(id, self.choices.amoeboid_cell().phagocytosis),
            10 => {
                let hit_speed = self.choices.flag().then(|| self.choices.number(0.0, 20.0));
                let reporting = self.choices.flag().then_some(ContactReporting { hit_speed });
                self.world.set_contact_reporting(reporting)
            }
            12 => self.world.set_mass(id, self.choices.number(0.0, 100.0)),
            11 => self.world.shrink(id, self.choices.byte().into()),
            1 => self.world.set_damping(self.choices.number(0.0, 3.0)),
            2 => self.world.set_max_speed(self.choices.number(5.0, 30.0)),
            3 => self.world.set_gravity_scale(id, self.choices.number(-2.0, 3.0)),
            4 => self.world.set_collision_groups(id, groups),
            _ => self.world.set_user_data(id, u128::from(self.choices.byte()) << 90),
        }
    }
}
