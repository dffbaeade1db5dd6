//! The core for JavaScript by a plain C ABI, without imports: `index.js` makes a class of it.
//!
//! Worlds have numbers. Text and lists go through one buffer, of which JavaScript asks the place: nothing here follows a pointer.
#![expect(unsafe_code, reason = "exported functions have names of their own")]

mod run;

use run::Run;
use std::cell::RefCell;

/// What the functions return where there is no run or no such scenario.
const NONE: i32 = -1;

thread_local! {
    /// What goes from JavaScript to Rust and back.
    static BUFFER: RefCell<Vec<u8>> = const { RefCell::new(Vec::new()) };
    /// All runs by number; `None` for those that are closed.
    static RUNS: RefCell<Vec<Option<Run>>> = const { RefCell::new(Vec::new()) };
}

/// Makes the buffer this long, and returns where it is.
#[unsafe(no_mangle)]
extern "C" fn buffer(length: usize) -> *mut u8 {
    BUFFER.with_borrow_mut(|buffer| {
        buffer.resize(length, 0);
        buffer.as_mut_ptr()
    })
}

/// How much there is in the buffer, bytes.
#[unsafe(no_mangle)]
extern "C" fn buffer_length() -> usize {
    BUFFER.with_borrow(Vec::len)
}

/// Names of the built-in scenarios, a line each, to the buffer.
#[unsafe(no_mangle)]
extern "C" fn builtins() {
    answer(&run::builtins());
}

/// Opens the scenario whose name or text is in the buffer. A seed below 0 stands for the scenario's own. Returns the number of
/// the run, or -1 with the problem in the buffer.
#[unsafe(no_mangle)]
extern "C" fn open(seed: f64) -> i32 {
    let text = BUFFER.with_borrow(|buffer| String::from_utf8_lossy(buffer).into_owned());
    match Run::open(&text, (seed >= 0.0).then_some(seed as u64)) {
        Ok(run) => RUNS.with_borrow_mut(|runs| {
            runs.push(Some(run));
            runs.len() as i32 - 1
        }),
        Err(problem) => {
            answer(&problem);
            NONE
        }
    }
}

/// Frees a run; its number is not used again.
#[unsafe(no_mangle)]
extern "C" fn close(run: usize) {
    RUNS.with_borrow_mut(|runs| runs.get_mut(run).map(Option::take));
}

/// Takes steps.
#[unsafe(no_mangle)]
extern "C" fn step(run: usize, count: u32) {
    with(run, |run| (0..count).for_each(|_| run.step()));
}

/// Tells an organism where to go until it is told something else. Returns whether it lives and the goal is one.
#[unsafe(no_mangle)]
extern "C" fn steer(run: usize, organism: u32, x: f32, y: f32, digests: bool) -> bool {
    with(run, |run| run.steer(organism, Some([x, y]), digests)).unwrap_or(false)
}

/// Tells an organism to stay.
#[unsafe(no_mangle)]
extern "C" fn rest(run: usize, organism: u32, digests: bool) -> bool {
    with(run, |run| run.steer(organism, None, digests)).unwrap_or(false)
}

/// Index of the player's organism; -1 if there is none.
#[unsafe(no_mangle)]
extern "C" fn player(run: usize) -> i32 {
    with(run, |run| run.player()).flatten().map_or(NONE, |index| index as i32)
}

/// Digest of the state.
#[unsafe(no_mangle)]
extern "C" fn digest(run: usize) -> u64 {
    with(run, |run| run.world().digest()).unwrap_or(0)
}

/// Simulated time, s.
#[unsafe(no_mangle)]
extern "C" fn time(run: usize) -> f64 {
    with(run, |run| run.world().time()).unwrap_or(0.0)
}

/// Width of the room, units.
#[unsafe(no_mangle)]
extern "C" fn width(run: usize) -> f32 {
    with(run, |run| run.world().config().size.x).unwrap_or(0.0)
}

/// Height of the room, units.
#[unsafe(no_mangle)]
extern "C" fn height(run: usize) -> f32 {
    with(run, |run| run.world().config().size.y).unwrap_or(0.0)
}

/// All organisms to the buffer, as 32-bit numbers: index, kind and number of points; then x and y of each point of the surface,
/// or x, y and radius where there is none and the number of points is 0.
#[unsafe(no_mangle)]
extern "C" fn organisms(run: usize) {
    let words = with(run, |run| run.organisms()).unwrap_or_default();
    BUFFER.with_borrow_mut(|buffer| {
        buffer.clear();
        buffer.extend(words.into_iter().flat_map(f32::to_le_bytes));
    });
}

fn with<T>(run: usize, action: impl FnOnce(&mut Run) -> T) -> Option<T> {
    RUNS.with_borrow_mut(|runs| runs.get_mut(run)?.as_mut().map(action))
}

fn answer(text: &str) {
    BUFFER.with_borrow_mut(|buffer| {
        buffer.clear();
        buffer.extend_from_slice(text.as_bytes());
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    fn send(text: &str) {
        answer(text);
    }

    fn received() -> String {
        BUFFER.with_borrow(|buffer| String::from_utf8(buffer.clone()).unwrap())
    }

    #[test]
    fn a_run_steps_and_a_closed_one_answers_nothing() {
        send("absorb-agar");
        let run = usize::try_from(open(-1.0)).unwrap();
        let before = digest(run);
        step(run, 3);
        assert!(time(run) > 0.0 && digest(run) != before);
        organisms(run);
        assert!(buffer_length() > 0 && buffer_length().is_multiple_of(4));
        close(run);
        assert_eq!((digest(run), time(run), player(run)), (0, 0.0, NONE));
        organisms(run);
        assert_eq!(buffer_length(), 0);
    }

    #[test]
    fn what_is_wrong_is_said() {
        for (text, word) in [("nonsense", "nonsense"), ("schema = 1\nname = \"a\"\nfood = 1", "food")] {
            send(text);
            assert_eq!(open(-1.0), NONE);
            assert!(received().contains(word), "{}", received());
        }
    }
}
