//! Compiles the engines that are not Rust: each with its shim of `native/`, as its makers release it, assertions off.
//!
//! The sources come out of crates that cargo has in its registry; `cargo metadata` fetches them and knows where they are.

use cargo_metadata::MetadataCommand;
use cc::Build;
use std::path::{Path, PathBuf};

fn main() {
    println!("cargo:rerun-if-changed=native");
    let sources = Sources::locate();
    let has_avx2 = has_avx2();
    box2d(&sources.of("boxdd-sys").join("third-party/box2d"), has_avx2);
    liquidfun(&sources.of("liquidfun").join("liquidfun-cpp"));
    chipmunk();
}

/// Whether what is built here runs here, on a processor with AVX2.
fn has_avx2() -> bool {
    let is_native = std::env::var("HOST") == std::env::var("TARGET");
    #[cfg(target_arch = "x86_64")]
    return is_native && is_x86_feature_detected!("avx2");
    #[cfg(not(target_arch = "x86_64"))]
    return is_native && false;
}

/// Box2D 3: eight contacts at a time with AVX2, its option for speed, where there is AVX2.
fn box2d(root: &Path, has_avx2: bool) {
    let mut build = Build::new();
    build.std("c17").define("_POSIX_C_SOURCE", "199309L").include(root.join("include"));
    if has_avx2 {
        build.define("BOX2D_AVX2", None).flag("-mavx2");
    }
    released(&mut build).files(files(&root.join("src"), "c")).file("native/box2d.c").compile("box2d_peer");
    println!("cargo:rustc-link-lib=pthread");
    println!("cargo:rustc-link-lib=m");
}

/// LiquidFun 1.1 (Box2D 2.3 with particles).
fn liquidfun(root: &Path) {
    let mut build = Build::new();
    build.cpp(true).std("c++11").include(root);
    let sources = ["Collision", "Collision/Shapes", "Common", "Dynamics", "Dynamics/Contacts", "Dynamics/Joints"];
    for folder in sources.into_iter().chain(["Particle", "Rope"]) {
        build.files(files(&root.join("Box2D").join(folder), "cpp"));
    }
    released(&mut build).file("native/liquidfun.cpp").compile("liquidfun_peer");
}

/// Chipmunk 7, only where its headers are installed (Debian: `libchipmunk-dev`).
fn chipmunk() {
    let mut build = Build::new();
    released(&mut build).file("native/chipmunk.c").cargo_warnings(false);
    if build.try_compile("chipmunk_peer").is_ok() {
        println!("cargo:rustc-link-lib=chipmunk");
        println!("cargo:rustc-cfg=has_chipmunk");
    }
}

fn released(build: &mut Build) -> &mut Build {
    build.opt_level(3).define("NDEBUG", None).include("native").warnings(false)
}

/// The files of a folder with this extension, in a stable order.
fn files(folder: &Path, extension: &str) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
    let paths = entries.map(|entry| entry.expect("the folder can be read").path());
    let mut files: Vec<_> = paths.filter(|path| path.extension().is_some_and(|e| e == extension)).collect();
    files.sort();
    files
}

/// Where cargo keeps the packages of the lock file.
struct Sources(cargo_metadata::Metadata);

impl Sources {
    fn locate() -> Self {
        let metadata = MetadataCommand::new().other_options(["--locked".to_owned()]).exec();
        Self(metadata.expect("cargo metadata lists the packages"))
    }

    fn of(&self, name: &str) -> PathBuf {
        let package = self.0.packages.iter().find(|package| package.name.as_str() == name);
        let package = package.unwrap_or_else(|| panic!("{name} is not in the lock file"));
        package.manifest_path.parent().expect("a manifest lies in a folder").into()
    }
}
