//! What lies before and behind the scene (thesis, 3.2.3): drifting things out of focus, the film's grain, a vignette.

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
        let mut motes: Vec<Mote> = (0..BLOBS).map(|_| blob(&mut dice)).collect();
        motes.extend((0..SPECKS).map(|_| speck(&mut dice)));
        Self { motes }
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
        each_place(first, period, reach, |at| {
            canvas.sprite(half + Vec2::new(at.x, -at.y), radius, self.tile, self.colour);
        });
    }
}

/// Visits the places from `first` to before `end` on both axes, row by row.
fn each_place(first: Vec2, step: Vec2, end: Vec2, mut visit: impl FnMut(Vec2)) {
    let mut at = first;
    while at.y < end.y {
        at.x = first.x;
        while at.x < end.x {
            visit(at);
            at.x += step.x;
        }
        at.y += step.y;
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
    each_place(Vec2::splat(half), Vec2::splat(2.0 * half), screen + half, |at| {
        canvas.sprite(at, half, Tile::Grain, Color::new(1.0, 1.0, 1.0, GRAIN));
    });
    // Rings from where it starts to beyond the corners.
    let reach = screen.length() * 0.5;
    let around = |k: usize| Vec2::from_angle(-(k as f32) / 64.0 * TAU);
    let circle: [Vec2; 64] = std::array::from_fn(|k| screen * 0.5 + around(k) * reach * 0.5);
    let dark = |share: f32| (share * 0.55 * reach, fade(INK, VIGNETTE * share * share));
    canvas.band(&circle, &[dark(0.0), dark(0.25), dark(0.5), dark(0.75), dark(1.0)]);
}
