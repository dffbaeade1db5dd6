//! The furrow of a dividing cell: the two sides of its equator are drawn towards each other, as by a contractile ring.

use crate::organism::table::Organisms;
use crate::solver::contraction::Contraction;

/// Speeds of approach at the bottom of the furrow and next to it, relative to the furrow's: its sides slope.
const SLOPE: [f32; 3] = [1.0, 0.8, 0.5];

/// Draws the sides of every furrow together.
pub(crate) fn draw_furrows(organisms: &Organisms, contractions: &mut Vec<Contraction>) {
    for (_, organism) in organisms.iter().filter(|(_, organism)| !organism.is_quarantined) {
        let (Some(furrow), Some(divider)) = (organism.furrow(), &organism.divider) else { continue };
        let (ring, count) = (&organism.outline, organism.outline.len());
        let place = |node| ring.iter().position(|&other| other == node);
        let [Some(a), Some(b)] = furrow.nodes.map(place) else { continue };
        let speed = 2.0 * divider.params.furrow_speed;
        for (step, &share) in SLOPE.iter().enumerate() {
            let mut draw = |a: usize, b: usize| {
                contractions.push(Contraction { a: ring[a % count], b: ring[b % count], speed: speed * share });
            };
            draw(a + step, b + count - step);
            if step > 0 {
                draw(a + count - step, b + step);
            }
        }
    }
}
