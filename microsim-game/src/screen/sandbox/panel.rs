//! The panel of a simulation: everything that keys do, for the mouse.

use super::super::pause::{Over, Pause};
use super::super::pick::Pick;
use super::super::{Change, Context};
use super::tools::Tool;
use super::{SPEEDS, Sandbox};
use crate::ui::menu::{Choice, Item, Place};
use crate::ui::pen::{Pen, Size};

const PAUSE: usize = Tool::ALL.len();
const STEP: usize = PAUSE + 1;
const SPEED: usize = STEP + 1;
const ANATOMY: usize = SPEED + 1;
const PLOTS: usize = ANATOMY + 1;
const RESTART: usize = PLOTS + 1;
const SCENARIOS: usize = RESTART + 1;

/// Where it lies: along the left edge, below the status line.
pub(super) fn place(pen: &Pen) -> Place {
    Place::side(pen, 1.7 * pen.line(Size::Small))
}

/// What it says.
pub(super) fn items(sandbox: &Sandbox) -> Vec<Item> {
    let tool = |tool: Tool| {
        let mark = if tool == sandbox.tools.tool { "* " } else { "" };
        let label = format!("{mark}{}", tool.label());
        if tool == Tool::Spawn { Item::with(label, sandbox.tools.spawn_name()) } else { Item::new(label) }
    };
    let others = [
        Item::new(if sandbox.is_paused { "Go on" } else { "Pause" }),
        Item::new("Single step"),
        Item::with("Speed", format!("{} x", SPEEDS[sandbox.speed])),
        Item::switch("Debug view", sandbox.shows.anatomy),
        Item::switch("Plots", sandbox.shows.plots),
        Item::new("Restart"),
        Item::new("Scenarios"),
        Item::new("Menu"),
    ];
    Tool::ALL.map(tool).into_iter().chain(others).collect()
}

/// Does what was chosen.
pub(super) fn choose(sandbox: &mut Sandbox, choice: Choice, context: &mut Context) -> Change {
    let (item, is_back) = match choice {
        Choice::Pick(item) => (item, false),
        Choice::Less(item) => (item, true),
    };
    if let Some(&tool) = Tool::ALL.get(item) {
        // What is spawned changes once the tool has been chosen.
        if tool == Tool::Spawn && sandbox.tools.tool == tool {
            sandbox.tools.change_spawn(is_back);
        }
        sandbox.tools.tool = tool;
        return Change::Stay;
    }
    match item {
        PAUSE => sandbox.is_paused ^= true,
        STEP => {
            sandbox.is_paused = true;
            sandbox.step();
        }
        SPEED => {
            let count = SPEEDS.len();
            sandbox.speed = (sandbox.speed + if is_back { count - 1 } else { 1 }) % count;
        }
        ANATOMY => sandbox.shows.anatomy ^= true,
        PLOTS => sandbox.shows.plots ^= true,
        RESTART => return sandbox.restart(context),
        SCENARIOS => return Change::push(Pick::new(context)),
        _ => return Change::push(Pause::new(Over::Simulation)),
    }
    Change::Stay
}
