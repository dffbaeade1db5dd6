//! Sound by a server of PulseAudio or PipeWire.

use super::Feed;
use crate::sound::RATE;
use pulseaudio::protocol::stream::{BufferAttr, StreamFlags};
use pulseaudio::protocol::{ChannelMap, ChannelVolume, PlaybackStreamParams, SampleFormat, SampleSpec};
use pulseaudio::{AsPlaybackSource, Client, ClientError};

/// Samples that the server keeps in store: 40 ms.
const STORE: u32 = RATE / 25;
const SAMPLE_BYTES: usize = size_of::<f32>();

pub(super) fn play(mut feed: Feed) -> Result<(), ClientError> {
    let client = Client::from_env(c"microsim")?;
    let params = PlaybackStreamParams {
        sample_spec: SampleSpec { format: SampleFormat::Float32Le, channels: 1, sample_rate: RATE },
        channel_map: ChannelMap::mono(),
        cvolume: Some(ChannelVolume::norm(1)),
        buffer_attr: BufferAttr { target_length: STORE * SAMPLE_BYTES as u32, ..BufferAttr::default() },
        flags: StreamFlags { adjust_latency: true, ..StreamFlags::default() },
        ..PlaybackStreamParams::default()
    };
    let mut samples = Vec::new();
    let source = move |bytes: &mut [u8]| {
        samples.resize(bytes.len() / SAMPLE_BYTES, 0.0f32);
        if !feed.fill(&mut samples) {
            return 0;
        }
        let (whole, _) = bytes.as_chunks_mut::<SAMPLE_BYTES>();
        whole.iter_mut().zip(&samples).for_each(|(bytes, sample)| *bytes = sample.to_le_bytes());
        whole.len() * SAMPLE_BYTES
    };
    futures::executor::block_on(async {
        let stream = client.create_playback_stream(params, source.as_playback_source()).await?;
        stream.play_all().await
    })
}
