//! The parts of an HTML page.

use crate::sanitize;
use std::fmt::{Display, Write};

/// A page that is being put together.
#[derive(Debug)]
pub(super) struct Page {
    body: String,
}

impl Page {
    pub(super) fn new(title: &str, lead: &str) -> Self {
        let mut page = Self { body: String::new() };
        page.push(&format!("<header><h1>{}</h1><p>{}</p></header>", escape(title), escape(lead)));
        page
    }

    pub(super) fn push(&mut self, html: &str) {
        self.body.push_str(html);
        self.body.push('\n');
    }

    /// A section: a heading and its content; none if the content is empty.
    pub(super) fn section(&mut self, heading: &str, html: &str) {
        if !html.is_empty() {
            self.push(&format!("<section><h2>{}</h2>{html}</section>", escape(heading)));
        }
    }

    /// Failures, above everything else.
    pub(super) fn warning(&mut self, lines: &[String]) {
        if !lines.is_empty() {
            let items: String = lines.iter().map(|line| format!("<li>{}</li>", escape(line))).collect();
            self.push(&format!("<ul class=\"warning\">{items}</ul>"));
        }
    }

    /// The whole file.
    pub(super) fn finish(self, title: &str) -> String {
        let mut html = String::new();
        // Nothing may be fetched, and the empty icon keeps browsers from asking for one.
        let _ = write!(
            html,
            "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\
             <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\
             <meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; img-src data:; style-src 'unsafe-inline'\">\
             <link rel=\"icon\" href=\"data:,\"><title>{}</title>\n<style>\n{}</style></head>\n<body>\n{}\
             <footer>microsim {}</footer></body></html>\n",
            escape(title),
            include_str!("page.css"),
            self.body,
            env!("CARGO_PKG_VERSION")
        );
        html
    }
}

pub(super) fn figures(figures: &[String]) -> String {
    if figures.is_empty() { String::new() } else { format!("<div class=\"figures\">{}</div>", figures.concat()) }
}

/// One figure with its caption.
pub(super) fn figure(caption: &str, content: &str) -> String {
    format!("<figure><figcaption>{}</figcaption>{content}</figure>", escape(caption))
}

/// A table of names and values.
pub(super) fn table(rows: &[(String, String)]) -> String {
    let row = |(name, value): &(String, String)| {
        format!("<tr><th scope=\"row\">{}</th><td>{}</td></tr>", escape(name), escape(value))
    };
    let rows: String = rows.iter().map(row).collect();
    if rows.is_empty() { rows } else { format!("<table>{rows}</table>") }
}

/// Something long that is folded away.
pub(super) fn folded(summary: &str, html: &str) -> String {
    format!("<details><summary>{}</summary>{html}</details>", escape(summary))
}

/// Text that cannot be taken for markup, and turns no direction of writing.
pub(super) fn escape(text: impl Display) -> String {
    sanitize::lines(&text.to_string())
        .replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
        .replace('"', "&quot;")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_in_a_name_becomes_markup() {
        let mut page = Page::new("<script>alert(1)</script>\u{202e}", "\"&");
        page.warning(&["<b>".to_owned()]);
        let html = page.finish("<i>");
        assert!(!html.contains("<script") && !html.contains("<b>") && !html.contains("<i>"), "{html}");
        assert!(!html.contains('\u{202e}'), "{html}");
        assert!(html.contains("&quot;&amp;"));
    }
}
