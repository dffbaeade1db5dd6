//! Types of amoeba: how each crawls, as data.

use super::params::PseudopodParams;
use serde::{Deserialize, Serialize};

/// How an amoeboid cell crawls.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Crawl {
    /// Front and rear of the membrane drive it and the wings follow, round as it is (thesis, 3.1.2).
    #[default]
    FrontAndRear,
    /// By pseudopods, as [`PseudopodParams::KERATOCYTE`] has them.
    Keratocyte,
    /// By pseudopods, as [`PseudopodParams::NEUTROPHIL`] has them.
    Neutrophil,
    /// By pseudopods, as [`PseudopodParams::DICTYOSTELIUM`] has them.
    Dictyostelium,
    /// By pseudopods, as [`PseudopodParams::AMOEBA_PROTEUS`] has them.
    AmoebaProteus,
}

impl Crawl {
    /// All of them.
    pub(crate) const ALL: [Self; 5] =
        [Self::FrontAndRear, Self::Keratocyte, Self::Neutrophil, Self::Dictyostelium, Self::AmoebaProteus];
    /// Their names in scenario files.
    pub(crate) const WORDS: [&'static str; 5] =
        ["front_and_rear", "keratocyte", "neutrophil", "dictyostelium", "amoeba_proteus"];

    /// Its pseudopods, if it has any.
    #[must_use]
    pub fn pseudopods(self) -> Option<PseudopodParams> {
        match self {
            Self::FrontAndRear => None,
            Self::Keratocyte => Some(PseudopodParams::KERATOCYTE),
            Self::Neutrophil => Some(PseudopodParams::NEUTROPHIL),
            Self::Dictyostelium => Some(PseudopodParams::DICTYOSTELIUM),
            Self::AmoebaProteus => Some(PseudopodParams::AMOEBA_PROTEUS),
        }
    }
}

impl PseudopodParams {
    /// A fish keratocyte: one broad lamellipodium that does not end; it glides and hardly changes its shape (Keren et al. 2008,
    /// Nature 453, 475).
    pub const KERATOCYTE: Self = Self {
        start_rate: 12.0,
        life: 100.0,
        width: 0.3,
        coverage: 1.0,
        split_share: 0.0,
        goal_bias: 0.4,
        tip_speed: 1.05,
        stiffness: 0.5,
        slack: 0.15,
        spreading: 0.0,
        ..Self::NEUTROPHIL
    };

    /// A neutrophil: a fan of one or two short pseudopods, the second strongly inhibited by the first (Van Haastert 2020,
    /// "Unified control of amoeboid pseudopod extension").
    pub const NEUTROPHIL: Self = Self {
        start_rate: 12.0,
        life: 0.33,
        width: 0.14,
        coverage: 0.35,
        split_share: 0.7,
        split_angle: 57.0,
        split_spread: 14.0,
        alternation: 0.9,
        goal_bias: 0.03,
        tip_speed: 3.0,
        stiffness: 0.15,
        slack: 0.33,
        spreading: 1.0,
    };

    /// Dictyostelium discoideum: narrow pseudopods that split at some 60 degrees, mostly on alternating sides (Bosgraaf and
    /// Van Haastert 2009, PLoS ONE 4, e5253).
    pub const DICTYOSTELIUM: Self = Self {
        start_rate: 13.0,
        life: 0.35,
        width: 0.12,
        coverage: 0.4,
        split_share: 0.85,
        goal_bias: 0.03,
        tip_speed: 2.5,
        stiffness: 0.1,
        slack: 0.4,
        ..Self::NEUTROPHIL
    };

    /// Amoeba proteus: a few long lobopodia that live on while others start anywhere (Mast 1926, J. Morphol. 41, 347).
    pub const AMOEBA_PROTEUS: Self = Self {
        start_rate: 5.0,
        life: 0.8,
        width: 0.1,
        coverage: 0.3,
        split_share: 0.4,
        goal_bias: 0.05,
        tip_speed: 2.2,
        stiffness: 0.12,
        slack: 0.5,
        ..Self::NEUTROPHIL
    };
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_type_has_its_word_and_sound_pseudopods_of_its_own() {
        for (k, crawl) in Crawl::ALL.into_iter().enumerate() {
            assert_eq!(crawl as usize, k, "the order of the words");
            let Some(params) = crawl.pseudopods() else { continue };
            params.validate().unwrap();
            assert!(Crawl::ALL[..k].iter().all(|other| other.pseudopods() != Some(params)), "{crawl:?}");
            assert_eq!(Crawl::WORDS[k].replace('_', ""), format!("{crawl:?}").to_lowercase());
        }
    }
}
