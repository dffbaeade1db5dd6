//! Yielding distance: a spring that flows beyond a yield strain and tears beyond a breaking strain.
//!
//! With `l` the length at rest, `e = |x_b - x_a| / l - 1` the strain and `p` the plastic strain of an instance, it is a
//! [`super::Distance`] of length `l (1 + p)`. Its elastic strain `e - p` is force times compliance over `l`. Beyond the yield
//! strain `y` it flows:
//!
//! `dp/dt = k (|e - p| - y) sign(e - p)`, `|p| <= p_max`.
//!
//! That is a spring in series with a body of Bingham ("Fluidity and Plasticity", 1922), and for `y = 0` the fluid of Maxwell (1867,
//! Phil. Trans. R. Soc. 157, 49); between particles, Clavet, Beaudoin, Poulin 2005, "Particle-based Viscoelastic Fluid Simulation",
//! algorithm 4. At a length that is held, what exceeds `y` decays as `exp(-k t)`; under a constant force `p` grows by
//! `k (F alpha / l - y)` per second. In a substep the share `1 - exp(-k h)` of the excess flows, the exponential by its Taylor
//! polynomial of third order. Where `e` exceeds the breaking strain the link is gone.

use super::{Constrain, Constraint, Distance, JacobianRow, MAX_LENGTH, PULL};
use crate::error::{Error, in_range};
use crate::instruction_set::each;
use crate::particle::Columns;
use crate::solver::lanes::{Pair, Span, ratio};
use glam::Vec2;
use serde::{Deserialize, Serialize};

/// Stands for the plastic strain of a link that tore: its length would be 0.
pub(crate) const TORN: f32 = -1.0;
/// How far a link may shorten for good.
const MOST_SHORTENED: f32 = 0.9;

/// Two nodes at a distance, like a soft [`Distance`], that keep a part of what stretches or compresses them too far, or part for
/// good. How far a link has yielded is a matter of each body; [`crate::OrganismView::yielding_links`] says it.
///
/// Strains are changes of length over [`rest_length`](Self::rest_length), which grows with the body and follows a muscle. They
/// are measured at the end of each substep. Beside this link, whatever else holds the nodes stays.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct YieldingDistance {
    /// First node.
    pub a: u32,
    /// Second node.
    pub b: u32,
    /// Length at rest before it has yielded, units, 0.000 001 to 1 000 000.
    pub rest_length: f32,
    /// Inverse stiffness (length/force), 1e-9 to 1 000 000. Its product with a force, over the length, is a strain; in a chain of
    /// nodes of mass `m`, in substeps of `h`, strains are larger than that by the share `h (h + damping) / (m compliance)`.
    pub compliance: f32,
    /// Damping time (damping coefficient over stiffness), s, 0 to 10; 0 is undamped. It resists flow too: under a constant force
    /// a link flows slower by the factor `1 + flow_rate * damping`.
    pub damping: f32,
    /// Elastic strain, of extension or compression, up to which it springs back, 0 to 100.
    pub yield_strain: f32,
    /// Share of the elastic strain beyond that which flows in a second, 1/s, 0 to 100; 0 never flows. Under a constant force
    /// it flows slower by half its product with the substep.
    pub flow_rate: f32,
    /// Largest plastic strain, of extension and of compression, 0 to 100; that of compression stays below 0.9.
    pub max_plastic_strain: f32,
    /// Strain, elastic and plastic together, beyond which it tears, 0.001 to 1000, or infinite for one that does not.
    pub breaking_strain: f32,
}

impl YieldingDistance {
    /// The spring that it is before it yields.
    fn distance(&self) -> Distance {
        let Self { a, b, rest_length, compliance, damping, .. } = *self;
        Distance { a, b, rest_length, compliance, damping }
    }

    /// Share of the excess of elastic strain that flows in `h` seconds: `1 - exp(-k h)`.
    pub(crate) fn share(&self, h: f32) -> f32 {
        let z = self.flow_rate * h;
        let grown = z * (1.0 + z * (0.5 + z / 6.0));
        grown / (1.0 + grown)
    }

    /// Least and largest plastic strain.
    pub(crate) fn bounds(&self) -> [f32; 2] {
        let most = self.max_plastic_strain;
        [if most < MOST_SHORTENED { -most } else { -MOST_SHORTENED }, most]
    }

    /// The nearest plastic strain that it may have; one that tore stays so.
    pub(crate) fn within_bounds(&self, plastic: f32) -> f32 {
        let [least, most] = self.bounds();
        if plastic == TORN {
            TORN
        } else if plastic < least {
            least
        } else if plastic > most {
            most
        } else {
            plastic
        }
    }

    /// The plastic strain in each lane after a share of the excess has flowed, [`TORN`] where it tears; `None` if nothing yields.
    /// What nothing moves does not yield.
    #[inline(always)]
    pub(crate) fn flow<const L: usize>(
        &self,
        span: &Span<L>,
        plastic: [f32; L],
        share: f32,
        particles: &Columns<'_>,
    ) -> Option<[f32; L]> {
        let pair = Pair::<L>::load(particles, span.at(self.a), span.at(self.b));
        let length = each::<L>(|l| pair.length(l));
        let strain = each::<L>(|l| length[l] / (self.rest_length * span.scale[l]) - 1.0);
        let elastic = each::<L>(|l| strain[l] - plastic[l]);
        let mut yields = false;
        for l in 0..L {
            let is_beyond = (elastic[l] > self.yield_strain) | (elastic[l] < -self.yield_strain);
            let is_beyond = is_beyond | (strain[l] > self.breaking_strain);
            yields |= is_beyond & (plastic[l] > TORN) & (pair.weight(l) > 0.0);
        }
        let after = |l: usize| {
            let is_whole = plastic[l] > TORN && pair.weight(l) > 0.0;
            if is_whole { self.flowed(strain[l], plastic[l], share) } else { plastic[l] }
        };
        yields.then(|| each(after))
    }

    /// Plastic strain at a strain, after a share of the excess has flowed.
    #[inline(always)]
    fn flowed(&self, strain: f32, plastic: f32, share: f32) -> f32 {
        if strain > self.breaking_strain {
            return TORN;
        }
        let elastic = strain - plastic;
        let excess = if elastic > self.yield_strain {
            elastic - self.yield_strain
        } else if elastic < -self.yield_strain {
            elastic + self.yield_strain
        } else {
            0.0
        };
        let flowed = plastic + excess * share;
        if flowed.is_finite() { self.within_bounds(flowed) } else { plastic }
    }
}

impl Constrain for YieldingDistance {
    fn order(&self) -> u8 {
        PULL + 5
    }

    fn half(&self) -> Option<Constraint> {
        Some(Self { compliance: 2.0 * self.compliance, ..*self }.into())
    }

    fn rows(&self, places: &[Vec2]) -> Vec<JacobianRow> {
        JacobianRow::of_pair([self.a, self.b], self.compliance, places)
    }

    fn links(&self) -> Vec<[u32; 2]> {
        vec![[self.a, self.b]]
    }

    fn validate(&self, nodes: usize) -> Result<(), Error> {
        self.distance().validate(nodes)?;
        in_range("rest_length", self.rest_length, 1e-6, MAX_LENGTH)?;
        in_range("compliance", self.compliance, 1e-9, MAX_LENGTH)?;
        in_range("yield_strain", self.yield_strain, 0.0, 100.0)?;
        in_range("flow_rate", self.flow_rate, 0.0, 100.0)?;
        in_range("max_plastic_strain", self.max_plastic_strain, 0.0, 100.0)?;
        if self.breaking_strain == f32::INFINITY {
            return Ok(());
        }
        in_range("breaking_strain", self.breaking_strain, 1e-3, 1000.0)
    }

    /// The scale of a lane has the plastic strain in it; it is 0 where the link tore.
    #[inline(always)]
    fn project<const L: usize>(&self, spans: &[Span<L>], particles: &mut Columns<'_>, h: f32) {
        let Self { a, b, rest_length, compliance, damping, .. } = *self;
        let (alpha, gamma) = (compliance / (h * h), damping / h);
        for span in spans {
            let pair = Pair::<L>::load(particles, span.at(a), span.at(b));
            let resisted = pair.opening(particles);
            let length = each::<L>(|l| pair.length(l));
            let error = each::<L>(|l| rest_length * span.scale[l] - length[l]);
            let weight = each::<L>(|l| (1.0 + gamma) * pair.weight(l) + alpha);
            let share = each::<L>(|l| ratio(error[l] * length[l] - gamma * resisted[l], pair.squared[l] * weight[l]));
            pair.push(particles, each(|l| if span.scale[l] > 0.0 { share[l] } else { 0.0 }));
        }
    }
}

impl From<YieldingDistance> for Constraint {
    fn from(constraint: YieldingDistance) -> Self {
        Self::YieldingDistance(constraint)
    }
}

/// One that neither flows nor tears, to be completed by struct update.
impl From<Distance> for YieldingDistance {
    fn from(distance: Distance) -> Self {
        let Distance { a, b, rest_length, compliance, damping } = distance;
        let (yield_strain, flow_rate, max_plastic_strain, breaking_strain) = (0.0, 0.0, 0.0, f32::INFINITY);
        Self { a, b, rest_length, compliance, damping, yield_strain, flow_rate, max_plastic_strain, breaking_strain }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solver::testing::{assert_pair_laws, line, momentum};

    const H: f32 = 0.01;

    fn link() -> YieldingDistance {
        let spring = Distance { a: 0, b: 1, rest_length: 1.0, compliance: 1e-3, damping: 0.0 };
        YieldingDistance {
            yield_strain: 0.1,
            flow_rate: 2.0,
            max_plastic_strain: 0.5,
            breaking_strain: 1.5,
            ..spring.into()
        }
    }

    fn span(plastic: f32) -> Span<1> {
        Span { base: 0, scale: [1.0 + plastic] }
    }

    /// Plastic strain at a length after a share of the excess has flowed.
    fn flowed(length: f32, plastic: f32, share: f32) -> Option<f32> {
        let mut p = line(length, [1.0, 1.0]);
        link().flow(&span(0.0), [plastic], share, &p.columns()).map(|[after]| after)
    }

    #[test]
    fn obeys_the_laws_of_a_pair_constraint() {
        for damping in [0.0, 0.01] {
            assert_pair_laws(&[0.5, 1.7], 1.0, |p| {
                YieldingDistance { damping, ..link() }.project(&[span(0.0)], &mut p.columns(), H);
            });
        }
    }

    #[test]
    fn it_is_the_spring_of_its_present_length_or_nothing() {
        for plastic in [-0.2, 0.0, 0.4] {
            let [mut one, mut other] = [(); 2].map(|()| line(2.0, [1.0, 0.5]));
            link().project(&[span(plastic)], &mut one.columns(), H);
            let spring = Distance { rest_length: 1.0 + plastic, ..link().distance() };
            spring.project(&[Span::LOOSE], &mut other.columns(), H);
            assert!((one.x[0] - other.x[0]).abs() < 1e-6 && (one.x[1] - other.x[1]).abs() < 1e-6);
            assert!((momentum(&one) - momentum(&line(2.0, [1.0, 0.5]))).length() < 1e-5);
        }
        let mut torn = line(2.0, [1.0, 0.5]);
        link().project(&[span(TORN)], &mut torn.columns(), H);
        assert_eq!((torn.x[0], torn.x[1]), (0.0, 2.0));
    }

    #[test]
    fn what_exceeds_the_yield_strain_flows_within_bounds() {
        assert_eq!([flowed(1.09, 0.0, 0.5), flowed(0.91, 0.0, 0.5), flowed(1.3, 0.25, 0.5)], [None; 3]);
        let near = |after: Option<f32>, expected: f32| (after.unwrap() - expected).abs() < 1e-6;
        assert!(near(flowed(1.3, 0.0, 0.5), 0.1) && near(flowed(0.7, 0.0, 0.5), -0.1), "half of the excess");
        assert!(near(flowed(2.4, 0.0, 1.0), 0.5) && near(flowed(0.1, 0.0, 1.0), -0.5), "the largest");
    }

    #[test]
    fn it_tears_beyond_the_breaking_strain_once() {
        assert_eq!([flowed(2.51, 0.3, 0.0), flowed(2.49, 0.3, 0.0)], [Some(TORN), Some(0.3)]);
        assert_eq!(flowed(1.0, TORN, 0.5), None);
        let mut fixed = line(9.0, [0.0, 0.0]);
        assert_eq!(link().flow(&span(0.0), [0.0], 0.5, &fixed.columns()), None, "what nothing moves");
    }

    #[test]
    fn numbers_that_are_none_change_nothing() {
        let endless = YieldingDistance { breaking_strain: f32::INFINITY, ..link() };
        for strain in [f32::NAN, f32::INFINITY] {
            for share in [0.0, 0.5] {
                let after = endless.flowed(strain, 0.2, share);
                assert!((-0.5..=0.5).contains(&after), "{strain} {share}: {after}");
            }
        }
    }

    #[test]
    fn the_share_is_that_of_an_exponential() {
        let of = |rate| YieldingDistance { flow_rate: rate, ..link() }.share(H);
        assert_eq!(of(0.0), 0.0);
        // 1 - exp(-0.01), 1 - exp(-0.1), 1 - exp(-1)
        for (rate, expected) in [(1.0, 0.009_950_166), (10.0, 0.095_162_58), (100.0, 0.632_120_6)] {
            assert!((of(rate) / expected - 1.0).abs() < 0.02, "{rate}: {}", of(rate));
        }
    }
}
