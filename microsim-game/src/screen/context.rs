//! What all screens share: the pen, the settings, the scores and the message.

use super::photo_view::PhotoView;
use super::{MainScreen, Paused};
use crate::album::Album;
use crate::camera::Camera;
use crate::draw::SceneFrame;
use crate::draw::palette::{HALO, INK, fade};
use crate::game_choice::GameChoice;
use crate::guide;
use crate::hud::captions::Captions;
use crate::network::room::Room;
use crate::platform::{self, Speaker};
use crate::rules::food_chain::change::Change;
use crate::rules::food_chain::feats::Feats;
use crate::rules::lesson::Lessons;
use crate::rules::two_players::RoundsWon;
use crate::scene_source::SceneSource;
use crate::scenery::{Effort, Scenery, Sight};
use crate::stage::Stage;
use crate::store::best_life::BestLife;
use crate::store::best_times::BestTimes;
use crate::store::chain_records::ChainRecords;
use crate::store::files::PlayerFolder;
use crate::store::found::FoundEntries;
use crate::store::scores::Scores;
use crate::store::settings::{self as kept, Settings};
use crate::store::toml_value::from_toml;
use crate::ui::font::TextSize;
use crate::ui::pen::{Align, Pen};
use crate::viewer::Pace;
use crate::words::articles::{self, Article};
use crate::words::{self, Key, LANGUAGES, Language};
use microsim_core::View;
use microsim_core::glam::Vec2;
use std::io;

/// File of the last round that was played to its end: a replay, which `microsim replay` reads too.
const LAST_GAME: &str = "last-game.replay";
/// How long a message is shown: at least, for each of its bytes, and at most, s.
const MESSAGE_TIME: f32 = 4.0;
const READING_TIME: f32 = 0.04;
const LONGEST_TIME: f32 = 20.0;
/// Most lines and letters of a message.
const MESSAGE_LINES: usize = 10;
const MESSAGE_LETTERS: usize = 700;

/// The optics, quality and language that the command line asks for, in place of the settings.
#[derive(Clone, Copy, Debug, Default)]
pub struct Asked {
    /// The way of looking.
    pub sight: Option<Sight>,
    /// How much of the machine pictures may take.
    pub effort: Option<Effort>,
    /// The language of what is read.
    pub language: Option<&'static Language>,
}

/// Chooses the language of what is read before the settings are there.
pub(crate) fn choose_first_language(asked: &Asked, store: &PlayerFolder, system: &'static Language) {
    let kept = store.read(kept::FILE).and_then(|bytes| from_toml::<Settings>(std::str::from_utf8(&bytes).ok()?));
    let kept = kept.and_then(|settings| Language::named(&settings.language));
    show_language(asked.language.or(kept).unwrap_or(system));
}

/// Takes over a language, once its texts are there.
fn show_language(language: &'static Language) {
    if words::choose(language, || platform::words(language.code)) {
        platform::show_language(language.code);
    }
}

/// What the command line says of playing over a network.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Party {
    /// Address of the server; a page has its own.
    pub server: String,
    /// Code of the room.
    pub code: String,
    /// Name of this player.
    pub name: String,
    /// What only this player knows: by it the server gives the place in a room back after a cut.
    pub key: String,
}

/// What all screens share.
#[derive(Debug)]
pub struct AppContext {
    /// Draws the scene.
    pub scenery: Scenery,
    /// Pictures for the list of simulations.
    pub album: Album,
    /// Draws above it.
    pub pen: Pen,
    /// Plays what is heard.
    pub speaker: Speaker,
    /// Where settings and scores are kept.
    pub store: PlayerFolder,
    /// What the player has chosen.
    pub settings: Settings,
    /// The settings when they were last read or kept.
    kept_settings: Settings,
    /// High scores.
    pub scores: Scores,
    /// Best times for the slides.
    pub best_times: BestTimes,
    /// What the player has reached in the food chain.
    pub chain_records: ChainRecords,
    /// The most of all lives in it before the main screen was shown.
    pub(super) best_before: Feats,
    /// The longest life in a water of the food chain.
    pub best_life: BestLife,
    /// What the player has found of the field guide.
    pub found: FoundEntries,
    /// How time passes in this frame.
    pub pace: Pace,
    /// Time since the program began, s.
    pub time: f32,
    /// The game that is played.
    pub game: GameChoice,
    /// A game that the player has opened beside it.
    pub(super) other_game: Option<GameChoice>,
    /// The item of the title's menu that was chosen last.
    pub(super) title_item: Option<usize>,
    /// What was opened last of the list of simulations.
    pub(super) picked: Option<SceneSource>,
    /// Scenario files that the player has named or dropped, for the list.
    pub files: Vec<SceneSource>,
    /// The last round that was played to its end, as a replay.
    pub last_game: Option<Vec<u8>>,
    /// The rounds of two players that were won since the program began.
    pub(super) rounds_won: RoundsWon,
    /// Which of its players this one was, as far as that is known.
    pub(super) last_seat: usize,
    /// What was explained so far.
    pub(super) lessons: Lessons,
    /// The change of the body that was chosen, for the food chain below the choice.
    pub(super) chosen: Option<Change>,
    /// With whom this player plays over a network, and the room that it is in.
    pub party: Party,
    pub(super) room: Option<Room>,
    /// What a photo shows of the scene, while one is prepared.
    pub(super) photo: Option<PhotoView>,
    /// Whether the screen that draws has nothing above it.
    pub is_top: bool,
    /// Whether a picture is wanted.
    pub wants_picture: bool,
    /// Ways of looking for this run only, in place of the ones in the settings.
    pub asked: Asked,
    /// The language of the system.
    pub(crate) system_language: &'static Language,
    message: Option<(String, f32)>,
    pub(super) captions: Captions,
}

impl AppContext {
    /// What screens share at first. Needs an open window.
    #[must_use]
    pub fn new(store: PlayerFolder, game: GameChoice, files: Vec<SceneSource>) -> Self {
        let (settings, problem) = store.load::<Settings>(kept::FILE);
        let (scores, other_problem) = Scores::load(&store);
        let (best_times, third_problem) = BestTimes::load(&store);
        let (chain_records, fourth_problem) = ChainRecords::load(&store);
        let found = FoundEntries::load(&store);
        let best_life = BestLife::load(&store);
        let last_game = store.read(LAST_GAME);
        let mut context = Self {
            scenery: Scenery::new(),
            album: Album::default(),
            pen: Pen::new(),
            speaker: Speaker::default(),
            store,
            kept_settings: settings.clone(),
            settings,
            scores,
            best_times,
            best_before: chain_records.best,
            chain_records,
            best_life,
            found,
            pace: Pace { elapsed: 0.0, is_exact: false },
            time: 0.0,
            game,
            other_game: None,
            title_item: None,
            picked: None,
            files,
            last_game,
            last_seat: 0,
            rounds_won: RoundsWon::default(),
            lessons: Lessons::default(),
            chosen: None,
            party: Party::default(),
            room: None,
            photo: None,
            is_top: true,
            wants_picture: false,
            asked: Asked::default(),
            system_language: &LANGUAGES[0],
            message: None,
            captions: Captions::default(),
        };
        let other_language = context.settings.refuse_language();
        let refused = |code: String| words::text_with(Key::SettingsUnknownLanguage, &[("language", (&code).into())]);
        let problems = [problem, other_problem, third_problem, fourth_problem, other_language.map(refused)];
        let problems: Vec<String> = problems.into_iter().flatten().collect();
        if !problems.is_empty() {
            context.tell(problems.join("\n"));
        }
        context
    }

    /// Shows a message for a while.
    pub fn tell(&mut self, text: impl Into<String>) {
        let mut text = text.into();
        if let Some((end, _)) = text.char_indices().nth(MESSAGE_LETTERS) {
            text.truncate(end);
            text.push_str(" ...");
        }
        let time = (READING_TIME * text.len() as f32).clamp(MESSAGE_TIME, LONGEST_TIME);
        self.message = Some((text, self.time + time));
    }

    fn tell_error(&mut self, key: Key, error: &io::Error) {
        self.tell(words::text_with(key, &[("error", words::of_error(error.kind()).into())]));
    }

    /// Keeps a round that was played to its end, to be watched again. `kept` says whether what it earned was kept.
    pub(super) fn keep_game(&mut self, record: Vec<u8>, kept: io::Result<()>) {
        if let Err(error) = kept.and(self.store.write(LAST_GAME, &record)) {
            self.tell_error(Key::LastGameUnkept, &error);
        }
        (self.last_game, self.last_seat) = (Some(record), 0);
    }

    /// Notes an entry of the field guide as found.
    pub(super) fn find(&mut self, name: &str) {
        let kept = guide::find(name).map_or(Ok(()), |entry| self.found.add(entry, &self.store));
        if let Err(error) = kept {
            self.tell_error(Key::GuideUnkept, &error);
        }
    }

    /// An article of the field guide, once its text is there.
    pub(super) fn article(&self, name: &str) -> Option<&'static Article> {
        articles::article(name, platform::words)
    }

    /// Notes what was reached in a life of the food chain that is left before its end.
    pub(super) fn keep_feats(&mut self, feats: Feats) {
        if let Err(error) = self.chain_records.add(feats, None, &self.store) {
            self.tell_error(Key::LastGameUnkept, &error);
        }
    }

    /// Keeps the settings, and takes over what another window has kept meanwhile of those that were not changed here.
    pub fn save_settings(&mut self) {
        if self.store.read(kept::FILE).is_some() {
            // One that makes no sense is put aside.
            match self.store.load(kept::FILE) {
                (kept, None) => self.settings = self.settings.clone().over(&self.kept_settings, kept),
                (_, Some(problem)) => self.tell(problem),
            }
        }
        self.kept_settings = self.settings.clone();
        if let Err(error) = self.store.save(kept::FILE, &self.settings) {
            self.tell_error(Key::SettingsUnkept, &error);
        }
    }

    /// The present way of looking.
    #[must_use]
    pub fn sight(&self) -> Sight {
        self.asked.sight.unwrap_or_else(|| Sight::named(&self.settings.sight))
    }

    /// How much of the machine pictures may take.
    #[must_use]
    pub fn effort(&self) -> Effort {
        self.asked.effort.unwrap_or(self.settings.effort)
    }

    /// The language of what is read.
    #[must_use]
    pub fn language(&self) -> &'static Language {
        self.asked.language.or_else(|| Language::named(&self.settings.language)).unwrap_or(self.system_language)
    }

    /// Another language. The menu that asks for it keeps the settings.
    pub(super) fn change_language(&mut self, is_back: bool) {
        self.language().next(is_back).code.clone_into(&mut self.settings.language);
        self.asked.language = None;
        self.choose_language();
    }

    /// Takes over the language that is wanted, once its texts are there.
    pub(crate) fn choose_language(&mut self) {
        show_language(self.language());
    }

    /// Draws a scene as the player wants to see it. Returns what of it is seen, which is another part where a photo is prepared.
    pub fn paint(&mut self, view: View<'_>, camera: &Camera) -> Camera {
        let time = self.motion().unwrap_or(0.0);
        let camera = self.photo.as_mut().map_or_else(|| camera.clone(), |photo| photo.camera_from(camera).clone());
        self.scenery.paint(&SceneFrame { view, camera: &camera, time }, self.sight(), self.effort());
        camera
    }

    /// Whether pictures show the scene and nothing above it.
    #[must_use]
    pub(crate) fn is_photo(&self) -> bool {
        self.photo.is_some()
    }

    /// Another way of looking.
    pub fn change_sight(&mut self, is_back: bool) {
        let sight = self.sight().next(is_back);
        sight.name().clone_into(&mut self.settings.sight);
        self.asked.sight = None;
        self.scenery.take_heart();
        self.save_settings();
        self.find(sight.name());
        self.tell(sight.title());
    }

    /// The way of looking from before a photo.
    pub(super) fn put_back_sight(&mut self, sight: String, asked: Option<Sight>) {
        (self.settings.sight, self.asked.sight) = (sight, asked);
        self.scenery.take_heart();
        self.save_settings();
    }

    /// More or less of the machine for pictures.
    pub fn change_effort(&mut self, is_back: bool) {
        self.settings.effort = self.effort().next(is_back);
        self.asked.effort = None;
        self.scenery.take_heart();
        self.save_settings();
    }

    /// Opens a simulation, or a game, or tells what is wrong with it. A file moves to the front of the list of simulations.
    pub fn open(&mut self, source: &SceneSource) -> Option<MainScreen> {
        let stage = Stage::open(source, &[]).map_err(|problem| self.tell(problem)).ok()?;
        let game = GameChoice { source: source.clone(), overrides: Vec::new(), seed: None };
        if matches!(source, SceneSource::File(_)) {
            self.album.forget(source);
            self.files.retain(|known| known != source);
            self.files.insert(0, source.clone());
        }
        if !game.is_game() {
            return Some(MainScreen::Simulation(Box::new(stage)));
        }
        self.other_game = Some(game);
        Some(MainScreen::OtherGame)
    }

    /// The game that is played, or the one beside it.
    pub(super) fn game_of(&self, played: Paused) -> &GameChoice {
        self.other_game.as_ref().filter(|_| played == Paused::OtherGame).unwrap_or(&self.game)
    }

    /// Time for what moves of itself in marks and background; `None` if the player wants less motion.
    #[must_use]
    pub fn motion(&self) -> Option<f32> {
        (!self.settings.reduced_motion).then_some(self.time)
    }

    /// Draws captions, and the message, if there is one.
    pub(crate) fn draw_message(&mut self) {
        if self.photo.is_none() {
            self.captions.draw(&mut self.pen);
        }
        let Some((text, _)) = self.message.as_ref().filter(|(_, until)| self.time < *until) else { return };
        let pen = &mut self.pen;
        let (screen, line) = (pen.screen(), pen.line(TextSize::Small));
        let most = ((screen.y / line - 1.0) as usize).clamp(1, MESSAGE_LINES);
        let lines: Vec<String> = pen.wrap(TextSize::Small, text, 0.94 * screen.x).into_iter().take(most).collect();
        let widest = lines.iter().map(|text| pen.width(TextSize::Small, text)).fold(0.0, f32::max);
        let size = Vec2::new(widest + 0.8 * line, line * (lines.len() as f32 + 0.2));
        // A photo is seen whole but for its upper edge.
        let top = if self.photo.is_some() { 0.3 * line } else { 0.78 * screen.y };
        let low = Vec2::new(0.5 * (screen.x - size.x), top.min(screen.y - size.y - 0.3 * line));
        // Menus do not shine through.
        let radius = pen.rounding();
        pen.canvas().rounded(low, low + size, radius, fade(INK, 0.95));
        for (k, text) in lines.iter().enumerate() {
            let at = Vec2::new(0.5 * screen.x, low.y + line * (k as f32 + 0.6));
            pen.write(at, TextSize::Small, Align::Centre, HALO, text);
        }
    }
}
