//! What part of the room the picture shows. Pure maths: room units, y up, to picture pixels, y down.

use microsim_core::glam::Vec2;

/// Seen beyond the walls, share of the visible height.
const MARGIN: f32 = 0.04;
/// Least height that is seen, units.
const NEAREST: f32 = 8.0;
/// How fast the camera closes in on what it follows, 1/s.
const FOLLOW_RATE: f32 = 4.0;

/// A camera over a walled room.
#[derive(Clone, Debug, PartialEq)]
pub struct Camera {
    centre: Vec2,
    height: f32,
    room: Vec2,
    screen: Vec2,
}

impl Camera {
    /// Shows the whole room on a picture of `screen` pixels.
    #[must_use]
    pub fn whole(room: Vec2, screen: Vec2) -> Self {
        let mut camera = Self { centre: room * 0.5, height: 1.0, room, screen: screen.max(Vec2::ONE) };
        camera.height = camera.farthest();
        camera
    }

    /// Shows `height` units around `centre`.
    #[must_use]
    pub fn around(centre: Vec2, height: f32, room: Vec2, screen: Vec2) -> Self {
        let mut camera = Self::whole(room, screen);
        camera.height = height;
        camera.centre = centre;
        camera.clamp();
        camera
    }

    /// Pixels per unit.
    #[must_use]
    pub fn scale(&self) -> f32 {
        self.screen.y / self.height
    }

    /// Size of the picture, pixels.
    #[must_use]
    pub fn screen(&self) -> Vec2 {
        self.screen
    }

    /// Size of the room, units.
    #[must_use]
    pub fn room(&self) -> Vec2 {
        self.room
    }

    /// Whether nothing more would be seen from farther away.
    #[must_use]
    pub fn shows_all(&self) -> bool {
        self.height >= self.farthest() - 1e-3
    }

    /// Point of the room in the middle of the picture.
    #[must_use]
    pub fn centre(&self) -> Vec2 {
        self.centre
    }

    /// From the room to the picture.
    #[must_use]
    pub fn to_screen(&self, point: Vec2) -> Vec2 {
        let offset = (point - self.centre) * self.scale();
        self.screen * 0.5 + Vec2::new(offset.x, -offset.y)
    }

    /// From the picture to the room.
    #[must_use]
    pub fn to_room(&self, pixel: Vec2) -> Vec2 {
        let offset = (pixel - self.screen * 0.5) / self.scale();
        self.centre + Vec2::new(offset.x, -offset.y)
    }

    /// Adapts to a picture of another size.
    pub fn resize(&mut self, screen: Vec2) {
        if screen != self.screen && screen.min_element() >= 1.0 {
            let was_whole = self.shows_all();
            self.screen = screen;
            if was_whole {
                self.height = self.farthest();
            }
            self.clamp();
        }
    }

    /// Moves smoothly to `target`, for `dt` seconds.
    pub fn follow(&mut self, target: Vec2, dt: f32) {
        let share = 1.0 - (-FOLLOW_RATE * dt).exp();
        self.centre += (target - self.centre) * share;
        self.clamp();
    }

    /// Moves by some units, walls permitting.
    pub fn shift(&mut self, by: Vec2) {
        self.centre += by;
        self.clamp();
    }

    /// Shows everything `factor` times as large; the point under `pixel` stays where it is, walls permitting.
    pub fn zoom(&mut self, factor: f32, pixel: Vec2) {
        let fixed = self.to_room(pixel);
        self.height /= factor.clamp(0.1, 10.0);
        self.limit_height();
        self.centre += fixed - self.to_room(pixel);
        self.clamp();
    }

    /// Height at which the whole room is seen.
    fn farthest(&self) -> f32 {
        let aspect = self.screen.x / self.screen.y;
        let by_height = self.room.y / (1.0 - 2.0 * MARGIN);
        let by_width = self.room.x / (aspect - 2.0 * MARGIN);
        by_height.max(by_width)
    }

    fn limit_height(&mut self) {
        let farthest = self.farthest();
        self.height = self.height.clamp(NEAREST.min(farthest), farthest);
    }

    fn clamp(&mut self) {
        self.limit_height();
        let half = Vec2::new(self.screen.x / self.screen.y, 1.0) * (0.5 * self.height);
        let margin = Vec2::splat(MARGIN * self.height);
        let (low, high) = (half - margin, self.room - half + margin);
        // Where the room is narrower than the view, it lies in the middle.
        self.centre = Vec2::select(low.cmplt(high), self.centre.clamp(low, high.max(low)), self.room * 0.5);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const ROOM: Vec2 = Vec2::new(160.0, 90.0);
    const SCREEN: Vec2 = Vec2::new(640.0, 360.0);

    fn is_near(a: Vec2, b: Vec2) -> bool {
        (a - b).length() < 1e-2
    }

    #[test]
    fn the_whole_room_is_seen_whatever_its_shape() {
        for room in [ROOM, Vec2::new(1000.0, 10.0), Vec2::new(5.0, 300.0)] {
            let camera = Camera::whole(room, SCREEN);
            for corner in [Vec2::ZERO, room] {
                let pixel = camera.to_screen(corner);
                assert!(pixel.cmpge(Vec2::ZERO).all() && pixel.cmple(SCREEN).all(), "{room}: {pixel}");
            }
        }
    }

    #[test]
    fn up_is_up_and_back_is_back() {
        let camera = Camera::around(Vec2::new(60.0, 40.0), 30.0, ROOM, SCREEN);
        assert!(camera.to_screen(Vec2::new(60.0, 41.0)).y < camera.to_screen(Vec2::new(60.0, 40.0)).y);
        let point = Vec2::new(71.0, 33.0);
        assert!(is_near(camera.to_room(camera.to_screen(point)), point));
    }

    #[test]
    fn the_camera_stays_in_the_room() {
        let mut camera = Camera::around(Vec2::new(80.0, 45.0), 30.0, ROOM, SCREEN);
        (0..600).for_each(|_| camera.follow(Vec2::new(-50.0, 500.0), 1.0 / 60.0));
        let corner = camera.to_screen(Vec2::new(0.0, ROOM.y));
        assert!(corner.x > 0.0 && corner.x < 30.0 && corner.y > 0.0 && corner.y < 30.0, "{corner}");
    }

    #[test]
    fn following_does_not_depend_on_the_frame_rate() {
        let start = Camera::around(Vec2::new(60.0, 45.0), 30.0, ROOM, SCREEN);
        let (mut slow, mut fast) = (start.clone(), start);
        (0..30).for_each(|_| slow.follow(Vec2::new(90.0, 45.0), 1.0 / 30.0));
        (0..120).for_each(|_| fast.follow(Vec2::new(90.0, 45.0), 1.0 / 120.0));
        assert!(is_near(slow.centre, fast.centre));
    }

    #[test]
    fn zoom_keeps_the_point_under_the_cursor_and_has_limits() {
        let mut camera = Camera::around(Vec2::new(80.0, 45.0), 40.0, ROOM, SCREEN);
        let (pixel, point) = (Vec2::new(400.0, 100.0), camera.to_room(Vec2::new(400.0, 100.0)));
        camera.zoom(1.5, pixel);
        assert!(is_near(camera.to_room(pixel), point));
        (0..50).for_each(|_| camera.zoom(2.0, pixel));
        assert!((camera.height - NEAREST).abs() < 1e-3);
        (0..50).for_each(|_| camera.zoom(0.5, pixel));
        assert_eq!(camera, Camera::whole(ROOM, SCREEN));
    }

    #[test]
    fn a_whole_view_stays_whole_when_the_window_changes() {
        let mut camera = Camera::whole(ROOM, SCREEN);
        camera.resize(Vec2::new(900.0, 300.0));
        assert_eq!(camera, Camera::whole(ROOM, Vec2::new(900.0, 300.0)));
        camera.resize(Vec2::ZERO);
        assert_eq!(camera.screen, Vec2::new(900.0, 300.0));
    }
}
