//! Shows a running world: a clock of fixed steps, the last two moments, and a camera.

use crate::camera::Camera;
use crate::clock::FixedStep;
use crate::platform;
use microsim_core::glam::Vec2;
use microsim_core::{Moment, OrganismId, View, World};

/// Steps are given up when they have taken this much of a frame, s.
const STEP_BUDGET: f32 = 0.03;
/// Zoom factor per second that a key is held, and per notch of the wheel.
const KEY_ZOOM: f32 = 3.0;
const WHEEL_ZOOM: f32 = 1.12;
/// Units that are seen from bottom to top at first when there is somebody to follow.
pub const FIRST_HEIGHT: f32 = 60.0;
/// Share of the way to the cursor that the camera looks ahead.
const LOOK_AHEAD: f32 = 0.12;

/// How time passes in one frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pace {
    /// Time since the last frame, s.
    pub elapsed: f32,
    /// Every frame is exactly one step, so that pictures come out the same on every machine.
    pub is_exact: bool,
}

/// Shows a running world.
#[derive(Debug)]
pub struct Viewer {
    /// What part of the room is seen.
    pub camera: Camera,
    clock: FixedStep,
    /// Before the last step, and after it.
    before: Moment,
    after: Moment,
    /// How far the moment that is seen lies between the two.
    alpha: f32,
    step_ms: f32,
}

impl Viewer {
    /// A viewer of the present moment.
    #[must_use]
    pub fn new(world: &World, camera: Camera) -> Self {
        let (clock, now) = (FixedStep::new(world.config().dt), world.moment());
        Self { camera, clock, before: now.clone(), after: now, alpha: 1.0, step_ms: 0.0 }
    }

    /// The same for steps that are each as long as several of the world.
    #[must_use]
    pub fn with_long_steps(world: &World, camera: Camera, steps: u32) -> Self {
        let clock = FixedStep::new(world.config().dt * steps as f32);
        Self { clock, ..Self::new(world, camera) }
    }

    /// Takes the steps that are due in this frame, at `speed` times the usual speed. When the machine is too slow for
    /// them the world runs in slow motion.
    pub fn run<S>(&mut self, pace: Pace, speed: f32, scene: &mut S, mut step: impl FnMut(&mut S) -> &World) {
        if pace.is_exact {
            self.step(scene, &mut step);
            return;
        }
        self.clock.feed(pace.elapsed * speed);
        let start = platform::now();
        while self.clock.take() {
            self.step(scene, &mut step);
            if (platform::now() - start).as_secs_f32() > STEP_BUDGET {
                self.clock.drop_backlog();
            }
        }
        self.alpha = self.clock.alpha();
    }

    /// Takes one step.
    pub fn step<S>(&mut self, scene: &mut S, mut step: impl FnMut(&mut S) -> &World) {
        let began = platform::now();
        let world = step(scene);
        let took = (platform::now() - began).as_secs_f32() * 1000.0;
        self.step_ms += (took - self.step_ms) * if self.step_ms > 0.0 { 0.1 } else { 1.0 };
        self.before = std::mem::replace(&mut self.after, world.moment());
        self.alpha = 1.0;
    }

    /// What is to be seen now of the world that it runs: between the last two steps.
    #[must_use]
    pub fn view<'a>(&'a self, world: &'a World) -> View<'a> {
        world.view_since(&self.before, self.alpha)
    }

    /// How far that moment lies between the two steps, 0 to 1.
    #[must_use]
    pub fn alpha(&self) -> f32 {
        self.alpha
    }

    /// Where somebody is at the moment that is seen.
    #[must_use]
    pub fn place_of(&self, world: &World, id: Option<OrganismId>) -> Option<Vec2> {
        Some(self.view(world).organism(id?)?.centroid())
    }

    /// Time that a step takes, ms, smoothed.
    #[must_use]
    pub fn step_ms(&self) -> f32 {
        self.step_ms
    }

    /// Moves the camera: zooming by keys and wheel, following something, looking ahead to the cursor.
    pub fn look(&mut self, zoom: f32, wheel: f32, target: Option<Vec2>, cursor: Option<Vec2>, elapsed: f32) {
        let factor = zoom_factor(zoom, wheel, elapsed);
        if factor != 1.0 {
            let fixed = target.map(|at| self.camera.to_screen(at)).or(cursor).unwrap_or(self.camera.screen() * 0.5);
            self.camera.zoom(factor, fixed);
        }
        if let Some(at) = target {
            let ahead = cursor.map_or(Vec2::ZERO, |cursor| (self.camera.to_room(cursor) - at) * LOOK_AHEAD);
            self.camera.follow(at + ahead, elapsed);
        }
    }
}

/// How much closer one looks after a frame of this length, s, by keys and by notches of the wheel.
#[must_use]
pub fn zoom_factor(keys: f32, wheel: f32, elapsed: f32) -> f32 {
    KEY_ZOOM.powf(keys * elapsed) * WHEEL_ZOOM.powf(wheel)
}

/// The view of a room at first: `height` units around somebody, or all of it.
#[must_use]
pub fn first_view(world: &World, around: Option<OrganismId>, height: f32, screen: Vec2) -> Camera {
    let room = world.config().size;
    match around.and_then(|id| world.centroid(id)) {
        Some(at) => Camera::around(at, height, room, screen),
        None => Camera::whole(room, screen),
    }
}
