//! Compares the numeric solver with closed forms, with itself, and with Pinocchio.

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
