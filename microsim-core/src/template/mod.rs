//! Templates: the recipe of a body, validated once and shared by all its instances.
//!
//! Instances of one template have the same topology, which is what lets eight of them be solved side by side. They may
//! differ in place, direction and size.

mod cut;
mod order;
pub(crate) mod projection;
mod role;
mod self_contact;

use crate::error::{Error, in_range};
use crate::float_environment::with_default_float_environment;
use crate::particle::{CollisionGroups, Material};
use crate::solver::constraint::{Constraint, Distance, YieldingDistance, check_ring};
use crate::solver::muscle::{Muscle, Scaled};
pub use cut::Half;
use cut::{Abilities, check_name};
use glam::Vec2;
use order::{in_order, scaled};
pub use role::Role;
use serde::{Deserialize, Serialize};

/// Most bytes of a name.
const LONGEST_NAME: usize = 100;

/// One particle of a template, in the template's own frame.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Node {
    /// Position relative to the instance's place, units, components within ±10 000.
    pub position: Vec2,
    /// Mass, 0.000 001 to 1 000 000, or infinite for what nothing moves.
    pub mass: f32,
    /// Radius, units, 0 to 1000.
    pub radius: f32,
    /// What it collides with; with nodes of its own instance only after [`TemplateBuilder::self_contacts`].
    pub groups: CollisionGroups,
    /// Its surface.
    pub material: Material,
    /// What it is to its organism.
    pub role: Role,
}

impl Node {
    /// A disc of this mass and radius that collides with everything.
    #[must_use]
    pub fn disc(position: Vec2, mass: f32, radius: f32) -> Self {
        let (groups, material) = (CollisionGroups::ALL, Material::default());
        Self { position, mass, radius, groups, material, role: Role::Plain }
    }

    /// A point that nothing moves or touches.
    #[must_use]
    pub fn fixed(position: Vec2) -> Self {
        Self { groups: CollisionGroups::NONE, role: Role::Anchor, ..Self::disc(position, f32::INFINITY, 0.0) }
    }

    fn validate(&self) -> Result<(), Error> {
        in_range("position.x", self.position.x, -1e4, 1e4)?;
        in_range("position.y", self.position.y, -1e4, 1e4)?;
        if self.mass != f32::INFINITY {
            in_range("mass", self.mass, 1e-6, 1e6)?;
        }
        in_range("radius", self.radius, 0.0, 1000.0)?;
        in_range("material.friction", self.material.friction, 0.0, 10.0)?;
        in_range("material.restitution", self.material.restitution, 0.0, 1.0)
    }
}

/// How a body moves towards a goal, when an intent or a controller gives it one: its nodes are accelerated towards a velocity.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Propulsion {
    /// Speed, units/s, 0 to 1000.
    pub speed: f32,
    /// Largest acceleration, units/s2, 0 to 1 000 000.
    pub max_acceleration: f32,
}

/// A validated recipe of a body.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "TemplateBuilder")]
pub struct Template {
    name: String,
    nodes: Vec<Node>,
    constraints: Vec<Constraint>,
    outline: Vec<u32>,
    abilities: Abilities,
    channels: Vec<[f32; 2]>,
    /// By constraint.
    muscles: Vec<Muscle>,
    /// Those whose lengths are scaled: muscles and yielding links.
    #[serde(skip)]
    scaled: Vec<Scaled>,
}

impl Template {
    /// An empty recipe to add to.
    #[must_use]
    pub fn builder() -> TemplateBuilder {
        TemplateBuilder::default()
    }

    /// Its name; empty if it has none.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Its particles; a node's index here is its slot.
    #[must_use]
    pub fn nodes(&self) -> &[Node] {
        &self.nodes
    }

    /// Its constraints, over slots, in the order in which they are projected.
    #[must_use]
    pub fn constraints(&self) -> &[Constraint] {
        &self.constraints
    }

    /// Slots of its outline, counter-clockwise; empty if it has none.
    #[must_use]
    pub fn outline(&self) -> &[u32] {
        &self.outline
    }

    /// How it moves towards a goal; `None` if it cannot.
    #[must_use]
    pub fn propulsion(&self) -> Option<Propulsion> {
        self.abilities.propulsion()
    }

    /// The halves into which it divides; `None` if it cannot.
    #[must_use]
    pub fn cut(&self) -> Option<&[Half; 2]> {
        self.abilities.cut()
    }

    /// Its channels: the factors on the lengths of their muscles at rest and at full activation.
    #[must_use]
    pub fn channels(&self) -> &[[f32; 2]] {
        &self.channels
    }

    /// Its muscles and yielding links, in the order of its constraints.
    pub(crate) fn scaled(&self) -> &[Scaled] {
        &self.scaled
    }

    /// The yielding links among them.
    pub(crate) fn yielding_links(&self) -> impl Iterator<Item = (&YieldingDistance, &Scaled)> {
        self.scaled.iter().filter_map(|scaled| match &self.constraints[scaled.constraint as usize] {
            Constraint::YieldingDistance(link) => Some((link, scaled)),
            _ => None,
        })
    }

    /// Whether there are any.
    pub(crate) fn yields(&self) -> bool {
        self.scaled.iter().any(|scaled| scaled.link.is_some())
    }

    /// Length state of a body that has just been spawned, see [`crate::solver::block::Block`].
    pub(crate) fn rest_state(&self) -> Vec<f32> {
        let links = self.yielding_links().map(|_| 0.0);
        self.channels.iter().map(|&[rest, _]| rest).chain(links).collect()
    }

    /// Farthest that a disc of it reaches from its place.
    #[must_use]
    pub fn extent(&self) -> f32 {
        self.nodes.iter().fold(0.0, |far, node| {
            let reach = node.position.length() + node.radius;
            if reach > far { reach } else { far }
        })
    }
}

impl TryFrom<TemplateBuilder> for Template {
    type Error = Error;

    fn try_from(builder: TemplateBuilder) -> Result<Self, Error> {
        builder.build()
    }
}

/// Collects nodes and constraints; [`TemplateBuilder::build`] checks them.
///
/// ```
/// use microsim_core::{Distance, Node, Template, glam::Vec2};
///
/// let mut builder = Template::builder();
/// let a = builder.node(Node::disc(Vec2::ZERO, 1.0, 0.5));
/// let b = builder.node(Node::disc(Vec2::X, 1.0, 0.5));
/// builder.link(a, b, 0.0);
/// let dumbbell = builder.build()?;
/// let rigid = Distance { a, b, rest_length: 1.0, compliance: 0.0, damping: 0.0 };
/// assert_eq!(dumbbell.constraints(), [rigid.into()]);
/// # Ok::<(), microsim_core::Error>(())
/// ```
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct TemplateBuilder {
    name: String,
    nodes: Vec<Node>,
    constraints: Vec<Constraint>,
    outline: Vec<u32>,
    abilities: Abilities,
    channels: Vec<[f32; 2]>,
    muscles: Vec<Muscle>,
}

impl TemplateBuilder {
    /// Names it: at most 100 bytes, without control characters. Templates of different names are different ones, whatever else
    /// they have in common.
    ///
    /// ```
    /// use microsim_core::{Kind, Node, Placement, Template, World, WorldConfig, glam::Vec2};
    ///
    /// let mut world = World::new(WorldConfig::default())?;
    /// let mut builder = Template::builder();
    /// builder.name("crumb").node(Node::disc(Vec2::ZERO, 1.0, 0.5));
    /// let crumb = world.add_template(builder.build()?);
    /// let one = world.spawn_template(crumb, Placement::at(50.0, 50.0))?;
    /// assert_eq!((world.kind(one), world.template_named("crumb")), (Some(Kind::Custom(crumb)), Some(crumb)));
    /// assert_eq!(world.view().organism(one).unwrap().template_name(), Some("crumb"));
    /// # Ok::<(), microsim_core::Error>(())
    /// ```
    pub fn name(&mut self, name: impl Into<String>) -> &mut Self {
        self.name = name.into();
        self
    }

    /// Adds a particle and returns its slot.
    pub fn node(&mut self, node: Node) -> u32 {
        self.nodes.push(node);
        self.nodes.len() as u32 - 1
    }

    /// Links two slots at their present distance, with this compliance and no damping.
    pub fn link(&mut self, a: u32, b: u32, compliance: f32) -> &mut Self {
        self.spring(a, b, compliance, 0.0)
    }

    /// Links two slots at their present distance, with this compliance and damping time.
    pub fn spring(&mut self, a: u32, b: u32, compliance: f32, damping: f32) -> &mut Self {
        let rest_length = match (self.nodes.get(a as usize), self.nodes.get(b as usize)) {
            (Some(a), Some(b)) => with_default_float_environment(|| (b.position - a.position).length()),
            _ => 0.0,
        };
        self.constraint(Distance { a, b, rest_length, compliance, damping })
    }

    /// Links the slots of a ring each to the next, at their present distances. Even links come before odd ones: links
    /// that share no node follow each other, so the processor can overlap them.
    pub fn ring(&mut self, ring: &[u32], compliance: f32) -> &mut Self {
        for parity in 0..2 {
            for k in (parity..ring.len()).step_by(2) {
                self.link(ring[k], ring[(k + 1) % ring.len()], compliance);
            }
        }
        self
    }

    /// Adds a constraint of any kind. Kinds are projected in a fixed order, those of one kind as they were added.
    pub fn constraint(&mut self, constraint: impl Into<Constraint>) -> &mut Self {
        self.constraints.push(constraint.into());
        self
    }

    /// Declares a channel and returns its number. Its muscles have `scale[0]` times their lengths at rest and `scale[1]` times at
    /// full activation ([`crate::Inputs::activate`]), 0.1 to 10 each, and areas are scaled by its square.
    ///
    /// ```
    /// use microsim_core::{Distance, Inputs, Node, Placement, Template, World, WorldConfig, glam::Vec2};
    ///
    /// let mut builder = Template::builder();
    /// let [a, b] = [0.0, 4.0].map(|x| builder.node(Node::disc(Vec2::new(x, 0.0), 1.0, 0.5)));
    /// let channel = builder.channel([1.0, 0.5]);
    /// builder.muscle(channel, Distance { a, b, rest_length: 4.0, compliance: 0.0, damping: 0.0 });
    /// let mut world = World::new(WorldConfig::default())?;
    /// let fibre = world.add_template(builder.build()?);
    /// let fibre = world.spawn_template(fibre, Placement::at(50.0, 50.0))?;
    /// let mut inputs = Inputs::new();
    /// inputs.activate(fibre, channel, 0.5)?;
    /// (0..60).for_each(|_| world.step(&inputs));
    /// let ends: Vec<Vec2> = world.view().organism(fibre).unwrap().particles().map(|node| node.position).collect();
    /// assert!((ends[0].distance(ends[1]) - 3.0).abs() < 0.01);
    /// # Ok::<(), microsim_core::Error>(())
    /// ```
    pub fn channel(&mut self, scale: [f32; 2]) -> u32 {
        self.channels.push(scale);
        self.channels.len() as u32 - 1
    }

    /// Adds a constraint of any kind that has lengths or an area as a muscle of a channel.
    pub fn muscle(&mut self, channel: u32, constraint: impl Into<Constraint>) -> &mut Self {
        self.muscles.push(Muscle { constraint: self.constraints.len() as u32, channel });
        self.constraint(constraint)
    }

    /// Declares the outline: slots, counter-clockwise.
    pub fn outline(&mut self, outline: &[u32]) -> &mut Self {
        self.outline = outline.to_vec();
        self
    }

    /// Lets it move towards the goal of an intent or a controller. Without it, it goes nowhere by itself.
    pub fn propulsion(&mut self, propulsion: Propulsion) -> &mut Self {
        self.abilities = Abilities::new(Some(propulsion), self.abilities.cut().cloned().map(Box::new));
        self
    }

    /// Checks everything and returns the template.
    ///
    /// # Errors
    /// Names the node or constraint that is out of range or refers to a slot that does not exist.
    pub fn build(self) -> Result<Template, Error> {
        with_default_float_environment(|| self.check())
    }

    fn check(self) -> Result<Template, Error> {
        let Self { name, nodes, constraints, outline, abilities, channels, muscles } = self;
        check_name("name", &name)?;
        if nodes.is_empty() || nodes.len() > 10_000 {
            return Err(Error::reference("nodes", "1 to 10000 nodes"));
        }
        for (k, node) in nodes.iter().enumerate() {
            node.validate().map_err(|error| error.within(&format!("nodes[{k}]")))?;
        }
        for (k, constraint) in constraints.iter().enumerate() {
            constraint.validate(nodes.len()).map_err(|error| error.within(&format!("constraints[{k}]")))?;
        }
        for (k, scale) in channels.iter().enumerate() {
            in_range("rest", scale[0], 0.1, 10.0).map_err(|error| error.within(&format!("channels[{k}]")))?;
            in_range("active", scale[1], 0.1, 10.0).map_err(|error| error.within(&format!("channels[{k}]")))?;
        }
        check_muscles(&muscles, &constraints, channels.len())?;
        let (constraints, muscles) = in_order(constraints, &muscles);
        if !outline.is_empty() {
            check_ring("outline", &outline, nodes.len())?;
        }
        abilities.check(&nodes)?;
        let scaled = scaled(&constraints, &muscles, channels.len() as u32);
        Ok(Template { name, nodes, constraints, outline, abilities, channels, muscles, scaled })
    }
}

/// Checks that muscles name different constraints, ascending, that have lengths, and channels that exist.
fn check_muscles(muscles: &[Muscle], constraints: &[Constraint], channels: usize) -> Result<(), Error> {
    let has_lengths =
        |muscle: &Muscle| constraints.get(muscle.constraint as usize).is_some_and(Constraint::has_lengths);
    let is_known = |muscle: &Muscle| has_lengths(muscle) && (muscle.channel as usize) < channels;
    let is_ascending = muscles.is_sorted_by(|a, b| a.constraint < b.constraint);
    if is_ascending && muscles.iter().all(is_known) {
        return Ok(());
    }
    Err(Error::reference(
        "muscles",
        format!(
            "one of the {channels} channels for each of the constraints that are muscles, and those with lengths only"
        ),
    ))
}

#[cfg(test)]
mod tests;
