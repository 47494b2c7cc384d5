//! The numeric solver against closed forms, against itself, and against Pinocchio.

#[cfg(test)]
mod closed_form;
#[cfg(test)]
mod differences;
#[cfg(test)]
mod faults;
#[cfg(test)]
mod identities;
#[cfg(test)]
mod loads;
#[cfg(test)]
mod measure;
#[cfg(test)]
mod oracle;
