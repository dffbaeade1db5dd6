//! The panel of a simulation: everything that keys do, for the mouse.

use super::super::context::AppContext;
use super::super::{Next, Overlay, Paused};
use super::Sandbox;
use super::tools::Tool;
use crate::ui::font::TextSize;
use crate::ui::menu::{MenuChoice, MenuItem, MenuLayout};
use crate::ui::pen::Pen;
use crate::words::{self, Key};

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
    Tool::ALL.map(tool).into_iter().chain(others).collect()
}

/// Does what was chosen.
pub(super) fn choose(sandbox: &mut Sandbox, choice: MenuChoice, context: &mut AppContext) -> Next {
    let (item, is_back) = match choice {
        MenuChoice::Pick(item) => (item, false),
        MenuChoice::Less(item) => (item, true),
    };
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
