//! Pictures made by a graphics card: what it has to draw, into which targets, with which programs.
//!
//! ```text
//!   Matter --------------------------+--> Image --> Softened --> Picture
//!   CoarseMatter --> Wave --> Spread --> Surround --^
//! ```
//!
//! A recipe is data. Whoever has a graphics card carries it out: [`Program::source`] is GLSL 100, with no extension and
//! nothing but targets of bytes unless [`Precision::Float`] is asked for. The picture is that of
//! [`Microscope::expose`] up to rounding, except within some pixels of its border.

mod program;
mod slide;

pub use program::{Program, Source};
pub use slide::{Draw, Map};
pub(super) use slide::{QUAD, Slide, box_corners};

use super::exposure::Microscope;
use super::field::Field;
use super::film::Frame;
use super::maths::{gaussian, larger, smaller};
use super::matter::Grid;
use super::noise::{self, scramble};
use super::optics::{Mode, Optics, Shade};
use super::painting::Painting;
use super::specimen::Specimen;
use super::wave;
use crate::error::{Error, in_range};
use crate::world::view::View;
use glam::{IVec2, Vec2};

/// Smallest pixel that a card computes an image on, micrometres.
const FINEST: f32 = 1.0 / 32.0;
/// Most pixels that a blur takes to one side, and one more.
const LONGEST: usize = 24;
/// Largest amplitude of a wave, and largest brightness of an image, that targets hold.
const WAVE_RANGE: f32 = 1.2;
const LIGHT_RANGE: f32 = 1.5;
/// Of bytes: the largest amounts of matter that a target tells apart, and what an empty one holds. Phase goes from -1 to 5.
const BYTES_SCALE: [f32; 4] = [1.0 / 6.0, 1.0 / 1.6, 1.0 / 2.4, 1.0 / 2.0];
const BYTES_BIAS: [f32; 4] = [1.0 / 6.0, 0.03, 0.15, 0.05];

/// What a card's targets hold.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Precision {
    /// Four floats of 16 bits: [`Target::is_float`] says which targets.
    Float,
    /// Four bytes; every card can do that. Thin things are a little noisy.
    Bytes,
}

/// What a card can do and may take.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Card {
    /// What its targets hold.
    pub precision: Precision,
    /// Pixels of the image for each pixel of the picture, along each side, 0.1 to 1.
    pub detail: f32,
    /// Whether the image is blurred as an objective does. Without, a pass is saved and edges are too sharp, and halos are
    /// computed on larger pixels.
    pub is_soft: bool,
}

impl Card {
    /// As the picture is meant.
    pub const FULL: Self = Self { precision: Precision::Float, detail: 1.0, is_soft: true };
}

/// A texture that is drawn into.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Target {
    /// The specimen.
    Matter,
    /// The specimen and some of what is around it, coarsely.
    CoarseMatter,
    /// The wave behind that.
    Wave,
    /// That, blurred along its rows.
    Spread,
    /// The surround wave.
    Surround,
    /// Light.
    Image,
    /// Light, blurred along its rows.
    Softened,
    /// The result: bytes, red, green, blue and full opacity.
    Picture,
}

impl Target {
    /// All of them.
    pub const ALL: [Self; 8] = [
        Self::Matter,
        Self::CoarseMatter,
        Self::Wave,
        Self::Spread,
        Self::Surround,
        Self::Image,
        Self::Softened,
        Self::Picture,
    ];

    /// Whether it holds floats where targets can.
    #[must_use]
    pub fn is_float(self) -> bool {
        self != Self::Picture
    }
}

/// What a program reads from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Input {
    /// [`noise_table`].
    Noise,
    /// What an earlier pass has drawn; between pixels it is interpolated.
    Target(Target),
    /// One of [`Recipe::maps`], not interpolated.
    Map(usize),
}

/// Draws into one target.
#[derive(Clone, Debug)]
pub struct Pass {
    /// Where to.
    pub target: Target,
    /// Its size, pixels.
    pub size: [u32; 2],
    /// What.
    pub content: Content,
}

/// What a pass draws.
#[derive(Clone, Debug)]
pub enum Content {
    /// [`Recipe::slide`], its draws in their order. The numbers come before each draw's own uniforms.
    Slide(Vec<f32>),
    /// A program on each pixel.
    Screen {
        /// Which.
        program: Program,
        /// In the order of [`Source::uniforms`].
        uniforms: Vec<f32>,
        /// In the order of [`Source::textures`].
        inputs: Vec<Input>,
    },
}

/// What a card has to do for a picture, pass after pass; the last draws [`Target::Picture`].
#[derive(Clone, Debug)]
pub struct Recipe {
    /// Things on the slide.
    pub slide: Vec<Draw>,
    /// Textures that only this picture needs.
    pub maps: Vec<Map>,
    /// In their order.
    pub passes: Vec<Pass>,
}

/// The texture that programs take noise from: its side in texels, and four bytes for each. Beyond its edges it repeats
/// itself, and between texels it is interpolated.
#[must_use]
pub fn noise_table() -> (u16, Vec<u8>) {
    let side = noise::SIDE;
    let texels = (0..side * side).flat_map(|k| noise::entry(IVec2::new(k % side, k / side)));
    (side as u16, texels.collect())
}

impl Microscope {
    /// What a graphics card has to do for the picture that [`Microscope::expose`] computes of what is viewed.
    ///
    /// # Errors
    /// Names the number of the field, the film or the card that is out of range.
    pub fn recipe(&self, view: View<'_>, field: Field, card: Card) -> Result<Recipe, Error> {
        field.validate()?;
        self.film.validate().map_err(|error| error.within("film"))?;
        in_range("card.detail", card.detail, 0.1, 1.0)?;
        let frame = self.film.frame(view.time(), scramble(view.world().config().seed as u32 ^ 0xf11e));
        let mode = self.optics.mode();
        let kitchen = Kitchen { optics: self.optics, mode, card, field, frame };
        Ok(match mode.shade {
            Shade::Painted => kitchen.painted(&Painting::of(view)),
            Shade::Light(..) => kitchen.lit(view),
        })
    }
}

/// What a recipe is made from.
struct Kitchen {
    optics: Optics,
    mode: &'static Mode,
    card: Card,
    field: Field,
    frame: Frame,
}

impl Kitchen {
    fn lit(&self, view: View<'_>) -> Recipe {
        let grid = self.image_grid(larger(self.field.pixel() / self.card.detail, FINEST));
        let (scale, bias) = self.coding();
        let coarse = if self.card.is_soft { grid.pixel } else { 2.0 * grid.pixel };
        let around = self.mode.has_surround.then(|| wave::surround_grid(&grid, coarse));
        let widest = around.unwrap_or(grid);
        let mut slide = Slide::new(widest.bounds(), grid.pixel);
        Specimen::of(view, self.field.centre, &widest).draw_on(&mut slide, bias);
        let mut passes = vec![self.matter(Target::Matter, &grid)];
        let mut uniforms = [scale, bias].concat();
        let low = grid.bounds().0;
        uniforms.extend([low.x, low.y, grid.columns as f32 * grid.pixel, grid.rows as f32 * grid.pixel]);
        let mut inputs = vec![Input::Target(Target::Matter), Input::Noise];
        if let Some(around) = around {
            passes.extend(self.surround(&around));
            let size = Vec2::new(around.columns as f32, around.rows as f32) * around.pixel;
            let (to_scale, to_start) = (Vec2::new(uniforms[10], uniforms[11]) / size, (low - around.bounds().0) / size);
            uniforms.extend([to_scale.x, to_scale.y, to_start.x, to_start.y]);
            inputs.push(Input::Target(Target::Surround));
        }
        passes.push(screen(Target::Image, &grid, Program::Image(self.optics), uniforms, inputs));
        self.develop(&grid, &mut passes);
        Recipe { slide: slide.draws, maps: slide.maps, passes }
    }

    fn painted(&self, painting: &Painting) -> Recipe {
        // Four pixels for each of the picture's, unless the card is to be spared.
        let samples = if self.card.detail == 1.0 { 2.0 } else { 1.0 };
        let grid = self.image_grid(self.field.pixel() / (samples * self.card.detail));
        let mut slide = Slide::new(grid.bounds(), grid.pixel);
        painting.draw_on(&mut slide);
        let content = Content::Slide(view(&grid).to_vec());
        let mut passes = vec![Pass { target: Target::Image, size: size(&grid), content }];
        self.develop(&grid, &mut passes);
        Recipe { slide: slide.draws, maps: slide.maps, passes }
    }

    /// Pixels of this side over the whole picture.
    fn image_grid(&self, pixel: f32) -> Grid {
        let [columns, rows] =
            self.field.pixels.map(|count| (count as f32 * self.field.pixel() / pixel).ceil() as usize);
        let corner = self.field.corner() + self.frame.weave * self.field.pixel();
        Grid { corner, pixel, columns: columns.max(1), top: 0, rows: rows.max(1) }
    }

    /// How targets hold matter: they hold it times the first, plus the second.
    fn coding(&self) -> ([f32; 4], [f32; 4]) {
        match self.card.precision {
            Precision::Float => ([1.0; 4], [0.0; 4]),
            Precision::Bytes => (BYTES_SCALE, BYTES_BIAS),
        }
    }

    fn matter(&self, target: Target, grid: &Grid) -> Pass {
        let dither = if self.card.precision == Precision::Bytes { 1.0 / 255.0 } else { 0.0 };
        let mut common = view(grid).to_vec();
        common.extend([grid.pixel, dither]);
        common.extend(self.coding().0);
        Pass { target, size: size(grid), content: Content::Slide(common) }
    }

    /// The surround wave, on its own coarse pixels.
    fn surround(&self, grid: &Grid) -> [Pass; 4] {
        let (scale, bias) = self.coding();
        let weights = wave::surround_weights(grid.pixel);
        let reach = (weights.len() / 2 - 1) as f32;
        let spread = |side: [f32; 2]| {
            let mut uniforms = vec![side[0], side[1], reach];
            uniforms.extend(padded(&weights, 2 * LONGEST));
            uniforms
        };
        let (across, along) = ([1.0 / grid.columns as f32, 0.0], [0.0, 1.0 / grid.rows as f32]);
        let from = |target| vec![Input::Target(target)];
        [
            self.matter(Target::CoarseMatter, grid),
            screen(Target::Wave, grid, Program::Wave, [scale, bias].concat(), from(Target::CoarseMatter)),
            screen(Target::Spread, grid, Program::SpreadAcross, spread(across), from(Target::Wave)),
            screen(Target::Surround, grid, Program::SpreadAlong, spread(along), from(Target::Spread)),
        ]
    }

    /// From the image to the picture.
    fn develop(&self, grid: &Grid, passes: &mut Vec<Pass>) {
        let sigma = if self.card.is_soft { self.mode.blur / grid.pixel } else { 0.0 };
        let weights = gaussian(smaller(sigma, (LONGEST - 1) as f32 / 3.0));
        let half = &weights[weights.len() / 2..];
        let reach = (half.len() - 1) as f32;
        let mut image = Target::Image;
        if reach > 0.0 {
            let mut uniforms = vec![1.0 / grid.columns as f32, 0.0, reach];
            uniforms.extend(padded(half, LONGEST));
            passes.push(screen(Target::Softened, grid, Program::Soften, uniforms, vec![Input::Target(image)]));
            image = Target::Softened;
        }
        let pixels = self.field.pixels.map(|count| count as usize);
        let mut uniforms = self.frame.uniforms(self.mode.grain, self.mode.channels == 1, pixels);
        // From the picture's pixels to the image, whose upper left corner is that of the picture.
        let scale = self.field.pixel() / grid.pixel;
        let share = [scale / grid.columns as f32, scale / grid.rows as f32];
        uniforms.extend([share[0], share[1], 1.0 - share[1] * pixels[1] as f32, 1.0 / grid.rows as f32, reach]);
        uniforms.extend(padded(half, LONGEST));
        let content =
            Content::Screen { program: Program::Film, uniforms, inputs: vec![Input::Target(image), Input::Noise] };
        passes.push(Pass { target: Target::Picture, size: self.field.pixels, content });
    }
}

fn screen(target: Target, grid: &Grid, program: Program, uniforms: Vec<f32>, inputs: Vec<Input>) -> Pass {
    Pass { target, size: size(grid), content: Content::Screen { program, uniforms, inputs } }
}

fn size(grid: &Grid) -> [u32; 2] {
    [grid.columns as u32, grid.rows as u32]
}

/// Middle of a grid, and clip units per micrometre.
fn view(grid: &Grid) -> [f32; 4] {
    let (low, high) = grid.bounds();
    let (middle, scale) = (0.5 * (low + high), 2.0 / (high - low));
    [middle.x, middle.y, scale.x, scale.y]
}

fn padded(numbers: &[f32], count: usize) -> impl Iterator<Item = f32> {
    numbers.iter().copied().chain(std::iter::repeat(0.0)).take(count)
}
