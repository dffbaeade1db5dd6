//! Actions played back from a file, for tests and for pictures that can be made again.
//!
//! One action per line, `FRAME ACTION`, frames not going back; `#` starts a comment:
//!
//! ```text
//! 0   hold 0.8 0.5     # the mouse at 80 % of the width and 50 % of the height, from the left and top
//! 60  release
//! 60  zoom 1           # D held; -1: A held; 0: neither
//! 90  press space      # space, n, f12, escape, 1 to 9
//! ```

use crate::input::Actions;
use microsim_core::glam::Vec2;

/// A list of actions by frame.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Script {
    cues: Vec<(u32, Cue)>,
    next: usize,
    held: Option<Vec2>,
    zoom: f32,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Cue {
    Hold(Vec2),
    Release,
    Zoom(f32),
    Press(Key),
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Key {
    Pause,
    SingleStep,
    Screenshot,
    Quit,
    Scenario(usize),
}

impl Script {
    /// Reads a script.
    ///
    /// # Errors
    /// Names the first line that makes no sense.
    pub fn parse(text: &str) -> Result<Self, String> {
        let mut script = Self::default();
        for (number, line) in (1..).zip(text.lines()) {
            let line = line.split('#').next().unwrap_or_default();
            let words: Vec<&str> = line.split_whitespace().collect();
            if words.is_empty() {
                continue;
            }
            let cue = cue(&words).ok_or(format!("line {number}: not an action: {}", line.trim()))?;
            if script.cues.last().is_some_and(|last| last.0 > cue.0) {
                return Err(format!("line {number}: frame {} comes after a later one", cue.0));
            }
            script.cues.push(cue);
        }
        Ok(script)
    }

    /// The actions of a frame, for a picture of `screen` pixels. Frames are asked for in order.
    pub fn actions(&mut self, frame: u32, screen: Vec2) -> Actions {
        let mut actions = Actions::default();
        while let Some(&(_, cue)) = self.cues.get(self.next).filter(|(at, _)| *at <= frame) {
            self.next += 1;
            match cue {
                Cue::Hold(at) => self.held = Some(at),
                Cue::Release => self.held = None,
                Cue::Zoom(direction) => self.zoom = direction,
                Cue::Press(key) => press(&mut actions, key),
            }
        }
        actions.goal = self.held.map(|at| at * screen);
        actions.cursor = actions.goal.unwrap_or(screen * 0.5);
        actions.zoom = self.zoom;
        actions
    }
}

fn press(actions: &mut Actions, key: Key) {
    match key {
        Key::Pause => actions.pause = true,
        Key::SingleStep => actions.single_step = true,
        Key::Screenshot => actions.screenshot = true,
        Key::Quit => actions.quit = true,
        Key::Scenario(position) => actions.scenario = Some(position),
    }
}

fn cue(words: &[&str]) -> Option<(u32, Cue)> {
    let (frame, action) = words.split_first()?;
    let number = |word: &str| word.parse().ok().filter(|value: &f32| value.is_finite());
    let cue = match *action {
        ["hold", x, y] => Cue::Hold(Vec2::new(number(x)?, number(y)?)),
        ["release"] => Cue::Release,
        ["zoom", direction] => Cue::Zoom(number(direction)?.clamp(-1.0, 1.0)),
        ["press", name] => Cue::Press(key(name)?),
        _ => return None,
    };
    Some((frame.parse().ok()?, cue))
}

fn key(name: &str) -> Option<Key> {
    Some(match name {
        "space" => Key::Pause,
        "n" => Key::SingleStep,
        "f12" => Key::Screenshot,
        "escape" => Key::Quit,
        digit => Key::Scenario(digit.parse().ok().filter(|digit: &usize| (1..=9).contains(digit))? - 1),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn held_things_stay_held_and_keys_last_one_frame() {
        let text = "0 hold 0.5 0.25\n1 zoom -1 # out\n\n2 press space\n2 press 3\n4 release\n";
        let mut script = Script::parse(text).unwrap();
        let screen = Vec2::new(640.0, 360.0);
        let frames: Vec<Actions> = (0..5).map(|frame| script.actions(frame, screen)).collect();
        assert_eq!(frames[0].goal, Some(Vec2::new(320.0, 90.0)));
        assert_eq!((frames[0].zoom, frames[3].zoom), (0.0, -1.0));
        assert!(frames[2].pause && !frames[3].pause);
        assert_eq!((frames[2].scenario, frames[3].scenario), (Some(2), None));
        assert!(frames[3].goal.is_some() && frames[4].goal.is_none());
    }

    #[test]
    fn nonsense_is_named_by_its_line() {
        for text in ["0 press q", "hold 1 1", "0 hold 1", "0 hold nan 0", "5 release\n4 release"] {
            let problem = Script::parse(text).unwrap_err();
            assert!(problem.starts_with("line "), "{text}: {problem}");
        }
    }
}
