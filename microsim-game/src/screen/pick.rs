//! The list of scenarios to look at: those that come with the program, and files.

use super::pause::draw_heading;
use super::sandbox::Sandbox;
use super::{Change, Context, Screen};
use crate::args::Scene;
use crate::draw::palette::HALO;
use crate::input::{Input, Move};
use crate::stage::Stage;
use crate::ui::menu::{Choice, Item, Menu, Place};
use crate::ui::pen::{Align, Size};
use microsim_core::glam::Vec2;
use microsim_core::scenario;

/// Share of the picture's height above the list.
const TOP: f32 = 0.24;

/// The list of scenarios.
#[derive(Debug)]
pub struct Pick {
    menu: Menu,
    scenes: Vec<(Scene, &'static str)>,
}

impl Pick {
    /// The files that the player has named or dropped, and the built-in scenarios.
    #[must_use]
    pub fn new(context: &Context) -> Self {
        let files = context.files.iter().map(|file| (file.clone(), "a file"));
        let builtins = scenario::builtins().iter().map(|found| (Scene::Builtin(found.name.to_owned()), found.summary));
        let scenes: Vec<_> = files.chain(builtins).collect();
        let items = scenes.iter().map(|(scene, _)| Item::new(scene.to_string())).collect();
        Self { menu: Menu::new(items), scenes }
    }
}

impl Screen for Pick {
    fn update(&mut self, input: &Input, context: &mut Context) -> Change {
        if input.step == Some(Move::Back) {
            return Change::Pop;
        }
        let choice = self.menu.update(input, &Place::middle(&context.pen, TOP));
        let Some(Choice::Pick(item)) = choice else { return Change::Stay };
        match Stage::open(&self.scenes[item].0, &[]) {
            Ok(stage) => Change::reset(Sandbox::new(stage, context)),
            Err(problem) => {
                context.tell(problem);
                Change::Stay
            }
        }
    }

    fn draw(&mut self, context: &mut Context) {
        let pen = &mut context.pen;
        draw_heading(pen, "Simulation");
        let summary = self.scenes.get(self.menu.focus()).map_or("", |(_, summary)| *summary);
        let at = Vec2::new(0.5 * pen.screen().x, 0.2 * pen.screen().y);
        pen.write(at, Size::Small, Align::Centre, HALO, summary);
        self.menu.draw(pen, &Place::middle(pen, TOP));
    }

    fn name(&self) -> String {
        "scenarios".to_owned()
    }
}
