//! Sound by the system's own way: WASAPI on Windows, Core Audio on macOS.

use super::Feed;
use crate::sound::RATE;
use cpal::traits::{DeviceTrait, HostTrait, StreamTrait};
use cpal::{BufferSize, Error, ErrorKind, StreamConfig};
use std::sync::mpsc::channel;
use std::sync::{Arc, Mutex, PoisonError};

pub(super) fn play(feed: Feed) -> Result<(), Error> {
    let feed = Arc::new(Mutex::new(feed));
    while play_until_lost(&feed)? {}
    Ok(())
}

/// Plays by the device of now. True when it has to be opened anew, false when no cue can come any more.
fn play_until_lost(feed: &Arc<Mutex<Feed>>) -> Result<bool, Error> {
    let device = cpal::default_host().default_output_device().ok_or(ErrorKind::DeviceNotAvailable)?;
    let channels = device.default_output_config()?.channels();
    let config = StreamConfig { channels, sample_rate: RATE, buffer_size: BufferSize::Default };
    let (is_over, end) = channel();
    let (is_lost, feed, mut samples) = (is_over.clone(), Arc::clone(feed), Vec::new());
    let fill = move |all: &mut [f32], _: &_| {
        samples.clear();
        samples.resize(all.len() / usize::from(channels), 0.0);
        // The receiver is gone with the stream only.
        if !feed.lock().unwrap_or_else(PoisonError::into_inner).fill(&mut samples) {
            let _ = is_over.send(false);
        }
        for (all, &sample) in all.chunks_exact_mut(usize::from(channels)).zip(&samples) {
            all.fill(sample);
        }
    };
    let complain = move |error: Error| {
        if matches!(error.kind(), ErrorKind::DeviceNotAvailable | ErrorKind::StreamInvalidated) {
            let _ = is_lost.send(true);
        }
    };
    let stream = device.build_output_stream(config, fill, complain, None)?;
    stream.play()?;
    Ok(end.recv().unwrap_or(false))
}
