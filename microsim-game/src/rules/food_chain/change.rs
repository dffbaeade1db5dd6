//! Changes of the player's body: as it grows one of three. They are kept as the cell's user data, so that
//! daughters and replays have them.

use crate::words::Key;
use microsim_core::{Error, OrganismId, OrganismView, PhagocytosisParams, World};

/// Bits of the user data that have the number of the line, from 1 on; all other amoebae have 0 there.
const LINE: u128 = 7;
/// Bits of the user data for the number of each change, from the fourth bit on.
const BITS: u32 = 4;
const MOST: u128 = (1 << BITS) - 1;

/// What can change about the body.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Change {
    /// It crawls faster.
    Speed,
    /// Food sticks to its front: it goes in sooner and from the side.
    StickyFront,
    /// It digests sooner, makes more of food and slows down less over it.
    Stomach,
    /// It needs less to live on.
    Thrift,
    /// It counts as larger among amoebae, and bites take less of it.
    Coat,
    /// It takes in larger prey, and bites larger amoebae.
    WideMouth,
}

impl Change {
    /// All of them.
    pub const ALL: [Self; 6] =
        [Self::Speed, Self::StickyFront, Self::Stomach, Self::Thrift, Self::Coat, Self::WideMouth];

    /// What players call it, and what it does.
    #[must_use]
    pub fn words(self) -> [Key; 2] {
        match self {
            Self::Speed => [Key::ChangeSpeed, Key::ChangeSpeedAbout],
            Self::StickyFront => [Key::ChangeStickyFront, Key::ChangeStickyFrontAbout],
            Self::Stomach => [Key::ChangeStomach, Key::ChangeStomachAbout],
            Self::Thrift => [Key::ChangeThrift, Key::ChangeThriftAbout],
            Self::Coat => [Key::ChangeCoat, Key::ChangeCoatAbout],
            Self::WideMouth => [Key::ChangeWideMouth, Key::ChangeWideMouthAbout],
        }
    }

    /// How often a cell has changed like this.
    #[must_use]
    pub fn count(self, cell: OrganismView<'_>) -> u32 {
        (cell.user_data() >> self.shift() & MOST) as u32
    }

    fn shift(self) -> u32 {
        BITS * (1 + self as u32)
    }

    /// Changes a cell once more, at most fifteen times.
    ///
    /// # Errors
    /// When the cell is gone.
    pub fn make(self, world: &mut World, cell: OrganismId) -> Result<(), Error> {
        let Some(view) = world.view().organism(cell).filter(|view| u128::from(self.count(*view)) < MOST) else {
            return Ok(());
        };
        let (data, speed) = (view.user_data(), view.speed());
        let params = view.phagocytosis().copied();
        match (self, params) {
            (Self::Speed, _) => world.set_speed(cell, 1.12 * speed),
            (Self::StickyFront | Self::Stomach | Self::WideMouth, Some(params)) => {
                world.set_phagocytosis(cell, self.of_eating(params))
            }
            _ => Ok(()),
        }?;
        world.set_user_data(cell, data + (1 << self.shift()))
    }

    fn of_eating(self, mut params: PhagocytosisParams) -> PhagocytosisParams {
        match self {
            Self::StickyFront => {
                params.hold_time *= 0.4;
                params.heading_cosine = (params.heading_cosine - 0.8).max(-1.0);
            }
            Self::Stomach => {
                params.digestion_time = params.digestion_time.map(|time| (0.8 * time).max(0.05));
                params.digestion_speed = 1.0 - 0.8 * (1.0 - params.digestion_speed);
                params.growth_yield = (1.06 * params.growth_yield).min(4.0);
            }
            _ => params.size_ratio = (0.75 * params.size_ratio).max(1.0),
        }
        params
    }
}

/// How often a cell has changed.
#[must_use]
pub fn changes(cell: OrganismView<'_>) -> u32 {
    Change::ALL.into_iter().map(|change| change.count(cell)).sum()
}

/// The player, from 0 on, of whose line a cell is.
#[must_use]
pub fn line_of(cell: OrganismView<'_>) -> Option<usize> {
    ((cell.user_data() & LINE) as usize).checked_sub(1)
}

/// Marks a cell as the first of a player's line.
///
/// # Errors
/// When it is gone.
pub fn mark(world: &mut World, cell: OrganismId, player: usize) -> Result<(), Error> {
    world.set_user_data(cell, (1 + player as u128) & LINE)
}

#[cfg(test)]
mod tests {
    use super::*;
    use microsim_core::{AmoeboidCellSpec, Placement, WorldConfig};

    #[test]
    fn changes_are_counted_in_the_cell_and_do_what_they_say() {
        let mut world = World::new(WorldConfig::default()).unwrap();
        let cell = world.spawn(&AmoeboidCellSpec::default().into(), Placement::at(80.0, 45.0)).unwrap();
        let before = *world.view().organism(cell).unwrap().phagocytosis().unwrap();
        assert_eq!(line_of(world.view().organism(cell).unwrap()), None);
        mark(&mut world, cell, 3).unwrap();
        for change in Change::ALL {
            (0..2).for_each(|_| change.make(&mut world, cell).unwrap());
        }
        let view = world.view().organism(cell).unwrap();
        assert_eq!((line_of(view), changes(view)), (Some(3), 12));
        assert_eq!(Change::ALL.map(|change| change.count(view)), [2; 6]);
        assert!((view.speed() - 1.2544 * AmoeboidCellSpec::default().speed).abs() < 1e-4);
        let after = view.phagocytosis().unwrap();
        assert!((after.hold_time - 0.16 * before.hold_time).abs() < 1e-6 && after.size_ratio < 0.6 * before.size_ratio);
        (0..20).for_each(|_| Change::Coat.make(&mut world, cell).unwrap());
        let view = world.view().organism(cell).unwrap();
        assert_eq!((Change::Coat.count(view), Change::WideMouth.count(view)), (15, 2), "none runs over");
        world.remove(cell).unwrap();
        assert!(Change::Speed.make(&mut world, cell).is_ok(), "nothing to change");
    }
}
