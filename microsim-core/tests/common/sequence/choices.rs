//! Bytes as choices of numbers, worlds and organisms, some of them out of range.

use microsim_core::glam::Vec2;
use microsim_core::{
    AgarSpec, AmoeboidCellSpec, AvoidanceParams, BacillusSpec, BrownianParams, ChemicalId, ChemotaxisParams,
    CoccusSpec, Controller, FleeParams, FluidBlockSpec, FluidMode, FluidParams, IngestionWay, OrganismSpec,
    PersistentWalkParams, Placement, PlateletSpec, ProbeSpec, PursueParams, RedCellSpec, RigidCellSpec,
    RunAndTumbleParams, Side, Sides, Substrate, WorldConfig,
};

/// Numbers of which few are legal everywhere.
const NUMBERS: [f32; 16] =
    [0.0, -0.0, 1.0, -1.0, 0.5, 2.0, 1.5, 7.0, 1e-3, 1e-9, 30.0, 1e6, 1e30, f32::NAN, f32::INFINITY, f32::NEG_INFINITY];

/// Bytes as choices; zeros when they are used up.
pub(super) struct Choices<'a>(pub(super) &'a [u8]);

impl Choices<'_> {
    pub(super) fn byte(&mut self) -> u8 {
        let Some((&first, rest)) = self.0.split_first() else { return 0 };
        self.0 = rest;
        first
    }

    pub(super) fn below(&mut self, count: usize) -> usize {
        usize::from(self.byte()) % count
    }

    /// In `low..high`.
    pub(super) fn range(&mut self, low: f32, high: f32) -> f32 {
        low + (high - low) * f32::from(self.byte()) / 256.0
    }

    /// A number in `low..high`, or once in a while any.
    pub(super) fn number(&mut self, low: f32, high: f32) -> f32 {
        if self.byte() < 8 { NUMBERS[self.below(NUMBERS.len())] } else { self.range(low, high) }
    }

    pub(super) fn flag(&mut self) -> bool {
        self.byte() % 2 == 1
    }

    pub(super) fn place(&mut self, size: Vec2) -> Vec2 {
        Vec2::new(self.number(0.0, size.x), self.number(0.0, size.y))
    }

    pub(super) fn config(&mut self) -> WorldConfig {
        WorldConfig {
            size: Vec2::new(self.number(30.0, 90.0), self.number(30.0, 60.0)),
            // With one substep a membrane may cross itself under load, see `WorldConfig::substeps`.
            substeps: [8, 4, 2, 0][self.below(13) / 4],
            gravity: Vec2::new(0.0, if self.byte() < 200 { 0.0 } else { self.number(-30.0, 5.0) }),
            seed: u64::from(self.byte()),
            protects_membranes: self.byte() < 230,
            max_particles: if self.byte() < 230 { 2500 } else { 150 },
            substrate: if self.byte() < 200 { Substrate::Slide } else { Substrate::Surfaces },
            sides: match self.byte() {
                0..200 => Sides::default(),
                200..230 => self.sides(),
                _ => repeating(self.sides()),
            },
            ..Default::default()
        }
    }

    fn side(&mut self) -> Side {
        if self.flag() { Side::Open } else { Side::Wall }
    }

    fn sides(&mut self) -> Sides {
        Sides { bottom: self.side(), top: self.side(), left: self.side(), right: self.side() }
    }

    pub(super) fn placement(&mut self, size: Vec2) -> Placement {
        let (at, c) = (self.place(size), self);
        let controller = match c.below(12) {
            5.. => Controller::Still,
            1 => Controller::wander([c.number(0.1, 0.5), c.number(0.5, 1.0)], c.number(0.0, 1.0)),
            2 => Controller::thrash(c.number(0.05, 1.0), c.number(0.0, 1.0)),
            3 => Controller::ram(c.number(0.1, 1.0), c.number(0.1, 1.0), c.number(5.0, 20.0)),
            0 | 4 => {
                Controller::patrol((0..c.below(4)).map(|_| Vec2::new(c.number(0.0, 60.0), 20.0)).collect(), c.flag())
            }
        };
        let scale = if c.byte() < 220 { 1.0 } else { c.number(0.5, 2.0) };
        let placed = Placement::at(at.x, at.y).turned(c.number(-4.0, 4.0)).scaled(scale).steered_by(controller);
        let placed = if c.byte() < 220 { placed } else { placed.damped(c.number(0.0, 10.0), c.number(0.0, 10.0)) };
        if c.byte() < 220 { placed } else { placed.overlapping(c.number(0.0, 0.9)) }
    }

    pub(super) fn spec(&mut self) -> OrganismSpec {
        let c = self;
        match c.below(9) {
            0 => AgarSpec { radius: c.number(0.3, 2.0), density: c.number(0.5, 2.0) }.into(),
            1 => CoccusSpec { radius: c.number(0.3, 1.5), speed: c.number(0.0, 20.0), ..Default::default() }.into(),
            2 => PlateletSpec { radius: c.number(1.0, 4.0), satellites: c.byte().into(), ..Default::default() }.into(),
            3 => ProbeSpec { radius: c.number(0.5, 4.0), mass: c.number(0.1, 100.0), ..Default::default() }.into(),
            4 => RedCellSpec { radius: c.number(2.0, 5.0), area_compliance: c.number(0.0, 0.1), ..Default::default() }
                .into(),
            5 => RigidCellSpec {
                radii: Vec2::new(c.number(2.0, 8.0), c.number(1.5, 5.0)),
                satellites: 8 + u32::from(c.byte() % 32),
                layers: 1 + u32::from(c.byte() % 2),
                speed: c.number(0.0, 20.0),
                ..Default::default()
            }
            .into(),
            6 => FluidBlockSpec {
                size: Vec2::new(c.number(2.0, 15.0), c.number(2.0, 10.0)),
                fluid: FluidParams {
                    spacing: c.number(0.7, 1.5),
                    mode: if c.flag() { FluidMode::Density } else { FluidMode::Granular },
                    ..Default::default()
                },
            }
            .into(),
            7 => BacillusSpec { speed: c.number(0.0, 20.0), ..Default::default() }.into(),
            _ => c.amoeboid_cell().into(),
        }
    }

    pub(super) fn amoeboid_cell(&mut self) -> AmoeboidCellSpec {
        let c = self;
        let mut spec = AmoeboidCellSpec { speed: c.number(2.0, 20.0), ..Default::default() };
        let radius = c.number(4.0, 14.0);
        spec.radii = Vec2::new(radius, radius * c.range(0.7, 1.4));
        spec.phagocytosis.way = if c.flag() { IngestionWay::Cup } else { IngestionWay::Gate };
        spec.phagocytosis.hold_time = c.number(0.0, 0.3);
        spec.phagocytosis.time_limit = c.number(0.2, 2.0);
        spec.phagocytosis.digestion_time = [c.number(0.05, 0.5), c.number(0.05, 1.0), c.number(0.05, 1.0)];
        spec.division.time_limit = c.number(0.5, 5.0);
        spec.division.furrow_speed = c.number(1.0, 20.0);
        spec
    }

    /// A controller, which may need `chemical`.
    pub(super) fn controller(&mut self, chemical: Option<ChemicalId>) -> Controller {
        let c = self;
        let seconds = [c.number(0.05, 0.5), c.number(0.5, 1.0)];
        match (c.below(8), chemical) {
            (0, _) => Controller::persistent_walk(PersistentWalkParams { persistence: seconds[0] }),
            (1, _) => Controller::brownian(BrownianParams { diffusion: c.number(0.1, 50.0), interval: seconds[0] }),
            (2, _) => Controller::avoidance(AvoidanceParams { back: seconds, ..Default::default() }),
            (3, _) => Controller::run_and_tumble(RunAndTumbleParams {
                run: seconds[0],
                tumble: seconds[1],
                chemical,
                ..Default::default()
            }),
            (4, _) => {
                Controller::flee(FleeParams { within: c.number(1.0, 30.0), ..Default::default() }, Controller::Still)
            }
            (5, _) => Controller::pursue(
                PursueParams { within: c.number(1.0, 30.0), ..Default::default() },
                Controller::Still,
            ),
            (6, Some(chemical)) => Controller::chemotaxis(ChemotaxisParams {
                noise: c.number(0.0, 1.0),
                interval: seconds[0],
                ..ChemotaxisParams::towards(chemical)
            }),
            _ => Controller::wander(seconds, 0.5),
        }
    }
}

/// A room that repeats from left to right, and upwards if its top is open.
fn repeating(sides: Sides) -> Sides {
    let sides = Sides { left: Side::Periodic, right: Side::Periodic, ..sides };
    if sides.top == Side::Open { Sides { bottom: Side::Periodic, top: Side::Periodic, ..sides } } else { sides }
}
