//! What is at a point of a world, as an entry of the field guide.

use super::of_kind;
use microsim_core::glam::Vec2;
use microsim_core::{Form, MealPhase, MembraneRegion, OrganismId, OrganismView, View, World};

/// Distance from a membrane's nodes within which it is meant, in their radii.
const BESIDE: f32 = 1.6;
/// Share of the greatest protrusion from which a node is part of a pseudopod.
const PROTRUDES: f32 = 0.3;
/// Share of the highest concentration from which a scent is noticed.
const NOTICED: f32 = 0.05;

/// Name of the entry about what is at a point, or within `within` units of it.
#[must_use]
pub fn name_at(view: View<'_>, at: Vec2, within: f32) -> &'static str {
    let world = view.world();
    let organism = organism_at(world, at, within).and_then(|id| view.organism(id));
    let name = organism.and_then(|organism| part_at(view, organism, at));
    name.unwrap_or_else(|| surroundings_at(world, at))
}

/// What is at a point, the smallest first; else what is nearest to it within `within` units.
#[must_use]
pub fn organism_at(world: &World, at: Vec2, within: f32) -> Option<OrganismId> {
    let area = |id: &OrganismId| world.view().organism(*id).map_or(f32::MAX, |organism| organism.spawn_area());
    let smallest = |a: &OrganismId, b: &OrganismId| area(a).total_cmp(&area(b));
    world.organisms_at(at).min_by(smallest).or_else(|| world.organisms_in_circle(at, within).min_by(smallest))
}

/// The part of an organism, or what it is just doing.
fn part_at(view: View<'_>, organism: OrganismView<'_>, at: Vec2) -> Option<&'static str> {
    if let Some(engulfer) = organism.held_by().and_then(|id| view.organism(id)) {
        let phase = engulfer.meals().find(|(prey, _)| *prey == organism.id()).map(|(_, phase)| phase);
        let is_inside = phase.is_some_and(|phase| matches!(phase, MealPhase::Ingested | MealPhase::Digesting(_)));
        return Some(if is_inside { "phagosome" } else { "phagocytosis" });
    }
    let part = match organism.drawn_look().form {
        Form::Amoeboid if organism.dividing_for().is_some() => Some("division"),
        Form::Amoeboid => membrane_at(organism, at),
        Form::Ciliate => {
            organism.nucleus().filter(|nucleus| nucleus.position.distance(at) < nucleus.radius).map(|_| "nucleus")
        }
        _ => None,
    };
    part.or_else(|| of_kind(organism.kind()).map(|entry| entry.name))
}

/// The part of a crawling membrane beside a point.
fn membrane_at(organism: OrganismView<'_>, at: Vec2) -> Option<&'static str> {
    let distances = organism.outline().map(|node| node.distance(at)).enumerate();
    let (nearest, distance) = distances.min_by(|a, b| a.1.total_cmp(&b.1))?;
    let radius = organism.particles().next()?.radius;
    if distance > BESIDE * radius {
        return None;
    }
    let region = organism.membrane_regions().and_then(|regions| regions.get(nearest).copied());
    let protrudes = match organism.protrusion() {
        Some(shares) => shares.get(nearest).is_some_and(|share| *share > PROTRUDES),
        None => region == Some(MembraneRegion::Front),
    };
    Some(match region {
        _ if protrudes => "pseudopod",
        Some(MembraneRegion::Rear) => "uropod",
        _ => "membrane",
    })
}

/// What is between the organisms.
fn surroundings_at(world: &World, at: Vec2) -> &'static str {
    let is_outside = at.cmplt(Vec2::ZERO).any() || at.cmpgt(world.config().size).any();
    let mut solid = world.obstacles().filter_map(|id| world.obstacle(id)).filter(|obstacle| obstacle.is_solid());
    if is_outside || solid.any(|obstacle| obstacle.shape.contains_point(&obstacle.pose, at)) {
        return "wall";
    }
    let is_noticed = world.view().chemicals().any(|(_, chemical)| {
        let highest = chemical.values().iter().copied().fold(0.0, f32::max);
        highest > 0.0 && chemical.concentration(at) > NOTICED * highest
    });
    if is_noticed { "scent" } else { "medium" }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::guide::find;
    use crate::stage::Stage;
    use std::collections::BTreeSet;

    /// The names at all points of a grid over a scene, now and then while it runs.
    fn names(scene: &str, seconds: f64) -> BTreeSet<&'static str> {
        let mut stage = Stage::builtin(scene).unwrap();
        let size = stage.world().config().size;
        let mut found = BTreeSet::new();
        while stage.world().time() < seconds {
            for k in 0..120 * 68 {
                let share = Vec2::new((k % 120) as f32 / 119.0, (k / 120) as f32 / 67.0);
                found.insert(name_at(stage.world().view(), share * 1.02 * size, 0.1));
            }
            (0..60).for_each(|_| stage.step());
        }
        found
    }

    #[test]
    fn the_inside_of_an_obstacle_is_a_wall_and_beside_it_is_none() {
        let stage = Stage::builtin("squeeze").unwrap();
        let world = stage.world();
        let obstacle = world.obstacles().filter_map(|id| world.obstacle(id)).next().unwrap();
        let bounds = obstacle.shape.compute_aabb(&obstacle.pose);
        assert_eq!(name_at(world.view(), bounds.center(), 0.0), "wall");
        let beside = bounds.center() + Vec2::new(0.5 * bounds.extents().x + 1.0, 0.0);
        assert_ne!(name_at(world.view(), beside, 0.0), "wall");
    }

    #[test]
    fn of_a_cell_with_pseudopods_only_what_protrudes_is_one() {
        let mut stage = Stage::builtin("crawl").unwrap();
        (0..180).for_each(|_| stage.step());
        let view = stage.world().view();
        let mut found = [0; 2];
        for cell in view.organisms() {
            for (node, share) in cell.outline().zip(cell.protrusion().unwrap_or_default()) {
                let protrudes = share > PROTRUDES;
                assert_eq!(name_at(view, node, 0.1) == "pseudopod", protrudes, "{share}");
                found[usize::from(protrudes)] += 1;
            }
        }
        assert!(found.iter().all(|count| *count > 10), "{found:?}");
    }

    #[test]
    fn t87_what_lies_on_slides_is_told_apart() {
        let expected: [(&str, f64, &[&str]); 7] = [
            ("absorb-agar", 8.0, &["agar", "amoeboid-cell", "medium", "membrane", "phagosome", "platelet", "wall"]),
            ("absorb-rigid", 1.0, &["nucleus", "rigid-cell"]),
            ("crawl", 3.0, &["pseudopod"]),
            ("divide", 4.0, &["division"]),
            ("hunt", 3.0, &["coccus", "red-cell", "scent"]),
            ("pond", 1.0, &["bacillus"]),
            ("squeeze", 3.0, &["pseudopod", "uropod"]),
        ];
        for (scene, seconds, wanted) in expected {
            let found = names(scene, seconds);
            assert!(found.iter().all(|name| find(name).is_some()), "{scene}: {found:?}");
            let missing: Vec<_> = wanted.iter().filter(|name| !found.contains(*name)).collect();
            assert!(missing.is_empty(), "{scene}: {missing:?} not in {found:?}");
        }
    }
}
