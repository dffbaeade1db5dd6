//! Unknown names: the message about one, what it was probably meant to be, and what is accepted.

/// Known names that are listed, more than there are fields in any table.
const MOST_NAMES: usize = 80;

/// Message and accepted names for a name that is none of those known.
pub(crate) fn unknown<'a>(what: &str, name: &str, known: impl IntoIterator<Item = &'a str>) -> (String, String) {
    let known: Vec<&str> = known.into_iter().collect();
    let guess = nearest(name, &known).map_or(String::new(), |near| format!(", did you mean `{near}`?"));
    let accepted = match known.len() {
        0 => "nothing: none is defined".to_owned(),
        count if count > MOST_NAMES => format!("{}, and others", known[..MOST_NAMES].join(", ")),
        _ => known.join(", "),
    };
    (format!("unknown {what} `{name}`{guess}"), accepted)
}

/// The candidate that `word` is most likely a slip of, if any is near.
fn nearest<'a>(word: &str, candidates: &[&'a str]) -> Option<&'a str> {
    let allowed = match word.chars().count() {
        0..=1 | 65.. => return None,
        2..=3 => 1,
        4..=7 => 2,
        _ => 3,
    };
    let distances = candidates.iter().map(|&candidate| (strsim::damerau_levenshtein(word, candidate), candidate));
    let (distance, candidate) = distances.min_by_key(|(distance, _)| *distance)?;
    (distance <= allowed).then_some(candidate)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slips_are_recognised_and_other_words_are_not() {
        let words = ["radius", "density", "speed"];
        assert_eq!(nearest("radus", &words), Some("radius"));
        assert_eq!(nearest("desnity", &words), Some("density"));
        assert_eq!(nearest("colour", &words), None);
        assert_eq!(nearest("", &words), None);
        assert_eq!(nearest(&"r".repeat(5000), &words), None);
        assert_eq!(nearest("pseed", &words), Some("speed"));
    }
}
