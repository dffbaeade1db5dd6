//! What answers a hand at once: a ring closes where the player begins to crawl to, a ring opens around what was taken in, and the
//! rim of the own cell swells once. Nothing of it blinks: each fades, and a rim does not swell again before it is done.

use super::marks::Style;
use crate::draw::palette::{ALERT, HALO, INK, READY, fade};
use crate::ui::font::TextSize;
use crate::ui::pen::Pen;
use macroquad::color::Color;
use microsim_core::glam::Vec2;

/// Time for which a ring is seen, s.
const TIME: f32 = 0.4;
/// Half the length from which a meal is a large one, units.
const LARGE: f32 = 2.0;
/// How much wider the rim of a cell gets that has taken something in.
const SWELLING: f32 = 1.2;

/// Whether a meal of half this length, units, is a large one.
#[must_use]
pub fn is_large(half_extent: f32) -> bool {
    half_extent > LARGE
}

/// A ring.
#[derive(Clone, Copy, Debug)]
struct Pulse {
    at: Vec2,
    /// Radius when it appears and when it is gone, lines of text.
    radii: [f32; 2],
    colour: Color,
    age: f32,
}

/// The rings that are seen now.
#[derive(Clone, Debug, Default)]
pub struct Pulses {
    rings: Vec<Pulse>,
    /// Time since the rim began to swell, s; `None` when it is done.
    swelling: Option<f32>,
}

impl Pulses {
    /// The player begins to crawl towards a point.
    pub fn call(&mut self, at: Vec2) {
        self.rings.push(Pulse { at, radii: [0.9, 0.2], colour: HALO, age: 0.0 });
    }

    /// Something was taken in at a point; half its length, units. A large meal has a second, wider ring.
    pub fn take(&mut self, at: Vec2, half_extent: f32) {
        self.rings.push(Pulse { at, radii: [0.4, 1.5], colour: READY, age: 0.0 });
        if is_large(half_extent) {
            self.rings.push(Pulse { at, radii: [1.5, 6.0], colour: READY, age: 0.0 });
        }
        self.swelling.get_or_insert(0.0);
    }

    /// The own cell, at a point, cannot do what it is asked for now: a dim ring in place of words.
    pub fn refuse(&mut self, at: Vec2) {
        self.rings.push(Pulse { at, radii: [1.3, 1.3], colour: fade(HALO, 0.5), age: 0.0 });
    }

    /// A cell is gone that was at a point.
    pub fn lose(&mut self, at: Vec2) {
        self.rings.push(Pulse { at, radii: [3.0, 0.2], colour: ALERT, age: 0.0 });
    }

    /// Lets time pass, s.
    pub fn pass(&mut self, elapsed: f32) {
        self.rings.iter_mut().for_each(|ring| ring.age += elapsed);
        self.rings.retain(|ring| ring.age < TIME);
        self.swelling = self.swelling.map(|age| age + elapsed).filter(|age| *age < TIME);
    }

    /// How many times as wide as usual the rim of the own cell is.
    #[must_use]
    pub fn rim(&self) -> f32 {
        1.0 + self.swelling.map_or(0.0, |age| SWELLING * (1.0 - age / TIME))
    }

    /// Draws the rings; they keep their size where nothing may move.
    pub fn draw(&self, pen: &mut Pen, style: &Style<'_>) {
        let unit = pen.line(TextSize::Body);
        for ring in &self.rings {
            let share = ring.age / TIME;
            let [from, to] = ring.radii;
            let radius = unit * style.time.map_or(0.5 * (from + to), |_| from + (to - from) * share);
            let at = style.camera.to_screen(ring.at);
            pen.canvas().arc(at, radius, 0.22 * unit, 1.0, fade(INK, 0.7 * (1.0 - share)));
            pen.canvas().arc(at, radius, 0.11 * unit, 1.0, fade(ring.colour, ring.colour.a * (1.0 - share)));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::camera::Camera;

    fn size(pulses: &Pulses, time: Option<f32>) -> f32 {
        let camera = Camera::whole(Vec2::new(160.0, 90.0), Vec2::new(1280.0, 720.0));
        let (style, mut pen) = (Style { camera: &camera, time, is_classic: false, key: None }, Pen::bare());
        pulses.draw(&mut pen, &style);
        let at = camera.to_screen(Vec2::new(80.0, 45.0));
        pen.canvas().corners().map(|(corner, ..)| corner.distance(at)).fold(0.0, f32::max)
    }

    #[test]
    fn what_is_refused_has_a_dimmer_ring_than_what_is_done() {
        let camera = Camera::whole(Vec2::new(160.0, 90.0), Vec2::new(1280.0, 720.0));
        let style = Style { camera: &camera, time: None, is_classic: false, key: None };
        let strongest = |begin: fn(&mut Pulses, Vec2)| {
            let (mut pulses, mut pen) = (Pulses::default(), Pen::bare());
            begin(&mut pulses, Vec2::new(80.0, 45.0));
            pulses.draw(&mut pen, &style);
            let light = pen.canvas().corners().filter(|(.., colour)| colour[0] > 128);
            light.map(|(.., colour)| colour[3]).max().unwrap_or_default()
        };
        let [refused, called] = [strongest(Pulses::refuse), strongest(Pulses::call)];
        assert!(refused > 0 && f32::from(refused) < 0.6 * f32::from(called), "{refused} {called}");
    }

    #[test]
    fn a_ring_closes_where_one_crawls_to_and_opens_around_what_was_taken_in() {
        for (is_taken, grows) in [(false, false), (true, true)] {
            let sizes = |time| {
                let mut pulses = Pulses::default();
                let at = Vec2::new(80.0, 45.0);
                if is_taken {
                    pulses.take(at, 1.0);
                } else {
                    pulses.call(at);
                }
                [0.05, 0.2, TIME].map(|elapsed| {
                    pulses.pass(elapsed);
                    size(&pulses, time)
                })
            };
            let [early, late, gone] = sizes(Some(0.0));
            assert!(early > 0.0 && (late > early) == grows && gone == 0.0, "{early} {late} {gone}");
            let [early, late, gone] = sizes(None);
            assert!(early > 0.0 && early == late && gone == 0.0, "nothing moves");
        }
    }

    #[test]
    fn a_large_meal_has_a_wider_ring_and_a_cell_that_is_gone_one_that_closes() {
        let sizes = |answer: fn(&mut Pulses, Vec2)| {
            let mut pulses = Pulses::default();
            answer(&mut pulses, Vec2::new(80.0, 45.0));
            [0.05, 0.2].map(|elapsed| {
                pulses.pass(elapsed);
                size(&pulses, Some(0.0))
            })
        };
        let [small, large] =
            [|pulses: &mut Pulses, at| pulses.take(at, 1.0), |pulses: &mut Pulses, at| pulses.take(at, 4.0)].map(sizes);
        assert!(large[1] > 2.0 * small[1] && large[1] > large[0], "{small:?} {large:?}");
        let lost = sizes(Pulses::lose);
        assert!(lost[0] > lost[1] && lost[1] > 0.0, "{lost:?}");
    }

    #[test]
    fn a_rim_swells_less_than_three_times_a_second_however_much_is_taken_in() {
        let (mut pulses, mut before, mut swellings) = (Pulses::default(), 1.0, 0);
        for _ in 0..600 {
            pulses.take(Vec2::ZERO, 1.0);
            swellings += u32::from(pulses.rim() > before + 0.5);
            before = pulses.rim();
            pulses.pass(1.0 / 60.0);
        }
        assert!((2..30).contains(&swellings), "{swellings} in ten seconds");
    }
}
