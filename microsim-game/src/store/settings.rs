//! What the player has chosen.

use crate::input::keys::Keys;
use crate::input::{Action, Input};
use crate::scenery::Effort;
use crate::words::Language;
use serde::{Deserialize, Serialize};

/// File that they are kept in.
pub const FILE: &str = "settings.toml";
/// Sizes of text, relative to the usual one.
const TEXT_SIZES: [f32; 4] = [0.85, 1.0, 1.25, 1.5];
/// Speeds of time in rounds.
const PACES: [f32; 3] = [1.0, 0.75, 0.5];
/// Steps from silence to the full loudness.
const SOUND_STEPS: usize = 4;

/// What the player has chosen. Each has a default, so that files of other versions can be read.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Settings {
    /// Which of the sizes of text.
    pub text_size: usize,
    /// Nothing floats, pulses or drifts that does not have to.
    pub reduced_motion: bool,
    /// Food is digested only while a key is held, as in the thesis; otherwise as soon as it is inside.
    pub hold_to_digest: bool,
    /// A click starts and stops the crawl, in place of a button that is held.
    pub click_to_crawl: bool,
    /// Which of the speeds of time in rounds.
    pub pace: usize,
    /// Which of the steps from silence to the full loudness.
    pub sound: usize,
    /// What is heard is written, too.
    pub captions: bool,
    /// Green arrows over cells that cannot be taken in while there is no room, as in the thesis.
    pub classic_arrows: bool,
    /// What the player is called in the list of scores and, without `--name`, in rooms; empty for nothing.
    pub name: String,
    /// Name of the way of looking, see [`crate::scenery::Sight`].
    pub sight: String,
    /// Tag of the language, see [`Language`]; empty for that of the system.
    pub language: String,
    /// How much of the machine pictures may take.
    pub effort: Effort,
    /// Whether the window fills the screen.
    pub full_screen: bool,
    /// Keys of all actions.
    pub keys: Keys,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            text_size: 1,
            reduced_motion: false,
            hold_to_digest: false,
            click_to_crawl: false,
            pace: 0,
            sound: 3,
            captions: false,
            classic_arrows: false,
            name: String::new(),
            sight: String::new(),
            language: String::new(),
            effort: Effort::default(),
            full_screen: false,
            keys: Keys::default(),
        }
    }
}

impl Settings {
    /// These settings where they differ from an earlier state of theirs, and otherwise others.
    #[must_use]
    pub fn over(self, earlier: &Self, others: Self) -> Self {
        fn newer<T: PartialEq>(own: T, earlier: &T, other: T) -> T {
            if own == *earlier { other } else { own }
        }
        let Self {
            text_size,
            reduced_motion,
            hold_to_digest,
            click_to_crawl,
            pace,
            sound,
            captions,
            classic_arrows,
            name,
            sight,
            language,
            effort,
            full_screen,
            keys,
        } = earlier;
        Self {
            text_size: newer(self.text_size, text_size, others.text_size),
            reduced_motion: newer(self.reduced_motion, reduced_motion, others.reduced_motion),
            hold_to_digest: newer(self.hold_to_digest, hold_to_digest, others.hold_to_digest),
            click_to_crawl: newer(self.click_to_crawl, click_to_crawl, others.click_to_crawl),
            pace: newer(self.pace, pace, others.pace),
            sound: newer(self.sound, sound, others.sound),
            captions: newer(self.captions, captions, others.captions),
            classic_arrows: newer(self.classic_arrows, classic_arrows, others.classic_arrows),
            name: newer(self.name, name, others.name),
            sight: newer(self.sight, sight, others.sight),
            language: newer(self.language, language, others.language),
            effort: newer(self.effort, effort, others.effort),
            full_screen: newer(self.full_screen, full_screen, others.full_screen),
            keys: newer(self.keys, keys, others.keys),
        }
    }

    /// Whether the player's cell digests what is inside.
    #[must_use]
    pub fn digests(&self, input: &Input) -> bool {
        !self.hold_to_digest || input.holds(Action::Consume)
    }

    /// Size of text relative to the usual one.
    #[must_use]
    pub fn text_factor(&self) -> f32 {
        TEXT_SIZES[self.text_size.min(TEXT_SIZES.len() - 1)]
    }

    /// How fast time passes in rounds.
    #[must_use]
    pub fn pace(&self) -> f32 {
        PACES[self.pace.min(PACES.len() - 1)]
    }

    /// The next speed of time, or the one before.
    pub fn change_pace(&mut self, is_back: bool) {
        let by = if is_back { PACES.len() - 1 } else { 1 };
        self.pace = (self.pace.min(PACES.len() - 1) + by) % PACES.len();
    }

    /// Loudness of what is heard, 0 to 1.
    #[must_use]
    pub fn loudness(&self) -> f32 {
        self.sound.min(SOUND_STEPS) as f32 / SOUND_STEPS as f32
    }

    /// A step louder, and silent after the loudest; or one less loud, and the loudest after silence.
    pub fn change_sound(&mut self, is_louder: bool) {
        let by = if is_louder { 1 } else { SOUND_STEPS };
        self.sound = (self.sound.min(SOUND_STEPS) + by) % (SOUND_STEPS + 1);
    }

    /// Goes back to the system's language if this one is not known, and returns it then.
    pub fn refuse_language(&mut self) -> Option<String> {
        let is_known = self.language.is_empty() || Language::named(&self.language).is_some();
        (!is_known).then(|| std::mem::take(&mut self.language))
    }

    /// The next size of text, or the one before.
    pub fn change_text_size(&mut self, by: isize) {
        self.text_size = self.text_size.saturating_add_signed(by).min(TEXT_SIZES.len() - 1);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::store::files::tests::Folder;
    use macroquad::input::KeyCode;

    #[test]
    fn settings_come_back_as_they_were() {
        let (_folder, store) = Folder::new("settings");
        let mut settings = Settings { reduced_motion: true, text_size: 3, ..Settings::default() };
        assert!(settings.keys.set(Action::Consume, KeyCode::E));
        store.save(FILE, &settings).unwrap();
        assert_eq!(store.load::<Settings>(FILE), (settings, None));
    }

    #[test]
    fn t61_food_is_digested_at_once_unless_the_player_asks_for_a_key() {
        let (free, holding) = (Input::default(), Input { held: vec![Action::Consume], ..Input::default() });
        let held = Settings { hold_to_digest: true, ..Settings::default() };
        assert_eq!([&free, &holding].map(|input| Settings::default().digests(input)), [true, true]);
        assert_eq!([&free, &holding].map(|input| held.digests(input)), [false, true]);
    }

    #[test]
    fn time_passes_slower_if_the_player_asks() {
        let mut settings = Settings { pace: 99, ..Settings::default() };
        assert_eq!((Settings::default().pace(), settings.pace()), (1.0, 0.5));
        settings.change_pace(false);
        assert_eq!(settings.pace(), 1.0);
        settings.change_pace(true);
        assert_eq!(settings.pace(), 0.5);
    }

    #[test]
    fn sound_goes_from_silence_to_full_and_round_again() {
        let mut settings = Settings { sound: 99, ..Settings::default() };
        assert_eq!(settings.loudness(), 1.0);
        settings.change_sound(true);
        assert_eq!(settings.loudness(), 0.0);
        settings.change_sound(true);
        assert_eq!(settings.loudness(), 0.25);
        settings.change_sound(false);
        settings.change_sound(false);
        assert_eq!(settings.loudness(), 1.0);
    }

    #[test]
    fn of_two_windows_each_keeps_what_it_has_changed() {
        let earlier = Settings::default();
        let mut others = Settings { reduced_motion: true, text_size: 2, ..Settings::default() };
        assert!(others.keys.set(Action::Consume, KeyCode::E));
        let own = Settings { sight: "dic".to_owned(), text_size: 0, ..Settings::default() };
        let both = own.over(&earlier, others.clone());
        assert_eq!(both, Settings { sight: "dic".to_owned(), text_size: 0, ..others });
    }

    #[test]
    fn only_known_languages_are_accepted() {
        let settings = |language: &str| Settings { language: language.to_owned(), ..Settings::default() };
        let mut unknown = settings("tlh");
        assert_eq!((unknown.refuse_language().as_deref(), unknown.language.as_str()), (Some("tlh"), ""));
        assert_eq!(["", "en", "cs"].map(|known| settings(known).refuse_language()), [None, None, None]);
    }

    #[test]
    fn files_of_other_versions_are_read() {
        let text = "text_size = 99\nunknown = 1\neffort = \"heroic\"\n[keys]\npause = \"Q\"\ndance = \"T\"";
        let settings: Settings = toml::from_str(text).unwrap();
        assert_eq!(settings.text_factor(), TEXT_SIZES[3]);
        assert_eq!(settings.effort, Effort::default());
        assert_eq!(settings.keys.of(Action::Pause), KeyCode::Q);
        assert_eq!(settings.keys.of(Action::Consume), KeyCode::Space, "no key has two meanings");
    }
}
