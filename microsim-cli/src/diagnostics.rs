//! Shows the problems of a scenario with the lines that cause them.

use crate::counted::counted;
use crate::sanitize;
use annotate_snippets::renderer::DecorStyle;
use annotate_snippets::{AnnotationKind, Group, Level, Origin, Renderer, Snippet};
use microsim_core::scenario::{Diagnostic, Diagnostics};
use std::ops::Range;

/// The text of a scenario and its origin.
#[derive(Clone, Debug)]
pub(crate) struct ScenarioText {
    /// Name of the file, for messages.
    pub origin: String,
    pub text: String,
}

impl ScenarioText {
    pub(crate) fn new(origin: String, text: String) -> Self {
        Self { origin, text }
    }
}

/// All problems of one scenario, as a text for a terminal.
pub(crate) fn render(source: &ScenarioText, problems: &Diagnostics, is_coloured: bool) -> String {
    let renderer = if is_coloured { Renderer::styled() } else { Renderer::plain() };
    let renderer = renderer.decor_style(DecorStyle::Ascii);
    let shown = problems.iter().map(|problem| renderer.render(&[group(source, problem)]));
    let mut text = shown.collect::<Vec<_>>().join("\n\n");
    for more in problems.left_out() {
        text.push_str(&format!("\n\n{}", sanitize::line(&more.to_string())));
    }
    let count = problems.len() + problems.left_out().iter().map(|more| more.count).sum::<usize>();
    text.push_str(&format!("\n\nerror: {} in {}", counted(count, "problem"), sanitize::line(&source.origin)));
    text
}

fn group<'a>(source: &'a ScenarioText, problem: &'a Diagnostic) -> Group<'a> {
    let title = Level::ERROR.primary_title(sanitize::line(&title(problem)).into_owned());
    let group = match &problem.span {
        Some(span) => title.element(snippet(source, span)),
        None => title.element(origin(source, problem)),
    };
    match &problem.accepted {
        Some(accepted) => group.element(Level::HELP.message(format!("accepted: {}", sanitize::line(accepted)))),
        None => group,
    }
}

fn title(problem: &Diagnostic) -> String {
    let Diagnostic { field, message, .. } = problem;
    if field.is_empty() || message.contains(&format!("`{field}`")) {
        message.clone()
    } else {
        format!("`{field}`: {message}")
    }
}

fn snippet<'a>(source: &'a ScenarioText, span: &Range<usize>) -> Snippet<'a, annotate_snippets::Annotation<'a>> {
    let annotation = AnnotationKind::Primary.span(within(&source.text, span));
    Snippet::source(&source.text).path(sanitize::line(&source.origin)).annotation(annotation)
}

fn origin<'a>(source: &'a ScenarioText, problem: &Diagnostic) -> Origin<'a> {
    let origin = Origin::path(sanitize::line(&source.origin));
    match (problem.line, problem.column) {
        (Some(line), Some(column)) => origin.line(line).char_column(column),
        (Some(line), None) => origin.line(line),
        _ => origin,
    }
}

/// The span, cut to the text and to whole characters: whatever it is, showing it must not panic.
fn within(text: &str, span: &Range<usize>) -> Range<usize> {
    let whole = |at: usize| {
        let mut at = at.min(text.len());
        while !text.is_char_boundary(at) {
            at -= 1;
        }
        at
    };
    let start = whole(span.start);
    start..whole(span.end).max(start)
}

#[cfg(test)]
mod tests {
    use super::within;

    #[test]
    fn a_span_is_cut_to_whole_characters_of_the_text() {
        assert_eq!(within("aµb", &(2..9)), 1..4);
        assert_eq!(within("", &(5..9)), 0..0);
    }
}
