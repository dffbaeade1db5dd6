//! The field guide: what can be found on slides, each with an article (`words/guide`) and a scene that shows it.

pub mod identify;

use microsim_core::Kind;

/// What an article is about, and where to see it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Entry {
    /// Name of the article.
    pub name: &'static str,
    /// Scene of its picture, and the time in it, s.
    pub scene: (&'static str, f64),
    /// The picture shows the first organism of this kind, or whoever is followed there.
    pub kind: Option<Kind>,
}

/// All entries, in the order of the guide.
pub const ENTRIES: [Entry; 29] = [
    entry("amoeboid-cell", ("crawl", 1.5), Some(Kind::AmoeboidCell)),
    entry("membrane", ("absorb-agar", 0.0), Some(Kind::AmoeboidCell)),
    entry("pseudopod", ("crawl", 2.5), Some(Kind::AmoeboidCell)),
    entry("uropod", ("squeeze", 1.5), Some(Kind::AmoeboidCell)),
    entry("nucleus", ("absorb-rigid", 0.0), Some(Kind::RigidCell)),
    entry("phagocytosis", ("absorb-agar", 2.5), Some(Kind::AmoeboidCell)),
    entry("phagosome", ("absorb-agar", 6.0), Some(Kind::AmoeboidCell)),
    entry("division", ("divide", 3.5), Some(Kind::AmoeboidCell)),
    entry("rigid-cell", ("pond", 0.5), Some(Kind::RigidCell)),
    entry("red-cell", ("hunt", 0.0), Some(Kind::RedCell)),
    entry("platelet", ("hunt", 0.0), Some(Kind::Platelet)),
    entry("coccus", ("hunt", 0.0), Some(Kind::Coccus)),
    entry("bacillus", ("pond", 0.5), Some(Kind::Bacillus)),
    entry("agar", ("absorb-agar", 0.0), Some(Kind::Agar)),
    entry("probe", ("platelets", 0.0), Some(Kind::Probe)),
    entry("custom", ("absorb-rigid", 0.0), Some(Kind::RigidCell)),
    entry("fluid-block", ("dam-break", 0.5), Some(Kind::FluidBlock)),
    entry("medium", ("hunt", 0.0), Some(Kind::Coccus)),
    entry("scent", ("hunt", 0.5), None),
    entry("wall", ("squeeze", 1.5), None),
    entry("phase-contrast", ("hunt", 0.5), None),
    entry("negative-phase-contrast", ("hunt", 0.5), None),
    entry("dic", ("hunt", 0.5), None),
    entry("dark-field", ("hunt", 0.5), None),
    entry("bright-field", ("hunt", 0.5), None),
    entry("stained", ("hunt", 0.5), None),
    entry("fluorescence", ("hunt", 0.5), None),
    entry("classic", ("hunt", 0.5), None),
    entry("drawn", ("hunt", 0.5), None),
];

const fn entry(name: &'static str, scene: (&'static str, f64), kind: Option<Kind>) -> Entry {
    Entry { name, scene, kind }
}

/// The entry of this name.
#[must_use]
pub fn find(name: &str) -> Option<&'static Entry> {
    ENTRIES.iter().find(|entry| entry.name == name)
}

/// The entry about a kind of organism; kinds without one are bodies of discs, as all are.
#[must_use]
pub fn of_kind(kind: Kind) -> Option<&'static Entry> {
    find(&kind.name().replace('_', "-")).or_else(|| find("custom"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenery::Sight;
    use crate::stage::Stage;
    use crate::words::articles::article;
    use crate::words::{self, LANGUAGES};
    use microsim_core::OrganismSpec;

    #[test]
    fn t87_every_entry_has_an_article_of_at_most_forty_words_with_its_source() {
        for language in &LANGUAGES {
            words::choose(language, || None);
            for entry in ENTRIES {
                let article = article(entry.name, |_| None).unwrap_or_else(|| panic!("{}", entry.name));
                assert!(
                    (8..=40).contains(&article.text.split_whitespace().count()),
                    "{}: {}",
                    language.code,
                    entry.name
                );
                assert!(
                    !article.title.is_empty() && article.source.chars().any(|c| c.is_ascii_digit()),
                    "{}",
                    entry.name
                );
            }
        }
    }

    #[test]
    fn t87_every_kind_and_every_way_of_looking_has_an_entry() {
        let own = |kind| of_kind(kind).filter(|entry| entry.name != "custom").map(|entry| entry.name);
        let mut names: Vec<_> = OrganismSpec::defaults().iter().filter_map(|spec| own(spec.kind())).collect();
        names.sort_unstable();
        let expected = "agar amoeboid-cell bacillus coccus fluid-block platelet probe red-cell rigid-cell";
        assert_eq!(names.join(" "), expected);
        let custom = Kind::try_from(6).expect("a body of the first template");
        assert_eq!(of_kind(custom).map(|entry| entry.name), Some("custom"));
        assert!(Sight::all().all(|sight| find(sight.name()).is_some()));
    }

    #[test]
    fn every_picture_shows_what_its_entry_is_about() {
        for entry in ENTRIES {
            let mut stage = Stage::builtin(entry.scene.0).unwrap_or_else(|| panic!("{}", entry.name));
            while stage.world().time() < entry.scene.1 {
                stage.step();
            }
            let view = stage.world().view();
            let shown = entry.kind.map_or(stage.player().is_some(), |kind| view.organisms().any(|o| o.kind() == kind));
            assert!(shown, "{}", entry.name);
        }
    }
}
