//! Yielding links: at the end of each substep those of some blocks flow or tear, each lane by itself.

use super::block::Batch;
use super::constraint::{Constraint, TORN};
use super::lanes::LANES;
use super::muscle::Scaled;

/// Excess of elastic strain from which on a link that flows keeps its body awake.
const KEEPS_AWAKE: f32 = 1e-3;

/// A link of one body that has flowed or torn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Flow {
    pub block: u32,
    pub lane: usize,
    /// Of the length state of the block.
    pub row: u32,
    pub nodes: [u32; 2],
    /// Its plastic strain now, or [`TORN`].
    pub plastic: f32,
    /// Whether it has still a long way to flow, or has just torn.
    pub keeps_awake: bool,
}

/// Each block has its index as value.
impl Batch<'_, u32> {
    /// What becomes of the yielding links of a template in all blocks, after a share of the step and a substep of `h` seconds.
    #[inline(always)]
    pub(crate) fn flow(&self, constraints: &[Constraint], scaled: &[Scaled], share: f32, h: f32) -> Vec<Flow> {
        let mut flows = Vec::new();
        for scaled in scaled {
            let Some((row, Constraint::YieldingDistance(link))) =
                scaled.link.map(|row| (row, &constraints[scaled.constraint as usize]))
            else {
                continue;
            };
            let flowing = link.share(h);
            for &(block, index) in self.blocks.iter().filter(|(block, _)| !block.is_empty()) {
                let plastic = block.length_state[row as usize];
                let span = block.contracted(scaled, share, self.start);
                let Some(after) = link.flow::<LANES>(&span, plastic, flowing, &self.stretch) else { continue };
                for lane in (0..LANES).filter(|&lane| after[lane] != plastic[lane]) {
                    let way = (after[lane] - plastic[lane]).abs();
                    let keeps_awake = after[lane] == TORN || way > KEEPS_AWAKE * flowing;
                    let nodes = [link.a, link.b];
                    flows.push(Flow { block: index, lane, row, nodes, plastic: after[lane], keeps_awake });
                }
            }
        }
        flows
    }
}

#[cfg(test)]
mod tests {
    use super::super::block::{Block, batches};
    use super::super::constraint::{Distance, YieldingDistance};
    use super::super::testing::disc;
    use super::*;
    use crate::particle::Particles;
    use glam::Vec2;

    #[test]
    fn each_lane_flows_by_its_own_length_scale_and_contraction() {
        let mut p = Particles::default();
        let mut block = Block::new(0, 2, &mut p);
        block.owner = [0; LANES];
        block.scale[1] = 2.0;
        block.length_state = vec![[1.0, 1.0, 0.5, 1.0, 1.0, 1.0, 1.0, 1.0], [0.0; LANES]];
        block.length_state[1][3] = TORN;
        block.length_state[1][4] = 0.4;
        block.contraction_before = block.length_state[..1].to_vec();
        for lane in 0..LANES {
            p.set(block.particle(0, lane) as usize, &disc(Vec2::ZERO, 1.0));
            p.set(block.particle(1, lane) as usize, &disc(Vec2::new(1.5, 0.0), 1.0));
        }
        p.x[block.particle(1, 5) as usize] = 1.0;
        p.x[block.particle(1, 6) as usize] = 2.5;
        let spring = Distance { a: 0, b: 1, rest_length: 1.0, compliance: 1e-3, damping: 0.0 };
        let link = YieldingDistance {
            yield_strain: 0.3,
            flow_rate: 1.0,
            max_plastic_strain: 3.0,
            breaking_strain: 1.2,
            ..spring.into()
        };
        let scaled = [Scaled { constraint: 0, channel: Some(0), link: Some(1) }];
        let (constraints, mut blocks) = ([link.into()], [(&block, 7)]);
        let flows = batches(&mut blocks, &mut p)[0].flow(&constraints, &scaled, 1.0, 0.01);
        let found: Vec<_> = flows.iter().map(|flow| (flow.lane, flow.plastic == TORN)).collect();
        // Lane 1 is not stretched, but as short as a body twice as large may not be; lane 2 is thrice as long as its muscle wants.
        assert_eq!(found, [(0, false), (2, true), (6, true), (7, false)].map(|lane| lane).to_vec());
        assert!(flows.iter().all(|flow| (flow.block, flow.row, flow.nodes) == (7, 1, [0, 1]) && flow.keeps_awake));
        let expected = 0.2 * link.share(0.01);
        assert!((flows[0].plastic - expected).abs() < 1e-6, "{flows:?}");
    }
}
