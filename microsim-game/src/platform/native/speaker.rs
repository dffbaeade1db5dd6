//! The speaker of a desktop: on Linux by the protocol of PulseAudio, which PipeWire speaks too; elsewhere silent.

use crate::sound::Cue;
#[cfg(target_os = "linux")]
use std::sync::mpsc::Sender;

/// Plays cues. Where nothing can play them it is silent.
#[derive(Debug, Default)]
pub struct Speaker {
    /// To the thread that feeds the server; it begins with the first cue.
    #[cfg(target_os = "linux")]
    cues: Option<Sender<(Cue, f32)>>,
}

impl Speaker {
    /// Plays a cue, with a loudness of 0 to 1.
    #[cfg(target_os = "linux")]
    pub fn play(&mut self, cue: Cue, loudness: f32) {
        // Refused where there is no server: then it is silent.
        let _ = self.cues.get_or_insert_with(server::begin).send((cue, loudness));
    }

    /// Nothing.
    #[cfg(not(target_os = "linux"))]
    pub fn play(&mut self, _: Cue, _: f32) {}

    /// Nothing: the server asks for samples by itself.
    pub fn pass(&mut self, _: f32) {}
}

#[cfg(target_os = "linux")]
mod server {
    use crate::sound::{Cue, Mixer, RATE};
    use pulseaudio::protocol::stream::{BufferAttr, StreamFlags};
    use pulseaudio::protocol::{ChannelMap, ChannelVolume, PlaybackStreamParams, SampleFormat, SampleSpec};
    use pulseaudio::{AsPlaybackSource, Client, ClientError};
    use std::sync::mpsc::{Receiver, Sender, TryRecvError, channel};

    /// Samples that the server keeps in store: 40 ms.
    const STORE: u32 = RATE / 25;
    const SAMPLE_BYTES: usize = size_of::<f32>();

    /// Begins to play what is sent, until the sender is dropped.
    pub(super) fn begin() -> Sender<(Cue, f32)> {
        let (sender, cues) = channel();
        // Without a thread, as without a server, what is sent is refused.
        let _ = std::thread::Builder::new().name("sound".to_owned()).spawn(move || {
            // A player without a server of sound knows; others need no message in the middle of a round.
            let _ = futures::executor::block_on(play(cues));
        });
        sender
    }

    async fn play(cues: Receiver<(Cue, f32)>) -> Result<(), ClientError> {
        let client = Client::from_env(c"microsim")?;
        let params = PlaybackStreamParams {
            sample_spec: SampleSpec { format: SampleFormat::Float32Le, channels: 1, sample_rate: RATE },
            channel_map: ChannelMap::mono(),
            cvolume: Some(ChannelVolume::norm(1)),
            buffer_attr: BufferAttr { target_length: STORE * SAMPLE_BYTES as u32, ..BufferAttr::default() },
            flags: StreamFlags { adjust_latency: true, ..StreamFlags::default() },
            ..PlaybackStreamParams::default()
        };
        let (mut mixer, mut samples) = (Mixer::default(), Vec::new());
        let source = move |bytes: &mut [u8]| {
            loop {
                match cues.try_recv() {
                    Ok((cue, loudness)) => mixer.play(cue, loudness),
                    Err(TryRecvError::Empty) => break,
                    Err(TryRecvError::Disconnected) => return 0,
                }
            }
            samples.resize(bytes.len() / SAMPLE_BYTES, 0.0f32);
            mixer.fill(&mut samples);
            let (whole, _) = bytes.as_chunks_mut::<SAMPLE_BYTES>();
            whole.iter_mut().zip(&samples).for_each(|(bytes, sample)| *bytes = sample.to_le_bytes());
            whole.len() * SAMPLE_BYTES
        };
        let stream = client.create_playback_stream(params, source.as_playback_source()).await?;
        stream.play_all().await
    }
}
