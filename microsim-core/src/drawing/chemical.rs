//! Chemicals as shades: each band is where there is at least half as much as in the next one.

use super::shape::{Colour, Item, Paint, Part, Shape};
use crate::{Chemical, View};
use glam::Vec2;

/// Bands from the highest concentration downwards.
const BANDS: u32 = 5;
/// How much each band covers of what is below.
const COVER: f32 = 0.05;
/// One for each chemical, in turns.
const COLOURS: [Colour; 3] = [Colour::hex(0xE08A00), Colour::hex(0x2B7FB8), Colour::hex(0x8A4FA0)];

/// All chemicals.
pub(super) fn draw(view: View<'_>) -> Vec<Item> {
    let chemicals = view.chemicals().map(|(_, chemical)| chemical).zip(COLOURS.into_iter().cycle());
    chemicals.flat_map(|(chemical, colour)| bands(chemical, colour)).collect()
}

fn bands(chemical: &Chemical, colour: Colour) -> Vec<Item> {
    let highest =
        chemical.values().iter().copied().fold(0.0, |most: f32, value| if value > most { value } else { most });
    let band = |k: u32| {
        let area = Shape::Polygons(area(chemical, highest / (1_u32 << k) as f32));
        Item::filled(Part::Chemical, area, Paint::Flat(colour.faded(COVER)))
    };
    if highest > 0.0 { (1..=BANDS).rev().map(band).collect() } else { Vec::new() }
}

/// Where there is at least this much: in each half row of cells the stretches where there is.
fn area(chemical: &Chemical, least: f32) -> Vec<Vec<Vec2>> {
    let [columns, rows] = chemical.cells().map(|count| 2 * count);
    let piece = chemical.cell_size() * 0.5;
    let corner = |column: usize, row: usize| Vec2::new(column as f32, row as f32) * piece;
    let mut area = Vec::new();
    for row in 0..rows {
        let reaches = |column: usize| chemical.concentration(corner(column, row) + piece * 0.5) >= least;
        let mut start = None;
        for column in 0..=columns {
            match (start, column < columns && reaches(column)) {
                (None, true) => start = Some(column),
                (Some(from), false) => {
                    let (low, high) = (corner(from, row), corner(column, row + 1));
                    area.push(vec![low, Vec2::new(high.x, low.y), high, Vec2::new(low.x, high.y)]);
                    start = None;
                }
                _ => {}
            }
        }
    }
    area
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{AgarSpec, ChemicalSpec, Exchange, Inputs, Placement, World, WorldConfig};

    #[test]
    fn bands_lie_around_a_source_and_there_are_none_without() {
        let mut world = World::new(WorldConfig::default()).unwrap();
        let chemical = world.add_chemical(ChemicalSpec::default()).unwrap();
        assert!(draw(world.view()).is_empty());
        let source = world.spawn(&AgarSpec::default().into(), Placement::at(40.0, 40.0)).unwrap();
        world.set_exchange(source, Exchange { chemical, secretion: 1.0, uptake: 0.0 }).unwrap();
        (0..30).for_each(|_| world.step(&Inputs::new()));
        let pieces: Vec<usize> = draw(world.view()).iter().map(|band| band.shape.segments().len()).collect();
        assert_eq!(pieces.len(), BANDS as usize);
        assert!(
            pieces.windows(2).all(|pair| pair[0] >= pair[1]) && pieces[0] > pieces[BANDS as usize - 1],
            "{pieces:?}"
        );
    }
}
