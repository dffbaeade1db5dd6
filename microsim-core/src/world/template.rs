//! Templates of bodies: those that a program adds, and those of the library's organisms.

use super::World;
use super::change::WorldChange;
use crate::float_environment::with_default_float_environment;
use crate::id::TemplateId;
use crate::template::Template;
use crate::template::projection::Projection;

impl World {
    /// Adds a template for custom bodies, see [`World::spawn_template`].
    pub fn add_template(&mut self, template: Template) -> TemplateId {
        let count = self.templates.len();
        let index = self.template_index(template);
        if self.templates.len() > count {
            let added = self.templates[count].clone();
            self.changed(|| WorldChange::AddTemplate(Box::new(added)));
        }
        TemplateId(index)
    }

    /// A template: one that was added, or that of an organism of the library; `None` if it is not one of this world's.
    #[must_use]
    pub fn template(&self, id: TemplateId) -> Option<&Template> {
        self.templates.get(id.0 as usize)
    }

    /// The first template of this name; `None` for an empty one.
    #[must_use]
    pub fn template_named(&self, name: &str) -> Option<TemplateId> {
        let found = self.templates.iter().position(|template| !name.is_empty() && template.name() == name);
        found.map(|index| TemplateId(index as u32))
    }

    /// Index of an equal template, added if there is none.
    pub(crate) fn template_index(&mut self, template: Template) -> u32 {
        let known = with_default_float_environment(|| self.templates.iter().position(|other| *other == template));
        known.unwrap_or_else(|| {
            self.push_template(template);
            self.templates.len() - 1
        }) as u32
    }

    /// Adds a template at the end.
    pub(super) fn push_template(&mut self, template: Template) {
        self.projections.push(Projection::new(&template, self.config.substep()));
        self.templates.push(template);
    }
}
