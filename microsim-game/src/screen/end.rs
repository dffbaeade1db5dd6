//! The end of a round: the score by kind, and its place among the best.

use super::page::draw_shade;
use super::play::Play;
use super::scores::draw_table;
use super::title::Title;
use super::{Change, Context, LAST_GAME, Screen};
use crate::draw::palette::{HALO, READY};
use crate::input::{Action, Input, Move};
use crate::rules::referee::Tally;
use crate::rules::round::Round;
use crate::store::scores::Score;
use crate::ui::menu::{Choice, Item, Menu, Place};
use crate::ui::pen::{Align, Pen, Size};
use microsim_core::Kind;
use microsim_core::glam::Vec2;

/// Share of the picture's height above the menu.
const MENU_TOP: f32 = 0.62;
/// Time for which the menu does not answer, s: the player may still be holding keys.
const DELAY: f32 = 0.7;

/// The end of a round.
#[derive(Debug)]
pub struct End {
    heading: String,
    points: u32,
    tallies: Vec<(Kind, Tally)>,
    /// The best ones of the same game; none after a replay, which may be of another one.
    best: Vec<Score>,
    place: Option<usize>,
    menu: Menu,
    since: f32,
}

impl End {
    /// The end of a round that was played, which is kept among the best, or replayed.
    #[must_use]
    pub fn new(round: &Round, context: &mut Context) -> Self {
        let (game, referee) = (context.game.label(), round.referee());
        let time = referee.game().time;
        let count = |is_rigid: bool| {
            let of_kind = referee.tallies().iter().filter(|(kind, _)| (*kind == Kind::RigidCell) == is_rigid);
            of_kind.map(|(_, tally)| tally.count).sum()
        };
        let score =
            Score { game: game.clone(), time, points: referee.score(), small: count(false), rigid: count(true) };
        let (mut place, mut best) = (None, Vec::new());
        if let Some(record) = round.record() {
            let (found, kept) = context.scores.add(score, &context.store);
            place = found;
            best = context.scores.of(&game, time).take(5).cloned().collect();
            if let Err(error) = kept.and(context.store.write(LAST_GAME, &record)) {
                context.tell(format!("cannot keep the game: {error}"));
            }
            context.last_game = Some(record);
        }
        let items = ["Play again", "Watch it again", "Title"].map(Item::new);
        let doubt = if round.mismatch().is_some() { ", not as it was played" } else { "" };
        Self {
            heading: format!("{} points{doubt}", referee.score()),
            points: referee.score(),
            tallies: referee.tallies().to_vec(),
            best,
            place,
            menu: Menu::new(items.into()),
            since: 0.0,
        }
    }

    fn draw_tallies(&self, pen: &mut Pen, top: f32) {
        let (middle, line) = (0.25 * pen.screen().x, pen.line(Size::Body));
        for (k, (kind, tally)) in self.tallies.iter().enumerate() {
            let y = top + line * k as f32;
            let what = format!("{} x {}", tally.count, plain_name(*kind));
            pen.write(Vec2::new(middle + 1.0 * line, y), Size::Body, Align::Right, HALO, &what);
            pen.write(Vec2::new(middle + 4.0 * line, y), Size::Body, Align::Right, HALO, &tally.points.to_string());
        }
    }
}

/// What players call it.
fn plain_name(kind: Kind) -> &'static str {
    match kind {
        Kind::Agar => "agar",
        Kind::Coccus => "cocci",
        Kind::Bacillus => "rods",
        Kind::RigidCell => "rigid cells",
        other => other.name(),
    }
}

impl Screen for End {
    fn update(&mut self, input: &Input, context: &mut Context) -> Change {
        self.since += context.pace.elapsed;
        if self.since < DELAY {
            return Change::Stay;
        }
        if input.presses(Action::Restart) {
            return Play::start(context);
        }
        if input.step == Some(Move::Back) {
            return Change::reset(Title::new(context));
        }
        match self.menu.update(input, &Place::middle(&context.pen, MENU_TOP)) {
            Some(Choice::Pick(0)) => Play::start(context),
            Some(Choice::Pick(1)) => Play::replay(context),
            Some(_) => Change::reset(Title::new(context)),
            None => Change::Stay,
        }
    }

    fn draw(&mut self, context: &mut Context) {
        let pen = &mut context.pen;
        draw_shade(pen);
        let (screen, line) = (pen.screen(), pen.line(Size::Body));
        let heading = Vec2::new(0.5 * screen.x, 0.09 * screen.y);
        pen.write(heading, Size::Large, Align::Centre, HALO, &self.heading);
        if let Some(place) = self.place {
            let text = if place == 0 { "The best so far!".to_owned() } else { format!("Number {} so far", place + 1) };
            let below = heading + Vec2::new(0.0, 0.95 * pen.line(Size::Large));
            pen.write(below, Size::Body, Align::Centre, READY, &text);
        }
        self.draw_tallies(pen, 0.28 * screen.y + line);
        draw_table(pen, [0.74 * screen.x, 0.28 * screen.y], MENU_TOP * screen.y, &self.best, self.place);
        self.menu.draw(pen, &Place::middle(pen, MENU_TOP));
    }

    fn name(&self) -> String {
        format!("end-{}", self.points)
    }
}
