//! How well an engine keeps the cells of a crowd together.

use super::{Quality, contains, mean, raise};
use crate::scene::DT;
use crate::scene::crowd::Crowd;
use microsim_core::glam::Vec2;
use serde::{Deserialize, Serialize};
use std::collections::HashMap;

/// Of the crowd's rows; the numbers of one look, unless stated otherwise.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct CrowdQuality {
    /// Cytoplasm particles outside their own ring, in the end ...
    pub leaks_end: usize,
    /// ... and most of all looks.
    pub leaks_max: usize,
    /// Most discs and particles at once that were inside a strange ring.
    pub intruders_max: usize,
    /// Longest link of a ring ever seen, over its length at rest.
    pub longest_link: f64,
    /// Mean speed of the cells from look to look, units/s.
    pub speed: f64,
    /// Area of the rings over that at the start: mean in the end, and the least ever seen.
    pub area_end: f64,
    pub area_least: f64,
    /// Centres of the rings at the last look, and the sum of the mean ways since the first.
    #[serde(skip)]
    centres: Vec<Vec2>,
    #[serde(skip)]
    way: f64,
    #[serde(skip)]
    steps: u64,
}

impl Quality {
    /// Takes a look at the crowd so many steps after the last one.
    pub(crate) fn look_at_crowd(&mut self, crowd: &Crowd, steps: u64, positions: &[Vec2]) {
        let mut seen = self.crowd.take().unwrap_or_else(|| CrowdQuality { area_least: f64::MAX, ..Default::default() });
        seen.look(crowd, steps, positions);
        self.crowd = Some(seen);
    }
}

impl CrowdQuality {
    fn look(&mut self, crowd: &Crowd, steps: u64, positions: &[Vec2]) {
        let ring_len = crowd.cell.ring.len();
        let cells: Vec<(&[Vec2], &[Vec2])> =
            positions.chunks(crowd.cell.bodies()).map(|cell| cell.split_at(ring_len)).collect();
        let is_outside = |ring: &[Vec2], p: &&Vec2| !contains(ring, **p);
        let outside = |&(ring, inner): &(&[Vec2], &[Vec2])| inner.iter().filter(|p| is_outside(ring, p)).count();
        self.leaks_end = cells.iter().map(outside).sum();
        self.leaks_max = self.leaks_max.max(self.leaks_end);
        self.intruders_max = self.intruders_max.max(intruders(&cells));
        let mut longest = Some(self.longest_link);
        let areas: Vec<f64> = cells.iter().map(|(ring, _)| area(ring) / area(&crowd.cell.ring)).collect();
        for (ring, _) in &cells {
            let link = |k: usize| f64::from(ring[k].distance(ring[(k + 1) % ring_len]) / crowd.cell.link());
            (0..ring_len).for_each(|k| raise(&mut longest, link(k)));
        }
        self.longest_link = longest.unwrap_or_default();
        self.area_end = mean(&areas);
        self.area_least = areas.iter().copied().fold(self.area_least, f64::min);
        self.follow(cells.iter().map(|(ring, _)| middle(ring)).collect(), steps);
    }

    /// Adds the way from the last look to this one.
    fn follow(&mut self, centres: Vec<Vec2>, steps: u64) {
        if !self.centres.is_empty() {
            let ways: Vec<f64> =
                centres.iter().zip(&self.centres).map(|(now, then)| f64::from(now.distance(*then))).collect();
            self.way += mean(&ways);
            self.steps += steps;
            self.speed = self.way / (self.steps as f64 * f64::from(DT));
        }
        self.centres = centres;
    }
}

/// Mean of the discs.
fn middle(ring: &[Vec2]) -> Vec2 {
    ring.iter().sum::<Vec2>() / ring.len() as f32
}

/// Area of the polygon through the discs' centres.
fn area(ring: &[Vec2]) -> f64 {
    let around = (0..ring.len()).map(|k| (ring[k] - ring[0]).perp_dot(ring[(k + 1) % ring.len()] - ring[0]));
    f64::from(around.sum::<f32>()).abs() * 0.5
}

/// Side of the squares by which rings are found, units: about a cell.
const SQUARE: f32 = 16.0;

/// Discs and particles inside a ring that is not theirs.
fn intruders(cells: &[(&[Vec2], &[Vec2])]) -> usize {
    let square = |p: Vec2| ((p.x / SQUARE).floor() as i32, (p.y / SQUARE).floor() as i32);
    let mut rings: HashMap<(i32, i32), Vec<usize>> = HashMap::new();
    for (k, (ring, _)) in cells.iter().enumerate() {
        let (low, high) = ring.iter().fold((ring[0], ring[0]), |(low, high), p| (low.min(*p), high.max(*p)));
        let (low, high) = (square(low), square(high));
        for x in low.0..=high.0 {
            (low.1..=high.1).for_each(|y| rings.entry((x, y)).or_default().push(k));
        }
    }
    let is_intruder = |owner: usize, p: Vec2| {
        let near = rings.get(&square(p)).into_iter().flatten();
        near.copied().any(|k| k != owner && contains(cells[k].0, p))
    };
    let of_cell = |(owner, (ring, inner)): (usize, &(&[Vec2], &[Vec2]))| {
        ring.iter().chain(inner.iter()).filter(|p| is_intruder(owner, **p)).count()
    };
    cells.iter().enumerate().map(of_cell).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn crowd_at_start_is_whole_and_what_moves_is_seen() {
        let crowd = Crowd::new(9);
        let shape = || crowd.cell.ring.iter().chain(&crowd.cell.cytoplasm);
        let mut positions: Vec<Vec2> =
            crowd.centres.iter().flat_map(|centre| shape().map(move |offset| *centre + *offset)).collect();
        let mut quality = Quality::default();
        quality.look_at_crowd(&crowd, 0, &positions);
        let seen = quality.crowd.clone().unwrap();
        assert_eq!((seen.leaks_end, seen.intruders_max), (0, 0));
        assert!((seen.longest_link - 1.0).abs() < 1e-4 && (seen.area_least - 1.0).abs() < 1e-4);
        positions.iter_mut().for_each(|p| p.x += 1.0);
        *positions.last_mut().unwrap() = crowd.centres[0];
        quality.look_at_crowd(&crowd, 60, &positions);
        let seen = quality.crowd.unwrap();
        assert_eq!((seen.leaks_end, seen.leaks_max, seen.intruders_max), (1, 1, 1));
        assert!((seen.speed - 1.0).abs() < 1e-3, "{seen:?}");
    }
}
