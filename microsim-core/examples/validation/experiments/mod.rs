//! The experiments of docs/validation.md. An experiment is a file and a line in [`ALL`]; its short form is in `tests/validation.rs`.

pub(crate) mod angle_of_repose;
pub(crate) mod catenary;
pub(crate) mod cell_area;
pub(crate) mod chemotactic_index;
pub(crate) mod constriction;
pub(crate) mod convergence;
pub(crate) mod coulomb;
pub(crate) mod crawl;
pub(crate) mod dam_break;
pub(crate) mod diffusion;
pub(crate) mod division;
pub(crate) mod drag;
pub(crate) mod engulfment;
pub(crate) mod free_fall;
pub(crate) mod granular_column;
pub(crate) mod granular_energy;
pub(crate) mod hydrostatic_rest;
pub(crate) mod order;
pub(crate) mod oscillations;
pub(crate) mod packing;
pub(crate) mod pendulum;
pub(crate) mod persistent_walk;
pub(crate) mod plot;
pub(crate) mod point_source;
pub(crate) mod refinement;
pub(crate) mod relaxation;
pub(crate) mod restitution;
pub(crate) mod run_and_tumble;
pub(crate) mod scene;
pub(crate) mod spring;

use microsim_core::Error;
use order::Order;
use plot::Plot;

/// What is compared with a published result.
pub(crate) struct Experiment {
    /// Its name on the command line.
    pub name: &'static str,
    pub title: &'static str,
    /// Author, year, journal.
    pub source: &'static str,
    /// What is done.
    pub words: &'static str,
    pub run: fn() -> Result<Outcome, Error>,
    /// How its error goes with the substep.
    pub order: Order,
}

/// In the order of the page.
pub(crate) const ALL: [Experiment; 26] = [
    free_fall::EXPERIMENT,
    pendulum::EXPERIMENT,
    spring::EXPERIMENT,
    oscillations::EXPERIMENT,
    catenary::EXPERIMENT,
    coulomb::EXPERIMENT,
    restitution::EXPERIMENT,
    drag::EXPERIMENT,
    convergence::EXPERIMENT,
    diffusion::EXPERIMENT,
    persistent_walk::EXPERIMENT,
    run_and_tumble::EXPERIMENT,
    point_source::EXPERIMENT,
    chemotactic_index::EXPERIMENT,
    dam_break::EXPERIMENT,
    hydrostatic_rest::EXPERIMENT,
    packing::EXPERIMENT,
    granular_column::EXPERIMENT,
    angle_of_repose::EXPERIMENT,
    granular_energy::EXPERIMENT,
    constriction::EXPERIMENT,
    cell_area::EXPERIMENT,
    relaxation::EXPERIMENT,
    engulfment::EXPERIMENT,
    division::EXPERIMENT,
    crawl::EXPERIMENT,
];

/// What came of it.
#[derive(Default)]
pub(crate) struct Outcome {
    pub rows: Vec<Row>,
    pub plot: Option<Plot>,
    /// Why rows are missed; the page says it where some are.
    pub cause: &'static str,
}

/// One number beside the published one.
pub(crate) struct Row {
    pub what: String,
    pub published: String,
    pub ours: f64,
    /// Least and largest value that agrees.
    pub accepted: [f64; 2],
}

impl Row {
    /// A number that agrees within a share of the published one.
    pub(crate) fn near(what: impl Into<String>, published: f64, share: f64, ours: f64) -> Self {
        let margin = share * published.abs();
        let accepted = [published - margin, published + margin];
        Self { what: what.into(), published: plot::number(published), ours, accepted }
    }

    /// A number that agrees between two bounds.
    pub(crate) fn between(what: impl Into<String>, published: &str, accepted: [f64; 2], ours: f64) -> Self {
        Self { what: what.into(), published: published.into(), ours, accepted }
    }

    pub(crate) fn agrees(&self) -> bool {
        self.accepted[0] <= self.ours && self.ours <= self.accepted[1]
    }
}
