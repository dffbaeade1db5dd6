//! The whole state of a world: its digest, where two worlds differ, whether it is valid, and reading it.

pub(crate) mod difference;
pub(crate) mod digest;
#[cfg(feature = "snapshot")]
pub(crate) mod restore;
pub(crate) mod validate;
