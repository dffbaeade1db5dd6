//! The arithmetic that stepping relies on, over all kinds of numbers: it must give equal bits everywhere. And what it must
//! not use: lines that begin with `unportable` may differ between builds, and show that the comparison would see it.

use super::print;
use microsim_core::Rng;
use microsim_core::geometry::{ellipse, outline::excess_turning, unit_vector};
use microsim_core::glam::Vec2;
use std::hint::black_box;

type Unary = fn(f32) -> f32;
type Binary = fn(f32, f32) -> f32;

const PORTABLE: [(&str, Unary); 5] = [
    ("sqrt", f32::sqrt),
    ("floor, ceil, round, trunc", |a| a.floor() + a.ceil() * 3.0 + a.round() * 5.0 + a.trunc() * 7.0),
    ("unit_vector x", |a| unit_vector(a).x),
    ("unit_vector y", |a| unit_vector(a).y),
    ("to integers and back", |a| a as i32 as f32 + a as u8 as f32),
];

const PORTABLE_OF_TWO: [(&str, Binary); 5] = [
    ("+ - *", |a, b| (a + b) * (a - b)),
    ("a * b + c", |a, b| a * b + a),
    ("/", |a, b| a / b),
    ("ellipse", |a, b| ellipse(Vec2::new(a, b).abs(), 7).iter().map(|p| p.x * p.y).sum()),
    ("excess_turning", |a, b| excess_turning(&[Vec2::ZERO, Vec2::new(a, 1.0), Vec2::new(2.0, b), Vec2::new(b, a)])),
];

const UNPORTABLE: [(&str, Unary); 6] = [
    ("sin", f32::sin),
    ("tan", f32::tan),
    ("atan", f32::atan),
    ("exp", f32::exp),
    ("ln", f32::ln),
    ("powi", |a| a.powi(7)),
];

const UNPORTABLE_OF_TWO: [(&str, Binary); 5] = [
    ("min", |a, b| 1.0 / a.min(b)),
    ("max", |a, b| 1.0 / a.max(b)),
    ("powf", f32::powf),
    ("hypot", f32::hypot),
    ("atan2", f32::atan2),
];

pub(crate) fn run() {
    let numbers = numbers();
    let of = |function: &Unary| digest(numbers.iter().map(|&a| function(black_box(a))));
    let of_two = |function: &Binary| {
        let pairs = numbers.iter().flat_map(|&a| numbers[..64].iter().map(move |&b| (a, b)));
        digest(pairs.map(|(a, b)| function(black_box(a), black_box(b))))
    };
    PORTABLE.iter().for_each(|(name, function)| print(&format!("arithmetic: {name} {:016x}", of(function))));
    PORTABLE_OF_TWO.iter().for_each(|(name, function)| print(&format!("arithmetic: {name} {:016x}", of_two(function))));
    UNPORTABLE.iter().for_each(|(name, function)| print(&format!("unportable: {name} {:016x}", of(function))));
    UNPORTABLE_OF_TWO
        .iter()
        .for_each(|(name, function)| print(&format!("unportable: {name} {:016x}", of_two(function))));
}

/// The special ones, then random ones of all magnitudes, then such as occur.
fn numbers() -> Vec<f32> {
    let mut numbers = vec![0.0, -0.0, 1.0, -1.0, f32::MIN_POSITIVE, 1e-45, -1e-40, f32::MAX, f32::MIN];
    numbers.extend([f32::INFINITY, f32::NEG_INFINITY, f32::NAN, 0.5, 2.5, -3.5, 8_388_607.5, 16_777_217.0, 1e20]);
    let mut rng = Rng::new(2018, 5);
    numbers.extend((0..1000).map(|_| f32::from_bits(rng.next_u32())));
    numbers.extend((0..1000).map(|_| rng.range(-200.0, 200.0)));
    numbers
}

/// FNV-1a of the bits; every NaN is the same.
fn digest(values: impl Iterator<Item = f32>) -> u64 {
    let bits = values.map(|value| if value.is_nan() { 0x7fc0_0000 } else { value.to_bits() });
    let bytes = bits.flat_map(u32::to_le_bytes);
    bytes.fold(0xcbf2_9ce4_8422_2325, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x100_0000_01b3))
}
