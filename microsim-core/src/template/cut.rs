//! What a body can do: to follow a goal, and to divide by a cut that its template declares.

use super::{LONGEST_NAME, Node, Propulsion, TemplateBuilder};
use crate::error::{Error, in_range};
use serde::{Deserialize, Serialize};

/// One half of a body that divides, see [`TemplateBuilder::cut`].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Half {
    /// Slots of the whole body that become this half.
    pub slots: Vec<u32>,
    /// Name of the template that it goes on with ([`TemplateBuilder::name`]), at most 100 bytes; empty: that of the whole body.
    pub template: String,
    /// Size of that template relative to the present size of the whole body, 0.1 to 10.
    pub scale: f32,
}

impl Half {
    /// One that goes on with the template of the whole body, in its size.
    #[must_use]
    pub fn of(slots: impl IntoIterator<Item = u32>) -> Self {
        Self { slots: slots.into_iter().collect(), template: String::new(), scale: 1.0 }
    }

    /// The same with the template of this name.
    #[must_use]
    pub fn named(mut self, template: impl Into<String>) -> Self {
        self.template = template.into();
        self
    }

    /// The same in another size.
    #[must_use]
    pub fn scaled(mut self, scale: f32) -> Self {
        self.scale = scale;
        self
    }
}

impl TemplateBuilder {
    /// Lets it divide ([`crate::World::divide`]): its slots become two halves, each of which goes on with a template.
    ///
    /// Where that template has as many nodes as the half has slots, its nodes take over places, velocities and masses of the
    /// slots, in their order. Otherwise the half gets the form that its template has at rest, with the mass, centre of mass,
    /// velocity, direction and angular momentum of its slots. Momentum is conserved either way; lengths are those of the template.
    ///
    /// ```
    /// use microsim_core::{Event, Half, Inputs, Node, Placement, Template, World, WorldConfig, glam::Vec2};
    ///
    /// let rod = |count: u8, name: &str| {
    ///     let mut builder = Template::builder();
    ///     let at = |k: u8| Vec2::new(0.6 * (f32::from(k) - 0.5 * f32::from(count - 1)), 0.0);
    ///     let discs: Vec<u32> = (0..count).map(|k| builder.node(Node::disc(at(k), 0.1, 0.5))).collect();
    ///     discs.windows(2).for_each(|pair| _ = builder.link(pair[0], pair[1], 0.0));
    ///     builder.name(name);
    ///     builder
    /// };
    /// let mut long = rod(8, "long");
    /// long.cut([Half::of(0..4).named("short"), Half::of(4..8).named("short")]);
    /// let mut world = World::new(WorldConfig::default())?;
    /// let [long, short] = [long.build()?, rod(4, "short").build()?].map(|template| world.add_template(template));
    /// let parent = world.spawn_template(long, Placement::at(50.0, 50.0))?;
    /// world.divide(parent)?;
    /// world.step(&Inputs::new());
    /// let Event::Divided { daughter, .. } = world.events()[0] else { panic!("{:?}", world.events()) };
    /// let templates = [parent, daughter].map(|id| world.view().organism(id).unwrap().template());
    /// assert_eq!(templates, [Some(short); 2]);
    /// # Ok::<(), microsim_core::Error>(())
    /// ```
    pub fn cut(&mut self, halves: [Half; 2]) -> &mut Self {
        self.abilities = Abilities::new(self.abilities.propulsion(), Some(Box::new(halves)));
        self
    }
}

/// What a body can do besides holding together. Variants are in the order in which they came: a template without the later ones
/// has the digest and the bytes that it had before.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(super) enum Abilities {
    #[default]
    None,
    Follow(Propulsion),
    Divide(Box<[Half; 2]>),
    FollowAndDivide(Propulsion, Box<[Half; 2]>),
}

impl Abilities {
    pub(super) fn new(propulsion: Option<Propulsion>, cut: Option<Box<[Half; 2]>>) -> Self {
        match (propulsion, cut) {
            (None, None) => Self::None,
            (Some(propulsion), None) => Self::Follow(propulsion),
            (None, Some(cut)) => Self::Divide(cut),
            (Some(propulsion), Some(cut)) => Self::FollowAndDivide(propulsion, cut),
        }
    }

    pub(super) fn propulsion(&self) -> Option<Propulsion> {
        match self {
            Self::None | Self::Divide(_) => None,
            Self::Follow(propulsion) | Self::FollowAndDivide(propulsion, _) => Some(*propulsion),
        }
    }

    pub(super) fn cut(&self) -> Option<&[Half; 2]> {
        match self {
            Self::None | Self::Follow(_) => None,
            Self::Divide(cut) | Self::FollowAndDivide(_, cut) => Some(cut),
        }
    }

    pub(super) fn check(&self, nodes: &[Node]) -> Result<(), Error> {
        if let Some(Propulsion { speed, max_acceleration }) = self.propulsion() {
            in_range("propulsion.speed", speed, 0.0, 1000.0)?;
            in_range("propulsion.max_acceleration", max_acceleration, 0.0, 1e6)?;
        }
        self.cut().map_or(Ok(()), |cut| check_cut(cut, nodes))
    }
}

/// Checks that halves have each slot once, and that all of it can move.
fn check_cut(halves: &[Half; 2], nodes: &[Node]) -> Result<(), Error> {
    for (k, half) in halves.iter().enumerate() {
        check_name("template", &half.template).map_err(|error| error.within(&format!("cut[{k}]")))?;
        in_range("scale", half.scale, 0.1, 10.0).map_err(|error| error.within(&format!("cut[{k}]")))?;
    }
    let mut slots: Vec<u32> = halves.iter().flat_map(|half| &half.slots).copied().collect();
    slots.sort_unstable();
    let is_whole = slots.iter().copied().eq(0..nodes.len() as u32);
    if !is_whole || halves.iter().any(|half| half.slots.is_empty()) {
        let accepted = format!("each of the slots below {} in one of two halves, none of which is empty", nodes.len());
        return Err(Error::reference("cut", accepted));
    }
    let can_move = nodes.iter().all(|node| node.mass.is_finite());
    can_move.then_some(()).ok_or_else(|| Error::unsupported("cut", "a body of nodes that can move"))
}

pub(super) fn check_name(field: &str, name: &str) -> Result<(), Error> {
    let is_accepted = name.len() <= LONGEST_NAME && !name.contains(char::is_control);
    let accepted = || Error::unsupported(field, "at most 100 bytes, without control characters");
    is_accepted.then_some(()).ok_or_else(accepted)
}
