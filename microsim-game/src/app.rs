//! The program: a loop of input, steps and a drawn frame.

use crate::camera::Camera;
use crate::clock::FixedStep;
use crate::draw::hud::Hud;
use crate::draw::{Frame, Painter};
use crate::input::{self, Actions};
use crate::script::Script;
use crate::shot::Shot;
use crate::stage::Stage;
use macroquad::time::{get_frame_time, get_time};
use macroquad::window::{next_frame, screen_dpi_scale, screen_height, screen_width};
use microsim_core::Intent;
use microsim_core::glam::Vec2;
use std::path::{Path, PathBuf};
use std::time::Duration;

/// Time of a frame whose length must not depend on the machine, s.
const SCRIPTED_FRAME: f32 = 1.0 / 60.0;
/// Steps are given up when they have taken this much of a frame, s.
const STEP_BUDGET: f64 = 0.03;
/// Shortest frame, s: where nothing waits for the screen, the loop would run hot.
const SHORTEST_FRAME: f32 = 1.0 / 250.0;
/// Zoom factor per second that a key is held, and per notch of the wheel.
const KEY_ZOOM: f32 = 3.0;
const WHEEL_ZOOM: f32 = 1.12;
/// How long a message is shown, s.
const MESSAGE_TIME: f32 = 4.0;
/// Units that are seen from bottom to top at first when there is a player.
const PLAYER_VIEW: f32 = 60.0;

/// What to do besides showing the scene.
#[derive(Clone, Debug, Default)]
pub struct Plan {
    /// Actions to play back instead of reading mouse and keyboard.
    pub script: Option<Script>,
    /// Frames after which to exit.
    pub frames: Option<u32>,
    /// Picture of the last frame. With it, every frame is exactly one step.
    pub screenshot: Option<PathBuf>,
    /// Size of that picture, pixels.
    pub size: (u32, u32),
}

/// The running program.
#[derive(Debug)]
pub struct App {
    stage: Stage,
    plan: Plan,
    camera: Camera,
    clock: FixedStep,
    painter: Painter,
    shot: Shot,
    frame: u32,
    is_paused: bool,
    /// Simulated by the scenery, s: it goes on while the scene is paused.
    scenery_time: f32,
    step_ms: f32,
    /// Something that has just happened, and the scenery's time until which it is shown.
    message: Option<(String, f32)>,
}

impl App {
    /// The program for a scene. Needs an open window.
    #[must_use]
    pub fn new(stage: Stage, plan: Plan) -> Self {
        let view = view_size(&plan);
        Self {
            camera: first_view(&stage, view),
            clock: FixedStep::new(stage.world().config().dt),
            stage,
            plan,
            painter: Painter::new(),
            shot: Shot::default(),
            frame: 0,
            is_paused: false,
            scenery_time: 0.0,
            step_ms: 0.0,
            message: None,
        }
    }

    /// Runs until the player leaves or the plan is done.
    ///
    /// # Errors
    /// When a planned picture cannot be written.
    pub async fn run(mut self) -> Result<(), String> {
        loop {
            let elapsed = if self.is_scripted() { SCRIPTED_FRAME } else { get_frame_time() };
            self.camera.resize(view_size(&self.plan));
            let actions = match &mut self.plan.script {
                Some(script) => script.actions(self.frame, self.camera.screen()),
                None => input::read(),
            };
            if actions.quit {
                return Ok(());
            }
            self.act(&actions);
            self.advance(&actions, elapsed);
            self.look(&actions, elapsed);
            self.frame += 1;
            let is_last = self.plan.frames.is_some_and(|frames| self.frame >= frames);
            self.show(actions.screenshot, is_last)?;
            if is_last {
                return Ok(());
            }
            next_frame().await;
            self.rest(elapsed);
        }
    }

    /// Whether every frame must come out the same on every machine.
    fn is_scripted(&self) -> bool {
        self.plan.screenshot.is_some() || self.plan.script.is_some()
    }

    fn act(&mut self, actions: &Actions) {
        self.is_paused ^= actions.pause;
        match actions.scenario.and_then(Stage::numbered) {
            Some(Ok(stage)) => {
                self.camera = first_view(&stage, self.camera.screen());
                self.clock = FixedStep::new(stage.world().config().dt);
                self.stage = stage;
            }
            Some(Err(problem)) => self.tell(problem),
            None => {}
        }
        let goal = actions.goal.map(|pixel| self.camera.to_room(pixel));
        let moving = goal.and_then(|goal| Intent::toward(goal).ok()).unwrap_or(Intent::REST);
        self.stage.steer(moving.digesting(actions.digest));
    }

    fn advance(&mut self, actions: &Actions, elapsed: f32) {
        self.scenery_time += elapsed;
        if self.is_paused {
            if actions.single_step {
                self.step();
                self.clock.drop_backlog();
            }
        } else if self.is_scripted() {
            self.step();
        } else {
            self.clock.feed(elapsed);
            let start = get_time();
            while self.clock.take() {
                self.step();
                if get_time() - start > STEP_BUDGET {
                    self.clock.drop_backlog();
                }
            }
        }
    }

    fn step(&mut self) {
        let start = get_time();
        self.stage.step();
        let took = (get_time() - start) as f32 * 1000.0;
        self.step_ms += (took - self.step_ms) * if self.step_ms > 0.0 { 0.05 } else { 1.0 };
    }

    /// Moves the camera.
    fn look(&mut self, actions: &Actions, elapsed: f32) {
        let factor = KEY_ZOOM.powf(actions.zoom * elapsed) * WHEEL_ZOOM.powf(actions.wheel);
        let player = self.stage.player().and_then(|id| self.stage.world().centroid(id));
        if factor != 1.0 {
            let fixed = player.map_or(actions.cursor, |at| self.camera.to_screen(at));
            self.camera.zoom(factor, fixed);
        }
        if let Some(at) = player {
            self.camera.follow(at, elapsed);
        }
    }

    /// Draws the frame to the window, and into a file if one is wanted.
    fn show(&mut self, is_wanted: bool, is_last: bool) -> Result<(), String> {
        let alpha = if self.is_scripted() || self.is_paused { 1.0 } else { self.clock.alpha() };
        let picture = self.stage.picture(alpha);
        let frame = Frame {
            picture: &picture,
            world: self.stage.world(),
            camera: &self.camera,
            time: self.scenery_time,
            hud: self.hud(),
        };
        self.painter.paint(&frame);
        let size = if self.is_scripted() { self.plan.size } else { physical_size() };
        let view = self.camera.screen();
        if let Some(path) = self.plan.screenshot.as_deref().filter(|_| is_last) {
            let taken = self.shot.take(path, size, view, || self.painter.paint(&frame));
            taken.map_err(|error| format!("cannot write {}: {error}", path.display()))?;
        }
        if is_wanted {
            let name = format!("microsim-{}-{}.png", self.stage.name(), self.stage.world().step_index());
            let taken = self.shot.take(Path::new(&name), size, view, || self.painter.paint(&frame));
            self.tell(match taken {
                Ok(()) => format!("wrote {name}"),
                Err(error) => format!("cannot write {name}: {error}"),
            });
        }
        Ok(())
    }

    /// Shows a message for a while.
    fn tell(&mut self, text: String) {
        self.message = Some((text, self.scenery_time + MESSAGE_TIME));
    }

    fn hud(&self) -> Hud {
        let current = self.message.as_ref().filter(|(_, until)| self.scenery_time < *until);
        Hud {
            scenario: self.stage.name().to_owned(),
            time: self.stage.world().time(),
            // The only thing in a picture that would differ from run to run.
            step_ms: (!self.is_scripted()).then_some(self.step_ms),
            bodies: self.stage.census().bodies,
            particles: self.stage.census().particles,
            is_paused: self.is_paused,
            shows_help: !self.is_scripted() && self.scenery_time < 10.0,
            message: current.map(|(text, _)| text.clone()),
        }
    }

    fn rest(&self, elapsed: f32) {
        if !self.is_scripted() && elapsed < SHORTEST_FRAME {
            std::thread::sleep(Duration::from_secs_f32(SHORTEST_FRAME - elapsed.max(0.0)));
        }
    }
}

/// Follows the player from nearby, or shows the whole room.
fn first_view(stage: &Stage, screen: Vec2) -> Camera {
    let room = stage.world().config().size;
    match stage.player().and_then(|id| stage.world().centroid(id)) {
        Some(at) => Camera::around(at, PLAYER_VIEW, room, screen),
        None => Camera::whole(room, screen),
    }
}

/// Drawing units: those of the window, or the pixels of the planned picture.
fn view_size(plan: &Plan) -> Vec2 {
    if plan.screenshot.is_some() || plan.script.is_some() {
        Vec2::new(plan.size.0 as f32, plan.size.1 as f32)
    } else {
        Vec2::new(screen_width(), screen_height())
    }
}

fn physical_size() -> (u32, u32) {
    let scale = screen_dpi_scale();
    let side = |units: f32| ((units * scale) as u32).max(1);
    (side(screen_width()), side(screen_height()))
}
