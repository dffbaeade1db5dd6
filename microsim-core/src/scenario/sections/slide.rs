//! Slides: the table `[slide]`, what a front-end needs to make a short level of a scenario.

use super::game::PREY;
use super::group::{self, Group};
use super::spawn;
use crate::kind::Kind;
use crate::scenario::reader::Fields;
use glam::Vec2;

/// Times that make sense, s.
const TIME: [f32; 2] = [1.0, 3600.0];
/// Most prey that a goal asks for.
const MOST: f32 = 1000.0;
/// Most words of a fact.
const FACT_WORDS: usize = 40;
/// Name of the cell of a second player.
const SECOND: &str = "player-2";

/// A short level: the player reaches all goals within a time. The sooner, the more stars.
#[derive(Clone, Debug, PartialEq)]
pub struct Slide {
    /// Its title.
    pub title: String,
    /// What the player has to do, in one sentence.
    pub task: String,
    /// A fact of biology or optics that it shows, in at most forty words.
    pub fact: String,
    /// Where the fact stands: author, year, title.
    pub source: String,
    /// Time after which it is lost, s.
    pub time: f32,
    /// Longest times that earn three stars and two, s.
    pub stars: [f32; 2],
    /// What has to be done, in any order.
    pub goals: Vec<Goal>,
}

/// One thing that the players of a slide have to do.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Goal {
    /// That one of them is in a box with its centre once.
    Reach {
        /// Lower left corner of the box.
        low: Vec2,
        /// Upper right corner.
        high: Vec2,
    },
    /// That two of them are in two boxes at the same time, one in each.
    Together {
        /// Lower left and upper right corner of both, which do not overlap.
        places: [[Vec2; 2]; 2],
    },
    /// That all of them together digest prey.
    Digest {
        /// Kind of the prey.
        kind: Kind,
        /// How many of it.
        count: u32,
    },
}

/// Reads the table, if the file has it, for a room of this size.
pub(crate) fn read(root: &mut Fields<'_>, groups: &[Group], size: Vec2) -> Option<Slide> {
    let (is_slide, is_game) = (root.has("slide"), root.has("game"));
    let mut fields = root.table("slide");
    let slide = read_slide(&mut fields, is_slide || root.context.notes.is_some(), groups, size);
    fields.finish();
    if is_slide {
        group::require_player(root, "slide", groups);
    }
    if is_slide && is_game {
        root.refuse("slide", "does not go with [game]", "one of the two");
    }
    slide.filter(|_| is_slide)
}

fn read_slide(fields: &mut Fields<'_>, is_there: bool, groups: &[Group], size: Vec2) -> Option<Slide> {
    if !is_there {
        return None;
    }
    let title = read_text(fields, "title", 30);
    let task = read_text(fields, "task", 120);
    let fact = read_text(fields, "fact", 400);
    check_fact(fields, &fact);
    let source = read_text(fields, "source", 200);
    let time = fields.required("time").filter(|&time| fields.is_within("time", time, TIME)).unwrap_or(TIME[1]);
    let stars = read_stars(fields, time);
    let goals = fields.list("goal");
    if goals.is_empty() {
        fields.refuse("goal", "nothing to do", "[[slide.goal]] tables");
    }
    let goals = goals.into_iter().filter_map(|goal| read_goal(goal, groups, size)).collect();
    Some(Slide { title, task, fact, source, time, stars, goals })
}

fn read_text(fields: &mut Fields<'_>, field: &'static str, most: usize) -> String {
    let text: Option<String> = fields.required(field);
    let count = text.as_ref().map_or(1, |text| text.trim().chars().count());
    if !(1..=most).contains(&count) {
        fields.refuse(field, format!("{count} characters"), format!("1 to {most} characters"));
    }
    text.unwrap_or_default()
}

fn check_fact(fields: &Fields<'_>, fact: &str) {
    let words = fact.split_whitespace().count();
    if words > FACT_WORDS {
        fields.refuse("fact", format!("{words} words"), format!("at most {FACT_WORDS} words"));
    }
}

/// Times for three stars and two: in order, and before time is up.
fn read_stars(fields: &mut Fields<'_>, time: f32) -> [f32; 2] {
    let stars = fields.required("stars").unwrap_or([TIME[0]; 2]);
    let [three, two] = stars;
    if !(TIME[0] <= three && three <= two && two <= time) {
        let accepted = format!("[time for 3 stars, time for 2], in order, from {} to `time`", TIME[0]);
        fields.refuse("stars", format!("{three} and {two} are out of range or order"), accepted);
    }
    stars
}

fn read_goal(mut fields: Fields<'_>, groups: &[Group], size: Vec2) -> Option<Goal> {
    let reach: Option<[Vec2; 2]> = fields.get("reach");
    let together: Option<[[Vec2; 2]; 2]> = fields.get("together");
    let digested: Option<String> = fields.get("digested");
    let count = fields.or("count", 1_u32);
    fields.is_within("count", count as f32, [1.0, MOST]);
    let is_one = check_sort(&fields);
    let goal = match (reach, together, digested) {
        (Some([low, high]), ..) => {
            spawn::is_box_in("reach", &[low, high], size, &fields);
            Some(Goal::Reach { low, high })
        }
        (_, Some(places), _) => {
            check_places(&fields, &places, groups, size);
            Some(Goal::Together { places })
        }
        (.., Some(name)) => {
            let kind = read_prey(&fields, &name).inspect(|&kind| check_supply(&fields, groups, kind, count));
            kind.map(|kind| Goal::Digest { kind, count })
        }
        _ => None,
    };
    fields.finish();
    goal.filter(|_| is_one)
}

/// Whether a goal is of one sort; reports it if it is not.
fn check_sort(fields: &Fields<'_>) -> bool {
    let given: Vec<&str> = ["reach", "together", "digested"].into_iter().filter(|sort| fields.has(sort)).collect();
    match given[..] {
        [] => fields.context.refuse(&fields.path, "nothing to do", "`reach`, `together` or `digested`"),
        [sort] if sort != "digested" && fields.has("count") => {
            fields.refuse("count", format!("does not go with `{sort}`"), "`digested` and `count`");
        }
        [sort, other, ..] => fields.refuse(other, format!("does not go with `{sort}`"), "one of them"),
        [_] => {}
    }
    given.len() == 1
}

/// Refuses boxes that one cell could be in alone, or that nobody else could be in.
fn check_places(fields: &Fields<'_>, places: &[[Vec2; 2]; 2], groups: &[Group], size: Vec2) {
    for (field, place) in ["together.0", "together.1"].into_iter().zip(places) {
        spawn::is_box_in(field, place, size, fields);
    }
    let [[low, high], [other_low, other_high]] = places;
    if low.cmplt(*other_high).all() && other_low.cmplt(*high).all() {
        fields.refuse("together.1", "overlaps the other box", "two boxes apart from each other");
    }
    let is_second = |group: &Group| group.name.as_deref() == Some(SECOND) && group.prototype.can_grow();
    if !groups.iter().any(is_second) {
        fields.refuse("together", "one plays alone", format!("a [[spawn]] of an amoeboid_cell named `{SECOND}`"));
    }
}

/// Refuses a goal for which there is not enough prey.
fn check_supply(fields: &Fields<'_>, groups: &[Group], kind: Kind, count: u32) {
    let of_kind = || groups.iter().filter(|group| group.prototype.kind() == kind);
    let all: u64 = of_kind().map(|group| u64::from(group.positions.count())).sum();
    let comes_again = of_kind().any(|group| group.respawn.is_some());
    if all == 0 || (all < u64::from(count) && !comes_again) {
        fields.refuse(
            "digested",
            format!("{count} wanted, {all} spawned"),
            "as many as are spawned, or respawned prey",
        );
    }
}

fn read_prey(fields: &Fields<'_>, name: &str) -> Option<Kind> {
    let known = PREY.iter().find(|(known, _)| *known == name);
    if known.is_none() {
        fields.refuse_unknown("digested", "prey", name, PREY.map(|(known, _)| known));
    }
    known.map(|(_, kind)| *kind)
}
