//! The title: the hunt goes on behind the menu.

use super::context::AppContext;
use super::{MainScreen, Next, Overlay, Screen};
use crate::draw::palette::{HALO, INK, fade};
use crate::input::{Input, Move};
use crate::platform;
use crate::rules::bot::{Bot, Policy};
use crate::rules::food_chain::feats::Feats;
use crate::stage::Stage;
use crate::ui::font::{TITLE, TextSize};
use crate::ui::menu::{Menu, MenuChoice, MenuItem, MenuLayout, title_lines};
use crate::ui::pen::Align;
use crate::viewer::{Viewer, first_view};
use crate::words::{self, Key};
use microsim_core::glam::Vec2;

/// Height of the picture behind the menu, units.
const VIEW: f32 = 42.0;
/// The menu covers the middle: the hunter is seen beside it.
const BESIDE: Vec2 = Vec2::new(0.36 * VIEW, 0.0);
/// The backdrop starts over after this time, s: by then most of the prey is eaten.
const SCENE_TIME: f64 = 90.0;

#[derive(Debug)]
pub(super) struct Title {
    backdrop: Option<Backdrop>,
    menu: Menu,
    targets: Vec<(Key, Target)>,
    /// What is said below the title: where to begin to one without a star, or the next goal of the food chain to one who has played it.
    note: Option<String>,
}

#[derive(Debug)]
struct Backdrop {
    stage: Stage,
    bot: Bot,
    viewer: Viewer,
}

/// Where an item of the menu leads.
type Target = fn() -> Next;

/// What the menu may offer.
const ITEMS: [(Key, Target); 11] = [
    (Key::TitlePlay, || Next::Show(MainScreen::Round)),
    (Key::TitleSlides, || Next::Open(Overlay::Slides(None))),
    (Key::TitleFoodChain, || Next::Open(Overlay::FoodChain)),
    (Key::TitleTwoPlayers, || Next::Open(Overlay::TwoPlayers)),
    (Key::TitleNetwork, || Next::Open(Overlay::Join)),
    (Key::TitleSimulation, || Next::Open(Overlay::Pick)),
    (WATCH, || Next::Show(MainScreen::Replay)),
    (Key::TitleGuide, || Next::Open(Overlay::Guide)),
    (Key::TitleScores, || Next::Open(Overlay::Scores)),
    (Key::Settings, || Next::Open(Overlay::Settings)),
    (QUIT, || Next::Open(Overlay::Quit)),
];
/// Offered only if a game was played, and where the program can end of itself.
const WATCH: Key = Key::TitleWatch;
const QUIT: Key = Key::TitleQuit;

impl Title {
    /// The title, with its backdrop at the beginning.
    pub(super) fn new(context: &AppContext) -> Self {
        let targets = offered(context.last_game.is_some(), platform::CAN_QUIT);
        let items = targets.iter().map(|&(label, _)| MenuItem::new(label)).collect();
        let best = context.chain_records.best;
        let goal = best.next_goal(Key::TitleGoal).filter(|_| best != Feats::default());
        let is_new = context.best_times.is_empty();
        let note = is_new.then(|| words::text(Key::TitleNew).to_owned()).or(goal);
        // Who is new begins with the slides.
        let menu = title_menu(items, context.title_item.unwrap_or(usize::from(is_new)));
        Self { backdrop: Backdrop::new(context.pen.screen()), menu, targets, note }
    }
}

/// The menu, of which "Play" is always seen.
fn title_menu(items: Vec<MenuItem>, focus: usize) -> Menu {
    let mut menu = Menu::new(items);
    menu.keeps_first = true;
    menu.set_focus(focus);
    menu
}

/// What the menu offers now.
fn offered(has_played: bool, can_quit: bool) -> Vec<(Key, Target)> {
    let is_offered = |label| (label != WATCH || has_played) && (label != QUIT || can_quit);
    ITEMS.into_iter().filter(|&(label, _)| is_offered(label)).collect()
}

impl Backdrop {
    fn new(screen: Vec2) -> Option<Self> {
        let stage = Stage::builtin("hunt")?;
        let mut camera = first_view(stage.world(), stage.player(), VIEW, screen);
        camera.shift(-BESIDE);
        let viewer = Viewer::new(stage.world(), camera);
        Some(Self { stage, bot: Bot::new(Policy::Greedy, 1), viewer })
    }

    /// Goes on, unless the player wants less motion.
    fn run(&mut self, context: &AppContext) {
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
    fn update(&mut self, input: &Input, context: &mut AppContext) -> Next {
        if let Some(backdrop) = &mut self.backdrop {
            backdrop.run(context);
            if backdrop.stage.world().time() > SCENE_TIME {
                self.backdrop = Backdrop::new(context.pen.screen());
            }
        }
        if platform::CAN_QUIT && input.step == Some(Move::Back) {
            return Next::Open(Overlay::Quit);
        }
        match self.menu.update(input, &MenuLayout::title(&context.pen)) {
            Some(MenuChoice::Pick(item)) => {
                context.title_item = Some(item);
                self.targets[item].1()
            }
            _ => Next::Stay,
        }
    }

    fn draw(&mut self, context: &mut AppContext) {
        if let Some(backdrop) = &mut self.backdrop {
            backdrop.viewer.camera.resize(context.pen.screen());
            let view = backdrop.viewer.view(backdrop.stage.world());
            context.paint(view, &backdrop.viewer.camera);
        }
        if !context.is_top {
            return;
        }
        let pen = &mut context.pen;
        let (screen, line) = (pen.screen(), pen.line(TextSize::Huge));
        let layout = MenuLayout::title(pen);
        let left = layout.corner.x;
        let shade = [fade(INK, 0.82), fade(INK, 0.0), fade(INK, 0.0), fade(INK, 0.82)];
        let wide = (left + 1.6 * layout.item.x).min(screen.x);
        let (right, below) = (Vec2::new(wide, 0.0), Vec2::new(0.0, screen.y));
        pen.canvas().quad([Vec2::ZERO, right, right + below, below], shade);
        let [title, below, end] = title_lines(pen);
        pen.write(Vec2::new(left, title), TextSize::Huge, Align::Left, HALO, TITLE);
        if layout.corner.y >= end {
            let motto = Vec2::new(left + 0.05 * line, below);
            match &self.note {
                Some(note) => pen.label(motto, TextSize::Body, Align::Left, HALO, note),
                None => {
                    let colour = fade(HALO, 0.85);
                    pen.write(motto, TextSize::Body, Align::Left, colour, words::text(Key::TitleMotto));
                }
            }
        }
        self.menu.draw(pen, &layout);
        let version = words::text_with(Key::TitleVersion, &[("version", env!("CARGO_PKG_VERSION").into())]);
        let corner = screen - 0.8 * pen.line(TextSize::Small);
        pen.label(corner, TextSize::Small, Align::Right, HALO, &version);
    }

    fn menu(&self) -> Option<&Menu> {
        Some(&self.menu)
    }

    fn name(&self) -> String {
        "title".to_owned()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ui::pen::Pen;

    #[test]
    fn play_is_seen_with_every_size_of_text_in_every_window_whatever_was_chosen_before() {
        let items = |count| (0..count).map(|_| MenuItem::new(Key::TitlePlay)).collect();
        for screen in [(640.0, 360.0), (960.0, 540.0), (800.0, 600.0), (360.0, 640.0), (1280.0, 720.0)] {
            for wish in [0.85, 1.0, 1.25, 1.5] {
                let layout = MenuLayout::title(&Pen::measured(screen.into(), wish).0);
                for focus in 0..ITEMS.len() {
                    let mut menu = title_menu(items(ITEMS.len()), focus);
                    menu.update(&Input::default(), &layout);
                    let seen: Vec<usize> = menu.shown(&layout).map(|(item, _)| item).collect();
                    assert!(seen.contains(&0) && seen.contains(&focus), "{screen:?}, {wish}: {seen:?} with {focus}");
                }
            }
        }
    }

    #[test]
    fn a_game_is_watched_only_after_one_and_a_page_has_no_quit() {
        let labels =
            |has_played, can_quit| offered(has_played, can_quit).into_iter().map(|item| item.0).collect::<Vec<_>>();
        assert!(labels(false, true).contains(&QUIT) && !labels(false, true).contains(&WATCH));
        assert!(labels(true, false).contains(&WATCH) && !labels(true, false).contains(&QUIT));
        assert_eq!(labels(true, true).len(), ITEMS.len());
    }
}
