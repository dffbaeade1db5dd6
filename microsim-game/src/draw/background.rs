//! What lies before and behind the scene (seed, 3.2.3): drifting things out of focus, the film's grain, a vignette.

use super::atlas::{GUARD, SIDE, Tile};
use super::canvas::Canvas;
use super::palette::{HALO, INK, SLIDE, fade, mix, scene};
use crate::camera::Camera;
use macroquad::color::Color;
use microsim_core::Rng;
use microsim_core::glam::Vec2;
use std::f32::consts::TAU;

const BLOBS: usize = 46;
const SPECKS: usize = 220;
/// Units after which the scenery comes again.
const PERIOD: Vec2 = Vec2::new(240.0, 160.0);
const GRAIN: f32 = 0.10;
const VIGNETTE: f32 = 0.42;

/// Something in the background.
#[derive(Clone, Copy, Debug)]
struct Mote {
    place: Vec2,
    radius: f32,
    /// How much of the scene's motion it takes part in: less is deeper down.
    depth: f32,
    wander: Vec2,
    phase: f32,
    tile: Tile,
    colour: Color,
}

/// The scenery below the scene.
#[derive(Debug)]
pub(crate) struct Background {
    motes: Vec<Mote>,
}

impl Background {
    pub(crate) fn new() -> Self {
        let mut dice = Rng::new(11, 0);
        let blobs = (0..BLOBS).map(|_| blob(&mut dice)).collect::<Vec<_>>();
        let specks = (0..SPECKS).map(|_| speck(&mut dice));
        Self { motes: blobs.into_iter().chain(specks.collect::<Vec<_>>()).collect() }
    }

    /// Draws what lies below the scene.
    pub(crate) fn draw(&self, canvas: &mut Canvas, camera: &Camera, time: f32) {
        for mote in &self.motes {
            let sway = Vec2::from_angle(mote.phase + 0.05 * TAU * time * (0.5 + mote.depth)) * mote.radius * 0.35;
            let place = mote.place + mote.wander * time + sway;
            mote.draw(canvas, camera, place);
        }
    }
}

impl Mote {
    /// Draws each repetition that lies in the picture.
    fn draw(&self, canvas: &mut Canvas, camera: &Camera, place: Vec2) {
        let half = camera.screen() * 0.5;
        // Deep things are seen smaller, and from farther away nearly unchanged.
        let scale = self.depth * camera.scale();
        let (period, radius) = (PERIOD * scale, self.radius * scale);
        let offset = (place - camera.centre()) * scale;
        let reach = half + radius;
        let first = (offset + reach).rem_euclid(period) - reach;
        let mut y = first.y;
        while y < reach.y {
            let mut x = first.x;
            while x < reach.x {
                canvas.sprite(half + Vec2::new(x, -y), radius, self.tile, self.colour);
                x += period.x;
            }
            y += period.y;
        }
    }
}

fn somewhere(dice: &mut Rng) -> Vec2 {
    Vec2::new(dice.unit(), dice.unit()) * PERIOD
}

fn blob(dice: &mut Rng) -> Mote {
    let (is_dark, strength) = (dice.unit() < 0.55, 0.10 + 0.16 * dice.unit());
    Mote {
        place: somewhere(dice),
        radius: 5.0 + 15.0 * dice.unit() * dice.unit(),
        depth: 0.55 + 0.25 * dice.unit(),
        wander: Vec2::from_angle(dice.unit() * TAU) * (0.3 + 0.6 * dice.unit()),
        phase: dice.unit() * TAU,
        tile: Tile::Soft,
        colour: if is_dark { fade(mix(INK, scene(SLIDE), 0.35), strength) } else { fade(HALO, 2.2 * strength) },
    }
}

fn speck(dice: &mut Rng) -> Mote {
    Mote {
        place: somewhere(dice),
        radius: 0.12 + 0.35 * dice.unit() * dice.unit(),
        depth: 0.80 + 0.2 * dice.unit(),
        wander: Vec2::from_angle(dice.unit() * TAU) * 0.12,
        phase: dice.unit() * TAU,
        tile: Tile::Soft,
        colour: if dice.unit() < 0.7 { fade(INK, 0.35) } else { fade(HALO, 0.7) },
    }
}

/// Grain and vignette, over everything.
pub(crate) fn draw_film(canvas: &mut Canvas, screen: Vec2) {
    // One texel per pixel.
    let half = 0.5 * SIDE as f32 - GUARD;
    let mut y = half;
    while y - half < screen.y {
        let mut x = half;
        while x - half < screen.x {
            canvas.sprite(Vec2::new(x, y), half, Tile::Grain, Color::new(1.0, 1.0, 1.0, GRAIN));
            x += 2.0 * half;
        }
        y += 2.0 * half;
    }
    // Rings from where it starts to beyond the corners.
    let reach = screen.length() * 0.5;
    let circle: Vec<Vec2> = (0..64).map(|k| Vec2::from_angle(-k as f32 / 64.0 * TAU)).collect();
    let on_screen: Vec<Vec2> = circle.iter().map(|&along| screen * 0.5 + along * reach * 0.5).collect();
    let dark = |share: f32| (share * 0.55 * reach, fade(INK, VIGNETTE * share * share));
    canvas.band(&on_screen, &[dark(0.0), dark(0.25), dark(0.5), dark(0.75), dark(1.0)]);
}
