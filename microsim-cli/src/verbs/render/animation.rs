//! Movies: GIF and APNG by themselves, MP4 by a program that the user may have.

use super::options::Size;
use crate::draw::png::Picture;
use crate::failure::Failure;
use crate::output::{Outputs, PendingFile};
use std::io::{ErrorKind, Write};
use std::path::Path;
use std::process::{Child, Command, Stdio};

/// The format of a file, by the ending of its name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum PictureFormat {
    Png,
    Gif,
    Apng,
    Mp4,
}

impl PictureFormat {
    pub(crate) fn of(path: &Path) -> Result<Self, Failure> {
        let extension = path.extension().and_then(|extension| extension.to_str()).unwrap_or_default();
        match extension.to_ascii_lowercase().as_str() {
            "png" => Ok(Self::Png),
            "gif" => Ok(Self::Gif),
            "apng" => Ok(Self::Apng),
            "mp4" => Ok(Self::Mp4),
            _ => {
                let accepted = "a name that ends in .png, .gif, .apng or .mp4";
                Err(Failure::Message(format!("-o {}: accepted: {accepted}", path.display())))
            }
        }
    }
}

/// Frames that are computed as they are written.
type Frames<'f> = &'f mut dyn Iterator<Item = Result<Picture, Failure>>;

/// Size and timing of a movie.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Movie {
    pub size: Size,
    /// Frames per second.
    pub fps: f64,
    pub frames: u32,
}

impl Movie {
    /// Writes the frames as they come. The file appears when it is complete.
    pub(crate) fn write(&self, format: PictureFormat, path: &Path, frames: Frames<'_>) -> Result<(), Failure> {
        let (outputs, name) = Outputs::beside(path)?;
        let mut file = outputs.file(&name)?;
        match format {
            PictureFormat::Gif => self.write_gif(&mut file, frames),
            PictureFormat::Apng | PictureFormat::Png => self.write_apng(&mut file, frames),
            PictureFormat::Mp4 => self.write_mp4(&mut file, frames),
        }?;
        file.finish()
    }

    fn write_gif(&self, file: &mut PendingFile, frames: Frames<'_>) -> Result<(), Failure> {
        let fail = |error: gif::EncodingError| encoding("GIF", &error);
        let Size([width, height]) = self.size;
        let (Ok(width), Ok(height)) = (u16::try_from(width), u16::try_from(height)) else {
            return Err(Failure::Message("--size: a GIF is at most 65535 pixels wide and high".to_owned()));
        };
        let greys: Vec<u8> = (0..=255).flat_map(|grey| [grey; 3]).collect();
        let mut encoder = gif::Encoder::new(file, width, height, &greys).map_err(fail)?;
        encoder.set_repeat(gif::Repeat::Infinite).map_err(fail)?;
        // A GIF counts in hundredths of a second; the error is carried on from frame to frame.
        let due = |frame: u32| (f64::from(frame) * 100.0 / self.fps).round() as u32;
        for (number, picture) in (0..).zip(frames) {
            let mut frame = gif_frame(&picture?, width, height);
            frame.delay = (due(number + 1) - due(number)).clamp(1, u32::from(u16::MAX)) as u16;
            encoder.write_frame(&frame).map_err(fail)?;
        }
        Ok(())
    }

    fn write_apng(&self, file: &mut PendingFile, frames: Frames<'_>) -> Result<(), Failure> {
        let fail = |error: png::EncodingError| encoding("APNG", &error);
        let Size([width, height]) = self.size;
        let mut encoder = png::Encoder::new(file, width, height);
        encoder.set_color(png::ColorType::Rgb);
        encoder.set_depth(png::BitDepth::Eight);
        encoder.set_animated(self.frames, 0).map_err(fail)?;
        let (delay, per_second) = fraction(1.0 / self.fps);
        encoder.set_frame_delay(delay, per_second).map_err(fail)?;
        let mut writer = encoder.write_header().map_err(fail)?;
        for picture in frames {
            writer.write_image_data(picture?.bytes()).map_err(fail)?;
        }
        writer.finish().map_err(fail)
    }

    /// Hands the frames to `ffmpeg`, which writes the file that `file` has reserved.
    fn write_mp4(&self, file: &mut PendingFile, mut frames: Frames<'_>) -> Result<(), Failure> {
        let mut child = self.ffmpeg(&file.temporary)?;
        let mut input = child.stdin.take();
        let written: Result<(), Failure> = Iterator::try_for_each(&mut frames, |picture| {
            let picture = picture?;
            let sent = input.as_mut().map_or(Ok(()), |input| input.write_all(picture.bytes()));
            // When it has closed the pipe, its exit status and its own words say why.
            sent.or_else(|error| if error.kind() == ErrorKind::BrokenPipe { Ok(()) } else { Err(error) })
                .map_err(|error| Failure::Message(format!("cannot send frames to ffmpeg: {error}")))
        });
        drop(input);
        let status = child.wait().map_err(|error| Failure::Message(format!("cannot wait for ffmpeg: {error}")))?;
        written?;
        if status.success() { Ok(()) } else { Err(Failure::Message(format!("ffmpeg failed: {status}"))) }
    }

    fn ffmpeg(&self, output: &Path) -> Result<Child, Failure> {
        let Size([width, height]) = self.size;
        let mut command = Command::new("ffmpeg");
        command.args(["-hide_banner", "-loglevel", "error", "-y", "-f", "rawvideo", "-pix_fmt", "rgb24"]);
        command.args(["-s", &format!("{width}x{height}"), "-r", &self.fps.to_string(), "-i", "-", "-an"]);
        // H.264 in 4:2:0 wants even sides.
        command.args(["-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2", "-c:v", "libx264", "-pix_fmt", "yuv420p", "-crf", "18"]);
        command.args(["-movflags", "+faststart", "-f", "mp4"]).arg(output);
        command.stdin(Stdio::piped()).stdout(Stdio::null()).spawn().map_err(|error| match error.kind() {
            ErrorKind::NotFound => Failure::Message(
                "an mp4 needs the program ffmpeg, and there is none on the PATH; accepted without it: .gif, .apng"
                    .to_owned(),
            ),
            _ => Failure::Message(format!("cannot start ffmpeg: {error}")),
        })
    }
}

/// A frame in 256 greys if it is grey, which is exact, and in its own 256 colours if it is not.
fn gif_frame(picture: &Picture, width: u16, height: u16) -> gif::Frame<'static> {
    if let Some(greys) = picture.greys() {
        return gif::Frame { width, height, buffer: greys.into(), ..gif::Frame::default() };
    }
    gif::Frame::from_rgb_speed(width, height, picture.bytes(), 10)
}

/// A time as a fraction of whole numbers of 16 bits.
fn fraction(seconds: f64) -> (u16, u16) {
    let most = f64::from(u16::MAX);
    let per_second = (most / seconds.max(1.0)).min(10_000.0).floor();
    ((seconds * per_second).round().clamp(1.0, most) as u16, per_second as u16)
}

fn encoding(what: &str, error: &dyn std::fmt::Display) -> Failure {
    Failure::Message(format!("cannot encode the {what}: {error}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_format_is_known_by_the_name_of_the_file() {
        let of = |name: &str| PictureFormat::of(Path::new(name)).ok();
        assert_eq!(of("a.PNG"), Some(PictureFormat::Png));
        assert_eq!(of("b.c/clip.gif"), Some(PictureFormat::Gif));
        assert!(of("clip").is_none() && of("clip.mov").is_none());
    }

    #[test]
    fn times_become_fractions() {
        for seconds in [1.0 / 24.0, 1.0 / 1000.0, 3.5, 100.0] {
            let (delay, per_second) = fraction(seconds);
            assert!((f64::from(delay) / f64::from(per_second) / seconds - 1.0).abs() < 0.01, "{seconds}");
        }
    }

    #[test]
    fn grey_frames_keep_every_grey() {
        let bytes: Vec<u8> = (0..=255).flat_map(|grey| [grey; 3]).collect();
        let frame = gif_frame(&Picture::new(16, 16, bytes), 16, 16);
        assert!(frame.palette.is_none() && frame.buffer.iter().enumerate().all(|(k, &grey)| k == usize::from(grey)));
        let colours = gif_frame(&Picture::new(1, 2, vec![200, 10, 10, 10, 10, 200]), 1, 2);
        assert!(colours.palette.is_some());
    }
}
