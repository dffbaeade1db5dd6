//! No files and no folders of the game use each other in a circle.

#[path = "../../microsim-core/tests/common/sources.rs"]
#[allow(dead_code, reason = "the core's tests use all of it")]
mod sources;

use std::path::Path;

#[test]
fn no_files_and_no_folders_use_each_other_in_a_circle() {
    let sources = sources::sources(&Path::new(env!("CARGO_MANIFEST_DIR")).join("src"));
    let found = sources::circles(&sources);
    assert!(found.is_empty(), "circles: {found:#?}");
    let found = sources::circles_of_modules(&sources);
    assert!(found.is_empty(), "circles of modules: {found:#?}");
}
