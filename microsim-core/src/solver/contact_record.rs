//! Records of what contacts did in each substep, for reports. Nothing is recorded unless somebody wants to know.

use super::lanes::ratio;
use glam::Vec2;

/// What a disc touched.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Touched {
    /// A particle.
    Disc(u32),
    /// The obstacle with this index, walls included.
    Obstacle(u32),
}

/// What a contact did in a substep.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ContactRecord {
    pub particle: u32,
    pub touched: Touched,
    pub point: Vec2,
    /// Unit vector to the particle.
    pub normal: Vec2,
    /// Speed of approach; negative if they part.
    pub speed: f32,
    /// Normal impulse.
    pub impulse: f32,
}

/// A contact that was projected, as the projection knows it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Projected {
    pub particle: u32,
    pub touched: Touched,
    pub point: Vec2,
    /// Unit vector to the particle.
    pub normal: Vec2,
    pub depth: f32,
    /// Sum of the inverse masses of both sides along the normal.
    pub weight: f32,
    pub restitution: f32,
    /// Velocity of what is touched, relative to the particle.
    pub way: Vec2,
}

/// Records of a step.
#[derive(Debug, Default)]
pub(crate) struct ContactRecorder {
    is_on: bool,
    h: f32,
    records: Vec<ContactRecord>,
}

impl ContactRecorder {
    /// Begins a step with substeps of `h`.
    pub(crate) fn begin(&mut self, is_on: bool, h: f32) {
        self.records.clear();
        (self.is_on, self.h) = (is_on, h);
    }

    /// Notes a contact that was projected.
    #[inline(always)]
    pub(crate) fn note(&mut self, projected: impl FnOnce() -> Projected) {
        if self.is_on {
            self.record(projected());
        }
    }

    /// Takes the records of another one.
    pub(crate) fn append(&mut self, other: &mut Self) {
        self.records.append(&mut other.records);
    }

    /// One without records, which notes what this one notes.
    pub(crate) fn begin_like(&mut self, other: &Self) {
        self.begin(other.is_on, other.h);
    }

    /// The records, by particle and by what it touched, in the order of the substeps.
    pub(crate) fn sorted(&mut self) -> &[ContactRecord] {
        self.records.sort_by_key(|record| (record.particle, record.touched));
        &self.records
    }

    fn record(&mut self, projected: Projected) {
        let Projected { particle, touched, point, normal, depth, weight, restitution, way } = projected;
        let speed = way.dot(normal);
        // What bounces gets its speed of separation at once, see `apply_restitution`.
        let (stopped, bounced) = (depth / self.h, (1.0 + restitution) * speed);
        let impulse = ratio(if restitution > 0.0 && bounced > stopped { bounced } else { stopped }, weight);
        self.records.push(ContactRecord { particle, touched, point, normal, speed, impulse });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_impulse_is_that_of_the_rebound_or_of_the_depth_whichever_is_greater() {
        let impulse = |speed: f32, restitution: f32, is_on: bool| {
            let mut recorder = ContactRecorder::default();
            recorder.begin(is_on, 0.01);
            recorder.note(|| Projected {
                particle: 0,
                touched: Touched::Disc(1),
                point: Vec2::ZERO,
                normal: Vec2::X,
                depth: 0.01,
                weight: 0.5,
                restitution,
                way: Vec2::new(speed, 0.0),
            });
            let records = recorder.sorted().iter().map(|record| (record.speed, record.impulse));
            records.collect::<Vec<_>>()
        };
        assert_eq!(impulse(4.0, 0.0, true), [(4.0, 2.0)]);
        assert_eq!(impulse(4.0, 0.5, true), [(4.0, 12.0)]);
        assert_eq!(impulse(0.5, 0.5, true), [(0.5, 2.0)]);
        assert_eq!(impulse(4.0, 0.5, false), []);
    }
}
