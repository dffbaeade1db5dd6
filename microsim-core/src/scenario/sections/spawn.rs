//! Groups of organisms: the tables `[[spawn]]` and `[[field]]`.

use crate::scenario::reader::document::{DEGREE, NAME, Value, is_name, unknown};
use crate::scenario::reader::fields::{Fields, Read, Report, mismatch};
use crate::scenario::reader::value_type::Shape;
use crate::scenario::sections::chemical::{self, Chemicals};
use crate::scenario::sections::controller::{self, Controllers};
use crate::scenario::sections::field::{Grid, GridPlan};
use crate::scenario::sections::prototype::{Prototype, Prototypes};
use crate::{Controller, Exchange};
use glam::Vec2;
use std::collections::BTreeSet;

/// Organisms of one prototype that one table puts into the world.
#[derive(Clone, Debug)]
pub(crate) struct Group {
    /// Path of its table.
    pub path: String,
    pub prototype: Prototype,
    pub place: Place,
    pub angle: Angle,
    /// Smallest and largest scale.
    pub scale: [f32; 2],
    pub controller: Controller,
    pub exchanges: Vec<Exchange>,
    pub name: Option<String>,
    pub is_player: bool,
    /// Time from which on they are there, s.
    pub from: f32,
    /// Time after which one that is gone or taken in is replaced, s.
    pub respawn: Option<f32>,
}

/// Where organisms are put.
#[derive(Clone, Debug)]
pub(crate) enum Place {
    /// One, here.
    At(Vec2),
    /// Anywhere wholly within a box, `gap` from everything else.
    Random { count: u32, within: [Vec2; 2], gap: f32 },
    /// On a jittered grid.
    Grid(Grid),
}

impl Place {
    pub(crate) fn count(&self) -> u32 {
        match self {
            Self::At(_) => 1,
            Self::Random { count, .. } => *count,
            Self::Grid(grid) => grid.count(),
        }
    }
}

/// Direction of organisms.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Angle {
    Radians(f32),
    Random,
}

impl Read for Angle {
    fn accepted() -> String {
        "degrees from -36000 to 36000, or \"random\"".to_owned()
    }

    fn shape() -> Shape {
        Shape::Either(vec![Shape::Number, Shape::Word(&["random"])])
    }

    fn written(&self) -> String {
        match self {
            Self::Radians(angle) => (angle / DEGREE).written(),
            Self::Random => "\"random\"".to_owned(),
        }
    }

    fn read(value: &Value<'_>, path: &str, report: &Report<'_>) -> Option<Self> {
        if value.get_ref().as_str() == Some("random") {
            return Some(Self::Random);
        }
        if value.get_ref().is_str() {
            return mismatch(value, path, report);
        }
        let degrees = f32::read(value, path, report)?;
        if !(-36_000.0..=36_000.0).contains(&degrees) {
            return mismatch(value, path, report);
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

    fn shape() -> Shape {
        Shape::Either(vec![Shape::Number, Shape::array(Shape::Number, 2)])
    }

    fn written(&self) -> String {
        let [smallest, largest] = self.0;
        if smallest == largest { smallest.written() } else { self.0.written() }
    }

    fn read(value: &Value<'_>, path: &str, report: &Report<'_>) -> Option<Self> {
        let range = if value.get_ref().is_array() {
            <[f32; 2]>::read(value, path, report)?
        } else {
            [f32::read(value, path, report)?; 2]
        };
        let is_sound = 0.01 <= range[0] && range[0] <= range[1] && range[1] <= 100.0;
        if is_sound { Some(Self(range)) } else { mismatch(value, path, report) }
    }
}

/// What groups refer to by name, and the room that they are put into.
pub(crate) struct Surroundings<'a> {
    pub prototypes: &'a Prototypes,
    pub controllers: &'a Controllers,
    pub chemicals: &'a Chemicals,
    pub size: Vec2,
}

/// Reads the `[[spawn]]` tables.
pub(crate) fn read_spawns(root: &mut Fields<'_>, around: &Surroundings<'_>) -> Vec<Group> {
    let mut names = BTreeSet::new();
    let mut groups = Vec::new();
    for mut fields in root.list("spawn") {
        let group = read_spawn(&mut fields, around, &mut names);
        fields.finish();
        groups.extend(group);
    }
    groups
}

fn read_spawn(fields: &mut Fields<'_>, around: &Surroundings<'_>, names: &mut BTreeSet<String>) -> Option<Group> {
    let prototype = read_prototype(fields, around.prototypes);
    let place = read_place(fields, around.size);
    let angle = fields.or("angle", Angle::Radians(0.0));
    let Scale(scale) = fields.or("scale", Scale([1.0, 1.0]));
    let controller = controller::read_named(fields, "controller", around.controllers).unwrap_or_default();
    let exchanges = chemical::read_exchanges(fields, around.chemicals);
    let name = read_name(fields, names);
    let is_player = fields.or("player", false);
    let from = fields.number("from", 0.0, [0.0, 1e6]);
    let respawn = fields.get("respawn").filter(|&time| fields.is_within("respawn", time, [0.0, 1e6]));
    for field in ["from", "respawn"].into_iter().filter(|field| fields.has(field) && (is_player || name.is_some())) {
        let accepted = "a [[spawn]] without `name` and `player`";
        fields.report.refuse(
            &fields.at(field),
            "one that is known by name is there from the beginning, once",
            accepted,
        );
    }
    let prototype = prototype?;
    let steering = [("controller", controller != Controller::Still), ("player", is_player)];
    for (field, _) in steering.into_iter().filter(|(_, is_set)| *is_set && !prototype.can_move()) {
        let message = format!("`{}` cannot move", prototype.name);
        fields.report.refuse(&fields.at(field), message, "an amoeboid_cell, a rigid_cell, a bacterium or a probe");
    }
    let (path, place) = (fields.path.clone(), place?);
    check_box(fields, &place, prototype.extent(scale[1]));
    Some(Group { path, prototype, place, angle, scale, controller, exchanges, name, is_player, from, respawn })
}

/// Checks that an organism of this reach fits into the box that it is to be put into.
fn check_box(fields: &Fields<'_>, place: &Place, reach: f32) {
    let Place::Random { within: [low, high], .. } = place else {
        return;
    };
    let inner = *high - *low - 2.0 * reach;
    if inner.cmplt(Vec2::ZERO).any() {
        let named = ["within", "scale"].into_iter().find(|field| fields.has(field));
        let message = format!("with a reach of {reach} it does not fit into its box");
        let accepted = format!("a box of at least {0} by {0}, or a smaller organism", 2.0 * reach);
        fields.report.refuse(&fields.at(named.unwrap_or("of")), message, accepted);
    }
}

fn read_prototype(fields: &mut Fields<'_>, prototypes: &Prototypes) -> Option<Prototype> {
    let of: String = fields.required("of")?;
    if let Some(prototype) = prototypes.get(&of) {
        return prototype.clone();
    }
    let known: Vec<&str> = prototypes.keys().map(String::as_str).collect();
    let (message, accepted) = unknown("prototype", &of, &known);
    fields.report.refuse(&fields.at("of"), message, accepted);
    None
}

fn read_name(fields: &mut Fields<'_>, names: &mut BTreeSet<String>) -> Option<String> {
    let name: String = fields.get("name")?;
    let path = fields.at("name");
    if !is_name(&name) {
        fields.report.refuse(&path, "not a usable name", NAME);
    }
    if fields.has("count") {
        fields.report.refuse(&path, "one name for several organisms", "`name` without `count`");
    }
    if !names.insert(name.clone()) {
        fields.report.refuse(&path, format!("the name `{name}` is taken"), "a name that no other organism has");
    }
    Some(name)
}

fn read_place(fields: &mut Fields<'_>, size: Vec2) -> Option<Place> {
    let at: Option<Vec2> = fields.get("at");
    let count = fields.or("count", 1);
    let within = fields.get("within").unwrap_or([Vec2::ZERO, size]);
    let gap = fields.number("gap", 0.0, [0.0, 1000.0]);
    if !fields.has("at") {
        return is_box_in(&within, size, fields).then_some(Place::Random { count, within, gap });
    }
    for field in ["count", "within", "gap"].into_iter().filter(|field| fields.has(field)) {
        let accepted = "either `at`, or `count`, `within` and `gap`";
        fields.report.refuse(&fields.at(field), "does not go with `at`", accepted);
    }
    at.map(Place::At)
}

fn is_box_in([low, high]: &[Vec2; 2], size: Vec2, fields: &Fields<'_>) -> bool {
    let is_box = Vec2::ZERO.cmple(*low).all() && low.cmplt(*high).all() && high.cmple(size).all();
    if !is_box {
        let accepted = format!("[lower left, upper right] corner within 0 to {} by 0 to {}", size.x, size.y);
        fields.report.refuse(&fields.at("within"), "not a box in the room", accepted);
    }
    is_box
}

/// Reads the `[[field]]` tables; they are laid out when the size of the room is known.
pub(crate) fn read_fields(root: &mut Fields<'_>, prototypes: &Prototypes) -> Vec<(String, Prototype, GridPlan)> {
    let mut plans = Vec::new();
    for mut fields in root.list("field") {
        let prototype = read_prototype(&mut fields, prototypes);
        let plan = GridPlan::read(&mut fields, prototype.as_ref());
        let path = fields.path.clone();
        fields.finish();
        if let (Some(prototype), Some(plan)) = (prototype, plan) {
            plans.push((path, prototype, plan));
        }
    }
    plans
}

impl Group {
    /// Organisms on a grid: unturned, in their own size, not steered.
    pub(crate) fn on_grid(path: String, prototype: Prototype, grid: Grid) -> Self {
        Self {
            path,
            prototype,
            place: Place::Grid(grid),
            angle: Angle::Radians(0.0),
            scale: [1.0, 1.0],
            controller: Controller::Still,
            exchanges: Vec::new(),
            name: None,
            is_player: false,
            from: 0.0,
            respawn: None,
        }
    }

    /// How many there are from the beginning in random places.
    pub(crate) fn random_count(&self) -> usize {
        match self.place {
            Place::Random { count, .. } if self.from == 0.0 => count as usize,
            _ => 0,
        }
    }

    /// Path of the field that says how many there are.
    pub(crate) fn count_path(&self, report: &Report<'_>) -> String {
        let count = format!("{}.count", self.path);
        if report.source.has(&count) { count } else { format!("{}.of", self.path) }
    }
}

/// Checks that the scaled organisms are sound and that all of them together are not too many, before anything is made.
pub(crate) fn check_size(groups: &[Group], max_particles: u32, report: &Report<'_>) {
    let mut left = u64::from(max_particles);
    for group in groups {
        let sizes = group.scale.map(|scale| group.prototype.particles(scale));
        let [Ok(_), Ok(each)] = sizes else {
            sizes.into_iter().filter_map(Result::err).for_each(|error| {
                let (message, accepted) = crate::scenario::diagnostic::in_words(&error);
                let message = format!("scaled, its {} {message}", error.field());
                report.refuse(&format!("{}.scale", group.path), message, accepted.unwrap_or_default());
            });
            continue;
        };
        let count = u64::from(group.place.count());
        if count * each > left {
            let message = format!("{count} x {each} particles are more than the world has room for");
            let accepted = format!("at most {}, for world.max_particles = {max_particles}", left / each);
            report.refuse(&group.count_path(report), message, accepted);
            continue;
        }
        left -= count * each;
    }
}
