//! Rooms with periodic sides: what cannot be in them, and how what goes out on one side comes in on the other.

use super::World;
use super::occupancy::is_blocked;
use crate::capability::controller::Controller;
use crate::collision::obstacle::Obstacle;
use crate::collision::obstacle_path::extent;
use crate::error::{Error, out_of_range};
use crate::geometry::period::Period;
use crate::id::OrganismId;
use crate::joint::{JointKind, JointSpec};
use crate::organism::{Blueprint, Organism, Placement};
use crate::particle::Particle;
use crate::solver::constraint::Constraint;
use crate::solver::fluid::FluidParams;
use crate::template::{Node, Role};
use glam::{BVec2, Vec2};
use parry2d::math::Pose;

/// Largest diameter of a body as it is made, as a share of the shorter period: it touches neither its own image nor two of another.
const WIDEST: f32 = 0.5;
/// Largest spacing of a fluid, as a share of it.
const COARSEST: f32 = 0.125;
/// Largest box of an obstacle, in periods.
const LARGEST_OBSTACLE: f32 = 2.0;

impl World {
    /// The lengths after which the room repeats.
    pub(crate) fn period(&self) -> Period {
        Period(self.config.period_lengths())
    }

    /// A point's image that is in the room; the point itself where the room does not repeat.
    pub(crate) fn in_room(&self, at: Vec2) -> Vec2 {
        let period = self.period();
        if period.is_none() { at } else { at + period.into_room(at) }
    }

    /// Moves what has left the room through a periodic side to the opposite one: organisms as a whole by their centres, fluid without a
    /// membrane particle by particle. Their origins move, exactly.
    pub(crate) fn return_to_room(&mut self) {
        let period = self.period();
        if !period.is_none() {
            self.organisms().collect::<Vec<_>>().into_iter().for_each(|id| self.return_organism(id, period));
            self.return_contact_points();
        }
    }

    #[cold]
    fn return_organism(&mut self, id: OrganismId, period: Period) {
        let Some(organism) = self.organisms.get(id) else { return };
        if organism.is_free_fluid() {
            for &i in &organism.fluid_particles {
                let shift = period.into_room(self.particles.position(i as usize));
                self.particles.displace(i as usize, shift);
            }
            return;
        }
        let shift = self.centroid(id).map_or(Vec2::ZERO, |centre| period.into_room(centre));
        let Some(organism) = self.organisms.get(id).filter(|_| shift != Vec2::ZERO) else { return };
        organism.particles().for_each(|i| self.particles.displace(i as usize, shift));
        if let Some(organism) = self.organisms.get_mut(id) {
            organism.goal = organism.goal.map(|goal| goal + shift);
        }
    }

    /// Checks that a room with periodic sides can hold what a blueprint says at a scale.
    pub(super) fn check_period(&self, blueprint: &Blueprint, scale: f32) -> Result<(), Error> {
        let period = self.period();
        if period.is_none() {
            return Ok(());
        }
        if blueprint.rim.is_some() || blueprint.engulfer.is_some() {
            let accepted = "an organism without a membrane that takes in nothing, in a room with periodic sides";
            return Err(Error::unsupported("organism", accepted));
        }
        let Some(template) = &blueprint.template else { return Ok(()) };
        if template.constraints().iter().any(|link| matches!(link, Constraint::YieldingDistance(_))) {
            let accepted = "a template without yielding links, in a room with periodic sides";
            return Err(Error::unsupported("template", accepted));
        }
        self.check_width(template.nodes(), blueprint.scale * scale)
    }

    /// Checks that an organism that was read may be in a room with periodic sides.
    pub(super) fn check_periodic_organism(&self, organism: &Organism) -> Result<(), Error> {
        let is_refused = organism.body.membrane().is_some() || organism.engulfer.is_some();
        if is_refused && !self.period().is_none() {
            return Err(Error::unsupported("organism", "one without a membrane in a room with periodic sides"));
        }
        Ok(())
    }

    /// Checks that a body of these nodes is not too wide for periodic sides.
    pub(super) fn check_width(&self, nodes: &[Node], scale: f32) -> Result<(), Error> {
        let middle = nodes.iter().map(|node| node.position).sum::<Vec2>() / nodes.len() as f32;
        let radii = nodes.iter().map(|node| node.position.distance(middle) + node.radius);
        let width = 2.0 * scale * radii.fold(0.0, |most, radius| if radius > most { radius } else { most });
        let most = WIDEST * self.period().shortest();
        let refused =
            || out_of_range("width", width.into(), format!("at most {most}, half of the room between periodic sides"));
        (width <= most).then_some(()).ok_or_else(refused)
    }

    /// Checks that a fluid is fine enough for periodic sides.
    pub(super) fn check_fluid_period(&self, params: &FluidParams) -> Result<(), Error> {
        let most = COARSEST * self.period().shortest();
        let accepted = || format!("at most {most}, an eighth of the room between periodic sides");
        let refused = || out_of_range("spacing", params.spacing.into(), accepted());
        (params.spacing <= most).then_some(()).ok_or_else(refused)
    }

    /// Checks that a placement suits a room with periodic sides: its controller, and that fluid has no damping about a centre.
    pub(super) fn check_periodic_placement(&self, blueprint: &Blueprint, placement: &Placement) -> Result<(), Error> {
        if self.period().is_none() {
            return Ok(());
        }
        if blueprint.fluid.is_some() && placement.angular_damping != 0.0 {
            return Err(Error::unsupported("angular_damping", "0 for fluid in a room with periodic sides"));
        }
        self.check_period(blueprint, placement.scale)
    }

    /// Checks that a controller needs nothing that a room with periodic sides does not have: it senses walls and others where they lie.
    pub(super) fn check_periodic_controller(&self, controller: &Controller) -> Result<(), Error> {
        let is_refused = !self.period().is_none() && *controller != Controller::Still;
        let refused = || Error::unsupported("controller", "none in a room with periodic sides: inputs steer there");
        if is_refused { Err(refused()) } else { Ok(()) }
    }

    /// Checks that chemicals can be here.
    pub(super) fn check_chemicals_allowed(&self) -> Result<(), Error> {
        let refused = || Error::unsupported("chemical", "a room without periodic sides");
        self.period().is_none().then_some(()).ok_or_else(refused)
    }

    /// Checks that an obstacle is in the room, and no larger than it and one image.
    pub(super) fn check_obstacle_period(&self, obstacle: &Obstacle) -> Result<(), Error> {
        self.check_obstacle_near(obstacle, 0.0)
    }

    /// The same of one that was read, and of its target: in the middle of a turn it may be outside, by less than the room is long.
    #[cfg(feature = "snapshot")]
    pub(super) fn check_read_obstacle_period(&self, obstacle: &Obstacle, target: Option<Pose>) -> Result<(), Error> {
        self.check_obstacle_near(obstacle, 1.0)?;
        target.map_or(Ok(()), |target| self.check_target_period(obstacle, &target))
    }

    /// Checks that an obstacle is in the room at its target, and near it all the way.
    pub(super) fn check_target_period(&self, obstacle: &Obstacle, target: &Pose) -> Result<(), Error> {
        if self.period().is_none() {
            return Ok(());
        }
        let accepted = "a target at which it is in the room between periodic sides, and at most two lengths of it long";
        let there = Obstacle { pose: *target, ..obstacle.clone() };
        self.check_obstacle_period(&there).map_err(|_| Error::unsupported("target", accepted))?;
        let turns = obstacle.pose.rotation != target.rotation;
        if turns && 2.0 * extent(obstacle) > LARGEST_OBSTACLE * self.period().shortest() {
            let accepted =
                "its own, for a shape that is not within a length of the room between periodic sides from its place";
            return Err(Error::unsupported("target.rotation", accepted));
        }
        Ok(())
    }

    /// Checks that an obstacle is at most so many periods beyond a periodic side, and not too large.
    fn check_obstacle_near(&self, obstacle: &Obstacle, beyond: f32) -> Result<(), Error> {
        let (period, aabb) = (self.period(), obstacle.aabb());
        for axis in (0..2).filter(|&axis| period.0[axis] > 0.0) {
            let length = period.0[axis];
            if aabb.maxs[axis] - aabb.mins[axis] > LARGEST_OBSTACLE * length {
                return Err(Error::unsupported(
                    "shape",
                    "a shape of at most two lengths of the room between periodic sides",
                ));
            }
            if aabb.maxs[axis] < -beyond * length || aabb.mins[axis] > (1.0 + beyond) * length {
                return Err(Error::unsupported("pose", "a place in the room between periodic sides"));
            }
        }
        Ok(())
    }

    /// Checks that a joint leads to the nearest image of its other end; `made` is its length when it was made.
    pub(super) fn check_joint_period(&self, spec: &JointSpec, made: f32) -> Result<(), Error> {
        let period = self.period();
        if period.is_none() {
            return Ok(());
        }
        let (length, field) = match spec.kind {
            JointKind::Distance { length }
            | JointKind::Spring { length, .. }
            | JointKind::LengthMotor { length, .. } => (length, "kind.length"),
            JointKind::Rope { max_length } => (max_length, "kind.max_length"),
            JointKind::SpeedMotor { .. } => {
                return Err(Error::unsupported("kind", "a joint with a length, in a room with periodic sides"));
            }
            JointKind::Weld => (made, "kind"),
            JointKind::Pin | JointKind::Mouse { .. } => (0.0, "kind"),
        };
        let most = 0.5 * period.shortest();
        let accepted = || format!("less than {most}, half of the room between periodic sides");
        (length < most).then_some(()).ok_or_else(|| out_of_range(field, length.into(), accepted()))
    }

    /// Displacements by which images of planned discs, in a box, come to lie over anything that is there; of the discs themselves in a
    /// room without periodic sides.
    pub(super) fn shifts_over_all(&mut self, of: [Vec2; 2]) -> Vec<Vec2> {
        let period = self.period();
        if period.is_none() {
            return vec![Vec2::ZERO];
        }
        let mut all = self.occupied();
        for aabb in self.solid_obstacles().map(Obstacle::aabb) {
            all = [all[0].min(aabb.mins), all[1].max(aabb.maxs)];
        }
        period.shifts(of, all).collect()
    }

    /// Along which axes planned discs may reach over the sides: a body whose middle is in the room over periodic ones.
    pub(super) fn may_reach_over(&self, planned: &[Particle]) -> BVec2 {
        let middle = planned.iter().map(Particle::position).sum::<Vec2>() / planned.len() as f32;
        let is_body = BVec2::splat(planned.iter().all(|disc| disc.role != Role::Fluid as u8));
        let is_in_room = middle.cmpge(Vec2::ZERO) & middle.cmple(self.config.size);
        is_body & is_in_room & self.period().0.cmpgt(Vec2::ZERO)
    }

    /// Whether an obstacle, or an image of it, overlaps a disc of an organism.
    pub(super) fn is_in_obstacle(&self, organism: &Organism, obstacle: &Obstacle) -> bool {
        let (period, aabb) = (self.period(), obstacle.aabb());
        organism.particles().any(|i| {
            let disc = self.particles.get(i as usize);
            let around = [disc.position() - disc.radius, disc.position() + disc.radius];
            period.shifts(around, [aabb.mins, aabb.maxs]).any(|shift| is_blocked(obstacle, &disc.moved(shift)))
        })
    }
}
