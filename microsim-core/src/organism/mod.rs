//! Organisms, one file each: a spec as plain data, the [`Blueprint`] that it amounts to, its fields in scenario files and
//! its look. Besides, the living organism and the table of all that live.

pub(crate) mod agar;
pub(crate) mod amoeboid_cell;
pub(crate) mod bacillus;
mod blueprint;
pub(crate) mod coccus;
pub(crate) mod fluid_block;
mod living;
mod placement;
pub(crate) mod platelet;
pub(crate) mod probe;
pub(crate) mod red_cell;
pub(crate) mod rigid_cell;
pub(crate) mod ring_surgery;
mod spec;
mod storage;
pub(crate) mod table;

pub(crate) use amoeboid_cell::{LEAST_CYTOPLASM, MAX_NODES};
pub(crate) use blueprint::{Blueprint, FluidPlan};
pub(crate) use living::{MAX_SPEED, MOST, MOST_WANTED_NODES, Organism, Phagosome, at_most};
pub use placement::Placement;
pub(crate) use placement::{FARTHEST, TOUCHING};
pub use spec::SpecTable;
pub(crate) use storage::Storage;

use crate::kind::Kind;
use crate::look::Look;
use serde::{Deserialize, Serialize};
use spec::Spec;

/// Declares [`OrganismSpec`]. A macro, because nothing else writes a variant, its conversion and its arms in one line.
macro_rules! organisms {
    ($($kind:ident: $spec:ty;)*) => {
        /// Any organism, as plain data.
        #[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
        #[non_exhaustive]
        pub enum OrganismSpec {
            $(#[doc = concat!("See [`", stringify!($spec), "`].")] $kind($spec),)*
        }

        $(impl From<$spec> for OrganismSpec {
            fn from(spec: $spec) -> Self {
                Self::$kind(spec)
            }
        })*

        impl OrganismSpec {
            /// One of each kind, with default values.
            #[must_use]
            pub fn defaults() -> Vec<Self> {
                vec![$(Self::$kind(<$spec>::default())),*]
            }

            /// Its kind.
            #[must_use]
            pub fn kind(&self) -> Kind {
                match self {
                    $(Self::$kind(_) => Kind::$kind,)*
                }
            }

            fn spec(&self) -> &dyn Spec {
                match self {
                    $(Self::$kind(spec) => spec,)*
                }
            }

            fn spec_mut(&mut self) -> &mut dyn Spec {
                match self {
                    $(Self::$kind(spec) => spec,)*
                }
            }
        }

        /// How organisms of a kind look.
        pub(crate) fn look(kind: Kind) -> Look {
            match kind {
                $(Kind::$kind => <$spec>::default().look(),)*
                Kind::Custom(_) => Look::PLAIN,
            }
        }
    };
}

organisms! {
    RigidCell: rigid_cell::RigidCellSpec;
    AmoeboidCell: amoeboid_cell::AmoeboidCellSpec;
    Platelet: platelet::PlateletSpec;
    Agar: agar::AgarSpec;
    Probe: probe::ProbeSpec;
    FluidBlock: fluid_block::FluidBlockSpec;
    RedCell: red_cell::RedCellSpec;
    Coccus: coccus::CoccusSpec;
    Bacillus: bacillus::BacillusSpec;
}
