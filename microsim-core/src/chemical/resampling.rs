//! Concentrations along a line in other cells: what the cells overlap, so that nothing is lost where the old line was.

/// From cells of one width to so many of another, both from the same end; beyond the old ones `fill`.
pub(super) struct Resampling {
    pub from: f32,
    pub to: f32,
    pub count: usize,
    pub fill: f32,
}

impl Resampling {
    /// Concentrations in the new cells.
    pub(super) fn of(&self, old: &[f32]) -> Vec<f32> {
        let mean = |k: usize| {
            let (low, high) = (k as f32 * self.to, (k + 1) as f32 * self.to);
            let first = (low / self.from) as usize;
            let (mut sum, mut covered) = (0.0, 0.0);
            for (cell, value) in old.iter().enumerate().skip(first.saturating_sub(1)) {
                let (start, end) = (cell as f32 * self.from, (cell + 1) as f32 * self.from);
                if start >= high {
                    break;
                }
                let (from, until) = (if start > low { start } else { low }, if end < high { end } else { high });
                let share = if until > from { (until - from) / self.to } else { 0.0 };
                (sum, covered) = (sum + share * value, covered + share);
            }
            // What is left over is either rounding, or beyond the old cells.
            let rest = 1.0 - covered;
            if rest > ROUNDING { sum + rest * self.fill } else { sum / covered }
        };
        (0..self.count).map(mean).collect()
    }
}

/// Largest error of the sum of shares.
const ROUNDING: f32 = 1e-3;

#[cfg(test)]
mod tests {
    use super::*;

    fn amount(values: &[f32], width: f32) -> f32 {
        values.iter().sum::<f32>() * width
    }

    #[test]
    fn finer_and_coarser_cells_hold_the_same_amount() {
        let old: Vec<f32> = (0..40u8).map(|k| f32::from(k % 7)).collect();
        for count in [1, 7, 39, 40, 41, 160] {
            let to = 80.0 / count as f32;
            let new = Resampling { from: 2.0, to, count, fill: 9.0 }.of(&old);
            assert!((amount(&new, to) / amount(&old, 2.0) - 1.0).abs() < 1e-5, "{count} cells");
        }
        assert_eq!(Resampling { from: 2.0, to: 2.0, count: 40, fill: 9.0 }.of(&old), old);
    }

    #[test]
    fn what_is_beyond_the_old_cells_is_filled() {
        let new = Resampling { from: 2.0, to: 2.5, count: 4, fill: 1.0 }.of(&[3.0, 3.0, 5.0]);
        let expected = [3.0, (1.5 * 3.0 + 5.0) / 2.5, (5.0 + 1.5) / 2.5, 1.0];
        assert!(new.iter().zip(expected).all(|(new, expected)| (new - expected).abs() < 1e-5), "{new:?}");
    }
}
