//! Organisms as shapes, one function per kind.

use super::palette::{AGAR, AMOEBOID, COCCUS, CUSTOM, FLUID, HALO, PLATELET, PROBE, QUARANTINED, RED, RIGID, Tint};
use super::shape::{Item, Paint, Path, Stroke};
use microsim_core::glam::Vec2;
use microsim_core::{Kind, MembraneRegion, OrganismView, ParticleView, Role};

/// What is seen of an organism, lowest first.
pub(crate) fn draw(view: OrganismView<'_>) -> Vec<Item> {
    let tint = |own| if view.is_quarantined() { QUARANTINED } else { own };
    match view.kind() {
        Kind::AmoeboidCell => amoeboid_cell(view, tint(AMOEBOID)),
        Kind::RigidCell => rigid_cell(view, tint(RIGID)),
        Kind::Platelet => platelet(view, tint(PLATELET)),
        Kind::Agar => beads(view, tint(AGAR)),
        Kind::Probe => probe(view, tint(PROBE)),
        Kind::FluidBlock => fluid(view, tint(FLUID)),
        Kind::RedCell => rigid_cell(view, tint(RED)),
        Kind::Coccus | Kind::Bacillus => beads(view, tint(COCCUS)),
        _ => custom(view, tint(CUSTOM)),
    }
}

/// The bright seam around a cell; drawn below everything else, so that it hides nothing.
pub(crate) fn halo(view: OrganismView<'_>) -> Option<Item> {
    let is_thick = matches!(view.kind(), Kind::AmoeboidCell | Kind::RigidCell | Kind::Platelet);
    let seam = || Stroke::new(HALO, line_width(view) * 3.5);
    is_thick.then(|| Item::stroked(Path::smooth(&view.surface()), seam()))
}

/// A translucent body, its granules, and a membrane that is bolder where it leads.
fn amoeboid_cell(view: OrganismView<'_>, tint: Tint) -> Vec<Item> {
    let surface = view.surface();
    let thickness = line_width(view);
    let mut items = vec![body(&surface, tint, [0.42, 0.62])];
    let granules = of_role(view, Role::Cytoplasm).map(|p| (p.position, p.radius * 0.5));
    items.push(flat(Path::circles(granules), tint, 0.2));
    items.extend(view.phagosomes().map(|(_, ring)| phagosome(&ring, tint, thickness)));
    let line = Stroke::new(tint.line.faded(0.85), thickness);
    items.push(Item::stroked(Path::smooth(&surface), line));
    let lead = Path::smooth_open(&leading_edge(view, &surface));
    items.push(Item::stroked(lead, Stroke::new(tint.line.faded(0.6), thickness * 1.6)));
    items
}

/// A thin membrane around prey, with bright fluid in it.
fn phagosome(ring: &[Vec2], tint: Tint, thickness: f32) -> Item {
    let line = Stroke::new(tint.line.faded(0.6), thickness * 0.8);
    Item::filled(Path::smooth(ring), Paint::Flat(HALO.faded(0.12))).outlined(line)
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
fn rigid_cell(view: OrganismView<'_>, tint: Tint) -> Vec<Item> {
    let surface = view.surface();
    let thickness = line_width(view);
    let mut items = vec![body(&surface, tint, [0.75, 0.9])];
    let cortex: Vec<Vec2> = of_role(view, Role::InnerRing).map(|p| p.position).collect();
    let faint = Stroke::new(tint.line.faded(0.22), thickness * 0.8);
    items.push(Item::stroked(Path::smooth(&cortex), faint));
    items.extend(cap(view, tint, &surface));
    items.extend(nucleus(view, tint, 0.7));
    items.push(Item::stroked(Path::smooth(&surface), Stroke::new(tint.line, thickness)));
    items
}

/// A faint crescent behind the front.
fn cap(view: OrganismView<'_>, tint: Tint, surface: &[Vec2]) -> Option<Item> {
    let (front, count) = (view.front_index()?, surface.len());
    let reach = (count / 8).max(1);
    let around = (front + count - reach..=front + count + reach).map(|k| surface[k % count]);
    let points: Vec<Vec2> = around.collect();
    let crescent = Path::smooth_open(&points);
    Some(Item::filled(crescent, Paint::Flat(tint.detail.faded(0.32))))
}

/// A soft disc, pale in the middle, with a spot.
fn platelet(view: OrganismView<'_>, tint: Tint) -> Vec<Item> {
    let surface = view.surface();
    let thickness = line_width(view);
    let mut items = vec![body(&surface, tint, [0.8, 0.9])];
    items.extend(nucleus(view, tint, 0.55));
    items.push(Item::stroked(Path::smooth(&surface), Stroke::new(tint.line.faded(0.9), thickness)));
    items
}

/// Discs with a bright point, as of small lenses.
fn beads(view: OrganismView<'_>, tint: Tint) -> Vec<Item> {
    let one = |p: ParticleView| {
        let (at, radius) = (p.position, p.radius);
        let line = Stroke::new(tint.line, radius * 0.16);
        let glint = at + Vec2::new(-0.28, 0.28) * radius;
        [disc(at, radius * 0.92, tint).outlined(line), flat(Path::circle(glint, radius * 0.2), tint, 0.8)]
    };
    view.particles().flat_map(one).collect()
}

/// A disc of metal: a ring and a hub.
fn probe(view: OrganismView<'_>, tint: Tint) -> Vec<Item> {
    let one = |p: ParticleView| {
        let (at, radius) = (p.position, p.radius);
        let ring = Stroke::new(tint.detail.faded(0.8), radius * 0.06);
        [
            disc(at, radius * 0.97, tint).outlined(Stroke::new(tint.line, radius * 0.06)),
            Item::stroked(Path::circle(at, radius * 0.66), ring),
            flat(Path::circle(at, radius * 0.14), tint, 0.9),
        ]
    };
    view.particles().flat_map(one).collect()
}

/// Drops that run into one another.
fn fluid(view: OrganismView<'_>, tint: Tint) -> Vec<Item> {
    let drops = |scale: f32| Path::circles(view.particles().map(move |p| (p.position, p.radius * scale)));
    vec![Item::filled(drops(1.15), Paint::Flat(tint.inner.faded(0.55))), flat(drops(0.6), tint, 0.45)]
}

/// What the library does not know: its outline, if any, and its discs.
fn custom(view: OrganismView<'_>, tint: Tint) -> Vec<Item> {
    let surface = view.surface();
    let mut items = Vec::new();
    if surface.len() > 2 {
        items.push(body(&surface, tint, [0.3, 0.45]));
    }
    let discs = view.particles().filter(|p| p.radius > 0.0);
    items.extend(discs.map(|p| {
        let line = Stroke::new(tint.line, p.radius * 0.14);
        disc(p.position, p.radius * 0.93, tint).outlined(line)
    }));
    items
}

fn nucleus(view: OrganismView<'_>, tint: Tint, alpha: f32) -> Option<Item> {
    let nucleus = view.nucleus()?;
    let paint = Paint::Radial {
        centre: nucleus.position,
        radius: nucleus.radius,
        inner: tint.detail.faded(alpha),
        outer: tint.detail.faded(alpha * 0.6),
    };
    Some(Item::filled(Path::circle(nucleus.position, nucleus.radius), paint))
}

/// The area within a surface, denser towards its edge.
fn body(surface: &[Vec2], tint: Tint, [inner, outer]: [f32; 2]) -> Item {
    let centre = surface.iter().sum::<Vec2>() / surface.len().max(1) as f32;
    let reach = surface.iter().map(|p| p.distance(centre));
    let paint = Paint::Radial {
        centre,
        radius: reach.fold(0.0, f32::max),
        inner: tint.inner.faded(inner),
        outer: tint.outer.faded(outer),
    };
    Item::filled(Path::smooth(surface), paint)
}

fn disc(centre: Vec2, radius: f32, tint: Tint) -> Item {
    let paint = Paint::Radial { centre, radius, inner: tint.inner, outer: tint.outer };
    Item::filled(Path::circle(centre, radius), paint)
}

fn flat(path: Path, tint: Tint, alpha: f32) -> Item {
    Item::filled(path, Paint::Flat(tint.detail.faded(alpha)))
}

/// Lines follow the size of the discs that the surface is made of.
fn line_width(view: OrganismView<'_>) -> f32 {
    let disc = view.particles().find(|p| p.role == Role::Membrane);
    disc.map_or(0.0, |p| p.radius * 0.5)
}

fn of_role(view: OrganismView<'_>, role: Role) -> impl Iterator<Item = ParticleView> + '_ {
    view.particles().filter(move |p| p.role == role)
}
