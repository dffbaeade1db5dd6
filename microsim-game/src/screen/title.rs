//! The title: the hunt goes on behind the menu.

use super::pick::Pick;
use super::play::Play;
use super::scores::ScoreList;
use super::settings::SettingsMenu;
use super::{Change, Context, Screen};
use crate::draw::palette::{HALO, INK, fade};
use crate::input::{Input, Move};
use crate::rules::bot::{Bot, Policy};
use crate::stage::Stage;
use crate::ui::glyphs::TITLE;
use crate::ui::menu::{Choice, Item, Menu, Place, title_lines};
use crate::ui::pen::{Align, Size};
use crate::viewer::{Viewer, first_view};
use microsim_core::glam::Vec2;

/// Height of the picture behind the menu, units.
const VIEW: f32 = 42.0;
/// The menu covers the middle: the hunter is seen beside it.
const BESIDE: Vec2 = Vec2::new(0.36 * VIEW, 0.0);
/// The scene behind the menu begins anew after this time, s: by then most of the prey is eaten.
const SCENE_TIME: f64 = 90.0;

/// The title.
#[derive(Debug)]
pub struct Title {
    scene: Option<Scene>,
    menu: Menu,
}

#[derive(Debug)]
struct Scene {
    stage: Stage,
    bot: Bot,
    viewer: Viewer,
}

const PLAY: usize = 0;
const SIMULATION: usize = 1;
const REPLAY: usize = 2;
const SCORES: usize = 3;
const SETTINGS: usize = 4;

impl Title {
    /// The title, with its scene at the beginning.
    #[must_use]
    pub fn new(context: &Context) -> Self {
        let labels = ["Play", "Simulation", "Watch the last game", "High scores", "Settings", "Quit"];
        Self { scene: Scene::new(context.pen.screen()), menu: Menu::new(labels.map(Item::new).into()) }
    }

    fn choose(&self, choice: Choice, context: &mut Context) -> Change {
        let Choice::Pick(item) = choice else { return Change::Stay };
        match item {
            PLAY => Play::start(context),
            SIMULATION => Change::push(Pick::new(context)),
            REPLAY => Play::replay(context),
            SCORES => Change::push(ScoreList::new(context)),
            SETTINGS => Change::push(SettingsMenu::new(context)),
            _ => Change::Quit,
        }
    }
}

impl Scene {
    fn new(screen: Vec2) -> Option<Self> {
        let stage = Stage::builtin("hunt")?;
        let mut camera = first_view(stage.world(), stage.player(), VIEW, screen);
        camera.shift(-BESIDE);
        let viewer = Viewer::new(stage.world(), camera);
        Some(Self { stage, bot: Bot::new(Policy::Greedy, 1), viewer })
    }

    /// Goes on, unless the player wants less motion.
    fn run(&mut self, context: &Context) {
        let bot = &mut self.bot;
        let speed = if context.motion().is_some() { 1.0 } else { 0.0 };
        self.viewer.run(context.pace, speed, &mut self.stage, |stage| {
            if let Some(player) = stage.player() {
                let intent = bot.intent(stage.world(), player);
                stage.steer(intent);
            }
            stage.step();
            stage.world()
        });
        let at = self.viewer.place_of(self.stage.world(), self.stage.player());
        self.viewer.look(0.0, 0.0, at.map(|at| at - BESIDE), None, context.pace.elapsed);
    }
}

impl Screen for Title {
    fn update(&mut self, input: &Input, context: &mut Context) -> Change {
        if let Some(scene) = &mut self.scene {
            scene.run(context);
            if scene.stage.world().time() > SCENE_TIME {
                self.scene = Scene::new(context.pen.screen());
            }
        }
        if input.step == Some(Move::Back) {
            return Change::Quit;
        }
        let place = Place::title(&context.pen);
        let choice = self.menu.update(input, &place);
        choice.map_or(Change::Stay, |choice| self.choose(choice, context))
    }

    fn draw(&mut self, context: &mut Context) {
        if let Some(scene) = &mut self.scene {
            scene.viewer.camera.resize(context.pen.screen());
            let view = scene.viewer.view(scene.stage.world());
            context.paint(view, &scene.viewer.camera);
        }
        if !context.is_top {
            return;
        }
        let pen = &mut context.pen;
        let (screen, line) = (pen.screen(), pen.line(Size::Huge));
        let place = Place::title(pen);
        let left = place.corner.x;
        let shade = [fade(INK, 0.82), fade(INK, 0.0), fade(INK, 0.0), fade(INK, 0.82)];
        let wide = (left + 1.6 * place.item.x).min(screen.x);
        pen.canvas()
            .quad([Vec2::ZERO, Vec2::new(wide, 0.0), Vec2::new(wide, screen.y), Vec2::new(0.0, screen.y)], shade);
        let [title, below, end] = title_lines(pen);
        pen.write(Vec2::new(left, title), Size::Huge, Align::Left, HALO, TITLE);
        if place.corner.y >= end {
            let motto = Vec2::new(left + 0.05 * line, below);
            pen.write(motto, Size::Body, Align::Left, fade(HALO, 0.85), "a cell under the microscope");
        }
        self.menu.draw(pen, &place);
        let version = concat!("version ", env!("CARGO_PKG_VERSION"));
        let corner = screen - 0.8 * pen.line(Size::Small);
        pen.label(corner, Size::Small, Align::Right, HALO, version);
    }

    fn is_overlay(&self) -> bool {
        false
    }

    fn name(&self) -> String {
        "title".to_owned()
    }
}
