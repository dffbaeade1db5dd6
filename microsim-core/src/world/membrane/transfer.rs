//! Cytoplasm and prey that pass from one cell to another in a division or fusion.

use crate::capability::phagocytosis::{Engulfer, Meal};
use crate::id::OrganismId;
use crate::world::World;

impl World {
    /// Moves cytoplasm from the fluid `from` to that of another cell.
    pub(super) fn move_cytoplasm(&mut self, moving: &[u32], from: Option<u32>, to: OrganismId) {
        let Self { organisms, particles, fluids, .. } = self;
        let Some(into) = organisms.get(to).and_then(|organism| organism.fluid) else { return };
        for &i in moving {
            particles.owner[i as usize] = to.index;
            particles.fluid[i as usize] = into + 1;
        }
        if let Some(from) = from {
            fluids[from as usize].particles.retain(|&i| particles.fluid[i as usize] == from + 1);
        }
        fluids[into as usize].particles.extend(moving);
    }

    /// Moves prey inside a cell to another cell.
    pub(super) fn move_meals(&mut self, meals: &[Meal], from: OrganismId, to: OrganismId) {
        for meal in meals {
            self.set_held_by(meal.prey, Some(to));
            self.exemptions.set(meal.prey.index, to.index, false);
        }
        let stays = |meal: &Meal| meals.iter().all(|moved| moved.prey != meal.prey);
        self.update_engulfer(from, |engulfer| engulfer.meals.retain(stays));
        self.update_engulfer(to, |engulfer| engulfer.meals.extend(meals.iter().cloned()));
    }

    fn update_engulfer(&mut self, id: OrganismId, change: impl FnOnce(&mut Engulfer)) {
        let engulfer = self.organisms.get_mut(id).and_then(|organism| organism.engulfer.take());
        let Some(mut engulfer) = engulfer else { return };
        change(&mut engulfer);
        engulfer.held_area = self.held_area(id, &engulfer);
        if let Some(organism) = self.organisms.get_mut(id) {
            organism.engulfer = Some(engulfer);
        }
    }
}
