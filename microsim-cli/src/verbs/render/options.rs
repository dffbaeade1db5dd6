//! Values of `render`'s options.

use crate::failure::Failure;
use crate::prepared::Prepared;
use microsim_core::glam::Vec2;
use microsim_core::microscope::{Field, Film, Optics};
use microsim_core::{OrganismId, World};
use std::str::FromStr;

/// Width of the view that follows an organism, in the room's.
const FOLLOWING: f32 = 0.5;

/// `--size`: width and height, pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Size(pub [u32; 2]);

impl Size {
    pub(crate) fn pixels(self) -> u64 {
        self.0.map(u64::from).iter().product()
    }
}

impl FromStr for Size {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let sides = text.split_once('x').and_then(|(width, height)| Some([width.parse().ok()?, height.parse().ok()?]));
        sides.map(Self).ok_or_else(|| "expected WIDTHxHEIGHT in pixels, for example 1280x720".to_owned())
    }
}

/// `--optics`: one or several, `all` for all.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct OpticsList(pub Vec<Optics>);

impl FromStr for OpticsList {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        if text == "all" {
            return Ok(Self(Optics::ALL.to_vec()));
        }
        let one = |name: &str| {
            let names = || Optics::ALL.map(Optics::name).join(", ");
            Optics::named(name).ok_or_else(|| format!("no optics {name:?}, accepted: all, or some of {}", names()))
        };
        text.split(',').map(one).collect::<Result<_, _>>().map(Self)
    }
}

/// `--fps`.
pub(crate) fn frame_rate(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(rate) if (0.001..=1000.0).contains(&rate) => Ok(rate),
        _ => Err("expected frames per second, 0.001 to 1000".to_owned()),
    }
}

/// `--film`.
#[derive(Clone, Copy, Debug, clap::ValueEnum)]
pub(crate) enum FilmStock {
    Cine,
    Digital,
    Photo,
}

impl FilmStock {
    pub(crate) fn film(self) -> Film {
        match self {
            Self::Cine => Film::CINE,
            Self::Digital => Film::DIGITAL,
            Self::Photo => Film::PHOTO,
        }
    }
}

/// `--view`.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum ViewSpec {
    /// As much of the room as fits without showing anything beyond it.
    Room,
    /// A place and a width, micrometres.
    At(Vec2, f32),
    /// An organism by name or by index, and a width.
    Follow(String, Option<f32>),
}

impl FromStr for ViewSpec {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let expected = || "expected X,Y,WIDTH or follow:ID or follow:ID,WIDTH in micrometres".to_owned();
        let number = |text: &str| text.trim().parse::<f32>().map_err(|_| expected());
        if let Some(target) = text.strip_prefix("follow:") {
            let (name, width) = target.split_once(',').map_or((target, None), |(name, width)| (name, Some(width)));
            return Ok(Self::Follow(name.to_owned(), width.map(number).transpose()?));
        }
        let [x, y, width] = text.split(',').map(number).collect::<Result<Vec<_>, _>>()?[..] else {
            return Err(expected());
        };
        Ok(Self::At(Vec2::new(x, y), width))
    }
}

impl ViewSpec {
    /// The field of view in a world.
    pub(crate) fn field(&self, world: &World, prepared: &Prepared, size: Size) -> Result<Field, Failure> {
        let Size(pixels) = size;
        let room = world.config().size;
        let aspect = pixels[0].max(1) as f32 / pixels[1].max(1) as f32;
        let whole = room.x.min(room.y * aspect);
        let (centre, width) = match self {
            Self::Room => (room * 0.5, whole),
            Self::At(centre, width) => (*centre, *width),
            Self::Follow(name, width) => {
                let centre = find(name, world, prepared)?;
                (centre, width.unwrap_or(FOLLOWING * whole))
            }
        };
        let field = Field { centre, width, pixels };
        field.validate().map_err(|error| Failure::Message(format!("--view or --size: {error}")))?;
        Ok(field)
    }
}

/// Where an organism is, by its name in the scenario, by `player`, or by its index.
fn find(name: &str, world: &World, prepared: &Prepared) -> Result<Vec2, Failure> {
    let built = &prepared.built;
    let named = || built.named.iter().find(|(other, _)| other == name).map(|(_, id)| *id);
    let player = || built.player.filter(|_| name == "player");
    let index = || name.parse().ok().and_then(|index: u32| world.organisms().find(|id| id.index() == index));
    let id: Option<OrganismId> = named().or_else(player).or_else(index);
    id.and_then(|id| world.centroid(id)).ok_or_else(|| {
        let names: Vec<&str> = built.named.iter().map(|(name, _)| name.as_str()).collect();
        let accepted = format!("the index of an organism that lives, or a name ({})", names.join(", "));
        Failure::Message(format!("--view follow:{name}: nothing to follow, accepted: {accepted}"))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_views_and_optics_are_read_and_refused() {
        assert_eq!("64x48".parse(), Ok(Size([64, 48])));
        assert!(["64", "x", "-1x2", "1x2x3", ""].iter().all(|text| text.parse::<Size>().is_err()));
        assert_eq!("1,2.5,40".parse(), Ok(ViewSpec::At(Vec2::new(1.0, 2.5), 40.0)));
        assert_eq!("follow:player".parse(), Ok(ViewSpec::Follow("player".into(), None)));
        assert_eq!("follow:3,20".parse(), Ok(ViewSpec::Follow("3".into(), Some(20.0))));
        assert!(["", "1,2", "1,2,3,4", "a,b,c", "follow:x,y"].iter().all(|text| text.parse::<ViewSpec>().is_err()));
        assert_eq!("dic,stained".parse(), Ok(OpticsList(vec![Optics::DIC, Optics::STAINED])));
        assert!("dic,x-ray".parse::<OpticsList>().unwrap_err().contains("dark-field"));
        assert_eq!("all".parse::<OpticsList>().unwrap().0.len(), 8);
    }
}
