//! Cells of more players in the text of a scenario.

/// Where the cells of the players end in a scenario of two.
pub const OBSTACLES: &str = "# --- What is in their way";

/// The text with cells for so many players: `cells` are numbers and places of those that it does not have, `of` says what they are.
/// They come before `before`, after which things find free places of their own.
#[must_use]
pub fn seat(text: &str, before: &str, players: usize, of: &str, cells: &[(usize, [f32; 2])]) -> String {
    let more = cells.iter().filter(|(number, _)| *number <= players);
    let more = more.map(|(number, at)| format!("[[spawn]]\nname = \"player-{number}\"\nat = {at:?}\n{of}\n\n"));
    text.replacen(before, &(more.collect::<String>() + before), 1)
}
