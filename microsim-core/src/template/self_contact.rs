//! Self-collision of a body, by choice: nodes of a body meet those of others, but not each other, unless it asks for it.

use super::TemplateBuilder;
use crate::float_environment::with_default_float_environment;
use crate::solver::constraint::MinDistance;

impl TemplateBuilder {
    /// Keeps the discs of these slots out of each other: a [`MinDistance`] of their radii for each two that are apart now. It has no
    /// friction, and is projected in lanes as all constraints are, n (n - 1) / 2 of them for n slots: choose those that can meet.
    ///
    /// ```
    /// use microsim_core::{Node, Template, glam::Vec2};
    ///
    /// let mut builder = Template::builder();
    /// let chain: Vec<u32> =
    ///     (0..8u8).map(|k| builder.node(Node::disc(Vec2::new(f32::from(k), 0.0), 1.0, 0.4))).collect();
    /// chain.windows(2).for_each(|pair| _ = builder.link(pair[0], pair[1], 0.0));
    /// builder.self_contacts(&chain);
    /// assert_eq!(builder.build()?.constraints().len(), 7 + 28);
    /// # Ok::<(), microsim_core::Error>(())
    /// ```
    pub fn self_contacts(&mut self, slots: &[u32]) -> &mut Self {
        let pairs = (0..).zip(slots).flat_map(|(k, &a)| slots.iter().skip(k + 1).map(move |&b| (a, b)));
        for (a, b) in pairs {
            let nodes = [a, b].map(|slot| self.nodes.get(slot as usize));
            let [Some(one), Some(other)] = nodes else {
                // For `build` to refuse.
                self.constraint(MinDistance { a, b, min_length: 0.0 });
                continue;
            };
            let (min_length, is_apart) = with_default_float_environment(|| {
                let min_length = one.radius + other.radius;
                (min_length, (other.position - one.position).length_squared() >= min_length * min_length)
            });
            if is_apart {
                self.constraint(MinDistance { a, b, min_length });
            }
        }
        self
    }
}

#[cfg(test)]
mod tests {
    use crate::{Bend, Inputs, Node, Placement, Template, World, WorldConfig};
    use glam::Vec2;

    /// Smallest distance of two nodes of a chain that bends into a tight coil, over the sum of their radii.
    fn coiled(collides: bool) -> f32 {
        let mut builder = Template::builder();
        let place = |k: u8| Vec2::new(f32::from(k), 0.02 * f32::from(k % 3));
        let chain: Vec<u32> = (0..24).map(|k| builder.node(Node::disc(place(k), 1.0, 0.4))).collect();
        for part in chain.windows(3) {
            builder.link(part[0], part[1], 0.0).constraint(Bend::new([part[0], part[1], part[2]], 0.9, 1e-2));
        }
        if collides {
            builder.self_contacts(&chain);
        }
        let mut world = World::new(WorldConfig { damping: 2.0, ..WorldConfig::default() }).unwrap();
        let template = world.add_template(builder.build().unwrap());
        let id = world.spawn_template(template, Placement::at(60.0, 45.0)).unwrap();
        (0..400).for_each(|_| world.step(&Inputs::new()));
        let places: Vec<Vec2> = world.view().organism(id).unwrap().particles().map(|node| node.position).collect();
        let apart = (0..places.len()).flat_map(|k| (0..k).map(move |j| (j, k)));
        let least = apart.map(|(j, k)| places[j].distance(places[k])).fold(f32::INFINITY, f32::min);
        least / 0.8
    }

    #[test]
    fn a_body_that_coils_up_meets_itself_if_it_asks_for_it() {
        let [without, with] = [false, true].map(coiled);
        assert!(without < 0.5 && with > 0.9, "{without} {with}");
    }

    #[test]
    fn slots_that_do_not_exist_are_refused() {
        let mut builder = Template::builder();
        builder.node(Node::disc(Vec2::ZERO, 1.0, 0.4));
        builder.self_contacts(&[0, 7]);
        assert!(builder.build().is_err());
    }
}
