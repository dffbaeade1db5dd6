//! Bites: an amoeba gnaws at a smaller one that it touches. Real ones do: *Entamoeba histolytica* kills by taking in pieces of
//! living cells (trogocytosis; Ralston and others 2014, Nature 508, 526).

use super::change::Change;
use microsim_core::glam::Vec2;
use microsim_core::{Kind, OrganismId, OrganismView, Role, World};

/// Area of who bites over that of who is bitten, at least.
pub const LEAST_RATIO: f32 = 1.5;
/// Gap between two outlines' nodes that counts as touching, units; nodes have radii from 0.5 to 0.8.
const GAP: f32 = 1.8;
/// Time for which they have to touch first, s.
const HOLD: f32 = 0.4;
/// Cytoplasm that a bite takes, particles/s; for each thick coat half as much.
const RATE: f32 = 20.0;

/// An amoeba that touches a smaller one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bite {
    /// Who bites.
    pub by: OrganismId,
    /// Who is bitten.
    pub of: OrganismId,
    /// For how long they have touched, s.
    pub held: f32,
    /// What is to be taken, particles.
    owed: f32,
}

/// Amoebae that touch smaller ones.
#[derive(Clone, Debug, Default)]
pub struct Bites(Vec<Bite>);

impl Bites {
    /// Looks after a step who touches whom. Returns who loses a particle of cytoplasm now: by whom, and who.
    pub fn advance(&mut self, world: &World) -> Vec<[OrganismId; 2]> {
        let dt = world.config().dt;
        let before = std::mem::take(&mut self.0);
        let mut taken = Vec::new();
        for [by, of] in pairs(world) {
            let known = before.iter().find(|bite| (bite.by, bite.of) == (by.id(), of.id()));
            let mut bite = known.copied().unwrap_or(Bite { by: by.id(), of: of.id(), held: 0.0, owed: 0.0 });
            bite.held += dt;
            if bite.held > HOLD {
                bite.owed += RATE * 0.5_f32.powi(Change::Coat.count(of) as i32) * dt;
            }
            while bite.owed >= 1.0 {
                bite.owed -= 1.0;
                taken.push([bite.by, bite.of]);
            }
            self.0.push(bite);
        }
        taken
    }

    /// Whether somebody is bitten now.
    #[must_use]
    pub fn is_bitten(&self, cell: OrganismId) -> bool {
        self.0.iter().any(|bite| bite.of == cell && bite.held > HOLD)
    }
}

/// Particles of cytoplasm of a cell.
#[must_use]
pub fn cytoplasm(cell: OrganismView<'_>) -> u32 {
    let is_cytoplasm = |role| matches!(role, Role::Cytoplasm | Role::GrownCytoplasm);
    cell.particles().filter(|particle| is_cytoplasm(particle.role)).count() as u32
}

/// Whether one amoeba is large enough to bite another.
#[must_use]
pub fn can_bite(by: OrganismView<'_>, of: OrganismView<'_>) -> bool {
    by.cytoplasm_area() >= LEAST_RATIO * of.cytoplasm_area()
}

/// All amoebae that touch a smaller one that is no sister.
fn pairs(world: &World) -> Vec<[OrganismView<'_>; 2]> {
    let amoebae: Vec<_> = world.view().organisms().filter(|cell| cell.kind() == Kind::AmoeboidCell).collect();
    let mut pairs = Vec::new();
    for by in &amoebae {
        let others = amoebae.iter().filter(|of| of.id() != by.id() && of.user_data() != by.user_data());
        pairs.extend(others.filter(|of| touch(*by, **of) && can_bite(*by, **of)).map(|of| [*by, *of]));
    }
    pairs
}

fn touch(a: OrganismView<'_>, b: OrganismView<'_>) -> bool {
    let ((low_a, high_a), (low_b, high_b)) = (a.bounds(), b.bounds());
    if (low_a - high_b).max(low_b - high_a).max_element() > GAP {
        return false;
    }
    let near_b = |at: &Vec2| at.cmpgt(low_b - GAP).all() && at.cmplt(high_b + GAP).all();
    let outline: Vec<Vec2> = b.outline().collect();
    a.outline().filter(near_b).any(|at| outline.iter().any(|to| at.distance_squared(*to) < GAP * GAP))
}
