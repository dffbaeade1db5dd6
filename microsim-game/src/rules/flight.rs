//! How a bot gets past threats that do not fit through gaps: what it reaches before them, and where they do not get.

use super::path::PathMap;
use super::threat::Other;
use microsim_core::glam::Vec2;

/// Gap around its middle that a threat needs, share of half its length, and how far its rim reaches beyond, units.
const NEEDED: f32 = 0.4;
const RIM: f32 = 10.0;
/// Gap of the narrowest hole that bots go through.
const OWN_GAP: f32 = 1.5;
/// Distance of the middles at which two cells nearly touch, beyond half the length of the threat, and the one at which it is no
/// longer to be feared, units.
const TOUCH: f32 = 9.0;
const FEAR: f32 = 26.0;
/// Speed of a threat over the bot's.
const SPEED: f32 = 0.7;
/// What a unit of way costs more where a threat is.
const COST: f32 = 14.0;
/// What is farther than this from threats is as good as what they do not reach, units; and what a unit of way to it takes off.
const ENOUGH: f32 = 70.0;
const WAY: f32 = 0.4;

/// Ways of a bot and of threats at one moment.
#[derive(Debug)]
pub struct Flight<'a> {
    map: &'a PathMap,
    /// The cell of the map where the bot is.
    here: usize,
    /// How far each cell of the map is from the bot, and from the rim of the next threat, units.
    own: Vec<f32>,
    gaps: Vec<f32>,
}

impl<'a> Flight<'a> {
    /// The ways from where a bot and threats are now.
    #[must_use]
    pub fn new(map: &'a PathMap, at: Vec2, threats: &[Other]) -> Self {
        let own = map.reach(at, OWN_GAP, 0.0);
        let mut gaps = vec![f32::INFINITY; own.len()];
        for threat in threats {
            let far = map.reach(threat.at, NEEDED * threat.half_extent, RIM);
            gaps.iter_mut().zip(far).for_each(|(gap, far)| *gap = gap.min(far - threat.half_extent));
        }
        Self { map, here: map.cell(at), own, gaps }
    }

    /// The nearest of these places that no threat reaches before the bot; none while one almost touches it.
    #[must_use]
    pub fn nearest(&self, places: &[Vec2]) -> Option<Vec2> {
        let cells = places.iter().map(|&place| (place, self.map.cell(place)));
        let safe = cells.filter(|&(_, cell)| self.gaps[cell] - TOUCH > SPEED * self.own[cell]);
        let nearest = safe.min_by(|a, b| self.own[a.1].total_cmp(&self.own[b.1]));
        nearest.filter(|_| self.gaps[self.here] > TOUCH).map(|(place, _)| place)
    }

    /// Where it is safe.
    #[must_use]
    pub fn refuge(&self) -> Option<Vec2> {
        let safety = |cell: usize| self.gaps[cell].min(ENOUGH) - WAY * self.own[cell];
        let places = self.map.middles().enumerate().filter(|&(cell, _)| self.own[cell].is_finite());
        places.max_by(|a, b| safety(a.0).total_cmp(&safety(b.0))).map(|(_, place)| place)
    }

    /// What a unit of way costs more in a cell of the map.
    #[must_use]
    pub fn risk(&self, cell: usize) -> f32 {
        COST * (1.0 - self.gaps[cell] / FEAR).clamp(0.0, 1.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use microsim_core::scenario::Scenario;
    use microsim_core::{Placement, ProbeSpec, World, WorldConfig};

    const LEFT: Vec2 = Vec2::new(25.0, 30.0);
    const RIGHT: Vec2 = Vec2::new(95.0, 30.0);

    fn two_rooms() -> PathMap {
        let text = "schema = 1\n[world]\nsize = [120.0, 60.0]\n\
                    [[wall]]\nthickness = 4.0\nfrom = [60.0, 0.0]\nto = [60.0, 25.0]\n\
                    [[wall]]\nthickness = 4.0\nfrom = [60.0, 35.0]\nto = [60.0, 60.0]\n";
        PathMap::new(&Scenario::parse(text, &[]).unwrap().build().unwrap().world)
    }

    fn threat(at: Vec2, own: Vec2) -> Other {
        let mut world = World::new(WorldConfig::default()).unwrap();
        let cell = world.spawn(&ProbeSpec::default().into(), Placement::at(20.0, 20.0)).unwrap();
        Other { cell, at, half_extent: 14.0, distance: at.distance(own) }
    }

    #[test]
    fn what_lies_behind_a_gap_is_safe_and_what_a_threat_reaches_first_is_not() {
        let map = two_rooms();
        let flight = Flight::new(&map, RIGHT, &[threat(LEFT, RIGHT)]);
        assert_eq!(flight.nearest(&[LEFT, RIGHT + 10.0]), Some(RIGHT + 10.0));
        assert_eq!(flight.nearest(&[LEFT]), None);
        assert!(flight.refuge().unwrap().x > 60.0);
        let risks = [LEFT, RIGHT].map(|at| flight.risk(map.cell(at)));
        assert!(risks[0] > 1.0 && risks[1] == 0.0, "{risks:?}");
    }

    #[test]
    fn who_is_almost_touched_flees_through_the_gap() {
        let map = two_rooms();
        let own = LEFT + Vec2::new(18.0, 0.0);
        let flight = Flight::new(&map, own, &[threat(LEFT, own)]);
        assert_eq!(flight.nearest(&[own + 2.0]), None);
        assert!(flight.refuge().unwrap().x > 60.0);
    }
}
