//! Videos of an episode: MP4 with H.264, or GIF.
//!
//! [`video`] draws the scenes of an episode, several frames per step, and [`Encoder`] encodes
//! frames one by one. Frames depend on the scenes alone, so the same ones give the same pixels.
//! `OpenH264` runs on one thread, which makes its bytes the same too.

use muxide::api::{Muxer, MuxerBuilder, VideoCodec};
use openh264::OpenH264API;
use openh264::encoder::{
    Complexity, Encoder as H264, EncoderConfig, FrameRate, FrameType, IntraFramePeriod, QpRange,
    RateControlMode, UsageType,
};
use openh264::formats::{RgbaSliceU8, YUVBuffer};
use setpiece_render::{Camera, Options, RenderError, Renderer, Scene, between};
use std::ops::RangeInclusive;

/// Steps of a second.
const STEPS_PER_S: f64 = crate::scenario::pitch::STEPS_PER_S;
/// Frames per second of an MP4, and of a GIF, whose delays are whole hundredths.
const MP4_FPS: u32 = 30;
const GIF_FPS: u32 = 20;
/// How long a stop of play is shown before the restart, and the last scene, seconds.
const STOP_S: f64 = 1.0;
/// Seconds between two frames that stand for themselves, for players that jump.
const INTRA_S: u32 = 2;
/// How coarsely H.264 quantises, by quality.
const QUANTISER: [u8; 3] = [34, 28, 24];
/// The longest side of a GIF, pixels.
const GIF_SIDE_MAX: usize = 65_535;

/// A format of videos.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum VideoFormat {
    /// MP4 with H.264.
    Mp4,
    /// An animated GIF.
    Gif,
}

impl Quality {
    /// The quality of a name.
    pub fn from_name(name: &str) -> Option<Quality> {
        match name {
            "low" => Some(Quality::Low),
            "medium" => Some(Quality::Medium),
            "high" => Some(Quality::High),
            _ => None,
        }
    }
}

impl VideoFormat {
    /// The format of a file name's ending, in lower case.
    pub fn of_ending(ending: &str) -> Option<VideoFormat> {
        match ending {
            "mp4" => Some(VideoFormat::Mp4),
            "gif" => Some(VideoFormat::Gif),
            _ => None,
        }
    }

    /// Frames per second.
    pub fn fps(self) -> u32 {
        match self {
            VideoFormat::Mp4 => MP4_FPS,
            VideoFormat::Gif => GIF_FPS,
        }
    }
}

/// How much room a video takes: GRF's `video_quality_level`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Quality {
    /// The smallest files.
    Low,
    /// Good for most uses.
    #[default]
    Medium,
    /// The sharpest pictures.
    High,
}

/// Why a video can't be made.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum VideoError {
    /// The picture can't be drawn.
    #[error(transparent)]
    Render(#[from] RenderError),
    /// H.264 halves both sides.
    #[error("an MP4 has an even width and height, not {width}x{height}")]
    Odd {
        /// The width asked for.
        width: usize,
        /// The height asked for.
        height: usize,
    },
    /// The speed isn't a number above 0, or too far from 1.
    #[error("a speed is a number in 0.05..20, not {0}")]
    Speed(f64),
    /// The film has no such steps.
    #[error("the episode has the steps 0..{length}, none of {from}..{to}")]
    Empty {
        /// The first step asked for.
        from: u32,
        /// The last one.
        to: u32,
        /// The episode's last step.
        length: u32,
    },
    /// The encoder's message.
    #[error("the video can't be encoded: {0}")]
    Encode(String),
}

/// What a video shows.
#[derive(Clone, Debug, PartialEq)]
pub struct VideoOptions {
    /// Width and height, pixels.
    pub size: (usize, usize),
    /// Where it is seen from.
    pub camera: Camera,
    /// How much faster than the match it runs, 0.05..20.
    pub speed: f64,
    /// The first and last step.
    pub steps: RangeInclusive<u32>,
    /// How much room it takes; GIFs don't have a choice.
    pub quality: Quality,
}

/// Draws and encodes scenes that follow each other, such as a [film](crate::film::Film)'s.
///
/// `progress` is called after each frame with the number of frames so far and in all.
///
/// # Errors
/// [`VideoError`] for sizes, speeds and steps that can't be shown.
pub fn video(
    all: &[Scene],
    format: VideoFormat,
    options: &VideoOptions,
    progress: &mut dyn FnMut(usize, usize),
) -> Result<Vec<u8>, VideoError> {
    let speed = options.speed;
    if !(0.05..=20.0).contains(&speed) {
        return Err(VideoError::Speed(speed));
    }
    let (from, to) = (*options.steps.start(), *options.steps.end());
    let scenes: Vec<&Scene> =
        all.iter().filter(|scene| options.steps.contains(&scene.step)).collect();
    if scenes.is_empty() {
        let length = all.last().map_or(0, |scene| scene.step);
        return Err(VideoError::Empty { from, to, length });
    }
    let (width, height) = options.size;
    let look = Options { camera: options.camera, ..Options::default() };
    let mut renderer = Renderer::new(width, height, look)?;
    let mut encoder = Encoder::new(format, options.size, format.fps(), options.quality)?;
    let timeline = timeline(&scenes, speed, f64::from(format.fps()));
    let (mut scene, mut rgba) = (Scene::default(), vec![0; width * height * 4]);
    for (done, &(at, share)) in timeline.iter().enumerate() {
        let Some(&first) = scenes.get(at) else { continue };
        between(first, scenes.get(at + 1).unwrap_or(&first), share, &mut scene);
        renderer.render(&scene, &mut rgba)?;
        encoder.push(&mut rgba)?;
        progress(done + 1, timeline.len());
    }
    encoder.finish()
}

/// Each frame's scene, and the share of the way to the next.
fn timeline(scenes: &[&Scene], speed: f64, fps: f64) -> Vec<(usize, f32)> {
    let mut frames = Vec::new();
    // How much of the current scene's time the last frame has left over, seconds of the match.
    let (mut over, each) = (0.0, speed / fps);
    for at in 0..scenes.len() {
        let leads = scenes.get(at + 1).is_some_and(|next| !next.placed);
        let lasts = if leads { 1.0 / STEPS_PER_S } else { STOP_S * speed };
        // Sums of floats end a hair early or late.
        while over < lasts - 1e-9 {
            frames.push((at, if leads { (over / lasts) as f32 } else { 0.0 }));
            over += each;
        }
        over -= lasts;
    }
    frames
}

/// Encodes frames of one size, one by one.
pub struct Encoder {
    size: (usize, usize),
    kind: EncoderKind,
}

enum EncoderKind {
    Mp4(Box<Mp4>),
    Gif(Box<Gif>),
}

struct Gif {
    encoder: gif::Encoder<Vec<u8>>,
    /// How long a frame is shown, hundredths of a second.
    delay: u16,
    /// The frame before.
    shown: Vec<u8>,
}

struct Mp4 {
    encoder: H264,
    muxer: Muxer<Vec<u8>>,
    yuv: YUVBuffer,
    fps: u32,
    frames: u32,
    bytes: Vec<u8>,
}

impl Encoder {
    /// Begins a video.
    ///
    /// # Errors
    /// [`VideoError`] for a size that the format doesn't have.
    pub fn new(
        format: VideoFormat,
        size: (usize, usize),
        fps: u32,
        quality: Quality,
    ) -> Result<Encoder, VideoError> {
        let (width, height) = size;
        let kind = match format {
            VideoFormat::Mp4 => {
                if width % 2 != 0 || height % 2 != 0 || width < 16 || height < 16 {
                    return Err(VideoError::Odd { width, height });
                }
                let quantiser = QUANTISER[quality as usize];
                let config = EncoderConfig::new()
                    .max_frame_rate(FrameRate::from_hz(fps as f32))
                    .rate_control_mode(RateControlMode::Bufferbased)
                    .qp(QpRange::new(quantiser, quantiser))
                    .complexity(Complexity::Low)
                    .usage_type(UsageType::CameraVideoRealTime)
                    .skip_frames(false)
                    .intra_frame_period(IntraFramePeriod::from_num_frames(fps * INTRA_S))
                    .num_threads(1);
                let encoder =
                    H264::with_api_config(OpenH264API::from_source(), config).map_err(encode)?;
                let muxer = MuxerBuilder::new(Vec::new())
                    .video(VideoCodec::H264, width as u32, height as u32, f64::from(fps))
                    .with_fast_start(true)
                    .build()
                    .map_err(encode)?;
                let yuv = YUVBuffer::new(width, height);
                EncoderKind::Mp4(Box::new(Mp4 {
                    encoder,
                    muxer,
                    yuv,
                    fps,
                    frames: 0,
                    bytes: Vec::new(),
                }))
            }
            VideoFormat::Gif => {
                let side = |side: usize| u16::try_from(side).map_err(encode);
                if width.max(height) > GIF_SIDE_MAX {
                    return Err(RenderError::Size { width, height }.into());
                }
                let mut encoder = gif::Encoder::new(Vec::new(), side(width)?, side(height)?, &[])
                    .map_err(encode)?;
                encoder.set_repeat(gif::Repeat::Infinite).map_err(encode)?;
                let delay = (100 / fps.clamp(1, 100)) as u16;
                EncoderKind::Gif(Box::new(Gif { encoder, delay, shown: Vec::new() }))
            }
        };
        Ok(Encoder { size, kind })
    }

    /// Adds a frame: width · height · 4 bytes, red, green, blue, opacity. The bytes may change.
    ///
    /// # Errors
    /// [`VideoError::Render`] for another number of bytes, [`VideoError::Encode`] if the encoder
    /// fails.
    pub fn push(&mut self, rgba: &mut [u8]) -> Result<(), VideoError> {
        let (width, height) = self.size;
        if rgba.len() != width * height * 4 {
            let (expected, found) = (width * height * 4, rgba.len());
            return Err(RenderError::Buffer { expected, found }.into());
        }
        match &mut self.kind {
            EncoderKind::Mp4(mp4) => {
                mp4.yuv.read_rgba8(RgbaSliceU8::new(rgba, self.size));
                let stream = mp4.encoder.encode(&mp4.yuv).map_err(encode)?;
                let stands_alone = matches!(stream.frame_type(), FrameType::IDR | FrameType::I);
                mp4.bytes.clear();
                stream.write_vec(&mut mp4.bytes);
                let seconds = f64::from(mp4.frames) / f64::from(mp4.fps);
                mp4.muxer.write_video(seconds, &mp4.bytes, stands_alone).map_err(encode)?;
                mp4.frames += 1;
            }
            EncoderKind::Gif(gif) => {
                let whole = rgba.to_vec();
                // What stays as it was is left out, which takes no room.
                for (pixel, before) in rgba.chunks_exact_mut(4).zip(gif.shown.chunks_exact(4)) {
                    if pixel == before {
                        pixel.fill(0);
                    }
                }
                gif.shown = whole;
                let (width, height) = (width as u16, height as u16);
                let mut frame = gif::Frame::from_rgba_speed(width, height, rgba, 10);
                frame.delay = gif.delay;
                frame.dispose = gif::DisposalMethod::Keep;
                gif.encoder.write_frame(&frame).map_err(encode)?;
            }
        }
        Ok(())
    }

    /// Ends the video and returns its file.
    ///
    /// # Errors
    /// [`VideoError::Encode`] if the encoder fails.
    pub fn finish(self) -> Result<Vec<u8>, VideoError> {
        match self.kind {
            EncoderKind::Mp4(mut mp4) => {
                mp4.muxer.finish_in_place().map_err(encode)?;
                Ok(mp4.muxer.into_writer())
            }
            EncoderKind::Gif(gif) => gif.encoder.into_inner().map_err(encode),
        }
    }
}

fn encode(why: impl std::fmt::Display) -> VideoError {
    VideoError::Encode(why.to_string())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn scenes(placed: &[bool]) -> Vec<Scene> {
        let scene = |&placed: &bool| Scene { placed, ..Scene::default() };
        placed.iter().map(scene).collect()
    }

    #[test]
    fn every_step_lasts_a_tenth_of_a_second() {
        let scenes = scenes(&[true, false, false]);
        let scenes: Vec<&Scene> = scenes.iter().collect();
        let frames = timeline(&scenes, 1.0, 30.0);
        assert_eq!(frames.len(), 3 + 3 + 30);
        assert_eq!(frames[..4].iter().map(|(at, _)| *at).collect::<Vec<_>>(), [0, 0, 0, 1]);
        assert!((frames[1].1 - 1.0 / 3.0).abs() < 1e-5, "{frames:?}");
        // At half the speed there are twice as many, but a stop lasts as long.
        assert_eq!(timeline(&scenes, 0.5, 30.0).len(), 6 + 6 + 30);
    }

    #[test]
    fn a_stop_is_shown_before_the_restart() {
        let scenes = scenes(&[true, false, true, false]);
        let frames = timeline(&scenes.iter().collect::<Vec<_>>(), 1.0, 10.0);
        let stopped = frames.iter().filter(|frame| **frame == (1, 0.0)).count();
        assert_eq!((stopped, frames.len()), (10, 1 + 10 + 1 + 10));
    }
}
