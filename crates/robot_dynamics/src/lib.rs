//! Robots and mechanics: robot files, the Newton-Euler iterations, dynamic quantities as named expressions.
