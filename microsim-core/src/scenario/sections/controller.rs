//! Controllers: the tables `[wander.NAME]`, `[patrol.NAME]` and so on.

use crate::scenario::reader::{DEGREE, Fields, Keyword};
use crate::scenario::sections::chemical::{self, Chemicals};
use crate::{
    AvoidanceParams, BrownianParams, ChemicalId, ChemotaxisParams, Controller, FleeParams, PersistentWalkParams,
    PursueParams, RunAndTumbleParams,
};
use glam::Vec2;
use std::collections::BTreeMap;

/// Controllers by name.
pub(crate) type Controllers = BTreeMap<String, Controller>;

/// What controllers may refer to.
struct Known<'a> {
    size: Vec2,
    chemicals: &'a Chemicals,
    /// Those of the kinds above.
    controllers: &'a Controllers,
}

type ReadController = fn(&mut Fields<'_>, &Known<'_>) -> Option<Controller>;

/// Tables of controllers and how they are read. `otherwise` can name controllers of the kinds above.
const KINDS: [(&str, ReadController); 11] = [
    ("wander", |fields, _| wander(fields)),
    ("patrol", patrol),
    ("thrash", |fields, _| thrash(fields)),
    ("ram", |fields, _| ram(fields)),
    ("persistent_walk", |fields, _| Some(persistent_walk(fields))),
    ("chemotaxis", chemotaxis),
    ("run_and_tumble", run_and_tumble),
    ("brownian", |fields, _| Some(brownian(fields))),
    ("avoidance", |fields, _| Some(avoidance(fields))),
    ("pursue", pursue),
    ("flee", flee),
];

/// Reads all controllers of a file for a room of this size.
pub(crate) fn read(root: &mut Fields<'_>, size: Vec2, chemicals: &Chemicals) -> Controllers {
    let mut controllers = Controllers::new();
    for (kind, read) in KINDS {
        for (name, mut fields) in root.named(kind) {
            let known = Known { size, chemicals, controllers: &controllers };
            let (path, context) = (fields.path.clone(), fields.context);
            let read = || {
                let controller = read(&mut fields, &known).unwrap_or_default();
                controller.validate().map(|()| controller)
            };
            let controller = context.check_all(&path, read).unwrap_or_default();
            fields.finish();
            if controllers.contains_key(&name) {
                let accepted = "a name that no other controller has".to_owned();
                context.refuse_key(&path, format!("the name `{name}` is taken"), accepted);
            }
            controllers.insert(name, controller);
        }
    }
    controllers
}

/// The controller that a field names, if it is there; reports it if there is none of that name.
pub(crate) fn read_named(
    fields: &mut Fields<'_>,
    field: &'static str,
    controllers: &Controllers,
) -> Option<Controller> {
    let name = fields.get::<String>(field)?;
    let found = controllers.get(&name).cloned();
    if found.is_none() {
        fields.refuse_unknown(field, "controller", &name, controllers.keys().map(String::as_str));
    }
    found
}

fn wander(fields: &mut Fields<'_>) -> Option<Controller> {
    let interval = fields.required("interval");
    let rest = fields.or("rest", 0.0);
    Some(Controller::wander(interval?, rest))
}

fn patrol(fields: &mut Fields<'_>, known: &Known<'_>) -> Option<Controller> {
    let through: Option<Vec<Vec2>> = fields.required("through");
    let repeats = fields.or("repeats", false);
    let unit = fields.or("in", Unit::Micrometres);
    let mut through = through?;
    if unit == Unit::Rooms {
        for (index, point) in through.iter_mut().enumerate() {
            let is_inside = point.cmpge(Vec2::ZERO).all() && point.cmple(Vec2::ONE).all();
            if !is_inside {
                let field = fields.at(&format!("through.{index}"));
                fields.context.refuse(&field, "lies outside the room", "fractions of the room, 0 to 1 each");
            }
            *point *= known.size;
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

fn persistent_walk(fields: &mut Fields<'_>) -> Controller {
    let default = PersistentWalkParams::default();
    let persistence = fields.or("persistence", default.persistence);
    Controller::persistent_walk(PersistentWalkParams { persistence })
}

fn chemotaxis(fields: &mut Fields<'_>, known: &Known<'_>) -> Option<Controller> {
    let name: Option<String> = fields.required("chemical");
    let chemical = name.and_then(|name| chemical::find(&name, &fields.at("chemical"), known.chemicals, fields.context));
    let default = ChemotaxisParams::towards(chemical.unwrap_or(ChemicalId(0)));
    let params = ChemotaxisParams {
        chemical: default.chemical,
        saturation: fields.or("saturation", default.saturation),
        threshold: fields.or("threshold", default.threshold),
        noise: fields.or("noise", default.noise),
        interval: fields.or("interval", default.interval),
        turn_rate: degrees(fields, "turn_rate", default.turn_rate),
        persistence: fields.or("persistence", default.persistence),
    };
    chemical.map(|_| Controller::chemotaxis(params))
}

fn run_and_tumble(fields: &mut Fields<'_>, known: &Known<'_>) -> Option<Controller> {
    let default = RunAndTumbleParams::default();
    let name = fields.get::<String>("chemical");
    let find = |name: String| chemical::find(&name, &fields.at("chemical"), known.chemicals, fields.context);
    let chemical = name.and_then(find);
    Some(Controller::run_and_tumble(RunAndTumbleParams {
        run: fields.or("run", default.run),
        tumble: fields.or("tumble", default.tumble),
        turn: pair_of_degrees(fields, "turn", default.turn),
        chemical,
        saturation: fields.or("saturation", default.saturation),
        memory: fields.or("memory", default.memory),
        gain: fields.or("gain", default.gain),
    }))
}

fn brownian(fields: &mut Fields<'_>) -> Controller {
    let default = BrownianParams::default();
    let diffusion = fields.or("diffusion", default.diffusion);
    Controller::brownian(BrownianParams { diffusion, interval: fields.or("interval", default.interval) })
}

fn avoidance(fields: &mut Fields<'_>) -> Controller {
    let default = AvoidanceParams::default();
    Controller::avoidance(AvoidanceParams {
        back: fields.or("back", default.back),
        turn: pair_of_degrees(fields, "turn", default.turn),
        follow: degrees(fields, "follow", default.follow),
        spontaneous: fields.or("spontaneous", default.spontaneous),
        sway: degrees(fields, "sway", default.sway),
        period: fields.or("period", default.period),
    })
}

fn pursue(fields: &mut Fields<'_>, known: &Known<'_>) -> Option<Controller> {
    let default = PursueParams::default();
    let params =
        PursueParams { within: fields.or("within", default.within), largest: fields.or("largest", default.largest) };
    Some(Controller::pursue(params, otherwise(fields, known)))
}

fn flee(fields: &mut Fields<'_>, known: &Known<'_>) -> Option<Controller> {
    let default = FleeParams::default();
    let params = FleeParams { within: fields.or("within", default.within), alarm: fields.or("alarm", default.alarm) };
    Some(Controller::flee(params, otherwise(fields, known)))
}

fn otherwise(fields: &mut Fields<'_>, known: &Known<'_>) -> Controller {
    read_named(fields, "otherwise", known.controllers).unwrap_or_default()
}

/// An angle, which files give in degrees.
fn degrees(fields: &mut Fields<'_>, field: &'static str, default: f32) -> f32 {
    fields.get::<f32>(field).map_or(default, |angle| angle * DEGREE)
}

fn pair_of_degrees(fields: &mut Fields<'_>, field: &'static str, default: [f32; 2]) -> [f32; 2] {
    fields.get::<[f32; 2]>(field).map_or(default, |angles| angles.map(|angle| angle * DEGREE))
}

/// What the numbers of a patrol's points count.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Unit {
    Micrometres,
    Rooms,
}

impl Keyword for Unit {
    const KEYWORDS: &'static [(&'static str, Self)] = &[("units", Self::Micrometres), ("room", Self::Rooms)];
}
