//! SVG by hand: text that can be compared line by line.

use super::{Page, Viewport};
use microsim_core::drawing::shape::{Colour, Item, Paint, Segment};
use microsim_core::glam::Vec2;
use std::fmt::Write;

/// The page as a document whose longer side has `longest` pixels.
pub(crate) fn write(page: &Page, longest: u32) -> String {
    let viewport = page.viewport(longest);
    let (width, height) = (viewport.width, viewport.height);
    let background = colour(page.background);
    let mut text = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" viewBox=\"0 0 {width} {height}\">\n\
<rect width=\"{width}\" height=\"{height}\" fill=\"{background}\"/>\n\
<g fill=\"none\" stroke-linecap=\"round\" stroke-linejoin=\"round\">\n"
    );
    for (number, item) in page.items.iter().enumerate() {
        add(&mut text, item, number, &viewport);
    }
    text.push_str("</g>\n</svg>\n");
    text
}

fn add(text: &mut String, item: &Item, number: usize, viewport: &Viewport) {
    if item.shape.is_empty() {
        return;
    }
    let mut style = String::new();
    match item.fill {
        Some(Paint::Flat(fill)) => {
            style += &format!(" fill=\"{}\"{}", colour(fill), alpha("fill-opacity", fill));
        }
        Some(Paint::Radial { .. }) => {
            text.push_str(&gradient(item.fill, number, viewport));
            style += &format!(" fill=\"url(#g{number})\"");
        }
        None => {}
    }
    if let Some(stroke) = item.stroke {
        let width = Number(stroke.width * viewport.scale);
        let (colour, alpha) = (colour(stroke.colour), alpha("stroke-opacity", stroke.colour));
        style += &format!(" stroke=\"{colour}\"{alpha} stroke-width=\"{width}\"");
    }
    text.push_str("<path d=\"");
    for segment in item.shape.segments() {
        add_segment(text, segment, viewport);
    }
    let _ = writeln!(text, "\"{style}/>");
}

fn add_segment(text: &mut String, segment: Segment, viewport: &Viewport) {
    let place = |p: Vec2| Point(viewport.place(p));
    // Writing to a string cannot fail.
    let _ = match segment {
        Segment::Move(p) => write!(text, "M{}", place(p)),
        Segment::Line(p) => write!(text, "L{}", place(p)),
        Segment::Cubic(a, b, c) => write!(text, "C{} {} {}", place(a), place(b), place(c)),
        Segment::Circle(centre, radius) => {
            let pixels = radius * viewport.scale;
            let (r, across) = (Number(pixels), Number(pixels * 2.0));
            let back = Number(pixels * -2.0);
            let left = Point(viewport.place(centre) - Vec2::new(pixels, 0.0));
            write!(text, "M{left}a{r} {r} 0 1 0 {across} 0a{r} {r} 0 1 0 {back} 0z")
        }
        Segment::Close => write!(text, "z"),
    };
}

fn gradient(fill: Option<Paint>, number: usize, viewport: &Viewport) -> String {
    let Some(Paint::Radial { centre, radius, inner, outer }) = fill else {
        return String::new();
    };
    let at = viewport.place(centre);
    let (x, y, r) = (Number(at.x), Number(at.y), Number(radius * viewport.scale));
    let stop = |offset: u8, c: Colour| {
        let (colour, alpha) = (colour(c), alpha("stop-opacity", c));
        format!("<stop offset=\"{offset}\" stop-color=\"{colour}\"{alpha}/>")
    };
    format!(
        "<radialGradient id=\"g{number}\" gradientUnits=\"userSpaceOnUse\" cx=\"{x}\" cy=\"{y}\" r=\"{r}\">{}{}</radialGradient>\n",
        stop(0, inner),
        stop(1, outer)
    )
}

fn colour(colour: Colour) -> String {
    let Colour { red, green, blue, .. } = colour;
    format!("#{red:02x}{green:02x}{blue:02x}")
}

fn alpha(name: &str, colour: Colour) -> String {
    if colour.alpha < 1.0 { format!(" {name}=\"{}\"", Number(colour.alpha)) } else { String::new() }
}

/// A number with at most two decimals and none that say nothing.
struct Number(f32);

impl std::fmt::Display for Number {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let hundredths = (self.0 * 100.0).round() / 100.0;
        // Adding zero turns the negative zero into the positive one.
        write!(f, "{}", hundredths + 0.0)
    }
}

struct Point(Vec2);

impl std::fmt::Display for Point {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{} {}", Number(self.0.x), Number(self.0.y))
    }
}

#[cfg(test)]
mod tests {
    use super::Number;

    #[test]
    fn numbers_are_short() {
        let shown = |value: f32| Number(value).to_string();
        assert_eq!(shown(1.0), "1");
        assert_eq!(shown(-0.001), "0");
        assert_eq!(shown(1234.567), "1234.57");
    }
}
