//! The times of the output.

use robot_model::diagnostic::number;

use crate::error::Error;

/// The largest number of samples; a table of more would fill the memory.
const MAX_SAMPLES: f64 = 1e7;

/// The times 0, step, 2 step, … up to the duration, and the duration itself if it is not one of them, in s.
///
/// # Errors
///
/// If the duration or the step is not positive, or if there are too many samples.
pub(crate) fn times(duration: f64, step: f64) -> Result<Vec<f64>, Error> {
    let mut wrong = vec![];
    for (name, value) in [("duration", duration), ("output step", step)] {
        if !(value.is_finite() && value > 0.0) {
            wrong
                .push(format!("the {name} is {} s; it must be positive and finite", number(value)));
        }
    }
    Error::check(wrong, ())?;
    // A time that differs from the end only by rounding counts as the end.
    let whole = (duration / step * (1.0 + 1e-12)).floor();
    if whole > MAX_SAMPLES {
        let count = match whole {
            whole if whole < 1e12 => number(whole),
            whole if whole.is_finite() => format!("about {whole:.0e}"),
            _ => "these".to_owned(),
        };
        let message = format!("{count} samples are more than {MAX_SAMPLES}; increase the step");
        return Err(Error::input(message));
    }
    let mut times: Vec<f64> = (0..=whole as usize).map(|index| index as f64 * step).collect();
    match times.last_mut() {
        Some(last) if *last > 0.0 && duration - *last <= 1e-9 * step => *last = duration,
        _ => times.push(duration),
    }
    Ok(times)
}

#[cfg(test)]
mod tests {
    use super::times;

    #[test]
    fn the_end_is_always_there_and_once() {
        assert_eq!(times(1.0, 0.25).unwrap(), [0.0, 0.25, 0.5, 0.75, 1.0]);
        assert_eq!(times(1.0, 0.4).unwrap(), [0.0, 0.4, 0.8, 1.0]);
        assert_eq!(times(0.3, 1.0).unwrap(), [0.0, 0.3]);
        // The start is included, however short the duration is.
        for (duration, step) in [(1e-300, 0.01), (10.0, 1e300), (5e-324, 1.0)] {
            assert_eq!(times(duration, step).unwrap(), [0.0, duration]);
        }
        // The quotients 10 / 0.1 and 0.3 / 0.1 are rounded up and down.
        for (duration, step, count) in [(10.0, 0.1, 101), (0.3, 0.1, 4), (0.7, 0.1, 8)] {
            let times = times(duration, step).unwrap();
            assert_eq!((times.len(), times.last()), (count, Some(&duration)));
        }
    }

    #[test]
    fn what_is_not_a_grid_is_refused() {
        let shown = times(-1.0, f64::NAN).unwrap_err().to_string();
        assert_eq!(shown.lines().count(), 2, "{shown}");
        for (duration, step, message) in [
            (1e4, 1e-4, "100000000 samples are more than"),
            (1e9, 1e-9, "about 1e18 samples are more than"),
            (1e300, 1e-300, "these samples are more than"),
        ] {
            let error = times(duration, step).unwrap_err().to_string();
            assert!(error.starts_with(message), "{error}");
        }
        let shown = times(1e300, 0.01).unwrap_err().to_string();
        assert!(shown.len() < 100, "{shown}");
    }
}
