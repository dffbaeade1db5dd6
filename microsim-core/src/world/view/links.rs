//! Yielding links of an organism: what has flowed and what has torn.

use super::OrganismView;
use crate::solver::constraint::TORN;

/// A yielding link of one body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct YieldingLink {
    /// The nodes of the template that it is between.
    pub nodes: [u32; 2],
    /// By how much it has lengthened for good (negative: shortened), over its rest length; `None` once it tore.
    pub plastic_strain: Option<f32>,
}

impl<'a> OrganismView<'a> {
    /// Its yielding links ([`crate::YieldingDistance`]), in the order in which the template's builder was given them.
    pub fn yielding_links(self) -> impl Iterator<Item = YieldingLink> + 'a {
        let links = self.view.world.yielding_links(self.organism);
        links.map(|(link, plastic)| YieldingLink {
            nodes: [link.a, link.b],
            plastic_strain: (plastic != TORN).then_some(plastic),
        })
    }
}
