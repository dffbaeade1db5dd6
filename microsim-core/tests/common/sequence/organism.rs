//! Calls for organisms: spawning, inputs, division, growth, controllers, own templates.

use super::{Choices, Outcome, Sequence};
use microsim_core::glam::Vec2;
use microsim_core::{
    Actuation, Bend, ChemicalSpec, Distance, Error, Exchange, Half, Intent, LinkDrag, Node, OrganismId, Propulsion,
    Rope, Template, YieldingDistance,
};

impl Sequence<'_> {
    pub(super) fn spawn(&mut self) -> Outcome {
        let (spec, placement) = (self.choices.spec(), self.choices.placement(self.world.config().size));
        self.world.spawn(&spec, placement).map(|id| self.handles.push(id))
    }

    pub(super) fn input(&mut self, id: OrganismId) -> Outcome {
        let place = match self.choices.below(4) {
            0 => self.place(),
            // After somebody: that is how meals come about.
            _ => self.handle().and_then(|other| self.world.centroid(other)).unwrap_or(Vec2::ZERO),
        };
        let digests = self.choices.flag();
        let intent = Intent::toward(place)?.digesting(digests);
        self.inputs.set(id, if self.choices.byte() < 20 { Intent::REST } else { intent });
        Ok(())
    }

    pub(super) fn divide(&mut self, id: OrganismId) -> Outcome {
        if self.choices.flag() {
            // Bodies that can are few among many.
            let body = self.handles.iter().copied().rfind(|&id| self.has_cut(id)).filter(|_| self.choices.flag());
            return self.world.divide(body.unwrap_or(id));
        }
        let axis = Vec2::new(self.choices.number(-1.0, 1.0), self.choices.number(-1.0, 1.0));
        self.world.divide_along(id, axis)
    }

    pub(super) fn grow(&mut self, id: OrganismId) -> Outcome {
        let (nodes, particles) = (self.choices.below(6) as u32, self.choices.byte() as u32);
        self.world.grow(id, nodes, particles)
    }

    pub(super) fn set_exempt(&mut self, a: OrganismId, b: OrganismId) -> Outcome {
        let is_exempt = self.choices.flag();
        self.world.set_exempt(a, b, is_exempt)
    }

    pub(super) fn push(&mut self, id: OrganismId) -> Outcome {
        let velocity = Vec2::new(self.choices.number(-50.0, 50.0), self.choices.number(-50.0, 50.0));
        self.world.push(id, velocity)
    }

    pub(super) fn actuate(&mut self, id: OrganismId) -> Outcome {
        let node = self.choices.below(40) as u32;
        let (force, impulse) = (Actuation::force(self.vector(500.0)), Actuation::impulse(self.vector(50.0)));
        let target = Actuation::target(self.place());
        match self.choices.below(9) {
            7 => self.inputs.actuate_node(id, node, Actuation { impulse: impulse.impulse, ..target }),
            8 => {
                self.inputs.remove(id);
                self.inputs.actuate(id, Actuation::default())
            }
            0 => self.inputs.actuate(id, force),
            1 => self.inputs.actuate(id, impulse),
            2 => self.inputs.actuate(id, Actuation::torque(self.choices.number(-500.0, 500.0))),
            3 => self.inputs.actuate(id, target),
            4 => self.inputs.actuate_node(id, node, force),
            5 => self.inputs.activate(id, node % 3, self.choices.number(0.0, 1.1)),
            _ => {
                self.inputs.clear();
                self.world.check_inputs(&self.inputs)
            }
        }
    }

    pub(super) fn set_exchange(&mut self, id: OrganismId) -> Outcome {
        if self.chemicals.len() < 2 && self.choices.flag() {
            let spec = ChemicalSpec { diffusion: self.choices.number(0.0, 200.0), ..ChemicalSpec::default() };
            // A kept world that is returned to may not have it.
            return self.world.add_chemical(spec).map(|chemical| self.chemicals.push(chemical));
        }
        let Some(&chemical) = self.chemicals.first() else { return Ok(()) };
        let (secretion, uptake) = (self.choices.number(0.0, 100.0), self.choices.number(0.0, 100.0));
        self.world.set_exchange(id, Exchange { chemical, secretion, uptake })
    }

    pub(super) fn set_controller(&mut self, id: OrganismId) -> Outcome {
        let controller = self.choices.controller(self.chemicals.first().copied());
        self.world.set_controller(id, controller)
    }

    pub(super) fn spawn_template(&mut self) -> Outcome {
        let is_new = self.templates.is_empty() || self.choices.byte() < 80;
        if is_new {
            let template = self.template()?;
            self.templates.push(self.world.add_template(template));
        }
        let which = if is_new { self.templates.len() - 1 } else { self.choices.below(self.templates.len()) };
        let (template, placement) = (self.templates[which], self.choices.placement(self.world.config().size));
        // Whether the second of two calls is refused does not matter: the first one has changed the world.
        let id = match self.world.spawn_template(template, placement) {
            Err(_) if is_new => return Ok(()),
            spawned => spawned?,
        };
        self.handles.push(id);
        if self.has_cut(id) && self.choices.byte() < 200 {
            let _ = self.world.divide(id);
        }
        Ok(())
    }

    fn has_cut(&self, id: OrganismId) -> bool {
        let template = self.world.view().organism(id).and_then(|body| self.world.template(body.template()?));
        template.is_some_and(|template| template.cut().is_some())
    }

    /// A rod that can divide.
    fn rod(&mut self) -> Result<Template, Error> {
        let (mut builder, c) = (Template::builder(), &mut self.choices);
        let (count, pitch) = (2 + c.below(5) as u32, c.number(0.5, 1.5));
        for k in 0..count {
            builder.node(Node::disc(Vec2::new(pitch * k as f32, 0.0), c.number(0.1, 10.0), 0.5));
        }
        (1..count).for_each(|k| _ = builder.link(k - 1, k, 0.0));
        let at = 1 + c.below(count as usize - 1) as u32;
        builder.cut([0..at, at..count].map(|slots| Half::of(slots).scaled(c.number(0.3, 0.8))));
        builder.build()
    }

    fn template(&mut self) -> Result<Template, Error> {
        if self.choices.byte() < 120 {
            return self.rod();
        }
        let mut builder = Template::builder();
        builder.name(["", "mote", "seed", "a\tb"][usize::from(self.choices.byte() % 16) / 5]);
        let c = &mut self.choices;
        let count = 1 + c.below(6) as u32;
        for _ in 0..count {
            let at = Vec2::new(c.number(-3.0, 3.0), c.number(-3.0, 3.0));
            builder.node(Node::disc(at, c.number(0.1, 10.0), c.number(0.1, 1.0)));
        }
        for _ in 0..c.below(6) {
            builder.spring(c.below(7) as u32, c.below(7) as u32, c.number(0.0, 1e-3), c.number(0.0, 1.0));
        }
        if count > 2 {
            builder.constraint(Bend::new([0, 1, 2], c.number(-3.0, 3.0), c.number(0.0, 1e-2)));
        }
        if count > 3 {
            // Without a draw of its own, so that what is in the corpus stays what it is.
            builder.constraint(LinkDrag { a: 0, b: count - 1, along: count as f32, across: 1e4 });
        }
        if c.byte() < 40 {
            let slots: Vec<u32> = (0..1 + c.below(6) as u32).collect();
            builder.self_contacts(&slots);
        }
        if count > 1 && c.byte() < 120 {
            let (at, template) = (1 + c.below(count as usize - 1) as u32, ["", "mote", "seed"][c.below(3)]);
            let halves = [Half::of(0..at), Half::of(at..count)];
            builder.cut(halves.map(|half| half.named(template).scaled(c.number(0.4, 1.2))));
        }
        if c.flag() {
            let channel = builder.channel([c.number(0.5, 1.5), c.number(0.5, 1.5)]);
            builder.muscle(channel, Rope { a: 0, b: c.below(3) as u32, max_length: c.number(1.0, 4.0) });
            builder.propulsion(Propulsion { speed: c.number(1.0, 20.0), max_acceleration: c.number(1.0, 100.0) });
        }
        for _ in 0..c.below(6) / 2 {
            builder.constraint(yielding(c));
        }
        builder.build()
    }
}

/// A link that a push makes flow or tear.
fn yielding(c: &mut Choices<'_>) -> YieldingDistance {
    let a = c.below(2) as u32;
    let b = a + 1 + c.below(2) as u32;
    let (rest_length, compliance, damping) = (c.number(0.5, 4.0), c.number(1e-4, 1e-2), c.number(0.0, 0.1));
    YieldingDistance {
        yield_strain: c.number(0.0, 0.3),
        flow_rate: c.number(0.0, 20.0),
        max_plastic_strain: c.number(0.0, 1.0),
        breaking_strain: c.number(0.1, 1.0),
        ..Distance { a, b, rest_length, compliance, damping }.into()
    }
}
