//! What players hear of what happens on a screen: as sound, and as captions.

use super::context::AppContext;
use crate::sound::Cue;

impl AppContext {
    /// Plays what was heard in this frame, unless frames are made for pictures, and writes it if the player wants that.
    pub fn play(&mut self, heard: &[Cue]) {
        if self.settings.captions {
            self.captions.add(heard);
        }
        let loudness = self.settings.loudness();
        if loudness > 0.0 && !self.pace.is_exact {
            heard.iter().for_each(|&cue| self.speaker.play(cue, loudness));
        }
    }

    /// Lets the time of this frame pass for what is heard and for its captions.
    pub(crate) fn pass_sound(&mut self) {
        self.speaker.pass(self.pace.elapsed);
        self.captions.pass(self.pace.elapsed);
    }
}
