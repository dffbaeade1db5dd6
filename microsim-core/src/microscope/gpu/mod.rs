//! What a graphics card does for a picture: the passes, from the specimen to the film.

mod shader;

use super::exposure::Microscope;
use super::field::Field;
use super::film::FilmFrame;
use super::maths::{larger, smaller};
use super::optics::{Mode, Optics, Shader};
use super::painting::Painting;
use super::raster::{PixelGrid, gaussian};
use super::recipe::{Card, DrawList, Pass, PassContent, Precision, Program, RenderRecipe, RenderTarget, TextureInput};
use super::specimen::Specimen;
use super::surround_wave;
use super::surround_wave::Surround;
use crate::error::{Error, in_range};
use crate::world::view::View;
use glam::Vec2;
use shader::LONGEST;

/// Smallest pixel that a card computes an image on, micrometres.
const FINEST: f32 = 1.0 / 32.0;
/// Largest standard deviation of a lens's blur, pixels: with the camera's mask it fits into a kernel.
const MOST_SIGMA: f32 = 7.0;
/// Scale and bias of matter in targets of bytes. Phase goes from -1 to 5, haemoglobin from -1 on.
const BYTES_SCALE: [f32; 4] = [1.0 / 6.0, 1.0 / 2.8, 1.0 / 2.4, 1.0 / 2.0];
const BYTES_BIAS: [f32; 4] = [1.0 / 6.0, 0.36, 0.15, 0.05];

impl Microscope {
    /// The passes by which a graphics card draws the picture that [`Microscope::expose`] computes.
    ///
    /// # Errors
    /// Names the number of the field, the film or the card that is out of range.
    pub fn recipe(&self, view: View<'_>, field: Field, card: Card) -> Result<RenderRecipe, Error> {
        let frame = self.frame(view, field)?;
        in_range("card.detail", card.detail, 0.1, 1.0)?;
        let mode = self.optics.mode();
        let builder = RecipeBuilder { optics: self.optics, mode, card, field, frame };
        Ok(match mode.shader {
            Shader::Painted => builder.painted(&Painting::of(view)),
            Shader::Light(..) => builder.lit(view),
        })
    }
}

/// What a recipe is made from.
struct RecipeBuilder {
    optics: Optics,
    mode: &'static Mode,
    card: Card,
    field: Field,
    frame: FilmFrame,
}

impl RecipeBuilder {
    fn lit(&self, view: View<'_>) -> RenderRecipe {
        let grid = self.image_grid(larger(self.field.pixel() / self.card.detail, FINEST));
        let (scale, bias) = self.coding();
        let coarse = if self.card.is_soft { grid.pixel } else { 2.0 * grid.pixel };
        let around = self.mode.surround.map(|_| surround_wave::grid_around(&grid, coarse));
        let widest = around.unwrap_or(grid);
        let mut draws = DrawList::new(widest.bounds(), grid.pixel);
        Specimen::of(view, self.field.centre, &widest).draw_on(&mut draws, bias);
        let mut passes = vec![self.matter(RenderTarget::Matter, &grid)];
        let mut uniforms = [scale, bias].concat();
        let low = grid.bounds().0;
        uniforms.extend([low.x, low.y, grid.columns as f32 * grid.pixel, grid.rows as f32 * grid.pixel]);
        let mut inputs = vec![TextureInput::Target(RenderTarget::Matter), TextureInput::Noise];
        if let Some(around) = around {
            passes.extend(self.surround(&around));
            let size = Vec2::new(around.columns as f32, around.rows as f32) * around.pixel;
            let (to_scale, to_start) = (Vec2::new(uniforms[10], uniforms[11]) / size, (low - around.bounds().0) / size);
            uniforms.extend([to_scale.x, to_scale.y, to_start.x, to_start.y]);
            inputs.push(TextureInput::Target(RenderTarget::Surround));
        }
        passes.push(screen(RenderTarget::Image, &grid, Program::Image(self.optics), uniforms, inputs));
        self.develop(&grid, &mut passes);
        RenderRecipe { draws: draws.draws, maps: draws.maps, passes }
    }

    fn painted(&self, painting: &Painting) -> RenderRecipe {
        // At full detail, four pixels for each of the picture's.
        let samples = if self.card.detail == 1.0 { 2.0 } else { 1.0 };
        let grid = self.image_grid(self.field.pixel() / (samples * self.card.detail));
        let mut draws = DrawList::new(grid.bounds(), grid.pixel);
        painting.draw_on(&mut draws);
        let content = PassContent::Draws(view(&grid).to_vec());
        let mut passes = vec![Pass { target: RenderTarget::Image, size: size(&grid), content }];
        self.develop(&grid, &mut passes);
        RenderRecipe { draws: draws.draws, maps: draws.maps, passes }
    }

    /// Pixels of this side over the whole picture.
    fn image_grid(&self, pixel: f32) -> PixelGrid {
        let [columns, rows] =
            self.field.pixels.map(|count| (count as f32 * self.field.pixel() / pixel).ceil() as usize);
        let corner = self.field.corner() + self.frame.weave * self.field.pixel();
        PixelGrid { corner, pixel, columns: columns.max(1), top: 0, rows: rows.max(1) }
    }

    /// Scale and bias of matter in targets.
    fn coding(&self) -> ([f32; 4], [f32; 4]) {
        match self.card.precision {
            Precision::Float => ([1.0; 4], [0.0; 4]),
            Precision::Bytes => (BYTES_SCALE, BYTES_BIAS),
        }
    }

    fn matter(&self, target: RenderTarget, grid: &PixelGrid) -> Pass {
        let dither = if self.card.precision == Precision::Bytes { 1.0 / 255.0 } else { 0.0 };
        let mut common = view(grid).to_vec();
        common.extend([grid.pixel, dither]);
        common.extend(self.coding().0);
        Pass { target, size: size(grid), content: PassContent::Draws(common) }
    }

    /// The surround wave, on its own coarse pixels.
    fn surround(&self, grid: &PixelGrid) -> [Pass; 4] {
        let (scale, bias) = self.coding();
        let weights = surround_wave::weights(grid.pixel);
        let reach = (weights.len() / 2 - 1) as f32;
        let spread = |side: [f32; 2]| {
            let mut uniforms = vec![side[0], side[1], reach];
            uniforms.extend(padded(&weights, 2 * LONGEST));
            uniforms
        };
        let (across, along) = ([1.0 / grid.columns as f32, 0.0], [0.0, 1.0 / grid.rows as f32]);
        let from = |target| vec![TextureInput::Target(target)];
        let wave = if self.mode.surround == Some(Surround::Emission) { Program::Emission } else { Program::Wave };
        [
            self.matter(RenderTarget::CoarseMatter, grid),
            screen(RenderTarget::Wave, grid, wave, [scale, bias].concat(), from(RenderTarget::CoarseMatter)),
            screen(RenderTarget::Spread, grid, Program::SpreadAcross, spread(across), from(RenderTarget::Wave)),
            screen(RenderTarget::Surround, grid, Program::SpreadAlong, spread(along), from(RenderTarget::Spread)),
        ]
    }

    /// From the image to the picture.
    fn develop(&self, grid: &PixelGrid, passes: &mut Vec<Pass>) {
        let sigma = if self.card.is_soft { self.frame.blur(self.mode) / grid.pixel } else { 0.0 };
        let sigma = smaller(sigma, MOST_SIGMA);
        let is_soft = self.card.is_soft;
        let weights = if is_soft { self.frame.kernel(sigma, grid.pixel / self.field.pixel()) } else { gaussian(0.0) };
        let half = &weights[weights.len() / 2..];
        let reach = (half.len() - 1) as f32;
        let mut image = RenderTarget::Image;
        if reach > 0.0 {
            let mut uniforms = vec![1.0 / grid.columns as f32, 0.0, reach];
            uniforms.extend(padded(half, LONGEST));
            let inputs = vec![TextureInput::Target(image)];
            passes.push(screen(RenderTarget::Softened, grid, Program::Soften, uniforms, inputs));
            image = RenderTarget::Softened;
        }
        let pixels = self.field.pixels.map(|count| count as usize);
        let mut uniforms = self.frame.uniforms(self.mode, pixels);
        // From the picture's pixels to the image, whose upper left corner is that of the picture.
        let scale = self.field.pixel() / grid.pixel;
        let share = [scale / grid.columns as f32, scale / grid.rows as f32];
        uniforms.extend([share[0], share[1], 1.0 - share[1] * pixels[1] as f32, 1.0 / grid.rows as f32, reach]);
        uniforms.extend(padded(half, LONGEST));
        let inputs = vec![TextureInput::Target(image), TextureInput::Noise];
        let film = screen(RenderTarget::Picture, grid, Program::Film, uniforms, inputs);
        passes.push(Pass { size: self.field.pixels, ..film });
    }
}

fn screen(
    target: RenderTarget,
    grid: &PixelGrid,
    program: Program,
    uniforms: Vec<f32>,
    inputs: Vec<TextureInput>,
) -> Pass {
    Pass { target, size: size(grid), content: PassContent::Screen { program, uniforms, inputs } }
}

fn size(grid: &PixelGrid) -> [u32; 2] {
    [grid.columns as u32, grid.rows as u32]
}

/// Middle of a grid, and clip units per micrometre.
fn view(grid: &PixelGrid) -> [f32; 4] {
    let (low, high) = grid.bounds();
    let (middle, scale) = (0.5 * (low + high), 2.0 / (high - low));
    [middle.x, middle.y, scale.x, scale.y]
}

fn padded(numbers: &[f32], count: usize) -> impl Iterator<Item = f32> {
    numbers.iter().copied().chain(std::iter::repeat(0.0)).take(count)
}
