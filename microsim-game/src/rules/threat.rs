//! Larger amoebae as a cell meets them: who can take it in, and what becomes of it inside one.

use microsim_core::glam::Vec2;
use microsim_core::{Event, IngestionWay, Inputs, Intent, OrganismId, OrganismView, View, World};

/// Time without a threat after which the next one is an alarm, s.
const QUIET: f32 = 3.0;

/// Another amoeba, as the player's cell meets it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Other {
    /// Which one it is.
    pub cell: OrganismId,
    /// Its middle.
    pub at: Vec2,
    /// Half its length, units.
    pub half_extent: f32,
    /// How far its middle is from the cell's, units.
    pub distance: f32,
}

impl Other {
    /// What a cell sees of another one.
    #[must_use]
    pub fn seen(other: OrganismView<'_>, cell: OrganismView<'_>) -> Self {
        let ((low, high), at) = (other.bounds(), other.centroid());
        let (half_extent, distance) = (0.5 * (high - low).max_element(), (at - cell.centroid()).length());
        Self { cell: other.id(), at, half_extent, distance }
    }
}

/// Tells when somebody who bites comes near.
#[derive(Clone, Copy, Debug)]
pub struct Alarm {
    /// Time since nobody has been near, s.
    quiet: f32,
}

impl Default for Alarm {
    fn default() -> Self {
        Self { quiet: QUIET }
    }
}

impl Alarm {
    /// Lets time pass, s, and says whether to be alarmed: when somebody is near now and nobody was for a while.
    pub fn rings(&mut self, is_near: bool, elapsed: f32) -> bool {
        let rings = is_near && self.quiet >= QUIET;
        self.quiet = if is_near { 0.0 } else { self.quiet + elapsed };
        rings
    }
}

/// The amoebae that can take a free cell in.
#[must_use]
pub fn engulfers(view: View<'_>, cell: OrganismId) -> Vec<Other> {
    let Some(cell) = view.organism(cell).filter(|cell| cell.held_by().is_none()) else { return Vec::new() };
    let can_engulf = |other: &OrganismView<'_>| {
        let params = other.phagocytosis().filter(|params| params.way == IngestionWay::WideGate);
        params.is_some_and(|params| other.cytoplasm_area() >= params.size_ratio * cell.cytoplasm_area())
    };
    let others = view.organisms().filter(|other| other.id() != cell.id()).filter(can_engulf);
    others.map(|other| Other::seen(other, cell)).collect()
}

/// Where a cell is, if it is free.
#[must_use]
pub fn free_place(world: &World, cell: OrganismId) -> Option<Vec2> {
    let cell = world.view().organism(cell).filter(|cell| cell.held_by().is_none());
    cell.map(OrganismView::centroid)
}

/// Tells those that hold a player's cell to rest and digest it; other players do as they like.
pub fn digest_players(world: &World, players: &[OrganismId], inputs: &mut Inputs) {
    let view = world.view();
    for player in players {
        let holder = view.organism(*player).and_then(OrganismView::held_by).filter(|by| !players.contains(by));
        let Some(holder) = holder.and_then(|by| view.organism(by)) else { continue };
        if holder.meals().any(|(prey, phase)| prey == *player && phase.is_inside()) {
            inputs.set(holder.id(), Intent::REST.digesting(true));
        }
    }
}

/// Whether the last step digested the last of the players' cells.
#[must_use]
pub fn are_digested(world: &World, players: &[OrganismId]) -> bool {
    let is_digested = |event: &Event| matches!(event, Event::Consumed { prey, .. } if players.contains(prey));
    world.events().iter().any(is_digested) && players.iter().all(|player| world.kind(*player).is_none())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rules::round::Round;
    use microsim_core::scenario::Scenario;

    /// A player of radius 6 beside a cell of this radius, with this way of taking in.
    fn room(radius: f32, way: &str) -> Round {
        let text = format!(
            "schema = 1\nname = \"two\"\n[slide]\ntitle = \"a\"\ntask = \"b\"\nfact = \"c\"\nsource = \"d\"\ntime = 60.0\n\
             stars = [10.0, 20.0]\n[[slide.goal]]\nreach = [[2.0, 2.0], [4.0, 4.0]]\n[world]\nsize = [90.0, 60.0]\n\
             [amoeboid_cell.cell]\nradii = [6.0, 6.0]\n[amoeboid_cell.other]\nradii = [{radius}, {radius}]\n\
             phagocytosis = {{ way = \"{way}\" }}\n[[spawn]]\nof = \"cell\"\nplayer = true\nat = [20.0, 30.0]\n\
             [[spawn]]\nof = \"other\"\nat = [50.0, 30.0]\n"
        );
        Round::new(&Scenario::parse(&text, &[]).unwrap()).unwrap()
    }

    #[test]
    fn an_alarm_rings_once_for_somebody_who_comes_near_and_goes_to_and_fro() {
        let mut alarm = Alarm::default();
        let mut rings =
            |is_near, time: f32| (0..(10.0 * time) as u32).map(|_| u32::from(alarm.rings(is_near, 0.1))).sum::<u32>();
        assert_eq!(rings(false, 1.0), 0);
        assert_eq!([true, false, true, false, true].map(|is_near| rings(is_near, 2.0)), [1, 0, 0, 0, 0]);
        assert_eq!((rings(false, 4.0), rings(true, 1.0)), (0, 1));
    }

    #[test]
    fn who_is_large_enough_and_has_a_wide_gate_is_a_threat() {
        let threats = |radius, way| {
            let round = room(radius, way);
            engulfers(round.world().view(), round.player())
        };
        assert_eq!(
            [(7.0, "wide_gate"), (12.0, "cup"), (12.0, "gate")].map(|(r, way)| threats(r, way)),
            [const { Vec::new() }; 3]
        );
        let [threat] = threats(12.0, "wide_gate")[..] else { panic!("one threat") };
        assert!((threat.distance - 30.0).abs() < 0.5 && (threat.half_extent - 12.0).abs() < 1.0, "{threat:?}");
    }
}
