//! Formulas for a graphics card: GLSL 100 beside the code of the same name, and the numbers that both share.

use std::fmt::Write as _;

/// A piece of GLSL 100.
#[derive(Debug)]
pub(super) struct Glsl {
    pub source: &'static str,
    /// What the code calls by the same names: numbers and vectors of up to four.
    pub constants: &'static [(&'static str, &'static [f32])],
}

impl Glsl {
    /// Writes the constants and the source.
    pub(super) fn write(&self, text: &mut String) {
        for (name, numbers) in self.constants {
            let kind = ["float", "vec2", "vec3", "vec4"][numbers.len() - 1];
            let list: Vec<String> = numbers.iter().map(|number| format!("{number:?}")).collect();
            _ = writeln!(text, "const {kind} {name} = {kind}({});", list.join(", "));
        }
        text.push_str(self.source);
    }
}
