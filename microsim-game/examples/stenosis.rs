//! Blood in a narrowed vessel: `cargo run --release -p microsim-game --example stenosis [FILE.png]`.
//!
//! Emitters let red cells in at the left end, an open side lets them out at the right one.

mod toy;
#[path = "../../microsim-core/examples/blood/vessel.rs"]
mod vessel;

use microsim_core::prelude::*;

fn main() -> Result<(), Error> {
    toy::run("stenosis", vessel::vessel()?, |_, _| Ok(()));
    Ok(())
}
