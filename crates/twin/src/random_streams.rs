//! The streams of random numbers that follow from the seed of a scenario, all different: adding noise does not change which readings
//! are lost, nor one fault those that another loses.

/// The stream of the sensors.
pub(crate) const SENSORS: u64 = 1;

/// The stream of a fault, by its index in the scenario.
pub(crate) fn fault_stream(index: usize) -> u64 {
    let index = index as u64;
    if index < SENSORS { index } else { index + 1 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_two_streams_are_the_same() {
        let mut streams: Vec<u64> = (0..9).map(fault_stream).chain([SENSORS]).collect();
        streams.sort_unstable();
        streams.dedup();
        assert_eq!(streams.len(), 10);
        assert_eq!(fault_stream(0), 0, "the first fault keeps its stream, and a run of it its hash");
    }
}
