//! Crops of pictures in files, and writing them.

use crate::{Crop, Outcome, SIDE, pick};
use microsim_core::Rng;
use std::fs::File;
use std::io::{BufReader, BufWriter};
use std::path::{Path, PathBuf};

/// The PNG files of a folder, in their order.
pub(crate) fn files_in(folder: &Path) -> Outcome<Vec<PathBuf>> {
    let mut files: Vec<PathBuf> = Vec::new();
    for entry in std::fs::read_dir(folder)? {
        let path = entry?.path();
        if path.extension().is_some_and(|extension| extension == "png") {
            files.push(path);
        }
    }
    files.sort();
    Ok(files)
}

/// Random crops of files that are large enough; each file is taken about equally often.
pub(crate) fn references(mut files: Vec<PathBuf>, count: usize, rng: &mut Rng) -> Outcome<Vec<Crop>> {
    let mut crops = Vec::new();
    while crops.len() < count && !files.is_empty() {
        let file = pick(rng, files.len());
        let (pixels, [width, height]) = load(&files[file])?;
        if width < SIDE || height < SIDE {
            files.remove(file);
            continue;
        }
        let [left, top] = [pick(rng, width - SIDE + 1), pick(rng, height - SIDE + 1)];
        let row = |y: usize| ((top + y) * width + left) * 3..((top + y) * width + left + SIDE) * 3;
        let bytes = (0..SIDE).flat_map(|y| pixels[row(y)].to_vec()).collect();
        crops.push(Crop { bytes, origin: format!("real {} {left} {top}", files[file].display()) });
    }
    if crops.len() < count {
        return Err(format!("no PNG file of at least {SIDE} x {SIDE} pixels").into());
    }
    Ok(crops)
}

/// Red, green and blue of a PNG file, and its size.
fn load(path: &Path) -> Outcome<(Vec<u8>, [usize; 2])> {
    let mut decoder = png::Decoder::new(BufReader::new(File::open(path)?));
    decoder.set_transformations(png::Transformations::normalize_to_color8());
    let mut reader = decoder.read_info()?;
    let mut bytes = vec![0; reader.output_buffer_size().ok_or("too large")?];
    let info = reader.next_frame(&mut bytes)?;
    let channels = info.color_type.samples();
    let pixels = bytes[..info.buffer_size()].chunks_exact(channels);
    let rgb = pixels.flat_map(|pixel| if channels < 3 { [pixel[0]; 3] } else { [pixel[0], pixel[1], pixel[2]] });
    Ok((rgb.collect(), [info.width as usize, info.height as usize]))
}

pub(crate) fn save(path: &Path, bytes: &[u8], [width, height]: [usize; 2]) -> Outcome<()> {
    let mut encoder = png::Encoder::new(BufWriter::new(File::create(path)?), width as u32, height as u32);
    encoder.set_color(png::ColorType::Rgb);
    encoder.write_header()?.write_image_data(bytes)?;
    Ok(())
}
