//! The panel of a simulation: everything that keys do, for the mouse.

use super::super::context::AppContext;
use super::super::{Next, Overlay, Paused};
use super::Sandbox;
use super::tools::Tool;
use crate::ui::font::TextSize;
use crate::ui::menu::{MenuChoice, MenuItem, MenuLayout};
use crate::ui::pen::Pen;
use crate::words::{self, Key};

/// What the items from this one on are about, headings not counted.
const GROUPS: [(usize, Key); 6] = [
    (0, Key::PanelMove),
    (3, Key::PanelBodies),
    (5, Key::PanelLook),
    (8, Key::PanelBuild),
    (PAUSE, Key::PanelTime),
    (ANATOMY, Key::PanelScene),
];

const UNDO: usize = Tool::ALL.len();
const PAUSE: usize = UNDO + 1;
const STEP: usize = PAUSE + 1;
const SPEED: usize = STEP + 1;
const ANATOMY: usize = SPEED + 1;
const PLOTS: usize = ANATOMY + 1;
const RESTART: usize = PLOTS + 1;
const SCENARIOS: usize = RESTART + 1;

/// Where it lies: along the left edge, below the status line.
pub(super) fn place(pen: &Pen) -> MenuLayout {
    MenuLayout::side(pen, 1.7 * pen.line(TextSize::Small))
}

/// What it says.
pub(super) fn items(sandbox: &Sandbox) -> Vec<MenuItem> {
    let tool = |(tool, label)| {
        let mark = if tool == sandbox.tools.tool { "* " } else { "" };
        let label = format!("{mark}{}", words::text(label));
        let value = sandbox.tools.value(tool).map(|key| words::text(key).to_owned());
        MenuItem { value, ..MenuItem::new(label) }
    };
    let others = [
        MenuItem::new(Key::PanelUndo),
        MenuItem::new(if sandbox.is_paused { Key::PauseGoOn } else { Key::ActionPause }),
        MenuItem::new(Key::ActionStep),
        MenuItem::with(Key::PanelSpeed, sandbox.tempo.to_string()),
        MenuItem::switch(Key::ActionDebugView, sandbox.shows.anatomy),
        MenuItem::switch(Key::ActionPlots, sandbox.shows.plots),
        MenuItem::new(Key::PauseRestart),
        MenuItem::new(Key::PanelScenarios),
        MenuItem::new(Key::PanelMenu),
    ];
    grouped(Tool::ALL.map(tool).into_iter().chain(others)).collect()
}

/// The items with their headings.
fn grouped(items: impl Iterator<Item = MenuItem>) -> impl Iterator<Item = MenuItem> {
    items.enumerate().flat_map(|(k, item)| {
        let heading = GROUPS.into_iter().find(|(first, _)| *first == k).map(|(_, about)| MenuItem::heading(about));
        heading.into_iter().chain([item])
    })
}

/// The number of an item among those that are no headings.
fn without_headings(items: &[MenuItem], item: usize) -> usize {
    items.iter().take(item).filter(|item| !item.is_heading).count()
}

/// Does what was chosen.
pub(super) fn choose(sandbox: &mut Sandbox, choice: MenuChoice, context: &mut AppContext) -> Next {
    let (item, is_back) = match choice {
        MenuChoice::Pick(item) => (item, false),
        MenuChoice::Less(item) => (item, true),
    };
    let item = without_headings(&sandbox.panel.items, item);
    if let Some(&(tool, _)) = Tool::ALL.get(item) {
        sandbox.tools.choose(tool, is_back);
        return Next::Stay;
    }
    match item {
        UNDO => sandbox.undo(context),
        PAUSE => sandbox.is_paused ^= true,
        STEP => {
            sandbox.is_paused = true;
            sandbox.step();
        }
        SPEED => sandbox.tempo = sandbox.tempo.next(is_back),
        ANATOMY => sandbox.shows.anatomy ^= true,
        PLOTS => sandbox.shows.plots ^= true,
        RESTART => sandbox.restart(context),
        SCENARIOS => return Next::Open(Overlay::Pick),
        _ => return Next::Open(Overlay::Pause(Paused::Simulation)),
    }
    Next::Stay
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::words::Label;

    #[test]
    fn items_are_under_headings_and_do_what_they_did_without() {
        let others = (UNDO..=SCENARIOS + 1).map(|_| MenuItem::new(Key::PanelMenu));
        let items: Vec<MenuItem> =
            grouped(Tool::ALL.map(|(_, label)| MenuItem::new(label)).into_iter().chain(others)).collect();
        assert_eq!(items.len(), SCENARIOS + 2 + GROUPS.len());
        let after = |heading: Key| items.iter().position(|item| item.label == Label::from(heading)).unwrap() + 1;
        for (heading, first) in
            [(Key::PanelMove, Tool::Steer), (Key::PanelLook, Tool::Follow), (Key::PanelBuild, Tool::Join)]
        {
            assert_eq!(Tool::ALL[without_headings(&items, after(heading))].0, first);
        }
        assert_eq!(without_headings(&items, after(Key::PanelTime)), PAUSE);
        assert_eq!(without_headings(&items, items.len() - 1), SCENARIOS + 1);
    }
}
