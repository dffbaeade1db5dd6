//! Organisms as shapes, one function per form.

use super::palette::{GROWN, HALO, QUARANTINED};
use super::shape::{DrawnPart, Geometry, Item, Paint, Stroke};
use crate::{Form, MembraneRegion, OrganismView, ParticleView, Role, Tint};
use glam::Vec2;

/// Adds an organism, the lowest item first.
pub(super) fn draw(view: OrganismView<'_>, items: &mut Vec<Item>) {
    let look = view.drawn_look();
    let tint = if view.is_quarantined() { QUARANTINED } else { look.tint };
    let first = items.len();
    match look.form {
        Form::Amoeboid => amoeboid_cell(view, tint, items),
        Form::Ciliate | Form::RedCell => dense_cell(view, tint, items),
        Form::Platelet => platelet(view, tint, items),
        Form::Beads => beads(view, tint, items),
        Form::Metal => metal(view, tint, items),
        Form::Drops => drops(view, tint, items),
        Form::Plain => plain(view, tint, items),
    }
    items[first..].iter_mut().for_each(|item| item.owner = Some(view.id()));
}

/// The bright seam around a cell.
pub(super) fn halo(view: OrganismView<'_>) -> Option<Item> {
    let is_thick = matches!(view.drawn_look().form, Form::Amoeboid | Form::Ciliate | Form::RedCell | Form::Platelet);
    let seam = || Stroke { colour: HALO, width: line_width(view) * 3.5 };
    is_thick.then(|| Item {
        owner: Some(view.id()),
        ..Item::stroked(DrawnPart::Halo, Geometry::Outline(view.surface()), seam())
    })
}

/// A translucent body, its granules, and a membrane that is bolder where it leads.
fn amoeboid_cell(view: OrganismView<'_>, tint: Tint, items: &mut Vec<Item>) {
    let surface = view.surface();
    let thickness = line_width(view);
    items.push(body(&surface, tint, [0.42, 0.62]));
    let fluid = [
        (DrawnPart::Cytoplasm, Role::Cytoplasm, tint.detail),
        (DrawnPart::GrownCytoplasm, Role::GrownCytoplasm, GROWN),
    ];
    for (part, role, colour) in fluid {
        let granules = Geometry::Discs(of_role(view, role).map(|p| (p.position, p.radius * 0.5)).collect());
        if !granules.is_empty() {
            items.push(Item::filled(part, granules, Paint::Flat(colour.faded(0.2))));
        }
    }
    items.extend(view.phagosomes().map(|(_, ring)| phagosome(ring, tint, thickness)));
    let lead = Geometry::Curve(leading_edge(view, &surface));
    items.push(membrane(surface, tint, 0.85, thickness));
    if !lead.is_empty() {
        let stroke = Stroke { colour: tint.line.faded(0.6), width: thickness * 1.6 };
        items.push(Item::stroked(DrawnPart::LeadingEdge, lead, stroke));
    }
}

/// A thin membrane around prey, with bright fluid in it.
fn phagosome(ring: Vec<Vec2>, tint: Tint, thickness: f32) -> Item {
    let stroke = Stroke { colour: tint.line.faded(0.6), width: thickness * 0.8 };
    let fluid = Item::filled(DrawnPart::Phagosome, Geometry::Outline(ring), Paint::Flat(HALO.faded(0.12)));
    Item { stroke: Some(stroke), ..fluid }
}

/// The front of the surface, in its order; empty unless it crawls.
fn leading_edge(view: OrganismView<'_>, surface: &[Vec2]) -> Vec<Vec2> {
    let Some(regions) = view.membrane_regions() else {
        return Vec::new();
    };
    let count = regions.len();
    let is_front = |k: usize| regions[k % count] == MembraneRegion::Front;
    let Some(start) = (0..count).find(|&k| is_front(k) && !is_front(k + count - 1)) else {
        return Vec::new();
    };
    let run = (start..start + count).take_while(|&k| is_front(k));
    run.map(|k| surface[k % count]).collect()
}

/// A body with a cortex, a nucleus and a small cap at its front.
fn dense_cell(view: OrganismView<'_>, tint: Tint, items: &mut Vec<Item>) {
    let surface = view.surface();
    let thickness = line_width(view);
    items.push(body(&surface, tint, [0.75, 0.9]));
    let cortex = Geometry::Outline(of_role(view, Role::InnerRing).map(|p| p.position).collect());
    if !cortex.is_empty() {
        let faint = Stroke { colour: tint.line.faded(0.22), width: thickness * 0.8 };
        items.push(Item::stroked(DrawnPart::Cortex, cortex, faint));
    }
    items.extend(cap(view, tint, &surface));
    items.extend(nucleus(view, tint, 0.7));
    items.push(membrane(surface, tint, 1.0, thickness));
}

/// Depth of a cap, in the distance from the front to the centroid.
const CAP_DEPTH: f32 = 0.35;

/// A faint crescent behind the front.
fn cap(view: OrganismView<'_>, tint: Tint, surface: &[Vec2]) -> Option<Item> {
    let (front, count) = (view.front_index()?, surface.len());
    let half = (count / 8).max(1);
    let around: Vec<Vec2> = (front + count - half..=front + count + half).map(|k| surface[k % count]).collect();
    let (centre, last) = (view.centroid(), (around.len() - 1) as f32);
    let depth = |k: usize| 4.0 * CAP_DEPTH * (k as f32 / last) * (1.0 - k as f32 / last);
    let inwards = (1..around.len() - 1).rev().map(|k| around[k].lerp(centre, depth(k)));
    let crescent = around.iter().copied().chain(inwards).collect();
    Some(Item::filled(DrawnPart::Cap, Geometry::Curve(crescent), Paint::Flat(tint.detail.faded(0.32))))
}

/// A soft disc, pale in the middle, with a spot.
fn platelet(view: OrganismView<'_>, tint: Tint, items: &mut Vec<Item>) {
    let surface = view.surface();
    items.push(body(&surface, tint, [0.8, 0.9]));
    items.extend(nucleus(view, tint, 0.55));
    items.push(membrane(surface, tint, 0.9, line_width(view)));
}

/// Discs with a bright spot, as of small lenses. Discs that touch run into each other.
fn beads(view: OrganismView<'_>, tint: Tint, items: &mut Vec<Item>) {
    items.push(rims(view, tint));
    items.extend(view.particles().map(|p| disc(p.position, p.radius * 0.84, tint)));
    items.push(spots(view, tint, Vec2::new(-0.28, 0.28), 0.2, 0.8));
}

/// A disc of metal: a ring and a hub.
fn metal(view: OrganismView<'_>, tint: Tint, items: &mut Vec<Item>) {
    items.push(rims(view, tint));
    items.extend(view.particles().map(|p| disc(p.position, p.radius * 0.94, tint)));
    items.extend(view.particles().map(|p| {
        let ring = Stroke { colour: tint.detail.faded(0.8), width: p.radius * 0.06 };
        Item::stroked(DrawnPart::Spot, Geometry::disc(p.position, p.radius * 0.66), ring)
    }));
    items.push(spots(view, tint, Vec2::ZERO, 0.14, 0.9));
}

/// Drops that run into one another.
fn drops(view: OrganismView<'_>, tint: Tint, items: &mut Vec<Item>) {
    let discs = |scale: f32| Geometry::Discs(view.particles().map(|p| (p.position, p.radius * scale)).collect());
    items.push(Item::filled(DrawnPart::Fluid, discs(1.15), Paint::Flat(tint.inner.faded(0.55))));
    items.push(Item::filled(DrawnPart::Spot, discs(0.6), Paint::Flat(tint.detail.faded(0.45))));
}

/// A body that the library does not know: its outline, if any, and its discs.
fn plain(view: OrganismView<'_>, tint: Tint, items: &mut Vec<Item>) {
    let surface = view.surface();
    if surface.len() > 2 {
        items.push(body(&surface, tint, [0.3, 0.45]));
    }
    items.push(rims(view, tint));
    let discs = view.particles().filter(|p| p.radius > 0.0);
    items.extend(discs.map(|p| disc(p.position, p.radius * 0.86, tint)));
}

fn nucleus(view: OrganismView<'_>, tint: Tint, alpha: f32) -> Option<Item> {
    let nucleus = view.nucleus()?;
    let paint = Paint::Radial {
        centre: nucleus.position,
        radius: nucleus.radius,
        inner: tint.detail.faded(alpha),
        outer: tint.detail.faded(alpha * 0.6),
    };
    Some(Item::filled(DrawnPart::Nucleus, Geometry::disc(nucleus.position, nucleus.radius), paint))
}

/// The area within a surface, denser towards its edge.
fn body(surface: &[Vec2], tint: Tint, [inner, outer]: [f32; 2]) -> Item {
    let centre = surface.iter().sum::<Vec2>() / surface.len().max(1) as f32;
    let farthest = surface.iter().map(|p| p.distance_squared(centre)).max_by(f32::total_cmp);
    let paint = Paint::Radial {
        centre,
        radius: farthest.map_or(0.0, f32::sqrt),
        inner: tint.inner.faded(inner),
        outer: tint.outer.faded(outer),
    };
    Item::filled(DrawnPart::Body, Geometry::Outline(surface.to_vec()), paint)
}

fn membrane(surface: Vec<Vec2>, tint: Tint, alpha: f32, width: f32) -> Item {
    Item::stroked(DrawnPart::Membrane, Geometry::Outline(surface), Stroke { colour: tint.line.faded(alpha), width })
}

fn disc(centre: Vec2, radius: f32, tint: Tint) -> Item {
    let paint = Paint::Radial { centre, radius, inner: tint.inner, outer: tint.outer };
    Item::filled(DrawnPart::Bead, Geometry::disc(centre, radius), paint)
}

/// The edges of all discs, below their areas.
fn rims(view: OrganismView<'_>, tint: Tint) -> Item {
    let discs = view.particles().filter(|p| p.radius > 0.0).map(|p| (p.position, p.radius));
    Item::filled(DrawnPart::BeadRim, Geometry::Discs(discs.collect()), Paint::Flat(tint.line))
}

/// A spot on each disc; `offset` and `size` in radii of the disc.
fn spots(view: OrganismView<'_>, tint: Tint, offset: Vec2, size: f32, alpha: f32) -> Item {
    let discs = view.particles().map(|p| (p.position + offset * p.radius, p.radius * size));
    Item::filled(DrawnPart::Spot, Geometry::Discs(discs.collect()), Paint::Flat(tint.detail.faded(alpha)))
}

/// Lines follow the size of the discs that the surface is made of.
fn line_width(view: OrganismView<'_>) -> f32 {
    let disc = view.particles().find(|p| p.role == Role::Membrane);
    disc.map_or(0.0, |p| p.radius * 0.5)
}

fn of_role(view: OrganismView<'_>, role: Role) -> impl Iterator<Item = ParticleView> + '_ {
    view.particles().filter(move |p| p.role == role)
}
