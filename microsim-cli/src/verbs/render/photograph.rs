//! Computing an exposure on several threads.

use crate::draw::png::Picture;
use microsim_core::microscope::Exposure;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Rows that a thread takes at a time.
const BAND: usize = 90;

/// The picture. It does not depend on the number of threads.
pub(crate) fn develop(exposure: &Exposure, threads: usize) -> Picture {
    let [width, height] = exposure.size();
    let bands = height.div_ceil(BAND);
    let next = AtomicUsize::new(0);
    let work = || {
        let mut done = Vec::new();
        loop {
            let band = next.fetch_add(1, Ordering::Relaxed);
            if band >= bands {
                return done;
            }
            done.push((band, exposure.rows(band * BAND..(band + 1) * BAND)));
        }
    };
    let mut done: Vec<(usize, Vec<u8>)> = std::thread::scope(|scope| {
        let helpers: Vec<_> = (1..threads.min(bands)).map(|_| scope.spawn(work)).collect();
        let mut done = work();
        for helper in helpers {
            done.extend(helper.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic)));
        }
        done
    });
    done.sort_unstable_by_key(|(band, _)| *band);
    Picture::new(width, height, done.into_iter().flat_map(|(_, bytes)| bytes).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use microsim_core::glam::Vec2;
    use microsim_core::microscope::{Field, Film, Microscope, Optics};
    use microsim_core::{World, WorldConfig};

    #[test]
    fn a_picture_does_not_depend_on_the_number_of_threads() {
        let world = World::new(WorldConfig::default()).unwrap();
        let field = Field { centre: Vec2::new(80.0, 45.0), width: 30.0, pixels: [70, 200] };
        let microscope = Microscope { optics: Optics::PHASE_CONTRAST, film: Film::CINE };
        let exposure = microscope.expose(&world, field).unwrap();
        let pictures = [1, 2, 5].map(|threads| develop(&exposure, threads));
        assert!(pictures[0] == pictures[1] && pictures[0] == pictures[2]);
        assert_eq!(pictures[0].bytes().len(), 70 * 200 * 3);
    }
}
