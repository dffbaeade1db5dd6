//! Input played back from a file, for tests and for pictures that can be made again.
//!
//! One cue per line, `FRAME CUE`, frames not going back; `#` starts a comment:
//!
//! ```text
//! 0   hold 0.8 0.5     # the mouse at 80 % of the width and 50 % of the height, from the left and top, button down
//! 30  move 0.5 0.5     # the same, button as it is
//! 60  release
//! 60  down consume     # an action's key held: consume, zoom-in, zoom-out, ...
//! 90  up consume
//! 90  press pause      # a key for one frame: an action, or enter, escape, up, down, left, right
//! 95  click 0.5 0.4
//! 99  drop a.toml      # a file on the window, by a name without spaces
//! ```

use super::{Action, Input, Move};
use microsim_core::glam::Vec2;
use std::path::PathBuf;

/// A list of cues by frame.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct InputScript {
    cues: Vec<(u32, Cue)>,
    next: usize,
    cursor: Option<Vec2>,
    is_held: bool,
    held: Vec<Action>,
}

#[derive(Clone, Debug, PartialEq)]
enum Cue {
    Hold(Vec2),
    Move(Vec2),
    Click(Vec2),
    Release,
    Down(Action),
    Up(Action),
    Press(Action),
    Step(Move),
    Drop(PathBuf),
}

impl InputScript {
    /// Reads a script.
    ///
    /// # Errors
    /// Names the first line that is not a cue.
    pub fn parse(text: &str) -> Result<Self, String> {
        let mut script = Self::default();
        for (number, line) in (1..).zip(text.lines()) {
            let line = line.split('#').next().unwrap_or_default();
            let words: Vec<&str> = line.split_whitespace().collect();
            if words.is_empty() {
                continue;
            }
            let cue = cue(&words).ok_or(format!("line {number}: not a cue: {}", line.trim()))?;
            if script.cues.last().is_some_and(|last| last.0 > cue.0) {
                return Err(format!("line {number}: frame {} comes after a later one", cue.0));
            }
            script.cues.push(cue);
        }
        Ok(script)
    }

    /// The input of a frame, for a picture of `screen` units. Frames are asked for in order.
    pub fn input(&mut self, frame: u32, screen: Vec2) -> Input {
        let mut input = Input::default();
        while let Some((_, cue)) = self.cues.get(self.next).filter(|(at, _)| *at <= frame).cloned() {
            self.next += 1;
            self.act(cue, &mut input);
        }
        input.cursor = self.cursor.unwrap_or(Vec2::splat(0.5)) * screen;
        input.is_held |= self.is_held;
        input.held = self.held.clone();
        input
    }

    fn act(&mut self, cue: Cue, input: &mut Input) {
        if let Cue::Hold(at) | Cue::Move(at) | Cue::Click(at) = cue {
            input.has_moved = true;
            self.cursor = Some(at);
        }
        match cue {
            Cue::Hold(_) => {
                input.is_clicked = !self.is_held;
                self.is_held = true;
            }
            Cue::Click(_) => (input.is_clicked, input.is_held) = (true, true),
            Cue::Move(_) => {}
            Cue::Release => self.is_held = false,
            Cue::Down(action) => self.held.push(action),
            Cue::Up(action) => self.held.retain(|&held| held != action),
            Cue::Press(action) => input.pressed.push(action),
            Cue::Step(step) => input.step = Some(step),
            Cue::Drop(file) => input.dropped.push(file),
        }
    }
}

fn cue(words: &[&str]) -> Option<(u32, Cue)> {
    let (frame, cue) = words.split_first()?;
    let number = |word: &str| word.parse().ok().filter(|value: &f32| value.is_finite());
    let place = |x: &str, y: &str| Some(Vec2::new(number(x)?, number(y)?));
    let cue = match *cue {
        ["hold", x, y] => Cue::Hold(place(x, y)?),
        ["move", x, y] => Cue::Move(place(x, y)?),
        ["click", x, y] => Cue::Click(place(x, y)?),
        ["release"] => Cue::Release,
        ["drop", file] => Cue::Drop(file.into()),
        ["down", name] => Cue::Down(action(name)?),
        ["up", name] => Cue::Up(action(name)?),
        ["press", name] => match Move::ALL.into_iter().find(|(_, known)| *known == name) {
            Some((step, _)) => Cue::Step(step),
            None => Cue::Press(action(name)?),
        },
        _ => return None,
    };
    Some((frame.parse().ok()?, cue))
}

fn action(name: &str) -> Option<Action> {
    Action::ALL.into_iter().find(|action| action.name() == name)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn held_things_stay_held_and_presses_last_one_frame() {
        let text = "0 hold 0.5 0.25\n1 down zoom-out # out\n\n2 press pause\n2 press enter\n4 release\n4 up zoom-out\n";
        let mut script = InputScript::parse(text).unwrap();
        let screen = Vec2::new(640.0, 360.0);
        let frames: Vec<Input> = (0..5).map(|frame| script.input(frame, screen)).collect();
        assert_eq!((frames[0].cursor, frames[0].is_clicked), (Vec2::new(320.0, 90.0), true));
        assert!(frames[1].is_held && !frames[1].is_clicked);
        assert_eq!((frames[0].zoom(), frames[3].zoom(), frames[4].zoom()), (0.0, -1.0, 0.0));
        assert!(frames[2].presses(Action::Pause) && !frames[3].presses(Action::Pause));
        assert_eq!((frames[2].step, frames[3].step), (Some(Move::Confirm), None));
        assert!(frames[3].is_held && !frames[4].is_held);
    }

    #[test]
    fn nonsense_is_named_by_its_line() {
        for text in ["0 press q", "hold 1 1", "0 hold 1", "0 hold nan 0", "5 release\n4 release"] {
            let problem = InputScript::parse(text).unwrap_err();
            assert!(problem.starts_with("line "), "{text}: {problem}");
        }
    }
}
