use microsim_core::glam::Vec2;
use microsim_core::*;
fn main() {
    let a: Vec<f32> = std::env::args().skip(1).map(|x| x.parse().unwrap()).collect();
    let (mu, w, hgt, substeps, damping, g, time) = (a[0], a[1], a[2], a[3] as u32, a[4], a[5], a[6]);
    let mut world = World::new(WorldConfig {
        size: Vec2::new(300., 400.),
        damping,
        substeps,
        gravity: Vec2::new(0., -g),
        max_speed: 120.0,
        ..Default::default()
    })
    .unwrap();
    let fluid = FluidParams { mode: FluidMode::Granular, viscosity: 0.0, friction: mu, ..Default::default() };
    let f = world
        .spawn(&FluidBlockSpec { size: Vec2::new(w, hgt), fluid }.into(), Placement::at(150., hgt / 2. + 0.1))
        .unwrap();
    let e0 = {
        let v = world.view();
        v.organism(f).unwrap().particles().map(|p| (p.position.y - 0.5) * g).sum::<f32>()
    };
    for s in 0..=(time * 60.) as u32 {
        if s % ((time * 6.) as u32) == 0 {
            let v = world.view();
            let p: Vec<_> = v.organism(f).unwrap().particles().collect();
            let n = p.len() as f32;
            let e = p.iter().map(|p| (p.position.y - 0.5) * g + 0.5 * p.velocity.length_squared()).sum::<f32>();
            let com = p.iter().map(|p| p.position.y).sum::<f32>() / n;
            let top = p.iter().map(|p| p.position.y).fold(0., f32::max);
            let mut bins = [0.0f32; 300];
            for q in &p {
                let b = (q.position.x as usize).min(299);
                bins[b] = bins[b].max(q.position.y + 0.5);
            }
            let front = (0..300)
                .filter(|&b| bins[b] > 1.5)
                .map(|b| b as f32)
                .fold((300.0f32, 0.0f32), |(a, z), b| (a.min(b), z.max(b)));
            // slope: least squares of profile right side between 20% and 80% of top
            let pts: Vec<(f32, f32)> = (150..300)
                .filter(|&b| bins[b] > 0.15 * top && bins[b] < 0.85 * top)
                .map(|b| (b as f32 + 0.5, bins[b]))
                .collect();
            let m = pts.len() as f32;
            let (mx, my) = (pts.iter().map(|p| p.0).sum::<f32>() / m, pts.iter().map(|p| p.1).sum::<f32>() / m);
            let sl = pts.iter().map(|p| (p.0 - mx) * (p.1 - my)).sum::<f32>()
                / pts.iter().map(|p| (p.0 - mx).powi(2)).sum::<f32>();
            println!(
                "{:.1} E/E0 {:.3} com {com:.2} top {top:.1} front {front:?} angle {:.1} vmax {:.2} overlap {:.3}",
                s as f32 / 60.,
                e / e0,
                -sl.atan().to_degrees(),
                p.iter().map(|p| p.velocity.length()).fold(0., f32::max),
                {
                    let mut c = 9.0f32;
                    for i in (0..p.len()).step_by(37) {
                        for j in 0..p.len() {
                            if i != j {
                                c = c.min((p[i].position - p[j].position).length());
                            }
                        }
                    }
                    1. - c
                }
            );
        }
        world.step(&Inputs::new());
    }
}
