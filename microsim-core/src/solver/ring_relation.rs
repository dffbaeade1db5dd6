//! Where a disc is with respect to the links of a ring, eight neighbouring links at a time.

use super::lanes::{LANES, load, ratio};
use crate::collision::ring::{FoundLink, Link, RingSide};
use crate::instruction_set::each;
use crate::particle::{Particles, PositionCells};
use glam::Vec2;

/// Where a disc is with respect to a link.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Relation {
    /// Place of the nearest point on the link, 0 at its first node and 1 at its second.
    pub t: f32,
    /// From the nearest point to the disc.
    pub away: Vec2,
    pub squared: f32,
    /// From the link's first node to its second.
    along: Vec2,
}

impl Relation {
    #[inline(always)]
    pub(super) fn of(particle: u32, link: Link, p: &Particles) -> Self {
        let [disc, a, b] = [particle, link.a, link.b].map(|i| i as usize);
        let (along, from_a) = (p.between(a, b), p.between(a, disc));
        let (place, squared_length) = (from_a.dot(along), along.length_squared());
        // At an end, relative to that end exactly, so that both links of a node find the same distance.
        let (t, away) = if place > 0.0 && place < squared_length {
            let t = place / squared_length;
            (t, from_a - along * t)
        } else if place > 0.0 {
            (1.0, p.between(b, disc))
        } else {
            (0.0, from_a)
        };
        Self { t, away, squared: away.length_squared(), along }
    }

    /// Whether this is the wrong side for a disc that has to stay on `side`.
    #[inline(always)]
    pub(super) fn is_wrong(&self, side: RingSide) -> bool {
        match side {
            RingSide::Inside => self.signed_height() < 0.0,
            RingSide::Outside => self.signed_height() > 0.0,
            RingSide::Either => false,
        }
    }

    /// Unit vector across the link, to that side.
    #[inline(always)]
    pub(super) fn to_side(self, side: RingSide) -> Vec2 {
        let length = self.squared.sqrt();
        if length > 1e-6 {
            let away = self.away / length;
            if self.is_wrong(side) { -away } else { away }
        } else if side == RingSide::Inside {
            self.inwards()
        } else {
            -self.inwards()
        }
    }

    /// Whether this link is nearer than another one. Ends of two links in the same node are equally far; then the more
    /// orthogonal link wins.
    #[inline(always)]
    pub(super) fn is_nearer_than(&self, other: &Self) -> bool {
        self.squared < other.squared || (self.squared == other.squared && self.height().abs() > other.height().abs())
    }

    /// Unit vector across the link, to the inside.
    #[inline(always)]
    fn inwards(&self) -> Vec2 {
        self.along.perp() * ratio(1.0, self.along.length())
    }

    /// Something with the sign of [`Relation::height`]; without its root and division, unless their roundings might matter:
    /// each summand of the height has three, together below 3e-7 of it.
    #[inline(always)]
    fn signed_height(&self) -> f32 {
        let across = self.along.perp();
        let (x, y) = (across.x * self.away.x, across.y * self.away.y);
        let (sum, most) = (x + y, x.abs() + y.abs());
        let is_clear = sum.abs() > 1e-6 * most && sum.abs() > 1e-12 && most < 1e12;
        if is_clear { sum } else { self.height() }
    }

    /// Sine of the angle between link and way, positive inside, times the way's length.
    #[inline(always)]
    pub(super) fn height(&self) -> f32 {
        self.inwards().dot(self.away)
    }
}

/// The nodes of a ring side by side, and the first ones once more after the last, so that eight links can be read from any
/// one on.
#[derive(Debug, Default)]
pub(super) struct RingNodes {
    origin_x: Vec<f32>,
    origin_y: Vec<f32>,
    x: Vec<f32>,
    y: Vec<f32>,
    count: usize,
}

impl RingNodes {
    /// Reads where the nodes are.
    #[inline(always)]
    pub(super) fn read(&mut self, nodes: &[u32], p: PositionCells<'_>) {
        let Self { origin_x, origin_y, x, y, count } = self;
        *count = nodes.len();
        for own in [&mut *origin_x, origin_y, x, y] {
            own.clear();
        }
        for &node in nodes {
            let (origin, offset) = (p.origin(node as usize), p.offset(node as usize));
            origin_x.push(origin.x);
            origin_y.push(origin.y);
            x.push(offset.x);
            y.push(offset.y);
        }
        for own in [origin_x, origin_y, x, y] {
            while own.len() < nodes.len() + LANES {
                let missing = nodes.len() + LANES - own.len();
                own.extend_from_within(..missing.min(nodes.len()));
            }
        }
    }

    /// Notes where the nodes of a link are now.
    #[inline(always)]
    pub(super) fn update(&mut self, FoundLink { link, place }: FoundLink, p: PositionCells<'_>) {
        let first = place as usize;
        self.set(first, link.a as usize, p);
        self.set(if first + 1 < self.count { first + 1 } else { 0 }, link.b as usize, p);
    }

    #[inline(always)]
    fn set(&mut self, first: usize, node: usize, p: PositionCells<'_>) {
        let (mut k, offset) = (first, p.offset(node));
        while k < self.x.len() {
            (self.x[k], self.y[k]) = (offset.x, offset.y);
            k += self.count;
        }
    }
}

/// More than eight links away from every place in a ring.
const NONE: usize = usize::MAX / 2;

/// The relations of a disc to the links of a ring, found eight at a time.
pub(super) struct Relations {
    /// The first of the eight links in the ring, or [`NONE`].
    first: usize,
    t: [f32; LANES],
    away: [[f32; LANES]; 2],
    squared: [f32; LANES],
    along: [[f32; LANES]; 2],
}

impl Relations {
    /// None yet.
    #[inline(always)]
    pub(super) fn unknown() -> Self {
        let none = [0.0; LANES];
        Self { first: NONE, t: none, away: [none; 2], squared: none, along: [none; 2] }
    }

    /// Forgets them: disc or nodes have moved.
    #[inline(always)]
    pub(super) fn forget(&mut self) {
        self.first = NONE;
    }

    /// The squared distance of a disc from link `k`.
    #[inline(always)]
    pub(super) fn squared(&mut self, k: usize, disc: usize, nodes: &RingNodes, p: PositionCells<'_>) -> f32 {
        let lane = self.find(k, disc, nodes, p);
        self.squared[lane]
    }

    /// The relation of a disc to link `k`.
    #[inline(always)]
    pub(super) fn to(&mut self, k: usize, disc: usize, nodes: &RingNodes, p: PositionCells<'_>) -> Relation {
        let lane = self.find(k, disc, nodes, p);
        Relation {
            t: self.t[lane],
            away: Vec2::new(self.away[0][lane], self.away[1][lane]),
            squared: self.squared[lane],
            along: Vec2::new(self.along[0][lane], self.along[1][lane]),
        }
    }

    /// The lane of link `k`, which is found first unless it is among the eight that are known.
    #[inline(always)]
    fn find(&mut self, k: usize, disc: usize, nodes: &RingNodes, p: PositionCells<'_>) -> usize {
        let lane = k.wrapping_sub(self.first);
        if lane < LANES {
            return lane;
        }
        // Links from the first node on come once more after the last one.
        let lane = lane.wrapping_add(nodes.count);
        if lane < LANES {
            return lane;
        }
        self.first = k;
        let RingNodes { origin_x, origin_y, x, y, .. } = nodes;
        let (along_x, along_y) = (along(origin_x, x, k), along(origin_y, y, k));
        let (origin, offset) = (p.origin(disc), p.offset(disc));
        let (here_x, here_y) = ([origin.x, offset.x], [origin.y, offset.y]);
        let (a_x, a_y) = (from_nodes(origin_x, x, k, here_x), from_nodes(origin_y, y, k, here_y));
        let (b_x, b_y) = (from_nodes(origin_x, x, k + 1, here_x), from_nodes(origin_y, y, k + 1, here_y));
        let place = each::<LANES>(|l| a_x[l] * along_x[l] + a_y[l] * along_y[l]);
        let length = each::<LANES>(|l| along_x[l] * along_x[l] + along_y[l] * along_y[l]);
        let part = each::<LANES>(|l| place[l] / length[l]);
        // Chosen by one comparison after the other: both at once would not become vector instructions.
        let at_second = each::<LANES>(|l| if place[l] < length[l] { part[l] } else { 1.0 });
        self.t = each::<LANES>(|l| if place[l] > 0.0 { at_second[l] } else { 0.0 });
        let between_x = each::<LANES>(|l| a_x[l] - along_x[l] * part[l]);
        let between_y = each::<LANES>(|l| a_y[l] - along_y[l] * part[l]);
        let second_x = each::<LANES>(|l| if place[l] < length[l] { between_x[l] } else { b_x[l] });
        let second_y = each::<LANES>(|l| if place[l] < length[l] { between_y[l] } else { b_y[l] });
        let away_x = each::<LANES>(|l| if place[l] > 0.0 { second_x[l] } else { a_x[l] });
        let away_y = each::<LANES>(|l| if place[l] > 0.0 { second_y[l] } else { a_y[l] });
        self.squared = each::<LANES>(|l| away_x[l] * away_x[l] + away_y[l] * away_y[l]);
        (self.away, self.along) = ([away_x, away_y], [along_x, along_y]);
        0
    }
}

/// From each of eight nodes to a place, given by origin and offset, in one coordinate.
#[inline(always)]
fn from_nodes(origins: &[f32], offsets: &[f32], first: usize, [origin, offset]: [f32; 2]) -> [f32; LANES] {
    let (origins, offsets) = (load::<LANES>(origins, first), load::<LANES>(offsets, first));
    each::<LANES>(|l| (origin - origins[l]) + (offset - offsets[l]))
}

/// From each of eight nodes to the next one, in one coordinate.
#[inline(always)]
fn along(origins: &[f32], offsets: &[f32], first: usize) -> [f32; LANES] {
    let (origin_a, origin_b) = (load::<LANES>(origins, first), load::<LANES>(origins, first + 1));
    let (a, b) = (load::<LANES>(offsets, first), load::<LANES>(offsets, first + 1));
    each::<LANES>(|l| (origin_b[l] - origin_a[l]) + (b[l] - a[l]))
}

#[cfg(test)]
mod tests {
    use super::super::testing::disc;
    use super::*;
    use crate::particle::Particle;
    use crate::rng::Rng;

    #[test]
    fn the_quick_sign_of_a_height_is_that_of_the_height() {
        let (mut rng, mut close) = (Rng::new(3, 9), 0);
        for k in 0..200_000 {
            let mut vector = || Vec2::new(rng.range(-1.0, 1.0), rng.range(-1.0, 1.0));
            let (along, aside) = (vector(), vector());
            // Every other way is along the link, but for a few roundings.
            let away = if k % 2 == 0 { aside } else { along * aside.x + aside * 1e-7 };
            let relation = Relation { t: 0.0, away, squared: away.length_squared(), along };
            let (quick, exact) = (relation.signed_height(), relation.height());
            assert_eq!((quick < 0.0, quick > 0.0), (exact < 0.0, exact > 0.0), "{relation:?}");
            close += u32::from(exact.abs() < 1e-6);
        }
        assert!(close > 10_000, "{close}");
        let gone = Relation { t: 0.0, away: Vec2::ONE, squared: 2.0, along: Vec2::new(1e-25, 0.0) };
        assert_eq!((gone.signed_height(), gone.height()), (0.0, 0.0));
    }

    #[test]
    fn eight_links_at_a_time_give_the_bits_of_one() {
        let mut rng = Rng::new(8, 1);
        for count in [3, 5, 8, 40] {
            let mut particles = Particles::default();
            let mut place = || {
                let origin = Vec2::new(rng.range(0.0, 900.0).floor(), rng.range(0.0, 90.0).floor());
                let offset = Vec2::new(rng.range(-2.0, 2.0), rng.range(-2.0, 2.0));
                particles.insert(&Particle { origin, offset, ..disc(origin, 1.0) })
            };
            let ring: Vec<u32> = (0..count).map(|_| place()).collect();
            let stray = place();
            // One of two nodes in the same place, and a disc that is on a node.
            (particles.x[0], particles.origin_x[0]) = (particles.x[1], particles.origin_x[1]);
            (particles.y[0], particles.origin_y[0]) = (particles.y[1], particles.origin_y[1]);
            let mut nodes = RingNodes::default();
            nodes.read(&ring, particles.position_cells());
            particles.x[ring[0] as usize] += 0.5;
            nodes.update(
                FoundLink { link: Link { a: ring[count - 1], b: ring[0] }, place: count as u32 - 1 },
                particles.position_cells(),
            );
            for particle in [stray, ring[2]] {
                let mut relations = Relations::unknown();
                // From the last links on to the first ones, too.
                for k in (count - 2..count).chain(0..count) {
                    let link = Link { a: ring[k], b: ring[(k + 1) % count] };
                    let alone = Relation::of(particle, link, &particles);
                    let found = relations.to(k, particle as usize, &nodes, particles.position_cells());
                    assert_eq!(found, alone, "link {k} of {count}");
                }
            }
        }
    }
}
