//! What is heard, and what each sounds like.

use super::tone::Tone;
use microsim_core::{Event, OrganismId};

/// Something that is heard.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Cue {
    /// A membrane begins to take prey in.
    Engulf,
    /// Prey is inside.
    Ingest,
    /// Prey came out again.
    Release,
    /// Prey is digested.
    Digest,
    /// A cell lunges.
    Lunge,
    /// Somebody who bites comes near.
    Danger,
    /// One cell became two.
    Divide,
    /// Two cells became one.
    Fuse,
    /// One of the last seconds of a round begins.
    Second,
    /// A round is over.
    End,
}

impl Cue {
    /// All of them.
    pub const ALL: [Self; 10] = {
        use Cue::*;
        [Engulf, Ingest, Release, Digest, Lunge, Danger, Divide, Fuse, Second, End]
    };

    /// What an event sounds like to one organism, which hears only what it does itself, or to a watcher, who hears everybody.
    #[must_use]
    pub fn of(event: &Event, listener: Option<OrganismId>) -> Option<Self> {
        let (by, cue) = match *event {
            Event::IngestionBegan { engulfer, .. } => (engulfer, Self::Engulf),
            Event::Ingested { engulfer, .. } => (engulfer, Self::Ingest),
            Event::Released { engulfer, .. } => (engulfer, Self::Release),
            Event::Consumed { engulfer, .. } => (engulfer, Self::Digest),
            Event::Divided { parent, .. } => (parent, Self::Divide),
            Event::Fused { into, .. } => (into, Self::Fuse),
            _ => return None,
        };
        listener.is_none_or(|listener| listener == by).then_some(cue)
    }

    /// Its tones.
    pub(super) fn tones(self) -> Vec<Tone> {
        match self {
            Self::Engulf => vec![Tone::glide([95.0, 150.0], 0.30, 0.35)],
            Self::Ingest => {
                vec![Tone::glide([420.0, 130.0], 0.14, 0.60), Tone::glide([210.0, 90.0], 0.12, 0.50).after(0.05)]
            }
            Self::Release => vec![Tone::glide([150.0, 330.0], 0.16, 0.40)],
            Self::Digest => vec![Tone::note(523.25, 0.18, 0.35), Tone::note(783.99, 0.28, 0.35).after(0.07)],
            Self::Lunge => vec![Tone::glide([130.0, 400.0], 0.22, 0.45)],
            Self::Danger => vec![Tone::note(196.0, 0.14, 0.40), Tone::note(185.0, 0.20, 0.40).after(0.16)],
            Self::Divide => vec![Tone::glide([330.0, 220.0], 0.35, 0.35), Tone::glide([330.0, 495.0], 0.35, 0.35)],
            Self::Fuse => vec![Tone::glide([220.0, 330.0], 0.35, 0.35), Tone::glide([495.0, 330.0], 0.35, 0.35)],
            Self::Second => vec![Tone::note(880.0, 0.06, 0.25)],
            Self::End => vec![
                Tone::note(392.0, 0.90, 0.30),
                Tone::note(523.25, 0.90, 0.30).after(0.12),
                Tone::note(659.26, 1.00, 0.30).after(0.24),
            ],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stage::Stage;

    #[test]
    fn one_who_listens_hears_only_what_it_does_itself() {
        let mut stage = Stage::builtin("absorb-agar").unwrap();
        let eater = stage.player().unwrap();
        let prey = stage.world().organisms().find(|&id| id != eater).unwrap();
        let mut heard = [Vec::new(), Vec::new(), Vec::new()];
        for _ in 0..900 {
            stage.step();
            for (heard, listener) in heard.iter_mut().zip([None, Some(eater), Some(prey)]) {
                heard.extend(stage.world().events().iter().filter_map(|event| Cue::of(event, listener)));
            }
        }
        let [all, own, others] = heard;
        assert!(own.contains(&Cue::Engulf) && own.contains(&Cue::Ingest), "{own:?}");
        assert!(all == own && others.is_empty(), "{all:?}, {others:?}");
    }
}
