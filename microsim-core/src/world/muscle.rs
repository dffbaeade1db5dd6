//! Muscles of own bodies: activations become the lengths of their constraints.

use super::World;
use crate::inputs::Inputs;
use crate::solver::block::Block;
use crate::solver::lanes::LANES;

impl World {
    /// Sets the contraction of all muscles for a step, and wakes the bodies in which it changes.
    pub(crate) fn contract_muscles(&mut self, inputs: &Inputs) {
        for index in 0..self.blocks.len() {
            let channels = self.templates[self.blocks[index].template as usize].channels().len();
            if channels == 0 {
                continue;
            }
            let wanted = self.contraction(&self.blocks[index], inputs);
            let before = &self.blocks[index].length_state[..channels];
            let changes =
                |lane: &usize| wanted.iter().zip(before).any(|(wanted, before)| wanted[*lane] != before[*lane]);
            let changed: Vec<usize> = (0..LANES).filter(changes).collect();
            changed.iter().for_each(|&lane| self.sleep.wake_up(index as u32, lane));
            if !changed.is_empty() || *before != self.blocks[index].contraction_before {
                let block = &mut self.blocks[index];
                block.contraction_before = block.length_state.splice(..channels, wanted).collect();
            }
        }
    }

    /// Factor on the lengths of the muscles of each channel, lane by lane.
    fn contraction(&self, block: &Block, inputs: &Inputs) -> Vec<[f32; LANES]> {
        let owners = block.owner.map(|owner| self.organisms.id_at(owner));
        let channels = self.templates[block.template as usize].channels().iter().zip(0..);
        let of_channel = |(&[rest, active], channel): (&[f32; 2], u32)| {
            let activation = owners.map(|owner| owner.map_or(0.0, |id| inputs.activation(id, channel)));
            activation.map(|activation| rest + activation * (active - rest))
        };
        channels.map(of_channel).collect()
    }
}
