//! The notations of sines and cosines.

/// The notation of sines and cosines in print.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Trigonometry {
    /// `sin q₂`, `cos² q₅`, `sin(q₂ + q₃)`.
    #[default]
    Named,
    /// `s₂`, `c₅²`, `s₂₃` for the joint positions q2, q5 and q2 + q3; other angles are the index themselves,
    /// except numbers: `cos(2)`.
    Short,
    /// `sq₂`, `c²q₅`, `s(q₂ + q₃)`, as in some papers.
    Paper,
}
