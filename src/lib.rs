//! Equations of motion of the robots in `robots/`, generated at build time.
