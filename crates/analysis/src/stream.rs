//! Results for many configurations, each computed when it is written, so that only one is in memory.

use std::{
    cell::RefCell,
    fmt,
    iter::{Peekable, from_fn},
};

use congruent_input::Diagnostic;
use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde::{
    Serialize, Serializer,
    ser::{Error, SerializeSeq},
};

type Results<'a, T> = Peekable<Box<dyn Iterator<Item = Result<T, Diagnostic>> + 'a>>;

/// Results that are computed one at a time, once: by [`Stream::iter`], or while they are serialised as a list.
///
/// An error of the first result is returned at once, that of a later one at the end, by [`Stream::end`].
pub struct Stream<'a, T> {
    results: RefCell<Results<'a, T>>,
    fault: RefCell<Option<Diagnostic>>,
}

impl<'a, T: 'a> Stream<'a, T> {
    /// A stream of results; the first one is computed at once.
    ///
    /// # Errors
    /// The first result cannot be computed.
    pub fn begin(results: impl Iterator<Item = Result<T, Diagnostic>> + 'a) -> Result<Self, Diagnostic> {
        let mut results: Results<'a, T> = (Box::new(results) as Box<dyn Iterator<Item = _> + 'a>).peekable();
        // The first result now: a source that refuses is an error of the call, before anything is written.
        match results.next_if(Result::is_err) {
            Some(Err(fault)) => Err(fault),
            _ => Ok(Self { results: results.into(), fault: None.into() }),
        }
    }

    /// A stream of results that are computed from these.
    ///
    /// # Errors
    /// The first result cannot be computed.
    pub fn map<U: 'a>(
        self,
        mut make: impl FnMut(T) -> Result<U, Diagnostic> + 'a,
    ) -> Result<Stream<'a, U>, Diagnostic> {
        Stream::begin(self.results.into_inner().map(move |result| result.and_then(&mut make)))
    }

    /// The results that were not computed yet, up to the first error.
    pub fn iter(&self) -> impl Iterator<Item = T> + '_ {
        from_fn(|| match self.results.borrow_mut().next()? {
            Ok(result) => Some(result),
            Err(fault) => {
                self.fault.replace(Some(fault));
                None
            }
        })
    }

    /// Ends the stream, and returns the error that stopped it.
    ///
    /// # Errors
    /// A result could not be computed: it and those after it are missing.
    pub fn end(self) -> Result<(), Diagnostic> {
        self.fault.into_inner().map_or(Ok(()), Err)
    }
}

impl<'a, T: Serialize + 'a> Serialize for Stream<'a, T> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut list = serializer.serialize_seq(None)?;
        self.iter().try_for_each(|result| list.serialize_element(&result))?;
        match &*self.fault.borrow() {
            Some(fault) => Err(S::Error::custom(fault)),
            None => list.end(),
        }
    }
}

impl<T: JsonSchema> JsonSchema for Stream<'_, T> {
    fn schema_name() -> std::borrow::Cow<'static, str> {
        Vec::<T>::schema_name()
    }

    fn inline_schema() -> bool {
        true
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        Vec::<T>::json_schema(generator)
    }
}

impl<T> fmt::Debug for Stream<'_, T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Stream")
    }
}

#[cfg(test)]
mod tests {
    use std::cell::Cell;

    use super::*;

    fn fault() -> Diagnostic {
        Diagnostic::error(crate::codes::targets::JSON, "this is wrong")
    }

    #[test]
    fn a_stream_is_the_list_of_its_results() {
        let written =
            |count: i32| serde_json::to_string(&Stream::begin((0..count).map(Ok)).unwrap()).unwrap();
        assert_eq!([written(0), written(1), written(3)], ["[]", "[0]", "[0,1,2]"]);
    }

    #[test]
    fn results_are_made_one_at_a_time() {
        let made = Cell::new(0);
        let results = (0..3).map(|index| {
            made.set(index + 1);
            Ok(index)
        });
        let stream = Stream::begin(results).unwrap();
        stream.iter().for_each(|index| assert_eq!(made.get(), index + 1));
        assert_eq!(made.get(), 3);
    }

    #[test]
    fn a_fault_is_reported_at_once_or_in_the_end() {
        assert_eq!(Stream::<i32>::begin([Err(fault())].into_iter()).unwrap_err(), fault());
        let stream = Stream::begin([Ok(1), Err(fault()), Ok(3)].into_iter()).unwrap();
        assert!(serde_json::to_string(&stream).unwrap_err().to_string().contains("this is wrong"));
        assert_eq!(stream.end(), Err(fault()));
        let stream = Stream::begin([Ok(1), Ok(2)].into_iter()).unwrap();
        let fails = stream.map(|value| if value == 1 { Err(fault()) } else { Ok(value) });
        assert_eq!(fails.unwrap_err(), fault());
    }
}
