//! Blood in a narrowed vessel: emitters let red cells in at the left end, an open side lets them out at the right one.

#[path = "../../../microsim-core/examples/blood/vessel.rs"]
mod vessel;

use super::Scene;

pub(crate) fn scene() -> Scene {
    Ok((vessel::vessel()?, Box::new(|_, _, _| Ok(()))))
}
