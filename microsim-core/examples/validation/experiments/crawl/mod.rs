//! Crawling by pseudopods: shape and statistics of a cell in an open field.

mod pseudopods;
mod silhouette;

use super::scene::{Stepping, mean};
use super::{Experiment, Order, Outcome, Row};
use microsim_core::glam::Vec2;
use microsim_core::{
    AmoeboidCellSpec, Controller, Crawl, Error, Inputs, Intent, OrganismId, PersistentWalkParams, Placement, World,
    WorldConfig,
};
use pseudopods::{Pseudopod, Tracker};
use silhouette::Silhouette;

pub(crate) const EXPERIMENT: Experiment = Experiment {
    name: "crawl",
    title: "Crawling by pseudopods",
    source: "angle and order of splits: Bosgraaf and Van Haastert 2009, PLoS ONE 4, e5253 (some 2000 pseudopodia); area and \
             solidity: masks of T98G cells in phase contrast (Tsai et al. 2019, SoftwareX 9, 230); what has no number there is \
             what is asked of a cell that is to look alive and to obey",
    words: "A cell of radius 7.6 walks about in an open field for 30 s at 5 units/s, each number the mean of six seeds. Outlines \
            are compared in the cell's own frame, not rotated: area of the intersection over that of the union. A pseudopod is \
            followed from where its part of the membrane begins to protrude to where it ends; that is its direction. A split \
            is within 100° of the last one. Angles, shares and sides at the start are parameters of the type.",
    run: measure,
    order: Order::None("statistical, and no exact value is known"),
};

/// Speed of the cell, units/s, and its radius.
const SPEED: f32 = 5.0;
const RADIUS: f32 = 7.6;
/// Time before measuring, and between two silhouettes, s.
const START: f32 = 2.0;
const FRAME: f32 = 0.1;
/// Largest angle between pseudopods of which the second splits off the first, degrees.
const SPLIT: f64 = 100.0;

/// Figures of one cell.
#[derive(Clone, Copy, Default)]
pub(crate) struct Figures {
    /// Standard deviation of the area over its mean.
    pub area_cv: f64,
    pub solidity: f64,
    /// Overlap with itself after each of [`LAGS`].
    pub overlaps: [f64; 4],
    /// Share of the time in which there are one to three pseudopods.
    pub one_to_three: f64,
    /// Mean time between two starts, s.
    pub interval: f64,
    /// Mean angle of splits, degrees, their share and that of splits on the other side than the one before.
    pub split_angle: f64,
    pub split_share: f64,
    pub alternation: f64,
    /// Speed along the path over the cell's.
    pub speed: f64,
    /// Largest share of its area that nothing covers.
    pub voids: f64,
    pub leaks: usize,
}

impl Figures {
    fn per_radius(&self) -> f64 {
        f64::from(RADIUS / SPEED) / self.interval
    }
}

/// Times after which a silhouette is compared with itself, s.
pub(crate) const LAGS: [f32; 4] = [0.2, 1.0, 3.0, 9.0];

fn room(seed: u64) -> WorldConfig {
    let room = Stepping::DEFAULT.room(Vec2::new(300.0, 300.0), 0.0);
    WorldConfig { damping: 3.0, max_speed: 20.0, seed, ..room }
}

pub(crate) fn cell(crawl: Crawl) -> AmoeboidCellSpec {
    AmoeboidCellSpec { radii: Vec2::splat(RADIUS), node_radius: 0.45, speed: SPEED, crawl, ..Default::default() }
}

/// Walks about for 30 s.
pub(crate) fn figures(spec: &AmoeboidCellSpec, seed: u64) -> Result<Figures, Error> {
    let mut world = World::new(room(seed))?;
    let walk = Controller::persistent_walk(PersistentWalkParams { persistence: 4.0 });
    let cell = world.spawn(&spec.clone().into(), Placement::at(150.0, 150.0).steered_by(walk))?;
    let (mut silhouettes, mut tracker, mut leaks, mut voids) = (Vec::new(), Tracker::default(), 0, 0.0);
    while world.time() < f64::from(START) + 30.0 {
        world.step(&Inputs::new());
        if world.time() < f64::from(START) {
            continue;
        }
        let outline = outline(&world, cell);
        tracker.note(&outline, &protrusion(&world, cell), world.time());
        let frames = ((world.time() - f64::from(START)) / f64::from(FRAME)) as usize;
        if frames >= silhouettes.len() {
            silhouettes.push(Silhouette::of(&outline, 2.5 * RADIUS));
            leaks += world.census().leaks;
            voids = f64::max(voids, world.membrane_quality(cell).map_or(0.0, |quality| f64::from(quality.voids)));
        }
    }
    Ok(Figures { leaks, voids, ..of_a_film(&silhouettes, &tracker) })
}

fn outline(world: &World, cell: OrganismId) -> Vec<Vec2> {
    world.view().organism(cell).map_or(Vec::new(), |cell| cell.outline().collect())
}

fn protrusion(world: &World, cell: OrganismId) -> Vec<f32> {
    world.view().organism(cell).and_then(|cell| cell.protrusion()).unwrap_or_default()
}

fn of_a_film(film: &[Silhouette], tracker: &Tracker) -> Figures {
    let areas: Vec<f64> = film.iter().map(|it| it.area).collect();
    let overlaps = LAGS.map(|lag| {
        let frames = (lag / FRAME).round() as usize;
        mean(film.iter().zip(film.iter().skip(frames)).map(|(a, b)| a.overlap(b)))
    });
    let second = (1.0 / FRAME) as usize;
    let steps: Vec<&Silhouette> = film.iter().step_by(second).collect();
    let path = mean(steps.windows(2).map(|pair| f64::from((pair[1].centre - pair[0].centre).length())));
    let pods = tracker.pseudopods();
    let turns: Vec<f64> = pods.windows(2).map(|pair| Pseudopod::turn(&pair[0], &pair[1])).collect();
    let splits: Vec<f64> = turns.iter().copied().filter(|turn| turn.abs() < SPLIT).collect();
    let alternates = |pair: &&[f64]| pair.iter().all(|turn| turn.abs() < SPLIT);
    let pairs: Vec<&[f64]> = turns.windows(2).filter(alternates).collect();
    Figures {
        area_cv: deviation(&areas) / mean(areas.iter().copied()),
        solidity: mean(film.iter().map(|it| it.solidity)),
        overlaps,
        one_to_three: mean(tracker.counts().iter().map(|&count| f64::from(u8::from((1..=3).contains(&count))))),
        interval: 30.0 / pods.len() as f64,
        split_angle: mean(splits.iter().map(|turn| turn.abs())),
        split_share: splits.len() as f64 / turns.len() as f64,
        alternation: mean(pairs.iter().map(|pair| f64::from(u8::from(pair[0] * pair[1] < 0.0)))),
        speed: path / f64::from(SPEED),
        voids: 0.0,
        leaks: 0,
    }
}

fn deviation(values: &[f64]) -> f64 {
    let centre = mean(values.iter().copied());
    mean(values.iter().map(|value| (value - centre) * (value - centre))).sqrt()
}

/// Time until a resting cell moves at a tenth of its speed, and until a cell whose goal is turned round has half its speed
/// backwards, s.
pub(crate) fn delays(spec: &AmoeboidCellSpec, seed: u64) -> Result<[f64; 2], Error> {
    let mut world = World::new(room(seed))?;
    let cell = world.spawn(&spec.clone().into(), Placement::at(150.0, 150.0))?;
    super::scene::run(&mut world, 1.0);
    let first = delay(&mut world, cell, Vec2::new(1e4, 150.0), 0.1)?;
    let mut inputs = Inputs::new();
    inputs.set(cell, Intent::toward(Vec2::new(1e4, 150.0))?);
    (0..300).for_each(|_| world.step(&inputs));
    Ok([first, delay(&mut world, cell, Vec2::new(-1e4, 150.0), 0.5)?])
}

/// Time until a cell has this share of its speed towards a goal, s.
fn delay(world: &mut World, cell: OrganismId, goal: Vec2, share: f32) -> Result<f64, Error> {
    let mut inputs = Inputs::new();
    inputs.set(cell, Intent::toward(goal)?);
    let began = world.time();
    let mut before = world.centroid(cell).unwrap_or(goal);
    let way = (goal - before).normalize();
    while world.time() < began + 5.0 {
        world.step(&inputs);
        let at = world.centroid(cell).unwrap_or(goal);
        let velocity = (at - before) / world.config().dt;
        if velocity.dot(way) > share * SPEED {
            return Ok(world.time() - began);
        }
        before = at;
    }
    Ok(f64::INFINITY)
}

/// A number of [`Figures`] with what is published and what is accepted.
struct Measured {
    what: &'static str,
    published: &'static str,
    accepted: [f64; 2],
    ours: fn(&Figures) -> f64,
}

const SHAPE: [Measured; 7] = [
    Measured {
        what: "standard deviation of the area, %",
        published: "18",
        accepted: [5.0, 30.0],
        ours: |f| 100.0 * f.area_cv,
    },
    Measured { what: "solidity", published: "0.91", accepted: [0.85, 0.95], ours: |f| f.solidity },
    Measured { what: "overlap after 1 s", published: "", accepted: [0.0, 0.85], ours: |f| f.overlaps[1] },
    Measured { what: "overlap after 9 s", published: "", accepted: [0.0, 0.75], ours: |f| f.overlaps[3] },
    Measured { what: "speed along the path over its own", published: "", accepted: [0.9, 1.2], ours: |f| f.speed },
    Measured { what: "largest share of voids, %", published: "", accepted: [0.0, 15.0], ours: |f| 100.0 * f.voids },
    Measured { what: "leaks", published: "0", accepted: [0.0, 0.0], ours: |f| f.leaks as f64 },
];

const PSEUDOPODS: [Measured; 5] = [
    Measured {
        what: "share of time with one to three pseudopods",
        published: "",
        accepted: [0.8, 1.0],
        ours: |f| f.one_to_three,
    },
    Measured { what: "pseudopods per radius crawled", published: "", accepted: [1.0, 6.0], ours: |f| f.per_radius() },
    Measured { what: "angle of splits, °", published: "55 to 60", accepted: [46.0, 70.0], ours: |f| f.split_angle },
    Measured { what: "share of splits", published: "most", accepted: [0.5, 1.0], ours: |f| f.split_share },
    Measured { what: "splits on alternating sides", published: "most", accepted: [0.5, 1.0], ours: |f| f.alternation },
];

fn measure() -> Result<Outcome, Error> {
    let mut rows = Vec::new();
    let types = [Crawl::Keratocyte, Crawl::Neutrophil, Crawl::Dictyostelium, Crawl::AmoebaProteus];
    for crawl in types {
        let spec = cell(crawl);
        let runs: Result<Vec<Figures>, Error> = (1..=6).map(|seed| figures(&spec, seed)).collect();
        let runs = runs?;
        let splits = !matches!(crawl, Crawl::Keratocyte);
        let wanted = SHAPE.iter().chain(PSEUDOPODS.iter().filter(|_| splits));
        rows.extend(wanted.map(|it| {
            let ours = mean(runs.iter().map(it.ours));
            Row::between(format!("{crawl:?}: {}", it.what), it.published, it.accepted, ours)
        }));
        let [first, back] = delays(&spec, 1)?;
        rows.push(Row::between(format!("{crawl:?}: first motion, s"), "", [0.0, 0.1], first));
        rows.push(Row::between(format!("{crawl:?}: half its speed backwards, s"), "", [0.0, 0.2], back));
    }
    Ok(Outcome {
        rows,
        cause: "a keratocyte is almost convex and hardly changes its shape or its area in reality either.",
        ..Outcome::default()
    })
}
