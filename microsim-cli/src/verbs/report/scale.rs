//! Axes: from values to places, and round numbers to write beside them.

/// A range of values along so many pixels.
#[derive(Clone, Copy, Debug)]
pub(super) struct Scale {
    low: f64,
    high: f64,
    from: f64,
    to: f64,
}

impl Scale {
    /// Over all finite values, from one place to another; with a little room if they are all the same.
    pub(super) fn over(values: impl Iterator<Item = f64>, from: f64, to: f64) -> Self {
        let finite = values.filter(|value| value.is_finite());
        let (mut low, mut high) = finite.fold((f64::MAX, f64::MIN), |(low, high), v| (low.min(v), high.max(v)));
        if low > high {
            (low, high) = (0.0, 1.0);
        }
        if high - low < 1e-9 * high.abs().max(1e-6) {
            let room = (0.05 * high.abs()).max(0.5);
            (low, high) = (low - room, high + room);
        }
        Self { low, high, from, to }
    }

    pub(super) fn place(&self, value: f64) -> f64 {
        self.from + (value - self.low) / (self.high - self.low) * (self.to - self.from)
    }

    /// How far along a value is, 0 to 1.
    pub(super) fn share(&self, value: f64) -> f64 {
        ((value - self.low) / (self.high - self.low)).clamp(0.0, 1.0)
    }

    pub(super) fn ends(&self) -> [f64; 2] {
        [self.low, self.high]
    }

    /// About so many multiples of 1, 2 or 5 times a power of ten.
    pub(super) fn ticks(&self, about: f64) -> Vec<f64> {
        let rough = (self.high - self.low) / about;
        let power = 10_f64.powf(rough.log10().floor());
        let step = [1.0, 2.0, 5.0, 10.0].into_iter().map(|k| k * power).find(|step| *step >= rough);
        let step = step.unwrap_or(10.0 * power);
        let first = (self.low / step).ceil() as i64;
        (first..).map(|k| k as f64 * step).take_while(|tick| *tick <= self.high + 1e-9 * step).take(50).collect()
    }
}

/// A number as short as its size allows.
pub(super) fn short(value: f64) -> String {
    let size = value.abs();
    match () {
        () if !value.is_finite() => "–".to_owned(),
        () if size < 1e-12 => "0".to_owned(),
        () if !(1e-3..1e6).contains(&size) => format!("{value:.1e}"),
        () => {
            let digits = (2 - size.log10().floor() as i32).clamp(0, 6) as usize;
            let text = format!("{value:.digits$}");
            if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_round_and_within() {
        let ticks = |low, high| Scale::over([low, high].into_iter(), 0.0, 1.0).ticks(5.0);
        assert_eq!(ticks(0.0, 10.0), [0.0, 2.0, 4.0, 6.0, 8.0, 10.0]);
        assert_eq!(ticks(-1.0, 1.0), [-1.0, -0.5, 0.0, 0.5, 1.0]);
        assert!(!ticks(3.0, 3.0).is_empty() && !ticks(f64::NAN, f64::NAN).is_empty());
    }

    #[test]
    fn numbers_are_short() {
        let texts = [0.0, 1.0, 0.25, 1234.0, 12.3456, 1e-7, -40.0].map(short);
        assert_eq!(texts, ["0", "1", "0.25", "1234", "12.3", "1.0e-7", "-40"]);
        assert_eq!(short(f64::NAN), "–");
    }
}
