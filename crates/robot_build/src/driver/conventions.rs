//! The conventions, as every generated module states them.

/// The conventions of robot files, equations and code, a line each.
pub const CONVENTIONS: [&str; 7] = [
    "SI units, angles in radians; right-handed frames. A link's frame is its parent's frame, displaced \
     as the robot file says, then moved by the joint.",
    "Roll, pitch and yaw turn about fixed axes: R = Rz(yaw) Ry(pitch) Rx(roll).",
    "Gravity is the acceleration of gravity: it points down.",
    "Inertia tensors are about the centre of mass, in link axes unless the file says otherwise.",
    "A tip's wrench is what the tip exerts on its surroundings, in the tip's axes, the moment about its \
     origin: a hanging mass m with the axes upright is force z = +m g.",
    "Armature, rotor inertia and gear ratio are three figures; the reflected inertia is armature + \
     ratio² · rotor inertia.",
    "Friction is b q̇ + c (d/2) F sgn q̇ for a rotation and b q̇ + c F sgn q̇ for a translation, where F \
     is the size of the contact force across the axis and sgn 0 = 0.",
];
