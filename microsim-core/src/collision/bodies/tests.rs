//! Discs and boxes of bodies, awake and asleep.

use super::*;
use crate::particle::{CollisionGroups, Particle};
use crate::solver::testing::disc;

#[test]
fn sleepers_have_the_boxes_and_discs_that_they_have_awake() {
    let mut p = Particles::default();
    let block = BlockRange { base: p.extend(3 * LANES) as usize, slots: 3 };
    for (slot, lane) in (0..3).flat_map(|slot| (0..LANES).map(move |lane| (slot, lane))).filter(|(_, k)| *k != 5) {
        let at = Vec2::new(3.0 * lane as f32 + 0.1, 0.7 * slot as f32);
        p.set(block.entry(slot, lane), &Particle { owner: lane as u32, ..disc(at, 1.0) });
    }
    p.groups[block.entry(1, 2)] = CollisionGroups::NONE;
    let limits = DisplacementLimits { step: 0.3, substep: 0.1, dt: 0.01 };
    let found = |sleep: &Sleep| {
        let (mut bodies, mut margins) = (Bodies::default(), SpeculativeMargins::default());
        bodies.collect(&[block], &p, sleep, limits, &mut margins, Dispatch::default());
        bodies.sort(Vec2::splat(30.0));
        let discs = |body| bodies.discs_of(body).collect::<Vec<_>>();
        bodies.iter().map(|body| (body.owner, body.aabb, discs(body))).collect::<Vec<_>>()
    };
    let mut sleep = Sleep::default();
    let awake = found(&sleep);
    sleep.wake_up(0, 0);
    assert!(sleep.fall_asleep(0));
    assert_eq!(format!("{awake:?}"), format!("{:?}", found(&sleep)));
    let counts: Vec<_> = awake.iter().map(|(owner, _, discs)| (*owner, discs.len())).collect();
    assert_eq!(counts, [(0, 3), (1, 3), (2, 2), (3, 3), (4, 3), (6, 3), (7, 3)]);
    for (owner, aabb, discs) in awake {
        let around = discs.iter().fold(Aabb::EMPTY, |aabb, disc| aabb.union(disc.aabb()));
        assert_eq!((aabb.low(), aabb.high()), (around.low(), around.high()), "owner {owner}");
    }
}
