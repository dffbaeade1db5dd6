//! A hanging chain.

use super::order::{Falling, Order};
use super::plot::{Curve, Plot};
use super::scene::{GRAVITY, Stepping, particles, run};
use super::{Experiment, Outcome, Row};
use microsim_core::glam::Vec2;
use microsim_core::{Error, Node, Placement, Template, World, WorldConfig};

pub(crate) const EXPERIMENT: Experiment = Experiment {
    name: "catenary",
    title: "Catenary",
    source: "Leibniz, Huygens and Johann Bernoulli 1691, Acta Eruditorum: `y = a cosh(x / a)`",
    words: "A chain of 40 rigid links hangs between two points at 0.6 of its length, and comes to rest by drag. A rigid link \
            gives way by `h²` times its load: shorter substeps are stiffer.",
    run: measure,
    order: Order::Of(Falling { accepted: [1.0, 2.2], theory: "1 to 2", ..Falling::first("the length", stretch) }),
};

const LINKS: u32 = 40;
const SPAN: f32 = 24.0;

/// Nodes of a chain at rest, relative to the middle between its ends.
fn hang(stepping: Stepping) -> Result<Vec<Vec2>, Error> {
    let room = stepping.room(Vec2::splat(60.0), GRAVITY);
    let mut world = World::new(WorldConfig { damping: 2.0, ..room })?;
    let mut builder = Template::builder();
    let half = 0.5 * SPAN;
    let slope = (0.25 * (LINKS * LINKS) as f32 - half * half).sqrt() / half;
    for k in 0..=LINKS {
        let x = SPAN * k as f32 / LINKS as f32 - half;
        let position = Vec2::new(x, (x.abs() - half) * slope);
        let is_end = k == 0 || k == LINKS;
        builder.node(if is_end { Node::fixed(position) } else { Node::disc(position, 1.0, 0.4) });
    }
    (0..LINKS).for_each(|k| _ = builder.link(k, k + 1, 0.0));
    let template = world.add_template(builder.build()?);
    let at = Vec2::new(30.0, 50.0);
    let chain = world.spawn_template(template, Placement::at(at.x, at.y))?;
    run(&mut world, 30.0);
    Ok(particles(&world, chain).iter().map(|node| node.position - at).collect())
}

/// By what share links are longer than they should be, together.
pub(crate) fn stretch(stepping: Stepping) -> Result<f64, Error> {
    Ok(length(&hang(stepping)?) / f64::from(LINKS) - 1.0)
}

fn length(nodes: &[Vec2]) -> f64 {
    nodes.windows(2).map(|link| f64::from((link[1] - link[0]).length())).sum()
}

/// The parameter `a` of the catenary of this length.
fn parameter(length: f64) -> f64 {
    let (mut low, mut high) = (1.0, 100.0);
    for _ in 0..60 {
        let a = 0.5 * (low + high);
        let longer = 2.0 * a * (0.5 * f64::from(SPAN) / a).sinh() > length;
        if longer { low = a } else { high = a }
    }
    low
}

fn measure() -> Result<Outcome, Error> {
    let a = parameter(f64::from(LINKS));
    let height = |x: f64| a * ((x / a).cosh() - (0.5 * f64::from(SPAN) / a).cosh());
    let mut rows = Vec::new();
    let curve = (-48..=48).map(|k| 0.25 * f64::from(k)).map(|x| [x, height(x)]).collect();
    let mut curves = vec![Curve::line("a cosh(x / a)", curve)];
    for substeps in [8, 64] {
        let nodes = hang(Stepping::of_substeps(substeps))?;
        let off = |node: &Vec2| (f64::from(node.y) - height(f64::from(node.x))).abs();
        let farthest = nodes.iter().map(off).fold(0.0, f64::max);
        let lowest = nodes.iter().map(|node| f64::from(-node.y)).fold(0.0, f64::max);
        let what = |what: &str| format!("{what}, {substeps} substeps");
        rows.push(Row::near(what("sag, units"), -height(0.0), 0.01, lowest));
        let share = farthest / -height(0.0);
        rows.push(Row::between(what("largest distance from the curve, share of the sag"), "0", [0.0, 0.01], share));
        let stretch = length(&nodes) / f64::from(LINKS) - 1.0;
        rows.push(Row::between(what("stretch of the chain"), "0", [0.0, 0.005], stretch));
        let places = nodes.iter().map(|node| [node.x, node.y].map(f64::from)).collect();
        curves.push(Curve::dots(format!("nodes, {substeps} substeps"), places));
    }
    let plot = Plot { axes: ["x, units", "y, units"], is_logarithmic: false, curves };
    Ok(Outcome { rows, plot: Some(plot), ..Outcome::default() })
}
