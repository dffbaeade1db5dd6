//! Groups: the organisms that one table of the file puts into the world.

use crate::scenario::diagnostic::in_words;
use crate::scenario::grid::Grid;
use crate::scenario::reader::{Fields, ReadContext};
use crate::scenario::sections::prototype::Prototype;
use crate::{CollisionGroups, Controller, Exchange};
use glam::Vec2;

/// Organisms of one prototype that one table puts into the world.
#[derive(Clone, Debug)]
pub(crate) struct Group {
    /// Path of its table.
    pub path: String,
    pub prototype: Prototype,
    pub positions: Positions,
    pub angle: Angle,
    /// Smallest and largest scale.
    pub scale: [f32; 2],
    pub groups: CollisionGroups,
    /// Of their motion, and of their rotation, 1/s.
    pub damping: [f32; 2],
    pub controller: Controller,
    pub exchanges: Vec<Exchange>,
    pub name: Option<String>,
    pub is_player: bool,
    /// Time from which on they are there, s.
    pub from: f32,
    /// Time after which one that is gone or taken in is replaced, s.
    pub respawn: Option<f32>,
}

/// Where organisms are put.
#[derive(Clone, Debug)]
pub(crate) enum Positions {
    /// One, here.
    At(Vec2),
    /// Anywhere wholly within a box, `gap` from everything else.
    Random { count: u32, within: [Vec2; 2], gap: f32 },
    /// On a jittered grid.
    Grid(Grid),
}

impl Positions {
    pub(crate) fn count(&self) -> u32 {
        match self {
            Self::At(_) => 1,
            Self::Random { count, .. } => *count,
            Self::Grid(grid) => grid.count(),
        }
    }
}

/// Direction of organisms.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Angle {
    Radians(f32),
    Random,
}

impl Group {
    /// Organisms on a grid: unturned, in their own size, not steered.
    pub(crate) fn on_grid(path: String, prototype: Prototype, grid: Grid) -> Self {
        Self {
            path,
            prototype,
            positions: Positions::Grid(grid),
            angle: Angle::Radians(0.0),
            scale: [1.0, 1.0],
            groups: CollisionGroups::ALL,
            damping: [0.0, 0.0],
            controller: Controller::Still,
            exchanges: Vec::new(),
            name: None,
            is_player: false,
            from: 0.0,
            respawn: None,
        }
    }

    /// How many there are from the beginning in random places.
    pub(crate) fn random_count(&self) -> usize {
        match self.positions {
            Positions::Random { count, .. } if self.from == 0.0 => count as usize,
            _ => 0,
        }
    }

    /// Path of the field that says how many there are.
    pub(crate) fn count_path(&self, context: &ReadContext<'_>) -> String {
        let count = format!("{}.count", self.path);
        if context.has(&count) { count } else { format!("{}.of", self.path) }
    }
}

/// Refuses a table of what is played if there is nobody to play it.
pub(crate) fn require_player(root: &Fields<'_>, table: &str, groups: &[Group]) {
    if !groups.iter().any(|group| group.is_player && group.prototype.can_grow()) {
        root.refuse(table, "nobody plays", "a [[spawn]] of an amoeboid_cell with `player = true`");
    }
}

/// Checks that the scaled organisms are sound and that all of them together are not too many, before anything is made.
pub(crate) fn check_size(groups: &[Group], max_particles: u32, context: &ReadContext<'_>) {
    let mut left = u64::from(max_particles);
    for group in groups {
        let sizes = group.scale.map(|scale| group.prototype.particles(scale));
        let [Ok(_), Ok(each)] = sizes else {
            for error in sizes.into_iter().filter_map(Result::err) {
                let (message, accepted) = in_words(&error);
                let message = format!("scaled, its {} {message}", error.field());
                context.refuse(&format!("{}.scale", group.path), message, accepted.unwrap_or_default());
            }
            continue;
        };
        let count = u64::from(group.positions.count());
        if count * each > left {
            let message = format!("{count} x {each} particles are more than the world has room for");
            let accepted = format!("at most {}, for world.max_particles = {max_particles}", left / each);
            context.refuse(&group.count_path(context), message, accepted);
            continue;
        }
        left -= count * each;
    }
}
