//! Pseudopods of a film: where the membrane protrudes, followed from step to step.

use microsim_core::glam::Vec2;

/// Protrusion of a node from which on it belongs to a pseudopod.
const PROTRUDES: f32 = 0.1;
/// Shortest way of a pseudopod, units, and its shortest time, s.
const LEAST_WAY: f32 = 1.0;
const LEAST_TIME: f64 = 0.2;

/// A pseudopod from its start to its end.
#[derive(Clone)]
pub(crate) struct Pseudopod {
    nodes: Vec<usize>,
    start: Vec2,
    end: Vec2,
    time: [f64; 2],
}

impl Pseudopod {
    /// Angle from the way of one to that of the next, degrees; positive to the left.
    pub(crate) fn turn(one: &Self, next: &Self) -> f64 {
        let (a, b) = (one.end - one.start, next.end - next.start);
        f64::from(a.perp_dot(b)).atan2(f64::from(a.dot(b))).to_degrees()
    }

    fn counts(&self) -> bool {
        self.time[1] - self.time[0] >= LEAST_TIME && (self.end - self.start).length() >= LEAST_WAY
    }
}

/// Follows the pseudopods of a cell.
#[derive(Default)]
pub(crate) struct Tracker {
    alive: Vec<Pseudopod>,
    ended: Vec<Pseudopod>,
    counts: Vec<usize>,
}

impl Tracker {
    /// Takes note of the present protrusion of each node of the outline.
    pub(crate) fn note(&mut self, outline: &[Vec2], protrusion: &[f32], time: f64) {
        let arcs = arcs(protrusion);
        self.counts.push(arcs.len());
        let mut before = std::mem::take(&mut self.alive);
        for nodes in arcs {
            let at = nodes.iter().map(|&k| outline[k]).sum::<Vec2>() / nodes.len() as f32;
            let known = before.iter().position(|pod| pod.nodes.iter().any(|k| nodes.contains(k)));
            let began = known.map(|k| before.remove(k));
            let (start, since) = began.map_or((at, time), |pod| (pod.start, pod.time[0]));
            self.alive.push(Pseudopod { nodes, start, end: at, time: [since, time] });
        }
        self.ended.extend(before);
    }

    /// Number of protrusions in each step.
    pub(crate) fn counts(&self) -> &[usize] {
        &self.counts
    }

    /// All pseudopods that have ended, by their start.
    pub(crate) fn pseudopods(&self) -> Vec<Pseudopod> {
        let mut all: Vec<Pseudopod> = self.ended.iter().filter(|pod| pod.counts()).cloned().collect();
        all.sort_by(|a, b| a.time[0].total_cmp(&b.time[0]));
        all
    }
}

/// Arcs of neighbouring nodes that protrude.
fn arcs(protrusion: &[f32]) -> Vec<Vec<usize>> {
    let count = protrusion.len();
    let is_active = |k: usize| protrusion[k % count] > PROTRUDES;
    let firsts = (0..count).filter(|&k| is_active(k) && !is_active(k + count - 1));
    firsts.map(|k| (k..k + count).take_while(|&k| is_active(k)).map(|k| k % count).collect()).collect()
}
