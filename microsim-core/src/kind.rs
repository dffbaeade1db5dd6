//! What kinds of organisms there are, as a name for events and output.

use crate::id::TemplateId;
use serde::{Deserialize, Serialize};

/// Declares [`Kind`]. A macro, because nothing else writes a variant, its name and its documentation in one line.
macro_rules! kinds {
    ($($variant:ident = $number:literal, $name:literal, $words:literal;)*) => {
        /// What an organism is. Serialised as a number: [`u8::from`] plus 256 times the template of a custom one.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
        #[serde(into = "u64", try_from = "u64")]
        #[non_exhaustive]
        pub enum Kind {
            $(#[doc = $words] $variant,)*
            /// Spawned from this template, which the library does not know.
            Custom(TemplateId),
        }

        impl Kind {
            /// Name in output.
            #[must_use]
            pub fn name(self) -> &'static str {
                match self {
                    $(Self::$variant => $name,)*
                    Self::Custom(_) => "custom",
                }
            }
        }

        /// The number of a kind, the same for all templates.
        impl From<Kind> for u8 {
            fn from(kind: Kind) -> Self {
                match kind {
                    $(Kind::$variant => $number,)*
                    Kind::Custom(_) => CUSTOM,
                }
            }
        }

        impl TryFrom<u64> for Kind {
            type Error = &'static str;

            fn try_from(number: u64) -> Result<Self, Self::Error> {
                let template = u32::try_from(number / 256);
                match (number, template) {
                    $(($number, _) => Ok(Self::$variant),)*
                    (_, Ok(template)) if number % 256 == u64::from(CUSTOM) => Ok(Self::Custom(TemplateId(template))),
                    _ => Err("no kind of organism has this number"),
                }
            }
        }
    };
}

/// Number of bodies of templates.
const CUSTOM: u8 = 6;

// Digests and snapshots hold the number: a new kind takes the next one.
kinds! {
    RigidCell = 0, "rigid_cell", "A soft body that keeps its shape, like a paramecium.";
    AmoeboidCell = 1, "amoeboid_cell", "A membrane filled with cytoplasm, like a neutrophil.";
    Platelet = 2, "platelet", "A soft obstacle that returns to its anchor.";
    Agar = 3, "agar", "A small disc to be eaten.";
    Probe = 4, "probe", "A heavy disc that an experimenter drives.";
    FluidBlock = 5, "fluid_block", "Fluid on its own.";
    RedCell = 7, "red_cell", "A red blood cell: soft, in everybody's way.";
    Coccus = 8, "coccus", "A small round bacterium.";
    Bacillus = 9, "bacillus", "A small rod-shaped bacterium.";
}

impl From<Kind> for u64 {
    fn from(kind: Kind) -> Self {
        let template = if let Kind::Custom(TemplateId(template)) = kind { template } else { 0 };
        Self::from(u8::from(kind)) + 256 * Self::from(template)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_kind_is_written_as_its_number_and_read_back() {
        let templates = [0, 1, 77, u32::MAX].map(|template| u64::from(Kind::Custom(TemplateId(template))));
        for number in (0..2000).chain(templates) {
            let kind = Kind::try_from(number);
            assert!(kind.is_err() || u64::from(kind.unwrap()) == number);
        }
        let kind = Kind::Bacillus;
        assert_eq!((u8::from(kind), Kind::try_from(9), kind.name()), (9, Ok(kind), "bacillus"));
        let custom = Kind::Custom(TemplateId(u32::MAX));
        assert_eq!((u8::from(custom), Kind::try_from(templates[3]), custom.name()), (6, Ok(custom), "custom"));
        for number in [254, 255, 256 + 7, templates[3] + 256, u64::MAX] {
            assert!(Kind::try_from(number).is_err(), "{number}");
        }
    }
}
