//! Yielding links of own bodies: what flowed and tore in a substep becomes state and events.

use super::World;
use crate::event::Event;
use crate::organism::{Organism, Storage};
use crate::parallel;
use crate::solver::block::{self, Block};
use crate::solver::constraint::{TORN, YieldingDistance};
use crate::solver::muscle::Scaled;
use crate::solver::yielding::Flow;
use crate::template::Template;

impl World {
    /// Lets the links of all bodies that are awake flow and tear, at the end of a substep of `h` seconds.
    pub(crate) fn yield_links(&mut self, substep: u32, h: f32) {
        let Self { config, particles, templates, blocks, sleep, dispatch, .. } = self;
        if !templates.iter().any(|template| template.yields()) {
            return;
        }
        let share = (substep + 1) as f32 / config.substeps as f32;
        let yields = |block: &Block| templates[block.template as usize].yields();
        let mut awake: Vec<(&Block, u32)> =
            blocks.iter().zip(0..).filter(|(block, k)| yields(block) && !sleep.is_asleep(*k)).collect();
        let flows = parallel::map(block::batches(&mut awake, particles), |batch| {
            let template = &templates[batch.template()];
            dispatch.run(
                #[inline(always)]
                || batch.flow(template.constraints(), template.scaled(), share, h),
            )
        });
        flows.into_iter().flatten().for_each(|flow| self.apply_flow(flow));
    }

    fn apply_flow(&mut self, flow: Flow) {
        let Flow { block, lane, row, nodes, plastic, keeps_awake } = flow;
        self.blocks[block as usize].length_state[row as usize][lane] = plastic;
        if keeps_awake {
            self.sleep.wake_up(block, lane);
        }
        if plastic == TORN
            && let Some(organism) = self.organisms.id_at(self.blocks[block as usize].owner[lane])
        {
            self.events.push(Event::LinkTorn { organism, nodes });
        }
    }

    /// Factor on the lengths of a constraint of an organism beside its scale: 1, but for muscles and yielding links, and 0 for a
    /// link that tore.
    pub(in crate::world) fn length_factor(&self, organism: &Organism, constraint: u32) -> f32 {
        let Storage::Lane { block, first } = organism.body else { return 1.0 };
        let block = &self.blocks[block as usize];
        let scaled = self.templates[block.template as usize].scaled();
        let Ok(k) = scaled.binary_search_by_key(&constraint, |scaled| scaled.constraint) else { return 1.0 };
        let Scaled { channel, link, .. } = scaled[k];
        let state = |row: u32| block.length_state[row as usize][(first - block.base) as usize];
        channel.map_or(1.0, state) * link.map_or(1.0, |row| 1.0 + state(row))
    }

    /// The yielding links of an organism, each with its plastic strain, or [`TORN`].
    pub(in crate::world) fn yielding_links<'a>(
        &'a self,
        organism: &Organism,
    ) -> impl Iterator<Item = (&'a YieldingDistance, f32)> + use<'a> {
        let place = match organism.body {
            Storage::Lane { block, first } => Some((&self.blocks[block as usize], first)),
            Storage::Loose { .. } => None,
        };
        place.into_iter().flat_map(move |(block, first)| {
            let links = self.templates[block.template as usize].yielding_links();
            links.filter_map(move |(link, scaled)| {
                let row = &block.length_state[scaled.link? as usize];
                Some((link, row[(first - block.base) as usize]))
            })
        })
    }

    /// Rows and plastic strains of the links of a half of an organism that goes on with a template, where its nodes take over slots:
    /// a link has what one between the same slots had.
    pub(in crate::world) fn strains_of_half(
        &self,
        organism: &Organism,
        slots: &[u32],
        template: &Template,
    ) -> Vec<(u32, f32)> {
        if slots.len() != template.nodes().len() {
            return Vec::new();
        }
        let strain = |link: &YieldingDistance| {
            let [a, b] = [link.a, link.b].map(|node| slots[node as usize]);
            let mut known = self.yielding_links(organism);
            let same = known.find(|(of_whole, _)| [[a, b], [b, a]].contains(&[of_whole.a, of_whole.b]));
            same.map_or(0.0, |(_, plastic)| link.within_bounds(plastic))
        };
        template.yielding_links().filter_map(|(link, scaled)| Some((scaled.link?, strain(link)))).collect()
    }

    /// Sets plastic strains of a body, by their rows.
    pub(in crate::world) fn set_strains(&mut self, body: &Storage, strains: &[(u32, f32)]) {
        let &Storage::Lane { block, first } = body else { return };
        let block = &mut self.blocks[block as usize];
        let lane = (first - block.base) as usize;
        strains.iter().for_each(|&(row, strain)| block.length_state[row as usize][lane] = strain);
    }
}
