//! include_robot!: a robot file becomes a module at compile time.
