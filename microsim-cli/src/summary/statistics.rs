//! Medians and percentiles.

use serde::Serialize;

/// How measured values spread.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub(crate) struct Spread {
    pub median: f64,
    pub p90: f64,
    pub p99: f64,
}

impl Spread {
    /// All 0 when there are no values.
    pub(crate) fn of(values: &[f64]) -> Self {
        let sorted = sorted(values);
        Self { median: percentile(&sorted, 0.5), p90: percentile(&sorted, 0.9), p99: percentile(&sorted, 0.99) }
    }
}

/// The value in the middle; 0 when there are none.
pub(crate) fn median(values: &[f64]) -> f64 {
    percentile(&sorted(values), 0.5)
}

/// The arithmetic mean; 0 when there are no values.
pub(crate) fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len().max(1) as f64
}

fn sorted(values: &[f64]) -> Vec<f64> {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    sorted
}

/// Linear between the two nearest ranks: `rank = share (n - 1)`.
fn percentile(sorted: &[f64], share: f64) -> f64 {
    let Some(last) = sorted.len().checked_sub(1) else {
        return 0.0;
    };
    let rank = share * last as f64;
    let (low, high) = (rank.floor() as usize, (rank.ceil() as usize).min(last));
    sorted[low] + (sorted[high] - sorted[low]) * rank.fract()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn percentiles_lie_between_their_ranks() {
        let values: Vec<f64> = (0..=100).rev().map(f64::from).collect();
        let spread = Spread::of(&values);
        assert_eq!((spread.median, spread.p90, spread.p99), (50.0, 90.0, 99.0));
        assert_eq!(median(&[4.0, 1.0]), 2.5);
    }

    #[test]
    fn few_values_are_no_trouble() {
        assert_eq!(Spread::of(&[]), Spread::default());
        assert_eq!(median(&[7.0]), 7.0);
        assert_eq!((mean(&[]), mean(&[1.0, 2.0])), (0.0, 1.5));
    }
}
