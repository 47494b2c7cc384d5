//! The letters of joint torques and of everything that the forms define.

use robot_dynamics::quantity::Kind;
use robot_model::diagnostic::quote;
use robot_model::signs;
use robot_model::variable::JointVariable;

use super::{Equation, Group, Writer};
use crate::error::Error;
use crate::latex;
use crate::math::{Math, Script};

/// The usual letter of the matrix of the Coriolis and centrifugal terms.
pub(super) const VELOCITY_MATRIX: &str = "C";

/// Letters of what the forms define, the preferred one first: the first that no symbol of the robot has is taken.
pub(super) mod candidates {
    pub(in crate::forms) const MASS_MATRIX: [&str; 6] = ["M", "H", "A", "D", "B", "W"];
    /// Coefficients of products of two velocities.
    pub(in crate::forms) const VELOCITY: [&str; 5] = ["b", "h", "v", "n", "B"];
    pub(in crate::forms) const CHRISTOFFEL: [&str; 5] = ["c", "C", "e", "f", "E"];
    /// The column of the Coriolis and centrifugal terms, and their matrix.
    pub(in crate::forms) const VELOCITY_COLUMN: [&str; 5] = ["h", "n", "v", "u", "V"];
    pub(in crate::forms) const VELOCITY_MATRIX: [&str; 5] =
        [super::VELOCITY_MATRIX, "K", "N", "Z", "V"];
    pub(in crate::forms) const GRAVITY: [&str; 4] = ["g", "G", "f", "P"];
    /// Contributions of the tips' wrenches.
    pub(in crate::forms) const WRENCH: [&str; 4] = ["w", "r", "e", "R"];
    /// Coefficients of the base parameters.
    pub(in crate::forms) const REGRESSOR: [&str; 4] = ["Y", "W", "A", "X"];
    /// Masses of links that are more than a number or a symbol.
    pub(crate) const LINK_MASS: [&str; 4] = ["m", "M", "A", "B"];
    /// Combinations of parameters, and expressions of the state.
    pub(in crate::forms) const OF_PARAMETERS: [&str; 7] = ["k", "p", "h", "A", "B", "K", "X"];
    pub(in crate::forms) const OF_STATE: [&str; 7] = ["x", "u", "y", "z", "w", "Y", "Z"];
}

/// The letters of joint torques and of the symbols that the grouped form defines. A letter that is `None` is chosen
/// from those that no symbol of the robot has, except for the letter of the joint torques.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Letters {
    /// The letter of the joint torques; `None` for Q.
    pub torque: Option<String>,
    /// The letter of the mass matrix and its entries.
    pub mass: Option<String>,
    /// The letter of the Coriolis and centrifugal terms: of their column, their matrix, and the coefficients of
    /// products of velocities. If it is C, it is the letter of the matrix, and the grouped form
    /// has Christoffel symbols.
    pub velocity: Option<String>,
    /// The letter of the gravity terms.
    pub gravity: Option<String>,
}

impl Letters {
    /// The names of the sets of letters: the letters that are usual in robotics, and those of the paper.
    pub const SETS: [&'static str; 2] = ["field", "paper"];

    /// Reads four letters separated by commas, each a Latin one or the name of a Greek one, or the name of a set.
    ///
    /// # Errors
    ///
    /// A number of letters other than four, names that are not letters, and letters that are given twice.
    pub fn parse(text: &str) -> Result<Letters, InvalidLetters> {
        let [field, paper] = Letters::SETS;
        if text == paper {
            return Ok(Letters::default());
        }
        let usual = [JointVariable::Torque.name(), "M", VELOCITY_MATRIX, "g"];
        let letters: Vec<&str> = match text == field {
            true => usual.into(),
            false => text.split(',').map(str::trim).collect(),
        };
        let is_letter = |letter: &&str| {
            let mut characters = letter.chars();
            let single = characters.next().is_some_and(|first| first.is_ascii_alphabetic());
            (single && characters.next().is_none()) || signs::Letter::greek(letter).is_some()
        };
        let mut wrong = vec![];
        for (place, letter) in letters.iter().enumerate() {
            let (shown, is_again) = (quote(letter), letters[..place].contains(letter));
            match (is_letter(letter), is_again) {
                (true, false) | (false, true) => {}
                (true, true) => wrong.push(format!("`{shown}` is given twice")),
                (false, false) => wrong.push(format!(
                    "`{shown}` is not a letter: one of a to z or A to Z, or the name of a Greek one"
                )),
            }
        }
        wrong.extend(
            (letters.len() != 4).then(|| format!("four letters are needed, not {}", letters.len())),
        );
        let letters: Vec<Option<String>> =
            letters.iter().map(|letter| Some((*letter).to_owned())).collect();
        match <[Option<String>; 4]>::try_from(letters) {
            Ok([torque, mass, velocity, gravity]) if wrong.is_empty() => {
                Ok(Letters { torque, mass, velocity, gravity })
            }
            _ => Err(InvalidLetters(wrong.join("; "))),
        }
    }

    /// The letter of the joint torques in text.
    pub(crate) fn torque(&self) -> &str {
        self.torque.as_deref().unwrap_or(Kind::JointTorque.name())
    }

    /// The sign of the joint torques.
    pub(crate) fn torque_sign(&self) -> Math {
        Math::Letter(character(self.torque()))
    }
}

/// Texts that are not letters, with the reason.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "{0}; letters are `field`, `paper`, or four different ones, for joint torques, mass matrix, Coriolis \
     and centrifugal terms, and gravity terms, such as tau,M,C,g"
)]
pub struct InvalidLetters(String);

/// The character of a letter by its name.
pub(super) fn character(name: &str) -> char {
    let greek = signs::Letter::greek(name).map(|letter| letter.character);
    greek.or(name.chars().next()).unwrap_or('x')
}

impl Writer<'_, '_> {
    /// The letter that is given, or one that no symbol has. A letter of the gravity terms may also be that of the
    /// acceleration of gravity, as usual.
    pub(super) fn letter(&self, given: Option<&str>, candidates: &[&'static str]) -> String {
        let free = || match candidates {
            [usual, others @ ..] if candidates == candidates::GRAVITY => {
                match self.symbols.free_letter(candidates) {
                    free if free == *usual => free,
                    _ => self.symbols.free_letter_alone(others),
                }
            }
            _ => self.symbols.free_letter_alone(candidates),
        };
        given.map_or_else(|| free().to_owned(), str::to_owned)
    }

    /// Keeps the given letters for what they are given for.
    ///
    /// # Errors
    ///
    /// If a given letter is a symbol of the robot, π, or that of the joint positions or of sines and cosines.
    pub(super) fn reserve_letters(&mut self) -> Result<(), Error> {
        let Letters { torque, mass, velocity, gravity } = &self.options.letters;
        let [usual, ..] = candidates::GRAVITY;
        let other = gravity.as_ref().filter(|letter| *letter != usual);
        for letter in
            [torque.as_ref(), mass.as_ref(), velocity.as_ref(), other].into_iter().flatten()
        {
            let owner = if self.symbols.is_symbol(letter) {
                "a symbol of this robot"
            } else if letter == JointVariable::Position.name() {
                "the joint positions"
            } else if letter == "pi" {
                "the number π"
            } else if self.symbols.is_letter_of_sines(letter) {
                "sines and cosines"
            } else {
                continue;
            };
            return Err(Error::TakenLetter { letter: letter.clone(), owner });
        }
        let given = [torque, mass, velocity, gravity].into_iter().flatten();
        self.symbols.reserve(given.map(String::as_str));
        Ok(())
    }

    /// Returns an error if a joint torque or a vector of the equations would look like a symbol of the robot or like one
    /// that the form has defined. The letter of the torques can be that of a symbol with the number of no joint.
    pub(super) fn check_letters(&self, groups: &[Group]) -> Result<(), Error> {
        let has_vectors = groups.iter().any(|group| group.vector.is_some());
        if has_vectors {
            self.check_vectors()?;
        }
        let letter = self.options.letters.torque();
        let joints = 1..=self.robot.degrees_of_freedom();
        let own: Vec<String> = joints.map(|joint| format!("{letter}{joint}")).collect();
        let is_own =
            |name: &str| own.iter().any(|one| one == name) && self.symbols.is_defined(name);
        let printed = |name: &str| latex::formula(&self.symbols.look(name)).replace(['{', '}'], "");
        let is_part = |name: &str, one: &str| {
            name.strip_prefix(one).is_some_and(|tail| tail.is_empty() || tail.starts_with('.'))
        };
        let is_alike =
            |name: &str| own.iter().any(|one| is_part(name, one) || printed(one) == printed(name));
        let mut others = self.symbols.symbols_with_letter(letter).filter(|name| !is_own(name));
        // A quantity such as `F1.x` is not a symbol if no other equation has it.
        let first = format!("{letter}1.");
        let names = groups.iter().flat_map(|group| &group.equations).map(|one| &one.name);
        let is_quantity = names.into_iter().any(|name| name.starts_with(&first));
        let owner = if is_quantity || others.any(is_alike) {
            "other symbols of these equations"
        } else if has_vectors && self.symbols.is_symbol(letter) {
            "a symbol of this robot"
        } else {
            return Ok(());
        };
        Err(Error::TakenLetter { letter: letter.to_owned(), owner })
    }

    /// Returns an error if a left side of the equations or of their matrices and columns is printed like a symbol of the
    /// robot.
    pub(super) fn check_left_sides(&self, groups: &[Group]) -> Result<(), Error> {
        let sides = groups.iter().flat_map(|group| {
            let equations = group.equations.iter().chain(&group.vector);
            let arrays = group.arrays.iter().flatten().map(|array| (&array.name, &array.left));
            equations.map(|one| (&one.name, &one.left)).chain(arrays)
        });
        sides.into_iter().try_for_each(|(name, left)| self.symbols.check_left_side(name, left))
    }

    /// Returns an error if a symbol of the robot is printed like the vector of the joint positions, velocities or
    /// accelerations.
    fn check_vectors(&self) -> Result<(), Error> {
        JointVariable::MOTION.map(JointVariable::name).into_iter().try_for_each(|vector| {
            self.symbols.check_printed(vector, &latex::formula(&Math::spelled(vector)))
        })
    }

    /// The error about a given letter, if a symbol of a form with this letter is printed like one of the robot: then another
    /// letter is the remedy, not another symbol.
    pub(super) fn blamed(&self, error: Error) -> Error {
        let Letters { mass, velocity, gravity, .. } = &self.options.letters;
        let mut given = [mass, velocity, gravity].into_iter().flatten();
        let of_form = match &error {
            Error::Alike { name, other, .. } => {
                [name, other].into_iter().find(|name| self.symbols.is_defined(name))
            }
            _ => None,
        };
        let letter =
            of_form.and_then(|name| given.find(|letter| name.starts_with(letter.as_str())));
        match letter {
            Some(letter) => Error::TakenLetter {
                letter: letter.clone(),
                owner: "indexed symbols of this robot",
            },
            None => error,
        }
    }

    /// Gives the joint torques their letter.
    pub(super) fn name_torque(&self, equation: &mut Equation) {
        let usual = Kind::JointTorque.name();
        let Some(letter) = &self.options.letters.torque else { return };
        let Some(number) = equation.name.strip_prefix(usual) else { return };
        equation.name = format!("{letter}{number}");
        let base = self.options.letters.torque_sign();
        equation.left = match &equation.left {
            Math::Script(script) => Math::Script(Box::new(Script { base, ..*script.clone() })),
            _ => base,
        };
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn letters_are_four_or_a_set() {
        let field = Letters::parse("field").unwrap();
        assert_eq!(Letters::parse("tau, M,C,g"), Ok(field.clone()));
        assert_eq!(field.torque_sign(), Math::Letter('τ'));
        assert_eq!(Letters::parse("paper"), Ok(Letters::default()));
        assert_eq!(Letters::default().torque_sign(), Math::Letter('Q'));
        for wrong in ["tau,M,C", "tau,M,M,g", "tau,M,C,gg", "feild", ",,,", "1,2,3,4"] {
            assert!(Letters::parse(wrong).is_err(), "{wrong}");
        }
        let all = Letters::parse("tau,M,M,gg,1").unwrap_err().to_string();
        for part in ["`gg` is not a letter", "`1` is not a letter", "`M` is given twice", "not 5"] {
            assert!(all.contains(part), "{part}: {all}");
        }
    }
}
