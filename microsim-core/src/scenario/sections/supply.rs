//! Emitters and drains: the tables `[[emitter]]` and `[[drain]]`.

use crate::scenario::reader::Fields;
use crate::scenario::sections::group::Angle;
use crate::scenario::sections::prototype;
use crate::scenario::sections::spawn::{Definitions, is_box_in};
use crate::{Drain, Emitter, Recipe, Region, WorldConfig};
use glam::Vec2;

/// What comes and goes while a world runs, emitters with the paths of their tables.
#[derive(Clone, Debug, Default)]
pub(crate) struct Supplies {
    pub emitters: Vec<(String, Emitter)>,
    pub drains: Vec<Drain>,
}

/// Reads all emitters and drains of a file.
pub(crate) fn read(root: &mut Fields<'_>, definitions: &Definitions<'_>) -> Supplies {
    let mut supplies = Supplies::default();
    for mut fields in root.list("emitter") {
        let emitter = read_emitter(&mut fields, definitions);
        let path = fields.path.clone();
        fields.finish();
        supplies.emitters.extend(emitter.map(|emitter| (path, emitter)));
    }
    for mut fields in root.list("drain") {
        let drain = read_drain(&mut fields, definitions);
        fields.finish();
        supplies.drains.extend(drain);
    }
    supplies
}

fn read_emitter(fields: &mut Fields<'_>, definitions: &Definitions<'_>) -> Option<Emitter> {
    let prototype = prototype::read_named(fields, definitions.prototypes);
    let region = read_region(fields, definitions.size);
    let rate = fields.required("rate").filter(|&rate| fields.is_within("rate", rate, [0.0, 1000.0]));
    let velocity = fields.or("velocity", Vec2::ZERO);
    let angle = match fields.or("angle", Angle::Random) {
        Angle::Radians(angle) => Some(angle),
        Angle::Random => None,
    };
    let (prototype, region, rate) = (prototype?, region?, rate?);
    let recipe = Recipe::Organism(prototype.scaled(1.0).0);
    let emitter = Emitter { region, recipe, rate, velocity, angle };
    fields.context.check(&fields.path, emitter.validate()).map(|()| emitter)
}

fn read_drain(fields: &mut Fields<'_>, definitions: &Definitions<'_>) -> Option<Drain> {
    let region = read_region(fields, definitions.size);
    let is_for_one = fields.has("of");
    let prototype = prototype::read_optional(fields, definitions.prototypes);
    let kind = prototype.map(|prototype| prototype.kind());
    (!is_for_one || kind.is_some()).then_some(Drain { region: region?, kind })
}

/// A disc around `at`, or the box `within`, by default the room.
fn read_region(fields: &mut Fields<'_>, size: Vec2) -> Option<Region> {
    let at: Option<Vec2> = fields.get("at");
    let radius = fields.number_within("radius", [0.0, WorldConfig::MAX_SIZE]);
    let [low, high] = fields.get("within").unwrap_or([Vec2::ZERO, size]);
    let is_disc = fields.has("at") || fields.has("radius");
    if !is_disc {
        return is_box_in("within", &[low, high], size, fields).then_some(Region::Box { low, high });
    }
    fields.require("at", "[x, y], two numbers");
    fields.require("radius", "a number");
    if fields.has("within") {
        fields.refuse("within", "does not go with `at`", "either `at` and `radius`, or `within`");
    }
    Some(Region::Circle { centre: at?, radius: radius? })
}
