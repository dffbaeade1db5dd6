//! Fluids as a whole: density, walls, grains, viscosity.

use super::*;
use crate::rng::Rng;
use crate::solver::testing::disc;

fn block(mode: FluidMode, spacing: f32) -> (Fluid, Particles) {
    let mut fluid = Fluid::new(FluidParams { mode, ..FluidParams::default() }, false);
    let mut particles = Particles::default();
    let mut rng = Rng::new(1, 1);
    for k in 0..200 {
        let jitter = Vec2::new(rng.range(-0.1, 0.1), rng.range(-0.1, 0.1));
        let at = Vec2::new((k % 20) as f32, (k / 20) as f32) * spacing + jitter + 50.0; // far from walls
        fluid.particles.push(particles.insert(&disc(at, 1.0)));
    }
    (fluid, particles)
}

/// A substep of 1/480 s in which nothing was predicted.
fn project(fluid: &Fluid, particles: &mut Particles) {
    particles.prev_x.clone_from(&particles.x);
    particles.prev_y.clone_from(&particles.y);
    project_in(Vec2::INFINITY, fluid, particles);
}

fn project_in(size: Vec2, fluid: &Fluid, particles: &mut Particles) {
    let (fluids, mut workspace) = (std::slice::from_ref(fluid), Workspace::default());
    workspace.find_neighbours(fluids, particles, [Vec2::ZERO, size], Period::NONE);
    workspace.project(fluids, particles, 1.0 / 480.0, Dispatch::default());
}

fn centre(particles: &Particles) -> [f64; 2] {
    let sum = |along: fn(Vec2) -> f32| particles.live().map(|i| f64::from(along(particles.position(i)))).sum::<f64>();
    [sum(|at| at.x), sum(|at| at.y)].map(|sum| sum / particles.len() as f64)
}

fn are_near(a: [f64; 2], b: [f64; 2], distance: f64) -> bool {
    a.iter().zip(b).all(|(a, b)| (a - b).abs() < distance)
}

#[test]
fn compressed_fluid_expands_to_its_rest_density_about_its_centre() {
    let (fluid, mut particles) = block(FluidMode::Density, 0.7);
    let (before, start) = (fluid.mean_compression(1.0, &particles, Period::NONE), centre(&particles));
    (0..60).for_each(|_| project(&fluid, &mut particles));
    let after = fluid.mean_compression(1.0, &particles, Period::NONE);
    assert!(before > 0.4 && after < 0.02, "compression {before} -> {after}");
    assert!(are_near(centre(&particles), start, 1e-3), "momentum");
}

#[test]
fn a_wall_pushes_like_the_mirror_image_of_the_fluid() {
    // A lattice row at half a spacing from the wall is as dense as one inside: nothing moves.
    let (fluid, mut particles) = block(FluidMode::Density, 1.0);
    for i in 0..200 {
        particles.x[i] = (i % 20) as f32 + 0.5 * (i / 20 % 2) as f32 + 0.5;
        particles.y[i] = (i / 20) as f32 * 0.866 + 0.5;
    }
    let at_rest = particles.clone();
    let shift = |fluid: &Fluid, lower: f32| {
        let mut moved = at_rest.clone();
        moved.y.iter_mut().for_each(|y| *y -= lower);
        moved.prev_x.clone_from(&moved.x);
        moved.prev_y.clone_from(&moved.y);
        project_in(Vec2::splat(1e4), fluid, &mut moved);
        moved.y[10] - (at_rest.y[10] - lower)
    };
    assert!(shift(&fluid, 0.0).abs() < 0.02, "at half a spacing: {}", shift(&fluid, 0.0));
    assert!(shift(&fluid, 0.2) > 0.02, "nearer: {}", shift(&fluid, 0.2));
}

#[test]
fn compression_is_the_same_at_any_spacing() {
    let (fluid, mut p) = block(FluidMode::Density, 0.8);
    let compression = fluid.mean_compression(1.0, &p, Period::NONE);
    let mut wide = Fluid::new(FluidParams { spacing: 2.0 * fluid.params.spacing, ..fluid.params }, false);
    wide.particles.clone_from(&fluid.particles);
    [&mut p.x, &mut p.y].into_iter().for_each(|places| places.iter_mut().for_each(|place| *place *= 2.0));
    let twice = wide.mean_compression(1.0, &p, Period::NONE);
    assert!(compression > 0.1 && (twice - compression).abs() < 1e-3, "{compression}, {twice} at twice the spacing");
}

#[test]
fn a_fluid_with_a_larger_spacing_for_a_step_spreads_and_comes_together_again() {
    let (fluid, mut p) = block(FluidMode::Density, 1.0);
    let mut workspace = Workspace::default();
    let mut settle = |scale: f32, p: &mut Particles| {
        let fluids = std::slice::from_ref(&fluid);
        for _ in 0..60 {
            (p.prev_x, p.prev_y) = (p.x.clone(), p.y.clone());
            workspace.scale(1, [(0, scale)].into_iter());
            workspace.find_neighbours(fluids, p, [Vec2::ZERO, Vec2::INFINITY], Period::NONE);
            workspace.project(fluids, p, 1.0 / 480.0, Dispatch::default());
        }
        [scale, 1.0].map(|scale| fluid.mean_compression(scale, p, Period::NONE))
    };
    let [_, before] = settle(1.0, &mut p);
    let [spread, at_rest] = settle(1.2, &mut p);
    assert!(before < 0.02 && spread < 0.02 && at_rest == 0.0, "{before}, {spread} where it is spread, {at_rest}");
    assert!(fluid.mean_compression(1.5, &p, Period::NONE) > 0.2, "no farther than that");
}

#[test]
fn each_wall_pushes_inwards() {
    let (fluid, particles) = block(FluidMode::Density, 0.9);
    let edge = |most: fn(f32, f32) -> f32| {
        particles.live().map(|i| particles.position(i)).reduce(|a, b| Vec2::new(most(a.x, b.x), most(a.y, b.y)))
    };
    let (low, high) = (edge(f32::min).unwrap(), edge(f32::max).unwrap());
    let far = Vec2::splat(1e4);
    for (offset, size, push) in [
        (Vec2::new(0.2 - low.x, 0.0), far, Vec2::X),
        (Vec2::new(0.0, 0.2 - low.y), far, Vec2::Y),
        (Vec2::ZERO, Vec2::new(high.x + 0.2, far.y), Vec2::NEG_X),
        (Vec2::ZERO, Vec2::new(far.x, high.y + 0.2), Vec2::NEG_Y),
    ] {
        let mut p = particles.clone();
        p.x.iter_mut().for_each(|x| *x += offset.x);
        p.y.iter_mut().for_each(|y| *y += offset.y);
        (p.prev_x, p.prev_y) = (p.x.clone(), p.y.clone());
        let before = centre(&p);
        project_in(size, &fluid, &mut p);
        let after = centre(&p);
        let moved = Vec2::new((after[0] - before[0]) as f32, (after[1] - before[1]) as f32);
        assert!(moved.dot(push) > 1e-4 && moved.perp_dot(push).abs() < 1e-5, "{push}: {moved}");
    }
}

#[test]
fn fluid_at_rest_density_or_below_stays() {
    let (fluid, mut particles) = block(FluidMode::Density, 1.3);
    let before = particles.clone();
    project(&fluid, &mut particles);
    assert!((0..200).all(|i| (particles.position(i) - before.position(i)).length() < 1e-6));
}

#[test]
fn grains_separate_to_their_spacing() {
    let (mut fluid, mut particles) = block(FluidMode::Granular, 0.8);
    fluid.params.friction = 0.0;
    (0..400).for_each(|_| project(&fluid, &mut particles));
    for i in 0..200 {
        for j in 0..i {
            let gap = (particles.position(i) - particles.position(j)).length();
            assert!(gap > 0.93, "grains {i} and {j} at {gap}");
        }
    }
}

#[test]
fn what_one_grain_gains_others_lose() {
    let (mut fluid, mut particles) = block(FluidMode::Granular, 0.8);
    fluid.params.viscosity = 100.0;
    let mut rng = Rng::new(5, 5);
    for i in 0..200 {
        particles.prev_x[i] = particles.x[i] - rng.range(-0.1, 0.1);
        particles.prev_y[i] = particles.y[i] - rng.range(-0.1, 0.1);
    }
    let (before, start) = (particles.clone(), centre(&particles));
    project_in(Vec2::INFINITY, &fluid, &mut particles);
    let way = |i: u32| (particles.position(i as usize) - before.position(i as usize)).length();
    assert!((0..200).map(way).sum::<f32>() > 5.0, "they are pushed apart");
    assert!(are_near(centre(&particles), start, 1e-5), "{:?} from {start:?}", centre(&particles));
}

#[test]
fn viscosity_draws_ways_towards_the_neighbours_mean() {
    for mode in [FluidMode::Density, FluidMode::Granular] {
        let (mut fluid, mut particles) = block(mode, 0.99);
        let mut rng = Rng::new(5, 5);
        let still = particles.clone();
        let ways: Vec<f32> = (0..200).map(|_| rng.range(-1e-3, 1e-3)).collect();
        let mut ways_taken = |viscosity: f32| -> Vec<f32> {
            fluid.params.viscosity = viscosity;
            for (i, way) in ways.iter().enumerate() {
                particles.prev_x[i] = still.x[i];
                (particles.x[i], particles.y[i]) = (still.x[i] + way, still.y[i]);
            }
            project_in(Vec2::INFINITY, &fluid, &mut particles);
            (0..200).map(|i| particles.x[i] - still.x[i]).collect()
        };
        let (free, viscous) = (ways_taken(0.0), ways_taken(400.0));
        let taken_back: f32 = (0..200).map(|i| (free[i] - viscous[i]) * ways[i]).sum();
        let all: f32 = ways.iter().map(|way| way * way).sum();
        assert!(taken_back > 0.2 * all && taken_back < all, "{mode:?}: {taken_back} of {all}");
    }
}

#[test]
fn neighbours_found_once_per_step_are_enough() {
    for (mode, spacing) in [(FluidMode::Density, 0.8), (FluidMode::Granular, 0.8)] {
        // Eight substeps of shear and push, with a search before the first or before each; a workspace that has seen others.
        let after = |searches: usize| {
            let (fluid, mut particles) = block(mode, spacing);
            let (fluids, mut workspace) = ([Fluid::new(fluid.params, true), fluid], Workspace::default());
            workspace.find_neighbours(&fluids[1..], &particles, [Vec2::ZERO, Vec2::INFINITY], Period::NONE);
            for substep in 0..8 {
                for i in 0..200 {
                    (particles.prev_x[i], particles.prev_y[i]) = (particles.x[i], particles.y[i]);
                    particles.x[i] += 0.005 * (particles.y[i] - 50.0);
                }
                if substep < searches {
                    workspace.find_neighbours(&fluids, &particles, [Vec2::ZERO, Vec2::INFINITY], Period::NONE);
                }
                workspace.project(&fluids, &mut particles, 1.0 / 480.0, Dispatch::default());
            }
            let gap = |i: usize, j: usize| (particles.position(i) - particles.position(j)).length();
            let least = |i: usize| (0..200).filter(|&j| j != i).map(|j| gap(i, j)).fold(f32::INFINITY, f32::min);
            (fluids[1].mean_compression(1.0, &particles, Period::NONE), (0..200).map(least).sum::<f32>() / 200.0)
        };
        let (once, each) = (after(1), after(8));
        assert!((once.0 - each.0).abs() < 0.005 && (once.1 - each.1).abs() < 0.005, "{mode:?}: {once:?} {each:?}");
    }
}

#[test]
fn particles_in_one_place_come_apart() {
    let mut fluid = Fluid::new(FluidParams::default(), false);
    let mut particles = Particles::default();
    for _ in 0..4 {
        fluid.particles.push(particles.insert(&disc(Vec2::splat(50.0), 1.0)));
    }
    (0..20).for_each(|_| project(&fluid, &mut particles));
    let spread = (0..4).map(|i| (particles.position(i) - Vec2::splat(50.0)).length()).sum::<f32>();
    assert!(spread > 0.1 && spread.is_finite(), "spread {spread}");
}

#[test]
fn a_block_across_a_periodic_side_is_projected_as_elsewhere() {
    let period = Period(Vec2::new(40.0, 0.0));
    for mode in [FluidMode::Density, FluidMode::Granular] {
        let moves = |aside: f32| {
            let (fluid, mut p) = block(mode, 0.8);
            for i in 0..p.len() {
                p.displace(i, Vec2::new(aside - 40.0, 0.0));
                p.displace(i, period.into_room(p.position(i)));
                (p.prev_x[i], p.prev_y[i]) = (p.x[i] - 0.01 * (i % 3) as f32, p.y[i]);
            }
            let (fluids, mut workspace) = (std::slice::from_ref(&fluid), Workspace::default());
            workspace.find_neighbours(fluids, &p, [Vec2::new(-f32::INFINITY, 0.0), Vec2::INFINITY], period);
            let before: Vec<Vec2> = (0..p.len()).map(|i| p.offset(i)).collect();
            workspace.project(fluids, &mut p, 1.0 / 480.0, Dispatch::default());
            let moved: Vec<Vec2> = before.iter().enumerate().map(|(i, before)| p.offset(i) - *before).collect();
            (moved, fluid.mean_compression(1.0, &p, period), fluid.mean_compression(1.0, &p, Period::NONE))
        };
        let ([here, there], compressed) = ([0.0, 22.0].map(|aside| moves(aside).0), moves(22.0));
        let largest = here.iter().map(|moved| moved.length()).fold(0.0, f32::max);
        let differ = here.iter().zip(&there).map(|(a, b)| a.distance(*b)).fold(0.0, f32::max);
        assert!(largest > 0.01 && differ < 1e-4, "{mode:?}: {differ} of {largest}");
        let momentum: Vec2 = there.iter().sum();
        assert!(momentum.length() < 1e-3, "{mode:?}: {momentum}");
        assert!(compressed.1 > compressed.2 + 1e-3, "images count as neighbours: {compressed:?}");
    }
}

#[test]
fn shorter_substeps_correct_less_of_a_lack_of_spacing_and_longer_ones_no_more() {
    let [half, whole, double] = [0.5, 1.0, 2.0].map(|share| density::spacing_share(share / 480.0));
    assert!((half - 1.0 / 13.0).abs() < 1e-6, "four times as soft as a quarter: {half}");
    assert_eq!((whole, double), (0.25, 0.25));
}
