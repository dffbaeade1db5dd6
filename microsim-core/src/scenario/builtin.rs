//! The scenarios that come with the library.

use crate::bare_text::bare_text;

/// The text of a file, as it is where people are told what fields mean.
macro_rules! text {
    ($file:literal) => {
        if cfg!(feature = "schema") { include_str!($file) } else { bare_text!($file, "#") }
    };
}

/// A scenario that comes with the library.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Builtin {
    /// Its name.
    pub name: &'static str,
    /// What it shows, in one line.
    pub summary: &'static str,
    /// The file; for WebAssembly without comments where the feature `schema` is off.
    pub text: &'static str,
}

static BUILTINS: [Builtin; 16] = [
    Builtin {
        name: "game",
        summary: "90 seconds to eat: agar first, then paramecia, larger and larger ones",
        text: text!("../../scenarios/game.toml"),
    },
    Builtin {
        name: "demo",
        summary: "hunting cells among platelets: everything at once, to play with (thesis, Fig. 3.12)",
        text: text!("../../scenarios/demo.toml"),
    },
    Builtin {
        name: "platelets",
        summary: "a probe sweeps through a dense field of platelets, any number of them (thesis, Table 4.1)",
        text: text!("../../scenarios/platelets.toml"),
    },
    Builtin {
        name: "crowd",
        summary: "amoeboid cells wander about and jostle each other, any number of them",
        text: text!("../../scenarios/crowd.toml"),
    },
    Builtin {
        name: "dam-break",
        summary: "a column of fluid collapses under gravity",
        text: text!("../../scenarios/dam-break.toml"),
    },
    Builtin { name: "empty", summary: "an empty room, to start from", text: text!("../../scenarios/empty.toml") },
    Builtin {
        name: "absorb-agar",
        summary: "a cell hunts down agar among platelets and takes it in",
        text: text!("../../scenarios/absorb-agar.toml"),
    },
    Builtin {
        name: "absorb-rigid",
        summary: "a cell hunts down a rigid cell among platelets and takes it in",
        text: text!("../../scenarios/absorb-rigid.toml"),
    },
    Builtin {
        name: "grow",
        summary: "a cell eats agar, digests it and grows",
        text: text!("../../scenarios/grow.toml"),
    },
    Builtin {
        name: "divide",
        summary: "a cell divides among platelets; its halves crawl apart, come back and fuse",
        text: text!("../../scenarios/divide.toml"),
    },
    Builtin {
        name: "squeeze",
        summary: "a cell squeezes through a gap of half its diameter",
        text: text!("../../scenarios/squeeze.toml"),
    },
    Builtin {
        name: "leak-stress",
        summary: "a growing cell thrashes about among platelets and must not leak",
        text: text!("../../scenarios/leak-stress.toml"),
    },
    Builtin {
        name: "ram-stress",
        summary: "rigid cells and probes ram a cell from all sides; nothing gets in but by ingestion",
        text: text!("../../scenarios/ram-stress.toml"),
    },
    Builtin {
        name: "hunt",
        summary: "a neutrophil hunts cocci among red blood cells: the film of the 1950s",
        text: text!("../../scenarios/hunt.toml"),
    },
    Builtin {
        name: "pond",
        summary: "paramecia and an amoeba in their real size",
        text: text!("../../scenarios/pond.toml"),
    },
    Builtin {
        name: "crawl",
        summary: "four types of amoeba crawl by pseudopods in an open field",
        text: text!("../../scenarios/crawl.toml"),
    },
];

/// All scenarios that come with the library.
#[must_use]
pub fn builtins() -> &'static [Builtin] {
    &BUILTINS
}

/// The scenario of this name, if there is one.
#[must_use]
pub fn builtin(name: &str) -> Option<&'static Builtin> {
    BUILTINS.iter().find(|builtin| builtin.name == name)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bare_text::bare;
    use crate::scenario::Scenario;

    #[test]
    fn without_comments_the_same_worlds_are_built() {
        for found in builtins() {
            let bare = bare::string(found.text, "#");
            let digest = |text| Scenario::parse(text, &[]).unwrap().build().unwrap().world.digest();
            assert_eq!(digest(&bare), digest(found.text), "{}", found.name);
            assert!(!bare.contains("# ") && !bare.contains("\n\n"), "{}", found.name);
        }
    }
}
