//! Priors: knowledge about parameters that does not come from the log.

use std::fmt;
use std::str::FromStr;

use super::parameters::Parameters;
use crate::error::Error;

/// Priors in a text such as `ridge=0.01, ZZR_2=1.2:0.1, MX_3=:0.05, FV_1=0:0`. A parameter has a value and its
/// standard deviation. Without a value, that of the robot file is used; with deviation 0, the parameter is fixed. A
/// ridge keeps all parameters near the robot file, each with that fraction of the weight of the log's rows.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Prior {
    /// The weight of the values of the robot file relative to that of all rows of the log.
    pub ridge: f64,
    /// The known parameters, by name.
    pub known: Vec<Known>,
}

/// A known parameter.
#[derive(Clone, Debug, PartialEq)]
pub struct Known {
    /// Its name, such as `ZZR_2`.
    pub name: String,
    /// Its value; `None` for that of the robot file.
    pub value: Option<f64>,
    /// The standard deviation of the value; 0 if it is fixed.
    pub deviation: f64,
}

impl fmt::Display for Prior {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "ridge={}", self.ridge)?;
        for Known { name, value, deviation } in &self.known {
            let value = value.map_or(String::new(), |value| value.to_string());
            write!(f, ", {name}={value}:{deviation}")?;
        }
        Ok(())
    }
}

impl FromStr for Known {
    type Err = Error;

    fn from_str(text: &str) -> Result<Known, Error> {
        let wrong = || {
            Error::Identification(format!(
                "`{text}` is not a prior; write NAME=VALUE:DEVIATION, such as ZZR_2=1.2:0.1, or NAME=:DEVIATION for the \
                 value in the robot file"
            ))
        };
        let (name, known) = text.split_once('=').ok_or_else(wrong)?;
        let (value, deviation) = known.split_once(':').ok_or_else(wrong)?;
        let number =
            |text: &str| text.trim().parse().ok().filter(|number: &f64| number.is_finite());
        let value = match value.trim() {
            "" => None,
            value => Some(number(value).ok_or_else(wrong)?),
        };
        let deviation =
            number(deviation).filter(|deviation| *deviation >= 0.0).ok_or_else(wrong)?;
        Ok(Known { name: name.trim().to_owned(), value, deviation })
    }
}

impl FromStr for Prior {
    type Err = Error;

    fn from_str(text: &str) -> Result<Prior, Error> {
        let mut prior = Prior::default();
        for part in text.split(',').map(str::trim).filter(|part| !part.is_empty()) {
            match part.strip_prefix("ridge=") {
                Some(ridge) => {
                    let found = ridge.trim().parse().ok();
                    let found = found.filter(|ridge: &f64| ridge.is_finite() && *ridge >= 0.0);
                    let wrong = || {
                        Error::Identification(format!("`{part}`: a ridge is a number, 0 or more"))
                    };
                    prior.ridge = found.ok_or_else(wrong)?;
                }
                None => prior.known.push(part.parse()?),
            }
        }
        Ok(prior)
    }
}

/// Priors by the places of the parameters.
#[derive(Clone, Debug)]
pub(super) struct Placed {
    /// The expected values of the parameters, including fixed ones.
    pub(super) expected: Vec<f64>,
    /// The weights of these values, 1/deviation; 0 for parameters without a prior.
    pub(super) weights: Vec<f64>,
    /// The parameters that are not estimated.
    pub(super) fixed: Vec<usize>,
    /// The square root of the ridge.
    pub(super) ridge: f64,
}

impl Placed {
    /// No priors, for this number of parameters.
    pub(super) fn none(count: usize) -> Placed {
        Placed { expected: vec![0.0; count], weights: vec![0.0; count], fixed: vec![], ridge: 0.0 }
    }

    /// Finds the parameters of priors by their names.
    ///
    /// # Errors
    ///
    /// A name that no parameter has, or that occurs twice.
    pub(super) fn of(prior: &Prior, parameters: &Parameters) -> Result<Placed, Error> {
        let mut placed = Placed {
            expected: parameters.nominal.as_slice().to_vec(),
            ridge: prior.ridge.sqrt(),
            ..Placed::none(parameters.names.len())
        };
        let mut seen = vec![];
        for Known { name, value, deviation } in &prior.known {
            let place = parameters.names.iter().position(|other| other == name);
            let place = place.filter(|_| !seen.contains(&name)).ok_or_else(|| {
                let what =
                    if seen.contains(&name) { "is named twice" } else { "is not a base parameter" };
                let names = parameters.names.join(", ");
                Error::Identification(format!("`{name}` {what}; the base parameters are {names}"))
            })?;
            seen.push(name);
            placed.expected[place] = value.unwrap_or(placed.expected[place]);
            match *deviation {
                0.0 => placed.fixed.push(place),
                deviation => placed.weights[place] = 1.0 / deviation,
            }
        }
        Ok(placed)
    }

    /// Whether there is a weight for any parameter.
    pub(super) fn has_weights(&self) -> bool {
        self.ridge > 0.0 || self.weights.iter().any(|weight| *weight > 0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_are_read_and_written() {
        let text = "ridge=0.01, ZZR_2=1.2:0.1, MX_3=:0.05, FV_1=0:0";
        let prior: Prior = text.parse().unwrap();
        assert_eq!(prior.ridge, 0.01);
        assert_eq!(prior.known[1], Known { name: "MX_3".to_owned(), value: None, deviation: 0.05 });
        assert_eq!(prior.to_string(), text);
        for wrong in ["ridge=-1", "ZZR_2", "ZZR_2=1", "ZZR_2=1:-1", "ZZR_2=x:1", "ZZR_2=1:nan"] {
            assert!(wrong.parse::<Prior>().is_err(), "{wrong}");
        }
    }
}
