//! Running the engines side by side: every engine takes its turn in every repeat, so that what else the machine does
//! meets all of them.

use crate::Scene;
use crate::engines::{Clock, ENGINES, Engine, Peer};
use crate::quality::Quality;
use crate::scene::crowd::Crowd;
use crate::scene::{DISCS, FluidBlock, PlateletField};
use cpu_time::ThreadTime;
use microsim_core::glam::Vec2;
use serde::{Deserialize, Serialize};
use std::time::Instant;

/// One engine in one scene.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) struct Row {
    pub scene: Scene,
    /// Platelets, particles or cells.
    pub count: usize,
    /// Discs that move, or particles.
    pub bodies: usize,
    pub engine: String,
    /// Median over the repeats of their medians, ms per step.
    pub ms_median: f64,
    /// Of all steps of all repeats.
    pub ms_p99: f64,
    /// Median of the first engine's time over this one's, each within the same repeat: how much slower than ours.
    pub times_microsim: f64,
    /// Peak of the memory that a process of its own takes for this scene, bytes per body.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub bytes_per_body: Option<f64>,
    pub quality: Quality,
}

/// How long to look.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Plan {
    /// Steps before measuring.
    pub warm_up: u64,
    pub repeats: usize,
    /// Steps of each engine in each repeat.
    pub steps: u64,
    /// Steps after the pushers went back, before the return to the anchors is measured; 0: it is not.
    pub rest: u64,
}

/// An engine's world, and what has been seen of it.
struct Contestant {
    engine: &'static Engine,
    peer: Box<dyn Peer>,
    step: u64,
    /// Times of the steps of each repeat, ms.
    repeats: Vec<Vec<f64>>,
    quality: Quality,
}

impl Contestant {
    fn new(engine: &'static Engine, peer: Box<dyn Peer>) -> Self {
        Self { engine, peer, step: 0, repeats: Vec::new(), quality: Quality::default() }
    }

    /// Time of one step, ms.
    fn step(&mut self, goals: &[Vec2]) -> f64 {
        self.step += 1;
        let spent = match self.engine.clock {
            Clock::Thread => {
                let begin = ThreadTime::now();
                self.peer.step(goals);
                begin.elapsed()
            }
            Clock::Wall => {
                let begin = Instant::now();
                self.peer.step(goals);
                begin.elapsed()
            }
        };
        spent.as_secs_f64() * 1e3
    }

    fn row(self, scene: Scene, count: usize, bodies: usize, ours: &[f64]) -> Row {
        let medians: Vec<f64> = self.repeats.iter().map(|times| quantile(times, 0.5)).collect();
        let ratios: Vec<f64> = medians.iter().zip(ours).map(|(theirs, ours)| theirs / ours).collect();
        Row {
            scene,
            count,
            bodies,
            engine: self.engine.name.to_owned(),
            ms_median: quantile(&medians, 0.5),
            ms_p99: quantile(&self.repeats.concat(), 0.99),
            times_microsim: quantile(&ratios, 0.5),
            bytes_per_body: None,
            quality: self.quality,
        }
    }
}

/// The value below which this share of the values lies.
fn quantile(values: &[f64], share: f64) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_unstable_by(f64::total_cmp);
    let at = share * (sorted.len() - 1) as f64;
    let (low, high) = (sorted[at.floor() as usize], sorted[at.ceil() as usize]);
    low + (high - low) * at.fract()
}

/// Runs a scene in the engines that have it and whose names contain `name`, and in ours.
pub(crate) fn run(scene: Scene, count: usize, plan: Plan, name: &str) -> Vec<Row> {
    let engines = ENGINES.iter().filter(|engine| engine.is_microsim() || engine.name.contains(name));
    match scene {
        Scene::Platelets => platelets(engines, &PlateletField::new(count), plan),
        Scene::Fluid => fluid(engines, &FluidBlock::new(count), plan),
        Scene::Crowd => crowd(engines, &Crowd::new(count), plan),
    }
}

fn platelets(engines: impl Iterator<Item = &'static Engine>, field: &PlateletField, plan: Plan) -> Vec<Row> {
    let build = |engine: &'static Engine| Some(Contestant::new(engine, engine.platelets?(field)));
    let mut contestants: Vec<Contestant> = engines.filter_map(build).collect();
    for contestant in &mut contestants {
        for _ in 0..plan.warm_up {
            contestant.step(&field.goals(contestant.step));
        }
    }
    for repeat in 0..plan.repeats {
        in_turn(&mut contestants, repeat, |contestant| {
            let times = (0..plan.steps).map(|_| contestant.step(&field.goals(contestant.step))).collect();
            contestant.repeats.push(times);
            contestant.quality.look_at_field(field, &contestant.peer.positions());
        });
    }
    for contestant in contestants.iter_mut().filter(|_| plan.rest > 0) {
        (0..plan.rest).for_each(|_| _ = contestant.step(&field.parked()));
        contestant.quality.look_at_rest(field, &contestant.peer.positions());
    }
    rows(contestants, Scene::Platelets, field.centres.len(), field.centres.len() * DISCS)
}

/// The repeats are stretches of the fluid's way to rest.
fn fluid(engines: impl Iterator<Item = &'static Engine>, block: &FluidBlock, plan: Plan) -> Vec<Row> {
    let count = block.points.len();
    let build = |engine: &'static Engine| {
        let build = engine.fluid.filter(|_| count <= engine.most_fluid)?;
        Some(Contestant::new(engine, build(block)))
    };
    let mut contestants: Vec<Contestant> = engines.filter_map(build).collect();
    for contestant in &mut contestants {
        (0..plan.warm_up).for_each(|_| _ = contestant.step(&[]));
    }
    for repeat in 0..plan.repeats {
        in_turn(&mut contestants, repeat, |contestant| {
            let mut times: Vec<f64> = (1..plan.steps).map(|_| contestant.step(&[])).collect();
            let before = contestant.peer.positions();
            times.push(contestant.step(&[]));
            contestant.repeats.push(times);
            contestant.quality.look_at_fluid(block, &before, &contestant.peer.positions());
        });
    }
    rows(contestants, Scene::Fluid, count, count)
}

fn crowd(engines: impl Iterator<Item = &'static Engine>, crowd: &Crowd, plan: Plan) -> Vec<Row> {
    let build = |engine: &'static Engine| Some(Contestant::new(engine, engine.crowd?(crowd)));
    let mut contestants: Vec<Contestant> = engines.filter_map(build).collect();
    for contestant in &mut contestants {
        (0..plan.warm_up).for_each(|_| _ = contestant.step(&crowd.directions(contestant.step)));
        contestant.quality.look_at_crowd(crowd, plan.warm_up, &contestant.peer.positions());
    }
    for repeat in 0..plan.repeats {
        in_turn(&mut contestants, repeat, |contestant| {
            let times = (0..plan.steps).map(|_| contestant.step(&crowd.directions(contestant.step))).collect();
            contestant.repeats.push(times);
            contestant.quality.look_at_crowd(crowd, plan.steps, &contestant.peer.positions());
        });
    }
    let cells = crowd.centres.len();
    rows(contestants, Scene::Crowd, cells, cells * crowd.cell.bodies())
}

/// Each once, another one first in each repeat.
fn in_turn(contestants: &mut [Contestant], repeat: usize, mut action: impl FnMut(&mut Contestant)) {
    let count = contestants.len();
    (0..count).for_each(|k| action(&mut contestants[(k + repeat) % count]));
}

fn rows(contestants: Vec<Contestant>, scene: Scene, count: usize, bodies: usize) -> Vec<Row> {
    let ours: Vec<f64> = contestants[0].repeats.iter().map(|times| quantile(times, 0.5)).collect();
    contestants.into_iter().map(|contestant| contestant.row(scene, count, bodies, &ours)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_lie_between_their_neighbours() {
        let values = [4.0, 1.0, 3.0, 2.0];
        assert_eq!(quantile(&values, 0.5), 2.5);
        assert_eq!(quantile(&values, 1.0), 4.0);
        assert_eq!(quantile(&[7.0], 0.99), 7.0);
    }

    /// Every engine gets through its scenes, and what is measured of it is sound.
    #[test]
    fn every_engine_runs_and_is_measured() {
        let plan = Plan { warm_up: 2, repeats: 2, steps: 3, rest: 2 };
        let scenes = [(Scene::Platelets, 12), (Scene::Fluid, 400), (Scene::Crowd, 4)];
        let rows = scenes.map(|(scene, count)| run(scene, count, plan, "")).concat();
        assert!(rows.len() >= 11, "{} rows", rows.len());
        for row in rows {
            assert!(row.ms_median > 0.0 && row.ms_p99 >= row.ms_median, "{row:?}");
            match row.scene {
                Scene::Platelets => assert!(row.quality.ring_error_max.unwrap() < 0.5, "{row:?}"),
                Scene::Fluid => assert_eq!(row.quality.lost, Some(0), "{row:?}"),
                Scene::Crowd => {
                    let crowd = row.quality.crowd.as_ref().unwrap();
                    assert!(crowd.leaks_max == 0 && crowd.longest_link < 1.5 && crowd.speed > 0.1, "{row:?}");
                }
            }
        }
    }
}
