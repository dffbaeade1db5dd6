//! Ways in which an amoeboid cell crawls, one file each.

pub(crate) mod front_and_rear;
pub(crate) mod pseudopods;
