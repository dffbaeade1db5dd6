//! In which order a substep projects the constraints of a body: forwards, or forwards and backwards.
//!
//! A pass over constraints that share nodes maps small errors `e` of the positions by a product `P` of projections. With velocities
//! from positions `e_(n+1) = P (2 e_n - e_(n-1))`, so an eigenvalue `p` of `P` stands for growth by `|p +- sqrt(p^2 - p)|` a substep.
//! Between 0 and 1 that is `sqrt(p)`: errors decay. But `P` is not symmetric, and complex or negative eigenvalues may grow, however
//! small: those of links between all pairs of six nodes on a circle by 8 % a substep, of a hub that is lighter than the eleven nodes on
//! it by up to 24 %. Forwards and backwards the pass is `P^T P`, symmetric in the metric of the masses, with eigenvalues between 0
//! and 1 (symmetric Gauss-Seidel, Saad 2003, "Iterative Methods for Sparse Linear Systems", 4.1). Each constraint then takes half
//! of its multiplier each way, with twice its compliance.

use super::{Node, Template};
use crate::float_environment::with_default_float_environment;
use crate::rng::Rng;
use crate::solver::constraint::{Constraint, Distance, JacobianRow};
use crate::solver::lanes::ratio;
use crate::solver::muscle::Scaled;
use glam::Vec2;

/// Substeps in which errors turn from the first ones to those that last.
const BEGINNING: usize = 64;
/// Substeps over which their largest size is looked at, twice.
const SUBSTEPS: usize = 1024;
/// Most rows that are looked at, some 6 µs each: of more it is taken that errors grow.
const MOST_ROWS: usize = 20_000;
/// Growth of that which counts: of 0.02 % a substep where a tenth of the errors grows.
const GROWTH: f64 = 1.001;
/// Size at which they have grown for sure.
const LARGE: f64 = 100.0;

/// What a substep projects of a template.
#[derive(Clone, Debug)]
pub(crate) struct Projection {
    /// In the order of projection.
    pub constraints: Vec<Constraint>,
    /// Those of them whose lengths are scaled.
    pub scaled: Vec<Scaled>,
    /// Those that are rigid links and not scaled, for projecting them once more.
    pub rigid_links: Vec<Constraint>,
}

impl Projection {
    /// Once forwards where errors decay, in substeps of `h` seconds and for bodies of any size and mass, else forwards and backwards.
    pub(crate) fn new(template: &Template, h: f32) -> Self {
        with_default_float_environment(|| {
            let (mut constraints, mut scaled) = (template.constraints().to_vec(), template.scaled().to_vec());
            if makes_energy(template.nodes(), &constraints, h) {
                (constraints, scaled) = there_and_back(&constraints, &scaled);
            }
            let rigid_links = rigid_links(&constraints, &scaled);
            Self { constraints, scaled, rigid_links }
        })
    }
}

/// Halves of what has halves, in their order and in the opposite one, then all others.
fn there_and_back(constraints: &[Constraint], scaled: &[Scaled]) -> (Vec<Constraint>, Vec<Scaled>) {
    let mut halves: Vec<_> = constraints.iter().map_while(Constraint::half).collect();
    let (turn, all) = (halves.len(), constraints.len());
    halves.extend_from_within(..);
    halves[turn..].reverse();
    halves.extend_from_slice(&constraints[turn..]);
    let order = (0..turn).chain((0..turn).rev()).chain(turn..all);
    let of = |(at, from): (u32, usize)| {
        let k = scaled.binary_search_by_key(&(from as u32), |scaled| scaled.constraint).ok()?;
        Some(Scaled { constraint: at, ..scaled[k] })
    };
    (halves, (0..).zip(order).filter_map(of).collect())
}

/// The constraints that are rigid links and not scaled, in their order.
fn rigid_links(constraints: &[Constraint], scaled: &[Scaled]) -> Vec<Constraint> {
    let is_scaled = |k: u32| scaled.binary_search_by_key(&k, |scaled| scaled.constraint).is_ok();
    let is_rigid = |constraint: &Constraint| {
        matches!(constraint, Constraint::Distance(Distance { compliance: 0.0, damping: 0.0, .. }))
    };
    let rigid = constraints.iter().zip(0..).filter(|&(constraint, k)| is_rigid(constraint) && !is_scaled(k));
    rigid.map(|(constraint, _)| constraint.clone()).collect()
}

/// Whether one pass over constraints may make energy: where small errors grow in the shape of the template, or what has branches can
/// take others. Bodies may be lighter than their template, and so stiffer: all that is soft is looked at as if it were rigid, too.
fn makes_energy(nodes: &[Node], constraints: &[Constraint], h: f32) -> bool {
    let places: Vec<Vec2> = nodes.iter().map(|node| node.position).collect();
    let mut rows: Vec<JacobianRow> = constraints.iter().flat_map(|constraint| constraint.rows(&places)).collect();
    let moves = |slot: u32| nodes[slot as usize].mass.is_finite();
    if is_chain(nodes.len(), &rows) {
        return false;
    }
    if rows.len() > MOST_ROWS || is_floppy(nodes.len(), &rows, moves) || Errors::new(nodes, &rows, h).grow() {
        return true;
    }
    let is_soft = rows.iter().any(|row| row.compliance > 0.0);
    rows.iter_mut().for_each(|row| row.compliance = 0.0);
    is_soft && Errors::new(nodes, &rows, h).grow()
}

/// Whether rows are links of which no node has more than two: errors decay in chains and rings of any shape.
fn is_chain(nodes: usize, rows: &[JacobianRow]) -> bool {
    rows.iter().all(|row| row.gradient.len() == 2) && degrees(nodes, rows).iter().all(|&degree| degree <= 2)
}

/// How many rows have each node.
fn degrees(nodes: usize, rows: &[JacobianRow]) -> Vec<u32> {
    let mut degrees = vec![0; nodes];
    rows.iter().flat_map(|row| &row.gradient).for_each(|&(slot, _)| degrees[slot as usize] += 1);
    degrees
}

/// Whether rows are too few to hold a shape: in all, or a node that moves has one only.
fn is_floppy(nodes: usize, rows: &[JacobianRow], moves: impl Fn(u32) -> bool) -> bool {
    let moving = (0..nodes as u32).filter(|&slot| moves(slot)).count();
    let free = if moving == nodes { 3 } else { 0 };
    let degrees = degrees(nodes, rows);
    rows.len() + free < 2 * moving || (0..).zip(degrees).any(|(slot, degree)| degree == 1 && moves(slot))
}

/// Small errors of the positions of a body that rests in the shape of its template, to first order.
struct Errors {
    now: Vec<[f64; 2]>,
    before: Vec<[f64; 2]>,
    /// Of each row and node the slot, the gradient, and what the row gives the node of its sum.
    parts: Vec<(usize, [f64; 2], [f64; 2])>,
    /// The number of nodes of each row.
    counts: Vec<usize>,
}

impl Errors {
    /// At rest, so that what moves the body as a whole stays as it is; the same in each run.
    fn new(nodes: &[Node], rows: &[JacobianRow], h: f32) -> Self {
        let inv_mass = |slot: u32| 1.0 / nodes[slot as usize].mass;
        let mut parts = Vec::new();
        for JacobianRow { gradient, compliance } in rows {
            let weight: f32 = gradient.iter().map(|&(slot, of)| inv_mass(slot) * of.length_squared()).sum();
            let share = ratio(1.0, weight + compliance / (h * h));
            parts.extend(gradient.iter().map(|&(slot, of)| {
                let given = of * (share * inv_mass(slot));
                (slot as usize, of.to_array().map(f64::from), given.to_array().map(f64::from))
            }));
        }
        let mut rng = Rng::new(0, 0);
        let mut error = || [(); 2].map(|()| f64::from(rng.range(-1.0, 1.0)));
        let now = nodes.iter().map(|node| if node.mass.is_finite() { error() } else { [0.0; 2] });
        let now: Vec<_> = now.collect();
        Self { before: now.clone(), now, parts, counts: rows.iter().map(|row| row.gradient.len()).collect() }
    }

    /// Whether they grow from substep to substep. What decays, however slowly and however slowly it swings, was larger before.
    fn grow(&mut self) -> bool {
        self.largest(BEGINNING);
        let before = self.largest(SUBSTEPS);
        before > LARGE || self.largest(SUBSTEPS) > GROWTH * before
    }

    /// Their largest size in so many substeps, or as soon as it is large.
    fn largest(&mut self, substeps: usize) -> f64 {
        let mut largest = 0.0;
        for _ in 0..substeps {
            self.substep();
            let size = self.size();
            if size > largest {
                largest = size;
            }
            if largest > LARGE {
                break;
            }
        }
        largest
    }

    /// Root of the mean square.
    fn size(&self) -> f64 {
        let square: f64 = self.now.iter().map(|[x, y]| x * x + y * y).sum();
        (square / self.now.len() as f64).sqrt()
    }

    fn substep(&mut self) {
        let Self { now, before, parts, counts } = self;
        for (now, before) in now.iter_mut().zip(before) {
            (*now, *before) = ([2.0 * now[0] - before[0], 2.0 * now[1] - before[1]], *now);
        }
        let mut rest = &parts[..];
        for &count in &*counts {
            let (row, others) = rest.split_at(count);
            rest = others;
            let error: f64 = row.iter().map(|&(slot, [x, y], _)| x * now[slot][0] + y * now[slot][1]).sum();
            for &(slot, _, [x, y]) in row {
                now[slot] = [now[slot][0] - x * error, now[slot][1] - y * error];
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::TemplateBuilder;
    use super::*;
    use crate::solver::constraint::{Rope, YieldingDistance};

    const H: f32 = 1.0 / 480.0;

    /// Nodes of mass 0.5 on a circle of radius 1.
    fn circle(nodes: u8) -> TemplateBuilder {
        let mut builder = Template::builder();
        let turn = std::f32::consts::TAU / f32::from(nodes);
        (0..nodes).for_each(|k| _ = builder.node(Node::disc(Vec2::from_angle(turn * f32::from(k)), 0.5, 0.1)));
        builder
    }

    /// Links between all pairs of them.
    fn clique(nodes: u8, compliance: f32) -> Template {
        let mut builder = circle(nodes);
        for a in 0..u32::from(nodes) {
            (a + 1..u32::from(nodes)).for_each(|b| _ = builder.link(a, b, compliance));
        }
        builder.build().unwrap()
    }

    fn is_there_and_back(template: &Template) -> bool {
        Projection::new(template, H).constraints.len() > template.constraints().len()
    }

    #[test]
    fn what_makes_energy_is_projected_there_and_back() {
        let [few, many, soft, tight] =
            [(5, 0.0), (6, 0.0), (5, 1e-3), (8, 3e-6)].map(|(n, softness)| clique(n, softness));
        assert_eq!([few, many, soft, tight].each_ref().map(is_there_and_back), [false, true, false, true]);
        assert!(is_there_and_back(&clique(6, 1e-3)), "a light body of it is stiff");
    }

    #[test]
    fn errors_grow_as_the_eigenvalues_of_a_pass_say() {
        // `|p +- sqrt(p^2 - p)|` of the matrix of a pass, by an eigenvalue solver.
        for (nodes, compliance, expected) in
            [(6, 0.0, 1.0761), (8, 0.0, 1.30022), (8, 3e-6, 1.08137), (10, 0.0, 1.4513)]
        {
            let template = clique(nodes, compliance);
            let places: Vec<Vec2> = template.nodes().iter().map(|node| node.position).collect();
            let rows: Vec<JacobianRow> = template.constraints().iter().flat_map(|link| link.rows(&places)).collect();
            let mut errors = Errors::new(template.nodes(), &rows, H);
            (0..400).for_each(|_| errors.substep());
            let before = errors.size();
            (0..400).for_each(|_| errors.substep());
            let growth = libm::log(errors.size() / before) / 400.0;
            assert!((growth - libm::log(expected)).abs() < 1e-4, "{nodes} nodes: {growth}");
        }
    }

    #[test]
    fn what_has_branches_can_take_shapes_that_it_was_not_looked_at_in() {
        let mut star = circle(5);
        (1..5).for_each(|k| _ = star.link(0, k, 0.0));
        let mut chain = circle(5);
        [[0, 3], [1, 4], [3, 2], [4, 0]].into_iter().for_each(|[a, b]| _ = chain.link(a, b, 0.0));
        let mut wheel = circle(5);
        wheel.ring(&[1, 2, 3, 4], 0.0);
        (1..5).for_each(|k| _ = wheel.link(0, k, 0.0));
        let [star, chain, wheel] = [star, chain, wheel].map(|builder| builder.build().unwrap());
        assert_eq!([star, chain, wheel].each_ref().map(is_there_and_back), [true, false, false]);
    }

    #[test]
    fn rigid_links_are_neither_soft_nor_muscles() {
        let mut builder = Template::builder();
        (0..4u8).for_each(|k| _ = builder.node(Node::disc(Vec2::new(f32::from(k), 0.0), 1.0, 0.1)));
        let channel = builder.channel([1.0, 0.5]);
        let link = |a, b, compliance| Distance { a, b, rest_length: 1.0, compliance, damping: 0.0 };
        builder.constraint(YieldingDistance { breaking_strain: 0.5, ..link(0, 1, 1e-3).into() });
        builder
            .constraint(Rope { a: 0, b: 3, max_length: 4.0 })
            .constraint(link(2, 3, 0.0))
            .constraint(link(0, 2, 1e-3));
        builder.muscle(channel, link(1, 2, 0.0)).constraint(link(0, 1, 0.0));
        let template = builder.build().unwrap();
        // There and back: the last node has one link.
        let [first, second] = [link(2, 3, 0.0), link(0, 1, 0.0)].map(Constraint::from);
        assert_eq!(Projection::new(&template, H).rigid_links, [first.clone(), second.clone(), second, first]);
    }

    #[test]
    fn halves_go_there_and_back_and_what_is_scaled_stays_so() {
        let mut builder = circle(7);
        let channel = builder.channel([1.0, 0.9]);
        for (k, [a, b]) in (0..).zip((0..7).flat_map(|a| (a + 1..7).map(move |b| [a, b]))) {
            let link = Distance { a, b, rest_length: 1.0, compliance: 1e-9, damping: 0.0 };
            if k == 3 {
                builder.muscle(channel, link)
            } else {
                builder.constraint(link)
            };
        }
        builder.constraint(Rope { a: 0, b: 3, max_length: 4.0 });
        let template = builder.build().unwrap();
        let Projection { constraints, scaled, .. } = Projection::new(&template, H);
        let all = template.constraints();
        assert_eq!((constraints.len(), &constraints[42]), (43, &all[21]));
        for k in 0..21 {
            assert_eq!((&constraints[k], &constraints[41 - k]), (&all[k].half().unwrap(), &constraints[k]));
        }
        assert_eq!(scaled.iter().map(|scaled| scaled.constraint).collect::<Vec<_>>(), [3, 38]);
        assert_eq!(scaled.iter().map(|scaled| scaled.channel).collect::<Vec<_>>(), [Some(channel); 2]);
    }
}
