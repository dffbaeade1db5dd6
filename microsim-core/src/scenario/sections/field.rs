//! Organisms on grids: the tables `[[field]]`.

use crate::WorldConfig;
use crate::scenario::grid::GridPlan;
use crate::scenario::reader::{Fields, ReadContext};
use crate::scenario::sections::group::Group;
use crate::scenario::sections::prototype::{self, Prototype, Prototypes};
use glam::Vec2;

/// A `[[field]]` table: its path, its prototype and its grid.
pub(crate) type Plan = (String, Prototype, GridPlan);

/// Reads the `[[field]]` tables; they are laid out when the size of the room is known.
pub(crate) fn read(root: &mut Fields<'_>, prototypes: &Prototypes) -> Vec<Plan> {
    let mut plans = Vec::new();
    for mut fields in root.list("field") {
        let prototype = prototype::read_named(&mut fields, prototypes);
        let plan = read_plan(&mut fields, prototype.as_ref());
        let path = fields.path.clone();
        fields.finish();
        if let (Some(prototype), Some(plan)) = (prototype, plan) {
            plans.push((path, prototype, plan));
        }
    }
    plans
}

fn read_plan(fields: &mut Fields<'_>, prototype: Option<&Prototype>) -> Option<GridPlan> {
    let count = fields.required("count");
    let pitch = fields.required("pitch");
    let jitter = fields.number("jitter", 0.0, [0.0, 1000.0]);
    let margin = fields.number("margin", 0.0, [0.0, 1000.0]);
    let (count, pitch) = (count?, pitch?);
    if count == 0 {
        fields.refuse("count", "0 is out of range", "1 or more");
        return None;
    }
    let least = prototype.map_or(0.0, |prototype| 2.0 * (prototype.extent(1.0) + jitter));
    let is_sound = fields.is_within("pitch", pitch, [least, WorldConfig::MAX_SIZE]);
    is_sound.then_some(GridPlan { count, pitch, jitter, margin })
}

/// Size of the room that holds every field.
pub(crate) fn room_for(plans: &[Plan], context: &ReadContext<'_>) -> Option<Vec2> {
    let mut room = Vec2::ONE;
    for (path, _, plan) in plans {
        let wanted = plan.room();
        if wanted.cmpgt(Vec2::splat(WorldConfig::MAX_SIZE)).any() {
            let message = format!("needs a room of {:.0} by {:.0}", wanted.x, wanted.y);
            context.refuse(&format!("{path}.count"), message, format!("at most {0} by {0}", WorldConfig::MAX_SIZE));
            return None;
        }
        room = Vec2::select(wanted.cmpgt(room), wanted, room);
    }
    Some(room)
}

/// Lays the grids out in a room; reports those that do not fit.
pub(crate) fn lay_out(plans: Vec<Plan>, size: Vec2, context: &ReadContext<'_>) -> Vec<Group> {
    let mut groups = Vec::new();
    for (path, prototype, plan) in plans {
        let wanted = plan.room();
        match plan.fit(size) {
            Some(grid) => groups.push(Group::on_grid(path, prototype, grid)),
            None => {
                let message = format!("does not fit into the room of {} by {}", size.x, size.y);
                let accepted = format!("a room of about {:.1} by {:.1}, or fewer", wanted.x, wanted.y);
                context.refuse(&format!("{path}.count"), message, accepted);
            }
        }
    }
    groups
}
