//! The first field in which two worlds differ, in words.

use crate::float_environment::with_default_float_environment;
use crate::particle::NO_OWNER;
use crate::value_walk::{Leaf, PathSegment, Visitor, walk};
use crate::world::World;
use std::fmt;

/// A field in which two worlds differ: the first, in the order in which the digest takes them.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Difference {
    /// What it is a field of, for example `particle 17 (organism 3, amoeboid_cell)`; empty for the world's own.
    pub of: String,
    /// The field.
    pub field: String,
    /// Its value in the first world and in the second one.
    pub values: [String; 2],
}

impl fmt::Display for Difference {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { of, field, values: [one, other] } = self;
        let space = if of.is_empty() { "" } else { " " };
        write!(f, "{of}{space}{field}: {one} against {other}")
    }
}

impl World {
    /// The first field in which this world differs from another one; `None` if they are equal to the bit, but for the sign
    /// of zeros and the kind of NaN.
    #[must_use]
    pub fn first_difference(&self, other: &Self) -> Option<Difference> {
        let mut listed = Leaves::default();
        walk(self, &mut listed);
        let mut compared = Comparison { known: listed.0.into_iter(), path: Vec::new(), found: None };
        with_default_float_environment(|| walk(other, &mut compared));
        let (path, values) = compared.found?;
        let (of, field) = self.describe(&path);
        Some(Difference { of, field, values })
    }

    /// What a field is of, and its name there.
    fn describe(&self, path: &[PathSegment]) -> (String, String) {
        match path {
            [PathSegment::Field("particles"), PathSegment::Field(column), PathSegment::Element(i), rest @ ..] => {
                let owner = self.particles.owner.get(*i).copied().filter(|&owner| owner != NO_OWNER);
                let owner = owner.map_or("nobody's".to_owned(), |owner| self.describe_organism(owner));
                (format!("particle {i} ({owner})"), format!("{column}{}", dotted(rest)))
            }
            [
                PathSegment::Field("organisms"),
                PathSegment::Field("slots"),
                PathSegment::Element(i),
                PathSegment::Field(field),
                rest @ ..,
            ] => {
                let field = if *field == "value" { dotted(rest) } else { format!("{field}{}", dotted(rest)) };
                let field = if field.is_empty() { "existence".to_owned() } else { field };
                (self.describe_organism(*i as u32), field.trim_start_matches('.').to_owned())
            }
            _ => (String::new(), dotted(path).trim_start_matches('.').to_owned()),
        }
    }

    fn describe_organism(&self, index: u32) -> String {
        let kind = self.organisms.id_at(index).and_then(|id| self.kind(id));
        kind.map_or_else(|| format!("organism {index}"), |kind| format!("organism {index}, {}", kind.name()))
    }
}

fn dotted(path: &[PathSegment]) -> String {
    let part = |part: &PathSegment| match part {
        PathSegment::Field(name) => format!(".{name}"),
        PathSegment::Element(index) => format!("[{index}]"),
    };
    path.iter().map(part).collect()
}

/// All leaves.
#[derive(Default)]
struct Leaves(Vec<OwnedLeaf>);

/// A leaf that is kept.
#[derive(Clone, Debug, PartialEq)]
enum OwnedLeaf {
    Integer(u64),
    Single(f32),
    Double(f64),
    Text(String),
    Variant(&'static str),
    Count(usize),
}

impl OwnedLeaf {
    fn of(leaf: Leaf<'_>) -> Self {
        match leaf {
            Leaf::Word(value) => Self::Integer(value.into()),
            Leaf::Long(value) => Self::Integer(value),
            Leaf::Single(value) => Self::Single(value),
            Leaf::Double(value) => Self::Double(value),
            Leaf::Text(text) => Self::Text(text.to_owned()),
            Leaf::Variant(_, name) => Self::Variant(name),
            Leaf::Count(count) => Self::Count(count),
        }
    }

    /// Equal for the digest: one NaN is like another.
    fn same_for_digest(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Single(a), Self::Single(b)) => a == b || (a.is_nan() && b.is_nan()),
            (Self::Double(a), Self::Double(b)) => a == b || (a.is_nan() && b.is_nan()),
            _ => self == other,
        }
    }
}

impl fmt::Display for OwnedLeaf {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Integer(value) => write!(f, "{value}"),
            Self::Single(value) => write!(f, "{value}"),
            Self::Double(value) => write!(f, "{value}"),
            Self::Text(text) => write!(f, "{text:?}"),
            Self::Variant(name) => write!(f, "{name}"),
            Self::Count(count) => write!(f, "{count} entries"),
        }
    }
}

impl Visitor for Leaves {
    fn leaf(&mut self, leaf: Leaf<'_>) {
        self.0.push(OwnedLeaf::of(leaf));
    }
}

/// Compares leaves with those of another walk, up to the first that differs.
struct Comparison {
    known: std::vec::IntoIter<OwnedLeaf>,
    path: Vec<PathSegment>,
    found: Option<(Vec<PathSegment>, [String; 2])>,
}

impl Visitor for Comparison {
    fn enter(&mut self, part: PathSegment) {
        self.path.push(part);
    }

    fn leave(&mut self) {
        self.path.pop();
    }

    fn leaf(&mut self, leaf: Leaf<'_>) {
        if self.found.is_some() {
            return;
        }
        let (known, now) = (self.known.next(), OwnedLeaf::of(leaf));
        if !known.as_ref().is_some_and(|known| known.same_for_digest(&now)) {
            let known = known.map_or("nothing".to_owned(), |known| known.to_string());
            self.found = Some((self.path.clone(), [known, now.to_string()]));
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::{CoccusSpec, Controller, Inputs, Placement, World, WorldConfig};

    fn world() -> World {
        let mut world = World::new(WorldConfig::default()).unwrap();
        for x in [20.0, 40.0] {
            let at = Placement::at(x, 20.0).steered_by(Controller::wander([0.1, 0.2], 0.0));
            world.spawn(&CoccusSpec::default().into(), at).unwrap();
        }
        world
    }

    fn difference(change: impl FnOnce(&mut World)) -> String {
        let (one, mut other) = (world(), world());
        assert_eq!(one.first_difference(&other), None);
        change(&mut other);
        one.first_difference(&other).unwrap().to_string()
    }

    #[test]
    fn the_first_field_is_named_with_what_it_is_of() {
        let x = difference(|world| world.particles.vx[1] = 0.5);
        assert_eq!(x, "particle 1 (organism 1, coccus) vx: 0 against 0.5");
        let y = difference(|world| world.particles.y[5] = 2.0);
        assert_eq!(y, "particle 5 (nobody's) y: 0 against 2");
        let rng = difference(|world| {
            let id = world.organisms().next().unwrap();
            world.organisms.get_mut(id).unwrap().rng.state = 5;
        });
        assert!(rng.starts_with("organism 0, coccus rng.state: ") && rng.ends_with(" against 5"), "{rng}");
        assert_eq!(difference(|world| world.step(&Inputs::new())), "step_index: 0 against 1");
        let gone = difference(|world| {
            let id = world.organisms().next().unwrap();
            world.remove(id).unwrap();
        });
        assert!(gone.starts_with("particle 0 (organism 0, coccus) "), "{gone}");
        assert!(difference(|world| world.particles.x[0] = f32::NAN).ends_with("against NaN"));
    }

    #[test]
    fn zeros_and_nans_are_alike() {
        let (mut one, mut other) = (world(), world());
        (one.particles.vx[0], other.particles.vx[0]) = (0.0, -0.0);
        (one.particles.vy[0], other.particles.vy[0]) = (f32::NAN, -f32::NAN);
        assert_eq!(one.first_difference(&other), None);
        assert_eq!(one.digest(), other.digest());
    }
}
