//! The laws of the models of motion, measured on bodies in a world.
#![allow(clippy::disallowed_methods, reason = "tests measure; only stepping has to be bit-exact")]

use microsim_core::geometry::ellipse;
use microsim_core::glam::Vec2;
use microsim_core::{
    AmoeboidCellSpec, BacillusSpec, BrownianParams, ChemicalSpec, ChemotaxisParams, CoccusSpec, Controller, Crawl,
    Exchange, FleeParams, Inputs, Intent, OrganismId, OrganismSpec, PersistentWalkParams, Placement, PlateletSpec,
    ProbeSpec, RigidCellSpec, RunAndTumbleParams, World, WorldConfig,
};

/// Bodies of one kind with one controller, so far from each other and from walls that they never meet.
struct Swarm {
    world: World,
    bodies: Vec<OrganismId>,
}

impl Swarm {
    const ROW: u16 = 32;

    fn new(spec: &OrganismSpec, controller: &Controller, config: WorldConfig) -> Self {
        let size = Vec2::splat(WorldConfig::MAX_SIZE);
        let mut world = World::new(WorldConfig { size, ..config }).unwrap();
        let gap = WorldConfig::MAX_SIZE / f32::from(Self::ROW);
        let place = |k: u16| (Vec2::new(f32::from(k % Self::ROW), f32::from(k / Self::ROW)) + 0.5) * gap;
        let placement = |k| Placement::at(place(k).x, place(k).y).steered_by(controller.clone());
        let bodies = (0..Self::ROW * Self::ROW).map(|k| world.spawn(spec, placement(k)).unwrap()).collect();
        Self { world, bodies }
    }

    fn places(&self) -> Vec<Vec2> {
        self.bodies.iter().map(|&id| self.world.centroid(id).unwrap()).collect()
    }

    /// Mean squared displacements after some times, s, over so many runs one after the other.
    fn mean_squared_displacements(&mut self, times: &[f32], runs: u32) -> Vec<f64> {
        let mut sums = vec![0.0; times.len()];
        let dt = self.world.config().dt;
        for _ in 0..runs {
            let (start, mut step) = (self.places(), 0);
            for (time, sum) in times.iter().zip(&mut sums) {
                while step < (time / dt).round() as u32 {
                    self.world.step(&Inputs::new());
                    step += 1;
                }
                *sum += self.places().iter().zip(&start).map(|(a, b)| f64::from(a.distance_squared(*b))).sum::<f64>();
            }
        }
        sums.into_iter().map(|sum| sum / f64::from(runs) / self.bodies.len() as f64).collect()
    }
}

/// A world of this step, s, substeps, drag, 1/s, and speed limit, units/s.
fn config(dt: f32, substeps: u32, damping: f32, max_speed: f32) -> WorldConfig {
    WorldConfig { dt, substeps, damping, max_speed, ..WorldConfig::default() }
}

fn worlds() -> [WorldConfig; 4] {
    let (slow, fast) = (config(1.0 / 30.0, 4, 3.0, 50.0), config(1.0 / 240.0, 2, 0.0, 20.0));
    [WorldConfig::default(), slow, fast, config(0.1, 8, 4.0, 120.0)]
}

fn coccus(speed: f32) -> OrganismSpec {
    CoccusSpec { speed, ..CoccusSpec::default() }.into()
}

fn bacillus(speed: f32) -> OrganismSpec {
    BacillusSpec { speed, ..BacillusSpec::default() }.into()
}

fn probe(speed: f32) -> OrganismSpec {
    ProbeSpec { speed, ..ProbeSpec::default() }.into()
}

/// A world, two parameters of a model and a kind of given speed.
type Case<'a> = (&'a WorldConfig, f32, f32, fn(f32) -> OrganismSpec);

fn assert_near(measured: f64, law: f64, what: &str) {
    let error = measured / law - 1.0;
    println!("{what}: {measured:.4}, law {law:.4}, {:+.1} %", 100.0 * error);
    assert!(error.abs() < 0.05, "{what}: {measured} instead of {law}");
}

/// Fuerth 1920: `2 S^2 P (t - P (1 - exp(-t / P)))`.
fn fuerth(persistence: f32, speed: f32, time: f32) -> f64 {
    let [p, s, t] = [persistence, speed, time].map(f64::from);
    2.0 * s * s * p * (t - p * (1.0 - (-t / p).exp()))
}

#[test]
fn bodies_on_a_persistent_walk_spread_as_fuerth_says() {
    let [usual, slow, fast, viscous] = worlds();
    let cases: [Case<'_>; 8] = [
        (&usual, 2.0, 3.0, bacillus),
        (&usual, 0.3, 10.0, bacillus),
        (&usual, 5.0, 1.0, coccus),
        (&usual, 0.05, 1.0, coccus),
        (&slow, 0.3, 10.0, bacillus),
        (&slow, 1.0, 14.0, probe),
        (&fast, 0.3, 10.0, bacillus),
        (&viscous, 0.3, 10.0, bacillus),
    ];
    for (config, persistence, speed, kind) in cases {
        let walk = Controller::persistent_walk(PersistentWalkParams { persistence });
        let mut swarm = Swarm::new(&kind(speed), &walk, config.clone());
        let steps = |periods: f32| (periods * persistence / config.dt).round().max(1.0) * config.dt;
        let times = [0.5, 1.0, 3.0].map(steps);
        for (time, measured) in times.into_iter().zip(swarm.mean_squared_displacements(&times, 3)) {
            let what = format!("P {persistence}, S {speed}, dt {:.4}, t {time:.2}", config.dt);
            assert_near(measured, fuerth(persistence, speed, time), &what);
        }
    }
}

#[test]
fn bodies_that_are_kicked_diffuse_as_einstein_says() {
    let [usual, slow, fast, viscous] = worlds();
    let cases: [Case<'_>; 7] = [
        (&usual, 0.46, 0.1, coccus),
        (&usual, 0.1, 0.05, bacillus),
        (&usual, 10.0, 0.5, coccus),
        (&slow, 10.0, 0.1, probe),
        (&slow, 50.0, 0.5, bacillus),
        (&fast, 1.0, 0.05, bacillus),
        (&viscous, 50.0, 0.1, coccus),
    ];
    for (config, diffusion, interval, kind) in cases {
        let kicks = Controller::brownian(BrownianParams { diffusion, interval });
        let mut swarm = Swarm::new(&kind(1.0), &kicks, config.clone());
        let interval = (interval / config.dt).round() * config.dt;
        let times = [2.0, 10.0].map(|kicks| kicks * interval);
        for (time, measured) in times.into_iter().zip(swarm.mean_squared_displacements(&times, 6)) {
            let law = 4.0 * f64::from(diffusion) * f64::from(time);
            assert_near(measured, law, &format!("D {diffusion}, dt {:.4}, t {time:.2}", config.dt));
        }
    }
}

#[test]
fn bodies_that_run_and_tumble_diffuse_as_lovely_and_dahlquist_say() {
    let [usual, _, _, viscous] = worlds();
    for (config, run, tumble, speed) in
        [(&usual, 0.86, 0.14, 14.2), (&viscous, 0.86, 0.14, 14.2), (&usual, 0.3, 0.6, 5.0)]
    {
        let params = RunAndTumbleParams { run, tumble, ..RunAndTumbleParams::default() };
        let mut swarm = Swarm::new(&bacillus(speed), &Controller::run_and_tumble(params), config.clone());
        let [run, tumble, mean, deviation, speed] = [run, tumble, params.turn[0], params.turn[1], speed].map(f64::from);
        let cosine = mean.cos() * (-0.5 * deviation * deviation).exp();
        let law = speed * speed * run * run / (2.0 * (1.0 - cosine) * (run + tumble));
        // Between two times, so that the beginning, which is straighter, does not count.
        let found = swarm.mean_squared_displacements(&[5.0, 20.0], 2);
        let measured = (found[1] - found[0]) / (4.0 * 15.0);
        assert_near(measured, law, &format!("runs of {run} s, tumbles of {tumble} s, dt {:.4}", config.dt));
    }
}

#[test]
fn what_a_body_cannot_follow_is_refused() {
    let mut world = World::new(WorldConfig::default()).unwrap();
    let mut refused = |spec: OrganismSpec, controller: &Controller| {
        let error = world.spawn(&spec, Placement::at(80.0, 45.0).steered_by(controller.clone())).unwrap_err();
        (error.field().to_owned(), error.to_string())
    };
    let kicks = |diffusion, interval| Controller::brownian(BrownianParams { diffusion, interval });
    let (field, message) = refused(coccus(1.0), &kicks(10_000.0, 0.1));
    assert_eq!(field, "controller.diffusion");
    assert!(message.contains("0 to 2.2") && message.contains("`max_speed` of 20"), "{message}");
    assert_eq!(refused(coccus(1.0), &kicks(2.3, 0.1)).0, "controller.diffusion");
    assert_eq!(refused(coccus(0.0), &kicks(0.1, 0.1)).0, "speed");
    assert_eq!(refused(RigidCellSpec::default().into(), &kicks(0.1, 0.1)).0, "controller");
    assert_eq!(refused(PlateletSpec::default().into(), &kicks(0.1, 0.1)).0, "controller");
    let walk = |persistence| Controller::persistent_walk(PersistentWalkParams { persistence });
    assert_eq!(refused(bacillus(20.5), &walk(1.0)).0, "speed");
    for crawl in [Crawl::FrontAndRear, Crawl::Neutrophil] {
        let cell = AmoeboidCellSpec { crawl, ..AmoeboidCellSpec::default() };
        assert_eq!(refused(cell.into(), &walk(0.9)).0, "controller.persistence");
    }
    let tumbling = RunAndTumbleParams { run: 0.04, ..RunAndTumbleParams::default() };
    assert_eq!(refused(bacillus(1.0), &Controller::run_and_tumble(tumbling)).0, "controller.run");
    let fled = Controller::flee(FleeParams::default(), kicks(10.0, 0.1));
    assert_eq!(refused(coccus(1.0), &fled).0, "controller.diffusion");
    let mut slow = World::new(config(0.1, 8, 0.5, 20.0)).unwrap();
    let error = slow.spawn(&bacillus(1.0), Placement::at(80.0, 45.0).steered_by(walk(0.2))).unwrap_err();
    assert_eq!(error.field(), "controller.persistence");
    let coccus = world.spawn(&coccus(1.0), Placement::at(80.0, 45.0)).unwrap();
    assert_eq!(world.set_controller(coccus, kicks(10.0, 0.1)).unwrap_err().field(), "controller.diffusion");
}

#[test]
fn what_nothing_steers_falls_and_coasts_as_mechanics_has_it() {
    let gravity = Vec2::new(0.0, -10.0);
    for spec in [coccus(3.0), bacillus(3.0), probe(3.0)] {
        let room = WorldConfig { gravity, ..config(1.0 / 60.0, 8, 0.0, 50.0) };
        let mut world = World::new(room).unwrap();
        let [left, braked] = [40.0, 80.0].map(|x| world.spawn(&spec, Placement::at(x, 60.0)).unwrap());
        world.push(left, Vec2::new(4.0, 0.0)).unwrap();
        let mut inputs = Inputs::new();
        inputs.set(braked, Intent::REST);
        (0..60).for_each(|_| world.step(&inputs));
        let moved = world.centroid(left).unwrap() - Vec2::new(40.0, 60.0);
        assert!((moved - Vec2::new(4.0, -5.0)).length() < 0.05, "{moved}");
        let moved = world.centroid(braked).unwrap() - Vec2::new(80.0, 60.0);
        assert!(moved.length() < 0.1, "{moved}: who is told to rest brakes");
    }
}

/// How straight cells go to a source from all sides: the way that they have made towards it over the way that they went.
fn chemotactic_index(saturation: f32) -> f32 {
    const MIDDLE: Vec2 = Vec2::new(80.0, 45.0);
    let mut smelling = World::new(WorldConfig::default()).unwrap();
    let chemical = smelling.add_chemical(ChemicalSpec::default()).unwrap();
    let source = smelling.spawn(&coccus(1.0), Placement::at(MIDDLE.x, MIDDLE.y)).unwrap();
    smelling.set_exchange(source, Exchange { chemical, secretion: 100.0, uptake: 0.0 }).unwrap();
    (0..600).for_each(|_| smelling.step(&Inputs::new()));
    let scent = Controller::chemotaxis(ChemotaxisParams { saturation, ..ChemotaxisParams::towards(chemical) });
    let spec = RigidCellSpec { radii: Vec2::new(3.0, 2.5), speed: 4.0, ..RigidCellSpec::default() };
    let (mut towards, mut way) = (0.0, 0.0);
    for start in ellipse(Vec2::splat(25.0), 16) {
        let (mut world, mut at) = (smelling.clone(), MIDDLE + start);
        let cell = world.spawn(&spec.clone().into(), Placement::at(at.x, at.y).steered_by(scent.clone())).unwrap();
        for _ in 0..20 {
            (0..12).for_each(|_| world.step(&Inputs::new()));
            let next = world.centroid(cell).unwrap();
            towards += at.distance(MIDDLE) - next.distance(MIDDLE);
            way += at.distance(next);
            at = next;
        }
    }
    towards / way
}

#[test]
fn cells_find_a_source_by_their_receptors_and_not_by_what_too_few_of_them_tell() {
    let indices = [0.05, 5e3, 1e9].map(chemotactic_index);
    println!("chemotactic index for saturation at 0.05, 5e3 and 1e9: {indices:?}");
    assert!(indices[0] > 0.5 && indices[1] < 0.6 * indices[0] && indices[2].abs() < 0.2, "{indices:?}");
}
