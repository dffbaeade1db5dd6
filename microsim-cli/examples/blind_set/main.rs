//! A blind test of the microscope: crops of real micrographs among crops of ours, for somebody who is to tell them apart.
//!
//! `cargo run --release -p microsim-cli --example blind_set COUNT SEED FOLDER [REFERENCES]` writes `COUNT` crops of ours and
//! as many of the PNG files in `REFERENCES`, in one order that the seed decides, as `01.png` and so on, and all of them as
//! `sheet.png`. `key.txt` says which is which. Scenario, its seed, time and view are drawn at random, and so are the optics: among
//! ours they are as frequent as among the references, whose files are named after theirs. All crops have the same size, are of
//! larger fields, grey ones of which have the same share of black and white pixels, and went through the same lossy coding.

mod crop;
mod draw;

use microsim_core::Rng;
use microsim_core::microscope::coding::code;
use std::ffi::OsStr;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

/// Side of a crop, pixels.
const SIDE: usize = 256;
/// Quality of the coding that all crops go through.
const QUALITY: u8 = 75;
/// Crops in a row of the sheet, and pixels between them.
const COLUMNS: usize = 6;
const GAP: usize = 4;

type Outcome<T> = Result<T, Box<dyn std::error::Error>>;

/// A square picture: three bytes for each pixel.
struct Crop {
    bytes: Vec<u8>,
    /// Where it is from.
    origin: String,
}

fn main() -> Outcome<()> {
    let usage = "usage: blind_set COUNT SEED FOLDER [REFERENCES]";
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [count, seed, folder, references @ ..] = &arguments[..] else { return Err(usage.into()) };
    let (count, folder) = (count.parse()?, PathBuf::from(folder));
    let mut rng = Rng::new(seed.parse()?, 0);
    let mut crops = Vec::new();
    let files = match references {
        [] => Vec::new(),
        [references] => crop::files_in(Path::new(references))?,
        _ => return Err(usage.into()),
    };
    for _ in 0..count {
        let like = files.get(pick(&mut rng, files.len())).and_then(|file| file.file_name()).and_then(OsStr::to_str);
        crops.push(draw::ours(like.and_then(draw::optics_of), &mut rng)?);
    }
    if !references.is_empty() {
        crops.extend(crop::references(files, count, &mut rng)?);
    }
    for last in (1..crops.len()).rev() {
        crops.swap(last, pick(&mut rng, last + 1));
    }
    crops.iter_mut().for_each(|crop| code(&mut crop.bytes, SIDE, QUALITY));
    write(&folder, &crops)
}

/// A number below `count`.
fn pick(rng: &mut Rng, count: usize) -> usize {
    rng.next_u32() as usize % count.max(1)
}

fn write(folder: &Path, crops: &[Crop]) -> Outcome<()> {
    std::fs::create_dir_all(folder)?;
    let mut key = String::new();
    let rows = crops.len().div_ceil(COLUMNS);
    let (width, height) = (COLUMNS * (SIDE + GAP), rows * (SIDE + GAP));
    let mut sheet = vec![255; width * height * 3];
    for (k, crop) in crops.iter().enumerate() {
        writeln!(key, "{:02} {}", k + 1, crop.origin)?;
        crop::save(&folder.join(format!("{:02}.png", k + 1)), &crop.bytes, [SIDE, SIDE])?;
        for (y, row) in crop.bytes.chunks_exact(SIDE * 3).enumerate() {
            let start = corner_at(k, width, y);
            sheet[start..start + row.len()].copy_from_slice(row);
        }
    }
    std::fs::write(folder.join("key.txt"), key)?;
    crop::save(&folder.join("sheet.png"), &sheet, [width, height])
}

/// Where row `y` of crop `k` begins on the sheet.
fn corner_at(k: usize, width: usize, y: usize) -> usize {
    let (row, column) = (k / COLUMNS * (SIDE + GAP) + y, k % COLUMNS * (SIDE + GAP));
    (row * width + column) * 3
}
