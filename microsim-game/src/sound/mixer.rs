//! The mixer: samples as a function of the cues that it was given and when, with equal bits on every machine.

use super::cue::Cue;
use super::tone::{RATE, Voice};

/// Most tones at a time; more are not heard.
const MOST_VOICES: usize = 24;
/// Time within which a cue is not heard again, samples: 30 ms.
const PAUSE: u32 = RATE * 3 / 100;

/// Mixes tones.
#[derive(Clone, Debug, Default)]
pub struct Mixer {
    voices: Vec<Voice>,
    /// What began in the last moments, and how long ago, samples.
    recent: Vec<(Cue, u32)>,
}

impl Mixer {
    /// Begins the tones of a cue, unless there are too many. Loudness is 0 to 1.
    pub fn play(&mut self, cue: Cue, loudness: f32) {
        let tones = cue.tones();
        let is_new = self.recent.iter().all(|(other, _)| *other != cue);
        if is_new && self.voices.len() + tones.len() <= MOST_VOICES {
            self.voices.extend(tones.into_iter().map(|tone| Voice::new(tone, loudness)));
            self.recent.push((cue, 0));
        }
    }

    /// Whether nothing is to be heard.
    #[must_use]
    pub fn is_silent(&self) -> bool {
        self.voices.is_empty()
    }

    /// The next samples, of one channel, between -1 and 1.
    pub fn fill(&mut self, samples: &mut [f32]) {
        for sample in samples.iter_mut() {
            let sum: f32 = self.voices.iter_mut().map(Voice::next).sum();
            // Many tones at a time do not clip.
            *sample = sum / (1.0 + sum.abs());
        }
        self.voices.retain(|voice| !voice.is_over());
        self.recent.iter_mut().for_each(|(_, age)| *age = age.saturating_add(samples.len() as u32));
        self.recent.retain(|(_, age)| *age < PAUSE);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn played(cue: Cue, loudness: f32) -> Vec<f32> {
        let (mut mixer, mut samples) = (Mixer::default(), vec![0.0; 2 * RATE as usize]);
        mixer.play(cue, loudness);
        mixer.fill(&mut samples);
        assert!(mixer.is_silent(), "{cue:?} ends");
        samples
    }

    fn peak(samples: &[f32]) -> f32 {
        samples.iter().fold(0.0, |most, sample| sample.abs().max(most))
    }

    /// FNV-1a of the bits.
    fn hash(samples: &[f32]) -> u64 {
        let bytes = samples.iter().flat_map(|sample| sample.to_bits().to_le_bytes());
        bytes.fold(0xcbf2_9ce4_8422_2325, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3))
    }

    #[test]
    fn every_cue_is_heard_as_loud_as_it_is_asked_for_and_differs_from_the_others() {
        let all = Cue::ALL.map(|cue| played(cue, 1.0));
        for (k, samples) in all.iter().enumerate() {
            assert!((0.1..0.6).contains(&peak(samples)), "{:?}: {}", Cue::ALL[k], peak(samples));
            assert!(all[..k].iter().all(|other| other != samples), "{:?}", Cue::ALL[k]);
            let quiet = peak(&played(Cue::ALL[k], 0.25));
            assert!(quiet < 0.4 * peak(samples) && quiet > 0.0);
            assert_eq!(peak(&played(Cue::ALL[k], 0.0)), 0.0);
        }
    }

    #[test]
    fn samples_have_equal_bits_everywhere_and_in_pieces_of_every_length() {
        let whole: Vec<f32> = Cue::ALL.iter().flat_map(|&cue| played(cue, 1.0)).collect();
        assert_eq!(hash(&whole), 0xf816_721c_d7cf_94e3, "{:#018x}", hash(&whole));
        let mut pieces = vec![0.0; 2 * RATE as usize];
        let mut mixer = Mixer::default();
        mixer.play(Cue::End, 1.0);
        pieces.chunks_mut(777).for_each(|piece| mixer.fill(piece));
        assert_eq!(pieces, played(Cue::End, 1.0));
    }

    #[test]
    fn a_note_has_its_pitch() {
        let samples = &played(Cue::Second, 1.0)[..RATE as usize / 20];
        let rises = samples.windows(2).filter(|pair| pair[0] < 0.0 && pair[1] >= 0.0).count();
        assert!((43..=44).contains(&rises), "{rises} periods of 880 Hz in 50 ms");
    }

    #[test]
    fn a_crowd_of_cues_neither_clips_nor_grows() {
        let (mut mixer, mut samples, mut most) = (Mixer::default(), [0.0; 480], 0.0f32);
        for k in 0..2000 {
            mixer.play(Cue::ALL[k % Cue::ALL.len()], 1.0);
            mixer.fill(&mut samples);
            most = most.max(peak(&samples));
            assert!(mixer.voices.len() <= MOST_VOICES && mixer.recent.len() <= Cue::ALL.len());
        }
        assert!((0.5..1.0).contains(&most), "{most}");
    }

    #[test]
    fn the_same_cue_twice_at_once_is_heard_once() {
        let mut mixer = Mixer::default();
        (0..5).for_each(|_| mixer.play(Cue::Ingest, 1.0));
        assert_eq!(mixer.voices.len(), Cue::Ingest.tones().len());
        mixer.fill(&mut vec![0.0; PAUSE as usize]);
        mixer.play(Cue::Ingest, 1.0);
        assert_eq!(mixer.voices.len(), 2 * Cue::Ingest.tones().len());
    }
}
