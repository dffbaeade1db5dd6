//! Controllers: the tables `[wander.NAME]`, `[patrol.NAME]` and so on.

use super::fields::{Fields, Read, Report, mismatch};
use super::shape::Shape;
use super::source::Value;
use crate::capability::controller::Controller;
use glam::Vec2;
use std::collections::BTreeMap;

/// Controllers by name.
pub(super) type Controllers = BTreeMap<String, Controller>;

type ReadController = fn(&mut Fields<'_>, size: Vec2) -> Option<Controller>;

/// Tables of controllers and how they are read.
const KINDS: [(&str, ReadController); 4] = [
    ("wander", |fields, _| wander(fields)),
    ("patrol", patrol),
    ("thrash", |fields, _| thrash(fields)),
    ("ram", |fields, _| ram(fields)),
];

/// Reads all controllers of a file for a room of this size.
pub(super) fn read(root: &mut Fields<'_>, size: Vec2) -> Controllers {
    let mut controllers = Controllers::new();
    for (kind, read) in KINDS {
        for (name, mut fields) in root.named(kind) {
            let (path, report) = (fields.path.clone(), fields.report);
            let read = || {
                let controller = read(&mut fields, size).unwrap_or_default();
                controller.validate().map(|()| controller)
            };
            let controller = report.check_all(&path, read).unwrap_or_default();
            fields.finish();
            if controllers.contains_key(&name) {
                let accepted = "a name that no other controller has".to_owned();
                report.refuse_key(&path, format!("the name `{name}` is taken"), accepted);
            }
            controllers.insert(name, controller);
        }
    }
    controllers
}

fn wander(fields: &mut Fields<'_>) -> Option<Controller> {
    let interval = fields.required("interval");
    let rest = fields.or("rest", 0.0);
    Some(Controller::wander(interval?, rest))
}

fn patrol(fields: &mut Fields<'_>, size: Vec2) -> Option<Controller> {
    let through: Option<Vec<Vec2>> = fields.required("through");
    let repeats = fields.or("repeats", false);
    let unit = fields.or("in", Unit::Micrometres);
    let mut through = through?;
    if unit == Unit::Rooms {
        for (index, point) in through.iter_mut().enumerate() {
            let is_inside = point.cmpge(Vec2::ZERO).all() && point.cmple(Vec2::ONE).all();
            if !is_inside {
                let field = fields.at(&format!("through.{index}"));
                fields.report.refuse(&field, "lies outside the room", "fractions of the room, 0 to 1 each");
            }
            *point *= size;
        }
    }
    Some(Controller::patrol(through, repeats))
}

fn thrash(fields: &mut Fields<'_>) -> Option<Controller> {
    let interval = fields.required("interval");
    let reversal = fields.or("reversal", 1.0);
    Some(Controller::thrash(interval?, reversal))
}

fn ram(fields: &mut Fields<'_>) -> Option<Controller> {
    let [charge, retreat, distance] = ["charge", "retreat", "distance"].map(|field| fields.required(field));
    Some(Controller::ram(charge?, retreat?, distance?))
}

/// What the numbers of a patrol's points count.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Unit {
    Micrometres,
    Rooms,
}

impl Read for Unit {
    fn accepted() -> String {
        "\"units\" or \"room\"".to_owned()
    }

    fn shape() -> Shape {
        Shape::Word(&["units", "room"])
    }

    fn written(&self) -> String {
        match self {
            Self::Micrometres => "\"units\"",
            Self::Rooms => "\"room\"",
        }
        .to_owned()
    }

    fn read(value: &Value<'_>, path: &str, report: &Report<'_>) -> Option<Self> {
        match value.get_ref().as_str() {
            Some("units") => Some(Self::Micrometres),
            Some("room") => Some(Self::Rooms),
            _ => mismatch(value, path, report),
        }
    }
}
