//! An article of the field guide: a picture, what it says, and where that is from.

use super::context::AppContext;
use super::page::draw_heading;
use super::{Next, Overlay, Screen};
use crate::album;
use crate::camera::Camera;
use crate::convert;
use crate::draw::palette::{HALO, fade};
use crate::guide::Entry;
use crate::input::{Input, Move};
use crate::scenery::Sight;
use crate::stage::Stage;
use crate::ui::font::TextSize;
use crate::ui::menu::{Menu, MenuChoice, MenuItem, MenuLayout};
use crate::ui::pen::{Align, Pen};
use crate::words::articles::Article;
use crate::words::{self, Key};
use macroquad::color::WHITE;
use macroquad::texture::{DrawTextureParams, RenderTarget, draw_texture_ex};
use microsim_core::glam::Vec2;

/// Share of the picture's height above the menu, and above the text.
const MENU_TOP: f32 = 0.86;
const TEXT_TOP: f32 = 0.22;
/// Size of a picture, pixels, and the least share of the height that it is shown with.
const PICTURE: Vec2 = Vec2::new(640.0, 360.0);
const LEAST_HEIGHT: f32 = 0.18;
/// What is seen from bottom to top: so many sizes of what is shown, but some units in any case.
const AROUND: f32 = 1.8;
const LEAST_VIEW: f32 = 9.0;
const WHOLE_VIEW: f32 = 40.0;

#[derive(Debug)]
pub(super) struct ArticlePage {
    entry: &'static Entry,
    /// None before it is taken, and if its scene does not open.
    picture: Option<RenderTarget>,
    is_taken: bool,
    menu: Menu,
}

impl ArticlePage {
    pub(super) fn new(entry: &'static Entry) -> Self {
        let menu = Menu::new([Key::Back, Key::TitleGuide].map(MenuItem::new).into());
        Self { entry, picture: None, is_taken: false, menu }
    }

    fn take_picture(&mut self, context: &mut AppContext) {
        self.is_taken = true;
        let Some(mut stage) = Stage::builtin(self.entry.scene.0) else { return };
        while stage.world().time() < self.entry.scene.1 {
            stage.step();
        }
        let sight = Sight::all().find(|sight| sight.name() == self.entry.name).unwrap_or_else(|| context.sight());
        let camera = camera(&stage, self.entry);
        self.picture = Some(album::take(stage.world().view(), &camera, sight, &mut context.scenery));
    }

    /// Draws the picture, where there is room, and the text below it.
    fn draw_article(&self, pen: &mut Pen, article: &Article) {
        let (screen, top) = (pen.screen(), TEXT_TOP * pen.screen().y);
        let bottom = MenuLayout::middle(pen, MENU_TOP).corner.y - 0.4 * pen.line(TextSize::Small);
        let fits = |size: &TextSize| height(pen, &lines(pen, article, *size)) <= bottom - top;
        let size = [TextSize::Body, TextSize::Small].into_iter().find(fits).unwrap_or(TextSize::Small);
        let lines = lines(pen, article, size);
        let room = bottom - top - height(pen, &lines) - pen.line(TextSize::Small);
        let shown = self.picture.as_ref().filter(|_| room >= LEAST_HEIGHT * screen.y);
        let high = room.min(0.5 * screen.y).min(0.9 * screen.x * PICTURE.y / PICTURE.x);
        if let Some(target) = shown {
            let wide = high * PICTURE.x / PICTURE.y;
            let params = DrawTextureParams {
                dest_size: Some(convert::pair(Vec2::new(wide, high))),
                flip_y: true,
                ..Default::default()
            };
            pen.flush();
            draw_texture_ex(&target.texture, 0.5 * (screen.x - wide), top, WHITE, params);
        }
        let mut y = top + if shown.is_some() { high + 0.6 * pen.line(TextSize::Small) } else { 0.0 };
        for (size, alpha, text) in lines {
            y += 0.5 * pen.line(size);
            pen.write(Vec2::new(0.5 * screen.x, y), size, Align::Centre, fade(HALO, alpha), &text);
            y += 0.5 * pen.line(size);
        }
    }
}

/// Text, and its source in small letters, in lines.
fn lines(pen: &Pen, article: &Article, size: TextSize) -> Vec<(TextSize, f32, String)> {
    let width = |size| (0.92 * pen.screen().x).min(34.0 * pen.line(size));
    let text = pen.wrap(size, article.text, width(size)).into_iter().map(|line| (size, 1.0, line));
    let source = pen.wrap(TextSize::Small, article.source, width(TextSize::Body)).into_iter();
    text.chain(source.map(|line| (TextSize::Small, 0.75, line))).collect()
}

fn height(pen: &Pen, lines: &[(TextSize, f32, String)]) -> f32 {
    lines.iter().map(|(size, ..)| pen.line(*size)).sum()
}

/// The view of what an entry is about.
fn camera(stage: &Stage, entry: &Entry) -> Camera {
    let (view, room) = (stage.world().view(), stage.world().config().size);
    let of_kind = |kind| view.organisms().find(|organism| organism.kind() == kind);
    let shown = entry.kind.and_then(of_kind);
    let (centre, size) = match shown.or_else(|| view.organism(stage.player()?)) {
        Some(organism) if shown.is_some() => {
            let (low, high) = organism.bounds();
            (0.5 * (low + high), (AROUND * (high - low).max_element()).clamp(LEAST_VIEW, room.y))
        }
        Some(organism) => (organism.centroid(), WHOLE_VIEW),
        None => (0.5 * room, room.y),
    };
    Camera::around(centre, size, room, PICTURE)
}

impl Screen for ArticlePage {
    fn update(&mut self, input: &Input, context: &mut AppContext) -> Next {
        if !self.is_taken {
            self.take_picture(context);
        }
        if input.step == Some(Move::Back) {
            return Next::Back;
        }
        let layout = MenuLayout::middle(&context.pen, MENU_TOP);
        match self.menu.update(input, &layout) {
            Some(MenuChoice::Pick(1)) => Next::Open(Overlay::Guide),
            Some(_) => Next::Back,
            None => Next::Stay,
        }
    }

    fn draw(&mut self, context: &mut AppContext) {
        let article = context.article(self.entry.name);
        let pen = &mut context.pen;
        draw_heading(pen, article.map_or_else(|| words::text(Key::Waiting), |article| article.title));
        if let Some(article) = article {
            self.draw_article(pen, article);
        }
        self.menu.draw(pen, &MenuLayout::middle(pen, MENU_TOP));
    }

    fn menu(&self) -> Option<&Menu> {
        Some(&self.menu)
    }

    fn name(&self) -> String {
        format!("article-{}", self.entry.name)
    }
}
