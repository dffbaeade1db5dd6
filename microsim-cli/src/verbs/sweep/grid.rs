//! The axes and seeds of a sweep.

use std::collections::BTreeSet;
use std::fmt::Display;
use std::str::FromStr;

/// Most values of one axis.
const MOST: u64 = 1_000_000;

/// `--grid KEY=VALUES`.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Axis {
    pub key: String,
    pub values: Vec<String>,
}

/// `--seeds`.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Seeds(pub Vec<u64>);

impl FromStr for Axis {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let expected = "expected KEY=a..b, KEY=a..b/n or KEY=x,y,z, for example count=1..5 or speed=0.5..2/4";
        let (key, values) = text.split_once('=').ok_or(expected)?;
        let (key, values) = (key.trim(), values.trim());
        if key.is_empty() || values.is_empty() {
            return Err(expected.to_owned());
        }
        let values = each_once(range(values)?.unwrap_or_else(|| listed(values)))?;
        Ok(Self { key: key.to_owned(), values })
    }
}

impl FromStr for Seeds {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let values = range(text)?.unwrap_or_else(|| listed(text));
        let seed = |value: &String| {
            value.parse().map_err(|_| format!("{value:?} is not a seed, expected 0..99 or whole numbers with commas"))
        };
        each_once(values.iter().map(seed).collect::<Result<_, _>>()?).map(Self)
    }
}

/// The numbers of `a..b` and `a..b/n`, ends included; `None` for anything else.
fn range(text: &str) -> Result<Option<Vec<String>>, String> {
    let Some((low, high)) = text.split_once("..") else {
        return Ok(None);
    };
    if let Some((high, count)) = high.split_once('/') {
        let number = |part: &str| part.trim().parse::<f64>().ok().filter(|number| number.is_finite());
        let ends = number(low).zip(number(high)).filter(|(low, high)| low < high);
        let count = count.trim().parse::<u64>().ok().filter(|count| (2..=MOST).contains(count));
        let ((low, high), count) =
            ends.zip(count).ok_or("expected a..b/n: two numbers in order and 2 or more values")?;
        let at = |k: u64| if k == count - 1 { high } else { low + (high - low) * k as f64 / (count - 1) as f64 };
        // Ends are what was asked for, however small beside the other one; 0 between them is no rounding error.
        let common = decimals(low.abs().max(high.abs()));
        let digits = |k: u64| if k == 0 || k == count - 1 { decimals(at(k).abs()).max(common) } else { common };
        return Ok(Some((0..count).map(|k| shortest(at(k), digits(k))).collect()));
    }
    let ends = low.trim().parse::<i64>().ok().zip(high.trim().parse::<i64>().ok());
    let (low, high) = ends.filter(|(low, high)| low <= high).ok_or("expected a..b: two whole numbers in order")?;
    if high.abs_diff(low) >= MOST {
        return Err(format!("more than {MOST} values"));
    }
    Ok(Some((low..=high).map(|value| value.to_string()).collect()))
}

/// Refuses values of which two are equal: their tasks would be one and the same.
fn each_once<T: Ord + Display>(values: Vec<T>) -> Result<Vec<T>, String> {
    let mut known = BTreeSet::new();
    let twice = values.iter().find(|value| !known.insert(*value));
    twice.map_or(Ok(()), |value| Err(format!("{value} is there twice, accepted: each value once")))?;
    Ok(values)
}

/// Decimals to which numbers up to this one are written: 12 digits of it, which drops the rounding errors of divisions.
fn decimals(largest: f64) -> usize {
    (12.0 - largest.log10().ceil()).clamp(0.0, 300.0) as usize
}

/// Whole numbers without a fraction, to serve as counts.
fn shortest(value: f64, decimals: usize) -> String {
    let text = format!("{value:.decimals$}");
    if decimals == 0 { text } else { text.trim_end_matches('0').trim_end_matches('.').to_owned() }
}

/// Values between commas that are not within brackets or quotes.
fn listed(text: &str) -> Vec<String> {
    let (mut values, mut depth, mut quote) = (vec![String::new()], 0_i32, None);
    for c in text.chars() {
        match (c, quote) {
            (_, Some(open)) if c == open => quote = None,
            ('"' | '\'', None) => quote = Some(c),
            ('[' | '{', None) => depth += 1,
            (']' | '}', None) => depth -= 1,
            _ => {}
        }
        match values.last_mut() {
            _ if c == ',' && depth == 0 && quote.is_none() => values.push(String::new()),
            Some(last) => last.push(c),
            None => {}
        }
    }
    values.iter().map(|value| value.trim().to_owned()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn values(text: &str) -> Vec<String> {
        format!("k={text}").parse::<Axis>().unwrap().values
    }

    #[test]
    fn ranges_include_both_ends() {
        assert_eq!(values("1..4"), ["1", "2", "3", "4"]);
        assert_eq!(values("-1..1"), ["-1", "0", "1"]);
        assert_eq!(values("0..1/5"), ["0", "0.25", "0.5", "0.75", "1"]);
        assert_eq!(values("0.1..0.3/3"), ["0.1", "0.2", "0.3"]);
        assert_eq!(values("1e-10..4e-10/4"), ["0.0000000001", "0.0000000002", "0.0000000003", "0.0000000004"]);
        assert_eq!(values("1e-9..1e6/2"), ["0.000000001", "1000000"]);
        assert_eq!(values("-1e6..1e-9/2"), ["-1000000", "0.000000001"]);
        assert_eq!(values("0..3e15/4"), ["0", "1000000000000000", "2000000000000000", "3000000000000000"]);
        assert_eq!("3..5".parse(), Ok(Seeds(vec![3, 4, 5])));
    }

    #[test]
    fn values_are_split_where_nothing_is_open() {
        assert_eq!(values("[1, 2],[3, 4]"), ["[1, 2]", "[3, 4]"]);
        assert_eq!(values("a,\"b,c\""), ["a", "\"b,c\""]);
        assert_eq!(values("'a,b',c"), ["'a,b'", "c"]);
    }

    #[test]
    fn what_is_no_axis_is_refused() {
        for text in [
            "k",
            "k=",
            "=1",
            "k=5..1",
            "k=0..99999999",
            "k=0..1/1",
            "k=1..1/2",
            "k=x..y",
            "k=1,2,1",
            "k=1..1.00000000000001/9",
        ] {
            assert!(text.parse::<Axis>().is_err(), "{text}");
        }
        assert!("a".parse::<Seeds>().is_err() && "7,07".parse::<Seeds>().is_err() && "-1".parse::<Seeds>().is_err());
    }
}
