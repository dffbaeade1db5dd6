//! Simulation mode: any scenario, without rules or hints, to look at and to meddle with.

mod anatomy;
mod building;
mod ghost;
mod panel;
mod plots;
mod spawns;
mod tools;
mod undo;

use super::context::AppContext;
use super::pick::builtin_title;
use super::{Next, Overlay, Paused, Screen};
use crate::clock::Tempo;
use crate::draw::palette::HALO;
use crate::input::{Action, Input, Move};
use crate::sound::Cue;
use crate::stage::Stage;
use crate::ui::font::TextSize;
use crate::ui::menu::Menu;
use crate::ui::pen::{Align, Pen};
use crate::viewer::{FIRST_HEIGHT, Viewer, first_view};
use crate::words::{self, Key};
use microsim_core::View;
use microsim_core::geometry::signed_area;
use microsim_core::glam::Vec2;
use plots::Plots;
use tools::{Tool, Tools};
use undo::Undo;

/// A scene to meddle with.
#[derive(Debug)]
pub(super) struct Sandbox {
    stage: Stage,
    viewer: Viewer,
    tools: Tools,
    undo: Undo,
    panel: Menu,
    plots: Plots,
    /// What was heard in this frame.
    heard: Vec<Cue>,
    tempo: Tempo,
    shows: Shows,
    is_paused: bool,
}

/// What is shown besides the scene.
#[derive(Clone, Copy, Debug, Default)]
struct Shows {
    panel: bool,
    anatomy: bool,
    plots: bool,
}

impl Sandbox {
    /// A scene that runs.
    pub(super) fn new(stage: Stage, context: &AppContext) -> Self {
        let camera = first_view(stage.world(), stage.player(), FIRST_HEIGHT, context.pen.screen());
        let shows = Shows { panel: !context.pace.is_exact, ..Shows::default() };
        let (viewer, panel) = (Viewer::new(stage.world(), camera), Menu::default());
        let mut tools = Tools::default();
        tools.tool = first_tool(stage.world().view());
        let (undo, plots) = (Undo::default(), Plots::default());
        let (heard, tempo) = (Vec::new(), Tempo::default());
        let mut sandbox = Self { stage, viewer, tools, undo, panel, plots, heard, tempo, shows, is_paused: false };
        sandbox.panel.items = panel::items(&sandbox);
        // Behind the heading.
        sandbox.panel.set_focus(1);
        sandbox
    }

    /// The scene from its beginning.
    fn restart(&mut self, context: &mut AppContext) {
        match self.stage.again() {
            Ok(stage) => *self = Self { shows: self.shows, tempo: self.tempo, ..Self::new(stage, context) },
            Err(problem) => context.tell(problem),
        }
    }

    /// The scene of before the last tool's act.
    fn undo(&mut self, context: &mut AppContext) {
        let Some(before) = self.undo.take() else {
            context.tell(words::text(Key::SandboxNoUndo));
            return;
        };
        self.viewer = Viewer::new(before.world(), self.viewer.camera.clone());
        self.stage = before;
        self.tools.let_go();
    }

    /// Uses the tool as the mouse says; what it does to the world can be undone.
    fn use_tool(&mut self, input: &Input, is_on_panel: bool, context: &mut AppContext) {
        let begins = input.is_clicked && !is_on_panel;
        let acts = (begins || self.tools.ends(input)) && self.tools.tool.is_act();
        let before = acts.then(|| self.stage.clone());
        let digests = context.settings.digests(input);
        let told = self.tools.use_on(&mut self.stage, &self.viewer.camera, input, is_on_panel, digests);
        let stands = begins && self.is_paused && self.tools.tool.needs_time();
        match (told.or(stands.then(|| words::text(Key::SandboxStopped).to_owned())), before) {
            (Some(problem), _) => context.tell(problem),
            (None, Some(before)) if self.is_done(&before, begins) => self.undo.keep(before),
            _ => {}
        }
        self.tools.foresee(self.stage.world(), self.viewer.camera.to_room(input.cursor), is_on_panel);
    }

    /// Whether the tool has done something that can be undone: a click is an act, unless it builds nothing.
    fn is_done(&self, before: &Stage, begins: bool) -> bool {
        let built = |stage: &Stage| {
            let world = stage.world();
            [world.joints().count(), world.obstacles().count(), world.fields().count()]
        };
        if self.tools.tool.builds() { built(before) != built(&self.stage) } else { begins }
    }

    fn press(&mut self, input: &Input, context: &mut AppContext) {
        self.is_paused ^= input.presses(Action::Pause);
        self.is_paused |= input.has_lost_focus;
        if input.presses(Action::Panel) {
            self.shows.panel ^= true;
            if !self.shows.panel {
                let key = context.settings.keys.label(Action::Panel);
                context.tell(words::text_with(Key::SandboxPanel, &[("key", (&key).into())]));
            }
        }
        self.shows.anatomy ^= input.presses(Action::DebugView);
        self.shows.plots ^= input.presses(Action::Plots);
        self.tempo = self.tempo.changed(input.presses(Action::Faster), input.presses(Action::Slower));
        if input.presses(Action::Step) {
            self.is_paused = true;
            self.step();
        }
    }

    /// One step, while time stands still.
    fn step(&mut self) {
        let tools = &self.tools;
        self.viewer.step(&mut self.stage, |stage| tools.step(stage));
        self.measure();
    }

    fn run(&mut self, context: &mut AppContext) {
        if self.is_paused {
            return;
        }
        let Self { tools, heard, .. } = self;
        heard.clear();
        self.viewer.run(context.pace, self.tempo.factor(), &mut self.stage, |stage| {
            let world = tools.step(stage);
            heard.extend(world.events().iter().filter_map(|event| Cue::of(event, None)));
            world
        });
        context.play(&self.heard);
        self.measure();
    }

    fn measure(&mut self) {
        let cell = self.stage.player().and_then(|id| self.stage.world().view().organism(id));
        let area = cell.map(|cell| signed_area(&cell.outline().collect::<Vec<_>>()));
        self.plots.push(self.viewer.step_ms(), area);
    }

    /// How many bodies and particles there are.
    fn counts(&self) -> [String; 2] {
        let census = self.stage.census();
        let counts = [(Key::SandboxBodies, census.bodies), (Key::SandboxParticles, census.particles)];
        counts.map(|(key, count)| words::text_with(key, &[("count", (count as u32).into())]))
    }

    /// Name and time, and with the debug view what there is and how long a step takes.
    fn draw_status(&self, pen: &mut Pen, is_exact: bool) {
        let time = self.stage.world().time() as f32;
        let mut parts =
            vec![builtin_title(self.stage.name()).text().to_owned(), format!("{} s", words::number(time, 2))];
        if self.is_paused {
            parts.push(words::text(Key::SandboxPaused).to_owned());
        }
        if self.tempo != Tempo::default() {
            parts.push(self.tempo.to_string());
        }
        if self.shows.anatomy {
            parts.extend(self.counts());
            parts.extend((!is_exact).then(|| step_label(self.viewer.step_ms())));
        }
        let line = pen.line(TextSize::Small);
        let width = pen.screen().x - 0.8 * line;
        let text = fitting(&parts, |text| pen.width(TextSize::Small, text) <= width);
        pen.label(Vec2::new(0.4 * line, 0.8 * line), TextSize::Small, Align::Left, HALO, &text);
    }
}

/// How long a step took.
fn step_label(time: f32) -> String {
    words::text_with(Key::SandboxStep, &[("time", (&words::number(time, 2)).into())])
}

/// As many parts of a line as fit, the first one in any case.
fn fitting(parts: &[String], fits: impl Fn(&str) -> bool) -> String {
    let mut lines = (1..=parts.len()).rev().map(|count| parts[..count].join("   "));
    lines.find(|line| fits(line)).unwrap_or_else(|| parts[0].clone())
}

impl Screen for Sandbox {
    fn update(&mut self, input: &Input, context: &mut AppContext) -> Next {
        if input.step == Some(Move::Back) {
            return Next::Open(Overlay::Pause(Paused::Simulation));
        }
        if input.presses(Action::Restart) {
            self.restart(context);
            return Next::Stay;
        }
        if input.presses(Action::Undo) {
            self.undo(context);
        }
        self.press(input, context);
        let place = panel::place(&context.pen);
        let is_on_panel = self.shows.panel && self.panel.contains(input.cursor, &place);
        if self.shows.panel
            && let Some(choice) = self.panel.update(input, &place)
        {
            let next = panel::choose(self, choice, context);
            if !matches!(next, Next::Stay) {
                return next;
            }
        }
        self.use_tool(input, is_on_panel, context);
        if let Some(entry) = self.tools.take_asked() {
            context.find(entry.name);
            return Next::Open(Overlay::Article(entry));
        }
        self.run(context);
        let looks_around = self.tools.look_around(&mut self.viewer.camera);
        let at = self.viewer.place_of(self.stage.world(), self.stage.player()).filter(|_| !looks_around);
        let wheel = if is_on_panel { 0.0 } else { input.wheel };
        let pivot = looks_around.then_some(input.cursor);
        self.viewer.look(input.zoom(), wheel, at, pivot, context.pace.elapsed);
        self.panel.items = panel::items(self);
        Next::Stay
    }

    fn draw(&mut self, context: &mut AppContext) {
        self.viewer.camera.resize(context.pen.screen());
        let (view, camera) = (self.viewer.view(self.stage.world()), &self.viewer.camera);
        let seen = context.paint(view, camera);
        if self.shows.anatomy {
            anatomy::draw(&mut context.pen, view, &seen);
        }
        if !context.is_top {
            return;
        }
        let pen = &mut context.pen;
        self.tools.draw(pen, view, camera);
        if self.shows.plots {
            self.plots.draw(pen);
        }
        self.draw_status(pen, context.pace.is_exact);
        if self.shows.panel {
            self.panel.draw(pen, &panel::place(pen));
        }
    }

    fn is_scene(&self) -> bool {
        true
    }

    fn menu(&self) -> Option<&Menu> {
        self.shows.panel.then_some(&self.panel)
    }

    fn name(&self) -> String {
        format!("{}-{}", self.stage.name(), self.stage.world().step_index())
    }
}

/// The tool with which a scene begins: where nobody crawls there is nobody to steer, but all can be pushed away.
fn first_tool(view: View<'_>) -> Tool {
    let stands = view.organisms().count() > 0 && view.organisms().all(|organism| organism.speed() == 0.0);
    if stands { Tool::Push } else { Tool::Steer }
}

#[cfg(test)]
mod tests {
    use super::*;
    use microsim_core::{AgarSpec, AmoeboidCellSpec, Placement, World, WorldConfig};

    #[test]
    fn where_nobody_crawls_all_are_pushed_away() {
        let mut world = World::new(WorldConfig::default()).unwrap();
        assert_eq!(first_tool(world.view()), Tool::Steer);
        world.spawn(&AgarSpec::default().into(), Placement::at(20.0, 20.0)).unwrap();
        assert_eq!(first_tool(world.view()), Tool::Push);
        world.spawn(&AmoeboidCellSpec::default().into(), Placement::at(40.0, 40.0)).unwrap();
        assert_eq!(first_tool(world.view()), Tool::Steer);
    }

    #[test]
    fn the_status_fits_small_and_narrow_windows() {
        let parts = ["leak-stress", "123.45 s", "PAUSED", "0.25 x", "1234 bodies", "123456 particles", "step 12.34 ms"];
        let parts = parts.map(str::to_owned);
        for (width, height) in [(420.0, 260.0), (300.0, 700.0), (1280.0, 720.0)] {
            for wish in [0.85, 1.0, 1.5] {
                let (pen, measure) = Pen::measured(Vec2::new(width, height), wish);
                let text = fitting(&parts, |text| measure(TextSize::Small, text) <= width);
                assert!(measure(TextSize::Small, &text) <= width, "{width} {wish}: {text}");
                assert!(text.starts_with("leak-stress   123.45 s"), "{width} {wish}: {text}");
                let panel = panel::place(&pen);
                assert!(panel.corner.x + panel.item.x <= width, "{width} {wish}: the panel");
            }
        }
    }
}
