//! What refining the step changes.

use super::free_fall;
use super::scene::Stepping;
use microsim_core::geometry::polygon::signed_area;
use microsim_core::glam::Vec2;
use microsim_core::scenario::{Scenario, builtin};
use microsim_core::{
    AmoeboidCellSpec, Error, Event, Inputs, Intent, Measure, OrganismId, Placement, World, WorldConfig,
};

const STEPS: [(&str, f32); 4] = [("1/30", 1.0 / 30.0), ("1/60", 1.0 / 60.0), ("1/240", 1.0 / 240.0), ("0.001", 0.001)];
const SUBSTEPS: [u32; 6] = [1, 4, 8, 16, 32, 64];

/// A row for each step and number of substeps.
pub(crate) fn table(seeds: u64) -> Vec<String> {
    let header = "| step, s | substeps | free fall | way at rest, area | driven: way, area | agar taken in, s | rigid cell taken in, s |";
    let mut table = vec![header.to_owned(), "|---|---|---|---|---|---|---|".to_owned()];
    for (name, dt) in STEPS {
        for substeps in SUBSTEPS {
            let measured = row(Stepping { dt, substeps }, seeds);
            let cells = measured.unwrap_or_else(|refusal| format!("refused: {refusal} | | | |"));
            table.push(format!("| {name} | {substeps} | {cells} |"));
        }
    }
    table
}

fn row(stepping: Stepping, seeds: u64) -> Result<String, Error> {
    let fall = free_fall::fall(stepping)?[0] / 10.0 - 1.0;
    let cells = cells(stepping, seeds).unwrap_or_else(|refusal| format!("refused: {refusal} | | |"));
    Ok(format!("{:+.3} % | {cells}", 100.0 * fall))
}

/// The columns that are about amoeboid cells.
fn cells(stepping: Stepping, seeds: u64) -> Result<String, Error> {
    let Rest { way, area: [low, high] } = rest(stepping, 20.0)?;
    let (driven_way, driven_area) = driven(stepping)?;
    let percent = |share: f32| format!("{:+.1} %", 100.0 * share);
    let absorb = |name: &str| {
        let ends: Vec<String> = (1..=seeds).map(|seed| absorb(name, seed, stepping).to_string()).collect();
        ends.join(", ")
    };
    Ok([
        format!("{way:.3}, {} to {}", percent(low), percent(high)),
        format!("{driven_way:.1}, {}", percent(driven_area)),
        absorb("absorb-agar"),
        absorb("absorb-rigid"),
    ]
    .join(" | "))
}

/// A room with a cell of the default size, and the area that its radii give.
fn cell_in_room(stepping: Stepping, at: Vec2) -> Result<(World, OrganismId, f32), Error> {
    let Stepping { dt, substeps } = stepping;
    let mut world = World::new(WorldConfig { dt, substeps, ..WorldConfig::default() })?;
    let spec = AmoeboidCellSpec::default();
    let nodes = spec.radii - spec.node_radius;
    let cell = world.spawn(&spec.into(), Placement::at(at.x, at.y))?;
    Ok((world, cell, std::f32::consts::PI * nodes.x * nodes.y))
}

fn area(world: &World, cell: OrganismId) -> f32 {
    let outline: Vec<Vec2> = world.view().organism(cell).map(|cell| cell.outline().collect()).unwrap_or_default();
    signed_area(&outline)
}

/// A cell that nobody drives.
pub(crate) struct Rest {
    /// How far it gets, units.
    pub way: f32,
    /// Least and largest difference of its area from that of its spec, as shares.
    pub area: [f32; 2],
}

/// Watches a cell that nobody drives for so long, s.
pub(crate) fn rest(stepping: Stepping, seconds: f32) -> Result<Rest, Error> {
    let start = Vec2::new(80.0, 45.0);
    let (mut world, cell, wanted) = cell_in_room(stepping, start)?;
    let at_spawn = area(&world, cell) / wanted - 1.0;
    let [mut low, mut high] = [at_spawn; 2];
    for _ in 0..(seconds * 10.0) as u32 {
        super::scene::run(&mut world, 0.1);
        let error = area(&world, cell) / wanted - 1.0;
        (low, high) = (low.min(error), high.max(error));
    }
    let way = (world.centroid(cell).unwrap_or_default() - start).length();
    Ok(Rest { way, area: [low, high] })
}

/// Way, units, and area of a cell that is driven for 4 s, the area relative to that of its spec.
fn driven(stepping: Stepping) -> Result<(f32, f32), Error> {
    let (mut world, cell, wanted) = cell_in_room(stepping, Vec2::new(40.0, 45.0))?;
    let mut inputs = Inputs::new();
    inputs.set(cell, Intent::toward(Vec2::new(150.0, 45.0))?);
    while world.time() < 4.0 {
        world.step(&inputs);
    }
    Ok((world.centroid(cell).unwrap_or_default().x - 40.0, area(&world, cell) / wanted - 1.0))
}

/// What became of prey in a built-in scenario.
#[derive(Debug, Default)]
pub(crate) struct Absorption {
    /// When it was taken in, s.
    pub ingested: Option<f64>,
    /// Names and values of what must not happen and did.
    pub flaws: Vec<(&'static str, f64)>,
}

impl std::fmt::Display for Absorption {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self.ingested {
            Some(time) => write!(f, "{time:.1}")?,
            None => write!(f, "never")?,
        }
        self.flaws.iter().try_for_each(|(name, value)| write!(f, " {name} {value:.2}"))
    }
}

/// What must not be larger in `absorb-agar` and `absorb-rigid`, and the limit of each.
const LIMITS: [(&str, f64); 6] = [
    ("leaks", 0.0),
    ("wrong_side", 0.0),
    ("net_fired", 0.0),
    ("improper_absorptions", 0.0),
    ("partial_absorptions", 0.0),
    ("membrane_stretch_max", 0.25),
];

/// Runs a built-in scenario until a second after prey is taken in, 15 s at most.
pub(crate) fn absorb(name: &str, seed: u64, stepping: Stepping) -> Absorption {
    let overrides =
        [("step.dt".to_owned(), stepping.dt.to_string()), ("step.substeps".to_owned(), stepping.substeps.to_string())];
    let text = builtin(name).map_or("", |builtin| builtin.text);
    let mut scenario = Scenario::parse(text, &overrides).expect("a built-in scenario in a step that is accepted");
    scenario.set_seed(seed);
    let mut built = scenario.build().expect("there is room for what these scenarios place");
    let mut absorption = Absorption::default();
    let (mut worst, mut released) = ([0.0f64; LIMITS.len()], 0.0);
    while built.world.time() < absorption.ingested.map_or(15.0, |time| time + 1.0) {
        built.step(&Inputs::new());
        for event in built.world.events() {
            match event {
                Event::Ingested { .. } => absorption.ingested = absorption.ingested.or(Some(built.world.time())),
                Event::Released { .. } => released += 1.0,
                _ => {}
            }
        }
        for (worst, (name, _)) in worst.iter_mut().zip(LIMITS) {
            *worst = worst.max(Measure::named(name).map_or(0.0, |measure| measure.of(&built.world)));
        }
    }
    let broken = LIMITS.into_iter().zip(worst).filter(|((_, limit), worst)| worst > limit);
    absorption.flaws = broken.map(|((name, _), worst)| (name, worst)).collect();
    absorption.flaws.extend((released > 0.0).then_some(("released", released)));
    absorption
}
