//! The places of wrong values: the entry of an output, and the joint of its row.

use std::fmt;

use robot_dynamics::functions::Output;
use robot_model::robot::Robot;

/// The layout of values: arrays one after another, each with a name and the lengths of its dimensions, stored row by
/// row.
pub struct Layout<'r> {
    robot: &'r Robot,
    arrays: Vec<(String, Vec<usize>)>,
}

impl<'r> Layout<'r> {
    /// The layout of one array.
    pub fn new(robot: &'r Robot, name: &str, shape: &[usize]) -> Layout<'r> {
        Layout { robot, arrays: vec![(name.to_owned(), shape.to_vec())] }
    }

    /// The layout of an array with one value for each coordinate.
    pub fn per_joint(robot: &'r Robot, name: &str) -> Layout<'r> {
        Layout::new(robot, name, &[robot.degrees_of_freedom()])
    }

    /// The layout of the outputs of functions.
    pub fn of<'o, 'g: 'o>(
        robot: &'r Robot,
        outputs: impl IntoIterator<Item = &'o Output<'g>>,
    ) -> Layout<'r> {
        let arrays = outputs.into_iter().map(|output| (output.name.clone(), output.shape.clone()));
        Layout { robot, arrays: arrays.collect() }
    }

    /// The description of an entry, such as ``mass_matrix, row 2 (joint `elbow`), column 3``.
    fn entry(&self, mut index: usize) -> String {
        for (name, shape) in &self.arrays {
            let length: usize = shape.iter().product();
            if index >= length {
                index -= length;
                continue;
            }
            let mut places = vec![];
            for size in shape.iter().rev() {
                places.push(index % size);
                index /= size;
            }
            places.reverse();
            return self.named(name, shape, &places);
        }
        format!("entry {} beyond all outputs", index + 1)
    }

    fn named(&self, name: &str, shape: &[usize], places: &[usize]) -> String {
        let Some((first, more)) = places.split_first() else { return name.to_owned() };
        let mut text = format!("{name}, row {}", first + 1);
        let links = &self.robot.links;
        if shape.first() == Some(&self.robot.degrees_of_freedom()) {
            let moved = links.iter().filter(|link| link.joint.coordinate == *first);
            let names: Vec<String> = moved.map(|link| format!("`{}`", link.joint.name)).collect();
            text += &format!(" (joint {})", names.join(", "));
        } else if shape.first() == Some(&links.len()) {
            text += &format!(" (link `{}`)", links[*first].name);
        }
        for place in more {
            text += &format!(", column {}", place + 1);
        }
        text
    }
}

/// The largest difference between values and their expected values.
pub struct Off {
    /// The difference relative to the size of the values; infinite if a value is NaN.
    pub error: f64,
    entry: String,
    found: f64,
    expected: f64,
}

impl Off {
    /// Finds the largest difference, relative to `size`.
    pub fn of(layout: &Layout<'_>, found: &[f64], expected: &[f64], size: f64) -> Off {
        assert_eq!(found.len(), expected.len(), "{}", layout.entry(0));
        let errors = found.iter().zip(expected).map(|(a, b)| (a - b).abs() / size);
        let errors = errors.map(|error| if error.is_nan() { f64::INFINITY } else { error });
        let worst = errors.enumerate().max_by(|(_, a), (_, b)| a.total_cmp(b));
        let Some((index, error)) = worst else {
            return Off { error: 0.0, entry: String::new(), found: 0.0, expected: 0.0 };
        };
        let entry = layout.entry(index);
        Off { error, entry, found: found[index], expected: expected[index] }
    }
}

/// The text of the difference, such as `off by 1.05e-1 at mass_matrix, row 2 (joint `elbow`), column 3: 0.2 for 0.3`.
impl fmt::Display for Off {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Off { error, entry, found, expected } = self;
        write!(formatter, "off by {error:e} at {entry}: {found} for {expected}")
    }
}
