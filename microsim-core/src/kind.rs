//! What kinds of organisms there are, as a name for events and output.

use serde::{Deserialize, Serialize};

/// Declares [`Kind`]. A macro, because nothing else writes a variant, its name and its documentation in one line.
macro_rules! kinds {
    ($($variant:ident = $number:literal, $name:literal, $words:literal;)*) => {
        /// What an organism is.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
        #[serde(into = "u8", try_from = "u8")]
        #[non_exhaustive]
        #[repr(u8)]
        pub enum Kind {
            $(#[doc = $words] $variant = $number,)*
        }

        impl Kind {
            /// Name in output.
            #[must_use]
            pub fn name(self) -> &'static str {
                match self {
                    $(Self::$variant => $name,)*
                }
            }
        }

        impl TryFrom<u8> for Kind {
            type Error = &'static str;

            fn try_from(number: u8) -> Result<Self, Self::Error> {
                match number {
                    $($number => Ok(Self::$variant),)*
                    _ => Err("no kind of organism has this number"),
                }
            }
        }
    };
}

// Digests and snapshots hold the number: a new kind takes the next one.
kinds! {
    RigidCell = 0, "rigid_cell", "A soft body that keeps its shape, like a paramecium.";
    AmoeboidCell = 1, "amoeboid_cell", "A membrane filled with cytoplasm, like a neutrophil.";
    Platelet = 2, "platelet", "A soft obstacle that returns to its anchor.";
    Agar = 3, "agar", "A small disc to be eaten.";
    Probe = 4, "probe", "A heavy disc that an experimenter drives.";
    FluidBlock = 5, "fluid_block", "Fluid on its own.";
    Custom = 6, "custom", "Spawned from a template that the library does not know.";
    RedCell = 7, "red_cell", "A red blood cell: soft, in everybody's way.";
    Coccus = 8, "coccus", "A small round bacterium.";
    Bacillus = 9, "bacillus", "A small rod-shaped bacterium.";
}

impl From<Kind> for u8 {
    fn from(kind: Kind) -> Self {
        kind as Self
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_kind_is_written_as_its_number_and_read_back() {
        for number in 0..=u8::MAX {
            let kind = Kind::try_from(number);
            assert!(kind.is_err() || u8::from(kind.unwrap()) == number);
        }
        assert_eq!(
            (u8::from(Kind::Bacillus), Kind::try_from(9), Kind::Bacillus.name()),
            (9, Ok(Kind::Bacillus), "bacillus")
        );
        assert!(Kind::try_from(u8::MAX).is_err());
    }
}
