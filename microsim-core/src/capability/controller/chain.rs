//! A controller and everything that it does otherwise, written as a list, so that nobody can write one that is nested
//! without end.

use super::{Controller, DEEPEST};
use serde::de::{Error, SeqAccess, Visitor};
use serde::ser::SerializeSeq;
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use std::fmt;

/// An element of the list: a controller without what it does otherwise.
struct Element<T>(T);

impl Serialize for Element<&Controller> {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        Controller::serialize(self.0, to)
    }
}

impl<'de> Deserialize<'de> for Element<Controller> {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        Controller::deserialize(from).map(Self)
    }
}

impl Serialize for Controller {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        let mut list = to.serialize_seq(Some(self.chain().count()))?;
        self.chain().try_for_each(|controller| list.serialize_element(&Element(controller)))?;
        list.end()
    }
}

impl<'de> Deserialize<'de> for Controller {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        from.deserialize_seq(Chain)
    }
}

struct Chain;

impl<'de> Visitor<'de> for Chain {
    type Value = Controller;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "1 to {DEEPEST} controllers, each what the one before it does otherwise")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<Controller, A::Error> {
        let wrong = |length: usize| A::Error::invalid_length(length, &self);
        let mut found: Vec<Controller> = Vec::new();
        while let Some(Element(controller)) = list.next_element()? {
            found.push(controller);
            if found.len() > DEEPEST {
                return Err(wrong(found.len()));
            }
        }
        let count = found.len();
        let mut inwards = found.into_iter().rev();
        let innermost = inwards.next().ok_or_else(|| wrong(0))?;
        inwards.try_fold(innermost, |otherwise, mut controller| {
            *controller.otherwise_mut().ok_or_else(|| wrong(count))? = otherwise;
            Ok(controller)
        })
    }
}

#[cfg(all(test, feature = "snapshot"))]
mod tests {
    use super::super::flee::FleeParams;
    use super::*;

    /// So many controllers, one in another.
    fn nested(count: usize) -> Controller {
        (1..count).fold(Controller::thrash(0.2, 0.5), |inner, _| Controller::flee(FleeParams::default(), inner))
    }

    fn written(controller: &Controller) -> Vec<u8> {
        postcard::to_stdvec(controller).unwrap()
    }

    fn read(bytes: &[u8]) -> Option<Controller> {
        postcard::from_bytes(bytes).ok()
    }

    #[test]
    fn what_is_nested_is_read_as_it_was_written_and_no_deeper_than_it_may_be() {
        for count in 1..=DEEPEST {
            let controller = nested(count);
            assert_eq!((controller.validate(), read(&written(&controller))), (Ok(()), Some(controller)));
        }
        let deeper = nested(DEEPEST + 1);
        assert_eq!(deeper.validate().unwrap_err().field(), "otherwise");
        assert_eq!(read(&written(&deeper)), None);
    }

    #[test]
    fn a_list_that_is_no_chain_is_refused() {
        let element = |controller: &Controller| written(controller)[1..].to_vec();
        let still = element(&Controller::Still);
        let flight = written(&Controller::flee(FleeParams::default(), Controller::Still));
        let flight = &flight[1..flight.len() - still.len()];
        let fleeing = Controller::flee(FleeParams::default(), Controller::Still);
        assert_eq!(read(&[&[1][..], flight].concat()), Some(fleeing), "it rests otherwise");
        assert_eq!(read(&[0]), None, "none");
        assert_eq!(read(&[&[2][..], &still, &still].concat()), None, "one that does nothing otherwise");
        // A million, as a number of three bytes.
        assert_eq!(read(&[&[0xc0, 0x84, 0x3d][..], &flight.repeat(1_000_000)].concat()), None);
    }
}
