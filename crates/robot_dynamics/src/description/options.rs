//! What the caller may ask of a reader.

/// The format of a robot file.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Format {
    /// The project's own, in TOML.
    Toml,
    /// The format of ROS, in XML.
    Urdf,
}

/// How a description is read that has no words for what a robot file can say itself. Robot files in
/// TOML are not affected.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Options {
    /// Lets moving links have no mass; without this they are errors.
    pub allow_massless: bool,
    /// Takes inertias that no body can have; the errors become warnings.
    pub allow_unphysical: bool,
    /// Takes the friction of joints: damping as viscous, friction as constant dry friction. Without
    /// this it is left out of the robot.
    pub friction: bool,
}
