//! Secretion and uptake of chemicals at the outlines of organisms.

use crate::chemical::Chemical;
use crate::organism::table::Organisms;
use crate::particle::Particles;

/// Carries out the sources and sinks of all organisms for a time `dt`.
pub(crate) fn exchange(organisms: &Organisms, particles: &Particles, chemicals: &mut [Chemical], dt: f32) {
    for (_, organism) in organisms.iter().filter(|(_, organism)| !organism.is_quarantined && !organism.is_held()) {
        for exchange in &organism.exchanges {
            let Some(chemical) = chemicals.get_mut(exchange.chemical.0 as usize) else { continue };
            let first = organism.first_node().filter(|_| organism.outline.is_empty());
            let part = dt / organism.outline.len().max(1) as f32;
            for i in organism.outline_particles().chain(first) {
                let at = particles.position(i as usize);
                chemical.take(at, exchange.uptake * part);
                chemical.add(at, exchange.secretion * part);
            }
        }
    }
}
