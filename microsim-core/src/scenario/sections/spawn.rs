//! Organisms in one place or in random places: the tables `[[spawn]]`.

use crate::scenario::diagnostic::in_words;
use crate::scenario::reader::{DEGREE, Fields, NAME, Read, ReadContext, SpannedValue, ValueType, is_name, mismatch};
use crate::scenario::sections::chemical::{self, Chemicals};
use crate::scenario::sections::controller::{self, Controllers};
use crate::scenario::sections::group::{Angle, Group, Positions};
use crate::scenario::sections::prototype::Prototype;
use crate::scenario::sections::prototype::{self, Prototypes};
use crate::{CollisionGroups, Controller, WorldConfig};
use glam::Vec2;
use std::collections::BTreeSet;

/// What groups refer to by name, and the room that they are put into.
pub(crate) struct Definitions<'a> {
    pub prototypes: &'a Prototypes,
    pub controllers: &'a Controllers,
    pub chemicals: &'a Chemicals,
    pub config: &'a WorldConfig,
    pub size: Vec2,
}

/// Reads the `[[spawn]]` tables.
pub(crate) fn read(root: &mut Fields<'_>, definitions: &Definitions<'_>) -> Vec<Group> {
    let mut names = BTreeSet::new();
    let mut groups = Vec::new();
    for mut fields in root.list("spawn") {
        let group = read_spawn(&mut fields, definitions, &mut names);
        fields.finish();
        groups.extend(group);
    }
    groups
}

fn read_spawn(fields: &mut Fields<'_>, definitions: &Definitions<'_>, names: &mut BTreeSet<String>) -> Option<Group> {
    let prototype = prototype::read_named(fields, definitions.prototypes);
    let positions = read_positions(fields, definitions.size);
    let angle = fields.or("angle", Angle::Radians(0.0));
    let Scale(scale) = fields.or("scale", Scale([1.0, 1.0]));
    let controller = controller::read_named(fields, "controller", definitions.controllers).unwrap_or_default();
    let exchanges = chemical::read_exchanges(fields, definitions.chemicals);
    let name = read_name(fields, names);
    let is_player = fields.or("player", false);
    let (from, respawn) = read_times(fields, is_player || name.is_some());
    let groups = read_tier(fields, prototype.as_ref());
    let damping = ["linear_damping", "angular_damping"].map(|field| read_damping(fields, field, definitions.config));
    let prototype = prototype?;
    check_steering(fields, &prototype, controller != Controller::Still, is_player);
    let (path, positions) = (fields.path.clone(), positions?);
    check_box(fields, &positions, prototype.extent(scale[1]));
    Some(Group {
        path,
        prototype,
        positions,
        angle,
        scale,
        groups,
        damping,
        controller,
        exchanges,
        name,
        is_player,
        from,
        respawn,
    })
}

/// When organisms are spawned at first, and how long after they are gone again, s.
fn read_times(fields: &mut Fields<'_>, is_known_by_name: bool) -> (f32, Option<f32>) {
    let from = fields.number("from", 0.0, [0.0, 1e6]);
    let respawn = fields.number_within("respawn", [0.0, 1e6]);
    for field in ["from", "respawn"].into_iter().filter(|field| fields.has(field) && is_known_by_name) {
        let accepted = "a [[spawn]] without `name` and `player`";
        fields.refuse(field, "one that is known by name is there from the beginning, once", accepted);
    }
    (from, respawn)
}

/// Checks that what is steered can move.
fn check_steering(fields: &Fields<'_>, prototype: &Prototype, has_controller: bool, is_player: bool) {
    let steering = [("controller", has_controller), ("player", is_player)];
    for (field, _) in steering.into_iter().filter(|(_, is_set)| *is_set && !prototype.can_move()) {
        let message = format!("`{}` cannot move", prototype.name);
        fields.refuse(field, message, "an amoeboid_cell, a rigid_cell, a bacterium or a probe");
    }
}

/// The groups of the tier that organisms lie in, or all.
fn read_tier(fields: &mut Fields<'_>, prototype: Option<&Prototype>) -> CollisionGroups {
    let Some(tier) = fields.get::<u32>("tier") else { return CollisionGroups::ALL };
    if prototype.is_some_and(Prototype::holds_fluid) {
        fields.refuse("tier", "what holds fluid meets everything", "a kind without membrane and fluid");
    }
    CollisionGroups::in_tier(tier).unwrap_or_else(|| {
        fields.refuse("tier", format!("{tier} is out of range"), "0 to 31");
        CollisionGroups::ALL
    })
}

/// A damping of their own, of which substeps carry as much as of the medium's.
fn read_damping(fields: &mut Fields<'_>, field: &'static str, config: &WorldConfig) -> f32 {
    let damping = fields.number(field, 0.0, [0.0, 100.0]);
    let of_all = WorldConfig { damping, ..config.clone() }.validate();
    if let Some(error) = of_all.err().filter(|error| error.field() == "damping") {
        let (message, accepted) = in_words(&error);
        fields.refuse(field, message, accepted.unwrap_or_default());
    }
    damping
}

/// Checks that an organism of this extent fits into the box that it is to be put into.
fn check_box(fields: &Fields<'_>, positions: &Positions, extent: f32) {
    let Positions::Random { within: [low, high], .. } = positions else {
        return;
    };
    let inner = *high - *low - 2.0 * extent;
    if inner.cmplt(Vec2::ZERO).any() {
        let named = ["within", "scale"].into_iter().find(|field| fields.has(field));
        let message = format!("with an extent of {extent} it does not fit into its box");
        let accepted = format!("a box of at least {0} by {0}, or a smaller organism", 2.0 * extent);
        fields.refuse(named.unwrap_or("of"), message, accepted);
    }
}

fn read_name(fields: &mut Fields<'_>, names: &mut BTreeSet<String>) -> Option<String> {
    let name: String = fields.get("name")?;
    let path = fields.at("name");
    if !is_name(&name) {
        fields.context.refuse(&path, "not a usable name", NAME);
    }
    if fields.has("count") {
        fields.context.refuse(&path, "one name for several organisms", "`name` without `count`");
    }
    if !names.insert(name.clone()) {
        fields.context.refuse(&path, format!("the name `{name}` is taken"), "a name that no other organism has");
    }
    Some(name)
}

fn read_positions(fields: &mut Fields<'_>, size: Vec2) -> Option<Positions> {
    let at: Option<Vec2> = fields.get("at");
    let count = fields.or("count", 1);
    let within = fields.get("within").unwrap_or([Vec2::ZERO, size]);
    let gap = fields.number("gap", 0.0, [0.0, 1000.0]);
    if !fields.has("at") {
        return is_box_in("within", &within, size, fields).then_some(Positions::Random { count, within, gap });
    }
    for field in ["count", "within", "gap"].into_iter().filter(|field| fields.has(field)) {
        let accepted = "either `at`, or `count`, `within` and `gap`";
        fields.refuse(field, "does not go with `at`", accepted);
    }
    at.map(Positions::At)
}

/// Whether a field's box lies in the room; reports it if it does not.
pub(crate) fn is_box_in(field: &str, [low, high]: &[Vec2; 2], size: Vec2, fields: &Fields<'_>) -> bool {
    let is_box = Vec2::ZERO.cmple(*low).all() && low.cmplt(*high).all() && high.cmple(size).all();
    if !is_box {
        let accepted = format!("[lower left, upper right] corner within 0 to {} by 0 to {}", size.x, size.y);
        fields.refuse(field, "not a box in the room", accepted);
    }
    is_box
}

impl Read for Angle {
    fn accepted() -> String {
        "degrees from -36000 to 36000, or \"random\"".to_owned()
    }

    fn value_type() -> ValueType {
        ValueType::Either(vec![ValueType::Number, ValueType::Word(vec!["random"])])
    }

    fn written(&self) -> String {
        match self {
            Self::Radians(angle) => (angle / DEGREE).written(),
            Self::Random => "\"random\"".to_owned(),
        }
    }

    fn read(value: &SpannedValue<'_>, path: &str, context: &ReadContext<'_>) -> Option<Self> {
        if value.get_ref().as_str() == Some("random") {
            return Some(Self::Random);
        }
        if value.get_ref().is_str() {
            return mismatch(value, path, context);
        }
        let degrees = f32::read(value, path, context)?;
        if !(-36_000.0..=36_000.0).contains(&degrees) {
            return mismatch(value, path, context);
        }
        Some(Self::Radians(degrees * DEGREE))
    }
}

/// Smallest and largest scale, from one number or two.
struct Scale([f32; 2]);

impl Read for Scale {
    fn accepted() -> String {
        "a number 0.01 to 100, or [smallest, largest]".to_owned()
    }

    fn value_type() -> ValueType {
        ValueType::Either(vec![ValueType::Number, ValueType::array(ValueType::Number, 2)])
    }

    fn written(&self) -> String {
        let [smallest, largest] = self.0;
        if smallest == largest { smallest.written() } else { self.0.written() }
    }

    fn read(value: &SpannedValue<'_>, path: &str, context: &ReadContext<'_>) -> Option<Self> {
        let range = if value.get_ref().is_array() {
            <[f32; 2]>::read(value, path, context)?
        } else {
            [f32::read(value, path, context)?; 2]
        };
        let is_sound = 0.01 <= range[0] && range[0] <= range[1] && range[1] <= 100.0;
        if is_sound { Some(Self(range)) } else { mismatch(value, path, context) }
    }
}
