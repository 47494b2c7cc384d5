//! Styles of sines and cosines.

/// The notation of sines and cosines in print.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Trigonometry {
    /// `sin q₂`, `cos² q₅`, `sin(q₂ + q₃)`.
    #[default]
    Named,
    /// `s₂`, `c₅²`, `s₂₃` for the joint variables q2, q5, q2 + q3; the angle as an index for others.
    Short,
    /// `sq₂`, `c²q₅`, `s(q₂ + q₃)`, as some papers print.
    Paper,
}
