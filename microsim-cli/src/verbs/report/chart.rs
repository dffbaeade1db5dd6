//! Charts as SVG: lines, bands, marks, bars, rows of events and paths.

use super::page::escape;
use super::scale::{Scale, short};
use std::fmt::Write;

const WIDTH: f64 = 420.0;
const HEIGHT: f64 = 190.0;
/// Margin for the labels of the axes.
const LEFT: f64 = 48.0;
const RIGHT: f64 = 10.0;
const TOP: f64 = 8.0;
const BOTTOM: f64 = 34.0;
/// Most points of a line: more than there are pixels show nothing more.
const MOST: usize = 800;

/// Distinct colours for kinds of things (M. Okabe, K. Ito, "Color Universal Design", 2008).
pub(super) const COLOURS: [&str; 7] = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#999999"];

type Point = (f64, f64);

/// One value over another as a line.
pub(super) fn line(points: &[Point], x_name: &str) -> String {
    let (x, y) = scales(points.iter().copied());
    let path = polyline(&thinned(points), &x, &y);
    frame(&x, &y, x_name, &format!("<polyline class=\"line\" points=\"{path}\"/>"))
}

/// Several values at each place: their mean as a line, least and most as a band, each as a mark.
pub(super) fn spread(groups: &[(f64, Vec<f64>)], x_name: &str) -> String {
    let all = groups.iter().flat_map(|(at, values)| values.iter().map(move |value| (*at, *value)));
    let (x, y) = scales(all.clone());
    let extreme = |pick: fn(f64, f64) -> f64| {
        groups.iter().filter_map(move |(at, values)| Some((*at, values.iter().copied().reduce(pick)?)))
    };
    let band: Vec<Point> = extreme(f64::min).chain(extreme(f64::max).collect::<Vec<_>>().into_iter().rev()).collect();
    let mean: Vec<Point> =
        groups.iter().map(|(at, values)| (*at, values.iter().sum::<f64>() / values.len().max(1) as f64)).collect();
    let marks: String = all
        .map(|(at, value)| {
            let title = format!("{x_name} {}: {}", short(at), short(value));
            format!(
                "<circle class=\"mark\" cx=\"{:.1}\" cy=\"{:.1}\" r=\"2\"><title>{}</title></circle>",
                x.place(at),
                y.place(value),
                escape(title)
            )
        })
        .collect();
    let (band, mean) = (polyline(&band, &x, &y), polyline(&mean, &x, &y));
    let content =
        format!("<polygon class=\"band\" points=\"{band}\"/><polyline class=\"line\" points=\"{mean}\"/>{marks}");
    frame(&x, &y, x_name, &content)
}

/// How often values fall into each of some ranges.
pub(super) fn histogram(values: &[f64], x_name: &str) -> String {
    const BARS: usize = 20;
    let x = Scale::over(values.iter().copied(), LEFT, WIDTH - RIGHT);
    let mut counts = [0_u32; BARS];
    for value in values.iter().filter(|value| value.is_finite()) {
        counts[((x.share(*value) * BARS as f64) as usize).min(BARS - 1)] += 1;
    }
    let most = counts.iter().copied().max().unwrap_or(1);
    let y = Scale::over([0.0, f64::from(most.max(1))].into_iter(), HEIGHT - BOTTOM, TOP);
    let width = (WIDTH - RIGHT - LEFT) / BARS as f64;
    let bar = |(index, &count): (usize, &u32)| {
        let top = y.place(f64::from(count));
        format!(
            "<rect class=\"bar\" x=\"{:.1}\" y=\"{top:.1}\" width=\"{:.1}\" height=\"{:.1}\"><title>{count}</title></rect>",
            LEFT + index as f64 * width,
            width - 1.0,
            HEIGHT - BOTTOM - top
        )
    };
    let bars: String = counts.iter().enumerate().map(bar).collect();
    frame(&x, &y, x_name, &bars)
}

/// When things of several kinds happened: a row for each kind.
pub(super) fn rows(kinds: &[(String, Vec<f64>)], end: f64) -> String {
    let (left, width, step) = (150.0, 2.0 * WIDTH, 22.0);
    let height = kinds.len() as f64 * step + BOTTOM;
    let x = Scale::over([0.0, end].into_iter(), left, width - RIGHT);
    let mut svg = open(width, height);
    for (index, (name, times)) in kinds.iter().enumerate() {
        let y = index as f64 * step + 4.0;
        let _ = write!(svg, "<text x=\"0\" y=\"{:.1}\">{} ({})</text>", y + 12.0, escape(name), times.len());
        // Marks on the same pixel are one.
        let mut places: Vec<i64> = times.iter().map(|time| x.place(*time).round() as i64).collect();
        places.dedup();
        let marks: String = places.iter().map(|place| format!("M{place} {y:.0}v{:.0}", step - 8.0)).collect();
        let _ = write!(svg, "<path class=\"line\" d=\"{marks}\"/>");
    }
    x_axis(&mut svg, &x, height - BOTTOM, "time, s");
    svg + "</svg>"
}

/// Ways through the room, each in a colour.
pub(super) fn paths(paths: &[(&str, Vec<Point>)]) -> String {
    let points = || paths.iter().flat_map(|(_, points)| points.iter().copied());
    let x = Scale::over(points().map(|point| point.0), LEFT, WIDTH - RIGHT);
    let [left, right] = x.ends();
    let unscaled = Scale::over(points().map(|point| point.1), 0.0, 1.0);
    let [low, high] = unscaled.ends();
    // As large in both directions.
    let drawn = ((high - low) / (right - left) * (WIDTH - RIGHT - LEFT)).clamp(60.0, 420.0);
    let y = Scale::over([low, high].into_iter(), TOP + drawn, TOP);
    let line = |(colour, points): &(&str, Vec<Point>)| {
        let path = polyline(&thinned(points), &x, &y);
        format!("<polyline points=\"{path}\" fill=\"none\" stroke=\"{colour}\" stroke-width=\"1\" opacity=\".7\"/>")
    };
    let content: String = paths.iter().map(line).collect();
    framed(&x, &y, "x, µm", &content, TOP + drawn + BOTTOM)
}

/// Several lines, each in a colour.
pub(super) fn lines(series: &[(&str, Vec<Point>)], x_name: &str) -> String {
    let (x, y) = scales(series.iter().flat_map(|(_, points)| points.iter().copied()));
    let line = |(colour, points): &(&str, Vec<Point>)| {
        let path = polyline(&thinned(points), &x, &y);
        format!("<polyline points=\"{path}\" fill=\"none\" stroke=\"{colour}\" stroke-width=\"1.2\" opacity=\".8\"/>")
    };
    let content: String = series.iter().map(line).collect();
    frame(&x, &y, x_name, &content)
}

pub(super) fn legend(names: &[(&str, &str)]) -> String {
    let entry = |(colour, name): &(&str, &str)| format!("<span style=\"color:{colour}\">■</span> {} ", escape(name));
    format!("<p>{}</p>", names.iter().map(entry).collect::<String>())
}

pub(super) fn open(width: f64, height: f64) -> String {
    format!("<svg viewBox=\"0 0 {width:.0} {height:.0}\" role=\"img\">")
}

fn scales(points: impl Iterator<Item = Point> + Clone) -> (Scale, Scale) {
    let x = Scale::over(points.clone().map(|point| point.0), LEFT, WIDTH - RIGHT);
    (x, Scale::over(points.map(|point| point.1), HEIGHT - BOTTOM, TOP))
}

fn polyline(points: &[Point], x: &Scale, y: &Scale) -> String {
    let finite = points.iter().filter(|(a, b)| a.is_finite() && b.is_finite());
    finite.map(|(a, b)| format!("{:.1},{:.1} ", x.place(*a), y.place(*b))).collect()
}

/// Of each stretch of points its lowest and its highest.
fn thinned(points: &[Point]) -> Vec<Point> {
    if points.len() <= MOST {
        return points.to_vec();
    }
    let stretch = points.len().div_ceil(MOST / 2);
    let ends = |part: &[Point]| {
        let order = |a: &&Point, b: &&Point| a.1.total_cmp(&b.1);
        let mut both = [part.iter().min_by(order), part.iter().max_by(order)].map(|point| *point.unwrap_or(&part[0]));
        both.sort_by(|a, b| a.0.total_cmp(&b.0));
        both
    };
    points.chunks(stretch).flat_map(ends).collect()
}

fn frame(x: &Scale, y: &Scale, x_name: &str, content: &str) -> String {
    framed(x, y, x_name, content, HEIGHT)
}

fn framed(x: &Scale, y: &Scale, x_name: &str, content: &str, height: f64) -> String {
    let mut svg = open(WIDTH, height);
    for tick in y.ticks(4.0) {
        let place = y.place(tick);
        let _ = write!(
            svg,
            "<line class=\"axis\" x1=\"{LEFT}\" x2=\"{:.0}\" y1=\"{place:.1}\" y2=\"{place:.1}\"/>\
             <text x=\"{:.0}\" y=\"{:.1}\" text-anchor=\"end\">{}</text>",
            WIDTH - RIGHT,
            LEFT - 6.0,
            place + 4.0,
            short(tick)
        );
    }
    x_axis(&mut svg, x, height - BOTTOM, x_name);
    svg.push_str(content);
    svg + "</svg>"
}

fn x_axis(svg: &mut String, x: &Scale, y: f64, name: &str) {
    let [low, high] = x.ends();
    for tick in x.ticks(6.0) {
        let place = x.place(tick);
        let _ =
            write!(svg, "<text x=\"{place:.1}\" y=\"{:.1}\" text-anchor=\"middle\">{}</text>", y + 14.0, short(tick));
    }
    let (left, right) = (x.place(low), x.place(high));
    let _ = write!(
        svg,
        "<line class=\"axis\" x1=\"{left:.1}\" x2=\"{right:.1}\" y1=\"{y:.1}\" y2=\"{y:.1}\"/>\
         <text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"middle\">{}</text>",
        (left + right) / 2.0,
        y + 29.0,
        escape(name)
    );
}

#[cfg(test)]
mod tests {
    use super::*;

    fn is_sound(svg: &str) -> bool {
        !svg.contains("NaN") && !svg.contains("inf") && svg.matches("<svg").count() == svg.matches("</svg>").count()
    }

    #[test]
    fn charts_stand_whatever_they_are_given() {
        let hard: Vec<Point> = vec![(0.0, f64::NAN), (1.0, 3.0), (1.0, f64::INFINITY)];
        for svg in [
            line(&[], "t"),
            line(&hard, "t"),
            spread(&[(1.0, vec![2.0, 3.0]), (2.0, vec![])], "t"),
            histogram(&[1.0, f64::NAN, 2.0], "t"),
            histogram(&[], "t"),
            rows(&[("a<b".to_owned(), vec![0.0, 1.0])], 2.0),
            paths(&[("red", hard.clone())]),
            lines(&[("red", hard)], "t"),
        ] {
            assert!(is_sound(&svg), "{svg}");
        }
    }

    #[test]
    fn thinning_keeps_what_stands_out() {
        let mut points: Vec<Point> = (0..100_000).map(|k| (f64::from(k), 0.0)).collect();
        points[54_321].1 = 9.0;
        let thin = thinned(&points);
        assert!(thin.len() <= 2 * MOST && thin.iter().any(|point| point.1 == 9.0));
    }
}
