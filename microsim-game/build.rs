//! Writes the font without what nothing here reads: letters that are never written, instructions for coarse screens and tables of
//! layout. Nine tenths of it.
//! Makes tables of the texts in all languages. Gives the program for Windows its icon and version.

#[path = "words/compile.rs"]
mod compile;
#[path = "src/ui/letters.rs"]
mod letters;

use std::collections::{BTreeMap, BTreeSet};
use std::env;
use std::path::Path;
use std::process::Command;

/// Tables that are kept: letters, their outlines and widths, and whose work they are.
const KEPT: [&[u8; 4]; 9] = [b"cmap", b"glyf", b"head", b"hhea", b"hmtx", b"loca", b"maxp", b"name", b"OS/2"];

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::rerun-if-changed=src/ui/letters.rs");
    println!("cargo::rerun-if-changed=words/compile.rs");
    let font = epaint_default_fonts::UBUNTU_LIGHT;
    let small = smaller(font).unwrap_or_else(|| font.to_vec());
    let out = env::var_os("OUT_DIR").expect("cargo names a folder");
    std::fs::write(Path::new(&out).join("font.ttf"), small).expect("the folder can be written to");
    compile::compile(Path::new(&out));
    if env::var("TARGET").is_ok_and(|target| target == "x86_64-pc-windows-gnu") {
        add_windows_resources(Path::new(&out));
    }
}

/// Icon and version as resources, by MinGW; where that is not installed, the program has neither.
fn add_windows_resources(out: &Path) {
    let (script, object) = (out.join("resources.rc"), out.join("resources.o"));
    std::fs::write(&script, resource_script()).expect("the folder can be written to");
    println!("cargo::rerun-if-changed=packaging/microsim.ico");
    match Command::new("x86_64-w64-mingw32-windres").arg(script).arg(&object).status() {
        Ok(status) if status.success() => println!("cargo::rustc-link-arg-bins={}", object.display()),
        _ => println!("cargo::warning=no windres: the program has no icon"),
    }
}

/// What windres reads.
fn resource_script() -> String {
    let part = |name: &str| env::var(format!("CARGO_PKG_VERSION{name}")).expect("cargo gives the version");
    let numbers = [part("_MAJOR"), part("_MINOR"), part("_PATCH"), "0".into()].join(",");
    format!(
        r#"1 ICON "packaging/microsim.ico"
1 VERSIONINFO FILEVERSION {numbers} PRODUCTVERSION {numbers}
BEGIN
    BLOCK "StringFileInfo" BEGIN BLOCK "040904b0" BEGIN
        VALUE "FileDescription", "microsim"
        VALUE "FileVersion", "{version}"
        VALUE "ProductName", "microsim"
        VALUE "ProductVersion", "{version}"
    END END
    BLOCK "VarFileInfo" BEGIN VALUE "Translation", 0x409, 1200 END
END
"#,
        version = part(""),
    )
}

/// A TrueType font with nothing but the letters that are written, and without instructions; `None` if it is not built as the
/// format's specification says (OpenType 1.9).
fn smaller(font: &[u8]) -> Option<Vec<u8>> {
    let mut tables: BTreeMap<&[u8], Vec<u8>> = BTreeMap::new();
    for k in 0..usize::from(u16_at(font, 4)?) {
        let entry = font.get(12 + 16 * k..28 + 16 * k)?;
        let (tag, from) = (&entry[..4], u32_at(entry, 8)? as usize);
        if KEPT.iter().any(|kept| kept[..] == *tag) {
            tables.insert(tag, font.get(from..from + u32_at(entry, 12)? as usize)?.to_vec());
        }
    }
    let has_long_offsets = u16_at(&tables[&b"head"[..]], 50)? == 1;
    let (old, places) = (tables.get(&b"glyf"[..])?, tables.get(&b"loca"[..])?);
    let place =
        |k| if has_long_offsets { Some(u32_at(places, 4 * k)?) } else { Some(2 * u32::from(u16_at(places, 2 * k)?)) };
    let glyph_of = |k| old.get(place(k)? as usize..place(k + 1)? as usize);
    let wanted = wanted(font, glyph_of)?;
    let (mut glyphs, mut offsets) = (Vec::new(), vec![0u32]);
    for k in 0..usize::from(u16_at(&tables[&b"maxp"[..]], 4)?) {
        if wanted.contains(&k) {
            glyphs.extend(without_instructions(glyph_of(k)?)?);
        }
        glyphs.resize(glyphs.len().next_multiple_of(4), 0);
        offsets.push(glyphs.len() as u32);
    }
    tables.insert(b"loca", offsets.iter().flat_map(|at| at.to_be_bytes()).collect());
    tables.insert(b"glyf", glyphs);
    tables.get_mut(&b"head"[..])?.splice(50..52, [0, 1]);
    Some(file(&font[..4], &tables))
}

/// Numbers of the glyphs of all letters, and of those that they are composed of.
fn wanted<'a>(font: &[u8], glyph_of: impl Fn(usize) -> Option<&'a [u8]>) -> Option<BTreeSet<usize>> {
    let face = ttf_parser::Face::parse(font, 0).ok()?;
    let mut open: Vec<usize> =
        letters::letters().filter_map(|letter| Some(face.glyph_index(letter)?.0.into())).collect();
    let mut found = BTreeSet::new();
    while let Some(k) = open.pop() {
        if found.insert(k) {
            open.extend(parts(glyph_of(k)?)?);
        }
    }
    Some(found)
}

/// Numbers of the glyphs that a glyph is composed of.
fn parts(glyph: &[u8]) -> Option<Vec<usize>> {
    const HAS_WORDS: u16 = 1;
    const HAS_SCALE: u16 = 8;
    const HAS_MORE: u16 = 0x20;
    const HAS_TWO_SCALES: u16 = 0x40;
    const HAS_MATRIX: u16 = 0x80;
    let mut found = Vec::new();
    if u16_at(glyph, 0).map_or(0, u16::cast_signed) >= 0 {
        return Some(found);
    }
    let mut at = 10;
    loop {
        let flags = u16_at(glyph, at)?;
        found.push(u16_at(glyph, at + 2)?.into());
        let length = |flag, length| if flags & flag != 0 { length } else { 0 };
        at += 6 + length(HAS_WORDS, 2) + length(HAS_SCALE, 2) + length(HAS_TWO_SCALES, 4) + length(HAS_MATRIX, 8);
        if flags & HAS_MORE == 0 {
            return Some(found);
        }
    }
}

/// A glyph without its instructions; one that is composed of others has few, and stays as it is.
fn without_instructions(old: &[u8]) -> Option<Vec<u8>> {
    let contours = u16_at(old, 0).map_or(0, u16::cast_signed);
    if contours <= 0 {
        return Some(old.to_vec());
    }
    let at = 10 + 2 * contours.cast_unsigned() as usize;
    let rest = at + 2 + usize::from(u16_at(old, at)?);
    Some([&old[..at], &[0, 0], old.get(rest..)?].concat())
}

/// A file of these tables.
fn file(kind: &[u8], tables: &BTreeMap<&[u8], Vec<u8>>) -> Vec<u8> {
    let count = tables.len() as u16;
    let range = 16 << count.ilog2();
    let mut head = kind.to_vec();
    head.extend([count, range, count.ilog2() as u16, 16 * count - range].iter().flat_map(|word| word.to_be_bytes()));
    let (mut body, start) = (Vec::new(), 12 + 16 * tables.len());
    for (tag, table) in tables {
        let padded = table.chunks(4).map(|part| [0, 1, 2, 3].map(|k| part.get(k).copied().unwrap_or(0)));
        let sum = padded.map(u32::from_be_bytes).fold(0, u32::wrapping_add);
        head.extend_from_slice(tag);
        head.extend([sum, (start + body.len()) as u32, table.len() as u32].iter().flat_map(|word| word.to_be_bytes()));
        body.extend_from_slice(table);
        body.resize(body.len().next_multiple_of(4), 0);
    }
    [head, body].concat()
}

fn u16_at(bytes: &[u8], at: usize) -> Option<u16> {
    Some(u16::from_be_bytes(bytes.get(at..at + 2)?.try_into().ok()?))
}

fn u32_at(bytes: &[u8], at: usize) -> Option<u32> {
    Some(u32::from_be_bytes(bytes.get(at..at + 4)?.try_into().ok()?))
}
