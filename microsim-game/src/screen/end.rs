//! The end of a round: the score by kind, its place among the best, what was missed, and the next goal.

use super::context::AppContext;
use super::end_menu::{EndMenu, doubted, rank, signature};
use super::scores::draw_table;
use super::{MainScreen, Next, Paused, Screen};
use crate::draw::palette::{HALO, READY};
use crate::input::Input;
use crate::rules::end_advice;
use crate::rules::prey_class;
use crate::rules::referee::KindScore;
use crate::rules::round::RoundResult;
use crate::store::scores::Score;
use crate::ui::font::TextSize;
use crate::ui::menu::{Menu, MenuLayout};
use crate::ui::pen::{Align, Pen};
use crate::words::{self, Key};
use microsim_core::Kind;
use microsim_core::glam::Vec2;

/// Share of the picture's height above the menu.
const MENU_TOP: f32 = 0.62;

#[derive(Debug)]
pub(super) struct End {
    heading: String,
    points: u32,
    kinds: Vec<(Kind, KindScore)>,
    /// The best ones of the same game; none after a replay, which may be of another one.
    best: Vec<Score>,
    place: Option<usize>,
    missed: Option<String>,
    /// None after a replay.
    goal: Option<String>,
    menu: EndMenu,
    played: Paused,
}

impl End {
    /// The end of a round that was played, which is kept among the best, or replayed.
    pub(super) fn new(result: RoundResult, played: Paused, context: &mut AppContext) -> Self {
        let missed = end_advice::missed(&result);
        let RoundResult { score: points, time, kinds, record, is_mismatch, .. } = result;
        let game = context.game_of(played).label();
        let [small, rigid] = prey_class::counts(&kinds);
        let (name, day) = signature(context);
        let score = Score { game: game.clone(), time, points, small, rigid, name, day };
        let (mut place, mut best, is_own) = (None, Vec::new(), record.is_some());
        if let Some(record) = record {
            let (found, kept) = context.scores.add(score, &context.store);
            place = found;
            best = context.scores.of(&game, time).take(5).cloned().collect();
            context.keep_game(record, kept);
        }
        let menu = EndMenu::new(&[Key::EndAgain, Key::EndWatch, Key::Title]);
        let heading = doubted(words::text_with(Key::EndPoints, &[("points", points.into())]), is_mismatch);
        let better = best.iter().map(|score| score.points).filter(|&other| other > points).min();
        let goal = is_own.then(|| end_advice::next_goal(points, better));
        Self { heading, points, kinds, best, place, missed, goal, menu, played }
    }

    fn draw_kinds(&self, pen: &mut Pen, top: f32) {
        let (middle, line) = (0.28 * pen.screen().x, pen.line(TextSize::Body));
        for (k, (kind, entry)) in self.kinds.iter().enumerate() {
            let y = top + line * k as f32;
            let what = format!("{}: {}", plain_name(*kind), entry.count);
            pen.write(Vec2::new(middle + 1.0 * line, y), TextSize::Body, Align::Right, HALO, &what);
            pen.write(Vec2::new(middle + 4.0 * line, y), TextSize::Body, Align::Right, HALO, &entry.points.to_string());
        }
    }
}

/// What players call it.
fn plain_name(kind: Kind) -> &'static str {
    match kind {
        Kind::Agar => words::text(Key::KindAgar),
        Kind::Coccus => words::text(Key::KindCocci),
        Kind::Bacillus => words::text(Key::KindRods),
        Kind::RigidCell => words::text(Key::KindRigidCells),
        other => other.name(),
    }
}

impl Screen for End {
    fn update(&mut self, input: &Input, context: &mut AppContext) -> Next {
        // A replay leads on to a round of the game.
        let next = if self.played == Paused::Replay { Paused::Round } else { self.played };
        self.menu.lead(input, context, MENU_TOP, || next.restart(), &[|_| Next::Show(MainScreen::Replay)])
    }

    fn draw(&mut self, context: &mut AppContext) {
        let pen = &mut context.pen;
        self.menu.draw_shade(pen);
        let (screen, line) = (pen.screen(), pen.line(TextSize::Body));
        EndMenu::draw_panel(pen, 0.86 * screen.x, [0.06 * screen.y, (MENU_TOP - 0.03) * screen.y]);
        let heading = Vec2::new(0.5 * screen.x, 0.09 * screen.y);
        pen.write(heading, TextSize::Large, Align::Centre, HALO, &self.heading);
        if let Some(place) = self.place {
            let below = heading + Vec2::new(0.0, 0.95 * pen.line(TextSize::Large));
            let colour = if place == 0 { READY } else { HALO };
            pen.write(below, TextSize::Body, Align::Centre, colour, &rank(place));
        }
        let told = [self.missed.as_deref(), self.goal.as_deref()].into_iter().flatten();
        let told: Vec<String> = told.flat_map(|text| pen.wrap(TextSize::Small, text, 0.94 * screen.x)).collect();
        let small = pen.line(TextSize::Small);
        let first = (MENU_TOP - 0.02) * screen.y - small * (told.len() as f32 - 0.3);
        for (k, text) in told.iter().enumerate() {
            pen.write(Vec2::new(0.5 * screen.x, first + small * k as f32), TextSize::Small, Align::Centre, HALO, text);
        }
        self.draw_kinds(pen, 0.28 * screen.y + line);
        draw_table(pen, [0.71 * screen.x, 0.28 * screen.y], first - small, &self.best, (Key::ScoresPoints, self.place));
        self.menu.menu.draw(pen, &MenuLayout::middle(pen, MENU_TOP));
    }

    fn menu(&self) -> Option<&Menu> {
        Some(&self.menu.menu)
    }

    fn name(&self) -> String {
        format!("end-{}", self.points)
    }
}
