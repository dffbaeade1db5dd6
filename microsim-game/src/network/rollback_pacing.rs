//! How fast a match goes.

/// How a match is played; the same for all who play.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Pacing {
    /// Steps of the world in a frame: 2 for 30 frames a second, 1 for 60.
    pub steps: u32,
    /// Frames after which an own input counts.
    pub delay: u32,
    /// Most frames that are predicted; a slow machine predicts fewer.
    pub window: u32,
    /// Frames between two digests that are compared.
    pub interval: u32,
}

impl Pacing {
    /// 30 frames a second.
    pub const USUAL: Self = Self { steps: 2, delay: 2, window: 10, interval: 30 };
    /// 60 frames a second.
    pub const QUICK: Self = Self { steps: 1, delay: 3, window: 20, interval: 60 };

    /// Rounds that are kept: one who left may have been followed a window farther by the one who says where it ended.
    pub(super) fn kept(self) -> u32 {
        3 * self.window + 2 * self.delay + 2
    }

    /// How many frames ahead of the own one an honest player can be heard of.
    pub(super) fn horizon(self) -> u32 {
        2 * (self.window + self.delay)
    }
}
