//! Safety net against rings that cross themselves. Nodes keep apart as discs do, which is enough unless a cell is overfull
//! and pressed against something: then a fold of a few links can be squeezed so thin that its sides cross. Nodes between
//! two crossing links that are a few links apart are put on a straight line.

use super::contact::shift;
use super::lanes::{LANES, load};
use crate::geometry::segment::{folds_back, segments_touch};
use crate::instruction_set::each;
use crate::particle::Particles;
use glam::Vec2;

/// Links that are at most this many links apart are looked at.
const FARTHEST: usize = 12;

/// A node farther away than this, in its radii, is broken: more than the links looked at reach when stretched to their limit.
const BROKEN: f32 = 40.0;
/// Most rounds: straightened links may cross the next ones.
const ROUNDS: usize = 4;

/// Straightens the ring between each two links that cross, a few links apart. Leaves in `outline` where its nodes are, and
/// returns the number of crossings. `midpoints` is scratch.
pub(crate) fn untangle(ring: &[u32], p: &mut Particles, outline: &mut Vec<Vec2>, midpoints: &mut Midpoints) -> u32 {
    let mut crossings = 0;
    read(ring, p, outline, midpoints);
    for _ in 0..ROUNDS {
        let before = crossings;
        for first in 0..ring.len() {
            if let Some(apart) = crossed_by(outline, midpoints, first)
                && straighten(ring, first, apart + 1, p)
            {
                crossings += 1;
                read(ring, p, outline, midpoints);
            }
        }
        if crossings == before {
            break;
        }
    }
    crossings
}

/// Whether [`untangle`] would find a crossing. Leaves in `outline` where the nodes are.
pub(crate) fn is_tangled(ring: &[u32], p: &Particles, outline: &mut Vec<Vec2>, midpoints: &mut Midpoints) -> bool {
    read(ring, p, outline, midpoints);
    (0..ring.len()).any(|first| crossed_by(outline, midpoints, first).is_some())
}

fn read(ring: &[u32], p: &Particles, outline: &mut Vec<Vec2>, midpoints: &mut Midpoints) {
    outline.clear();
    outline.extend(ring.iter().map(|&node| p.position(node as usize)));
    midpoints.read(outline);
}

/// How many links later the first one comes that a link crosses, if one does.
fn crossed_by(outline: &[Vec2], midpoints: &Midpoints, first: usize) -> Option<usize> {
    // The way between the two links that cross is the shorter one.
    let farthest = FARTHEST.min((outline.len() / 2).saturating_sub(1));
    let last = if midpoints.any_near(first, farthest) { farthest } else { farthest.min(1) };
    (1..=last).find(|&apart| cross(outline, first, apart))
}

/// The middle of each link, and of the first ones once more after the last, so that the next links lie side by side.
#[derive(Default)]
pub(crate) struct Midpoints {
    x: Vec<f32>,
    y: Vec<f32>,
    /// Squared length of the longest link, and some more for rounding.
    longest_squared: f32,
}

impl Midpoints {
    fn read(&mut self, outline: &[Vec2]) {
        let Self { x, y, longest_squared } = self;
        x.clear();
        y.clear();
        *longest_squared = 0.0;
        for (a, b) in outline.iter().zip(outline.iter().cycle().skip(1)) {
            x.push(0.5 * (a.x + b.x));
            y.push(0.5 * (a.y + b.y));
            let squared = 1.001 * a.distance_squared(*b);
            *longest_squared = if squared > *longest_squared { squared } else { *longest_squared };
        }
        for column in [x, y] {
            (0..FARTHEST + LANES).for_each(|k| column.extend(column.get(k).copied()));
        }
    }

    /// Whether any link that is two to `farthest` links later, or a few more, is so near that a link may touch it: their
    /// middles are apart by half of both lengths at most.
    fn any_near(&self, first: usize, farthest: usize) -> bool {
        let mut least = f32::INFINITY;
        for k in (first + 2..=first + farthest).step_by(LANES) {
            let (x, y) = (load::<LANES>(&self.x, k), load::<LANES>(&self.y, k));
            let (x, y) = (each::<LANES>(|l| x[l] - self.x[first]), each::<LANES>(|l| y[l] - self.y[first]));
            let squared = each::<LANES>(|l| x[l] * x[l] + y[l] * y[l]);
            least = squared.into_iter().fold(least, |least, squared| if squared < least { squared } else { least });
        }
        least <= self.longest_squared
    }
}

/// Whether a link crosses, or folds back onto, the one `apart` links later.
fn cross(outline: &[Vec2], first: usize, apart: usize) -> bool {
    let at = |k: usize| outline[if k < outline.len() { k } else { k - outline.len() }];
    let (a, b, c, d) = (at(first), at(first + 1), at(first + apart), at(first + apart + 1));
    if apart == 1 { folds_back(a, b, d) } else { segments_touch(a, b, c, d) }
}

/// Puts the nodes between two of a ring evenly on the line between those, unless one is so far away that it is broken: such
/// organisms are for quarantine.
fn straighten(ring: &[u32], first: usize, count: usize, p: &mut Particles) -> bool {
    let position = |k: usize| p.position(ring[k % ring.len()] as usize);
    let (from, to) = (position(first), position(first + count));
    let way = |k: usize| from + (to - from) * (k as f32 / count as f32) - position(first + k);
    let moves: Vec<_> = (1..count).map(|k| (ring[(first + k) % ring.len()] as usize, way(k))).collect();
    let is_sound = moves.iter().all(|&(i, way)| way.length() < BROKEN * p.radius[i]);
    if is_sound {
        for (i, way) in moves {
            shift(p, i, way);
        }
    }
    is_sound
}

#[cfg(test)]
mod tests {
    use super::super::testing::disc;
    use super::*;
    use crate::geometry::polygon::is_simple;
    use crate::rng::Rng;
    use proptest::prelude::*;

    fn ring_of(points: &[Vec2]) -> (Vec<u32>, Particles) {
        let mut p = Particles::default();
        let ring = points.iter().map(|&at| p.insert(&disc(at, 1.0))).collect();
        (ring, p)
    }

    fn untangle(ring: &[u32], p: &mut Particles) -> u32 {
        let mut seen = Vec::new();
        let crossings = super::untangle(ring, p, &mut seen, &mut Midpoints::default());
        assert_eq!(format!("{seen:?}"), format!("{:?}", outline(ring, p)));
        crossings
    }

    fn outline(ring: &[u32], p: &Particles) -> Vec<Vec2> {
        ring.iter().map(|&node| p.position(node as usize)).collect()
    }

    /// A square of 24 links, and what is done to some of its nodes.
    fn square(moved: &[(usize, [f32; 2])]) -> Vec<Vec2> {
        let corners = [[0.0, 0.0], [6.0, 0.0], [6.0, 6.0], [0.0, 6.0]].map(Vec2::from);
        let point = |k: usize| corners[k / 6].lerp(corners[(k / 6 + 1) % 4], (k % 6) as f32 / 6.0);
        let mut points: Vec<Vec2> = (0..24).map(point).collect();
        moved.iter().for_each(|&(k, at)| points[k] = at.into());
        points
    }

    #[test]
    fn links_that_cross_a_few_links_apart_are_straightened() {
        for moved in [
            // A fold whose sides cross; two nodes in the wrong order on their line; a node behind its predecessor; a loop
            // of five links; one across the ring's first node.
            &[(2, [3.5, 1.0]), (3, [2.5, 1.0])][..],
            &[(2, [3.0, 0.0]), (3, [2.0, 0.0])],
            &[(3, [1.5, 0.0])],
            &[(2, [3.6, 0.4]), (3, [3.0, 1.5]), (4, [2.4, 0.4])],
            &[(23, [0.0, -1.0]), (0, [0.0, 1.5])],
        ] {
            let points = square(moved);
            assert!(!is_simple(&points), "{moved:?}");
            let (ring, mut p) = ring_of(&points);
            assert!(untangle(&ring, &mut p) > 0);
            assert!(is_simple(&outline(&ring, &p)), "{moved:?}: {:?}", outline(&ring, &p));
            assert_eq!(untangle(&ring, &mut p), 0);
        }
    }

    #[test]
    fn broken_rings_are_left_to_quarantine() {
        for far in [50.0, 300.0, f32::NAN, f32::INFINITY] {
            let (ring, mut p) = ring_of(&square(&[(2, [1.0, -far]), (3, [0.9, 1.0])]));
            let before = outline(&ring, &p);
            assert_eq!(untangle(&ring, &mut p), 0);
            assert_eq!(format!("{before:?}"), format!("{:?}", outline(&ring, &p)), "{far}");
        }
    }

    #[test]
    fn small_rings_are_looked_at_too() {
        let (ring, mut p) = ring_of(&[[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]].map(Vec2::from));
        assert_eq!(untangle(&ring, &mut p), 0);
        assert_eq!(untangle(&ring[..3], &mut p), 0);
        assert_eq!(untangle(&[], &mut p), 0);
    }

    #[test]
    fn links_whose_middles_are_far_apart_do_not_touch() {
        let (mut rng, mut midpoints, mut far, mut near) = (Rng::new(5, 2), Midpoints::default(), 0, 0);
        for count in [3_usize, 5, 12, 44] {
            for _ in 0..500 {
                let mut noise = || Vec2::new(rng.range(-1.0, 1.0), rng.range(-1.0, 1.0));
                let points: Vec<Vec2> = (0..count).map(|k| Vec2::from_angle(k as f32 / 7.0) * 7.0 + noise()).collect();
                let farthest = FARTHEST.min((count / 2).saturating_sub(1));
                midpoints.read(&points);
                for first in 0..count {
                    let crosses = (2..=farthest).any(|apart| cross(&points, first, apart));
                    let is_near = midpoints.any_near(first, farthest);
                    assert!(is_near || !crosses, "{points:?}, link {first}");
                    (far, near) = (far + u32::from(!is_near), near + u32::from(crosses));
                }
            }
        }
        assert!(far > 1000 && near > 300, "{far} far, {near} near");
    }

    proptest! {
        #[test]
        fn a_ring_that_does_not_cross_itself_stays_as_it_is(
            points in crate::geometry::arbitrary::star_polygon()
        ) {
            prop_assume!(is_simple(&points));
            let (ring, mut p) = ring_of(&points);
            prop_assert_eq!(untangle(&ring, &mut p), 0);
            prop_assert_eq!(outline(&ring, &p), points);
        }
    }
}
